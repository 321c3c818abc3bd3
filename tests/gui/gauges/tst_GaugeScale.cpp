// SPDX-License-Identifier: Apache-2.0
#include "gui/gauges/GaugePicture.h"

#include <QtTest/QTest>

#include <limits>

using namespace qplc;

namespace {

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

class tst_GaugeScale : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void sharesAreClamped();
    void ticksAreRoundNumbers_data();
    void ticksAreRoundNumbers();
    void decimalsResolveAThousandthOfTheScale_data();
    void decimalsResolveAThousandthOfTheScale();
    void aScaleGrowsToRoundNumbersAndNeverShrinks();
    void numbersKeepTheirDecimals_data();
    void numbersKeepTheirDecimals();
    void bandsLieWithinTheScale();
    void invisibleChangesAreNotDrawn();
};

void tst_GaugeScale::sharesAreClamped()
{
    const GaugeScale scale{-10.0, 10.0};
    QCOMPARE(scale.share(-11.0), 0.0);
    QCOMPARE(scale.share(0.0), 0.5);
    QCOMPARE(scale.share(infinity), 1.0);
    QCOMPARE(scale.share(notANumber), 0.0);
    QCOMPARE((GaugeScale{3.0, 3.0}).share(3.0), 0.0);
}

void tst_GaugeScale::ticksAreRoundNumbers_data()
{
    QTest::addColumn<double>("minimum");
    QTest::addColumn<double>("maximum");
    QTest::addColumn<int>("most");
    QTest::addColumn<QVector<double>>("expected");
    QTest::newRow("symmetric") << -10.0 << 10.0 << 5 << QVector<double>{-10, -5, 0, 5, 10};
    QTest::newRow("ends that are not round") << 0.3 << 2.4 << 6 << QVector<double>{0.5, 1.0, 1.5, 2.0};
    QTest::newRow("an end that rounding would lose") << 0.0 << 0.3 << 4 << QVector<double>{0.0, 0.1, 0.2, 0.3};
    QTest::newRow("two") << 0.0 << 360.0 << 2 << QVector<double>{0.0};
    QTest::newRow("nothing") << 1.0 << 1.0 << 5 << QVector<double>{};
    QTest::newRow("infinite") << 0.0 << infinity << 5 << QVector<double>{};
}

void tst_GaugeScale::ticksAreRoundNumbers()
{
    QFETCH(double, minimum);
    QFETCH(double, maximum);
    QFETCH(int, most);
    QFETCH(QVector<double>, expected);
    const QVector<double> ticks = GaugeScale{minimum, maximum}.ticks(most);
    QCOMPARE(ticks.size(), expected.size());
    QVERIFY(ticks.size() <= most);
    for (int i = 0; i < ticks.size(); ++i)
        QVERIFY(std::abs(ticks.at(i) - expected.at(i)) < 1e-9);
}

void tst_GaugeScale::decimalsResolveAThousandthOfTheScale_data()
{
    QTest::addColumn<double>("span");
    QTest::addColumn<int>("decimals");
    QTest::newRow("1") << 1.0 << 3;
    QTest::newRow("20") << 20.0 << 2;
    QTest::newRow("360") << 360.0 << 1;
    QTest::newRow("1000") << 1000.0 << 0;
    QTest::newRow("10^6") << 1e6 << 0;
    QTest::newRow("10^-9") << 1e-9 << 6;
    QTest::newRow("none") << 0.0 << 0;
}

void tst_GaugeScale::decimalsResolveAThousandthOfTheScale()
{
    QFETCH(double, span);
    QTEST(GaugeScale({-span / 2.0, span / 2.0}).decimals(), "decimals");
}

void tst_GaugeScale::aScaleGrowsToRoundNumbersAndNeverShrinks()
{
    GaugeScale scale;
    QVERIFY(!scale.extendTo(0.7));
    QVERIFY(!scale.extendTo(notANumber));
    QVERIFY(!scale.extendTo(infinity));
    QVERIFY(scale.extendTo(3.0));
    QCOMPARE(scale, (GaugeScale{0.0, 5.0}));
    QVERIFY(scale.extendTo(-4.0));
    QCOMPARE(scale, (GaugeScale{-5.0, 5.0}));
    QVERIFY(scale.extendTo(-12.0));
    QCOMPARE(scale, (GaugeScale{-20.0, 20.0}));
    QVERIFY(!scale.extendTo(0.0));
    QVERIFY(scale.extendTo(1000.0));
    QCOMPARE(scale, (GaugeScale{-1000.0, 1000.0}));
}

void tst_GaugeScale::numbersKeepTheirDecimals_data()
{
    QTest::addColumn<double>("value");
    QTest::addColumn<int>("decimals");
    QTest::addColumn<QString>("expected");
    QTest::newRow("zero") << 0.0 << 2 << QStringLiteral("0.00");
    QTest::newRow("minus") << -1.5 << 2 << QStringLiteral("−1.50");
    QTest::newRow("a zero has no sign") << -0.001 << 2 << QStringLiteral("0.00");
    QTest::newRow("integer") << 42.0 << 0 << QStringLiteral("42");
    QTest::newRow("large") << 12345678.0 << 1 << QStringLiteral("1.23e+07");
    QTest::newRow("five digits") << 1234.5678 << 3 << QStringLiteral("1234.6");
    QTest::newRow("whole digits stay") << 152204.7 << 3 << QStringLiteral("152205");
    QTest::newRow("below one") << 0.123456 << 6 << QStringLiteral("0.1235");
    QTest::newRow("not a number") << notANumber << 2 << QStringLiteral("NaN");
    QTest::newRow("infinite") << -infinity << 2 << QStringLiteral("−∞");
}

void tst_GaugeScale::numbersKeepTheirDecimals()
{
    QFETCH(double, value);
    QFETCH(int, decimals);
    QTEST(gaugeNumber(value, decimals), "expected");
}

void tst_GaugeScale::bandsLieWithinTheScale()
{
    const auto textOf = [](const AlarmLimits &limits) {
        QStringList texts;
        const QVector<GaugePicture::Band> bands = bandsOf(limits, {0.0, 100.0});
        for (const GaugePicture::Band &band : bands)
            texts << QStringLiteral("%1 %2 %3")
                         .arg(band.begin)
                         .arg(band.end)
                         .arg(band.level == AlarmState::Alarm ? QStringLiteral("alarm") : QStringLiteral("warning"));
        return texts.join(QStringLiteral(", "));
    };
    QCOMPARE(textOf({}), QString());
    QCOMPARE(textOf({10.0, 20.0, 80.0, 90.0, 0.0}),
             QStringLiteral("0 10 alarm, 10 20 warning, 80 90 warning, 90 100 alarm"));
    QCOMPARE(textOf({{}, 20.0, 80.0, {}, 0.0}), QStringLiteral("0 20 warning, 80 100 warning"));
    QCOMPARE(textOf({-10.0, {}, 200.0, {}, 0.0}), QString());
}

void tst_GaugeScale::invisibleChangesAreNotDrawn()
{
    const auto picture = [](GaugeStyle style, double number, const char *text = "1") {
        GaugePicture made;
        made.style = style;
        made.scale = {0.0, 100.0};
        made.values = {{number, QString(text), {}, {}}};
        return made;
    };
    for (const GaugeStyle style : {GaugeStyle::Dial, GaugeStyle::Bar}) {
        QVERIFY(looksLike(picture(style, 50.0), picture(style, 50.01)));
        QVERIFY(!looksLike(picture(style, 50.0), picture(style, 50.1)));
        QVERIFY(looksLike(picture(style, 150.0), picture(style, 200.0)));
    }
    QVERIFY(looksLike(picture(GaugeStyle::Number, 1.0), picture(GaugeStyle::Number, 2.0)));
    QVERIFY(!looksLike(picture(GaugeStyle::Number, 1.0), picture(GaugeStyle::Number, 1.0, "2")));
    QVERIFY(looksLike(picture(GaugeStyle::Led, 1.0), picture(GaugeStyle::Led, 2.0)));
    QVERIFY(!looksLike(picture(GaugeStyle::Led, 1.0), picture(GaugeStyle::Led, 0.0)));
    QVERIFY(!looksLike(picture(GaugeStyle::Number, 1.0), picture(GaugeStyle::Number, notANumber)));
    QVERIFY(looksLike(picture(GaugeStyle::Dial, notANumber), picture(GaugeStyle::Dial, notANumber)));
    QVERIFY(!looksLike(picture(GaugeStyle::Dial, 1.0), picture(GaugeStyle::Bar, 1.0)));
}

QTEST_APPLESS_MAIN(tst_GaugeScale)
#include "tst_GaugeScale.moc"
