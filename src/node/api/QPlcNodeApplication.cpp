// SPDX-License-Identifier: Apache-2.0
#include "QPlcNodeApplication.h"

#include "QPlcServiceNotifier.h"
#include "QPlcSignalIndexTable.h"

namespace {

QCommandLineOption option(const char *name, const QString &description, const char *valueName,
                          const QString &defaultValue = QString())
{
    return QCommandLineOption(QString::fromLatin1(name), description, QString::fromLatin1(valueName), defaultValue);
}

}  // namespace

QPlcNodeApplication::QPlcNodeApplication(int &argc, char **argv)
    : QPlcCoreApplication(argc, argv)
{
    addOption(
        option("master",
               QStringLiteral("Where the master is: [tcp://|udp://|udp-multicast://]HOST[:PORT], or "
                              "local://PORT for shared memory on one computer. Without a transport: UDP, or TCP if UDP "
                              "does not get through. "
                              "Without this option: 127.0.0.1:50000."),
               "ADDRESS", QStringLiteral("127.0.0.1:%1").arg(QPlcUnderlyingProtocol::DefaultPort)));
    addOption(option("signals", QStringLiteral("Signal table of this node. Without one the master sends its table."),
                     "FILE"));
    addOption(option("name", QStringLiteral("Name under which the node registers."), "NAME"));
    addOption(
        option("watchdog",
               QStringLiteral(
                   "Watchdog time: longest time without a frame of the master. 0: no watchdog. Default: 0.5 for nodes "
                   "with devices (qtplc_hardware), else the setting of the program or of the profile of the plant."),
               "SECONDS"));
    addOption(option("watchdog-reaction",
                     QStringLiteral("Reaction of the watchdog to its time-out: report, or safe-state. Default: the "
                                    "setting of the program or of the profile of the plant."),
                     "REACTION"));
    addOption(QCommandLineOption(
        QStringLiteral("critical"),
        QStringLiteral("The plant stops safely when this node is lost, fails, or is late too often.")));
    addOption(QCommandLineOption(
        QStringLiteral("stay"),
        QStringLiteral(
            "Waits for the master when it is not there yet, and when it has ended. Without this option the node ends "
            "in both cases. It always waits for a master that was lost.")));
    addOption(QCommandLineOption(
        QStringLiteral("same-cycle"),
        QStringLiteral("Reads all inputs in the cycle in which they are written, without the dead time of a cycle.")));
    addRealTimeOptions();
    addFaultOptions();
    addSecurityOptions(QPlcSecurity::NodeSide);
}

void QPlcNodeApplication::setDefaultSignals(const QString &fileName)
{
    m_defaultSignals = fileName;
}

void QPlcNodeApplication::setWorkloadSignal(const QString &signalName)
{
    m_workloadSignal = signalName;
}

bool QPlcNodeApplication::parseNodeOptions()
{
    if (!parseOptions())
        return false;
    const QString fileName = isSet(QStringLiteral("signals")) ? value(QStringLiteral("signals")) : m_defaultSignals;
    QPlcSignalIndexTable table;
    if (fileName.isEmpty() || table.initializeFromIniFile(fileName))
        return true;
    usageError(table.errorString());
    return false;
}

bool QPlcNodeApplication::configure(QPlcSlaveNode &node)
{
    const bool hasWatchdog = isSet(QStringLiteral("watchdog"));
    double watchdog = 0.0;
    QPlcRealTimeOptions realTimeOptions;
    QString faultPlan;
    QPlcSecurity security;
    if ((hasWatchdog && !number(QStringLiteral("watchdog"), 0.0, 3600.0, &watchdog))
        || !readRealTimeOptions(&realTimeOptions) || !readSecurityOptions(QPlcSecurity::NodeSide, &security)
        || !readFaultPlan(&faultPlan))
        return false;
    const QString reaction = value(QStringLiteral("watchdog-reaction"));
    if (reaction == QLatin1String("report")) {
        node.setWatchdogReaction(QPlcSlaveNode::WatchdogReaction::Report);
    } else if (reaction == QLatin1String("safe-state")) {
        node.setWatchdogReaction(QPlcSlaveNode::WatchdogReaction::SafeState);
    } else if (isSet(QStringLiteral("watchdog-reaction"))) {
        usageError(QStringLiteral("--watchdog-reaction '%1': use report or safe-state").arg(reaction));
        return false;
    }
    QPlcSecurity::setCurrent(security);
    if (hasWatchdog)
        node.activateWatchdog(watchdog);
    node.setFaultPlan(faultPlan);
    node.setRealTimeOptions(realTimeOptions);
    if (isSet(QStringLiteral("critical")))
        node.setCritical(true);
    node.setReconnectPolicy(isSet(QStringLiteral("stay")) ? QPlcSlaveNode::ReconnectAlways
                                                          : QPlcSlaveNode::ReconnectWhenLost);
    if (isSet(QStringLiteral("same-cycle")))
        node.setSameCycle(true);
    if (isSet(QStringLiteral("name")))
        node.setName(value(QStringLiteral("name")));
    if (!m_workloadSignal.isEmpty())
        node.activateWorkloadMeasurement(m_workloadSignal);
    return true;
}

int QPlcNodeApplication::run(QPlcSlaveNode &node)
{
    QString text;
    const QPlcUnderlyingProtocol master
        = QPlcUnderlyingProtocol::fromString(value(QStringLiteral("master")), QPlcUnderlyingProtocol::Automatic, &text);
    if (!master.isValid())
        return usageError(QStringLiteral("--master: %1").arg(text));
    if (!configure(node))
        return exitCode();
    const bool stays = isSet(QStringLiteral("stay"));
    QPlcServiceNotifier service(node);
    quitOnSignals();  // also while it waits for the connection
    if (stays)
        node.connectToMaster(master);
    else if (!node.connectToMasterAndWaitForConnected(master))
        return node.error() == QPlcSlaveNode::NoError
            ? Success
            : UsageError;  // the node has said why; without an error the master or this program just ends
    service.setReady();    // one that stays does its work already when it waits for its master
    if (!stays) {
        connect(&node, &QPlcSlaveNode::disconnectedFromMaster, this, [this, &node] {
            // When the master was lost, and did not just end, its error follows, and the node
            // connects again. An error of the code of the node may still be there.
            QMetaObject::invokeMethod(
                this,
                [&node] {
                    if (node.state() == QPlcSlaveNode::Disconnected && node.error() != QPlcSlaveNode::ConnectionError)
                        exit(Success);
                },
                Qt::QueuedConnection);
        });
    }
    const int code = exec();
    node.disconnect(this);
    node.disconnectFromMaster();
    return code;
}
