// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/layout/Layout.h"

#include <QtCore/QRandomGenerator>

/// Edits that a person could make, and some that nobody can, chosen by a seed.
class RandomEdits
{
public:
    explicit RandomEdits(quint32 seed)
        : m_random(seed)
    {
    }

    /// Makes one edit with \a editor, which has the edits of a layout. \param layout  what it edits
    template<typename Editor>
    void apply(Editor *editor, const qplc::Layout &layout)
    {
        const QString panel = anyPanel(layout);
        const QString tab = anyTab(layout);
        switch (m_random.bounded(18)) {
        case 0:
        case 1:
        case 2:
            editor->addPanel(QStringLiteral("Gauge"), {{QStringLiteral("n"), number(9)}}, anyTarget(layout));
            break;
        case 3:
            editor->duplicatePanel(panel, anySide());
            break;
        case 4:
            editor->closePanel(panel);
            break;
        case 5:
        case 6:
            editor->movePanel(panel, anyTarget(layout));
            break;
        case 7:
            editor->floatPanel(panel, {number(500), number(500), 1 + number(900), 1 + number(600)});
            break;
        case 8:
            editor->dockPanel(panel);
            break;
        case 9:
            editor->setMaximized(panel, number(2) == 0);
            break;
        case 10:
            editor->setPanelSettings(panel, {{QStringLiteral("n"), number(1000) / 7.0}});
            break;
        case 11:
            editor->setPanelTitle(panel, number(2) == 0 ? QString() : QStringLiteral("Title %1").arg(number(9)));
            break;
        case 12:
            resize(editor, layout, panel);
            break;
        case 13:
            editor->growPanel(panel, number(2) == 0 ? Qt::Horizontal : Qt::Vertical, number(4000) - 2000);
            break;
        case 14:
            editor->addTab();
            break;
        case 15:
            editor->moveTab(tab, number(4));
            break;
        case 16:
            editor->renameTab(tab, QStringLiteral("Name %1").arg(number(9)));
            break;
        case 17:
            number(3) == 0 ? editor->closeTab(tab) : editor->closeWindow(anyWindow(layout));
            break;
        }
    }

private:
    int number(int end) { return m_random.bounded(end); }
    qplc::LayoutSide anySide() { return qplc::LayoutSide(number(4)); }

    QString anyPanel(const qplc::Layout &layout)
    {
        const auto panels = layout.panels();
        return panels.empty() || number(20) == 0 ? QStringLiteral("nobody")
                                                 : panels[std::size_t(number(int(panels.size())))]->id;
    }

    QString anyTab(const qplc::Layout &layout)
    {
        return layout.tabs()[std::size_t(number(int(layout.tabs().size())))].id;
    }

    QString anyWindow(const qplc::Layout &layout)
    {
        return layout.windows().empty() ? QStringLiteral("nowhere")
                                        : layout.windows()[std::size_t(number(int(layout.windows().size())))].id;
    }

    qplc::LayoutTarget anyTarget(const qplc::Layout &layout)
    {
        using qplc::LayoutTarget;
        switch (number(6)) {
        case 0:
            return LayoutTarget::inTab(anyTab(layout));
        case 1:
            return LayoutTarget::inNewTab();
        case 2:
            return LayoutTarget::inNewWindow({number(500), number(500), 300, 200});
        case 3:
            return LayoutTarget::beside(qplc::LayoutSpan{anyPanel(layout), anyPanel(layout)}, anySide());
        default:
            return LayoutTarget::beside(anyPanel(layout), anySide());
        }
    }

    template<typename Editor>
    void resize(Editor *editor, const qplc::Layout &layout, const QString &panel)
    {
        const qplc::LayoutPage *page = layout.pageOf(panel);
        if (!page)
            return;
        QVector<int> shares(int(page->tree->children.size()));
        for (int &share : shares)
            share = 1 + number(5000);
        editor->setShares(page->tree->span(), shares);
    }

    QRandomGenerator m_random;
};
