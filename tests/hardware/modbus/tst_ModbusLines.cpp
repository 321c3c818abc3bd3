// SPDX-License-Identifier: Apache-2.0
#include "../DriverBench.h"
#include "ModbusServer.h"

#include <QtTest/QtTest>

#include <sys/file.h>

using namespace std::chrono_literals;

// The driver with a server of libmodbus, over TCP on loopback and over a serial line (a pseudo
// terminal).
class tst_ModbusLines : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everySpaceIsReadAndWritten_data() { lines(); }
    void everySpaceIsReadAndWritten();
    void everyTypeIsTransferredUnchanged_data() { lines(); }
    void everyTypeIsTransferredUnchanged();
    void requestsAreThoseOfTheProtocol_data() { lines(); }
    void requestsAreThoseOfTheProtocol();
    void unknownAddressIsReported_data() { lines(); }
    void unknownAddressIsReported();
    void aBusyDeviceIsNotLost_data() { lines(); }
    void aBusyDeviceIsNotLost();
    void aGarbledAnswerIsAskedForAgain_data() { lines(); }
    void aGarbledAnswerIsAskedForAgain();
    void silentDeviceIsLostAndReconnects_data() { lines(); }
    void silentDeviceIsLostAndReconnects();
    void anotherUnitDoesNotAnswer();
    void restartedServerIsLostAndReconnects();
    void missingServerIsReported();
    void unknownHostIsReported();
    void missingSerialDeviceIsReported();
    void busySerialLineIsReported();
    void invalidDeviceNamesAreReported_data();
    void invalidDeviceNamesAreReported();

private:
    static void lines()
    {
        QTest::addColumn<bool>("isSerial");
        QTest::newRow("TCP") << false;
        QTest::newRow("serial line") << true;
    }
    /// The server of this row of the data, and the keys that lead to it.
    void startServer()
    {
        QFETCH(bool, isSerial);
        m_server = isSerial ? ModbusServer::onSerialLine() : ModbusServer::onTcp();
        m_keys = isSerial ? "device = rtu:" + m_server->line().toLatin1() + "\nbaud = 115200\nparity = none\n"
                          : "device = tcp:127.0.0.1:" + QByteArray::number(m_server->port()) + "\n";
    }
    QByteArray keys(const QByteArray &more, const QByteArray &timeout = "5 s") const
    {
        return m_keys + "response-timeout = " + timeout + "\n" + more;
    }

    std::unique_ptr<ModbusServer> m_server;
    QByteArray m_keys;
};

void tst_ModbusLines::everySpaceIsReadAndWritten()
{
    startServer();
    DriverBench bench("modbus",
                      keys("register.coil = coil 199\nregister.switch = discrete 199\nregister.input = input 199\n"
                           "register.holding = holding 199\nregister.lamp = coil 3\nregister.force = holding 3\n"));
    for (const char *name : {"coil", "switch", "input", "holding"})
        QCOMPARE(bench.wireRead(name), QString());
    bench.wireWrite("lamp");
    bench.wireWrite("force");
    m_server->with([](modbus_mapping_t &values) {
        values.tab_bits[199] = values.tab_input_bits[199] = 1;
        values.tab_input_registers[199] = 1234;
        values.tab_registers[199] = 4321;
    });
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    bench.set("lamp", 1.0);
    bench.set("force", 77.0);
    QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    QCOMPARE(bench.value("coil"), 1.0);
    QCOMPARE(bench.value("switch"), 1.0);
    QCOMPARE(bench.value("input"), 1234.0);
    QCOMPARE(bench.value("holding"), 4321.0);
    QCOMPARE(m_server->with([](modbus_mapping_t &values) { return int(values.tab_bits[3]); }), 1);
    QCOMPARE(m_server->with([](modbus_mapping_t &values) { return int(values.tab_registers[3]); }), 77);
}

void tst_ModbusLines::everyTypeIsTransferredUnchanged()
{
    startServer();
    QByteArray registers;
    int address = 0;
    const QStringList types{"int16", "uint16", "int32", "uint32", "float32", "int64", "float64"};
    for (const QString &type : types) {
        registers += QStringLiteral("register.%1 = holding %2, %1\n").arg(type).arg(address).toLatin1();
        address += 4;
    }
    DriverBench bench("modbus", keys(registers));
    QCOMPARE(bench.errors(), QString());
    for (const QString &type : types) {
        bench.wireRead(type);
        bench.wireWrite(type);
    }
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    for (const QString &type : types)
        bench.set(type, type.startsWith("u") ? 60000.0 : -1234.0);
    QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    for (const QString &type : types)
        QCOMPARE(bench.value(type), type.startsWith("u") ? 60000.0 : -1234.0);
    // As libmodbus itself understands the float.
    QCOMPARE(m_server->with([](modbus_mapping_t &values) { return modbus_get_float_abcd(values.tab_registers + 16); }),
             -1234.0f);
}

void tst_ModbusLines::requestsAreThoseOfTheProtocol()
{
    startServer();
    QByteArray registers;
    for (int i = 0; i < 130; ++i)
        registers += "register.r" + QByteArray::number(i) + " = holding " + QByteArray::number(i) + "\n";
    DriverBench bench("modbus", keys(registers + "register.lamp = coil 7\n"));
    for (int i = 0; i < 130; ++i)
        bench.wireRead(QStringLiteral("r%1").arg(i));
    bench.wireWrite("r0");
    bench.wireWrite("r1");
    bench.wireWrite("r5");
    bench.wireWrite("lamp");
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    m_server->takeRequests();
    for (const char *name : {"r0", "r1", "r5", "lamp"})
        bench.set(name, 1.0);
    QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    std::vector<std::pair<int, int>> seen;
    for (const ModbusServer::Seen &request : m_server->takeRequests())
        seen.emplace_back(request.function, request.first);
    const std::vector<std::pair<int, int>> expected{{5, 7}, {16, 0}, {6, 5}, {3, 0}, {3, 125}};
    QCOMPARE(seen, expected);
}

void tst_ModbusLines::unknownAddressIsReported()
{
    startServer();
    DriverBench bench("modbus", keys("register.speed = holding 199, int32\n"));
    bench.wireRead("speed");
    QVERIFY(!bench.open());
    QVERIFY2(bench.errorString().contains("cannot read holding registers 199 ... 200 (speed) of unit 1: it does not "
                                          "have all of these addresses (exception 2)"),
             qPrintable(bench.errorString()));
}

void tst_ModbusLines::aBusyDeviceIsNotLost()
{
    startServer();
    DriverBench bench("modbus", keys("register.speed = input 1\n"));
    bench.wireRead("speed");
    m_server->answerWith(MODBUS_EXCEPTION_SLAVE_OR_SERVER_BUSY);
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    QVERIFY(!bench.isFresh("speed"));
    m_server->answerWith(0);
    QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    QVERIFY(bench.isFresh("speed"));
}

void tst_ModbusLines::aGarbledAnswerIsAskedForAgain()
{
    startServer();
    DriverBench bench("modbus", keys("register.speed = input 1\nregister.torque = input 9\n"));
    for (const char *name : {"speed", "torque", "@errors", "@failures"})
        bench.wireRead(name);
    m_server->with([](modbus_mapping_t &values) {
        values.tab_input_registers[1] = 11;
        values.tab_input_registers[9] = 99;
    });
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    for (int i = 1; i <= 5; ++i) {
        bench.advance(10ms);
        m_server->garbleNext();
        QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
        QCOMPARE(bench.time("speed"), bench.now());
        QCOMPARE(bench.value("speed"), 11.0);
        QCOMPARE(bench.value("torque"), 99.0);
        QCOMPARE(bench.value("@errors"), double(i));
    }
    QCOMPARE(bench.value("@failures"), 0.0);
}

void tst_ModbusLines::silentDeviceIsLostAndReconnects()
{
    startServer();
    DriverBench bench("modbus", keys("register.speed = input 1\n", "50 ms"));
    bench.wireRead("speed");
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    m_server->setSilent(true);
    QVERIFY(bench.exchange());  // its values are held
    bench.advance(31ms);
    QVERIFY(!bench.exchange());
    QVERIFY2(bench.errorString().contains("cannot read input register 1 (speed) of unit 1: Connection timed out; "
                                          "look at power"),
             qPrintable(bench.errorString()));
    m_server->setSilent(false);
    DriverBench patient("modbus", keys("register.speed = input 1\n"));
    patient.wireRead("speed");
    QVERIFY2(patient.open(), qPrintable(patient.errorString()));
    QVERIFY2(patient.exchange(), qPrintable(patient.errorString()));
}

void tst_ModbusLines::anotherUnitDoesNotAnswer()
{
    m_server = ModbusServer::onSerialLine();
    m_keys = "device = rtu:" + m_server->line().toLatin1() + "\nunit = 2\n";
    DriverBench bench("modbus", keys("register.speed = input 1\n", "50 ms"));
    bench.wireRead("speed");
    QVERIFY(!bench.open());
    QVERIFY2(bench.errorString().contains("(speed) of unit 2: Connection timed out"), qPrintable(bench.errorString()));
}

void tst_ModbusLines::restartedServerIsLostAndReconnects()
{
    m_server = ModbusServer::onTcp();
    const int port = m_server->port();
    m_keys = "device = tcp:127.0.0.1:" + QByteArray::number(port) + "\n";
    DriverBench bench("modbus", keys("register.speed = input 1\n"));
    bench.wireRead("speed");
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    m_server.reset();
    QVERIFY(!bench.exchange());
    QVERIFY2(bench.errorString().contains("closed the connection"), qPrintable(bench.errorString()));
    QVERIFY(!bench.open());
    m_server = ModbusServer::onTcp(port);
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    QVERIFY2(bench.exchange(), qPrintable(bench.errorString()));
    QVERIFY(bench.isFresh("speed"));
}

void tst_ModbusLines::missingServerIsReported()
{
    const int port = ModbusServer::onTcp()->port();  // was free a moment ago
    DriverBench bench("modbus", "device = tcp:127.0.0.1:" + QByteArray::number(port) + "\nregister.a = coil 1\n");
    bench.wireRead("a");
    QVERIFY(!bench.open());
    QCOMPARE(
        bench.errorString(),
        QStringLiteral("tcp:127.0.0.1:%1: Connection refused; there is no Modbus server; look at host and port (502 "
                       "is usual), and whether it runs")
            .arg(port));
}

void tst_ModbusLines::unknownHostIsReported()
{
    DriverBench bench("modbus", "device = tcp:256.1.1.1\nregister.a = coil 1\n");
    bench.wireRead("a");
    QVERIFY(!bench.open());
    QVERIFY2(bench.errorString().contains("look at host and port"), qPrintable(bench.errorString()));
}

void tst_ModbusLines::missingSerialDeviceIsReported()
{
    DriverBench bench("modbus", "device = rtu:/dev/ttyNowhere\nregister.a = coil 1\n");
    bench.wireRead("a");
    QVERIFY(!bench.open());
    QCOMPARE(bench.errorString(),
             QString("rtu:/dev/ttyNowhere: No such file or directory; plug it in; \"ls /dev/serial/by-id\" shows what "
                     "there is"));
}

void tst_ModbusLines::busySerialLineIsReported()
{
    m_server = ModbusServer::onSerialLine();
    QCOMPARE(::flock(m_server->otherEnd(), LOCK_EX | LOCK_NB), 0);
    DriverBench bench("modbus", "device = rtu:" + m_server->line().toLatin1() + "\nregister.a = coil 1\n");
    bench.wireRead("a");
    QVERIFY(!bench.open());
    QVERIFY2(bench.errorString().contains("another program uses the line"), qPrintable(bench.errorString()));
    ::flock(m_server->otherEnd(), LOCK_UN);
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
}

void tst_ModbusLines::invalidDeviceNamesAreReported_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("error");
    QTest::newRow("no host") << QByteArray("device = tcp:") << "is not a host and port";
    QTest::newRow("port") << QByteArray("device = tcp:host:0") << "'host:0' is not a host and port";
    QTest::newRow("large port") << QByteArray("device = tcp:host:65536") << "is not a host and port";
    QTest::newRow("bracket") << QByteArray("device = tcp:[::1") << "is not a host and port";
    QTest::newRow("path") << QByteArray("device = rtu:ttyUSB0") << "write for example rtu:/dev/ttyUSB0";
    QTest::newRow("baud") << QByteArray("device = rtu:/dev/x\nbaud = 9601") << "9601";
    QTest::newRow("parity") << QByteArray("device = rtu:/dev/x\nparity = mark") << "mark";
    QTest::newRow("stop bits") << QByteArray("device = rtu:/dev/x\nstop-bits = 3") << "3";
    QTest::newRow("unit of a serial line") << QByteArray("device = rtu:/dev/x\nunit = 248") << "248";
    QTest::newRow("unit") << QByteArray("device = tcp:host\nunit = 256") << "256";
    QTest::newRow("timeout") << QByteArray("device = tcp:host\nresponse-timeout = 0 s") << "response-timeout";
}

void tst_ModbusLines::invalidDeviceNamesAreReported()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, error);
    const DriverBench bench("modbus", text + "\nregister.a = holding 1\n");
    QVERIFY2(bench.errors().contains(error), qPrintable(bench.errors()));
    const DriverBench good("modbus", "device = tcp:[::1]:1502\nregister.a = holding 1\n");
    QCOMPARE(good.errors(), QString());
}

QTEST_APPLESS_MAIN(tst_ModbusLines)
#include "tst_ModbusLines.moc"
