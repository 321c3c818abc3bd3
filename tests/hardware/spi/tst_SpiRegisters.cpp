// SPDX-License-Identifier: Apache-2.0
#include "../DriverBench.h"
#include "../FakeDevices.h"
#include "hardware/spi/FakeSpiRegisters.h"

#include <QtTest/QtTest>

using namespace qplc;
using namespace std::chrono_literals;

namespace {

struct Chip
{
    explicit Chip(const QByteArray &keys, quint8 readBit = 0x80)
        : bench(QStringLiteral("spi-registers"), "device = fake:chip\n" + keys)
    {
        QString error;
        if (!memory.create(QStringLiteral("fake:chip"), FakeSpiRegisters::Size, &error))
            qFatal("%s", qPrintable(error));
        memory.at(FakeSpiRegisters::Power) = 1;
        memory.at(FakeSpiRegisters::ReadBit) = readBit;
        memory.at(FakeSpiRegisters::CommandSize) = 1;
        set(0x0f, QByteArray("\x33"));
    }
    void set(int first, const QByteArray &bytes)
    {
        for (int i = 0; i < bytes.size(); ++i)
            memory.at(FakeSpiRegisters::FirstRegister + std::size_t(first + i)) = quint8(bytes.at(i));
    }
    QByteArray get(int first, int count) const
    {
        QByteArray bytes;
        for (int i = 0; i < count; ++i)
            bytes.append(char(memory.at(FakeSpiRegisters::FirstRegister + std::size_t(first + i)).load()));
        return bytes;
    }

    const FakeDevices devices;
    FakeMemory memory;
    DriverBench bench;
};

}  // namespace

class tst_SpiRegisters : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void registersAreReadAndWritten();
    void theMarkOfReadingIsThatOfTheChip();
    void bytesWithoutAMeaningAreLeftOut();
    void registersMayHaveNumbersOf16Bits();
    void aChipWithoutRegistersSendsPlainBytes();
    void aShiftRegisterTakesPlainBytes();
    void writtenBitsLeaveTheOthers();
    void aChipThatIsGoneIsNoticedByItsIdentity();
    void anotherChipIsRefused();
    void aBusThatIsUnpluggedIsAnError();
    void invalidKeysAreRefused_data();
    void invalidKeysAreRefused();
};

void tst_SpiRegisters::registersAreReadAndWritten()
{
    Chip chip("identity = 0x0f 0x33\nsetup = 0x20 0x57\nregister.x = 0x28, int16 little-endian, factor 0.5\n"
              "register.limit = 0x30, uint16, write\n");
    QCOMPARE(chip.bench.errors() + chip.bench.wireRead("x") + chip.bench.wireWrite("limit"), QString());
    chip.set(0x28, QByteArray::fromHex("feff"));
    QVERIFY2(chip.bench.open(), qPrintable(chip.bench.errorString()));
    QCOMPARE(chip.get(0x20, 1), QByteArray("\x57"));
    QVERIFY(chip.bench.exchange());
    QCOMPARE(chip.bench.value("x"), -1.0);
    QCOMPARE(chip.get(0x30, 2), QByteArray(2, '\0'));  // no value yet
    chip.bench.set("limit", 258.0);
    QVERIFY(chip.bench.exchange());
    QCOMPARE(chip.get(0x30, 2), QByteArray("\x01\x02"));
}

void tst_SpiRegisters::theMarkOfReadingIsThatOfTheChip()
{
    Chip chip("identity = 0x0f 0x33\nread-mask = 0x40\nregister.a = 0x0f\n", 0x40);
    chip.bench.wireRead("a");
    QVERIFY2(chip.bench.open(), qPrintable(chip.bench.errorString()));
    Chip wrong("identity = 0x0f 0x33\nregister.a = 0x0f\n", 0x40);
    wrong.bench.wireRead("a");
    QVERIFY(!wrong.bench.open());
    QVERIFY2(wrong.bench.errorString().contains("'read-mask'"), qPrintable(wrong.bench.errorString()));
}

void tst_SpiRegisters::bytesWithoutAMeaningAreLeftOut()
{
    Chip chip("identity = 0x0f 0x33\ndummy-bytes = 1\nregister.a = 0x10, uint16\n");
    chip.memory.at(FakeSpiRegisters::DummyBytes) = 1;
    chip.set(0x10, QByteArray("\x01\x02"));
    chip.bench.wireRead("a");
    QVERIFY2(chip.bench.open(), qPrintable(chip.bench.errorString()));
    QVERIFY(chip.bench.exchange());
    QCOMPARE(chip.bench.value("a"), 258.0);
}

void tst_SpiRegisters::registersMayHaveNumbersOf16Bits()
{
    Chip chip("identity = 0x000f 0x33\nregister-numbers = 16 bits\nread-mask = 0x8000\nregister.a = 0x1234, uint16\n"
              "register.b = 0x2000, write\n");
    QCOMPARE(chip.bench.errors() + chip.bench.wireRead("a") + chip.bench.wireWrite("b"), QString());
    chip.memory.at(FakeSpiRegisters::CommandSize) = 2;
    chip.set(0x1234, QByteArray("\x01\x02"));
    QVERIFY2(chip.bench.open(), qPrintable(chip.bench.errorString()));
    chip.bench.set("b", 7.0);
    QVERIFY(chip.bench.exchange());
    QCOMPARE(chip.bench.value("a"), 258.0);
    QCOMPARE(chip.get(0x2000, 1), QByteArray("\x07"));
}

// As a converter for thermocouples: 14 bits with a sign at the left of 32, and a bit for an error.
void tst_SpiRegisters::aChipWithoutRegistersSendsPlainBytes()
{
    Chip chip("register.temperature = plain, int32, bits 18-31, factor 0.25\nregister.fault = plain, uint32, bit 16\n");
    QCOMPARE(chip.bench.errors() + chip.bench.wireRead("temperature") + chip.bench.wireRead("fault"), QString());
    chip.memory.at(FakeSpiRegisters::CommandSize) = 0;
    QVERIFY2(chip.bench.open(), qPrintable(chip.bench.errorString()));
    for (const auto &[hex, temperature, fault] :
         {std::tuple{"06400000", 100.0, 0.0}, {"fff00000", -1.0, 0.0}, {"00010001", 0.0, 1.0}}) {
        chip.set(0, QByteArray::fromHex(hex));
        QVERIFY(chip.bench.exchange());
        QCOMPARE(chip.bench.value("temperature"), temperature);
        QCOMPARE(chip.bench.value("fault"), fault);
    }
}

void tst_SpiRegisters::aShiftRegisterTakesPlainBytes()
{
    Chip chip("register.valves = plain, uint16, write\n");
    QCOMPARE(chip.bench.errors() + chip.bench.wireWrite("valves"), QString());
    chip.memory.at(FakeSpiRegisters::CommandSize) = 0;
    QVERIFY2(chip.bench.open(), qPrintable(chip.bench.errorString()));
    chip.bench.set("valves", 0xa55a);
    QVERIFY(chip.bench.exchange());
    QCOMPARE(chip.get(0x100, 2).toHex(), QByteArray("a55a"));
}

void tst_SpiRegisters::writtenBitsLeaveTheOthers()
{
    Chip chip("identity = 0x0f 0x33\nregister.gain = 0x20, bits 4-6, write\n");
    chip.bench.wireWrite("gain");
    chip.set(0x20, QByteArray("\xff"));
    QVERIFY2(chip.bench.open(), qPrintable(chip.bench.errorString()));
    chip.bench.set("gain", 2.0);
    QVERIFY(chip.bench.exchange());
    QCOMPARE(chip.get(0x20, 1), QByteArray("\xaf"));
}

void tst_SpiRegisters::aChipThatIsGoneIsNoticedByItsIdentity()
{
    Chip chip("identity = 0x0f 0x33\ntimeout = 30 ms\nregister.a = 0x10\n");
    chip.bench.wireRead("a");
    chip.bench.wireRead("@errors");
    chip.set(0x10, QByteArray("\x05"));
    QVERIFY2(chip.bench.open(), qPrintable(chip.bench.errorString()));
    QVERIFY(chip.bench.exchange());
    chip.memory.at(FakeSpiRegisters::Power) = 0;
    chip.bench.advance(20ms);
    QVERIFY(chip.bench.exchange());
    QCOMPARE(chip.bench.value("a"), 5.0);  // held, and not 255
    QCOMPARE(chip.bench.value("@errors"), 1.0);
    chip.bench.advance(20ms);
    QVERIFY(!chip.bench.exchange());
    QVERIFY(!chip.bench.isFresh("a"));
    QVERIFY2(chip.bench.errorString().contains("register 0x0f of the device at fake:chip is 0xff, and not 0x33")
                 && chip.bench.errorString().contains("look at its power, at MISO"),
             qPrintable(chip.bench.errorString()));
}

void tst_SpiRegisters::anotherChipIsRefused()
{
    Chip chip("identity = 0x0f 0x44\nsetup = 0x20 1\nregister.a = 0x10\n");
    QVERIFY(!chip.bench.open());
    QVERIFY2(chip.bench.errorString().contains("is 0x33, and not 0x44"), qPrintable(chip.bench.errorString()));
    QCOMPARE(chip.get(0x20, 1), QByteArray(1, '\0'));
}

void tst_SpiRegisters::aBusThatIsUnpluggedIsAnError()
{
    Chip chip("identity = 0x0f 0x33\nregister.a = 0x10\n");
    chip.bench.wireRead("a");
    QVERIFY2(chip.bench.open(), qPrintable(chip.bench.errorString()));
    FakeMemory::remove("fake:chip");
    QVERIFY(!chip.bench.exchange());
    QVERIFY2(chip.bench.errorString().contains("the device at fake:chip")
                 && chip.bench.errorString().contains("plug its adapter in again"),
             qPrintable(chip.bench.errorString()));
}

void tst_SpiRegisters::invalidKeysAreRefused_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<QString>("part");
    QTest::newRow("no register") << QByteArray() << "register.NAME";
    QTest::newRow("mode") << QByteArray("register.a = 1\nmode = 4\n") << "from 0 to 3";
    QTest::newRow("dummy bytes") << QByteArray("register.a = 1\ndummy-bytes = 5\n") << "from 0 to 4";
    QTest::newRow("mask of a wide number") << QByteArray("register.a = 1\nread-mask = 0x8000\n")
                                           << "read-mask = '0x8000' is not a whole number from 0 to 255";
}

void tst_SpiRegisters::invalidKeysAreRefused()
{
    QFETCH(QByteArray, keys);
    QFETCH(QString, part);
    const DriverBench bench(QStringLiteral("spi-registers"), "device = fake:chip\n" + keys);
    QVERIFY2(bench.errors().contains(part), qPrintable(bench.errors()));
}

QTEST_GUILESS_MAIN(tst_SpiRegisters)
#include "tst_SpiRegisters.moc"
