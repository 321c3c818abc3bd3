// SPDX-License-Identifier: Apache-2.0
#include "gui/models/SteadyPrefix.h"

#include <QtTest/QtTest>

#include <cmath>

using namespace qplc;

namespace {

QString textOf(const QString &unit, double value)
{
    const SiPrefix prefix = SiPrefix::fitting(unit, value);
    return (steadyNumberText(prefix.shown(value), 4) + QLatin1Char(' ') + prefix.unit()).trimmed();
}

}  // namespace

class tst_SiPrefix : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void valuesHaveThePrefixThatFits_data();
    void valuesHaveThePrefixThatFits();
    void aPrefixIsKeptWhileItIsGoodEnough();
    void aSteadyPrefixGrowsAtOnceAndShrinksLater();
    void aSteadyPrefixDoesNotFlickerAtABorder();
    void numbersKeepTheirDigits_data();
    void numbersKeepTheirDigits();
};

void tst_SiPrefix::valuesHaveThePrefixThatFits_data()
{
    QTest::addColumn<QString>("unit");
    QTest::addColumn<double>("value");
    QTest::addColumn<QString>("text");
    const auto row = [](const char *unit, double value, const char *text) {
        QTest::newRow(text) << QString::fromUtf8(unit) << value << QString::fromUtf8(text);
    };
    row("s", 13.9e-6, "13.90 µs");
    row("J", 1.008e6, "1.008 MJ");
    row("W", 1263.0, "1263 W");
    row("W", -12630.0, "-12.63 kW");
    row("kN", 0.0125, "12.50 N");
    row("us", 250.0, "250.0 µs");
    row("us", 25000.0, "25.00 ms");
    row("mm", 0.002, "2.000 µm");
    row("Nm", 20e3, "20.00 kNm");
    row("Hz", 0.0, "0.000 Hz");
    row("deg", 12345.0, "12345 deg");
    row("m/s", 0.0125, "0.013 m/s");
    row("%", 20e3, "20000 %");
    row("kg", 20e3, "20000 kg");
    row("min", 20e3, "20000 min");
    row("1", 0.5, "0.500");
    row("", 20e3, "20000");
    row("s", NAN, "– s");
}

void tst_SiPrefix::valuesHaveThePrefixThatFits()
{
    QFETCH(QString, unit);
    QFETCH(double, value);
    QTEST(textOf(unit, value), "text");
}

void tst_SiPrefix::aPrefixIsKeptWhileItIsGoodEnough()
{
    SiPrefix prefix = SiPrefix::fitting(QStringLiteral("s"), 900e-6);
    QCOMPARE(prefix.unit(), QStringLiteral("µs"));
    prefix = prefix.kept(1.1e-3);
    QCOMPARE(prefix.unit(), QStringLiteral("µs"));
    prefix = prefix.kept(0.0);
    QCOMPARE(prefix.unit(), QStringLiteral("µs"));
    prefix = prefix.kept(12e-3);
    QCOMPARE(prefix.unit(), QStringLiteral("ms"));
    QCOMPARE(prefix.shown(12e-3), 12.0);
    QCOMPARE(prefix.kept(2.0).unit(), QStringLiteral("ms"));
    QCOMPARE(prefix.kept(20.0).unit(), QStringLiteral("s"));
}

void tst_SiPrefix::aSteadyPrefixGrowsAtOnceAndShrinksLater()
{
    const QString joule = QStringLiteral("J");
    SteadyPrefix prefix;
    QCOMPARE(prefix.next(joule, 0.0).unit(), QStringLiteral("J"));
    QCOMPARE(prefix.next(joule, 2e-3).unit(), QStringLiteral("mJ"));  // the first value decides
    QCOMPARE(prefix.next(joule, 12e3).unit(), QStringLiteral("kJ"));
    for (int text = 1; text < SteadyPrefix::Patience; ++text)
        QCOMPARE(prefix.next(joule, 50.0).unit(), QStringLiteral("kJ"));
    QCOMPARE(prefix.next(joule, 500.0).unit(), QStringLiteral("kJ"));  // good again: the count begins anew
    for (int text = 1; text < SteadyPrefix::Patience; ++text)
        QCOMPARE(prefix.next(joule, -50.0).unit(), QStringLiteral("kJ"));
    QCOMPARE(prefix.next(joule, 50.0).unit(), QStringLiteral("J"));
    QCOMPARE(prefix.next(joule, std::numeric_limits<double>::quiet_NaN()).unit(), QStringLiteral("J"));
    QCOMPARE(prefix.next(QStringLiteral("deg"), 1e6).unit(), QStringLiteral("deg"));
}

void tst_SiPrefix::aSteadyPrefixDoesNotFlickerAtABorder()
{
    SteadyPrefix prefix;
    prefix.next(QStringLiteral("N"), 9990.0);
    int changes = 0;
    QString shown = prefix.current().unit();
    for (int text = 0; text < 1000; ++text) {
        const double size = text % 2 == 0 ? 9990.0 : 10010.0;
        const QString unit = prefix.next(QStringLiteral("N"), size).unit();
        changes += unit != shown ? 1 : 0;
        shown = unit;
    }
    QCOMPARE(changes, 1);
}

void tst_SiPrefix::numbersKeepTheirDigits_data()
{
    QTest::addColumn<double>("value");
    QTest::addColumn<QString>("text");
    QTest::newRow("zeros") << 1.2 << "1.200";
    QTest::newRow("tens") << 12.34567 << "12.35";
    QTest::newRow("thousands") << 1234.4 << "1234";
    QTest::newRow("more") << 123456.0 << "123456";
    QTest::newRow("below one") << -0.05 << "-0.050";
    QTest::newRow("nothing") << 0.0 << "0.000";
    QTest::newRow("tiny") << 1.5e-7 << "1.5e-07";
    QTest::newRow("huge") << 1.5e9 << "1.5e+09";
}

void tst_SiPrefix::numbersKeepTheirDigits()
{
    QFETCH(double, value);
    QTEST(steadyNumberText(value, 4), "text");
}

QTEST_APPLESS_MAIN(tst_SiPrefix)
#include "tst_SiPrefix.moc"
