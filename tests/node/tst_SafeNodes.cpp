// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "VirtualTime.h"
#include "Winch.h"
#include "node/api/QPlcSlaveNodePrivate.h"
#include "realtime/TimeSource.h"

using namespace std::chrono_literals;
using qplc::SafeStopFlag;

namespace {

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
    void nodeThatWasStoppedIsSafeBeforeItComputes();
    void nodeStaysDisconnectedWithoutReconnectPolicy();
    void exceptionMakesTheNodeSafe();
    void phaseEndMakesTheNodeSafeBeforeItStops();
    void leavingDuringThePhaseMakesTheNodeSafe();
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
    QVERIFY(master.admit(winch, master.place()));
    QVERIFY(master.start());
    master.request(4);
    QVERIFY(master.waitForAnswers(1));
    pass(57ms);  // the answer took up to 2 ms to be read
    QVERIFY(barked.isEmpty());
    pass(4ms);
    QCOMPARE(barked.size(), 1);
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

void tst_SafeNodes::nodeThatWasStoppedIsSafeBeforeItComputes()
{
    ScriptedMaster master(winchTable());
    Winch winch;
    winch.activateWatchdog(60ms);
    int steps = 0;
    winch.onStep = [&](const QPlcCycle &) {
        if (++steps > 1)
            return;
        const std::int64_t end = qplc::monotonicNow() + 100'000'000;  // [ns] as if it had been stopped
        while (qplc::monotonicNow() < end)
            qplc::TimeSource::monotonic().sleepUntil(end);
    };
    QVERIFY(master.admit(winch, master.place()));
    QVERIFY(master.start());
    master.request(0);
    pass(50ms);
    master.request(1);  // waits until it resumes
    QVERIFY(master.waitForAnswers(2));
    QCOMPARE(steps, 1);
    QCOMPARE(int(master.answers.at(1).flags), int(SafeStopFlag));
    QCOMPARE(real(master.answers.at(1).payload), 300.0);
    QTRY_COMPARE(winch.story(), (QStringList{"step", "safe WatchdogReason", "stopped"}));
    winch.disconnectFromMaster();
}

void tst_SafeNodes::nodeStaysDisconnectedWithoutReconnectPolicy()
{
    ScriptedMaster master(winchTable());
    Winch winch;
    winch.setReconnectPolicy(QPlcSlaveNode::NeverReconnect);
    winch.activateWatchdog(30ms);
    QSignalSpy gone(&winch, &QPlcSlaveNode::disconnectedFromMaster);
    QVERIFY(master.admit(winch, master.place()));
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

void tst_SafeNodes::nodeWaitsForAnEndedMasterOnlyOnRequest()
{
    for (bool wish : {false, true}) {
        Winch winch;
        winch.setReconnectPolicy(wish ? QPlcSlaveNode::ReconnectAlways : QPlcSlaveNode::ReconnectWhenLost);
        ScriptedMaster master(winchTable());
        QVERIFY(master.admit(winch, master.place()));
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
    winch.connectToMaster(master.place());
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    master.send(QPlcMessage::Rejected, {{"error", "SignalHasWriter"}, {"text", "no"}});
    QTRY_COMPARE(winch.state(), QPlcSlaveNode::Rejected);
    QCOMPARE(winch.error(), QPlcSlaveNode::RegistrationError);
    master.control = nullptr;
    QCOMPARE(master.next(3990).kind(), QPlcMessage::Invalid);
    QCOMPARE(master.next(2020).kind(), QPlcMessage::Hello);  // after 4 to 6 s
    winch.disconnectFromMaster();
}

void tst_SafeNodes::connectionAttemptWithoutAnswerTimesOut()
{
    ScriptedMaster master(winchTable());  // accepts, and says nothing
    Winch winch;
    winch.setReconnectPolicy(QPlcSlaveNode::ReconnectAlways);
    winch.connectToMaster(master.place());
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    QCOMPARE(winch.state(), QPlcSlaveNode::Registering);
    pass(1990ms);
    QCOMPARE(winch.state(), QPlcSlaveNode::Registering);
    pass(20ms);
    QCOMPARE(winch.state(), QPlcSlaveNode::Disconnected);
    QCOMPARE(winch.error(), QPlcSlaveNode::ConnectionError);
    QVERIFY2(winch.errorString().contains("no answer within 2 s"), qPrintable(winch.errorString()));
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    winch.disconnectFromMaster();
}

QTPLC_VIRTUAL_TIME_MAIN(tst_SafeNodes)
#include "tst_SafeNodes.moc"
