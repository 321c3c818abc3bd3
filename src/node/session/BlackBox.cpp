// SPDX-License-Identifier: Apache-2.0
#include "BlackBox.h"

#include "node/cycle/NodeRegistry.h"
#include "node/cycle/RingReader.h"

#include <QtCore/QFile>

#include <algorithm>
#include <cstring>
#include <utility>

namespace qplc {

namespace {

constexpr int BlackBoxLooks = 200;              // [ms]
constexpr std::size_t SmallestPart = 1U << 16;  // [byte]

/// Calls \a take(kind, body, size) for the records from the cycle \a first on: before them, the
/// nodes that were there.
template<typename Take>
void forEachRecord(RingReader *reader, std::uint64_t first, std::uint64_t last, Take take)
{
    QByteArray roster;
    bool hasBegun = false;
    for (RingReader::Result result = reader->next(); result != RingReader::Nothing; result = reader->next()) {
        if (result != RingReader::Found)
            continue;
        if (reader->kind() == RecordKind::Cycle) {
            CycleView view;
            if (!CycleView::read(reader->body(), reader->size(), &view) || view.cycle.number < first)
                continue;
            if (view.cycle.number > last)
                return;
            if (!hasBegun && !roster.isEmpty())
                take(RecordKind::Roster, roster.constData(), std::uint32_t(roster.size()));
            hasBegun = true;
        } else if (!hasBegun) {
            if (reader->kind() == RecordKind::Roster)
                roster = QByteArray(reader->body(), int(reader->size()));
            continue;
        }
        take(reader->kind(), reader->body(), reader->size());
    }
}

}  // namespace

/// What the thread writes, and what has become of it.
struct BlackBox::Part
{
    QByteArray ring;
    QByteArray file;
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    QString reason;
    QString error;
};

BlackBox::BlackBox(Journal &journal, PhaseRing &ring, Cycles cycles)
    : m_journal(journal)
    , m_phaseRing(ring)
    , m_cycles(std::move(cycles))
{
    m_timer.setInterval(BlackBoxLooks);
    QObject::connect(&m_timer, &QTimer::timeout, [this] { look(); });
}

void BlackBox::watch(const std::shared_ptr<RecordRing> &ring, std::chrono::nanoseconds period)
{
    m_ring = ring;
    m_reason.clear();
    m_marks = 0;
    m_parts = 0;
    const auto cyclesIn = [period](std::chrono::nanoseconds time) { return std::uint64_t(time / period); };
    m_before = cyclesIn(Before);
    m_after = cyclesIn(After);
    if (ring)
        m_timer.start();
    else
        m_timer.stop();
}

/// Until the part is written, the ring stays, whatever happens.
void BlackBox::keep(const QString &reason)
{
    const std::shared_ptr<RecordRing> ring = m_ring.lock();
    if (!ring)
        return;
    const std::uint64_t newest = m_cycles.newest();
    if (m_reason.isEmpty()) {
        m_reason = reason;
        m_first = newest - std::min(newest, m_before);
        m_place = ring->head();
    }
    m_last = newest + m_after;
    m_phaseRing.setKept(true);
}

void BlackBox::look()
{
    m_worker.collect();
    const std::shared_ptr<RecordRing> ring = m_ring.lock();
    if (!ring) {
        m_timer.stop();
        return;
    }
    const std::uint32_t marks = ring->memory().header()->wishes.load(std::memory_order_relaxed);
    if (std::exchange(m_marks, marks) != marks)
        keep(QStringLiteral("a mark"));
    if (!m_reason.isEmpty() && !m_isWriting && m_cycles.areRunning() && isDue(*ring))
        begin();
}

/// At high rates, the ring is shorter than what is wanted: a half of it is left for what was
/// before.
bool BlackBox::isDue(const RecordRing &ring) const
{
    const std::uint64_t written = ring.head() - m_place;
    return m_cycles.newest() > m_last || written > ring.capacity() / 2;
}

void BlackBox::begin()
{
    const std::shared_ptr<RecordRing> ring = m_ring.lock();
    const QString reason = std::exchange(m_reason, QString());
    if (ring->isRead()) {  // a recorder has it, and marks its files
        m_phaseRing.setKept(false);
        return;
    }
    const auto part = std::make_shared<Part>();
    part->ring = ring->memory().file();
    part->file = part->ring + "-part" + QByteArray::number(++m_parts);
    part->first = m_first;
    part->last = m_last;
    part->reason = reason;
    m_isWriting = true;
    m_worker.begin([part] { write(part.get()); }, [this, part] { finish(*part); });
}

void BlackBox::finish(const Part &part)
{
    m_isWriting = false;
    if (!part.error.isEmpty()) {
        m_journal.tell(JournalEvent::Warning, JournalEvent::State, NodeRegistry::masterName(),
                       QStringLiteral("the cycles around %1 cannot be kept: %2").arg(part.reason, part.error));
        return;
    }
    m_phaseRing.setKept(!m_reason.isEmpty());
    PhaseRing::removeDead();
    m_journal.tell(JournalEvent::Info, JournalEvent::State, NodeRegistry::masterName(),
                   QStringLiteral("nobody records: the cycles around %1 are kept in memory; qtplc record FOLDER/ "
                                  "writes them into a file")
                       .arg(part.reason));
}

/// Twice over the ring: how much there is, and what.
void BlackBox::write(Part *part)
{
    if (RingReader reader; reader.open(part->ring, &part->error))
        copy(&reader, part);
}

void BlackBox::copy(RingReader *reader, Part *part)
{
    std::size_t size = 0;
    forEachRecord(reader, part->first, part->last,
                  [&size](RecordKind, const char *, std::uint32_t body) { size += sizeof(RecordHead) + body; });
    if (size == 0) {
        part->error = QStringLiteral("the ring has none of them");
        return;
    }
    std::size_t capacity = SmallestPart;
    while (capacity < size)
        capacity *= 2;
    const RingMemory::Header &source = *reader->memory().header();
    RingMemory memory;
    if (!memory.createHidden(part->file, capacity, reader->memory().description(), &part->error,
                             std::size_t(reader->memory().texts().capacity)))
        return;
    const auto writerOf = [](RingRegion region, std::size_t most) {
        return [writer = RegionWriter(region), left = most](RecordKind kind, const char *body,
                                                            std::uint32_t bodySize) mutable {
            const std::uint32_t bytes = std::uint32_t(sizeof(RecordHead)) + bodySize;
            if (bytes > left)  // it was written meanwhile
                return;
            left -= bytes;
            std::memcpy(writer.begin(bytes), body, bodySize);
            writer.commit(kind, bytes);
        };
    };
    reader->RegionReader::open(reader->memory().cycles());
    forEachRecord(reader, part->first, part->last, writerOf(memory.cycles(), size));
    // What was done and told before says why, too.
    auto writeText = writerOf(memory.texts(), std::size_t(memory.texts().capacity));
    RegionReader &texts = reader->texts();
    for (auto result = texts.next(); result != RegionReader::Nothing; result = texts.next()) {
        if (result == RegionReader::Found)
            writeText(texts.kind(), texts.body(), texts.size());
    }
    memory.header()->startTime = source.startTime;
    memory.header()->isCut = 1;
    memory.publish(part->file, &part->error);
}

}  // namespace qplc
