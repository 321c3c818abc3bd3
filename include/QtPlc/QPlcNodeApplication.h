// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcCoreApplication.h"
#include "QPlcSlaveNode.h"

/// The program around one node, with the options that all nodes have: --master, --signals, --name, --watchdog, --critical, --stay, --same-cycle, --priority, --cpu, ...
///
/// The usual main():
/// ```cpp
/// int main(int argc, char **argv) { return QPlcNodeApplication::run<Winch>(argc, argv); }
/// ```
/// With options of one's own:
/// ```cpp
/// QPlcNodeApplication application(argc, argv);
/// application.addOption({"drum", "Radius of the drum [m].", "METRES", "0.25"});
/// if (!application.parseNodeOptions())
///     return application.exitCode();
/// Winch winch(application.value("drum").toDouble());
/// return application.run(winch);
/// ```
/// As a service of systemd (Type=notify) it tells when the node is registered, or with --stay when it waits for its master, and feeds the watchdog: QPlcServiceNotifier.
class QTPLC_EXPORT QPlcNodeApplication : public QPlcCoreApplication
{
    Q_OBJECT
public:
    QPlcNodeApplication(int &argc, char **argv);

    /// A file that holds the signal table when --signals is not given. Without one the master sends the table.
    void setDefaultSignals(const QString &fileName);
    /// A signal that takes the workload of the node; empty: none.
    void setWorkloadSignal(const QString &signalName);

    /// parseOptions(), and reads the signal table into the process.
    bool parseNodeOptions();
    /// Sets the node up as the options say (the watchdog of the node stays as it is without --watchdog), connects it and runs the event loop until a signal ends the program or the master is lost.
    /// \return the exit code
    int run(QPlcSlaveNode &node);

    template<typename Node>
    static int run(int argc, char **argv)
    {
        QPlcNodeApplication application(argc, argv);
        if (!application.parseNodeOptions())
            return application.exitCode();
        Node node;
        return application.run(node);
    }

private:
    bool configure(QPlcSlaveNode &node);

    QString m_defaultSignals;
    QString m_workloadSignal;
};
