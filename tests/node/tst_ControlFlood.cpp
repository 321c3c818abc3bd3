// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "NodeFixtures.h"
#include "ScriptedNode.h"

#include <memory>
#include <vector>

namespace {

constexpr int Questions = 400;
constexpr int Signals = 300;

QPlcSignalTable largeTable()
{
    QByteArray ini = "[setpoint]\ntype = Real64\n";
    for (int i = 1; i < Signals; ++i)
        ini += "[signal_" + QByteArray::number(i) + "]\ntype = Real64[4]\nunit = m/s\n";
    return QPlcSignalTable::fromIni(ini);
}

}  // namespace

// Tools that ask for more than a master can answer soon: what a person wants at once, and in which
// order the answers come.
class tst_ControlFlood : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void stopOfOneToolDoesNotWaitForQuestionsOfOthers();
    void stopDoesNotWaitForEarlierQuestionsOfItsTool();
    void safeStopDoesNotWaitForEarlierQuestionsOfItsTool();
    void leaseIsReleasedBeforeEarlierQuestionsAreAnswered();
    void commandThatAStopHasOvertakenIsRefused();
    void stopOvertakesNothingThatIsAnsweredAtOnce();
    void stopOfAToolThatReadsNothingIsCarriedOut();
    void answersInPortionsAreComplete();
    void answerThatIsTooLongIsRefused();
    void scheduleInPortionsIsComplete();
    void scheduleThatIsTooLongIsRefused();

private:
    static void ask(ScriptedTool &tool, QPlcMessage::Kind kind, int times = Questions)
    {
        for (int i = 0; i < times; ++i)
            tool.send(kind);
    }
    /// How many answers the tools have when the master leaves the state RealTime.
    int answersUntilTheStop();
    std::unique_ptr<ScriptedTool> newTool(const char *name)
    {
        auto tool = std::make_unique<ScriptedTool>(name);
        return tool->greetAt(m_master->serverPort()) ? std::move(tool) : nullptr;
    }
    static std::unique_ptr<ScriptedNode> listenerToAll(const TestMaster &master, int number)
    {
        auto node = std::make_unique<ScriptedNode>(QStringLiteral("Listener%1").arg(number));
        node->table = master.signalTable();
        node->onlyListen();
        node->inputs.clear();
        for (const QPlcSignalDefinition &signal : node->table)
            node->inputs << signal.name;
        return node->registerAt(master.serverPort()) ? std::move(node) : nullptr;
    }
    int answers() const
    {
        int count = 0;
        for (const auto &tool : m_tools)
            count += tool->messages.size();
        return count;
    }

    std::unique_ptr<TestMaster> m_master;
    std::unique_ptr<CounterNode> m_counter;
    std::vector<std::unique_ptr<ScriptedTool>> m_tools;
};

void tst_ControlFlood::init()
{
    m_tools.clear();
    m_counter.reset();
    m_master = std::make_unique<TestMaster>(QPlcClock::realTime(), largeTable());
    m_master->setInterval(0.01);
    QVERIFY(m_master->listen());
    for (const char *name : {"Anna", "Bert", "Carl", "Dora"}) {
        m_tools.push_back(newTool(name));
        QVERIFY(m_tools.back());
    }
    QVERIFY(m_master->startRealTime() && m_master->waitForState(QPlcMasterNode::RealTime));
    for (const auto &tool : m_tools) {
        QVERIFY(tool->waitForMessage(QPlcMessage::StatesInitialized));
        tool->forgetMessages();
    }
}

int tst_ControlFlood::answersUntilTheStop()
{
    int count = -1;
    const auto look = [&](QPlcMasterNode::State state) {
        if (count < 0 && state == QPlcMasterNode::Off)
            count = answers();
    };
    const auto connection = connect(m_master.get(), &QPlcMasterNode::stateChanged, this, look);
    (void)waitUntil([&] { return count >= 0; }, 60000);
    disconnect(connection);
    return count;
}

void tst_ControlFlood::stopOfOneToolDoesNotWaitForQuestionsOfOthers()
{
    const std::unique_ptr<ScriptedTool> operatorTool = newTool("Operator");
    QVERIFY(operatorTool);
    for (const auto &tool : m_tools)
        ask(*tool, QPlcMessage::GetSignals);
    QVERIFY(waitUntil([&] { return answers() > 0; }));  // in full flood
    operatorTool->send(QPlcMessage::Stop);
    const int served = answersUntilTheStop();
    QVERIFY2(served >= 0 && served < int(m_tools.size()) * Questions / 4, qPrintable(QString::number(served)));
    QVERIFY(operatorTool->waitForMessage(QPlcMessage::Done));
    QVERIFY2(answers() < int(m_tools.size()) * Questions / 2, qPrintable(QString::number(answers())));
}

void tst_ControlFlood::stopDoesNotWaitForEarlierQuestionsOfItsTool()
{
    ScriptedTool &anna = *m_tools.front();
    ask(anna, QPlcMessage::GetSignals);
    anna.send(QPlcMessage::Stop);
    anna.send(QPlcMessage::GetState);
    const int served = answersUntilTheStop();
    QVERIFY2(served >= 0 && served < Questions / 4, qPrintable(QString::number(served)));
    QTRY_COMPARE_WITH_TIMEOUT(anna.messages.size(), Questions + 2, 60000);
    for (int i = 0; i < Questions; ++i)
        QCOMPARE(anna.messages.at(i).kind(), QPlcMessage::Signals);
    QCOMPARE(anna.messages.at(Questions).kind(), QPlcMessage::Done);  // answers come in the order of the requests
    QCOMPARE(anna.messages.at(Questions + 1).kind(), QPlcMessage::State);
}

void tst_ControlFlood::safeStopDoesNotWaitForEarlierQuestionsOfItsTool()
{
    ScriptedTool &anna = *m_tools.front();
    ask(anna, QPlcMessage::GetSignals);
    anna.send(QPlcMessage::SafeStop);
    QVERIFY(waitUntil([&] { return m_master->state() == QPlcMasterNode::SafeStop; }, 60000));
    QVERIFY2(anna.messages.size() < Questions / 4, qPrintable(QString::number(anna.messages.size())));
    QTRY_COMPARE_WITH_TIMEOUT(anna.messages.size(), Questions + 1, 60000);
    QCOMPARE(anna.messages.last().kind(), QPlcMessage::Done);
    m_master->stop();
}

void tst_ControlFlood::leaseIsReleasedBeforeEarlierQuestionsAreAnswered()
{
    ScriptedTool &anna = *m_tools.front();
    QCOMPARE(anna.ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"setpoint"}}, {"timeout", 3.6e12}}).kind(),
             QPlcMessage::Done);
    anna.forgetMessages();
    ask(anna, QPlcMessage::GetSignals);
    anna.send(QPlcMessage::ReleaseLease);
    QVERIFY(waitUntil([&] { return m_master->leases().isEmpty(); }, 60000));
    QVERIFY2(anna.messages.size() < Questions / 4, qPrintable(QString::number(anna.messages.size())));
    QTRY_COMPARE_WITH_TIMEOUT(anna.messages.size(), Questions + 1, 60000);
    QCOMPARE(anna.messages.last().kind(), QPlcMessage::Done);
    m_master->stop();
}

/// Otherwise it would move the plant again after the stop.
void tst_ControlFlood::commandThatAStopHasOvertakenIsRefused()
{
    ScriptedTool &anna = *m_tools.front();
    ask(anna, QPlcMessage::GetSignals);
    anna.send(QPlcMessage::StartRealTime);
    anna.send(QPlcMessage::SetSignals, {{"values", QJsonObject{{"setpoint", "5"}}}});
    anna.send(QPlcMessage::Stop);
    anna.send(QPlcMessage::SetSignals, {{"values", QJsonObject{{"setpoint", "6"}}}});
    QTRY_COMPARE_WITH_TIMEOUT(anna.messages.size(), Questions + 4, 60000);
    for (int i : {0, 1}) {
        const QPlcMessage &refused = anna.messages.at(Questions + i);
        QCOMPARE(refused.text("error"), QString("WrongState"));
        QVERIFY2(refused.text("text").contains("overtaken"), qPrintable(refused.text("text")));
    }
    QCOMPARE(anna.messages.at(Questions + 2).kind(), QPlcMessage::Done);
    QCOMPARE(anna.messages.at(Questions + 3).kind(), QPlcMessage::Done);
    QCOMPARE(m_master->signalValue("setpoint").toReal(), 6.0);
    QCOMPARE(m_master->state(), QPlcMasterNode::Off);
}

void tst_ControlFlood::stopOvertakesNothingThatIsAnsweredAtOnce()
{
    ScriptedTool &anna = *m_tools.front();
    anna.send(QPlcMessage::SetSignals, {{"values", QJsonObject{{"setpoint", "5"}}}});
    anna.send(QPlcMessage::Stop);
    QTRY_COMPARE(anna.messages.size(), 2);
    QCOMPARE(anna.messages.at(0).kind(), QPlcMessage::Done);
    QCOMPARE(anna.messages.at(1).kind(), QPlcMessage::Done);
    QCOMPARE(m_master->signalValue("setpoint").toReal(), 5.0);
}

/// The master does not answer it any more, and does what it wants.
void tst_ControlFlood::stopOfAToolThatReadsNothingIsCarriedOut()
{
    QTcpSocket tool;
    tool.setReadBufferSize(1000);  // what comes stays with the master
    tool.connectToHost(QHostAddress::LocalHost, m_master->serverPort());
    QTRY_COMPARE(tool.state(), QAbstractSocket::ConnectedState);
    const QJsonObject greeting{{"protocol", 2}, {"name", "Deaf"}, {"uuid", "deaf"}, {"role", "tool"}};
    tool.write(qplc::encodeControlFrame(QPlcMessage(QPlcMessage::Hello, greeting)));
    for (int i = 0; i < 3000; ++i)
        tool.write(qplc::encodeControlFrame(QPlcMessage(QPlcMessage::GetSignals)));
    QVERIFY(waitUntil([&] { return tool.bytesToWrite() == 0; }));
    pass(std::chrono::milliseconds(500));
    tool.write(qplc::encodeControlFrame(QPlcMessage(QPlcMessage::Stop)));
    QVERIFY(m_master->waitForState(QPlcMasterNode::Off));
}

void tst_ControlFlood::answersInPortionsAreComplete()
{
    ScriptedTool &anna = *m_tools.front();
    const QJsonArray all = anna.ask(QPlcMessage::GetSignals).fields().value("signals").toArray();
    QCOMPARE(all.size(), Signals);
    for (int i = 1; i < Signals; ++i)
        QCOMPARE(all.at(i).toObject().value("name").toString(), QStringLiteral("signal_%1").arg(i));
    const QJsonArray names{"signal_7", "setpoint", "signal_299"};
    const QJsonArray some = anna.ask(QPlcMessage::GetSignals, {{"names", names}}).fields().value("signals").toArray();
    QCOMPARE(some.size(), 3);
    QCOMPARE(some.at(0).toObject(), all.at(7).toObject());
    QCOMPARE(some.at(2).toObject(), all.at(299).toObject());
    const QJsonObject statistics = anna.ask(QPlcMessage::GetStatistics).fields();
    QCOMPARE(statistics.keys(), (QStringList{"master", "nodes", "worst"}));
    m_master->stop();
}

void tst_ControlFlood::answerThatIsTooLongIsRefused()
{
    QByteArray ini;
    for (int i = 0; i < 10'000; ++i)
        ini += "[a_rather_long_name_of_a_signal_with_the_number_" + QByteArray::number(i) + "]\ntype = Bool\n";
    TestMaster master(QPlcClock::realTime(), QPlcSignalTable::fromIni(ini));
    QVERIFY(master.listen());
    ScriptedTool tool("Tool");
    QVERIFY(tool.greetAt(master.serverPort()));
    tool.send(QPlcMessage::GetSignals);
    const QPlcMessage refusal = tool.next(20000);
    QCOMPARE(refusal.text("error"), QString("TooLong"));
    QCOMPARE(tool.ask(QPlcMessage::GetState).kind(), QPlcMessage::State);
}

void tst_ControlFlood::scheduleInPortionsIsComplete()
{
    m_master->stop();
    const auto listener = listenerToAll(*m_master, 0);
    QVERIFY(listener);
    const QJsonObject schedule = m_tools.front()->ask(QPlcMessage::GetSchedule).fields();
    QCOMPARE(schedule.keys(), (QStringList{"links", "stages"}));
    const QJsonArray links = schedule.value("links").toArray();
    QCOMPARE(links.size(), Signals);
    QCOMPARE(links.size(), m_master->schedule().links.size());
    const QJsonObject last{
        {"age", 0}, {"from", ""}, {"sameCycle", false}, {"signal", "signal_299"}, {"to", "Listener0"}};
    QCOMPARE(links.last().toObject(), last);
    QCOMPARE(schedule.value("stages").toArray().first().toArray().last().toObject().value("node").toString(),
             QString("Listener0"));
}

/// Each listener reads each signal again. An Observer may be one, and ask.
void tst_ControlFlood::scheduleThatIsTooLongIsRefused()
{
    m_master->stop();
    std::vector<std::unique_ptr<ScriptedNode>> listeners;
    for (const int number : {50, 70}) {  // too long when it is made, and so long that it is not made
        while (int(listeners.size()) < number) {
            listeners.push_back(listenerToAll(*m_master, int(listeners.size())));
            QVERIFY(listeners.back());
        }
        const QPlcMessage refusal = m_tools.front()->ask(QPlcMessage::GetSchedule);
        QCOMPARE(refusal.text("error"), QString("TooLong"));
        QVERIFY2(refusal.text("text").contains(QString::number(number * Signals)), qPrintable(refusal.text("text")));
    }
    QCOMPARE(m_tools.front()->ask(QPlcMessage::GetState).kind(), QPlcMessage::State);
}

QTEST_GUILESS_MAIN(tst_ControlFlood)
#include "tst_ControlFlood.moc"
