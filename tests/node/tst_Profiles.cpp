// SPDX-License-Identifier: Apache-2.0
// What the profiles Simulation and Plant decide, and what wins over them.
#include "../common/Waiting.h"
#include "NodeFixtures.h"
#include "ScriptedMaster.h"
#include "ScriptedNode.h"
#include "VirtualTime.h"
#include "node/cycle/ProfileDefaults.h"

using namespace std::chrono_literals;
using Profile = QPlcProfile;

namespace {

QPlcSignalTable profileTable()
{
    return QPlcSignalTable::fromIni("[count]\ntype = Int32\nsafe = -1\n"
                                    "[echo]\ntype = Real64\n"
                                    "[sum]\ntype = Real64\nunit = m\nhold = 2\nsafe = -5\n");
}

/// A master whose profile is what the test is about.
class ProfiledMaster : public TestMaster
{
public:
    explicit ProfiledMaster(Profile::Value profile, QPlcClock clock = QPlcClock::realTime())
        : TestMaster(clock, profileTable())
    {
        setProfile(profile);
        setInterval(5ms);
    }
    QStringList eventsOf(const QString &part) const { return m_log.matching(part); }

private:
    LogCapture m_log;
};

}  // namespace

class tst_Profiles : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void chosenProfileOverridesTheDetectedOne_data();
    void chosenProfileOverridesTheDetectedOne();
    void namesAreReadInAnyCase();
    void stateTellsProfileAndReason();
    void aPhaseKeepsItsProfile();
    void simulationHoldsValuesWithoutHoldTimeForever();
    void plantGoesToSafeValues();
    void aWatchdogReportsInASimulation();
    void plantActivatesTheWatchdogByDefault();
    void unknownProfileCountsAsPlant();
    void settingsOfANodeWinOverTheProfile();
    void aMasterThatListensOnANetworkIsAPlant();
    void aListenerHasNoWatchdogByDefault();
    void aRestartedProcessBeginsAtItsInitialStateWithAnEvent();
    void aNewPhaseBeginsAtTheInitialState();
    void simulationWaitsForALateNodeWithoutLimit();
    void gapDoesNotStopASimulation();
    void realDevicesMakeAPlant();
    void realDevicesAreRefusedInASimulationUntilTheNextStart();
    void realDevicesInThisProcessMakeAPlant();
};

void tst_Profiles::chosenProfileOverridesTheDetectedOne_data()
{
    QTest::addColumn<int>("wanted");
    QTest::addColumn<QString>("hardware");
    QTest::addColumn<QString>("network");
    QTest::addColumn<QPlcClock>("clock");
    QTest::addColumn<int>("profile");
    const auto row = [](const char *name, Profile::Value wanted, const char *hardware, const char *network,
                        QPlcClock clock, Profile::Value profile) {
        QTest::newRow(name) << int(wanted) << QString(hardware) << QString(network) << clock << int(profile);
    };
    const auto realTime = QPlcClock::realTime();
    const auto lockstep = QPlcClock::lockstep();
    const auto external = QPlcClock::external();
    row("a desk", Profile::Automatic, "", "", realTime, Profile::Simulation);
    row("lockstep on a network", Profile::Automatic, "", "10.0.0.1", lockstep, Profile::Simulation);
    row("a turned clock on a network", Profile::Automatic, "", "10.0.0.1", external, Profile::Simulation);
    row("a clock that runs on a network", Profile::Automatic, "", "10.0.0.1", realTime, Profile::Plant);
    row("devices", Profile::Automatic, "Winch", "", realTime, Profile::Plant);
    row("devices in lockstep", Profile::Automatic, "Winch", "", lockstep, Profile::Plant);
    row("devices with a turned clock", Profile::Automatic, "Winch", "", external, Profile::Plant);
    row("a person wants a simulation", Profile::Simulation, "Winch", "10.0.0.1", realTime, Profile::Simulation);
    row("a person wants a plant", Profile::Plant, "", "", lockstep, Profile::Plant);
}

void tst_Profiles::chosenProfileOverridesTheDetectedOne()
{
    QFETCH(int, wanted);
    QFETCH(QString, hardware);
    QFETCH(QString, network);
    QFETCH(QPlcClock, clock);
    const qplc::ChosenProfile chosen
        = qplc::chooseProfile({Profile::Value(wanted), false, Profile::Automatic, hardware, network, clock});
    QTEST(int(chosen.value), "profile");
    QVERIFY(!chosen.reason.isEmpty());
}

void tst_Profiles::namesAreReadInAnyCase()
{
    Profile::Value profile = Profile::Automatic;
    QVERIFY(Profile::fromName("plant", &profile));
    QCOMPARE(profile, Profile::Plant);
    QVERIFY(Profile::fromName("Simulation", &profile));
    QVERIFY(!Profile::fromName("simulated", &profile));
    QCOMPARE(profile, Profile::Simulation);
}

void tst_Profiles::stateTellsProfileAndReason()
{
    ProfiledMaster master(Profile::Automatic);
    QVERIFY(master.listen());
    QCOMPARE(master.profile(), Profile::Simulation);
    ScriptedTool asker;
    QVERIFY(asker.greetAt(master.serverPort()));
    QPlcMessage state = asker.ask(QPlcMessage::GetState);
    QCOMPARE(state.text("profile"), QString("Simulation"));
    QVERIFY(state.text("profileReason").contains("this computer only"));
    master.setProfile(Profile::Plant);
    state = asker.ask(QPlcMessage::GetState);
    QCOMPARE(state.text("profile"), QString("Plant"));
    QCOMPARE(state.text("profileReason"), QString("set at the master"));
}

void tst_Profiles::aPhaseKeepsItsProfile()
{
    ProfiledMaster master(Profile::Simulation);
    CounterNode counter;
    QVERIFY(master.listen());
    QVERIFY(master.admit(counter, datagrams()));
    QCOMPARE(counter.profile(), Profile::Automatic);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(3));
    QCOMPARE(counter.profile(), Profile::Simulation);
    master.setProfile(Profile::Plant);
    QCOMPARE(master.profile(), Profile::Simulation);
    master.stop();
    QCOMPARE(master.profile(), Profile::Plant);
    QTRY_COMPARE(counter.state(), QPlcSlaveNode::Registered);
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(counter.profile(), Profile::Plant);
    master.stop();
}

void tst_Profiles::simulationHoldsValuesWithoutHoldTimeForever()
{
    ProfiledMaster master(Profile::Simulation);
    QVERIFY(master.listen());
    {
        CounterNode counter;
        QVERIFY(master.admit(counter, datagrams()));
        QVERIFY(master.startRealTime());
        QTRY_VERIFY(master.signalValue("count").toInt() > 3);
        counter.disconnectFromMaster();
    }
    QTRY_VERIFY(master.nodes().isEmpty());
    const quint64 gone = master.statistics().cycles;
    const int last = master.signalValue("count").toInt();
    QVERIFY(master.waitForCycles(gone + 50));
    QVERIFY(last > 3);
    QCOMPARE(master.signalValue("count").toInt(), last);  // although it has `safe`
    QCOMPARE(master.signalQuality("count").kind(), QPlcQuality::Held);
    QCOMPARE(master.signalValue("sum").toReal(), -5.0);  // the table says for how long it is held
    QCOMPARE(master.signalQuality("sum").kind(), QPlcQuality::Safe);
    master.stop();
}

void tst_Profiles::plantGoesToSafeValues()
{
    ProfiledMaster master(Profile::Plant);
    QVERIFY(master.listen());
    {
        CounterNode counter;
        QVERIFY(master.admit(counter, datagrams()));
        QVERIFY(master.startRealTime());
        QTRY_VERIFY(master.signalValue("count").toInt() > 3);
        counter.disconnectFromMaster();
    }
    QTRY_COMPARE(master.signalQuality("count").kind(), QPlcQuality::Safe);
    QCOMPARE(master.signalValue("count").toInt(), -1);
    master.stop();
}

namespace {

bool start(ScriptedMaster &master, const char *profile)
{
    QJsonObject fields = master.startFields();
    fields.insert("profile", QString::fromLatin1(profile));
    return master.startWith(fields);
}

}  // namespace

void tst_Profiles::aWatchdogReportsInASimulation()
{
    const LogCapture log;
    ScriptedMaster master(profileTable());
    CounterNode node;
    node.setSignalTable(profileTable());
    node.activateWatchdog(0.015);
    QSignalSpy timedOut(&node, &QPlcSlaveNode::watchdogTimedOut);
    QSignalSpy safe(&node, &QPlcSlaveNode::safeStateEntered);
    QSignalSpy gone(&node, &QPlcSlaveNode::disconnectedFromMaster);
    QVERIFY(master.admit(node, master.place()));
    QVERIFY(start(master, "Simulation"));
    QCOMPARE(node.watchdog(), std::chrono::nanoseconds(15ms));
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    QTRY_VERIFY(!timedOut.isEmpty());
    QCOMPARE(timedOut.last().at(0).toULongLong(), quint64(0));
    QCOMPARE(node.state(), QPlcSlaveNode::RealTime);
    const int before = timedOut.size();
    master.request(1);
    QVERIFY(master.waitForAnswers(2));
    QCOMPARE(QPlcValue::fromBytes(QPlcSignalType(QPlcSignalType::Int32), master.answers.at(1).payload.left(4)).toInt(),
             2);
    QCOMPARE(int(master.answers.at(1).flags), 0);
    QTRY_VERIFY(timedOut.size() > before);
    QTRY_COMPARE(quint64(timedOut.size()), node.counters().watchdog);
    QCOMPARE(safe.size() + gone.size(), 0);
    QCOMPARE(node.error(), QPlcSlaveNode::NoError);
    node.disconnectFromMaster();
    QVERIFY(log.matching("no frame of the master for 15 ms since cycle").size() >= 2);  // the rest is told at the end
}

void tst_Profiles::plantActivatesTheWatchdogByDefault()
{
    ScriptedMaster master(profileTable());
    CounterNode node;
    node.setSignalTable(profileTable());
    QSignalSpy safe(&node, &QPlcSlaveNode::safeStateEntered);
    QVERIFY(master.admit(node, master.place()));
    QVERIFY(start(master, "Plant"));
    QCOMPARE(node.watchdog(), std::chrono::nanoseconds(500ms));
    master.request(0);
    pass(499ms);
    QVERIFY(safe.isEmpty());
    pass(2ms);
    QCOMPARE(safe.size(), 1);
    QCOMPARE(safe.at(0).at(0).value<QPlcSlaveNode::SafeStateReason>(), QPlcSlaveNode::WatchdogReason);
    QCOMPARE(node.error(), QPlcSlaveNode::WatchdogError);
}

void tst_Profiles::unknownProfileCountsAsPlant()
{
    for (const char *told : {"Automatic", "simulated", ""}) {
        ScriptedMaster master(profileTable());
        CounterNode node;
        node.setSignalTable(profileTable());
        QVERIFY(master.admit(node, master.place()));
        QVERIFY(start(master, told));
        QCOMPARE(node.profile(), Profile::Plant);
        QCOMPARE(node.watchdog(), std::chrono::nanoseconds(500ms));
        node.disconnectFromMaster();
    }
}

void tst_Profiles::settingsOfANodeWinOverTheProfile()
{
    ScriptedMaster master(profileTable());
    CounterNode node;
    node.setSignalTable(profileTable());
    node.activateWatchdog(20ms);
    node.setWatchdogReaction(QPlcSlaveNode::WatchdogReaction::SafeState);
    QSignalSpy safe(&node, &QPlcSlaveNode::safeStateEntered);
    QVERIFY(master.admit(node, master.place()));
    QVERIFY(start(master, "Simulation"));
    master.request(0);
    QTRY_COMPARE(safe.size(), 1);
    node.disconnectFromMaster();

    ScriptedMaster strict(profileTable());
    CounterNode calm;
    calm.setSignalTable(profileTable());
    calm.activateWatchdog(0ms);
    QVERIFY(strict.admit(calm, strict.place()));
    QVERIFY(start(strict, "Plant"));
    QCOMPARE(calm.watchdog(), std::chrono::nanoseconds(0));
}

void tst_Profiles::aMasterThatListensOnANetworkIsAPlant()
{
    const OnTheMachine here;  // a simulated computer has one address
    ProfiledMaster master(Profile::Automatic);
    master.setClock(QPlcClock::realTime());
    QVERIFY(master.listen());
    QCOMPARE(master.profile(), Profile::Simulation);
    master.stopServer();
    master.setInsecureNetworkAllowed(true);
    QVERIFY(master.listen(QHostAddress::AnyIPv4));
    QCOMPARE(master.profile(), Profile::Plant);
    QVERIFY2(master.profileReason().contains("0.0.0.0"), qPrintable(master.profileReason()));
}

void tst_Profiles::aListenerHasNoWatchdogByDefault()
{
    ScriptedMaster master(profileTable());
    CounterNode node;
    node.setSignalTable(profileTable());
    node.setListener(true);
    QVERIFY(master.admit(node, master.place()));
    QVERIFY(start(master, "Plant"));
    QCOMPARE(node.watchdog(), std::chrono::nanoseconds(0));
}

void tst_Profiles::aRestartedProcessBeginsAtItsInitialStateWithAnEvent()
{
    ProfiledMaster master(Profile::Simulation);
    QVERIFY(master.listen());
    {
        CounterNode counter;
        QVERIFY(master.admit(counter, datagrams()));
        QVERIFY(master.startRealTime());
        QTRY_VERIFY(master.signalValue("count").toInt() > 3);
        counter.disconnectFromMaster();
    }
    QTRY_VERIFY(master.nodes().isEmpty());
    QVERIFY(master.eventsOf("initial state").isEmpty());
    CounterNode again;
    QVERIFY(master.admit(again, datagrams()));
    QTRY_COMPARE(again.state(), QPlcSlaveNode::RealTime);
    QCOMPARE(again.resets, 1);
    QCOMPARE(master.eventsOf("node Counter begins again at its initial state").size(), 1);
    master.stop();
}

void tst_Profiles::aNewPhaseBeginsAtTheInitialState()
{
    ProfiledMaster master(Profile::Simulation);
    QVERIFY(master.listen());
    CounterNode counter;
    QVERIFY(master.admit(counter, datagrams()));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(3));
    counter.disconnectFromMaster();
    master.stop();
    QTRY_VERIFY(master.nodes().isEmpty());
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    QVERIFY(master.admit(counter, datagrams()));  // it has not been in this phase
    QTRY_COMPARE(counter.state(), QPlcSlaveNode::RealTime);
    QCOMPARE(counter.resets, 2);
    master.stop();
}

void tst_Profiles::simulationWaitsForALateNodeWithoutLimit()
{
    const auto waitsIn = [](Profile::Value profile, bool isSet) {
        ProfiledMaster master(profile);
        if (isSet)
            master.setLongestWait(200ms);
        CounterNode node(QStringLiteral("Counter"), QPlcSlaveNode::SilentWait);
        node.activateWatchdog(0ms);
        std::atomic<bool> mayGoOn{false};
        node.onStep = [&](const QPlcCycle &cycle) {
            while (cycle.number() == 3 && !mayGoOn)
                beBusyFor(1ms);
        };
        bool isRight = master.listen() && master.admit(node, datagrams()) && master.startRealTime()
            && master.waitForState(QPlcMasterNode::WaitingForLateSlaves);
        pass(400ms);  // longer than the limit that was set
        const auto state = master.state();
        mayGoOn = true;
        isRight = isRight && (isSet || master.waitForState(QPlcMasterNode::RealTime));
        master.stop();
        node.disconnectFromMaster();
        return isRight ? state : QPlcMasterNode::Fault;
    };
    QCOMPARE(waitsIn(Profile::Simulation, false), QPlcMasterNode::WaitingForLateSlaves);
    QCOMPARE(waitsIn(Profile::Simulation, true), QPlcMasterNode::SafeStop);  // the setting wins
    QCOMPARE(qplc::ProfileDefaults::of(Profile::Plant).longestWait, std::chrono::nanoseconds(5s));
}

void tst_Profiles::gapDoesNotStopASimulation()
{
    const auto stateAfterAGap = [](Profile::Value profile) {
        ProfiledMaster master(profile);
        CounterNode node;  // in the process of the master: while it stands still, so do the cycles
        node.onStep = [](const QPlcCycle &cycle) {
            if (cycle.number() == 3)
                beBusyFor(1100ms);
        };
        const bool isRight = master.addLocalNode(&node) && master.startRealTime() && master.waitForCycles(4);
        pass(50ms);
        const auto state = master.state();
        master.stop();
        return isRight ? state : QPlcMasterNode::Fault;
    };
    QCOMPARE(stateAfterAGap(Profile::Simulation), QPlcMasterNode::RealTime);
    QCOMPARE(stateAfterAGap(Profile::Plant), QPlcMasterNode::SafeStop);
}

void tst_Profiles::realDevicesMakeAPlant()
{
    ProfiledMaster master(Profile::Automatic);
    QVERIFY(master.listen());
    CounterNode winch(QStringLiteral("Winch"));
    winch.setHardware(true);
    QVERIFY(master.admit(winch, datagrams()));
    QCOMPARE(master.profile(), Profile::Plant);
    QCOMPARE(master.profileReason(), QString("node 'Winch' drives real devices"));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(3));
    QCOMPARE(winch.profile(), Profile::Plant);
    QCOMPARE(winch.watchdog(), std::chrono::nanoseconds(500ms));
    master.stop();
    winch.disconnectFromMaster();
    QTRY_VERIFY(master.nodes().isEmpty());
    QCOMPARE(master.profile(), Profile::Simulation);
}

void tst_Profiles::realDevicesAreRefusedInASimulationUntilTheNextStart()
{
    ProfiledMaster master(Profile::Automatic);
    QVERIFY(master.listen());
    EchoNode echo;
    QVERIFY(master.admit(echo, datagrams()));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(3));
    CounterNode winch(QStringLiteral("Winch"));
    winch.setHardware(true);
    QVERIFY(!master.admit(winch, datagrams()));
    QCOMPARE(winch.error(), QPlcSlaveNode::RegistrationError);
    QVERIFY2(winch.errorString().contains("the phase at hand has the profile Simulation"),
             qPrintable(winch.errorString()));
    QCOMPARE(winch.resets, 0);
    master.stop();
    QVERIFY(master.admit(winch, datagrams()));
    QCOMPARE(master.profile(), Profile::Plant);
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(winch.state(), QPlcSlaveNode::RealTime);
    master.stop();
}

void tst_Profiles::realDevicesInThisProcessMakeAPlant()
{
    ProfiledMaster master(Profile::Automatic, QPlcClock::lockstep());
    CounterNode winch;
    winch.setHardware(true);
    QVERIFY(master.addLocalNode(&winch));
    QCOMPARE(master.profile(), Profile::Plant);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    QCOMPARE(winch.profile(), Profile::Plant);
    QCOMPARE(winch.watchdog(), std::chrono::nanoseconds(0));  // the master needs no frame to reach it
    master.stop();
}

QTPLC_VIRTUAL_TIME_MAIN(tst_Profiles)
#include "tst_Profiles.moc"
