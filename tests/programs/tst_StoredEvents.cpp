// SPDX-License-Identifier: Apache-2.0
#include "ProcessPlant.h"

#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

#include <unistd.h>

/// Events of a master that survive it, with programs.
class tst_StoredEvents : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void cleanup() { m_plant.reset(); }
    void killedMasterLeavesAllItsEvents();
    void nextMasterContinuesTheFile();
    void fullDiskStopsNothing();
    void olderFilesAreShownFirst();
    void missingEventsAreShown();
    void linesThatAreNoEventsAreTold();
    void badCallsAreRefused_data();
    void badCallsAreRefused();

private:
    QStringList asked() const { return linesOf(m_plant->qtplc(QStringLiteral("events"))); }
    QStringList stored(const QStringList &options = {}) const
    {
        return linesOf(runProgram(programPath("qtplc"), QStringList{"events", "--file", m_file} + options));
    }
    static QStringList linesOf(const Outcome &outcome)
    {
        return outcome.exitCode == 0 ? outcome.output.split(QLatin1Char('\n'), Qt::SkipEmptyParts)
                                     : QStringList{QStringLiteral("failed: ") + outcome.errors};
    }
    bool startPlant() const { return m_plant->qtplc(QStringLiteral("start")).exitCode == 0; }
    bool stopPlant() const { return m_plant->qtplc(QStringLiteral("stop")).exitCode == 0; }
    static void append(const QString &path, const QByteArray &lines)
    {
        QFile file(path);
        if (!file.open(QIODevice::Append) || file.write(lines) != lines.size())
            qFatal("cannot write %s", qPrintable(path));
    }
    static QByteArray event(int run, int sequence)
    {
        return QStringLiteral(R"({"run":"%1","sequence":%2,"severity":"info","kind":"state","source":"Master",)"
                              R"("text":"event %1.%2","time":"18eb89392534e3e9"})")
                   .arg(run, 16, 16, QLatin1Char('0'))
                   .arg(sequence)
                   .toUtf8()
            + '\n';
    }
    QString outputOfFile() const { return stored().join(QLatin1Char('\n')); }

    QScopedPointer<QTemporaryDir> m_folder;
    QString m_file;
    QScopedPointer<ProcessPlant> m_plant;
};

void tst_StoredEvents::init()
{
    m_folder.reset(new QTemporaryDir);
    m_file = m_folder->filePath(QStringLiteral("events.jsonl"));
    m_plant.reset(new ProcessPlant);
}

void tst_StoredEvents::killedMasterLeavesAllItsEvents()
{
    QVERIFY(m_plant->start({"--events=" + m_file}));
    for (int i = 0; i < 5; ++i)
        QVERIFY(startPlant() && stopPlant());
    QVERIFY(startPlant());
    const QStringList events = asked();
    QVERIFY(events.size() > 10);
    m_plant->master().kill();
    m_plant->master().waitForEnd();
    QCOMPARE(stored().mid(0, events.size()), events);  // it may have told more before its end
}

void tst_StoredEvents::nextMasterContinuesTheFile()
{
    QStringList events;
    for (int run = 0; run < 2; ++run) {
        m_plant.reset(new ProcessPlant);
        QVERIFY(m_plant->start({"--events=" + m_file}));
        QVERIFY(startPlant());
        events += asked();
        m_plant->master().kill();
        m_plant->master().waitForEnd();
    }
    QCOMPARE(stored(), events);
    QSet<QString> runs;
    for (const QString &line : stored({"--json"}))
        runs.insert(QJsonDocument::fromJson(line.toUtf8()).object().value("run").toString());
    QCOMPARE(int(runs.size()), 2);
}

/// On a disk of its own, in a mount namespace of the master.
void tst_StoredEvents::fullDiskStopsNothing()
{
    if (::geteuid() != 0 || runProgram("unshare", {"--mount", "true"}).exitCode != 0)
        QSKIP("only root can make a small disk");
    const QString script = QStringLiteral("mount -t tmpfs -o size=64k tmpfs '%1' && exec '%2' --port=0 --events='%3'")
                               .arg(m_folder->path(), programPath("awe_master"), m_file);
    Program master(QStringLiteral("unshare"), {"--mount", "sh", "-c", script});
    QVERIFY2(master.waitForOutput(QStringLiteral("\n")), qPrintable(master.errors()));
    m_plant->port = master.output().section(QLatin1Char('\n'), 0, 0).section(QLatin1Char(' '), 1);
    const QString root = QStringLiteral("/proc/%1/root").arg(master.processId());
    QVERIFY(startPlant());
    QFile filler(root + m_folder->filePath(QStringLiteral("filler")));
    QVERIFY(filler.open(QIODevice::WriteOnly | QIODevice::Unbuffered));
    while (filler.write(QByteArray(1024, 'x')) == 1024) {}
    const auto isTold = [this](const char *part) {
        if (!stopPlant() || !startPlant())
            qFatal("the plant cannot be started and stopped");
        return !asked().filter(QString::fromLatin1(part)).isEmpty();
    };
    QTRY_VERIFY_WITH_TIMEOUT(isTold("No space left on device"), 10 * Program::patience);
    QVERIFY(filler.remove());
    filler.close();
    QTRY_VERIFY_WITH_TIMEOUT(isTold("events.jsonl again; "), 10 * Program::patience);
    const QStringList events = asked();
    m_file = root + m_file;
    const QStringList kept = stored();
    const QStringList gaps
        = kept.filter(QRegularExpression(QStringLiteral("^\\.\\.\\. \\d+ events are missing here$")));
    QVERIFY(!gaps.isEmpty() && kept.size() < events.size());
    for (const QString &line : kept)
        QVERIFY2(events.contains(line) || gaps.contains(line), qPrintable(line));
}

void tst_StoredEvents::olderFilesAreShownFirst()
{
    append(m_file + ".2", event(1, 1) + event(1, 2));
    append(m_file + ".1", event(1, 3) + event(2, 1));
    append(m_file, event(2, 2));
    append(m_file + ".old", event(3, 1));
    const QStringList texts = stored().replaceInStrings(QRegularExpression("^.*event \\d+\\."), QString());
    QCOMPARE(texts, (QStringList{"1", "2", "3", "1", "2"}));
}

void tst_StoredEvents::missingEventsAreShown()
{
    append(m_file, event(1, 7) + event(1, 10) + event(2, 3));
    const QStringList shown = stored();
    QCOMPARE(int(shown.size()), 4);
    QCOMPARE(shown[1], QStringLiteral("... 2 events are missing here"));
    QCOMPARE(int(stored({"--json"}).size()), 3);
}

void tst_StoredEvents::linesThatAreNoEventsAreTold()
{
    append(m_file, event(1, 1) + "{\"a\":1}\nnonsense\n" + event(1, 2));
    const Outcome outcome = runProgram(programPath("qtplc"), {"events", "--file", m_file});
    QCOMPARE(outcome.exitCode, 1);
    QCOMPARE(int(outcome.output.count("event ")), 2);
    QVERIFY2(outcome.errors.contains("2 lines are not events"), qPrintable(outcome.errors));
}

void tst_StoredEvents::badCallsAreRefused_data()
{
    QTest::addColumn<QStringList>("options");
    QTest::addColumn<int>("exitCode");
    QTest::addColumn<QString>("error");
    QTest::newRow("no such file") << QStringList{"--file", "/nowhere/e.jsonl"} << 1 << "cannot read /nowhere/e.jsonl";
    QTest::newRow("follow") << QStringList{"--file", "e.jsonl", "--follow"} << 2 << "--follow needs a master";
}

void tst_StoredEvents::badCallsAreRefused()
{
    QFETCH(QStringList, options);
    QFETCH(int, exitCode);
    QFETCH(QString, error);
    const Outcome outcome = runProgram(programPath("qtplc"), QStringList{"events"} + options);
    QCOMPARE(outcome.exitCode, exitCode);
    QVERIFY2(outcome.errors.contains(error), qPrintable(outcome.errors));
}

QTEST_GUILESS_MAIN(tst_StoredEvents)
#include "tst_StoredEvents.moc"
