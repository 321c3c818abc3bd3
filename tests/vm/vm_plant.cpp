// SPDX-License-Identifier: Apache-2.0
// A plant with a lamp, whose programs are killed, stopped and told to end by tests/vm/plant.py:
//
//   vm_plant master PERIOD_MS                 starts as soon as Switch and Lamp are there
//   vm_plant switch PORT                      switches the lamp on in each cycle
//   vm_plant lamp PORT CONFIGURATION WATCHDOG_MS    a hardware node with code of its own
//
// SIGUSR1 lets the code of switch and lamp throw an exception.
#include <QtPlcHardware>

#include <csignal>
#include <cstdio>
#include <stdexcept>

namespace {

constexpr const char *table = "[lamp]\ntype = Real64\nsafe = 0\nhold = 10\n";
volatile std::sig_atomic_t isToThrow = 0;

void throwOnSignal()
{
    std::signal(SIGUSR1, [](int) { isToThrow = 1; });
}

void throwIfToldTo()
{
    if (isToThrow)
        throw std::runtime_error("this code was told to fail");
}

void tell(const QString &line)
{
    std::printf("%s\n", qPrintable(line));
    std::fflush(stdout);
}

int runMaster(QPlcCoreApplication &application, int period)
{
    QPlcMasterNode master;
    master.setProfile(QPlcProfile::Plant);
    master.setInterval(period * 1e-3);
    QObject::connect(
        &master, &QPlcMasterNode::nodeRegistered, &master,
        [&] {
            if (master.nodes().size() == 2 && master.state() == QPlcMasterNode::Off)
                master.startRealTime();
        },
        Qt::QueuedConnection);
    if (!master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)))
        return QPlcCoreApplication::UsageError;
    tell(QStringLiteral("port %1").arg(master.serverPort()));
    application.quitOnSignals();
    return QPlcCoreApplication::exec();
}

class Switch : public QPlcCompactSlaveNode
{
public:
    Switch()
        : QPlcCompactSlaveNode(QStringLiteral("Switch"))
    {
    }

private:
    void step(const QPlcCycle &) override
    {
        throwIfToldTo();
        m_lamp = 1.0;
    }
    QPlcOutput<double> m_lamp{this, "lamp"};
};

class Lamp : public QPlcHardwareNode
{
    void step(const QPlcCycle &cycle) override
    {
        throwIfToldTo();
        QPlcHardwareNode::step(cycle);
    }
};

int runNode(QPlcCoreApplication &application, QPlcSlaveNode &node, const QString &port)
{
    QObject::connect(&node, &QPlcSlaveNode::connectedToMaster, [] { tell(QStringLiteral("registered")); });
    throwOnSignal();
    application.quitOnSignals();
    node.connectToMaster(QPlcUnderlyingProtocol::udp(QHostAddress::LocalHost, quint16(port.toInt())));
    return QPlcCoreApplication::exec();
}

int runLamp(QPlcCoreApplication &application, const QStringList &arguments)
{
    Lamp lamp;
    if (!lamp.configureFromFile(arguments.at(2)))
        return application.usageError(QPlcParseError::toString(lamp.configurationErrors()));
    QObject::connect(&lamp, &QPlcHardwareNode::deviceFailed,
                     [](const QString &driver, const QString &text) { tell(driver + QStringLiteral(": ") + text); });
    lamp.openDevices();
    lamp.activateWatchdog(std::chrono::milliseconds(arguments.at(3).toInt()));
    return runNode(application, lamp, arguments.at(1));
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    QPlcSignalIndexTable::setCurrent(QPlcSignalTable::fromIni(table));
    const QStringList arguments = QCoreApplication::arguments().mid(1);
    const QString role = arguments.value(0);
    if (role == QLatin1String("master") && arguments.size() == 2)
        return runMaster(application, arguments.at(1).toInt());
    if (role == QLatin1String("switch") && arguments.size() == 2) {
        Switch node;
        return runNode(application, node, arguments.at(1));
    }
    if (role == QLatin1String("lamp") && arguments.size() == 4)
        return runLamp(application, arguments);
    return QPlcCoreApplication::UsageError;
}
