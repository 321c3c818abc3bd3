// SPDX-License-Identifier: Apache-2.0
#include "FlightRun.h"

#include "FlightReportText.h"

#include <QtCore/QJsonArray>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace awe {

namespace {

constexpr std::chrono::milliseconds period(10);
constexpr std::chrono::milliseconds numbersPeriod(200);
const char *const runOptions[] = {"scale", "overrun", "duration", "record", "keep-days", "keep-gib", "free-gib"};
const char *const runFlags[] = {"lockstep", "real-time", "external", "watch"};

/// \return false, with the message out, when picture or report could only fail later
bool canShow(QPlcCoreApplication &application, const RunSettings &settings)
{
    QString error;
    if (settings.watch && !FlightDisplay::hasTerminal())
        error = QStringLiteral("--watch draws on a terminal, and the standard error is none (or TERM is dumb); leave "
                               "it out, or use --report");
    else if (!settings.reportFile.isEmpty())
        canWriteReport(settings.reportFile, &error);
    if (!error.isEmpty())
        application.usageError(error);
    return error.isEmpty();
}

FlightStatisticsParameters statisticsParameters(const RunSettings &settings)
{
    FlightStatisticsParameters parameters = FlightStatisticsParameters::of(settings.plant.kite.plant);
    parameters.nominalWindSpeed = settings.nominalWindSpeed;
    return parameters;
}

}  // namespace

// ---- options ----

void addRunOptions(QPlcCoreApplication &application, const QString &defaultDuration, DefaultClock clock)
{
    const bool either = clock == DefaultClock::LockstepWithStartWith;
    application.addOption(
        QCommandLineOption(QStringLiteral("lockstep"),
                           QStringLiteral("As fast as possible, bit-identical each time; the default%1.")
                               .arg(either ? QStringLiteral(" with --start-with") : QString())));
    application.addOption(
        QCommandLineOption(QStringLiteral("real-time"),
                           QStringLiteral("As fast as the real thing%1.")
                               .arg(either ? QStringLiteral("; the default without --start-with") : QString())));
    application.addOption(QCommandLineOption(
        QStringLiteral("scale"), QStringLiteral("F times as fast as the real thing."), QStringLiteral("F")));
    application.addOption(QCommandLineOption(
        QStringLiteral("external"),
        QStringLiteral("A thread of the program turns the clock, as a simulator does that holds the master. Values are "
                       "those of --lockstep.")));
    application.addOption(QCommandLineOption(
        QStringLiteral("overrun"),
        QStringLiteral(
            "When a cycle is late by a period or more: skip, catch-up:N, shift, or stop. Lockstep has none."),
        QStringLiteral("POLICY"), QStringLiteral("skip")));
    application.addOption(QCommandLineOption(QStringLiteral("duration"),
                                             QStringLiteral("Simulated time of the flight [s]. 0: until stopped."),
                                             QStringLiteral("S"), defaultDuration));
    application.addOption(QCommandLineOption(QStringLiteral("report"),
                                             QStringLiteral("Writes the figures of the flight to FILE as JSON."),
                                             QStringLiteral("FILE")));
    application.addOption(QCommandLineOption(
        QStringLiteral("record"),
        QStringLiteral(
            "Records every cycle into FILE, which must not exist, or into files in FOLDER/: see qtplc verify, "
            "qtplc record."),
        QStringLiteral("PATH")));
    FlightRecorder::addLimitOptions(application);
    application.addOption(QCommandLineOption(
        QStringLiteral("watch"),
        QStringLiteral("Draws the flight on the terminal; --real-time unless another clock is given.")));
}

bool readRunOptions(QPlcCoreApplication &application, RunSettings *settings)
{
    const bool lockstep = application.isSet(QStringLiteral("lockstep"));
    const bool realTime = application.isSet(QStringLiteral("real-time"));
    const bool scaled = application.isSet(QStringLiteral("scale"));
    const bool external = application.isSet(QStringLiteral("external"));
    if (int(lockstep) + int(realTime) + int(scaled) + int(external) > 1) {
        application.usageError(QStringLiteral("use one of --lockstep, --real-time, --scale and --external"));
        return false;
    }
    double scale = 1.0;
    if (scaled && !application.number(QStringLiteral("scale"), 0.001, 1000.0, &scale))
        return false;
    settings->watch = application.isSet(QStringLiteral("watch"));
    const bool given = lockstep || scaled || external;
    settings->clock = realTime || (settings->watch && !given) ? QPlcClock::realTime()
        : scaled                                              ? QPlcClock::scaled(scale)
        : external                                            ? QPlcClock::external()
                                                              : QPlcClock::lockstep();
    settings->reportFile = application.value(QStringLiteral("report"));
    settings->recordFile = application.value(QStringLiteral("record"));
    if (!FlightRecorder::readLimits(application, &settings->recordLimits))
        return false;
    QString error;
    settings->overrunPolicy = QPlcOverrunPolicy::fromString(application.value(QStringLiteral("overrun")), &error);
    if (!error.isEmpty()) {
        application.usageError(QStringLiteral("--overrun: %1").arg(error));
        return false;
    }
    return application.number(QStringLiteral("duration"), 0.0, 1e7, &settings->duration)
        && canShow(application, *settings);
}

QStringList givenRunOptions(const QPlcCoreApplication &application)
{
    QStringList arguments;
    for (const char *name : runFlags) {
        if (application.isSet(QString::fromLatin1(name)))
            arguments << QStringLiteral("--%1").arg(QString::fromLatin1(name));
    }
    for (const char *name : runOptions) {
        if (application.isSet(QString::fromLatin1(name)))
            arguments << QStringLiteral("--%1=%2").arg(QString::fromLatin1(name),
                                                       application.value(QString::fromLatin1(name)));
    }
    return arguments;
}

// ---- the flight ----

QString winchNode()
{
    return QStringLiteral("Winch");
}

FlightRun::FlightRun(QPlcMasterNode &master, const RunSettings &settings)
    : m_master(master)
    , m_settings(settings)
    , m_observer(statisticsParameters(settings), settings.plant)
    , m_display(master, settings.duration, settings.watch ? FlightDisplay::Picture : FlightDisplay::Line)
    , m_recorder(master, settings.recordFile, settings.recordLimits)
{
    m_valid = master.setTimeSignal(QStringLiteral("masterTime"))
        && master.activateJitterMeasurement(QStringLiteral("masterJitter"))
        && master.activateWorkloadMeasurement(QStringLiteral("masterWorkload")) && master.setInterval(period)
        && master.setClock(settings.clock) && master.setOverrunPolicy(settings.overrunPolicy)
        && master.addLocalNode(&m_observer) && addWinchObserver() && m_display.isValid() && startRecorder();
    master.setCycleLimit(quint64(std::llround(settings.duration / std::chrono::duration<double>(period).count())));
    connect(&master, &QPlcMasterNode::nodeRegistered, this, &FlightRun::startIfComplete);
    connect(&master, &QPlcMasterNode::realTimeHasStarted, this, &FlightRun::started);
    connect(&master, &QPlcMasterNode::realTimeHasStopped, this, &FlightRun::stopped);
    connect(&master, &QPlcMasterNode::errorOccurred, this, [this] {
        if (m_begun && !m_ending)
            fail(QPlcCoreApplication::UsageError, {});  // the master has said why
    });
    connect(&master, &QPlcMasterNode::nodeLost, this, &FlightRun::nodeIsLost);
    m_numbersTimer.setInterval(numbersPeriod);
    connect(&m_numbersTimer, &QTimer::timeout, this, &FlightRun::requireNumbers);
    connect(&master, &QPlcMasterNode::safelyStopped, this, [this](const QString &reason) {
        if (!m_begun || m_ending || !endsWithFlight())
            return;
        m_exitCode = 0;  // what the master has told is a consequence
        fail(QPlcCoreApplication::Failure,
             QStringLiteral("the plant has stopped safely (%1): the flight ends").arg(reason));
    });
}

bool FlightRun::startRecorder()
{
    connect(&m_recorder, &FlightRecorder::failed, this,
            [this](const QString &text) { fail(QPlcCoreApplication::UsageError, text); });
    return m_recorder.start();
}

bool FlightRun::addWinchObserver()
{
    if (!m_settings.plant.hasDrive())
        return true;
    m_winchObserver = std::make_unique<WinchObserver>();
    return m_master.addLocalNode(m_winchObserver.get());
}

void FlightRun::nodeIsLost(const QString &name, const QString &reason)
{
    const bool mayComeBack = m_settings.plant.hasDrive() && name == winchNode();
    if (m_begun && m_settings.awaitedNodes.contains(name) && !mayComeBack)
        fail(QPlcCoreApplication::Failure, QStringLiteral("node '%1' is gone (%2): the flight ends").arg(name, reason));
}

void FlightRun::requireNumbers()
{
    if (!m_begun || m_ending)
        return;
    const QVector<QPlcNodeStatistics> nodes = m_master.cycleStatistics().nodes;
    for (const QPlcNodeStatistics &node : nodes) {
        if (node.nonFinite == 0 || !m_settings.awaitedNodes.contains(node.name))
            continue;
        m_numbersTimer.stop();
        fail(QPlcCoreApplication::UsageError,
             QStringLiteral("node '%1' gives values that are not finite numbers: the flight ends").arg(node.name));
        return;
    }
}

FlightRun::~FlightRun()
{
    m_master.disconnect(this);
    m_master.removeLocalNode(&m_observer);
    if (m_winchObserver)
        m_master.removeLocalNode(m_winchObserver.get());
    endHost();  // no cycle runs any more
}

void FlightRun::begin()
{
    m_begun = true;
    startIfComplete();
}

void FlightRun::startIfComplete()
{
    QStringList missing = m_settings.awaitedNodes;
    const QVector<QPlcNodeInfo> nodes = m_master.nodes();
    for (const QPlcNodeInfo &node : nodes)
        missing.removeAll(node.name);
    if (m_begun && !m_started && missing.isEmpty() && !m_settings.awaitedNodes.isEmpty()) {
        m_started = true;
        // Not from within the registration of a node.
        QMetaObject::invokeMethod(this, &FlightRun::start, Qt::QueuedConnection);
    }
}

/// Without autopilot the master itself writes the controls. \return false when it refused one; it
/// has said why
bool FlightRun::setControls()
{
    if (!m_settings.controls)
        return true;
    const Eigen::Vector3d &controls = *m_settings.controls;
    return m_master.setSignalValue(QStringLiteral("bodyControlPitchSpeed"), controls.x())
        && m_master.setSignalValue(QStringLiteral("bodyControlYawSpeed"), controls.y())
        && m_master.setSignalValue(QStringLiteral("tetherSpeed"), controls.z());
}

/// --start-with permits this one start, also where every start has to be permitted.
void FlightRun::start()
{
    if (!setControls())
        return;
    if (!m_master.isArmingRequired()) {
        m_master.startRealTime();
        return;
    }
    const auto armAndStart = [this](QPlcMasterNode::State state) {
        if (state != QPlcMasterNode::Ready)
            return;
        disconnect(&m_master, &QPlcMasterNode::stateChanged, this, nullptr);
        if (m_master.arm())
            m_master.startRealTime();
    };
    connect(&m_master, &QPlcMasterNode::stateChanged, this, armAndStart, Qt::QueuedConnection);
    m_master.initializeAllStates();
}

void FlightRun::started()
{
    m_schedule = m_master.schedule();
    m_wallClock.start();
    m_numbersTimer.start();
    m_display.begin();
    if (m_settings.clock.isExternal())
        m_host = std::thread([this] { turnClock(); });
}

/// As a simulator does it that holds the master.
void FlightRun::turnClock()
{
    using Result = QPlcMasterNode::StepResult;
    for (Result result = Result::Complete; result == Result::Complete || result == Result::Late;)
        result = m_master.step();
}

void FlightRun::endHost()
{
    if (m_host.joinable())
        m_host.join();
}

void FlightRun::stopped()
{
    m_wallTime = m_wallClock.nsecsElapsed();
    endHost();
    m_numbersTimer.stop();
    m_display.end();
    requireNumbers();  // a flight may be shorter than the period of the timer
    m_report = makeReport();
    if (!m_recorder.finish())
        fail(QPlcCoreApplication::Failure, {});  // the recorder has said why
    QString error;
    if (!m_settings.reportFile.isEmpty() && !writeReport(m_settings.reportFile, m_report, &error))
        fail(QPlcCoreApplication::Failure, error);
    if (endsWithFlight() || m_ending)  // else: stopped by hand, and perhaps started again
        finish();
}

void FlightRun::end()
{
    m_ending = true;
    m_master.stop();
    if (m_master.state() == QPlcMasterNode::SafeStop)
        m_master.stopServer();  // a stop does not leave it; the end of the program does
    finish();
}

void FlightRun::finish()
{
    if (m_over)
        return;
    m_over = true;
    QMetaObject::invokeMethod(
        this, [this] { Q_EMIT finished(m_exitCode); }, Qt::QueuedConnection);
}

void FlightRun::fail(int exitCode, const QString &text)
{
    if (m_exitCode != 0)
        return;
    m_exitCode = exitCode;
    if (!text.isEmpty()) {
        m_display.end();
        QPlcCoreApplication::printError(text);
    }
    if (!endsWithFlight()) {
        m_exitCode = 0;  // a person is at the controls, and may try again
        if (m_settings.stay)
            QMetaObject::invokeMethod(&m_master, &QPlcMasterNode::stop, Qt::QueuedConnection);
        return;
    }
    QMetaObject::invokeMethod(this, &FlightRun::end, Qt::QueuedConnection);
}

/// Age of every link, and what the links from sensors to actuators cost together.
void FlightRun::reportLinks(QJsonObject *report) const
{
    const QString model = QStringLiteral("Model");
    const QString autopilot = QStringLiteral("Autopilot");
    int sensors = -1;
    int actuators = -1;
    QJsonArray links;
    for (const QPlcSchedule::Link &link : m_schedule.links) {
        links.append(QJsonObject{{QStringLiteral("signal"), link.signal},
                                 {QStringLiteral("from"), link.from},
                                 {QStringLiteral("to"), link.to},
                                 {QStringLiteral("age"), link.age}});
        if (link.from == model && link.to == autopilot)
            sensors = std::max(sensors, link.age);
        else if (link.from == autopilot && link.to == model)
            actuators = std::max(actuators, link.age);
    }
    report->insert(QStringLiteral("links"), links);
    if (sensors >= 0 && actuators >= 0)
        report->insert(QStringLiteral("dead_time_cycles"), sensors + actuators);
}

void FlightRun::reportMast(const FlightReport &flight, QJsonObject *report)
{
    report->insert(QStringLiteral("starts"), flight.starts);
    report->insert(QStringLiteral("dockings"), flight.dockings);
    report->insert(QStringLiteral("docking_speed_m_s"), flight.dockingSpeed);
    report->insert(QStringLiteral("landed"), flight.landed);
}

QJsonObject FlightRun::makeReport() const
{
    const FlightReport flight = m_observer.report();
    const QPlcMasterStatistics statistics = m_master.statistics();
    const double simulated
        = double(statistics.cycles + statistics.skippedCycles) * std::chrono::duration<double>(period).count();
    const double wall = double(m_wallTime) * 1e-9;
    QJsonObject report{{QStringLiteral("cycles"), double(statistics.cycles)},
                       {QStringLiteral("simulated_s"), simulated},
                       {QStringLiteral("wall_s"), wall},
                       {QStringLiteral("real_time_factor"), wall > 0.0 ? simulated / wall : 0.0},
                       {QStringLiteral("energy_J"), flight.energy},
                       {QStringLiteral("mean_power_W"), flight.meanPower},
                       {QStringLiteral("eta"), flight.eta},
                       {QStringLiteral("eta_per_mean_cubed_wind"), flight.etaPerMeanCubedWind},
                       {QStringLiteral("reel_out_power_W"), flight.reelOutPower},
                       {QStringLiteral("reel_in_power_W"), flight.reelInPower},
                       {QStringLiteral("mean_wind_speed_m_s"), flight.meanWindSpeed},
                       {QStringLiteral("mean_speed_m_s"), flight.meanSpeed},
                       {QStringLiteral("max_speed_m_s"), flight.maximumSpeed},
                       {QStringLiteral("max_power_W"), flight.maximumPower},
                       {QStringLiteral("pumping_cycles"), flight.pumpingCycles},
                       {QStringLiteral("min_altitude_m"), flight.minimumAltitude},
                       {QStringLiteral("max_tether_force_N"), flight.maximumTetherForce},
                       {QStringLiteral("crashed"), flight.crashed},
                       {QStringLiteral("recoveries"), flight.recoveries},
                       {QStringLiteral("overruns"), double(statistics.overruns)},
                       {QStringLiteral("skipped_cycles"), double(statistics.skippedCycles)},
                       {QStringLiteral("caught_up_cycles"), double(statistics.caughtUpCycles)},
                       {QStringLiteral("shifted_s"), double(statistics.shiftedTime) * 1e-9},
                       {QStringLiteral("late_answers"), double(statistics.lateAnswers)},
                       {QStringLiteral("lateness_p50_us"), double(statistics.latenessMedian) * 1e-3},
                       {QStringLiteral("lateness_p99_us"), double(statistics.lateness99) * 1e-3},
                       {QStringLiteral("image_digest"), QPlcMessage::fromHex64(statistics.imageDigest)}};
    if (m_settings.plant.options.hasMachine)
        report.insert(QStringLiteral("electrical_power_W"), flight.electricalPower);
    if (m_settings.plant.options.hasTurbines)
        report.insert(QStringLiteral("turbine_power_W"), flight.turbinePower);
    if (m_settings.plant.options.mast.isPresent)
        reportMast(flight, &report);
    if (flight.crashed)
        report.insert(QStringLiteral("crashed_after_s"), flight.crashTime);
    if (flight.hitMast)
        report.insert(QStringLiteral("hit_mast"), true);
    if (flight.wasMachineOff)
        report.insert(QStringLiteral("machine_off_after_s"), flight.machineOffTime);
    if (!m_observer.sawKite())
        report.insert(QStringLiteral("no_kite"), true);
    reportLinks(&report);
    if (m_winchObserver)
        report.insert(QStringLiteral("winch"), m_winchObserver->report());
    return report;
}

}  // namespace awe
