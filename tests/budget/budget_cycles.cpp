// SPDX-License-Identifier: Apache-2.0
// budget_cycles: a master, or a slave, of a fixed number of cycles, so that two lengths differ by
// nothing but cycles. budget.py starts it.
#include "BudgetNodes.h"

#include <QtCore/QEventLoop>
#include <QtCore/QJsonDocument>
#include <QtCore/QLoggingCategory>
#include <QtCore/QTimer>

#include <cstdio>

namespace {

void print(const QJsonObject &fields)
{
    std::puts(QJsonDocument(fields).toJson(QJsonDocument::Compact).constData());
    std::fflush(stdout);
}

int fail(const QString &text)
{
    QPlcCoreApplication::printError(text);
    return QPlcCoreApplication::Failure;
}

bool readOptions(QPlcCoreApplication &application, BudgetRun *run, QString *master, qint64 *index)
{
    const auto add = [&](const char *name, const char *value, const char *description) {
        application.addOption({QString::fromLatin1(name), QString::fromLatin1(description), QStringLiteral("VALUE"),
                               QString::fromLatin1(value)});
    };
    application.setDescription(QStringLiteral("A master or slave of a fixed number of cycles."));
    add("transport", "udp",
        "Master: udp, tcp, local, inprocess, or steps: in process, and the program turns the clock.");
    add("slaves", "1", "Master: number of slaves.");
    add("cycles", "1000", "Length of the phase.");
    add("period-us", "0", "Master: period [us]; 0: lockstep.");
    add("master", "", "Be a slave of the master with this address.");
    add("index", "0", "Slave: its number.");
    add("plant", "", "Slave: an extra allocation, lock, page-fault, system-call, or 1000 instructions in each cycle.");
    qint64 slaves = 0;
    qint64 cycles = 0;
    qint64 period = 0;
    if (!application.parseOptions() || !application.integer(QStringLiteral("slaves"), 1, 250, &slaves)
        || !application.integer(QStringLiteral("cycles"), 100, 100'000'000, &cycles)
        || !application.integer(QStringLiteral("period-us"), 0, 1'000'000, &period)
        || !application.integer(QStringLiteral("index"), 0, 249, index))
        return false;
    *run = {application.value(QStringLiteral("transport")), int(slaves), quint64(cycles), int(period),
            application.value(QStringLiteral("plant"))};
    *master = application.value(QStringLiteral("master"));
    return true;
}

int runSlave(QPlcCoreApplication &application, const BudgetRun &run, const QString &address, int index)
{
    QString error;
    const QPlcUnderlyingProtocol master
        = QPlcUnderlyingProtocol::fromString(address, QPlcUnderlyingProtocol::Udp, &error);
    if (!master.isValid())
        return fail(error);
    BudgetSlave slave(run, index);
    QObject::connect(&slave, &QPlcSlaveNode::disconnectedFromMaster, &application, &QCoreApplication::quit);
    if (!slave.connectToMasterAndWaitForConnected(master))
        return fail(slave.errorString());
    application.exec();
    print(slave.costs());
    return QPlcCoreApplication::Success;
}

/// Runs the event loop until \a signal of \a sender. \return false when it does not come
template<typename Sender, typename Signal>
bool waitFor(Sender *sender, Signal signal)
{
    constexpr std::chrono::seconds patience{100};  // valgrind makes everything fifty times slower
    QEventLoop loop;
    QTimer::singleShot(patience, &loop, [&loop] { loop.exit(1); });
    QObject::connect(sender, signal, &loop, &QEventLoop::quit);
    return loop.exec() == 0;
}

/// Turns the clock until the phase ends. \return false when a step was not complete
bool turn(QPlcMasterNode &master)
{
    while (master.state() == QPlcMasterNode::RealTime) {
        if (master.step() != QPlcMasterNode::StepResult::Complete)
            return false;
    }
    return true;
}

int runMaster(const BudgetRun &run)
{
    QPlcMasterNode master;
    master.setSignalTable(budgetTable(run.slaves));
    const bool isTurned = run.transport == QLatin1String("steps");
    master.setClock(isTurned               ? QPlcClock::external()
                        : run.periodUs > 0 ? QPlcClock::realTime()
                                           : QPlcClock::lockstep());
    if (run.periodUs > 0 && !master.setInterval(std::chrono::microseconds(run.periodUs)))
        return fail(master.errorString());
    master.setCycleLimit(run.cycles);
    BudgetProbe probe(run);
    master.addLocalNode(&probe);
    std::deque<BudgetSlave> slaves;  // in process
    const bool isInProcess = isTurned || run.transport == QLatin1String("inprocess");
    for (int i = 0; i < (isInProcess ? run.slaves : 0); ++i)
        master.addLocalNode(&slaves.emplace_back(run, i));
    if (!isInProcess && !master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)))
        return fail(master.errorString());
    print({{QStringLiteral("port"), master.serverPort()}});
    while (master.nodes().size() < run.slaves + 1) {
        if (!waitFor(&master, &QPlcMasterNode::nodeRegistered))
            return fail(QStringLiteral("only %1 of %2 slaves came").arg(master.nodes().size() - 1).arg(run.slaves));
    }
    if (!master.startRealTime() || !(isTurned ? turn(master) : waitFor(&master, &QPlcMasterNode::realTimeHasStopped)))
        return fail(QStringLiteral("the cycles did not end: %1").arg(master.errorString()));
    QJsonObject fields = isInProcess ? slaves.front().costs() : probe.costs();
    fields.insert(QStringLiteral("cycles"), double(master.statistics().cycles));
    print(fields);
    return QPlcCoreApplication::Success;
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    QLoggingCategory::setFilterRules(QStringLiteral("qtplc.*.info=false"));
    BudgetRun run;
    QString master;
    qint64 index = 0;
    if (!readOptions(application, &run, &master, &index))
        return application.exitCode();
    return master.isEmpty() ? runMaster(run) : runSlave(application, run, master, int(index));
}
