// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "Program.h"

#include <QtPlcCore>

#include <QtCore/QFile>
#include <QtCore/QTemporaryFile>
#include <QtNetwork/QTcpServer>
#include <QtNetwork/QTcpSocket>

#include <csignal>

/// qtplc as a person uses it: against a master with a model and an autopilot, and against what is
/// none.
class tst_qtplc : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void badUseIsRefusedWithOneSentence_data();
    void badUseIsRefusedWithOneSentence();
    void helpShowsEveryCommand();
    void otherServersAreReported_data();
    void otherServersAreReported();
    void silentMasterTimesOut();
    void masterMayRefuseTheGreeting();

    void init();
    void cleanup();
    void stateNamesTheNodes();
    void listShowsEverySignal();
    void commandsRunACompleteFlight();
    void startEndsAfterItsCycles();
    void refusedCommandsKeepTheMasterAsItIs();
    void setChangesSignalsWithoutWriter();
    void setRefusesBadValues_data();
    void setRefusesBadValues();
    void echoBeforeTheFlightShowsPresentValuesOnce();
    void echoPrintsLinesAtItsRate();
    void echoStartedBeforeTheFlightShowsItsCycles();
    void echoJoiningAnEndingPhaseShowsRemainingValues();
    void echoShowsMoreSignalsThanOneAnswerHolds();
    void echoEndsCleanlyOnUnixSignals_data();
    void echoEndsCleanlyOnUnixSignals();
    void echoEndsWithTheMaster_data();
    void echoEndsWithTheMaster();
    void unknownSignalNamesCloseOnes();
    void eventsAreFollowedUntilCtrlC();

private:
    static QString path(const char *program)
    {
        return QStringLiteral(QTPLC_PROGRAMS "/") + QString::fromLatin1(program);
    }
    QStringList withMaster(const QString &command) const
    {
        return QStringList{m_address} + command.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    }
    Outcome qtplc(const QString &command) const { return runProgram(path("qtplc"), withMaster(command)); }
    static QStringList linesOf(const Outcome &outcome)
    {
        return outcome.output.split(QLatin1Char('\n'), Qt::SkipEmptyParts);
    }
    /// Starts model and autopilot and waits until they are registered.
    bool startNodes();
    bool startMaster(const QStringList &options = {});

    std::unique_ptr<Program> m_master, m_model, m_autopilot;
    QString m_address;  // "--master=..."
};

void tst_qtplc::init()
{
    QVERIFY(startMaster());
}

bool tst_qtplc::startMaster(const QStringList &options)
{
    m_master = std::make_unique<Program>(path("awe_master"), QStringList{QStringLiteral("--port=0")} + options);
    const bool listens = m_master->waitForOutput(QStringLiteral("\n"));
    m_address = QStringLiteral("--master=127.0.0.1:%1")
                    .arg(m_master->output().section(QLatin1Char('\n'), 0, 0).section(QLatin1Char(' '), 1));
    return listens;
}

void tst_qtplc::cleanup()
{
    m_autopilot.reset();
    m_model.reset();
    m_master.reset();
}

bool tst_qtplc::startNodes()
{
    m_model = std::make_unique<Program>(path("awe_model"), QStringList{m_address});
    m_autopilot = std::make_unique<Program>(path("awe_autopilot"), QStringList{m_address});
    return m_model->waitForErrors(QStringLiteral("registered"))
        && m_autopilot->waitForErrors(QStringLiteral("registered"));
}

// ---- use ----

void tst_qtplc::badUseIsRefusedWithOneSentence_data()
{
    QTest::addColumn<QString>("command");
    QTest::addColumn<QString>("message");
    const auto row = [](const char *command, const char *message) {
        QTest::newRow(command) << QString::fromLatin1(command) << QString::fromLatin1(message);
    };
    row("", "no command; use one of list, get, set, echo, watch, hz, state,");
    row("init all", "wrong number of arguments for init");
    row("get", "get needs arguments; use qtplc get");
    row("echo power --rate 0", "--rate 0");
    row("start --cycles 0", "--cycles 0");
    row("set a 1 --for 0", "--for 0");
    row("set a* 1", "'a*' is a pattern");
    row("get a --plain --json", "--plain and --json");
    row("hz --for never", "--for never");
    row("help fly", "unknown command 'fly'");
    row("state now", "state");
    row("echo", "echo needs arguments; use qtplc echo SIGNAL|PATTERN...");
    row("set", "set needs arguments");
    row("set tetherSpeed", "wrong number of arguments for set; use qtplc set SIGNAL VALUE ...");
    row("strat", "unknown command 'strat'; did you mean 'start' or 'state'?");
    row("list --nonsense", "unknown option '--nonsense' (see --help)\n");
    row("list --jsno", "unknown option '--jsno' (see --help); did you mean '--json'?\n");
    row("list --timeout", "missing value after '--timeout' (see --help)\n");
    row("list --json=yes", "unexpected value after '--json' (see --help)\n");
    row("list --master http://127.0.0.1", "unknown transport 'http://'; use tcp://, udp://");
    row("list --cycles 3", "list has no option --cycles");
    row("stop --rate 3", "stop has no option --rate");
    row("list --timeout 0", "--timeout 0");
    row("list --timeout soon", "--timeout soon");
    row("list --master :", "--master: ':' is not a valid address");
    row("list --master 127.0.0.1:0", "'0' is not a valid port");
}

void tst_qtplc::badUseIsRefusedWithOneSentence()
{
    QFETCH(QString, command);
    QFETCH(QString, message);
    const Outcome outcome = runProgram(path("qtplc"), command.split(QLatin1Char(' '), Qt::SkipEmptyParts));
    QCOMPARE(outcome.exitCode, 2);
    QCOMPARE(outcome.output, QString());
    QVERIFY2(outcome.errors.startsWith(QLatin1String("qtplc: ")) && outcome.errors.contains(message),
             qPrintable(outcome.errors));
    QCOMPARE(outcome.errors.count(QLatin1Char('\n')), 1);
}

void tst_qtplc::helpShowsEveryCommand()
{
    const Outcome outcome = runProgram(path("qtplc"), {QStringLiteral("--help")});
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.errors, QString());
    for (const char *command :
         {"list",     "get",   "set",   "echo",  "watch",    "hz",     "state",  "init", "arm",      "start", "stop",
          "safestop", "reset", "evict", "admit", "schedule", "jitter", "doctor", "help", "complete", "note"})
        QVERIFY2(outcome.output.contains(QStringLiteral("\n  %1 ").arg(QLatin1String(command))), command);
    QVERIFY(outcome.output.contains(QLatin1String("\nExamples:\n  qtplc list\n")));
    QCOMPARE(runProgram(path("qtplc"), {QStringLiteral("--version")}).exitCode, 0);
}

// ---- what is no master ----

void tst_qtplc::otherServersAreReported_data()
{
    QTest::addColumn<QByteArray>("greeting");
    QTest::addColumn<QString>("message");
    QTest::newRow("nobody") << QByteArray() << QStringLiteral("Connection refused");
    QTest::newRow("another server") << QByteArray("HTTP/1.1 400 Bad Request\r\n\r\n")
                                    << QStringLiteral("sent bytes that are not a QtPLC message");
    QTest::newRow("other message") << QByteArray("\x01\x00\x00\x00\x23", 5)
                                   << QStringLiteral("answers with Done instead of a greeting");
    const QByteArray hello = "\x01{\"protocol\":9}";
    QTest::newRow("other version") << QByteArray("\x0f\x00\x00\x00", 4) + hello << QStringLiteral("protocol version 9");
}

void tst_qtplc::otherServersAreReported()
{
    QFETCH(QByteArray, greeting);
    QFETCH(QString, message);
    QTcpServer server;
    QVERIFY(server.listen(QHostAddress::LocalHost));
    const quint16 port = server.serverPort();
    if (greeting.isEmpty())
        server.close();
    connect(&server, &QTcpServer::newConnection, &server, [&] { server.nextPendingConnection()->write(greeting); });
    Program program(path("qtplc"), {QStringLiteral("--master=127.0.0.1:%1").arg(port), QStringLiteral("state")});
    QTRY_VERIFY(program.state() == QProcess::NotRunning);
    QCOMPARE(program.waitForEnd(), 2);
    QVERIFY2(program.errors().contains(message), qPrintable(program.errors()));
    QVERIFY2(program.errors().contains(QString::number(port)), qPrintable(program.errors()));
    QCOMPARE(program.errors().count(QLatin1Char('\n')), 1);
    QCOMPARE(program.output(), QString());
}

void tst_qtplc::silentMasterTimesOut()
{
    QTcpServer server;
    QVERIFY(server.listen(QHostAddress::LocalHost));
    Program program(path("qtplc"),
                    {QStringLiteral("--master=127.0.0.1:%1").arg(server.serverPort()), QStringLiteral("--timeout=0.2"),
                     QStringLiteral("list")});
    QCOMPARE(program.waitForEnd(), 2);
    QVERIFY2(program.errors().contains(QLatin1String("no answer within 0.2 s")), qPrintable(program.errors()));
}

void tst_qtplc::masterMayRefuseTheGreeting()
{
    QTcpServer server;
    QVERIFY(server.listen(QHostAddress::LocalHost));
    const QByteArray text = "\x04{\"error\":\"TooLong\",\"text\":\"the table is\\u0007 too long\"}";
    connect(&server, &QTcpServer::newConnection, &server, [&] {
        QTcpSocket *socket = server.nextPendingConnection();
        const char length[] = {char(text.size()), 0, 0, 0};
        socket->write(length, 4);
        socket->write(text);
        socket->disconnectFromHost();
    });
    Program program(path("qtplc"),
                    {QStringLiteral("--master=127.0.0.1:%1").arg(server.serverPort()), QStringLiteral("list")});
    QTRY_VERIFY(program.state() == QProcess::NotRunning);
    QCOMPARE(program.waitForEnd(), 1);
    // What the other side says must not command the terminal.
    QVERIFY2(program.errors().contains(QLatin1String("refuses: the table is\\x07 too long")),
             qPrintable(program.errors()));
}

// ---- a real master ----

void tst_qtplc::stateNamesTheNodes()
{
    QVERIFY(startNodes());
    const Outcome outcome = qtplc(QStringLiteral("state"));
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.errors, QString());
    for (const char *line : {"state     Off\n", "cycle     0 (0.000 s)\n", "period    10 ms\n", "clock     Real time\n",
                             "counters  all zero\n", "session   ", "digest    "})
        QVERIFY2(outcome.output.contains(QLatin1String(line)), qPrintable(outcome.output));
    const QRegularExpression model(QStringLiteral("\nModel +udp +Registered +ErrorZeroOrderHold +3 +18\n"));
    QVERIFY2(model.match(outcome.output).hasMatch(), qPrintable(outcome.output));
    QVERIFY2(qtplc(QStringLiteral("state --verbose"))
                 .output.contains(QRegularExpression(QStringLiteral("\nAutopilot +udp +127\\.0\\.0\\.1:\\d+ +"))),
             "address");
    QVERIFY(!outcome.output.contains(QLatin1Char('\033')));  // a pipe is no terminal
}

void tst_qtplc::listShowsEverySignal()
{
    QVERIFY(startNodes());
    const Outcome outcome = qtplc(QStringLiteral("list"));
    QCOMPARE(outcome.exitCode, 0);
    const QStringList lines = linesOf(outcome);
    QPlcSignalIndexTable table;
    QVERIFY(table.initializeFromIniFile(QStringLiteral(QTPLC_SIGNALS)));
    QCOMPARE(lines.size(), 1 + QPlcSignalIndexTable::current().size());
    QCOMPARE(lines.constFirst().simplified(), QStringLiteral("name type value unit quality writer"));
    QVERIFY(outcome.output.contains(
        QRegularExpression(QStringLiteral("\ntetherSpeed +Real32 +0 +m/s +invalid +Autopilot\n"))));
    QVERIFY(outcome.output.contains(QRegularExpression(QStringLiteral("\ncrashed +Int8 +No +- +invalid +Model\n"))));
    // Columns are aligned: the second begins at the same place everywhere.
    const int column = lines.constFirst().indexOf(QLatin1String("type"));
    for (const QString &line : lines)
        QVERIFY2(line.at(column - 1) == QLatin1Char(' ') && line.at(column) != QLatin1Char(' '), qPrintable(line));
    QVERIFY(!outcome.output.contains(QLatin1String("speed of the winch")));
    QVERIFY(qtplc(QStringLiteral("list --verbose"))
                .output.contains(QLatin1String("  speed of the winch, > 0 reels out\n")));
}

void tst_qtplc::commandsRunACompleteFlight()
{
    QVERIFY(startNodes());
    const Outcome initialized = qtplc(QStringLiteral("init"));
    QCOMPARE(initialized.exitCode, 0);
    QCOMPARE(initialized.output, QStringLiteral("initialized\n"));
    QCOMPARE(qtplc(QStringLiteral("start")).output, QStringLiteral("started\n"));
    QVERIFY(qtplc(QStringLiteral("state")).output.startsWith(QLatin1String("state     Real time\n")));
    const Outcome echo = qtplc(QStringLiteral("echo tetherLength --count 2"));
    QCOMPARE(echo.exitCode, 0);
    QCOMPARE(linesOf(echo).size(), 3);
    QCOMPARE(qtplc(QStringLiteral("stop")).output, QStringLiteral("stopped\n"));
    QCOMPARE(qtplc(QStringLiteral("stop")).exitCode, 0);  // may be said twice
    QVERIFY(qtplc(QStringLiteral("state")).output.startsWith(QLatin1String("state     Off\n")));
}

void tst_qtplc::startEndsAfterItsCycles()
{
    QCOMPARE(qtplc(QStringLiteral("start --cycles 5")).output, QStringLiteral("started for 5 cycles\n"));
    QString state;
    QTRY_VERIFY((state = qtplc(QStringLiteral("state")).output).startsWith(QLatin1String("state     Off\n")));
    // Number 4, or one before it when a machine that is busy with other things made the master skip
    // the last ones.
    QVERIFY2(QRegularExpression(QStringLiteral("^cycle     [0-4] "), QRegularExpression::MultilineOption)
                 .match(state)
                 .hasMatch(),
             qPrintable(state));
    for (const char *number : {"0", "-1", "many", "1e3"}) {
        const Outcome outcome = qtplc(QStringLiteral("start --cycles %1").arg(QLatin1String(number)));
        QCOMPARE(outcome.exitCode, 2);
        QVERIFY2(outcome.errors.contains(QStringLiteral("--cycles %1: use").arg(QLatin1String(number))),
                 qPrintable(outcome.errors));
    }
}

void tst_qtplc::refusedCommandsKeepTheMasterAsItIs()
{
    QVERIFY(startNodes());
    QCOMPARE(qtplc(QStringLiteral("start")).exitCode, 0);
    for (const char *command : {"start", "init", "set tetherSpeed 1"}) {
        const Outcome outcome = qtplc(QString::fromLatin1(command));
        QCOMPARE(outcome.exitCode, 1);
        QCOMPARE(outcome.output, QString());
        QVERIFY2(outcome.errors.startsWith(QLatin1String("qtplc: the master refuses: ")), qPrintable(outcome.errors));
    }
    QVERIFY(qtplc(QStringLiteral("set tetherSpeed 1"))
                .errors.contains(QLatin1String("'tetherSpeed' is written by 'Autopilot'")));
    QVERIFY(qtplc(QStringLiteral("state")).output.startsWith(QLatin1String("state     Real time\n")));
}

void tst_qtplc::setChangesSignalsWithoutWriter()
{
    const Outcome outcome
        = qtplc(QStringLiteral("set tetherSpeed -1.5 bodyControlYawSpeed 30 windVelocity_earth 5,-3,0"));
    QVERIFY2(outcome.exitCode == 0, qPrintable(outcome.errors));
    QCOMPARE(
        outcome.output,
        QStringLiteral("tetherSpeed = -1.5 m/s\nbodyControlYawSpeed = 30 deg/s\nwindVelocity_earth = 5, -3, 0 m/s\n"));
    const QString list = qtplc(QStringLiteral("list")).output;
    QVERIFY2(list.contains(QRegularExpression(QStringLiteral("\ntetherSpeed +Real32 +-1\\.5 +m/s +good +-\n"))),
             qPrintable(list));
    QVERIFY2(list.contains(
                 QRegularExpression(QStringLiteral("\nwindVelocity_earth +Real32\\[3\\] +5, -3, 0 +m/s +good +-\n"))),
             qPrintable(list));
}

void tst_qtplc::setRefusesBadValues_data()
{
    QTest::addColumn<QString>("command");
    QTest::addColumn<int>("exitCode");
    QTest::addColumn<QString>("message");
    QTest::newRow("no number") << QStringLiteral("set tetherSpeed fast") << 2
                               << QStringLiteral("signal 'tetherSpeed': 'fast' is not a number");
    QTest::newRow("too many numbers") << QStringLiteral("set tetherSpeed 1,2") << 2
                                      << QStringLiteral("signal 'tetherSpeed': ");
    QTest::newRow("one good, one bad") << QStringLiteral("set tetherSpeed 1 power fast") << 2
                                       << QStringLiteral("signal 'power': ");
    QTest::newRow("no value") << QStringLiteral("set tetherSpeed 1 power") << 2
                              << QStringLiteral("signal 'power' has no value");
    QTest::newRow("twice") << QStringLiteral("set tetherSpeed 1 tetherSpeed 2") << 2
                           << QStringLiteral("signal 'tetherSpeed' is there twice");
    QTest::newRow("unknown") << QStringLiteral("set teterSpeed 1") << 2
                             << QStringLiteral("unknown signal 'teterSpeed'; did you mean 'tetherSpeed'?");
    QTest::newRow("out of range") << QStringLiteral("set power 1 tetherSpeed -11") << 1
                                  << QStringLiteral("-11 is out of range for signal 'tetherSpeed'");
    QTest::newRow("not finite") << QStringLiteral("set power nan") << 1 << QStringLiteral("'power'");
}

void tst_qtplc::setRefusesBadValues()
{
    QFETCH(QString, command);
    QFETCH(int, exitCode);
    QFETCH(QString, message);
    const QString before = qtplc(QStringLiteral("list")).output;
    const Outcome outcome = qtplc(command);
    QCOMPARE(outcome.exitCode, exitCode);
    QVERIFY2(outcome.errors.contains(message), qPrintable(outcome.errors));
    QCOMPARE(outcome.errors.count(QLatin1Char('\n')), 1);
    QCOMPARE(outcome.output, QString());
    QCOMPARE(qtplc(QStringLiteral("list")).output, before);  // all or nothing
}

// ---- echo ----

void tst_qtplc::echoBeforeTheFlightShowsPresentValuesOnce()
{
    QVERIFY(startNodes());
    QCOMPARE(qtplc(QStringLiteral("init")).exitCode, 0);
    const Outcome outcome = qtplc(QStringLiteral("echo bodyPosition_earth tetherLength --count 1"));
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.errors, QString());
    QCOMPARE(outcome.output,
             QStringLiteral("time [s]\tbodyPosition_earth [m]\ttetherLength [m]\n-\t74.26106, 44.55664, 50\t100\n"));
}

void tst_qtplc::echoPrintsLinesAtItsRate()
{
    QVERIFY(startNodes());
    QCOMPARE(qtplc(QStringLiteral("start")).exitCode, 0);
    const Outcome outcome = qtplc(QStringLiteral("echo power flightPhase --count 6 --rate 20"));
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.errors, QString());
    const QStringList lines = linesOf(outcome);
    QCOMPARE(lines.size(), 7);
    QCOMPARE(lines.constFirst(), QStringLiteral("time [s]\tpower [W]\tflightPhase"));
    double last = -1.0;
    for (const QString &line : lines.mid(1)) {
        QCOMPARE(line.count(QLatin1Char('\t')), 2);
        const double time = line.section(QLatin1Char('\t'), 0, 0).toDouble();
        QVERIFY(time > last);
        last = time;
    }
    // Five pauses of 50 ms of the real clock: no fewer cycles than that, however loaded the machine
    // is.
    QVERIFY(last - lines.at(1).section(QLatin1Char('\t'), 0, 0).toDouble() > 0.15);
    for (const char *option : {"--rate 0", "--rate fast", "--count 0", "--count -1"})
        QCOMPARE(qtplc(QStringLiteral("echo power %1").arg(QLatin1String(option))).exitCode, 2);
}

void tst_qtplc::echoStartedBeforeTheFlightShowsItsCycles()
{
    QVERIFY(startNodes());
    Program echo(path("qtplc"), withMaster(QStringLiteral("echo tetherLength --count 3")));
    QVERIFY(echo.waitForOutput(QStringLiteral("\n-\t")));
    QTRY_VERIFY(qtplc(QStringLiteral("state")).output.contains(QLatin1String("qtplc-echo-")));
    QCOMPARE(qtplc(QStringLiteral("start")).exitCode, 0);
    QCOMPARE(echo.waitForEnd(), 0);
    QCOMPARE(echo.output().count(QLatin1Char('\n')), 4);
    QVERIFY(!echo.output().contains(QLatin1Char('\033')));
}

void tst_qtplc::echoJoiningAnEndingPhaseShowsRemainingValues()
{
    QVERIFY(startNodes());
    for (unsigned long pause = 0; pause < 8000;
         pause += 500) {  // [us], so that each step of joining meets the end of a phase
        QCOMPARE(qtplc(QStringLiteral("start")).exitCode, 0);
        Program stop(path("qtplc"), withMaster(QStringLiteral("stop")));
        QThread::usleep(pause);
        Program echo(path("qtplc"), withMaster(QStringLiteral("echo tetherLength --count 1")));
        QCOMPARE(stop.waitForEnd(), 0);
        QCOMPARE(echo.waitForEnd(), 0);
        QCOMPARE(echo.output().count(QLatin1Char('\n')), 2);
    }
}

void tst_qtplc::echoShowsMoreSignalsThanOneAnswerHolds()
{
    constexpr int more = 10'000;
    QFile example(QStringLiteral(QTPLC_SIGNALS));
    QVERIFY(example.open(QIODevice::ReadOnly));
    QTemporaryFile table;
    QVERIFY(table.open());
    table.write(example.readAll());
    for (int i = 0; i < more; ++i)
        table.write("\n[more" + QByteArray::number(i) + "]\ntype = Real32\ndescription = " + QByteArray(60, 'x')
                    + "\n");
    table.close();
    QVERIFY(startMaster({QStringLiteral("--signals"), table.fileName()}));
    const Outcome outcome = qtplc(QStringLiteral("echo more* --count 1"));
    QVERIFY2(outcome.exitCode == 0, qPrintable(outcome.errors));
    QCOMPARE(outcome.output.count(QLatin1Char('\n')), 2);
    QCOMPARE(linesOf(outcome).constFirst().simplified().count(QStringLiteral("more")), more);
}

void tst_qtplc::echoEndsCleanlyOnUnixSignals_data()
{
    QTest::addColumn<int>("signal");
    QTest::newRow("Ctrl-C") << SIGINT;
    QTest::newRow("SIGTERM") << SIGTERM;
}

void tst_qtplc::echoEndsCleanlyOnUnixSignals()
{
    QFETCH(int, signal);
    QCOMPARE(qtplc(QStringLiteral("start")).exitCode, 0);
    Program echo(path("qtplc"), withMaster(QStringLiteral("echo masterTime")));
    QVERIFY(echo.waitForOutput(QStringLiteral("Z\n")));
    echo.sendSignal(signal);
    QCOMPARE(echo.waitForEnd(), 0);
    QCOMPARE(echo.errors(), QString());
    QVERIFY(echo.output().endsWith(QLatin1Char('\n')));  // whole lines only
    QVERIFY(qtplc(QStringLiteral("state")).output.startsWith(QLatin1String("state     Real time\n")));
}

void tst_qtplc::echoEndsWithTheMaster_data()
{
    QTest::addColumn<int>("signal");
    QTest::addColumn<QString>("options");
    QTest::addColumn<int>("exitCode");
    QTest::addColumn<QString>("message");
    QTest::newRow("orderly end") << SIGTERM << QString() << 0 << QString();
    QTest::newRow("lines missing") << SIGTERM << QStringLiteral("--count 1000000") << 1
                                   << QStringLiteral("lines too early");
    QTest::newRow("crash") << SIGKILL << QString() << 1 << QStringLiteral("has lost the master");
}

void tst_qtplc::echoEndsWithTheMaster()
{
    QFETCH(int, signal);
    QFETCH(QString, options);
    QFETCH(int, exitCode);
    QFETCH(QString, message);
    QCOMPARE(qtplc(QStringLiteral("start")).exitCode, 0);
    Program echo(path("qtplc"), withMaster(QStringLiteral("echo masterTime ") + options));
    QVERIFY(echo.waitForOutput(QStringLiteral("Z\n")));
    m_master->sendSignal(signal);
    QCOMPARE(echo.waitForEnd(), exitCode);
    QVERIFY2(echo.errors().contains(message), qPrintable(echo.errors()));
    QCOMPARE(echo.errors().count(QLatin1Char('\n')), message.isEmpty() ? 0 : 1);
}

void tst_qtplc::unknownSignalNamesCloseOnes()
{
    const Outcome outcome = qtplc(QStringLiteral("echo tetherLenght power nonsense"));
    QCOMPARE(outcome.exitCode, 2);
    QCOMPARE(outcome.output, QString());
    QVERIFY2(outcome.errors.contains(QLatin1String("unknown signal 'tetherLenght'; did you mean 'tetherLength'")),
             qPrintable(outcome.errors));
    QVERIFY2(outcome.errors.contains(QLatin1String("unknown signal 'nonsense'")), qPrintable(outcome.errors));
    QCOMPARE(outcome.errors.count(QLatin1Char('\n')), 1);
}

void tst_qtplc::eventsAreFollowedUntilCtrlC()
{
    QVERIFY(startNodes());
    Program events(path("qtplc"), withMaster(QStringLiteral("events --follow")));
    QVERIFY(events.waitForOutput(QStringLiteral("registered over")));  // the backlog
    QCOMPARE(qtplc(QStringLiteral("start")).exitCode, 0);
    QVERIFY(events.waitForOutput(QStringLiteral("state Real time\n")));
    QCOMPARE(qtplc(QStringLiteral("stop")).exitCode, 0);
    QVERIFY(events.waitForOutput(QStringLiteral("state Off: 'qtplc' asked for it\n")));
    QCOMPARE(events.output().count(QStringLiteral("state Real time\n")), 1);
    events.sendSignal(SIGINT);
    QCOMPARE(events.waitForEnd(), 0);
    QCOMPARE(events.errors(), QString());
}

QTEST_GUILESS_MAIN(tst_qtplc)
#include "tst_qtplc.moc"
