// SPDX-License-Identifier: Apache-2.0
// The program of a node whose signals are wired to devices, as a file says: see QPlcHardwareNode.
#include "hardware/canopen/CanOpenScan.h"

#include <QtPlcHardware>

#include <QtCore/QTextStream>
#include <QtCore/QTimer>

#include <chrono>
#include <csignal>
#include <unistd.h>

namespace {

constexpr int NotSafe = 1;  // exit code of --safe

void print(const QString &text)
{
    QTextStream(stdout) << text << Qt::endl;
}

void printKinds()
{
    for (const auto &[kind, description] : QPlcHardwareNode::driverKinds())
        print(QStringLiteral("%1 %2").arg(kind, -16).arg(description));
}

QString valueText(const QPlcHardwareNode::Wire &wire)
{
    if (!wire.isFresh)
        return QStringLiteral("-");
    return QStringLiteral("%1").arg(wire.value, 0, 'g', 7);
}

void printWires(const QPlcHardwareNode &node)
{
    for (const QPlcHardwareNode::DriverState &driver : node.drivers())
        print(QStringLiteral("%1 (%2): %3")
                  .arg(driver.name, driver.kind,
                       driver.isOnline              ? QStringLiteral("open")
                           : driver.error.isEmpty() ? QStringLiteral("opening")
                                                    : driver.error));
    for (const QPlcHardwareNode::Wire &wire : node.wires()) {
        const QString channel = wire.driver + QLatin1Char('.') + wire.channel;
        const bool isRead = wire.direction == QPlcChannel::Read;
        print(QStringLiteral("  %1 %2 %3  %4%5")
                  .arg(channel, -36)
                  .arg(isRead ? QStringLiteral("->") : QStringLiteral("<-"))
                  .arg(wire.signal, -28)
                  .arg(valueText(wire), 14)
                  .arg(isRead && wire.isFresh ? QStringLiteral("  %1 ms old").arg(wire.age * 1e3, 0, 'f', 1)
                                              : QString()));
    }
}

QString hexText(quint32 number)
{
    return QStringLiteral("0x%1").arg(number, 8, 16, QLatin1Char('0'));
}

/// Lists the devices of a CANopen bus.
int scan(const QString &bus)
{
    QVector<qplc::CanOpenScan::Device> devices;
    QString error;
    if (!qplc::CanOpenScan::run(bus, std::chrono::milliseconds(500), &devices, &error)) {
        QTextStream(stderr) << error << Qt::endl;
        return QPlcNodeApplication::Failure;
    }
    if (devices.isEmpty()) {
        QTextStream(stderr) << "no CANopen device answers at " << bus
                            << "; check power, wires, terminators and bit rate" << Qt::endl;
        return QPlcNodeApplication::Failure;
    }
    for (const auto &device : qAsConst(devices)) {
        const QString state = qplc::nmtStateText(device.state);
        if (!device.hasAnswered) {
            print(QStringLiteral("node %1  %2  no answer to SDO: a master, or a device that is stopped")
                      .arg(device.node, 3)
                      .arg(state, -15));
            continue;
        }
        print(QStringLiteral("node %1  %2  %3  vendor %4  product %5  revision %6  serial %7  %8")
                  .arg(device.node, 3)
                  .arg(state, -15)
                  .arg(qplc::CanOpenScan::profileText(device.type), -24)
                  .arg(hexText(device.vendor), hexText(device.product), hexText(device.revision),
                       hexText(device.serial), device.name));
    }
    return QPlcNodeApplication::Success;
}

/// Shows what comes from the devices, without a master, until a signal ends it.
int monitor(QPlcNodeApplication &application, QPlcHardwareNode &node)
{
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout, [&] {
        node.readDevices();
        printWires(node);
        print({});
    });
    node.openDevices();
    timer.start(1000);
    application.quitOnSignals();
    const int code = QPlcNodeApplication::exec();
    node.closeDevices();
    return code;
}

/// A device hangs. What is not safe was told before.
void endNow(int)
{
    constexpr char text[] = "a device hangs: ended without closing it\n";
    const ssize_t written = ::write(STDERR_FILENO, text, sizeof text - 1);
    Q_UNUSED(written)
    ::_exit(NotSafe);
}

/// After the node has died: writes the safe values, and ends in any case.
int makeSafe(QPlcHardwareNode &node)
{
    constexpr unsigned longest = 4;  // [s] also if a device hangs; below TimeoutStopSec of the service
    std::signal(SIGALRM, endNow);
    ::alarm(longest);
    const QStringList problems = node.makeSafe(std::chrono::seconds(2));
    for (const QString &problem : problems)
        QTextStream(stderr) << problem << Qt::endl;
    node.closeDevices();
    return problems.isEmpty() ? QPlcNodeApplication::Success : NotSafe;
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcNodeApplication application(argc, argv);
    application.setDescription(QStringLiteral("A node that connects signals with devices (CAN, switches, sensors, "
                                              "drives), as a configuration file describes it."));
    application.setExamples({QStringLiteral("qtplc_hardware winch.ini --master 192.168.1.5 --stay"),
                             QStringLiteral("qtplc_hardware winch.ini --monitor"),
                             QStringLiteral("qtplc_hardware --drivers"), QStringLiteral("qtplc_hardware scan can0")});
    application.addPositionalArgument(
        QStringLiteral("configuration"),
        QStringLiteral("Configuration file: the devices, and the signals of their channels. Or: scan BUS, which lists "
                       "the devices of a CANopen bus."),
        QStringLiteral("CONFIGURATION"));
    application.addOption(
        {QStringLiteral("check"), QStringLiteral("Reads the configuration, shows the wires, and ends.")});
    application.addOption({QStringLiteral("monitor"),
                           QStringLiteral("Opens the devices and shows their values each second, without a master. "
                                          "Writes only safe values to them.")});
    application.addOption({QStringLiteral("safe"),
                           QStringLiteral("Writes the safe values of the configuration to all devices, without a "
                                          "master, and ends within 4 s: 0 if all devices have them, else 1.")});
    application.addOption({QStringLiteral("drivers"), QStringLiteral("Lists the kinds of drivers.")});
    if (!application.parseNodeOptions())
        return application.exitCode();
    if (application.isSet(QStringLiteral("drivers"))) {
        printKinds();
        return QPlcNodeApplication::Success;
    }
    const QStringList words = application.positionalArguments();
    if (words.size() == 2 && words.first() == QLatin1String("scan"))
        return scan(words.last());
    if (words.size() != 1)
        return application.usageError(QStringLiteral("name one configuration: qtplc_hardware winch.ini"));
    QPlcHardwareNode node;
    if (!node.configureFromFile(words.first()))
        return application.usageError(QPlcParseError::toString(node.configurationErrors()));
    for (const QPlcParseError &warning : node.configurationWarnings())
        QTextStream(stderr) << QStringLiteral("warning: ") << QPlcParseError::toString({warning}) << Qt::endl;
    if (node.name().isEmpty() && !application.isSet(QStringLiteral("name")))
        return application.usageError(
            QStringLiteral("the node has no name: add 'name = ...' to [node] of the configuration, or use --name"));
    if (application.isSet(QStringLiteral("check"))) {
        printWires(node);
        return QPlcNodeApplication::Success;
    }
    if (application.isSet(QStringLiteral("safe")))
        return makeSafe(node);
    if (application.isSet(QStringLiteral("monitor")))
        return monitor(application, node);
    node.openDevices();
    return application.run(node);
}
