// SPDX-License-Identifier: Apache-2.0
// How long operators and a node that is started again wait at the control port while a stranger
// floods it, and how many answers are late while datagrams of strangers come in. With keys.
//
//   strangers [--master ADDRESS] [--foe ADDRESS] [--garbage N] [--silent N] [--friends N]
//             [--datagrams N] [--rounds N] [--seconds S] [--hello]
//
// The program starts itself as master, node and foe. Friends have the address of the master: with
// --foe of the same address, friend and foe share it. Addresses other than 127.0.0.0/8 have limits
// that users of this machine do not have: try them in a network namespace. With --hello the garbage
// is a wrong ClientHello.
#include "../common/Processes.h"

#include <QtCore/QCommandLineParser>
#include <QtNetwork/QUdpSocket>

#include <arpa/inet.h>
#include <cerrno>
#include <deque>
#include <netinet/in.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace {

constexpr std::chrono::milliseconds period{10};

/// Where a master is.
struct Place
{
    QString address;
    quint16 port = 0;

    /// As the program is told.
    explicit Place(const QString &text)
        : address(text.section(QLatin1Char(':'), 0, 0))
        , port(quint16(text.section(QLatin1Char(':'), 1).toInt()))
    {
    }
};

// ---- the plant ----

class Echo : public QPlcCompactSlaveNode
{
public:
    Echo()
        : QPlcCompactSlaveNode(QStringLiteral("Echo"))
    {
    }

private:
    void step(const QPlcCycle &cycle) override { m_time = m_time + cycle.dt(); }

    QPlcOutput<double> m_time{this, "time"};
};

void useTable()
{
    QPlcSignalIndexTable::setCurrent(QPlcSignalTable::fromIni("[time]\ntype = Real64\n"));
}

/// [us] that this thread has worked.
qint64 workedSoFar()
{
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return qint64(time.tv_sec) * 1'000'000 + time.tv_nsec / 1000;
}

/// Tells late answers, cycles, datagrams of strangers and the work of the event loop, each second.
int runMaster(const QString &keys, const QString &address)
{
    useTable();
    QPlcMasterNode master;
    master.setInterval(period);
    master.setSecurity(QPlcSecurity::preSharedKeys(keys));
    master.setArmingRequired(false);
    QTimer teller;
    QObject::connect(&teller, &QTimer::timeout, &master, [&master] {
        const QPlcMasterStatistics statistics = master.statistics();
        tell(QStringLiteral("figures %1 %2 %3 %4")
                 .arg(statistics.lateAnswers)
                 .arg(statistics.cycles)
                 .arg(statistics.strangers)
                 .arg(workedSoFar()));
        if (master.state() == QPlcMasterNode::Off && !master.nodes().isEmpty())
            master.startRealTime();
    });
    teller.start(1000);
    if (!master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress(address), 0))) {
        std::fprintf(stderr, "%s\n", qPrintable(master.errorString()));
        return 1;
    }
    tell(QStringLiteral("listens %1:%2").arg(address).arg(master.serverPort()));
    return QCoreApplication::exec();
}

int runNode(const QString &keys, const Place &master)
{
    useTable();
    Echo node;
    node.setSecurity(QPlcSecurity::preSharedKeys(keys, QStringLiteral("Echo")));
    QObject::connect(&node, &QPlcSlaveNode::connectedToMaster, &node, [] { tell(QStringLiteral("registered")); });
    node.connectToMaster(QPlcUnderlyingProtocol::udp(QHostAddress(master.address), master.port));
    return QCoreApplication::exec();
}

// ---- the foe ----

sockaddr_in ipv4(const QString &address, quint16 port)
{
    sockaddr_in result{};
    result.sin_family = AF_INET;
    result.sin_port = htons(port);
    ::inet_pton(AF_INET, qPrintable(address), &result.sin_addr);
    return result;
}

int socketFrom(const QString &address, int type, const Place &goal)
{
    const int descriptor = ::socket(AF_INET, type | SOCK_NONBLOCK, 0);
    const sockaddr_in own = ipv4(address, 0);
    const sockaddr_in master = ipv4(goal.address, goal.port);
    if (::bind(descriptor, reinterpret_cast<const sockaddr *>(&own), sizeof own) != 0)
        qFatal("cannot use the address %s", qPrintable(address));
    ::connect(descriptor, reinterpret_cast<const sockaddr *>(&master), sizeof master);
    return descriptor;
}

/// Calls \a act so many times a second, for ever.
template<typename Act>
[[noreturn]] void repeat(int perSecond, const Act &act)
{
    const qint64 begin = now();
    for (qint64 done = 0;;) {
        const qint64 due = (now() - begin) / 1000 * perSecond / 1'000'000;
        for (; done < due; ++done)
            act();
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
}

bool isEnded(int descriptor)
{
    char byte = 0;
    const ssize_t count = ::recv(descriptor, &byte, 1, MSG_DONTWAIT);
    return count == 0 || (count < 0 && errno != EAGAIN);
}

/// Garbage connections, and silent ones that come again when the master ends them.
[[noreturn]] void runConnections(const QString &address, const Place &goal, int garbagePerSecond, int silentCount,
                                 const QString &kind)
{
    const QByteArray bytes = kind == QLatin1String("hello")
        ? QByteArray("\x16\x03\x01\x00\x40\x01\x00\x00\x3c\x03\x03", 11) + QByteArray(58, '\0')
        : QByteArray("GET / HTTP/1.1\r\n\r\n");
    std::vector<int> silent(std::size_t(silentCount), -1);
    std::deque<int> garbage;
    std::size_t place = 0;
    repeat(garbagePerSecond, [&] {
        garbage.push_back(socketFrom(address, SOCK_STREAM, goal));
        ::send(garbage.back(), bytes.constData(), std::size_t(bytes.size()), MSG_NOSIGNAL);
        if (garbage.size() > 100) {
            ::close(garbage.front());
            garbage.pop_front();
        }
        if (silent.empty())
            return;
        int &one = silent[place++ % silent.size()];
        if (one >= 0 && !isEnded(one))
            return;
        if (one >= 0)
            ::close(one);
        one = socketFrom(address, SOCK_STREAM, goal);
    });
}

[[noreturn]] void runDatagrams(const QString &address, const Place &goal, int perSecond)
{
    const int descriptor = socketFrom(address, SOCK_DGRAM, goal);
    const QByteArray datagram(64, '\x11');
    repeat(perSecond, [&] { ::send(descriptor, datagram.data(), std::size_t(datagram.size()), MSG_NOSIGNAL); });
}

// ---- the measurement ----

class Measurement
{
public:
    Measurement(const QString &keys, const QString &address, const QString &foe)
        : m_keys(keys)
        , m_address(address)
        , m_foe(foe)
        , m_master({"master", keys, address})
        , m_place(m_master.next("listens").at(0))
    {
        startNode();
    }

    /// \param kind  of the garbage: "hello" or "text"
    void connections(int garbage, int silent, int friends, const QString &kind)
    {
        const Child flood({"connections", m_foe, m_place, QString::number(garbage), QString::number(silent), kind});
        pass(3000);  // longer than a master is patient
        m_master.next("figures");
        const qint64 before = m_master.next("figures").at(3).toLongLong();
        constexpr int seconds = 5;
        qint64 after = 0;
        for (int second = 0; second < seconds; ++second)
            after = m_master.next("figures").at(3).toLongLong();
        tell(QStringLiteral("the event loop of the master works for %1 % of the time")
                 .arg(double(after - before) / 1e4 / seconds, 0, 'f', 1));
        std::vector<double> operators;
        std::vector<double> nodes;
        for (int i = 0; i < friends; ++i) {
            operators.push_back(greet());
            nodes.push_back(startNode());
        }
        show("operator: connected, authenticated and greeted", operators, "ms");
        show("node: process started and registered", nodes, "ms");
    }

    void datagrams(int perSecond, int rounds, int seconds)
    {
        QUdpSocket other;  // nobody reads it
        other.bind(QHostAddress(m_address), 0);
        const QString otherPlace = QStringLiteral("%1:%2").arg(m_address).arg(other.localPort());
        for (int round = 0; round < rounds; ++round) {
            for (const bool isOwn : {round % 2 == 0, round % 2 != 0}) {
                const Child flood({"datagrams", m_foe, isOwn ? m_place : otherPlace, QString::number(perSecond)});
                m_master.next("figures");
                const QStringList before = m_master.next("figures");
                QStringList after;
                for (int second = 0; second < seconds; ++second)
                    after = m_master.next("figures");
                const auto grown = [&](int i) { return after.at(i).toLongLong() - before.at(i).toLongLong(); };
                tell(QStringLiteral("datagrams to %1: %2 late answers in %3 cycles, %4 datagrams kept off in a second")
                         .arg(isOwn ? "the master" : "another port")
                         .arg(grown(0))
                         .arg(grown(1))
                         .arg(grown(2) / seconds));
            }
        }
    }

private:
    /// \return how long it took [ms]
    double greet()
    {
        const qint64 begin = now();
        Tool person(QStringLiteral("operator"), m_keys, QPlcUnderlyingProtocol::fromString(m_place));
        bool isGreeted = false;
        person.onMessage = [&](const QPlcMessage &) { isGreeted = true; };
        while (!isGreeted)
            QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
        return double(now() - begin) * 1e-6;
    }
    double startNode()
    {
        m_node.reset();
        const qint64 begin = now();
        m_node = std::make_unique<Child>(QStringList{"node", m_keys, m_place});
        m_node->next("registered");
        return double(now() - begin) * 1e-6;
    }

    const QString m_keys;
    const QString m_address;
    const QString m_foe;
    Child m_master;
    const QString m_place;
    std::unique_ptr<Child> m_node;
};

int runAll(const QCoreApplication &application)
{
    QCommandLineParser parser;
    const auto option = [&parser](const char *name, const char *preset) {
        parser.addOption({QLatin1String(name), {}, QStringLiteral("value"), QLatin1String(preset)});
    };
    option("master", "127.0.0.1");
    option("foe", "127.0.0.2");
    option("garbage", "1000");
    option("silent", "200");
    option("friends", "20");
    option("datagrams", "100000");
    option("rounds", "3");
    option("seconds", "10");
    parser.addOption({QStringLiteral("hello"), {}});
    parser.addHelpOption();
    parser.process(application);
    const auto number = [&parser](const char *name) { return parser.value(QLatin1String(name)).toInt(); };
    const QTemporaryDir folder;
    Measurement measurement(makeKeys(folder, {{"operator", "Operator"}, {"Echo", "Node"}}),
                            parser.value(QStringLiteral("master")), parser.value(QStringLiteral("foe")));
    measurement.connections(number("garbage"), number("silent"), number("friends"),
                            parser.isSet(QStringLiteral("hello")) ? QStringLiteral("hello") : QStringLiteral("text"));
    measurement.datagrams(number("datagrams"), number("rounds"), number("seconds"));
    return 0;
}

}  // namespace

int main(int argc, char **argv)
{
    QCoreApplication application(argc, argv);
    const QStringList arguments = QCoreApplication::arguments();
    const auto number = [&arguments](int i) { return arguments.value(i).toInt(); };
    if (arguments.value(1) == QLatin1String("master"))
        return runMaster(arguments.at(2), arguments.at(3));
    if (arguments.value(1) == QLatin1String("node"))
        return runNode(arguments.at(2), Place(arguments.at(3)));
    if (arguments.value(1) == QLatin1String("connections"))
        runConnections(arguments.at(2), Place(arguments.at(3)), number(4), number(5), arguments.at(6));
    if (arguments.value(1) == QLatin1String("datagrams"))
        runDatagrams(arguments.at(2), Place(arguments.at(3)), number(4));
    return runAll(application);
}
