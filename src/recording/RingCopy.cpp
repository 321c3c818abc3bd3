// SPDX-License-Identifier: Apache-2.0
#include "RingCopy.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QRegularExpression>

#include <algorithm>
#include <cstring>
#include <unistd.h>

namespace qplc {

namespace {

using messages::RingPart;

constexpr std::uint64_t LargestDescription = 64U << 20;  // [byte]
constexpr std::uint64_t LargestCapacity = std::uint64_t(1) << 30;

constexpr RingPart parts[] = {RingPart::Cycles, RingPart::Texts};

bool isCapacity(std::uint64_t capacity)
{
    return capacity >= 4096 && capacity <= LargestCapacity && (capacity & (capacity - 1)) == 0;
}

bool refuse(const QString &what, QString *error)
{
    *error = QStringLiteral("the master does not answer as a ring would: %1").arg(what);
    return false;
}

QString prefix()
{
    return QStringLiteral("qtplc-copy-%1-").arg(::getuid());
}

}  // namespace

/// A recorder that has not attached itself yet has saved nothing.
std::uint64_t RingCopy::Part::saved() const
{
    return std::clamp(region.marks->read.load(std::memory_order_acquire), base, received);
}

/// What is missing in between is a gap for the recorder.
void RingCopy::Part::leap()
{
    base = received = *jump;
    jump.reset();
    region.marks->oldest.store(base, std::memory_order_release);
    region.marks->head.store(base, std::memory_order_release);
}

RingCopy::RingCopy(const QString &computer)
    : m_computer(computer)
{
}

RingCopy::~RingCopy()
{
    m_memory.remove();
}

void RingCopy::removeDead()
{
    const QDir folder(QFile::decodeName(RingMemory::folder()));
    const QStringList names = folder.entryList({prefix() + QLatin1Char('*')}, QDir::Files);
    for (const QString &name : names) {
        const QString file = folder.filePath(name);
        const RingMemory::Use use = RingMemory::useOf(QFile::encodeName(file));
        if (use == RingMemory::Dead || use == RingMemory::DeadAndRecorded)
            QFile::remove(file);
    }
}

// ---- questions ----

std::optional<messages::GetRecords> RingCopy::question(std::int64_t now)
{
    if (m_asked)
        return std::nullopt;
    m_asked = m_state == Looking || m_state == Opening ? openingQuestion(now)
        : m_state == Ready                             ? recordsQuestion(now)
                                                       : std::nullopt;
    return m_asked;
}

/// Capacity and begin of a part come without bytes: there is no place for them yet.
std::optional<messages::GetRecords> RingCopy::openingQuestion(std::int64_t now)
{
    if (now < m_due)
        return std::nullopt;
    messages::GetRecords question;
    question.ring = m_ring;
    if (m_descriptionSize && quint64(m_description.size()) == *m_descriptionSize) {
        question.part = parts[m_parts[0].hasBegun ? 1 : 0];
        question.bytes = 0;
        return question;
    }
    question.part = RingPart::Description;
    question.from = quint64(m_description.size());
    return question;
}

/// Without room, or with nothing to come, too: the master hears what is in safety, and that we are
/// there.
std::optional<messages::GetRecords> RingCopy::recordsQuestion(std::int64_t now)
{
    const bool wasRecorded = std::exchange(m_isRecorded, m_memory.header()->cycles.isRead.load() != 0);
    m_isEnding = !m_isRecorded && (wasRecorded || m_isEnding);
    if (m_isEnding) {
        messages::GetRecords last = end();
        addReport(&last, now);
        return last;
    }
    for (std::size_t i = 0; m_isRecorded && i < m_parts.size(); ++i) {
        const std::size_t number = (m_next + i) % m_parts.size();
        Part &part = m_parts[number];
        if (part.capacity == 0 || now < part.due)
            continue;
        if (part.jump && part.saved() == part.received)
            part.leap();
        m_next = number + 1;
        messages::GetRecords question;
        question.ring = m_ring;
        question.part = parts[number];
        question.from = part.received;
        question.saved = part.saved();
        const std::uint64_t room = part.jump ? 0 : part.region.capacity - (part.received - part.saved());
        question.bytes = std::min<quint64>(room, messages::GetRecords::most);
        if (now - m_reported >= ReportEach)
            addReport(&question, now);
        return question;
    }
    return std::nullopt;
}

messages::GetRecords RingCopy::end()
{
    messages::GetRecords last;
    last.ring = m_ring;
    last.bytes = 0;
    last.ends = true;
    if (m_state == Ready) {
        last.from = m_parts[0].received;
        last.saved = m_parts[0].saved();
    }
    return last;
}

void RingCopy::addReport(messages::GetRecords *question, std::int64_t now)
{
    const std::optional<RecorderReport> report = m_memory.header()->report.read();
    m_reported = now;
    if (!report)
        return;
    question->recorder = toEntry(*report);
    if (!report->file.isEmpty())
        question->recorder->file.prepend(m_computer + QLatin1Char(':'));
}

// ---- answers ----

bool RingCopy::take(const messages::Records &answer, std::int64_t now, QString *error)
{
    if (!m_asked)
        return refuse(QStringLiteral("nothing was asked"), error);
    const messages::GetRecords asked = *std::exchange(m_asked, std::nullopt);
    if (asked.ends) {
        m_isEnding = false;
        m_state = m_hasEnd ? Ended : m_state;
        return true;
    }
    if (m_state == Looking && answer.ring.isEmpty()) {
        m_due = now + LookForRings;
        return true;
    }
    if (m_state == Looking && !takeName(answer, error))
        return false;
    if (answer.ring != m_ring || answer.part != asked.part || quint64(answer.bytes.size()) > asked.bytes)
        return refuse(QStringLiteral("it has answered another question"), error);
    if (m_state == Ready)
        m_memory.header()->startTime = std::int64_t(answer.startTime);
    if (asked.part == RingPart::Description)
        return takeDescription(answer, error);
    Part &part = m_parts[asked.part == RingPart::Cycles ? 0 : 1];
    return part.hasBegun ? takeRecords(&part, answer, now, error) : beginPart(&part, answer, error);
}

/// It becomes a part of the name of a file.
bool RingCopy::takeName(const messages::Records &answer, QString *error)
{
    static const QRegularExpression name(QStringLiteral("^[A-Za-z0-9_-]{1,200}$"));
    if (!name.match(answer.ring).hasMatch())
        return refuse(QStringLiteral("its ring has a name that no ring has"), error);
    m_ring = answer.ring;
    m_state = Opening;
    return true;
}

bool RingCopy::takeDescription(const messages::Records &answer, QString *error)
{
    if (answer.from != quint64(m_description.size()) || answer.head > LargestDescription
        || answer.from + quint64(answer.bytes.size()) > answer.head
        || m_descriptionSize.value_or(answer.head) != answer.head)
        return refuse(QStringLiteral("its description does not fit together"), error);
    m_descriptionSize = answer.head;
    m_description += answer.bytes;
    return true;
}

bool RingCopy::beginPart(Part *part, const messages::Records &answer, QString *error)
{
    const bool isTexts = part == &m_parts[1];
    if (!isCapacity(answer.capacity) && !(isTexts && answer.capacity == 0))
        return refuse(QStringLiteral("its capacity is %1 bytes").arg(answer.capacity), error);
    part->capacity = answer.capacity;
    part->base = part->received = answer.from;
    part->hasBegun = true;
    return !isTexts || make(error);
}

bool RingCopy::make(QString *error)
{
    const QByteArray file = RingMemory::folder() + '/' + QFile::encodeName(prefix() + m_ring);
    const RingMemory::Use use = RingMemory::useOf(file);
    if (use == RingMemory::Alive || use == RingMemory::BeingRead) {
        *error = QStringLiteral("another recorder on this computer records the ring '%1'; stop it first").arg(m_ring);
        return false;
    }
    QFile::remove(QFile::decodeName(file));
    if (!m_memory.createHidden(file, std::size_t(m_parts[0].capacity), m_description, error,
                               std::size_t(m_parts[1].capacity)))
        return false;
    m_parts[0].region = m_memory.cycles();
    m_parts[1].region = m_memory.texts();
    for (Part &part : m_parts) {
        RingMarks &marks = *part.region.marks;
        marks.oldest = marks.head = marks.read = part.base;
    }
    m_description.clear();
    if (!m_memory.publish(file, error))
        return false;
    m_file = file;
    m_state = Ready;
    return true;
}

/// Who was away for too long finds newer records than those that it needs.
bool RingCopy::takeRecords(Part *part, const messages::Records &answer, std::int64_t now, QString *error)
{
    part->due = answer.bytes.isEmpty() ? now + LookForRecords : now;
    RingMarks &marks = *part->region.marks;
    if (answer.from < part->received || answer.from > answer.head)
        return refuse(QStringLiteral("its records begin at %1 instead of %2").arg(answer.from).arg(part->received),
                      error);
    if (answer.from > part->received) {
        part->received = marks.head.load(std::memory_order_relaxed);  // the rest of a record is lost, too
        part->jump = answer.from;
        part->due = now + LookForRecords;
        return true;
    }
    const auto size = std::uint64_t(answer.bytes.size());
    if (part->received + size - marks.oldest.load(std::memory_order_relaxed) > part->region.capacity) {
        // As RegionWriter::begin() does: readers look at `oldest` after they have copied a record.
        marks.oldest.store(part->saved(), std::memory_order_relaxed);
        std::atomic_thread_fence(std::memory_order_release);
    }
    std::memcpy(part->region.at(part->received), answer.bytes.constData(), std::size_t(size));
    part->received += size;
    return commit(part, error);
}

/// A record appears when all of it is there.
bool RingCopy::commit(Part *part, QString *error)
{
    RingMarks &marks = *part->region.marks;
    std::uint64_t head = marks.head.load(std::memory_order_relaxed);
    RecordHead record;
    while (head + sizeof record <= part->received) {
        std::memcpy(&record, part->region.at(head), sizeof record);
        if (record.commit != head || record.size < sizeof record || record.size % 8 != 0
            || record.size > part->region.capacity)
            return refuse(QStringLiteral("there is no record at %1").arg(head), error);
        if (head + record.size > part->received)
            break;
        head += record.size;
        m_hasEnd = m_hasEnd || record.kind == RecordKind::End;
    }
    marks.head.store(head, std::memory_order_release);
    return true;
}

void RingCopy::abandon()
{
    m_asked.reset();
    m_state = Abandoned;
    m_memory.close();
}

}  // namespace qplc
