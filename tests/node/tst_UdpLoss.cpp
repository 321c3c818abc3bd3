// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "ScriptedNode.h"

#include <random>

// Datagrams that get lost, come twice, come late, or come from somebody else.
class tst_UdpLoss : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void aLostRequestIsSentAgain();
    void aRepeatedRequestIsAnsweredFromTheCache();
    void aRequestThatComesTwiceIsNotAnsweredTwice();
    void anOldRequestIsDropped();
    void aRepeatedPartCompletesTheRequest();
    void lockstepSurvivesHeavyLoss();
    void masterCountsDuplicates();
    void masterRejectsEveryCorruption();
    void slaveRejectsEveryCorruption();
    void datagramsOfStrangersAreCountedAndDropped();
};

void tst_UdpLoss::aLostRequestIsSentAgain()
{
    TestMaster master;
    ScriptedNode node;
    QVERIFY(node.beginWith(master));
    const quint64 cycle = node.requests.at(0).cycle;
    QVERIFY(node.waitForRequestOf(cycle, qplc::ResentFlag));
    const ScriptedNode::Request again = node.frames.last();
    QCOMPARE(again.bytes.mid(qplc::CyclicHeaderSize, 4),
             node.requests.at(0).bytes.mid(qplc::CyclicHeaderSize, 4));  // the same values
    QCOMPARE(master.statistics().cycles, quint64(0));
    QVERIFY(master.nodes().at(0).resent >= 1);
    node.answer(cycle, 1.0);
    QVERIFY(node.waitForRequests(2));
    QCOMPARE(int(node.requests.at(1).flags), 0);
    QCOMPARE(node.requests.at(1).cycle, cycle + 1);
    master.stop();
}

void tst_UdpLoss::aRepeatedRequestIsAnsweredFromTheCache()
{
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.beginWith(node));
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    for (int i = 2; i < 6; ++i) {
        master.request(0, qplc::ResentFlag);
        QVERIFY(master.waitForAnswers(i));
        QCOMPARE(master.answers.last().bytes, master.answers.first().bytes);  // the very same bytes
    }
    QCOMPARE(node.counters().cycles, quint64(1));
    QCOMPARE(node.counters().duplicated, quint64(4));
    master.request(1, qplc::ResentFlag);  // the first one of this cycle was lost: it is computed
    QVERIFY(master.waitForAnswers(6));
    QCOMPARE(master.answers.last().payload.left(4), QPlcValue(2).toBytes());
    QCOMPARE(node.counters().cycles, quint64(2));
    node.disconnectFromMaster();
}

void tst_UdpLoss::aRequestThatComesTwiceIsNotAnsweredTwice()
{
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.beginWith(node));
    master.request(0);
    master.request(0);
    master.request(1);
    QVERIFY(master.waitForAnswers(2));
    QCOMPARE(master.answers.at(1).cycle, quint64(1));
    QCOMPARE(node.counters().duplicated, quint64(1));
    QCOMPARE(node.counters().cycles, quint64(2));
    node.disconnectFromMaster();
}

void tst_UdpLoss::anOldRequestIsDropped()
{
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.beginWith(node));
    master.request(5);
    master.request(3);
    master.request(5, qplc::ResentFlag | qplc::FaultFlag);  // a flag that inputs do not have changes nothing
    master.request(4, qplc::ResentFlag);
    master.request(6);
    QVERIFY(master.waitForAnswers(3));
    QCOMPARE(master.answers.at(2).cycle, quint64(6));
    QCOMPARE(node.counters().outdated, quint64(2));
    QCOMPARE(node.counters().cycles, quint64(2));
    node.disconnectFromMaster();
}

void tst_UdpLoss::aRepeatedPartCompletesTheRequest()
{
    class Wide : public QPlcCompactSlaveNode
    {
    public:
        Wide()
            : QPlcCompactSlaveNode("Wide")
        {
        }
        QPlcInput<std::array<double, 150>> m_a{this, "a"};
        QPlcInput<std::array<double, 150>> m_b{this, "b"};
        QPlcInput<std::array<double, 150>> m_c{this, "c"};
        QPlcOutput<std::array<double, 150>> m_d{this, "d"};
        QPlcOutput<double> m_e{this, "e"};
        QPlcOutput<std::array<double, 150>> m_f{this, "f"};
    } node;
    QByteArray ini = "[e]\ntype = Real64\n";
    for (char name : {'a', 'b', 'c', 'd', 'f'})
        ini += "[" + QByteArray(1, name) + "]\ntype = Real64[150]\n";
    ScriptedMaster master(QPlcSignalTable::fromIni(ini));
    QVERIFY(master.beginWith(node));
    const QByteArray values(int(master.inputSize()), '\0');
    const QVector<QByteArray> parts = master.requestFrames(0, values);
    QCOMPARE(parts.size(), 3);
    master.sendFrame(parts.at(2));
    master.sendFrame(parts.at(0));
    for (const QByteArray &part : master.requestFrames(0, values, qplc::ResentFlag))
        master.sendFrame(part);
    QVERIFY(master.waitForAnswers(2));
    QCOMPARE(node.counters().cycles, quint64(1));
    QCOMPARE(node.counters().duplicated, quint64(2));  // parts 0 and 2 came again
    const int soFar = 2;
    for (const QByteArray &part : master.requestFrames(0, values, qplc::ResentFlag))
        master.sendFrame(part);
    QVERIFY(master.waitForAnswers(soFar + 2));  // one repetition: the whole answer once, not once for each part
    master.request(1);
    QVERIFY(master.waitForAnswers(soFar + 4));
    QCOMPARE(master.answers.at(soFar + 2).cycle, quint64(1));
    node.disconnectFromMaster();
    QPlcSignalIndexTable::setCurrent({});
}

void tst_UdpLoss::lockstepSurvivesHeavyLoss()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    std::mt19937 random(1);
    int computed = 0;
    quint64 newest = ~quint64(0);
    node.onRequest = [&](const ScriptedNode::Request &request) {
        if (random() % 10 < 2)
            return;  // this request was lost
        computed += request.cycle != newest;
        newest = request.cycle;
        if (random() % 10 >= 2)  // else the answer was lost
            node.answer(request.cycle, double(computed));
    };
    master.setCycleLimit(100);
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.statistics().cycles, quint64(100));
    QCOMPARE(master.signalValue("echo").toReal(), 100.0);  // none left out, none computed twice
    QVERIFY(master.nodes().at(0).resent > 10);
}

void tst_UdpLoss::masterCountsDuplicates()
{
    TestMaster master;
    ScriptedNode node;
    QVERIFY(node.beginWith(master));
    const quint64 cycle = node.requests.at(0).cycle;
    node.answer(cycle, 1.0);
    QVERIFY(node.waitForRequests(2));
    node.answer(cycle, 5.0);
    node.answer(cycle - 1, 5.0);
    QTRY_COMPARE(master.nodes().at(0).duplicates, quint64(2));
    QCOMPARE(master.statistics().cycles, quint64(1));
    QCOMPARE(master.signalValue("echo").toReal(), 1.0);
    master.stop();
}

void tst_UdpLoss::masterRejectsEveryCorruption()
{
    TestMaster master;
    ScriptedNode node;
    QVERIFY(node.beginWith(master));
    const QByteArray good = node.answerFrames(node.requests.at(0).cycle, QPlcValue(9.0).toBytes()).at(0);
    quint64 sent = 0;
    for (int i = 0; i < good.size(); ++i) {
        QByteArray bad = good;
        bad[i] = char(bad.at(i) ^ 0x20);
        node.sendFrame(bad);
        ++sent;
    }
    for (const QByteArray &bad : {good.left(good.size() - 1), good + 'x', good.left(3), QByteArray(1472, 'x'),
                                  QByteArray(4000, 'y'), QByteArray()}) {
        node.sendFrame(bad);
        ++sent;
    }
    QTRY_COMPARE(master.nodes().at(0).rejected, sent);
    QCOMPARE(master.statistics().cycles, quint64(0));
    QCOMPARE(master.signalValue("echo").toReal(), 0.0);
    node.sendFrame(good);
    QVERIFY(master.waitForCycles(1));
    master.stop();
}

void tst_UdpLoss::slaveRejectsEveryCorruption()
{
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.beginWith(node));
    const QByteArray good = master.requestFrames(0, QByteArray(8, '\0')).at(0);
    quint64 sent = 0;
    for (int i = 0; i < good.size(); ++i) {
        QByteArray bad = good;
        bad[i] = char(bad.at(i) ^ 0x01);
        master.sendFrame(bad);
        ++sent;
    }
    for (const QByteArray &bad : {good.left(good.size() - 1), good + 'x', QByteArray(), QByteArray(60000, 'z')}) {
        master.sendFrame(bad);
        ++sent;
    }
    QTRY_COMPARE(node.counters().rejected, sent);
    QCOMPARE(node.counters().cycles, quint64(0));
    master.sendFrame(good);
    QVERIFY(master.waitForAnswers(1));
    QCOMPARE(master.answers.size(), 1);
    node.disconnectFromMaster();
}

void tst_UdpLoss::datagramsOfStrangersAreCountedAndDropped()
{
    TestMaster master;
    ScriptedNode node;
    QVERIFY(node.beginWith(master));
    const QByteArray good = node.answerFrames(node.requests.at(0).cycle, QPlcValue(9.0).toBytes()).at(0);
    QUdpSocket stranger;
    QVERIFY(stranger.bind(QHostAddress::LocalHost, 0));
    for (int i = 0; i < 100; ++i)
        stranger.writeDatagram(good, QHostAddress::LocalHost,
                               master.serverPort());  // a true copy, from the wrong place
    QTRY_COMPARE(master.statistics().strangers, quint64(100));
    QCOMPARE(master.statistics().cycles, quint64(0));
    QCOMPARE(master.nodes().at(0).rejected, quint64(0));
    QVERIFY(!stranger.hasPendingDatagrams());  // nothing is ever answered
    master.stop();
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    QCOMPARE(master.statistics().strangers, quint64(0));  // counted from the start of the phase
    master.stop();
}

QTEST_GUILESS_MAIN(tst_UdpLoss)
#include "tst_UdpLoss.moc"
