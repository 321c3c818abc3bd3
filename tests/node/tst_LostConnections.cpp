// SPDX-License-Identifier: Apache-2.0
#include "ScriptedMaster.h"
#include "SecurityFixtures.h"
#include "Winch.h"
#include "transport/LossWatch.h"

#include <QtTest/QtTest>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

using namespace std::chrono_literals;

// The other end is gone without a word, as when its board has no power. That it is noticed on a
// real wire is shown by tests/netns.
class tst_LostConnections : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void bothEndsOfAControlConnectionDetectItsLoss_data();
    void bothEndsOfAControlConnectionDetectItsLoss();
    void aCyclicStreamMayStayUnread();
    void nodeIsSafeAfterMasterLossAndReconnects_data();
    void nodeIsSafeAfterMasterLossAndReconnects();

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

void tst_LostConnections::nodeIsSafeAfterMasterLossAndReconnects_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("tcp") << "tcp";
    QTest::newRow("udp") << "udp";
}

void tst_LostConnections::nodeIsSafeAfterMasterLossAndReconnects()
{
    QFETCH(QString, kind);
    Winch winch;
    quint16 port = 0;
    {
        ScriptedMaster master(winchTable());
        const QPlcUnderlyingProtocol address = kind == "tcp" ? master.tcp() : master.udp();
        port = address.port();
        QVERIFY(master.admit(winch, address));
        QVERIFY(master.start());
        master.request(0);
        QVERIFY(master.waitForAnswers(1));
        master.control->abort();
        QTRY_COMPARE(winch.state(), QPlcSlaveNode::SafeStop);
        QCOMPARE(winch.story(), (QStringList{"step", "safe MasterLost", "stopped"}));
    }
    TestMaster successor(QPlcClock::realTime(), winchTable());
    QVERIFY(waitUntil([&] { return successor.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port)); },
                      10s));
    QTRY_COMPARE_WITH_TIMEOUT(winch.state(), QPlcSlaveNode::Registered, 15000);
    QCOMPARE(winch.error(), QPlcSlaveNode::NoError);
    QCOMPARE(successor.state(), QPlcMasterNode::Off);  // and nothing moves
    pass(50ms);
    QCOMPARE(winch.story().size(), 3);
    winch.disconnectFromMaster();
}

QTEST_GUILESS_MAIN(tst_LostConnections)
#include "tst_LostConnections.moc"
