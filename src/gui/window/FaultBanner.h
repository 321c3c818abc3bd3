// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"

#include <QtWidgets/QWidget>

namespace qplc {

/// Says across the whole window that plants meet faults on purpose. It is there as long as they do,
/// and nobody can close it.
class FaultBanner : public QWidget
{
    Q_OBJECT
public:
    /// \param context  outlives the banner
    explicit FaultBanner(WindowContext *context, QWidget *parent = nullptr);

    /// Who injects what; empty: nobody does, and the banner is hidden.
    QString text() const { return m_text; }
    QSize sizeHint() const override { return {400, 28}; }
    QSize minimumSizeHint() const override { return {120, 28}; }

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    void follow();

    WindowContext *m_context;
    QString m_text;
};

}  // namespace qplc
