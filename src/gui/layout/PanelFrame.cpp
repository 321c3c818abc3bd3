// SPDX-License-Identifier: Apache-2.0
#include "PanelFrame.h"
#include "gui/SignalsMimeType.h"

#include "LayoutIcons.h"
#include "PanelPlaceholder.h"
#include "PanelTitleBar.h"
#include "QPlcWidget.h"
#include "QPlcWidgetFactory.h"
#include "gui/panel/PanelAction.h"
#include "gui/panel/SignalDropArea.h"

#include <QtGui/QContextMenuEvent>
#include <QtGui/QDragEnterEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QAction>
#include <QtWidgets/QApplication>
#include <QtWidgets/QFrame>
#include <QtWidgets/QMenu>
#include <QtWidgets/QToolTip>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace qplc {

namespace {

constexpr int lineWidth = 1;  // [px]

}  // namespace

PanelFrame::PanelFrame(LayoutEditor *editor, const LayoutPanel &panel, const QList<QPlcWidgetFactory *> &factories,
                       QWidget *parent)
    : QWidget(parent)
    , m_editor(editor)
    , m_id(panel.id)
    , m_type(panel.type)
    , m_factories(factories)
    , m_titleBar(new PanelTitleBar(this))
{
    setObjectName(panel.id);
    setAcceptDrops(true);
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(lineWidth, lineWidth, lineWidth, lineWidth);
    column->setSpacing(0);
    column->addWidget(m_titleBar);
    const auto factory = std::find_if(factories.begin(), factories.end(),
                                      [&](const QPlcWidgetFactory *each) { return each->name() == panel.type; });
    makeActions();
    makeContent(panel, factory != factories.end() ? *factory : nullptr);
    connectActions();
    connect(qApp, &QApplication::focusChanged, this,
            [this](QWidget *, QWidget *now) { m_titleBar->setActive(now && (now == this || isAncestorOf(now))); });
}

PanelFrame::~PanelFrame()
{
    // Parts go one after the other, and the keyboard from one to the next: the frame looks no more.
    disconnect(qApp, nullptr, this, nullptr);
    if (m_widget)
        disconnect(m_widget, nullptr, this, nullptr);
}

void PanelFrame::makeActions()
{
    const auto make = [this](const QString &text, const QKeySequence &keys, LayoutIcon icon) {
        auto *action = new QAction(layoutIcon(icon), text, this);
        action->setShortcut(keys);
        action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
        action->setToolTip(
            keys.isEmpty() ? text : QStringLiteral("%1 (%2)").arg(text, keys.toString(QKeySequence::NativeText)));
        addAction(action);
        return action;
    };
    m_settings = make(tr("Settings"), tr("Ctrl+,"), LayoutIcon::Settings);
    m_float = make(tr("Float"), tr("Ctrl+Shift+F"), LayoutIcon::Float);
    m_maximize = make(tr("Maximize"), tr("Ctrl+Shift+M"), LayoutIcon::Maximize);
    m_close = make(tr("Close"), tr("Ctrl+W"), LayoutIcon::Close);
    m_titleBar->addButton(m_settings);
    m_titleBar->addButton(m_float, PanelTitleBar::WhereThereIsRoom);
    m_titleBar->addButton(m_maximize, PanelTitleBar::WhereThereIsRoom);
    m_titleBar->addButton(m_close);
    m_rename = new QAction(tr("Rename"), this);
    m_rename->setShortcut(tr("F2"));
    m_rename->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    addAction(m_rename);
    // Many keyboards have no key for it.
    addPanelAction(this, tr("Menu of the panel"), {tr("Shift+F10")},
                   [this] { openMenu(m_titleBar->mapToGlobal(QPoint(0, m_titleBar->height()))); });
}

void PanelFrame::makeContent(const LayoutPanel &panel, const QPlcWidgetFactory *factory)
{
    m_widget = factory ? factory->createNew(this) : nullptr;
    layout()->addWidget(m_widget ? static_cast<QWidget *>(m_widget) : new PanelPlaceholder(panel.type, this));
    m_settings->setEnabled(m_widget);
    if (!m_widget)
        return;
    m_widget->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    m_initialSettings = m_widget->settings();
    offerMenuToWidget();
    connect(m_widget, &QPlcWidget::settingsEdited, this, &PanelFrame::takeSettings);
    connect(m_widget, &QPlcWidget::titleChanged, this, &PanelFrame::updateTitle);
}

void PanelFrame::connectActions()
{
    connect(m_settings, &QAction::triggered, this, &PanelFrame::openSettings);
    connect(m_float, &QAction::triggered, this, &PanelFrame::toggleFloating);
    connect(m_maximize, &QAction::triggered, this, &PanelFrame::toggleMaximized);
    connect(m_close, &QAction::triggered, this, [this] { m_editor->closePanel(m_id); });
    connect(m_rename, &QAction::triggered, m_titleBar, &PanelTitleBar::startRename);
    connect(m_titleBar, &PanelTitleBar::badgeClicked, this, [this] {
        QMenu *menu = m_makePlantMenu ? m_makePlantMenu(this) : nullptr;
        if (!menu)
            return;
        menu->setAttribute(Qt::WA_DeleteOnClose);
        menu->popup(m_titleBar->mapToGlobal(m_titleBar->badgeRect().bottomLeft()));
    });
    connect(m_titleBar, &PanelTitleBar::doubleClicked, this, &PanelFrame::toggleMaximized);
    connect(m_titleBar, &PanelTitleBar::renamed, this, [this](const QString &title) {
        const bool isDefault = title.isEmpty() || title == m_type || (m_widget && title == m_widget->defaultTitle());
        m_editor->setPanelTitle(m_id, isDefault ? QString() : title);
    });
}

void PanelFrame::showPanel(const LayoutPanel &panel, const Layout &layout)
{
    applySettings(panel);
    updateTitle();
    const bool isFloating = layout.isFloating(m_id);
    const bool isMaximized = layout.pageOf(m_id)->maximized == m_id;
    const auto say = [](QAction *action, const QString &text, LayoutIcon icon) {
        action->setText(text);
        action->setIcon(layoutIcon(icon));
        action->setToolTip(QStringLiteral("%1 (%2)").arg(text, action->shortcut().toString(QKeySequence::NativeText)));
    };
    say(m_float, isFloating ? tr("Dock back") : tr("Float"), isFloating ? LayoutIcon::Dock : LayoutIcon::Float);
    say(m_maximize, isMaximized ? tr("Restore") : tr("Maximize"),
        isMaximized ? LayoutIcon::Restore : LayoutIcon::Maximize);
    m_maximize->setEnabled(!layout.pageOf(m_id)->tree->isPanel());
}

void PanelFrame::applySettings(const LayoutPanel &panel)
{
    if (panel.settings == m_shownSettings)
        return;
    m_shownSettings = panel.settings;
    if (!m_widget)
        return;
    // A key that is missing has the value of a new widget.
    QJsonObject all = m_initialSettings;
    if (!all.contains(QStringLiteral("title")))
        all.insert(QStringLiteral("title"), QString());
    for (auto entry = panel.settings.begin(); entry != panel.settings.end(); ++entry)
        all.insert(entry.key(), entry.value());
    m_isApplying = true;
    m_widget->applySettings(all);
    m_isApplying = false;
}

void PanelFrame::takeSettings()
{
    if (m_isApplying)
        return;
    m_shownSettings = m_widget->settings();
    m_editor->setPanelSettings(m_id, m_shownSettings);
}

void PanelFrame::updateTitle()
{
    const QString title = m_editor->titleOf(m_id);
    m_titleBar->setTitle(title);
    setAccessibleName(title);
    for (QToolButton *button : m_titleBar->findChildren<QToolButton *>())
        button->setAccessibleName(tr("%1: %2").arg(title, button->defaultAction()->text()));
}

void PanelFrame::openSettings()
{
    QWidget *editor = m_widget ? m_widget->createSettingsEditor() : nullptr;
    const QPoint below = m_titleBar->mapToGlobal(QPoint(0, m_titleBar->height()));
    if (!editor) {
        QToolTip::showText(below, tr("'%1' has no settings").arg(m_titleBar->title()), this);
        return;
    }
    auto *popup = new QFrame(this, Qt::Popup);
    popup->setAttribute(Qt::WA_DeleteOnClose);
    popup->setFrameShape(QFrame::StyledPanel);
    popup->setAccessibleName(tr("Settings of %1").arg(m_titleBar->title()));
    auto *column = new QVBoxLayout(popup);
    column->addWidget(editor);
    popup->adjustSize();
    popup->move(below + QPoint(qMax(0, m_titleBar->width() - popup->width()), 0));
    popup->show();
    editor->setFocus(Qt::PopupFocusReason);
}

void PanelFrame::toggleFloating()
{
    if (m_editor->layout().isFloating(m_id)) {
        m_editor->dockPanel(m_id);
        return;
    }
    const QSize wanted = size().expandedTo({320, 220});
    m_editor->floatPanel(m_id, QRect(mapToGlobal(QPoint(32, 32)), wanted));
}

void PanelFrame::toggleMaximized()
{
    const LayoutPage *page = m_editor->layout().pageOf(m_id);
    if (page && !page->tree->isPanel())
        m_editor->setMaximized(m_id, page->maximized != m_id);
}

void PanelFrame::openMenu(const QPoint &place)
{
    QMenu *menu = createMenu();
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->popup(place);
}

void PanelFrame::contextMenuEvent(QContextMenuEvent *event)
{
    openMenu(event->globalPos());
}

void PanelFrame::mousePressEvent(QMouseEvent *event)
{
    // On a widget that takes no keys: those of the panel work from now on.
    m_titleBar->setFocus(Qt::MouseFocusReason);
    QWidget::mousePressEvent(event);
}

void PanelFrame::dragEnterEvent(QDragEnterEvent *event)
{
    if (event->mimeData()->hasFormat(signalsMimeType()))
        event->acceptProposedAction();
}

void PanelFrame::dragMoveEvent(QDragMoveEvent *event)
{
    if (!m_overlay)
        m_overlay = new DropOverlay;
    if (const SignalDropArea *area = dropAreaAt(event->pos())) {
        m_overlay->showOver(this, area->area().translated(m_widget->pos()), area->text());
    } else {
        const DropZone zone = dropZoneAt(rect(), event->pos(), DropCenter::IsAZone);
        m_overlay->showOver(this, dropZoneRect(rect(), zone));
    }
    event->acceptProposedAction();
}

void PanelFrame::dragLeaveEvent(QDragLeaveEvent *event)
{
    QWidget::dragLeaveEvent(event);
    if (m_overlay)
        m_overlay->hide();
}

void PanelFrame::dropEvent(QDropEvent *event)
{
    if (m_overlay)
        m_overlay->hide();
    event->acceptProposedAction();
    const DropZone zone
        = dropAreaAt(event->pos()) ? DropZone::Area : dropZoneAt(rect(), event->pos(), DropCenter::IsAZone);
    Q_EMIT signalsDropped(zone, event->mimeData());
}

/// The line is what the parts of the panel leave free. A line drawn with a pen would be cut by them
/// where it does not meet the pixels of the screen.
void PanelFrame::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    const QColor window = palette().color(QPalette::Window);
    painter.fillRect(rect(), window.lightness() < 128 ? window.lighter(160) : window.darker(140));
    if (m_widget)
        painter.fillRect(m_widget->geometry(), palette().color(QPalette::Base));  // a panel need not paint all of it
}

/// Null: there is none.
const SignalDropArea *PanelFrame::dropAreaAt(QPoint position) const
{
    const auto *area = m_widget ? m_widget->findChild<SignalDropArea *>() : nullptr;
    return area && area->area().contains(position - m_widget->pos()) ? area : nullptr;
}

}  // namespace qplc
