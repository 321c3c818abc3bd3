// SPDX-License-Identifier: Apache-2.0
// Which nodes a plant needs, by its manifest or because they are critical, and that nothing begins
// without them.
#include "../common/Waiting.h"
#include "SafeNode.h"
#include "SecurityFixtures.h"
#include "VirtualTime.h"
#include "node/session/NeededNodes.h"

using namespace std::chrono_literals;
using State = QPlcMasterNode::State;

namespace {

/// A master in real time; without a manifest if \a manifest is empty.
class NeedingMaster : public TestMaster
{
public:
    explicit NeedingMaster(const char *manifest = "")
        : TestMaster(QPlcClock::realTime())
    {
        setInterval(5ms);
        isSet = *manifest == '\0' || setManifest(QPlcManifest::fromIni(manifest));
    }
    /// Whether neither an initialization nor a start begins, and both name \a reason.
    bool refuses(const QString &reason)
    {
        const State before = state();
        const auto isNamed = [&](bool hasBegun) {
            const bool is = !hasBegun && error() == StateError && errorString().contains(reason) && state() == before;
            if (!is)
                qWarning("%s", qPrintable(errorString()));
            return is;
        };
        return isNamed(initializeAllStates()) && isNamed(startRealTime()) && missingNodes().contains(reason);
    }
    bool starts()
    {
        const bool has = startRealTime() && waitForState(RealTime);
        if (!has)
            qWarning("%s", qPrintable(errorString()));
        return has;
    }
    bool isWithout(const QString &name)
    {
        return waitUntil([&] {
            const QVector<QPlcNodeInfo> all = nodes();
            return std::none_of(all.begin(), all.end(), [&](const auto &node) { return node.name == name; });
        });
    }

    bool isSet = false;
};

constexpr const char *winchIsCritical = "[Winch]\nneed = critical\n[Counter]\n";
constexpr const char *winchIsRequired = "[Winch]\n[Counter]\n";

}  // namespace

class tst_NeededNodes : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    // with a manifest
    void absentNodeIsNamedAndNothingBegins();
    void nodeLostInReadyIsMissing();
    void requiredNodeLostWhileCyclesRunIsMissingAtTheNextStart();
    void criticalNodeIsMissingAfterAResetToo();
    void silentNodeEndsTheStartAndIsNamed();
    void silentNodeThatIsNeededIsMissingAfterwards();
    void refusedNodeIsMissingWithTheReason();
    void masterThatWasStartedAgainNeedsTheNodesOfItsManifest();
    void manifestMakesANodeCritical();
    void optionalNodeIsNotNeeded();
    void optionalNodeThatIsCriticalIsNotNeeded();
    void listenerDoesNotReplaceANode();
    void watchdogHasToBeShortEnough_data();
    void watchdogHasToBeShortEnough();
    void identityHasToBeProven();
    void identitiesNeedSecurity();
    void profileOfTheManifestIsBetweenTheSetOneAndTheFacts();
    void nodeWithASimilarNameIsSuggested();
    void stateTellsMissingNodes();
    void manifestIsSetBeforeNodesAndServersOnly();
    // without one
    void criticalNodeThatHasRegisteredIsNeeded();
    void criticalNodeThatWasRefusedIsNeeded();
    void nodeStaysCriticalUntilTheMasterEnds();
    void criticalNodeThatComesDuringTheInitializationIsNotLeftBehind();
    void localNodeIsNeededUntilItIsRemoved();
    void rememberedNodesHaveABound();
    void silentNodeThatIsNotNeededBlocksOneStartOnly();
};

void tst_NeededNodes::absentNodeIsNamedAndNothingBegins()
{
    NeedingMaster master(winchIsCritical);
    QVERIFY(master.isSet && master.listen());
    QVERIFY(master.refuses("critical node 'Winch' (has not registered), required node 'Counter' (has not registered) "
                           "are missing; start them"));
    CounterNode counter;
    QVERIFY(master.admit(counter, datagrams()));
    QVERIFY(master.refuses("critical node 'Winch' (has not registered) is missing; start it"));
    QCOMPARE(counter.resets, 0);
    QVERIFY(!master.arm());
    SafeNode winch;
    QVERIFY(master.admit(winch, datagrams()));
    QCOMPARE(master.missingNodes(), QString());
    QVERIFY(master.starts());
}

void tst_NeededNodes::nodeLostInReadyIsMissing()
{
    NeedingMaster master(winchIsRequired);
    QVERIFY(master.listen());
    CounterNode counter;
    SafeNode winch;
    QVERIFY(master.admit(counter, datagrams()) && master.admit(winch, datagrams()));
    QVERIFY(master.initializeAllStates() && master.waitForState(State::Ready));
    winch.disconnectFromMaster();
    QVERIFY(master.waitForState(State::Off));
    QVERIFY(master.refuses("required node 'Winch' (has left: "));
    QVERIFY(master.admit(winch, datagrams()));
    QVERIFY(master.starts());
}

void tst_NeededNodes::requiredNodeLostWhileCyclesRunIsMissingAtTheNextStart()
{
    NeedingMaster master(winchIsRequired);
    QVERIFY(master.listen());
    CounterNode counter;
    SafeNode winch;
    QVERIFY(master.admit(counter, datagrams()) && master.admit(winch, datagrams()));
    QVERIFY(master.starts());
    winch.disconnectFromMaster();
    QVERIFY(master.isWithout("Winch"));
    const quint64 cycles = master.statistics().cycles;
    QVERIFY(master.waitForCycles(cycles + 5));
    QCOMPARE(master.state(), State::RealTime);  // it is not critical
    master.stop();
    QVERIFY(master.refuses("required node 'Winch' (has left: "));
}

void tst_NeededNodes::criticalNodeIsMissingAfterAResetToo()
{
    NeedingMaster master(winchIsCritical);
    QVERIFY(master.listen());
    CounterNode counter;
    SafeNode winch;
    QVERIFY(master.admit(counter, datagrams()) && master.admit(winch, datagrams()));
    QVERIFY(master.starts());
    winch.disconnectFromMaster();
    QVERIFY(master.waitForState(State::SafeStop));
    QVERIFY(!master.reset());
    QVERIFY(master.admit(winch, datagrams()));
    QVERIFY(master.reset());
    winch.disconnectFromMaster();
    QVERIFY(master.isWithout("Winch"));
    QVERIFY(master.refuses("critical node 'Winch' (has left: "));
}

/// As a process that was stopped: its connection is there, and nobody answers.
void tst_NeededNodes::silentNodeEndsTheStartAndIsNamed()
{
    NeedingMaster master("[Scripted]\nneed = critical\n");
    QVERIFY(master.listen());
    ScriptedNode node;
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates() && master.waitForState(State::Ready));
    node.playsAlong = false;
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(State::Off));
    QVERIFY2(master.errorString().contains("from node 'Scripted'"), qPrintable(master.errorString()));
    QCOMPARE(master.statistics().cycles, quint64(0));
}

void tst_NeededNodes::refusedNodeIsMissingWithTheReason()
{
    NeedingMaster master("[Winch]\ntransport = tcp\n");
    QVERIFY(master.listen());
    SafeNode winch;
    QVERIFY(!master.admit(winch, datagrams()));
    const QString reason
        = QStringLiteral("node 'Winch' uses the transport '%1'; the manifest says transport = tcp; use it")
              .arg(datagrams());
    QVERIFY2(winch.errorString().contains(reason), qPrintable(winch.errorString()));
    QVERIFY(master.refuses("required node 'Winch' (was refused: " + reason + ')'));
}

void tst_NeededNodes::masterThatWasStartedAgainNeedsTheNodesOfItsManifest()
{
    CounterNode counter;
    {
        NeedingMaster master(winchIsCritical);
        QVERIFY(master.listen());
        SafeNode winch;
        QVERIFY(master.admit(counter, datagrams()) && master.admit(winch, datagrams()));
        QVERIFY(master.starts());
    }
    counter.disconnectFromMaster();
    NeedingMaster again(winchIsCritical);
    QVERIFY(again.listen());
    QVERIFY(again.admit(counter, datagrams()));
    QVERIFY(again.refuses("critical node 'Winch' (has not registered) is missing"));
    counter.disconnectFromMaster();

    NeedingMaster withoutManifest;
    QVERIFY(withoutManifest.listen());
    QVERIFY(withoutManifest.admit(counter, datagrams()));
    QVERIFY(withoutManifest.starts());
}

void tst_NeededNodes::manifestMakesANodeCritical()
{
    NeedingMaster master(winchIsCritical);
    QVERIFY(master.listen());
    CounterNode counter;
    SafeNode winch;
    QVERIFY(!winch.isCritical());
    QVERIFY(master.admit(counter, datagrams()) && master.admit(winch, datagrams()));
    QVERIFY(master.nodes().at(1).critical);
    QVERIFY(master.starts());
    winch.disconnectFromMaster();
    QVERIFY(master.waitForState(State::SafeStop));
}

void tst_NeededNodes::optionalNodeIsNotNeeded()
{
    NeedingMaster master("[Winch]\nneed = optional\ntransport = tcp\n[Counter]\n");
    QVERIFY(master.listen());
    CounterNode counter;
    SafeNode winch;
    QVERIFY(master.admit(counter, datagrams()));
    QVERIFY(!master.admit(winch, datagrams()));  // what the manifest says of it counts nevertheless
    QVERIFY(master.starts());
}

void tst_NeededNodes::optionalNodeThatIsCriticalIsNotNeeded()
{
    NeedingMaster master("[Winch]\nneed = optional\n[Counter]\n");
    QVERIFY(master.listen());
    CounterNode counter;
    SafeNode winch;
    winch.setCritical(true);
    QVERIFY(master.admit(counter, datagrams()) && master.admit(winch, datagrams()));
    QVERIFY(master.nodes().at(1).critical);
    winch.disconnectFromMaster();
    QVERIFY(master.isWithout("Winch"));
    QVERIFY(master.starts());
}

void tst_NeededNodes::listenerDoesNotReplaceANode()
{
    NeedingMaster master("[Winch]\n");
    QVERIFY(master.listen());
    ScriptedNode listener("Winch");
    listener.onlyListen();
    QVERIFY(!listener.registerAt(master.serverPort()));
    QCOMPARE(listener.registered.text("error"), QString("ManifestMismatch"));
    QVERIFY(master.refuses("node 'Winch' is a listener; the manifest says that the plant needs it"));
}

void tst_NeededNodes::watchdogHasToBeShortEnough_data()
{
    QTest::addColumn<int>("watchdog");  // [ms] -1: the node sets none
    QTest::addColumn<bool>("reports");
    QTest::addColumn<bool>("isPlant");
    QTest::addColumn<QString>("refusal");
    QTest::newRow("as long as allowed") << 400 << false << true << QString();
    QTest::newRow("too long") << 401 << false << true << QString("has a watchdog of 401 ms");
    QTest::newRow("none") << 0 << false << true << QString("has no watchdog that leads to its safe state");
    QTest::newRow("one that reports") << 400 << true << true << QString("has no watchdog that leads to its safe state");
    QTest::newRow("usual one") << -1 << false << true << QString("has a watchdog of 500 ms");
    QTest::newRow("none in a simulation") << -1 << false << false << QString();
}

void tst_NeededNodes::watchdogHasToBeShortEnough()
{
    QFETCH(int, watchdog);
    QFETCH(bool, reports);
    QFETCH(bool, isPlant);
    QFETCH(QString, refusal);
    NeedingMaster master("[Winch]\nwatchdog = 400 ms\n");
    master.setProfile(isPlant ? QPlcProfile::Plant : QPlcProfile::Simulation);
    QVERIFY(master.listen());
    SafeNode winch;
    if (watchdog >= 0)
        winch.activateWatchdog(std::chrono::milliseconds(watchdog));
    if (reports)
        winch.setWatchdogReaction(QPlcSlaveNode::WatchdogReaction::Report);
    QCOMPARE(master.admit(winch, datagrams()), refusal.isEmpty());
    if (refusal.isEmpty())
        return;
    QVERIFY2(winch.errorString().contains(
                 QStringLiteral("node 'Winch' %1; the manifest says watchdog = 400 ms; start it with --watchdog 0.4")
                     .arg(refusal)),
             qPrintable(winch.errorString()));
}

void tst_NeededNodes::identityHasToBeProven()
{
    const SecurityFiles files;
    NeedingMaster master("[Echo]\nidentity = Echo\n[Pump]\nidentity = Counter\n");
    master.setSecurity(QPlcSecurity::preSharedKeys(files.masterKeys()));
    QVERIFY(master.listen());
    EchoNode echo;
    echo.setSecurity(files.echo());
    QVERIFY(master.admit(echo, datagrams()));
    QCOMPARE(master.nodes().first().identity, QString("Echo"));
    CounterNode pump("Pump");
    pump.setSecurity(files.carl());  // an engineer may run nodes
    QVERIFY(!master.admit(pump, datagrams()));
    QVERIFY2(pump.errorString().contains("node 'Pump' has the identity 'carl'; the manifest says identity = Counter"),
             qPrintable(pump.errorString()));
}

void tst_NeededNodes::identitiesNeedSecurity()
{
    NeedingMaster master("[Echo]\nidentity = Echo\n");
    QVERIFY(!master.listen());
    QCOMPARE(master.error(), QPlcMasterNode::ServerError);
    QVERIFY2(master.errorString().contains("identity = Echo for node 'Echo', and the master has no security"),
             qPrintable(master.errorString()));
}

void tst_NeededNodes::profileOfTheManifestIsBetweenTheSetOneAndTheFacts()
{
    const auto profileOf = [](const char *manifest, QPlcProfile::Value wanted) {
        NeedingMaster master(manifest);
        master.setProfile(wanted);
        return QPlcProfile::name(master.profile()) + ": " + master.profileReason();
    };
    QCOMPARE(profileOf("[A]\n", QPlcProfile::Automatic), QString("Plant: the plant has a manifest"));
    QCOMPARE(profileOf("profile = Simulation\n[A]\n", QPlcProfile::Automatic),
             QString("Simulation: set by the manifest"));
    QCOMPARE(profileOf("profile = Simulation\n[A]\n", QPlcProfile::Plant), QString("Plant: set at the master"));
    QVERIFY(profileOf("", QPlcProfile::Automatic).startsWith("Simulation"));
}

void tst_NeededNodes::nodeWithASimilarNameIsSuggested()
{
    NeedingMaster master("[Winsh]\n");
    QVERIFY(master.listen());
    SafeNode winch;
    QVERIFY(master.admit(winch, datagrams()));
    QVERIFY(master.refuses("required node 'Winsh' (has not registered; did you mean 'Winch'?) is missing"));
}

void tst_NeededNodes::stateTellsMissingNodes()
{
    NeedingMaster master("[Winch]\n[Scripted]\n");
    QVERIFY(master.listen());
    ScriptedNode node;
    QVERIFY(node.registerAt(master.serverPort()));
    node.forgetMessages();
    node.send(QPlcMessage::GetState);
    QCOMPARE(node.next().text("missing"), QString("required node 'Winch' (has not registered) is missing; start it"));
    SafeNode winch;
    winch.activateWatchdog(300ms);
    winch.setWatchdogReaction(QPlcSlaveNode::WatchdogReaction::SafeState);
    node.outputs.clear();
    node.control.close();
    QVERIFY(master.isWithout("Scripted"));
    QVERIFY(master.admit(winch, datagrams()));
    QCOMPARE(master.nodes().first().watchdog, std::chrono::nanoseconds(300ms));
}

void tst_NeededNodes::manifestIsSetBeforeNodesAndServersOnly()
{
    const QPlcManifest manifest = QPlcManifest::fromIni("[Winch]\n");
    NeedingMaster listening;
    QVERIFY(listening.listen());
    QVERIFY(!listening.setManifest(manifest));
    QCOMPARE(listening.error(), QPlcMasterNode::StateError);

    NeedingMaster withNode;
    CounterNode counter;
    QVERIFY(withNode.addLocalNode(&counter));
    QVERIFY(!withNode.setManifest(manifest));

    NeedingMaster master;
    QVERIFY(!master.setManifest(QPlcManifest()));
    QCOMPARE(master.error(), QPlcMasterNode::NodeError);
    QVERIFY(master.setManifest(manifest));
    QCOMPARE(master.manifest().toIni(), manifest.toIni());
}

void tst_NeededNodes::criticalNodeThatHasRegisteredIsNeeded()
{
    NeedingMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    SafeNode winch;
    winch.setCritical(true);
    QVERIFY(master.admit(counter, datagrams()) && master.admit(winch, datagrams()));
    QVERIFY(master.initializeAllStates() && master.waitForState(State::Ready));
    winch.disconnectFromMaster();
    QVERIFY(master.waitForState(State::Off));
    QVERIFY(master.refuses("critical node 'Winch' (has left: "));
    QVERIFY(master.refuses("is missing; start it again, or start the master again if the plant may run without it"));
    QVERIFY(master.admit(winch, datagrams()));
    QVERIFY(master.starts());
}

void tst_NeededNodes::criticalNodeThatWasRefusedIsNeeded()
{
    NeedingMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    QVERIFY(master.admit(counter, datagrams()));
    ScriptedNode winch("Winch");
    winch.critical = true;
    winch.outputs = QStringList{"count"};  // Counter writes it
    QVERIFY(!winch.registerAt(master.serverPort()));
    QVERIFY(master.refuses("critical node 'Winch' (was refused: signal 'count' cannot be written"));
}

void tst_NeededNodes::nodeStaysCriticalUntilTheMasterEnds()
{
    NeedingMaster master;
    QVERIFY(master.listen());
    SafeNode winch;
    winch.setCritical(true);
    QVERIFY(master.admit(winch, datagrams()));
    winch.disconnectFromMaster();
    QVERIFY(master.isWithout("Winch"));
    winch.setCritical(false);
    QVERIFY(master.admit(winch, datagrams()));
    QVERIFY(master.nodes().first().critical);
}

/// It was not there when the initialization began, and has no values when the others have theirs.
void tst_NeededNodes::criticalNodeThatComesDuringTheInitializationIsNotLeftBehind()
{
    NeedingMaster master;
    QVERIFY(master.listen());
    ScriptedNode slow;
    slow.playsAlong = false;
    QVERIFY(slow.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(slow.waitForMessage(QPlcMessage::SendYourInitialOutputStates));
    CounterNode winch("Winch");
    winch.setCritical(true);
    QVERIFY(master.admit(winch, datagrams()));
    QCOMPARE(master.state(), State::Initializing);
    slow.playsAlong = true;
    slow.send(QPlcMessage::ReceiveMyInitialOutputStates,
              {{"values", QString::fromLatin1(slow.initialValues.toBase64())}});
    QVERIFY(master.waitForState(State::Off));
    QVERIFY2(master.errorString().contains(
                 "critical node 'Winch' (came too late for the initialization) is missing; initialize again"),
             qPrintable(master.errorString()));
    QCOMPARE(master.statistics().cycles, quint64(0));
    QVERIFY(master.starts());
    QCOMPARE(winch.resets, 1);
}

void tst_NeededNodes::localNodeIsNeededUntilItIsRemoved()
{
    NeedingMaster master;
    CounterNode counter;
    {
        SafeNode winch;
        winch.setCritical(true);
        QVERIFY(master.addLocalNode(&counter) && master.addLocalNode(&winch));
        master.removeLocalNode(&winch);
    }
    QVERIFY(master.starts());
    master.stop();

    NeedingMaster strict("[Winch]\ntransport = inprocess\nwatchdog = 1 ms\n");
    SafeNode winch;
    QVERIFY(strict.addLocalNode(&winch));
    strict.removeLocalNode(&winch);
    QVERIFY(strict.refuses("required node 'Winch' (was removed) is missing"));
}

void tst_NeededNodes::rememberedNodesHaveABound()
{
    const qplc::NodeSessions none;
    qplc::NeededNodes needed(none, [] { return 0ns; });
    qplc::NodeDeclaration node;
    const auto judge = [&](int number) {
        node.name = QStringLiteral("Node %1").arg(number);
        node.critical = true;
        return needed.judge(&node, QStringLiteral("udp"), QString()).error;
    };
    for (int i = 0; i < qplc::NodeRegistry::MaximumNodes; ++i)
        QCOMPARE(judge(i), QString());
    QCOMPARE(judge(qplc::NodeRegistry::MaximumNodes), QString("TooManyNodes"));
    QCOMPARE(judge(0), QString());
    needed.forget("Node 7");
    QCOMPARE(judge(qplc::NodeRegistry::MaximumNodes), QString());
    QVERIFY(needed.missingText(qplc::NodeSession::Idle).contains("and 992 more are missing"));
}

void tst_NeededNodes::silentNodeThatIsNotNeededBlocksOneStartOnly()
{
    NeedingMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    ScriptedNode silent("Winch");
    silent.playsAlong = false;
    QVERIFY(master.admit(counter, datagrams()) && silent.registerAt(master.serverPort()));
    QString reason;
    connect(&master, &QPlcMasterNode::nodeLost, this, [&](const QString &, const QString &text) { reason = text; });
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(State::Off));
    QVERIFY2(master.errorString().contains("from node 'Winch'; is it busy, or stopped?"),
             qPrintable(master.errorString()));
    QVERIFY(master.isWithout("Winch"));
    QVERIFY2(reason.contains("no answer to SendYourInitialOutputStates within 2000 ms"), qPrintable(reason));
    QVERIFY(master.starts());
}

void tst_NeededNodes::silentNodeThatIsNeededIsMissingAfterwards()
{
    NeedingMaster master("[Winch]\n");
    QVERIFY(master.listen());
    ScriptedNode silent("Winch");
    QVERIFY(silent.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates() && master.waitForState(State::Ready));
    silent.playsAlong = false;
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(State::Off));
    QVERIFY(master.isWithout("Winch"));
    QVERIFY(master.refuses("required node 'Winch' (has left: no answer to RealTimeStarted within 2000 ms"));
}

QTPLC_VIRTUAL_TIME_MAIN(tst_NeededNodes)
#include "tst_NeededNodes.moc"
