// SPDX-License-Identifier: Apache-2.0
#include "../DriverBench.h"
#include "../FakeDevices.h"
#include "hardware/spi/FakeMcp3208.h"

#include <QtTest/QtTest>

using namespace qplc;

namespace {

struct Converter
{
    explicit Converter(const QByteArray &keys = {})
        : bench(QStringLiteral("mcp3208"), "device = fake:adc\n" + keys)
    {
        QString error;
        if (!memory.create(QStringLiteral("fake:adc"), FakeMcp3208::Size, &error))
            qFatal("%s", qPrintable(error));
        memory.at(FakeMcp3208::Power) = 1;
    }
    void set(int input, int counts)
    {
        const std::size_t place = FakeMcp3208::Inputs + 2 * std::size_t(input);
        memory.at(place) = quint8(counts & 0xff);
        memory.at(place + 1) = quint8(counts >> 8);
    }

    const FakeDevices devices;
    FakeMemory memory;
    DriverBench bench;
};

}  // namespace

class tst_Mcp3208 : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void transfersFollowTheDataSheet();
    void eachInputIsAVoltage();
    void differencesAreOfNeighboursAndNeverNegative();
    void aChipWithoutPowerIsNamed();
    void aBusThatIsUnpluggedIsAnError();
    void invalidKeysAreRefused();
    void aMissingDeviceIsNamedWithTheRemedy();
};

// As its data sheet draws it: 5 zeros, start, single-ended, 3 bits of the input, one clock of
// sampling, a zero, 12 bits.
void tst_Mcp3208::transfersFollowTheDataSheet()
{
    Converter converter;
    converter.set(6, 0xabc);
    converter.set(7, 0x001);
    QString error;
    const auto chip = FakeMcp3208::open("fake:adc", &error);
    QVERIFY2(chip, qPrintable(error));
    quint8 answer[3] = {};
    const quint8 single[] = {0x07, 0x80, 0x00};
    QVERIFY(chip->transfer(single, answer, 3));
    QCOMPARE(int(answer[1] & 0x1f) << 8 | answer[2], 0xabc);
    const quint8 difference[] = {0x05, 0x80, 0x00};
    QVERIFY(chip->transfer(difference, answer, 3));
    QCOMPARE(int(answer[1] & 0x1f) << 8 | answer[2], 0xabb);
    const quint8 nothing[] = {0x00, 0x00, 0x00};
    QVERIFY(chip->transfer(nothing, answer, 3));
    QCOMPARE(int(answer[1]) << 8 | answer[2], 0xffff);
}

void tst_Mcp3208::eachInputIsAVoltage()
{
    Converter converter("reference = 4.096\n");
    QCOMPARE(converter.bench.errors(), QString());
    for (int i = 0; i < 8; ++i) {
        QCOMPARE(converter.bench.wireRead(QString("voltage%1").arg(i)), QString());
        converter.set(i, 500 * i + 1);
    }
    QVERIFY2(converter.bench.open(), qPrintable(converter.bench.errorString()));
    QVERIFY(converter.bench.exchange());
    for (int i = 0; i < 8; ++i)
        QCOMPARE(converter.bench.value(QString("voltage%1").arg(i)), 0.5 * i + 0.001);
    converter.set(7, 4095);
    QVERIFY(converter.bench.exchange());
    QCOMPARE(converter.bench.value("voltage7"), 4.095);
}

void tst_Mcp3208::differencesAreOfNeighboursAndNeverNegative()
{
    Converter converter("reference = 4.096\nmode = 3\nspeed = 500000\n");
    for (const char *name : {"difference01", "difference10", "difference76"})
        QCOMPARE(converter.bench.wireRead(name), QString());
    QVERIFY(converter.bench.wireRead("difference12").contains("'difference10'"));
    converter.set(0, 1500);
    converter.set(1, 500);
    converter.set(7, 2);
    QVERIFY2(converter.bench.open(), qPrintable(converter.bench.errorString()));
    QVERIFY(converter.bench.exchange());
    QCOMPARE(converter.bench.value("difference01"), 1.0);
    QCOMPARE(converter.bench.value("difference10"), 0.0);
    QCOMPARE(converter.bench.value("difference76"), 0.002);
}

void tst_Mcp3208::aChipWithoutPowerIsNamed()
{
    Converter converter;
    converter.bench.wireRead("voltage0");
    QVERIFY2(converter.bench.open(), qPrintable(converter.bench.errorString()));
    converter.memory.at(FakeMcp3208::Power) = 0;
    QVERIFY(!converter.bench.exchange());
    QVERIFY(!converter.bench.isFresh("voltage0"));
    QVERIFY2(converter.bench.errorString().contains("no MCP3208 answers at fake:adc")
                 && converter.bench.errorString().contains("MISO"),
             qPrintable(converter.bench.errorString()));
}

void tst_Mcp3208::aBusThatIsUnpluggedIsAnError()
{
    Converter converter;
    converter.bench.wireRead("voltage0");
    QVERIFY2(converter.bench.open(), qPrintable(converter.bench.errorString()));
    FakeMemory::remove("fake:adc");
    QVERIFY(!converter.bench.exchange());
    QVERIFY2(converter.bench.errorString().contains("fake:adc")
                 && converter.bench.errorString().contains("plug its adapter in again"),
             qPrintable(converter.bench.errorString()));
}

void tst_Mcp3208::invalidKeysAreRefused()
{
    const Converter converter("reference = 12\nspeed = 5000000\nmode = 1\n");
    const QString errors = converter.bench.errors();
    QVERIFY2(errors.contains("reference = '12'") && errors.contains("speed = '5000000'")
                 && errors.contains("mode = '1'"),
             qPrintable(errors));
}

void tst_Mcp3208::aMissingDeviceIsNamedWithTheRemedy()
{
    DriverBench bench(QStringLiteral("mcp3208"), "device = /dev/spidev98.7\n");
    QVERIFY(!bench.open());
    QVERIFY2(bench.errorString().contains("/dev/spidev98.7")
                 && bench.errorString().contains("No such file or directory; "),
             qPrintable(bench.errorString()));
}

QTEST_GUILESS_MAIN(tst_Mcp3208)
#include "tst_Mcp3208.moc"
