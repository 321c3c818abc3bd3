// SPDX-License-Identifier: Apache-2.0
#include "RecordedFlight.h"
#include "recording/McapReader.h"
#include "recording/Recovery.h"
#include "recording/Verification.h"

#include <QtTest/QtTest>

#include <random>

using namespace qplc;
using namespace qplc::mcap;

namespace {

constexpr int Chunks = 4;
constexpr int CyclesOfAChunk = 12;

struct ChunkCollector final : ScanHandler
{
    QVector<QByteArray> records;
    QVector<ChunkEntry> entries;
    void chunk(const ChunkEntry &entry, const QByteArray &found) override
    {
        entries << entry;
        records << found;
    }
};

}  // namespace

// Files that were cut or damaged.
class tst_Recovery : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void aFileThatIsCutAnywhereIsFinished();
    void aFinishedFileStaysAsItIs();
    void aFileWithNothingWholeStaysAsItIs();
    void aFlippedBitLosesOneChunkAndNoMore();
    void aDamagedFileIsNotVerified();

private:
    QString write(const QByteArray &bytes);
    ChunkCollector scan(const QString &file);

    std::unique_ptr<RecordedFlight> m_flight;
    QByteArray m_bytes;
    ChunkCollector m_whole;
    QString m_error;
};

void tst_Recovery::initTestCase()
{
    m_flight = std::make_unique<RecordedFlight>();
    QVERIFY(m_flight->begin());
    QVERIFY(m_flight->start());
    for (int chunk = 0; chunk < Chunks; ++chunk) {
        m_flight->step(CyclesOfAChunk);
        if (chunk == Chunks - 1)
            m_flight->cycle.stop();
        m_flight->recorder.proceed(&m_error);
        QVERIFY(m_flight->recorder.save(false, &m_error));
    }
    QVERIFY(m_flight->recorder.finish(&m_error));
    QFile file(m_flight->file);
    QVERIFY(file.open(QIODevice::ReadOnly));
    m_bytes = file.readAll();
    m_whole = scan(m_flight->file);
    QCOMPARE(m_whole.entries.size(), Chunks);
}

QString tst_Recovery::write(const QByteArray &bytes)
{
    const QString name = m_flight->folder.filePath("part.mcap");
    QFile file(name);
    if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size())
        qFatal("cannot write %s", qPrintable(name));
    return name;
}

ChunkCollector tst_Recovery::scan(const QString &file)
{
    ChunkCollector found;
    Reader reader;
    if (reader.open(file, &m_error))
        reader.scan(found);
    return found;
}

void tst_Recovery::aFileThatIsCutAnywhereIsFinished()
{
    const ChunkEntry &last = m_whole.entries.back();
    const int lastEnd = int(last.offset + last.length);
    for (int size = int(last.offset); size < m_bytes.size(); ++size) {
        const QString name = write(m_bytes.left(size));
        RecoveredFile recovered;
        QVERIFY2(recoverRecording(name, &recovered, &m_error), qPrintable(m_error));
        const int whole = size < lastEnd ? Chunks - 1 : Chunks;
        QCOMPARE(recovered.wasFinished, false);
        QCOMPARE(int(recovered.chunks), whole);
        QCOMPARE(recovered.damages, 0);
        Reader reader;
        QVERIFY(reader.open(name, &m_error));
        Index index;
        QVERIFY(reader.readSummary(&index));
        QCOMPARE(int(index.chunks.size()), whole);
        for (const ChunkEntry &chunk : index.chunks)
            QVERIFY(!chunk.indexOffsets.isEmpty());
        QCOMPARE(scan(name).records, m_whole.records.mid(0, whole));
        VerifiedFile verified;
        QVERIFY(verifyRecording(name, &verified, &m_error));
        QVERIFY(verified.isFinished);
        QCOMPARE(verified.cycles, quint64(whole * CyclesOfAChunk));
        QCOMPARE(verified.isComplete(), whole == Chunks);
        QCOMPARE(verified.checkedCycles, verified.cycles);
    }
}

void tst_Recovery::aFinishedFileStaysAsItIs()
{
    const QString name = write(m_bytes);
    RecoveredFile recovered;
    QVERIFY(recoverRecording(name, &recovered, &m_error));
    QVERIFY(recovered.wasFinished);
    QFile file(name);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(file.readAll(), m_bytes);
}

/// Its recorder was killed before the description of the plant was there, or it is of another kind.
void tst_Recovery::aFileWithNothingWholeStaysAsItIs()
{
    for (const int size : {MagicSize, MagicSize + 1, 100}) {
        const QByteArray begin = m_bytes.left(size);
        const QString name = write(begin);
        RecoveredFile recovered;
        QVERIFY(!recoverRecording(name, &recovered, &m_error));
        QVERIFY(recovered.hasNothing);
        QVERIFY2(m_error.contains("stays as it is"), qPrintable(m_error));
        QFile file(name);
        QVERIFY(file.open(QIODevice::ReadOnly));
        QCOMPARE(file.readAll(), begin);
    }
}

void tst_Recovery::aFlippedBitLosesOneChunkAndNoMore()
{
    std::mt19937 random(7);  // NOLINT: the same each time
    const QString name = write(m_bytes);
    QFile file(name);
    QVERIFY(file.open(QIODevice::ReadWrite | QIODevice::Unbuffered));
    for (int flip = 0; flip < 10'000; ++flip) {
        const int at = MagicSize + int(random() % unsigned(m_bytes.size() - MagicSize));
        const char changed = char(m_bytes.at(at) ^ (1 << (random() % 8)));
        QVERIFY(file.seek(at) && file.write(&changed, 1) == 1);
        const ChunkCollector found = scan(name);
        QVector<QByteArray> expected;
        bool isInAChunk = false;
        for (int i = 0; i < Chunks; ++i) {
            const ChunkEntry &entry = m_whole.entries[i];
            const bool isHit = at >= int(entry.offset) && at < int(entry.offset + entry.length);
            isInAChunk = isInAChunk || isHit;
            if (!isHit)
                expected << m_whole.records[i];
        }
        // A bit of a compressed chunk may say nothing: then all of them are whole.
        if (!isInAChunk || found.records != expected)
            QCOMPARE(found.records, m_whole.records);
        QVERIFY(file.seek(at) && file.write(m_bytes.constData() + at, 1) == 1);
    }
}

void tst_Recovery::aDamagedFileIsNotVerified()
{
    QByteArray damaged = m_bytes;
    const int at = int(m_whole.entries[1].offset) + 100;
    damaged[at] = char(damaged.at(at) ^ 1);
    VerifiedFile verified;
    QVERIFY(verifyRecording(write(damaged), &verified, &m_error));
    QVERIFY(!verified.isComplete());
    QCOMPARE(verified.cycles, quint64((Chunks - 1) * CyclesOfAChunk));
    QVERIFY2(verified.problems.contains("the file is damaged at 1 places"), qPrintable(verified.problems.join("; ")));
}

QTEST_GUILESS_MAIN(tst_Recovery)
#include "tst_Recovery.moc"
