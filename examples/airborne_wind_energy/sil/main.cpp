// SPDX-License-Identifier: Apache-2.0
#include "AutopilotNode.h"
#include "CompactModelNode.h"
#include "ExampleOptions.h"
#include "FlightReportText.h"
#include "FlightRun.h"
#include "ProcessFlight.h"
#include "awe_lawe_model.h"

#include <QtCore/QFile>

#include <cstdio>
#include <sched.h>

namespace {

const QString multicast = QStringLiteral("udp-multicast");  // a transport

struct Settings
{
    awe::RunSettings run;
    awe::ModelSettings model;
    awe::AutopilotSettings autopilot;
    QString transport;
    bool processes = false;
    bool sameCycle = false;
    bool isExported = false;  // the model has the form of an export of Simulink
};

void addOptions(QPlcCoreApplication &application)
{
    application.addOption(QCommandLineOption(QStringLiteral("signals"),
                                             QStringLiteral("Signal table. Without one that of the example."),
                                             QStringLiteral("FILE"), awe::builtInSignals()));
    awe::addRunOptions(application, QStringLiteral("600"));
    awe::addModelOptions(application);
    awe::addPlantOptions(application);
    awe::addAutopilotOptions(application);
    application.addOption(QCommandLineOption(
        QStringLiteral("same-cycle"),
        QStringLiteral(
            "Model and autopilot read each other in the same cycle: no dead time from sensor to actuator.")));
    application.addOption(QCommandLineOption(
        QStringLiteral("controls"),
        QStringLiteral("Without autopilot, in one process: pitch and yaw speed [deg/s] and tether speed [m/s] stay as "
                       "they are given here."),
        QStringLiteral("PITCH,YAW,TETHER")));
    application.addOption(QCommandLineOption(
        QStringLiteral("model"),
        QStringLiteral("The model that flies: compact (default), or lawe: the same in the form that Simulink exports, "
                       "with a constant wind (5, 3, 0) m/s."),
        QStringLiteral("KIND"), QStringLiteral("compact")));
    application.addOption(QCommandLineOption(QStringLiteral("processes"),
                                             QStringLiteral("Master, model and autopilot as processes of their own.")));
    application.addOption(
        QCommandLineOption(QStringLiteral("transport"),
                           QStringLiteral("How the nodes reach the master: inprocess (default), tcp, udp (default with "
                                          "--processes), udp-multicast, or local (shared memory)."),
                           QStringLiteral("KIND")));
}

/// \return false, with the message out, when the nodes cannot reach their master like that
bool canTransport(QPlcCoreApplication &application, const Settings &settings)
{
    const QStringList kinds{QStringLiteral("inprocess"), QStringLiteral("tcp"), QStringLiteral("udp"), multicast,
                            QStringLiteral("local")};
    QString error;
    if (!kinds.contains(settings.transport))
        error
            = QStringLiteral("--transport %1: use inprocess, tcp, udp, udp-multicast or local").arg(settings.transport);
    else if (settings.processes && settings.transport == QLatin1String("inprocess"))
        error = QStringLiteral(
            "--processes and --transport inprocess exclude each other: use tcp, udp, udp-multicast or local");
    else if (settings.sameCycle && settings.transport == multicast)
        error = QStringLiteral(
            "--same-cycle and --transport udp-multicast exclude each other, because same-cycle nodes are asked "
            "one by one: use udp, tcp or local");
    if (!error.isEmpty())
        application.usageError(error);
    return error.isEmpty();
}

/// A drive is hardware, or a program that behaves like it: it does not wait for a simulation.
/// \return false, with the message out, when it is to
bool readPlant(QPlcCoreApplication &application, Settings *settings)
{
    awe::RunSettings &run = settings->run;
    if (!awe::readPlantOptions(application, &run.plant))
        return false;
    if (!run.plant.hasDrive())
        return true;
    for (const char *clock : {"lockstep", "external"}) {
        if (!application.isSet(QLatin1String(clock)))
            continue;
        application.usageError(QStringLiteral("--%1 and a winch drive exclude each other, because a drive does not "
                                              "wait: use --real-time or --scale")
                                   .arg(QLatin1String(clock)));
        return false;
    }
    if (run.clock.isLockstep())
        run.clock = QPlcClock::realTime();
    if (!QFile::exists(run.plant.hardware())) {
        application.usageError(QStringLiteral("the plant has a winch drive, and its configuration '%1' is not there: "
                                              "name it by '%2' in the file of --plant")
                                   .arg(run.plant.hardware(),
                                        run.plant.winch == awe::WinchKind::CanOpen ? QStringLiteral("canOpenHardware")
                                                                                   : QStringLiteral("hardware")));
        return false;
    }
    settings->processes = true;
    return true;
}

/// \return false, with the message out, when --model does not fit
bool readModel(QPlcCoreApplication &application, Settings *settings)
{
    const QString kind = application.value(QStringLiteral("model"));
    settings->isExported = kind == QLatin1String("lawe");
    QString error;
    if (!settings->isExported && kind != QLatin1String("compact"))
        error = QStringLiteral("--model %1: use compact or lawe").arg(kind);
    QStringList given = awe::givenModelOptions(application) + awe::givenPlantOptions(application);
    given.removeAll(QStringLiteral("--winch=ideal"));  // it has that one
    if (settings->isExported && !given.isEmpty())
        error = QStringLiteral("--model lawe and %1 exclude each other, because the exported model has its own "
                               "parameters: use --model compact")
                    .arg(given.first());
    if (!error.isEmpty())
        application.usageError(error);
    return error.isEmpty();
}

/// A flight without autopilot. \return false, with the message out, when --controls does not fit
bool readControls(QPlcCoreApplication &application, Settings *settings)
{
    const QString controls = QStringLiteral("controls");
    if (!application.isSet(controls))
        return true;
    if (settings->processes) {
        application.usageError(QStringLiteral(
            "--controls flies without autopilot in one process: leave out --processes and --winch drive"));
        return false;
    }
    if (settings->run.plant.options.mast.isPresent) {
        application.usageError(QStringLiteral("--controls and a mast exclude each other, because only the autopilot "
                                              "releases the kite: write kind = none in [mast] of --plant"));
        return false;
    }
    for (const char *option : {"gains", "force-limit", "dead-time"}) {
        if (!application.isSet(QLatin1String(option)))
            continue;
        application.usageError(QStringLiteral("--controls and --%1 exclude each other: without autopilot there is "
                                              "nothing to set")
                                   .arg(QLatin1String(option)));
        return false;
    }
    settings->run.controls.emplace();
    settings->run.awaitedNodes.removeAll(QStringLiteral("Autopilot"));
    return awe::readVector(application, controls, &*settings->run.controls);
}

bool readOptions(QPlcCoreApplication &application, Settings *settings)
{
    settings->processes = application.isSet(QStringLiteral("processes"));
    if (!awe::readRunOptions(application, &settings->run) || !readPlant(application, settings)
        || !readModel(application, settings))
        return false;
    settings->sameCycle = application.isSet(QStringLiteral("same-cycle"));
    settings->transport = application.isSet(QStringLiteral("transport"))
        ? application.value(QStringLiteral("transport"))
        : settings->processes ? QStringLiteral("udp")
                              : QStringLiteral("inprocess");
    if (!canTransport(application, *settings))
        return false;
    if (!awe::readModelOptions(application, settings->run.plant, &settings->model)
        || !awe::readAutopilotOptions(application, settings->run.plant, &settings->autopilot))
        return false;
    settings->run.nominalWindSpeed = settings->model.wind.meanVelocity.norm();
    settings->run.awaitedNodes = QStringList{QStringLiteral("Model"), QStringLiteral("Autopilot")};
    return readControls(application, settings);
}

/// The end of a flight: prints the summary, writes the report.
int conclude(QJsonObject report, const Settings &settings, int exitCode)
{
    if (report.isEmpty())
        return exitCode;
    const QString reportFile = settings.run.reportFile;
    const QString deadTime = QStringLiteral("dead_time_cycles");
    if (report.contains(deadTime))
        report.insert(deadTime, report.value(deadTime).toInt() + settings.autopilot.extraDeadTime);
    std::fputs(qPrintable(awe::summary(report)), stdout);
    QString error;
    if (reportFile.isEmpty() || awe::writeReport(reportFile, report, &error))
        return exitCode;
    QPlcCoreApplication::printError(error);
    return exitCode == 0 ? int(QPlcCoreApplication::Failure) : exitCode;
}

/// What the programs are told of the winch drive.
void addWinch(QPlcCoreApplication &application, const awe::RunSettings &run, awe::ProcessArguments *arguments)
{
    arguments->hardware = run.plant.hardware();
    if (!application.isSet(QStringLiteral("scale")) && !application.isSet(QStringLiteral("real-time")))
        arguments->master << QStringLiteral("--real-time");
    if (run.plant.simulatedWinch.isEmpty())
        return;
    arguments->winch << QStringLiteral("--bus=%1").arg(run.plant.simulatedWinch);
    if (run.plant.winch == awe::WinchKind::CanOpen)
        arguments->winch << QStringLiteral("--canopen");
    if (application.isSet(QStringLiteral("scale")))
        arguments->winch << QStringLiteral("--scale=%1").arg(application.value(QStringLiteral("scale")));
}

int flyInProcesses(QPlcCoreApplication &application, const Settings &settings)
{
    // Without one, each program has that of the example, or gets the one of the master.
    const QStringList table = application.isSet(QStringLiteral("signals"))
        ? QStringList{QStringLiteral("--signals=%1").arg(application.value(QStringLiteral("signals")))}
        : QStringList();
    awe::ProcessArguments arguments;
    if (settings.isExported)
        arguments.modelProgram = QStringLiteral("awe_lawe_model");
    arguments.master = table + awe::givenRunOptions(application) + awe::givenPlantOptions(application)
        + QStringList{QStringLiteral("--mean-wind=%1").arg(settings.run.nominalWindSpeed, 0, 'g', 17)};
    if (!application.isSet(QStringLiteral("duration")))
        arguments.master << QStringLiteral("--duration=%1").arg(settings.run.duration);
    // In lockstep the programs take turns: on one processor they wake each other without waking a
    // processor first.
    const QStringList processor = settings.run.clock.isLockstep()
        ? QStringList{QStringLiteral("--cpu=%1").arg(::sched_getcpu())}
        : QStringList();
    arguments.master += processor;
    if (settings.transport == multicast)
        arguments.master << QStringLiteral("--multicast=%1").arg(awe::defaultMulticastGroup().toString());
    const QStringList order = settings.sameCycle ? QStringList{QStringLiteral("--same-cycle")} : QStringList();
    arguments.model = table + processor + order;
    if (!settings.isExported)  // that one is generated, and has no options of the example
        arguments.model += awe::givenPlantOptions(application) + awe::givenModelOptions(application);
    arguments.autopilot
        = table + processor + order + awe::givenPlantOptions(application) + awe::givenAutopilotOptions(application);
    arguments.transport = settings.transport;
    if (settings.run.plant.hasDrive())
        addWinch(application, settings.run, &arguments);
    arguments.watch = settings.run.watch;

    awe::ProcessFlight flight;
    QObject::connect(&flight, &awe::ProcessFlight::finished, &application,
                     [](int exitCode) { QCoreApplication::exit(exitCode); });
    application.quitOnSignals([&flight] { flight.end(); });
    if (!flight.begin(arguments))
        return QPlcCoreApplication::UsageError;
    const int exitCode = QCoreApplication::exec();
    return conclude(flight.report(), settings, exitCode);
}

/// Brings a node to its master: in the process, or over a socket of it.
bool attach(QPlcMasterNode &master, QPlcSlaveNode &node, const QString &transport, const QString &workloadSignal)
{
    node.activateWorkloadMeasurement(workloadSignal);
    if (transport == QLatin1String("inprocess"))
        return master.addLocalNode(&node);
    if (master.serverPort() == 0 && !master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)))
        return false;
    return node.connectToMasterAndWaitForConnected(QPlcUnderlyingProtocol::fromString(
        QStringLiteral("%1://127.0.0.1:%2").arg(transport).arg(master.serverPort())));
}

std::unique_ptr<QPlcSlaveNode> makeModel(const Settings &settings)
{
    if (settings.isExported)
        return make_awe_lawe_model();
    auto model = std::make_unique<awe::CompactModelNode>(awe::KiteSimulation(
        settings.model.plant, settings.model.wind, settings.model.substeps, settings.model.options));
    model->setTwoPhase(settings.sameCycle);
    return model;
}

int flyInOneProcess(QPlcCoreApplication &application, const Settings &settings)
{
    const std::unique_ptr<QPlcSlaveNode> model = makeModel(settings);
    awe::AutopilotNode autopilot(settings.autopilot.gains, settings.autopilot.extraDeadTime);
    autopilot.setSameCycle(settings.sameCycle);
    model->setSameCycle(settings.sameCycle);
    QPlcMasterNode master;
    if (settings.transport == multicast)
        master.setMulticastGroup(awe::defaultMulticastGroup());
    awe::RunSettings runSettings = settings.run;
    runSettings.reportFile.clear();  // written at the end, with the summary
    awe::FlightRun run(master, runSettings);
    if (!run.isValid() || !attach(master, *model, settings.transport, QStringLiteral("modelWorkload"))
        || (!settings.run.controls
            && !attach(master, autopilot, settings.transport, QStringLiteral("autopilotWorkload"))))
        return QPlcCoreApplication::UsageError;
    QObject::connect(&run, &awe::FlightRun::finished, &application,
                     [](int exitCode) { QCoreApplication::exit(exitCode); });
    application.quitOnSignals([&run] { run.end(); });
    run.begin();
    const int exitCode = QCoreApplication::exec();
    autopilot.disconnectFromMaster();
    model->disconnectFromMaster();
    return conclude(run.report(), settings, exitCode);
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    application.setDescription(QStringLiteral("Software in the loop: master, model and autopilot of the airborne wind "
                                              "energy example fly together on this machine."));
    application.setExamples({QStringLiteral("awe_sil --duration 1800 --report flight.json"),
                             QStringLiteral("awe_sil --scale 10 --turbulence 0.15 --seed 3"),
                             QStringLiteral("awe_sil --processes --transport udp --gains tuned"),
                             QStringLiteral("awe_sil --processes --transport udp-multicast"),
                             QStringLiteral("awe_sil --plant drag-fifth.ini --duration 120"),
                             QStringLiteral("awe_sil --plant realistic --duration 1860"),
                             QStringLiteral("awe_sil --plant drag --duration 1860"),
                             QStringLiteral("awe_sil --plant mast --duration 600"),
                             QStringLiteral("awe_sil --plant reel-in.ini --controls 0,0,-4 --duration 25"),
                             QStringLiteral("awe_sil --winch drive --duration 120 --report flight.json"),
                             QStringLiteral("awe_sil --winch canopen --duration 120")});
    addOptions(application);
    Settings settings;
    if (!application.parseOptions() || !readOptions(application, &settings))
        return application.exitCode();
    QPlcSignalIndexTable table;
    if (!table.initializeFromIniFile(application.value(QStringLiteral("signals"))))
        return application.usageError(table.errorString());
    if (!awe::addOptionSignals(application, settings.run.plant.options))
        return application.exitCode();
    return settings.processes ? flyInProcesses(application, settings) : flyInOneProcess(application, settings);
}
