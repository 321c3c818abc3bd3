// SPDX-License-Identifier: Apache-2.0
#include "protocol/CyclicFrame.h"

#include "Vectors.h"
#include "protocol/LittleEndian.h"

#include <QtTest/QtTest>

using namespace qplc;

class tst_CyclicFrame : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void encoderReproducesTheVectors_data() { goodFrames(); }
    void encoderReproducesTheVectors();
    void decoderAcceptsTheValidVectors_data() { goodFrames(); }
    void decoderAcceptsTheValidVectors();
    void decoderRefusesTheInvalidVectors_data();
    void decoderRefusesTheInvalidVectors();
    void decoderFollowsTheRecordedSequences_data();
    void decoderFollowsTheRecordedSequences();
    void noFlippedBitGoesUnnoticed_data() { goodFrames(); }
    void noFlippedBitGoesUnnoticed();
    void truncatedFramesAreRefused_data() { goodFrames(); }
    void truncatedFramesAreRefused();
    void sizeOfAFrameIsReadFromItsHeader_data() { goodFrames(); }
    void sizeOfAFrameIsReadFromItsHeader();
    void headerOfAnotherChannelHasNoSize();
    void aTimeHasTwelveBitsOnTheWire();
    void defaultDecoderRefusesEverything();
    void encoderSetsItsOwnHeaderFields();
    void randomBytesAreNeverAccepted();

private:
    static void goodFrames();
};

// Frames as they are, and sealed ones: they follow the same rules.
static const QStringList files{QStringLiteral("cyclic_frames.json"), QStringLiteral("sealed_frames.json")};

static QByteArray rowName(const QString &file, const QJsonValue &row)
{
    return (file.section(QLatin1Char('_'), 0, 0) + QStringLiteral(": ") + row[QStringLiteral("name")].toString())
        .toUtf8();
}

static void addRows(const QString &array)
{
    QTest::addColumn<QJsonObject>("row");
    for (const QString &file : files) {
        const QJsonArray rows = vectors::file(file)[array].toArray();
        QVERIFY(!rows.isEmpty());
        for (const QJsonValue row : rows)
            QTest::newRow(rowName(file, row).constData()) << row.toObject();
    }
}

static FrameHeader headerOf(const QJsonObject &row)
{
    FrameHeader header;
    header.flags = std::uint8_t(row[QStringLiteral("flags")].toInt());
    header.cycle = std::uint64_t(row[QStringLiteral("cycle")].toDouble());
    header.info = std::uint32_t(row[QStringLiteral("info")].toDouble());
    header.before = std::uint16_t(row[QStringLiteral("before")].toDouble());
    return header;
}

void tst_CyclicFrame::goodFrames()
{
    addRows(QStringLiteral("frames"));
}

void tst_CyclicFrame::encoderReproducesTheVectors()
{
    QFETCH(QJsonObject, row);
    const FrameEncoder encoder = vectors::Channel(row[QStringLiteral("channel")]).encoder();
    const QJsonArray frames = row[QStringLiteral("frames")].toArray();
    QCOMPARE(int(encoder.partCount()), frames.size());
    std::size_t total = 0;
    for (std::size_t part = 0; part < encoder.partCount(); ++part) {
        const QByteArray frame
            = vectors::encode(encoder, part, headerOf(row), vectors::bytes(row[QStringLiteral("payload")]));
        QCOMPARE(QString::fromLatin1(frame.toHex()), frames.at(int(part)).toString());
        QVERIFY(encoder.partSize(part) <= MaximumCyclicFrame);
        total += encoder.partSize(part);
    }
    QCOMPARE(encoder.totalSize(), total);
}

void tst_CyclicFrame::decoderAcceptsTheValidVectors()
{
    QFETCH(QJsonObject, row);
    const vectors::Channel channel(row[QStringLiteral("channel")]);
    const FrameHeader header = headerOf(row);
    FrameDecoder decoder = channel.decoder();
    decoder.restart(header.cycle);
    const QJsonArray frames = row[QStringLiteral("frames")].toArray();
    for (int i = 0; i < frames.size(); ++i) {
        const bool isLast = i + 1 == frames.size();
        QCOMPARE(vectors::decode(decoder, vectors::bytes(frames.at(i))),
                 isLast ? FrameStatus::Complete : FrameStatus::Incomplete);
    }
    QCOMPARE(channel.payload(decoder), vectors::bytes(row[QStringLiteral("payload")]));
    QCOMPARE(decoder.cycle(), std::uint64_t(header.cycle));
    QCOMPARE(decoder.header().kind, channel.kind);
    QCOMPARE(decoder.header().flags, header.flags);
    QCOMPARE(decoder.header().cycle, header.cycle);
    QCOMPARE(decoder.header().info, header.info);
    QCOMPARE(decoder.header().before, header.before);
}

void tst_CyclicFrame::decoderRefusesTheInvalidVectors_data()
{
    QTest::addColumn<QJsonValue>("channelOfAll");
    QTest::addColumn<QByteArray>("frame");
    QTest::addColumn<QString>("status");
    for (const QString &file : files) {
        const QJsonValue refused = vectors::file(file)[QStringLiteral("refused")];
        const QJsonArray rows = refused[QStringLiteral("frames")].toArray();
        QVERIFY(!rows.isEmpty());
        for (const QJsonValue row : rows)
            QTest::newRow(rowName(file, row).constData())
                << refused[QStringLiteral("channel")] << vectors::bytes(row[QStringLiteral("hex")])
                << row[QStringLiteral("status")].toString();
    }
}

void tst_CyclicFrame::decoderRefusesTheInvalidVectors()
{
    QFETCH(QJsonValue, channelOfAll);
    QFETCH(QByteArray, frame);
    QFETCH(QString, status);
    const vectors::Channel channel(channelOfAll);
    FrameDecoder decoder = channel.decoder();
    QCOMPARE(vectors::name(vectors::decode(decoder, frame)), status);

    // Nothing has changed: the whole frame of the same cycle is still welcome.
    const QByteArray payload(int(channel.borders.back()), 'p');
    FrameHeader header;
    header.cycle = 42;
    QCOMPARE(vectors::decode(decoder, vectors::encode(channel.encoder(), 0, header, payload)), FrameStatus::Incomplete);
    QCOMPARE(vectors::decode(decoder, vectors::encode(channel.encoder(), 1, header, payload)), FrameStatus::Complete);
    QCOMPARE(channel.payload(decoder), payload);
}

void tst_CyclicFrame::decoderFollowsTheRecordedSequences_data()
{
    addRows(QStringLiteral("sequences"));
}

void tst_CyclicFrame::decoderFollowsTheRecordedSequences()
{
    QFETCH(QJsonObject, row);
    const vectors::Channel channel(row[QStringLiteral("channel")]);
    FrameDecoder decoder = channel.decoder();
    decoder.restart(vectors::number(row[QStringLiteral("firstCycle")]));
    for (const QJsonValue step : row[QStringLiteral("steps")].toArray()) {
        const FrameStatus status = vectors::decode(decoder, vectors::bytes(step[QStringLiteral("hex")]));
        QCOMPARE(vectors::name(status), step[QStringLiteral("status")].toString());
        if (step.toObject().contains(QStringLiteral("cycle"))) {
            QCOMPARE(decoder.cycle(), vectors::number(step[QStringLiteral("cycle")]));
            QCOMPARE(channel.payload(decoder), vectors::bytes(step[QStringLiteral("payload")]));
        }
    }
}

void tst_CyclicFrame::noFlippedBitGoesUnnoticed()
{
    QFETCH(QJsonObject, row);
    const vectors::Channel channel(row[QStringLiteral("channel")]);
    FrameDecoder decoder = channel.decoder();
    for (const QJsonValue hex : row[QStringLiteral("frames")].toArray()) {
        const QByteArray good = vectors::bytes(hex);
        for (int bit = 0; bit < good.size() * 8; ++bit) {
            QByteArray frame = good;
            frame[bit / 8] = char(frame.at(bit / 8) ^ (1 << bit % 8));
            QVERIFY(vectors::isRefused(vectors::decode(decoder, frame)));
        }
    }
    QCOMPARE(decoder.cycle(), std::uint64_t(0));
    QCOMPARE(channel.payload(decoder), QByteArray(int(channel.borders.back()), '\0'));
}

void tst_CyclicFrame::truncatedFramesAreRefused()
{
    QFETCH(QJsonObject, row);
    FrameDecoder decoder = vectors::Channel(row[QStringLiteral("channel")]).decoder();
    for (const QJsonValue hex : row[QStringLiteral("frames")].toArray()) {
        const QByteArray good = vectors::bytes(hex);
        for (int size = 0; size < good.size(); ++size) {
            // A copy of just these bytes, so that a memory checker sees a read behind them.
            const std::vector<char> cut(good.constData(), good.constData() + size);
            QVERIFY(vectors::isRefused(decoder.decode(cut.data(), cut.size())));
        }
    }
}

void tst_CyclicFrame::sizeOfAFrameIsReadFromItsHeader()
{
    QFETCH(QJsonObject, row);
    const FrameDecoder decoder = vectors::Channel(row[QStringLiteral("channel")]).decoder();
    for (const QJsonValue hex : row[QStringLiteral("frames")].toArray()) {
        const QByteArray frame = vectors::bytes(hex);
        const std::vector<char> header(frame.constData(), frame.constData() + CyclicHeaderSize);
        QCOMPARE(decoder.frameSize(header.data()), std::size_t(frame.size()));
    }
}

void tst_CyclicFrame::headerOfAnotherChannelHasNoSize()
{
    const FrameSeed seed{0x1234, 1, 2};
    const FrameDecoder decoder(FrameKind::Inputs, seed, {0, 8, 12});
    QByteArray frame
        = vectors::encode(FrameEncoder(FrameKind::Inputs, seed, {0, 8, 12}), 1, FrameHeader(), QByteArray(12, 'x'));
    QCOMPARE(decoder.frameSize(frame.constData()), std::size_t(20));

    for (const int bit : {0, 1, 4, 7, 16, 31}) {  // kind, version, session
        QByteArray strange = frame;
        strange[bit / 8] = char(strange.at(bit / 8) ^ (1 << bit % 8));
        QCOMPARE(decoder.frameSize(strange.constData()), std::size_t(0));
    }
    for (const int part : {0, 2, 100}) {  // the parts above 0 are: 1
        frame[8] = char(part);
        QCOMPARE(decoder.frameSize(frame.constData()), std::size_t(0));
    }
}

void tst_CyclicFrame::aTimeHasTwelveBitsOnTheWire()
{
    const QJsonArray rows = vectors::file(QStringLiteral("cyclic_frames.json"))[QStringLiteral("times")].toArray();
    QVERIFY(!rows.isEmpty());
    for (const QJsonValue row : rows) {
        const QByteArray hex = vectors::bytes(row[QStringLiteral("hex")]);
        const auto wire = loadLittle<std::uint16_t>(hex.constData());
        const double time = row[QStringLiteral("time")].toDouble();
        QCOMPARE(int(shortTime(std::uint32_t(time))), int(wire));
        QCOMPARE(double(timeOfShort(wire)), row[QStringLiteral("read")].toDouble());
        QVERIFY(timeOfShort(wire) <= time && time - timeOfShort(wire) <= time / 2048);
    }
    QCOMPARE(timeOfShort(0xFFFF), std::numeric_limits<std::uint32_t>::max());  // longer than a program can hold
}

void tst_CyclicFrame::defaultDecoderRefusesEverything()
{
    FrameDecoder decoder;
    const QByteArray frame = vectors::encode(FrameEncoder(), 0, FrameHeader(), QByteArray());
    QCOMPARE(frame.size(), int(CyclicOverhead));
    QCOMPARE(vectors::decode(decoder, frame), FrameStatus::WrongLength);
    QCOMPARE(decoder.frameSize(frame.constData()), std::size_t(0));
    QVERIFY(decoder.payload() == nullptr);
}

void tst_CyclicFrame::encoderSetsItsOwnHeaderFields()
{
    const FrameSeed seed{1, 2, 3};
    const FrameEncoder encoder(FrameKind::Outputs, seed, {0, 4, 8});
    FrameDecoder decoder(FrameKind::Outputs, seed, {0, 4, 8});
    FrameHeader header;
    header.kind = FrameKind::Inputs;
    header.flags = PartFlag | FaultFlag;
    header.info = 99;
    const QByteArray payload("01234567");
    QCOMPARE(vectors::decode(decoder, vectors::encode(encoder, 0, header, payload)), FrameStatus::Incomplete);
    QCOMPARE(decoder.received().flags, std::uint8_t(FaultFlag));
    QCOMPARE(decoder.received().info, 99u);
    QCOMPARE(vectors::decode(decoder, vectors::encode(encoder, 1, header, payload)), FrameStatus::Complete);
    QCOMPARE(decoder.received().flags, std::uint8_t(FaultFlag | PartFlag));
    QCOMPARE(decoder.received().info, 1u);
    QCOMPARE(decoder.header().info, 99u);
}

void tst_CyclicFrame::randomBytesAreNeverAccepted()
{
    std::mt19937 random(4);
    const FrameSeed seed{random(), 3, random()};
    FrameDecoder decoder(FrameKind::Inputs, seed, {0, 16, 40});
    const QByteArray good
        = vectors::encode(FrameEncoder(FrameKind::Inputs, seed, {0, 16, 40}), 1, FrameHeader(), QByteArray(40, 'x'));
    for (int round = 0; round < 50000; ++round) {
        // Every second one begins as a good frame does, and has its length: it passes the first
        // checks.
        const int begin = round % 2 == 0 ? 0 : int(random() % 13);
        const int size = round % 2 == 0 ? int(random() % 64) : good.size();
        const QByteArray frame = good.left(begin) + vectors::randomBytes(random, size - begin);
        QVERIFY(vectors::isRefused(vectors::decode(decoder, frame)));
    }
    QCOMPARE(vectors::decode(decoder, good), FrameStatus::Incomplete);
}

QTEST_APPLESS_MAIN(tst_CyclicFrame)
#include "tst_CyclicFrame.moc"
