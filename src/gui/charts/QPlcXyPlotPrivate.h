// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChartPanel.h"
#include "QPlcXyPlot.h"
#include "XyCanvas.h"
#include "XyInteraction.h"
#include "gui/panel/PanelSettings.h"

#include <QtCore/QJsonArray>
#include <QtWidgets/QAction>

#include <functional>

class QLabel;
class QMenu;

class QPlcXyPlot::Private : public qplc::ChartPanel
{
public:
    static constexpr int shortestPause = 40;  // [ms] between pictures

    explicit Private(QPlcXyPlot *plot);

    // -- QPlcXyPlot.cpp: settings, and what is seen --
    QJsonArray curves() const;
    void bind() override;
    void draw() override;
    void edit(const QJsonArray &curves);
    void showAspect();
    void showMessage();
    void showLegend();
    void showMoment();
    void showTheme(const QPlcTheme &theme) override;
    QString messageText() const;
    QString timeText() const;
    /// Of the first curve whose newest values are no longer true; null: all are.
    const QPlcPast *stale() const;
    QPlcPast::Time seenEnd() const;

    // -- XyPlotCommands.cpp: what a person can do --
    void makeActions();
    void connectInteraction();
    QMenu *createMenu() override;
    void zoom(double factor);
    QString pointerText() const;
    qplc::ChartExport::Table table() const;

    QPlcXyPlot *q;
    qplc::XyCanvas *canvas;
    QLabel *message;  // what is missing
    QLabel *legend;
    QLabel *moment;  // when the dot was
    qplc::XyInteraction *interaction;
    QAction *equal = nullptr;
    qplc::PanelSettings settings{"curves", "equalAspect"};
    QString error;  // of the first curve that cannot be drawn
};
