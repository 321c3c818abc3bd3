// SPDX-License-Identifier: Apache-2.0
#include "CurveCanvas.h"
#include "ThreadCosts.h"

#include <QtCore/QBuffer>
#include <QtSvg/QSvgGenerator>

#include <qwt_graphic.h>

#include <algorithm>
#include <cmath>
#include <limits>

using qplc::SignalStore;
using qplc::StoreCurve;
using Time = SignalStore::Time;

class tst_StoreCurve : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void curveWithoutStoreOrRowsDrawsNothing();
    void spikeOfOneSampleReachesItsHeight();
    void eachColumnOfACurveIsDrawn();
    void gapsStayWhite();
    void valuesWithAMarkArePalerAndThinnerAndKeepTheirPeaks_data();
    void valuesWithAMarkArePalerAndThinnerAndKeepTheirPeaks();
    void stepsHoldTheirValue_data();
    void stepsHoldTheirValue();
    void gainAndOffsetMoveTheCurve();
    void lineWidthScalesWithTheScreen_data();
    void lineWidthScalesWithTheScreen();
    void curveFollowsATranslatedPainter();
    void curveFollowsARotatedPainter();
    void logarithmicAxisIsFollowed();
    void valuesFarOutsideAreCut();
    void originMovesTheAxis();
    void curveMovesByWholePixels_data();
    void curveMovesByWholePixels();
    void smoothCurvesHaveShades();
    void vectorPicturesHaveLines();
    void painterIsLeftAsItWas();
    void legendShowsTheColour();
    void valueRangeCoversTheView();
    void drawingAllocatesNoMemory();
};

void tst_StoreCurve::curveWithoutStoreOrRowsDrawsNothing()
{
    const SignalStore store(1, 16);
    Canvas canvas;
    canvas.draw(StoreCurve(nullptr, 0), 0.0, 1.0);
    canvas.draw(StoreCurve(&store, 0), 0.0, 1.0);
    for (int x = 0; x < width; ++x)
        QCOMPARE(canvas.count(x), 0);
    QVERIFY(StoreCurve(nullptr, 0).valueRange(0.0, 1.0).isEmpty());
}

void tst_StoreCurve::spikeOfOneSampleReachesItsHeight()
{
    SignalStore store(1, 100'000);
    fill(&store, 100'000, [](int i) { return i == 50'100 ? 90.5F : 10.5F; });
    Canvas canvas;
    canvas.draw(StoreCurve(&store, 0), 0.0, 100.0);
    QVERIFY(canvas.isSet(100, 9));
    QCOMPARE(canvas.count(100), 81);
    QVERIFY(!canvas.isSet(100, 8));
    QCOMPARE(canvas.count(99), 1);
    QCOMPARE(canvas.count(101), 1);
}

void tst_StoreCurve::eachColumnOfACurveIsDrawn()
{
    for (const int rows : {50, 150, 399, 400, 500, 20'000}) {
        SignalStore store(1, 20'000);
        fill(&store, rows, [](int i) { return float((i * 37) % 100); });
        Canvas canvas;
        canvas.draw(StoreCurve(&store, 0), 0.0, 0.001 * (rows - 1));
        for (int x = 0; x < width; ++x)
            QVERIFY2(canvas.count(x) > 0, qPrintable(QStringLiteral("%1 rows, column %2").arg(rows).arg(x)));
    }
}

void tst_StoreCurve::gapsStayWhite()
{
    for (const int rows : {100, 10'000}) {
        SignalStore store(1, std::max(rows, 16));
        fill(&store, rows, [rows](int i) { return i >= rows / 4 && i < rows / 2 ? noValue : 50.5F; });
        Canvas canvas;
        canvas.draw(StoreCurve(&store, 0), 0.0, 0.001 * rows);
        for (int x = 0; x < width - 2; ++x)
            QCOMPARE(canvas.count(x) > 0, x <= (rows == 100 ? 48 : 49) || x >= 100);
    }
}

void tst_StoreCurve::valuesWithAMarkArePalerAndThinnerAndKeepTheirPeaks_data()
{
    QTest::addColumn<int>("rows");
    QTest::addColumn<bool>("isSmooth");
    QTest::newRow("spans, a column for each row and more") << 150 << false;
    QTest::newRow("spans of many rows") << 20'000 << false;
    QTest::newRow("smooth lines") << 150 << true;
}

void tst_StoreCurve::valuesWithAMarkArePalerAndThinnerAndKeepTheirPeaks()
{
    QFETCH(int, rows);
    QFETCH(bool, isSmooth);
    SignalStore store(1, rows);
    for (int i = 0; i < rows; ++i) {
        const float value = i == rows * 5 / 8 ? 90.0F : 50.0F;
        QVERIFY(store.append(i * millisecond, &value));
        if (i >= rows / 2 && i < rows * 3 / 4)
            store.mark(0, 1);
    }
    Canvas canvas;
    StoreCurve curve(&store, 0);
    curve.setLineWidth(3.0);
    curve.setRenderHint(QwtPlotItem::RenderAntialiased, isSmooth);
    canvas.draw(curve, 0.0, 0.001 * rows);
    const auto darkest = [&](int x) {
        int grey = 255;
        for (int y = 0; y < height; ++y)
            grey = std::min(grey, qGray(canvas.image.pixel(x, y)));
        return grey;
    };
    QVERIFY(darkest(50) < 20 && darkest(180) < 20);
    QVERIFY(darkest(110) > 90 && darkest(110) < 200);
    QVERIFY(canvas.count(110) < canvas.count(50));
    int top = height;
    for (int x = 120; x < 130; ++x) {
        for (int y = 0; y < top; ++y)
            top = canvas.isSet(x, y) ? y : top;
    }
    QVERIFY2(std::abs(top - 10) <= 1, qPrintable(QString::number(top)));
    for (int x = 0; x < width - 2; ++x)
        QVERIFY2(canvas.count(x) > 0, qPrintable(QString::number(x)));
}

void tst_StoreCurve::stepsHoldTheirValue_data()
{
    QTest::addColumn<int>("rows");
    QTest::newRow("sparse") << 10;
    QTest::newRow("dense") << 1000;
}

void tst_StoreCurve::stepsHoldTheirValue()
{
    QFETCH(int, rows);
    SignalStore store(1, std::max(rows, 16));
    fill(&store, rows, [rows](int i) { return i < rows / 2 ? 20.5F : 80.5F; });
    StoreCurve curve(&store, 0);
    curve.setStyle(StoreCurve::Steps);
    Canvas canvas;
    canvas.draw(curve, 0.0, 0.001 * rows);
    for (int x = 0; x < 180; ++x)
        QCOMPARE(canvas.count(x), x == 100 ? 61 : 1);
    QVERIFY(canvas.isSet(99, 79));
    QVERIFY(canvas.isSet(101, 19));
}

void tst_StoreCurve::gainAndOffsetMoveTheCurve()
{
    SignalStore store(1, 1000);
    fill(&store, 1000, [](int i) { return i == 500 ? 2.0F : 1.0F; });
    StoreCurve curve(&store, 0);
    curve.setScaling(-20.0, 80.5);
    Canvas canvas;
    canvas.draw(curve, 0.0, 1.0);
    QVERIFY(canvas.isSet(50, 39));   // 60.5
    QVERIFY(canvas.isSet(100, 59));  // 40.5
    QCOMPARE(canvas.count(100), 21);
}

void tst_StoreCurve::lineWidthScalesWithTheScreen_data()
{
    QTest::addColumn<double>("scale");
    QTest::addColumn<double>("lineWidth");
    QTest::addColumn<int>("pixels");
    QTest::newRow("1x, 1 px") << 1.0 << 1.0 << 1;
    QTest::newRow("1x, 2 px") << 1.0 << 2.0 << 2;
    QTest::newRow("1x, hair line") << 1.0 << 0.2 << 1;
    QTest::newRow("1.5x, 2 px") << 1.5 << 2.0 << 3;
    QTest::newRow("2x, 1 px") << 2.0 << 1.0 << 2;
    QTest::newRow("2x, half a pixel") << 2.0 << 0.5 << 1;
}

void tst_StoreCurve::lineWidthScalesWithTheScreen()
{
    QFETCH(double, scale);
    QFETCH(double, lineWidth);
    QFETCH(int, pixels);
    for (const int rows : {20, 10'000}) {
        SignalStore store(1, std::max(rows, 16));
        fill(&store, rows, [](int) { return 50.5F; });
        StoreCurve curve(&store, 0);
        curve.setLineWidth(lineWidth);
        Canvas canvas(scale);
        canvas.draw(curve, 0.0, 0.001 * (rows - 1));
        for (int x = 0; x < canvas.image.width(); ++x)
            QCOMPARE(canvas.count(x), pixels);
        QVERIFY(canvas.isSet(5, int(49.5 * scale)));
    }
}

void tst_StoreCurve::curveFollowsATranslatedPainter()
{
    SignalStore store(1, 1000);
    fill(&store, 1000, [](int) { return 50.5F; });
    Canvas canvas(2.0);
    canvas.xMap.setScaleInterval(0.0, 1.0);
    QPainter painter(&canvas.image);
    painter.translate(30, 20);
    const StoreCurve curve(&store, 0);
    curve.draw(&painter, canvas.xMap, canvas.yMap, QRectF(0, 0, width, height));
    painter.end();
    QCOMPARE(canvas.count(59), 0);
    QVERIFY(canvas.isSet(60, 2 * 20 + 99));
    QVERIFY(canvas.isSet(399, 2 * 20 + 99));
}

void tst_StoreCurve::curveFollowsARotatedPainter()
{
    SignalStore store(1, 1000);
    fill(&store, 1000, [](int) { return 49.5F; });
    Canvas canvas;
    canvas.xMap.setScaleInterval(0.0, 1.0);
    QPainter painter(&canvas.image);
    painter.translate(width, 0);
    painter.rotate(90.0);  // to the right is down, down is to the left
    const StoreCurve curve(&store, 0);
    curve.draw(&painter, canvas.xMap, canvas.yMap, QRectF(0, 0, width, height));
    painter.end();
    QCOMPARE(canvas.count(width - 51), height);
    QCOMPARE(canvas.count(width - 53), 0);
}

void tst_StoreCurve::logarithmicAxisIsFollowed()
{
    SignalStore store(1, 1000);
    fill(&store, 1000, [](int) { return 10.0F; });
    Canvas canvas;
    canvas.yMap.setTransformation(new QwtLogTransform);
    canvas.yMap.setScaleInterval(1.0, 100.0);
    canvas.draw(StoreCurve(&store, 0), 0.0, 1.0);
    QVERIFY(canvas.isSet(100, 50) || canvas.isSet(100, 49));
    QCOMPARE(canvas.count(100), 1);
}

void tst_StoreCurve::valuesFarOutsideAreCut()
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    SignalStore store(1, 1000);
    fill(&store, 1000, [](int i) {
        const float values[]{1e30F, -1e30F, infinity, -infinity, 50.5F};
        return values[i % 5];
    });
    Canvas canvas;
    canvas.draw(StoreCurve(&store, 0), 0.0, 1.0);
    for (int x = 0; x < width; ++x)
        QCOMPARE(canvas.count(x), height);
    StoreCurve withoutGain(&store, 0);
    withoutGain.setScaling(0.0, 50.0);  // 0 * infinity
    canvas.draw(withoutGain, 0.0, 1.0);
}

void tst_StoreCurve::originMovesTheAxis()
{
    constexpr Time origin = 1'700'000'000'000'000'000;
    SignalStore store(1, 100);
    const float value = 50.5F;
    store.append(origin + 500 * millisecond, &value);
    StoreCurve curve(&store, 0);
    curve.setOrigin(origin);
    Canvas canvas;
    canvas.draw(curve, 0.0, 1.0);
    QVERIFY(canvas.isSet(100, 49));
    QCOMPARE(canvas.count(100), 3);  // a dot
    QCOMPARE(canvas.count(102), 0);
}

void tst_StoreCurve::curveMovesByWholePixels_data()
{
    QTest::addColumn<Qt::PenStyle>("style");
    QTest::newRow("solid") << Qt::SolidLine;
    QTest::newRow("dashes") << Qt::DashLine;
    QTest::newRow("dots") << Qt::DotLine;
}

void tst_StoreCurve::curveMovesByWholePixels()
{
    QFETCH(Qt::PenStyle, style);
    SignalStore store(1, 20'000);
    fill(&store, 20'000, [](int i) { return float((i * 7919) % 97); });
    StoreCurve curve(&store, 0);
    curve.setPenStyle(style);
    Canvas still;
    still.draw(curve, 2.0, 12.0);
    for (int shift = 1; shift < 200; shift += 7) {  // a pixel is 50 ms
        Canvas moved;
        moved.draw(curve, 2.0 + 0.001 * shift, 12.0 + 0.001 * shift);
        const int pixels = int(std::floor(shift / 50.0 + 0.5));
        QCOMPARE(moved.image.copy(1, 0, 190, height), still.image.copy(1 + pixels, 0, 190, height));
    }
}

void tst_StoreCurve::smoothCurvesHaveShades()
{
    SignalStore store(1, 16);
    fill(&store, 2, [](int i) { return i == 0 ? 10.0F : 60.0F; });
    StoreCurve curve(&store, 0);
    Canvas plain;
    plain.draw(curve, 0.0, 0.001);
    curve.setRenderHint(QwtPlotItem::RenderAntialiased);
    Canvas smooth;
    smooth.draw(curve, 0.0, 0.001);
    QCOMPARE(plain.shades(), 0);
    QVERIFY(smooth.shades() > 100);
}

void tst_StoreCurve::vectorPicturesHaveLines()
{
    SignalStore store(1, 16);
    fill(&store, 10, [](int i) { return i == 5 ? noValue : float(i * i); });
    QBuffer file;
    QSvgGenerator svg;
    svg.setOutputDevice(&file);
    svg.setSize(QSize(width, height));
    Canvas canvas;
    canvas.xMap.setScaleInterval(0.0, 0.01);
    QPainter painter(&svg);
    const StoreCurve curve(&store, 0);
    curve.draw(&painter, canvas.xMap, canvas.yMap, QRectF(0, 0, width, height));
    painter.end();
    QCOMPARE(file.data().count("<polyline"), 2);
}

void tst_StoreCurve::painterIsLeftAsItWas()
{
    SignalStore store(1, 16);
    fill(&store, 10, [](int i) { return float(i); });
    Canvas canvas(2.0);
    canvas.xMap.setScaleInterval(0.0, 1.0);
    QPainter painter(&canvas.image);
    painter.translate(3, 4);
    painter.setPen(Qt::red);
    const QTransform before = painter.transform();
    const StoreCurve curve(&store, 0);
    curve.draw(&painter, canvas.xMap, canvas.yMap, QRectF(0, 0, width, height));
    QCOMPARE(painter.transform(), before);
    QCOMPARE(painter.pen().color(), QColor(Qt::red));
}

void tst_StoreCurve::legendShowsTheColour()
{
    StoreCurve curve(nullptr, 0, QStringLiteral("power"));
    curve.setColor(Qt::blue);
    QVERIFY(curve.testItemAttribute(QwtPlotItem::Legend));
    QCOMPARE(curve.title().text(), QStringLiteral("power"));
    QCOMPARE(curve.legendIcon(0, QSizeF(8, 8)).toImage().pixelColor(4, 4), QColor(Qt::blue));
}

void tst_StoreCurve::valueRangeCoversTheView()
{
    SignalStore store(1, 1000);
    fill(&store, 1000, [](int i) { return float(i); });
    StoreCurve curve(&store, 0);
    curve.setScaling(-2.0, 1.0);
    const SignalStore::Range range = curve.valueRange(0.1, 0.2);
    QCOMPARE(range.minimum, -2.0F * 199.0F + 1.0F);
    QCOMPARE(range.maximum, -2.0F * 100.0F + 1.0F);
    QVERIFY(curve.valueRange(5.0, 6.0).isEmpty());
}

void tst_StoreCurve::drawingAllocatesNoMemory()
{
    if (!ThreadCosts::areCounted())
        QSKIP("allocations are not counted under a sanitizer");
    SignalStore store(1, 20'000);
    fill(&store, 20'000, [](int i) { return float((i * 37) % 100); });
    const StoreCurve curve(&store, 0);
    const auto costsOf = [&](double span) {
        Canvas canvas;
        canvas.draw(curve, 0.0, span);
        const ThreadCosts before = ThreadCosts::ofThisThread();
        canvas.draw(curve, 0.0, span);
        return (ThreadCosts::ofThisThread() - before).allocations;
    };
    const std::uint64_t ofPainter = costsOf(0.0005);  // hardly anything to draw
    QVERIFY(costsOf(20.0) <= ofPainter + 2);
    QVERIFY(costsOf(0.1) <= ofPainter + 2);
}

QTEST_MAIN(tst_StoreCurve)
#include "tst_StoreCurve.moc"
