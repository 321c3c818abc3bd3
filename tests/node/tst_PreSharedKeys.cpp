// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "SecurityFixtures.h"

#include <QtCore/QLoggingCategory>

#include <unistd.h>

// Nodes and tools at a master with pre-shared keys, over TLS on loopback.
class tst_PreSharedKeys : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void aNodeWithItsKeyTakesPart_data();
    void aNodeWithItsKeyTakesPart();
    void nodesAndToolWorkTogetherWithKeys();
    void aWrongKeyIsRefusedOnBothEnds();
    void anUnknownIdentityIsRefusedOnBothEnds();
    void clientWithoutSecurityGetsTheReason();
    void securedClientReportsAnUnsecuredMaster();
    void clientWithCertificateGetsTheReason();
    void revokedKeyIsRefused();
    void aKeyIsReplacedWithoutARestart();
    void aKeysFileThatOthersMayReadIsRefused();
    void aKeysFileOfAnotherUserIsRefused();
    void unreadableKeysFileRefusesAllClients();
    void aNodeIsReplacedByItsOwnIdentityOnly();
    void ambiguousIdentityIsReported();
    void keyOfANodeIsRefusedForAMaster();
    void noKeyIsEverLogged();
    void multicastIsRefused();
    void oldVersionsAndWeakSuitesAreRefused_data();
    void oldVersionsAndWeakSuitesAreRefused();

private:
    bool listen()
    {
        m_master.reset(new TestMaster);
        m_master->setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
        return m_master->listen();
    }
    SecurityFiles m_files;
    QScopedPointer<TestMaster> m_master;
};

void tst_PreSharedKeys::init()
{
    QVERIFY(listen());
}

void tst_PreSharedKeys::aNodeWithItsKeyTakesPart_data()
{
    QTest::addColumn<QString>("kind");
    for (const char *kind : {"tcp", "udp", "shared memory"})
        QTest::newRow(kind) << kind;
}

void tst_PreSharedKeys::aNodeWithItsKeyTakesPart()
{
    QFETCH(QString, kind);
    CounterNode node;
    node.setSecurity(m_files.counter());
    const QPlcUnderlyingProtocol protocol = kind == QLatin1String("shared memory")
        ? QPlcUnderlyingProtocol::local(QString::number(m_master->serverPort()))
        : m_master->protocol(kind);
    QVERIFY2(node.connectToMasterAndWaitForConnected(protocol), qPrintable(node.errorString()));
    QVERIFY(node.isSecured());
    m_master->setCycleLimit(5);
    QVERIFY(m_master->startArmed());
    QVERIFY(m_master->waitForCycles(5));
    QVERIFY(m_master->waitForState(QPlcMasterNode::Off));
    QCOMPARE(m_master->signalValue("count").toInt(), 5);
}

void tst_PreSharedKeys::nodesAndToolWorkTogetherWithKeys()
{
    CounterNode counter;
    EchoNode echo;
    counter.setSecurity(m_files.counter());
    echo.setSecurity(m_files.echo());
    QVERIFY(m_master->admit(counter, "udp") && m_master->admit(echo, "tcp"));
    SecuredTool anna(m_files.anna());
    QVERIFY(anna.greetAt(m_master->serverPort()));
    QCOMPARE(anna.answerTo(QPlcMessage::InitializeAllStates).kind(), QPlcMessage::Done);
    const QString token = anna.ask(QPlcMessage::Arm).text("token");
    QCOMPARE(anna.ask(QPlcMessage::StartRealTime, {{"cycles", 10}, {"token", token}}).kind(), QPlcMessage::Done);
    QVERIFY(m_master->waitForState(QPlcMasterNode::Off));
    QCOMPARE(m_master->statistics().cycles, quint64(10));
}

void tst_PreSharedKeys::aWrongKeyIsRefusedOnBothEnds()
{
    LogCapture log;
    CounterNode node;
    node.setSecurity(m_files.of("Counter", 'f'));
    QVERIFY(!m_master->admit(node, "udp"));
    QVERIFY2(node.errorString().contains("the key of identity 'Counter' is not the one"),
             qPrintable(node.errorString()));
    QTRY_VERIFY(!log.matching("wrong key of identity 'Counter'").isEmpty());
    QVERIFY(m_master->nodes().isEmpty());
    QVERIFY(log.matching("ffff").isEmpty() && log.matching("aaaa").isEmpty());
}

void tst_PreSharedKeys::anUnknownIdentityIsRefusedOnBothEnds()
{
    LogCapture log;
    CounterNode node;
    node.setSecurity(m_files.of("Mallory", 'a'));
    QVERIFY(!m_master->admit(node, "udp"));
    QVERIFY2(node.errorString().contains("does not know identity 'Mallory'"), qPrintable(node.errorString()));
    QTRY_VERIFY(!log.matching("unknown identity 'Mallory'").isEmpty());
}

void tst_PreSharedKeys::clientWithoutSecurityGetsTheReason()
{
    LogCapture log;
    CounterNode node;
    QVERIFY(!m_master->admit(node, "udp"));
    QVERIFY2(node.errorString().contains("this master is secured; connect with --security psk"),
             qPrintable(node.errorString()));
    QTRY_VERIFY(!log.matching("it does not speak TLS, but this master is secured").isEmpty());
}

void tst_PreSharedKeys::securedClientReportsAnUnsecuredMaster()
{
    LogCapture log;
    TestMaster open;
    QVERIFY(open.listen());
    CounterNode node;
    node.setSecurity(m_files.counter());
    QVERIFY(!open.admit(node, "udp"));
    QVERIFY2(node.errorString().contains("the master is not secured; start it with --security psk"),
             qPrintable(node.errorString()));
    QTRY_VERIFY(!log.matching("it speaks TLS, but this master is not secured").isEmpty());
}

void tst_PreSharedKeys::clientWithCertificateGetsTheReason()
{
    LogCapture log;
    QVERIFY(m_files.makeAuthority("authority") && m_files.makeCertificate("Counter", "authority"));
    CounterNode node;
    node.setSecurity(m_files.certificate("Counter"));
    QVERIFY(!m_master->admit(node, "udp"));
    QVERIFY2(node.errorString().contains("does not offer security of the kind 'cert'"), qPrintable(node.errorString()));
    QTRY_VERIFY(!log.matching("TLS handshake failed").isEmpty());
}

void tst_PreSharedKeys::revokedKeyIsRefused()
{
    EchoNode echo;
    echo.setSecurity(m_files.echo());
    QVERIFY(m_master->admit(echo, "udp"));
    m_files.write("keys.ini", SecurityFiles::section("Echo", SecurityFiles::key('b'), "Node"));
    CounterNode node;
    node.setSecurity(m_files.counter());
    LogCapture log;
    QVERIFY(!m_master->admit(node, "udp"));
    QVERIFY(node.errorString().contains("does not know identity 'Counter'"));
    QCOMPARE(echo.state(), QPlcSlaveNode::Off);  // who is in stays
    QTRY_VERIFY(!log.matching("unknown identity 'Counter'").isEmpty());
}

void tst_PreSharedKeys::aKeyIsReplacedWithoutARestart()
{
    EchoNode echo;
    echo.setSecurity(m_files.echo());
    QVERIFY(m_master->admit(echo, "udp"));
    m_files.write("keys.ini",
                  SecurityFiles::section("Echo", SecurityFiles::key('b'), "Node")
                      + SecurityFiles::section("Counter", SecurityFiles::key('9'), "Node"));
    CounterNode node;
    node.setSecurity(m_files.of("Counter", '9'));
    QVERIFY2(m_master->admit(node, "udp"), qPrintable(node.errorString()));
    QCOMPARE(echo.state(), QPlcSlaveNode::Off);
    m_master->setCycleLimit(3);
    QVERIFY(m_master->startArmed());
    QVERIFY(m_master->waitForCycles(3) && m_master->waitForState(QPlcMasterNode::Off));
}

void tst_PreSharedKeys::aKeysFileThatOthersMayReadIsRefused()
{
    LogCapture log;
    const QString keys = m_files.masterKeys();
    QVERIFY(QFile::setPermissions(keys, QFile::ReadOwner | QFile::WriteOwner | QFile::ReadGroup | QFile::ReadOther));
    TestMaster master;
    master.setSecurity(QPlcSecurity::preSharedKeys(keys));
    QVERIFY(!master.listen());
    QVERIFY2(master.errorString().contains(keys + " has the mode 0644"), qPrintable(master.errorString()));
    QVERIFY2(master.errorString().contains("chmod 600 " + keys), qPrintable(master.errorString()));

    const QPlcSecurity counter = m_files.counter();
    QVERIFY(QFile::setPermissions(counter.keysFile(), QFile::ReadOwner | QFile::WriteOwner | QFile::ReadGroup));
    CounterNode node;
    node.setSecurity(counter);
    QVERIFY(!node.connectToMasterAndWaitForConnected(
        QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, m_master->serverPort())));
    QVERIFY2(node.errorString().contains("has the mode 0640"), qPrintable(node.errorString()));
}

void tst_PreSharedKeys::aKeysFileOfAnotherUserIsRefused()
{
    if (::geteuid() != 0)
        QSKIP("only root can give a file to another user and still read it");
    LogCapture log;
    constexpr uid_t nobody = 65534;
    const QString keys = m_files.masterKeys();
    QCOMPARE(::chown(QFile::encodeName(keys).constData(), nobody, gid_t(-1)), 0);
    TestMaster master;
    master.setSecurity(QPlcSecurity::preSharedKeys(keys));
    QVERIFY(!master.listen());
    QVERIFY2(master.errorString().contains(keys + " belongs to another user"), qPrintable(master.errorString()));
    QCOMPARE(::chown(QFile::encodeName(keys).constData(), 0, gid_t(-1)), 0);
    QVERIFY2(master.listen(), qPrintable(master.errorString()));
}

void tst_PreSharedKeys::unreadableKeysFileRefusesAllClients()
{
    LogCapture log;
    m_files.write("keys.ini", "[Counter]\nkey = 12\n");
    CounterNode node;
    node.setSecurity(m_files.counter());
    QVERIFY(!m_master->admit(node, "udp"));
    QVERIFY2(node.errorString().contains("the master cannot read its keys"), qPrintable(node.errorString()));
    QTRY_VERIFY(!log.matching("'Counter' needs key = 64 hexadecimal digits").isEmpty());
}

void tst_PreSharedKeys::aNodeIsReplacedByItsOwnIdentityOnly()
{
    LogCapture log;
    TestMaster master;
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(master.listen());
    const auto display = [](ScriptedNode &node, const QPlcSecurity &security, const QString &uuid) {
        node.control.setSecurity(security);
        node.uuid = uuid;
        node.listener = true;
        node.outputs.clear();
    };
    ScriptedNode ofAnna("Display");
    display(ofAnna, m_files.anna(), ofAnna.uuid);
    QVERIFY(ofAnna.registerAt(master.serverPort()));
    ScriptedNode ofBert("Display");
    display(ofBert, m_files.bert(), ofAnna.uuid);  // as others see it, it is the same node
    QVERIFY(!ofBert.registerAt(master.serverPort()));
    QCOMPARE(ofBert.registered.text("error"), QString("NameInUse"));
    QVERIFY(ofAnna.control.isConnected());
    ScriptedNode again("Display");
    display(again, m_files.anna(), ofAnna.uuid);
    QVERIFY(again.registerAt(master.serverPort()));
    QTRY_VERIFY(!ofAnna.control.isConnected());
    QCOMPARE(master.nodes().size(), 1);
}

void tst_PreSharedKeys::ambiguousIdentityIsReported()
{
    LogCapture log;
    CounterNode node;
    node.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(!m_master->admit(node, "udp"));
    QVERIFY2(node.errorString().contains("has the keys of 5 identities; say which one"),
             qPrintable(node.errorString()));
}

/// A node knows its own key alone: it cannot play the master for another one.
void tst_PreSharedKeys::keyOfANodeIsRefusedForAMaster()
{
    LogCapture log;
    TestMaster impostor;
    impostor.setSecurity(QPlcSecurity::preSharedKeys(
        m_files.write("false.ini", SecurityFiles::section("Counter", SecurityFiles::key('b'), "Node"))));
    QVERIFY(impostor.listen());
    CounterNode node;
    node.setSecurity(m_files.counter());
    QVERIFY(!impostor.admit(node, "udp"));
    QVERIFY(!node.isSecured());
}

/// Not even at the debug level that shows every message: neither those of the file, nor those for
/// frames.
void tst_PreSharedKeys::noKeyIsEverLogged()
{
    QLoggingCategory::setFilterRules("qtplc.*.debug=true");
    LogCapture log;
    CounterNode node;
    node.setSecurity(m_files.counter());
    const bool isAdmitted = m_master->admit(node, "udp");
    QLoggingCategory::setFilterRules(QString());
    QVERIFY(isAdmitted);
    QVERIFY(!log.matching("Registered").isEmpty());
    QVERIFY(log.matching(QString(QByteArray("seal").toHex(' '))).isEmpty());
    QVERIFY(log.matching(QString(32, 'a')).isEmpty());
}

void tst_PreSharedKeys::multicastIsRefused()
{
    LogCapture log;
    TestMaster master;
    master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    master.setMulticastGroup(QHostAddress("239.255.76.68"));
    QVERIFY(!master.listen());
    QVERIFY2(master.errorString().contains("a secured master has no multicast group"),
             qPrintable(master.errorString()));
    QVERIFY(master.errorString().contains("connect nodes by udp://"));
    CounterNode node;
    node.setSecurity(m_files.counter());
    QVERIFY(!node.connectToMasterAndWaitForConnected(
        QPlcUnderlyingProtocol::udpMulticast(QHostAddress::LocalHost, m_master->serverPort())));
    QVERIFY2(node.errorString().contains("a secured master sends no datagrams for many nodes; use udp"),
             qPrintable(node.errorString()));
}

void tst_PreSharedKeys::oldVersionsAndWeakSuitesAreRefused_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<bool>("succeeds");
    QTest::newRow("as it should be") << QStringList{"-tls1_2", "-cipher", "ECDHE-PSK-CHACHA20-POLY1305"} << true;
    QTest::newRow("TLS 1.0") << QStringList{"-tls1", "-cipher", "ALL:PSK:@SECLEVEL=0"} << false;
    QTest::newRow("TLS 1.1") << QStringList{"-tls1_1", "-cipher", "ALL:PSK:@SECLEVEL=0"} << false;
    QTest::newRow("CBC") << QStringList{"-tls1_2", "-cipher", "ECDHE-PSK-AES128-CBC-SHA256:@SECLEVEL=0"} << false;
    QTest::newRow("no forward secrecy") << QStringList{"-tls1_2", "-cipher",
                                                       "PSK-AES128-GCM-SHA256:PSK-CHACHA20-POLY1305"}
                                        << false;
    QTest::newRow("no encryption") << QStringList{"-tls1_2", "-cipher", "ECDHE-PSK-NULL-SHA256:@SECLEVEL=0"} << false;
    QTest::newRow("TLS 1.3") << QStringList{"-tls1_3"} << false;
}

void tst_PreSharedKeys::oldVersionsAndWeakSuitesAreRefused()
{
    QFETCH(QStringList, arguments);
    QFETCH(bool, succeeds);
    LogCapture log;
    QProcess client;
    client.setProcessChannelMode(QProcess::MergedChannels);
    client.start("openssl",
                 QStringList{"s_client", "-connect", QString("127.0.0.1:%1").arg(m_master->serverPort()),
                             "-psk_identity", "Counter", "-psk", SecurityFiles::key('a')}
                     + arguments);
    QVERIFY(client.waitForStarted());
    client.closeWriteChannel();
    QTRY_VERIFY(client.state() == QProcess::NotRunning);
    const QByteArray output = client.readAll();
    QVERIFY2(!output.contains("no cipher match"), output.constData());
    QCOMPARE(!log.matching("accepted identity 'Counter'").isEmpty(), succeeds);
    QVERIFY2(succeeds || !log.matching("TLS handshake failed").isEmpty(), qPrintable(log.all().join('\n') + output));
}

QTEST_GUILESS_MAIN(tst_PreSharedKeys)
#include "tst_PreSharedKeys.moc"
