// SPDX-License-Identifier: Apache-2.0
#include "TransportFixtures.h"
#include "realtime/InterruptibleWaits.h"
#include "transport/StreamLink.h"
#include "transport/UdpLink.h"

#include <QtTest/QtTest>

using qplc::CyclicLink;
using qplc::InterruptibleWaits;
using qplc::SocketAddress;
using qplc::StreamLink;
using qplc::UdpLink;

class tst_CyclicLink : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aUdpLinkTalksToItsMasterOnly();
    void udpLinkStaysOpenAfterLossOfTheMaster();
    void aTcpLinkGivesWholeFrames();
    void garbageEndsATcpLink();
    void theEndOfTheMasterEndsATcpLink();
    void tcpLinkToAnUnresponsiveMasterDoesNotBlock();
    void waitsEndInTime();
};

namespace {

struct Received
{
    CyclicLink::Status status;
    QByteArray bytes;
};

Received receive(CyclicLink &link, bool wait = true)
{
    const char *frame = nullptr;
    std::size_t size = 0;
    const CyclicLink::Status status = wait ? link.receive(&frame, &size) : link.poll(&frame, &size);
    return {status, status == CyclicLink::Received ? QByteArray(frame, int(size)) : QByteArray()};
}

}  // namespace

void tst_CyclicLink::aUdpLinkTalksToItsMasterOnly()
{
    UdpSocket master;
    UdpSocket stranger;
    quint16 port = 0;
    QString error;
    const auto link = UdpLink::open(master.self, &port, &error);
    QVERIFY2(link, qPrintable(error));
    const SocketAddress self(QHostAddress(QHostAddress::LocalHost), port);
    QVERIFY(stranger.send("stranger", self));
    QVERIFY(master.send("master", self));
    QCOMPARE(receive(*link).bytes, QByteArray("master"));
    QCOMPARE(receive(*link, false).status, CyclicLink::Nothing);
    QVERIFY(link->send("answer", 6));
    QCOMPARE(master.receive(), QByteArray("answer"));
    QVERIFY(master.send(QByteArray(60000, 'z'), self));
    QVERIFY(receive(*link).bytes.size() > 1472);  // cut off or not, it is longer than every frame: refused elsewhere
}

void tst_CyclicLink::udpLinkStaysOpenAfterLossOfTheMaster()
{
    SocketAddress gone;
    {
        const UdpSocket master;
        gone = master.self;
    }
    quint16 port = 0;
    QString error;
    const auto link = UdpLink::open(gone, &port, &error);
    QVERIFY(link);
    const InterruptibleWaits interrupt(1'000'000);
    for (int i = 0; i < 5; ++i) {
        link->send("anybody?", 8);
        QCOMPARE(receive(*link).status, CyclicLink::Nothing);  // "port unreachable" is no reason to give up
    }
}

void tst_CyclicLink::aTcpLinkGivesWholeFrames()
{
    StreamPair pair;
    const auto link = StreamLink::make(pair.take(0), toyCutter, LargestToyFrame);
    const InterruptibleWaits interrupt(20'000'000);
    pair.write(toyFrame(9).left(4));
    QCOMPARE(receive(*link).status, CyclicLink::Nothing);
    pair.write(toyFrame(9).mid(4) + toyFrame(3) + toyFrame(255));
    QCOMPARE(receive(*link).bytes, toyFrame(9));
    QCOMPARE(receive(*link, false).bytes, toyFrame(3));
    QCOMPARE(receive(*link).bytes, toyFrame(255));
    QCOMPARE(receive(*link, false).status, CyclicLink::Nothing);
    QVERIFY(link->send("answer", 6));
    QCOMPARE(pair.readAll(), QByteArray("answer"));
}

void tst_CyclicLink::garbageEndsATcpLink()
{
    StreamPair pair;
    const auto link = StreamLink::make(pair.take(0), toyCutter, LargestToyFrame);
    pair.write(toyFrame(5) + "garbage");
    QCOMPARE(receive(*link).status, CyclicLink::Received);
    QCOMPARE(receive(*link).status, CyclicLink::Closed);
    QCOMPARE(receive(*link, false).status, CyclicLink::Closed);
}

void tst_CyclicLink::theEndOfTheMasterEndsATcpLink()
{
    StreamPair pair;
    const auto link = StreamLink::make(pair.take(0), toyCutter, LargestToyFrame);
    pair.write(toyFrame(5));
    pair.closeEnd(1);
    QCOMPARE(receive(*link).status, CyclicLink::Received);
    QCOMPARE(receive(*link).status, CyclicLink::Closed);
    QVERIFY(!link->send("x", 1));  // and no SIGPIPE
}

void tst_CyclicLink::tcpLinkToAnUnresponsiveMasterDoesNotBlock()
{
    StreamPair pair;
    const auto link = StreamLink::make(pair.take(0), toyCutter, LargestToyFrame);
    int accepted = 0;
    while (link->send(toyFrame(255).constData(), 255))  // nothing interrupts it: it comes back by itself
        ++accepted;
    QVERIFY(accepted > 0);
    const InterruptibleWaits interrupt(1'000'000);
    int heard = pair.readAll().size();
    receive(*link);  // goes on with what has begun
    heard += pair.readAll().size();
    QCOMPARE(heard, accepted * 255);
}

void tst_CyclicLink::waitsEndInTime()
{
    UdpSocket master;
    quint16 port = 0;
    QString error;
    const auto link = UdpLink::open(master.self, &port, &error);
    QVERIFY(link);
    for (qint64 period : {100'000, 1'000'000}) {
        const InterruptibleWaits interrupt(period);
        QCOMPARE(receive(*link).status, CyclicLink::Nothing);
    }
    QVERIFY(!UdpLink::open(SocketAddress(), &port, &error));
    QVERIFY(!error.isEmpty());
}

QTEST_APPLESS_MAIN(tst_CyclicLink)
#include "tst_CyclicLink.moc"
