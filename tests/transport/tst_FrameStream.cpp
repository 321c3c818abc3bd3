// SPDX-License-Identifier: Apache-2.0
#include "TransportFixtures.h"
#include "transport/StreamSender.h"

#include <QtTest/QtTest>

using qplc::FrameBuffer;
using qplc::StreamSender;

// Whole frames into a byte stream and out of it.
class tst_FrameStream : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void framesAreReadFromAnyPieces_data();
    void framesAreReadFromAnyPieces();
    void garbageIsNeverReadAsAFrame_data();
    void garbageIsNeverReadAsAFrame();
    void aFullSocketTearsNoFrame();
    void aBlockingSenderTearsNoFrameEither();
    void aFrameThatIsTooLongIsLeftOut();
};

namespace {

QVector<QByteArray> feed(FrameBuffer &buffer, const QByteArray &bytes)
{
    QVector<QByteArray> frames;
    buffer.compact();
    std::memcpy(buffer.space(), bytes.constData(), std::size_t(bytes.size()));
    buffer.filled(std::size_t(bytes.size()));
    const char *frame = nullptr;
    std::size_t size = 0;
    while (buffer.next(toyCutter, &frame, &size) == FrameBuffer::Frame)
        frames << QByteArray(frame, int(size));
    return frames;
}

/// A stream socket with the smallest buffers there are.
void shrink(const StreamPair &pair)
{
    const int smallest = 1;
    for (int end : pair.ends)
        ::setsockopt(end, SOL_SOCKET, SO_SNDBUF, &smallest, sizeof smallest);
}

}  // namespace

void tst_FrameStream::framesAreReadFromAnyPieces_data()
{
    QTest::addColumn<int>("piece");
    for (int piece : {1, 2, 3, 7, 50, 1000})
        QTest::addRow("%d bytes at a time", piece) << piece;
}

void tst_FrameStream::framesAreReadFromAnyPieces()
{
    QFETCH(int, piece);
    QVector<QByteArray> sent;
    QByteArray stream;
    for (int size : {2, 3, 255, 16, 2, 100, 254}) {
        sent << toyFrame(size, char('a' + sent.size()));
        stream += sent.last();
    }
    FrameBuffer buffer(4 * LargestToyFrame);
    QVector<QByteArray> received;
    for (int i = 0; i < stream.size(); i += piece)
        received += feed(buffer, stream.mid(i, piece));
    QCOMPARE(received, sent);
}

void tst_FrameStream::garbageIsNeverReadAsAFrame_data()
{
    QTest::addColumn<QByteArray>("bytes");
    QTest::newRow("no begin") << QByteArray("GET /");
    QTest::newRow("shorter than its header") << QByteArray("F\x01");
    QTest::newRow("length 0") << QByteArray("F\0", 2);
    QTest::newRow("behind a good frame") << toyFrame(5) + "G\x05";
}

void tst_FrameStream::garbageIsNeverReadAsAFrame()
{
    QFETCH(QByteArray, bytes);
    FrameBuffer buffer(100);
    feed(buffer, bytes);
    const char *frame = nullptr;
    std::size_t size = 0;
    QCOMPARE(buffer.next(toyCutter, &frame, &size), FrameBuffer::Garbage);
    QCOMPARE(buffer.next(toyCutter, &frame, &size), FrameBuffer::Garbage);  // for ever
    FrameBuffer tight(100);
    feed(tight, QByteArray("F\xff", 2));  // longer than the buffer: could never become whole
    QCOMPARE(tight.next(toyCutter, &frame, &size), FrameBuffer::Garbage);
}

void tst_FrameStream::aFullSocketTearsNoFrame()
{
    StreamPair pair;
    QVERIFY(pair.ok);
    shrink(pair);
    StreamSender sender(LargestToyFrame);
    FrameBuffer buffer(1 << 20);
    int accepted = 0;
    int received = 0;
    bool wasFull = false;
    for (int round = 0; round < 20; ++round) {
        for (int i = 0; i < 2000; ++i)
            accepted += sender.send(pair.ends[0], toyFrame(255, char(accepted)).constData(), 255, MSG_DONTWAIT);
        wasFull = wasFull || accepted < 2000 * (round + 1);
        for (const QByteArray &frame : feed(buffer, pair.readAll()))
            QCOMPARE(frame, toyFrame(255, char(received++)));
    }
    QVERIFY(wasFull);
    QVERIFY(sender.sendRest(pair.ends[0], MSG_DONTWAIT));
    for (const QByteArray &frame : feed(buffer, pair.readAll()))
        QCOMPARE(frame, toyFrame(255, char(received++)));
    QCOMPARE(received, accepted);  // every frame that was taken arrives, whole and in order
    QVERIFY(!sender.hasRest());
}

void tst_FrameStream::aBlockingSenderTearsNoFrameEither()
{
    // A stream whose kernel takes a few bytes at a time: over TCP with small buffers, in both
    // directions of time-out.
    StreamPair pair;
    shrink(pair);
    timeval time{0, 1000};
    ::setsockopt(pair.ends[0], SOL_SOCKET, SO_SNDTIMEO, &time, sizeof time);
    StreamSender sender(60000);
    QByteArray frame(60000, 'y');
    int accepted = 0;
    while (sender.send(pair.ends[0], frame.constData(), std::size_t(frame.size()), 0))
        ++accepted;
    QVERIFY(accepted >= 1);
    QByteArray all = pair.readAll();
    while (!sender.sendRest(pair.ends[0], MSG_DONTWAIT))
        all += pair.readAll();
    all += pair.readAll();
    QCOMPARE(all.size(), accepted * frame.size());
}

void tst_FrameStream::aFrameThatIsTooLongIsLeftOut()
{
    StreamPair pair;
    StreamSender sender(10);
    QVERIFY(!sender.send(pair.ends[0], "01234567890", 11, MSG_DONTWAIT));
    QVERIFY(sender.send(pair.ends[0], "0123456789", 10, MSG_DONTWAIT));
    QCOMPARE(pair.readAll(), QByteArray("0123456789"));
    pair.closeEnd(1);
    QVERIFY(!sender.send(pair.ends[0], "x", 1, MSG_DONTWAIT));  // and no SIGPIPE
}

QTEST_APPLESS_MAIN(tst_FrameStream)
#include "tst_FrameStream.moc"
