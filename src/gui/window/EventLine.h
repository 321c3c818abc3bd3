// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BarButton.h"

#include <QtCore/QTimer>

namespace qplc {

/// The newest event that asks to be acknowledged, and how many there are; at the right the newest
/// start or stop. A click opens the log.
class EventLine : public BarButton
{
    Q_OBJECT
public:
    explicit EventLine(WindowContext *context, QWidget *parent = nullptr);

    /// Says what the window has done, for some seconds, or until there is a new event.
    void say(const QString &text);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return {80, sizeHint().height()}; }

private:
    void follow();
    void showEvents();

    WindowContext *m_context;
    QString m_said;
    QTimer m_saying;
};

}  // namespace qplc
