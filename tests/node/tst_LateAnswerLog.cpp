// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QRegularExpression>

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

namespace {

struct LateLine
{
    quint64 cycle;
    int untold;  // -1: says nothing of further ones
};

QVector<LateLine> parse(const QStringList &lines)
{
    static const QRegularExpression pattern(
        "was late in cycle (\\d+)(?: \\(and (\\d+) more since the last report\\))?");
    QVector<LateLine> parsed;
    for (const QString &line : lines) {
        const QRegularExpressionMatch match = pattern.match(line);
        parsed << LateLine{match.captured(1).toULongLong(),
                           match.captured(2).isEmpty() ? -1 : match.captured(2).toInt()};
    }
    return parsed;
}

}  // namespace

void tst_LateAnswerLog::lateAnswersAreCountedInOneLinePerSecond()
{
    LogCapture log;
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.setInterval(0.010));
    QVERIFY(master.listen());
    ScriptedNode mute;  // joins, and never answers a cycle
    QVERIFY(mute.registerAt(master.serverPort()));
    QSignalSpy violated(&master, &QPlcMasterNode::realTimeViolated);
    QElapsedTimer timer;
    timer.start();
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(log.matching("was late in cycle").size() >= 2);
    master.stop();
    const QVector<LateLine> lines = parse(log.matching("was late in cycle"));
    QVERIFY(lines.size() <= 1 + timer.elapsed() / 1000);
    QCOMPARE(lines.at(0).untold, -1);
    QVERIFY(lines.at(1).untold > 0);
    int between = 0;
    for (const QList<QVariant> &violation : violated) {
        QCOMPARE(violation.at(0).toString(), QString("Scripted"));
        const quint64 cycle = violation.at(1).toULongLong();
        between += cycle > lines.at(0).cycle && cycle < lines.at(1).cycle;
    }
    QCOMPARE(lines.at(1).untold, between);  // every one of them is a signal of its own all the same
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
    QTest::qWait(50);
    master.stop();
    QCOMPARE(violated.isEmpty(), isSilent);
    QCOMPARE(log.matching("was late").isEmpty(), isSilent);
}

QTEST_GUILESS_MAIN(tst_LateAnswerLog)
#include "tst_LateAnswerLog.moc"
