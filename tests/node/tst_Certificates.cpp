// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "SecurityFixtures.h"

// Nodes and tools at a master with certificates, over TLS on loopback. All of them are made by
// openssl here.
class tst_Certificates : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void init();
    void aNodeWithACertificateTakesPart();
    void identityMissingInTheAccessFileIsRefused();
    void aWrongCertificateIsRefusedOnBothEnds_data();
    void aWrongCertificateIsRefusedOnBothEnds();
    void nodeCertificateIsRefusedForAMaster();
    void aMasterOfAnotherAuthorityIsRefused();
    void aClientWithoutACertificateIsRefused();
    void oldVersionsAndWeakSuitesAreRefused_data();
    void oldVersionsAndWeakSuitesAreRefused();
    void filesThatCannotBeUsedAreNamed_data();
    void filesThatCannotBeUsedAreNamed();

private:
    QPlcSecurity masterSecurity(const QString &name = QStringLiteral("master")) const
    {
        QPlcSecurity security = m_files.certificate(name);
        security.setAccessFile(m_files.path("access.ini"));
        return security;
    }
    SecurityFiles m_files;
    QScopedPointer<TestMaster> m_master;
};

void tst_Certificates::initTestCase()
{
    QVERIFY(m_files.makeAuthority("authority") && m_files.makeAuthority("stranger"));
    QVERIFY(m_files.makeCertificate("master", "authority"));
    QVERIFY(m_files.makeCertificate("Counter", "authority"));
    QVERIFY(m_files.makeCertificate("Mallory", "authority"));
    QVERIFY(m_files.makeCertificate("Counter", "stranger", "foreign"));
    QVERIFY(m_files.makeCertificate("master", "stranger", "foreign-master"));
    QVERIFY(m_files.makeCertificate("Counter", "authority", "expired", -1));
    m_files.write("access.ini", "[Counter]\nrole = Node\nwrites = count, s*\n[Echo]\nrole = Node\n");
}

void tst_Certificates::init()
{
    m_master.reset(new TestMaster);
    m_master->setSecurity(masterSecurity());
    QVERIFY2(m_master->listen(), qPrintable(m_master->errorString()));
}

void tst_Certificates::aNodeWithACertificateTakesPart()
{
    CounterNode node;
    node.setSecurity(m_files.certificate("Counter"));
    QVERIFY2(m_master->admit(node, "udp"), qPrintable(node.errorString()));
    QVERIFY(node.isSecured());
    m_master->setCycleLimit(5);
    QVERIFY(m_master->startArmed());
    QVERIFY(m_master->waitForCycles(5) && m_master->waitForState(QPlcMasterNode::Off));
    QCOMPARE(m_master->signalValue("count").toInt(), 5);
}

void tst_Certificates::identityMissingInTheAccessFileIsRefused()
{
    LogCapture log;
    CounterNode node(QStringLiteral("Mallory"));
    node.setSecurity(m_files.certificate("Mallory"));
    QVERIFY(!m_master->admit(node, "udp"));
    QVERIFY2(node.errorString().contains("identity 'Mallory' has no role"), qPrintable(node.errorString()));
    QTRY_VERIFY(!log.matching("identity 'Mallory' has no role").isEmpty());
}

void tst_Certificates::aWrongCertificateIsRefusedOnBothEnds_data()
{
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("word");
    QTest::newRow("of another authority") << "foreign"
                                          << "certificate is refused";
    QTest::newRow("expired") << "expired"
                             << "expired";
}

void tst_Certificates::aWrongCertificateIsRefusedOnBothEnds()
{
    QFETCH(QString, file);
    QFETCH(QString, word);
    LogCapture log;
    CounterNode node;
    node.setSecurity(m_files.certificate(file));
    QVERIFY(!m_master->admit(node, "udp"));
    QVERIFY2(node.errorString().contains(word), qPrintable(node.errorString()));
    QTRY_VERIFY2(!log.matching("its certificate is refused").isEmpty(), qPrintable(log.all().join('\n')));
    QVERIFY(m_master->nodes().isEmpty());
    QVERIFY(log.matching("accepted identity").isEmpty());
}

/// A certificate of the same authority, but not of the master.
void tst_Certificates::nodeCertificateIsRefusedForAMaster()
{
    LogCapture log;
    TestMaster impostor;
    impostor.setSecurity(masterSecurity("Mallory"));
    QVERIFY(impostor.listen());
    CounterNode node;
    node.setSecurity(m_files.certificate("Counter"));
    QVERIFY(!impostor.admit(node, "udp"));
    QVERIFY2(node.errorString().contains("the certificate of the master is refused"), qPrintable(node.errorString()));
}

void tst_Certificates::aMasterOfAnotherAuthorityIsRefused()
{
    LogCapture log;
    TestMaster impostor;
    impostor.setSecurity(masterSecurity("foreign-master"));
    QVERIFY(impostor.listen());
    CounterNode node;
    node.setSecurity(m_files.certificate("Counter"));
    QVERIFY(!impostor.admit(node, "udp"));
    QVERIFY2(node.errorString().contains("the certificate of the master is refused"), qPrintable(node.errorString()));
}

void tst_Certificates::aClientWithoutACertificateIsRefused()
{
    LogCapture log;
    QSslSocket client;
    client.setPeerVerifyMode(QSslSocket::VerifyNone);
    client.connectToHostEncrypted("127.0.0.1", m_master->serverPort());
    QTRY_VERIFY(!log.matching("its certificate is refused").isEmpty());
    QTRY_COMPARE(client.state(), QAbstractSocket::UnconnectedState);
    QCOMPARE(m_master->statistics().failedHandshakes, quint64(1));
}

void tst_Certificates::oldVersionsAndWeakSuitesAreRefused_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<bool>("succeeds");
    QTest::newRow("TLS 1.3") << QStringList{"-tls1_3"} << true;
    QTest::newRow("TLS 1.2") << QStringList{"-tls1_2"} << true;
    QTest::newRow("TLS 1.0") << QStringList{"-tls1", "-cipher", "ALL:@SECLEVEL=0"} << false;
    QTest::newRow("TLS 1.1") << QStringList{"-tls1_1", "-cipher", "ALL:@SECLEVEL=0"} << false;
    QTest::newRow("CBC") << QStringList{"-tls1_2", "-cipher", "ECDHE-ECDSA-AES128-SHA256:ECDHE-ECDSA-AES256-SHA"}
                         << false;
    QTest::newRow("no forward secrecy") << QStringList{"-tls1_2", "-cipher", "AES128-GCM-SHA256:AES256-GCM-SHA384"}
                                        << false;
    QTest::newRow("anonymous") << QStringList{"-tls1_2", "-cipher", "aNULL:@SECLEVEL=0"} << false;
}

void tst_Certificates::oldVersionsAndWeakSuitesAreRefused()
{
    QFETCH(QStringList, arguments);
    QFETCH(bool, succeeds);
    LogCapture log;
    QProcess client;
    client.setProcessChannelMode(QProcess::MergedChannels);
    client.start("openssl",
                 QStringList{"s_client", "-connect", QString("127.0.0.1:%1").arg(m_master->serverPort()), "-cert",
                             m_files.path("Counter.pem"), "-key", m_files.path("Counter.key"), "-CAfile",
                             m_files.path("authority.pem")}
                     + arguments);
    QVERIFY(client.waitForStarted());
    client.closeWriteChannel();
    QTRY_VERIFY(client.state() == QProcess::NotRunning);
    const QByteArray output = client.readAll();
    QVERIFY2(!output.contains("no cipher match"), output.constData());
    QCOMPARE(!log.matching("accepted identity 'Counter'").isEmpty(), succeeds);
    QVERIFY2(succeeds || !log.matching("TLS handshake failed").isEmpty(), qPrintable(log.all().join('\n') + output));
}

void tst_Certificates::filesThatCannotBeUsedAreNamed_data()
{
    QTest::addColumn<QString>("wrong");
    QTest::addColumn<QByteArray>("content");
    QTest::addColumn<int>("mode");
    QTest::addColumn<QString>("word");
    QTest::newRow("key for others") << "key" << QByteArray() << 0x6644 << "chmod 600";
    QTest::newRow("key that is none") << "key" << QByteArray("no key") << 0x6600 << "has no private key";
    QTest::newRow("certificate that is none") << "certificate" << QByteArray("none") << 0x6600 << "has no certificate";
    QTest::newRow("authority that is none") << "authority" << QByteArray("none") << 0x6600 << "has no certificate";
    QFile authority(m_files.path("authority.pem"));
    QVERIFY(authority.open(QIODevice::ReadOnly));
    const QByteArray pem = authority.readAll();
    QTest::newRow("authority that its group may change") << "authority" << pem << 0x6664 << "chmod go-w";
    QTest::newRow("certificate that others may change") << "certificate" << pem << 0x6646 << "chmod go-w";
    QTest::newRow("authority that all may read") << "authority" << pem << 0x6644 << "";
    QTest::newRow("rights that others may change")
        << "access" << QByteArray("[a]\nrole = Node\n") << 0x6666 << "chmod go-w";
    QTest::newRow("no such role") << "access" << QByteArray("[a]\nrole = King\n") << 0x6600
                                  << "file:2:8: 'a' has the role 'King'";
    QTest::newRow("no role") << "access" << QByteArray("[a]\nwrites = b\n") << 0x6600
                             << "file:1:1: 'a' has the role ''";
    QTest::newRow("an observer who writes")
        << "access" << QByteArray("[a]\nrole = Observer\nwrites = b\n") << 0x6600 << "file:3:10: 'a' is an Observer";
    QTest::newRow("twice") << "access" << QByteArray("[a]\nrole = Node\n[a]\nrole = Node\n") << 0x6600
                           << "'a' has a section in line 1";
    QTest::newRow("unknown entry") << "access" << QByteArray("[a]\nrole = Node\nkey = b\n") << 0x6600
                                   << "unknown entry 'key'; use role, writes";
    QTest::newRow("no identity") << "access" << QByteArray("[a b]\nrole = Node\n") << 0x6600
                                 << "'a b' is not a valid identity";
    QTest::newRow("before all") << "access" << QByteArray("role = Node\n") << 0x6600 << "before the first [identity]";
    QTest::newRow("no access file") << "none" << QByteArray() << 0 << "needs a file with the roles";
}

void tst_Certificates::filesThatCannotBeUsedAreNamed()
{
    QFETCH(QString, wrong);
    QFETCH(QByteArray, content);
    QFETCH(int, mode);
    QFETCH(QString, word);
    const auto fileOf
        = [&](const QString &what, const QString &right) { return wrong == what ? m_files.path("file") : right; };
    m_files.write("file", content, QFileDevice::Permissions(mode));
    QPlcSecurity security = QPlcSecurity::certificates(fileOf("certificate", m_files.path("master.pem")),
                                                       fileOf("key", m_files.path("master.key")),
                                                       fileOf("authority", m_files.path("authority.pem")));
    if (wrong != "none")
        security.setAccessFile(fileOf("access", m_files.path("access.ini")));
    const QString error = security.errorString(QPlcSecurity::MasterSide);
    QVERIFY2(error.contains(word) && error.isEmpty() == word.isEmpty(), qPrintable(error));
    QVERIFY2(wrong == "none" || word.isEmpty() || error.contains(m_files.path("file")), qPrintable(error));
}

QTEST_GUILESS_MAIN(tst_Certificates)
#include "tst_Certificates.moc"
