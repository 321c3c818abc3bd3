// SPDX-License-Identifier: Apache-2.0
#include "RemoteRecorder.h"

#include "protocol/messages/Vocabulary.h"
#include "realtime/TimeSource.h"
#include "signals/MessageText.h"

#include <QtCore/QFile>

#include <algorithm>
#include <cstring>

namespace qplc {

namespace {

namespace words = messages::errorWord;

constexpr int LookForSilence = 1000;  // [ms]

QString nameOf(const QByteArray &file)
{
    return QFile::decodeName(file.mid(file.lastIndexOf('/') + 1));
}

/// Whether a record begins there, or the next one will.
bool isBorder(const RingRegion &region, std::uint64_t place, std::uint64_t head)
{
    RecordHead record;
    if (place == head)
        return true;
    std::memcpy(&record, region.at(place), sizeof record);
    return record.commit == place;
}

/// \return false: they have been replaced meanwhile
bool copy(const RingRegion &region, std::uint64_t from, std::uint64_t size, QByteArray *bytes)
{
    *bytes = QByteArray(region.at(from), int(size));
    std::atomic_thread_fence(std::memory_order_acquire);
    return from >= region.marks->oldest.load(std::memory_order_relaxed);
}

/// As far as it may be shown.
RecorderReport reportOf(const messages::RecorderEntry &entry)
{
    RecorderReport report = toReport(entry);
    report.file = printable(report.file);
    report.error = printable(report.error);
    return report;
}

}  // namespace

RemoteRecorder::RemoteRecorder(std::function<QString()> ringUnderWay)
    : m_ringUnderWay(std::move(ringUnderWay))
{
    m_timer.setInterval(LookForSilence);
    QObject::connect(&m_timer, &QTimer::timeout, [this] { look(monotonicNow()); });
}

// ---- rings ----

void RemoteRecorder::begin(const QString &file, std::int64_t now)
{
    m_rings.push_back({QFile::encodeName(file), nullptr});
    if (m_rings.size() > MostRings) {
        leave(&m_rings.front());
        m_rings.pop_front();
    }
    Refusal refusal;  // another recorder may have been faster: who asks is told
    if (!m_name.isEmpty() && now - m_heard < Attention)
        attach(&m_rings.back(), &refusal);
}

RemoteRecorder::Ring *RemoteRecorder::find(const QString &name)
{
    const auto found
        = std::find_if(m_rings.rbegin(), m_rings.rend(), [&](const Ring &ring) { return nameOf(ring.file) == name; });
    return found == m_rings.rend() ? nullptr : &*found;
}

bool RemoteRecorder::attach(Ring *ring, Refusal *refusal)
{
    if (ring->reader)
        return true;
    auto reader = std::make_unique<RingReader>();
    QString error;
    if (!reader->open(ring->file, &error)) {
        *refusal = {words::unknownRing, QStringLiteral("the ring '%1' is not there any more").arg(nameOf(ring->file))};
        return false;
    }
    if (!reader->attach()) {
        *refusal = {words::wrongState,
                    QStringLiteral("a recorder on the computer of the master records the ring '%1'; stop it first")
                        .arg(nameOf(ring->file))};
        return false;
    }
    ring->reader = std::move(reader);
    m_timer.start();
    return true;
}

bool RemoteRecorder::isUnderWay(const Ring &ring) const
{
    return m_ringUnderWay() == QFile::decodeName(ring.file);
}

/// Nobody has recorded what is left. The ring of a phase that is over stays for the next recorder,
/// as if this one had been killed.
void RemoteRecorder::leave(Ring *ring)
{
    if (ring->reader && isUnderWay(*ring))
        ring->reader->detach();
    ring->reader.reset();
}

/// The recorder needs no more of it.
void RemoteRecorder::end(Ring *ring)
{
    RingMemory &memory = ring->reader->memory();
    const RingMarks &marks = *memory.cycles().marks;
    const bool isSaved = marks.read.load() == marks.head.load();
    ring->reader->detach();
    if (isSaved && !isUnderWay(*ring))
        memory.remove();
    ring->reader.reset();
}

QString RemoteRecorder::behind(std::int64_t now) const
{
    const bool isBehind = !m_rings.empty() && m_rings.back().reader && now - m_heard < Attention;
    return isBehind ? m_name : QString();
}

void RemoteRecorder::look(std::int64_t now)
{
    if (now - m_heard < Silence)
        return;
    for (Ring &ring : m_rings)
        leave(&ring);
    m_name.clear();
    m_timer.stop();
}

// ---- questions ----

bool RemoteRecorder::isAnother(const Asker &asker, std::int64_t now) const
{
    const bool isSame = m_connection == asker.connection || (!asker.key.isEmpty() && m_key == asker.key);
    return !m_name.isEmpty() && m_connection && !isSame && now - m_heard < Silence;
}

std::optional<messages::Records> RemoteRecorder::answer(const messages::GetRecords &question, const Asker &asker,
                                                        std::int64_t now, Refusal *refusal)
{
    if (isAnother(asker, now)) {
        *refusal = {words::wrongState,
                    QStringLiteral("%1 records this plant already; stop it, or wait until it is gone").arg(m_name)};
        return std::nullopt;
    }
    Ring *ring = question.ring.isEmpty() && !m_rings.empty() ? &m_rings.back() : find(question.ring);
    if (!ring && !question.ring.isEmpty()) {
        *refusal = {words::unknownRing,
                    QStringLiteral("this master has no ring '%1'; ask without a name for the newest one")
                        .arg(quoted(question.ring))};
        return std::nullopt;
    }
    m_connection = asker.connection;
    m_key = asker.key;
    m_name = asker.name;
    m_heard = now;
    if (!ring || (question.ring.isEmpty() && !QFile::exists(QFile::decodeName(ring->file))))
        return messages::Records();
    if (!attach(ring, refusal))
        return std::nullopt;
    RingMemory &memory = ring->reader->memory();
    messages::Records answer;
    answer.ring = nameOf(ring->file);
    answer.part = question.part;
    answer.startTime = quint64(memory.header()->startTime);
    if (question.recorder)
        ring->reader->report(reportOf(*question.recorder));
    if (question.part == messages::RingPart::Description) {
        const QByteArray text = memory.description();
        answer.from = std::min<quint64>(question.from.value_or(0), quint64(text.size()));
        const auto most = std::min<quint64>(question.bytes, quint64(text.size()) - answer.from);
        answer.bytes = text.mid(int(answer.from), m_bytes.takeUpTo(now, int(most)));
        answer.head = answer.capacity = quint64(text.size());
    } else if (!read(question.part == messages::RingPart::Cycles ? memory.cycles() : memory.texts(), question, now,
                     &answer, refusal)) {
        return std::nullopt;
    }
    if (question.ends)
        end(ring);
    return answer;
}

/// Only what is behind `read` is sure to stay while it is copied. Bytes before it may still be
/// there: a recorder that was away goes on with them.
bool RemoteRecorder::read(const RingRegion &region, const messages::GetRecords &question, std::int64_t now,
                          messages::Records *answer, Refusal *refusal)
{
    answer->capacity = region.capacity;
    if (region.capacity == 0)
        return true;
    const std::uint64_t head = region.marks->head.load(std::memory_order_acquire);
    std::uint64_t read = region.marks->read.load();
    const std::uint64_t from = question.from.value_or(messages::Hex64(read));
    const std::uint64_t saved = question.saved.value_or(messages::Hex64(0));
    if (from > head || saved > from) {
        *refusal = {words::malformedMessage,
                    QStringLiteral("the ring '%1' ends at %2; 'from' (%3) is at most that, and 'saved' (%4) at most "
                                   "'from'")
                        .arg(answer->ring)
                        .arg(head)
                        .arg(from)
                        .arg(saved)};
        return false;
    }
    if (saved > read && isBorder(region, saved, head)) {
        region.marks->read.store(saved, std::memory_order_release);
        read = saved;
    }
    answer->head = head;
    answer->from = from >= region.marks->oldest.load(std::memory_order_acquire) ? from : read;
    const auto most = std::min<std::uint64_t>(question.bytes, head - answer->from);
    const int size = m_bytes.takeUpTo(now, int(most));
    if (copy(region, answer->from, std::uint64_t(size), &answer->bytes))
        return true;
    answer->from = read;
    copy(region, read, std::min(std::uint64_t(size), head - read), &answer->bytes);
    return true;
}

}  // namespace qplc
