// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"

#include <QtWidgets/QToolBar>

namespace qplc {

/// A bar that cannot be moved, hidden or chosen away, with a line of the theme at its edges: those
/// of styles shine in dark themes.
class FlatToolBar : public QToolBar
{
    Q_OBJECT
public:
    /// \param context  outlives the bar
    FlatToolBar(const QString &title, WindowContext *context, QWidget *parent = nullptr);

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    WindowContext *m_context;
};

}  // namespace qplc
