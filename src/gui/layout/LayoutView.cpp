// SPDX-License-Identifier: Apache-2.0
#include "LayoutView.h"

#include "EmptyPage.h"
#include "FloatingWindow.h"
#include "LayoutIcons.h"
#include "LayoutTabBar.h"
#include "PageView.h"
#include "PanelDrag.h"
#include "PanelFrame.h"
#include "PanelPlace.h"
#include "PanelTitleBar.h"
#include "QPlcWidget.h"
#include "QPlcWidgetFactory.h"
#include "TabDrop.h"
#include "gui/panel/PanelAction.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QStackedWidget>
#include <QtWidgets/QToolButton>

#include <algorithm>
#include <memory>

namespace qplc {

LayoutView::LayoutView(LayoutEditor *editor, QWidget *parent)
    : QWidget(parent)
    , m_editor(editor)
    , m_tabBar(new LayoutTabBar(editor, this))
    , m_add(new QToolButton(this))
    , m_stack(new QStackedWidget(this))
    , m_drag(new PanelDrag(this))
{
    qRegisterMetaType<DropZone>("qplc::DropZone");
    m_add->setObjectName(QStringLiteral("addPanel"));
    m_add->setIcon(layoutIcon(LayoutIcon::Add));
    m_add->setAutoRaise(true);
    m_add->setText(tr("Add a panel or a tab"));
    m_add->setToolTip(m_add->text());
    m_add->setAccessibleName(m_add->text());
    m_add->setFocusPolicy(Qt::TabFocus);
    connect(m_add, &QToolButton::clicked, this, &LayoutView::addRequested);
    connect(new TabDrop(m_tabBar, m_add, editor), &TabDrop::signalsDropped, this,
            [this](DropZone zone, const QMimeData *dropped) { Q_EMIT signalsDropped({}, zone, dropped); });
    auto *bar = new QHBoxLayout;
    bar->setSpacing(2);
    bar->addWidget(m_tabBar);
    bar->addWidget(m_add);
    bar->addStretch();
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(2);
    column->addLayout(bar);
    column->addWidget(m_stack, 1);
    makeActions();
    editor->setTitles([this](const QString &id) { return widget(id) ? widget(id)->title() : QString(); });
    connect(editor, &LayoutEditor::layoutChanged, this, &LayoutView::follow);
    follow();
}

LayoutView::~LayoutView()
{
    // Nothing that happens while windows go is an edit.
    disconnect(m_editor, nullptr, this, nullptr);
    m_editor->setTitles({});
    qDeleteAll(m_windows);
}

void LayoutView::makeActions()
{
    const auto add = [this](const QString &text, const QString &keys, const std::function<void()> &act) {
        addPanelAction(this, text, QKeySequence::listFromString(keys), act);
    };
    add(tr("Next panel"), tr("F6"), [this] { focusPanel(1); });
    add(tr("Previous panel"), tr("Shift+F6"), [this] { focusPanel(-1); });
    add(tr("Next tab"), tr("Ctrl+PgDown; Ctrl+Tab"),
        [this] { m_tabBar->setCurrentIndex((m_tabBar->currentIndex() + 1) % m_tabBar->count()); });
    add(tr("Previous tab"), tr("Ctrl+PgUp; Ctrl+Shift+Tab"),
        [this] { m_tabBar->setCurrentIndex((m_tabBar->currentIndex() + m_tabBar->count() - 1) % m_tabBar->count()); });
    add(tr("New tab"), tr("Ctrl+T"), [this] { m_editor->addTab(); });
}

void LayoutView::setFactories(const QList<QPlcWidgetFactory *> &factories)
{
    m_factories = factories;
    // All menus and placeholders get to know them; widgets stay.
    QHash<QString, PanelFrame *> gone;
    for (PanelFrame *frame : qAsConst(m_frames)) {
        frame->setFactories(factories);
        const bool isKnown = std::any_of(factories.begin(), factories.end(),
                                         [&](const QPlcWidgetFactory *each) { return each->name() == frame->type(); });
        if (!frame->widget() && isKnown)
            gone.insert(frame->panelId(), frame);
    }
    for (const QString &id : gone.keys())
        m_frames.remove(id);
    makeFrames();
    followPages();
    dropFrames(gone);
    follow();
}

QPlcWidget *LayoutView::widget(const QString &panelId) const
{
    const PanelFrame *found = frame(panelId);
    return found ? found->widget() : nullptr;
}

void LayoutView::follow()
{
    const Layout layout = m_editor->layout();
    QHash<QString, PanelFrame *> gone;
    for (PanelFrame *frame : qAsConst(m_frames)) {
        const LayoutPanel *panel = layout.panel(frame->panelId());
        if (!panel || panel->type != frame->type())
            gone.insert(frame->panelId(), frame);
    }
    for (const QString &id : gone.keys())
        m_frames.remove(id);
    makeFrames();
    followPages();
    dropFrames(gone);
    for (PageView *page : qAsConst(m_pages))
        page->dropOldSplitters();
    for (const QString &id : m_pages.keys()) {
        if (layout.tab(id) || layout.window(id))
            continue;
        if (FloatingWindow *window = m_windows.take(id)) {
            window->hide();
            window->deleteLater();
            m_pages.remove(id);
        } else {
            delete m_pages.take(id);
        }
    }
}

void LayoutView::makeFrames()
{
    for (const LayoutPanel *panel : m_editor->layout().panels()) {
        if (!m_frames.contains(panel->id))
            makeFrame(*panel);
    }
}

void LayoutView::makeFrame(const LayoutPanel &panel)
{
    auto *frame = new PanelFrame(m_editor, panel, m_factories, this);
    m_frames.insert(panel.id, frame);
    const QString id = panel.id;
    connect(frame, &PanelFrame::signalsDropped, this,
            [this, id](DropZone zone, const QMimeData *dropped) { Q_EMIT signalsDropped(id, zone, dropped); });
    connect(frame->titleBar(), &PanelTitleBar::dragMoved, m_drag,
            [this, id](const QPoint &at) { m_drag->move(id, at); });
    connect(frame->titleBar(), &PanelTitleBar::dragFinished, m_drag,
            [this, id](const QPoint &at) { m_drag->finish(id, at); });
    connect(frame->titleBar(), &PanelTitleBar::dragCancelled, m_drag, &PanelDrag::cancel);
    if (!frame->widget())
        return;
    connect(frame->widget(), &QPlcWidget::titleChanged, this, [this] {
        for (FloatingWindow *window : qAsConst(m_windows))
            window->followTitles();
    });
    Q_EMIT widgetAdded(id, frame->widget());
}

PageView *LayoutView::newPage()
{
    auto *page = new PageView;
    m_stack->addWidget(page);
    connect(page->emptyPage(), &EmptyPage::signalsDropped, this,
            [this](const QMimeData *dropped) { Q_EMIT signalsDropped(QString(), DropZone::Center, dropped); });
    connect(page->emptyPage()->addButton(), &QPushButton::clicked, this, &LayoutView::addRequested);
    return page;
}

void LayoutView::followPages()
{
    const Layout layout = m_editor->layout();
    const auto frameOf = [this](const QString &id) { return m_frames.value(id); };
    const auto show = [&](const LayoutPage &page) {
        PageView *view = m_pages.value(page.id);
        connect(view, &PageView::sharesEdited, m_editor, &LayoutEditor::setShares, Qt::UniqueConnection);
        view->showPage(page, frameOf);
    };
    for (const LayoutTab &tab : layout.tabs()) {
        if (!m_pages.contains(tab.id))
            m_pages.insert(tab.id, newPage());
        show(tab);
    }
    for (const LayoutWindow &window : layout.windows()) {
        if (!m_windows.contains(window.id)) {
            m_windows.insert(window.id, new FloatingWindow(m_editor, window.id, this));
            m_pages.insert(window.id, m_windows.value(window.id)->page());
        }
        show(window);
        m_windows.value(window.id)->showWindow(window);
    }
    m_tabBar->showTabs(layout);
    m_stack->setCurrentWidget(m_pages.value(layout.currentTab().id));
    for (const LayoutPanel *panel : layout.panels())
        m_frames.value(panel->id)->showPanel(*panel, layout);
}

void LayoutView::dropFrames(QHash<QString, PanelFrame *> gone)
{
    for (PanelFrame *frame : gone) {
        frame->hide();
        frame->setParent(this);  // out of the splitter that goes
        frame->deleteLater();
        if (frame->widget())
            Q_EMIT widgetRemoved(frame->panelId(), frame->widget());
    }
}

/// The size that a panel of a type wants, with its frame, as its widget says.
QSize LayoutView::wantedSize(const QString &type)
{
    constexpr QSize smallest(160, 100);
    constexpr QSize usual(400, 240);  // of a widget that does not say what it wants, as plots do not
    constexpr QSize frame(2, 26);
    if (!m_wantedSizes.contains(type)) {
        const auto factory = std::find_if(m_factories.cbegin(), m_factories.cend(),
                                          [&](const QPlcWidgetFactory *each) { return each->name() == type; });
        const std::unique_ptr<QPlcWidget> sample(factory != m_factories.cend() ? (*factory)->createNew() : nullptr);
        if (!sample)
            return usual;
        const QSize hint = sample->sizeHint();
        const bool saysIt = hint.width() >= smallest.width() / 2 && hint.height() >= smallest.height() / 2;
        m_wantedSizes.insert(type, (saysIt ? hint.expandedTo(smallest) : usual) + frame);
    }
    return m_wantedSizes.value(type);
}

PageView *LayoutView::currentPage() const
{
    return m_pages.value(m_editor->layout().currentTab().id);
}

QString LayoutView::addPanel(const QString &type, const QJsonObject &settings)
{
    const LayoutTab &tab = m_editor->layout().currentTab();
    const LayoutTarget target = tab.tree
        ? fittingPlace(*tab.tree, m_stack->size(), wantedSize(type),
                       [this](const LayoutPanel &panel) { return wantedSize(panel.type); })
        : LayoutTarget::inTab(tab.id);
    return m_editor->addPanel(type, settings, target);
}

void LayoutView::focusPanel(int step)
{
    std::vector<const LayoutPanel *> panels;
    if (const LayoutTab &tab = m_editor->layout().currentTab(); tab.tree)
        tab.tree->appendPanels(&panels);
    if (panels.empty())
        return;
    const int count = int(panels.size());
    const auto holdsFocus = [this](const LayoutPanel *panel) {
        const QWidget *now = focusWidget();
        return now && frame(panel->id)->isAncestorOf(now);
    };
    const auto present = std::find_if(panels.begin(), panels.end(), holdsFocus);
    const int from = present != panels.end() ? int(present - panels.begin()) : (step > 0 ? -1 : count);
    for (int i = 1; i <= count; ++i) {
        PanelFrame *next = frame(panels[std::size_t((from + i * step + 2 * count) % count)]->id);
        if (next->isVisible())
            return next->titleBar()->setFocus(Qt::TabFocusReason);
    }
}

}  // namespace qplc
