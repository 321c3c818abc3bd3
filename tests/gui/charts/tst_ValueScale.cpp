// SPDX-License-Identifier: Apache-2.0
#include "gui/charts/PlotScales.h"

#include <QtTest/QtTest>

using namespace qplc;

namespace {

constexpr double line = 12.0;  // [px] of a label

QList<double> labelsOf(const QwtScaleDiv &scale)
{
    return scale.ticks(QwtScaleDiv::MajorTick);
}

}  // namespace

class tst_ValueScale : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void everyAxisHasTwoLabelsThatDiffer_data();
    void everyAxisHasTwoLabelsThatDiffer();
    void labelsDoNotTouch();
    void wholeNumbersStayWhole();
    void ticksAreRoundNumbers();
};

void tst_ValueScale::everyAxisHasTwoLabelsThatDiffer_data()
{
    QTest::addColumn<double>("minimum");
    QTest::addColumn<double>("maximum");
    QTest::newRow("usual") << 0.0 << 1400.0;
    QTest::newRow("one multiple of a half") << 0.97 << 1.4;
    QTest::newRow("one multiple of a thousand") << 700.0 << 1990.0;
    QTest::newRow("constant") << 8.1 << 9.9;
    QTest::newRow("negative") << -3.9 << -2.1;
    QTest::newRow("tiny") << 1.2e-5 << 1.9e-5;
    QTest::newRow("tiny beside its value") << 1e6 + 0.1 << 1e6 + 0.9;
    QTest::newRow("huge") << 1.1e12 << 1.9e12;
    QTest::newRow("about zero") << -0.9 << 0.9;
}

void tst_ValueScale::everyAxisHasTwoLabelsThatDiffer()
{
    QFETCH(double, minimum);
    QFETCH(double, maximum);
    for (double room = 8.0; room < 600.0; room *= 1.3) {
        ValueScaleDraw draw(QGuiApplication::font(), 5);
        draw.setScaleDiv(valueScale(minimum, maximum, room, line));
        QStringList texts;
        for (const double tick : labelsOf(draw.scaleDiv())) {
            QVERIFY(tick >= minimum - 1e-6 * std::abs(minimum) && tick <= maximum + 1e-6 * std::abs(maximum));
            texts << draw.label(tick).text();
        }
        QVERIFY2(texts.size() >= 2, qPrintable(QStringLiteral("%1 px: %2").arg(room).arg(texts.join(' '))));
        QVERIFY2(texts.removeDuplicates() == 0, qPrintable(texts.join(QLatin1Char(' '))));
        if (room > 6.0 * line)
            QVERIFY2(texts.size() >= 3, qPrintable(QStringLiteral("%1 px: %2").arg(room).arg(texts.join(' '))));
    }
}

void tst_ValueScale::labelsDoNotTouch()
{
    for (const double room : {20.0, 31.0, 47.0, 80.0, 300.0}) {
        for (double top = 1.0; top < 10.0; top += 0.37) {
            const QList<double> ticks = labelsOf(valueScale(0.0, top, room, line));
            for (int i = 1; i < ticks.size() && room > 2.5 * line; ++i)
                QVERIFY((ticks[i] - ticks[i - 1]) / top * room >= line);
        }
    }
}

void tst_ValueScale::wholeNumbersStayWhole()
{
    QCOMPARE(labelsOf(valueScale(0.0, 2.0, 500.0, line, 1.0)), (QList<double>{0.0, 1.0, 2.0}));
    QCOMPARE(labelsOf(valueScale(1.0, 3.0, 30.0, line, 1.0)), (QList<double>{1.0, 2.0, 3.0}));
    QVERIFY(labelsOf(valueScale(1.2, 1.8, 100.0, line, 1.0)).size() >= 2);  // zoomed in between them
}

void tst_ValueScale::ticksAreRoundNumbers()
{
    QCOMPARE(labelsOf(valueScale(0.0, 1400.0, 150.0, line)), (QList<double>{0.0, 500.0, 1000.0}));
    QCOMPARE(labelsOf(valueScale(-1.0, 1.0, 150.0, line)), (QList<double>{-1.0, -0.5, 0.0, 0.5, 1.0}));
}

QTEST_MAIN(tst_ValueScale)
#include "tst_ValueScale.moc"
