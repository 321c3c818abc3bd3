// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "QPlcTimePlot.h"
#include "gui/charts/PlotCanvas.h"
#include "gui/charts/PlotLegend.h"
#include "gui/charts/PlotOverlay.h"
#include "gui/charts/StatisticsView.h"
#include "gui/panel/WindowContext.h"

#include <QtCore/QJsonDocument>
#include <QtWidgets/QAction>

#include <cstdlib>
#include <memory>

/// A window with a time plot and a running plant, whose signals are those of testTable().
class PlotWindow
{
public:
    explicit PlotWindow(const QByteArray &settings = QByteArrayLiteral("{}"))
        : plot(new QPlcTimePlot)
    {
        plot->resize(640, 360);
        plot->setContext(&context);
        apply(settings);
    }
    ~PlotWindow() { delete plot; }

    void apply(const QByteArray &settings) { plot->applySettings(QJsonDocument::fromJson(settings).object()); }
    /// Shows the window, and waits until the plant has brought so many seconds.
    bool run(double seconds)
    {
        if (!master.startRealTime())
            return false;
        context.plants()->add(master.address(), QStringLiteral("kite"));
        plot->show();
        return QTest::qWaitForWindowExposed(plot) && waitUntil([&] { return past() >= seconds; }, 15'000);
    }
    /// Seconds of values.
    double past()
    {
        const qplc::SignalStore *store = context.plants()->at(0)->store();
        if (!store || store->isEmpty())
            return 0.0;
        return double(store->time(store->endRow() - 1) - store->time(store->firstRow())) * 1e-9;
    }
    /// Freezes the view, and waits until the plot has it: a busy machine draws later.
    bool show(QPlcTimeAxis::Time begin, QPlcTimeAxis::Time end)
    {
        time()->show(begin, end);
        return isDrawn();
    }
    /// Waits until the plot shows the frozen view, but for a column of pixels.
    bool isDrawn()
    {
        return waitUntil([this] {
            const auto column = time()->span() / canvas()->deviceWidth() + 1;
            return std::abs(canvas()->begin() - time()->begin()) <= column
                && std::abs(canvas()->end() - time()->end()) <= column;
        });
    }
    QPlcTimeAxis *time() { return context.timeAxis(); }
    template<typename Part>
    Part *part() const
    {
        return plot->findChild<Part *>();
    }
    qplc::PlotCanvas *canvas() const { return part<qplc::PlotCanvas>(); }
    void trigger(const char *action) const { plot->findChild<QAction *>(QLatin1String(action))->trigger(); }
    QByteArray settings() const { return QJsonDocument(plot->settings()).toJson(QJsonDocument::Compact); }
    QString hint() const { return part<qplc::PlotOverlay>()->picture().hint; }

    RunningMaster master;
    qplc::WindowContext context;
    QPlcTimePlot *plot;
};
