// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../../common/Waiting.h"
#include "NodeFixtures.h"
#include "QPlcTimePlot.h"
#include "gui/charts/PlotCanvas.h"
#include "gui/charts/PlotLegend.h"
#include "gui/panel/WindowContext.h"
#include "gui/plant/PlantFeed.h"

#include <QtCore/QJsonDocument>
#include <QtWidgets/QAction>

#include <qwt_plot_item.h>
#include <qwt_scale_draw.h>

constexpr qplc::PlantValues::Time millisecond = 1'000'000;

inline QPlcSignalTable fedTable()
{
    return QPlcSignalTable::fromIni("[phase]\ntype = Int8\nvalues = 0: Off, 1: ReelOut, 2: ReelInFasterThanEver\n"
                                    "[mode]\ntype = Int8\nvalues = 0: Manual, 1: Automatic\n"
                                    "[speed]\ntype = Real\nunit = m/s\n"
                                    "[windSpeed]\ntype = Real\nunit = m/s\n"
                                    "[force]\ntype = Real\nunit = N\n"
                                    "[power]\ntype = Real\nunit = W\n"
                                    "[angle]\ntype = Real\nunit = deg\n");
}

/// A plot with a plant that a test feeds: its phase is 0, 1, 2 for a second each.
class FedPlotWindow
{
public:
    explicit FedPlotWindow(const QByteArray &settings)
        : plot(new QPlcTimePlot)
    {
        QPlcSignalIndexTable::setCurrent(fedTable());
        plot->resize(640, 360);
        plot->setContext(&context);
        plant = context.plants()->addFed(QStringLiteral("kite"));
        plant->feed()->connected(fedTable());
        plant->feed()->started();
        for (int i = 0; i < 300; ++i) {
            QPlcSignalList values = valueOf("phase", QPlcValue(qint8(i / 100)));
            values.insert(QStringLiteral("speed"), QPlcValue(float(i)));
            values.insert(QStringLiteral("windSpeed"), QPlcValue(9.0F));
            values.insert(QStringLiteral("force"), QPlcValue(float(4000 + i)));
            values.insert(QStringLiteral("power"), QPlcValue(1.008e6F - 1000.0F * float(299 - i)));
            values.insert(QStringLiteral("angle"), QPlcValue(0.25F * float(i)));
            take(values);
        }
        context.timeAxis()->setSpan(2900 * millisecond);
        apply(settings);
    }
    ~FedPlotWindow() { delete plot; }

    void take(const QPlcSignalList &values)
    {
        now += 10 * millisecond;
        plant->feed()->add({values}, now);
    }
    /// An event at the time of a row.
    void tell(int row, const QString &text, const QString &source = QStringLiteral("kite"), bool isNote = false)
    {
        const qplc::SignalStore *store = plant->store();
        qplc::PlantEvent event;
        event.time = QDateTime::fromMSecsSinceEpoch(store->time(store->firstRow() + qplc::SignalStore::Row(row))
                                                    / millisecond);
        event.source = source;
        event.text = text;
        event.isNote = isNote;
        context.events()->append(event);
    }
    void apply(const QByteArray &settings) { plot->applySettings(QJsonDocument::fromJson(settings).object()); }
    QByteArray settings() const { return QJsonDocument(plot->settings()).toJson(QJsonDocument::Compact); }
    bool show()
    {
        plot->show();
        return QTest::qWaitForWindowExposed(plot) && waitUntil([this] { return plot->drawnPictures() > 0; });
    }
    qplc::PlotCanvas *canvas() const { return plot->findChild<qplc::PlotCanvas *>(); }
    qplc::PlotLegend *legend() const { return plot->findChild<qplc::PlotLegend *>(); }
    QAction *action(const char *name) const { return plot->findChild<QAction *>(QLatin1String(name)); }
    int count(int kind) const { return canvas()->itemList(kind).size(); }
    QString label(double value) const { return canvas()->axisScaleDraw(QwtPlot::yLeft)->label(value).text(); }
    bool hasNumbers() const
    {
        return canvas()->axisScaleDraw(QwtPlot::yLeft)->hasComponent(QwtAbstractScaleDraw::Labels);
    }
    /// At a place of the canvas, as shares of its size.
    QColor colorAt(double x, double y) const
    {
        const QImage picture = canvas()->canvas()->grab().toImage();
        return picture.pixelColor(int(x * (picture.width() - 1)), int(y * (picture.height() - 1)));
    }

    qplc::WindowContext context;
    QPlcTimePlot *plot;
    qplc::Plant *plant = nullptr;
    qplc::PlantValues::Time now = 1'700'000'000'000 * millisecond;
};
