// SPDX-License-Identifier: Apache-2.0
#include "Program.h"

#include <QtCore/QFile>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

/// What all programs of the example say before they begin: help, version, and one clear sentence
/// about each invalid option.
class tst_ProgramOptions : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void helpNamesEveryOption_data();
    void helpNamesEveryOption();
    void versionIsOneLine_data() { everyProgram(); }
    void versionIsOneLine();
    void badOptionsAreRefusedWithOneSentence_data();
    void badOptionsAreRefusedWithOneSentence();
    void helpStatesTheDefaultClock();
    void helpStatesTheDefaultListenAddress();
    void brokenSignalTableShowsAllOfItsErrors_data() { everyProgram(); }
    void brokenSignalTableShowsAllOfItsErrors();
    void reportThatCannotBeWrittenIsRefusedBeforeTheFlight_data();
    void reportThatCannotBeWrittenIsRefusedBeforeTheFlight();
    void checkOfTheReportLeavesAnOldOneAlone();

private:
    static void everyProgram();
    static QString path(const QString &program) { return QStringLiteral(AWE_PROGRAMS "/") + program; }
    QTemporaryDir m_folder;
};

void tst_ProgramOptions::everyProgram()
{
    QTest::addColumn<QString>("program");
    for (const char *program : {"awe_master", "awe_model", "awe_compact_model", "awe_autopilot", "awe_sil"})
        QTest::newRow(program) << QString::fromLatin1(program);
}

void tst_ProgramOptions::helpNamesEveryOption_data()
{
    QTest::addColumn<QString>("program");
    QTest::addColumn<QString>("options");
    const char *const node = "--master --signals --name --watchdog --critical --stay --same-cycle --priority --cpu "
                             "--lock-memory --enable-fault-injection --faults";
    const char *const model = " --wind --turbulence --seed --plant --winch --mode";
    const char *const autopilot = " --gains --force-limit --dead-time --plant --winch --mode";
    const char *const run
        = " --lockstep --real-time --scale --external --overrun --duration --report --record --watch --signals";
    const auto row = [](const char *program, const QByteArray &options) {
        QTest::newRow(program) << QString::fromLatin1(program) << QString::fromLatin1(options);
    };
    row("awe_model", QByteArray(node) + model);
    row("awe_compact_model", QByteArray(node) + model);
    row("awe_autopilot", QByteArray(node) + autopilot);
    row("awe_master",
        QByteArray(
            "--listen --port --multicast --insecure-network --beacon --start-with --mean-wind --plant --winch --mode "
            "--manifest --priority --cpu "
            "--lock-memory --enable-fault-injection --faults")
            + run);
    row("awe_sil", QByteArray("--processes --transport --same-cycle --controls --model") + run + model + autopilot);
}

void tst_ProgramOptions::helpNamesEveryOption()
{
    QFETCH(QString, program);
    QFETCH(QString, options);
    const Outcome outcome = runProgram(path(program), {QStringLiteral("--help")});
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.errors, QString());
    QVERIFY(outcome.output.startsWith(QLatin1String("Usage: ")));
    QVERIFY(outcome.output.contains(QLatin1String("\nExamples:\n  ")));
    const QStringList names = options.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    for (const QString &name : names)
        QVERIFY2(outcome.output.contains(QStringLiteral("  %1 ").arg(name)), qPrintable(name));
}

void tst_ProgramOptions::versionIsOneLine()
{
    QFETCH(QString, program);
    const Outcome outcome = runProgram(path(program), {QStringLiteral("--version")});
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.errors, QString());
    QVERIFY(
        QRegularExpression(QStringLiteral("^%1 \\d+\\.\\d+\\.\\d+\n$").arg(program)).match(outcome.output).hasMatch());
}

void tst_ProgramOptions::badOptionsAreRefusedWithOneSentence_data()
{
    QTest::addColumn<QString>("program");
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("message");
    const auto row = [](const char *program, const char *arguments, const char *message) {
        QTest::newRow(qPrintable(QStringLiteral("%1 %2").arg(QLatin1String(program), QLatin1String(arguments))))
            << QString::fromLatin1(program) << QString::fromLatin1(arguments).split(QLatin1Char(' '))
            << QString::fromLatin1(message);
    };
    for (const char *program : {"awe_master", "awe_model", "awe_compact_model", "awe_autopilot", "awe_sil"}) {
        row(program, "--fly", "unknown option '--fly' (see --help)\n");
        row(program, "fly", "unexpected argument 'fly'");
        row(program, "-5", "unexpected argument '-5'");
        row(program, "--signals", "missing value after '--signals'");
        row(program, "--signals /nowhere/signals.ini", "/nowhere/signals.ini");
        row(program, "--help=yes", "--help");
    }
    for (const char *program : {"awe_master", "awe_model", "awe_compact_model", "awe_autopilot"}) {
        row(program, "--faults loss=5%", "give --enable-fault-injection, too");
        row(program, "--enable-fault-injection", "name the faults with --faults PLAN");
        row(program, "--enable-fault-injection --faults loss=5%,lose=1%", "--faults 'lose=1%': use loss, duplicate,");
    }
    for (const char *node : {"awe_model", "awe_compact_model", "awe_autopilot"}) {
        row(node, "--master :", "':' is not a valid address");
        row(node, "--master 127.0.0.1:0", "'0' is not a valid port");
        row(node, "--master 127.0.0.1:65536", "'65536' is not a valid port");
        row(node, "--master 127.0.0.1:port", "'port' is not a valid port");
        row(node, "--master 127.0.0.1:1", "cannot reach a master at 127.0.0.1:1");
        row(node, "--master udp://127.0.0.1:1", "cannot reach a master at udp://127.0.0.1:1");
        row(node, "--watchdog -1", "--watchdog -1: use a number of 0 ...");
        row(node, "--watchdog soon", "--watchdog soon");
        row(node, "--watchdog nan", "--watchdog nan");
        row(node, "--priority 0", "--priority 0");
        row(node, "--priority 100", "--priority 100");
        row(node, "--cpu -1", "--cpu -1");
        row(node, "--cpu 1.5", "--cpu 1.5");
    }
    for (const char *program : {"awe_model", "awe_compact_model", "awe_sil"}) {
        row(program, "--wind 1,2", "--wind 1,2: use three numbers X,Y,Z");
        row(program, "--wind 8", "--wind 8: use three numbers X,Y,Z");
        row(program, "--wind west", "--wind west");
        row(program, "--wind 1,2,inf", "--wind 1,2,inf");
        row(program, "--wind 1000,0,0", "--wind 1000,0,0: use numbers from -100 to 100 m/s");
        row(program, "--turbulence -0.1", "--turbulence -0.1: use a number of 0 ... 1");
        row(program, "--turbulence 1.1", "--turbulence 1.1");
        row(program, "--turbulence much", "--turbulence much");
        row(program, "--seed -1", "--seed -1");
        row(program, "--seed 0.5", "--seed 0.5");
    }
    const QString plant = m_folder.filePath(QStringLiteral("plant.ini"));
    QFile file(plant);
    file.open(QIODevice::WriteOnly);
    file.write("[kite]\nmass = 0\n");
    file.close();
    for (const char *program : {"awe_master", "awe_model", "awe_compact_model", "awe_autopilot", "awe_sil"}) {
        row(program, qPrintable(QStringLiteral("--plant ") + plant),
            qPrintable(plant + QStringLiteral(":2: mass = 0: use a number from 0.001 to 1e+06 kg")));
        row(program, "--plant real", "choose another file, or one of drag, mast, realistic, thesis");
        row(program, "--winch steam", "--winch steam: use ideal, machine, drive or canopen");
        row(program, "--plant realistic --mode drag", "kind = machine and mode drag exclude each other");
    }
    for (const char *program : {"awe_autopilot", "awe_sil"}) {
        row(program, "--gains best", "--gains best: use default or tuned");
        row(program, "--gains tuned --plant realistic --winch ideal --mode drag",
            "--gains tuned: there is no tuned set for turbines on a wing that the air turns; use default");
        row(program, "--force-limit 99", "--force-limit 99");
        row(program, "--force-limit strong", "--force-limit strong");
        row(program, "--dead-time 1", "--dead-time 1: use a whole number of 2 ...");
        row(program, "--dead-time 101", "--dead-time 101");
        row(program, "--same-cycle --dead-time -1", "--dead-time -1: use a whole number of 0 ...");
    }
    for (const char *program : {"awe_master", "awe_sil"}) {
        row(program, "--lockstep --real-time", "use one of --lockstep, --real-time, --scale and --external");
        row(program, "--scale 2 --external", "use one of --lockstep, --real-time, --scale and --external");
        row(program, "--scale 2 --real-time", "use one of");
        row(program, "--scale 0", "--scale 0");
        row(program, "--scale 1001", "--scale 1001");
        row(program, "--scale fast", "--scale fast");
        row(program, "--overrun", "missing value after '--overrun'");
        row(program, "--overrun panic", "--overrun: overrun policy 'panic': use skip, catch-up:N, shift or stop");
        row(program, "--overrun catch-up:0", "use catch-up:N with N = 1 ... 1000000");
        row(program, "--duration -1", "--duration -1");
        row(program, "--duration long", "--duration long");
        row(program, "--watch", "--watch draws on a terminal");
    }
    row("awe_master", "--listen home", "--listen home: use an IP address");
    for (const char *address : {"0.0.0.0", "192.0.2.1", "::"})
        row("awe_master", qPrintable(QStringLiteral("--listen %1 --port 0").arg(QLatin1String(address))),
            qPrintable(QStringLiteral("--listen %1: everybody in that network could command the plant; use --security "
                                      "psk --keys FILE, or allow it by --insecure-network")
                           .arg(QLatin1String(address))));
    row("awe_master", "--listen 192.0.2.1 --insecure-network --port 0",
        "--listen 192.0.2.1: this computer has no such address");
    for (const char *group : {"home", "127.0.0.1", "240.0.0.1", "ff02::1", "239.255.76.68:50000"})
        row("awe_master", qPrintable(QStringLiteral("--multicast %1").arg(QLatin1String(group))),
            qPrintable(QStringLiteral("--multicast '%1': use an IPv4 multicast address").arg(QLatin1String(group))));
    row("awe_master", "--multicast=", "--multicast '': use an IPv4 multicast address");
    row("awe_master", "--listen ::1 --multicast 239.255.76.68 --port 0", "multicast needs IPv4");
    row("awe_master", "--port 65536", "--port 65536");
    row("awe_master", "--port -1", "--port -1");
    row("awe_master", "--mean-wind -1", "--mean-wind -1");
    row("awe_master", "--priority 0", "--priority 0");
    row("awe_sil", "--transport pigeon", "--transport pigeon: use inprocess, tcp, udp, udp-multicast or local");
    row("awe_sil", "--processes --transport inprocess", "exclude each other");
    row("awe_sil", "--same-cycle --transport udp-multicast", "asked one by one: use udp, tcp or local");
    row("awe_sil", "--processes --wind 1,2", "--wind 1,2");
    row("awe_sil", "--model list", "--model list: use compact or lawe");
    row("awe_sil", "--model lawe --turbulence 0.1", "--model lawe and --turbulence=0.1 exclude each other");
    row("awe_sil", "--model lawe --plant realistic", "--model lawe and --plant=realistic exclude each other");
    row("awe_sil", "--model lawe --winch machine", "--model lawe and --winch=machine exclude each other");
    row("awe_sil", "--model lawe --winch drive", "--model lawe and --winch=drive exclude each other");
    row("awe_sil", "--processes --watch", "--watch draws on a terminal");
    row("awe_sil", "--controls 0,0", "--controls 0,0: use three numbers X,Y,Z");
    row("awe_sil", "--controls 0,0,1 --processes", "leave out --processes and --winch drive");
    row("awe_sil", "--controls 0,0,1 --winch drive", "leave out --processes and --winch drive");
    row("awe_sil", "--controls 0,0,1 --gains tuned", "--controls and --gains exclude each other");
    row("awe_sil", "--controls 0,0,1 --plant mast", "--controls and a mast exclude each other");
    row("awe_sil", "--controls 0,0,100 --duration 1",
        "100 is out of range for signal 'tetherSpeed'; use -10 ... 10 m/s");
}

void tst_ProgramOptions::badOptionsAreRefusedWithOneSentence()
{
    QFETCH(QString, program);
    QFETCH(QStringList, arguments);
    QFETCH(QString, message);
    const Outcome outcome = runProgram(path(program), arguments);
    QVERIFY2(outcome.exitCode == 2, qPrintable(QStringLiteral("%1: %2").arg(outcome.exitCode).arg(outcome.errors)));
    QVERIFY2(outcome.errors.contains(message), qPrintable(outcome.errors));
    QVERIFY2(outcome.errors.startsWith(program + QStringLiteral(": ")), qPrintable(outcome.errors));
    QCOMPARE(outcome.errors.count(QLatin1Char('\n')), 1);
    QCOMPARE(outcome.output, QString());
    const QRegularExpression function(QStringLiteral("\\w\\(|::[A-Za-z_]"));
    QVERIFY2(!function.match(outcome.errors).hasMatch(),
             qPrintable(QStringLiteral("names a C++ function: %1").arg(outcome.errors)));
}

void tst_ProgramOptions::helpStatesTheDefaultClock()
{
    const QString master
        = runProgram(path(QStringLiteral("awe_master")), {QStringLiteral("--help")}).output.simplified();
    QVERIFY2(
        master.contains(QStringLiteral("As fast as possible, bit-identical each time; the default with --start-with.")),
        qPrintable(master));
    QVERIFY2(master.contains(QStringLiteral("As fast as the real thing; the default without --start-with.")),
             qPrintable(master));
    const QString sil = runProgram(path(QStringLiteral("awe_sil")), {QStringLiteral("--help")}).output.simplified();
    QVERIFY2(sil.contains(QStringLiteral("As fast as possible, bit-identical each time; the default.")),
             qPrintable(sil));
    QVERIFY2(sil.contains(QStringLiteral("As fast as the real thing. ")), qPrintable(sil));
}

void tst_ProgramOptions::helpStatesTheDefaultListenAddress()
{
    const QString master
        = runProgram(path(QStringLiteral("awe_master")), {QStringLiteral("--help")}).output.simplified();
    QVERIFY2(master.contains(QStringLiteral("Without it 127.0.0.1: only this computer reaches the master.")),
             qPrintable(master));
    QVERIFY2(master.contains(QStringLiteral("Without it 50000.")), qPrintable(master));
}

void tst_ProgramOptions::brokenSignalTableShowsAllOfItsErrors()
{
    QFETCH(QString, program);
    const QString fileName = m_folder.filePath(QStringLiteral("broken.ini"));
    QFile file(fileName);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("[power]\ntype = Rael\n\n[energy]\ntype = Real\nmin = low\n\n[energy]\ntype = Real\n");
    file.close();
    const Outcome outcome = runProgram(path(program), {QStringLiteral("--signals"), fileName});
    QCOMPARE(outcome.exitCode, 2);
    QCOMPARE(outcome.output, QString());
    for (const char *place : {":2:", ":6:", ":8:"})
        QVERIFY2(outcome.errors.contains(fileName + QLatin1String(place)), qPrintable(outcome.errors));
    QVERIFY(outcome.errors.contains(QLatin1String("did you mean 'Real'")));
    QCOMPARE(outcome.errors.count(QLatin1Char('\n')), 3);
}

void tst_ProgramOptions::reportThatCannotBeWrittenIsRefusedBeforeTheFlight_data()
{
    QTest::addColumn<QString>("program");
    QTest::addColumn<QStringList>("arguments");
    const QStringList missing{QStringLiteral("--report"), QStringLiteral("/nowhere/flight.json")};
    QTest::newRow("missing folder") << QStringLiteral("awe_sil") << missing;
    QTest::newRow("missing folder, processes")
        << QStringLiteral("awe_sil") << missing + QStringList{QStringLiteral("--processes")};
    QTest::newRow("missing folder, master")
        << QStringLiteral("awe_master") << missing + QStringList{QStringLiteral("--port=0")};
    QTest::newRow("a folder") << QStringLiteral("awe_sil") << QStringList{QStringLiteral("--report"), m_folder.path()};
}

void tst_ProgramOptions::reportThatCannotBeWrittenIsRefusedBeforeTheFlight()
{
    QFETCH(QString, program);
    QFETCH(QStringList, arguments);
    // A flight without end: a program that begins it is caught by the patience of the test.
    const Outcome outcome = runProgram(
        path(program), arguments + QStringList{QStringLiteral("--real-time"), QStringLiteral("--duration=0")});
    QCOMPARE(outcome.exitCode, 2);
    QCOMPARE(outcome.output, QString());
    QVERIFY2(outcome.errors.contains(QStringLiteral("cannot write the report %1: ").arg(arguments.at(1))),
             qPrintable(outcome.errors));
    QCOMPARE(outcome.errors.count(QLatin1Char('\n')), 1);
}

void tst_ProgramOptions::checkOfTheReportLeavesAnOldOneAlone()
{
    QFile report(m_folder.filePath(QStringLiteral("old.json")));
    QVERIFY(report.open(QIODevice::WriteOnly));
    report.write("old");
    report.close();
    // The second option is refused after the check of the report.
    const Outcome outcome = runProgram(path(QStringLiteral("awe_sil")),
                                       {QStringLiteral("--report"), report.fileName(), QStringLiteral("--wind=x")});
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY(report.open(QIODevice::ReadOnly));
    QCOMPARE(report.readAll(), QByteArray("old"));
}

QTEST_GUILESS_MAIN(tst_ProgramOptions)
#include "tst_ProgramOptions.moc"
