// SPDX-License-Identifier: Apache-2.0
#include "SignalDock.h"

#include "QPlcSignalTree.h"
#include "gui/layout/LayoutIcons.h"
#include "gui/layout/TitleButton.h"

#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>

namespace qplc {

SignalDock::SignalDock(WindowContext *context, QWidget *parent)
    : QDockWidget(tr("Signals"), parent)
    , m_tree(new QPlcSignalTree(this))
{
    setObjectName(QStringLiteral("SignalDock"));
    m_tree->setContext(context);
    setWidget(m_tree);
    setTitleBarWidget(createTitle());
}

/// With the buttons of panels, in place of those of the style, which are hardly seen in dark
/// themes.
QWidget *SignalDock::createTitle()
{
    auto *title = new QWidget(this);
    auto *row = new QHBoxLayout(title);
    row->setContentsMargins(6, 2, 4, 0);
    row->setSpacing(0);
    row->addWidget(new QLabel(windowTitle()), 1);
    const auto add = [&](LayoutIcon icon, const QString &text) {
        auto *button = new TitleButton;
        button->setIcon(layoutIcon(icon));
        button->setFocusPolicy(Qt::TabFocus);
        button->setToolTip(text);
        button->setAccessibleName(tr("%1: %2").arg(windowTitle(), text));
        row->addWidget(button);
        return button;
    };
    auto *place = add(LayoutIcon::Float, tr("Float"));
    connect(place, &QAbstractButton::clicked, this, [this] { setFloating(!isFloating()); });
    connect(this, &QDockWidget::topLevelChanged, place, [place](bool isFloating) {
        place->setIcon(layoutIcon(isFloating ? LayoutIcon::Dock : LayoutIcon::Float));
        place->setToolTip(isFloating ? tr("Dock back") : tr("Float"));
    });
    connect(add(LayoutIcon::Close, tr("Close (Ctrl+B)")), &QAbstractButton::clicked, this, &QWidget::close);
    return title;
}

void SignalDock::startSearch()
{
    show();
    raise();
    m_tree->startSearch();
}

}  // namespace qplc
