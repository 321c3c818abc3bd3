// SPDX-License-Identifier: Apache-2.0
#include "CurveCanvas.h"

#include <QtCore/QBuffer>
#include <QtSvg/QSvgGenerator>

#include <cmath>

using qplc::SignalStore;
using qplc::StoreCurve;

/// Curves whose colour another one has, too.
class tst_DashedCurves : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void dashesHaveGapsAndLoseNoSpike_data();
    void dashesHaveGapsAndLoseNoSpike();
    void vectorPicturesHaveDashes();
};

void tst_DashedCurves::dashesHaveGapsAndLoseNoSpike_data()
{
    QTest::addColumn<Qt::PenStyle>("style");
    QTest::addColumn<double>("share");  // of the columns that are drawn
    QTest::newRow("dashes") << Qt::DashLine << 5.0 / 8.0;
    QTest::newRow("dots") << Qt::DotLine << 0.5;
}

void tst_DashedCurves::dashesHaveGapsAndLoseNoSpike()
{
    QFETCH(Qt::PenStyle, style);
    QFETCH(double, share);
    for (int spike = 5'000; spike < 5'900; spike += 50) {  // a pixel is 50 ms
        SignalStore store(1, 20'000);
        fill(&store, 20'000, [spike](int i) { return i == spike ? 90.0F : 20.0F; });
        StoreCurve curve(&store, 0);
        curve.setRenderHint(QwtPlotItem::RenderAntialiased);
        curve.setLineWidth(2.0);
        curve.setPenStyle(style);
        Canvas canvas;
        canvas.draw(curve, 2.0, 12.0);
        int drawn = 0;
        int highest = height;
        for (int x = 0; x < width; ++x) {
            drawn += canvas.count(x) > 0 ? 1 : 0;
            for (int y = 0; y < highest; ++y)
                highest = canvas.isSet(x, y) ? y : highest;
        }
        QVERIFY2(std::abs(drawn - share * width) < 12, qPrintable(QString::number(drawn)));
        QVERIFY2(std::abs(highest - (height - 90)) <= 1, qPrintable(QString::number(highest)));
    }
}

void tst_DashedCurves::vectorPicturesHaveDashes()
{
    SignalStore store(1, 16);
    fill(&store, 10, [](int i) { return float(i * i); });
    for (const Qt::PenStyle style : {Qt::SolidLine, Qt::DashLine, Qt::DotLine}) {
        QBuffer file;
        QSvgGenerator svg;
        svg.setOutputDevice(&file);
        svg.setSize(QSize(width, height));
        Canvas canvas;
        canvas.xMap.setScaleInterval(0.0, 0.01);
        QPainter painter(&svg);
        StoreCurve curve(&store, 0);
        curve.setPenStyle(style);
        curve.draw(&painter, canvas.xMap, canvas.yMap, QRectF(0, 0, width, height));
        painter.end();
        QCOMPARE(file.data().contains("stroke-dasharray=\"5,3\""), style == Qt::DashLine);
        QCOMPARE(file.data().contains("stroke-dasharray=\"2,2\""), style == Qt::DotLine);
    }
}

QTEST_MAIN(tst_DashedCurves)
#include "tst_DashedCurves.moc"
