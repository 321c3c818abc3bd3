// SPDX-License-Identifier: Apache-2.0
#include "QPlcUnderlyingProtocol.h"

#include <QtTest/QtTest>

using P = QPlcUnderlyingProtocol;

class tst_QPlcUnderlyingProtocol : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void addressesAreRead_data();
    void addressesAreRead();
    void invalidAddressesAreRefusedWithAReason_data();
    void invalidAddressesAreRefusedWithAReason();
    void protocolReportsItsKind();
    void addressWithoutATransportIsAutomatic();
};

void tst_QPlcUnderlyingProtocol::addressesAreRead_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<bool>("udp");
    QTest::addColumn<QString>("canonical");
    QTest::newRow("host and port") << "127.0.0.1:1234" << false << "tcp://127.0.0.1:1234";
    QTest::newRow("default port") << "127.0.0.1" << true << "udp://127.0.0.1:50000";
    QTest::newRow("localhost") << "localhost:1" << false << "tcp://127.0.0.1:1";
    QTest::newRow("LOCALHOST") << " LocalHost:65535 " << false << "tcp://127.0.0.1:65535";
    QTest::newRow("scheme over kind") << "udp://10.0.0.3:7" << false << "udp://10.0.0.3:7";
    QTest::newRow("tcp scheme") << "tcp://10.0.0.3" << true << "tcp://10.0.0.3:50000";
    QTest::newRow("IPv6") << "[::1]:99" << false << "tcp://[::1]:99";
    QTest::newRow("IPv6 without port") << "[fe80::2]" << true << "udp://[fe80::2]:50000";
    QTest::newRow("bare IPv6") << "::1" << true << "udp://[::1]:50000";
    QTest::newRow("scheme and IPv6") << "udp://[::1]:4" << false << "udp://[::1]:4";
    QTest::newRow("multicast scheme") << "udp-multicast://10.0.0.3:7" << false << "udp-multicast://10.0.0.3:7";
    QTest::newRow("local port") << "local://4711" << true << "local://4711";
    QTest::newRow("local, host and port") << "local://127.0.0.1:4711" << false << "local://4711";
    QTest::newRow("local, localhost") << "local://localhost:4711" << false << "local://4711";
    QTest::newRow("any") << "0.0.0.0:5" << false << "tcp://0.0.0.0:5";
}

void tst_QPlcUnderlyingProtocol::addressesAreRead()
{
    QFETCH(QString, text);
    QFETCH(bool, udp);
    QFETCH(QString, canonical);
    QString error;
    const P protocol = P::fromString(text, udp ? P::Udp : P::Tcp, &error);
    QVERIFY2(protocol.isValid(), qPrintable(error));
    QCOMPARE(protocol.toString(), canonical);
    QCOMPARE(P::fromString(canonical), protocol);
    QVERIFY(error.isEmpty());
}

void tst_QPlcUnderlyingProtocol::invalidAddressesAreRefusedWithAReason_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("word");
    QTest::newRow("empty") << ""
                           << "HOST:PORT";
    QTest::newRow("spaces") << "   "
                            << "HOST:PORT";
    QTest::newRow("scheme only") << "udp://"
                                 << "udp://";
    QTest::newRow("port only") << ":50000"
                               << ":50000";
    QTest::newRow("no port behind the colon") << "127.0.0.1:"
                                              << "HOST:PORT";
    QTest::newRow("port 0") << "127.0.0.1:0"
                            << "65535";
    QTest::newRow("port 65536") << "127.0.0.1:65536"
                                << "'65536'";
    QTest::newRow("negative port") << "127.0.0.1:-1"
                                   << "'-1'";
    QTest::newRow("no number") << "127.0.0.1:http"
                               << "'http'";
    QTest::newRow("open bracket") << "[::1"
                                  << "[::1";
    QTest::newRow("empty brackets") << "[]:5"
                                    << "[]:5";
    QTest::newRow("IPv6 without port behind the colon") << "[::1]:"
                                                        << "[::1]:";
    QTest::newRow("garbage behind the bracket") << "[::1]5"
                                                << "[::1]5";
    QTest::newRow("local without a name") << "local://"
                                          << "''";
    QTest::newRow("local port 0") << "local://0"
                                  << "'0'";
    QTest::newRow("local on another machine") << "local://10.0.0.1:5"
                                              << "'10.0.0.1:5'";
    QTest::newRow("local master that does not run") << "local://no-such-master"
                                                    << "'no-such-master'";
    QTest::newRow("unknown host") << "no.such.host.invalid:5"
                                  << "'no.such.host.invalid'";
}

void tst_QPlcUnderlyingProtocol::invalidAddressesAreRefusedWithAReason()
{
    QFETCH(QString, text);
    QFETCH(QString, word);
    QString error;
    QVERIFY(!P::fromString(text, P::Tcp, &error).isValid());
    QVERIFY2(error.contains(word), qPrintable(error));
    QVERIFY(!P::fromString(text).isValid());  // without anybody who wants to know why
}

void tst_QPlcUnderlyingProtocol::protocolReportsItsKind()
{
    QCOMPARE(P::tcp(QHostAddress::LocalHost).kindName(), QString("tcp"));
    QCOMPARE(P::udp(QHostAddress::LocalHost).kindName(), QString("udp"));
    QCOMPARE(P().kindName(), QString("invalid"));
    QVERIFY(!P().isValid());
    QCOMPARE(P::tcp(QHostAddress::LocalHost).port(), P::DefaultPort);
    QVERIFY(P::tcp(QHostAddress::LocalHost, 5) == P::tcp(QHostAddress::LocalHost, 5));
    QVERIFY(P::tcp(QHostAddress::LocalHost, 5) != P::udp(QHostAddress::LocalHost, 5));
    QVERIFY(P::tcp(QHostAddress::LocalHost, 5) != P::tcp(QHostAddress::LocalHost, 6));
}

void tst_QPlcUnderlyingProtocol::addressWithoutATransportIsAutomatic()
{
    const P automatic = P::automatic(QHostAddress::LocalHost, 5);
    QCOMPARE(automatic.kindName(), QString("auto"));
    QCOMPARE(P::fromString("localhost:5"), automatic);
    QCOMPARE(P::fromString("auto://localhost:5", P::Tcp), automatic);
    QCOMPARE(automatic.toString(), QString("127.0.0.1:5"));
    QCOMPARE(P::fromString(automatic.toString()), automatic);
}

QTEST_GUILESS_MAIN(tst_QPlcUnderlyingProtocol)
#include "tst_QPlcUnderlyingProtocol.moc"
