// SPDX-License-Identifier: Apache-2.0
#include "SecurityFixtures.h"
#include "transport/LossWatch.h"

#include <QtTest/QtTest>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

// The other end is gone without a word, as when its board has no power. That it is noticed on a
// real wire is shown by tests/netns.
class tst_LostConnections : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void bothEndsOfAControlConnectionDetectItsLoss_data();
    void bothEndsOfAControlConnectionDetectItsLoss();
    void aCyclicStreamMayStayUnread();

private:
    static quint16 port(const sockaddr_in &address) { return ntohs(address.sin_port); }
    /// Descriptors of this program that are ends of TCP connections with the port of \a master.
    static std::vector<int> endsOfConnections(const QPlcMasterNode &master)
    {
        std::vector<int> ends;
        for (int descriptor = 3; descriptor < 1024; ++descriptor) {
            sockaddr_in own = {};
            sockaddr_in peer = {};
            socklen_t ownSize = sizeof own;
            socklen_t peerSize = sizeof peer;
            if (optionOf(descriptor, SOL_SOCKET, SO_TYPE) != SOCK_STREAM
                || ::getsockname(descriptor, reinterpret_cast<sockaddr *>(&own), &ownSize) < 0
                || ::getpeername(descriptor, reinterpret_cast<sockaddr *>(&peer), &peerSize) < 0)
                continue;
            if (own.sin_family == AF_INET && (port(own) == master.serverPort() || port(peer) == master.serverPort()))
                ends.push_back(descriptor);
        }
        return ends;
    }
    static int optionOf(int descriptor, int level, int option)
    {
        int value = -1;
        socklen_t size = sizeof value;
        return ::getsockopt(descriptor, level, option, &value, &size) == 0 ? value : -1;
    }
    static bool isWatched(int descriptor)
    {
        return optionOf(descriptor, SOL_SOCKET, SO_KEEPALIVE) == 1
            && optionOf(descriptor, IPPROTO_TCP, TCP_KEEPIDLE) == qplc::LossWatch::Idle
            && optionOf(descriptor, IPPROTO_TCP, TCP_KEEPINTVL) == qplc::LossWatch::Interval
            && optionOf(descriptor, IPPROTO_TCP, TCP_KEEPCNT) == qplc::LossWatch::Probes
            && optionOf(descriptor, IPPROTO_TCP, TCP_USER_TIMEOUT) == qplc::LossWatch::Unacknowledged;
    }
    SecurityFiles m_files;
};

void tst_LostConnections::bothEndsOfAControlConnectionDetectItsLoss_data()
{
    QTest::addColumn<bool>("isSecured");
    QTest::newRow("without security") << false;
    QTest::newRow("TLS") << true;
}

void tst_LostConnections::bothEndsOfAControlConnectionDetectItsLoss()
{
    QFETCH(bool, isSecured);
    TestMaster master;
    if (isSecured)
        master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(master.listen());
    SecuredTool tool(isSecured ? m_files.anna() : QPlcSecurity());
    QVERIFY(tool.greetAt(master.serverPort()));
    const std::vector<int> ends = endsOfConnections(master);
    QCOMPARE(ends.size(), std::size_t(2));
    QVERIFY(isWatched(ends[0]) && isWatched(ends[1]));
}

void tst_LostConnections::aCyclicStreamMayStayUnread()
{
    TestMaster master;
    QVERIFY(master.listen());
    EchoNode node;
    QVERIFY(master.admit(node, "tcp"));
    const std::vector<int> ends = endsOfConnections(master);
    QCOMPARE(ends.size(), std::size_t(4));
    const auto isPatient = [](int end) { return optionOf(end, IPPROTO_TCP, TCP_USER_TIMEOUT) == 0; };
    QCOMPARE(std::count_if(ends.begin(), ends.end(), isWatched), 2);
    QCOMPARE(std::count_if(ends.begin(), ends.end(), isPatient), 2);
}

QTEST_GUILESS_MAIN(tst_LostConnections)
#include "tst_LostConnections.moc"
