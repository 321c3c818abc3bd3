// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "node/security/Handshake.h"
#include "protocol/ControlFrame.h"
#include "transport/ControlListener.h"

#include <QtPlcCore>

#include <QtCore/QTemporaryFile>
#include <QtNetwork/QTcpServer>
#include <QtNetwork/QTcpSocket>

// Who asks and asks, and takes no answer, costs a bounded amount of memory.
class tst_UnreadAnswers : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void peerThatReadsNothingIsNotServed();
    void peerThatResumesReadingGetsAllAnswers();
    void peerOverTlsThatResumesReadingGetsAllAnswers();

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
    QTRY_VERIFY_WITH_TIMEOUT((answers += countIn(&reader, ends.asker.readAll())) == Requests, 20000);
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
    QTRY_VERIFY_WITH_TIMEOUT(asker.isConnected() && answerer, 20000);
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
    QTRY_VERIFY_WITH_TIMEOUT((answers += countIn(&reader, way->readAll())) == Requests, 20000);
    QCOMPARE(answerer->bytesToSend(), qint64(0));
}

QTEST_GUILESS_MAIN(tst_UnreadAnswers)
#include "tst_UnreadAnswers.moc"
