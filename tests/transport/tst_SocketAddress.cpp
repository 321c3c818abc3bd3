// SPDX-License-Identifier: Apache-2.0
#include "TransportFixtures.h"

#include <QtCore/QSet>
#include <QtTest/QtTest>

#include <net/if.h>
#include <random>

using qplc::SocketAddress;

class tst_SocketAddress : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void addressHasTheLayoutOfTheKernel();
    void mappedIpv4CountsAsIpv4();
    void differentPeersHaveDifferentKeys();
    void ipv6PeersWithOneKeyAreDifferent();
    void sameAddressOnAnotherInterfaceIsAnotherPeer();
    void systemErrorIsDescribed();
};

void tst_SocketAddress::addressHasTheLayoutOfTheKernel()
{
    const SocketAddress ipv4(QHostAddress("192.168.1.2"), 50000);
    const auto *in = reinterpret_cast<const sockaddr_in *>(ipv4.data());
    QCOMPARE(ipv4.family(), AF_INET);
    QCOMPARE(in->sin_port, htons(50000));
    QCOMPARE(in->sin_addr.s_addr, htonl(0xC0A80102));
    QCOMPARE(ipv4.length, socklen_t(sizeof(sockaddr_in)));
    QCOMPARE(ipv4.port(), quint16(50000));
    QCOMPARE(ipv4.toString(), QString("192.168.1.2:50000"));

    const SocketAddress ipv6(QHostAddress("::1"), 7);
    QCOMPARE(ipv6.family(), AF_INET6);
    QCOMPARE(ipv6.port(), quint16(7));
    QVERIFY(IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6 *>(ipv6.data())->sin6_addr));
    QCOMPARE(SocketAddress(QHostAddress(QHostAddress::Any), 1).family(), AF_INET6);
    QCOMPARE(SocketAddress(QHostAddress(QHostAddress::AnyIPv4), 1).family(), AF_INET);
}

void tst_SocketAddress::mappedIpv4CountsAsIpv4()
{
    SocketAddress mapped(QHostAddress("::1"), 1234);
    auto *in6 = reinterpret_cast<sockaddr_in6 *>(mapped.data());
    const unsigned char bytes[16] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff, 10, 0, 0, 5};
    std::memcpy(&in6->sin6_addr, bytes, 16);
    QCOMPARE(mapped.key(), SocketAddress(QHostAddress("10.0.0.5"), 1234).key());
    QCOMPARE(SocketAddress(QHostAddress("::ffff:10.0.0.5"), 1234).family(),
             AF_INET);  // what a dual-stack server calls its peers
    QCOMPARE(SocketAddress(QHostAddress("::ffff:10.0.0.5"), 1234).key(), mapped.key());
    const SocketAddress forIpv6Socket = SocketAddress(QHostAddress("10.0.0.5"), 1234).mappedToIpv6();
    QCOMPARE(forIpv6Socket.family(), AF_INET6);
    QCOMPARE(forIpv6Socket.port(), quint16(1234));
    QCOMPARE(std::memcmp(&reinterpret_cast<const sockaddr_in6 *>(forIpv6Socket.data())->sin6_addr, bytes, 16), 0);
}

void tst_SocketAddress::differentPeersHaveDifferentKeys()
{
    QSet<quint64> keys;
    int count = 0;
    for (int host = 1; host < 255; ++host) {
        for (quint16 port : {quint16(1), quint16(1000), quint16(50000), quint16(65535)}) {
            keys << SocketAddress(QHostAddress(quint32(0x0A000000 + host)), port).key();
            keys << SocketAddress(QHostAddress(QString("fe80::%1").arg(host, 0, 16)), port).key();
            count += 2;
        }
    }
    QCOMPARE(keys.size(), count);
}

void tst_SocketAddress::ipv6PeersWithOneKeyAreDifferent()
{
    QHash<quint64, SocketAddress> byKey;
    std::mt19937_64 random(1);
    for (int i = 0; i < 1'000'000; ++i) {
        SocketAddress address(QHostAddress("2001:db8::"), 50000);
        const std::uint64_t host = random();
        std::memcpy(&reinterpret_cast<sockaddr_in6 *>(address.data())->sin6_addr.s6_addr[8], &host, sizeof host);
        QVERIFY(address == address);
        const auto known = byKey.constFind(address.key());
        if (known != byKey.constEnd()) {
            QVERIFY(!(*known == address));
            return;
        }
        byKey.insert(address.key(), address);
    }
    QFAIL("no two of these addresses have one key: look for others");
}

void tst_SocketAddress::sameAddressOnAnotherInterfaceIsAnotherPeer()
{
    const SocketAddress none(QHostAddress("fe80::1"), 50000);
    const SocketAddress loopback(QHostAddress("fe80::1%lo"), 50000);
    QCOMPARE(reinterpret_cast<const sockaddr_in6 *>(loopback.data())->sin6_scope_id, ::if_nametoindex("lo"));
    QCOMPARE(reinterpret_cast<const sockaddr_in6 *>(SocketAddress(QHostAddress("fe80::1%7"), 1).data())->sin6_scope_id,
             quint32(7));
    QVERIFY(!(none == loopback));
    QVERIFY(loopback == SocketAddress(QHostAddress("fe80::1%lo"), 50000));
}

void tst_SocketAddress::systemErrorIsDescribed()
{
    errno = EADDRINUSE;
    QCOMPARE(qplc::systemErrorText(), QString("Address already in use"));
}

QTEST_APPLESS_MAIN(tst_SocketAddress)
#include "tst_SocketAddress.moc"
