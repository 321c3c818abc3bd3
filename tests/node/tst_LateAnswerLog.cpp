// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"
#include "VirtualTime.h"

using namespace std::chrono_literals;

// A node that is late in every cycle does not flood the log: a line at once, then one a second that
// tells how many there were.
class tst_LateAnswerLog : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void lateAnswersAreCountedInOneLinePerSecond();
    void everyNodeHasLinesOfItsOwn();
    void silentPoliciesLogNothing_data();
    void silentPoliciesLogNothing();
};

void tst_LateAnswerLog::lateAnswersAreCountedInOneLinePerSecond()
{
    LogCapture log;
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.setInterval(0.010));
    QVERIFY(master.listen());
    ScriptedNode mute;  // joins, and never answers a cycle
    QVERIFY(mute.registerAt(master.serverPort()));
    QSignalSpy violated(&master, &QPlcMasterNode::realTimeViolated);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    pass(1995ms);
    master.stop();
    const QString late = "qtplc.master: node Scripted was late in cycle ";
    const QString more = " (and 99 more since the last report)";
    QCOMPARE(log.matching("was late in cycle"), (QStringList{late + "0", late + "100" + more}));
    QCOMPARE(violated.size(), 199);  // every one of them is a signal of its own all the same
    for (int i = 0; i < violated.size(); ++i)
        QCOMPARE(violated.at(i), (QVariantList{"Scripted", quint64(i)}));
}

void tst_LateAnswerLog::everyNodeHasLinesOfItsOwn()
{
    LogCapture log;
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.setInterval(0.002));
    QVERIFY(master.listen());
    ScriptedNode first("First");
    ScriptedNode second("Second");
    second.outputs = QStringList{"sum"};
    QVERIFY(first.registerAt(master.serverPort()));
    QVERIFY(second.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(!log.matching("node First was late").isEmpty());
    QTRY_VERIFY(!log.matching("node Second was late").isEmpty());
    master.stop();
}

void tst_LateAnswerLog::silentPoliciesLogNothing_data()
{
    QTest::addColumn<QString>("policy");
    QTest::addColumn<bool>("isSilent");
    QTest::newRow("hold, silent") << "SilentZeroOrderHold" << true;
    QTest::newRow("hold, error") << "ErrorZeroOrderHold" << false;
    QTest::newRow("wait, silent") << "SilentWait" << true;
    QTest::newRow("wait, error") << "ErrorWait" << false;
}

void tst_LateAnswerLog::silentPoliciesLogNothing()
{
    QFETCH(QString, policy);
    QFETCH(bool, isSilent);
    LogCapture log;
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.setInterval(0.002));
    QVERIFY(master.listen());
    ScriptedNode mute;
    mute.policy = policy;
    QVERIFY(mute.registerAt(master.serverPort()));
    QSignalSpy violated(&master, &QPlcMasterNode::realTimeViolated);
    QVERIFY(master.startRealTime());
    const quint64 least = policy.endsWith("Hold") ? 20 : 1;
    QTRY_VERIFY(master.statistics().lateAnswers >= least);  // counted they are
    pass(50ms);
    master.stop();
    QCOMPARE(violated.isEmpty(), isSilent);
    QCOMPARE(log.matching("was late").isEmpty(), isSilent);
}

QTPLC_VIRTUAL_TIME_MAIN(tst_LateAnswerLog)
#include "tst_LateAnswerLog.moc"
