// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ThreadCosts.h"
#include "node/security/Handshake.h"
#include "protocol/ControlFrame.h"
#include "transport/ControlListener.h"

#include <QtPlcCore>

#include <QtCore/QTemporaryFile>
#include <QtNetwork/QTcpServer>
#include <QtNetwork/QTcpSocket>

#include <malloc.h>

#include <array>

// Who asks and asks, and takes no answer, costs a bounded amount of memory.
class tst_UnreadAnswers : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void peerThatReadsNothingIsNotServed();
    void peerThatResumesReadingGetsAllAnswers();
    void peerOverTlsThatResumesReadingGetsAllAnswers();
    void greetingsThatNobodyReadsShareTheTable();
    void greetingThatWasNotReadArrivesWhole();
    void connectionThatIsClosedSendsAllBefore();

private:
    static constexpr int Requests = 300;
    static constexpr int AnswerSize = 100'000;  // [byte]
    static constexpr qint64 Most = 1 << 20;     // [byte] that may be unread before nobody listens any more

    /// The two ends of a connection: one asks Requests times, the other one answers.
    struct Ends
    {
        QTcpServer server;
        QTcpSocket asker;
        QScopedPointer<QPlcSlaveSocket> answerer;
        int asked = 0;

        bool connectEnds();
    };
};

/// How many messages are complete with \a bytes.
static int countIn(qplc::ControlFrameReader *reader, const QByteArray &bytes)
{
    reader->append(bytes);
    QPlcMessage message;
    int count = 0;
    while (reader->next(&message))
        ++count;
    return count;
}

bool tst_UnreadAnswers::Ends::connectEnds()
{
    if (!server.listen(QHostAddress::LocalHost))
        return false;
    asker.setReadBufferSize(1000);  // what comes stays with the other end
    asker.connectToHost(QHostAddress::LocalHost, server.serverPort());
    if (!server.waitForNewConnection(20000) || !asker.waitForConnected(20000))
        return false;
    answerer.reset(new QPlcSlaveSocket(server.nextPendingConnection()));
    QObject::connect(answerer.data(), &QPlcAbstractSocket::messageReceived, answerer.data(), [this] {
        ++asked;
        answerer->sendMessage(QPlcMessage(QPlcMessage::Signals, {{"text", QString(AnswerSize, 'a')}}));
    });
    for (int i = 0; i < Requests; ++i)
        asker.write(qplc::encodeControlFrame(QPlcMessage(QPlcMessage::GetSignals, {{"number", i}})));
    return true;
}

void tst_UnreadAnswers::peerThatReadsNothingIsNotServed()
{
    Ends ends;
    QVERIFY(ends.connectEnds());
    QTRY_VERIFY(ends.answerer->bytesToSend() > Most / 2);
    QTest::qWait(100);
    QVERIFY2(ends.answerer->bytesToSend() <= Most + 2 * AnswerSize,
             QByteArray::number(ends.answerer->bytesToSend()).constData());
    QVERIFY2(ends.asked < Requests / 2, QByteArray::number(ends.asked).constData());
}

void tst_UnreadAnswers::peerThatResumesReadingGetsAllAnswers()
{
    Ends ends;
    QVERIFY(ends.connectEnds());
    QTRY_VERIFY(ends.answerer->bytesToSend() > Most / 2);
    ends.asker.setReadBufferSize(0);
    qplc::ControlFrameReader reader;
    int answers = 0;
    QTRY_VERIFY((answers += countIn(&reader, ends.asker.readAll())) == Requests);
    QCOMPARE(ends.asked, Requests);
    QCOMPARE(ends.answerer->bytesToSend(), qint64(0));
}

void tst_UnreadAnswers::peerOverTlsThatResumesReadingGetsAllAnswers()
{
    QTemporaryFile keys;
    QVERIFY(keys.open() && keys.write("[tool]\nkey = " + QByteArray(64, 'a') + "\nrole = Observer\n") > 0);
    keys.close();
    const QPlcSecurity security = QPlcSecurity::preSharedKeys(keys.fileName(), "tool");
    qplc::ControlListener listener;
    QVERIFY(listener.listen(QHostAddress::LocalHost, 0));
    QScopedPointer<QPlcSlaveSocket> answerer;
    int asked = 0;
    connect(&listener, &qplc::ControlListener::arrived, &listener, [&] {
        auto *handshake = new qplc::Handshake(listener.take(), security, &listener);
        connect(handshake, &qplc::Handshake::tlsWanted, handshake, &qplc::Handshake::beginTls);
        connect(handshake, &qplc::Handshake::succeeded, &listener, [&, handshake] {
            answerer.reset(new QPlcSlaveSocket(handshake->takeSocket()));
            connect(answerer.data(), &QPlcAbstractSocket::messageReceived, answerer.data(), [&] {
                ++asked;
                answerer->sendMessage(QPlcMessage(QPlcMessage::Signals, {{"text", QString(AnswerSize, 'a')}}));
            });
            handshake->deleteLater();
        });
    });
    QPlcMasterSocket asker;
    asker.setSecurity(security);
    asker.connectToMaster(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, listener.port()));
    QTRY_VERIFY(asker.isConnected() && answerer);
    auto *way = asker.findChild<QTcpSocket *>();
    QVERIFY(way);
    way->disconnect(&asker);
    way->setReadBufferSize(1000);  // what comes stays with the other end
    for (int i = 0; i < Requests; ++i)
        asker.sendMessage(QPlcMessage(QPlcMessage::GetSignals));
    QTRY_VERIFY(answerer->bytesToSend() > Most);
    QTest::qWait(100);
    QVERIFY2(asked < Requests / 2, QByteArray::number(asked).constData());
    way->setReadBufferSize(0);
    qplc::ControlFrameReader reader;
    int answers = 0;
    QTRY_VERIFY((answers += countIn(&reader, way->readAll())) == Requests);
    QCOMPARE(answerer->bytesToSend(), qint64(0));
}

/// A table whose text is larger than what the kernel keeps of a connection.
static QPlcSignalTable largeTable()
{
    QByteArray text;
    for (int i = 0; i < 50'000; ++i)
        text += "[signal" + QByteArray::number(i) + "]\ntype=Real64\ndescription=" + QByteArray(80, 'x') + "\n";
    return QPlcSignalTable::fromIni(text);
}

/// [byte]
static std::size_t heapInUse()
{
    const struct mallinfo2 heap = ::mallinfo2();
    return heap.uordblks + heap.hblkhd;
}

/// A client that wants the table, and reads nothing of it.
struct Stranger : QTcpSocket
{
    bool greet(const QPlcMasterNode &master)
    {
        setReadBufferSize(1000);
        connectToHost(QHostAddress::LocalHost, master.serverPort());
        if (!waitUntil([this] { return state() == ConnectedState; }))
            return false;
        write(qplc::encodeControlFrame(
            QPlcMessage(QPlcMessage::Hello, {{"protocol", 2}, {"name", "stranger"}, {"wantsTable", true}})));
        return waitUntil([this] { return bytesAvailable() > 0; });
    }
};

/// Nobody knows these clients yet: they must not cost copies of the table.
void tst_UnreadAnswers::greetingsThatNobodyReadsShareTheTable()
{
    if (!ThreadCosts::areCounted())
        QSKIP("the heap of a sanitizer does not tell");
    const QPlcSignalTable table = largeTable();
    const auto size = std::size_t(table.toIni().size());
    QVERIFY(size > 5'000'000);
    QPlcMasterNode master;
    QVERIFY(master.setSignalTable(table));
    QVERIFY(master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)));
    std::array<Stranger, 20> strangers;
    const std::size_t before = heapInUse();
    for (Stranger &stranger : strangers)
        QVERIFY(stranger.greet(master));
    const std::size_t after = heapInUse();
    QVERIFY2(after < before + size * strangers.size() / 10, QByteArray::number(qulonglong(after - before)).constData());
}

void tst_UnreadAnswers::greetingThatWasNotReadArrivesWhole()
{
    const QPlcSignalTable table = largeTable();
    QPlcMasterNode master;
    QVERIFY(master.setSignalTable(table));
    QVERIFY(master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)));
    Stranger stranger;
    QVERIFY(stranger.greet(master));
    stranger.setReadBufferSize(0);
    qplc::ControlFrameReader reader;
    reader.setLimit(qplc::MaximumControlFrame);
    QPlcMessage greeting;
    QVERIFY(waitUntil([&] { return reader.append(stranger.readAll()), reader.next(&greeting); }));
    QCOMPARE(greeting.kind(), QPlcMessage::Hello);
    QCOMPARE(greeting.fields().value(QStringLiteral("table")).toString().toUtf8(), table.toIni());
}

void tst_UnreadAnswers::connectionThatIsClosedSendsAllBefore()
{
    Ends ends;
    QVERIFY(ends.connectEnds());
    QTRY_VERIFY(ends.answerer->bytesToSend() > Most / 2);
    ends.answerer->close();
    QVERIFY(!ends.answerer->isConnected());
    QVERIFY(!ends.answerer->sendMessage(QPlcMessage(QPlcMessage::Done)));
    const int asked = ends.asked;
    ends.asker.setReadBufferSize(0);
    qplc::ControlFrameReader reader;
    int answers = 0;
    QTRY_COMPARE(((answers += countIn(&reader, ends.asker.readAll())), ends.asker.state()),
                 QAbstractSocket::UnconnectedState);
    answers += countIn(&reader, ends.asker.readAll());
    QCOMPARE(answers, asked);
}

QTEST_GUILESS_MAIN(tst_UnreadAnswers)
#include "tst_UnreadAnswers.moc"
