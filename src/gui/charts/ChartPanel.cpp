// SPDX-License-Identifier: Apache-2.0
#include "ChartPanel.h"

#include "QPlcWidget.h"
#include "gui/panel/DrawNow.h"
#include "gui/panel/Filming.h"
#include "gui/panel/PanelAction.h"

#include <QtCore/QCoreApplication>
#include <QtGui/QContextMenuEvent>
#include <QtGui/QKeyEvent>
#include <QtWidgets/QAction>
#include <QtWidgets/QMenu>

#include <algorithm>

namespace qplc {

/// What happens to the widget of a chart.
class ChartPanel::Events : public QObject
{
public:
    explicit Events(ChartPanel *chart)
        : m_chart(chart)
    {
    }
    bool eventFilter(QObject * /*watched*/, QEvent *event) override
    {
        switch (int(event->type())) {
        case QEvent::Show:
            m_chart->m_ticks.start();
            m_chart->tick();
            m_chart->schedule();
            return false;
        case QEvent::Hide:
            m_chart->m_ticks.stop();
            m_chart->m_timer.stop();
            return false;
        case QEvent::Resize:
            m_chart->resized();
            return false;
        case DrawNow::Kind:
            m_chart->tick();
            m_chart->drawNow();
            return false;
        case Filming::Kind:
            m_chart->m_isFilmed = static_cast<Filming *>(event)->moment() == Filming::Begins;
            m_chart->schedule();
            return false;
        case QEvent::KeyPress:
            return static_cast<QKeyEvent *>(event)->key() == Qt::Key_Escape && m_chart->m_exporter->dismiss();
        case QEvent::ContextMenu:
            return openMenu(static_cast<QContextMenuEvent *>(event));
        case QEvent::PaletteChange:
        case QEvent::FontChange:
            if (m_chart->context()->theme().surface != m_chart->m_surface
                || m_chart->m_panel->font() != m_chart->m_font)
                m_chart->showLook();
            return false;
        default:
            return false;
        }
    }

private:
    bool openMenu(QContextMenuEvent *event)
    {
        QMenu *menu = m_chart->createMenu();
        if (menu)
            menu->popup(event->globalPos());
        event->setAccepted(menu);
        return menu;
    }

    ChartPanel *m_chart;
};

ChartPanel::ChartPanel(QPlcWidget *panel, const ChartExport::Picture &picture)
    : m_panel(panel)
    , m_events(std::make_unique<Events>(this))
    , m_exporter(new ChartExport(panel, picture))
{
    panel->setFocusPolicy(Qt::StrongFocus);
    panel->setAutoFillBackground(true);
    panel->installEventFilter(m_events.get());
    m_timer.setSingleShot(true);
    m_timer.setTimerType(Qt::PreciseTimer);  // others come up to 5 % early
    QObject *own = receiver();
    QObject::connect(&m_timer, &QTimer::timeout, own, [this] { drawNow(); });
    QObject::connect(&m_ticks, &QTimer::timeout, own, [this] { tick(); });
    QObject::connect(context(), &QPlcPanelContext::valuesChanged, own, [this] { takeValues(); });
    QObject::connect(context(), &QPlcPanelContext::pastChanged, own, [this] { takePast(); });
    QObject::connect(context(), &QPlcPanelContext::timeChanged, own, [this] { takeTime(); });
    QObject::connect(context(), &QPlcPanelContext::themeChanged, own, [this] { showLook(); });
    QObject::connect(context(), &QPlcPanelContext::signalsChanged, own, [this] {
        m_exporter->cancel(ChartExport::tr("The signals have changed while they were exported. Export them again."));
        bind();
    });
}

ChartPanel::~ChartPanel() = default;

QObject *ChartPanel::receiver() const
{
    return m_events.get();
}

QPlcPanelContext *ChartPanel::context() const
{
    return m_panel->context();
}

void ChartPanel::schedule()
{
    if (!m_panel->isVisible() || m_timer.isActive())
        return;
    const qint64 passed = m_sinceDrawing.isValid() ? m_sinceDrawing.elapsed() : m_pause;
    m_timer.start(int(std::max<qint64>(0, m_pause - passed)));
}

void ChartPanel::drawNow()
{
    if (!m_panel->isVisible())
        return;
    m_sinceDrawing.restart();
    draw();
}

void ChartPanel::showLook()
{
    const QPlcTheme theme = context()->theme();
    m_surface = theme.surface;
    m_font = m_panel->font();
    QPalette palette = theme.palette();
    palette.setColor(QPalette::Window, theme.surface);
    if (m_hasQuietTexts)
        palette.setColor(QPalette::WindowText, theme.mutedText);
    m_panel->setPalette(palette);
    m_exporter->setTheme(theme);
    showTheme(theme);
    bind();
}

QAction *ChartPanel::addAction(const QString &text, const QList<QKeySequence> &keys, const char *name,
                               const std::function<void()> &act) const
{
    return addPanelAction(m_panel, text, keys, act, name);
}

QMenu *ChartPanel::makeMenu(std::initializer_list<std::initializer_list<const char *>> groups) const
{
    auto *menu = new QMenu(m_panel);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    for (const std::initializer_list<const char *> group : groups) {
        addTo(menu, group);
        menu->addSeparator();
    }
    return menu;
}

void ChartPanel::addTo(QMenu *menu, std::initializer_list<const char *> names) const
{
    for (const char *name : names) {
        if (auto *action = m_panel->findChild<QAction *>(QLatin1String(name), Qt::FindDirectChildrenOnly))
            menu->addAction(action);
    }
}

}  // namespace qplc
