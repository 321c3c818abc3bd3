// SPDX-License-Identifier: Apache-2.0
#include "node/statistics/EventFile.h"

#include <QtCore/QDir>
#include <QtTest/QtTest>

#include <csignal>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

using qplc::EventFile;

namespace {

/// What writes to a file here, in this thread.
struct Writer
{
    explicit Writer(const QString &path, qint64 mostBytes = EventFile::usualSize, bool isUsual = false)
        : file({path, isUsual}, shared, mostBytes)
    {
    }
    EventFile::Report report() const { return shared->report(); }

    const std::shared_ptr<EventFile::SharedReport> shared = std::make_shared<EventFile::SharedReport>();
    EventFile file;
};

/// A line as long as the file looks at it: an object.
QByteArray lineOf(int number, int size)
{
    return "{\"" + QByteArray::number(number).rightJustified(size - 5, '.') + "\"}\n";
}

QByteArray contentOf(const QString &path)
{
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray("no file");
}

void write(const QString &path, const QByteArray &content)
{
    QFile file(path);
    if (!file.open(QIODevice::WriteOnly) || file.write(content) != content.size())
        qFatal("cannot write %s", qPrintable(path));
    file.close();
    file.setPermissions(QFile::ReadOwner | QFile::WriteOwner);
}

}  // namespace

class tst_EventFile : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_folder.reset(new QTemporaryDir); }
    void linesAreAppended();
    void onlyTheOwnerMayReadIt();
    void filesKeepTheirSize();
    void whatIsNotOurFileIsRefused_data();
    void whatIsNotOurFileIsRefused();
    void fileOfAnotherUserIsRefused();
    void twoMastersDoNotShareAFile();
    void incompleteLastLineIsRemoved_data();
    void incompleteLastLineIsRemoved();
    void fullDiskLosesWholeLinesAndCountsThem();
    void failedRotationPushesNoFileOut();
    void usualFolderFollowsTheStandards_data();
    void usualFolderFollowsTheStandards();

private:
    QString path(const char *name = "events.jsonl") const { return m_folder->filePath(QString::fromLatin1(name)); }

    QScopedPointer<QTemporaryDir> m_folder;
};

void tst_EventFile::linesAreAppended()
{
    for (int run = 0; run < 2; ++run) {
        Writer writer(path());
        writer.file.write(lineOf(2 * run, 20));
        writer.file.write(lineOf(2 * run + 1, 20));
        QCOMPARE(writer.report().path, path());
        QCOMPARE(writer.report().lost, quint64(0));
        QVERIFY2(!writer.report().fails, qPrintable(writer.report().problem));
    }
    QCOMPARE(contentOf(path()), lineOf(0, 20) + lineOf(1, 20) + lineOf(2, 20) + lineOf(3, 20));
}

void tst_EventFile::onlyTheOwnerMayReadIt()
{
    Writer writer(path("new/folder/events.jsonl"), EventFile::usualSize, true);
    writer.file.write(lineOf(0, 20));
    struct stat status = {};
    QCOMPARE(::stat(qPrintable(path("new/folder/events.jsonl")), &status), 0);
    QCOMPARE(status.st_mode & 07777U, 0600U);
    QCOMPARE(::stat(qPrintable(path("new/folder")), &status), 0);
    QCOMPARE(status.st_mode & 07777U, 0700U);
}

void tst_EventFile::filesKeepTheirSize()
{
    constexpr int perFile = 10;
    constexpr int size = 100;
    constexpr int lines = 12 * perFile - 3;
    Writer writer(path(), perFile * size);
    for (int i = 0; i < lines; ++i)
        writer.file.write(lineOf(i, size));
    QCOMPARE(writer.report().lost, quint64(0));
    QCOMPARE(int(QDir(m_folder->path()).entryList(QDir::Files).size()), EventFile::mostFiles);
    QByteArray kept;
    for (int number = EventFile::mostFiles - 1; number >= 0; --number) {
        const QByteArray content = contentOf(EventFile::numbered(path(), number));
        QVERIFY2(content.size() <= perFile * size, qPrintable(QString::number(content.size())));
        kept += content;
    }
    QByteArray newest;
    for (int i = lines - kept.size() / size; i < lines; ++i)
        newest += lineOf(i, size);
    QCOMPARE(kept, newest);
    QCOMPARE(kept.size(), (EventFile::mostFiles - 1) * perFile * size + (perFile - 3) * size);
}

void tst_EventFile::whatIsNotOurFileIsRefused_data()
{
    QTest::addColumn<QString>("command");
    QTest::addColumn<QString>("problem");
    QTest::newRow("symbolic link") << "ln -s victim events.jsonl"
                                   << "symbolic link";
    QTest::newRow("hard link") << "ln victim events.jsonl"
                               << "a second name";
    QTest::newRow("pipe that nobody reads") << "mkfifo -m 600 events.jsonl"
                                            << "is not a file";
    QTest::newRow("folder") << "mkdir events.jsonl"
                            << "Is a directory";
    QTest::newRow("others may write") << "mv victim events.jsonl; chmod 620 events.jsonl"
                                      << "other users may write";
    QTest::newRow("something else") << "mv victim events.jsonl; echo name,value > events.jsonl"
                                    << "not a file of events";
}

void tst_EventFile::whatIsNotOurFileIsRefused()
{
    QFETCH(QString, command);
    QFETCH(QString, problem);
    write(path("victim"), "{}\n");
    QCOMPARE(QProcess::execute("sh", {"-c", QStringLiteral("cd '%1' && %2").arg(m_folder->path(), command)}), 0);
    const bool isFile = QFileInfo(path()).isFile();  // reading a pipe takes forever
    const QByteArray before = isFile ? contentOf(path()) : QByteArray();
    Writer writer(path());
    writer.file.write(lineOf(0, 20));
    QVERIFY(writer.report().fails);
    QVERIFY2(writer.report().problem.contains(problem), qPrintable(writer.report().problem));
    QCOMPARE(writer.report().lost, quint64(1));
    QCOMPARE(isFile ? contentOf(path()) : QByteArray(), before);
}

void tst_EventFile::fileOfAnotherUserIsRefused()
{
    if (::geteuid() != 0)
        QSKIP("only root can make a file of another user");
    write(path(), "{}\n");
    QCOMPARE(::chown(qPrintable(path()), 65534, 65534), 0);
    Writer writer(path());
    writer.file.write(lineOf(0, 20));
    QVERIFY2(writer.report().problem.contains("belongs to another user"), qPrintable(writer.report().problem));
    QCOMPARE(contentOf(path()), QByteArray("{}\n"));
}

void tst_EventFile::twoMastersDoNotShareAFile()
{
    Writer first(path());
    first.file.write(lineOf(0, 20));
    Writer second(path());
    second.file.write(lineOf(1, 20));
    QVERIFY2(second.report().problem.contains("another master"), qPrintable(second.report().problem));
    Writer third(path(), EventFile::usualSize, true);
    third.file.write(lineOf(2, 20));
    QCOMPARE(third.report().path, path("events-2.jsonl"));
    QCOMPARE(contentOf(path()), lineOf(0, 20));
    QCOMPARE(contentOf(path("events-2.jsonl")), lineOf(2, 20));
}

void tst_EventFile::incompleteLastLineIsRemoved_data()
{
    QTest::addColumn<QByteArray>("rest");
    QTest::newRow("nothing") << QByteArray();
    QTest::newRow("part of a line") << QByteArray("{\"time");
    QTest::newRow("blocks of zeros") << QByteArray(8192, '\0');
}

void tst_EventFile::incompleteLastLineIsRemoved()
{
    QFETCH(QByteArray, rest);
    write(path(), lineOf(0, 20) + rest);
    {
        Writer writer(path());
        writer.file.rest();
        QCOMPARE(writer.report().removed, qint64(rest.size()));
        writer.file.write(lineOf(1, 20));
        QCOMPARE(writer.report().lost, quint64(0));
    }
    QCOMPARE(contentOf(path()), lineOf(0, 20) + lineOf(1, 20));
}

/// The system cuts the line that reaches the limit, as a full disk does.
void tst_EventFile::fullDiskLosesWholeLinesAndCountsThem()
{
    rlimit before = {};
    QCOMPARE(::getrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small = {1000, before.rlim_max};
    Writer writer(path());
    writer.file.rest();
    QCOMPARE(::setrlimit(RLIMIT_FSIZE, &small), 0);
    for (int i = 0; i < 5; ++i)
        writer.file.write(lineOf(i, 300));
    QCOMPARE(::setrlimit(RLIMIT_FSIZE, &before), 0);
    QCOMPARE(writer.report().lost, quint64(2));
    QVERIFY(writer.report().fails);
    QVERIFY2(writer.report().problem.startsWith(path()), qPrintable(writer.report().problem));
    QCOMPARE(contentOf(path()), lineOf(0, 300) + lineOf(1, 300) + lineOf(2, 300));
    quint64 lost = 2;
    for (; writer.report().fails; ++lost) {
        QTest::qSleep(100);
        writer.file.write(lineOf(9, 300));
    }
    QCOMPARE(writer.report().lost, lost - 1);
    QVERIFY(contentOf(path()).endsWith(lineOf(2, 300) + lineOf(9, 300)));
}

/// A folder in the place of the oldest file cannot be replaced by a file.
void tst_EventFile::failedRotationPushesNoFileOut()
{
    constexpr int oldest = EventFile::mostFiles - 1;
    for (int number = 1; number < oldest; ++number)
        write(EventFile::numbered(path(), number), QByteArray::number(number));
    QVERIFY(QDir().mkpath(EventFile::numbered(path(), oldest) + "/full"));
    Writer writer(path(), 100);
    writer.file.write(lineOf(0, 100));
    writer.file.write(lineOf(1, 100));
    QCOMPARE(writer.report().lost, quint64(1));
    QVERIFY(writer.report().fails);
    QCOMPARE(contentOf(path()), lineOf(0, 100));
    for (int number = 1; number < oldest; ++number)
        QCOMPARE(contentOf(EventFile::numbered(path(), number)), QByteArray::number(number));
}

void tst_EventFile::usualFolderFollowsTheStandards_data()
{
    QTest::addColumn<QStringList>("environment");
    QTest::addColumn<QString>("path");
    QTest::newRow("logs of a service") << QStringList{"LOGS_DIRECTORY=/a:/b", "STATE_DIRECTORY=/c"} << "/a/M.jsonl";
    QTest::newRow("state of a service") << QStringList{"STATE_DIRECTORY=/c", "XDG_STATE_HOME=/d"} << "/c/M.jsonl";
    QTest::newRow("user") << QStringList{"XDG_STATE_HOME=/d"} << "/d/qtplc/M.jsonl";
    QTest::newRow("usual") << QStringList{"HOME=/h"}
                           << (::geteuid() == 0 ? "/var/log/qtplc/M.jsonl" : "/h/.local/state/qtplc/M.jsonl");
    QTest::newRow("relative folders do not count")
        << QStringList{"LOGS_DIRECTORY=a", "XDG_STATE_HOME=d", "HOME=/h"}
        << (::geteuid() == 0 ? "/var/log/qtplc/M.jsonl" : "/h/.local/state/qtplc/M.jsonl");
}

void tst_EventFile::usualFolderFollowsTheStandards()
{
    QFETCH(QStringList, environment);
    QFETCH(QString, path);
    QMap<QByteArray, QByteArray> before;
    for (const char *name : {"LOGS_DIRECTORY", "STATE_DIRECTORY", "XDG_STATE_HOME", "HOME"}) {
        if (qEnvironmentVariableIsSet(name))
            before.insert(name, qgetenv(name));
        qunsetenv(name);
    }
    for (const QString &each : environment)
        qputenv(qPrintable(each.section('=', 0, 0)), each.section('=', 1).toLatin1());
    const EventFile::Place place = EventFile::usualPlace("M");
    for (const char *name : {"LOGS_DIRECTORY", "STATE_DIRECTORY", "XDG_STATE_HOME", "HOME"})
        before.contains(name) ? qputenv(name, before.value(name)) : qunsetenv(name);
    QCOMPARE(place.path, path);
    QVERIFY(place.isUsual);
}

QTEST_GUILESS_MAIN(tst_EventFile)
#include "tst_EventFile.moc"
