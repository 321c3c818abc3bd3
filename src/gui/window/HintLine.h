// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BarButton.h"
#include "NoticeLine.h"

#include <QtCore/QPointer>
#include <QtWidgets/QAction>

namespace qplc {

/// A line over the panels that says one thing until it is closed; hidden while it has nothing to
/// say.
class HintLine : public NoticeLine
{
    Q_OBJECT
public:
    explicit HintLine(WindowContext *context, QWidget *parent = nullptr);

    /// Empty: closes the line. \param remedy  what a button of the line does; null: there is none
    void showText(const QString &text, QAction *remedy = nullptr);

private:
    BarButton *m_button;
    BarButton *m_close;
    QPointer<QAction> m_remedy;
};

}  // namespace qplc
