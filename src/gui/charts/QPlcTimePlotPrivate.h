// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChartPanel.h"
#include "EventFiles.h"
#include "PlotCanvas.h"
#include "PlotCurves.h"
#include "PlotInteraction.h"
#include "PlotLegend.h"
#include "PlotNotes.h"
#include "PlotOverlay.h"
#include "PlotSettings.h"
#include "PlotTime.h"
#include "QPlcTimePlot.h"
#include "RunBar.h"
#include "StatisticsView.h"
#include "TriggerBar.h"
#include "ValueRanges.h"
#include "gui/plot/RedrawRule.h"

#include <QtCore/QElapsedTimer>
#include <QtWidgets/QAction>

#include <vector>

class QMenu;
class QScrollArea;
class QToolButton;

namespace qplc {
class SignalEdit;
}

class QPlcTimePlot::Private : public QObject, public qplc::ChartPanel
{
    Q_OBJECT
public:
    using Time = QPlcTimeAxis::Time;
    using Axis = qplc::PlotCanvas::Axis;

    explicit Private(QPlcTimePlot *plot);

    // -- QPlcTimePlot.cpp: settings, and what is bound to what --
    void bind() override;
    /// Of the axes that are neither the first one at the left nor at the right.
    QStringList furtherUnits() const;
    void applySettings(const qplc::PlotSettings &settings);
    /// What a person has changed.
    void edit(const qplc::PlotSettings &settings);
    QStringList elementsOf(const QStringList &references) const;
    bool addCurves(const QStringList &signalNames);
    void removeCurve(int place);
    void toggleCurve(int place);
    void select(int place);
    /// Something else is seen.
    void change();

    // -- PlotDrawing.cpp: pictures and numbers --
    void draw() override;
    bool isPictureDue(const qplc::TimeColumns &columns);
    /// The event of the trigger that is seen, or was before somebody moved the view.
    std::optional<Time> shownEvent();
    void placeTrigger(qplc::PlotOverlay::Picture *picture);
    void pointAtMouse();
    QVector<qplc::PlotOverlay::Note> shownNotes() const;
    void showOverlay();
    QString hint() const;
    QString hintOfTime() const;
    void takeValues() override;
    void takePast() override
    {
        takeRuns();
        change();
    }
    void tick() override
    {
        takeRuns();
        if (notes.update(*context()))
            change();
        showNumbers();
    }
    void resized() override { arrange(); }
    void showNumbers();
    void showLiveButton();
    void arrange();
    void arrangeLegend();
    void showTheme(const QPlcTheme &theme) override;

    // -- PlotCommands.cpp: what a person can do, by mouse, keys and menu --
    void makeActions();
    void makeCurveActions();
    void makeViewActions();
    void makeSettingActions();
    void makeExportActions();
    void connectInteraction();
    QMenu *createMenu() override { return menuOf(curves.selected(), std::nullopt); }
    QMenu *menuOf(int curve, std::optional<QPoint> mouse);
    void openAddBar();
    void showAll();
    void showBox(const QRect &box);
    /// Of the chosen curve, or of the only one; null: none.
    const qplc::PlotCurve *chosenCurve() const;
    void showChecks();
    void addLine();
    void toggleBands();
    void toggleRightAxis();
    bool addToRightAxis(const QStringList &references);
    QRect rightAxisArea() const;
    /// Of the curves that are seen, at the moment when it is called.
    qplc::ChartExport::Table table(Time begin, Time end) const;
    qplc::ChartExport::Table shownTable() const;
    /// Without both cursors all that is seen.
    qplc::ChartExport::Table tableBetweenCursors() const;

    // -- PlotTriggering.cpp: the trigger and its files --
    void connectTrigger();
    void toggleTrigger();
    void showTrigger();
    void takeTrigger();

    // -- PlotComparing.cpp: runs that lie over each other --
    void connectRuns();
    void toggleRuns();
    /// Hides all curves of a run that lies over the others, or shows them again.
    void toggleRun(const QString &name);
    void showRuns();
    /// Finds the runs, and moves the view to them.
    void findRuns();
    void showRunState();
    void takeRuns();
    void showLaps();
    qplc::RunSettings usualRuns() const;

    QPlcTimePlot *q;
    qplc::PlotSettings settings;

    qplc::SignalEdit *addBar = nullptr;
    qplc::TriggerBar *triggerBar;
    qplc::RunBar *runBar;
    qplc::PlotCanvas *canvas;
    qplc::PlotOverlay *overlay;
    qplc::PlotInteraction *interaction;
    QToolButton *liveButton;
    QScrollArea *legendArea;
    qplc::PlotLegend *legend;
    qplc::StatisticsView *statistics;
    qplc::EventFiles *eventFiles;
    qplc::PlotRuns runs;
    qplc::PlotNotes notes;
    qplc::PlotCurves curves;
    qplc::ValueRanges ranges;
    qplc::PlotTime time;

    std::vector<qplc::RedrawRule> redraw;  // for each store
    quint64 version = 0;                   // of all but data and time that is seen
    int drawnPictures = 0;
    Time reference = 0;                    // 0 of labels in seconds: the live edge
    std::optional<Time> drawnEvent;        // of the trigger
    std::optional<Time> numberedPlayhead;  // whose numbers are shown
    QElapsedTimer sinceMoved;
    QJsonObject shownTrigger;  // settings that its bar has
    QRect box;
    QAction *removeAction = nullptr;
    QAction *toggleAction = nullptr;
    QAction *statisticsAction = nullptr;
    QAction *bandsAction = nullptr;
    QAction *limitsAction = nullptr;
    QAction *rightAxisAction = nullptr;
    QAction *triggerAction = nullptr;
    QAction *runsAction = nullptr;
    QPlcPast::Row furtherRows = 0;  // of runs, when they were drawn
    std::optional<Time> shownZero;  // of runs
    Time shownLength = 0;           // of the view of runs
};
