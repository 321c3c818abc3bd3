// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "gui/charts/EventFiles.h"
#include "gui/plot/TableExport.h"

#include <QtCore/QDir>
#include <QtCore/QTemporaryDir>

using namespace qplc;

namespace {

constexpr SignalStore::Time s = 1'000'000'000;
constexpr SignalStore::Time begin = 1'700'000'000 * s;

}  // namespace

class tst_EventFiles : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void init();
    void settingsAreRestoredAndDefaultsAreNotWritten();
    void everyEventIsAFileWithItsRows();
    void namesOfFilesSuitEveryFileSystem();
    void fullFolderIsReportedOnceAndNoFileIsOverwritten();
    void failureToCreateTheFolderIsReportedWithTheRemedy();
    void eventsFasterThanTheDiskAreReportedWithoutBlocking();
    void cancellingLeavesNoHalfFiles();

private:
    std::shared_ptr<TextTable> table() const
    {
        const std::vector<TableExport::Column> columns{{&m_store, 0, 1.0, 0.0, "speed", "m/s"}};
        return std::make_shared<TableExport>(TableExport::Csv, columns, begin, begin + 9 * s);
    }
    QStringList files() const { return QDir(m_folder->path()).entryList(QDir::Files, QDir::Name); }

    SignalStore m_store{1, 100};
    std::unique_ptr<QTemporaryDir> m_folder;
};

void tst_EventFiles::init()
{
    m_folder = std::make_unique<QTemporaryDir>();
    if (!m_store.isEmpty())
        return;
    for (int i = 0; i < 20; ++i) {
        const auto value = float(i);
        m_store.append(begin + i * s, &value);
    }
}

void tst_EventFiles::settingsAreRestoredAndDefaultsAreNotWritten()
{
    QCOMPARE(EventFileSettings().toJson(), QJsonObject());
    const QJsonObject all{{"on", true}, {"folder", "/data"}, {"most", 7}};
    QCOMPARE(EventFileSettings::fromJson(all).toJson(), all);
    QCOMPARE(EventFileSettings::fromJson({{"most", -3}, {"folder", 5}}).most, 1);
    QVERIFY(!EventFileSettings().usedFolder().isEmpty());
}

void tst_EventFiles::everyEventIsAFileWithItsRows()
{
    EventFiles events(nullptr);
    QSignalSpy failed(&events, &EventFiles::failed);
    events.begin({true, m_folder->path() + "/new/place", 10});
    events.save(begin, "speed", table());
    events.save(begin + s / 2, "speed", table());
    QTRY_COMPARE(events.saved(), 2);
    QVERIFY(failed.isEmpty());
    QDir folder(m_folder->path() + "/new/place");
    QCOMPARE(folder.entryList(QDir::Files).size(), 2);
    QFile file(folder.filePath(folder.entryList(QDir::Files, QDir::Name).first()));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QList<QByteArray> rows = file.readAll().trimmed().split('\n');
    QCOMPARE(rows.first().trimmed(), QByteArray("UTC,time [s],speed [m/s]"));
    QCOMPARE(rows.size(), 1 + 10);
}

void tst_EventFiles::namesOfFilesSuitEveryFileSystem()
{
    const QString name = EventFiles::fileName(begin + 5'000'000, QString::fromUtf8("= sin(a/b):ä[2]"));
    QVERIFY2(name.startsWith("event_20") && name.endsWith(".005_--sin-a-b----2-.csv"), qPrintable(name));
    QVERIFY(EventFiles::fileName(begin, QString(500, 'x')).size() < 120);
}

void tst_EventFiles::fullFolderIsReportedOnceAndNoFileIsOverwritten()
{
    EventFiles events(nullptr);
    QSignalSpy failed(&events, &EventFiles::failed);
    events.begin({true, m_folder->path(), 2});
    for (int i = 0; i < 5; ++i)
        events.save(begin + i * s, "speed", table());
    QTRY_COMPARE(failed.size(), 1);
    QCOMPARE(events.saved(), 2);
    QCOMPARE(files().size(), 2);
    const QString told = failed.at(0).at(0).toString();
    QVERIFY2(told.contains("has 2 files of events. Empty it"), qPrintable(told));
    events.begin({true, m_folder->path(), 3});
    events.save(begin, "speed", table());  // there already
    events.save(begin + 7 * s, "speed", table());
    QTRY_COMPARE(events.saved(), 1);
    QCOMPARE(files().size(), 3);
}

void tst_EventFiles::failureToCreateTheFolderIsReportedWithTheRemedy()
{
    QFile file(m_folder->filePath("file"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    EventFiles events(nullptr);
    QSignalSpy failed(&events, &EventFiles::failed);
    events.begin({true, m_folder->filePath("file") + "/below", 10});
    events.save(begin, "speed", table());
    events.save(begin + s, "speed", table());
    QCOMPARE(failed.size(), 1);
    QVERIFY(failed.at(0).at(0).toString().endsWith("cannot be made. Choose another one."));
}

void tst_EventFiles::eventsFasterThanTheDiskAreReportedWithoutBlocking()
{
    EventFiles events(nullptr);
    QSignalSpy failed(&events, &EventFiles::failed);
    events.begin({true, m_folder->path(), 1000});
    for (int i = 0; i < 50; ++i)
        events.save(begin + i * s, "speed", table());
    QCOMPARE(failed.size(), 1);
    QTRY_COMPARE(events.saved(), EventFiles::MostWaiting + 1);
}

void tst_EventFiles::cancellingLeavesNoHalfFiles()
{
    EventFiles events(nullptr);
    events.begin({true, m_folder->path(), 10});
    events.save(begin, "speed", table());
    events.save(begin + s, "speed", table());
    events.cancel("gone");
    QTest::qWait(20);
    QCOMPARE(events.saved(), 0);
    QVERIFY(files().isEmpty());
}

QTEST_GUILESS_MAIN(tst_EventFiles)
#include "tst_EventFiles.moc"
