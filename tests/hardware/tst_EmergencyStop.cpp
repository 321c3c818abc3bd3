// SPDX-License-Identifier: Apache-2.0
// A button at a hardware node stops the plant.
#include "WinchBench.h"

namespace {

/// The speed is the button. Its values are fresh for longer than a busy machine lets its thread wait.
QByteArray buttonWiring()
{
    QByteArray text = wiring;
    text.replace("name = Winch\n", "name = Winch\nsafeStop = drive.speed\n");
    return text.replace("device = bench0\n", "device = bench0\ntimeout = 2 s\n");
}

}  // namespace

class tst_EmergencyStop : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_bench.init(); }
    void aPressedButtonStopsThePlantSafely_data() { addKinds(); }
    void aPressedButtonStopsThePlantSafely();
    void aButtonThatIsSlowAtFirstStopsNothing_data() { addKinds(); }
    void aButtonThatIsSlowAtFirstStopsNothing();
    void aButtonWithoutAValueStopsThePlantToo();

private:
    WinchBench m_bench;
};

void tst_EmergencyStop::aPressedButtonStopsThePlantSafely()
{
    QFETCH(QString, kind);
    QFETCH(int, pace);
    m_bench.pace = QPlcDriver::Pace(pace);
    TestMaster master(QPlcClock::realTime(), winchTable());
    QVERIFY(master.listen());
    QPlcHardwareNode node;
    QVERIFY(node.configure(buttonWiring(), "winch.ini"));
    node.openDevices();
    QTRY_VERIFY(node.drivers().first().isOnline);
    QVERIFY(master.admit(node, kind));
    QVERIFY(WinchBench::start(master));
    QVERIFY(master.waitForCycles(20));
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    LogCapture log;
    m_bench.device->speed = 1.0;
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    QVERIFY2(master.stateReason().contains("node 'Winch' asked for it"), qPrintable(master.stateReason()));
    QTRY_COMPARE(m_bench.device->brake.load(), 1.0);
    node.disconnectFromMaster();
}

void tst_EmergencyStop::aButtonThatIsSlowAtFirstStopsNothing()
{
    QFETCH(QString, kind);
    QFETCH(int, pace);
    m_bench.pace = QPlcDriver::Pace(pace);
    TestMaster master(QPlcClock::realTime(), winchTable());
    QVERIFY(master.listen());
    QPlcHardwareNode node;
    QVERIFY(node.configure(buttonWiring(), "winch.ini"));
    m_bench.device->silentReads = 3;
    QVERIFY(master.admit(node, kind));
    QVERIFY(WinchBench::start(master));
    QVERIFY(master.waitForCycles(20));
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    node.disconnectFromMaster();
}

void tst_EmergencyStop::aButtonWithoutAValueStopsThePlantToo()
{
    TestMaster master(QPlcClock::realTime(), winchTable());
    QPlcHardwareNode node;
    QVERIFY(node.configure(buttonWiring(), "winch.ini"));
    m_bench.device->isPlugged = false;
    QVERIFY(master.addLocalNode(&node));
    LogCapture log;
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
}

QTEST_GUILESS_MAIN(tst_EmergencyStop)
#include "tst_EmergencyStop.moc"
