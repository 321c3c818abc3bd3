// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "../realtime/FakeTime.h"
#include "ScriptedMaster.h"
#include "ScriptedNode.h"
#include "node/cycle/MasterCycle.h"
#include "transport/StreamTransport.h"

#include <sys/socket.h>
#include <unistd.h>

// A listener that wants only one of so many cycles: it hears the first one of each turn, and
// nothing of it is a loss.
class tst_ListeningInterval : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent(testTable()); }
    void cleanup() { QPlcSignalIndexTable::setCurrent({}); }
    void intervalsAreCountedFromCycleZero();
    void onlyFirstCycleOfEachIntervalIsSent_data();
    void onlyFirstCycleOfEachIntervalIsSent();
    void skippedFirstCycleIsReplacedByTheNextOne();
    void joiningListenerGetsTheNextCycleAndThenItsInterval_data();
    void joiningListenerGetsTheNextCycleAndThenItsInterval();
    void localListenerIsCalledOnlyOncePerInterval();
    void lostIntervalsCountAsMissed();
    void masterThatSendsEveryCycleCausesNoLoss();
    void bufferReportsTheListeningInterval();
    void invalidListeningIntervalIsRefused_data();
    void invalidListeningIntervalIsRefused();
    void stateTellsTheInterval();
};

namespace {

constexpr int every = 10;

/// The cycle of a master whose only node, a listener of "count", is the other end of a socket pair.
class BareCycle
{
public:
    BareCycle(int interval, qplc::TimeSource *time)
        : m_cycle(testTable(), m_hub, false, time)
        , m_slot(std::make_shared<qplc::NodeSlot>())
    {
        constexpr quint64 session = 5;
        const bool made = ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, m_ends) == 0;
        Q_ASSERT(made);
        Q_UNUSED(made)
        m_slot->id = 1;
        m_slot->listener = true;
        m_slot->interval = qplc::ListeningInterval(interval);
        m_slot->inputLayout = qplc::PayloadLayout(testTable(), {testTable().indexOf("count")});
        m_slot->prepare(m_cycle.image(), session);
        m_slot->peer = qplc::StreamTransport::peer(m_ends[0], m_slot->outputCutter(), qplc::MaximumCyclicFrame);
        m_slot->peer->owner = m_slot.get();
        m_slot->peer->isListener = true;
        m_cycle.setRoster({{m_slot}});
        m_decoder = qplc::FrameDecoder(qplc::FrameKind::Inputs, {session, 1, m_slot->inputLayout.hash()},
                                       m_slot->inputLayout.partBorders(qplc::MaximumCyclicPayload));
    }
    ~BareCycle()
    {
        m_cycle.stop();
        m_cycle.setRoster({});
        ::close(m_ends[1]);
    }
    /// Runs a phase up to its end, and returns the cycles of the frames that were sent.
    QVector<quint64> run(QPlcClock clock, quint64 cycles)
    {
        const quint64 zero = m_cycle.cycleZero();
        qplc::MasterCycle::Phase phase;
        phase.period = std::chrono::milliseconds(1);
        phase.clock = clock;
        phase.cycleLimit = cycles;
        m_decoder.restart(zero);
        if (!m_cycle.start(phase))
            return {};
        (void)waitUntil([&] { return m_cycle.cycle() + 1 == cycles; }, 10000);
        m_cycle.stop();
        QVector<quint64> heard;
        char frame[64];
        const auto size = ssize_t(qplc::CyclicHeaderSize + 4 + 4);
        while (::recv(m_ends[1], frame, std::size_t(size), MSG_DONTWAIT) == size) {
            if (m_decoder.decode(frame, std::size_t(size)) == qplc::FrameStatus::Complete)
                heard << m_decoder.cycle() - zero;
        }
        return heard;
    }
    qplc::NodeStatistics &statistics() { return m_slot->statistics; }

private:
    qplc::CyclicHub m_hub;
    qplc::MasterCycle m_cycle;
    std::shared_ptr<qplc::NodeSlot> m_slot;
    int m_ends[2] = {-1, -1};
    qplc::FrameDecoder m_decoder;
};

}  // namespace

void tst_ListeningInterval::intervalsAreCountedFromCycleZero()
{
    const qplc::ListeningInterval one;
    QVERIFY(one.isEveryCycle());
    QCOMPARE(one.turn(12), quint64(12));
    QCOMPARE(one.missed(12, 13), quint64(0));
    QCOMPARE(one.missed(12, 15), quint64(2));
    const qplc::ListeningInterval ten(10);
    QCOMPARE(ten.turn(9), quint64(0));
    QCOMPARE(ten.turn(10), quint64(1));
    QCOMPARE(ten.missed(0, 10), quint64(0));
    QCOMPARE(ten.missed(0, 19), quint64(0));
    QCOMPARE(ten.missed(19, 20), quint64(0));
    QCOMPARE(ten.missed(9, 20), quint64(1));
    QCOMPARE(ten.missed(20, 25), quint64(0));
    QCOMPARE(ten.missed(25, 3), quint64(0));  // another phase
}

void tst_ListeningInterval::onlyFirstCycleOfEachIntervalIsSent_data()
{
    QTest::addColumn<int>("interval");
    QTest::addColumn<QVector<quint64>>("heard");
    QTest::newRow("every cycle") << 1 << QVector<quint64>{0, 1, 2, 3, 4, 5, 6};
    QTest::newRow("every second one") << 2 << QVector<quint64>{0, 2, 4, 6};
    QTest::newRow("every third one") << 3 << QVector<quint64>{0, 3, 6};
    QTest::newRow("longer than the phase") << qplc::ListeningInterval::Longest << QVector<quint64>{0};
}

void tst_ListeningInterval::onlyFirstCycleOfEachIntervalIsSent()
{
    QFETCH(int, interval);
    QFETCH(QVector<quint64>, heard);
    FakeTime time;  // moved by the cycle thread alone
    BareCycle cycle(interval, &time);
    QCOMPARE(cycle.run(QPlcClock::realTime(), 7), heard);
    QCOMPARE(cycle.run(QPlcClock::lockstep(), 7), heard);  // turns begin anew with each phase
    QCOMPARE(quint64(cycle.statistics().lost), quint64(0));
    QCOMPARE(quint64(cycle.statistics().late), quint64(0));
}

void tst_ListeningInterval::skippedFirstCycleIsReplacedByTheNextOne()
{
    FakeTime time;
    time.target = 9'500'000;  // [ns]: the sleep up to cycle 10...
    time.overshoot = 3'200'000;
    BareCycle cycle(every, &time);
    QCOMPARE(cycle.run(QPlcClock::realTime(), 35), (QVector<quint64>{0, 13, 20, 30}));  // ...ends in cycle 13
}

void tst_ListeningInterval::joiningListenerGetsTheNextCycleAndThenItsInterval_data()
{
    QTest::addColumn<QString>("kind");
    for (const char *kind : {"udp", "tcp", "local"})
        QTest::newRow(kind) << kind;
}

void tst_ListeningInterval::joiningListenerGetsTheNextCycleAndThenItsInterval()
{
    QFETCH(QString, kind);
    TestMaster master;
    ScriptedNode pace("Pace");  // time stands still until it answers
    pace.outputs = QStringList{"count"};
    pace.inputs.clear();
    pace.initialValues = QPlcValue(0).toBytes();
    QVERIFY(pace.beginWith(master));
    const quint64 zero = pace.requests.first().cycle;
    const auto goOnTo = [&](quint64 cycle) {
        while (pace.requests.last().cycle < zero + cycle) {
            const int before = pace.requests.size();
            pace.answer(pace.requests.last().cycle, QPlcValue(int(pace.requests.last().cycle - zero)).toBytes());
            if (!pace.waitForRequests(before + 1))
                return false;
        }
        return true;
    };
    QVERIFY(goOnTo(23));
    CountListener viewer(every);
    viewer.connectToMaster(kind == QLatin1String("local")
                               ? QPlcUnderlyingProtocol::local(QString::number(master.serverPort()))
                               : master.protocol(kind));
    QTRY_COMPARE(viewer.state(), QPlcSlaveNode::RealTime);
    QTest::qWait(20);  // the master hears of it, and takes it into the next cycle
    QVERIFY(goOnTo(55));
    QVector<quint64> cycles;
    QTRY_VERIFY((cycles += viewer.takeCycles(), cycles.size() >= 4));
    QCOMPARE(cycles, (QVector<quint64>{24, 30, 40, 50}));
    QCOMPARE(viewer.counters().missed, quint64(0));
    QCOMPARE(viewer.lostCycles(), quint64(0));
    const QPlcCycleStatistics statistics = master.cycleStatistics();
    for (const QPlcNodeStatistics &node : statistics.nodes) {
        QCOMPARE(node.lost, quint64(0));
        QCOMPARE(node.late, quint64(0));
    }
    viewer.disconnectFromMaster();
    master.stop();
}

void tst_ListeningInterval::localListenerIsCalledOnlyOncePerInterval()
{
    TestMaster master;
    CounterNode counter;
    CountListener viewer(every);
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.addLocalNode(&viewer));
    master.setCycleLimit(35);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QVector<int> counts;
    viewer.takeFrames([&](const QPlcIOBufferSlaveNode::Frame &frame) {
        counts << QPlcValue::fromBytes(QPlcSignalType::Int32, frame.inputs).toInt();
    });
    QCOMPARE(counts.mid(1), (QVector<int>{10, 20, 30}));
    QCOMPARE(master.statistics().lateAnswers, quint64(0));
}

void tst_ListeningInterval::lostIntervalsCountAsMissed()
{
    ScriptedMaster master;
    CountListener viewer(every);
    QVERIFY(master.beginWith(viewer));
    quint64 sent = 0;
    for (const quint64 cycle : {0, 10, 23, 30, 40, 50, 60}) {
        master.before = quint16(cycle - sent++);
        if (cycle != 40 && cycle != 50)  // those are lost
            master.request(cycle);
    }
    QVERIFY(master.waitForAnswers(5));
    QCOMPARE(viewer.counters().missed, quint64(2));
    QCOMPARE(viewer.counters().skipped, quint64(0));
    QCOMPARE(viewer.takeCycles(), (QVector<quint64>{0, 10, 23, 30, 60}));
    viewer.disconnectFromMaster();
}

void tst_ListeningInterval::masterThatSendsEveryCycleCausesNoLoss()
{
    ScriptedMaster master;
    CountListener viewer(every);
    QVERIFY(master.beginWith(viewer));
    for (quint64 cycle = 0; cycle < 25; ++cycle)
        master.request(cycle);
    QVERIFY(master.waitForAnswers(25));
    QCOMPARE(viewer.counters().missed, quint64(0));
    QCOMPARE(viewer.takeCycles().size(), 25);
    viewer.disconnectFromMaster();
}

void tst_ListeningInterval::bufferReportsTheListeningInterval()
{
    ScriptedMaster master;
    CountListener viewer(7);
    QCOMPARE(viewer.listeningInterval(), 7);
    QVERIFY(master.beginWith(viewer));
    QCOMPARE(master.messages.at(1).fields().value("every").toInt(), 7);
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    QVector<int> intervals;
    viewer.takeFrames([&](const QPlcIOBufferSlaveNode::Frame &frame) { intervals << frame.every; });
    QCOMPARE(intervals, QVector<int>{7});
    viewer.disconnectFromMaster();
}

void tst_ListeningInterval::invalidListeningIntervalIsRefused_data()
{
    QTest::addColumn<QJsonObject>("changes");
    QTest::addColumn<QString>("words");
    QTest::newRow("none") << QJsonObject{{"every", 0}} << "1 ... 1000000";
    QTest::newRow("negative") << QJsonObject{{"every", -3}} << "1 ... 1000000";
    QTest::newRow("too long") << QJsonObject{{"every", 1000001}} << "1 ... 1000000";
    QTest::newRow("half a cycle") << QJsonObject{{"every", 2.5}} << "field 'every'";
    QTest::newRow("a text") << QJsonObject{{"every", "10"}} << "field 'every'";
    QTest::newRow("no listener") << QJsonObject{{"listener", false}} << "listeners without outputs";
    QTest::newRow("outputs")
        << QJsonObject{{"outputs", QJsonArray{QJsonObject{{"name", "echo"}, {"type", "Real64"}, {"unit", ""}}}}}
        << "listeners without outputs";
}

void tst_ListeningInterval::invalidListeningIntervalIsRefused()
{
    QFETCH(QJsonObject, changes);
    QFETCH(QString, words);
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    node.listener = true;
    node.every = every;
    node.outputs.clear();
    QVERIFY(node.connectTo(master.serverPort()));
    node.send(QPlcMessage::Hello, node.helloFields());
    QCOMPARE(node.next().kind(), QPlcMessage::Hello);
    QJsonObject fields = node.registerFields();
    for (auto change = changes.begin(); change != changes.end(); ++change)
        fields.insert(change.key(), change.value());
    node.send(QPlcMessage::Register, fields);
    const QPlcMessage answer = node.next();
    QCOMPARE(answer.kind(), QPlcMessage::Rejected);
    QCOMPARE(answer.text("error"), QStringLiteral("MalformedMessage"));
    QVERIFY2(answer.text("text").contains(words), qPrintable(answer.text("text")));
}

void tst_ListeningInterval::stateTellsTheInterval()
{
    TestMaster master;
    QVERIFY(master.listen());
    CountListener viewer(every);
    QVERIFY(viewer.connectToMasterAndWaitForConnected(master.protocol("udp")));
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    const QJsonArray nodes = tool.ask(QPlcMessage::GetState).fields().value("nodes").toArray();
    QCOMPARE(nodes.size(), 1);
    QCOMPARE(nodes.first().toObject().value("every").toInt(), every);
    viewer.disconnectFromMaster();
}

QTEST_GUILESS_MAIN(tst_ListeningInterval)
#include "tst_ListeningInterval.moc"
