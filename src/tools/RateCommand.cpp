// SPDX-License-Identifier: Apache-2.0
// hz: the rate of the cycle, and its evenness, as a listener hears it.
#include "Commands.h"
#include "HistogramText.h"
#include "RateStatistics.h"
#include "TerminalText.h"
#include "node/state/StateText.h"
#include "realtime/SpscRing.h"
#include "realtime/TimeSource.h"

#include <QtCore/QTimer>

#include <cmath>

namespace tools {

namespace messages = qplc::messages;

namespace {

/// A listener without signals: notes when each cycle comes.
class CycleEar : public QPlcCompactSlaveNode
{
public:
    CycleEar()
        : QPlcCompactSlaveNode(QStringLiteral("qtplc-hz-%1").arg(QCoreApplication::applicationPid()),
                               SilentZeroOrderHold)
    {
        setListener(true);
    }
    ~CycleEar() override { disconnectFromMaster(); }

    bool pop(Arrival *arrival) { return m_arrivals.pop(arrival); }

protected:
    void step(const QPlcCycle &cycle) override { m_arrivals.push({cycle.number(), qplc::monotonicNow()}); }

private:
    qplc::SpscRing<Arrival> m_arrivals{65536};
};

quint64 skippedCycles(const messages::State &state)
{
    QPlcMasterStatistics counters;
    messages::setCounters(state.counters, &counters);
    return counters.skippedCycles;
}

double periodOf(const messages::State &state)  // [s]
{
    return double(state.period.count()) * 1e-9;
}

void print(const RateStatistics &rate, const messages::State &state, quint64 skipped)
{
    const auto field = [](const char *label, const QString &value) {
        printLine(QStringLiteral("%1%2").arg(QString::fromLatin1(label), -10).arg(value));
    };
    field("cycles", QStringLiteral("%1 in %2 s").arg(rate.cycles()).arg(rate.duration(), 0, 'f', 3));
    field("rate",
          QStringLiteral("%1 Hz (%2, period %3 ms)")
              .arg(rate.rate(), 0, 'f', 3)
              .arg(qplc::stateText(state.clock))
              .arg(periodOf(state) * 1e3));
    field("interval",
          QStringLiteral("mean %1, min %2, max %3, standard deviation %4")
              .arg(durationText(rate.mean()), durationText(rate.minimum()), durationText(rate.maximum()),
                   durationText(rate.deviation())));
    field("lost",
          rate.lost() == 0 ? QStringLiteral("0")
                           : QStringLiteral("%1 (cycles %2), of them skipped by the master: %3")
                                 .arg(rate.lost())
                                 .arg(rate.gapsText())
                                 .arg(skipped));
}

void printAsJson(const RateStatistics &rate, const messages::State &state, quint64 skipped)
{
    const QJsonObject interval{{QStringLiteral("count"), double(rate.intervals())},
                               {QStringLiteral("mean"), rate.mean()},
                               {QStringLiteral("minimum"), rate.minimum()},
                               {QStringLiteral("maximum"), rate.maximum()},
                               {QStringLiteral("std"), rate.deviation()}};
    printJson(QJsonDocument(QJsonObject{{QStringLiteral("cycles"), double(rate.cycles())},
                                        {QStringLiteral("duration"), rate.duration()},
                                        {QStringLiteral("rate"), rate.rate()},
                                        {QStringLiteral("clock"), QLatin1String(messages::nameOf(state.clock))},
                                        {QStringLiteral("period"), periodOf(state)},
                                        {QStringLiteral("interval"), interval},
                                        {QStringLiteral("lost"), double(rate.lost())},
                                        {QStringLiteral("lostCycles"), rate.gaps()},
                                        {QStringLiteral("skippedByMaster"), double(skipped)}}));
}

/// Listens for a time. \return false when the master was lost meanwhile
bool listen(CycleEar &ear, double seconds, RateStatistics *rate)
{
    constexpr int drainPause = 20;  // [ms], the ring holds far more
    QTimer drain;
    const auto takeAll = [&ear, rate] {
        for (Arrival arrival; ear.pop(&arrival);)
            rate->add(arrival);
    };
    QObject::connect(&drain, &QTimer::timeout, takeAll);
    // Queued: the node says goodbye when the event loop ends, too, and who ends a loop that has
    // ended ends all later ones.
    QObject::connect(
        &ear, &QPlcSlaveNode::disconnectedFromMaster, &drain,
        [] { QCoreApplication::exit(QPlcCoreApplication::Failure); }, Qt::QueuedConnection);
    drain.start(drainPause);
    QTimer::singleShot(std::chrono::milliseconds(std::llround(seconds * 1e3)), Qt::PreciseTimer, &drain,
                       [] { QCoreApplication::quit(); });
    const bool isSound = QCoreApplication::exec() == QPlcCoreApplication::Success;
    takeAll();
    return isSound;
}

}  // namespace

int measureRate(const CommandCall &call)
{
    double seconds = 3.0;
    messages::State before;
    messages::State after;
    if (!call.readNumber("for", 0.01, 1e6, &seconds) || !call.connect() || !call.ask(messages::GetState(), &before))
        return call.exitCode();
    if (!messages::hasCycles(before.state)) {
        QPlcCoreApplication::printError(
            QStringLiteral("the master is in state %1 and has no cycles; start it: qtplc start")
                .arg(qplc::stateText(before.state)));
        return QPlcCoreApplication::Failure;
    }
    const auto endIsWanted = call.quitOnSignals();
    CycleEar ear;
    ear.setReconnectPolicy(QPlcSlaveNode::NeverReconnect);
    RateStatistics rate;
    if (!ear.connectToMasterAndWaitForConnected(call.master, call.client.timeout()))
        return QPlcCoreApplication::Failure;  // the node has said why
    if (!*endIsWanted && !listen(ear, seconds, &rate)) {
        QPlcCoreApplication::printError(QStringLiteral("the master has ended during the measurement"));
        return QPlcCoreApplication::Failure;
    }
    if (!call.ask(messages::GetState(), &after))
        return call.exitCode();
    if (rate.cycles() < 2) {
        QPlcCoreApplication::printError(
            QStringLiteral("%1 cycles came in %2 s; measure longer with --for").arg(rate.cycles()).arg(seconds));
        return QPlcCoreApplication::Failure;
    }
    const quint64 skippedBefore = skippedCycles(before);
    const quint64 skippedSoFar = skippedCycles(after);
    const quint64 skipped = skippedSoFar - (skippedSoFar >= skippedBefore ? skippedBefore : 0);  // 0: a new phase
    call.isJson() ? printAsJson(rate, after, skipped) : print(rate, after, skipped);
    return rate.lost() > 0 ? QPlcCoreApplication::Failure : QPlcCoreApplication::Success;
}

}  // namespace tools
