// SPDX-License-Identifier: Apache-2.0
#include "QPlcServiceNotifier.h"

#include "QPlcMasterNode.h"
#include "QPlcSlaveNodePrivate.h"
#include "node/Logging.h"
#include "node/cycle/CycleWatch.h"
#include "node/state/StateText.h"
#include "transport/NotifySocket.h"

#include <QtCore/QMetaEnum>
#include <QtCore/QTimer>

#include <functional>
#include <unistd.h>

using namespace std::chrono_literals;

namespace {

constexpr int looksPerTime = 4;  // a look that comes late, or finds a long cycle, is none that kills

/// What $WATCHDOG_USEC says, if it is meant for this process.
std::chrono::microseconds watchdogTimeOfEnvironment()
{
    const QByteArray process = qgetenv("WATCHDOG_PID");
    const qint64 time = qgetenv("WATCHDOG_USEC").toLongLong();
    const bool isForOthers = !process.isEmpty() && process.toLongLong() != ::getpid();
    return std::chrono::microseconds(isForOthers || time < 0 ? 0 : time);
}

template<typename State>
QString stateName(State state)
{
    return qplc::stateText(QLatin1String(QMetaEnum::fromType<State>().valueToKey(int(state))));
}

QString statusOf(const QPlcSlaveNode &node)
{
    const QString state = stateName(node.state());
    if (node.state() == QPlcSlaveNode::RealTime)
        return QStringLiteral("%1, %2 cycles").arg(state).arg(node.counters().cycles);
    return node.errorString().isEmpty() ? state : QStringLiteral("%1; %2").arg(state, node.errorString());
}

QString statusOf(const QPlcMasterNode &master)
{
    const QString text = QStringLiteral("%1, %2 nodes, port %3")
                             .arg(stateName(master.state()))
                             .arg(master.nodes().size())
                             .arg(master.serverPort());
    if (master.state() == QPlcMasterNode::RealTime)
        return QStringLiteral("%1, cycle %2").arg(text).arg(master.cycle());
    return master.stateReason().isEmpty() ? text : QStringLiteral("%1; %2").arg(text, master.stateReason());
}

/// For CycleWatch: 0 while the cycles need not go on.
quint64 markOf(const QPlcMasterNode &master)
{
    const bool runs = master.state() == QPlcMasterNode::RealTime || master.state() == QPlcMasterNode::SafeStop;
    return runs && master.clock().isTimed() ? master.cycle() + 1 : 0;
}

/// Three periods, in looks.
qint64 patienceOf(const QPlcMasterNode &master, std::chrono::microseconds look)
{
    const double scale = master.clock().isTimed() ? master.clock().scale() : 1.0;
    return look > 0us ? qint64(3.0 * double(master.interval() / 1us) / scale / double(look.count())) : 0;
}

}  // namespace

struct QPlcServiceNotifier::Private
{
    /// What is asked of master or node.
    struct Questions
    {
        std::function<QString()> status;
        std::function<quint64()> mark;
        std::function<qint64(std::chrono::microseconds look)> patience;
    };

    explicit Private(Questions questionsOf)
        : questions(std::move(questionsOf))
    {
    }
    std::chrono::microseconds lookInterval() const { return watchdogTime / looksPerTime; }
    void tell(const QByteArray &line);

    Questions questions;
    qplc::NotifySocket socket{qgetenv("NOTIFY_SOCKET")};
    std::chrono::microseconds watchdogTime = watchdogTimeOfEnvironment();
    qplc::CycleWatch watch;
    QTimer timer;
    bool isReady = false;
    bool hasFailed = false;
};

/// \a line and the status, in one datagram.
void QPlcServiceNotifier::Private::tell(const QByteArray &line)
{
    const QByteArray status = "STATUS=" + qplc::printable(questions.status()).toUtf8();
    const bool isSent = socket.send(line.isEmpty() ? status : line + '\n' + status);
    if (!isSent && !hasFailed)
        qCWarning(lcSlave, "cannot report the state to systemd: %s", qPrintable(socket.errorString()));
    hasFailed = !isSent;
}

QPlcServiceNotifier::QPlcServiceNotifier(QPlcSlaveNode &node, QObject *parent)
    : QPlcServiceNotifier(std::make_unique<Private>(
                              Private::Questions{[&node] { return statusOf(node); },
                                                 [&node] { return QPlcSlaveNodePrivate::of(node).cycleInProgress(); },
                                                 [](std::chrono::microseconds) { return qint64(0); }}),
                          parent)
{
    connect(&node, &QPlcSlaveNode::stateChanged, this, [this] { d->tell({}); });
}

QPlcServiceNotifier::QPlcServiceNotifier(QPlcMasterNode &master, QObject *parent)
    : QPlcServiceNotifier(std::make_unique<Private>(Private::Questions{
                              [&master] { return statusOf(master); }, [&master] { return markOf(master); },
                              [&master](std::chrono::microseconds look) { return patienceOf(master, look); }}),
                          parent)
{
    connect(&master, &QPlcMasterNode::stateChanged, this, [this] { d->tell({}); });
}

QPlcServiceNotifier::QPlcServiceNotifier(std::unique_ptr<Private> data, QObject *parent)
    : QObject(parent)
    , d(std::move(data))
{
    connect(&d->timer, &QTimer::timeout, this, &QPlcServiceNotifier::look);
    if (isWanted() && d->watchdogTime > 0us)
        d->timer.start(std::max<std::chrono::milliseconds>(
            1ms, std::chrono::duration_cast<std::chrono::milliseconds>(d->lookInterval())));
}

QPlcServiceNotifier::~QPlcServiceNotifier()
{
    d->socket.send("STOPPING=1");
}

bool QPlcServiceNotifier::isWanted() const
{
    return d->socket.isWanted();
}

std::chrono::microseconds QPlcServiceNotifier::watchdogTime() const
{
    return d->watchdogTime;
}

void QPlcServiceNotifier::setReady()
{
    if (!d->isReady)
        d->tell("READY=1");
    d->isReady = true;
}

void QPlcServiceNotifier::look()
{
    const bool goesOn = d->watch.look(d->questions.mark(), d->questions.patience(d->lookInterval()));
    d->tell(goesOn ? "WATCHDOG=1" : QByteArray());
}
