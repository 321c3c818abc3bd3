// SPDX-License-Identifier: Apache-2.0
#include "SignalPlacer.h"

#include "gui/layout/PanelFrame.h"
#include "gui/layout/PanelTitleBar.h"
#include "gui/models/ValueFormat.h"
#include "gui/panel/SignalDropArea.h"

#include <QtCore/QJsonArray>
#include <QtWidgets/QApplication>

namespace qplc {

namespace {

const QString timePlot = QStringLiteral("Time plot");
const QString gauge = QStringLiteral("Gauge");
const QString setter = QStringLiteral("Setter");
const QString xyPlot = QStringLiteral("XY plot");

LayoutSide sideOf(DropZone zone)
{
    switch (zone) {
    case DropZone::Left:
        return LayoutSide::Left;
    case DropZone::Above:
        return LayoutSide::Above;
    case DropZone::Below:
        return LayoutSide::Below;
    case DropZone::Right:
    case DropZone::Center:
    case DropZone::NewTab:
    case DropZone::Area:
        break;
    }
    return LayoutSide::Right;
}

}  // namespace

SignalPlacer::SignalPlacer(LayoutView *view)
    : m_view(view)
{
    connect(view, &LayoutView::signalsDropped, this,
            [this](const QString &panelId, DropZone zone, const QMimeData *data) {
                QStringList references;
                for (const SignalReference &reference : referencesIn(data))
                    references.append(reference.toString());
                drop(panelId, zone, references);
            });
}

QJsonObject SignalPlacer::settingsFor(const QString &type, const QStringList &references)
{
    if (type == gauge || type == setter)
        return {{QStringLiteral("signal"), references.value(0)}};
    if (type == timePlot) {
        QJsonArray curves;
        for (const QString &reference : references)
            curves.append(QJsonObject{{QStringLiteral("signal"), reference}});
        return {{QStringLiteral("curves"), curves}};
    }
    if (type == xyPlot) {  // the first over time is the x of the second, and so on
        QJsonArray curves;
        for (int i = 0; i < references.size(); i += 2)
            curves.append(
                QJsonObject{{QStringLiteral("x"), references.at(i)}, {QStringLiteral("y"), references.value(i + 1)}});
        return {{QStringLiteral("curves"), curves}};
    }
    return {{QStringLiteral("signals"), QJsonArray::fromStringList(references)}};
}

bool SignalPlacer::addTo(const QString &panelId, const QStringList &references, DropZone zone)
{
    QPlcWidget *widget = m_view->widget(panelId);
    const auto *area = widget && zone == DropZone::Area ? widget->findChild<SignalDropArea *>() : nullptr;
    if (!widget)
        return false;
    LayoutEditor *editor = m_view->editor();
    editor->separateSteps();
    if (!(area ? area->add(references) : widget->addSignals(references)))
        return false;
    editor->setPanelSettings(panelId, widget->settings());  // of panels that did not tell by settingsEdited()
    editor->separateSteps();
    return true;
}

void SignalPlacer::drop(const QString &panelId, DropZone zone, const QStringList &references)
{
    if (references.isEmpty()
        || ((zone == DropZone::Center || zone == DropZone::Area) && addTo(panelId, references, zone)))
        return;
    LayoutEditor *editor = m_view->editor();
    if (zone == DropZone::NewTab)
        editor->addPanel(timePlot, settingsFor(timePlot, references), LayoutTarget::inNewTab());
    else if (panelId.isEmpty())
        m_view->addPanel(timePlot, settingsFor(timePlot, references));
    else
        editor->addPanel(timePlot, settingsFor(timePlot, references), LayoutTarget::beside(panelId, sideOf(zone)));
}

/// In the current tab: the one with the focus, else the first one; empty: there is none.
QString SignalPlacer::panelOfType(const QString &type) const
{
    const LayoutTab &tab = m_view->editor()->layout().currentTab();
    std::vector<const LayoutPanel *> panels;
    if (tab.tree)
        tab.tree->appendPanels(&panels);
    QString first;
    for (const LayoutPanel *panel : panels) {
        if (panel->type != type)
            continue;
        const QWidget *focused = QApplication::focusWidget();
        if (focused && m_view->frame(panel->id)->isAncestorOf(focused))
            return panel->id;
        if (first.isEmpty())
            first = panel->id;
    }
    return first;
}

void SignalPlacer::show(const QStringList &references, const QString &type)
{
    if (type == gauge || type == setter) {
        for (const QString &reference : references) {
            if (m_view->addPanel(type, settingsFor(type, {reference})).isEmpty())
                return;
        }
        return;
    }
    const QString panel = panelOfType(type);
    if (panel.isEmpty() || !addTo(panel, references))
        m_view->addPanel(type, settingsFor(type, references));
}

void SignalPlacer::showPanel(const QString &type)
{
    LayoutEditor *editor = m_view->editor();
    QString id;
    for (const LayoutPanel *panel : editor->layout().panels()) {
        if (panel->type == type && id.isEmpty())
            id = panel->id;
    }
    if (id.isEmpty())
        id = m_view->addPanel(type);
    else if (const LayoutPage *page = editor->layout().pageOf(id); editor->layout().tab(page->id))
        editor->setCurrentTab(page->id);
    if (PanelFrame *frame = m_view->frame(id))  // none: the layout is full
        frame->titleBar()->setFocus(Qt::OtherFocusReason);
}

}  // namespace qplc
