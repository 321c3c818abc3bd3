// SPDX-License-Identifier: Apache-2.0
// The winch drive at the other end of the CAN bus: no node of the plant, but a plant of its own
// with a cycle of 1 ms, whose nodes are the bus and the controller.
#include "DriveProfileNode.h"
#include "WinchDriveNode.h"

#include <QtPlcHardware>

#include <QtCore/QFile>
#include <QtCore/QTimer>

#include <cstdio>

namespace {

const QString signalsFile = QStringLiteral(":/winch_drive/drive_signals.ini");
const QString busFile = QStringLiteral(":/winch_drive/drive_bus.ini");
const QString canOpenSignalsFile = QStringLiteral(":/winch_drive/canopen_signals.ini");
const QString canOpenBusFile = QStringLiteral(":/winch_drive/canopen_bus.ini");

QByteArray contentOf(const QString &fileName)
{
    QFile file(fileName);
    file.open(QIODevice::ReadOnly);
    return file.readAll();
}

/// A file of a bus with the bus that was asked for.
QByteArray busConfiguration(const QString &fileName, const QString &bus)
{
    return contentOf(fileName).replace("device = fake:winch", "device = " + bus.toUtf8());
}

/// What the drive did, for the person who ends it.
void printEnergies(const awe::WinchDrive &drive)
{
    const awe::WinchEnergies &energy = drive.energies();
    std::printf(
        "The drive got %.1f kJ from the tether and gave %.1f kJ of electricity; heat: windings %.1f kJ, electronics "
        "%.1f kJ, friction %.1f kJ, brake %.1f kJ\n",
        energy.tether * 1e-3, energy.electrical * 1e-3, energy.copper * 1e-3, energy.converter * 1e-3,
        energy.friction * 1e-3, energy.brake * 1e-3);
}

void print(const QString &line)
{
    std::puts(qPrintable(line));
    std::fflush(stdout);
}

/// Tells each new state of the drive, as its display would. \param last  what was told last
void showState(const QPlcMasterNode &firmware, QString *last)
{
    const QPlcSignalTable table = firmware.signalTable();
    const auto text
        = [&](const QString &signal) { return table.at(table.indexOf(signal)).textOf(firmware.signalValue(signal)); };
    const QString state = text(QStringLiteral("driveState"));
    const QString line = state == QLatin1String("Enabled")
        ? state
        : QStringLiteral("%1 (%2)").arg(state, text(QStringLiteral("driveStop")));
    if (*last != line)
        print(line);
    *last = line;
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    application.setDescription(
        QStringLiteral("A winch with its drive, simulated at the other end of a CAN bus; what it "
                       "understands is in winch_drive.dbc, or with --canopen in winch_drive.eds."));
    application.setExamples(
        {QStringLiteral("awe_winch_drive --bus fake:winch"), QStringLiteral("awe_winch_drive --canopen --bus vcan0")});
    application.addOption(QCommandLineOption(QStringLiteral("bus"),
                                             QStringLiteral("The CAN bus, as the driver 'can' names it."),
                                             QStringLiteral("DEVICE"), QStringLiteral("fake:winch")));
    application.addOption(QCommandLineOption(QStringLiteral("canopen"),
                                             QStringLiteral("It is node 5 of a CANopen bus, a drive with the "
                                                            "profile CiA 402.")));
    application.addOption(QCommandLineOption(QStringLiteral("scale"),
                                             QStringLiteral("F times as fast as a real drive, as its plant."),
                                             QStringLiteral("F"), QStringLiteral("1")));
    application.addRealTimeOptions();
    double scale = 1.0;
    QPlcRealTimeOptions realTime;
    if (!application.parseOptions() || !application.number(QStringLiteral("scale"), 0.001, 100.0, &scale)
        || !application.readRealTimeOptions(&realTime))
        return application.exitCode();

    const awe::WinchDriveParameters parameters;
    const bool isCanOpen = application.isSet(QStringLiteral("canopen"));
    const QPlcSignalTable table
        = QPlcSignalTable::fromIni(contentOf(signalsFile) + (isCanOpen ? contentOf(canOpenSignalsFile) : QByteArray()));
    const QString fileOfBus = isCanOpen ? canOpenBusFile : busFile;
    QPlcHardwareNode bus;
    if (!bus.configure(busConfiguration(fileOfBus, application.value(QStringLiteral("bus"))), fileOfBus))
        return application.usageError(QPlcParseError::toString(bus.configurationErrors()));
    awe::WinchDriveNode drive(parameters);
    awe::DriveProfileNode profile;
    QPlcMasterNode firmware;
    firmware.setSignalTable(table);
    bus.setSignalTable(table);
    drive.setSignalTable(table);
    profile.setSignalTable(table);
    firmware.setRealTimeOptions(realTime);
    firmware.setInterval(parameters.step);
    firmware.setClock(scale == 1.0 ? QPlcClock::realTime() : QPlcClock::scaled(scale));
    firmware.setGapLimit(std::chrono::nanoseconds(0));  // a drive has a watchdog of its own, and nobody to reset it
    application.quitOnSignals();
    if (!firmware.addLocalNode(&bus) || !firmware.addLocalNode(&drive)
        || (isCanOpen && !firmware.addLocalNode(&profile)) || !firmware.startRealTime())
        return application.usageError(firmware.errorString());
    QTimer display;
    QString shown;
    QObject::connect(&display, &QTimer::timeout, &firmware, [&] { showState(firmware, &shown); });
    display.start(10);
    const int exitCode = QCoreApplication::exec();
    display.stop();
    firmware.stop();
    printEnergies(drive.drive());
    return exitCode;
}
