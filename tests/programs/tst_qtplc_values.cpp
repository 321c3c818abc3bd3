// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ProcessPlant.h"

#include <csignal>
#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace {

/// A terminal of 80 x 20 characters that a program believes to be in front of a person.
class Terminal
{
public:
    Terminal()
        : m_mine(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC))
    {
        ::grantpt(m_mine);
        ::unlockpt(m_mine);
        winsize size{};
        size.ws_col = 80;
        size.ws_row = 20;
        m_theirs = ::open(::ptsname(m_mine), O_RDWR | O_NOCTTY | O_CLOEXEC);
        ::ioctl(m_theirs, TIOCSWINSZ, &size);
        ::fcntl(m_mine, F_SETFL, O_NONBLOCK);
    }
    ~Terminal()
    {
        ::close(m_mine);
        ::close(m_theirs);
    }
    Terminal(const Terminal &) = delete;
    Terminal &operator=(const Terminal &) = delete;

    int descriptor() const { return m_theirs; }
    void press(const QByteArray &keys)
    {
        QCOMPARE(::write(m_mine, keys.constData(), size_t(keys.size())), keys.size());
    }
    /// All that was written to it.
    QByteArray screen()
    {
        char buffer[4096];
        for (ssize_t count = 0; (count = ::read(m_mine, buffer, sizeof buffer)) > 0;)
            m_screen.append(buffer, int(count));
        return m_screen;
    }
    void forget() { m_screen = screen().left(0); }
    bool hasLineInput() const
    {
        termios settings{};
        ::tcgetattr(m_theirs, &settings);
        return (settings.c_lflag & ICANON) != 0 && (settings.c_lflag & ECHO) != 0;
    }

private:
    int m_mine, m_theirs;
    QByteArray m_screen;
};

/// A program whose input and output are a terminal.
class TerminalProgram : public QProcess
{
    Q_OBJECT
public:
    TerminalProgram(const Terminal &terminal, const QStringList &arguments)
        : m_terminal(terminal.descriptor())
    {
        start(programPath("qtplc"), arguments);
        waitForStarted();
    }
    ~TerminalProgram() override
    {
        kill();
        waitForFinished();
    }
    int waitForEnd() { return waitForFinished(Program::patience) && exitStatus() == NormalExit ? exitCode() : -1; }

protected:
    void setupChildProcess() override
    {
        ::dup2(m_terminal, STDIN_FILENO);
        ::dup2(m_terminal, STDOUT_FILENO);
    }

private:
    int m_terminal;
};

}  // namespace

/// qtplc get, set --for, hz, watch, patterns and JSON against a real plant.
class tst_qtplc_values : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QVERIFY(m_plant.start()); }
    void getPrintsNameValueAndUnit();
    void valueNamesAreShownExceptInPlainAndJsonOutput();
    void valuesAreSetByNameAndWrongNamesAreRefused();
    void getPrintsPlainAndJsonValues();
    void getAcceptsPatterns();
    void unmatchedPatternIsRefused_data();
    void unmatchedPatternIsRefused();
    void listAcceptsPatterns();
    void jsonIsOneDocument_data();
    void jsonIsOneDocument();
    void echoAndWatchPrintAnObjectPerLine_data();
    void echoAndWatchPrintAnObjectPerLine();
    void echoEveryShowsOneCyclePerInterval();
    void watchWithoutATerminalPrintsLikeEcho();
    void watchRestoresTheTerminal_data();
    void watchRestoresTheTerminal();
    void watchScrolls();
    void setForRestoresTheFormerValueAfterItsTime();
    void endedSetForRestoresTheFormerValue_data();
    void endedSetForRestoresTheFormerValue();
    void setForTellsThatTheMasterIsLost();
    void hzMeasuresTheCycle();
    void hzNeedsARunningPlant();
    void interruptedHzPrintsItsResult();
    void coloursNeedATerminalThatSupportsThem_data();
    void coloursNeedATerminalThatSupportsThem();

private:
    QString value(const QString &signal) const
    {
        return m_plant.qtplc(QStringLiteral("get --plain ") + signal).output.trimmed();
    }
    ProcessPlant m_plant;
};

// ---- get, list ----

void tst_qtplc_values::coloursNeedATerminalThatSupportsThem_data()
{
    QTest::addColumn<QByteArray>("term");
    QTest::addColumn<QByteArray>("noColor");
    QTest::addColumn<bool>("isColoured");
    QTest::newRow("a terminal") << QByteArray("xterm") << QByteArray() << true;
    QTest::newRow("NO_COLOR") << QByteArray("xterm") << QByteArray("1") << false;
    QTest::newRow("a terminal without colours") << QByteArray("dumb") << QByteArray() << false;
}

void tst_qtplc_values::coloursNeedATerminalThatSupportsThem()
{
    QFETCH(QByteArray, term);
    QFETCH(QByteArray, noColor);
    QFETCH(bool, isColoured);
    const QByteArray before = qgetenv("TERM");
    qputenv("TERM", term);
    qputenv("NO_COLOR", noColor);
    Terminal terminal;
    TerminalProgram list(terminal, m_plant.withMaster("list tether*"));
    qputenv("TERM", before);
    qunsetenv("NO_COLOR");
    QCOMPARE(list.waitForEnd(), 0);
    const QByteArray screen = terminal.screen();
    QVERIFY2(screen.contains("tetherSpeed"), screen.constData());
    QCOMPARE(screen.contains('\033'), isColoured);
    for (const QByteArray &line : screen.split('\n'))  // the terminal has 80 columns
        QVERIFY2(isColoured || line.size() <= 81, line.constData());
}

void tst_qtplc_values::getPrintsNameValueAndUnit()
{
    m_plant.qtplc("set tetherSpeed -1.5 windVelocity_earth 5,-3,0");
    const Outcome outcome = m_plant.qtplc("get windVelocity_earth tetherSpeed flightPhase");
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.output,
             QString("windVelocity_earth = 5, -3, 0 m/s\ntetherSpeed = -1.5 m/s\nflightPhase = Launch  (invalid)\n"));
}

void tst_qtplc_values::valueNamesAreShownExceptInPlainAndJsonOutput()
{
    m_plant.qtplc("set flightPhase 2");
    QCOMPARE(m_plant.qtplc("get flightPhase").output, QString("flightPhase = ReelOut\n"));
    QCOMPARE(m_plant.qtplc("get --plain flightPhase").output, QString("2\n"));
    QCOMPARE(jsonOf(m_plant.qtplc("get --json flightPhase").output).object()["flightPhase"], QJsonValue(2));
    QVERIFY(m_plant.qtplc("list flightPhase").output.contains("ReelOut"));
    const QJsonObject row = jsonOf(m_plant.qtplc("list --json flightPhase").output).array().at(0).toObject();
    QCOMPARE(row["value"], QJsonValue(2));
    QCOMPARE(row["names"].toObject()["2"], QJsonValue("ReelOut"));
    QCOMPARE(m_plant.qtplc("echo flightPhase --count 1").output.section('\n', 1), QString("-\t2\n"));
}

void tst_qtplc_values::valuesAreSetByNameAndWrongNamesAreRefused()
{
    const Outcome outcome = m_plant.qtplc("set flightPhase reelin crashed Yes");
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.output, QString("flightPhase = ReelIn\ncrashed = Yes\n"));
    QCOMPARE(value("flightPhase"), QString("4"));
    QCOMPARE(value("crashed"), QString("1"));
    const Outcome refused = m_plant.qtplc("set flightPhase Reel");
    QCOMPARE(refused.exitCode, 2);
    QVERIFY2(refused.errors.contains("signal 'flightPhase': 'Reel' is no")
                 && refused.errors.contains("its names are 0: Launch, 1: Power"),
             qPrintable(refused.errors));
}

void tst_qtplc_values::getPrintsPlainAndJsonValues()
{
    m_plant.qtplc("set tetherSpeed 0.1 windVelocity_earth 5,-3,0");
    QCOMPARE(m_plant.qtplc("get --plain tetherSpeed windVelocity_earth").output, QString("0.1\n5, -3, 0\n"));
    const QJsonObject values = jsonOf(m_plant.qtplc("get --json tetherSpeed windVelocity_earth").output).object();
    QCOMPARE(values, (QJsonObject{{"tetherSpeed", 0.1}, {"windVelocity_earth", QJsonArray{5, -3, 0}}}));
}

void tst_qtplc_values::getAcceptsPatterns()
{
    const Outcome outcome = m_plant.qtplc("get tether* tetherLength p?wer");
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.output.count("tetherLength"), 1);
    QCOMPARE(outcome.output.count('\n'), 4);
    QVERIFY(outcome.output.contains("power = "));
}

void tst_qtplc_values::unmatchedPatternIsRefused_data()
{
    QTest::addColumn<QString>("command");
    for (const char *command : {"get", "list", "echo", "watch"})
        QTest::newRow(command) << QString(command);
}

void tst_qtplc_values::unmatchedPatternIsRefused()
{
    QFETCH(QString, command);
    const Outcome outcome = m_plant.qtplc(command + " zz* power tetherLenght");
    QCOMPARE(outcome.exitCode, 2);
    QCOMPARE(outcome.output, QString());
    QVERIFY2(outcome.errors.contains("no signal matches 'zz*'"), qPrintable(outcome.errors));
    QVERIFY2(outcome.errors.contains("did you mean 'tetherLength'"), qPrintable(outcome.errors));
    QCOMPARE(outcome.errors.count('\n'), 1);
}

void tst_qtplc_values::listAcceptsPatterns()
{
    const Outcome outcome = m_plant.qtplc("list tether*");
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.output.count('\n'), 4);
}

// ---- JSON ----

void tst_qtplc_values::jsonIsOneDocument_data()
{
    QTest::addColumn<QString>("command");
    QTest::addColumn<QString>("member");
    QTest::newRow("state") << "state --json"
                           << "nodes";
    QTest::newRow("set") << "set power 1 --json"
                         << "values";
    QTest::newRow("init") << "init --json"
                          << "done";
    QTest::newRow("start") << "start --cycles 3 --json"
                           << "cycles";
    QTest::newRow("stop") << "stop --json"
                          << "done";
    QTest::newRow("list") << "list power --json" << QString();
}

void tst_qtplc_values::jsonIsOneDocument()
{
    QFETCH(QString, command);
    QFETCH(QString, member);
    const Outcome outcome = m_plant.qtplc(command);
    QCOMPARE(outcome.exitCode, 0);
    const QJsonDocument document = jsonOf(outcome.output);
    QVERIFY2(!document.isNull(), qPrintable(outcome.output));
    if (member.isEmpty())
        QCOMPARE(document.array().at(0)["value"], QJsonValue(0));
    else
        QVERIFY2(document.object().contains(member), qPrintable(outcome.output));
}

void tst_qtplc_values::echoAndWatchPrintAnObjectPerLine_data()
{
    QTest::addColumn<QString>("command");
    QTest::newRow("echo") << "echo power windVelocity_earth --json --rate 100";
    QTest::newRow("watch") << "watch power windVelocity_earth --json --rate 100";
}

void tst_qtplc_values::echoAndWatchPrintAnObjectPerLine()
{
    QFETCH(QString, command);
    Program program(programPath("qtplc"), m_plant.withMaster(command));
    QVERIFY(program.waitForOutput("\n"));
    QCOMPARE(m_plant.qtplc("start").exitCode, 0);
    QTRY_VERIFY(program.output().count('\n') >= 4);
    program.sendSignal(SIGINT);
    QCOMPARE(program.waitForEnd(), 0);
    const QStringList lines = program.output().split('\n', Qt::SkipEmptyParts);
    QVERIFY(QJsonDocument::fromJson(lines.at(0).toUtf8()).object().value("time").isNull());  // before the start
    for (const QString &line : lines.mid(1)) {
        const QJsonObject object = QJsonDocument::fromJson(line.toUtf8()).object();
        QVERIFY2(object.value("cycle").isDouble() && object.value("time").isDouble(), qPrintable(line));
        QCOMPARE(object.value("values").toObject().value("windVelocity_earth").toArray().size(), 3);
    }
}

void tst_qtplc_values::echoEveryShowsOneCyclePerInterval()
{
    Program program(programPath("qtplc"), m_plant.withMaster("echo power --json --rate 1000 --every 7"));
    QVERIFY(program.waitForOutput("\n"));
    QCOMPARE(m_plant.qtplc("start").exitCode, 0);
    QTRY_VERIFY(program.output().count('\n') >= 5);
    program.sendSignal(SIGINT);
    QCOMPARE(program.waitForEnd(), 0);
    const QStringList lines = program.output().split('\n', Qt::SkipEmptyParts);
    int turn = -1;
    for (const QString &line : lines.mid(1)) {
        const int cycle = QJsonDocument::fromJson(line.toUtf8()).object().value("cycle").toInt();
        QVERIFY2(cycle / 7 > turn, qPrintable(line));
        turn = cycle / 7;
    }
}

// ---- watch ----

void tst_qtplc_values::watchWithoutATerminalPrintsLikeEcho()
{
    Program program(programPath("qtplc"), m_plant.withMaster("watch power tetherL*"));
    QVERIFY(program.waitForOutput("\n-\t"));
    program.sendSignal(SIGTERM);
    QCOMPARE(program.waitForEnd(), 0);
    QVERIFY2(program.output().startsWith("time [s]\tpower [W]\ttetherLength [m]\n-\t0\t0\n"),
             qPrintable(program.output()));
}

void tst_qtplc_values::watchRestoresTheTerminal_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<int>("signal");
    QTest::addColumn<int>("exitCode");
    QTest::newRow("q") << QByteArray("q") << 0 << 0;
    QTest::newRow("Ctrl-C") << QByteArray() << SIGINT << 0;
    QTest::newRow("SIGTERM") << QByteArray() << SIGTERM << 0;
    QTest::newRow("the master ends") << QByteArray() << -SIGTERM << 0;
    QTest::newRow("the master crashes") << QByteArray() << -SIGKILL << 1;
}

void tst_qtplc_values::watchRestoresTheTerminal()
{
    QFETCH(QByteArray, keys);
    QFETCH(int, signal);
    QFETCH(int, exitCode);
    Terminal terminal;
    TerminalProgram watch(terminal, m_plant.withMaster("watch power tetherSpeed"));
    QTRY_VERIFY(terminal.screen().contains("tetherSpeed") && terminal.screen().contains("Off"));
    QVERIFY(terminal.screen().startsWith("\033[?1049h"));
    QVERIFY(!terminal.hasLineInput());
    if (!keys.isEmpty())
        terminal.press(keys);
    else if (signal > 0)
        ::kill(pid_t(watch.processId()), signal);
    else
        m_plant.master().sendSignal(-signal);
    QCOMPARE(watch.waitForEnd(), exitCode);
    QVERIFY(terminal.screen().endsWith("\033[?1049l"));
    QVERIFY(terminal.screen().contains("\033[?25h"));  // the cursor is back
    QVERIFY(terminal.hasLineInput());
}

void tst_qtplc_values::watchScrolls()
{
    Terminal terminal;
    TerminalProgram watch(terminal, m_plant.withMaster("watch"));
    QTRY_VERIFY(terminal.screen().contains("rows 1-17 of"));
    terminal.press("\033[B\033[6~");
    QTRY_VERIFY(terminal.screen().contains("rows 19-35 of"));
    terminal.press("G");
    QTRY_VERIFY(terminal.screen().contains("rows 32-48 of 48"));
    terminal.press("xyz\033[A");
    QTRY_VERIFY(terminal.screen().contains("rows 31-47 of"));
    terminal.press("q");
    QCOMPARE(watch.waitForEnd(), 0);
}

// ---- set --for ----

void tst_qtplc_values::setForRestoresTheFormerValueAfterItsTime()
{
    m_plant.qtplc("set tetherSpeed 1.5");
    Program set(programPath("qtplc"), m_plant.withMaster("set tetherSpeed 5 --for 1"));
    QVERIFY(set.waitForOutput("tetherSpeed = 5 m/s\n"));
    QCOMPARE(value("tetherSpeed"), QString("5"));
    QCOMPARE(set.waitForEnd(), 0);
    QTRY_COMPARE(value("tetherSpeed"), QString("1.5"));
    QCOMPARE(set.errors(), QString());
}

void tst_qtplc_values::endedSetForRestoresTheFormerValue_data()
{
    QTest::addColumn<int>("signal");
    QTest::addColumn<int>("exitCode");
    QTest::newRow("interrupted") << SIGINT << 0;
    QTest::newRow("killed") << SIGKILL << -1;
}

void tst_qtplc_values::endedSetForRestoresTheFormerValue()
{
    QFETCH(int, signal);
    QFETCH(int, exitCode);
    Program set(programPath("qtplc"), m_plant.withMaster("set tetherSpeed 5 --for 1000 --json"));
    QVERIFY(set.waitForOutput("\n"));
    QCOMPARE(jsonOf(set.output()).object().value("duration"), QJsonValue(1000));
    QCOMPARE(value("tetherSpeed"), QString("5"));
    set.sendSignal(signal);
    QCOMPARE(set.waitForEnd(), exitCode);
    QTRY_COMPARE(value("tetherSpeed"), QString("0"));
}

void tst_qtplc_values::setForTellsThatTheMasterIsLost()
{
    Program set(programPath("qtplc"), m_plant.withMaster("set tetherSpeed 5 --for 1000"));
    QVERIFY(set.waitForOutput("\n"));
    m_plant.master().sendSignal(SIGKILL);
    QCOMPARE(set.waitForEnd(), 1);
    QVERIFY2(set.errors().contains("lost the master"), qPrintable(set.errors()));
}

// ---- hz ----

void tst_qtplc_values::hzMeasuresTheCycle()
{
    QCOMPARE(m_plant.qtplc("start").exitCode, 0);
    const Outcome outcome = m_plant.qtplc("hz --for 0.5 --json");
    const QJsonObject rate = jsonOf(outcome.output).object();
    const double cycles = rate.value("cycles").toDouble();
    const double lost = rate.value("lost").toDouble();
    QVERIFY2(cycles > 5, qPrintable(outcome.output));
    QCOMPARE(outcome.exitCode, lost > 0 ? 1 : 0);
    QVERIFY(rate.value("interval")["count"].toDouble() <= cycles - 1);
    // All cycles between the first and the last one took their 10 ms, however loaded the machine
    // is.
    QVERIFY(qAbs(rate.value("duration").toDouble() - (cycles - 1 + lost) * 0.010) < 0.1);
    const Outcome text = m_plant.qtplc("hz --for 0.2");
    for (const char *line :
         {"cycles    ", "\nrate      ", " Hz (Real time, period 10 ms)\n", "\ninterval  mean ", "\nlost      "})
        QVERIFY2(text.output.contains(line), qPrintable(text.output));
    const QString number = "\\d[\\d.]* (s|ms|µs|ns)";  // each with its unit
    QVERIFY2(text.output.contains(QRegularExpression("interval  mean " + number + ", min " + number + ", max " + number
                                                     + ", standard deviation " + number)),
             qPrintable(text.output));
}

void tst_qtplc_values::hzNeedsARunningPlant()
{
    const Outcome outcome = m_plant.qtplc("hz");
    QCOMPARE(outcome.exitCode, 1);
    QCOMPARE(outcome.errors, QString("qtplc: the master is in state Off and has no cycles; start it: qtplc start\n"));
}

void tst_qtplc_values::interruptedHzPrintsItsResult()
{
    QCOMPARE(m_plant.qtplc("start").exitCode, 0);
    Program hz(programPath("qtplc"), m_plant.withMaster("hz --for 1000"));
    QTRY_VERIFY(m_plant.qtplc("state").output.contains("qtplc-hz-"));
    QTest::qWait(300);
    hz.sendSignal(SIGINT);
    QVERIFY(hz.waitForEnd() >= 0);
    QVERIFY2(hz.output().contains("\nrate "), qPrintable(hz.output() + hz.errors()));
}

QTEST_GUILESS_MAIN(tst_qtplc_values)
#include "tst_qtplc_values.moc"
