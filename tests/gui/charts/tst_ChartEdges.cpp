// SPDX-License-Identifier: Apache-2.0
// Charts paint every pixel of theirs, also the last column and row, at scale factors between whole
// numbers. This program runs once for each scale factor: see CMakeLists.txt.
#include "../../common/Waiting.h"
#include "FedPlotWindow.h"
#include "PanelFixtures.h"
#include "QPlcJitterHistogram.h"
#include "QPlcXyPlot.h"
#include "gui/charts/JitterCanvas.h"

#include <QtGui/QPainter>

using namespace qplc;

namespace {

QImage pictureOver(QWidget *chart, const QColor &beneath, double ratio)
{
    QImage image((QSizeF(chart->size()) * ratio).toSize(), QImage::Format_RGB32);
    image.setDevicePixelRatio(ratio);
    image.fill(beneath);
    chart->render(&image, QPoint(), QRegion(), QWidget::DrawChildren);
    return image;
}

/// Pixels that show what is beneath the chart.
int foreignPixels(QWidget *chart, double ratio)
{
    const QImage magenta = pictureOver(chart, QColor(255, 0, 255), ratio);
    const QImage green = pictureOver(chart, QColor(0, 255, 0), ratio);
    int pixels = 0;
    for (int y = 0; y < magenta.height(); ++y) {
        for (int x = 0; x < magenta.width(); ++x)
            pixels += magenta.pixel(x, y) != green.pixel(x, y) ? 1 : 0;
    }
    return pixels;
}

/// The same for sizes that meet pixels and sizes that do not.
void checkSizes(QWidget *chart)
{
    for (const QSize size : {QSize(301, 201), QSize(302, 203), QSize(443, 304), QSize(160, 121)}) {
        chart->resize(size);
        QCoreApplication::processEvents();
        for (const double ratio : {1.0, 1.25, 1.5, 1.75, 2.0})
            QCOMPARE(foreignPixels(chart, ratio), 0);
    }
}

}  // namespace

class tst_ChartEdges : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void timePlotsPaintAllPixels_data();
    void timePlotsPaintAllPixels();
    void xyPlotsPaintAllPixels();
    void histogramsPaintAllPixels();
    void theAreaOfTheCurvesIsNotOpaque();
    void bandsReachTheLastColumnAndRow_data();
    void bandsReachTheLastColumnAndRow();
};

void tst_ChartEdges::initTestCase()
{
    const double wanted = qEnvironmentVariable("QT_SCALE_FACTOR", QStringLiteral("1")).toDouble();
    QCOMPARE(qApp->devicePixelRatio(), wanted);
}

void tst_ChartEdges::timePlotsPaintAllPixels_data()
{
    QTest::addColumn<QByteArray>("settings");
    QTest::newRow("empty") << QByteArray("{}");
    QTest::newRow("lines") << QByteArray(R"({"curves":[{"signal":"speed"},{"axis":"right","signal":"force"}]})");
    QTest::newRow("bands") << QByteArray(R"({"curves":[{"bands":true,"signal":"phase"}]})");
    QTest::newRow("both") << QByteArray(R"({"curves":[{"signal":"speed"},{"bands":true,"signal":"phase"}]})");
}

void tst_ChartEdges::timePlotsPaintAllPixels()
{
    QFETCH(QByteArray, settings);
    FedPlotWindow window(settings);
    QVERIFY(window.show());
    checkSizes(window.plot);
}

void tst_ChartEdges::xyPlotsPaintAllPixels()
{
    FedPlotWindow window("{}");
    QPlcXyPlot plot;
    plot.setContext(&window.context);
    plot.applySettings(objectOf(R"({"curves":[{"x":"speed","y":"force"}]})"));
    plot.show();
    QVERIFY(QTest::qWaitForWindowExposed(&plot));
    checkSizes(&plot);
}

void tst_ChartEdges::histogramsPaintAllPixels()
{
    JitterCanvas canvas;
    canvas.setTheme(Theme::byName(Theme::Light));
    JitterDistribution lateness;
    lateness.count = 30.0;
    lateness.bins = {{1e3, 2e3, 10.0}, {2e3, 4e3, 20.0}};
    canvas.setVisible(true);
    canvas.show({lateness}, false);
    checkSizes(&canvas);
}

/// Qt paints nothing beneath an opaque area: pixels that it meets only in part would keep what the
/// screen showed before.
void tst_ChartEdges::theAreaOfTheCurvesIsNotOpaque()
{
    FedPlotWindow window("{}");
    QPlcXyPlot path;
    JitterCanvas histogram;
    for (const QWidget *canvas :
         {window.canvas()->canvas(), path.findChild<QwtPlot *>()->canvas(), histogram.canvas()}) {
        canvas->ensurePolished();
        QVERIFY(!canvas->testAttribute(Qt::WA_OpaquePaintEvent));
    }
}

void tst_ChartEdges::bandsReachTheLastColumnAndRow_data()
{
    QTest::addColumn<QByteArray>("curves");
    QTest::newRow("one") << QByteArray(R"({"bands":true,"signal":"mode"})");
    QTest::newRow("two") << QByteArray(R"({"bands":true,"signal":"mode"},{"bands":true,"signal":"phase"})");
    QTest::newRow("at the bottom") << QByteArray(R"({"bands":true,"signal":"mode"},{"signal":"speed"})");
}

void tst_ChartEdges::bandsReachTheLastColumnAndRow()
{
    QFETCH(QByteArray, curves);
    FedPlotWindow window(R"({"grid":false,"curves":[)" + curves + "]}");
    QVERIFY(window.show());
    for (const int width : {300, 301, 302, 303}) {
        window.plot->resize(width + 2, width);
        const int before = window.plot->drawnPictures();
        QTRY_VERIFY(window.plot->drawnPictures() > before);
        QwtPlot *canvas = window.canvas();
        canvas->setCanvasBackground(Qt::magenta);
        canvas->replot();
        const QImage picture = canvas->canvas()->grab().toImage();
        const int right = picture.width() - 1;
        const int bottom = picture.height() - 1;
        QVERIFY(picture.pixelColor(right, bottom) != QColor(Qt::magenta));
        QCOMPARE(picture.pixelColor(right, bottom), picture.pixelColor(right - 3, bottom - 3));
    }
}

QTEST_MAIN(tst_ChartEdges)
#include "tst_ChartEdges.moc"
