// SPDX-License-Identifier: Apache-2.0
// Out means out: who is evicted, and whose key or right is taken away.
#include "../common/Waiting.h"
#include "SafeNode.h"
#include "SecurityFixtures.h"
#include "VirtualTime.h"
#include "node/session/Evictions.h"

#include <QtCore/QElapsedTimer>

using namespace std::chrono_literals;
using State = QPlcMasterNode::State;

namespace {

class EvictingMaster : public TestMaster
{
public:
    using QPlcMasterNode::admit;
    using TestMaster::admit;

    explicit EvictingMaster(const char *manifest = "")
        : TestMaster(QPlcClock::realTime())
    {
        setInterval(5ms);
        if (*manifest != '\0' && !setManifest(QPlcManifest::fromIni(manifest)))
            qFatal("%s", qPrintable(errorString()));
    }
    bool has(const QString &name) const
    {
        const QVector<QPlcNodeInfo> all = nodes();
        return std::any_of(all.begin(), all.end(), [&](const auto &node) { return node.name == name; });
    }
    bool refusesToStart(const QString &reason)
    {
        const bool isNamed = !startRealTime() && errorString().contains(reason);
        if (!isNamed)
            qWarning("%s", qPrintable(errorString()));
        return isNamed;
    }
    bool starts() { return startRealTime() && waitForState(RealTime) && waitForCycles(3); }
};

/// A winch that comes back by itself.
class ReturningWinch : public SafeNode
{
public:
    explicit ReturningWinch(bool isCritical)
    {
        setCritical(isCritical);
        setReconnectPolicy(ReconnectAlways);
    }
};

bool isRejected(const ScriptedNode &node, const QString &text)
{
    return waitUntil([&] {
        return std::any_of(node.messages.begin(), node.messages.end(), [&](const QPlcMessage &message) {
            return message.kind() == QPlcMessage::Rejected && message.text("text").contains(text);
        });
    });
}

}  // namespace

class tst_Evictions : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void evictedNodeStaysOutAndNeeded_data();
    void evictedNodeStaysOutAndNeeded();
    void evictionWhileCyclesRun_data();
    void evictionWhileCyclesRun();
    void evictionEndsAnInitialization();
    void evictedListenerDisturbsNobody();
    void evictedPersonLosesItsLeases();
    void nodesOfTheMasterAreNotEvicted();
    void neededNodeIsEvictedWhileItIsAway();
    void onlyKnownNamesAreEvicted_data();
    void onlyKnownNamesAreEvicted();
    void nobodyEvictsItself();
    void manyEvictionsHaveABound();
    void operatorsEvictAndNoEngineer();
    void evictionIsInTheEventLogAndInTheState();
    void programEvictsSomebodyWhoseMessageIsAtHand();
    // keys and rights
    void revokedKeyEndsConnectionsAndSessions_data();
    void revokedKeyEndsConnectionsAndSessions();
    void changedRightsCountAtOnce();
    void unreadableFilesEndNoConnection();

private:
    SecurityFiles m_files;
};

void tst_Evictions::evictedNodeStaysOutAndNeeded_data()
{
    QTest::addColumn<QByteArray>("manifest");
    QTest::addColumn<bool>("critical");
    QTest::newRow("critical by itself") << QByteArray() << true;
    QTest::newRow("critical by the manifest") << QByteArray("[Winch]\nneed = critical\n") << false;
    QTest::newRow("required") << QByteArray("[Winch]\n") << false;
}

void tst_Evictions::evictedNodeStaysOutAndNeeded()
{
    QFETCH(QByteArray, manifest);
    QFETCH(bool, critical);
    EvictingMaster master(manifest.constData());
    QVERIFY(master.listen());
    CounterNode counter;
    ReturningWinch winch(critical);
    QVERIFY(master.admit(counter, datagrams()) && master.admit(winch, datagrams()));
    QVERIFY(master.initializeAllStates() && master.waitForState(State::Ready));
    QVERIFY(master.evict("Winch"));
    QVERIFY(!master.has("Winch"));
    QCOMPARE(master.state(), State::Off);
    QVERIFY(master.refusesToStart("node 'Winch' (was evicted by the master: qtplc admit 'Winch') is missing"));
    QVERIFY(waitUntil([&] { return winch.errorString().contains("'Winch' was evicted by the master"); }));
    int refusals = 0;
    connect(&master, &QPlcMasterNode::nodeRefused, this, [&] { ++refusals; });
    QVERIFY(waitUntil([&] { return refusals >= 3; }, 120000));  // it tries again
    QVERIFY(!master.has("Winch"));
    QVERIFY(master.refusesToStart("'Winch' was evicted by the master"));
    QVERIFY(master.evict("Winch"));  // as it is
    QCOMPARE(master.evictedNames(), QStringList{"Winch"});
    QVERIFY(master.admit("Winch"));
    QCOMPARE(master.evictedNames(), QStringList());
    QVERIFY(master.refusesToStart("has not registered since it was admitted again"));
    QVERIFY(waitUntil([&] { return master.has("Winch"); }, 120000));
    QVERIFY(master.starts());
    QVERIFY(!master.admit("Winch"));
    QVERIFY(master.errorString().contains("'Winch' is not evicted"));
}

void tst_Evictions::evictionWhileCyclesRun_data()
{
    QTest::addColumn<bool>("critical");
    QTest::addColumn<State>("state");
    QTest::newRow("critical") << true << State::SafeStop;
    QTest::newRow("not critical") << false << State::RealTime;
}

void tst_Evictions::evictionWhileCyclesRun()
{
    QFETCH(bool, critical);
    QFETCH(State, state);
    EvictingMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    ReturningWinch winch(critical);
    QVERIFY(master.admit(counter, datagrams()) && master.admit(winch, datagrams()));
    QVERIFY(master.starts());
    QVERIFY(master.evict("Winch"));
    QCOMPARE(master.state(), state);
    QVERIFY(waitUntil([&] { return winch.safeStates > 0; }));
    const int steps = winch.steps;
    const quint64 cycles = master.statistics().cycles;
    QVERIFY(master.waitForCycles(cycles + 500));
    QCOMPARE(int(winch.steps), steps);  // it has come back again and again
    QCOMPARE(master.state(), state);
    if (critical) {
        QVERIFY(!master.reset());
        master.stop();
        QVERIFY(!master.startRealTime());
    }
}

void tst_Evictions::evictionEndsAnInitialization()
{
    EvictingMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    ScriptedNode slow("Winch");
    slow.playsAlong = false;
    QVERIFY(master.admit(counter, datagrams()) && slow.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(slow.waitForMessage(QPlcMessage::SendYourInitialOutputStates));
    QVERIFY(master.evict("Winch"));
    QCOMPARE(master.state(), State::Off);
    QVERIFY(isRejected(slow, "'Winch' was evicted by the master"));
    QVERIFY(master.starts());  // it was not critical
}

void tst_Evictions::evictedListenerDisturbsNobody()
{
    EvictingMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    ScriptedNode listener("Logger");
    listener.onlyListen();
    QVERIFY(master.admit(counter, datagrams()) && listener.registerAt(master.serverPort()));
    QVERIFY(master.starts());
    QVERIFY(master.evict("Logger"));
    QVERIFY(isRejected(listener, "evicted"));
    QVERIFY(!master.has("Logger"));
    QVERIFY(master.waitForCycles(master.statistics().cycles + 10));
    QCOMPARE(master.state(), State::RealTime);
    QCOMPARE(master.missingNodes(), QString());
}

void tst_Evictions::evictedPersonLosesItsLeases()
{
    EvictingMaster master;
    QVERIFY(master.listen());
    ScriptedTool tool("anna"), other("bert");
    QVERIFY(tool.greetAt(master.serverPort()) && other.greetAt(master.serverPort()));
    QCOMPARE(tool.ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"setpoint"}}}).kind(), QPlcMessage::Done);
    QCOMPARE(master.leases().size(), 1);
    QCOMPARE(other.ask(QPlcMessage::Evict, {{"name", "anna"}}).kind(), QPlcMessage::Done);
    QVERIFY(isRejected(tool, "'anna' was evicted by 'bert'; an operator can let it in again: qtplc admit 'anna'"));
    QVERIFY(waitUntil([&] { return !tool.control.isConnected() && master.leases().constFirst().isLost; }));
    ScriptedTool again("anna");
    QVERIFY(!again.greetAt(master.serverPort()));
    ScriptedNode node("anna");
    QVERIFY(!node.registerAt(master.serverPort()));
    QCOMPARE(other.ask(QPlcMessage::Admit, {{"name", "anna"}}).kind(), QPlcMessage::Done);
    ScriptedTool admitted("anna");
    QVERIFY(admitted.greetAt(master.serverPort()));
}

void tst_Evictions::nodesOfTheMasterAreNotEvicted()
{
    EvictingMaster master;
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(!master.evict("Counter"));
    QVERIFY(master.errorString().contains("node 'Counter' runs in the process of the master"));
    QVERIFY(!master.evict("Master"));
    QVERIFY(master.starts());
}

void tst_Evictions::neededNodeIsEvictedWhileItIsAway()
{
    EvictingMaster master("[Winch]\nneed = critical\n");
    QVERIFY(master.listen());
    QVERIFY(master.evict("Winch"));
    SafeNode winch;
    QVERIFY(!master.admit(winch, datagrams()));
    QVERIFY(master.refusesToStart("'Winch' was evicted by the master"));
}

void tst_Evictions::onlyKnownNamesAreEvicted_data()
{
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("reason");
    QTest::newRow("nobody") << "Camera"
                            << "nobody is connected as 'Camera'";
    QTest::newRow("misspelt") << "Winhc"
                              << "nobody is connected as 'Winhc'; did you mean 'Winch'?";
    QTest::newRow("empty") << ""
                           << "nobody is connected as ''";
    QTest::newRow("control characters") << "a\n\x1b[2Jb"
                                        << "nobody is connected as 'a??[2Jb'";
    QTest::newRow("too long") << QString(100000, 'x') << "nobody is connected as 'xxx";
}

void tst_Evictions::onlyKnownNamesAreEvicted()
{
    QFETCH(QString, name);
    QFETCH(QString, reason);
    EvictingMaster master;
    QVERIFY(master.listen());
    SafeNode winch;
    QVERIFY(master.admit(winch, datagrams()));
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    const QPlcMessage answer = tool.ask(QPlcMessage::Evict, {{"name", name}});
    QCOMPARE(answer.kind(), QPlcMessage::Failed);
    QVERIFY2(answer.text("text").contains(reason), qPrintable(answer.text("text")));
    QVERIFY(answer.text("text").size() < 1000);
    QCOMPARE(tool.ask(QPlcMessage::Admit, {{"name", name}}).kind(), QPlcMessage::Failed);
    QCOMPARE(tool.ask(QPlcMessage::Evict).text("error"), QString("MalformedMessage"));
    QCOMPARE(master.evictedNames(), QStringList());
    QVERIFY(master.has("Winch"));
}

void tst_Evictions::nobodyEvictsItself()
{
    EvictingMaster master;
    QVERIFY(master.listen());
    ScriptedTool tool("anna");
    QVERIFY(tool.greetAt(master.serverPort()));
    const QPlcMessage answer = tool.ask(QPlcMessage::Evict, {{"name", "anna"}});
    QVERIFY2(answer.text("text").contains("'anna' is you"), qPrintable(answer.text("text")));
    QCOMPARE(tool.ask(QPlcMessage::GetState).kind(), QPlcMessage::State);
}

void tst_Evictions::manyEvictionsHaveABound()
{
    const LogCapture quiet;
    EvictingMaster master("[Winch]\n");
    QVERIFY(master.listen());
    for (int i = 0; i < 100000; ++i)
        QVERIFY(!master.evict(QString::number(i)));
    for (int i = 0; i < 100000; ++i)
        QVERIFY(master.evict("Winch") && (i % 100 != 0 || master.admit("Winch")));
    QCOMPARE(master.evictedNames(), QStringList{"Winch"});

    qplc::Evictions book;
    for (int i = 0; i < qplc::Evictions::Most; ++i)
        QVERIFY(book.add(QString::number(i), "anna", qplc::Role::Engineer));
    QVERIFY(!book.add("one more", "anna", qplc::Role::Engineer));
    QVERIFY(book.add("7", "bert", qplc::Role::Engineer));
    QVERIFY(book.remove("7") && book.add("one more", "anna", qplc::Role::Engineer));
}

void tst_Evictions::operatorsEvictAndNoEngineer()
{
    EvictingMaster master;
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(master.listen());
    CounterNode counter;
    counter.setSecurity(m_files.counter());
    QVERIFY(master.admit(counter, datagrams()));
    SecuredTool anna(m_files.anna()), bert(m_files.bert()), carl(m_files.carl());
    anna.name = "anna's screen";
    QVERIFY(anna.greetAt(master.serverPort()) && bert.greetAt(master.serverPort())
            && carl.greetAt(master.serverPort()));
    const auto refusal = [](ScriptedTool &tool, const char *name) {
        return tool.ask(QPlcMessage::Evict, {{"name", name}}).text("text");
    };
    QCOMPARE(refusal(bert, "Counter"), QString("Denied: role Observer may not send Evict"));
    QCOMPARE(refusal(anna, "carl"), QString("Denied: only an Engineer may evict 'carl'"));
    QVERIFY(refusal(anna, "anna").contains("is you"));
    QVERIFY(refusal(anna, "anna's screen").contains("is you"));
    QCOMPARE(refusal(anna, "Counter"), QString());
    QVERIFY(!master.has("Counter"));
    QCOMPARE(refusal(carl, "anna"), QString());
    QVERIFY(isRejected(anna, "'anna' was evicted by 'carl"));
    SecuredTool again(m_files.anna());
    QVERIFY(!again.greetAt(master.serverPort()));
    QVERIFY(master.has("Counter") || master.evictedNames().contains("Counter"));
    QVERIFY2(master.evict("carl"), "the program of the master evicts everybody");
    QVERIFY(isRejected(carl, "'carl' was evicted by"));

    qplc::Evictions book;
    qplc::Peer engineer;
    engineer.isSecured = true;
    engineer.identity = "carl";
    QVERIFY(book.add("carl", "'anna'", qplc::Role::Operator));  // by a name that somebody has greeted with
    QCOMPARE(book.refusalOf("carl", engineer).error, QString());
    QVERIFY(book.add("carl", "'dora'", qplc::Role::Engineer));
    QCOMPARE(book.refusalOf("screen", engineer).error, QString("Evicted"));
}

void tst_Evictions::evictionIsInTheEventLogAndInTheState()
{
    LogCapture log;
    EvictingMaster master;
    QVERIFY(master.listen());
    SafeNode winch;
    QVERIFY(master.admit(winch, datagrams()));
    ScriptedTool tool("anna");
    QVERIFY(tool.greetAt(master.serverPort()));
    const qint64 before = qplc::wallClockNow();
    QCOMPARE(tool.ask(QPlcMessage::Evict, {{"name", "Winch"}}).kind(), QPlcMessage::Done);
    QCOMPARE(log.matching("'Winch' is evicted by 'anna'").size(), 1);
    QCOMPARE(tool.ask(QPlcMessage::Evict, {{"name", "Winch"}}).kind(), QPlcMessage::Done);
    QCOMPARE(log.matching("'Winch' is evicted by 'anna'").size(), 1);
    const auto state = qplc::messages::readAs<qplc::messages::State>(tool.ask(QPlcMessage::GetState));
    QVERIFY(state && state->evicted.size() == 1);
    const qplc::messages::EvictedEntry entry = state->evicted.first();
    QCOMPARE(entry.name, QString("Winch"));
    QCOMPARE(entry.by, QString("'anna'"));
    QVERIFY(before <= qint64(entry.time) && qint64(entry.time) <= qplc::wallClockNow());
    QCOMPARE(tool.ask(QPlcMessage::Admit, {{"name", "Winch"}}).kind(), QPlcMessage::Done);
    QCOMPARE(log.matching("'Winch' is admitted again by 'anna'").size(), 1);
    QVERIFY(!tool.ask(QPlcMessage::GetState).fields().contains("evicted"));
}

/// Its connection is in use until the message is carried out.
void tst_Evictions::programEvictsSomebodyWhoseMessageIsAtHand()
{
    EvictingMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    QVERIFY(master.admit(counter, datagrams()));
    ScriptedTool tool("anna");
    QVERIFY(tool.greetAt(master.serverPort()));
    QVERIFY(master.starts());
    connect(&master, &QPlcMasterNode::stateChanged, this, [&] {
        QVERIFY(master.evict("anna"));
        QVERIFY(master.evict("Counter"));
    });
    connect(&master, &QPlcMasterNode::nodeLost, this, [&] { QVERIFY(!master.evict("nobody")); });
    connect(&master, &QPlcMasterNode::nodeRefused, this, [&](const QString &name) { QVERIFY(master.evict(name)); });
    QCOMPARE(tool.answerTo(QPlcMessage::Stop).kind(), QPlcMessage::Done);
    QVERIFY(isRejected(tool, "evicted"));
    QVERIFY(!master.has("Counter"));
    QCOMPARE(master.state(), State::Off);
}

// ---- keys and rights ----

void tst_Evictions::revokedKeyEndsConnectionsAndSessions_data()
{
    QTest::addColumn<QByteArray>("now");  // of Echo and anna
    QTest::addColumn<QString>("reason");
    const auto keys = [](char echo, char anna) {
        return SecurityFiles::section("Counter", SecurityFiles::key('a'), "Node")
            + SecurityFiles::section("Echo", SecurityFiles::key(echo), "Node")
            + SecurityFiles::section("anna", SecurityFiles::key(anna), "Operator");
    };
    QTest::newRow("revoked") << SecurityFiles::section("Counter", SecurityFiles::key('a'), "Node")
                             << "is revoked: the files of the master do not have it any more";
    QTest::newRow("replaced") << keys('8', '9') << "is revoked: the master has another one now";
}

void tst_Evictions::revokedKeyEndsConnectionsAndSessions()
{
    QFETCH(QByteArray, now);
    QFETCH(QString, reason);
    LogCapture log;
    EvictingMaster master;
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(master.listen());
    CounterNode counter;
    counter.setSecurity(m_files.counter());
    EchoNode echo;
    echo.setSecurity(m_files.echo());
    echo.setCritical(true);
    SecuredTool anna(m_files.anna());
    QVERIFY(master.admit(counter, datagrams()) && master.admit(echo, datagrams()));
    QVERIFY(anna.greetAt(master.serverPort()));
    QCOMPARE(anna.ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"setpoint"}}}).kind(), QPlcMessage::Done);
    QVERIFY(master.startArmed() && master.waitForCycles(10));
    m_files.write("keys.ini", now);
    QElapsedTimer timer;
    timer.start();
    QVERIFY(waitUntil([&] { return !master.has("Echo"); }));
    QVERIFY2(timer.elapsed() < 1000, "virtual time");
    QVERIFY(isRejected(anna, reason));
    QVERIFY(waitUntil([&] { return master.leases().constFirst().isLost; }));
    QVERIFY(waitUntil([&] { return echo.errorString().contains(reason); }));
    QCOMPARE(master.state(), State::SafeStop);
    QVERIFY(master.has("Counter"));
    QVERIFY(!log.matching("identity 'anna'").filter("revoked").isEmpty());
    QVERIFY(!log.matching("identity 'Echo'").filter("revoked").isEmpty());
}

void tst_Evictions::changedRightsCountAtOnce()
{
    LogCapture log;
    const QString access = m_files.write("access.ini", "[anna]\nrole = Operator\n[Counter]\nrole = Node\n");
    EvictingMaster master;
    master.setSecurity([&] {
        QPlcSecurity security = QPlcSecurity::preSharedKeys(m_files.masterKeys());
        security.setAccessFile(access);
        return security;
    }());
    QVERIFY(master.listen());
    CounterNode counter;
    counter.setSecurity(m_files.counter());
    SecuredTool anna(m_files.anna());
    QVERIFY(master.admit(counter, datagrams()));
    QVERIFY(anna.greetAt(master.serverPort()));
    m_files.write("access.ini", "[anna]\nrole = Observer\n[Counter]\nrole = Node\nwrites = count, sum\n");
    QVERIFY(isRejected(anna, "the rights of identity 'anna' were changed at the master; connect again"));
    QVERIFY(master.has("Counter"));  // it may still write what it has registered
    SecuredTool observer(m_files.anna());
    QVERIFY(observer.greetAt(master.serverPort()));
    QCOMPARE(observer.ask(QPlcMessage::InitializeAllStates).text("error"), QString("Denied"));
    m_files.write("access.ini", "[anna]\nrole = Observer\n[Counter]\nrole = Node\nwrites = sum\n");
    QVERIFY(waitUntil([&] { return !master.has("Counter"); }));
    QVERIFY(!log.matching("the rights of identity 'Counter' were changed at the master").isEmpty());
    QCOMPARE(observer.ask(QPlcMessage::GetState).kind(), QPlcMessage::State);
}

void tst_Evictions::unreadableFilesEndNoConnection()
{
    LogCapture log;
    EvictingMaster master;
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(master.listen());
    CounterNode counter;
    counter.setSecurity(m_files.counter());
    QVERIFY(master.admit(counter, datagrams()));
    m_files.write("keys.ini", "[Counter\n");
    QVERIFY(waitUntil([&] { return !log.matching("cannot read the key or rights file: ").isEmpty(); }));
    QTest::qWait(5000);
    QCOMPARE(log.matching("the master refuses new ones").size(), 1);
    QVERIFY(master.has("Counter"));
    SecuredTool anna(m_files.anna());
    QVERIFY(!anna.greetAt(master.serverPort()));
    m_files.masterKeys();
    QTest::qWait(2000);
    QVERIFY(master.has("Counter"));
    QVERIFY(master.startArmed());
}

QTPLC_VIRTUAL_TIME_MAIN(tst_Evictions)
#include "tst_Evictions.moc"
