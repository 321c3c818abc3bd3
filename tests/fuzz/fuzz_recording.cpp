// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "node/cycle/RingReader.h"
#include "recording/Happenings.h"
#include "recording/McapReader.h"
#include "recording/Recovery.h"
#include "recording/Verification.h"

#include <sys/mman.h>
#include <unistd.h>

using namespace qplc;
using namespace qplc::mcap;

namespace {

enum Kind : std::uint8_t { File, Records, Ring };

/// A file in memory, which has a name.
class MemoryFile
{
public:
    MemoryFile()
        : m_descriptor(::memfd_create("fuzz", MFD_CLOEXEC))
    {
    }
    ~MemoryFile() { ::close(m_descriptor); }
    MemoryFile(const MemoryFile &) = delete;
    MemoryFile &operator=(const MemoryFile &) = delete;
    void write(const QByteArray &bytes) const
    {
        fuzz::check(::ftruncate(m_descriptor, 0) == 0
                        && ::pwrite(m_descriptor, bytes.constData(), std::size_t(bytes.size()), 0) == bytes.size(),
                    "memory has room");
    }
    QString name() const { return QStringLiteral("/proc/self/fd/%1").arg(m_descriptor); }

private:
    int m_descriptor;
};

struct Chunks final : ScanHandler
{
    QVector<QByteArray> found;
    void chunk(const ChunkEntry & /*entry*/, const QByteArray &records) override { found << records; }
};

/// What was whole before it is whole behind, and others can read it.
void recover(const QString &name)
{
    QString error;
    Reader reader;
    Chunks before;
    if (!reader.open(name, &error)) {
        fuzz::check(!error.isEmpty(), "a refusal has a reason");
        return;
    }
    reader.scan(before);
    VerifiedFile verified;
    if (verifyRecording(name, &verified, &error))
        fuzz::check(!verified.isComplete() || verified.problems.isEmpty(), "a whole recording has no problems");
    RecoveredFile recovered;
    const bool isFinished = recoverRecording(name, &recovered, &error);
    fuzz::check(isFinished || (recovered.hasNothing && before.found.isEmpty()),
                "a file that can be read can be finished, if anything is in it");
    if (!isFinished)
        return;
    Chunks after;
    fuzz::check(reader.open(name, &error), "what was finished can be read");
    fuzz::check(reader.scan(after) == Reader::Finished, "what was finished has its end");
    fuzz::check(after.found == before.found, "what was whole stays");
}

/// What people and programs did is text that somebody has written.
void readHappenings(const QString &name)
{
    QString error;
    Recording recording;
    if (!recording.open({name}, &error))
        return;
    HappeningReader reader(recording, ~0);
    for (Happening happening; reader.next(&happening);) {
        fuzz::check(!happening.sentence().contains(QLatin1Char('\n')), "a sentence is one line");
        fuzz::check(!happening.toJson().isEmpty() && !happening.severity().isEmpty(), "a happening says something");
    }
}

/// A recording of one chunk with these \a records.
QByteArray recordingOf(const QByteArray &records)
{
    RingDescription description;
    description.period = 1;
    description.table = "[x]\ntype = Real64\n[t]\ntype = String(3)\n";
    const QByteArray text = description.toText();
    const QByteArray fields = Fields()
                                  .number(quint64(0))
                                  .number(quint64(0))
                                  .text("recording.txt")
                                  .text({})
                                  .number(quint64(text.size()))
                                  .raw(text)
                                  .bytes();
    std::uint64_t begin = ~std::uint64_t(0);
    std::uint64_t end = 0;
    forEachMessage(
        records, [](const Channel &) {},
        [&](const Message &message, std::uint64_t) {
            begin = std::min(begin, message.time);
            end = std::max(end, message.time);
        });
    return QByteArray(Magic, MagicSize)
        + recordOf(AttachmentOpcode,
                   Fields().raw(fields).number(crc32(fields.constData(), std::size_t(fields.size()))).bytes())
        + recordOf(ChunkOpcode,
                   Fields()
                       .number(begin)
                       .number(end)
                       .number(quint64(records.size()))
                       .number(crc32(records.constData(), std::size_t(records.size())))
                       .text({})
                       .number(quint64(records.size()))
                       .raw(records)
                       .bytes());
}

/// A ring whose records somebody else has written.
void readRing(fuzz::Input &input)
{
    constexpr int page = 4096;
    constexpr std::uint64_t capacity = 4096;
    static const QByteArray name = RingMemory::folder() + "/qtplc-fuzz-" + QByteArray::number(::getpid());
    RingMemory ring;
    QString error;
    fuzz::check(ring.create(name, capacity, "x", &error, capacity), "memory has room");
    ring.header()->cycles.head = input.number<std::uint64_t>();
    ring.header()->cycles.oldest = input.number<std::uint64_t>();
    ring.header()->cycles.read = input.number<std::uint64_t>();
    ring.header()->cycles.isRead = input.number<std::uint8_t>() % 2;
    const QByteArray records = input.bytes(page);
    std::memcpy(ring.cycles().at(0), records.constData(), std::size_t(records.size()));
    const bool isAttached = input.number<std::uint8_t>() == 0;
    ring.header()->texts.head = input.number<std::uint64_t>();
    ring.header()->texts.oldest = input.number<std::uint64_t>();
    ring.header()->texts.read = input.number<std::uint64_t>();
    const QByteArray texts = input.bytes(page);
    std::memcpy(ring.texts().at(0), texts.constData(), std::size_t(texts.size()));
    RingReader reader;
    fuzz::check(reader.open(name, &error), "a ring can be opened");
    ring.remove();
    if (isAttached)
        reader.attach();
    constexpr int most = 1000;  // more than there can be
    int found = 0;
    for (RingReader::Result result = reader.next(); result != RingReader::Nothing && found < most; ++found) {
        CycleView view;
        if (result == RingReader::Found && CycleView::read(reader.body(), reader.size(), &view)) {
            const QByteArray image(view.image, int(view.cycle.imageSize));
            for (std::uint32_t i = 0; i < view.cycle.nodes; ++i)
                fuzz::check(view.node(i).rawSize == view.node(i).rawSize, "each node can be read");
        }
        reader.release();
        result = reader.next();
    }
    fuzz::check(found < most, "the reading of a ring ends");
    for (found = 0; reader.texts().next() != RegionReader::Nothing && found < most;)
        ++found;
    fuzz::check(found < most, "the reading of texts ends");
}

}  // namespace

// Input: a kind, and then a recording, the records of its only chunk, or a ring.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    fuzz::Input input(data, size);
    const auto kind = input.number<std::uint8_t>() % 3;
    if (kind == Ring) {
        readRing(input);
        return 0;
    }
    const QByteArray bytes = input.bytes(size);
    const MemoryFile file;
    file.write(kind == File ? bytes : recordingOf(bytes));
    recover(file.name());
    readHappenings(file.name());
    return 0;
}
