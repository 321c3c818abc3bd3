// SPDX-License-Identifier: Apache-2.0
#include "../DriverBench.h"
#include "QPlcHardwareNode.h"
#include "hardware/modbus/FakeModbusDevice.h"

#include <QtTest/QtTest>

using qplc::FakeModbusDevice;
using qplc::ModbusException;
using qplc::ModbusRegister;
using qplc::ModbusRequest;
using namespace std::chrono_literals;
using Words = std::vector<quint16>;

// The driver with a device of this process: what it asks for, what it makes of the answers, what it
// says.
class tst_ModbusDriver : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_device = FakeModbusDevice::named("drive"); }
    void cleanup() { m_device.reset(); }

    void channelsAreReadByName();
    void driverReadsOnlyWiredRegisters();
    void aChannelMayBeReadAndWritten();
    void neighboursAreWrittenInOneRequest();
    void writeSingleCanBeDisabled();
    void writtenBitsLeaveTheOthers();
    void writtenBitsAndTheirNeighboursAreOneRequest();
    void bitsThatFillARegisterNeedNoReading();
    void valuesAreWrittenInEveryCycle();
    void valuesMayBeWrittenWhenTheyChange();
    void afterALossAllIsWrittenAgain();
    void notANumberMakesTheValueStale();
    void severalUnitsShareADevice();
    void anExceptionNamesTheRegistersInWords_data();
    void anExceptionNamesTheRegistersInWords();
    void aRefusedWriteNamesItsRegister();
    void aBusyDeviceIsAskedAgainForAWhile();
    void aBadAnswerIsAskedForAgain();
    void valuesAreHeldAfterBadAnswersUntilTheirTimeout();
    void aSilentUnitLeavesTheOthersAlone();
    void aSilentUnitIsAskedAgainAfterTheOthers();
    void aSilentUnitIsNotCalledSafe();
    void aUnitThatRefusesIsLostAlone();
    void aUnitThatIsBackGetsAllValuesAgain();
    void onePercentOfBadAnswersCostsNoValue();
    void missingDeviceIsReported();
    void lostDeviceHasNoFreshValues();
    void writingAReadOnlyRegisterIsRefused();
    void onePlaceHasOneWriter();
    void invalidKeysAreReported_data();
    void invalidKeysAreReported();

private:
    static void expectLoss() { QTest::ignoreMessage(QtWarningMsg, QRegularExpression("unit is lost; trying again")); }
    static QByteArray keys(const QByteArray &more) { return "device = fake:drive\n" + more; }
    std::shared_ptr<FakeModbusDevice> m_device;
};

void tst_ModbusDriver::channelsAreReadByName()
{
    DriverBench bench("modbus",
                      keys("register.speed = holding 100, int16, factor 0.1\nregister.ready = discrete 3\n"
                           "register.position = input 7, int32, word-order little\n"));
    QCOMPARE(bench.errors(), QString());
    for (const char *name : {"speed", "ready", "position"})
        QCOMPARE(bench.wireRead(name), QString());
    m_device->set(ModbusRegister::Holding, 100, {quint16(-125)});
    m_device->set(ModbusRegister::Discrete, 3, {1});
    m_device->set(ModbusRegister::Input, 7, {0x5678, 0x1234});
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    QVERIFY(!bench.isFresh("speed"));
    QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    QCOMPARE(bench.value("speed"), -12.5);
    QCOMPARE(bench.value("ready"), 1.0);
    QCOMPARE(bench.value("position"), double(0x12345678));
    bench.advance(31ms);
    QVERIFY(!bench.isFresh("speed"));
}

void tst_ModbusDriver::driverReadsOnlyWiredRegisters()
{
    DriverBench bench("modbus", keys("register.a = holding 1\nregister.b = holding 2\nregister.c = holding 3\n"));
    bench.wireRead("a");
    bench.wireRead("b");
    QVERIFY(bench.open());
    const std::vector<ModbusRequest> reads = m_device->takeReads();
    QCOMPARE(reads.size(), std::size_t(1));
    QCOMPARE(reads[0].first, quint16(1));
    QCOMPARE(reads[0].count, 2);
    QVERIFY(m_device->takeWrites().empty());
}

void tst_ModbusDriver::aChannelMayBeReadAndWritten()
{
    DriverBench bench("modbus", keys("register.torque = holding 5, int16\n"));
    QCOMPARE(bench.wireRead("torque"), QString());
    QCOMPARE(bench.wireWrite("torque"), QString());
    QVERIFY(bench.open());
    QVERIFY(bench.exchange());
    QVERIFY(m_device->takeWrites().empty());  // nobody has said a value
    bench.set("torque", -7.0);
    QVERIFY(bench.exchange());
    QCOMPARE(m_device->values(ModbusRegister::Holding, 5, 1), Words{quint16(-7)});
    QCOMPARE(bench.value("torque"), -7.0);
}

void tst_ModbusDriver::neighboursAreWrittenInOneRequest()
{
    DriverBench bench("modbus",
                      keys("register.a = holding 10, int32\nregister.b = holding 12\nregister.on = coil 4\n"));
    for (const char *name : {"a", "b", "on"})
        bench.wireWrite(name);
    QVERIFY(bench.open());
    bench.set("a", 65537.0);
    bench.set("b", 3.0);
    bench.set("on", 1.0);
    QVERIFY(bench.exchange());
    const std::vector<ModbusRequest> writes = m_device->takeWrites();
    QCOMPARE(writes.size(), std::size_t(2));
    QVERIFY(writes[0].isSingle);
    QCOMPARE(writes[1].count, 3);
    QVERIFY(!writes[1].isSingle);
    QCOMPARE(m_device->values(ModbusRegister::Holding, 10, 3), (Words{1, 1, 3}));
    QCOMPARE(m_device->values(ModbusRegister::Coil, 4, 1), Words{1});
}

void tst_ModbusDriver::writeSingleCanBeDisabled()
{
    DriverBench bench("modbus", keys("write-single = no\nregister.a = holding 10\n"));
    bench.wireWrite("a");
    QVERIFY(bench.open());
    bench.set("a", 1.0);
    QVERIFY(bench.exchange());
    QVERIFY(!m_device->takeWrites().at(0).isSingle);
}

/// Several writers have bits of one register, and the device has the rest.
void tst_ModbusDriver::writtenBitsLeaveTheOthers()
{
    DriverBench bench("modbus",
                      keys("register.enable = holding 30, bit 0\nregister.mode = holding 30, bits 4-7\n"
                           "register.swapped = holding 40, bit 0, byte-order little\n"));
    QCOMPARE(bench.wireWrite("enable") + bench.wireWrite("mode") + bench.wireWrite("swapped"), QString());
    m_device->set(ModbusRegister::Holding, 30, {0xA5F0});
    bench.set("enable", 1.0);
    bench.set("mode", 3.0);
    bench.set("swapped", 1.0);
    bench.exchange();
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    QCOMPARE(m_device->values(ModbusRegister::Holding, 30, 1), Words{0xA531});
    QCOMPARE(m_device->values(ModbusRegister::Holding, 40, 1), Words{0x0100});
    QVERIFY(bench.runner().isDelivered());
    m_device->set(ModbusRegister::Holding, 30, {0x25FE});  // by the device itself
    bench.set("enable", 0.0);
    QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    QCOMPARE(m_device->values(ModbusRegister::Holding, 30, 1), Words{0x253E});
    m_device->answerWith(ModbusException::UnknownAddress, ModbusRegister::Holding, 30);
    QVERIFY(!bench.exchange());
    QVERIFY2(bench.errorString().contains("cannot read holding register 30 (enable, mode) of unit 1"),
             qPrintable(bench.errorString()));
    m_device->answerWith(ModbusException::None, ModbusRegister::Holding, 30);
}

void tst_ModbusDriver::writtenBitsAndTheirNeighboursAreOneRequest()
{
    DriverBench bench("modbus",
                      keys("write = on-change\nregister.before = holding 9\nregister.bit = holding 10, bit 15\n"
                           "register.other = holding 10, bit 1\nregister.after = holding 11, int32\n"));
    const QStringList names{"before", "bit", "other", "after"};
    for (const QString &name : names)
        QCOMPARE(bench.wireWrite(name), QString());
    for (const QString &name : names)
        bench.set(name, 1.0);
    bench.exchange();
    QVERIFY(bench.open());
    QCOMPARE(m_device->takeWrites().size(), std::size_t(1));
    QCOMPARE(m_device->values(ModbusRegister::Holding, 9, 4), (Words{1, 0x8002, 0, 1}));
    m_device->takeReads();
    QVERIFY(bench.exchange());
    QVERIFY(m_device->takeWrites().empty() && m_device->takeReads().empty());
    bench.set("bit", 0.0);
    QVERIFY(bench.exchange());
    QCOMPARE(m_device->takeWrites().size(), std::size_t(1));
    QCOMPARE(m_device->values(ModbusRegister::Holding, 9, 4), (Words{1, 0x0002, 0, 1}));
    QVERIFY(bench.runner().isDelivered());
}

void tst_ModbusDriver::bitsThatFillARegisterNeedNoReading()
{
    DriverBench bench("modbus", keys("register.low = holding 5, bits 0-7\nregister.high = holding 5, bits 8-15\n"));
    QCOMPARE(bench.wireWrite("low") + bench.wireWrite("high"), QString());
    bench.set("low", 0x34);
    bench.set("high", 0x12);
    bench.exchange();
    QVERIFY(bench.open());
    QCOMPARE(m_device->values(ModbusRegister::Holding, 5, 1), Words{0x1234});
    QVERIFY(m_device->takeReads().empty());
}

void tst_ModbusDriver::valuesAreWrittenInEveryCycle()
{
    DriverBench bench("modbus", keys("register.a = holding 10\n"));
    bench.wireWrite("a");
    QVERIFY(bench.open());
    bench.set("a", 1.0);
    for (int i = 0; i < 3; ++i)
        QVERIFY(bench.exchange());
    QCOMPARE(m_device->takeWrites().size(), std::size_t(3));
}

void tst_ModbusDriver::valuesMayBeWrittenWhenTheyChange()
{
    DriverBench bench("modbus", keys("write = on-change\nregister.a = holding 10\nregister.b = holding 11\n"));
    bench.wireWrite("a");
    bench.wireWrite("b");
    QVERIFY(bench.open());
    bench.set("a", 1.0);
    bench.set("b", 2.0);
    QVERIFY(bench.exchange());
    m_device->takeWrites();
    bench.set("a", 1.2);  // the same for the device
    QVERIFY(bench.exchange());
    QVERIFY(m_device->takeWrites().empty());
    bench.set("b", 5.0);
    QVERIFY(bench.exchange());
    QCOMPARE(m_device->takeWrites().at(0).first, quint16(11));
    QCOMPARE(m_device->values(ModbusRegister::Holding, 10, 2), (Words{1, 5}));
}

void tst_ModbusDriver::afterALossAllIsWrittenAgain()
{
    DriverBench bench("modbus", keys("write = on-change\nregister.a = holding 10\n"));
    bench.wireWrite("a");
    QVERIFY(bench.open());
    bench.set("a", 1.0);
    QVERIFY(bench.exchange());
    bench.close();
    m_device->set(ModbusRegister::Holding, 10, {0});  // it was switched off
    QVERIFY(bench.open());
    QVERIFY(bench.exchange());
    QCOMPARE(m_device->values(ModbusRegister::Holding, 10, 1), Words{1});
}

void tst_ModbusDriver::notANumberMakesTheValueStale()
{
    DriverBench bench("modbus", keys("register.level = input 0, float32\n"));
    bench.wireRead("level");
    m_device->set(ModbusRegister::Input, 0, {0x3f80, 0});
    QVERIFY(bench.open() && bench.exchange());
    QCOMPARE(bench.value("level"), 1.0);
    m_device->set(ModbusRegister::Input, 0, {0x7fc0, 0});  // how a device says that its sensor is broken
    QVERIFY(bench.exchange());
    QVERIFY(!bench.isFresh("level"));
}

void tst_ModbusDriver::severalUnitsShareADevice()
{
    DriverBench bench("modbus", keys("unit = 3\nregister.a = holding 1\nregister.b = holding 2, unit 4\n"));
    bench.wireRead("a");
    bench.wireRead("b");
    m_device->set(ModbusRegister::Holding, 1, {10, 11}, 3);
    m_device->set(ModbusRegister::Holding, 1, {20, 21}, 4);
    QVERIFY(bench.open() && bench.exchange());
    QCOMPARE(bench.value("a"), 10.0);
    QCOMPARE(bench.value("b"), 21.0);
}

void tst_ModbusDriver::anExceptionNamesTheRegistersInWords_data()
{
    QTest::addColumn<int>("exception");
    QTest::addColumn<QString>("words");
    QTest::newRow("1") << 1 << "does not know this function (exception 1)";
    QTest::newRow("2") << 2 << "does not have all of these addresses (exception 2); they count from 0 here";
    QTest::newRow("3") << 3 << "refuses the value (exception 3)";
    QTest::newRow("4") << 4 << "it has failed (exception 4)";
    QTest::newRow("8") << 8 << "answers with exception 8";
    QTest::newRow("10") << 10 << "the gateway gets no answer from this unit";
}

void tst_ModbusDriver::anExceptionNamesTheRegistersInWords()
{
    QFETCH(int, exception);
    QFETCH(QString, words);
    DriverBench bench("modbus", keys("register.speed = holding 100\nregister.torque = holding 101\n"));
    bench.wireRead("speed");
    bench.wireRead("torque");
    QVERIFY(bench.open() && bench.exchange());
    m_device->answerWith(ModbusException(exception), ModbusRegister::Holding, 101);
    QVERIFY(!bench.exchange());
    const QString error = bench.errorString();
    QVERIFY2(error.startsWith("fake:drive: cannot read holding registers 100 ... 101 (speed, torque) of unit 1: "),
             qPrintable(error));
    QVERIFY2(error.contains(words), qPrintable(error));
    QVERIFY(!bench.isFresh("speed"));
}

void tst_ModbusDriver::aRefusedWriteNamesItsRegister()
{
    DriverBench bench("modbus", keys("register.limit = holding 7, unit 2\n"));
    bench.wireWrite("limit");
    QVERIFY(bench.open());
    m_device->answerWith(ModbusException::RefusedValue, ModbusRegister::Holding, 7);
    bench.set("limit", 5.0);
    QVERIFY(!bench.exchange());
    QVERIFY2(bench.errorString().contains("cannot write holding register 7 (limit) of unit 2: it refuses the value"),
             qPrintable(bench.errorString()));
}

void tst_ModbusDriver::aBusyDeviceIsAskedAgainForAWhile()
{
    DriverBench bench("modbus", keys("interval = 10 ms\ntimeout = 100 ms\nregister.a = holding 1\n"));
    bench.wireRead("a");
    QVERIFY(bench.open() && bench.exchange());
    m_device->answerWith(ModbusException::Busy, ModbusRegister::Holding, 1);
    for (int i = 1; i <= 10; ++i) {
        bench.advance(10ms);
        QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    }
    bench.advance(10ms);
    QVERIFY(!bench.exchange());
    QVERIFY2(bench.errorString().contains("busy for too long"), qPrintable(bench.errorString()));
}

void tst_ModbusDriver::aBadAnswerIsAskedForAgain()
{
    DriverBench bench("modbus", keys("retries = 1\nregister.a = holding 1\nregister.b = holding 1\n"));
    for (const char *name : {"a", "@errors", "@failures"})
        QCOMPARE(bench.wireRead(name), QString());
    bench.wireWrite("b");
    QVERIFY(bench.open() && bench.exchange());
    bench.advance(10ms);
    bench.set("b", 7.0);
    m_device->damageNext(1);  // that of the write
    QVERIFY(bench.exchange());
    QCOMPARE(bench.value("a"), 7.0);
    m_device->takeReads();
    m_device->damageNext(1);
    bench.set("b", 8.0);
    QVERIFY(bench.exchange());
    QCOMPARE(bench.value("a"), 8.0);
    QCOMPARE(bench.time("a"), bench.now());
    QCOMPARE(bench.value("@errors"), 2.0);
    QCOMPARE(bench.value("@failures"), 0.0);
}

void tst_ModbusDriver::valuesAreHeldAfterBadAnswersUntilTheirTimeout()
{
    DriverBench bench("modbus", keys("timeout = 30 ms\nregister.a = holding 1\n"));
    bench.wireRead("a");
    bench.wireRead("@errors");
    m_device->set(ModbusRegister::Holding, 1, {5});
    QVERIFY(bench.open() && bench.exchange());
    m_device->damageAnswers(1.0);
    for (int i = 1; i <= 3; ++i) {
        bench.advance(10ms);
        QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
        QCOMPARE(bench.value("a"), 5.0);
        QCOMPARE(bench.value("@errors"), 2.0 + i);  // three questions, then one in each turn
    }
    bench.advance(1ms);
    QVERIFY(!bench.exchange());
    QVERIFY(!bench.isFresh("a"));
    QVERIFY2(bench.errorString().contains("cannot read holding register 1 (a) of unit 1: the answer is damaged"),
             qPrintable(bench.errorString()));
    m_device->damageAnswers(0.0);
    QVERIFY(bench.open() && bench.exchange());
    QCOMPARE(bench.value("a"), 5.0);
}

void tst_ModbusDriver::aSilentUnitLeavesTheOthersAlone()
{
    DriverBench bench("modbus",
                      keys("timeout = 30 ms\nregister.a = holding 1\nregister.b = holding 1, unit 2\n"
                           "register.c = holding 9, unit 2\nregister.d = holding 1, unit 3\n"));
    for (const char *name : {"a", "b", "c", "d", "@online", "@online.2", "@errors.1", "@errors.2", "@errors"})
        QCOMPARE(bench.wireRead(name), QString());
    QVERIFY(bench.wireRead("@online.4").contains("has no channel '@online.4' to read; did you mean '@online"));
    QVERIFY(bench.open() && bench.exchange());
    QCOMPARE(bench.value("@online.2"), 1.0);
    expectLoss();
    m_device->damageAnswers(1.0, 2);
    m_device->takeReads();
    for (int i = 1; i <= 1000; ++i) {
        bench.advance(10ms);
        QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
        QVERIFY(bench.isFresh("a") && bench.isFresh("d"));
        QCOMPARE(bench.isFresh("b"), i <= 3);
        QCOMPARE(bench.isFresh("c"), i <= 3);
        QCOMPARE(bench.value("@online.2"), i <= 3 ? 1.0 : 0.0);
        QCOMPARE(bench.value("@online"), 1.0);
    }
    // Ten seconds: three questions, one in each of three turns, then after 0.1 s, 0.2 s, ... 3.2 s.
    QCOMPARE(bench.value("@errors.2"), 12.0);
    QCOMPARE(bench.value("@errors"), 12.0);
    QCOMPARE(bench.value("@errors.1"), 0.0);
    m_device->damageAnswers(0.0);
    bench.advance(5s);
    QVERIFY(bench.exchange());
    QVERIFY(bench.isFresh("b") && bench.isFresh("c"));
    QCOMPARE(bench.value("@online.2"), 1.0);
}

/// Its retries must not keep safe values from others.
void tst_ModbusDriver::aSilentUnitIsAskedAgainAfterTheOthers()
{
    DriverBench bench("modbus", keys("register.a = holding 1, unit 1\nregister.b = holding 2, unit 2\n"));
    QCOMPARE(bench.wireWrite("a") + bench.wireWrite("b"), QString());
    bench.set("a", 7.0, true);
    bench.set("b", 8.0, true);
    bench.exchange();
    m_device->damageAnswers(1.0, 1);
    expectLoss();
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    std::vector<int> units;
    for (const ModbusRequest &request : m_device->takeWrites())
        units.push_back(request.unit);
    QCOMPARE(units, (std::vector<int>{1, 2, 1, 1}));
    QVERIFY(!bench.runner().isDelivered());
    m_device->damageAnswers(0.0);
    bench.advance(200ms);
    QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    QVERIFY(bench.runner().isDelivered());
}

void tst_ModbusDriver::aSilentUnitIsNotCalledSafe()
{
    QPlcHardwareNode node;
    QVERIFY(node.configure("[node]\nname = A\n[io]\ndriver = modbus\ndevice = fake:drive\nregister.a = holding 1, unit "
                           "1\nregister.b = holding 2, unit 2\n[io.safe]\na = 7\nb = 8\n",
                           "a.ini"));
    m_device->damageAnswers(1.0, 1);
    expectLoss();
    const QStringList problems = node.makeSafe(300ms);
    QCOMPARE(problems.size(), 1);
    QVERIFY2(problems.first().startsWith("device 'io' has not taken its safe values: fake:drive: cannot write holding "
                                         "register 1 (a) of unit 1: the answer is damaged"),
             qPrintable(problems.first()));
    QCOMPARE(m_device->values(ModbusRegister::Holding, 2, 1, 2), Words{8});
    m_device->damageAnswers(0.0);
    node.closeDevices();
}

void tst_ModbusDriver::aUnitThatRefusesIsLostAlone()
{
    DriverBench bench("modbus", keys("register.a = holding 1\nregister.b = holding 7, unit 2\n"));
    bench.wireRead("a");
    bench.wireRead("b");
    QVERIFY(bench.open() && bench.exchange());
    QVERIFY(bench.isFresh("b"));
    expectLoss();
    m_device->answerWith(ModbusException::UnknownAddress, ModbusRegister::Holding, 7);
    QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    QVERIFY(bench.isFresh("a"));
    QVERIFY(!bench.isFresh("b"));
    bench.close();
    expectLoss();
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));  // the other unit has answered
    expectLoss();
    m_device->answerWith(ModbusException::UnknownAddress, ModbusRegister::Holding, 1);
    QVERIFY(!bench.exchange());
}

void tst_ModbusDriver::aUnitThatIsBackGetsAllValuesAgain()
{
    DriverBench bench("modbus",
                      keys("timeout = 30 ms\nwrite = on-change\nregister.a = holding 1\n"
                           "register.b = holding 1, unit 2\nregister.c = holding 2, unit 2\n"));
    bench.wireRead("a");
    bench.wireRead("c");
    bench.wireWrite("b");
    QVERIFY(bench.open());
    bench.set("b", 4.0);
    QVERIFY(bench.exchange());
    expectLoss();
    m_device->damageAnswers(1.0, 2);
    for (int i = 0; i < 5; ++i) {
        bench.advance(10ms);
        QVERIFY(bench.exchange());
    }
    m_device->set(ModbusRegister::Holding, 1, {0}, 2);  // it was switched off
    m_device->damageAnswers(0.0);
    bench.advance(5s);
    QVERIFY(bench.exchange());
    QCOMPARE(m_device->values(ModbusRegister::Holding, 1, 1, 2), Words{4});
}

// Ten minutes of a line with three units, in the time of the bench.
void tst_ModbusDriver::onePercentOfBadAnswersCostsNoValue()
{
    DriverBench bench("modbus",
                      keys("interval = 20 ms\nregister.a = holding 1\nregister.b = holding 1, unit 2\n"
                           "register.c = holding 1, unit 3\n"));
    for (const char *name : {"a", "b", "c", "@errors", "@failures"})
        bench.wireRead(name);
    QVERIFY(bench.open());
    m_device->damageAnswers(0.01);
    for (int turn = 0; turn < 10 * 60 * 50; ++turn) {
        bench.advance(20ms);
        m_device->set(ModbusRegister::Holding, 1, {quint16(turn)}, 2);
        QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
        QVERIFY(bench.isFresh("a") && bench.isFresh("b") && bench.isFresh("c"));
    }
    QVERIFY2(m_device->damaged() > 500, qPrintable(QString::number(m_device->damaged())));
    QCOMPARE(bench.value("@errors"), double(m_device->damaged()));
    QCOMPARE(bench.value("@failures"), 0.0);
}

void tst_ModbusDriver::missingDeviceIsReported()
{
    DriverBench bench("modbus", keys("register.a = holding 1\n"));
    bench.wireRead("a");
    m_device->setPresent(false);
    QVERIFY(!bench.open());
    QVERIFY2(bench.errorString().startsWith("fake:drive: "), qPrintable(bench.errorString()));
    m_device->setPresent(true);
    QVERIFY(bench.open());
}

void tst_ModbusDriver::lostDeviceHasNoFreshValues()
{
    DriverBench bench("modbus", keys("register.a = holding 1\n"));
    bench.wireRead("a");
    QVERIFY(bench.open() && bench.exchange());
    m_device->setPresent(false);
    QVERIFY(!bench.exchange());
    QVERIFY(!bench.isFresh("a"));
    QVERIFY2(bench.errorString().contains("cannot read holding register 1 (a)"), qPrintable(bench.errorString()));
    m_device->setPresent(true);
    QVERIFY(bench.open() && bench.exchange());
    QVERIFY(bench.isFresh("a"));
}

void tst_ModbusDriver::writingAReadOnlyRegisterIsRefused()
{
    DriverBench bench("modbus", keys("register.a = input 1\nregister.b = discrete 1\nregister.c = input 1, bit 3\n"));
    QCOMPARE(bench.errors(), QString());
    QCOMPARE(bench.wireWrite("a"), QString("'a' can only be read: it is of the input registers"));
    QCOMPARE(bench.wireWrite("b"), QString("'b' can only be read: it is of the discrete inputs"));
    QCOMPARE(bench.wireWrite("c"), QString("'c' can only be read: it is of the input registers"));
    QVERIFY(bench.wireRead("aa").contains("did you mean 'a'"));
}

void tst_ModbusDriver::onePlaceHasOneWriter()
{
    DriverBench bench("modbus", keys("register.a = holding 1, int32\nregister.b = holding 2\n"));
    QCOMPARE(bench.wireWrite("a"), QString());
    QCOMPARE(bench.wireWrite("b"), QString("'b' and 'a' are the same place of the device; write one of them"));
    QCOMPARE(bench.wireRead("b"), QString());
    DriverBench bits(
        "modbus",
        keys("register.a = holding 1, bits 2-4\nregister.b = holding 1, bit 4\nregister.c = holding 1, bit "
             "5\nregister.d = holding 1\n"));
    QCOMPARE(bits.wireWrite("a") + bits.wireWrite("c"), QString());
    QCOMPARE(bits.wireWrite("b"), QString("'b' and 'a' are the same place of the device; write one of them"));
    QCOMPARE(bits.wireWrite("d"), QString("'d' and 'a' are the same place of the device; write one of them"));
}

void tst_ModbusDriver::invalidKeysAreReported_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("error");
    const QByteArray a = "register.a = holding 1\n";
    QTest::newRow("no device") << a << "device";
    QTest::newRow("unknown way") << "device = udp:host\n" + a << "'udp:host' is not a Modbus device; write tcp:HOST";
    QTest::newRow("no registers") << QByteArray("device = fake:x\n") << "no register is named";
    QTest::newRow("register") << QByteArray("device = fake:x\nregister.a = holding\n")
                              << "4:14: 'holding' is not a place";
    QTest::newRow("misspelt") << "device = fake:x\nbuad = 9600\n" + a << "buad";
    QTest::newRow("gap") << "device = fake:x\ngap = -1\n" + a << "gap";
    QTest::newRow("write") << "device = fake:x\nwrite = never\n" + a << "never";
    QTest::newRow("fake without a name") << "device = fake:\n" + a << "is not a Modbus device";
}

void tst_ModbusDriver::invalidKeysAreReported()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, error);
    const DriverBench bench("modbus", text);
    QVERIFY2(bench.errors().contains(error), qPrintable(bench.errors()));
}

QTEST_GUILESS_MAIN(tst_ModbusDriver)
#include "tst_ModbusDriver.moc"
