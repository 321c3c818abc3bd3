// SPDX-License-Identifier: Apache-2.0
#include "ClosedLoopFlight.h"
#include "Program.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QFile>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace {

/// A terminal for a program: what it writes to the slave end can be read here.
class Terminal
{
public:
    Terminal()
        : m_master(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC))
    {
        const winsize size = {24, 80, 0, 0};
        if (m_master < 0 || ::grantpt(m_master) != 0 || ::unlockpt(m_master) != 0)
            return;
        m_slave = ::open(::ptsname(m_master), O_RDWR | O_NOCTTY | O_CLOEXEC);
        ::ioctl(m_slave, TIOCSWINSZ, &size);
    }
    ~Terminal()
    {
        ::close(m_slave);
        ::close(m_master);
    }
    int slave() const { return m_slave; }

    /// All that was written so far.
    QByteArray text()
    {
        char buffer[4096];
        for (ssize_t count = 0; (count = ::read(m_master, buffer, sizeof buffer)) > 0;)
            m_text.append(buffer, int(count));
        return m_text;
    }

private:
    int m_master;
    int m_slave = -1;
    QByteArray m_text;
};

}  // namespace

/// awe_sil from outside: the same flight each time, whatever carries it, and a report of what was
/// flown however it ends.
class tst_awe_sil : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void reportHoldsEveryFigure();
    void flightIsIdenticalOverEveryTransport_data();
    void flightIsIdenticalOverEveryTransport();
    void multicastReachesBothNodes();
    void sameCycleFlightIsIdenticalOverEveryTransport_data();
    void sameCycleFlightIsIdenticalOverEveryTransport();
    void sameCycleFlightEqualsTheSingleLoopFlight();
    void plantWithOptionsIsTheSameInEveryProcess_data();
    void plantWithOptionsIsTheSameInEveryProcess();
    void optionsAddTheirFiguresToTheReport();
    void kiteAtAMastStartsAndLands();
    void endOfAFlightWithOptionsIsTold_data();
    void endOfAFlightWithOptionsIsTold();
    void plantWithOptionsEqualsTheSingleLoopFlight();
    void reportContainsTheAgeOfEveryLink_data();
    void reportContainsTheAgeOfEveryLink();
    void anotherSeedIsAnotherFlight();
    void exportedModelFliesTheSameFlight_data();
    void exportedModelFliesTheSameFlight();
    void clockSetsThePace_data();
    void clockSetsThePace();
    void interruptedFlightIsReported_data();
    void interruptedFlightIsReported();
    void progressLineFitsTheTerminal();
    void liveViewRestoresTheTerminal_data();
    void liveViewRestoresTheTerminal();

private:
    static void addTransports();
    /// Waits until the terminal shows \a text. \return false when it does not, or the program has
    /// ended
    static bool waitForText(Terminal &terminal, const Program &program, const char *text);
    /// Waits for the end of a program that writes to the terminal. \return the exit code
    static int waitForEnd(Terminal &terminal, Program &program);
    static QString path() { return QStringLiteral(AWE_PROGRAMS "/awe_sil"); }
    /// Flies 10 s of turbulence. \return the report; empty, with a warning, when that failed
    QJsonObject fly(const QString &options);
    QJsonObject readReport(const QString &fileName);

    QTemporaryDir m_folder;
    QJsonObject m_flight;
    QJsonObject m_sameCycleFlight;
};

bool tst_awe_sil::waitForText(Terminal &terminal, const Program &program, const char *text)
{
    const auto isOver = [&] { return terminal.text().contains(text) || program.state() == QProcess::NotRunning; };
    return QTest::qWaitFor(isOver, Program::patience) && terminal.text().contains(text);
}

int tst_awe_sil::waitForEnd(Terminal &terminal, Program &program)
{
    // A terminal that nobody reads is full one day.
    const auto isOver = [&] { return (void)terminal.text(), program.state() == QProcess::NotRunning; };
    return QTest::qWaitFor(isOver, Program::patience) ? program.waitForEnd() : -2;
}

QJsonObject tst_awe_sil::readReport(const QString &fileName)
{
    QFile file(fileName);
    return file.open(QIODevice::ReadOnly) ? QJsonDocument::fromJson(file.readAll()).object() : QJsonObject();
}

QJsonObject tst_awe_sil::fly(const QString &options)
{
    const QString report = m_folder.filePath(QStringLiteral("flight.json"));
    QFile::remove(report);
    const QStringList fixed{QStringLiteral("--duration=10"), QStringLiteral("--turbulence=0.15"),
                            QStringLiteral("--report"), report};
    const Outcome outcome = runProgram(path(), fixed + options.split(QLatin1Char(' '), Qt::SkipEmptyParts));
    if (outcome.exitCode != 0)
        qWarning().noquote() << outcome.exitCode << outcome.errors;
    return readReport(report);
}

void tst_awe_sil::reportHoldsEveryFigure()
{
    const QString report = m_folder.filePath(QStringLiteral("long.json"));
    const Outcome outcome = runProgram(path(), {QStringLiteral("--duration=300"), QStringLiteral("--report"), report});
    QCOMPARE(outcome.exitCode, 0);
    QVERIFY(outcome.output.startsWith(QLatin1String("Flight of 300.0 s in ")));
    const QJsonObject flight = readReport(report);
    for (const char *field : {"cycles", "simulated_s", "wall_s", "real_time_factor", "energy_J", "mean_power_W", "eta",
                              "eta_per_mean_cubed_wind", "reel_out_power_W", "reel_in_power_W", "pumping_cycles",
                              "min_altitude_m", "max_tether_force_N", "recoveries", "overruns", "late_answers"})
        QVERIFY2(flight.value(QLatin1String(field)).isDouble(), field);
    QVERIFY(flight.value(QStringLiteral("crashed")).isBool());
    QCOMPARE(flight.value(QStringLiteral("crashed")).toBool(), false);
    QCOMPARE(flight.value(QStringLiteral("image_digest")).toString().size(), 16);
    QCOMPARE(flight.value(QStringLiteral("cycles")).toInt(), 30000);
    QCOMPARE(flight.value(QStringLiteral("simulated_s")).toDouble(), 300.0);
    QVERIFY(flight.value(QStringLiteral("pumping_cycles")).toInt() >= 1);
    QVERIFY(flight.value(QStringLiteral("energy_J")).toDouble() > 0.0);
    QVERIFY(flight.value(QStringLiteral("reel_out_power_W")).toDouble() > 0.0
            && flight.value(QStringLiteral("reel_in_power_W")).toDouble() < 0.0);
    QVERIFY(flight.value(QStringLiteral("min_altitude_m")).toDouble() > 0.0);
    QCOMPARE(flight.value(QStringLiteral("late_answers")).toInt(), 0);
}

void tst_awe_sil::addTransports()
{
    QTest::addColumn<QString>("options");
    QTest::newRow("in one process") << QString();
    QTest::newRow("again") << QString();
    QTest::newRow("in one process over tcp") << QStringLiteral("--transport tcp");
    QTest::newRow("in one process over udp") << QStringLiteral("--transport udp");
    QTest::newRow("processes over tcp") << QStringLiteral("--processes --transport tcp");
    QTest::newRow("processes over udp") << QStringLiteral("--processes --transport udp");
    QTest::newRow("in one process through shared memory") << QStringLiteral("--transport local");
    QTest::newRow("processes with shared memory") << QStringLiteral("--processes --transport local");
    QTest::newRow("turned by the program") << QStringLiteral("--external");
    QTest::newRow("turned by the program, in one process over udp") << QStringLiteral("--external --transport udp");
    for (const char *transport : {"udp", "tcp", "local"})
        QTest::newRow(
            qPrintable(QStringLiteral("turned by the master, processes over %1").arg(QLatin1String(transport))))
            << QStringLiteral("--external --processes --transport %1").arg(QLatin1String(transport));
}

void tst_awe_sil::flightIsIdenticalOverEveryTransport_data()
{
    addTransports();
    QTest::newRow("in one process over multicast") << QStringLiteral("--transport udp-multicast");
    QTest::newRow("processes over multicast") << QStringLiteral("--processes --transport udp-multicast");
}

void tst_awe_sil::flightIsIdenticalOverEveryTransport()
{
    QFETCH(QString, options);
    const QJsonObject flight = fly(options);
    if (m_flight.isEmpty())
        m_flight = flight;
    QCOMPARE(flight.value(QStringLiteral("cycles")).toInt(), 1000);
    QCOMPARE(flight.value(QStringLiteral("image_digest")), m_flight.value(QStringLiteral("image_digest")));
    QCOMPARE(flight.value(QStringLiteral("energy_J")), m_flight.value(QStringLiteral("energy_J")));
}

void tst_awe_sil::multicastReachesBothNodes()
{
    const Outcome outcome = runProgram(
        path(),
        {QStringLiteral("--processes"), QStringLiteral("--duration=1"), QStringLiteral("--transport=udp-multicast")});
    QCOMPARE(outcome.exitCode, 0);
    for (const char *node : {"Model", "Autopilot"})
        QVERIFY2(
            outcome.errors.contains(QStringLiteral("node %1 registered over udp-multicast\n").arg(QLatin1String(node))),
            qPrintable(outcome.errors));
}

void tst_awe_sil::sameCycleFlightIsIdenticalOverEveryTransport_data()
{
    addTransports();
}

void tst_awe_sil::sameCycleFlightIsIdenticalOverEveryTransport()
{
    QFETCH(QString, options);
    const QJsonObject flight = fly(QStringLiteral("--same-cycle ") + options);
    if (m_sameCycleFlight.isEmpty())
        m_sameCycleFlight = flight;
    QCOMPARE(flight.value(QStringLiteral("cycles")).toInt(), 1000);
    QCOMPARE(flight.value(QStringLiteral("image_digest")), m_sameCycleFlight.value(QStringLiteral("image_digest")));
    QCOMPARE(flight.value(QStringLiteral("energy_J")), m_sameCycleFlight.value(QStringLiteral("energy_J")));
    QCOMPARE(flight.value(QStringLiteral("late_answers")).toInt(), 0);
    QVERIFY(flight.value(QStringLiteral("image_digest")) != m_flight.value(QStringLiteral("image_digest")));
}

/// Plant and autopilot in one loop, without QtPLC, with the rounding of the signals, in the wind of
/// fly().
/// \param duration  [s] a cycle less than that of the program: the observer sees a cycle after it
///                  has been, and the last one not at all
static awe::FlightReport singleLoop(awe::ClosedLoopParameters parameters, double duration)
{
    parameters.deadTime = 0;
    parameters.precision = awe::SignalPrecision::Real32;
    parameters.wind.turbulenceIntensity = 0.15;
    const Eigen::Vector3d &wind = parameters.wind.meanVelocity;
    parameters.plant.initialState
        = awe::PlantParameters::stateAtRest(30.0, std::atan2(wind.y(), wind.x()) * 180.0 / M_PI, 100.0);
    awe::ClosedLoopFlight loop(parameters);
    loop.fly(duration);
    return loop.report();
}

static double figure(const QJsonObject &flight, const char *name)
{
    return flight.value(QLatin1String(name)).toDouble();
}

static void compareToTheLastBit(const QJsonObject &flight, const awe::FlightReport &expected)
{
    QVERIFY(figure(flight, "energy_J") == expected.energy);
    QVERIFY(figure(flight, "min_altitude_m") == expected.minimumAltitude);
    QVERIFY(figure(flight, "max_tether_force_N") == expected.maximumTetherForce);
}

/// The same figures to the last bit.
void tst_awe_sil::sameCycleFlightEqualsTheSingleLoopFlight()
{
    const awe::FlightReport expected = singleLoop({}, 299.99);
    const QJsonObject flight = fly(QStringLiteral("--same-cycle --duration 300"));
    compareToTheLastBit(flight, expected);
    QVERIFY(figure(flight, "pumping_cycles") == expected.pumpingCycles);
    QVERIFY(expected.pumpingCycles >= 1 && expected.energy > 0.0);
}

void tst_awe_sil::plantWithOptionsIsTheSameInEveryProcess_data()
{
    QTest::addColumn<QString>("options");
    QTest::addColumn<bool>("isThesis");
    QTest::newRow("thesis") << QStringLiteral("--plant thesis") << true;
    QTest::newRow("realistic") << QStringLiteral("--plant realistic") << false;
    QTest::newRow("realistic, ideal winch") << QStringLiteral("--plant realistic --winch ideal") << false;
    QTest::newRow("realistic, same cycle") << QStringLiteral("--plant realistic --same-cycle") << false;
    QTest::newRow("drag") << QStringLiteral("--plant drag") << false;
    QTest::newRow("mode drag") << QStringLiteral("--mode drag") << false;
    QTest::newRow("machine") << QStringLiteral("--winch machine") << false;
    QTest::newRow("mast") << QStringLiteral("--plant mast --duration 70") << false;
}

/// The three programs read the plant by themselves, and agree on its signals. Without options it is
/// the flight without --plant.
void tst_awe_sil::plantWithOptionsIsTheSameInEveryProcess()
{
    QFETCH(QString, options);
    QFETCH(bool, isThesis);
    const QString digest = QStringLiteral("image_digest");
    const QJsonObject alone = fly(options), processes = fly(options + QStringLiteral(" --processes"));
    QVERIFY(alone.value(QStringLiteral("cycles")).toInt() >= 1000);
    QCOMPARE(processes.value(digest), alone.value(digest));
    QCOMPARE(alone.value(digest) == fly({}).value(digest), isThesis);
}

void tst_awe_sil::optionsAddTheirFiguresToTheReport()
{
    const auto has
        = [](const QJsonObject &flight, const char *field) { return flight.value(QLatin1String(field)).isDouble(); };
    const QJsonObject thesis = fly({}), machine = fly(QStringLiteral("--winch machine")),
                      drag = fly(QStringLiteral("--plant drag"));
    QVERIFY(!has(thesis, "electrical_power_W") && !has(thesis, "turbine_power_W") && !has(thesis, "dockings"));
    QVERIFY(has(machine, "electrical_power_W") && !has(machine, "turbine_power_W"));
    QVERIFY(!has(drag, "electrical_power_W") && has(drag, "turbine_power_W"));
    QVERIFY(figure(machine, "electrical_power_W") < figure(machine, "mean_power_W"));
    QVERIFY(figure(drag, "turbine_power_W") > 500.0);
}

/// From the start to the landing, which the fall of the wind causes.
void tst_awe_sil::kiteAtAMastStartsAndLands()
{
    QFile file(m_folder.filePath(QStringLiteral("mast.ini")));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(
        "[kite]\nwind = 8,0,0\ngustAmplitude = -0.4\ngustStart = 240\ngustDuration = 800\n[mast]\nkind = fixed\n");
    file.close();
    const QString report = m_folder.filePath(QStringLiteral("mast.json"));
    const Outcome outcome = runProgram(path(),
                                       {QStringLiteral("--duration=700"), QStringLiteral("--plant"), file.fileName(),
                                        QStringLiteral("--report"), report});
    QCOMPARE(outcome.exitCode, 0);
    QVERIFY2(outcome.output.contains(QLatin1String("\n  mast               starts 1, dockings 1, the fastest at 0."))
                 && outcome.output.contains(QLatin1String(" m/s; on the mast at the end\n")),
             qPrintable(outcome.output));
    const QJsonObject flight = readReport(report);
    QVERIFY(flight.value(QStringLiteral("landed")).toBool());
    QCOMPARE(flight.value(QStringLiteral("crashed")).toBool(), false);
    QVERIFY(figure(flight, "starts") == 1.0 && figure(flight, "dockings") == 1.0);
    QVERIFY(figure(flight, "docking_speed_m_s") > 0.0 && figure(flight, "docking_speed_m_s") <= 1.0);
    QVERIFY(figure(flight, "pumping_cycles") >= 2.0);
}

/// What a flight ended with is in its summary and report, and the remedy in what refuses it.
void tst_awe_sil::endOfAFlightWithOptionsIsTold_data()
{
    QTest::addColumn<QByteArray>("plant");
    QTest::addColumn<QString>("options");
    QTest::addColumn<int>("exitCode");
    QTest::addColumn<QString>("message");
    const auto add = [](const char *name, const char *plant, const char *options, int exitCode, const char *message) {
        QTest::newRow(name) << QByteArray(plant) << QString::fromLatin1(options) << exitCode
                            << QString::fromUtf8(message);
    };
    add("mast upwind", "[kite]\nwind = 8,0,0\n[mast]\nkind = fixed\nazimuth = 180\n", "--duration=100", 0,
        ": it hit the mast\n");
    add("overspeed", "[winch]\nkind = machine\nlargestSpeed = 20\n", "--duration=100", 0,
        "\n  THE MACHINE OF THE WINCH WAS SWITCHED OFF after ");
    add("reeled in", "[tether]\nkind = segments\n", "--controls=0,0,-4 --duration=30", 2,
        "the tether is reeled in: its segments are shorter than 5 cm; stop the winch before");
    add("stiff segments", "[tether]\nkind = segments\naxialStiffness = 1e9\n", "--duration=5", 2,
        "the simulation has diverged");
    add("nodes without mass", "[tether]\nkind = segments\ndensity = 0\n", "--duration=5", 2,
        "awe_sil: density of the tether is 0 kg/m³; choose a value from 1 to 20000 kg/m³");
    add("short segments", "[kite]\ndistance = 0.1\n[tether]\nkind = segments\n", "--duration=5", 2,
        "awe_sil: tether length at the start is 0.1 m; choose a value from 0.3 to 1e+06 m");
    add("short tether of turbines at a mast",
        "[kite]\nmode = drag\n[mast]\nkind = fixed\n[turbines]\ntetherLength = 20\n", "--duration=5", 2,
        "awe_sil: turbines.tetherLength is 20 m; choose a value from 100 to 100000 m");
}

void tst_awe_sil::endOfAFlightWithOptionsIsTold()
{
    QFETCH(QByteArray, plant);
    QFETCH(QString, options);
    QFETCH(int, exitCode);
    QFETCH(QString, message);
    QFile file(m_folder.filePath(QStringLiteral("plant.ini")));
    QVERIFY(file.open(QIODevice::WriteOnly | QIODevice::Truncate));
    file.write(plant);
    file.close();
    const QStringList given = options.split(QLatin1Char(' ')) << QStringLiteral("--plant") << file.fileName();
    const Outcome outcome = runProgram(path(), given);
    QCOMPARE(outcome.exitCode, exitCode);
    const QString told = outcome.output + outcome.errors;
    QVERIFY2(told.contains(message), qPrintable(told));
}

/// As sameCycleFlightEqualsTheSingleLoopFlight(). The loop counts the electrical energy a cycle
/// later, and does not round it.
void tst_awe_sil::plantWithOptionsEqualsTheSingleLoopFlight()
{
    awe::ClosedLoopParameters parameters;
    parameters.options = awe::PlantOptions::realistic();
    parameters.gains = awe::AutopilotGains::steered();
    const awe::FlightReport expected = singleLoop(parameters, 199.99);
    const QJsonObject flight = fly(QStringLiteral("--plant realistic --same-cycle --duration 200"));
    compareToTheLastBit(flight, expected);
    QVERIFY(std::abs(figure(flight, "electrical_power_W") - expected.electricalPower) < 1.0);
    QVERIFY(expected.pumpingCycles >= 1 && expected.electricalPower > 0.0);
}

void tst_awe_sil::reportContainsTheAgeOfEveryLink_data()
{
    QTest::addColumn<QString>("options");
    QTest::addColumn<int>("sensors");
    QTest::addColumn<int>("actuators");
    QTest::addColumn<int>("deadTime");
    QTest::newRow("default") << QString() << 1 << 1 << 2;
    QTest::newRow("processes") << QStringLiteral("--processes") << 1 << 1 << 2;
    QTest::newRow("more dead time") << QStringLiteral("--dead-time 5") << 1 << 1 << 5;
    QTest::newRow("same cycle") << QStringLiteral("--same-cycle") << 0 << 0 << 0;
    QTest::newRow("same cycle, dead time 1") << QStringLiteral("--same-cycle --dead-time 1") << 0 << 0 << 1;
    QTest::newRow("same cycle, processes, dead time 1")
        << QStringLiteral("--same-cycle --processes --dead-time 1") << 0 << 0 << 1;
}

void tst_awe_sil::reportContainsTheAgeOfEveryLink()
{
    QFETCH(QString, options);
    QFETCH(int, sensors);
    QFETCH(int, actuators);
    QFETCH(int, deadTime);
    const QJsonObject flight = fly(options);
    QCOMPARE(flight.value(QStringLiteral("dead_time_cycles")).toInt(-1), deadTime);
    int sensorLinks = 0;
    int actuatorLinks = 0;
    const QJsonArray links = flight.value(QStringLiteral("links")).toArray();
    for (const QJsonValue link : links) {
        const QString from = link[QStringLiteral("from")].toString();
        const QString to = link[QStringLiteral("to")].toString();
        if (from == QLatin1String("Model") && to == QLatin1String("Autopilot"))
            QCOMPARE(link[QStringLiteral("age")].toInt(-1), (++sensorLinks, sensors));
        else if (from == QLatin1String("Autopilot") && to == QLatin1String("Model"))
            QCOMPARE(link[QStringLiteral("age")].toInt(-1), (++actuatorLinks, actuators));
    }
    QCOMPARE(sensorLinks, 7);
    QCOMPARE(actuatorLinks, 3);
}

void tst_awe_sil::anotherSeedIsAnotherFlight()
{
    const QJsonObject first = fly(QStringLiteral("--seed 1"));
    const QJsonObject second = fly(QStringLiteral("--seed 2"));
    QCOMPARE(first.value(QStringLiteral("image_digest")), m_flight.value(QStringLiteral("image_digest")));
    QVERIFY(second.value(QStringLiteral("image_digest")) != first.value(QStringLiteral("image_digest")));
    QCOMPARE(second.value(QStringLiteral("cycles")).toInt(), 1000);
}

void tst_awe_sil::exportedModelFliesTheSameFlight_data()
{
    QTest::addColumn<QString>("options");
    QTest::newRow("in one process") << QString();
    QTest::newRow("processes") << QStringLiteral("--processes");
    QTest::newRow("processes, ideal winch") << QStringLiteral("--processes --winch ideal");
}

/// The third model: code in the form that Simulink exports, and a generated node around it.
void tst_awe_sil::exportedModelFliesTheSameFlight()
{
    QFETCH(QString, options);
    const auto flyWith = [&](const char *model) {
        const QString report = m_folder.filePath(QStringLiteral("flight.json"));
        QFile::remove(report);
        const QStringList fixed{QStringLiteral("--duration=60"), QStringLiteral("--report"), report,
                                QStringLiteral("--model=%1").arg(QLatin1String(model))};
        const Outcome outcome = runProgram(path(), fixed + options.split(QLatin1Char(' '), Qt::SkipEmptyParts));
        if (outcome.exitCode != 0)
            qWarning().noquote() << outcome.exitCode << outcome.errors;
        return readReport(report);
    };
    const QJsonObject compact = flyWith("compact");
    const QJsonObject exported = flyWith("lawe");
    QCOMPARE(exported.value(QStringLiteral("cycles")).toInt(), 6000);
    QCOMPARE(exported.value(QStringLiteral("image_digest")), compact.value(QStringLiteral("image_digest")));
    QCOMPARE(exported.value(QStringLiteral("energy_J")), compact.value(QStringLiteral("energy_J")));
}

void tst_awe_sil::clockSetsThePace_data()
{
    QTest::addColumn<QString>("options");
    QTest::addColumn<double>("simulated");
    QTest::addColumn<double>("wall");
    QTest::newRow("real time") << QStringLiteral("--real-time --duration 2") << 2.0 << 2.0;
    QTest::newRow("20 times as fast") << QStringLiteral("--scale 20 --duration 20") << 20.0 << 1.0;
    QTest::newRow("20 times as fast, processes")
        << QStringLiteral("--scale 20 --duration 20 --processes") << 20.0 << 1.0;
}

void tst_awe_sil::clockSetsThePace()
{
    QFETCH(QString, options);
    QFETCH(double, simulated);
    QFETCH(double, wall);
    const QJsonObject flight = fly(options);
    // On a machine that does something else the start is seen late, and the last cycles may be
    // skipped.
    const double flown = flight.value(QStringLiteral("simulated_s")).toDouble();
    const double measured = flight.value(QStringLiteral("wall_s")).toDouble();
    QVERIFY2(flown > simulated * 0.9 && flown < simulated * 1.2, qPrintable(QString::number(flown)));
    QVERIFY2(measured > 0.6 * wall && measured < wall + 5.0, qPrintable(QString::number(measured)));
}

void tst_awe_sil::interruptedFlightIsReported_data()
{
    QTest::addColumn<QString>("options");
    QTest::addColumn<int>("signal");
    QTest::newRow("one process, Ctrl-C") << QString() << SIGINT;
    QTest::newRow("one process, SIGTERM") << QString() << SIGTERM;
    QTest::newRow("processes, Ctrl-C") << QStringLiteral("--processes") << SIGINT;
    QTest::newRow("processes, SIGTERM") << QStringLiteral("--processes --transport tcp") << SIGTERM;
}

void tst_awe_sil::interruptedFlightIsReported()
{
    QFETCH(QString, options);
    QFETCH(int, signal);
    const QString report = m_folder.filePath(QStringLiteral("interrupted.json"));
    QFile::remove(report);
    Terminal terminal;  // where the progress line tells that it flies
    Program program(
        path(),
        QStringList{QStringLiteral("--real-time"), QStringLiteral("--duration=0"), QStringLiteral("--report"), report}
            + options.split(QLatin1Char(' '), Qt::SkipEmptyParts),
        terminal.slave());
    QVERIFY2(waitForText(terminal, program, "m tether"), terminal.text().constData());
    program.sendSignal(signal);
    QCOMPARE(waitForEnd(terminal, program), 0);
    const QJsonObject flight = readReport(report);
    QVERIFY2(flight.value(QStringLiteral("cycles")).toInt() > 0, terminal.text().constData());
    QVERIFY(program.output().startsWith(QLatin1String("Flight of ")));
    QVERIFY(program.output().contains(flight.value(QStringLiteral("image_digest")).toString()));
}

void tst_awe_sil::progressLineFitsTheTerminal()
{
    Terminal terminal;
    QVERIFY(terminal.slave() >= 0);
    Program program(path(), {QStringLiteral("--scale=20"), QStringLiteral("--duration=10")}, terminal.slave());
    QCOMPARE(waitForEnd(terminal, program), 0);
    const QByteArray text = terminal.text();
    QVERIFY(text.contains("m tether") && text.contains(" / 10 s"));
    QVERIFY(!text.contains('\n'));
    const QList<QByteArray> lines = text.split('\r');
    for (const QByteArray &line : lines)
        QVERIFY2(QByteArray(line).replace("\033[K", "").size() < 80, line.constData());
    QVERIFY(text.endsWith("\r\033[K"));
}

void tst_awe_sil::liveViewRestoresTheTerminal_data()
{
    QTest::addColumn<QString>("options");
    QTest::addColumn<int>("signal");
    QTest::newRow("at the end") << QStringLiteral("--scale=20 --duration=10") << 0;
    QTest::newRow("on Ctrl-C") << QStringLiteral("--duration=0") << SIGINT;
    QTest::newRow("processes, at the end") << QStringLiteral("--processes --scale=20 --duration=10") << 0;
    QTest::newRow("processes, on Ctrl-C") << QStringLiteral("--processes --duration=0") << SIGINT;
}

void tst_awe_sil::liveViewRestoresTheTerminal()
{
    QFETCH(QString, options);
    QFETCH(int, signal);
    Terminal terminal;
    QVERIFY(terminal.slave() >= 0);
    Program program(path(), QStringList{QStringLiteral("--watch")} + options.split(QLatin1Char(' ')), terminal.slave());
    QVERIFY2(waitForText(terminal, program, "downwind"), terminal.text().constData());
    if (signal != 0)
        program.sendSignal(signal);
    QCOMPARE(waitForEnd(terminal, program), 0);
    const QByteArray text = terminal.text();
    QVERIFY(text.contains("\033[?1049h"));
    QCOMPARE(text.count("\033[?1049h"), text.count("\033[?1049l"));
    QVERIFY(text.indexOf("\033[?1049l") > text.lastIndexOf("downwind"));
    QVERIFY(text.lastIndexOf("\033[?25h") > text.lastIndexOf("\033[?25l"));
    QVERIFY(text.lastIndexOf("\033[?7h") > text.lastIndexOf("\033[?7l"));
    QVERIFY(program.output().startsWith(QLatin1String("Flight of ")));
}

QTEST_GUILESS_MAIN(tst_awe_sil)
#include "tst_awe_sil.moc"
