// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BarButton.h"

namespace qplc {

/// The newest event that asks to be acknowledged, and how many there are; a click opens the log.
class EventLine : public BarButton
{
    Q_OBJECT
public:
    explicit EventLine(WindowContext *context, QWidget *parent = nullptr);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return {80, sizeHint().height()}; }

private:
    void follow();

    WindowContext *m_context;
};

}  // namespace qplc
