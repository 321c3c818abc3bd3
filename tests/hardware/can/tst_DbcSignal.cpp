// SPDX-License-Identifier: Apache-2.0
#include "hardware/can/DbcSignal.h"

#include <QtTest/QtTest>

#include <array>
#include <cmath>
#include <limits>

using qplc::DbcSignal;

namespace {

using Bytes = std::array<quint8, 64>;

DbcSignal place(int start, int length, DbcSignal::ByteOrder order, DbcSignal::Kind kind = DbcSignal::Unsigned)
{
    DbcSignal signal;
    signal.start = start;
    signal.length = length;
    signal.byteOrder = order;
    signal.kind = kind;
    return signal;
}

QByteArray hex(const Bytes &bytes, int size)
{
    return QByteArray(reinterpret_cast<const char *>(bytes.data()), size).toHex();
}

}  // namespace

class tst_DbcSignal : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void bitsHaveTheirDbcPositions_data();
    void bitsHaveTheirDbcPositions();
    void everyLayoutReturnsTheWrittenValue();
    void writingKeepsNeighbouringBits();
    void neededBytesReachToTheLastBit();
    void physicalIsRawTimesFactorPlusOffset();
    void negativeValuesAreReadBack();
    void encodingRoundsToTheNearestRawValue();
    void valuesOutOfRangeAreSaturated_data();
    void valuesOutOfRangeAreSaturated();
    void notANumberIsReportedAndEncodedAsZero();
    void floatsAreEncodedAsIeee754();
    void largeDoubleSaturatesToTheLargestFloat();
    void all64BitsAreExact();
};

void tst_DbcSignal::bitsHaveTheirDbcPositions_data()
{
    QTest::addColumn<int>("start");
    QTest::addColumn<int>("length");
    QTest::addColumn<bool>("isIntel");
    QTest::addColumn<quint64>("value");
    QTest::addColumn<QByteArray>("bytes");
    const auto row = [](const char *name, int start, int length, bool isIntel, quint64 value, const char *bytes) {
        QTest::newRow(name) << start << length << isIntel << value << QByteArray(bytes);
    };
    row("Intel, a byte", 8, 8, true, 0xAB, "00ab000000000000");
    row("Intel, two bytes", 0, 16, true, 0x1234, "3412000000000000");
    row("Intel, across a byte", 4, 12, true, 0xABC, "c0ab000000000000");
    row("Intel, one bit", 63, 1, true, 1, "0000000000000080");
    row("Intel, all", 0, 64, true, 0x0123456789ABCDEF, "efcdab8967452301");
    row("Motorola, a byte", 15, 8, false, 0xAB, "00ab000000000000");
    row("Motorola, two bytes", 7, 16, false, 0x1234, "1234000000000000");
    row("Motorola, across a byte", 3, 12, false, 0xABC, "0abc000000000000");
    row("Motorola, one bit", 56, 1, false, 1, "0000000000000001");
    row("Motorola, all", 7, 64, false, 0x0123456789ABCDEF, "0123456789abcdef");
    row("Motorola, nine bytes would be needed", 0, 57, false, 1, "0000000000000001");
}

void tst_DbcSignal::bitsHaveTheirDbcPositions()
{
    QFETCH(int, start);
    QFETCH(int, length);
    QFETCH(bool, isIntel);
    QFETCH(quint64, value);
    QFETCH(QByteArray, bytes);
    const DbcSignal signal = place(start, length, isIntel ? DbcSignal::Intel : DbcSignal::Motorola);
    Bytes data{};
    signal.setBits(data.data(), value);
    QCOMPARE(hex(data, 8), bytes);
    QCOMPARE(signal.bits(data.data()), value);
}

void tst_DbcSignal::everyLayoutReturnsTheWrittenValue()
{
    for (const auto order : {DbcSignal::Intel, DbcSignal::Motorola}) {
        for (int start = 0; start < 128; ++start) {
            for (int length = 1; length <= 64; ++length) {
                const DbcSignal signal = place(start, length, order);
                const quint64 value = 0x9E3779B97F4A7C15U >> (64 - length);
                Bytes data{};
                signal.setBits(data.data(), value);
                QCOMPARE(signal.bits(data.data()), value);
            }
        }
    }
}

void tst_DbcSignal::writingKeepsNeighbouringBits()
{
    for (const auto order : {DbcSignal::Intel, DbcSignal::Motorola}) {
        for (int length = 1; length <= 64; ++length) {
            const DbcSignal signal = place(21, length, order);
            Bytes ones;
            ones.fill(0xFF);
            signal.setBits(ones.data(), 0);
            int zeros = 0;
            for (const quint8 byte : ones)
                zeros += 8 - int(qPopulationCount(byte));
            QCOMPARE(zeros, length);
        }
    }
}

void tst_DbcSignal::neededBytesReachToTheLastBit()
{
    QCOMPARE(place(0, 1, DbcSignal::Intel).neededBytes(), 1);
    QCOMPARE(place(7, 2, DbcSignal::Intel).neededBytes(), 2);
    QCOMPARE(place(0, 64, DbcSignal::Intel).neededBytes(), 8);
    QCOMPARE(place(1, 64, DbcSignal::Intel).neededBytes(), 9);
    QCOMPARE(place(7, 8, DbcSignal::Motorola).neededBytes(), 1);
    QCOMPARE(place(6, 8, DbcSignal::Motorola).neededBytes(), 2);
    QCOMPARE(place(7, 64, DbcSignal::Motorola).neededBytes(), 8);
    QCOMPARE(place(504, 1, DbcSignal::Motorola).neededBytes(), 64);
}

void tst_DbcSignal::physicalIsRawTimesFactorPlusOffset()
{
    DbcSignal signal = place(0, 16, DbcSignal::Intel);
    signal.factor = 0.25;
    signal.offset = -40.0;
    Bytes data{};
    signal.setBits(data.data(), 400);
    QCOMPARE(signal.decode(data.data()), 60.0);
    QCOMPARE(signal.encode(data.data(), -40.0), DbcSignal::Fits);
    QCOMPARE(signal.bits(data.data()), quint64(0));
}

void tst_DbcSignal::negativeValuesAreReadBack()
{
    for (int length = 2; length <= 64; ++length) {
        const DbcSignal signal = place(3, length, DbcSignal::Motorola, DbcSignal::Signed);
        Bytes data{};
        QCOMPARE(signal.encode(data.data(), -2.0), DbcSignal::Fits);
        QCOMPARE(signal.signedRaw(data.data()), qint64(-2));
        QCOMPARE(signal.decode(data.data()), -2.0);
    }
}

void tst_DbcSignal::encodingRoundsToTheNearestRawValue()
{
    DbcSignal signal = place(0, 8, DbcSignal::Intel, DbcSignal::Signed);
    signal.factor = 0.1;
    Bytes data{};
    QCOMPARE(signal.encode(data.data(), 0.3), DbcSignal::Fits);  // 0.3 / 0.1 is 2.9999999999999996
    QCOMPARE(signal.signedRaw(data.data()), qint64(3));
    signal.encode(data.data(), -0.26);
    QCOMPARE(signal.signedRaw(data.data()), qint64(-3));
}

void tst_DbcSignal::valuesOutOfRangeAreSaturated_data()
{
    QTest::addColumn<int>("length");
    QTest::addColumn<bool>("isSigned");
    QTest::addColumn<double>("value");
    QTest::addColumn<bool>("fits");
    QTest::addColumn<quint64>("bits");
    const auto row = [](const char *name, int length, bool isSigned, double value, bool fits, quint64 bits) {
        QTest::newRow(name) << length << isSigned << value << fits << bits;
    };
    const double infinity = std::numeric_limits<double>::infinity();
    row("largest of 8", 8, false, 255.0, true, 255);
    row("rounded down to the largest of 8", 8, false, 255.4, true, 255);
    row("rounded up beyond the largest of 8", 8, false, 255.5, false, 255);
    row("below 0", 8, false, -0.6, false, 0);
    row("rounded up to 0", 8, false, -0.4, true, 0);
    row("infinite", 8, false, infinity, false, 255);
    row("largest with sign", 8, true, 127.0, true, 127);
    row("beyond it", 8, true, 128.0, false, 127);
    row("smallest with sign", 8, true, -128.0, true, 0x80);
    row("beyond it ", 8, true, -129.0, false, 0x80);
    row("minus infinite", 16, true, -infinity, false, 0x8000);
    row("one bit with sign", 1, true, -1.0, true, 1);
    row("one bit with sign, 1", 1, true, 1.0, false, 0);
    row("64 bits", 64, false, 18446744073709549568.0, true, 18446744073709549568U);
    row("beyond 64 bits", 64, false, 18446744073709551616.0, false, ~quint64(0));
    row("64 bits with sign", 64, true, -9223372036854775808.0, true, quint64(1) << 63);
    row("beyond 64 bits with sign", 64, true, 9223372036854775808.0, false, (quint64(1) << 63) - 1);
}

void tst_DbcSignal::valuesOutOfRangeAreSaturated()
{
    QFETCH(int, length);
    QFETCH(bool, isSigned);
    QFETCH(double, value);
    QFETCH(bool, fits);
    QFETCH(quint64, bits);
    const DbcSignal signal = place(0, length, DbcSignal::Intel, isSigned ? DbcSignal::Signed : DbcSignal::Unsigned);
    Bytes data{};
    QCOMPARE(signal.encode(data.data(), value), fits ? DbcSignal::Fits : DbcSignal::Saturated);
    QCOMPARE(signal.bits(data.data()), bits);
}

void tst_DbcSignal::notANumberIsReportedAndEncodedAsZero()
{
    const DbcSignal signal = place(0, 8, DbcSignal::Intel);
    Bytes data;
    data.fill(0xFF);
    QCOMPARE(signal.encode(data.data(), std::numeric_limits<double>::quiet_NaN()), DbcSignal::NoNumber);
    QCOMPARE(signal.bits(data.data()), quint64(0));
}

void tst_DbcSignal::floatsAreEncodedAsIeee754()
{
    Bytes data{};
    const DbcSignal single = place(7, 32, DbcSignal::Motorola, DbcSignal::Float32);
    QCOMPARE(single.encode(data.data(), -2.5), DbcSignal::Fits);
    QCOMPARE(hex(data, 4), QByteArray("c0200000"));
    QCOMPARE(single.decode(data.data()), -2.5);
    const DbcSignal twice = place(0, 64, DbcSignal::Intel, DbcSignal::Float64);
    twice.encode(data.data(), 0.1);
    QCOMPARE(twice.decode(data.data()), 0.1);
    QCOMPARE(single.encode(data.data(), std::numeric_limits<double>::quiet_NaN()), DbcSignal::Fits);
    QVERIFY(std::isnan(single.decode(data.data())));
}

void tst_DbcSignal::largeDoubleSaturatesToTheLargestFloat()
{
    Bytes data{};
    const DbcSignal single = place(0, 32, DbcSignal::Intel, DbcSignal::Float32);
    QCOMPARE(single.encode(data.data(), -1e300), DbcSignal::Saturated);
    QCOMPARE(single.decode(data.data()), double(std::numeric_limits<float>::lowest()));
}

void tst_DbcSignal::all64BitsAreExact()
{
    const DbcSignal signal = place(5, 64, DbcSignal::Intel, DbcSignal::Signed);
    Bytes data{};
    signal.setBits(data.data(), 0x8000000000000001U);
    QCOMPARE(signal.bits(data.data()), quint64(0x8000000000000001U));
    QCOMPARE(signal.signedRaw(data.data()), std::numeric_limits<qint64>::min() + 1);
}

QTEST_APPLESS_MAIN(tst_DbcSignal)
#include "tst_DbcSignal.moc"
