// SPDX-License-Identifier: Apache-2.0
// A plant of processes that is killed and stopped by its test: what happens to each of them stands
// on its standard output, a line each.
//
//   safe_plant master PORT NODES      starts as soon as NODES nodes are there (0: never)
//   safe_plant node NAME PORT WATCHDOG_MS critical|plain|stops [TRANSPORT]
//
// A node that 'stops' sends itself SIGSTOP in its 20th step.
#include <QtPlcCore>

#include <QtCore/QMetaEnum>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <unistd.h>

namespace {

constexpr const char *table = "[a]\ntype = Real64\nsafe = 1\n[b]\ntype = Real64\n";

void tell(const QString &line)
{
    const QByteArray bytes = line.toLocal8Bit() + '\n';
    const ssize_t written = ::write(STDOUT_FILENO, bytes.constData(), std::size_t(bytes.size()));
    Q_UNUSED(written)
}

qint64 microseconds()
{
    return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

int runMaster(QPlcCoreApplication &application, int port, int nodes)
{
    QPlcMasterNode master;
    master.setProfile(QPlcProfile::Plant);
    master.setInterval(0.010);
    QObject::connect(&master, &QPlcMasterNode::stateChanged, [&](QPlcMasterNode::State state) {
        tell(QStringLiteral("state %1 %2")
                 .arg(QLatin1String(QMetaEnum::fromType<QPlcMasterNode::State>().valueToKey(state)),
                      master.stateReason()));
    });
    QObject::connect(
        &master, &QPlcMasterNode::nodeRegistered, &master,
        [&](const QString &name) {
            tell(QStringLiteral("node %1").arg(name));
            if (master.nodes().size() == nodes && master.state() == QPlcMasterNode::Off)
                master.startRealTime();
        },
        Qt::QueuedConnection);
    if (!master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, quint16(port))))
        return QPlcCoreApplication::UsageError;
    tell(QStringLiteral("port %1").arg(master.serverPort()));
    application.quitOnSignals();
    return QPlcCoreApplication::exec();
}

/// Writes a signal of its own; tells when it was made safe, and how long after its last step.
class Node : public QPlcCompactSlaveNode
{
public:
    Node(const QString &name, bool stops)
        : QPlcCompactSlaveNode(name)
        , m_output(this, name == QLatin1String("A") ? "a" : "b")
        , m_stops(stops)
    {
    }

protected:
    void step(const QPlcCycle &cycle) override
    {
        m_missed += cycle.missedCycles();
        m_lastStep = microseconds();
        if (++m_steps == 10)
            tell(QStringLiteral("runs"));
        m_output = double(m_steps);
        if (m_stops && m_steps == 20) {
            tell(QStringLiteral("stops"));
            std::raise(SIGSTOP);
        }
    }
    void safeState(SafeStateReason reason) override
    {
        tell(QStringLiteral("safe %1 after %2 us, missed %3")
                 .arg(QLatin1String(QMetaEnum::fromType<SafeStateReason>().valueToKey(reason)))
                 .arg(microseconds() - m_lastStep)
                 .arg(m_missed));
        m_steps = 0;
    }

private:
    QPlcOutput<double> m_output;
    const bool m_stops;
    std::atomic<qint64> m_lastStep{0};
    std::atomic<int> m_steps{0};
    quint64 m_missed = 0;
};

int runNode(QPlcCoreApplication &application, const QStringList &arguments)
{
    Node node(arguments.at(1), arguments.at(4) == QLatin1String("stops"));
    node.activateWatchdog(std::chrono::milliseconds(arguments.at(3).toInt()));
    node.setCritical(arguments.at(4) == QLatin1String("critical"));
    QObject::connect(&node, &QPlcSlaveNode::connectedToMaster, [] { tell(QStringLiteral("registered")); });
    QObject::connect(&node, &QPlcSlaveNode::errorOccurred,
                     [&node] { tell(QStringLiteral("error %1").arg(node.errorString())); });
    application.quitOnSignals();
    const QString transport = arguments.value(5, QStringLiteral("udp"));
    node.connectToMaster(
        QPlcUnderlyingProtocol::fromString(QStringLiteral("%1://127.0.0.1:%2").arg(transport, arguments.at(2))));
    return QPlcCoreApplication::exec();
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    QPlcSignalIndexTable::setCurrent(QPlcSignalTable::fromIni(table));
    const QStringList arguments = QCoreApplication::arguments().mid(1);
    if (arguments.size() == 3 && arguments.at(0) == QLatin1String("master"))
        return runMaster(application, arguments.at(1).toInt(), arguments.at(2).toInt());
    if (arguments.size() >= 5 && arguments.at(0) == QLatin1String("node"))
        return runNode(application, arguments);
    return QPlcCoreApplication::UsageError;
}
