// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"

// SetSignals with a duration, from tools at the control channel of a master.
class tst_TemporarySettings : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void formerValueIsRestoredAfterTheDuration_data();
    void formerValueIsRestoredAfterTheDuration();
    void formerValueIsRestoredWhenTheConnectionEnds_data();
    void formerValueIsRestoredWhenTheConnectionEnds();
    void permanentSettingEndsATemporaryOne();
    void formerValueIsTheNewestSettingEvenBeforeACycle();
    void renewedValueStaysUntilTheLastDuration();
    void restoringDoesNotOverwriteTheValuesOfANode();
    void moreSignalsThanFitIntoOneCycleAreRestored();
    void badDurationsAreRefused_data();
    void badDurationsAreRefused();

private:
    static constexpr double forLong = 1e15;  // [ns], the longest one
    static constexpr double briefly = 50e6;  // [ns]
    QPlcMessage set(ScriptedTool &tool, const QString &value, double duration)
    {
        return tool.ask(QPlcMessage::SetSignals,
                        {{"values", QJsonObject{{"setpoint", value}}}, {"duration", duration}});
    }
    QPlcMessage set(ScriptedTool &tool, const QString &value)
    {
        return tool.ask(QPlcMessage::SetSignals, {{"values", QJsonObject{{"setpoint", value}}}});
    }
    QString setpoint() const { return m_master->signalValue("setpoint").toString(); }
    bool startIf(bool running)
    {
        return !running
            || (m_master->startRealTime() && m_tool->waitForMessage(QPlcMessage::StatesInitialized)
                && m_master->waitForState(QPlcMasterNode::RealTime));
    }
    QScopedPointer<TestMaster> m_master;
    QScopedPointer<ScriptedTool> m_tool;
};

void tst_TemporarySettings::init()
{
    m_tool.reset();
    m_master.reset(new TestMaster(QPlcClock::realTime()));
    QVERIFY(m_master->listen());
    m_tool.reset(new ScriptedTool);
    QVERIFY(m_tool->greetAt(m_master->serverPort()));
}

void tst_TemporarySettings::formerValueIsRestoredAfterTheDuration_data()
{
    QTest::addColumn<bool>("running");
    QTest::newRow("off") << false;
    QTest::newRow("running") << true;
}

void tst_TemporarySettings::formerValueIsRestoredAfterTheDuration()
{
    QFETCH(bool, running);
    QCOMPARE(set(*m_tool, "1.5").kind(), QPlcMessage::Done);
    QVERIFY(startIf(running));
    m_tool->forgetMessages();
    QElapsedTimer clock;
    clock.start();
    QCOMPARE(set(*m_tool, "5", briefly).kind(), QPlcMessage::Done);
    QTRY_COMPARE(setpoint(), QString("5"));
    QTRY_COMPARE(setpoint(), QString("1.5"));
    QVERIFY(double(clock.nsecsElapsed()) >= briefly);
    m_master->stop();
}

void tst_TemporarySettings::formerValueIsRestoredWhenTheConnectionEnds_data()
{
    formerValueIsRestoredAfterTheDuration_data();
}

void tst_TemporarySettings::formerValueIsRestoredWhenTheConnectionEnds()
{
    QFETCH(bool, running);
    QVERIFY(startIf(running));
    ScriptedTool other;
    QVERIFY(other.greetAt(m_master->serverPort()));
    m_tool->forgetMessages();
    QCOMPARE(set(*m_tool, "5", forLong).kind(), QPlcMessage::Done);
    QTRY_COMPARE(setpoint(), QString("5"));
    other.control.abort();
    QTest::qWait(20);
    QCOMPARE(setpoint(), QString("5"));
    m_tool->control.abort();
    QTRY_COMPARE(setpoint(), QString("0"));
    m_master->stop();
}

void tst_TemporarySettings::permanentSettingEndsATemporaryOne()
{
    set(*m_tool, "5", forLong);
    set(*m_tool, "6");
    QCOMPARE(setpoint(), QString("6"));
    m_tool->control.abort();
    QTest::qWait(20);
    QCOMPARE(setpoint(), QString("6"));
    // The master itself sets for good, too.
    ScriptedTool other;
    QVERIFY(other.greetAt(m_master->serverPort()));
    set(other, "5", forLong);
    QVERIFY(m_master->setSignalValue("setpoint", 7.0));
    other.control.abort();
    QTest::qWait(20);
    QCOMPARE(setpoint(), QString("7"));
}

void tst_TemporarySettings::formerValueIsTheNewestSettingEvenBeforeACycle()
{
    m_master->setInterval(0.2);
    QVERIFY(startIf(true));
    m_tool->forgetMessages();
    QVERIFY(m_master->waitForCycles(1));
    QCOMPARE(set(*m_tool, "3").kind(), QPlcMessage::Done);
    QCOMPARE(set(*m_tool, "5", 1.0).kind(), QPlcMessage::Done);  // over before the next cycle
    QVERIFY(m_master->waitForCycles(m_master->statistics().cycles + 2));
    QTRY_COMPARE(setpoint(), QString("3"));
    m_master->stop();
}

void tst_TemporarySettings::renewedValueStaysUntilTheLastDuration()
{
    set(*m_tool, "5", briefly);
    set(*m_tool, "6", forLong);
    QTest::qWait(100);
    QCOMPARE(setpoint(), QString("6"));
    set(*m_tool, "6", briefly);
    QTRY_COMPARE(setpoint(), QString("0"));
}

void tst_TemporarySettings::restoringDoesNotOverwriteTheValuesOfANode()
{
    CounterNode counter;
    QVERIFY(m_master->setSignalValue("sum", 3.0));
    QJsonObject values{{"sum", "5"}, {"setpoint", "5"}};
    QCOMPARE(m_tool->ask(QPlcMessage::SetSignals, {{"values", values}, {"duration", forLong}}).kind(),
             QPlcMessage::Done);
    QVERIFY(m_master->addLocalNode(&counter));  // writes sum
    QVERIFY(m_master->initializeAllStates());
    m_tool->control.abort();
    QTRY_COMPARE(setpoint(), QString("0"));
    QCOMPARE(m_master->signalValue("sum").toString(), QString("0"));
    QVERIFY(m_master->startRealTime());
    QVERIFY(m_master->waitForCycles(3));
    QVERIFY(m_master->signalValue("count").toInt() > 0);
    m_master->stop();
}

void tst_TemporarySettings::moreSignalsThanFitIntoOneCycleAreRestored()
{
    QByteArray ini;
    QJsonObject some[2];
    for (int i = 0; i < 400; ++i) {
        ini += "[s" + QByteArray::number(i) + "]\ntype = Int32\n";
        some[i % 2].insert(QString("s%1").arg(i), "2");
    }
    TestMaster master(QPlcClock::realTime(), QPlcSignalTable::fromIni(ini));
    master.setInterval(0.001);
    QVERIFY(master.listen());
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QCOMPARE(tool.next().kind(), QPlcMessage::StatesInitialized);
    for (const QJsonObject &values : some) {
        QVERIFY(master.waitForCycles(master.statistics().cycles + 2));
        QCOMPARE(tool.ask(QPlcMessage::SetSignals, {{"values", values}, {"duration", forLong}}).kind(),
                 QPlcMessage::Done);
    }
    QTRY_COMPARE(master.signalValue("s399").toInt(), 2);
    tool.control.abort();
    for (int i = 0; i < 400; ++i)
        QTRY_COMPARE(master.signalValue(QString("s%1").arg(i)).toInt(), 0);
    master.stop();
}

void tst_TemporarySettings::badDurationsAreRefused_data()
{
    QTest::addColumn<QJsonValue>("duration");
    QTest::newRow("zero") << QJsonValue(0);
    QTest::newRow("negative") << QJsonValue(-1);
    QTest::newRow("a fraction") << QJsonValue(1.5);
    QTest::newRow("too long") << QJsonValue(1.1e15);
    QTest::newRow("a text") << QJsonValue("5 s");
    QTest::newRow("null") << QJsonValue();
}

void tst_TemporarySettings::badDurationsAreRefused()
{
    QFETCH(QJsonValue, duration);
    const QPlcMessage failed
        = m_tool->ask(QPlcMessage::SetSignals, {{"values", QJsonObject{{"setpoint", "5"}}}, {"duration", duration}});
    QCOMPARE(failed.kind(), QPlcMessage::Failed);
    QCOMPARE(failed.text("error"), QString("MalformedMessage"));
    QVERIFY2(failed.text("text").contains("'duration'"), qPrintable(failed.text("text")));
    QCOMPARE(setpoint(), QString("0"));
}

QTEST_GUILESS_MAIN(tst_TemporarySettings)
#include "tst_TemporarySettings.moc"
