// SPDX-License-Identifier: Apache-2.0
// A hardware node at a master, with devices that the test holds.
#include "../common/Waiting.h"
#include "ScriptedNode.h"
#include "ThreadCosts.h"
#include "WinchBench.h"

class tst_HardwareNode : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_bench.init(); }
    void signalsAreConnectedToDevices_data() { addKinds(); }
    void signalsAreConnectedToDevices();
    void theDeviceIsSafeBeforeAndAfterAPhase_data() { addKinds(); }
    void theDeviceIsSafeBeforeAndAfterAPhase();
    void safeValuesAreWrittenWhenTheDeviceRecovers_data() { addKinds(); }
    void safeValuesAreWrittenWhenTheDeviceRecovers();
    void theDeviceIsSafeWhenTheMasterIsLost_data() { addKinds(); }
    void theDeviceIsSafeWhenTheMasterIsLost();
    void theDeviceIsSafeWhenTheLinkIsCut();
    void watchdogCanBeChangedOrDisabled();
    void theWatchdogIsNoShorterThanFourPeriods();
    void theDeviceOfAListenerIsSafeWhenThePlantStopsSafely_data() { addKinds(); }
    void theDeviceOfAListenerIsSafeWhenThePlantStopsSafely();
    void configuredSafeValueOverridesTheTable();
    void lostDeviceIsHeldThenSafeAndReconnects();
    void whatADeviceTellsIsInTheLogOfTheMaster_data() { addKinds(); }
    void whatADeviceTellsIsInTheLogOfTheMaster();
    void aLostDeviceIsAnAlarmUntilItIsBack();
    void valuesOutOfSignalRangeAreNotAccepted();
    void elementsOfAnArrayComeFromDifferentChannels();
    void signalsAndConstantsCanDriveChannels();
    void devicesAreNotClosedWhileCyclesRun_data() { addKinds(); }
    void devicesAreNotClosedWhileCyclesRun();
    void aSignalThatIsNotInTheTableIsNamed();
    void cycleAllocatesNothingAndLocksNothing_data() { addKinds(); }
    void cycleAllocatesNothingAndLocksNothing();

private:
    /// What nodes have reported to \a master: "warning Winch: the text", and its alarm.
    static QStringList reports(const TestMaster &master)
    {
        ScriptedTool tool("Anna");
        QStringList texts;
        if (!tool.greetAt(master.serverPort()))
            return texts;
        const QPlcMessage answer = tool.ask(QPlcMessage::GetEvents);
        for (const QJsonValue event : answer.fields().value("events").toArray()) {
            if (event["kind"].toString() == "report")
                texts << event["severity"].toString() + ' ' + event["text"].toString();
        }
        return texts;
    }

    WinchBench m_bench;
};

void tst_HardwareNode::signalsAreConnectedToDevices()
{
    QFETCH(QString, kind);
    QFETCH(int, pace);
    m_bench.pace = QPlcDriver::Pace(pace);
    m_bench.device->speed = 4.0;
    TestMaster master(QPlcClock::realTime(), winchTable());
    QVERIFY(master.listen());
    QPlcHardwareNode node;
    QVERIFY2(node.configure(wiring, "winch.ini"), qPrintable(QPlcParseError::toString(node.configurationErrors())));
    QVERIFY(master.admit(node, kind));
    QVERIFY(master.setSignalValue("torque", 0.5));
    QVERIFY(master.setSignalValue("brake", 0));
    QVERIFY(WinchBench::start(master));
    QTRY_COMPARE(master.signalValue("speed").toReal(), 9.0);
    QTRY_COMPARE(m_bench.device->torque.load(), 5.0);
    QTRY_COMPARE(m_bench.device->brake.load(), 0.0);
    QVERIFY(!m_bench.device->torqueWasSafe);
    QCOMPARE(master.signalValue("online").toInt(), 1);
    QVERIFY(node.drivers().first().isOnline);
    m_bench.device->speed = -1.0;
    QTRY_COMPARE(master.signalValue("speed").toReal(), -1.0);
    node.disconnectFromMaster();
}

void tst_HardwareNode::theDeviceIsSafeBeforeAndAfterAPhase()
{
    QFETCH(QString, kind);
    QFETCH(int, pace);
    m_bench.pace = QPlcDriver::Pace(pace);
    TestMaster master(QPlcClock::realTime(), winchTable());
    QVERIFY(master.listen());
    QPlcHardwareNode node;
    QVERIFY(node.configure(wiring, "winch.ini"));
    QVERIFY(master.admit(node, kind));
    node.openDevices();
    QTRY_VERIFY(node.drivers().first().isOnline);
    QCOMPARE(m_bench.device->brake.load(), -1.0);  // nothing is known of what is safe
    QVERIFY(master.setSignalValue("torque", 0.5));
    QVERIFY(master.setSignalValue("brake", 0));
    QVERIFY(master.initializeAllStates());
    QVERIFY(master.waitForState(QPlcMasterNode::Ready));
    QTRY_COMPARE(m_bench.device->torque.load(), 30.0);
    QTRY_COMPARE(m_bench.device->brake.load(), 1.0);
    QVERIFY(WinchBench::start(master));
    QTRY_COMPARE(m_bench.device->torque.load(), 5.0);
    master.stop();
    QTRY_COMPARE(m_bench.device->torque.load(), 30.0);
    QTRY_COMPARE(m_bench.device->brake.load(), 1.0);
    QVERIFY(m_bench.device->torqueWasSafe);
    node.disconnectFromMaster();
}

void tst_HardwareNode::safeValuesAreWrittenWhenTheDeviceRecovers()
{
    QFETCH(QString, kind);
    QFETCH(int, pace);
    m_bench.pace = QPlcDriver::Pace(pace);
    TestMaster master(QPlcClock::realTime(), winchTable());
    QVERIFY(master.listen());
    QPlcHardwareNode node;
    QVERIFY(node.configure(wiring, "winch.ini"));
    QVERIFY(master.admit(node, kind));
    QVERIFY(master.setSignalValue("torque", 0.5));
    QVERIFY(WinchBench::start(master));
    QTRY_COMPARE(m_bench.device->torque.load(), 5.0);
    QSignalSpy safe(&node, &QPlcHardwareNode::safeStateEntered);
    m_bench.device->isFull = true;
    master.stop();
    QTRY_COMPARE(safe.size(), 1);
    QCOMPARE(m_bench.device->torque.load(), 5.0);
    m_bench.device->isFull = false;
    QTRY_COMPARE(m_bench.device->torque.load(), 30.0);
    node.disconnectFromMaster();
}

void tst_HardwareNode::theDeviceIsSafeWhenTheMasterIsLost()
{
    QFETCH(QString, kind);
    QFETCH(int, pace);
    if (kind == QLatin1String("local"))
        return;  // it ends with its master
    m_bench.pace = QPlcDriver::Pace(pace);
    auto master = std::make_unique<TestMaster>(QPlcClock::realTime(), winchTable());
    QVERIFY(master->listen());
    QPlcHardwareNode node;
    QVERIFY(node.configure(wiring, "winch.ini"));
    QVERIFY(master->admit(node, kind));
    QVERIFY(master->setSignalValue("torque", 0.5));
    QVERIFY(WinchBench::start(*master));
    QTRY_COMPARE(m_bench.device->torque.load(), 5.0);
    LogCapture log;
    master.reset();
    QTRY_COMPARE(m_bench.device->torque.load(), 30.0);
    QTRY_COMPARE(m_bench.device->brake.load(), 1.0);
    node.disconnectFromMaster();
}

/// Nobody has asked for a watchdog, and the control connection stays.
void tst_HardwareNode::theDeviceIsSafeWhenTheLinkIsCut()
{
    TestMaster master(QPlcClock::realTime(), winchTable());
    QVERIFY(master.listen());
    QPlcHardwareNode node;
    QVERIFY(node.configure(wiring, "winch.ini"));
    QVERIFY(node.setFaultPlan(QStringLiteral("cut=100ms")));
    QVERIFY(master.admit(node, "udp"));
    QVERIFY(master.setSignalValue("torque", 0.5));
    QSignalSpy barked(&node, &QPlcSlaveNode::watchdogTimedOut);
    LogCapture log;
    QVERIFY(WinchBench::start(master));
    QTRY_COMPARE(m_bench.device->torque.load(), 5.0);
    QTRY_COMPARE(m_bench.device->torque.load(), 30.0);
    QTRY_COMPARE(m_bench.device->brake.load(), 1.0);
    QTRY_COMPARE(barked.size(), 1);
    node.disconnectFromMaster();
}

void tst_HardwareNode::watchdogCanBeChangedOrDisabled()
{
    QPlcHardwareNode node;
    QCOMPARE(node.watchdog(), std::chrono::nanoseconds(500'000'000));
    node.activateWatchdog(0.02);
    QCOMPARE(node.watchdog(), std::chrono::nanoseconds(20'000'000));
    node.activateWatchdog(0.0);
    QCOMPARE(node.watchdog(), std::chrono::nanoseconds(0));
    QCOMPARE(CounterNode().watchdog(), std::chrono::nanoseconds(0));  // a node that drives nothing has none
}

void tst_HardwareNode::theWatchdogIsNoShorterThanFourPeriods()
{
    TestMaster master(QPlcClock::scaled(2.0), winchTable());
    QVERIFY(master.setInterval(0.6));
    QVERIFY(master.listen());
    QPlcHardwareNode node;
    QVERIFY(node.configure(wiring, "winch.ini"));
    QVERIFY(master.admit(node, "udp"));
    QSignalSpy barked(&node, &QPlcSlaveNode::watchdogTimedOut);
    QVERIFY(WinchBench::start(master));
    QVERIFY(master.waitForCycles(3));
    QCOMPARE(barked.size(), 0);
    node.disconnectFromMaster();
}

void tst_HardwareNode::theDeviceOfAListenerIsSafeWhenThePlantStopsSafely()
{
    QFETCH(QString, kind);
    QFETCH(int, pace);
    m_bench.pace = QPlcDriver::Pace(pace);
    TestMaster master(QPlcClock::realTime(), winchTable());
    QVERIFY(master.listen());
    QPlcHardwareNode node;
    node.setListener(true);
    QVERIFY(node.configure("[node]\nname = Lamp\n[lamp]\ndriver = bench\ndevice = b\n[lamp.write]\n"
                           "torque = torque * 10\nbrake = 0\n[lamp.safe]\nbrake = 1\n",
                           "lamp.ini"));
    QVERIFY(master.admit(node, kind));
    QVERIFY(master.setSignalValue("torque", 0.5));
    QVERIFY(WinchBench::start(master));
    QTRY_COMPARE(m_bench.device->torque.load(), 5.0);
    QTRY_COMPARE(m_bench.device->brake.load(), 0.0);
    LogCapture log;
    master.safeStop();
    QTRY_COMPARE(m_bench.device->brake.load(), 1.0);
    QVERIFY(master.waitForCycles(master.statistics().cycles + 20));
    QCOMPARE(m_bench.device->torque.load(), 30.0);
    QCOMPARE(m_bench.device->brake.load(), 1.0);
    QVERIFY(m_bench.device->torqueWasSafe);
    node.disconnectFromMaster();
}

void tst_HardwareNode::configuredSafeValueOverridesTheTable()
{
    TestMaster master(QPlcClock::realTime(), winchTable());
    {
        QPlcHardwareNode node;
        QVERIFY(node.configure(wiring + "[drive.safe]\ntorque = -2\n", "winch.ini"));
        node.openDevices();
        QTRY_COMPARE(m_bench.device->torque.load(), -2.0);  // before there is a master
        QVERIFY(master.addLocalNode(&node));
        QVERIFY(master.setSignalValue("torque", 0.5));
        QVERIFY(WinchBench::start(master));
        QTRY_COMPARE(m_bench.device->torque.load(), 5.0);
        master.stop();
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        QTRY_COMPARE(m_bench.device->torque.load(), -2.0);
        QVERIFY(WinchBench::start(master));
        QTRY_COMPARE(m_bench.device->torque.load(), 5.0);
    }
    QCOMPARE(m_bench.device->torqueAtClose.load(), -2.0);  // the node has ended in the middle of a phase
    QCOMPARE(m_bench.device->closed.load(), 1);
}

void tst_HardwareNode::lostDeviceIsHeldThenSafeAndReconnects()
{
    TestMaster master(QPlcClock::realTime(), winchTable());
    QPlcHardwareNode node;
    QVERIFY(node.configure(wiring, "winch.ini"));
    QSignalSpy failed(&node, &QPlcHardwareNode::deviceFailed);
    QSignalSpy opened(&node, &QPlcHardwareNode::deviceOpened);
    m_bench.device->speed = 4.0;
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(WinchBench::start(master));
    QTRY_COMPARE(master.signalValue("speed").toReal(), 9.0);
    QTRY_COMPARE(opened.size(), 1);
    LogCapture log;
    m_bench.device->isPlugged = false;
    m_bench.device->isBroken = true;
    QTRY_COMPARE(master.signalQuality("speed").kind(), QPlcQuality::Safe);
    QCOMPARE(master.signalValue("speed").toReal(), -7.0);
    QCOMPARE(master.signalValue("online").toInt(), 0);
    QTRY_COMPARE(failed.size(), 2);
    QCOMPARE(failed.at(1).at(1).toString(), QString("there is no device 'bench0'; plug it in"));
    QCOMPARE(node.drivers().first().failures, quint64(1));
    QTRY_VERIFY(!log.matching("device 'drive': there is no device 'bench0'; plug it in (trying again)").isEmpty());
    m_bench.device->isBroken = false;
    m_bench.device->isPlugged = true;
    QTRY_COMPARE(master.signalValue("speed").toReal(), 9.0);
    QCOMPARE(master.signalQuality("speed").kind(), QPlcQuality::Good);
    QTRY_COMPARE(opened.size(), 2);
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
}

void tst_HardwareNode::whatADeviceTellsIsInTheLogOfTheMaster()
{
    QFETCH(QString, kind);
    QFETCH(int, pace);
    m_bench.pace = QPlcDriver::Pace(pace);
    TestMaster master(QPlcClock::realTime(), winchTable());
    QVERIFY(master.listen());
    QPlcHardwareNode node;
    QVERIFY(node.configure(wiring, "winch.ini"));
    QSignalSpy told(&node, &QPlcHardwareNode::deviceEvent);
    QVERIFY(master.admit(node, kind));
    QVERIFY(WinchBench::start(master));
    QTRY_VERIFY(node.drivers().first().isOnline);
    LogCapture log;
    for (const quint64 event : {1, 2, 7}) {
        m_bench.device->event = event;
        QTRY_COMPARE(told.size(), event == 7 ? 3 : int(event));
    }
    const auto last = told.last().first().value<QPlcDeviceEvent>();
    QCOMPARE(last.data, quint64(7));
    QCOMPARE(last.driver, node.drivers().first().name);
    QTRY_COMPARE(reports(master).size(), 3);
    const QStringList events = reports(master);
    const QString begin = QStringLiteral("node %1: ").arg(node.name());
    QCOMPARE(events.at(0), QStringLiteral("warning %1the motor is hot").arg(begin));
    QVERIFY2(events.at(1).startsWith(QStringLiteral("info %1the motor is cold, after").arg(begin)),
             qPrintable(events.at(1)));
    QCOMPARE(events.at(2), QStringLiteral("info %1device '%2' tells the event 7").arg(begin, last.driver));
    QCOMPARE(log.matching("the motor is hot").size(), 2);  // of the node, and of the master
    node.disconnectFromMaster();
}

void tst_HardwareNode::aLostDeviceIsAnAlarmUntilItIsBack()
{
    TestMaster master(QPlcClock::realTime(), winchTable());
    QVERIFY(master.listen());
    QPlcHardwareNode node;
    QVERIFY(node.configure(wiring, "winch.ini"));
    QVERIFY(master.admit(node, "tcp"));
    QVERIFY(WinchBench::start(master));
    QTRY_VERIFY(node.drivers().first().isOnline);
    LogCapture log;
    m_bench.device->isPlugged = false;
    m_bench.device->isBroken = true;
    QTRY_VERIFY(!reports(master).isEmpty());
    QVERIFY2(reports(master).first().startsWith("error node "), qPrintable(reports(master).first()));
    QVERIFY(reports(master).first().contains("read from the bench"));
    m_bench.device->isBroken = false;
    m_bench.device->isPlugged = true;
    QTRY_VERIFY(reports(master).last().contains("is open, after"));
    node.disconnectFromMaster();
}

void tst_HardwareNode::valuesOutOfSignalRangeAreNotAccepted()
{
    TestMaster master(QPlcClock::realTime(), winchTable());
    QPlcHardwareNode node("Winch");
    QVERIFY(node.configure("[drive]\ndriver = bench\ndevice = b\n[drive.read]\nsmall = speed\n", "winch.ini"));
    m_bench.device->speed = 127.4;
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(WinchBench::start(master));
    QTRY_COMPARE(master.signalValue("small").toInt(), 127);
    m_bench.device->speed = 127.6;
    QTRY_COMPARE(master.signalQuality("small").kind(), QPlcQuality::Safe);
    m_bench.device->speed = -128.4;
    QTRY_COMPARE(master.signalValue("small").toInt(), -128);
    m_bench.device->speed = qQNaN();
    QTRY_COMPARE(master.signalQuality("small").kind(), QPlcQuality::Safe);
}

void tst_HardwareNode::elementsOfAnArrayComeFromDifferentChannels()
{
    TestMaster master(QPlcClock::realTime(), winchTable());
    QPlcHardwareNode node("Winch");
    QVERIFY(node.configure(
        "[drive]\ndriver = bench\ndevice = b\n[drive.read]\npair[1] = speed * 3\npair[0] = @failures + 8\n",
        "winch.ini"));
    m_bench.device->speed = 2.0;
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(WinchBench::start(master));
    QTRY_COMPARE(master.signalValue("pair").toString(), QString("8, 6"));
}

void tst_HardwareNode::signalsAndConstantsCanDriveChannels()
{
    TestMaster master(QPlcClock::realTime(), winchTable());
    QPlcHardwareNode node("Winch");
    QVERIFY(node.configure("[a]\ndriver = bench\ndevice = b\n[a.write]\ntorque = torque * 2\nbrake = torque\n",
                           "winch.ini"));
    QPlcHardwareNode enabler("Enabler");
    const auto other = std::make_shared<BenchDevice>();
    QPlcHardwareNode::addDriverKind("bench", "memory of the test",
                                    [=] { return std::make_unique<BenchDriver>(other, QPlcDriver::EveryCycle); });
    QVERIFY(enabler.configure("[b]\ndriver = bench\ndevice = b\n[b.write]\nbrake = 1\n[b.safe]\nbrake = 0\n", "e.ini"));
    QCOMPARE(enabler.wires().size(), 1);
    QCOMPARE(enabler.wires().first().signal, QString("1"));
    enabler.openDevices();
    QTRY_COMPARE(other->brake.load(), 0.0);
    QVERIFY(master.addLocalNode(&node) && master.addLocalNode(&enabler));
    QVERIFY(master.setSignalValue("torque", 0.75));
    QVERIFY(WinchBench::start(master));
    QTRY_COMPARE(m_bench.device->torque.load(), 1.5);
    QTRY_COMPARE(m_bench.device->brake.load(), 1.0);
    QTRY_COMPARE(other->brake.load(), 1.0);
    master.stop();
    QTRY_COMPARE(other->brake.load(), 0.0);
}

void tst_HardwareNode::devicesAreNotClosedWhileCyclesRun()
{
    QFETCH(QString, kind);
    QFETCH(int, pace);
    m_bench.pace = QPlcDriver::Pace(pace);
    TestMaster master(QPlcClock::realTime(), winchTable());
    QVERIFY(master.listen());
    QPlcHardwareNode node;
    QVERIFY(node.configure(wiring, "winch.ini"));
    QVERIFY(master.admit(node, kind));
    QVERIFY(master.setSignalValue("torque", 0.5));
    QVERIFY(WinchBench::start(master));
    QTRY_COMPARE(m_bench.device->torque.load(), 5.0);
    {
        LogCapture log;
        node.closeDevices();
        QCOMPARE(log.matching("Winch: devices are not closed while cycles run; stop the real-time phase first").size(),
                 1);
    }
    QCOMPARE(m_bench.device->closed.load(), 0);
    QVERIFY(node.drivers().first().isOnline);
    master.stop();
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Registered);
    node.closeDevices();
    QCOMPARE(m_bench.device->closed.load(), 1);
    QCOMPARE(m_bench.device->torqueAtClose.load(), 30.0);
    node.disconnectFromMaster();
}

void tst_HardwareNode::aSignalThatIsNotInTheTableIsNamed()
{
    TestMaster master(QPlcClock::realTime(), winchTable());
    QPlcHardwareNode node("Winch");
    QVERIFY(node.configure("[drive]\ndriver = bench\ndevice = b\n[drive.read]\nspede = speed\npair[0] = speed\n",
                           "winch.ini"));
    LogCapture log;
    QVERIFY(!master.addLocalNode(&node));
    const QString text = log.all().join('\n');
    QVERIFY2(text.contains("spede") && text.contains("did you mean 'speed'?"), qPrintable(text));
    QVERIFY2(text.contains("signal 'pair' is Real32[2] in the table, but the node writes it as 1 numbers"),
             qPrintable(text));
}

void tst_HardwareNode::cycleAllocatesNothingAndLocksNothing()
{
    QFETCH(QString, kind);
    QFETCH(int, pace);
    if (!ThreadCosts::areCounted())
        QSKIP("the sanitizer owns malloc", "");
    /// Tells the counter which thread the cycles run on.
    class Watched : public QPlcHardwareNode
    {
        void step(const QPlcCycle &cycle) override
        {
            ThreadCosts::watchThisThread();
            QPlcHardwareNode::step(cycle);
        }
    };
    m_bench.pace = QPlcDriver::Pace(pace);
    TestMaster master(QPlcClock::lockstep(), winchTable());
    QVERIFY(master.listen());
    Watched node;
    QVERIFY(node.configure(wiring, "winch.ini"));
    QVERIFY(master.admit(node, kind));
    node.openDevices();
    QTRY_VERIFY(node.drivers().first().isOnline);
    master.setCycleLimit(5000);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(100));
    const ThreadCosts before = ThreadCosts::ofWatchedThreads();
    QVERIFY(master.waitForCycles(4900));
    const ThreadCosts spent = ThreadCosts::ofWatchedThreads() - before;
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(spent.allocations, std::uint64_t(0));
    QCOMPARE(spent.locks, std::uint64_t(0));
    node.disconnectFromMaster();
}

QTEST_GUILESS_MAIN(tst_HardwareNode)
#include "tst_HardwareNode.moc"
