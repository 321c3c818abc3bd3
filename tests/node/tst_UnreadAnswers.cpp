// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "protocol/ControlFrame.h"

#include <QtPlcCore>

#include <QtNetwork/QTcpServer>
#include <QtNetwork/QTcpSocket>

// Who asks and asks, and takes no answer, costs a bounded amount of memory.
class tst_UnreadAnswers : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void peerThatReadsNothingIsNotServed();
    void peerThatResumesReadingGetsAllAnswers();

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
    const auto read = [&] {
        reader.append(ends.asker.readAll());
        QPlcMessage message;
        while (reader.next(&message))
            ++answers;
        return answers == Requests;
    };
    QTRY_VERIFY_WITH_TIMEOUT(read(), 20000);
    QCOMPARE(ends.asked, Requests);
    QCOMPARE(ends.answerer->bytesToSend(), qint64(0));
}

QTEST_GUILESS_MAIN(tst_UnreadAnswers)
#include "tst_UnreadAnswers.moc"
