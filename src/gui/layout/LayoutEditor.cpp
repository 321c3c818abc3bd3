// SPDX-License-Identifier: Apache-2.0
#include "LayoutEditor.h"

namespace qplc {

/// Two values, one before and one after an edit.
class LayoutEditor::Step : public QUndoCommand
{
public:
    Step(LayoutEditor *editor, const Layout &after, MergeKind kind, const QString &mergeKey)
        : m_editor(editor)
        , m_before(editor->layout())
        , m_after(after)
        , m_kind(kind)
        , m_mergeKey(mergeKey)
    {
    }

    int id() const override { return m_kind; }
    void undo() override { m_editor->show(m_after, m_before); }
    void redo() override
    {
        m_editor->show(m_before, m_after);
        if (!m_newPanelId.isEmpty())  // what it shows is known now
            setText(LayoutEditor::tr("new panel '%1'").arg(m_editor->titleOf(m_newPanelId)));
    }
    void setNewPanel(const QString &panelId) { m_newPanelId = panelId; }

    bool mergeWith(const QUndoCommand *other) override
    {
        const auto *next = static_cast<const Step *>(other);
        if (next->m_mergeKey != m_mergeKey)
            return false;
        m_after = next->m_after;
        setObsolete(m_after == m_before);
        return true;
    }

private:
    LayoutEditor *m_editor;
    Layout m_before;
    Layout m_after;
    MergeKind m_kind;
    QString m_mergeKey;
    QString m_newPanelId;
};

LayoutEditor::LayoutEditor(QObject *parent)
    : LayoutEditor(Layout(), parent)
{
}

LayoutEditor::LayoutEditor(const Layout &layout, QObject *parent)
    : QObject(parent)
    , m_layout(layout)
{
}

void LayoutEditor::setLayout(const Layout &layout)
{
    m_stack.clear();
    m_layout = layout;
    Q_EMIT layoutChanged();
}

bool LayoutEditor::replace(const Layout &layout, const QString &text)
{
    return push(layout, text, {});
}

void LayoutEditor::show(const Layout &from, const Layout &to)
{
    const std::vector<LayoutWindow> windows = m_layout.windows();
    m_layout = to;
    // A window that the step did not move stays where a person has put it since.
    for (const LayoutWindow &each : windows) {
        const LayoutWindow *before = from.window(each.id);
        const LayoutWindow *after = to.window(each.id);
        if (before && after && before->geometry == after->geometry)
            m_layout.setWindowGeometry(each.id, each.geometry);
    }
    Q_EMIT layoutChanged();
}

bool LayoutEditor::push(const Layout &after, const QString &text, const Merge &merge)
{
    if (after == m_layout)
        return false;
    auto *step = new Step(this, after, merge.kind, QStringLiteral("%1\n%2").arg(m_series).arg(merge.key));
    step->setText(text);
    m_stack.push(step);
    return true;
}

template<typename... Parameters, typename... Arguments>
bool LayoutEditor::edit(bool (Layout::*change)(Parameters...), const QString &text, const Merge &merge,
                        const Arguments &...arguments)
{
    Layout after = m_layout;
    return (after.*change)(arguments...) && push(after, text, merge);
}

QString LayoutEditor::titleOf(const QString &panelId) const
{
    const QString title = m_titles ? m_titles(panelId) : QString();
    if (!title.isEmpty())
        return title;
    const LayoutPanel *panel = m_layout.panel(panelId);
    return panel ? panel->title() : panelId;
}

QString LayoutEditor::quotedTab(const QString &tabId) const
{
    const LayoutTab *tab = m_layout.tab(tabId);
    return tab ? tab->name : tabId;
}

bool LayoutEditor::hasRoom()
{
    if (!m_layout.isFull())
        return true;
    Q_EMIT refused(tr("A layout has at most %1 panels: close some first.").arg(Layout::MostPanels));
    return false;
}

QString LayoutEditor::addPanel(const QString &type, const QJsonObject &settings, const LayoutTarget &target)
{
    if (!hasRoom())
        return {};
    Layout after = m_layout;
    const QString id = after.addPanel(type, settings, target);
    if (!id.isEmpty()) {
        auto *step = new Step(this, after, NoMerge, {});
        step->setNewPanel(id);
        m_stack.push(step);
    }
    return id;
}

QString LayoutEditor::duplicatePanel(const QString &panelId, LayoutSide side)
{
    if (!hasRoom())
        return {};
    Layout after = m_layout;
    const QString id = after.duplicatePanel(panelId, side);
    if (!id.isEmpty())
        push(after, tr("copy of '%1'").arg(titleOf(panelId)), {});
    return id;
}

bool LayoutEditor::closePanel(const QString &panelId)
{
    return edit(&Layout::closePanel, tr("close of '%1'").arg(titleOf(panelId)), {}, panelId);
}

bool LayoutEditor::movePanel(const QString &panelId, const LayoutTarget &target)
{
    return edit(&Layout::movePanel, tr("move of '%1'").arg(titleOf(panelId)), {}, panelId, target);
}

bool LayoutEditor::floatPanel(const QString &panelId, const QRect &geometry)
{
    return edit(&Layout::floatPanel, tr("float of '%1'").arg(titleOf(panelId)), {}, panelId, geometry);
}

bool LayoutEditor::dockPanel(const QString &panelId)
{
    return edit(&Layout::dockPanel, tr("dock of '%1'").arg(titleOf(panelId)), {}, panelId);
}

bool LayoutEditor::setMaximized(const QString &panelId, bool isMaximized)
{
    return edit(&Layout::setMaximized,
                (isMaximized ? tr("maximize of '%1'") : tr("restore of '%1'")).arg(titleOf(panelId)), {}, panelId,
                isMaximized);
}

bool LayoutEditor::setPanelSettings(const QString &panelId, const QJsonObject &settings)
{
    return edit(&Layout::setPanelSettings, tr("settings of '%1'").arg(titleOf(panelId)), {Settings, panelId}, panelId,
                settings);
}

bool LayoutEditor::setPanelTitle(const QString &panelId, const QString &title)
{
    return edit(&Layout::setPanelTitle, tr("rename of '%1'").arg(titleOf(panelId)), {}, panelId, title);
}

bool LayoutEditor::setShares(const LayoutSpan &split, const QVector<int> &shares)
{
    return edit(&Layout::setShares, tr("resize"), {Resizes, split.first + QLatin1Char('\n') + split.last}, split,
                shares);
}

bool LayoutEditor::growPanel(const QString &panelId, Qt::Orientation orientation, int change)
{
    return edit(
        &Layout::growPanel, tr("resize of '%1'").arg(titleOf(panelId)),
        {Resizes, panelId + (orientation == Qt::Horizontal ? QStringLiteral("\nwidth") : QStringLiteral("\nheight"))},
        panelId, orientation, change);
}

QString LayoutEditor::addTab(const QString &name)
{
    Layout after = m_layout;
    const QString id = after.addTab(name);
    push(after, tr("new tab '%1'").arg(after.tab(id)->name), {});
    return id;
}

bool LayoutEditor::closeTab(const QString &tabId)
{
    return edit(&Layout::closeTab, tr("close of tab '%1'").arg(quotedTab(tabId)), {}, tabId);
}

bool LayoutEditor::renameTab(const QString &tabId, const QString &name)
{
    return edit(&Layout::renameTab, tr("rename of tab '%1'").arg(quotedTab(tabId)), {}, tabId, name);
}

bool LayoutEditor::moveTab(const QString &tabId, int index)
{
    return edit(&Layout::moveTab, tr("move of tab '%1'").arg(quotedTab(tabId)), {TabMoves, tabId}, tabId, index);
}

bool LayoutEditor::closeWindow(const QString &windowId)
{
    const LayoutWindow *window = m_layout.window(windowId);
    const QString first = window ? titleOf(window->tree->span().first) : windowId;
    return edit(&Layout::closeWindow, tr("close of window '%1'").arg(first), {}, windowId);
}

void LayoutEditor::setCurrentTab(const QString &tabId)
{
    if (tabId == m_layout.currentTab().id || !m_layout.setCurrentTab(tabId))
        return;
    Q_EMIT layoutChanged();
}

void LayoutEditor::setWindowGeometry(const QString &windowId, const QRect &geometry)
{
    const LayoutWindow *window = m_layout.window(windowId);
    if (window && window->geometry != geometry && m_layout.setWindowGeometry(windowId, geometry))
        Q_EMIT layoutChanged();
}

}  // namespace qplc
