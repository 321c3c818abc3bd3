// SPDX-License-Identifier: Apache-2.0
#include "QPlcEmbeddedMaster.h"

#include "OwnApplication.h"
#include "realtime/BlockedSignals.h"

#include <QtCore/QEventLoop>
#include <QtCore/QTimer>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <future>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

using namespace std::chrono_literals;
using StepResult = QPlcMasterNode::StepResult;

namespace {

/// Handles events until something is reached, or the time is over. In the thread of the master.
class Patience
{
public:
    explicit Patience(std::chrono::milliseconds longest)
    {
        m_end.setSingleShot(true);
        m_end.setTimerType(Qt::PreciseTimer);
        m_end.start(longest);
    }
    template<typename IsReached>
    bool waitFor(IsReached isReached)
    {
        QEventLoop loop;
        while (!isReached() && m_end.isActive())
            loop.processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
        return isReached();
    }

private:
    QTimer m_end;
};

}  // namespace

struct QPlcEmbeddedMaster::Private
{
    class Living;

    void run(std::promise<void> &isReady);
    void end();
    using Phase = bool (Private::*)(Patience &patience, QString *reason);
    bool begin(const char *what, std::chrono::milliseconds longest, const QStringList &nodes, Phase phase);
    bool settle(Patience &patience, QString *reason);
    bool initialize(Patience &patience, QString *reason);
    bool start(Patience &patience, QString *reason);
    QString missing(const QStringList &nodes) const;
    void setError(const QString &text);

    std::optional<qplc::OwnApplication> application{std::in_place};
    std::thread thread;
    std::atomic<bool> hasEnded{false};

    // in the thread
    QObject *context = nullptr;  // receives what is called
    QEventLoop *loop = nullptr;
    QPlcMasterNode *master = nullptr;
    std::vector<std::shared_ptr<QPlcSlaveNode>> nodes;

    mutable std::mutex mutex;
    QString error;  // guarded by mutex
};

/// Those that exist. A program may end, or unload this library, without having destroyed them:
/// their threads have to end before what they use does.
class QPlcEmbeddedMaster::Private::Living
{
public:
    static Living &instance()
    {
        static Living living;
        return living;
    }
    /// They end at the end of the program. To be called when what they use has been made: that is
    /// destroyed later.
    static bool endAtExit()
    {
        return std::atexit([] {
                   for (Private *one : instance().m_all)
                       one->end();
               })
            == 0;
    }
    void add(Private *one)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_all.push_back(one);
    }
    void remove(Private *one)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_all.erase(std::remove(m_all.begin(), m_all.end(), one), m_all.end());
    }

private:
    Living() = default;

    std::mutex m_mutex;
    std::vector<Private *> m_all;
};

void QPlcEmbeddedMaster::Private::end()
{
    if (hasEnded.exchange(true))
        return;
    QMetaObject::invokeMethod(
        context, [this] { loop->quit(); }, Qt::QueuedConnection);
    if (std::this_thread::get_id() == thread.get_id())
        thread.detach();  // the program ends in a function of call()
    else
        thread.join();
    application.reset();
}

void QPlcEmbeddedMaster::Private::run(std::promise<void> &isReady)
{
    QEventLoop ownLoop;
    QObject ownContext;
    QPlcMasterNode ownMaster;
    loop = &ownLoop;
    context = &ownContext;
    master = &ownMaster;
    master->setClock(QPlcClock::external());
    QObject::connect(master, &QPlcMasterNode::errorOccurred, master, [this] { setError(master->errorString()); });
    QMetaObject::invokeMethod(
        context, [&isReady] { isReady.set_value(); }, Qt::QueuedConnection);
    ownLoop.exec();
    master->stopServer();  // ends the cycles, also those of a safe stop
    nodes.clear();
}

void QPlcEmbeddedMaster::Private::setError(const QString &text)
{
    const std::lock_guard<std::mutex> lock(mutex);
    error = text;
}

/// Which nodes a start waits for, and why; empty: none.
QString QPlcEmbeddedMaster::Private::missing(const QStringList &names) const
{
    QStringList absent = names;
    const QVector<QPlcNodeInfo> present = master->nodes();
    for (const QPlcNodeInfo &node : present)
        absent.removeAll(node.name);
    QStringList sentences;
    if (!absent.isEmpty())
        sentences << QStringLiteral("no node '%1' has connected to port %2; start it")
                         .arg(absent.join(QStringLiteral("', '")))
                         .arg(master->serverPort());
    if (!master->missingNodes().isEmpty())
        sentences << master->missingNodes();
    return sentences.join(QStringLiteral("; "));
}

bool QPlcEmbeddedMaster::Private::settle(Patience &patience, QString *reason)
{
    const bool isSettled = patience.waitFor([this] { return master->state() != QPlcMasterNode::Initializing; });
    if (!isSettled)
        *reason = QStringLiteral("the nodes did not answer in time");
    return isSettled;
}

bool QPlcEmbeddedMaster::Private::initialize(Patience &patience, QString *reason)
{
    const bool hasBegun = master->initializeAllStates();
    if (!settle(patience, reason))
        return false;
    *reason = master->errorString();
    return hasBegun && master->state() == QPlcMasterNode::Ready;
}

bool QPlcEmbeddedMaster::Private::start(Patience &patience, QString *reason)
{
    if (master->isArmingRequired()) {
        const bool isReady = master->state() == QPlcMasterNode::Ready || initialize(patience, reason);
        if (!isReady || !master->arm())
            return false;
    }
    const bool hasBegun = master->startRealTime();
    if (!settle(patience, reason))
        return false;
    *reason = master->errorString();
    return hasBegun && (master->state() == QPlcMasterNode::RealTime || master->state() == QPlcMasterNode::SafeStop);
}

/// In the thread of the master. \param what  "start"
bool QPlcEmbeddedMaster::Private::begin(const char *what, std::chrono::milliseconds longest, const QStringList &names,
                                        Phase phase)
{
    if (longest < 1ms || longest > 24h) {
        setError(QStringLiteral("to %1 within %2 s is out of range; use 0.001 ... 86400 s")
                     .arg(QLatin1String(what))
                     .arg(double(longest.count()) * 1e-3));
        return false;
    }
    Patience patience(longest);
    QString reason;
    if (!patience.waitFor([&] { return missing(names).isEmpty(); }))
        reason = missing(names);
    else if ((this->*phase)(patience, &reason)) {
        setError({});
        return true;
    }
    master->stop();
    setError(QStringLiteral("the plant did not %1 within %2 s: %3")
                 .arg(QLatin1String(what))
                 .arg(double(longest.count()) * 1e-3)
                 .arg(reason.isEmpty() ? master->stateReason() : reason));
    return false;
}

QPlcEmbeddedMaster::QPlcEmbeddedMaster()
    : d(std::make_unique<Private>())
{
    std::promise<void> isReady;
    {
        const qplc::BlockedSignals blocked;
        d->thread = std::thread([this, &isReady] { d->run(isReady); });
    }
    isReady.get_future().wait();
    Private::Living::instance().add(d.get());
    static const bool isKnown = Private::Living::endAtExit();
    Q_UNUSED(isKnown)
}

QPlcEmbeddedMaster::~QPlcEmbeddedMaster()
{
    if (!d->hasEnded)
        Private::Living::instance().remove(d.get());
    d->end();
}

bool QPlcEmbeddedMaster::call(const std::function<void(QPlcMasterNode &)> &code)
{
    Q_ASSERT_X(std::this_thread::get_id() != d->thread.get_id(), "QPlcEmbeddedMaster::call",
               "a thread cannot wait for itself: use the master that call() was given");
    if (d->hasEnded)
        return false;
    std::promise<QString> promise;
    const auto run = [&] {
        QString fault;
        try {
            code(*d->master);
        } catch (const std::exception &exception) {
            fault = QStringLiteral("the function of call() threw: %1").arg(QString::fromLocal8Bit(exception.what()));
        } catch (...) {
            fault = QStringLiteral("the function of call() threw something that is no std::exception");
        }
        if (!fault.isEmpty())
            d->setError(fault);
        promise.set_value(fault);
    };
    QMetaObject::invokeMethod(d->context, run, Qt::QueuedConnection);
    return promise.get_future().get().isEmpty();
}

bool QPlcEmbeddedMaster::add(const std::shared_ptr<QPlcSlaveNode> &node)
{
    bool isAdded = false;
    call([&](QPlcMasterNode &master) {
        d->nodes.push_back(node);
        isAdded = master.addLocalNode(node.get());
    });
    return isAdded;
}

bool QPlcEmbeddedMaster::initialize(std::chrono::milliseconds longest, const QStringList &nodes)
{
    bool hasBegun = false;
    return call([&](QPlcMasterNode &) { hasBegun = d->begin("initialize", longest, nodes, &Private::initialize); })
        && hasBegun;
}

bool QPlcEmbeddedMaster::start(std::chrono::milliseconds longest, const QStringList &nodes)
{
    bool hasBegun = false;
    if (!call([&](QPlcMasterNode &) { hasBegun = d->begin("start", longest, nodes, &Private::start); }) || !hasBegun)
        return false;
    static const bool isKnown = Private::Living::endAtExit();  // of what a start has made, too
    Q_UNUSED(isKnown)
    return true;
}

StepResult QPlcEmbeddedMaster::step(int periods)
{
    Q_ASSERT_X(periods > 0, "QPlcEmbeddedMaster::step", "time advances by 1 period or more");
    bool isLate = false;
    StepResult result = StepResult::Stopped;
    for (int i = 0; i < periods && !d->hasEnded; ++i) {
        result = d->master->step();
        if (result != StepResult::Complete && result != StepResult::Late)
            return result;
        isLate = isLate || result == StepResult::Late;
    }
    return isLate ? StepResult::Late : result;
}

void QPlcEmbeddedMaster::stop()
{
    call([](QPlcMasterNode &master) { master.stop(); });
}

QString QPlcEmbeddedMaster::errorString() const
{
    const std::lock_guard<std::mutex> lock(d->mutex);
    return d->error;
}
