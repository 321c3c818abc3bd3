// SPDX-License-Identifier: Apache-2.0
#include "NodeFixtures.h"
#include "VirtualTime.h"
#include "node/statistics/EventKeeper.h"
#include "protocol/messages/StoredEvent.h"

#include <QtCore/QSemaphore>
#include <QtCore/QTemporaryDir>

using qplc::EventFile;
using qplc::EventKeeper;
using qplc::Journal;
using qplc::JournalEvent;
using qplc::messages::StoredEvent;

namespace {

/// A disk that takes a line when it is told to.
class HangingDisk final : public qplc::LogOutput
{
public:
    explicit HangingDisk(std::shared_ptr<QSemaphore> permits)
        : m_permits(std::move(permits))
    {
    }
    void write(const QByteArray &) override { m_permits->acquire(); }
    QByteArray gapText(quint64) const override { return {}; }

private:
    const std::shared_ptr<QSemaphore> m_permits;
};

constexpr int allLines = 1'000'000;

}  // namespace

// Events of a master in a file: what is in it, and what is told of it.
class tst_EventKeeper : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void cleanup() { m_keeper.reset(); }
    void eventIsStoredWithAllThatIsKnown();
    void eventsBeforeTheFileAreInIt();
    void hangingDiskIsToldAndDelaysNobody();
    void slowDiskLosesEventsWithTheirNumber();
    void fileThatCannotBeWrittenIsToldUntilItCan();
    void removedLineIsTold();
    void masterWritesAFileWhereItMatters_data();
    void masterWritesAFileWhereItMatters();
    void simulatedMasterWritesNoFile();

private:
    void tell(const QString &text)
    {
        m_journal->tell(JournalEvent::Info, JournalEvent::Node, QStringLiteral("Winch"), text);
    }
    QStringList texts(const QString &part) const
    {
        QStringList texts;
        for (const JournalEvent &event : m_journal->events().after(0, 10000))
            texts << event.text;
        return texts.filter(part);
    }
    /// Waits until the keeper has looked, and found that.
    bool isTold(const QString &part)
    {
        return waitUntil([&] { return !texts(part).isEmpty(); }, 60000);
    }
    QString path() const { return m_folder->filePath(QStringLiteral("events.jsonl")); }
    std::vector<StoredEvent> stored() const
    {
        QFile file(path());
        std::vector<StoredEvent> events;
        if (!file.open(QIODevice::ReadOnly))
            return events;
        while (!file.atEnd()) {
            events.emplace_back();
            if (!events.back().fromLine(file.readLine()))
                qFatal("a line of %s is no event", qPrintable(path()));
        }
        return events;
    }

    std::optional<quint64> m_cycle;
    QScopedPointer<QTemporaryDir> m_folder;
    std::unique_ptr<Journal> m_journal;
    std::unique_ptr<EventKeeper> m_keeper;
};

void tst_EventKeeper::init()
{
    QLoggingCategory::setFilterRules(QStringLiteral("qtplc.master=false"));
    m_cycle.reset();
    m_folder.reset(new QTemporaryDir);
    m_journal = std::make_unique<Journal>();
    m_keeper = std::make_unique<EventKeeper>(
        *m_journal, EventKeeper::Master{0x1234, [] { return std::nullopt; }, [this] { return m_cycle; }});
}

void tst_EventKeeper::eventIsStoredWithAllThatIsKnown()
{
    m_keeper->setFile(path());
    tell(QStringLiteral("a"));
    m_cycle = 4711;
    m_journal->commanded(QStringLiteral("anna"), QStringLiteral("127.0.0.1:40312"), QStringLiteral("SafeStop"),
                         QStringLiteral(" from there"));
    m_journal->raise(QStringLiteral("node Winch"), JournalEvent::Error, JournalEvent::Node, QStringLiteral("Winch"),
                     QStringLiteral("gone"));
    m_keeper->setFile(QString());
    const std::vector<StoredEvent> events = stored();
    const std::vector<JournalEvent> told = m_journal->events().after(0, 10);
    QCOMPARE(int(events.size()), 3);
    for (std::size_t i = 0; i < events.size(); ++i) {
        QCOMPARE(events[i].sequence, i + 1);
        QCOMPARE(quint64(events[i].run), quint64(0x1234));
        QCOMPARE(quint64(events[i].time), quint64(told[i].time));
        QCOMPARE(QDateTime::fromString(events[i].utc, Qt::ISODateWithMs).toMSecsSinceEpoch(), told[i].time / 1'000'000);
        QVERIFY(qAbs(events[i].monotonic - double(told[i].monotonic) * 1e-9) < 2e-6);
        QCOMPARE(events[i].text, told[i].text);
    }
    QVERIFY(!events[0].cycle.has_value() && events[0].address.isEmpty());
    QCOMPARE(events[1].cycle.value_or(0), quint64(4711));
    QCOMPARE(events[1].address, QStringLiteral("127.0.0.1:40312"));
    QCOMPARE(events[1].source, QStringLiteral("anna"));
    QCOMPARE(events[1].kind, QStringLiteral("security"));
    QCOMPARE(events[2].severity, QStringLiteral("error"));
    QCOMPARE(events[2].alarm, QStringLiteral("node Winch"));
    QCOMPARE(events[2].active, std::optional<bool>(true));
}

void tst_EventKeeper::eventsBeforeTheFileAreInIt()
{
    for (int i = 0; i < 5; ++i)
        tell(QString::number(i));
    m_cycle = 3;
    m_keeper->setFile(path());
    tell(QStringLiteral("5"));
    m_keeper->setFile(QString());
    QCOMPARE(int(stored().size()), 6);
    QVERIFY(!stored()[0].cycle.has_value());
    QVERIFY(stored()[5].cycle.has_value());
}

void tst_EventKeeper::hangingDiskIsToldAndDelaysNobody()
{
    const auto permits = std::make_shared<QSemaphore>();
    m_keeper->setOutput(std::make_unique<HangingDisk>(permits));
    for (int i = 0; i < 10; ++i)
        tell(QString::number(i));  // returns, though nothing is written
    for (int i = 0; i < EventKeeper::mostRests - 1; ++i)
        m_keeper->check();
    QVERIFY(texts(QStringLiteral("cannot be written")).isEmpty());
    m_keeper->check();
    QCOMPARE(texts(QStringLiteral("the disk takes nothing")).size(), 1);
    m_journal->clearAll(QStringLiteral("a phase has begun"));
    QVERIFY(texts(QStringLiteral("a phase has begun")).isEmpty());
    permits->release(allLines);
    QVERIFY(isTold(QStringLiteral("written to  again; 0 are missing")));
    QCOMPARE(texts(QStringLiteral("cannot be written")).size(), 1);
}

void tst_EventKeeper::slowDiskLosesEventsWithTheirNumber()
{
    const auto permits = std::make_shared<QSemaphore>();
    m_keeper->setOutput(std::make_unique<HangingDisk>(permits));
    const QString longText(qplc::EventLog::LongestText, QLatin1Char('x'));
    const int tooMany = 2 * qplc::LogWriter::mostBytes / longText.size();
    for (int i = 0; i < tooMany; ++i)
        tell(longText);
    QVERIFY(isTold(QStringLiteral("the disk")));
    permits->release(allLines);
    QVERIFY(isTold(QStringLiteral("again; ")));
    const QString told = texts(QStringLiteral("again; ")).constFirst();
    const int lost = told.section(QStringLiteral("again; "), 1).section(QLatin1Char(' '), 0, 0).toInt();
    QVERIFY2(lost > tooMany / 4 && lost < tooMany, qPrintable(told));
}

void tst_EventKeeper::fileThatCannotBeWrittenIsToldUntilItCan()
{
    m_keeper->setFile(m_folder->filePath(QStringLiteral("later/events.jsonl")));
    tell(QStringLiteral("a"));
    QVERIFY(isTold(QStringLiteral("cannot be written: %1/later/events.jsonl: No such file").arg(m_folder->path())));
    QVERIFY(QDir(m_folder->path()).mkdir(QStringLiteral("later")));
    QTimer often;
    connect(&often, &QTimer::timeout, this, [this] { tell(QStringLiteral("b")); });
    often.start(100);
    QVERIFY(isTold(QStringLiteral("later/events.jsonl again; ")));
}

void tst_EventKeeper::removedLineIsTold()
{
    QFile file(path());
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("{\"a\":1}\n{\"b");
    file.close();
    file.setPermissions(QFile::ReadOwner | QFile::WriteOwner);
    m_keeper->setFile(path());
    QVERIFY(isTold(QStringLiteral("was incomplete and was removed (3 bytes)")));
}

void tst_EventKeeper::masterWritesAFileWhereItMatters_data()
{
    QTest::addColumn<int>("profile");
    QTest::addColumn<bool>("isServing");
    QTest::addColumn<bool>("isWritten");
    QTest::newRow("plant") << int(QPlcProfile::Plant) << true << true;
    QTest::newRow("plant that nobody can reach") << int(QPlcProfile::Plant) << false << false;
    QTest::newRow("simulation") << int(QPlcProfile::Simulation) << true << false;
}

void tst_EventKeeper::masterWritesAFileWhereItMatters()
{
    QFETCH(int, profile);
    QFETCH(bool, isServing);
    QFETCH(bool, isWritten);
    qputenv("XDG_STATE_HOME", m_folder->path().toLocal8Bit());
    TestMaster master;
    master.setProfile(QPlcProfile::Value(profile));
    QVERIFY(!isServing || master.listen());
    QVERIFY(!isServing || master.initializeAllStates());
    const QString file = m_folder->filePath(QStringLiteral("qtplc/tst_EventKeeper.jsonl"));
    QCOMPARE(waitUntil([&] { return QFile::exists(file); }, isWritten ? 60000 : 100), isWritten);
    QCOMPARE(master.eventFile(), isWritten ? file : QString());
    master.setEventFile(QString());
    QCOMPARE(master.eventFile(), QString());
    master.setEventFile(path());
    QVERIFY(waitUntil([&] { return QFile::exists(path()); }, 60000));
    QCOMPARE(master.eventFile(), path());
}

void tst_EventKeeper::simulatedMasterWritesNoFile()
{
    qputenv("XDG_STATE_HOME", m_folder->path().toLocal8Bit());
    runInVirtualTime([] {
        TestMaster master;
        QVERIFY(master.listen());
        QVERIFY(master.initializeAllStates());
        QCOMPARE(master.eventFile(), QString());
    });
    QVERIFY(QDir(m_folder->path()).isEmpty());
}

QTEST_GUILESS_MAIN(tst_EventKeeper)
#include "tst_EventKeeper.moc"
