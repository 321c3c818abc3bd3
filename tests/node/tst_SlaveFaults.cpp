// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "ScriptedNode.h"
#include "Winch.h"
#include "node/api/QPlcSlaveNodePrivate.h"
#include "node/cycle/SlaveCycle.h"
#include "realtime/TimeSource.h"

#include <QtCore/QSemaphore>

#include <atomic>
#include <limits>

using namespace std::chrono_literals;

// What a node does when its master, its network or its own code fails.
class tst_SlaveFaults : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void corruptedFramesDoNotResetTheWatchdog();
    void watchdogExpiresAtItsDeadline();
    void theWatchdogWaitsForTheFirstFrameOfAStartThatOthersDelay();
    void watchdogIsInactiveInLockstepAndOutsideAPhase();
    void nodeComputesOnlyTheNewestCycleAfterAPause();
    void frameFloodAfterAPauseDoesNotBlockTheNode();
    void multiPartRequestsAreNotTreatedAsFlood();
    void lockstepComputesEveryCycle();
    void aStepThatThrowsGivesSafeValuesAndAFault();
    void whoGoesOnHasTheOutputsOfItsLastStep();
    void whoGoesOnTellsTheOutputsOfItsLastStep();
    void aStepThatThrowsStopsThePlant_data();
    void aStepThatThrowsStopsThePlant();
    void outputsThatAreNotFiniteAreHeldAndStopNothing_data();
    void outputsThatAreNotFiniteAreHeldAndStopNothing();
    void wrongOutputListIsAFault();
    void exceptionInStoppedIsTolerated();
    void aTornCyclicStreamEndsTheNode();
    void nodeIsSafeAfterMasterLossAndReconnects_data();
    void nodeIsSafeAfterMasterLossAndReconnects();
};

void tst_SlaveFaults::corruptedFramesDoNotResetTheWatchdog()
{
    ScriptedMaster master;
    CounterNode node;
    node.activateWatchdog(100ms);
    QSignalSpy barked(&node, &QPlcSlaveNode::watchdogTimedOut);
    QVERIFY(master.admit(node, master.udp()));
    QVERIFY(master.start());
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    QTimer noise;
    connect(&noise, &QTimer::timeout, this, [&] { master.sendFrame("noise"); });
    noise.start(1);
    QTRY_VERIFY(node.counters().rejected > 2 || barked.size() > 0);
    QTRY_COMPARE(barked.size(), 1);
    node.disconnectFromMaster();
}

namespace {

/// Knows when it computed last, and when it was made safe [ns].
class Timed : public CounterNode
{
public:
    Timed()
    {
        onStep = [this](const QPlcCycle &) { stepped = qplc::monotonicNow(); };
    }
    std::atomic<qint64> stepped{0};
    std::atomic<qint64> safe{0};

private:
    void safeState(SafeStateReason) override { safe = qplc::monotonicNow(); }
};

}  // namespace

void tst_SlaveFaults::watchdogExpiresAtItsDeadline()
{
    const std::chrono::nanoseconds time = 105ms;
    qint64 best = std::numeric_limits<qint64>::max();
    for (int i = 0; i < 5 && best > 1'000'000; ++i) {  // a busy machine is late now and then
        ScriptedMaster master;
        Timed node;
        node.activateWatchdog(time);
        QSignalSpy barked(&node, &QPlcSlaveNode::watchdogTimedOut);
        QVERIFY(master.admit(node, master.udp()));
        QVERIFY(master.start(QStringLiteral("RealTime"), 100'000'000));
        master.request(0);
        QTRY_COMPARE(barked.size(), 1);
        QVERIFY(node.stepped > 0);
        const qint64 late = node.safe - node.stepped - time.count();
        QVERIFY(late > -5'000'000);  // it counts from the arrival of the frame
        best = std::min(best, late);
        node.disconnectFromMaster();
    }
    QVERIFY2(best < 10'000'000, qPrintable(QStringLiteral("%1 ms late").arg(double(best) * 1e-6)));
}

void tst_SlaveFaults::theWatchdogWaitsForTheFirstFrameOfAStartThatOthersDelay()
{
    ScriptedMaster master;
    CounterNode node;
    node.activateWatchdog(30ms);
    QSignalSpy barked(&node, &QPlcSlaveNode::watchdogTimedOut);
    QVERIFY(master.admit(node, master.udp()));
    QVERIFY(master.start());
    QTest::qWait(120);  // another node is not ready yet
    QCOMPARE(barked.size(), 0);
    master.request(0);
    QTRY_COMPARE(barked.size(), 1);
    node.disconnectFromMaster();
}

void tst_SlaveFaults::watchdogIsInactiveInLockstepAndOutsideAPhase()
{
    ScriptedMaster master;
    CounterNode node;
    node.activateWatchdog(5ms);
    QSignalSpy barked(&node, &QPlcSlaveNode::watchdogTimedOut);
    QVERIFY(master.admit(node, master.udp()));
    QTest::qWait(50);
    QVERIFY(master.start("Lockstep"));
    QTest::qWait(50);
    QCOMPARE(barked.size(), 0);
    node.disconnectFromMaster();
}

void tst_SlaveFaults::nodeComputesOnlyTheNewestCycleAfterAPause()
{
    ScriptedMaster master;
    CounterNode node;
    QSemaphore entered;
    QSemaphore goOn;
    QVector<QPlcCycle> cycles;
    node.onStep = [&](const QPlcCycle &cycle) {
        cycles << cycle;
        entered.release();
        if (cycle.number() == 0)
            goOn.acquire();
    };
    QVERIFY(master.admit(node, master.udp()));
    QVERIFY(master.start("RealTime", 1'000'000));
    master.request(0);
    QVERIFY(entered.tryAcquire(1, 5000));
    for (quint64 k = 1; k < 10; ++k)
        master.request(k, QPlcValue(double(k)).toBytes());
    QTest::qWait(20);  // a pause of twenty periods
    goOn.release();
    QVERIFY(master.waitForAnswers(2));
    QCOMPARE(master.answers.at(1).cycle, quint64(9));
    QCOMPARE(QPlcValue::fromBytes(QPlcSignalType(QPlcSignalType::Real64), master.answers.at(1).payload.mid(4)).toReal(),
             9.0);  // of its inputs
    QCOMPARE(node.counters().cycles, quint64(2));
    QCOMPARE(node.counters().missed, quint64(8));
    node.disconnectFromMaster();
    QCOMPARE(cycles.size(), 2);
    QCOMPARE(cycles.at(1).missedCycles(), quint64(8));
}

namespace {

/// Brings a request, after a pause all others, and then garbage for ever, if there is any.
class FloodedLink : public qplc::CyclicLink
{
public:
    FloodedLink(const QVector<QByteArray> &requests, const QByteArray &garbage, const std::atomic<bool> &ends)
        : CyclicLink(-1)
        , m_requests(requests)
        , m_garbage(garbage)
        , m_ends(ends)
    {
    }
    Status receive(const char **frame, std::size_t *size) noexcept override
    {
        if (m_next > 0 && (m_next < m_requests.size() || m_garbage.isEmpty()))
            qplc::TimeSource::monotonic().sleepUntil(qplc::monotonicNow() + 5'000'000);
        return poll(frame, size);
    }
    Status poll(const char **frame, std::size_t *size) noexcept override
    {
        if (m_next >= m_requests.size() && m_garbage.isEmpty())
            return Nothing;
        const QByteArray &bytes = m_next < m_requests.size() ? m_requests.at(m_next++) : m_garbage;
        *frame = bytes.constData();
        *size = std::size_t(bytes.size());
        return m_ends ? Closed : Received;
    }
    bool send(const char *, std::size_t) noexcept override { return true; }
    bool hasBroughtAll() const { return m_next >= m_requests.size(); }

private:
    const QVector<QByteArray> m_requests;
    const QByteArray m_garbage;
    const std::atomic<bool> &m_ends;
    std::atomic<int> m_next{0};
};

/// Hears more than one frame holds.
class WideNode : public QPlcSlaveNode
{
public:
    WideNode()
        : QPlcSlaveNode("Wide", ErrorZeroOrderHold)
    {
    }

protected:
    QPlcSignalIndexList declareInputSignals() override
    {
        QPlcSignalIndexList list;
        for (const char *name : {"a", "b", "c"})
            list.insert(name);
        return list;
    }
    QPlcSignalList realTimeout(const QPlcSignalList &) override { return {}; }
};

/// The frames of \a cycles requests from 0 on.
QVector<QByteArray> requestsFor(const qplc::NodeRuntime &runtime, int cycles)
{
    const qplc::PayloadLayout &layout = runtime.inputLayout();
    const qplc::FrameEncoder encoder(qplc::FrameKind::Inputs,
                                     {ScriptedMaster::Session, ScriptedMaster::Node, layout.hash()},
                                     layout.partBorders(qplc::MaximumCyclicPayload));
    const QByteArray payload(int(layout.size()), '\0');
    QVector<QByteArray> requests;
    for (int k = 0; k < cycles; ++k) {
        qplc::FrameHeader header;
        header.cycle = quint64(k);
        for (std::size_t part = 0; part < encoder.partCount(); ++part) {
            QByteArray frame(int(encoder.partSize(part)), '\0');
            encoder.encode(part, header, payload.constData(), frame.data());
            requests << frame;
        }
    }
    return requests;
}

}  // namespace

void tst_SlaveFaults::frameFloodAfterAPauseDoesNotBlockTheNode()
{
    CounterNode node;
    qplc::NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    QVERIFY2(runtime.bind(testTable(), &error) && runtime.reset(&error), qPrintable(error));
    std::atomic<bool> ends{false};
    qplc::SlaveCycle cycle(runtime, {ScriptedMaster::Session, ScriptedMaster::Node}, false);
    cycle.setLink(std::make_unique<FloodedLink>(requestsFor(runtime, 2), "garbage", ends));
    qplc::SlaveCycle::Phase phase;
    phase.period = 1ms;
    phase.watchdog = 20ms;
    QVERIFY2(cycle.start(phase), qPrintable(cycle.errorString()));
    const bool barks = waitUntil([&] { return cycle.counters().watchdog == 1; }, 2000);
    ends = !barks;  // else a node that is held never stops
    cycle.stop();
    QVERIFY(barks);
    QCOMPARE(node.lastCycle, quint64(1));  // of a thread that began late, the newest request only
}

void tst_SlaveFaults::multiPartRequestsAreNotTreatedAsFlood()
{
    constexpr int cycles = 400;
    const QPlcSignalTable table
        = QPlcSignalTable::fromIni("[a]\ntype = Real64[150]\n[b]\ntype = Real64[150]\n[c]\ntype = Real64[150]\n");
    QPlcSignalIndexTable::setCurrent(table);
    WideNode node;
    qplc::NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    QVERIFY2(runtime.bind(table, &error) && runtime.reset(&error), qPrintable(error));
    const QVector<QByteArray> requests = requestsFor(runtime, cycles);
    QVERIFY(requests.size() >= 3 * cycles);
    const std::atomic<bool> ends{false};
    qplc::SlaveCycle cycle(runtime, {ScriptedMaster::Session, ScriptedMaster::Node}, false);
    auto link = std::make_unique<FloodedLink>(requests, QByteArray(), ends);
    const FloodedLink *brought = link.get();
    cycle.setLink(std::move(link));
    qplc::SlaveCycle::Phase phase;
    phase.period = 1ms;
    QVERIFY2(cycle.start(phase), qPrintable(cycle.errorString()));
    QTRY_VERIFY(brought->hasBroughtAll());
    QTRY_VERIFY(cycle.counters().cycles > 0);
    cycle.stop();
    QPlcSignalIndexTable::setCurrent({});
    QCOMPARE(cycle.counters().cycles, quint64(1));  // the parts of the first request come with pauses, too
}

void tst_SlaveFaults::lockstepComputesEveryCycle()
{
    ScriptedMaster master;
    CounterNode node;
    QSemaphore goOn;
    node.onStep = [&](const QPlcCycle &cycle) {
        if (cycle.number() == 0)
            goOn.acquire();
    };
    QVERIFY(master.admit(node, master.tcp()));
    QVERIFY(master.start("Lockstep", 1'000'000));
    for (quint64 k = 0; k < 10; ++k)
        master.request(k);
    QTest::qWait(20);
    goOn.release();
    QVERIFY(master.waitForAnswers(10));
    QCOMPARE(node.counters().cycles, quint64(10));
    node.disconnectFromMaster();
}

void tst_SlaveFaults::aStepThatThrowsGivesSafeValuesAndAFault()
{
    ScriptedMaster master;
    CounterNode node;
    node.onStep = [](const QPlcCycle &cycle) {
        if (cycle.number() >= 1)
            throw std::runtime_error("division by zero");
    };
    QVERIFY(master.beginWith(node));
    for (quint64 k = 0; k < 4; ++k)
        master.request(k);
    QVERIFY(master.waitForAnswers(4));
    QCOMPARE(int(master.answers.at(0).flags), 0);
    QCOMPARE(int(master.answers.at(3).flags), int(qplc::FaultFlag | qplc::SafeStopFlag));
    QCOMPARE(master.answers.at(3).payload, QByteArray(master.answers.at(0).payload.size(), '\0'));
    const QPlcMessage fault = master.next();
    QCOMPARE(fault.kind(), QPlcMessage::NodeFault);
    QVERIFY2(fault.text("text").contains("division by zero") && fault.text("text").contains("cycle 1"),
             qPrintable(fault.text("text")));
    QCOMPARE(fault.text("phase"), QPlcMessage::fromHex64(master.first));
    QCOMPARE(master.next(20).kind(), QPlcMessage::Invalid);  // once, not in every cycle
    QCOMPARE(node.error(), QPlcSlaveNode::UserCodeError);
    node.disconnectFromMaster();
}

namespace {

void addPlaces()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("udp") << "udp";
    QTest::newRow("tcp") << "tcp";
    QTest::newRow("in process") << "local";
}

}  // namespace

/// After its connection was lost: the signals are bound anew, and the code hears nothing of it.
void tst_SlaveFaults::whoGoesOnHasTheOutputsOfItsLastStep()
{
    CounterNode counter;
    qplc::NodeRuntime &runtime = QPlcSlaveNodePrivate::of(counter).runtime;
    QString error;
    const QByteArray inputs = QPlcValue(2.5).toBytes();  // echo
    QVERIFY2(runtime.bind(testTable(), &error), qPrintable(error));
    QVERIFY(runtime.reset(&error) && runtime.initialize(inputs.constData(), &error));
    runtime.beginPhase(true);
    for (quint64 cycle = 0; cycle < 3; ++cycle)
        QVERIFY(runtime.step(QPlcCycle(cycle, std::chrono::milliseconds(10)), inputs.constData()));
    const QByteArray last(runtime.outputs(), int(runtime.outputLayout().size()));
    QVERIFY2(runtime.bind(testTable(), &error), qPrintable(error));
    runtime.goOn();
    QCOMPARE(QByteArray(runtime.outputs(), int(runtime.outputLayout().size())), last);
    QCOMPARE(counter.resets, 1);
}

void tst_SlaveFaults::whoGoesOnTellsTheOutputsOfItsLastStep()
{
    ScriptedMaster master;
    CounterNode counter;
    QVERIFY(master.beginWith(counter));
    for (quint64 cycle = 0; cycle < 3; ++cycle) {
        master.request(cycle);
        QVERIFY(master.waitForAnswers(int(cycle) + 1));
    }
    const QByteArray last = master.answers.last().payload;
    const int resets = counter.resets;
    counter.disconnectFromMaster();
    master.control = nullptr;
    master.forgetMessages();
    QVERIFY(master.admit(counter, master.udp()));
    master.send(QPlcMessage::SendYourInitialOutputStates, {{"phase", QPlcMessage::fromHex64(master.first)}});
    const QPlcMessage answer = master.next();
    QCOMPARE(answer.kind(), QPlcMessage::ReceiveMyInitialOutputStates);
    QVERIFY(answer.fields().value("goesOn").toBool());
    QCOMPARE(answer.fields().value("values").toString(), QPlcMessage::fromBytes(last));
    QCOMPARE(counter.resets, resets);
}

void tst_SlaveFaults::aStepThatThrowsStopsThePlant_data()
{
    addPlaces();
}

void tst_SlaveFaults::aStepThatThrowsStopsThePlant()
{
    QFETCH(QString, kind);
    TestMaster master;
    QVERIFY(master.listen());
    CounterNode thrower("Thrower");
    thrower.onStep = [](const QPlcCycle &cycle) {
        if (cycle.number() == 5)
            throw std::runtime_error("broken");
    };
    QVERIFY(master.admit(thrower, kind));
    QSignalSpy errors(&master, &QPlcMasterNode::errorOccurred);
    QSignalSpy stopped(&master, &QPlcMasterNode::realTimeHasStopped);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(errors.size(), 1);
    QCOMPARE(stopped.size(), 1);
    QCOMPARE(master.error(), QPlcMasterNode::NodeError);
    QVERIFY2(master.errorString().contains("'Thrower'"), qPrintable(master.errorString()));
    QTRY_COMPARE(thrower.stops, 1);
    QTRY_COMPARE(thrower.state(), QPlcSlaveNode::Fault);
    thrower.onStep = {};
    QVERIFY(master.startRealTime());  // and it can be started again
    QVERIFY(master.waitForCycles(10));
    master.stop();
    thrower.disconnectFromMaster();
}

void tst_SlaveFaults::outputsThatAreNotFiniteAreHeldAndStopNothing_data()
{
    addPlaces();
}

void tst_SlaveFaults::outputsThatAreNotFiniteAreHeldAndStopNothing()
{
    class Bad : public QPlcCompactSlaveNode
    {
    public:
        Bad()
            : QPlcCompactSlaveNode("Bad")
        {
        }
        double bad = qQNaN();
        QPlcOutput<double> m_echo{this, "echo"};
        QPlcOutput<float> m_free{this, "free"};
        void reset() override
        {
            m_echo = 1.0;
            m_free = 1.0f;
        }
        void step(const QPlcCycle &cycle) override
        {
            m_echo = double(cycle.number());
            if (cycle.number() > 5)
                m_free = float(bad);
        }
    };
    QFETCH(QString, kind);
    for (double value : {qQNaN(), qInf(), -qInf()}) {
        TestMaster master;
        QVERIFY(master.listen());
        Bad node;
        node.bad = value;
        QVERIFY(master.admit(node, kind));
        master.setCycleLimit(8);
        LogCapture log;
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        QCOMPARE(master.error(), QPlcMasterNode::NoError);
        QCOMPARE(master.signalValue("free").toReal(), 1.0);
        QCOMPARE(master.signalQuality("free").heldCycles(), 2);
        QCOMPARE(master.signalValue("echo").toReal(), 7.0);  // what is good in the answer is taken
        QCOMPARE(master.signalQuality("echo").kind(), QPlcQuality::Good);
        node.disconnectFromMaster();
    }
}

void tst_SlaveFaults::wrongOutputListIsAFault()
{
    class Lister : public QPlcSlaveNode
    {
    public:
        Lister()
            : QPlcSlaveNode("Lister")
        {
        }
        QPlcSignalIndex m_out = 0;
        QPlcSignalList list;
        QPlcSignalIndexList declareOutputSignals() override
        {
            QPlcSignalIndexList indices;
            m_out = indices.insert("echo");
            return indices;
        }
        QPlcSignalList realTimeout(const QPlcSignalList &) override { return list; }
    };
    struct Case
    {
        const char *signal;
        QPlcValue value;
        const char *word;
    };
    for (const Case &wrong :
         {Case{"echo", QPlcValue("text"), "'echo'"}, Case{"echo", QPlcValue(std::array<double, 2>{1, 2}), "Real64[2]"},
          Case{"sum", QPlcValue(1.0), "not declared"}}) {
        TestMaster master;
        QPlcSignalIndexTable::setCurrent(testTable());
        Lister node;
        QVERIFY2(master.addLocalNode(&node), qPrintable(master.errorString()));
        node.list.insert(testTable().indexOf(wrong.signal), wrong.value);
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        QVERIFY2(master.errorString().contains(wrong.word) && master.errorString().contains("'Lister'"),
                 qPrintable(master.errorString()));
    }
}

void tst_SlaveFaults::exceptionInStoppedIsTolerated()
{
    class Bye : public QPlcCompactSlaveNode
    {
    public:
        Bye()
            : QPlcCompactSlaveNode("Bye")
        {
        }
        void stopped() override { throw 1; }
    } node;
    ScriptedMaster master;
    QVERIFY(master.admit(node, master.udp()));
    QVERIFY(master.start());
    master.send(QPlcMessage::RealTimeStopped);
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Off);
}

void tst_SlaveFaults::aTornCyclicStreamEndsTheNode()
{
    TestMaster master;
    ScriptedNode node("Torn");
    node.cyclic = "tcp";
    QSignalSpy lost(&master, &QPlcMasterNode::nodeLost);
    QVERIFY(node.beginWith(master));
    QByteArray wrongChecksum = node.answerFrames(node.requests.at(0).cycle, QByteArray(8, '\0')).at(0);
    wrongChecksum[14] = char(wrongChecksum.at(14) ^ 1);
    node.sendFrame(wrongChecksum);  // alone it is dropped, as with UDP
    QTRY_COMPARE(master.nodes().at(0).rejected, quint64(1));
    QCOMPARE(lost.size(), 0);
    node.sendFrame("GET / HTTP/1.1\r\n\r\n");
    QTRY_COMPARE(lost.size(), 1);
    QVERIFY2(lost.at(0).at(1).toString().contains("cyclic"), qPrintable(lost.at(0).at(1).toString()));
    QTRY_COMPARE(node.stream.state(), QAbstractSocket::UnconnectedState);
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    master.stop();
}

void tst_SlaveFaults::nodeIsSafeAfterMasterLossAndReconnects_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("tcp") << "tcp";
    QTest::newRow("udp") << "udp";
}

void tst_SlaveFaults::nodeIsSafeAfterMasterLossAndReconnects()
{
    QFETCH(QString, kind);
    Winch winch;
    quint16 port = 0;
    {
        ScriptedMaster master(winchTable());
        const QPlcUnderlyingProtocol address = kind == "tcp" ? master.tcp() : master.udp();
        port = address.port();
        QVERIFY(master.admit(winch, address));
        QVERIFY(master.start());
        master.request(0);
        QVERIFY(master.waitForAnswers(1));
        master.control->abort();
        QTRY_COMPARE(winch.state(), QPlcSlaveNode::SafeStop);
        QCOMPARE(winch.story(), (QStringList{"step", "safe MasterLost", "stopped"}));
    }
    TestMaster successor(QPlcClock::realTime(), winchTable());
    QVERIFY(waitUntil([&] { return successor.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port)); },
                      10s));
    QTRY_COMPARE_WITH_TIMEOUT(winch.state(), QPlcSlaveNode::Registered, 15000);
    QCOMPARE(winch.error(), QPlcSlaveNode::NoError);
    QCOMPARE(successor.state(), QPlcMasterNode::Off);  // and nothing moves
    pass(50ms);
    QCOMPARE(winch.story().size(), 3);
    winch.disconnectFromMaster();
}

QTEST_GUILESS_MAIN(tst_SlaveFaults)
#include "tst_SlaveFaults.moc"
