// SPDX-License-Identifier: Apache-2.0
#include "FarEnd.h"
#include "NmeaLines.h"
#include "hardware/serial/NmeaFix.h"

#include <QtTest/QtTest>

using namespace qplc;
using namespace std::chrono_literals;

namespace {

// The examples of the standard's tables, with their checksums.
const QByteArray gga = "GPGGA,123519.00,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,";
const QByteArray rmc = "GPRMC,123519.00,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W,A";
const QByteArray vtg = "GPVTG,054.7,T,034.4,M,005.5,N,010.2,K,A";

constexpr double Degree = M_PI / 180.0;

NmeaFix fixOf(const QByteArray &body)
{
    NmeaSentence sentence;
    return NmeaSentence::parse(nmeaLine(body).trimmed(), &sentence) == NmeaSentence::Good ? NmeaFix::read(sentence)
                                                                                          : NmeaFix();
}

/// A receiver at the far end of a line.
struct Receiver : FarEnd
{
    explicit Receiver(const QByteArray &keys = {})
        : FarEnd("nmea-gnss", "fake:gnss", keys)
    {
        for (const char *name : {"latitude", "longitude", "altitude", "geoidSeparation", "speed", "course", "time",
                                 "fixQuality", "satellites", "hdop", "correctionAge", "status"})
            errors += bench.wireRead(name);
    }

    QString errors;
};

}  // namespace

class tst_NmeaGnssDriver : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aFixComesInSiUnits();
    void anglesAreDegreesAndMinutes_data();
    void anglesAreDegreesAndMinutes();
    void timeIsThatOfUtc_data();
    void timeIsThatOfUtc();
    void whatIsOutOfRangeIsLeftOut_data();
    void whatIsOutOfRangeIsLeftOut();
    void aFixThatWasNotMeasuredIsNone_data();
    void aFixThatWasNotMeasuredIsNone();
    void aLostFixIsInvalidAtOnce();
    void movementIsLostWithoutTheFix();
    void emptyFieldsLeaveTheValue();
    void anotherInstrumentIsNamed();
};

void tst_NmeaGnssDriver::aFixComesInSiUnits()
{
    Receiver receiver;
    QCOMPARE(receiver.bench.errors() + receiver.errors, QString());
    QVERIFY2(receiver.bench.open(), qPrintable(receiver.bench.errorString()));
    QVERIFY(receiver.say(nmeaLine(gga)));
    QCOMPARE(receiver.bench.value("latitude"), (48.0 + 7.038 / 60.0) * Degree);
    QCOMPARE(receiver.bench.value("longitude"), (11.0 + 31.0 / 60.0) * Degree);
    QCOMPARE(receiver.bench.value("altitude"), 545.4);
    QCOMPARE(receiver.bench.value("geoidSeparation"), 46.9);
    QCOMPARE(receiver.bench.value("fixQuality"), 1.0);
    QCOMPARE(receiver.bench.value("satellites"), 8.0);
    QCOMPARE(receiver.bench.value("hdop"), 0.9);
    QCOMPARE(receiver.bench.value("status"), 1.0);
    for (const char *name : {"speed", "course", "time", "correctionAge"})
        QVERIFY2(!receiver.bench.isFresh(name), name);
    QVERIFY(receiver.say(nmeaLine(rmc)));
    QCOMPARE(receiver.bench.value("speed"), 22.4 * 1852.0 / 3600.0);
    QCOMPARE(receiver.bench.value("course"), 84.4 * Degree);
    QCOMPARE(receiver.bench.value("time"), 764426119.0);
    QVERIFY(receiver.say(nmeaLine(vtg)));
    QCOMPARE(receiver.bench.value("speed"), 5.5 * 1852.0 / 3600.0);
    QCOMPARE(receiver.bench.value("course"), 54.7 * Degree);
}

void tst_NmeaGnssDriver::anglesAreDegreesAndMinutes_data()
{
    QTest::addColumn<QByteArray>("fields");
    QTest::addColumn<double>("latitude");  // [deg]
    QTest::addColumn<double>("longitude");
    QTest::newRow("south and west") << QByteArray("3352.5000,S,15112.6000,W") << -33.875 << -(151.0 + 12.6 / 60.0);
    QTest::newRow("equator") << QByteArray("0000.0000,N,00000.0000,E") << 0.0 << 0.0;
    QTest::newRow("pole") << QByteArray("9000.0,S,18000.0,E") << -90.0 << 180.0;
    QTest::newRow("centimetres") << QByteArray("5230.1234567,N,00130.7654321,E") << 52.0 + 30.1234567 / 60.0
                                 << 1.0 + 30.7654321 / 60.0;
}

void tst_NmeaGnssDriver::anglesAreDegreesAndMinutes()
{
    QFETCH(QByteArray, fields);
    QFETCH(double, latitude);
    QFETCH(double, longitude);
    const NmeaFix fix = fixOf("GNGGA,120000," + fields + ",4,12,0.5,10,M,47,M,1.5,0001");
    QVERIFY(fix.latitude && fix.longitude);
    QVERIFY(std::abs(*fix.latitude - latitude * Degree) < 1e-12);
    QVERIFY(std::abs(*fix.longitude - longitude * Degree) < 1e-12);
    QCOMPARE(*fix.correctionAge, 1.5);
}

void tst_NmeaGnssDriver::timeIsThatOfUtc_data()
{
    QTest::addColumn<QByteArray>("time");
    QTest::addColumn<QByteArray>("date");
    QTest::addColumn<double>("seconds");  // NaN: it is none
    QTest::newRow("with a fraction") << QByteArray("000000.25") << QByteArray("010100") << 946684800.25;
    QTest::newRow("leap second") << QByteArray("235960") << QByteArray("311216") << 1483228800.0;
    QTest::newRow("29 February") << QByteArray("120000.00") << QByteArray("290228") << 1835438400.0;
    QTest::newRow("oldest year") << QByteArray("000000") << QByteArray("060180") << 315964800.0;
    QTest::newRow("no date") << QByteArray("120000") << QByteArray() << qQNaN();
    QTest::newRow("30 February") << QByteArray("120000") << QByteArray("300228") << qQNaN();
    QTest::newRow("hour 24") << QByteArray("240000") << QByteArray("010100") << qQNaN();
    QTest::newRow("minute 60") << QByteArray("126000") << QByteArray("010100") << qQNaN();
    QTest::newRow("second 61") << QByteArray("120061") << QByteArray("010100") << qQNaN();
    QTest::newRow("too short") << QByteArray("1200") << QByteArray("010100") << qQNaN();
    QTest::newRow("a sign") << QByteArray("-12000") << QByteArray("010100") << qQNaN();
    QTest::newRow("date in words") << QByteArray("120000") << QByteArray("01JAN0") << qQNaN();
}

void tst_NmeaGnssDriver::timeIsThatOfUtc()
{
    QFETCH(QByteArray, time);
    QFETCH(QByteArray, date);
    QFETCH(double, seconds);
    const NmeaFix fix = fixOf("GPRMC," + time + ",A,4807.038,N,01131.000,E,0,0," + date + ",,,A");
    QCOMPARE(fix.time.has_value(), !std::isnan(seconds));
    if (fix.time)
        QCOMPARE(*fix.time, seconds);
}

void tst_NmeaGnssDriver::whatIsOutOfRangeIsLeftOut_data()
{
    QTest::addColumn<QByteArray>("position");
    QTest::newRow("latitude") << QByteArray("9000.1,N,01131.000,E");
    QTest::newRow("minutes") << QByteArray("4860.0,N,01131.000,E");
    QTest::newRow("negative") << QByteArray("-4807.0,N,01131.000,E");
    QTest::newRow("no half") << QByteArray("4807.0,,01131.000,E");
    QTest::newRow("half of the other angle") << QByteArray("4807.0,E,01131.000,E");
}

void tst_NmeaGnssDriver::whatIsOutOfRangeIsLeftOut()
{
    QFETCH(QByteArray, position);
    const NmeaFix fix = fixOf("GPGGA,120000," + position + ",1,08,-0.9,1e3,M,99999,M,,");
    QVERIFY(fix.isOfFix);
    QVERIFY(!fix.latitude);
    QVERIFY(fix.longitude);
    QVERIFY(!fix.hdop && !fix.altitude && !fix.geoidSeparation);
    const NmeaFix motion = fixOf("GPVTG,361,T,,M,-1,N,,K,A");
    QVERIFY(motion.isOfFix && !motion.course && !motion.speed);
}

void tst_NmeaGnssDriver::aFixThatWasNotMeasuredIsNone_data()
{
    QTest::addColumn<QByteArray>("body");
    QTest::addColumn<bool>("isMeasured");
    const auto withQuality
        = [](char quality) { return QByteArray(gga).replace(",E,1,", QByteArray(",E,") + quality + ","); };
    for (const char quality : {'1', '2', '3', '4', '5'})
        QTest::newRow(qPrintable(QStringLiteral("quality %1").arg(QChar(quality)))) << withQuality(quality) << true;
    for (const char quality : {'0', '6', '7', '8', '9'})
        QTest::newRow(qPrintable(QStringLiteral("quality %1").arg(QChar(quality)))) << withQuality(quality) << false;
    for (const char mode : {'A', 'D', 'P', 'R', 'F'})
        QTest::newRow(qPrintable(QStringLiteral("mode %1").arg(QChar(mode)))) << rmc.chopped(1) + mode << true;
    for (const char mode : {'E', 'M', 'S', 'N'})
        QTest::newRow(qPrintable(QStringLiteral("mode %1").arg(QChar(mode)))) << rmc.chopped(1) + mode << false;
    QTest::newRow("status V") << QByteArray(rmc).replace(",A,4807", ",V,4807") << false;
    QTest::newRow("without mode") << rmc.chopped(2) << true;
}

void tst_NmeaGnssDriver::aFixThatWasNotMeasuredIsNone()
{
    QFETCH(QByteArray, body);
    QFETCH(bool, isMeasured);
    const NmeaFix fix = fixOf(body);
    QVERIFY(fix.hasPosition.has_value());
    QCOMPARE(*fix.hasPosition, isMeasured);
    QCOMPARE(fix.latitude.has_value(), isMeasured);
}

void tst_NmeaGnssDriver::aLostFixIsInvalidAtOnce()
{
    Receiver receiver;
    QVERIFY2(receiver.bench.open(), qPrintable(receiver.bench.errorString()));
    QVERIFY(receiver.say(nmeaLine(gga) + nmeaLine(rmc)));
    QVERIFY(receiver.bench.isFresh("latitude") && receiver.bench.isFresh("speed"));
    QVERIFY(receiver.say(nmeaLine("GPGGA,123520.00,,,,,0,00,99.99,,,,,,") + nmeaLine("GPRMC,,V,,,,,,,,,,N")));
    for (const char *name : {"latitude", "longitude", "altitude", "geoidSeparation", "speed", "course", "time"})
        QVERIFY2(!receiver.bench.isFresh(name), name);
    QCOMPARE(receiver.bench.value("fixQuality"), 0.0);
    QCOMPARE(receiver.bench.value("satellites"), 0.0);
    QCOMPARE(receiver.bench.value("status"), 0.0);
}

void tst_NmeaGnssDriver::movementIsLostWithoutTheFix()
{
    Receiver receiver;
    QVERIFY2(receiver.bench.open(), qPrintable(receiver.bench.errorString()));
    QVERIFY(receiver.say(nmeaLine(gga) + nmeaLine(vtg)));
    QVERIFY(receiver.bench.isFresh("speed"));
    QVERIFY(receiver.say(nmeaLine("GPVTG,,T,,M,,N,,K,N")));
    QVERIFY(!receiver.bench.isFresh("speed") && !receiver.bench.isFresh("course"));
    QVERIFY(receiver.bench.isFresh("latitude"));
}

// As the course at standstill.
void tst_NmeaGnssDriver::emptyFieldsLeaveTheValue()
{
    Receiver receiver("timeout = 2 s\n");
    QVERIFY2(receiver.bench.open(), qPrintable(receiver.bench.errorString()));
    QVERIFY(receiver.say(nmeaLine(vtg)));
    receiver.bench.advance(1s);
    QVERIFY(receiver.say(nmeaLine("GPVTG,,T,,M,0.0,N,0.0,K,A")));
    QCOMPARE(receiver.bench.value("speed"), 0.0);
    QCOMPARE(receiver.bench.value("course"), 54.7 * Degree);
    receiver.bench.advance(1001ms);
    QVERIFY(receiver.say(nmeaLine("GPVTG,,T,,M,0.0,N,0.0,K,A")));
    QVERIFY(!receiver.bench.isFresh("course"));
}

void tst_NmeaGnssDriver::anotherInstrumentIsNamed()
{
    Receiver receiver;
    QVERIFY2(receiver.bench.open(), qPrintable(receiver.bench.errorString()));
    QVERIFY(receiver.say(nmeaLine("WIMWV,90,R,10,M,A")));
    for (int i = 0; i < 5; ++i) {
        receiver.bench.advance(1s);
        QVERIFY(receiver.say(nmeaLine("WIMWV,90,R,10,M,A")));
    }
    receiver.bench.advance(1ms);
    QVERIFY(!receiver.bench.exchange());
    QVERIFY2(receiver.bench.errorString().contains("for example WIMWV, but no position; set the sensor up to send GGA"),
             qPrintable(receiver.bench.errorString()));
}

QTEST_GUILESS_MAIN(tst_NmeaGnssDriver)
#include "tst_NmeaGnssDriver.moc"
