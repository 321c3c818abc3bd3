// SPDX-License-Identifier: Apache-2.0
// The program qtplc_fmu: its commands, and FMU nodes as processes that crash, sleep and hang.
#include "../common/Waiting.h"
#include "NodeFixtures.h"

#include <QtCore/QProcess>
#include <QtCore/QTemporaryDir>

#include <csignal>

class tst_qtplc_fmu : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void helpNamesTheCommandsAndTheirOptions();
    void wrongCommandLinesEndWithExitCodeTwo_data();
    void wrongCommandLinesEndWithExitCodeTwo();
    void infoShowsVariablesAndPlatforms();
    void signalsPrintsATableThatIsRead_data();
    void signalsPrintsATableThatIsRead();
    void runWritesTheOutputs_data() { addVersions(); }
    void runWritesTheOutputs();
    void runTakesInputsFromAFile();
    void runTellsWhyItEnds_data();
    void runTellsWhyItEnds();
    void runEndsWithAWholeStep_data() { addVersions(); }
    void runEndsWithAWholeStep();
    void runStopsAtAMultipleOfTheStep();
    void runWritesOverNothingThatItReads();
    void outputThatCannotBeWrittenIsAnError();
    void checkFindsFaults_data();
    void checkFindsFaults();
    void benchCountsItsSteps();
    void nodeChecksItsConfiguration();
    void nodeIsPartOfAPlant_data() { addVersions(); }
    void nodeIsPartOfAPlant();
    void crashLosesTheNodeAndNotThePlant_data();
    void crashLosesTheNodeAndNotThePlant();
    void slowStepIsLateAndThePlantGoesOn();
    void hangingStepEndsWithItsProcess();
    void hangingInitializationEndsWithItsProcess_data() { addVersions(); }
    void hangingInitializationEndsWithItsProcess();

private:
    struct Run
    {
        int code = -1;
        QString output;
        QString errors;
    };
    static void addVersions()
    {
        QTest::addColumn<QString>("file");
        QTest::newRow("FMI 2") << "plant2";
        QTest::newRow("FMI 3") << "plant3";
    }
    Run run(const QStringList &arguments) const;
    QString write(const QString &name, const QByteArray &text) const;
    /// Starts a node whose plant has a fault 0.05 s after the start.
    void start(QProcess *process, const TestMaster &master, const QString &file, int fault,
               const QStringList &options = {}) const;

    QTemporaryDir m_folder;
};

namespace {

QString pathOf(const QString &name)
{
    return QStringLiteral(QTPLC_TEST_FMUS "/%1.fmu").arg(name);
}

}  // namespace

void tst_qtplc_fmu::initTestCase()
{
    QVERIFY(QDir(m_folder.path()).mkdir("temporary"));
    qputenv("TMPDIR", QFile::encodeName(m_folder.filePath("temporary")));
}

tst_qtplc_fmu::Run tst_qtplc_fmu::run(const QStringList &arguments) const
{
    QProcess process;
    process.setWorkingDirectory(m_folder.path());
    process.start(QStringLiteral(QTPLC_FMU_PROGRAM), arguments);
    if (!process.waitForFinished(60000))
        return {};
    return {process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -process.exitCode(),
            QString::fromUtf8(process.readAllStandardOutput()), QString::fromUtf8(process.readAllStandardError())};
}

QString tst_qtplc_fmu::write(const QString &name, const QByteArray &text) const
{
    QFile file(m_folder.filePath(name));
    return file.open(QIODevice::WriteOnly) && file.write(text) == text.size() ? file.fileName() : QString();
}

void tst_qtplc_fmu::start(QProcess *process, const TestMaster &master, const QString &file, int fault,
                          const QStringList &options) const
{
    const QString configuration = write(
        QStringLiteral("%1_%2.ini").arg(file).arg(fault),
        QStringLiteral("[node]\nname = Model\n[fmu]\nfile = %1\n[fmu.start]\nx0 = 1\nfaultTime = 0.05\nfault = %2\n"
                       "[fmu.read]\nsum = x\n[fmu.write]\nu = setpoint\n")
            .arg(pathOf(file))
            .arg(fault)
            .toUtf8());
    process->setProcessChannelMode(QProcess::MergedChannels);
    process->start(QStringLiteral(QTPLC_FMU_PROGRAM),
                   QStringList{"node", configuration, "--master", master.protocol("tcp").toString()} + options);
}

void tst_qtplc_fmu::helpNamesTheCommandsAndTheirOptions()
{
    const Run all = run({"--help"});
    QCOMPARE(all.code, 0);
    const QVector<QPair<QString, QStringList>> commands{{"node", {"--master", "--check"}},
                                                        {"run", {"--in", "--out", "--stop", "--step", "--set"}},
                                                        {"info", {"--all"}},
                                                        {"signals", {"FILE.fmu"}},
                                                        {"check", {"--step"}},
                                                        {"bench", {"--count", "--period"}}};
    for (const auto &[command, options] : commands) {
        QVERIFY2(all.output.contains("\n  " + command), qPrintable(all.output));
        const Run help = run({command, "--help"});
        QCOMPARE(help.code, 0);
        for (const QString &option : options)
            QVERIFY2(help.output.contains(option), qPrintable(help.output));
    }
}

void tst_qtplc_fmu::wrongCommandLinesEndWithExitCodeTwo_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("error");
    const auto row = [](const char *name, const QStringList &arguments, const char *error) {
        QTest::newRow(name) << arguments << QString(error);
    };
    const QString plant = pathOf("plant2");
    row("nothing", {}, "name a command: node, run");
    row("command", {"rum", plant}, "there is no command 'rum'; did you mean 'run'?");
    row("no FMU", {"info"}, "name one FMU: qtplc_fmu info model.fmu");
    row("absent FMU", {"info", "none.fmu"}, "none.fmu: there is no such file");
    row("no output", {"run", plant}, "say where the outputs go: --out OUT.csv");
    row("no folder of the output", {"run", plant, "--out", "/none/x.csv"}, "--out: /none/x.csv cannot be written");
    row("no length", {"run", pathOf("types3"), "--out", "x.csv", "--step", "0"}, "--step");
    row("end before the begin", {"run", plant, "--out", "x.csv", "--stop", "0"}, "--stop");
    row("start value", {"run", plant, "--out", "x.csv", "--set", "gain"}, "--set: 'gain' is not 'variable=value'");
    row("inputs", {"run", plant, "--out", "x.csv", "--in", "none.csv"}, "--in: none.csv cannot be read");
    row("platform", {"check", pathOf("hostile/windows")}, "export it for Linux on this processor");
    row("node", {"node"}, "name one configuration or FMU");
}

void tst_qtplc_fmu::wrongCommandLinesEndWithExitCodeTwo()
{
    QFETCH(QStringList, arguments);
    QFETCH(QString, error);
    const Run refused = run(arguments);
    QCOMPARE(refused.code, 2);
    QVERIFY2(refused.errors.contains(error), qPrintable(refused.errors));
}

void tst_qtplc_fmu::infoShowsVariablesAndPlatforms()
{
    const Run shown = run({"info", pathOf("plant3")});
    QCOMPARE(shown.code, 0);
    for (const char *line : {"model Plant", "FMI 3.0", "runs here yes", "event mode yes",
                             "experiment from 0 s, to 1 s, step 0.1 s, tolerance 0.0001",
                             "input Float64 u [m/s] = 0 speed", "output Float64 x [m] -1000 ... 1000 position",
                             "output Float64[3] r [m]", "output Enumeration mode", "parameter String label = plain"})
        QVERIFY2(shown.output.simplified().contains(line), qPrintable(shown.output));
    const Run foreign = run({"info", pathOf("hostile/windows")});
    QCOMPARE(foreign.code, 0);
    QVERIFY2(foreign.output.simplified().contains("platforms darwin64, win64 runs here no"),
             qPrintable(foreign.output));
}

void tst_qtplc_fmu::signalsPrintsATableThatIsRead_data()
{
    QTest::addColumn<QString>("file");
    QTest::addColumn<int>("count");
    QTest::newRow("FMI 2") << "plant2" << 5;
    QTest::newRow("FMI 3") << "plant3" << 6;
    QTest::newRow("all types") << "types3" << 48;
}

void tst_qtplc_fmu::signalsPrintsATableThatIsRead()
{
    QFETCH(QString, file);
    QFETCH(int, count);
    const Run printed = run({"signals", pathOf(file)});
    QCOMPARE(printed.code, 0);
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(printed.output.toUtf8(), &errors);
    QVERIFY2(errors.isEmpty(), qPrintable(QPlcParseError::toString(errors)));
    QCOMPARE(table.size(), count);
    if (file == "types3")
        return;
    const QPlcSignalDefinition &x = table.at(table.indexOf("x"));
    QCOMPARE(x.unit, QString("m"));
    QCOMPARE(x.maximum.toReal(), 1000.0);
    QCOMPARE(x.description, QString("position"));
    QCOMPARE(table.at(table.indexOf("mode")).valueNames.nameOf(1), QString("Above"));
    QCOMPARE(table.at(table.indexOf("r")).type, QPlcSignalType(QPlcSignalType::Real64, 3));
    QCOMPARE(table.at(table.indexOf("enabled")).initial.toInt(), 1);
}

void tst_qtplc_fmu::runWritesTheOutputs()
{
    QFETCH(QString, file);
    const Run done = run({"run", pathOf(file), "--stop", "0.3", "--step", "0.1", "--set", "u=2", "--set", "x0=1",
                          "--set", "limit=1.5", "--out", "out.csv"});
    QVERIFY2(done.code == 0, qPrintable(done.errors));
    QFile csv(m_folder.filePath("out.csv"));
    QVERIFY(csv.open(QIODevice::ReadOnly));
    const QList<QByteArray> lines = csv.readAll().trimmed().split('\n');
    QCOMPARE(lines.size(), 5);
    QCOMPARE(lines.first(), QByteArray(file == "plant2" ? "time,x,mode,r[1],r[2],r[3]" : "time,x,mode,r,position"));
    QVERIFY2(lines.at(1).startsWith("0,1,0,1"), lines.at(1));
    QVERIFY2(lines.at(2).startsWith("0.1,1.2,0,1.2"), lines.at(2));
    QVERIFY2(lines.at(4).startsWith("0.3,1.5999999999999999,1,") || lines.at(4).startsWith("0.3,1.6,1,"), lines.at(4));
}

void tst_qtplc_fmu::runTakesInputsFromAFile()
{
    const QString inputs = write("in.csv", "time,u,enabled\n0,0,1\n0.2,2,1\n0.4,2,0\n");
    const Run done = run({"run", pathOf("plant2"), "--stop", "0.5", "--in", inputs, "--out", "out.csv"});
    QVERIFY2(done.code == 0, qPrintable(done.errors));
    QFile csv(m_folder.filePath("out.csv"));
    QVERIFY(csv.open(QIODevice::ReadOnly));
    QVector<double> positions;
    for (const QByteArray &line : csv.readAll().trimmed().split('\n').mid(1))
        positions << line.split(',').at(1).toDouble();
    // 0, then with u = 0, 1, 2, 2 and not enabled
    const QVector<double> wanted{0.0, 0.0, 0.1, 0.3, 0.5, 0.5};
    QCOMPARE(positions.size(), wanted.size());
    for (int i = 0; i < wanted.size(); ++i)
        QVERIFY2(qAbs(positions.at(i) - wanted.at(i)) < 1e-12, qPrintable(QString::number(i)));
    const QString wrong = write("wrong.csv", "time,x\n0,1\n");
    const Run refused = run({"run", pathOf("plant2"), "--in", wrong, "--out", "out.csv"});
    QCOMPARE(refused.code, 2);
    QVERIFY2(refused.errors.contains("wrong.csv:1: 'x' (output) is not an input"), qPrintable(refused.errors));
}

void tst_qtplc_fmu::runTellsWhyItEnds_data()
{
    QTest::addColumn<QString>("file");
    QTest::addColumn<int>("fault");
    QTest::addColumn<int>("code");
    QTest::addColumn<QString>("text");
    for (const char *file : {"plant2", "plant3"}) {
        QTest::addRow("%s discards", file) << file << 1 << 0 << "the FMU has discarded the step at 0.2 s";
        QTest::addRow("%s ends", file) << file << 2 << 0 << "the FMU has ended the simulation at 0.2 s";
        QTest::addRow("%s error", file) << file << 3 << 1 << "in a step: 'the tank is empty'";
        QTest::addRow("%s fatal", file) << file << 4 << 1 << "the FMU reports a fatal error";
        QTest::addRow("%s crash", file) << file << 6 << -SIGSEGV << "the FMU has crashed in fmi";
        QTest::addRow("%s stack", file) << file << 13 << -SIGSEGV << "the FMU has crashed in fmi";
        QTest::addRow("%s exits", file) << file << 12 << 1 << "DoStep: it has called exit(); tell the maker";
        QTest::addRow("%s exits at once", file) << file << 14 << 1 << "DoStep: it has called _exit(); tell the maker";
        QTest::addRow("%s exits quickly", file) << file << 15 << 1 << "DoStep: it has called quick_exit(); tell";
    }
}

void tst_qtplc_fmu::runTellsWhyItEnds()
{
    QFETCH(QString, file);
    QFETCH(int, fault);
    QFETCH(int, code);
    QFETCH(QString, text);
    const Run ended = run({"run", pathOf(file), "--set", QStringLiteral("fault=%1").arg(fault), "--set",
                           "faultTime=0.3", "--out", "out.csv"});
    QCOMPARE(ended.code, code);
    QVERIFY2(ended.errors.contains(text), qPrintable(ended.errors));
    // A folder that a crash has left is removed by the next process.
    QCOMPARE(run({"run", pathOf("plant2"), "--out", "out.csv"}).code, 0);
    QVERIFY(QDir(m_folder.filePath("temporary")).isEmpty());
}

/// The FMU refuses steps that go beyond the stop time that it was told.
void tst_qtplc_fmu::runEndsWithAWholeStep()
{
    QFETCH(QString, file);
    const Run done = run({"run", pathOf(file), "--stop", "0.25", "--step", "0.1", "--out", "out.csv"});
    QVERIFY2(done.code == 0, qPrintable(done.errors));
    QFile csv(m_folder.filePath("out.csv"));
    QVERIFY(csv.open(QIODevice::ReadOnly));
    QCOMPARE(csv.readAll().trimmed().split('\n').size(), 5);
}

/// A step of no whole number of nanoseconds.
void tst_qtplc_fmu::runStopsAtAMultipleOfTheStep()
{
    const Run done = run({"run", pathOf("plant2"), "--stop", "100", "--step", "0.016666666666666666", "--set", "u=1",
                          "--out", "out.csv"});
    QVERIFY2(done.code == 0, qPrintable(done.errors));
    QFile csv(m_folder.filePath("out.csv"));
    QVERIFY(csv.open(QIODevice::ReadOnly));
    const QList<QByteArray> lines = csv.readAll().trimmed().split('\n');
    QCOMPARE(lines.size(), 6002);
    QVERIFY2(lines.at(61).startsWith("1,") && lines.last().startsWith("100,"), lines.last());
}

void tst_qtplc_fmu::runWritesOverNothingThatItReads()
{
    QVERIFY(QFile::copy(pathOf("plant2"), m_folder.filePath("copy.fmu")));
    const QString inputs = write("read.csv", "time,u\n0,1\n");
    for (const QString &file : {QStringLiteral("copy.fmu"), inputs}) {
        const qint64 size = QFileInfo(m_folder.filePath(file)).size();
        const Run refused = run({"run", "copy.fmu", "--in", inputs, "--out", file});
        QCOMPARE(refused.code, 2);
        QVERIFY2(refused.errors.contains("--out names a file that is read"), qPrintable(refused.errors));
        QCOMPARE(QFileInfo(m_folder.filePath(file)).size(), size);
    }
}

void tst_qtplc_fmu::outputThatCannotBeWrittenIsAnError()
{
    QProcess process;
    process.setStandardOutputFile(QStringLiteral("/dev/full"));
    process.start(QStringLiteral(QTPLC_FMU_PROGRAM), {"signals", pathOf("plant2")});
    QVERIFY(process.waitForFinished(60000));
    QCOMPARE(process.exitCode(), 1);
    QVERIFY(process.readAllStandardError().contains("the output cannot be written"));
}

void tst_qtplc_fmu::checkFindsFaults_data()
{
    QTest::addColumn<QStringList>("options");
    QTest::addColumn<int>("code");
    QTest::addColumn<QString>("text");
    QTest::newRow("none") << QStringList() << 0 << "10 steps of 0.1 s";
    QTest::newRow("NaN") << QStringList{"--set", "fault=5", "--set", "faultTime=0.3"} << 1
                         << "FAULT: output 'x' has values that are not finite";
    QTest::newRow("error") << QStringList{"--set", "fault=3", "--set", "faultTime=0.3"} << 1
                           << "FAULT: the FMU reports an error";
}

void tst_qtplc_fmu::checkFindsFaults()
{
    QFETCH(QStringList, options);
    QFETCH(int, code);
    QFETCH(QString, text);
    const Run checked = run(QStringList{"check", pathOf("plant3")} + options);
    QCOMPARE(checked.code, code);
    QVERIFY2(checked.output.contains(text), qPrintable(checked.output));
}

void tst_qtplc_fmu::benchCountsItsSteps()
{
    const Run measured = run({"bench", pathOf("plant2"), "--count", "200", "--period", "10"});
    QVERIFY2(measured.code == 0, qPrintable(measured.errors));
    QVERIFY2(measured.output.contains("200 steps of 0.1 s"), qPrintable(measured.output));
    QVERIFY2(measured.output.contains("0 of 200 take longer than the period of 10 s"), qPrintable(measured.output));
}

void tst_qtplc_fmu::nodeChecksItsConfiguration()
{
    const QString configuration
        = write("a.ini",
                "[node]\nname = A\n[fmu]\nfile = " QTPLC_TEST_FMUS "/plant2.fmu\n[fmu.read]\npower = x * 2 - 1\n"
                "[fmu.write]\nu = speed\n");
    const Run checked = run({"node", configuration, "--check"});
    QVERIFY2(checked.code == 0, qPrintable(checked.errors));
    QVERIFY2(checked.output.simplified().contains("A: model Plant, FMI 2.0"), qPrintable(checked.output));
    QVERIFY2(checked.output.simplified().contains("x * 2 - 1 -> signal power"), qPrintable(checked.output));
    QVERIFY2(checked.output.simplified().contains("speed -> variable u"), qPrintable(checked.output));
    const Run refused = run({"node", write("b.ini", "[fmu]\nfile = none.fmu\n")});
    QCOMPARE(refused.code, 2);
    QVERIFY2(refused.errors.contains("b.ini:2:8: "), qPrintable(refused.errors));
}

void tst_qtplc_fmu::nodeIsPartOfAPlant()
{
    QFETCH(QString, file);
    TestMaster master;
    QVERIFY(master.listen());
    QProcess process;
    start(&process, master, file, 0);
    QVERIFY(waitUntil([&] { return master.nodes().size() == 1; }));
    QVERIFY(master.setSignalValue("setpoint", 1.0));
    master.setCycleLimit(100);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QVERIFY(master.signalValue("sum").toReal() > 1.9);
    process.terminate();
    QVERIFY(waitUntil([&] { return process.state() == QProcess::NotRunning; }));
    QCOMPARE(process.exitStatus(), QProcess::NormalExit);
    QCOMPARE(process.exitCode(), 0);
    QVERIFY(QDir(m_folder.filePath("temporary")).isEmpty());
}

void tst_qtplc_fmu::crashLosesTheNodeAndNotThePlant_data()
{
    QTest::addColumn<int>("fault");
    QTest::addColumn<bool>("isSignal");
    QTest::addColumn<QString>("text");
    QTest::newRow("access") << 6 << true << "the FMU has crashed in fmi2DoStep: invalid access to memory";
    QTest::newRow("stack") << 13 << true << "the FMU has crashed in fmi2DoStep: invalid access to memory, or its stack";
    QTest::newRow("_exit()") << 14 << false << "the FMU has ended the process in fmi2DoStep: it has called _exit()";
}

void tst_qtplc_fmu::crashLosesTheNodeAndNotThePlant()
{
    QFETCH(int, fault);
    QFETCH(bool, isSignal);
    QFETCH(QString, text);
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.listen());
    QProcess process;
    start(&process, master, "plant2", fault);
    QVERIFY(waitUntil([&] { return master.nodes().size() == 1; }));
    QSignalSpy lost(&master, &QPlcMasterNode::nodeLost);
    const LogCapture log;
    QVERIFY(master.startRealTime());
    QVERIFY(waitUntil([&] { return process.state() == QProcess::NotRunning; }));
    QCOMPARE(process.exitStatus(), isSignal ? QProcess::CrashExit : QProcess::NormalExit);
    const QString output = QString::fromUtf8(process.readAll());
    QVERIFY2(output.contains(text), qPrintable(output));
    QTRY_COMPARE(lost.size(), 1);
    const quint64 cycles = master.statistics().cycles;
    QVERIFY(master.waitForCycles(cycles + 10));
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    QCOMPARE(master.signalValue("sum").toReal(), 1.0);  // held
    master.stop();
}

void tst_qtplc_fmu::slowStepIsLateAndThePlantGoesOn()
{
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.listen());
    QProcess process;
    start(&process, master, "plant3", 7);  // each step takes 150 ms
    QVERIFY(waitUntil([&] { return master.nodes().size() == 1; }));
    const LogCapture log;
    QVERIFY(master.setSignalValue("setpoint", 1.0));
    master.setInterval(std::chrono::milliseconds(10));
    QVERIFY(master.startRealTime());
    QVERIFY(waitUntil([&] { return master.statistics().cycles > 100 && master.signalValue("sum").toReal() > 1.0; }));
    // In most cycles the FMU computes an older one.
    const double computed = (master.signalValue("sum").toReal() - 1.0) / 0.01;
    QVERIFY2(computed < double(master.statistics().cycles) / 3.0, qPrintable(QString::number(computed)));
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    QVERIFY(!log.matching("late").isEmpty());
    master.stop();
    process.terminate();
    QVERIFY(waitUntil([&] { return process.state() == QProcess::NotRunning; }));
}

void tst_qtplc_fmu::hangingStepEndsWithItsProcess()
{
    TestMaster master(QPlcClock::realTime());
    QVERIFY(master.listen());
    QProcess process;
    start(&process, master, "plant2", 8);
    QVERIFY(waitUntil([&] { return master.nodes().size() == 1; }));
    const LogCapture log;
    QVERIFY(master.startRealTime());
    QVERIFY(waitUntil([&] { return !log.matching("late").isEmpty(); }));
    const quint64 cycles = master.statistics().cycles;
    QVERIFY(master.waitForCycles(cycles + 10));
    process.terminate();
    QVERIFY(waitUntil([&] { return process.state() == QProcess::NotRunning; }, 60000));
    QCOMPARE(process.exitCode(), 1);
    const QString output = QString::fromUtf8(process.readAll());
    QVERIFY2(output.contains("the FMU does not return from fmi2DoStep; this process ends"), qPrintable(output));
    master.stop();
}

/// Its main thread, which SIGTERM asks for an end, is in the FMU, where a long work may take 5 min.
void tst_qtplc_fmu::hangingInitializationEndsWithItsProcess()
{
    QFETCH(QString, file);
    TestMaster master;
    QVERIFY(master.listen());
    QProcess process;
    start(&process, master, file, 11, {"--stay"});
    QVERIFY(waitUntil([&] { return master.nodes().size() == 1; }));
    QVERIFY(master.startRealTime());
    QString output;
    const auto tells = [&](const char *text) {
        output += QString::fromUtf8(process.readAll());
        return output.contains(text);
    };
    QVERIFY2(waitUntil([&] { return tells("the plant hangs"); }), qPrintable(output));
    QVERIFY(waitUntil([&] { return master.error() == QPlcMasterNode::InitializationError; }));
    QVERIFY2(master.errorString().contains("no answer"), qPrintable(master.errorString()));
    process.terminate();
    QVERIFY(waitUntil([&] { return process.state() == QProcess::NotRunning; }, 60000));
    QCOMPARE(process.exitCode(), 1);
    QVERIFY2(tells("EnterInitializationMode; this process ends"), qPrintable(output));
}

QTEST_GUILESS_MAIN(tst_qtplc_fmu)
#include "tst_qtplc_fmu.moc"
