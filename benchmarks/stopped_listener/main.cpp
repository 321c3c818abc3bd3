// SPDX-License-Identifier: Apache-2.0
// Whether a listener in another process that is stopped (SIGSTOP) for a while has computed every
// cycle of a lockstep phase, or has counted it as lost or not sent: from the first one to the last.
//
//   stopped_listener [--cycles N] [--pause S]
//
// The program starts itself as listener, once for each transport. Exit code 1: a cycle is in no
// count, or in two.
#include "../common/Processes.h"

#include <QtCore/QCommandLineParser>

#include <csignal>

namespace {

void useTable()
{
    QPlcSignalIndexTable::setCurrent(QPlcSignalTable::fromIni("[time]\ntype = Real64\n"));
}

constexpr qint64 leastTime = 10'000;  // [ns] of a cycle: the phase is to last longer than the pause
constexpr int before = 1000;          // [ms] of the phase before the pause

/// Writes the number of the cycle, at most 100 000 times in a second.
class Clock : public QPlcCompactSlaveNode
{
public:
    Clock()
        : QPlcCompactSlaveNode(QStringLiteral("Clock"))
    {
    }

private:
    void step(const QPlcCycle &cycle) override
    {
        m_begin = cycle.number() == 0 ? now() : m_begin;
        while (now() < m_begin + qint64(cycle.number()) * leastTime) {}
        m_time = double(cycle.number());
    }

    QPlcOutput<double> m_time{this, "time"};
    qint64 m_begin = 0;
};

class Listener : public QPlcCompactSlaveNode
{
public:
    Listener()
        : QPlcCompactSlaveNode(QStringLiteral("Listener"))
    {
        setListener(true);
        QObject::connect(this, &QPlcSlaveNode::stateChanged, this, [this](State state) {
            if (state == Off && m_steps > 0)
                report();
        });
    }

private:
    void step(const QPlcCycle &cycle) override
    {
        if (m_steps++ == 0)
            m_first = cycle.number();
        const bool isExpected = cycle.number() == m_next + cycle.missedCycles();
        const bool isOfLastCycle = cycle.number() == 0 || m_time == double(cycle.number() - 1);
        m_wrong += isExpected && isOfLastCycle ? 0 : 1;
        m_next = cycle.number() + 1;
    }
    void report()
    {
        const QPlcSlaveNode::Counters counts = counters();
        tell(QStringLiteral("heard %1 %2 %3 %4 %5 %6")
                 .arg(m_first)
                 .arg(m_next - 1)
                 .arg(counts.cycles)
                 .arg(counts.missed)
                 .arg(counts.skipped)
                 .arg(m_wrong + quint64(m_steps != counts.cycles)));
    }

    QPlcInput<double> m_time{this, "time"};
    quint64 m_steps = 0;
    quint64 m_first = 0;
    quint64 m_next = 0;
    quint64 m_wrong = 0;  // steps of another cycle, or with other values, than was to be expected
};

int runListener(const QString &address)
{
    useTable();
    Listener listener;
    listener.connectToMaster(QPlcUnderlyingProtocol::fromString(address));
    return QCoreApplication::exec();
}

/// \return whether every cycle was accounted for
bool measure(const QString &kind, int cycles, double pause)
{
    QPlcMasterNode master;
    Clock clock;
    master.setClock(QPlcClock::lockstep());
    master.setCycleLimit(quint64(cycles));
    if (!master.addLocalNode(&clock) || !master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)))
        qFatal("%s", qPrintable(master.errorString()));
    const QString place
        = kind == QLatin1String("local") ? QStringLiteral("local://%1") : kind + QStringLiteral("://127.0.0.1:%1");
    Child listener({"listener", place.arg(master.serverPort())});
    while (master.nodes().size() < 2)
        QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    master.initializeAllStates();
    while (master.state() != QPlcMasterNode::Ready)
        QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    pass(200);  // the master does not wait until a listener is ready
    const qint64 begin = now();
    if (!master.startRealTime())
        qFatal("%s", qPrintable(master.errorString()));
    QTimer::singleShot(before, &master, [&] { ::kill(pid_t(listener.processId()), SIGSTOP); });
    QTimer::singleShot(before + int(pause * 1e3), &master, [&] { ::kill(pid_t(listener.processId()), SIGCONT); });
    const QStringList heard = listener.next("heard");
    const auto number = [&heard](int i) { return heard.at(i).toLongLong(); };
    const qint64 sum = number(2) + number(3) + number(4);
    tell(QStringLiteral("%1: first %2, last %3; %4 computed + %5 lost + %6 not sent = %7 of %8; %9 wrong steps; %10 s")
             .arg(kind, -5)
             .arg(number(0))
             .arg(number(1))
             .arg(number(2))
             .arg(number(3))
             .arg(number(4))
             .arg(sum)
             .arg(cycles)
             .arg(number(5))
             .arg(double(now() - begin) * 1e-9, 0, 'f', 1));
    master.removeLocalNode(&clock);
    return sum == cycles && number(5) == 0;
}

int runAll(const QCoreApplication &application)
{
    QCommandLineParser parser;
    parser.addOptions({{QStringLiteral("cycles"), {}, QStringLiteral("N"), QStringLiteral("1000000")},
                       {QStringLiteral("pause"), {}, QStringLiteral("S"), QStringLiteral("5")}});
    parser.addHelpOption();
    parser.process(application);
    useTable();
    bool isGood = true;
    for (const char *kind : {"udp", "tcp", "local"})
        isGood = measure(QLatin1String(kind), parser.value(QStringLiteral("cycles")).toInt(),
                         parser.value(QStringLiteral("pause")).toDouble())
            && isGood;
    return isGood ? 0 : 1;
}

}  // namespace

int main(int argc, char **argv)
{
    QCoreApplication application(argc, argv);
    const QStringList arguments = QCoreApplication::arguments();
    return arguments.value(1) == QLatin1String("listener") ? runListener(arguments.at(2)) : runAll(application);
}
