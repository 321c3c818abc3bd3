// SPDX-License-Identifier: Apache-2.0
#include "hardware/RawNumber.h"

#include <QtTest/QtTest>

#include <cmath>
#include <limits>

using qplc::RawNumber;

Q_DECLARE_METATYPE(RawNumber)
Q_DECLARE_METATYPE(RawNumber::Fit)

// A number of a device, to bits and back.
class tst_RawNumber : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void valueIsTheNearestNumberOfItsBits_data();
    void valueIsTheNearestNumberOfItsBits();
    void bitsAboveTheNumberDoNotCount();
    void finiteValueHasAFiniteNumber();
};

void tst_RawNumber::valueIsTheNearestNumberOfItsBits_data()
{
    QTest::addColumn<RawNumber>("number");
    QTest::addColumn<double>("value");
    QTest::addColumn<double>("nearest");
    QTest::addColumn<RawNumber::Fit>("fit");
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double largestFloat = double(std::numeric_limits<float>::max());
    const RawNumber bit{RawNumber::Unsigned, 1};
    const RawNumber byte{RawNumber::Unsigned, 8};
    const RawNumber twelve{RawNumber::Signed, 12};
    const RawNumber all{RawNumber::Unsigned, 64};
    const RawNumber allSigned{RawNumber::Signed, 64};
    const RawNumber single{RawNumber::Float, 32};
    const RawNumber twice{RawNumber::Float, 64};
    QTest::newRow("bit") << bit << 1.0 << 1.0 << RawNumber::Fits;
    QTest::newRow("bit, too large") << bit << 2.0 << 1.0 << RawNumber::Saturated;
    QTest::newRow("half away from 0") << byte << 2.5 << 3.0 << RawNumber::Fits;
    QTest::newRow("below 0 without a sign") << byte << -1.0 << 0.0 << RawNumber::Saturated;
    QTest::newRow("byte, too large") << byte << 1e300 << 255.0 << RawNumber::Saturated;
    QTest::newRow("byte, infinite") << byte << infinity << 255.0 << RawNumber::Saturated;
    QTest::newRow("byte, no number") << byte << nan << 0.0 << RawNumber::NoNumber;
    QTest::newRow("signed") << twelve << -2048.0 << -2048.0 << RawNumber::Fits;
    QTest::newRow("signed, half away from 0") << twelve << -2.5 << -3.0 << RawNumber::Fits;
    QTest::newRow("signed, too small") << twelve << -2049.0 << -2048.0 << RawNumber::Saturated;
    QTest::newRow("signed, too large") << twelve << 2048.0 << 2047.0 << RawNumber::Saturated;
    QTest::newRow("64 bits, too large") << all << 0x1p64 << 0x1p64 << RawNumber::Saturated;  // 2^64 - 1 is no double
    QTest::newRow("64 bits, signed, too small") << allSigned << -infinity << -0x1p63 << RawNumber::Saturated;
    QTest::newRow("64 bits, signed") << allSigned << -0x1p63 << -0x1p63 << RawNumber::Fits;
    QTest::newRow("float") << single << 0.1 << double(0.1f) << RawNumber::Fits;
    QTest::newRow("float, too large") << single << 1e39 << largestFloat << RawNumber::Saturated;
    QTest::newRow("float, too small") << single << -1e39 << -largestFloat << RawNumber::Saturated;
    QTest::newRow("float, infinite") << single << -infinity << -infinity << RawNumber::Fits;
    QTest::newRow("double") << twice << 0.1 << 0.1 << RawNumber::Fits;
}

void tst_RawNumber::valueIsTheNearestNumberOfItsBits()
{
    QFETCH(RawNumber, number);
    QFETCH(double, value);
    QFETCH(double, nearest);
    QFETCH(RawNumber::Fit, fit);
    RawNumber::Fit seen = RawNumber::Fits;
    const double back = number.decode(number.encode(value, &seen));
    QVERIFY2(back == nearest, qPrintable(QString::number(back, 'g', 17)));
    QCOMPARE(seen, fit);
}

void tst_RawNumber::bitsAboveTheNumberDoNotCount()
{
    QCOMPARE((RawNumber{RawNumber::Unsigned, 4}.decode(0xFFF7)), 7.0);
    QCOMPARE((RawNumber{RawNumber::Signed, 4}.decode(0xFFF7)), 7.0);
    QCOMPARE((RawNumber{RawNumber::Signed, 4}.decode(0x0008)), -8.0);
    QCOMPARE((RawNumber{RawNumber::Float, 32}.decode(0xFFFF'FFFF'3F80'0000)), 1.0);
}

void tst_RawNumber::finiteValueHasAFiniteNumber()
{
    constexpr double largest = std::numeric_limits<double>::max();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    QCOMPARE(RawNumber::scaled(-35.5, 0.1, -40.0), 45.0);
    QCOMPARE(RawNumber::scaled(1e300, 1e-10, 0.0), largest);
    QCOMPARE(RawNumber::scaled(1e300, -1e-10, 0.0), -largest);
    QCOMPARE(RawNumber::scaled(largest, 1.0, -largest), largest);
    QCOMPARE(RawNumber::scaled(-infinity, 2.0, 0.0), -infinity);
}

QTEST_APPLESS_MAIN(tst_RawNumber)
#include "tst_RawNumber.moc"
