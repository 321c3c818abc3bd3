// SPDX-License-Identifier: Apache-2.0
#include "ScriptedNode.h"
#include "VirtualTime.h"
#include "node/session/LongMessages.h"
#include "protocol/LittleEndian.h"

using namespace std::chrono_literals;
using qplc::LongMessages;

namespace {

constexpr qint64 Second = 1'000'000'000;  // [ns]
constexpr int Length = 2 * 1024 * 1024;   // [byte] of a message that takes more memory than most

/// A message of this table may have more than Length bytes.
QPlcSignalTable largeTable()
{
    QByteArray ini;
    for (int i = 0; i < 5000; ++i)
        ini += "[signal_" + QByteArray::number(i) + "]\ntype = Real64\n";
    return QPlcSignalTable::fromIni(ini);
}

struct OpenSocket : QPlcMasterSocket
{
    static QTcpSocket *of(QPlcMasterSocket &socket) { return (socket.*&OpenSocket::socket)(); }
};

/// A tool that begins a long message, and may end it.
struct LongSender : ScriptedTool
{
    const QByteArray frame = qplc::encodeControlFrame(
        QPlcMessage(QPlcMessage::SetSignals, {{"padding", QString(Length, 'x')}}), qplc::MaximumControlFrame);
    int sent = 0;  // [byte]

    bool begin(quint16 port)
    {
        if (!greetAt(port))
            return false;
        sendUpTo(Length / 4);
        return true;
    }
    void sendUpTo(int end)
    {
        OpenSocket::of(control)->write(frame.mid(sent, end - sent));
        sent = end;
    }
    void end() { sendUpTo(frame.size()); }
};

}  // namespace

// Messages that take much memory while they arrive: a few at a time, and each has to end.
class tst_LongMessages : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void fewArriveAtATime();
    void oneOfEachOriginArrivesAtATime();
    void patienceGrowsWithTheLength();
    void whoeverIsGoneWaitsForNothing();
    void aMessageThatDoesNotEndEndsItsConnection();
    void theNextOneOfTheSameAddressWaits();
};

void tst_LongMessages::fewArriveAtATime()
{
    LongMessages messages;
    int clients[LongMessages::MostAtOnce + 2]{};
    const auto admit = [&](int client) { return messages.admit(&clients[client], QString::number(client), Length, 0); };
    QVERIFY(messages.isEmpty());
    for (int i = 0; i < LongMessages::MostAtOnce; ++i)
        QVERIFY(admit(i) && admit(i));
    QVERIFY(!admit(LongMessages::MostAtOnce));
    QVERIFY(!admit(LongMessages::MostAtOnce + 1));
    QVERIFY(admit(0));
    const std::vector<LongMessages::Client> waiting{&clients[LongMessages::MostAtOnce],
                                                    &clients[LongMessages::MostAtOnce + 1]};
    QVERIFY(messages.leave(&clients[1]) == waiting);
    QVERIFY(admit(LongMessages::MostAtOnce));
    QVERIFY(!admit(LongMessages::MostAtOnce + 1));
}

void tst_LongMessages::oneOfEachOriginArrivesAtATime()
{
    LongMessages messages;
    int clients[3]{};
    QVERIFY(messages.admit(&clients[0], QStringLiteral("anna"), Length, 0));
    QVERIFY(!messages.admit(&clients[1], QStringLiteral("anna"), Length, 0));
    QVERIFY(messages.admit(&clients[2], QStringLiteral("berta"), Length, 0));
    QVERIFY(messages.leave(&clients[0]) == std::vector<LongMessages::Client>{&clients[1]});
    QVERIFY(messages.admit(&clients[1], QStringLiteral("anna"), Length, 0));
}

void tst_LongMessages::patienceGrowsWithTheLength()
{
    LongMessages messages;
    int clients[2]{};
    QVERIFY(messages.admit(&clients[0], QStringLiteral("anna"), 5'000'000, Second));
    QVERIFY(messages.admit(&clients[1], QStringLiteral("berta"), 20'000'000, Second));
    QVERIFY(messages.overdue(16 * Second - 1).empty());
    QVERIFY(messages.overdue(16 * Second) == std::vector<LongMessages::Client>{&clients[0]});
    QCOMPARE(messages.overdue(31 * Second).size(), std::size_t(2));
}

void tst_LongMessages::whoeverIsGoneWaitsForNothing()
{
    LongMessages messages;
    int clients[2]{};
    QVERIFY(messages.admit(&clients[0], QStringLiteral("anna"), Length, 0));
    QVERIFY(!messages.admit(&clients[1], QStringLiteral("anna"), Length, 0));
    QVERIFY(messages.leave(&clients[1]).empty());
    QVERIFY(messages.leave(&clients[0]).empty());
    QVERIFY(messages.isEmpty());
}

void tst_LongMessages::aMessageThatDoesNotEndEndsItsConnection()
{
    TestMaster master(QPlcClock::realTime(), largeTable());
    QVERIFY(master.listen());
    LongSender sender;
    QVERIFY(sender.begin(master.serverPort()));
    pass(10s);
    QVERIFY(sender.control.isConnected());  // 10 s, and 2 s for 2 MB
    const QPlcMessage refusal = sender.next(5000);
    QCOMPARE(refusal.kind(), QPlcMessage::Rejected);
    QCOMPARE(refusal.text("error"), QString("TimedOut"));
    QVERIFY2(refusal.text("text").contains("a message of 'Tool' does not end"), qPrintable(refusal.text("text")));
    QVERIFY(waitUntil([&] { return !sender.control.isConnected(); }));
}

void tst_LongMessages::theNextOneOfTheSameAddressWaits()
{
    TestMaster master(QPlcClock::realTime(), largeTable());
    QVERIFY(master.listen());
    LongSender first;
    LongSender second;
    ScriptedTool other;
    QVERIFY(first.begin(master.serverPort()));
    QVERIFY(second.begin(master.serverPort()));
    QVERIFY(other.greetAt(master.serverPort()));
    second.end();
    pass(5s);
    QCOMPARE(second.next(0).kind(), QPlcMessage::Invalid);
    QCOMPARE(other.ask(QPlcMessage::GetState).kind(), QPlcMessage::State);  // who is brief waits for nobody
    first.end();
    QCOMPARE(first.next().kind(), QPlcMessage::Failed);  // there is no signal in it
    QCOMPARE(second.next().kind(), QPlcMessage::Failed);
    pass(20s);
    QVERIFY(first.control.isConnected() && second.control.isConnected());
}

QTPLC_VIRTUAL_TIME_MAIN(tst_LongMessages)
#include "tst_LongMessages.moc"
