// SPDX-License-Identifier: Apache-2.0
#include "protocol/CyclicFrame.h"

#include "ThreadCosts.h"
#include "Vectors.h"

#include <QtTest/QtTest>

#include <cstdlib>
#include <set>

using namespace qplc;

class tst_FrameSequence : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void cycleIsExtendedToTheNearest_data();
    void cycleIsExtendedToTheNearest();
    void cyclesRunOnBeyond32Bits();
    void restartAcceptsCyclesFromTheFirstCycle();
    void restartForgetsTheIncompleteCycle();
    void cyclesBelowZeroAreRejected();
    void earlyFramesChangeNothing_data();
    void earlyFramesChangeNothing();
    void lastPayloadStaysWholeWhilePartsArrive();
    void resentFrameOfTheCurrentCycleIsRecognized();
    void movedDecoderKeepsItsState();
    void moreThan64PartsComplete();
    void anyOrderLossAndDuplicationGivesWholeCyclesInOrder();
    void workNeedsNoHeap();
};

static const FrameSeed Seed{0x8F3A61C2D4E5B097, 7, 0x0163FF7E025F2E30};

static QByteArray payloadOf(std::uint64_t cycle, std::uint32_t size)
{
    QByteArray payload(int(size), '\0');
    for (int i = 0; i < payload.size(); ++i)
        payload[i] = char(cycle * 31 + std::uint64_t(i) * 7);
    return payload;
}

static QByteArray frameOf(const std::vector<std::uint32_t> &borders, std::size_t part, std::uint64_t cycle,
                          std::uint8_t flags = 0)
{
    FrameHeader header;
    header.cycle = std::uint32_t(cycle);
    header.flags = flags;
    return vectors::encode(FrameEncoder(FrameKind::Inputs, Seed, borders), part, header,
                           payloadOf(cycle, borders.back()));
}

static bool shows(const FrameDecoder &decoder, std::uint32_t size, std::uint64_t cycle)
{
    return decoder.cycle() == cycle && QByteArray(decoder.payload(), int(size)) == payloadOf(cycle, size);
}

void tst_FrameSequence::cycleIsExtendedToTheNearest_data()
{
    QTest::addColumn<quint32>("wire");
    QTest::addColumn<quint64>("reference");
    QTest::addColumn<quint64>("cycle");
    const quint64 wrap = Q_UINT64_C(1) << 32;
    QTest::newRow("same") << 5u << Q_UINT64_C(5) << Q_UINT64_C(5);
    QTest::newRow("next") << 6u << Q_UINT64_C(5) << Q_UINT64_C(6);
    QTest::newRow("last") << 4u << Q_UINT64_C(5) << Q_UINT64_C(4);
    QTest::newRow("over the wrap") << 0u << wrap - 1 << wrap;
    QTest::newRow("back over the wrap") << 0xFFFFFFFFu << wrap << wrap - 1;
    QTest::newRow("far on") << 3u << 1000 * wrap + 1 << 1000 * wrap + 3;
    QTest::newRow("farthest ahead") << 0x7FFFFFFFu << wrap << wrap + 0x7FFFFFFF;
    QTest::newRow("half way round is behind") << 0x80000000u << wrap << wrap - 0x80000000;
}

void tst_FrameSequence::cycleIsExtendedToTheNearest()
{
    QFETCH(quint32, wire);
    QFETCH(quint64, reference);
    QFETCH(quint64, cycle);
    QCOMPARE(quint64(extendCycle(wire, reference)), cycle);
}

void tst_FrameSequence::cyclesRunOnBeyond32Bits()
{
    FrameDecoder decoder(FrameKind::Inputs, Seed, {0, 4});
    const std::uint64_t first = 0xFFFFFFF0;
    decoder.restart(first);
    for (std::uint64_t cycle = first; cycle < first + 40; ++cycle) {
        QCOMPARE(vectors::decode(decoder, frameOf({0, 4}, 0, cycle)), FrameStatus::Complete);
        QVERIFY(shows(decoder, 4, cycle));
    }
}

void tst_FrameSequence::restartAcceptsCyclesFromTheFirstCycle()
{
    const std::vector<std::uint32_t> borders{0, 4};
    FrameDecoder decoder(FrameKind::Inputs, Seed, borders);
    QCOMPARE(vectors::decode(decoder, frameOf(borders, 0, 1000)), FrameStatus::Complete);

    decoder.restart(100);
    QCOMPARE(vectors::decode(decoder, frameOf(borders, 0, 99)), FrameStatus::Old);
    QCOMPARE(vectors::decode(decoder, frameOf(borders, 0, 103)), FrameStatus::Complete);
    QCOMPARE(vectors::decode(decoder, frameOf(borders, 0, 100)), FrameStatus::Old);

    decoder.restart(103);
    QCOMPARE(vectors::decode(decoder, frameOf(borders, 0, 103)), FrameStatus::Complete);
    decoder.restart(104);
    QCOMPARE(vectors::decode(decoder, frameOf(borders, 0, 103)), FrameStatus::Old);
}

void tst_FrameSequence::restartForgetsTheIncompleteCycle()
{
    const std::vector<std::uint32_t> borders{0, 4, 8};
    FrameDecoder decoder(FrameKind::Inputs, Seed, borders);
    QCOMPARE(vectors::decode(decoder, frameOf(borders, 0, 5)), FrameStatus::Incomplete);
    decoder.restart(5);
    QCOMPARE(vectors::decode(decoder, frameOf(borders, 1, 5)), FrameStatus::Incomplete);
    QCOMPARE(vectors::decode(decoder, frameOf(borders, 0, 5)), FrameStatus::Complete);
}

void tst_FrameSequence::cyclesBelowZeroAreRejected()
{
    FrameDecoder decoder(FrameKind::Inputs, Seed, {0, 4});
    QCOMPARE(vectors::decode(decoder, frameOf({0, 4}, 0, 0xFFFFFFFF)), FrameStatus::Old);
    QCOMPARE(vectors::decode(decoder, frameOf({0, 4}, 0, 0)), FrameStatus::Complete);
}

void tst_FrameSequence::earlyFramesChangeNothing_data()
{
    QTest::addColumn<quint64>("first");
    QTest::newRow("from the first cycle on") << Q_UINT64_C(0);
    QTest::newRow("over the wrap") << Q_UINT64_C(0xFFFFFFFF);
    QTest::newRow("far on") << Q_UINT64_C(0x7FFFFFFFF);
}

void tst_FrameSequence::earlyFramesChangeNothing()
{
    QFETCH(quint64, first);
    const std::vector<std::uint32_t> borders{0, 4, 8};
    FrameDecoder decoder(FrameKind::Inputs, Seed, borders);
    decoder.restart(first);
    const auto take = [&](std::uint64_t cycle, std::size_t part, std::uint64_t end) {
        const QByteArray frame = frameOf(borders, part, cycle);
        return decoder.decode(frame.constData(), std::size_t(frame.size()), end);
    };
    QCOMPARE(take(first, 0, first), FrameStatus::Early);
    QCOMPARE(take(first - 1, 0, first), FrameStatus::Old);
    QCOMPARE(take(first, 0, first + 1), FrameStatus::Incomplete);
    for (std::uint64_t ahead : {1u, 2u, 1'000'000'000u, 0x7FFFFFFFu})
        QCOMPARE(take(first + ahead, 0, first + 1), FrameStatus::Early);
    QCOMPARE(take(first, 1, first + 1), FrameStatus::Complete);
    QVERIFY(shows(decoder, 8, first));
    QCOMPARE(decoder.received().cycle, first);
    QCOMPARE(take(first, 0, first + 2), FrameStatus::Duplicate);
    QCOMPARE(take(first + 1, 0, first + 2), FrameStatus::Incomplete);
    QCOMPARE(take(first + 1, 1, first + 2), FrameStatus::Complete);
}

void tst_FrameSequence::lastPayloadStaysWholeWhilePartsArrive()
{
    const std::vector<std::uint32_t> borders{0, 8, 16, 24};
    FrameDecoder decoder(FrameKind::Inputs, Seed, borders);
    for (std::size_t part : {2, 0, 1})
        vectors::decode(decoder, frameOf(borders, part, 1));
    QVERIFY(shows(decoder, 24, 1));
    for (std::size_t part : {1, 2}) {
        QCOMPARE(vectors::decode(decoder, frameOf(borders, part, 2)), FrameStatus::Incomplete);
        QVERIFY(shows(decoder, 24, 1));
        QCOMPARE(decoder.header().cycle, 1u);
    }
    QCOMPARE(vectors::decode(decoder, frameOf(borders, 0, 2)), FrameStatus::Complete);
    QVERIFY(shows(decoder, 24, 2));
}

void tst_FrameSequence::resentFrameOfTheCurrentCycleIsRecognized()
{
    const std::vector<std::uint32_t> borders{0, 4, 8};
    FrameDecoder decoder(FrameKind::Inputs, Seed, borders);
    vectors::decode(decoder, frameOf(borders, 0, 3));
    vectors::decode(decoder, frameOf(borders, 1, 3));
    QCOMPARE(vectors::decode(decoder, frameOf(borders, 0, 3)), FrameStatus::Duplicate);
    QCOMPARE(decoder.received().flags, std::uint8_t(0));
    QCOMPARE(vectors::decode(decoder, frameOf(borders, 0, 3, ResentFlag)), FrameStatus::Duplicate);
    QCOMPARE(decoder.received().flags, std::uint8_t(ResentFlag));
    QCOMPARE(decoder.received().cycle, std::uint32_t(decoder.cycle()));
    QCOMPARE(decoder.header().flags, std::uint8_t(0));
    QCOMPARE(vectors::decode(decoder, frameOf(borders, 1, 3, ResentFlag)), FrameStatus::Duplicate);
    QCOMPARE(decoder.received().flags, std::uint8_t(ResentFlag | PartFlag));
}

void tst_FrameSequence::movedDecoderKeepsItsState()
{
    const std::vector<std::uint32_t> borders{0, 4, 8};
    FrameDecoder first(FrameKind::Inputs, Seed, borders);
    vectors::decode(first, frameOf(borders, 0, 1));
    FrameDecoder second = std::move(first);
    QCOMPARE(vectors::decode(second, frameOf(borders, 1, 1)), FrameStatus::Complete);
    QVERIFY(shows(second, 8, 1));
}

void tst_FrameSequence::moreThan64PartsComplete()
{
    std::vector<std::uint32_t> borders;
    for (std::uint32_t part = 0; part <= 130; ++part)
        borders.push_back(part * 3);
    FrameDecoder decoder(FrameKind::Inputs, Seed, borders);
    for (std::uint64_t cycle = 0; cycle < 3; ++cycle) {
        for (std::size_t part = 129; part > 0; --part)
            QCOMPARE(vectors::decode(decoder, frameOf(borders, part, cycle)), FrameStatus::Incomplete);
        QCOMPARE(vectors::decode(decoder, frameOf(borders, 64, cycle)), FrameStatus::Duplicate);
        QCOMPARE(vectors::decode(decoder, frameOf(borders, 0, cycle)), FrameStatus::Complete);
        QVERIFY(shows(decoder, borders.back(), cycle));
    }
}

namespace {

// What the decoder has to say, in the plainest words.
class Model
{
public:
    explicit Model(std::size_t parts)
        : m_parts(parts)
    {
    }

    FrameStatus take(std::int64_t cycle, std::size_t part)
    {
        if (cycle == m_complete)
            return FrameStatus::Duplicate;
        if (cycle < m_newest)
            return FrameStatus::Old;
        if (cycle > m_newest)
            m_seen.clear();
        m_newest = cycle;
        if (!m_seen.insert(part).second)
            return FrameStatus::Duplicate;
        if (m_seen.size() < m_parts)
            return FrameStatus::Incomplete;
        m_complete = cycle;
        return FrameStatus::Complete;
    }
    std::int64_t complete() const { return m_complete; }

private:
    std::size_t m_parts;
    std::int64_t m_newest = -1;
    std::int64_t m_complete = -1;
    std::set<std::size_t> m_seen;
};

}  // namespace

void tst_FrameSequence::anyOrderLossAndDuplicationGivesWholeCyclesInOrder()
{
    std::mt19937 random(5);
    const std::vector<std::vector<std::uint32_t>> layouts{{0, 0}, {0, 6}, {0, 4, 6}, {0, 4, 8, 12, 13}};
    for (int round = 0; round < 200; ++round) {
        const std::vector<std::uint32_t> &borders = layouts[std::size_t(round) % layouts.size()];
        const std::size_t parts = borders.size() - 1;
        const std::uint64_t first = random() % 2 == 0 ? 0 : 0xFFFFFFF0;
        FrameDecoder decoder(FrameKind::Inputs, Seed, borders);
        decoder.restart(first);
        Model model(parts);
        std::int64_t now = 0;
        for (int i = 0; i < 200; ++i) {
            now += random() % (2 * parts) == 0 ? 1 + random() % 2 : 0;
            const std::int64_t cycle = std::max<std::int64_t>(0, now - (random() % 4 == 0 ? random() % 3 : 0));
            const std::size_t part = random() % parts;
            QByteArray frame = frameOf(borders, part, first + std::uint64_t(cycle), random() % 2 == 0 ? ResentFlag : 0);
            if (random() % 8 == 0) {
                const int place = int(random() % std::uint32_t(frame.size()));
                frame[place] = char(frame.at(place) ^ char(1 + random() % 255));
                QVERIFY(vectors::isRefused(vectors::decode(decoder, frame)));
                continue;
            }
            QCOMPARE(vectors::name(vectors::decode(decoder, frame)), vectors::name(model.take(cycle, part)));
            QVERIFY(model.complete() < 0 || shows(decoder, borders.back(), first + std::uint64_t(model.complete())));
        }
    }
}

void tst_FrameSequence::workNeedsNoHeap()
{
    const std::vector<std::uint32_t> borders{0, 1000, 2000, 2500};
    const FrameEncoder encoder(FrameKind::Inputs, Seed, borders);
    FrameDecoder decoder(FrameKind::Inputs, Seed, borders);
    const std::vector<char> payload(2500, 'x');
    std::vector<char> frame(MaximumCyclicFrame);
    std::size_t complete = 0;

    const ThreadCosts before = ThreadCosts::ofThisThread();
    for (std::uint32_t cycle = 0; cycle < 1000; ++cycle) {
        FrameHeader header;
        header.cycle = cycle;
        for (std::size_t part = 0; part < encoder.partCount(); ++part) {
            encoder.encode(part, header, payload.data(), frame.data());
            complete += decoder.decode(frame.data(), encoder.partSize(part)) == FrameStatus::Complete;
            complete += decoder.decode(frame.data(), 20) == FrameStatus::Complete;
        }
    }
    decoder.restart(7);
    const ThreadCosts spent = ThreadCosts::ofThisThread() - before;
    QCOMPARE(complete, std::size_t(1000));
    if (!ThreadCosts::areCounted())
        QSKIP("the sanitizer owns malloc", "");
    QCOMPARE(spent.allocations, std::uint64_t(0));
    QVERIFY(before.allocations > 0);  // the counter counts
}

QTEST_APPLESS_MAIN(tst_FrameSequence)
#include "tst_FrameSequence.moc"
