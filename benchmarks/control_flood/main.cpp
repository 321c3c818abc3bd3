// SPDX-License-Identifier: Apache-2.0
// How soon Stop acts, how exactly leases end and how late cycles begin while eight tools with keys
// ask the most expensive questions, over TLS, from other processes. Also what the event loop of the
// master does in one step while one of them registers with a long message.
//
//   control_flood [--signals N] [--connections N] [--stops N] [--leases N] [--rounds N]
//                 [--seconds S]
//
// The program starts itself as master and as tools. --signals: of the table.
#include "../common/Processes.h"

#include <QtCore/QCommandLineParser>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonObject>
#include <QtCore/QRandomGenerator>
#include <QtCore/QTemporaryDir>
#include <QtCore/QTimer>

#include <chrono>
#include <ctime>

namespace {

constexpr std::chrono::milliseconds period{10};
constexpr qint64 leaseTime = 200'000'000;  // [ns]
constexpr int questionsAtOnce = 8;         // of a tool, before it waits for answers
constexpr int namesAtOnce = 2000;          // more would fill the way to the master: TCP ends it

QString signalName(int number)
{
    return QStringLiteral("s%1").arg(number);
}

QPlcSignalTable table(int signalCount)
{
    QByteArray ini = "[speed]\ntype = Real64\n";
    for (int i = 1; i < signalCount; ++i)
        ini += "[" + signalName(i).toLatin1() + "]\ntype = Bool\n";
    return QPlcSignalTable::fromIni(ini);
}

// ---- the master ----

/// Tells in which cycle the speed leaves 0, and when it is there again.
class Watcher : public QPlcCompactSlaveNode
{
public:
    Watcher()
        : QPlcCompactSlaveNode(QStringLiteral("Watcher"))
    {
    }

private:
    void step(const QPlcCycle &) override
    {
        const bool isMoved = m_speed != 0.0;
        if (isMoved && !m_wasMoved)
            m_begin = now();
        if (!isMoved && m_wasMoved)
            tell(QStringLiteral("lease %1").arg(now() - m_begin));
        m_wasMoved = isMoved;
    }

    QPlcInput<double> m_speed{this, "speed"};
    bool m_wasMoved = false;
    qint64 m_begin = 0;
};

/// The longest step of an event loop, in processor time of its thread: what else the machine does
/// makes it no longer.
class LongestStep
{
public:
    LongestStep()
    {
        m_timer.setTimerType(Qt::PreciseTimer);
        QObject::connect(&m_timer, &QTimer::timeout, [this] {
            const qint64 worked = workedSoFar();
            m_longest = std::max(m_longest, worked - std::exchange(m_last, worked));
        });
        m_timer.start(1);
    }
    /// [ns] since the last call
    qint64 take() { return std::exchange(m_longest, 0); }

private:
    static qint64 workedSoFar()
    {
        timespec time{};
        ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return qint64(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
    }
    QTimer m_timer;
    qint64 m_last = workedSoFar();
    qint64 m_longest = 0;
};

int runMaster(const QString &keys, int signalCount)
{
    QPlcSignalIndexTable::setCurrent(table(signalCount));
    LongestStep longestStep;
    Watcher watcher;
    QPlcMasterNode master;
    master.setProfile(QPlcProfile::Plant);
    master.setInterval(period);
    master.setSecurity(QPlcSecurity::preSharedKeys(keys));
    master.setArmingRequired(false);
    QObject::connect(&master, &QPlcMasterNode::stateChanged, &master, [&](QPlcMasterNode::State state) {
        static bool isMoving = false;
        if (state == QPlcMasterNode::RealTime)
            tell(QStringLiteral("runs"));
        if (state == QPlcMasterNode::Off && isMoving) {
            const qint64 time = now();
            const QPlcCycleStatistics statistics = master.cycleStatistics();
            tell(QStringLiteral("stopped %1 %2 %3 %4")
                     .arg(time)
                     .arg(statistics.lateness.sinceStart.p99)
                     .arg(statistics.execution.sinceStart.p99)
                     .arg(longestStep.take()));
            QTimer::singleShot(0, &master, [&] { master.startRealTime(); });
        }
        isMoving = state == QPlcMasterNode::RealTime;
    });
    if (!master.addLocalNode(&watcher)
        || !master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0))) {
        std::fprintf(stderr, "%s\n", qPrintable(master.errorString()));
        return 1;
    }
    tell(QStringLiteral("port %1").arg(master.serverPort()));
    master.startRealTime();
    return QCoreApplication::exec();
}

// ---- tools ----

/// What costs most: all signals, many signals by name, all histograms.
void askMost(Tool &tool, int number, int signalCount)
{
    static const QJsonArray names = [signalCount] {
        QJsonArray array;
        for (int i = 1; i < std::min(signalCount, namesAtOnce); ++i)
            array << signalName(i);
        return array;
    }();
    if (number % 3 == 0)
        tool.send(QPlcMessage::GetSignals);
    else if (number % 3 == 1)
        tool.send(QPlcMessage::GetSignals, {{"names", names}});
    else
        tool.send(QPlcMessage::GetStatistics, {{"histograms", true}});
}

/// What else a tool does, without end.
enum class Registering : quint8 {
    Nothing,
    Signals,  // a listener of all signals registers and leaves
    Fields    // a registration with a million fields is refused
};

QJsonObject registrationOf(Registering kind, int signalCount)
{
    QJsonArray inputs;
    for (int i = 1; kind == Registering::Signals && i < signalCount; ++i)
        inputs << QJsonObject{{"name", signalName(i)}, {"type", "Int8"}, {"unit", ""}};
    QJsonObject registration{{"name", "observer"}, {"policy", "SilentZeroOrderHold"}, {"listener", true},
                             {"inputs", inputs},   {"outputs", QJsonArray()},         {"cyclic", "udp"},
                             {"udpPort", 9}};
    for (int i = 0; kind == Registering::Fields && i < 1'000'000; ++i)  // behind the others
        registration.insert(QStringLiteral("x%1").arg(i, 6, 10, QLatin1Char('0')), 12345);
    return registration;
}

/// Registers and leaves, or is refused, and comes again, without end.
class Registrant
{
public:
    Registrant(const QString &keys, quint16 port, Registering kind, int signalCount)
        : m_keys(keys)
        , m_port(port)
        , m_registration(registrationOf(kind, signalCount))
    {
        begin();
    }

private:
    void begin()
    {
        m_tool = std::make_unique<Tool>(QStringLiteral("observer"), m_keys,
                                        QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, m_port));
        m_tool->onMessage = [this](const QPlcMessage &message) {
            if (message.kind() == QPlcMessage::Hello) {
                m_tool->send(QPlcMessage::Register, m_registration);
            } else if (message.kind() == QPlcMessage::Registered || message.kind() == QPlcMessage::Rejected) {
                tell(message.kindName());
                QTimer::singleShot(0, qApp, [this] { begin(); });
            }
        };
    }

    const QString m_keys;
    const quint16 m_port;
    const QJsonObject m_registration;
    std::unique_ptr<Tool> m_tool;
};

int runFlood(const QString &keys, quint16 port, int connections, int signalCount, Registering registering)
{
    std::unique_ptr<Registrant> registrant;
    if (registering != Registering::Nothing)
        registrant = std::make_unique<Registrant>(keys, port, registering, signalCount);
    std::vector<std::unique_ptr<Tool>> tools;
    quint64 answers = 0;
    for (int i = 0; i < connections; ++i) {
        tools.push_back(std::make_unique<Tool>(QStringLiteral("observer"), keys,
                                               QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port)));
        Tool *tool = tools.back().get();
        tool->onMessage = [&answers, tool, signalCount, asked = 0](const QPlcMessage &message) mutable {
            if (message.kind() == QPlcMessage::Hello) {
                for (; asked < questionsAtOnce; ++asked)
                    askMost(*tool, asked, signalCount);
                return;
            }
            if (message.kind() == QPlcMessage::StatesInitialized)
                return;  // no answer: all are told of each start
            if (++answers == 1)
                tell(QStringLiteral("floods"));
            askMost(*tool, asked++, signalCount);
        };
    }
    return QCoreApplication::exec();
}

// ---- the person ----

class Measurement
{
public:
    Measurement(const QString &keys, int signalCount, int connections)
        : m_keys(keys)
        , m_signals(signalCount)
        , m_connections(connections)
        , m_master({"master", keys, QString::number(signalCount)})
        , m_other({"master", keys, QString::number(signalCount)})
        , m_port(m_master.next("port").at(0))
        , m_otherPort(m_other.next("port").at(0))
        , m_person(QStringLiteral("operator"), keys,
                   QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, quint16(m_port.toInt())))
    {
        m_master.next("runs");
        m_other.next("runs");
        bool isGreeted = false;
        m_person.onMessage = [&](const QPlcMessage &) { isGreeted = true; };
        while (!isGreeted)
            QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
        m_person.onMessage = {};
    }

    void stops(int count, Registering registering)
    {
        const std::unique_ptr<Child> flood = makeFlood(m_port, registering);
        std::vector<double> delays;
        std::vector<double> steps;
        for (int i = 0; i < count; ++i) {
            pass(QRandomGenerator::global()->bounded(20, 40));
            delays.push_back(stop());
            steps.push_back(m_figures.at(3).toDouble() * 1e-6);
        }
        checkThatItGoesOn(*flood);
        if (registering == Registering::Signals)
            flood->next("Registered");
        if (registering == Registering::Fields)
            flood->next("Rejected");
        const QString meanwhile = registering == Registering::Nothing ? QString()
            : registering == Registering::Signals
            ? QStringLiteral(", while a listener of all signals registers and leaves")
            : QStringLiteral(", while a registration with a million fields is refused");
        show(qPrintable("stop" + meanwhile), delays, "ms");
        show(qPrintable("longest step of the event loop between two stops" + meanwhile), steps, "ms");
    }

    void leases(int count)
    {
        const std::unique_ptr<Child> flood = makeFlood(m_port);
        std::vector<double> delays;
        for (int i = 0; i < count; ++i) {
            const QJsonObject values{{"speed", "1"}};
            m_person.send(QPlcMessage::TakeLease,
                          {{"signals", QJsonArray{"speed"}}, {"values", values}, {"timeout", double(leaseTime)}});
            delays.push_back((m_master.next("lease").at(0).toDouble() - double(leaseTime))
                             / double(period.count() * 1'000'000));
        }
        checkThatItGoesOn(*flood);
        show("lease ends after its time", delays, "cycles");
    }

    /// How late cycles begin, and how long they are, with the same load on this master and on the
    /// other one.
    void cycles(int rounds, int seconds)
    {
        std::vector<double> ratios[2];
        for (int round = 0; round < rounds; ++round) {
            double p99[2][2];
            for (const bool isOwn : {round % 2 == 0, round % 2 != 0}) {
                const std::unique_ptr<Child> flood = makeFlood(isOwn ? m_port : m_otherPort);
                stop();  // statistics begin anew
                pass(seconds * 1000);
                const QStringList figures = (stop(), m_figures);
                checkThatItGoesOn(*flood);
                for (int i : {0, 1})
                    p99[isOwn][i] = figures.at(i + 1).toDouble();
            }
            for (int i : {0, 1})
                ratios[i].push_back(p99[true][i] / p99[false][i]);
            tell(QStringLiteral("round %1: lateness p99 %2 us (other port %3), execution p99 %4 us (other port %5)")
                     .arg(round + 1)
                     .arg(p99[true][0] * 1e-3, 0, 'f', 1)
                     .arg(p99[false][0] * 1e-3, 0, 'f', 1)
                     .arg(p99[true][1] * 1e-3, 0, 'f', 1)
                     .arg(p99[false][1] * 1e-3, 0, 'f', 1));
        }
        show("lateness p99, ratio to the other port", ratios[0], "");
        show("execution p99, ratio to the other port", ratios[1], "");
    }

private:
    std::unique_ptr<Child> makeFlood(const QString &port, Registering registering = Registering::Nothing)
    {
        auto flood
            = std::make_unique<Child>(QStringList{"flood", m_keys, port, QString::number(m_connections),
                                                  QString::number(m_signals), QString::number(int(registering))});
        flood->next("floods");
        return flood;
    }
    static void checkThatItGoesOn(Child &flood)
    {
        QCoreApplication::processEvents();
        if (flood.state() != QProcess::Running)
            qFatal("the flood has ended; these figures are worth nothing");
    }
    /// \return how long it took [ms]; the plant runs again
    double stop()
    {
        const qint64 sent = now();
        m_person.send(QPlcMessage::Stop);
        m_figures = m_master.next("stopped");
        m_master.next("runs");
        return double(m_figures.at(0).toLongLong() - sent) * 1e-6;
    }

    const QString m_keys;
    const int m_signals;
    const int m_connections;
    Child m_master, m_other;
    const QString m_port, m_otherPort;
    Tool m_person;
    QStringList m_figures;
};

int runAll(const QCoreApplication &application)
{
    QCommandLineParser parser;
    const auto option = [&parser](const char *name, const char *preset) {
        parser.addOption({QLatin1String(name), {}, QStringLiteral("number"), QLatin1String(preset)});
    };
    option("signals", "65534");
    option("connections", "8");
    option("stops", "1000");
    option("leases", "50");
    option("rounds", "5");
    option("seconds", "10");
    parser.addHelpOption();
    parser.process(application);
    const auto number = [&parser](const char *name) { return parser.value(QLatin1String(name)).toInt(); };
    const QTemporaryDir folder;
    Measurement measurement(makeKeys(folder, {{"operator", "Operator"}, {"observer", "Observer"}}), number("signals"),
                            number("connections"));
    measurement.stops(number("stops"), Registering::Nothing);
    measurement.stops(number("stops") / 4, Registering::Signals);
    measurement.stops(number("stops") / 4, Registering::Fields);
    measurement.leases(number("leases"));
    measurement.cycles(number("rounds"), number("seconds"));
    return 0;
}

}  // namespace

int main(int argc, char **argv)
{
    QCoreApplication application(argc, argv);
    const QStringList arguments = QCoreApplication::arguments();
    if (arguments.value(1) == QLatin1String("master"))
        return runMaster(arguments.at(2), arguments.at(3).toInt());
    if (arguments.value(1) == QLatin1String("flood"))
        return runFlood(arguments.at(2), quint16(arguments.at(3).toInt()), arguments.at(4).toInt(),
                        arguments.at(5).toInt(), Registering(arguments.at(6).toInt()));
    return runAll(application);
}
