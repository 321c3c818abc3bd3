// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChartExport.h"
#include "QPlcXyPlot.h"
#include "XyCanvas.h"
#include "XyInteraction.h"
#include "gui/panel/PanelSettings.h"
#include "gui/panel/WindowContext.h"

#include <QtCore/QJsonArray>
#include <QtCore/QTimer>
#include <QtWidgets/QAction>

#include <functional>

class QLabel;
class QMenu;

class QPlcXyPlot::Private
{
public:
    static constexpr int shortestPause = 40;  // [ms] between pictures

    explicit Private(QPlcXyPlot *plot);

    // -- QPlcXyPlot.cpp: settings, and what is seen --
    QJsonArray curves() const;
    void bind();
    void follow(qplc::WindowContext *context);
    void schedule();
    void draw();
    void edit(const QJsonArray &curves);
    void showAspect();
    void showMessage();
    void showLegend();
    void showMoment();
    void applyTheme();
    QString messageText(const QString &error) const;
    QString timeText() const;
    const qplc::Plant *stalePlant() const;
    qplc::SignalStore::Time seenEnd() const;

    // -- XyPlotCommands.cpp: what a person can do --
    void makeActions();
    void connectInteraction();
    QMenu *createMenu();
    void zoom(double factor);
    QString pointerText() const;
    qplc::ChartExport::Table table() const;

    QPlcXyPlot *q;
    qplc::XyCanvas *canvas;
    QLabel *message;  // what is missing
    QLabel *legend;
    QLabel *moment;  // when the dot was
    qplc::XyInteraction *interaction;
    qplc::ChartExport *exporter;
    QAction *equal = nullptr;
    qplc::PanelSettings settings{"curves", "equalAspect"};
    QString error;  // of the first curve that cannot be drawn
    QTimer redraw;
    QTimer age;
    int pause = shortestPause;
};
