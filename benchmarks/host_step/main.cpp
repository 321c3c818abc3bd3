// SPDX-License-Identifier: Apache-2.0
// usage: host_step [ROUNDS]: steps with an FMU as a node, of a controller DLL, and of a master in a
// host, whose node is in the process or another program on UDP. The fastest round of each counts.
#include <QtPlcModels>

#include "models/FmuModel.h"

#include <QtCore/QLoggingCategory>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <dlfcn.h>
#include <limits>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

using namespace std::chrono_literals;

namespace {

constexpr int stepsOfRound = 2000;

std::runtime_error problem(const QString &text)
{
    return std::runtime_error(text.toStdString());
}

template<typename Step>
double nanosecondsOf(int count, Step step)
{
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < count; ++i)
        step();
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
    return spent.count() / count;
}

QPlcSignalTable table()
{
    return QPlcSignalTable::fromIni("[u]\ntype = Real64\n[x]\ntype = Real64\n[y]\ntype = Real64\n");
}

/// Copies u to a signal of the same type.
class Copy : public QPlcCompactSlaveNode
{
public:
    explicit Copy(const char *signal)
        : QPlcCompactSlaveNode(QStringLiteral("Copy"))
        , m_out(this, signal)
    {
    }
    ~Copy() override { disconnectFromMaster(); }

private:
    QPlcInput<double> m_in{this, "u"};
    QPlcOutput<double> m_out;
    void reset() override { m_out = 0.0; }
    void step(const QPlcCycle &) override { m_out = m_in; }
};

/// A node of the host.
class Giver : public QPlcCompactSlaveNode
{
public:
    Giver()
        : QPlcCompactSlaveNode(QStringLiteral("Giver"))
    {
    }
    ~Giver() override { disconnectFromMaster(); }
    QPlcOutput<double> u{this, "u"};

private:
    void step(const QPlcCycle &) override {}
};

// ---- an FMU as a node ----

double stepOfAFmu(int rounds)
{
    QString error;
    const std::unique_ptr<qplc::FmuModel> model = qplc::FmuModel::open(QStringLiteral(FMU), &error);
    if (!model || !model->load(&error))
        throw problem(error);
    double fastest = std::numeric_limits<double>::max();
    for (int round = 0; round < rounds; ++round) {
        model->reset();
        model->setStep(0.01);
        model->initialize();
        fastest = std::min(fastest, nanosecondsOf(stepsOfRound, [&] { model->doStep(); }));
        model->end();
    }
    return fastest;
}

double cycleWith(QPlcSlaveNode &node, int rounds)
{
    double fastest = std::numeric_limits<double>::max();
    QPlcMasterNode master;
    master.setSignalTable(table());
    master.setClock(QPlcClock::external());
    if (!master.addLocalNode(&node))
        throw problem(master.errorString());
    for (int round = 0; round < rounds; ++round) {
        if (!master.startRealTime())
            throw problem(master.errorString());
        bool isGood = true;
        fastest = std::min(fastest, nanosecondsOf(stepsOfRound, [&] {
                               isGood &= master.step() == QPlcMasterNode::StepResult::Complete;
                           }));
        if (!isGood)
            throw problem(master.errorString());
        master.stop();
    }
    return fastest;
}

// ---- a controller DLL ----

double callOfADll(int rounds)
{
    using Discon = void (*)(float *, int *, char *, char *, char *);
    void *library = ::dlopen(DISCON, RTLD_NOW | RTLD_LOCAL);
    const auto discon = library ? reinterpret_cast<Discon>(::dlsym(library, "DISCON")) : nullptr;
    if (!discon)
        throw problem(QString::fromLocal8Bit(::dlerror()));
    std::array<float, 200> records{};
    std::array<char, 400> message{};
    QByteArray file(RECORDS);
    int failure = 0;
    int number = 0;
    const auto call = [&](float status) {
        records[0] = status;
        records[1] = float(number++) * 0.0125F;
        discon(records.data(), &failure, file.data(), nullptr, message.data());
        if (failure != 0)
            throw problem(QString::fromUtf8(message.data()));
    };
    double fastest = std::numeric_limits<double>::max();
    for (int round = 0; round < rounds; ++round) {
        number = 0;
        records[2] = 0.0125F;
        records[19] = 100.0F;  // generator speed [rad/s]
        records[48] = float(message.size());
        records[49] = float(file.size());
        call(0.0F);
        fastest = std::min(fastest, nanosecondsOf(stepsOfRound, [&] { call(1.0F); }));
        call(-1.0F);
    }
    return fastest;
}

// ---- a master in a host ----

/// A host without an application of Qt, as it should be: its nodes are programs of their own.
double stepOfAHost(int rounds, bool isRemote, const char *program)
{
    QPlcEmbeddedMaster master;
    quint16 port = 0;
    master.call([&port](QPlcMasterNode &node) {
        node.setSignalTable(table());
        if (node.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)))
            port = node.serverPort();
    });
    Giver *giver = master.addNode<Giver>();
    if (!giver || (!isRemote && !master.addNode<Copy>("y")))
        throw problem(master.errorString());
    pid_t child = 0;
    if (isRemote) {
        const QByteArray address = "--master=udp://127.0.0.1:" + QByteArray::number(port);
        child = ::fork();
        if (child == 0) {
            ::execl(program, program, "node", address.constData(), nullptr);
            ::_exit(126);
        }
    }
    double fastest = std::numeric_limits<double>::max();
    bool isGood = master.start(20s, {QStringLiteral("Copy")});
    for (int round = 0; isGood && round < rounds; ++round)
        fastest = std::min(fastest, nanosecondsOf(stepsOfRound, [&] {
                               giver->u = giver->u + 1.0;
                               isGood &= master.step() == QPlcMasterNode::StepResult::Complete;
                           }));
    const QString error = master.errorString();
    master.call([](QPlcMasterNode &node) {
        node.stop();
        node.stopServer();  // the other program ends then
    });
    if (child > 0)
        ::waitpid(child, nullptr, 0);
    if (!isGood)
        throw problem(QStringLiteral("the host: %1").arg(error));
    return fastest;
}

int runNode(int argc, char **argv)
{
    QPlcNodeApplication application(argc, argv);
    application.addPositionalArgument(QStringLiteral("command"), QStringLiteral("The word 'node'."));
    if (!application.parseNodeOptions())
        return application.exitCode();
    Copy node("y");
    return application.run(node);
}

void measure(int rounds, const char *program)
{
    const double remote = stepOfAHost(rounds, true, program) / 1000;
    const double local = stepOfAHost(rounds, false, program) / 1000;
    const double call = callOfADll(rounds) / 1000;
    const double fmu = stepOfAFmu(rounds) / 1000;
    QPlcFmuNode node;
    if (!node.configureFromFile(QStringLiteral(FMU)))
        throw problem(QPlcParseError::toString(node.configurationErrors()));
    const double cycle = cycleWith(node, rounds) / 1000;
    Copy copy("x");
    const double usual = cycleWith(copy, rounds) / 1000;
    std::printf("{\"fmu_us\": %.4f, \"fmu_node_us\": %.4f, \"usual_node_us\": %.4f, \"fmu_above_us\": %.4f, "
                "\"discon_us\": %.4f, \"host_us\": %.4f, \"host_udp_us\": %.4f}\n",
                fmu, cycle, usual, cycle - fmu, call, local, remote);
}

}  // namespace

int main(int argc, char **argv)
{
    QLoggingCategory::setFilterRules(QStringLiteral("qtplc.*.info=false"));
    if (argc > 1 && QByteArray(argv[1]) == "node")
        return runNode(argc, argv);
    const QString given = QString::fromLocal8Bit(argc > 1 ? argv[1] : "50");
    const int rounds = given.toInt();
    if (rounds < 1) {
        std::fprintf(stderr, "'%s' rounds are not possible; use a number from 1\n", qPrintable(given));
        return 2;
    }
    const QPlcCoreApplication application(argc, argv);
    try {
        measure(rounds, "/proc/self/exe");
    } catch (const std::exception &failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return 1;
    }
    return 0;
}
