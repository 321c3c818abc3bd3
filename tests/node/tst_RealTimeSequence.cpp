// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "ScriptedNode.h"

// Figure 4.15 of the thesis: one cycle. New values go to every node, every node computes once and
// answers.
class tst_RealTimeSequence : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void masterSendsTheValuesOfTheCycleBefore_data();
    void masterSendsTheValuesOfTheCycleBefore();
    void slaveComputesOnceAndAnswers_data();
    void slaveComputesOnceAndAnswers();
    void lockstepWaitsForAllButListeners();
    void framesOfTheLastPhaseAreNeverAccepted();
    void anAnswerToACycleToComeIsRejected_data();
    void anAnswerToACycleToComeIsRejected();
    void framesBetweenPhasesAreDropped();
    void lockstepUsesListenerOutputsOnArrival();
    void valuesOfSeveralPartsTravel_data();
    void valuesOfSeveralPartsTravel();
    void cyclesTellTheirTime();

private:
    static QByteArray bytesOf(double value) { return QPlcValue(value).toBytes(); }
};

namespace {

void addTransports()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("tcp") << "tcp";
    QTest::newRow("udp") << "udp";
}

}  // namespace

void tst_RealTimeSequence::masterSendsTheValuesOfTheCycleBefore_data()
{
    addTransports();
}

void tst_RealTimeSequence::masterSendsTheValuesOfTheCycleBefore()
{
    QFETCH(QString, kind);
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    node.cyclic = kind;
    node.inputs = QStringList{"echo"};  // it sees its own output of the cycle before
    node.initialValues = bytesOf(0.25);
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    double expected = 0.25;
    quint64 first = 0;
    for (int k = 0; k < 20; ++k) {
        QVERIFY(node.waitForRequests(k + 1));
        const ScriptedNode::Request &request = node.requests.at(k);
        first = k == 0 ? request.cycle : first;
        QCOMPARE(request.status, qplc::FrameStatus::Complete);
        QCOMPARE(request.cycle, first + quint64(k));
        QCOMPARE(QPlcValue::fromBytes(QPlcSignalType(QPlcSignalType::Real64), request.payload).toReal(), expected);
        expected = k * 1.5;
        node.answer(request.cycle, expected);
    }
    QVERIFY(node.waitForRequests(21));
    QCOMPARE(master.statistics().cycles, quint64(20));
    QCOMPARE(master.signalValue("echo").toReal(), 19 * 1.5);
    master.stop();
}

void tst_RealTimeSequence::slaveComputesOnceAndAnswers_data()
{
    addTransports();
}

void tst_RealTimeSequence::slaveComputesOnceAndAnswers()
{
    QFETCH(QString, kind);
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.admit(node, kind == "udp" ? master.udp() : master.tcp()));
    QVERIFY(master.start("Lockstep"));
    double sum = 0.0;
    for (int k = 0; k < 20; ++k) {
        master.request(quint64(k), bytesOf(k * 0.5));
        sum += k * 0.5;
        QVERIFY(master.waitForAnswers(k + 1));
        const ScriptedMaster::Answer &answer = master.answers.at(k);
        QCOMPARE(answer.status, qplc::FrameStatus::Complete);
        QCOMPARE(answer.cycle, quint64(k));
        QCOMPARE(int(answer.flags), 0);
        QCOMPARE(answer.payload, QPlcValue(k + 1).toBytes() + bytesOf(sum));
    }
    QCOMPARE(node.counters().cycles, quint64(20));
    QCOMPARE(node.counters().missed, quint64(0));
    node.disconnectFromMaster();
}

void tst_RealTimeSequence::lockstepWaitsForAllButListeners()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode worker("Worker");
    ScriptedNode listener("Listener");
    listener.onlyListen();
    QVERIFY(worker.registerAt(master.serverPort()));
    QVERIFY(listener.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(worker.waitForRequests(1));
    QTest::qWait(60);  // long enough for a master that does not wait to be far away
    QCOMPARE(master.statistics().cycles, quint64(0));
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    worker.answerAll();
    worker.answer(worker.requests.at(0).cycle, 1.0);
    QVERIFY(master.waitForCycles(50));  // the listener never says anything
    master.stop();
    QVERIFY(listener.requests.size() > 0);
    QCOMPARE(master.nodes().at(1).resent, quint64(0));
}

void tst_RealTimeSequence::lockstepUsesListenerOutputsOnArrival()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode listener("Listener");
    listener.listener = true;
    listener.initialValues = bytesOf(0.75);
    listener.answerAll();
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(listener.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(master.signalValue("echo").toReal(), 0.75);
    listener.initialValues = bytesOf(-3.0);
    QTRY_COMPARE(master.signalValue("echo").toReal(), -3.0);
    master.stop();
}

void tst_RealTimeSequence::framesOfTheLastPhaseAreNeverAccepted()
{
    TestMaster master;
    ScriptedNode node;
    QVERIFY(node.beginWith(master));
    const quint64 old = node.requests.at(0).cycle;
    node.answer(old, 1.0);
    QVERIFY(node.waitForRequests(2));
    master.stop();
    node.requests.clear();
    const QVector<QByteArray> stale = node.answerFrames(old + 1, bytesOf(666.0));
    QVERIFY(master.startRealTime());
    QVERIFY(node.waitForRequests(1));
    QVERIFY(node.requests.at(0).cycle > old + 1);
    node.sendFrame(stale.at(0));  // on its way since the last phase
    QTRY_COMPARE(master.nodes().at(0).duplicates, quint64(1));
    QCOMPARE(master.statistics().cycles, quint64(0));  // it is no answer
    node.answer(node.requests.at(0).cycle, 2.0);
    QVERIFY(master.waitForCycles(1));
    QCOMPARE(master.signalValue("echo").toReal(), 2.0);
    master.stop();
}

void tst_RealTimeSequence::anAnswerToACycleToComeIsRejected_data()
{
    QTest::addColumn<quint64>("ahead");
    QTest::newRow("the next one") << Q_UINT64_C(1);
    QTest::newRow("one of next week") << Q_UINT64_C(1'000'000'000);
}

void tst_RealTimeSequence::anAnswerToACycleToComeIsRejected()
{
    QFETCH(quint64, ahead);
    TestMaster master;
    ScriptedNode node;
    QVERIFY(node.beginWith(master));
    const quint64 first = node.requests.at(0).cycle;
    node.answer(first + ahead, 666.0);
    QTRY_COMPARE(master.nodes().at(0).rejected, quint64(1));
    QCOMPARE(master.statistics().cycles, quint64(0));
    for (int k = 0; k < 3; ++k) {  // those that were asked count as ever
        QVERIFY(node.waitForRequests(k + 1));
        node.answer(first + quint64(k), double(k));
        QVERIFY(master.waitForCycles(quint64(k) + 1));
        QCOMPARE(master.signalValue("echo").toReal(), double(k));
        QCOMPARE(master.signalQuality("echo").kind(), QPlcQuality::Good);
    }
    QCOMPARE(master.nodes().at(0).duplicates, quint64(0));
    master.stop();
}

void tst_RealTimeSequence::framesBetweenPhasesAreDropped()
{
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.admit(node, master.udp()));
    master.request(0);
    master.first += 10;
    QVERIFY(master.start("Lockstep"));  // the frame of before is of an older cycle
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    QCOMPARE(master.answers.size(), 1);
    QCOMPARE(node.counters().cycles, quint64(1));
    QCOMPARE(node.counters().outdated, quint64(1));
    QCOMPARE(node.counters().missed, quint64(0));
    master.send(QPlcMessage::RealTimeStopped);
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Off);
    master.request(1);
    QVERIFY(!waitUntil([&] { return master.answers.size() > 1; }, 30));
}

void tst_RealTimeSequence::valuesOfSeveralPartsTravel_data()
{
    addTransports();
}

void tst_RealTimeSequence::valuesOfSeveralPartsTravel()
{
    // Twelve signals of 1000 bytes in each direction: twelve frames a cycle, since two of them do
    // not fit into one.
    class Big : public QPlcCompactSlaveNode
    {
    public:
        Big(const QString &name, char in, char out)
            : QPlcCompactSlaveNode(name)
        {
            for (int i = 0; i < 12; ++i) {
                m_names.push_back(QByteArray(1, in) + QByteArray::number(i));
                m_inputs.push_back(
                    std::make_unique<QPlcInput<std::array<double, 125>>>(this, m_names.back().constData()));
                m_names.push_back(QByteArray(1, out) + QByteArray::number(i));
                m_outputs.push_back(
                    std::make_unique<QPlcOutput<std::array<double, 125>>>(this, m_names.back().constData()));
            }
        }
        std::vector<QByteArray> m_names;
        std::vector<std::unique_ptr<QPlcInput<std::array<double, 125>>>> m_inputs;
        std::vector<std::unique_ptr<QPlcOutput<std::array<double, 125>>>> m_outputs;
        bool consistent = true;
        void step(const QPlcCycle &cycle) override
        {
            for (std::size_t i = 0; i < 12; ++i) {
                std::array<double, 125> values = m_inputs[i]->value();
                for (std::size_t j = 0; j < values.size(); ++j) {
                    consistent = consistent && values[j] == double((i + 1) * cycle.number());
                    values[j] += double(i + 1);
                }
                *m_outputs[i] = values;
            }
        }
    };
    QFETCH(QString, kind);
    QByteArray ini;
    for (char prefix : {'a', 'b'}) {
        for (int i = 0; i < 12; ++i)
            ini += "[" + QByteArray(1, prefix) + QByteArray::number(i) + "]\ntype = Real64[125]\n";
    }
    TestMaster master(QPlcClock::lockstep(), QPlcSignalTable::fromIni(ini));
    master.setCycleLimit(200);
    QVERIFY(master.listen());
    Big first("First", 'a', 'b');
    Big second("Second", 'b', 'a');
    QVERIFY2(first.connectToMasterAndWaitForConnected(master.protocol(kind)), qPrintable(first.errorString()));
    QVERIFY2(second.connectToMasterAndWaitForConnected(master.protocol(kind)), qPrintable(second.errorString()));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QVERIFY(first.consistent && second.consistent);
    QCOMPARE(master.statistics().cycles, quint64(200));
    QCOMPARE(master.signalValue("a11").toReal(124), 12.0 * 200);
    QCOMPARE(master.signalValue("b0").toReal(0), 200.0);
    first.disconnectFromMaster();
    second.disconnectFromMaster();
    QPlcSignalIndexTable::setCurrent({});
}

void tst_RealTimeSequence::cyclesTellTheirTime()
{
    ScriptedMaster master;
    CounterNode node;
    QVector<QPlcCycle> cycles;
    node.onStep = [&](const QPlcCycle &cycle) { cycles << cycle; };
    QVERIFY(master.admit(node, master.udp()));
    QVERIFY(master.start("Lockstep", 2'000'000));
    master.before = 3;  // it has not sent cycles 0 to 2
    master.request(3);
    QVERIFY(master.waitForAnswers(1));
    master.request(7);
    QVERIFY(master.waitForAnswers(2));
    node.disconnectFromMaster();
    QCOMPARE(cycles.size(), 2);
    QCOMPARE(cycles.at(0).number(), quint64(3));
    QCOMPARE(cycles.at(0).missedCycles(), quint64(0));
    QCOMPARE(cycles.at(1).number(), quint64(7));
    QCOMPARE(cycles.at(1).missedCycles(), quint64(3));
    QCOMPARE(qint64(cycles.at(1).time().count()), qint64(14'000'000));
    QCOMPARE(cycles.at(1).dt(), 0.002);
}

QTEST_GUILESS_MAIN(tst_RealTimeSequence)
#include "tst_RealTimeSequence.moc"
