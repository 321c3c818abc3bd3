// SPDX-License-Identifier: Apache-2.0
#include "Verification.h"

#include "McapReader.h"
#include "PlantMessage.h"
#include "RecordedFile.h"
#include "RecordingMessages.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace qplc {

namespace {

using namespace mcap;

constexpr int MostProblems = 20;

class Verifier final : public ScanHandler
{
public:
    explicit Verifier(VerifiedFile *result)
        : m_result(*result)
    {
    }

    void attachment(const Attachment &attachment, const NamedEntry & /*entry*/) override
    {
        if (attachment.name != "recording.txt" || m_message)
            return;
        QVector<QPlcParseError> errors;
        if (!RingDescription::fromText(attachment.data, &m_result.description))
            return problem(QStringLiteral("its description is that of another version"));
        const QPlcSignalTable table = QPlcSignalTable::fromIni(m_result.description.table, &errors);
        if (errors.isEmpty())
            m_message = std::make_unique<PlantMessage>(table);
    }
    void chunk(const ChunkEntry & /*entry*/, const QByteArray &records) override
    {
        forEachMessage(
            records, [this](const Channel &channel) { m_topics.insert(channel.id, channel.topic); },
            [this](const Message &message, std::uint64_t) { take(message); });
    }
    bool hasTable() const { return m_message != nullptr; }
    void problem(const QString &text)
    {
        if (m_result.problems.size() < MostProblems)
            m_result.problems << text;
        else if (m_result.problems.size() == MostProblems)
            m_result.problems << QStringLiteral("... and more");
    }
    /// Cycles behind the last digest cannot be compared.
    void end()
    {
        if (!m_hasDigest)
            problem(QStringLiteral("the cycles from %1 on have no digest to compare with").arg(m_result.checkedCycles));
        m_result.next = m_next;
    }

private:
    void take(const Message &message)
    {
        const QByteArray topic = m_topics.value(message.channel);
        const QByteArray text = QByteArray::fromRawData(message.bytes, int(message.size));
        if (topic == "/plant" && m_message)
            cycle(message);
        else if (topic == "/gaps")
            gap(text);
        else if (topic == "/digest")
            digest(text);
    }
    void cycle(const Message &message)
    {
        const std::optional<PlantMessage::Cycle> cycle = m_message->decode(message.bytes, message.size);
        if (!cycle)
            return problem(QStringLiteral("a message of /plant does not fit the signal table"));
        if (m_result.cycles == 0)
            m_result.firstCycle = cycle->number;
        if (cycle->number != m_next + cycle->skipped) {
            problem(QStringLiteral("cycle %1 follows cycle %2").arg(cycle->number).arg(qint64(m_next) - 1));
            m_isBroken = true;
        }
        m_result.digest = m_message->image().digest(m_result.digest);
        m_result.skipped += cycle->skipped;
        m_result.lastCycle = cycle->number;
        m_next = cycle->number + 1;
        m_hasDigest = false;
        ++m_result.cycles;
    }
    void gap(const QByteArray &text)
    {
        RecordedGap gap;
        readGap(text, &gap);
        m_result.gaps.append({gap.first, gap.last});
        if (m_next + gap.skipped + gap.cycles != gap.last + 1)
            problem(QStringLiteral("a gap ends with cycle %1, and does not begin behind cycle %2")
                        .arg(gap.last)
                        .arg(qint64(m_next) - 1));
        m_result.missing += gap.cycles;
        m_result.skipped += gap.skipped;
        m_result.digest = gap.digest;
        m_isBroken = m_result.digest == 0;  // of what came before, nothing is known
        m_next = gap.last + 1;
    }
    void digest(const QByteArray &text)
    {
        const std::optional<quint64> wanted = numberIn(text, "digest", 16);
        const std::optional<quint64> next = numberIn(text, "next");
        m_hasDigest = true;
        if (text.contains("\"continues\":true") && m_next == 0)
            return goOn(next.value_or(0), wanted.value_or(0));
        m_result.hasEnd = m_result.hasEnd || text.contains("\"end\":true");
        if (!m_isBroken && (!wanted || *wanted != m_result.digest || next.value_or(~quint64(0)) != m_next))
            problem(QStringLiteral("the digest of the cycles before %1 is %2, and that of the flight %3")
                        .arg(QString::number(m_next), QString::fromLatin1(digestText(m_result.digest)),
                             QString::fromLatin1(digestText(wanted.value_or(0)))));
        else if (!m_isBroken)
            m_result.checkedCycles = m_next;
        m_result.digest = wanted.value_or(0);  // what follows is judged by itself
        m_isBroken = !wanted;
        m_next = next.value_or(m_next);
    }

    /// Other files have what was before.
    void goOn(quint64 next, quint64 digest)
    {
        m_result.continues = true;
        m_result.fromDigest = digest;
        m_result.from = m_result.checkedCycles = m_next = next;
        m_result.digest = digest;
    }

    VerifiedFile &m_result;
    std::unique_ptr<PlantMessage> m_message;
    QMap<std::uint16_t, QByteArray> m_topics;
    quint64 m_next = 0;
    bool m_isBroken = false;  // until the next digest, nothing can be compared
    bool m_hasDigest = true;
};

/// \return false when the file cannot be read, or is no recording
bool readFile(const QString &file, VerifiedFile *result, QString *error)
{
    *result = {};
    Reader reader;
    if (!reader.open(file, error))
        return false;
    Verifier verifier(result);
    result->isFinished = reader.scan(verifier) == Reader::Finished;
    if (!verifier.hasTable()) {
        *error = RecordedFile::unknownText(file);
        return false;
    }
    verifier.end();
    if (reader.damages() > 0)
        verifier.problem(QStringLiteral("the file is damaged at %1 places").arg(reader.damages()));
    if (!result->isFinished)
        verifier.problem(QStringLiteral("the file is not finished; run: qtplc recover %1").arg(file));
    return true;
}

/// Puts the files of a phase together, one after the other.
class PhaseVerifier
{
public:
    explicit PhaseVerifier(VerifiedPhase *result)
        : m_result(*result)
    {
    }

    void add(const QString &name, const VerifiedFile &file)
    {
        for (const QString &problem : file.problems)
            m_result.problems << QStringLiteral("%1: %2").arg(name, problem);
        if (file.from > m_next)
            addHole(file);
        else if (m_hasFile && file.from == m_next && file.fromDigest != m_digest)
            m_result.problems << QStringLiteral("%1 does not go on where the file before has ended: other cycles are "
                                                "before cycle %2")
                                     .arg(name)
                                     .arg(m_next);
        if (m_result.cycles == 0)
            m_result.firstCycle = file.firstCycle;
        if (m_hasFile && file.next <= m_next)
            return;  // it has what other files have, such as the cycles around a mark
        m_result.cycles += file.cycles - std::min(file.cycles, m_next - std::min(m_next, file.from));
        m_result.skipped += file.skipped;
        m_result.missing += file.missing;
        m_result.gaps += file.gaps;
        m_result.lastCycle = std::max(m_result.lastCycle, file.lastCycle);
        m_result.hasEnd = m_result.hasEnd || file.hasEnd;
        if (file.next >= m_next) {
            m_next = file.next;
            m_digest = m_result.digest = file.digest;
        }
        m_hasFile = true;
        m_areAllMarked = m_areAllMarked && name.contains(QLatin1String("_marked.mcap"));
    }

private:
    /// Old files are deleted first, and marked ones never: so what is missing behind others than
    /// marked ones was not recorded.
    void addHole(const VerifiedFile &file)
    {
        const VerifiedFile::Gap hole{m_next, file.from - 1};
        if (m_areAllMarked) {
            m_result.deleted << hole;
            return;
        }
        m_result.gaps << hole;
        m_result.missing += hole.last - hole.first + 1;
    }

    VerifiedPhase &m_result;
    quint64 m_next = 0;  // cycle that comes behind the files so far
    quint64 m_digest = 0;
    bool m_hasFile = false;
    bool m_areAllMarked = true;
};

}  // namespace

bool verifyRecording(const QString &file, VerifiedFile *result, QString *error)
{
    if (!readFile(file, result, error))
        return false;
    if (!result->hasEnd)
        result->problems << QStringLiteral("the end of the phase is not in the file");
    return true;
}

VerifiedPhase verifyPhase(const RecordedPhase &phase)
{
    VerifiedPhase result;
    result.phase = phase;
    PhaseVerifier verifier(&result);
    for (const QString &name : phase.files) {
        VerifiedFile file;
        QString error;
        if (readFile(name, &file, &error))
            verifier.add(name, file);
        else
            result.problems << error;
    }
    if (!result.hasEnd)
        result.problems << QStringLiteral("the end of the phase is not in the files");
    return result;
}

}  // namespace qplc
