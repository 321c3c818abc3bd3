// SPDX-License-Identifier: Apache-2.0
#include "protocol/CyclicFrame.h"

#include "ThreadCosts.h"
#include "Vectors.h"

#include <QtTest/QtTest>

#include <new>
#include <utility>

using namespace qplc;

// What sealed frames are worth; their bytes are tested with those of the other frames in
// tst_CyclicFrame.
class tst_FrameSeal : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aNewKeyHasAllItsBitsFromTheRandomNumbers();
    void destructorWipesTheKey();
    void aSealedFrameShowsNothingOfItsPayload();
    void everyFlippedBitBehindTheFirstChecksCountsAsForged();
    void noSequencePositionIsSealedTwice_data();
    void noSequencePositionIsSealedTwice();
    void refusedFrameLeavesTheBufferUnchanged();
    void payloadCanBeSealedInPlace();
    void forgedPartKeepsTheValidParts();
    void sealedCyclesBeyond32BitsAreDistinct();
    void workNeedsNoHeap();
};

static const FrameSeed Seed{0x8F3A61C2D4E5B097, 7, 0x0163FF7E025F2E30};
static const QByteArray KeyBytes("0123456789abcdef0123456789ABCDEF");

static SealKey key()
{
    return SealKey(KeyBytes.constData());
}

static FrameEncoder encoderOf(const std::vector<std::uint32_t> &borders)
{
    const SealKey sealKey = key();
    return FrameEncoder(FrameKind::Inputs, Seed, borders, &sealKey);
}

static FrameDecoder decoderOf(const std::vector<std::uint32_t> &borders)
{
    const SealKey sealKey = key();
    return FrameDecoder(FrameKind::Inputs, Seed, borders, &sealKey);
}

static FrameHeader headerOf(std::uint64_t cycle, std::uint8_t flags = 0)
{
    FrameHeader header;
    header.cycle = cycle;
    header.flags = flags;
    return header;
}

void tst_FrameSeal::aNewKeyHasAllItsBitsFromTheRandomNumbers()
{
    std::uint64_t next = 0x0101010101010101;
    const SealKeys keys = SealKeys::make([&] { return std::exchange(next, next + 0x0101010101010101); });
    QByteArray expected;
    for (char number = 1; number <= 8; ++number)
        expected += QByteArray(8, number);
    QCOMPARE(QByteArray(keys.inputs.data(), SealKey::Size) + QByteArray(keys.outputs.data(), SealKey::Size), expected);
}

void tst_FrameSeal::destructorWipesTheKey()
{
    alignas(SealKey) char memory[sizeof(SealKey)];
    auto *placed = new (memory) SealKey(key());
    QCOMPARE(QByteArray(memory, SealKey::Size), KeyBytes);
    placed->~SealKey();
    QCOMPARE(QByteArray(memory, SealKey::Size), QByteArray(SealKey::Size, '\0'));
}

void tst_FrameSeal::aSealedFrameShowsNothingOfItsPayload()
{
    const FrameEncoder encoder = encoderOf({0, 64});
    const QByteArray payload(64, '\0');
    const QByteArray first = vectors::encode(encoder, 0, headerOf(1), payload);
    const QByteArray second = vectors::encode(encoder, 0, headerOf(2), payload);
    QCOMPARE(first.size(), 64 + 28);
    QVERIFY(first.mid(12, 64) != payload);
    QVERIFY(first.mid(12) != second.mid(12));  // the same values look different in every cycle
    for (int i = 0; i + 8 <= 64; ++i)
        QVERIFY(!second.mid(12).contains(first.mid(12 + i, 8)));
}

void tst_FrameSeal::everyFlippedBitBehindTheFirstChecksCountsAsForged()
{
    constexpr int firstChecks = 1 + 1 + 2;  // [byte] version and kind, flags, session
    FrameDecoder decoder = decoderOf({0, 40});
    const QByteArray good = vectors::encode(encoderOf({0, 40}), 0, headerOf(0), QByteArray(40, 'x'));
    int flips = 0;
    int forged = 0;
    for (int bit = 0; bit < good.size() * 8; ++bit) {
        QByteArray frame = good;
        frame[bit / 8] = char(frame.at(bit / 8) ^ (1 << bit % 8));
        const FrameStatus status = vectors::decode(decoder, frame);
        QVERIFY(vectors::isRefused(status));
        flips += bit >= firstChecks * 8 ? 1 : 0;
        forged += bit >= firstChecks * 8 && status == FrameStatus::Forged ? 1 : 0;
    }
    QCOMPARE(forged, flips);
    QCOMPARE(vectors::decode(decoder, good), FrameStatus::Complete);
}

void tst_FrameSeal::noSequencePositionIsSealedTwice_data()
{
    QTest::addColumn<quint64>("cycle");
    QTest::addColumn<int>("flags");
    QTest::addColumn<int>("part");
    QTest::addColumn<bool>("isSealed");
    // Part 1 of cycle 2^32, sent again, was sealed last.
    const quint64 last = Q_UINT64_C(1) << 32;
    QTest::newRow("the same place") << last << int(ResentFlag) << 1 << false;
    QTest::newRow("the same place with a fault") << last << int(ResentFlag | FaultFlag) << 1 << false;
    QTest::newRow("the part before") << last << int(ResentFlag) << 0 << false;
    QTest::newRow("the first time") << last << 0 << 2 << false;
    QTest::newRow("the cycle before") << last - 1 << int(ResentFlag) << 2 << false;
    QTest::newRow("the same low 32 bits, before") << Q_UINT64_C(0) << 0 << 0 << false;
    QTest::newRow("the next part") << last << int(ResentFlag) << 2 << true;
    QTest::newRow("the next cycle") << last + 1 << 0 << 0 << true;
    QTest::newRow("the same low 32 bits, after") << 2 * last << 0 << 0 << true;
    QTest::newRow("the last cycle of all") << ~Q_UINT64_C(0) << 0 << 0 << true;
}

void tst_FrameSeal::noSequencePositionIsSealedTwice()
{
    QFETCH(quint64, cycle);
    QFETCH(int, flags);
    QFETCH(int, part);
    QFETCH(bool, isSealed);
    const FrameEncoder encoder = encoderOf({0, 4, 8, 12});
    std::array<char, MaximumCyclicFrame> frame{};
    const QByteArray payload(12, 'x');
    QVERIFY(
        encoder.encode(1, headerOf(Q_UINT64_C(1) << 32, std::uint8_t(ResentFlag)), payload.constData(), frame.data()));
    QCOMPARE(encoder.encode(std::size_t(part), headerOf(cycle, std::uint8_t(flags)), payload.constData(), frame.data()),
             isSealed);
}

void tst_FrameSeal::refusedFrameLeavesTheBufferUnchanged()
{
    const FrameEncoder encoder = encoderOf({0, 8});
    QByteArray frame = vectors::encode(encoder, 0, headerOf(5), QByteArray(8, 'a'));
    const QByteArray sent = frame;
    QVERIFY(!encoder.encode(0, headerOf(5), QByteArray(8, 'b').constData(), frame.data()));
    QCOMPARE(frame, sent);
}

void tst_FrameSeal::payloadCanBeSealedInPlace()
{
    QByteArray frame(int(SealedOverhead) + 8, '\0');
    frame.replace(int(CyclicHeaderSize), 8, "12345678");
    QVERIFY(encoderOf({0, 8}).encode(0, headerOf(1), frame.constData() + CyclicHeaderSize, frame.data()));
    QCOMPARE(frame, vectors::encode(encoderOf({0, 8}), 0, headerOf(1), "12345678"));
}

void tst_FrameSeal::forgedPartKeepsTheValidParts()
{
    const QByteArray payload("0123456789abcdef");
    const FrameEncoder encoder = encoderOf({0, 8, 16});
    FrameDecoder decoder = decoderOf({0, 8, 16});
    const QByteArray first = vectors::encode(encoder, 0, headerOf(1), payload);
    const QByteArray second = vectors::encode(encoder, 1, headerOf(1), payload);
    QByteArray forged = first;
    forged[20] = char(forged.at(20) ^ 1);
    QCOMPARE(vectors::decode(decoder, first), FrameStatus::Incomplete);
    QCOMPARE(vectors::decode(decoder, forged), FrameStatus::Forged);
    QCOMPARE(vectors::decode(decoder, second), FrameStatus::Complete);
    QCOMPARE(QByteArray(decoder.payload(), 16), payload);
}

void tst_FrameSeal::sealedCyclesBeyond32BitsAreDistinct()
{
    const std::uint64_t first = 0xFFFFFFF0;
    const FrameEncoder encoder = encoderOf({0, 4});
    FrameDecoder decoder = decoderOf({0, 4});
    decoder.restart(first);
    QVector<QByteArray> frames;
    for (std::uint64_t cycle = first; cycle < first + 40; ++cycle) {
        frames << vectors::encode(encoder, 0, headerOf(cycle), QByteArray(4, 'x'));
        QCOMPARE(vectors::decode(decoder, frames.last()), FrameStatus::Complete);
        QCOMPARE(decoder.cycle(), cycle);
    }
    decoder.restart(
        first + (Q_UINT64_C(1) << 32));  // the wire has the same numbers again, and what was recorded is of no use
    for (const QByteArray &frame : qAsConst(frames))
        QCOMPARE(vectors::decode(decoder, frame), FrameStatus::Forged);
}

void tst_FrameSeal::workNeedsNoHeap()
{
    const FrameEncoder encoder = encoderOf({0, 1444, 1500});
    FrameDecoder decoder = decoderOf({0, 1444, 1500});
    const QByteArray payload(1500, 'x');
    std::array<char, MaximumCyclicFrame> frame{};
    const ThreadCosts before = ThreadCosts::ofThisThread();
    bool all = true;
    for (std::uint64_t cycle = 1; cycle <= 1000; ++cycle) {
        for (std::size_t part = 0; part < 2; ++part) {
            all = encoder.encode(part, headerOf(cycle), payload.constData(), frame.data()) && all;
            decoder.decode(frame.data(), encoder.partSize(part));
            frame[50] = char(frame[50] ^ 1);
            all = decoder.decode(frame.data(), encoder.partSize(part)) == FrameStatus::Forged && all;
        }
    }
    const ThreadCosts spent = ThreadCosts::ofThisThread() - before;
    QVERIFY(all);
    QCOMPARE(decoder.cycle(), std::uint64_t(1000));
    if (!ThreadCosts::areCounted())
        QSKIP("the sanitizer owns malloc", "");
    QCOMPARE(spent.allocations, std::uint64_t(0));
    QCOMPARE(spent.locks, std::uint64_t(0));
}

QTEST_APPLESS_MAIN(tst_FrameSeal)
#include "tst_FrameSeal.moc"
