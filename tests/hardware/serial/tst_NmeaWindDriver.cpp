// SPDX-License-Identifier: Apache-2.0
#include "FarEnd.h"
#include "NmeaLines.h"

#include <QtTest/QtTest>

using namespace qplc;
using namespace std::chrono_literals;

namespace {

/// A sensor at the far end of a line.
struct Sensor : FarEnd
{
    explicit Sensor(const QByteArray &keys = {})
        : FarEnd("nmea-wind", "fake:wind", keys)
    {
        for (const char *name : {"relativeSpeed", "relativeAngle", "trueSpeed", "direction", "temperature", "status"})
            bench.wireRead(name);
    }
};

}  // namespace

class tst_NmeaWindDriver : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void windComesInSiUnits();
    void sentencesMayComeInPieces();
    void aValueIsFreshForItsTimeout();
    void windMarkedInvalidIsNotFresh();
    void aWrongRateIsNamed();
    void aSilentSensorIsNamed();
    void anotherInstrumentIsNamed();
    void aLineThatIsUnpluggedIsOpenedAgain();
    void invalidKeysAreRefused();
};

void tst_NmeaWindDriver::windComesInSiUnits()
{
    Sensor sensor("baud = 9600\nformat = 8N1\n");
    QCOMPARE(sensor.bench.errors(), QString());
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QVERIFY(sensor.bench.exchange());
    QVERIFY(!sensor.bench.isFresh("relativeSpeed"));
    QVERIFY(sensor.say(nmeaLine("WIMWV,90,R,36,K,A") + nmeaLine("WIMWV,180,T,7.5,M,A") + nmeaLine("WIXDR,C,12.5,C,0")));
    QCOMPARE(sensor.bench.value("relativeSpeed"), 10.0);
    QCOMPARE(sensor.bench.value("relativeAngle"), M_PI / 2);
    QCOMPARE(sensor.bench.value("trueSpeed"), 7.5);
    QCOMPARE(sensor.bench.value("temperature"), 12.5);
    QCOMPARE(sensor.bench.value("status"), 1.0);
    QVERIFY(!sensor.bench.isFresh("direction"));
}

void tst_NmeaWindDriver::sentencesMayComeInPieces()
{
    Sensor sensor;
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    const QByteArray bytes = nmeaLine("WIMWV,90,R,10,M,A");
    for (const char byte : bytes.chopped(1))
        QVERIFY(sensor.say(QByteArray(1, byte)));
    QVERIFY(sensor.say("\n"));
    QCOMPARE(sensor.bench.value("relativeSpeed"), 10.0);
}

void tst_NmeaWindDriver::aValueIsFreshForItsTimeout()
{
    for (const auto &[keys, timeout] :
         {std::pair<QByteArray, std::chrono::nanoseconds>{"", 2500ms}, {"timeout = 300 ms\n", 300ms}}) {
        Sensor sensor(keys);
        QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
        QVERIFY(sensor.say(nmeaLine("WIMWV,90,R,10,M,A")));
        sensor.bench.advance(timeout);
        QVERIFY(sensor.bench.exchange());
        QVERIFY(sensor.bench.isFresh("relativeSpeed"));
        sensor.bench.advance(1ns);
        QVERIFY(sensor.bench.exchange());
        QVERIFY(!sensor.bench.isFresh("relativeSpeed"));
    }
}

void tst_NmeaWindDriver::windMarkedInvalidIsNotFresh()
{
    Sensor sensor;
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QVERIFY(sensor.say(nmeaLine("WIMWV,90,R,10,M,A") + nmeaLine("WIMWV,90,T,8,M,A")));
    QVERIFY(sensor.say(nmeaLine("WIMWV,90,R,10,M,V")));
    QVERIFY(!sensor.bench.isFresh("relativeSpeed"));
    QVERIFY(!sensor.bench.isFresh("relativeAngle"));
    QCOMPARE(sensor.bench.value("trueSpeed"), 8.0);
    QCOMPARE(sensor.bench.value("status"), 0.0);
}

void tst_NmeaWindDriver::aWrongRateIsNamed()
{
    Sensor sensor;
    const QByteArray garbage("\x1f\xc0\x07\xe6$\x98\x83\n\xff\x0f\x02\x81\xe4\x41\r");
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QVERIFY(sensor.say(garbage));
    sensor.bench.advance(1s);
    QVERIFY(sensor.say(garbage));
    sensor.bench.advance(1ms);
    QVERIFY(!sensor.say(garbage));
    const QString error = sensor.bench.errorString();
    QVERIFY2(error.contains("'fake:wind' at 4800 8N1 is not NMEA 0183") && error.contains("set 'baud'")
                 && error.contains("checksum = optional"),
             qPrintable(error));
    // It is tried again, and the sensor may be set right meanwhile.
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QVERIFY(sensor.say(nmeaLine("WIMWV,90,R,10,M,A")));
    QCOMPARE(sensor.bench.value("relativeSpeed"), 10.0);
}

void tst_NmeaWindDriver::aSilentSensorIsNamed()
{
    Sensor sensor;
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QVERIFY(sensor.say(nmeaLine("WIMWV,90,R,10,M,A")));
    sensor.bench.advance(5s);
    QVERIFY(sensor.bench.exchange());
    sensor.bench.advance(1ms);
    QVERIFY(!sensor.bench.exchange());
    QVERIFY2(sensor.bench.errorString().contains("nothing comes from 'fake:wind'"),
             qPrintable(sensor.bench.errorString()));
}

void tst_NmeaWindDriver::anotherInstrumentIsNamed()
{
    Sensor sensor;
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QVERIFY(sensor.say(nmeaLine("GPGGA,1")));
    for (int i = 0; i < 5; ++i) {
        sensor.bench.advance(1s);
        QVERIFY(sensor.say(nmeaLine("GPGGA,1")));
    }
    sensor.bench.advance(1ms);
    QVERIFY(!sensor.bench.exchange());
    QVERIFY2(sensor.bench.errorString().contains("for example GPGGA, but no wind"),
             qPrintable(sensor.bench.errorString()));
}

void tst_NmeaWindDriver::aLineThatIsUnpluggedIsOpenedAgain()
{
    Sensor sensor;
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QVERIFY(sensor.say(nmeaLine("WIMWV,90,R,10,M,A")));
    sensor.far.unplug();
    QVERIFY(!sensor.bench.exchange());
    QVERIFY(!sensor.bench.isFresh("relativeSpeed"));
    QVERIFY2(sensor.bench.errorString().contains("'fake:wind'")
                 && sensor.bench.errorString().contains("plug the adapter in again"),
             qPrintable(sensor.bench.errorString()));
    QVERIFY(!sensor.bench.open());
    QVERIFY(sensor.far.plugIn("fake:wind"));
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QVERIFY(sensor.say(nmeaLine("WIMWV,90,R,11,M,A")));
    QCOMPARE(sensor.bench.value("relativeSpeed"), 11.0);
}

void tst_NmeaWindDriver::invalidKeysAreRefused()
{
    const Sensor sensor("baud = 20\nformat = 8X1\nchecksum = maybe\nrs485-after = 1 ms\n");
    const QString errors = sensor.bench.errors();
    QVERIFY2(errors.contains("'20' is not a whole number from 50 to 10000000")
                 && errors.contains("rs485-after needs a direction; write 'rs485 = rts-on-send'")
                 && errors.contains("'8X1' is not a format") && errors.contains("'maybe'"),
             qPrintable(errors));
}

QTEST_GUILESS_MAIN(tst_NmeaWindDriver)
#include "tst_NmeaWindDriver.moc"
