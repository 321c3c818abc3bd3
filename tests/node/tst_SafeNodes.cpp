// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "node/api/QPlcSlaveNodePrivate.h"

#include <mutex>

using namespace std::chrono_literals;
using qplc::SafeStopFlag;

namespace {

QPlcSignalTable winchTable()
{
    return QPlcSignalTable::fromIni("[speed]\ntype = Real64\nsafe = 0.5\n[length]\ntype = Real64\nsafe = 300\n");
}

/// Drives something, and remembers what happened to it, in order.
class Winch : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    explicit Winch()
        : QPlcCompactSlaveNode(QStringLiteral("Winch"))
    {
        setSignalTable(winchTable());
    }
    std::function<void(const QPlcCycle &)> onStep;
    QStringList story()
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        return m_story;
    }
    double speedAtRest = -1.0;

protected:
    void step(const QPlcCycle &cycle) override
    {
        m_length = 100.0 + m_speed;
        tell("step");
        if (onStep)
            onStep(cycle);
    }
    void safeState(SafeStateReason reason) override
    {
        speedAtRest = m_speed;
        tell(QByteArray("safe ") + QMetaEnum::fromType<SafeStateReason>().valueToKey(reason));
    }
    void stopped() override { tell("stopped"); }

private:
    void tell(const QByteArray &what)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        if (what != "step" || m_story.isEmpty() || m_story.last() != "step")
            m_story << QString::fromLatin1(what);
    }

    std::mutex m_mutex;
    QStringList m_story;
    QPlcInput<double> m_speed{this, "speed"};
    QPlcOutput<double> m_length{this, "length"};
};

double real(const QByteArray &bytes)
{
    return QPlcValue::fromBytes(QPlcSignalType(QPlcSignalType::Real64), bytes).toReal();
}

}  // namespace

// How a node gets into its safe state and out of it, and how it finds its master again.
class tst_SafeNodes : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void safeStopFlagMakesTheNodeSafeUntilThePhaseEnds();
    void watchdogMakesTheNodeSafeAndItReconnects();
    void nodeStaysDisconnectedWithoutReconnectPolicy();
    void exceptionMakesTheNodeSafe();
    void phaseEndMakesTheNodeSafeBeforeItStops();
    void leavingDuringThePhaseMakesTheNodeSafe();
    void nodeIsSafeAfterMasterLossAndReconnects_data();
    void nodeIsSafeAfterMasterLossAndReconnects();
    void nodeWaitsForAnEndedMasterOnlyOnRequest();
    void aRefusalIsTriedAgainLater();
    void connectionAttemptWithoutAnswerTimesOut();
};

void tst_SafeNodes::safeStopFlagMakesTheNodeSafeUntilThePhaseEnds()
{
    ScriptedMaster master(winchTable());
    Winch winch;
    QSignalSpy safe(&winch, &QPlcSlaveNode::safeStateEntered);
    QVERIFY(master.beginWith(winch));
    master.request(0, QPlcValue(7.0).toBytes());
    master.request(1, QPlcValue(8.0).toBytes(), SafeStopFlag);
    master.request(2, QPlcValue(9.0).toBytes());  // without the flag: it does not go on by itself
    QVERIFY(master.waitForAnswers(3));
    QCOMPARE(int(master.answers.at(0).flags), 0);
    QCOMPARE(real(master.answers.at(0).payload), 107.0);
    for (int i : {1, 2}) {
        QCOMPARE(int(master.answers.at(i).flags), int(SafeStopFlag));
        QCOMPARE(real(master.answers.at(i).payload), 300.0);
    }
    QTRY_COMPARE(winch.state(), QPlcSlaveNode::SafeStop);
    QCOMPARE(safe.size(), 1);
    QCOMPARE(winch.story(), (QStringList{"step", "safe MasterStopsSafely"}));
    QCOMPARE(winch.speedAtRest, 0.5);                       // inputs have their safe values, too
    master.send(QPlcMessage::SendYourInitialOutputStates);  // not before a reset
    QCOMPARE(master.next(50).kind(), QPlcMessage::Invalid);
    master.send(QPlcMessage::RealTimeStopped);
    QTRY_COMPARE(winch.state(), QPlcSlaveNode::Registered);
    QCOMPARE(winch.story(), (QStringList{"step", "safe MasterStopsSafely", "stopped"}));
    master.first += 1000;
    master.answers.clear();
    QVERIFY(master.start(QStringLiteral("Lockstep")));
    master.request(0, QPlcValue(1.0).toBytes());
    QVERIFY(master.waitForAnswers(1));
    QCOMPARE(real(master.answers.at(0).payload), 101.0);
    winch.disconnectFromMaster();
}

void tst_SafeNodes::watchdogMakesTheNodeSafeAndItReconnects()
{
    ScriptedMaster master(winchTable());
    Winch winch;
    winch.activateWatchdog(60ms);
    QSignalSpy barked(&winch, &QPlcSlaveNode::watchdogTimedOut);
    QSignalSpy gone(&winch, &QPlcSlaveNode::disconnectedFromMaster);
    QVERIFY(master.admit(winch, master.udp()));
    QVERIFY(master.start());
    master.request(4);
    QVERIFY(master.waitForAnswers(1));
    QTRY_COMPARE(barked.size(), 1);
    QCOMPARE(barked.at(0).at(0).toULongLong(), quint64(4));
    QCOMPARE(winch.error(), QPlcSlaveNode::WatchdogError);
    QVERIFY2(winch.errorString().contains("60 ms"), qPrintable(winch.errorString()));
    QCOMPARE(winch.state(), QPlcSlaveNode::SafeStop);
    QTRY_COMPARE(gone.size(), 1);
    QCOMPARE(winch.story(), (QStringList{"step", "safe WatchdogReason", "stopped"}));
    master.control = nullptr;
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);  // it is back
    QCOMPARE(winch.state(), QPlcSlaveNode::Registering);
    winch.disconnectFromMaster();
    QCOMPARE(winch.state(), QPlcSlaveNode::Disconnected);
}

void tst_SafeNodes::nodeStaysDisconnectedWithoutReconnectPolicy()
{
    ScriptedMaster master(winchTable());
    Winch winch;
    winch.setReconnectPolicy(QPlcSlaveNode::NeverReconnect);
    winch.activateWatchdog(30ms);
    QSignalSpy gone(&winch, &QPlcSlaveNode::disconnectedFromMaster);
    QVERIFY(master.admit(winch, master.tcp()));
    QVERIFY(master.start());
    master.request(0);
    QTRY_COMPARE(gone.size(), 1);
    QCOMPARE(master.next(300).kind(), QPlcMessage::Invalid);
    QCOMPARE(winch.state(), QPlcSlaveNode::SafeStop);
}

void tst_SafeNodes::exceptionMakesTheNodeSafe()
{
    ScriptedMaster master(winchTable());
    Winch winch;
    int steps = 0;
    winch.onStep = [&](const QPlcCycle &cycle) {
        ++steps;
        if (cycle.number() == 1)
            throw std::runtime_error("no encoder");
    };
    QVERIFY(master.beginWith(winch));
    for (quint64 k = 0; k < 4; ++k)
        master.request(k);
    QVERIFY(master.waitForAnswers(4));
    for (int i : {1, 2, 3}) {
        QCOMPARE(int(master.answers.at(i).flags), int(qplc::FaultFlag | SafeStopFlag));
        QCOMPARE(real(master.answers.at(i).payload), 300.0);
    }
    QCOMPARE(steps, 2);
    const QPlcMessage fault = master.next();
    QCOMPARE(fault.kind(), QPlcMessage::NodeFault);
    QVERIFY(fault.text("text").contains("no encoder"));
    QCOMPARE(winch.state(), QPlcSlaveNode::Fault);
    QCOMPARE(winch.story(), (QStringList{"step", "safe CodeFailed"}));
    master.send(QPlcMessage::RealTimeStopped);
    QTRY_COMPARE(winch.story().last(), QString("stopped"));
    QCOMPARE(winch.state(), QPlcSlaveNode::Fault);  // until it is initialized again
    master.send(QPlcMessage::SendYourInitialOutputStates);
    QCOMPARE(master.next().kind(), QPlcMessage::ReceiveMyInitialOutputStates);
    QCOMPARE(winch.state(), QPlcSlaveNode::Initializing);
    winch.disconnectFromMaster();
}

void tst_SafeNodes::phaseEndMakesTheNodeSafeBeforeItStops()
{
    ScriptedMaster master(winchTable());
    Winch winch;
    QVERIFY(master.beginWith(winch));
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    master.send(QPlcMessage::RealTimeStopped);
    QTRY_COMPARE(winch.state(), QPlcSlaveNode::Registered);
    QCOMPARE(winch.story(), (QStringList{"step", "safe PhaseEnded", "stopped"}));
    winch.disconnectFromMaster();
    QCOMPARE(winch.story().size(), 3);
}

void tst_SafeNodes::leavingDuringThePhaseMakesTheNodeSafe()
{
    ScriptedMaster master(winchTable());
    Winch winch;
    QVERIFY(master.beginWith(winch));
    winch.disconnectFromMaster();
    QCOMPARE(winch.story(), (QStringList{"safe PhaseEnded", "stopped"}));
    QCOMPARE(winch.state(), QPlcSlaveNode::Disconnected);
}

void tst_SafeNodes::nodeIsSafeAfterMasterLossAndReconnects_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("tcp") << "tcp";
    QTest::newRow("udp") << "udp";
}

void tst_SafeNodes::nodeIsSafeAfterMasterLossAndReconnects()
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
                      10000));
    QTRY_COMPARE_WITH_TIMEOUT(winch.state(), QPlcSlaveNode::Registered, 15000);
    QCOMPARE(winch.error(), QPlcSlaveNode::NoError);
    QCOMPARE(successor.state(), QPlcMasterNode::Off);  // and nothing moves
    QTest::qWait(50);
    QCOMPARE(winch.story().size(), 3);
    winch.disconnectFromMaster();
}

void tst_SafeNodes::nodeWaitsForAnEndedMasterOnlyOnRequest()
{
    for (bool wish : {false, true}) {
        Winch winch;
        winch.setReconnectPolicy(wish ? QPlcSlaveNode::ReconnectAlways : QPlcSlaveNode::ReconnectWhenLost);
        ScriptedMaster master(winchTable());
        QVERIFY(master.admit(winch, master.tcp()));
        (void)master.messages;
        master.send(QPlcMessage::MasterEnds);
        QTRY_VERIFY(winch.state() != QPlcSlaveNode::Registered);
        QCOMPARE(winch.error(), QPlcSlaveNode::NoError);
        master.control = nullptr;
        QCOMPARE(master.next(wish ? 5000 : 300).kind(), wish ? QPlcMessage::Hello : QPlcMessage::Invalid);
        winch.disconnectFromMaster();
    }
}

void tst_SafeNodes::aRefusalIsTriedAgainLater()
{
    ScriptedMaster master(winchTable());
    Winch winch;
    winch.setReconnectPolicy(QPlcSlaveNode::ReconnectAlways);
    winch.connectToMaster(master.tcp());
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    master.send(QPlcMessage::Rejected, {{"error", "SignalHasWriter"}, {"text", "no"}});
    QTRY_COMPARE(winch.state(), QPlcSlaveNode::Rejected);
    QCOMPARE(winch.error(), QPlcSlaveNode::RegistrationError);
    master.control = nullptr;
    QCOMPARE(master.next(1000).kind(), QPlcMessage::Invalid);
    QCOMPARE(master.next(10000).kind(), QPlcMessage::Hello);  // after some 5 s
    winch.disconnectFromMaster();
}

void tst_SafeNodes::connectionAttemptWithoutAnswerTimesOut()
{
    ScriptedMaster master(winchTable());  // accepts, and says nothing
    Winch winch;
    winch.setReconnectPolicy(QPlcSlaveNode::ReconnectAlways);
    winch.connectToMaster(master.tcp());
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    QCOMPARE(winch.state(), QPlcSlaveNode::Registering);
    QTRY_VERIFY(winch.state() == QPlcSlaveNode::Disconnected || winch.error() == QPlcSlaveNode::ConnectionError);
    QVERIFY2(winch.errorString().contains("no answer within 2 s"), qPrintable(winch.errorString()));
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    winch.disconnectFromMaster();
}

QTEST_GUILESS_MAIN(tst_SafeNodes)
#include "tst_SafeNodes.moc"
