// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FlightDisplay.h"
#include "FlightObserver.h"
#include "FlightRecorder.h"
#include "WinchObserver.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QJsonObject>
#include <QtCore/QTimer>
#include <QtPlcCore>

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <thread>

namespace awe {

struct RunSettings
{
    QPlcClock clock;
    QPlcOverrunPolicy overrunPolicy;
    double duration = 0.0;                // [s] of simulated time; 0: until stopped
    QString reportFile;                   // empty: none
    QString recordFile;                   // likewise
    FlightRecorder::Limits recordLimits;  // of a folder
    double nominalWindSpeed = 0.0;        // [m/s]
    bool watch = false;                   // a live picture instead of a progress line
    PlantConfiguration plant;
    /// Without autopilot: pitch and yaw speed [deg/s] and tether speed [m/s], the same during the
    /// whole flight.
    std::optional<Eigen::Vector3d> controls;
    QStringList awaitedNodes;  // the flight begins as soon as all of them have registered
    bool stay = false;         // the program does not end with that flight: people stop and start as they like
};

/// The clock of a program that is started without --lockstep, --real-time, --scale, --external and
/// --watch; --help tells it.
enum class DefaultClock {
    Lockstep,
    LockstepWithStartWith,  // real time without --start-with
};

/// --lockstep, --real-time, --scale, --external, --overrun, --duration, --report, --record,
/// --watch: how a flight is run.
void addRunOptions(QPlcCoreApplication &application, const QString &defaultDuration,
                   DefaultClock clock = DefaultClock::Lockstep);
/// \return false, with the message out, when an option cannot be meant
bool readRunOptions(QPlcCoreApplication &application, RunSettings *settings);
/// Those of the run options that were given, to be handed on to another program.
QStringList givenRunOptions(const QPlcCoreApplication &application);

/// The node between the plant and a winch drive. Hardware may come and go: without it the signals
/// of the winch have their safe values, and the flight goes on.
QString winchNode();

/// One flight of a master from the registration of its nodes to the report.
class FlightRun : public QObject
{
    Q_OBJECT
public:
    /// Sets \a master up: period, clock, own signals, and a FlightObserver. \param master outlives
    /// this object
    FlightRun(QPlcMasterNode &master, const RunSettings &settings);
    ~FlightRun() override;

    /// \return false when the set-up failed; master.errorString() says why
    bool isValid() const { return m_valid; }
    /// Begins when all awaited nodes are there, now or later. finished() follows.
    void begin();
    /// Ends the flight before its time, with a report of what was flown.
    void end();

    /// The report; complete after finished().
    QJsonObject report() const { return m_report; }

Q_SIGNALS:
    /// \param exitCode  of the program, see QPlcCoreApplication
    void finished(int exitCode);

private:
    bool startRecorder();
    bool addWinchObserver();
    void nodeIsLost(const QString &name, const QString &reason);
    /// Ends the flight when one of its nodes gives NaN or infinity: a simulation holds the last
    /// number for ever.
    void requireNumbers();
    void startIfComplete();
    void start();
    bool setControls();
    void started();
    void turnClock();
    void endHost();
    void stopped();
    /// Whether the program ends with the flight that has begun by itself.
    bool endsWithFlight() const { return !m_settings.awaitedNodes.isEmpty() && !m_settings.stay; }
    void finish();
    void fail(int exitCode, const QString &text);
    QJsonObject makeReport() const;
    void reportLinks(QJsonObject *report) const;
    static void reportMast(const FlightReport &flight, QJsonObject *report);

    QPlcMasterNode &m_master;
    RunSettings m_settings;
    FlightObserver m_observer;
    std::unique_ptr<WinchObserver> m_winchObserver;  // of a drive
    FlightDisplay m_display;
    FlightRecorder m_recorder;
    QTimer m_numbersTimer;
    QElapsedTimer m_wallClock;
    std::thread m_host;       // turns the clock External
    QPlcSchedule m_schedule;  // as the flight began
    QJsonObject m_report;
    qint64 m_wallTime = 0;  // [ns]
    bool m_valid = false;
    bool m_begun = false;
    bool m_started = false;
    bool m_ending = false;  // by end()
    bool m_over = false;
    int m_exitCode = 0;
};

}  // namespace awe
