// SPDX-License-Identifier: Apache-2.0
#include "RingFixtures.h"
#include "node/session/PhaseRing.h"

#include <QtCore/QDir>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

using namespace qplc;

// Which ring a phase has, and which rings are deleted.
class tst_PhaseRing : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void aPhaseHasARingWithItsDescription();
    void theRingIsReadyBeforeThePhaseBegins();
    void theRingOfTheLastPhaseIsDeleted();
    void aRingThatIsRecordedStays();
    void aMasterWithoutANameHasNone();
    void ringsOfMastersThatWereKilledStay();
    void onlyTheNewestFourStay();
    void withoutMemoryThereIsNoneAndTheJournalSaysWhy();
    void anotherDescriptionIsRefused();

private:
    static RingDescription description()
    {
        RingDescription result;
        result.period = 1'000'000;
        result.clock = "real-time";
        result.table = "[x]\ntype = Real64\n";
        return result;
    }
    QStringList files() const { return QDir(m_folder->path()).entryList(QDir::Files); }
    /// A ring that no process writes any more.
    void addDead(const char *name, bool isRecorded) const
    {
        RecordRing ring;
        QString error;
        const QByteArray file = m_folder->filePath(prefix() + name).toUtf8();
        QVERIFY2(ring.create(file, 1 << 16, {}, &error), qPrintable(error));
        RingReader recorder;
        QVERIFY(recorder.open(file, &error));
        if (isRecorded)
            QVERIFY(recorder.attach());
    }
    static QString prefix() { return QStringLiteral("qtplc-ring-%1-").arg(::getuid()); }

    std::unique_ptr<QTemporaryDir> m_folder;
    Journal m_journal;
};

void tst_PhaseRing::init()
{
    m_folder = std::make_unique<QTemporaryDir>("/dev/shm/qtplc-test-XXXXXX");
    QVERIFY(m_folder->isValid());
    qputenv("QTPLC_RING_DIR", m_folder->path().toUtf8());
}

void tst_PhaseRing::aPhaseHasARingWithItsDescription()
{
    PhaseRing rings(m_journal);
    rings.setPlant("kite: \"1\"", 0x1234);
    const std::shared_ptr<RecordRing> ring = rings.make(description(), 1000);
    QVERIFY(ring);
    QCOMPARE(rings.file(), m_folder->filePath(prefix() + "kite___1_-1234-1"));
    RingReader reader;
    QString error;
    QVERIFY2(reader.open(rings.file().toUtf8(), &error), qPrintable(error));
    RingDescription read;
    QVERIFY(RingDescription::fromText(reader.memory().description(), &read));
    QCOMPARE(read.plant, QString("kite: \"1\""));
    QCOMPARE(read.session, quint64(0x1234));
    QCOMPARE(read.phase, quint64(1));
    QCOMPARE(read.period, qint64(1'000'000));
    QCOMPARE(read.clock, QString("real-time"));
    QCOMPARE(read.table, description().table);
    QCOMPARE(ring->memory().capacity(), quint64(64) << 20);  // 60 s of 1000 records a second
}

void tst_PhaseRing::theRingIsReadyBeforeThePhaseBegins()
{
    PhaseRing rings(m_journal);
    rings.setPlant("kite", 1);
    QString ready;
    rings.setCallback([&ready](const QString &file) { ready = file; });
    QVERIFY(rings.make(description(), 100));
    QCOMPARE(ready, rings.file());
}

void tst_PhaseRing::theRingOfTheLastPhaseIsDeleted()
{
    {
        PhaseRing rings(m_journal);
        rings.setPlant("kite", 1);
        QVERIFY(rings.make(description(), 100));
        QVERIFY(rings.make(description(), 100));
        QCOMPARE(files(), QStringList(prefix() + "kite-1-2"));
    }
    QCOMPARE(files(), QStringList());
}

void tst_PhaseRing::aRingThatIsRecordedStays()
{
    RingReader recorder;
    {
        PhaseRing rings(m_journal);
        rings.setPlant("kite", 1);
        QVERIFY(rings.make(description(), 100));
        QString error;
        QVERIFY(recorder.open(rings.file().toUtf8(), &error));
        QVERIFY(recorder.attach());
        QVERIFY(rings.make(description(), 100));
        QCOMPARE(files().size(), 2);
    }
    QCOMPARE(files(), QStringList(prefix() + "kite-1-1"));
    recorder.memory().remove();
    QCOMPARE(files(), QStringList());
}

void tst_PhaseRing::aMasterWithoutANameHasNone()
{
    PhaseRing rings(m_journal);
    QVERIFY(!rings.make(description(), 100));
    QCOMPARE(files(), QStringList());
}

void tst_PhaseRing::ringsOfMastersThatWereKilledStay()
{
    addDead("dead", false);
    RecordRing alive;
    QString error;
    QVERIFY(alive.create(m_folder->filePath(prefix() + "alive").toUtf8(), 1 << 16, {}, &error));
    QVERIFY(QFile::link("/dev/null", m_folder->filePath(prefix() + "link")));
    PhaseRing rings(m_journal);
    rings.setPlant("kite", 1);
    QVERIFY(rings.make(description(), 100));
    QCOMPARE(files(), QStringList({prefix() + "alive", prefix() + "dead", prefix() + "kite-1-1", prefix() + "link"}));
}

void tst_PhaseRing::onlyTheNewestFourStay()
{
    for (const char *name : {"a", "b", "c", "d", "e", "f"})
        addDead(name, name[0] > 'c');
    PhaseRing::removeDead();
    QCOMPARE(files().size(), 4);
    PhaseRing::removeDead();
    QCOMPARE(files().size(), 4);
}

void tst_PhaseRing::withoutMemoryThereIsNoneAndTheJournalSaysWhy()
{
    qputenv("QTPLC_RING_DIR", "/no-such-folder");
    QTest::ignoreMessage(QtWarningMsg, QRegularExpression("cannot be recorded"));
    PhaseRing rings(m_journal);
    rings.setPlant("kite", 1);
    QVERIFY(!rings.make(description(), 100));
    QVERIFY(rings.file().isEmpty());
    const std::vector<JournalEvent> told = m_journal.events().after(0, 100);
    QCOMPARE(told.size(), std::size_t(1));
    QVERIFY2(told[0].text.contains("/no-such-folder"), qPrintable(told[0].text));
}

void tst_PhaseRing::anotherDescriptionIsRefused()
{
    RingDescription read;
    QVERIFY(!RingDescription::fromText("", &read));
    QVERIFY(!RingDescription::fromText("format: qtplc-ring-2\nperiod_ns: 1\n\n", &read));
    QVERIFY(!RingDescription::fromText("format: qtplc-ring-1\nperiod_ns: 0\n\n", &read));
    QVERIFY(RingDescription::fromText("format: qtplc-ring-1\nperiod_ns: 1\nlater: x\n\n", &read));
}

QTEST_GUILESS_MAIN(tst_PhaseRing)
#include "tst_PhaseRing.moc"
