// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "SecurityFixtures.h"
#include "VirtualTime.h"
#include "node/security/AccessRights.h"
#include "node/security/Keyring.h"

#include <QtCore/QMetaEnum>

using qplc::Keyring;
using qplc::Peer;
using qplc::Role;

// Who may do what: the table, the rights of single signals, and that a real master keeps to them.
class tst_AccessRights : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void eachRoleMaySendItsMessages_data();
    void eachRoleMaySendItsMessages();
    void masterDeniesMessagesThatARoleMayNotSend_data();
    void masterDeniesMessagesThatARoleMayNotSend();
    void everyKnownIdentityMayStop_data();
    void everyKnownIdentityMayStop();
    void aSecuredPlantStartsInTwoSteps();
    void armingIsSkippedOnlyWhenSwitchedOff();
    void masterWithoutSecurityAllowsEveryMessage();
    void aNodeHasTheNameOfItsIdentity();
    void anObserverListensOnly();
    void nodeCannotUseNameOfAnotherIdentity_data();
    void nodeCannotUseNameOfAnotherIdentity();
    void aConnectionForFramesMayOnlyAttach_data();
    void aConnectionForFramesMayOnlyAttach();
    void identityIsLimitedToThirtyTwoConnections();
    void signalsAreWrittenOnlyWithAccessRights();
    void commandsAreLogged();
    void commandsNameTheirSignals();
    void peopleAreShownByTheirProvenIdentity();
    void shownNamesCannotBeMistaken();
    void rolesHaveNames();
    void keysFilesHaveClearErrors_data();
    void keysFilesHaveClearErrors();

private:
    static Peer peerOf(Role role)
    {
        Peer peer;
        peer.isSecured = true;
        peer.identity = "somebody";
        peer.role = role;
        return peer;
    }
    /// Whether a person who reads the manual would expect \a role to be allowed to send \a kind.
    /// Written apart from the table.
    static bool isMeantTo(Role role, const QString &kind)
    {
        static const QStringList looking{"GetState",    "GetSignals", "GetStatistics",
                                         "GetSchedule", "GetLeases",  "GetEvents"};
        static const QStringList takingPart{
            "Hello",       "Register",      "AttachCyclicChannel", "ReceiveMyInitialOutputStates",
            "Initialized", "RealTimeReady", "NodeFault",           "NodeEvent",
            "Stop",        "SafeStop"};
        static const QStringList operating{
            "InitializeAllStates", "Arm",   "Reset", "StartRealTime", "SetSignals", "TakeLease",
            "ReleaseLease",        "Evict", "Admit", "Note",          "GetRecords"};
        return looking.contains(kind) || takingPart.contains(kind)
            || (operating.contains(kind) && (role == Role::Operator || role == Role::Engineer));
    }
    static bool isOfMasters(const QString &kind)
    {
        static const QStringList kinds{"Invalid",
                                       "Registered",
                                       "Rejected",
                                       "CyclicChannelAttached",
                                       "MasterEnds",
                                       "SendYourInitialOutputStates",
                                       "InitializeWithValues",
                                       "StatesInitialized",
                                       "RealTimeStarted",
                                       "RealTimeStopped",
                                       "Armed",
                                       "State",
                                       "Signals",
                                       "Done",
                                       "Failed",
                                       "Statistics",
                                       "Schedule",
                                       "Leases",
                                       "LeasesChanged",
                                       "Events",
                                       "Records"};
        return kinds.contains(kind);
    }
    void everyRoleAndKind();
    SecurityFiles m_files;
};

/// Each role and each kind that a client may send.
void tst_AccessRights::everyRoleAndKind()
{
    QTest::addColumn<int>("role");
    QTest::addColumn<int>("kind");
    const QMetaEnum kinds = QMetaEnum::fromType<QPlcMessage::Kind>();
    for (int i = 0; i < kinds.keyCount(); ++i) {
        for (Role role : qplc::allRoles)
            QTest::addRow("%s %s", qPrintable(qplc::roleName(role)), kinds.key(i)) << int(role) << kinds.value(i);
    }
}

void tst_AccessRights::eachRoleMaySendItsMessages_data()
{
    everyRoleAndKind();
}

void tst_AccessRights::eachRoleMaySendItsMessages()
{
    QFETCH(int, role);
    QFETCH(int, kind);
    const auto message = QPlcMessage::Kind(kind);
    const QString name = QPlcMessage::kindName(message);
    QCOMPARE(qplc::whoMaySend(message).contains(Role(role)), isMeantTo(Role(role), name));
    QCOMPARE(qplc::whoMaySend(message).isEmpty(), isOfMasters(name));
    if (isOfMasters(name))
        QCOMPARE(qplc::refusalOf(peerOf(Role(role)), QPlcMessage(message)), QString());  // it means nothing
}

void tst_AccessRights::masterDeniesMessagesThatARoleMayNotSend_data()
{
    everyRoleAndKind();
}

/// A client without any fields: what it may not do is denied, whatever else would be wrong; what it
/// may is answered with something else.
void tst_AccessRights::masterDeniesMessagesThatARoleMayNotSend()
{
    QFETCH(int, role);
    QFETCH(int, kind);
    const QString name = QPlcMessage::kindName(QPlcMessage::Kind(kind));
    if (isOfMasters(name) || isMeantTo(Role(role), name))
        return;  // without a right there is nothing to be denied; rights are shown by the tests of each message
    LogCapture log;
    TestMaster master;
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(master.listen());
    const QPlcSecurity securities[] = {m_files.bert(), m_files.anna(), m_files.counter(), m_files.carl()};
    SecuredTool tool(securities[role]);
    QVERIFY(tool.greetAt(master.serverPort()));
    const QPlcMessage answer = tool.ask(QPlcMessage::Kind(kind));
    QCOMPARE(answer.kind(), QPlcMessage::Failed);
    QCOMPARE(answer.text("error"), QString("Denied"));
    QCOMPARE(answer.text("text"), QString("Denied: role %1 may not send %2").arg(qplc::roleName(Role(role)), name));
    QCOMPARE(master.statistics().deniedMessages, quint64(1));
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QVERIFY(!log.matching("qtplc.audit: " + answer.text("text")).isEmpty());
    QCOMPARE(tool.ask(QPlcMessage::GetState).kind(), QPlcMessage::State);  // the connection stays
}

void tst_AccessRights::everyKnownIdentityMayStop_data()
{
    QTest::addColumn<int>("role");
    for (Role role : qplc::allRoles)
        QTest::newRow(qPrintable(qplc::roleName(role))) << int(role);
}

void tst_AccessRights::everyKnownIdentityMayStop()
{
    QFETCH(int, role);
    TestMaster master(QPlcClock::realTime());
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    CounterNode local;
    QVERIFY(master.addLocalNode(&local) && master.listen() && master.startArmed());
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    const QPlcSecurity securities[] = {m_files.bert(), m_files.anna(), m_files.echo(), m_files.carl()};
    SecuredTool tool(securities[role]);
    QVERIFY(tool.greetAt(master.serverPort()));
    QCOMPARE(tool.ask(QPlcMessage::Stop).kind(), QPlcMessage::Done);
    QCOMPARE(master.state(), QPlcMasterNode::Off);
}

void tst_AccessRights::aSecuredPlantStartsInTwoSteps()
{
    TestMaster master(QPlcClock::realTime());
    QVERIFY(!master.isArmingRequired());
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(master.isArmingRequired());
    CounterNode local;
    QVERIFY(master.addLocalNode(&local) && master.listen());
    SecuredTool anna(m_files.anna());
    QVERIFY(anna.greetAt(master.serverPort()));
    QVERIFY(anna.ask(QPlcMessage::GetState).fields().value("armingRequired").toBool());
    QVERIFY(anna.ask(QPlcMessage::StartRealTime).text("text").contains("initialize, arm, then start"));
    QCOMPARE(anna.answerTo(QPlcMessage::InitializeAllStates).kind(), QPlcMessage::Done);
    QVERIFY(anna.ask(QPlcMessage::StartRealTime).text("text").contains("not armed"));
    QVERIFY(!master.startRealTime());
    const QString token = anna.ask(QPlcMessage::Arm).text("token");
    SecuredTool carl(m_files.carl());
    QVERIFY(carl.greetAt(master.serverPort()));
    QCOMPARE(carl.answerTo(QPlcMessage::StartRealTime).kind(),
             QPlcMessage::Failed);  // who has not armed starts nothing
    QCOMPARE(master.state(), QPlcMasterNode::Ready);
    QCOMPARE(anna.ask(QPlcMessage::StartRealTime, {{"token", token}}).kind(), QPlcMessage::Done);
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    QCOMPARE(carl.ask(QPlcMessage::Stop).kind(), QPlcMessage::Done);
}

void tst_AccessRights::armingIsSkippedOnlyWhenSwitchedOff()
{
    TestMaster master(QPlcClock::realTime());
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    master.setArmingRequired(false);
    CounterNode local;
    QVERIFY(master.addLocalNode(&local) && master.listen());
    SecuredTool anna(m_files.anna());
    QVERIFY(anna.greetAt(master.serverPort()));
    QVERIFY(!anna.ask(QPlcMessage::GetState).fields().value("armingRequired").toBool(true));
    QCOMPARE(anna.answerTo(QPlcMessage::StartRealTime).kind(), QPlcMessage::Done);
    QTRY_COMPARE(master.state(), QPlcMasterNode::RealTime);
    master.stop();
}

void tst_AccessRights::masterWithoutSecurityAllowsEveryMessage()
{
    const QMetaEnum kinds = QMetaEnum::fromType<QPlcMessage::Kind>();
    for (int i = 0; i < kinds.keyCount(); ++i)
        QCOMPARE(qplc::refusalOf(Peer(), QPlcMessage(QPlcMessage::Kind(kinds.value(i)))), QString());
}

void tst_AccessRights::aNodeHasTheNameOfItsIdentity()
{
    LogCapture log;
    TestMaster master;
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(master.listen());
    EchoNode node(QStringLiteral("Counter"));
    node.setSecurity(m_files.echo());
    QVERIFY(!master.admit(node, datagrams()));
    QCOMPARE(node.error(), QPlcSlaveNode::RegistrationError);
    QVERIFY(!log.matching("identity 'Echo' may not be node 'Counter'").isEmpty());
    QVERIFY(master.nodes().isEmpty());
}

void tst_AccessRights::anObserverListensOnly()
{
    TestMaster master;
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(master.listen());
    ScriptedNode node;
    node.control.setSecurity(m_files.bert());
    node.onlyListen();
    QVERIFY(node.registerAt(master.serverPort()));
    qplc::messages::Register registration;
    registration.name = "x";
    registration.outputs = {{"sum", "Real64", {}, false, {}}};
    const auto refusal = [&] { return qplc::refusalOf(peerOf(Role::Observer), registration); };
    QVERIFY(refusal().contains("may only listen"));
    registration.listener = true;
    QVERIFY(refusal().contains("may not write signal 'sum'"));
}

void tst_AccessRights::nodeCannotUseNameOfAnotherIdentity_data()
{
    QTest::addColumn<QString>("identity");
    QTest::addColumn<QString>("digit");
    QTest::newRow("Observer") << "bert"
                              << "d";
    QTest::newRow("Operator") << "anna"
                              << "c";
    QTest::newRow("Engineer") << "carl"
                              << "e";
}

/// Not only of one in the file of keys: the access file knows identities, too.
void tst_AccessRights::nodeCannotUseNameOfAnotherIdentity()
{
    QFETCH(QString, identity);
    QFETCH(QString, digit);
    LogCapture log;
    QPlcSecurity security = QPlcSecurity::preSharedKeys(m_files.masterKeys());
    security.setAccessFile(m_files.write("names.ini", "[Winch]\nrole = Node\n"));
    TestMaster master;
    master.setSecurity(security);
    QVERIFY(master.listen());
    const auto answerTo = [&](const QString &name) {
        ScriptedNode node(name);
        node.control.setSecurity(m_files.of(identity, digit.at(0).toLatin1()));
        node.listener = true;
        node.outputs.clear();
        (void)node.registerAt(master.serverPort());
        return node.registered;
    };
    for (const char *name : {"Counter", "Winch"}) {
        QCOMPARE(answerTo(name).text("text"),
                 QString("Denied: identity '%1' may not be node '%2', which is another identity; choose another name")
                     .arg(identity, name));
    }
    QVERIFY(master.nodes().isEmpty());
    QCOMPARE(answerTo(identity).kind(), QPlcMessage::Registered);
    QCOMPARE(answerTo("Screen").kind(), QPlcMessage::Registered);
}

/// So that nobody who is known keeps all others out.
void tst_AccessRights::aConnectionForFramesMayOnlyAttach_data()
{
    QTest::addColumn<int>("kind");
    const QMetaEnum kinds = QMetaEnum::fromType<QPlcMessage::Kind>();
    for (int i = 0; i < kinds.keyCount(); ++i)
        QTest::newRow(kinds.key(i)) << kinds.value(i);
}

void tst_AccessRights::aConnectionForFramesMayOnlyAttach()
{
    QFETCH(int, kind);
    const QPlcMessage message{QPlcMessage::Kind(kind)};
    Peer peer;
    peer.isCyclicOnly = true;
    const QString refusal = qplc::refusalOf(peer, message);
    if (message.kind() == QPlcMessage::AttachCyclicChannel)
        QCOMPARE(refusal, QString());
    else
        QCOMPARE(refusal, QString("Denied: %1 on a connection without TLS").arg(message.kindName()));
}

void tst_AccessRights::identityIsLimitedToThirtyTwoConnections()
{
    LogCapture log;
    TestMaster master;
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(master.listen());
    std::vector<std::unique_ptr<SecuredTool>> tools;
    for (int i = 0; i < 32; ++i) {
        tools.push_back(std::make_unique<SecuredTool>(m_files.bert()));
        QVERIFY(tools.back()->greetAt(master.serverPort()));
    }
    SecuredTool further(m_files.bert());
    QVERIFY(!further.greetAt(master.serverPort()));
    QCOMPARE(further.messages.constLast().text("error"), QString("TooMuch"));
    QCOMPARE(further.messages.constLast().text("text"), QString("too many connections of this identity"));
    QTRY_VERIFY(!further.control.isConnected());
    QCOMPARE(master.statistics().refusedConnections, quint64(1));
    QCOMPARE(log.matching("identity 'bert': too many connections of this identity").size(), 1);
    SecuredTool other(m_files.anna());
    QVERIFY(other.greetAt(master.serverPort()));
    tools.pop_back();
    QVERIFY(waitUntil([&] { return SecuredTool(m_files.bert()).greetAt(master.serverPort()); }));
}

void tst_AccessRights::signalsAreWrittenOnlyWithAccessRights()
{
    LogCapture log;
    QPlcSecurity security = QPlcSecurity::preSharedKeys(m_files.masterKeys());
    security.setAccessFile(
        m_files.write("access.ini",
                      "[anna]\nrole = Operator\nwrites = set*, free\n"
                      "[carl]\nrole = Engineer\nwrites =\n[Counter]\nrole = Node\nwrites = count\n"));
    TestMaster master;
    master.setSecurity(security);
    QVERIFY2(master.listen(), qPrintable(master.errorString()));
    SecuredTool anna(m_files.anna());
    QVERIFY(anna.greetAt(master.serverPort()));
    const auto set = [](SecuredTool &tool, const QJsonObject &values) {
        return tool.ask(QPlcMessage::SetSignals, {{"values", values}});
    };
    QCOMPARE(set(anna, {{"setpoint", "1"}, {"free", "2"}}).kind(), QPlcMessage::Done);
    QCOMPARE(set(anna, {{"setpoint", "3"}, {"echo", "2"}}).text("text"),
             QString("Denied: identity 'anna' with role Operator may not write signal 'echo'"));
    QCOMPARE(master.signalValue("setpoint").toReal(), 1.0);
    QCOMPARE(anna.ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"setpoint", "vector"}}}).text("error"),
             QString("Denied"));
    QCOMPARE(anna.ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"setpoint"}}}).kind(), QPlcMessage::Done);
    SecuredTool carl(m_files.carl());
    QVERIFY(carl.greetAt(master.serverPort()));
    QCOMPARE(set(carl, {{"free", "1"}}).text("error"), QString("Denied"));
    CounterNode counter;  // writes sum, too
    counter.setSecurity(m_files.counter());
    QVERIFY(!master.admit(counter, datagrams()));
    QVERIFY(counter.errorString().contains("may not write signal 'sum'"));
    QVERIFY(!log.matching("identity 'Counter' with role Node may not write signal 'sum'").isEmpty());
}

void tst_AccessRights::commandsAreLogged()
{
    LogCapture log;
    TestMaster master;
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    CounterNode local;
    QVERIFY(master.addLocalNode(&local) && master.listen());
    SecuredTool anna(m_files.anna());
    QVERIFY(anna.greetAt(master.serverPort()));
    QCOMPARE(anna.ask(QPlcMessage::Stop).kind(), QPlcMessage::Done);
    QCOMPARE(log.matching("qtplc.audit: accepted identity 'anna' with role Operator from 127.0.0.1:").size(), 1);
    QCOMPARE(log.matching("qtplc.audit: identity 'anna' commands Stop from 127.0.0.1:").size(), 1);
    const QJsonArray events = anna.ask(QPlcMessage::GetEvents).fields().value("events").toArray();
    int ofSecurity = 0;
    for (const QJsonValue &event : events)
        ofSecurity += event["kind"].toString() == QLatin1String("security") ? 1 : 0;
    QCOMPARE(ofSecurity, 2);
}

void tst_AccessRights::commandsNameTheirSignals()
{
    LogCapture log;
    TestMaster master;
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(master.listen());
    SecuredTool anna(m_files.anna());
    QVERIFY(anna.greetAt(master.serverPort()));
    const QJsonObject values{{"setpoint", "1"}, {"free", "2"}};
    QCOMPARE(anna.ask(QPlcMessage::SetSignals, {{"values", values}}).kind(), QPlcMessage::Done);
    QCOMPARE(anna.ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"echo"}}}).kind(), QPlcMessage::Done);
    QCOMPARE(log.matching("identity 'anna' commands SetSignals of free, setpoint from 127.0.0.1:").size(), 1);
    QCOMPARE(log.matching("identity 'anna' commands TakeLease of echo from 127.0.0.1:").size(), 1);
    QJsonArray many;
    for (int i = 0; i < 1000; ++i)
        many << QString(100, 'x') + QString::number(i) + "\n";
    QCOMPARE(anna.ask(QPlcMessage::ReleaseLease, {{"signals", many}}).text("error"), QString("MalformedMessage"));
    const QStringList lines = log.matching("identity 'anna' commands ReleaseLease of xxx");
    QCOMPARE(lines.size(), 1);
    QVERIFY2(lines.at(0).contains(" and 992 more from") && lines.at(0).size() < 520, qPrintable(lines.at(0)));
}

/// Whatever they call themselves: in leases, reasons and events.
void tst_AccessRights::peopleAreShownByTheirProvenIdentity()
{
    TestMaster master(QPlcClock::realTime());
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    CounterNode local;
    QVERIFY(master.addLocalNode(&local) && master.listen() && master.startArmed());
    SecuredTool anna(m_files.anna());
    anna.name = "carl";
    QVERIFY(anna.greetAt(master.serverPort()));
    const auto hasEvent = [&](const QString &text) {
        const QJsonArray events = anna.answerTo(QPlcMessage::GetEvents).fields().value("events").toArray();
        return std::any_of(events.begin(), events.end(),
                           [&](const QJsonValue &event) { return event["text"].toString().contains(text); });
    };
    QCOMPARE(anna.ask(QPlcMessage::SetSignals, {{"values", QJsonObject{{"free", "1"}}}}).kind(), QPlcMessage::Done);
    QVERIFY(hasEvent("'anna as \"carl\"' has set free"));
    const QJsonObject wish{{"signals", QJsonArray{"count"}}, {"whoever", "Bert at desk 3"}};
    QCOMPARE(anna.ask(QPlcMessage::TakeLease, wish).kind(), QPlcMessage::Done);
    QCOMPARE(master.leases().at(0).holder, QString("anna as \"Bert at desk 3\""));
    QVERIFY(hasEvent("'anna as \"Bert at desk 3\"' has taken over count"));
    QCOMPARE(anna.ask(QPlcMessage::ReleaseLease).kind(), QPlcMessage::Done);
    QVERIFY(hasEvent("'anna as \"carl\"' has released count"));
    QCOMPARE(anna.ask(QPlcMessage::SafeStop).kind(), QPlcMessage::Done);
    QCOMPARE(master.stateReason(), QString("'anna as \"carl\"' asked for it"));
    QVERIFY(master.reset());
}

void tst_AccessRights::shownNamesCannotBeMistaken()
{
    QCOMPARE(qplc::shownName(Peer(), "carl"), QString("carl"));
    const Peer peer = peerOf(Role::Operator);
    QCOMPARE(qplc::shownName(peer, "carl"), QString("somebody as \"carl\""));
    QCOMPARE(qplc::shownName(peer, "somebody"), QString("somebody"));
    QCOMPARE(qplc::shownName(peer, ""), QString("somebody"));
}

void tst_AccessRights::rolesHaveNames()
{
    for (Role role : qplc::allRoles)
        QVERIFY(qplc::roleOf(qplc::roleName(role)) == role);
    QVERIFY(!qplc::roleOf("operator") && !qplc::roleOf(""));
}

void tst_AccessRights::keysFilesHaveClearErrors_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("error");
    const QByteArray key = SecurityFiles::key('7');
    QTest::newRow("good") << "[a]\nkey = " + key + "\nrole = Node\n"
                          << "";
    QTest::newRow("empty") << QByteArray() << "";
    QTest::newRow("short key") << "[a]\nkey = " + key.left(63) + "\nrole = Node\n"
                               << "k.ini:2:7: 'a' needs key = 64 hexadecimal digits";
    QTest::newRow("long key") << "[a]\nkey = " + key + "7\nrole = Node\n"
                              << "k.ini:2:7: 'a' needs key";
    QTest::newRow("other digits") << "[a]\nkey = " + key.left(63) + "g\nrole = Node\n"
                                  << "k.ini:2:7: 'a' needs key";
    QTest::newRow("no key") << QByteArray("[a]\nrole = Node\n") << "k.ini:1:1: 'a' needs key";
    QTest::newRow("no role") << "[a]\nkey = " + key + "\n"
                             << "k.ini:1:1: 'a' has the role ''";
    QTest::newRow("garbage") << QByteArray("\x16\x03\x01\xff") << "k.ini:1:";
    QTest::newRow("key twice") << "[a]\nkey = " + key + "\nkey = " + key + "\n"
                               << "k.ini:3:1: 'key' twice";
    QTest::newRow("key as a role") << "[a]\nkey = " + key + "\nrole = " + key + "\n"
                                   << "k.ini:3:8: 'a' has the role a text of 64 characters";
    QTest::newRow("key as a name") << "[a]\n" + key + " = key\n"
                                   << "k.ini:2:1: unknown entry a text of 64 characters";
    QTest::newRow("key in an identity") << "[a " + key + "]\n"
                                        << "k.ini:1:2: a text of 66 characters is not a valid identity";
    QTest::newRow("two lines as a role") << "[a]\nkey = " + key + "\nrole = \"x\\ny\"\n"
                                         << "k.ini:3:8: 'a' has the role 'x?y'";
    QTest::newRow("key behind a typing error") << "[a]\nkey " + key + "\n"
                                               << "k.ini:2:";
}

/// And never a key in them.
void tst_AccessRights::keysFilesHaveClearErrors()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, error);
    Keyring keys;
    QString told;
    QCOMPARE(keys.parse(text, "k.ini", &told), error.isEmpty());
    QVERIFY2(error.isEmpty() || told.startsWith(error), qPrintable(told));
    QVERIFY2(!told.contains("77777777"), qPrintable(told));
}

QTPLC_VIRTUAL_TIME_MAIN(tst_AccessRights)
#include "tst_AccessRights.moc"
