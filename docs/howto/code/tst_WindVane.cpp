// SPDX-License-Identifier: Apache-2.0
// The driver in a node, at the other end of a pseudo terminal: no vane is needed.
#include "WindVane.h"

#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

#include <cstdlib>

class tst_WindVane : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        QPlcHardwareNode::addDriverKind(QStringLiteral("vane"), QString(), [] { return std::make_unique<WindVane>(); });
    }
    void init();
    void cleanup() { ::close(m_vane); }
    void anAngleIsRead();
    void invalidLinesAreIgnored();
    void unpluggedVaneIsReported();
    void missingDeviceKeyIsAConfigurationError();

private:
    void say(const QByteArray &text)
    {
        QCOMPARE(::write(m_vane, text.constData(), std::size_t(text.size())), ssize_t(text.size()));
    }
    static bool isFresh(QPlcHardwareNode &node, double angle)
    {
        node.readDevices();
        const QPlcHardwareNode::Wire wire = node.wires().value(0);
        return wire.isFresh && wire.value == angle;
    }
    static bool configure(QPlcHardwareNode &node, const QByteArray &device)
    {
        return node.configure("[node]\nname = Weather\n[vane]\ndriver = vane\ntimeout = 10 s\n" + device
                                  + "[vane.read]\nwindDirection = angle\n",
                              QStringLiteral("test.ini"));
    }
    int m_vane = -1;  // the end that the vane writes to
    QByteArray m_device;
};

void tst_WindVane::init()
{
    m_vane = ::posix_openpt(O_RDWR | O_NOCTTY);
    QVERIFY(m_vane >= 0 && ::grantpt(m_vane) == 0 && ::unlockpt(m_vane) == 0);
    m_device = QByteArray("device = ") + QByteArray(::ptsname(m_vane)) + '\n';
}

void tst_WindVane::anAngleIsRead()
{
    QPlcHardwareNode node;
    QVERIFY2(configure(node, m_device), qPrintable(QPlcParseError::toString(node.configurationErrors())));
    QSignalSpy opened(&node, &QPlcHardwareNode::deviceOpened);
    node.openDevices();
    QTRY_COMPARE(opened.size(), 1);
    say("123.5\n12");
    QTRY_VERIFY(isFresh(node, 123.5));
    say("4.25\r\n");
    QTRY_VERIFY(isFresh(node, 124.25));
    node.closeDevices();
}

void tst_WindVane::invalidLinesAreIgnored()
{
    QPlcHardwareNode node;
    QVERIFY(configure(node, m_device));
    QSignalSpy opened(&node, &QPlcHardwareNode::deviceOpened);
    node.openDevices();
    QTRY_COMPARE(opened.size(), 1);
    say("1#3\n361\n-1\nnan\n\n" + QByteArray(1000, 'x') + "\n90\n");
    QTRY_VERIFY(isFresh(node, 90.0));
    node.closeDevices();
}

void tst_WindVane::unpluggedVaneIsReported()
{
    QPlcHardwareNode node;
    QVERIFY(configure(node, m_device));
    QSignalSpy opened(&node, &QPlcHardwareNode::deviceOpened);
    QSignalSpy failed(&node, &QPlcHardwareNode::deviceFailed);
    node.openDevices();
    QTRY_COMPARE(opened.size(), 1);
    QTest::ignoreMessage(QtWarningMsg, QRegularExpression("read from the vane: Input/output error"));
    ::close(m_vane);
    m_vane = -1;
    QTRY_VERIFY(!failed.isEmpty());
    QVERIFY2(failed.at(0).at(1).toString().contains("vane"), qPrintable(failed.at(0).at(1).toString()));
    node.closeDevices();
}

void tst_WindVane::missingDeviceKeyIsAConfigurationError()
{
    QPlcHardwareNode node;
    QVERIFY(!configure(node, ""));
    QVERIFY2(QPlcParseError::toString(node.configurationErrors()).contains("/dev/ttyUSB0"),
             qPrintable(QPlcParseError::toString(node.configurationErrors())));
}

QTEST_GUILESS_MAIN(tst_WindVane)
#include "tst_WindVane.moc"
