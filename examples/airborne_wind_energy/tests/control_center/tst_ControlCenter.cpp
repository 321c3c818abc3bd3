// SPDX-License-Identifier: Apache-2.0
#include "Program.h"

#include <QtCore/QDirIterator>
#include <QtCore/QFile>
#include <QtCore/QTemporaryDir>
#include <QtGui/QImage>
#include <QtTest/QtTest>

#include <csignal>
#include <sys/stat.h>

namespace {

/// How many colours a picture has; those beyond \a most are not all counted. A blank one has one.
int colours(const QImage &image, int most)
{
    QSet<QRgb> seen;
    for (int y = 0; y < image.height() && seen.size() < most; ++y) {
        for (int x = 0; x < image.width(); ++x)
            seen.insert(image.pixel(x, y));
    }
    return seen.size();
}

}  // namespace

/// awe_control_center on a screen, from outside.
class tst_ControlCenter : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void helpHasExamples();
    void badOptionIsRefusedWithTheRemedy_data();
    void badOptionIsRefusedWithTheRemedy();
    void programWithoutDisplayReportsTheRemedy();
    void demoSavesAPictureAndEndsAllItsPrograms_data();
    void demoSavesAPictureAndEndsAllItsPrograms();
    void windowWithoutPlantShowsTheStartPage();
    void missingMasterDoesNotBlockTheWindow();
    void failureToWriteThePictureIsReportedAtTheEnd();
    void pictureDoesNotReplaceAPipe();
    void pictureIsGivenUpWhereProgramsOfTheDemoAreMissing();
    void programEndedBeforeItsPictureReportsFailure_data();
    void programEndedBeforeItsPictureReportsFailure();
    void windowOutlivesItsPrograms_data();
    void windowOutlivesItsPrograms();
    void windowEndsAllProgramsOfTheDemo_data();
    void windowEndsAllProgramsOfTheDemo();
    void signalEndsTheWindowInOrder();

private:
    static QString program() { return QStringLiteral(AWE_PROGRAMS "/awe_control_center"); }
    static QString picture(const QString &name)
    {
        const QString file = QStringLiteral(AWE_SCREENSHOTS "/awe_%1.png").arg(name);
        QFile::remove(file);
        return file;
    }
    /// The programs of the demo; empty when they do not come.
    static QList<qint64> waitForPrograms(Program &window);

    QTemporaryDir m_home;  // for the settings of the window
};

void tst_ControlCenter::initTestCase()
{
    QVERIFY(qputenv("XDG_CONFIG_HOME", m_home.path().toUtf8()));
}

QList<qint64> tst_ControlCenter::waitForPrograms(Program &window)
{
    QList<qint64> pids;
    return QTest::qWaitFor([&] { return (pids = childrenOf(window.processId())).size() == 3; }, Program::patience)
        ? pids
        : QList<qint64>();
}

void tst_ControlCenter::helpHasExamples()
{
    const Outcome outcome = runProgram(program(), {QStringLiteral("--help")});
    QCOMPARE(outcome.exitCode, 0);
    for (const char *text :
         {"Examples:", "awe_control_center --demo", "--master", "--screenshot", "--after", "--theme"})
        QVERIFY2(outcome.output.contains(QLatin1String(text)), text);
}

void tst_ControlCenter::badOptionIsRefusedWithTheRemedy_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("remedy");
    const auto row = [](const char *name, const QStringList &arguments, const char *remedy) {
        QTest::newRow(name) << arguments << QString::fromLatin1(remedy);
    };
    row("theme", {QStringLiteral("--theme=pink")}, "use one of system, light, dark, sunlight");
    row("size", {QStringLiteral("--size=big")}, "for example 1366x768");
    row("size without height", {QStringLiteral("--size=1366x")}, "for example 1366x768");
    row("master without name", {QStringLiteral("--master==localhost:50000")}, "NAME=HOST:PORT");
    row("empty master", {QStringLiteral("--master=")}, "use HOST:PORT");
    row("after alone", {QStringLiteral("--after=3")}, "give --screenshot");
    row("after nonsense", {QStringLiteral("--screenshot=x.png"), QStringLiteral("--after=soon")}, "use a number of");
    row("picture of no kind", {QStringLiteral("--screenshot=x.doc")}, "ends in .png");
    row("picture in no folder", {QStringLiteral("--screenshot=/nowhere/x.png")}, "there is no folder '/nowhere'");
    row("layout that is not there", {QStringLiteral("--layout=/nowhere/x.json")}, "/nowhere/x.json");
    row("tab that is not there", {QStringLiteral("--tab=Kitchen"), QStringLiteral("--demo")}, "no such tab");
    row("unknown", {QStringLiteral("--fly")}, "see --help");
}

void tst_ControlCenter::badOptionIsRefusedWithTheRemedy()
{
    QFETCH(QStringList, arguments);
    QFETCH(QString, remedy);
    const Outcome outcome = runProgram(program(), arguments);
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY2(outcome.errors.contains(remedy), qPrintable(outcome.errors));
    QCOMPARE(outcome.output, QString());
}

void tst_ControlCenter::programWithoutDisplayReportsTheRemedy()
{
    const QByteArray display = qgetenv("DISPLAY");
    qunsetenv("DISPLAY");
    qunsetenv("QT_QPA_PLATFORM");
    const Outcome refused = runProgram(program(), {QStringLiteral("--demo")});
    const Outcome help = runProgram(program(), {QStringLiteral("--help")});
    qputenv("DISPLAY", ":65000");  // of a session that has ended, say
    const Outcome unreachable = runProgram(program(), {QStringLiteral("--demo")});
    qputenv("DISPLAY", display);
    qputenv("QT_QPA_PLATFORM", "xcb");
    QCOMPARE(refused.exitCode, 2);
    QVERIFY2(refused.errors.contains(QLatin1String("there is no display")), qPrintable(refused.errors));
    QCOMPARE(help.exitCode, 0);
    QCOMPARE(unreachable.exitCode, 2);
    QVERIFY2(
        unreachable.errors.contains(QLatin1String("awe_control_center: cannot open a window on display ':65000'; ")),
        qPrintable(unreachable.errors));
    QVERIFY2(unreachable.errors.contains(QLatin1String("xvfb-run -a awe_control_center")),
             qPrintable(unreachable.errors));
}

void tst_ControlCenter::demoSavesAPictureAndEndsAllItsPrograms_data()
{
    QTest::addColumn<QString>("tab");
    QTest::addColumn<QString>("theme");
    QTest::addColumn<QSize>("size");
    QTest::newRow("fly") << QStringLiteral("Fly") << QStringLiteral("dark") << QSize(1366, 768);
    QTest::newRow("ground station") << QStringLiteral("Ground station") << QStringLiteral("light") << QSize(1280, 720);
    QTest::newRow("real time") << QStringLiteral("Real time") << QStringLiteral("sunlight") << QSize(1024, 700);
}

void tst_ControlCenter::demoSavesAPictureAndEndsAllItsPrograms()
{
    QFETCH(QString, tab);
    QFETCH(QString, theme);
    QFETCH(QSize, size);
    const QString file = picture(QString(tab).replace(QLatin1Char(' '), QLatin1Char('_')).toLower());
    Program window(program(),
                   {QStringLiteral("--demo"), QStringLiteral("--after=3"), QStringLiteral("--screenshot"), file,
                    QStringLiteral("--tab"), tab, QStringLiteral("--theme"), theme,
                    QStringLiteral("--size=%1x%2").arg(size.width()).arg(size.height())});
    const QList<qint64> pids = waitForPrograms(window);
    QCOMPARE(pids.size(), 3);
    QCOMPARE(window.waitForEnd(), 0);
    QCOMPARE(stillRunning(pids), QList<qint64>());
    QVERIFY2(QRegularExpression(QStringLiteral("^flying after \\d+\\.\\d s\n$")).match(window.output()).hasMatch(),
             qPrintable(window.output()));
    const QImage image(file);
    QCOMPARE(image.size(), size);
    QVERIFY(colours(image, 20) >= 20);
}

void tst_ControlCenter::windowWithoutPlantShowsTheStartPage()
{
    const QString file = picture(QStringLiteral("start_page"));
    const Outcome outcome = runProgram(
        program(),
        {QStringLiteral("--screenshot"), file, QStringLiteral("--after=1"), QStringLiteral("--size=1366x768")});
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(QImage(file).size(), QSize(1366, 768));
}

void tst_ControlCenter::missingMasterDoesNotBlockTheWindow()
{
    const QString file = picture(QStringLiteral("no_master"));
    QElapsedTimer clock;
    clock.start();
    const Outcome outcome = runProgram(program(),
                                       {QStringLiteral("--master=kite=127.0.0.1:1"), QStringLiteral("--screenshot"),
                                        file, QStringLiteral("--after=1.5")});
    QCOMPARE(outcome.exitCode, 0);
    QVERIFY(clock.elapsed() < Program::patience / 2);
    QVERIFY(!QImage(file).isNull());
}

void tst_ControlCenter::failureToWriteThePictureIsReportedAtTheEnd()
{
    QTemporaryDir folder;
    const QString file = folder.filePath(QStringLiteral("gone/x.png"));
    QVERIFY(QDir(folder.path()).mkdir(QStringLiteral("gone")));
    Program window(program(),
                   {QStringLiteral("--demo"), QStringLiteral("--screenshot"), file, QStringLiteral("--after=2")});
    QVERIFY(window.waitForOutput(QStringLiteral("flying")));
    QVERIFY(QDir(folder.path()).rmdir(QStringLiteral("gone")));
    QCOMPARE(window.waitForEnd(), 1);
    QVERIFY2(window.errors().contains(file), qPrintable(window.errors()));
}

void tst_ControlCenter::pictureDoesNotReplaceAPipe()
{
    QTemporaryDir folder;
    const QString file = folder.filePath(QStringLiteral("pipe.png"));
    QCOMPARE(::mkfifo(file.toLocal8Bit().constData(), 0600), 0);
    const Outcome outcome = runProgram(program(), {QStringLiteral("--screenshot"), file, QStringLiteral("--after=0")});
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY2(outcome.errors.contains(QLatin1String("no ordinary file")), qPrintable(outcome.errors));
    QVERIFY(!QFileInfo(file).isFile());
}

void tst_ControlCenter::pictureIsGivenUpWhereProgramsOfTheDemoAreMissing()
{
    QTemporaryDir folder;
    const QString alone = folder.filePath(QStringLiteral("awe_control_center"));
    QVERIFY(QFile::copy(program(), alone));
    const QString file = folder.filePath(QStringLiteral("x.png"));
    const Outcome outcome = runProgram(alone, {QStringLiteral("--demo"), QStringLiteral("--screenshot"), file});
    QCOMPARE(outcome.exitCode, 1);
    QVERIFY2(outcome.errors.contains(QLatin1String("needs awe_master")), qPrintable(outcome.errors));
    QVERIFY(!QFile::exists(file));
}

void tst_ControlCenter::programEndedBeforeItsPictureReportsFailure_data()
{
    QTest::addColumn<int>("signal");
    QTest::newRow("terminated") << SIGTERM;
    QTest::newRow("interrupted") << SIGINT;
}

void tst_ControlCenter::programEndedBeforeItsPictureReportsFailure()
{
    QFETCH(int, signal);
    QTemporaryDir folder;
    const QString file = folder.filePath(QStringLiteral("x.png"));
    Program window(program(),
                   {QStringLiteral("--demo"), QStringLiteral("--screenshot"), file, QStringLiteral("--after=60")});
    const QList<qint64> pids = waitForPrograms(window);
    QCOMPARE(pids.size(), 3);
    QVERIFY(window.waitForOutput(QStringLiteral("flying")));
    window.sendSignal(signal);
    QCOMPARE(window.waitForEnd(), 1);
    QVERIFY2(window.errors().contains(QLatin1String("before the picture")), qPrintable(window.errors()));
    QVERIFY(!QFile::exists(file));
    QCOMPARE(stillRunning(pids), QList<qint64>());
}

void tst_ControlCenter::windowOutlivesItsPrograms_data()
{
    QTest::addColumn<QByteArray>("victim");
    for (const char *name : {"awe_master", "awe_model", "awe_autopilot"})
        QTest::newRow(name) << QByteArray(name);
}

void tst_ControlCenter::windowOutlivesItsPrograms()
{
    QFETCH(QByteArray, victim);
    const QString file = picture(QStringLiteral("without_") + QString::fromLatin1(victim));
    Program window(program(),
                   {QStringLiteral("--demo"), QStringLiteral("--after=4"), QStringLiteral("--screenshot"), file,
                    QStringLiteral("--size=1366x768")});
    const QList<qint64> pids = waitForPrograms(window);
    QVERIFY(window.waitForOutput(QStringLiteral("flying")));
    for (qint64 pid : pids) {
        if (nameOf(pid) == victim)
            ::kill(pid_t(pid), SIGKILL);
    }
    QVERIFY(window.waitForErrors(QString::fromLatin1(victim) + QStringLiteral(" has ended (Killed)")));
    QCOMPARE(window.waitForEnd(), 0);
    QCOMPARE(QImage(file).size(), QSize(1366, 768));
    QCOMPARE(stillRunning(pids), QList<qint64>());
}

void tst_ControlCenter::windowEndsAllProgramsOfTheDemo_data()
{
    QTest::addColumn<int>("signal");
    QTest::addColumn<int>("exitCode");
    QTest::newRow("killed") << SIGKILL << -1;
    QTest::newRow("crashed") << SIGSEGV << -1;
    QTest::newRow("interrupted") << SIGINT << 0;
}

void tst_ControlCenter::windowEndsAllProgramsOfTheDemo()
{
    QFETCH(int, signal);
    QFETCH(int, exitCode);
    Program window(program(), {QStringLiteral("--demo")});
    const QList<qint64> pids = waitForPrograms(window);
    QCOMPARE(pids.size(), 3);
    QVERIFY(window.waitForOutput(QStringLiteral("flying")));
    window.sendSignal(signal);
    QCOMPARE(window.waitForEnd(), exitCode);
    QCOMPARE(stillRunning(pids), QList<qint64>());
}

void tst_ControlCenter::signalEndsTheWindowInOrder()
{
    Program window(program(), {QStringLiteral("--demo")});
    QVERIFY(window.waitForOutput(QStringLiteral("flying")));
    window.sendSignal(SIGTERM);
    QCOMPARE(window.waitForEnd(), 0);
    // The plant of the demo is not looked for the next time.
    QFile settings;
    QDirIterator files(m_home.path(), QDir::Files, QDirIterator::Subdirectories);
    while (files.hasNext()) {
        settings.setFileName(files.next());
        QVERIFY(settings.open(QIODevice::ReadOnly));
        QVERIFY2(!settings.readAll().contains("127.0.0.1"), qPrintable(settings.fileName()));
        settings.close();
    }
}

QTEST_GUILESS_MAIN(tst_ControlCenter)
#include "tst_ControlCenter.moc"
