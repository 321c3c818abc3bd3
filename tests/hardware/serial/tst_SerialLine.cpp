// SPDX-License-Identifier: Apache-2.0
#include "../FakeDevices.h"
#include "PseudoTerminal.h"
#include "hardware/serial/SerialLine.h"

#include <QtTest/QtTest>

#include <cerrno>
#include <termios.h>

using namespace qplc;

class tst_SerialLine : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void formatsAreThreeCharacters();
    void bytesGoBothWaysUnchanged();
    void readDoesNotBlock();
    void allUsualRatesAreSet();
    void openDiscardsEarlierBytes();
    void unpluggedLineReportsNoDevice();
    void aMissingLineIsNamedWithTheRemedy();
    void otherDeviceFilesAreRefused();
    void aRateThatTheLineCannotDoIsNamed();
    void anyOtherRateIsSet();
    void parityIsCheckedByItsEffect();
    void modesThatTheLineDoesNotHaveAreNamed();
    void aFakeLineIsALinkInTheFolder();
};

void tst_SerialLine::formatsAreThreeCharacters()
{
    SerialSettings settings;
    QVERIFY(settings.setFormat("7e2"));
    QCOMPARE(settings.toString(), QString("9600 7E2"));
    for (const char *wrong : {"", "8N", "8N11", "9N1", "4N1", "8X1", "8N3", "8N0"})
        QVERIFY2(!settings.setFormat(wrong), wrong);
    QCOMPARE(settings.toString(), QString("9600 7E2"));
}

void tst_SerialLine::bytesGoBothWaysUnchanged()
{
    PseudoTerminal far;
    SerialLine line;
    QString error;
    QVERIFY(far.plugIn());
    QVERIFY2(line.open(far.path(), SerialSettings(), &error), qPrintable(error));
    QByteArray all;
    for (int i = 0; i < 256; ++i)
        all.append(char(i));
    QVERIFY(far.send(all));
    QByteArray received(512, '\0');
    QCOMPARE(line.read(received.data(), received.size()), 256);
    QCOMPARE(received.left(256).toHex(), all.toHex());
    QCOMPARE(line.write(all.constData(), all.size()), 256);
    QCOMPARE(far.receive().toHex(), all.toHex());
}

void tst_SerialLine::readDoesNotBlock()
{
    PseudoTerminal far;
    SerialLine line;
    QString error;
    char byte = 0;
    QVERIFY(far.plugIn());
    QVERIFY2(line.open(far.path(), SerialSettings(), &error), qPrintable(error));
    QCOMPARE(line.read(&byte, 1), 0);
}

void tst_SerialLine::allUsualRatesAreSet()
{
    PseudoTerminal far;
    QVERIFY(far.plugIn());
    for (const int baud : {1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800, 921600, 1000000}) {
        SerialLine line;
        SerialSettings settings;
        QString error;
        settings.baud = baud;
        QVERIFY(SerialLine::isUsualRate(baud));
        QVERIFY2(line.open(far.path(), settings, &error), qPrintable(error));
    }
    QVERIFY(!SerialLine::isUsualRate(4801));
    QVERIFY(SerialLine::usualRates().contains("4800, 9600"));
}

void tst_SerialLine::openDiscardsEarlierBytes()
{
    PseudoTerminal far;
    SerialLine line;
    QString error;
    char bytes[8] = {};
    QVERIFY(far.plugIn());
    QVERIFY2(line.open(far.path(), SerialSettings(), &error), qPrintable(error));
    QVERIFY(far.send("old"));
    QVERIFY2(line.open(far.path(), SerialSettings(), &error), qPrintable(error));
    QVERIFY(far.send("new"));
    QCOMPARE(line.read(bytes, sizeof bytes), 3);
    QCOMPARE(QByteArray(bytes), QByteArray("new"));
}

void tst_SerialLine::unpluggedLineReportsNoDevice()
{
    PseudoTerminal far;
    SerialLine line;
    QString error;
    char byte = 0;
    QVERIFY(far.plugIn());
    QVERIFY2(line.open(far.path(), SerialSettings(), &error), qPrintable(error));
    far.unplug();
    QCOMPARE(line.read(&byte, 1), -1);
    QCOMPARE(errno, ENODEV);
    QCOMPARE(line.write(&byte, 1), -1);
    QCOMPARE(errno, ENODEV);
    QVERIFY(SerialLine::remedy(ENODEV).contains("plug the adapter in again"));
}

void tst_SerialLine::aMissingLineIsNamedWithTheRemedy()
{
    SerialLine line;
    QString error;
    QVERIFY(!line.open("/dev/ttyUSB987", SerialSettings(), &error));
    QVERIFY2(error.contains("'/dev/ttyUSB987': No such file or directory; "), qPrintable(error));
    QVERIFY2(error.contains("plug the adapter in") || error.contains("/dev/serial/by-id"), qPrintable(error));
    QVERIFY(!line.isOpen());
}

void tst_SerialLine::otherDeviceFilesAreRefused()
{
    SerialLine line;
    QString error;
    QVERIFY(!line.open("/dev/null", SerialSettings(), &error));
    QVERIFY2(error.contains("'/dev/null'") && error.contains("is that a serial line?"), qPrintable(error));
}

// A pseudo-terminal has 8 data bits, whatever it is told, and says nothing.
void tst_SerialLine::aRateThatTheLineCannotDoIsNamed()
{
    PseudoTerminal far;
    SerialLine line;
    SerialSettings settings;
    QString error;
    QVERIFY(far.plugIn());
    QVERIFY(settings.setFormat("7E1"));
    QVERIFY(!line.open(far.path(), settings, &error));
    QVERIFY2(error.contains("cannot do 9600 7E1"), qPrintable(error));
}

void tst_SerialLine::anyOtherRateIsSet()
{
    PseudoTerminal far;
    QVERIFY(far.plugIn());
    for (const int baud : {50000, 76800, 100000, 250000}) {
        SerialLine line;
        SerialSettings settings;
        QString error;
        settings.baud = baud;
        QVERIFY(!SerialLine::isUsualRate(baud));
        QVERIFY2(line.open(far.path(), settings, &error), qPrintable(error));
    }
}

// A pseudo-terminal has no parity, whatever it is told, and says nothing.
void tst_SerialLine::parityIsCheckedByItsEffect()
{
    PseudoTerminal far;
    SerialLine line;
    SerialSettings settings;
    QString error;
    QVERIFY(far.plugIn());
    for (const char *format : {"8E1", "8O1"}) {
        QVERIFY(settings.setFormat(format));
        QVERIFY(!line.open(far.path(), settings, &error));
        QVERIFY2(error.contains(QStringLiteral("cannot do 9600 ") + format), qPrintable(error));
    }
}

void tst_SerialLine::modesThatTheLineDoesNotHaveAreNamed()
{
    PseudoTerminal far;
    SerialLine line;
    SerialSettings direction;
    SerialSettings latency;
    QString error;
    QVERIFY(far.plugIn());
    direction.mode.direction = SerialMode::RtsOnSend;
    QVERIFY(!line.open(far.path(), direction, &error));
    QVERIFY2(error.contains("cannot set up the serial line '" + far.path()) && error.contains("direction of RS-485")
                 && error.contains("write 'rs485 = no'"),
             qPrintable(error));
    QVERIFY(!line.isOpen());
    latency.mode.isLowLatency = true;
    QVERIFY(!line.open(far.path(), latency, &error));
    QVERIFY2(error.contains("no low latency") && error.contains("remove 'low-latency'"), qPrintable(error));
}

void tst_SerialLine::aFakeLineIsALinkInTheFolder()
{
    const FakeDevices devices;
    PseudoTerminal far;
    SerialLine line;
    QString error;
    char bytes[8] = {};
    QVERIFY(!line.open("fake:wind", SerialSettings(), &error));
    QVERIFY2(error.contains("no fake device 'fake:wind'"), qPrintable(error));
    QVERIFY(far.plugIn("fake:wind"));
    QVERIFY2(line.open("fake:wind", SerialSettings(), &error), qPrintable(error));
    QVERIFY(far.send("hello"));
    QCOMPARE(line.read(bytes, sizeof bytes), 5);
}

QTEST_GUILESS_MAIN(tst_SerialLine)
#include "tst_SerialLine.moc"
