// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChartPanel.h"
#include "EventFiles.h"
#include "PlotCanvas.h"
#include "PlotCurves.h"
#include "PlotInteraction.h"
#include "PlotLegend.h"
#include "PlotOverlay.h"
#include "PlotSettings.h"
#include "QPlcTimeAxis.h"
#include "QPlcTimePlot.h"
#include "StatisticsView.h"
#include "StickyRange.h"
#include "TriggerBar.h"
#include "gui/plot/RedrawRule.h"

#include <QtCore/QElapsedTimer>
#include <QtWidgets/QAction>

#include <functional>
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
    void keepRanges();
    /// Of the axes that are neither the first one at the left nor at the right.
    QStringList furtherUnits() const;
    void applySettings(const qplc::PlotSettings &settings);
    /// What a person has changed.
    void edit(const qplc::PlotSettings &settings);
    QStringList elementsOf(const QString &name) const;
    bool addCurves(const QStringList &signalNames);
    void removeCurve(int place);
    void toggleCurve(int place);
    void select(int place);

    // -- PlotDrawing.cpp: pictures and numbers --
    QPlcTimeAxis *shared() const { return context()->timeAxis(); }
    /// The time axis: that of the window, or the own one, which a plot with a trigger also has.
    QPlcTimeAxis *view()
    {
        const bool hasOwn = settings.hasTrigger() ? !triggerBar->isLinked() : settings.hasOwnTime;
        return hasOwn ? &ownTime : shared();
    }
    /// Where it ends when it is live: with the newest values of the plants that it shows, as each
    /// has a clock of its own.
    Time newest();
    void draw() override;
    qplc::TimeColumns columns();
    bool isPictureDue(const qplc::TimeColumns &columns);
    /// The event of the trigger that is seen, or was before somebody moved the view.
    std::optional<Time> shownEvent();
    void placeTrigger(qplc::PlotOverlay::Picture *picture);
    void pointAtMouse();
    bool fitRange(Axis axis);
    void showRange(Axis axis);
    void showOverlay();
    QString hint() const;
    QString hintOfTime() const;
    void takeValues() override;
    void takePast() override;
    void tick() override { showNumbers(); }
    void resized() override { arrange(); }
    void showNumbers();
    void showLiveButton();
    void arrange();
    void arrangeLegend();
    void showTheme(const QPlcTheme &theme) override;

    // -- PlotCommands.cpp: what a person can do --
    void makeActions();
    void connectInteraction();
    QMenu *createMenu() override { return menuOf(curves.selected(), std::nullopt); }
    QMenu *menuOf(int curve, std::optional<QPoint> mouse);
    void openAddBar();
    void showAll();
    void freezeHere();
    void panTime(Time by);
    void zoomTime(double factor);
    void zoomTime(double factor, Time about);
    void zoomValues(Axis axis, double factor, double about);
    void panValues(Axis axis, double by);
    std::pair<double, double> valuesOf(Axis axis) const;
    void showBox(const QRect &box);
    void placeCursor(QPlcTimeAxis::Cursor which, std::optional<Time> time = std::nullopt);
    Time nearestRow(Time time) const;
    void removeCursors();
    void moveCursor(int pixels);
    bool hasLines() const;
    void addLine();
    void removeLines();
    void toggleLive();
    void toggleBands();
    /// Of the chosen curve, or of the only one; null: none.
    const qplc::PlotCurve *chosenCurve() const;
    void showChecks();
    void toggleLimits();
    void toggleRightAxis();
    bool addToRightAxis(const QStringList &references);
    QRect rightAxisArea() const;
    void toggleTrigger();
    void showTrigger();
    void takeTrigger();
    void makeExportActions();
    void connectEventFiles();
    /// Of the curves that are seen, at the moment when it is called.
    qplc::ChartExport::Table table(Time begin, Time end) const;
    qplc::ChartExport::Table shownTable() const;
    /// Without both cursors all that is seen.
    qplc::ChartExport::Table tableBetweenCursors() const;
    bool hasBothCursors() const;

    /// A y axis: by settings, by what is seen, or as a person has zoomed it.
    struct ValueAxis
    {
        qplc::PlotAxes::Axis of{qplc::PlotCurveSettings::Left, {}};
        qplc::StickyRange automatic;
        bool isHeld = false;
        double minimum = 0.0;  // when held
        double maximum = 1.0;
    };

    QPlcTimePlot *q;
    qplc::PlotSettings settings;
    QPlcTimeAxis ownTime;
    QPlcTimeAxis::Cursor lastCursor = QPlcTimeAxis::A;

    qplc::SignalEdit *addBar = nullptr;
    qplc::TriggerBar *triggerBar;
    qplc::PlotCanvas *canvas;
    qplc::PlotOverlay *overlay;
    qplc::PlotInteraction *interaction;
    QToolButton *liveButton;
    QScrollArea *legendArea;
    qplc::PlotLegend *legend;
    qplc::StatisticsView *statistics;
    qplc::EventFiles *eventFiles;
    qplc::PlotCurves curves;

    std::vector<ValueAxis> axes;
    std::vector<qplc::RedrawRule> redraw;  // for each store
    quint64 version = 0;                   // of all but data and time that is seen
    int drawnPictures = 0;
    Time reference = 0;              // 0 of labels in seconds: the live edge
    std::optional<Time> drawnEvent;  // of the trigger
    QJsonObject shownTrigger;        // settings that its bar has
    QRect box;
    QElapsedTimer clock;
    QAction *addAction = nullptr;
    QAction *removeAction = nullptr;
    QAction *toggleAction = nullptr;
    QAction *statisticsAction = nullptr;
    QAction *bandsAction = nullptr;
    QAction *limitsAction = nullptr;
    QAction *rightAxisAction = nullptr;
    QAction *triggerAction = nullptr;
};
