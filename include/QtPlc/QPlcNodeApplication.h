// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcCoreApplication.h"
#include "QPlcSlaveNode.h"

/// The program of one node, with the options that all nodes have: --master, --signals, --name,
/// --watchdog, --watchdog-reaction, --critical, --stay, --same-cycle, and those for real time,
/// faults and security.
///
/// The usual main():
/// \code
/// class Winch : public QPlcCompactSlaveNode
/// {
/// public:
///     Winch() : QPlcCompactSlaveNode("Winch") {}
/// };
///
/// int main(int argc, char **argv)
/// {
///     return QPlcNodeApplication::run<Winch>(argc, argv);
/// }
/// \endcode
///
/// With an option of your own:
/// \code
/// class Winch : public QPlcCompactSlaveNode
/// {
/// public:
///     explicit Winch(double radius) : QPlcCompactSlaveNode("Winch"), m_radius(radius) {}
///
/// private:
///     double m_radius;  // [m]
/// };
///
/// int main(int argc, char **argv)
/// {
///     QPlcNodeApplication application(argc, argv);
///     application.addOption({"drum", "Radius of the drum [m].", "METRES", "0.25"});
///     if (!application.parseNodeOptions())
///         return application.exitCode();
///     Winch winch(application.value("drum").toDouble());
///     return application.run(winch);
/// }
/// \endcode
///
/// As a service of systemd (Type=notify) the program reports that it is ready when the node is
/// registered, or with --stay when it waits for its master, and it feeds the watchdog: see
/// QPlcServiceNotifier.
///
/// \threadsafe no: use it in the main thread
///
/// \ingroup programs
class QTPLC_EXPORT QPlcNodeApplication : public QPlcCoreApplication
{
    Q_OBJECT
public:
    /// Makes the application and adds the options of a node.
    /// \param argc,  argv of main(); they outlive the object
    QPlcNodeApplication(int &argc, char **argv);

    /// Sets the file of the signal table that is read when --signals is not given. Without one the
    /// master sends its table. Call this before parseNodeOptions().
    void setDefaultSignals(const QString &fileName);
    /// Sets the signal that gets the workload of the node [s]; empty: no measurement. Call this
    /// before run(): QPlcSlaveNode::activateWorkloadMeasurement().
    void setWorkloadSignal(const QString &signalName);

    /// Does parseOptions(), and makes the signal table of --signals the table of the process.
    /// \return false when the program has to end with exitCode(): help was printed, or an option or
    ///     the table is wrong; the message was printed
    bool parseNodeOptions();
    /// Sets up the node as the options say, connects it, and runs the event loop until SIGINT or
    /// SIGTERM comes. Without --stay it also ends when the master ends in order, or is not there at
    /// the beginning; a master that was lost is waited for. The watchdog of the node stays as it is
    /// without --watchdog.
    /// \param node  outlives the call; it is disconnected when run() returns
    /// \return the exit code of the program
    int run(QPlcSlaveNode &node);

    /// Does all of it for a node class with a default constructor: see the first example.
    /// \return the exit code of the program
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
