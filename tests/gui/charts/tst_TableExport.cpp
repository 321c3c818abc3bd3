// SPDX-License-Identifier: Apache-2.0
#include "gui/charts/PlotExport.h"
#include "gui/plot/TableExport.h"

#include <QtCore/QTemporaryDir>
#include <QtGui/QClipboard>
#include <QtGui/QGuiApplication>
#include <QtTest/QtTest>

#include <cmath>

using namespace qplc;
using Time = SignalStore::Time;

namespace {

constexpr Time s = 1'000'000'000;
constexpr Time begin = 1'700'000'000 * s;  // 2023-11-14T22:13:20Z

void append(SignalStore *store, Time time, std::vector<float> values)
{
    QVERIFY(store->append(time, values.data()));
}

TableExport::Column column(const SignalStore &store, int channel, const QString &name = QStringLiteral("force"))
{
    return {&store, channel, 1.0, 0.0, name, QStringLiteral("N")};
}

QByteArray textOf(TableExport table)
{
    QByteArray text = table.header();
    while (!table.isAtEnd())
        text += table.next(1);
    return text;
}

std::shared_ptr<TextTable> tableOf(TableExport::Format format, const SignalStore &store, SignalStore::Time first,
                                   SignalStore::Time last)
{
    return std::make_shared<TableExport>(format, std::vector<TableExport::Column>{column(store, 0)}, first, last);
}

}  // namespace

class tst_TableExport : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void tableContainsTheRowsOfTheRange();
    void anEmptyRangeHasAHeaderOnly();
    void namesAreQuotedAfterTheRfc();
    void numbersUseTheCLocaleAndReadBackExactly();
    void missingValueIsAnEmptyField();
    void exportAppliesGainAndOffset();
    void severalStoresAreOneTable();
    void qualitiesAreThoseOfTablesOfRecordings();
    void aMovedRunHasItsRowsAtOtherTimes();
    void tabsAreForClipboards();
    void piecesAreBounded();
    void overwrittenRowsAreOmitted();
    void aFileIsWrittenWhole();
    void failureToWriteAFileIsReported();
    void givingUpLeavesNoFile();
    void theClipboardGetsTabs();
};

void tst_TableExport::tableContainsTheRowsOfTheRange()
{
    SignalStore store(2, 64);
    for (int i = 0; i < 5; ++i)
        append(&store, begin + i * s / 100, {float(i), 10.0F * float(i)});
    const TableExport table(TableExport::Csv, {column(store, 0), column(store, 1, QStringLiteral("power"))},
                            begin + s / 100, begin + 3 * s / 100);
    QCOMPARE(textOf(table),
             QByteArray("UTC,time [s],force [N],power [N]\r\n"
                        "2023-11-14T22:13:20.010000Z,0,1,10\r\n"
                        "2023-11-14T22:13:20.020000Z,0.01,2,20\r\n"
                        "2023-11-14T22:13:20.030000Z,0.02,3,30\r\n"));
}

void tst_TableExport::anEmptyRangeHasAHeaderOnly()
{
    const SignalStore store(1, 16);
    QCOMPARE(textOf(TableExport(TableExport::Csv, {column(store, 0)}, 0, begin)),
             QByteArray("UTC,time [s],force [N]\r\n"));
    QCOMPARE(textOf(TableExport(TableExport::Csv, {}, 0, begin)), QByteArray("UTC,time [s]\r\n"));
}

void tst_TableExport::namesAreQuotedAfterTheRfc()
{
    const SignalStore store(1, 16);
    TableExport::Column strange = column(store, 0, QStringLiteral("= max(a, \"b\")"));
    strange.unit.clear();
    QCOMPARE(TableExport(TableExport::Csv, {strange}, 0, 1).header(),
             QByteArray("UTC,time [s],\"= max(a, \"\"b\"\")\"\r\n"));
}

void tst_TableExport::numbersUseTheCLocaleAndReadBackExactly()
{
    const float values[] = {0.1F, -1.0F / 3.0F, 1.5e-30F, 16777216.0F, 3.4e38F};
    SignalStore store(1, 16);
    for (int i = 0; i < 5; ++i)
        append(&store, begin + i * s, {values[i]});
    const QLocale before;
    QLocale::setDefault(QLocale(QLocale::German));
    const QByteArray text = textOf(TableExport(TableExport::Csv, {column(store, 0)}, begin, begin + 9 * s));
    QLocale::setDefault(before);
    const QList<QByteArray> lines = text.split('\n');
    for (int i = 0; i < 5; ++i)
        QCOMPARE(lines[i + 1].trimmed().split(',').value(2).toFloat(), values[i]);
    QVERIFY(lines[1].endsWith(",0.1\r"));
}

void tst_TableExport::missingValueIsAnEmptyField()
{
    SignalStore store(1, 16);
    append(&store, begin, {NAN});
    QVERIFY(textOf(TableExport(TableExport::Csv, {column(store, 0)}, begin, begin)).endsWith("Z,0,\r\n"));
}

void tst_TableExport::exportAppliesGainAndOffset()
{
    SignalStore store(1, 16);
    append(&store, begin, {2.0F});
    TableExport::Column scaled = column(store, 0);
    scaled.gain = -3.0;
    scaled.offset = 0.5;
    QVERIFY(textOf(TableExport(TableExport::Csv, {scaled}, begin, begin)).endsWith(",-5.5\r\n"));
}

void tst_TableExport::qualitiesAreThoseOfTablesOfRecordings()
{
    SignalStore store(1, 64);
    const SignalStore::Mark marks[]
        = {QPlcQuality::Good, QPlcQuality::Held, QPlcQuality::Held, QPlcQuality::Safe, QPlcQuality::Invalid};
    for (int i = 0; i < 5; ++i) {
        append(&store, begin + i * s, {1.0F});
        if (marks[i] != RowMarks::None)
            store.mark(0, marks[i]);
    }
    TableExport::Column force = column(store, 0);
    force.hasQuality = true;
    const QList<QByteArray> rows = textOf(TableExport(TableExport::Csv, {force}, begin, begin + 4 * s)).split('\n');
    QCOMPARE(rows.at(0).trimmed(), QByteArray("UTC,time [s],force [N],force.quality"));
    QByteArrayList qualities;
    for (int i = 1; i <= 5; ++i)
        qualities << rows.at(i).trimmed().split(',').last();
    QCOMPARE(qualities, (QByteArrayList{"0", "1", "2", "253", "254"}));
    // A table that begins within a held piece.
    const QList<QByteArray> later
        = textOf(TableExport(TableExport::Csv, {force}, begin + 2 * s, begin + 2 * s)).split('\n');
    QVERIFY(later.at(1).trimmed().endsWith(",2"));
}

void tst_TableExport::aMovedRunHasItsRowsAtOtherTimes()
{
    SignalStore store(1, 64);
    for (int i = 0; i < 4; ++i)
        append(&store, begin + i * s, {float(i)});
    TableExport::Column run = column(store, 0, QStringLiteral("run"));
    run.shift = 2 * s;
    run.begin = begin + s;
    run.end = begin + 2 * s;
    const QList<QByteArray> rows
        = textOf(TableExport(TableExport::Csv, {column(store, 0), run}, begin + 2 * s, begin + 9 * s)).split('\n');
    QCOMPARE(rows.at(1).trimmed().split(',').mid(2), (QByteArrayList{"2", ""}));
    QCOMPARE(rows.at(2).trimmed().split(',').mid(2), (QByteArrayList{"3", "1"}));
    QCOMPARE(rows.size(), 4);  // and the end of the text
}

void tst_TableExport::severalStoresAreOneTable()
{
    SignalStore fast(1, 16);
    SignalStore slow(1, 16);
    for (int i = 0; i < 3; ++i)
        append(&fast, begin + i * s, {float(i)});
    append(&slow, begin + 1 * s, {7.0F});
    append(&slow, begin + 1 * s + s / 2, {8.0F});
    const QList<QByteArray> lines
        = textOf(TableExport(TableExport::Csv, {column(fast, 0), column(slow, 0)}, begin, begin + 9 * s)).split('\n');
    QCOMPARE(lines.size(), 6);
    QVERIFY(lines[1].endsWith("Z,0,0,\r"));
    QVERIFY(lines[2].endsWith("Z,1,1,7\r"));
    QVERIFY(lines[3].endsWith("Z,1.5,,8\r"));
    QVERIFY(lines[4].endsWith("Z,2,2,\r"));
}

void tst_TableExport::tabsAreForClipboards()
{
    SignalStore store(1, 16);
    append(&store, begin, {2.0F});
    QCOMPARE(textOf(TableExport(TableExport::Tsv, {column(store, 0, QStringLiteral("a\tb, c"))}, begin, begin)),
             QByteArray("UTC\ttime [s]\ta b, c [N]\n2023-11-14T22:13:20.000000Z\t0\t2\n"));
}

void tst_TableExport::piecesAreBounded()
{
    SignalStore store(1, 1024);
    for (int i = 0; i < 1000; ++i)
        append(&store, begin + i * s, {1.0F});
    TableExport table(TableExport::Csv, {column(store, 0)}, begin, begin + 5000 * s);
    QCOMPARE(table.next(300).count('\n'), 300);
    QCOMPARE(table.rows(), std::int64_t(300));
    QCOMPARE(table.next(5000).count('\n'), 700);
    QVERIFY(table.isAtEnd());
    QCOMPARE(table.next(5000), QByteArray());
}

void tst_TableExport::overwrittenRowsAreOmitted()
{
    SignalStore store(1, 32);
    for (int i = 0; i < 32; ++i)
        append(&store, begin + i * s, {float(i)});
    TableExport table(TableExport::Csv, {column(store, 0)}, begin, begin + 99 * s);
    for (int i = 32; i < 36; ++i)
        append(&store, begin + i * s, {float(i)});
    QVERIFY(table.next(1).endsWith("Z,4,4\r\n"));
}

void tst_TableExport::aFileIsWrittenWhole()
{
    const QTemporaryDir folder;
    const QString name = folder.filePath(QStringLiteral("a.csv"));
    SignalStore store(1, 8192);
    for (int i = 0; i < 5000; ++i)
        append(&store, begin + i * s, {float(i)});
    const TableExport table(TableExport::Csv, {column(store, 0)}, begin, begin + 9999 * s);
    PlotExport job(this);
    QSignalSpy finished(&job, &PlotExport::finished);
    job.save(std::make_shared<TableExport>(table), name);
    QVERIFY(!QFile::exists(name));  // until it is whole
    QVERIFY(job.isBusy());
    QVERIFY(finished.wait());
    QVERIFY(finished[0][0].toString().contains(QStringLiteral("5000")));
    QFile file(name);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(file.readAll(), textOf(table));
}

void tst_TableExport::failureToWriteAFileIsReported()
{
    const SignalStore store(1, 16);
    PlotExport job(this);
    QSignalSpy failed(&job, &PlotExport::failed);
    job.save(tableOf(TableExport::Csv, store, 0, 1), QStringLiteral("/nowhere/at/all.csv"));
    QCOMPARE(failed.size(), 1);
    QVERIFY(failed[0][0].toString().contains(QStringLiteral("/nowhere/at/all.csv")));
    QVERIFY(!job.isBusy());
}

void tst_TableExport::givingUpLeavesNoFile()
{
    const QTemporaryDir folder;
    const QString name = folder.filePath(QStringLiteral("a.csv"));
    SignalStore store(1, 16);
    append(&store, begin, {1.0F});
    PlotExport job(this);
    QSignalSpy failed(&job, &PlotExport::failed);
    job.save(tableOf(TableExport::Csv, store, begin, begin), name);
    job.cancel(QStringLiteral("no more"));
    job.cancel(QStringLiteral("nothing to give up"));
    QCOMPARE(failed.size(), 1);
    QVERIFY(QDir(folder.path()).isEmpty());
}

void tst_TableExport::theClipboardGetsTabs()
{
    SignalStore store(1, 16);
    append(&store, begin, {1.0F});
    PlotExport job(this);
    QSignalSpy finished(&job, &PlotExport::finished);
    job.copy(tableOf(TableExport::Tsv, store, begin, begin));
    QVERIFY(finished.wait());
    QVERIFY(QGuiApplication::clipboard()->text().endsWith(QStringLiteral("\t0\t1\n")));
}

QTEST_MAIN(tst_TableExport)
#include "tst_TableExport.moc"
