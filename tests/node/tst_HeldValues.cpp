// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "QualityFixtures.h"
#include "VirtualTime.h"

using namespace std::chrono_literals;

// Values without a good new one: for how long they are held, and what people are told.
class tst_HeldValues : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void skippedCyclesCountAsHoldTime();
    void initialOutputsOfAJoinerReachTheMaster();
    void signalOscillatingAtItsLimitRaisesOneAlarm();
};

void tst_HeldValues::skippedCyclesCountAsHoldTime()
{
    TestMaster master(QPlcClock::realTime(), qualityTable());
    master.setInterval(0.02);
    Actuator actuator;
    actuator.afterStep = [&] {
        if (actuator.record.last() == QLatin1String("19 held 1"))
            beBusyFor(150ms);  // the master leaves out more cycles than the value may be held
    };
    QVERIFY(master.addLocalNode(&actuator));
    QVERIFY(master.listen());
    ScriptedNode writer;
    writer.table = qualityTable();
    writer.onRequest = [&](const ScriptedNode::Request &request) {
        if (request.cycle < 20)
            writer.answer(request.cycle, QPlcValue(19.0).toBytes());
    };
    QVERIFY(writer.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(master.cycle() > 40);
    master.stop();
    QCOMPARE(master.statistics().skippedCycles, quint64(6));
    QCOMPARE(actuator.record.indexOf("19 held 1"), 21);
    QCOMPARE(actuator.record.at(22), QString("-5 safe"));
}

void tst_HeldValues::initialOutputsOfAJoinerReachTheMaster()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.002);
    QVERIFY(master.listen());
    QVERIFY(master.startRealTime());
    ScriptedNode joiner;  // it never answers a request
    joiner.initialValues = QPlcValue(0.25).toBytes();
    QVERIFY(joiner.registerAt(master.serverPort()));
    QTRY_COMPARE(master.signalValue("echo").toReal(), 0.25);
    QVERIFY(master.signalQuality("echo").isUsable());
    joiner.control.abort();
    pass(1990ms);  // they are held for 1000 cycles
    QVERIFY(master.nodes().isEmpty() && master.signalQuality("echo").isUsable());
    pass(20ms);
    QCOMPARE(master.signalQuality("echo").kind(), QPlcQuality::Safe);
    QCOMPARE(master.signalValue("echo").toReal(), 0.0);
    master.stop();
}

void tst_HeldValues::signalOscillatingAtItsLimitRaisesOneAlarm()
{
    LogCapture log;
    bool isBad = true;
    TestMaster master(QPlcClock::realTime(), qualityTable());
    master.setInterval(std::chrono::milliseconds(5));
    Source source;
    source.idea = [&isBad](quint64 cycle) { return isBad && cycle % 2 == 0 ? 112.5 : 1.0; };
    QVERIFY(master.addLocalNode(&source));
    QVERIFY(master.startRealTime());
    const auto lines = [&log] { return log.matching("echo of Source").size(); };
    pass(999ms);
    QCOMPARE(master.cycleStatistics().nodes.value(0).outOfRange, quint64(100));
    QCOMPARE(lines(), 1);
    isBad = false;
    pass(980ms);
    QCOMPARE(lines(), 1);
    pass(270ms);  // after a second, at the next look
    QCOMPARE(log.matching("echo of Source: no more values are refused").size(), 1);
    QCOMPARE(lines(), 2);
    isBad = true;
    QTRY_COMPARE(lines(), 3);
    master.stop();
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(lines(), 4);
}

QTPLC_VIRTUAL_TIME_MAIN(tst_HeldValues)
#include "tst_HeldValues.moc"
