// SPDX-License-Identifier: Apache-2.0
#include "RecordedMaster.h"

#include <QtPlcTest>
#include <QtTest/QtTest>

// A test of a user's node against a recording.
class tst_QPlcReplay : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void theSameNodeIsEqual();
    void theSameProgramIsEqual();
    void anotherProgramDiffersAndTheTextSaysWhere();
    void beforeTheTimeNothingIsCompared();
    void anotherNameOfTheNodeMayBeGiven();
    void aProgramThatIsNotThereIsNamed();
    void aProgramThatWantsKeysIsToldToDoWithout();
    void aFileThatIsNotThereIsNamed();
    void beforeARunNothingIsCounted();

private:
    QString program() const { return QCoreApplication::applicationDirPath() + "/replayed_node"; }
    std::unique_ptr<RecordedMaster> m_flight;
};

void tst_QPlcReplay::initTestCase()
{
    Chain chain;
    m_flight = std::make_unique<RecordedMaster>(QPlcClock::external());
    for (QPlcSlaveNode *node : chain.all())
        QVERIFY(m_flight->addLocalNode(node));
    QVERIFY(m_flight->startRealTime());
    for (int i = 0; i < 50; ++i)
        m_flight->step();
    QVERIFY2(m_flight->finish(), qPrintable(m_flight->error));
}

void tst_QPlcReplay::theSameNodeIsEqual()
{
    Chain chain;
    QPlcReplay replay(m_flight->recording());
    QVERIFY2(replay.run(chain.second), qPrintable(replay.text()));
    QCOMPARE(replay.cycles(), quint64(50));
    QCOMPARE(replay.compared(), quint64(50));
    QCOMPARE(replay.differences(), quint64(0));
    QVERIFY(!replay.firstDifference());
    QCOMPARE(replay.text(), QString("50 cycles of node 'Second' are equal"));
}

void tst_QPlcReplay::theSameProgramIsEqual()
{
    QPlcReplay replay(m_flight->recording());
    QVERIFY2(replay.runProgram(program()), qPrintable(replay.text()));
    QCOMPARE(replay.compared(), quint64(50));
}

void tst_QPlcReplay::anotherProgramDiffersAndTheTextSaysWhere()
{
    QPlcReplay replay(m_flight->recording());
    replay.setFrom(0.02);
    QVERIFY(!replay.runProgram(program() + " --gain 0.2"));
    QVERIFY(replay.differences() > 0);
    const std::optional<QPlcReplay::Difference> first = replay.firstDifference();
    QVERIFY(first);
    QCOMPARE(first->signal, QString("s3"));
    QCOMPARE(first->cycle, quint64(10));
    QCOMPARE(first->time, 0.02);
    QVERIFY(first->recorded != first->computed);
    QCOMPARE(replay.text(),
             QString("node 'Second' differs in %1 values, first in 's3' in cycle 10 (0.02 s): recorded %2, computed %3")
                 .arg(replay.differences())
                 .arg(first->recorded, first->computed));
}

void tst_QPlcReplay::beforeTheTimeNothingIsCompared()
{
    Chain chain;
    chain.second.gain = 0.2;
    QPlcReplay replay(m_flight->recording());
    replay.setFrom(60.0);
    QVERIFY(!replay.run(chain.second));
    QCOMPARE(replay.cycles(), quint64(50));
    QCOMPARE(replay.compared(), quint64(0));
    QVERIFY2(replay.text().startsWith("no outputs of node 'Second' were compared: from 60 s on"),
             qPrintable(replay.text()));
}

void tst_QPlcReplay::anotherNameOfTheNodeMayBeGiven()
{
    Probe renamed("Renamed", {{"s1", QPlcInputTiming::SameCycle}, {"s2"}, {"s4"}}, {"s3"});
    QPlcReplay replay(m_flight->recording());
    QVERIFY(!replay.run(renamed));
    QVERIFY2(replay.text().contains("no node 'Renamed'"), qPrintable(replay.text()));
    replay.setNodeName("Second");
    QVERIFY2(replay.run(renamed), qPrintable(replay.text()));
}

void tst_QPlcReplay::aProgramThatIsNotThereIsNamed()
{
    QPlcReplay replay(m_flight->recording());
    QVERIFY(!replay.runProgram("/nowhere/winch"));
    QVERIFY2(replay.text().contains("/nowhere/winch"), qPrintable(replay.text()));
    QVERIFY(!replay.runProgram(QString()));
    QVERIFY2(replay.text().contains("no program is given"), qPrintable(replay.text()));
}

void tst_QPlcReplay::aProgramThatWantsKeysIsToldToDoWithout()
{
    QPlcReplay replay(m_flight->recording());
    QVERIFY(!replay.runProgram(program() + " --security psk --keys keys.txt"));
    QVERIFY2(replay.text().contains("leave out --security"), qPrintable(replay.text()));
}

void tst_QPlcReplay::aFileThatIsNotThereIsNamed()
{
    Chain chain;
    QPlcReplay replay("/nowhere/flight.mcap");
    QVERIFY(!replay.run(chain.second));
    QVERIFY2(replay.text().contains("/nowhere/flight.mcap"), qPrintable(replay.text()));
}

void tst_QPlcReplay::beforeARunNothingIsCounted()
{
    const QPlcReplay replay(m_flight->recording());
    QCOMPARE(replay.cycles(), quint64(0));
    QCOMPARE(replay.text(), QString("nothing was replayed yet"));
}

QTEST_GUILESS_MAIN(tst_QPlcReplay)
#include "tst_QPlcReplay.moc"
