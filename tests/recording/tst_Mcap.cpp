// SPDX-License-Identifier: Apache-2.0
#include "recording/McapReader.h"
#include "recording/McapWriter.h"

#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

#include <sys/stat.h>

using namespace qplc::mcap;

namespace {

struct Collector final : ScanHandler
{
    QStringList seen;
    QVector<ChunkEntry> chunks;
    void attachment(const Attachment &attachment, const NamedEntry & /*entry*/) override
    {
        seen << "attachment " + attachment.name + ' ' + attachment.data;
    }
    void metadata(const QByteArray & /*fields*/, const NamedEntry &entry) override { seen << "metadata " + entry.name; }
    void chunk(const ChunkEntry &entry, const QByteArray &records) override
    {
        chunks << entry;
        forEachMessage(
            records, [](const Channel &) {},
            [this](const Message &message, std::uint64_t) {
                seen << QStringLiteral("%1 %2 %3")
                            .arg(message.channel)
                            .arg(message.time)
                            .arg(QString::fromLatin1(message.bytes, int(message.size)));
            });
    }
};

/// A disk that is full now and then.
class FullDisk final : public FileSink
{
public:
    FullDisk(QByteArray *bytes, bool *isFull)
        : m_bytes(bytes)
        , m_isFull(isFull)
    {
    }
    bool append(const QByteArray &bytes, QString *error) override
    {
        if (*m_isFull)
            *error = "the disk is full";
        else
            *m_bytes += bytes;
        return !*m_isFull;
    }
    bool sync(QString * /*error*/) override { return true; }
    std::uint64_t size() const override { return std::uint64_t(m_bytes->size()); }

private:
    QByteArray *m_bytes;
    bool *m_isFull;
};

}  // namespace

// The container of recordings.
class tst_Mcap : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void theChecksumIsThatOfZlib();
    void whatIsWrittenIsRead();
    void theSummarySaysWhereChunksAre();
    void aMessageThatWasNotWrittenIsWrittenLater();
    void aFileThatIsThereIsNotReplaced();
    void whatIsNoRecordingIsRefused();
    void aFifoIsRefusedWithoutWaitingForItsWriter();
    void aSizeThatCannotBeTakesNoMemory();

private:
    bool write(const QString &file);
    QTemporaryDir m_folder;
    QString m_error;
};

void tst_Mcap::theChecksumIsThatOfZlib()
{
    QCOMPARE(crc32("123456789", 9), 0xcbf43926U);
    QCOMPARE(crc32("", 0), 0U);
    QCOMPARE(crc32("56789", 5, crc32("1234", 4)), 0xcbf43926U);
}

bool tst_Mcap::write(const QString &file)
{
    Writer writer(FileSink::create(file, &m_error));
    if (!writer.begin("test", &m_error) || !writer.addAttachment("table", "text/plain", "abc", 5, &m_error)
        || !writer.addMetadata("facts", {{"a", "1"}}, &m_error))
        return false;
    const std::uint16_t first = writer.addChannel("/first", "ros1", "x/First", "ros1msg", "int8 x");
    const std::uint16_t second = writer.addChannel("/second", "json");
    for (std::uint64_t time = 10; time < 14; ++time) {
        writer.addMessage(first, std::uint32_t(time), time, time, "x", 1);
        if (time % 2 == 0)
            writer.addMessage(second, 0, time, time, "{}", 2);
        if (time == 11 && !writer.flush(&m_error))
            return false;
    }
    return writer.finish(&m_error);
}

void tst_Mcap::whatIsWrittenIsRead()
{
    const QString file = m_folder.filePath("read.mcap");
    QVERIFY2(write(file), qPrintable(m_error));
    Reader reader;
    QVERIFY2(reader.open(file, &m_error), qPrintable(m_error));
    Collector found;
    QCOMPARE(reader.scan(found), Reader::Finished);
    QCOMPARE(reader.damages(), 0);
    QCOMPARE(found.seen,
             QStringList({"attachment table abc", "metadata facts", "1 10 x", "2 10 {}", "1 11 x", "1 12 x", "2 12 {}",
                          "1 13 x"}));
}

void tst_Mcap::theSummarySaysWhereChunksAre()
{
    const QString file = m_folder.filePath("summary.mcap");
    QVERIFY2(write(file), qPrintable(m_error));
    Reader reader;
    QVERIFY(reader.open(file, &m_error));
    Index index;
    QVERIFY(reader.readSummary(&index));
    QCOMPARE(index.chunks.size(), std::size_t(2));
    QCOMPARE(index.channels.size(), std::size_t(2));
    QCOMPARE(index.channels[1].topic, QByteArray("/second"));
    QCOMPARE(index.schemas.at(0).text, QByteArray("int8 x"));
    QCOMPARE(index.chunks[1].begin, std::uint64_t(12));
    QCOMPARE(index.chunks[1].end, std::uint64_t(13));
    QCOMPARE(index.chunks[1].indexOffsets.size(), 2);
    QByteArray records;
    QVERIFY(reader.readChunk(index.chunks[1], &records));
    QVector<quint64> times;
    QVERIFY(forEachMessage(
        records, [](const Channel &) {}, [&](const Message &message, std::uint64_t) { times << message.time; }));
    QCOMPARE(times, QVector<quint64>({12, 12, 13}));
}

void tst_Mcap::aMessageThatWasNotWrittenIsWrittenLater()
{
    QByteArray bytes;
    bool isFull = false;
    Writer writer(std::make_unique<FullDisk>(&bytes, &isFull));
    QVERIFY(writer.begin("test", &m_error));
    const std::uint16_t channel = writer.addChannel("/a", "json");
    writer.addMessage(channel, 0, 1, 1, "x", 1);
    isFull = true;
    QVERIFY(!writer.flush(&m_error));
    QCOMPARE(m_error, QString("the disk is full"));
    writer.addMessage(channel, 0, 2, 2, "y", 1);
    QVERIFY(!writer.finish(&m_error));
    isFull = false;
    QVERIFY(writer.finish(&m_error));
    const QString name = m_folder.filePath("late.mcap");
    QFile file(name);
    QVERIFY(file.open(QIODevice::WriteOnly));
    QCOMPARE(file.write(bytes), qint64(bytes.size()));
    file.close();
    Reader reader;
    QVERIFY(reader.open(name, &m_error));
    Collector found;
    QCOMPARE(reader.scan(found), Reader::Finished);
    QCOMPARE(found.seen, QStringList({"1 1 x", "1 2 y"}));
}

void tst_Mcap::aFileThatIsThereIsNotReplaced()
{
    const QString name = m_folder.filePath("there.mcap");
    QVERIFY(FileSink::create(name, &m_error));
    QVERIFY(!FileSink::create(name, &m_error));
    QVERIFY2(m_error.contains("is there already"), qPrintable(m_error));
    QVERIFY(!FileSink::create("/no-such-folder/a.mcap", &m_error));
    QVERIFY2(m_error.contains("/no-such-folder/a.mcap"), qPrintable(m_error));
}

void tst_Mcap::whatIsNoRecordingIsRefused()
{
    const QString name = m_folder.filePath("text");
    QFile file(name);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("no recording at all, but a text");
    file.close();
    Reader reader;
    QVERIFY(!reader.open(name, &m_error));
    QVERIFY2(m_error.contains("is not a recording"), qPrintable(m_error));
    QVERIFY(!reader.open(m_folder.filePath("nothing"), &m_error));
    QVERIFY2(m_error.startsWith("cannot open"), qPrintable(m_error));
}

void tst_Mcap::aFifoIsRefusedWithoutWaitingForItsWriter()
{
    const QString name = m_folder.filePath("fifo");
    QCOMPARE(::mkfifo(QFile::encodeName(name).constData(), 0600), 0);
    Reader reader;
    QVERIFY(!reader.open(name, &m_error));
    QVERIFY2(m_error.contains("is not a file"), qPrintable(m_error));
}

void tst_Mcap::aSizeThatCannotBeTakesNoMemory()
{
    QByteArray result;
    QVERIFY(!uncompress("zstd", "abcd", 4, 1U << 20, &result));
    QVERIFY(!uncompress("", "abcd", 4, std::uint64_t(1) << 40, &result));
    QVERIFY(!uncompress("lz4", "abcd", 4, 4, &result));
    QVERIFY(uncompress("", "abcd", 4, 4, &result));
    QCOMPARE(result, QByteArray("abcd"));
}

QTEST_GUILESS_MAIN(tst_Mcap)
#include "tst_Mcap.moc"
