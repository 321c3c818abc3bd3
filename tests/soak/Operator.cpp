// SPDX-License-Identifier: Apache-2.0
#include "Operator.h"

#include "SoakPlant.h"
#include "realtime/TimeSource.h"

#include <QtCore/QEventLoop>
#include <QtCore/QTimer>

#include <algorithm>

namespace messages = qplc::messages;
using messages::MasterState;

namespace soak {

namespace {

constexpr int LongestWithoutNews = 100;  // [ms]
constexpr int LongestStop = 1000;        // [ms]

int registeredIn(const messages::State &state)
{
    return state.nodes.size() - 1;  // the recorder is one
}

int runningIn(const messages::State &state)
{
    return int(std::count_if(state.nodes.begin(), state.nodes.end(),
                             [](const QPlcNodeInfo &node) { return node.state == QLatin1String("RealTime"); }));
}

/// Whether all nodes take part in the cycles: a node that joins has registered, and its answers may
/// be under way for seconds.
bool areAllRunning(const messages::State &state)
{
    return state.state == MasterState::RealTime && runningIn(state) == state.nodes.size();
}

}  // namespace

Operator::Operator(HistoryWriter &history, int nodes)
    : m_history(history)
    , m_nodes(nodes)
{
}

void Operator::useMaster(const QPlcUnderlyingProtocol &master)
{
    m_master = master;
    m_formerId = 0;
    m_client.reset();
}

int Operator::idOf(const messages::State &state, int node)
{
    for (const QPlcNodeInfo &info : state.nodes) {
        if (info.name == nodeName(node))
            return info.id;
    }
    return 0;
}

void Operator::expectAnother(int node)
{
    messages::State state;
    m_formerNode = node;
    m_formerId = ask(messages::GetState(), &state) ? idOf(state, node) : 0;
}

void Operator::wait(int milliseconds)
{
    QEventLoop loop;
    QTimer::singleShot(milliseconds, Qt::PreciseTimer, &loop, &QEventLoop::quit);
    loop.exec();
}

void Operator::waitForNews()
{
    wait(10 + m_nodes / 4);  // the state has a part for each node: it is work for the master
    if (m_hasNews || !m_client || m_client->error() != tools::BlockingClient::NoError)
        return;
    QEventLoop loop;
    QObject::connect(&m_client->control(), &qplc::ControlClient::unasked, &loop, &QEventLoop::quit);
    QObject::connect(m_client.get(), &tools::BlockingClient::lost, &loop, &QEventLoop::quit);
    QTimer::singleShot(LongestWithoutNews, Qt::PreciseTimer, &loop, &QEventLoop::quit);
    loop.exec();
}

qint64 Operator::now()
{
    return qplc::monotonicNow() / 1'000'000;
}

void Operator::start(const messages::State &state)
{
    messages::StartRealTime wish;
    if (state.armingRequired) {  // permits are given in Ready
        messages::Armed armed;
        if ((state.state == MasterState::Off && !ask(messages::InitializeAllStates())) || !ask(messages::Arm(), &armed))
            return;
        wish.token = armed.token;
    }
    ask(wish);
}

bool Operator::waitForNodes(int count, int patience)
{
    const qint64 end = now() + patience;
    messages::State state;
    while (now() < end) {
        m_hasNews = false;
        if (ask(messages::GetState(), &state) && registeredIn(state) >= count)
            return true;
        waitForNews();
    }
    m_errorString = QStringLiteral("%1 of the first %2 nodes have registered").arg(registeredIn(state)).arg(count);
    return false;
}

tools::BlockingClient &Operator::client()
{
    if (!m_client || m_client->error() != tools::BlockingClient::NoError) {
        m_client = std::make_unique<tools::BlockingClient>(std::chrono::seconds(3));
        m_client->control().offer(messages::feature::events);
        QObject::connect(&m_client->control(), &qplc::ControlClient::unasked, m_client.get(),
                         [this] { m_hasNews = true; });
        m_client->connectToMaster(m_master);
    }
    return *m_client;
}

bool Operator::areAllThere(const messages::State &state) const
{
    return registeredIn(state) >= m_nodes && (m_formerId == 0 || idOf(state, m_formerNode) != m_formerId);
}

bool Operator::isRunning()
{
    messages::State state;
    return ask(messages::GetState(), &state) && areAllThere(state) && areAllRunning(state);
}

bool Operator::goOn()
{
    messages::State state;
    if (!ask(messages::GetState(), &state))
        return false;
    m_errorString = QStringLiteral("the master is in %1; %2 of %3 nodes are there, %4 of all %5 take part in cycles")
                        .arg(messages::nameOf(state.state))
                        .arg(registeredIn(state))
                        .arg(m_nodes)
                        .arg(runningIn(state))
                        .arg(state.nodes.size());
    if (!areAllThere(state))
        return false;
    resetOrStart(state);
    return areAllRunning(state);
}

void Operator::resetOrStart(const messages::State &state)
{
    if (messages::isLatched(state.state))
        ask(messages::Reset{state.latch});
    if (state.state == MasterState::Off || state.state == MasterState::Ready) {
        m_history.append(Record::Command, -1);
        start(state);
    }
}

void Operator::tryToStart()
{
    messages::State state;
    for (int steps = 2; steps > 0 && ask(messages::GetState(), &state); --steps)
        resetOrStart(state);
}

void Operator::tryToStartWithout(int node)
{
    const qint64 end = now() + LongestStop;
    messages::State state;
    while (now() < end && (!ask(messages::GetState(), &state) || state.state != MasterState::Off)) {
        if (messages::isLatched(state.state))
            ask(messages::Reset{state.latch});
        else
            ask(messages::Stop());
        wait(10);
    }
    const auto tryTo = [&](const auto &wish) {
        const bool isRefused = !ask(wish);
        const bool isNamed = m_errorString.contains(QStringLiteral("'%1'").arg(nodeName(node)));
        m_history.append(Record::Tried, node, {isRefused, isNamed});
    };
    tryTo(messages::InitializeAllStates());
    tryTo(messages::StartRealTime());
}

bool Operator::evict(int node)
{
    expectAnother(node);
    if (ask(messages::Evict{nodeName(node)})) {
        m_history.append(Record::Evicted, node);
        return true;
    }
    m_formerId = 0;
    return false;
}

void Operator::admit(int node)
{
    m_history.append(Record::Admitted, node);
    ask(messages::Admit{nodeName(node)});  // a master that was started again keeps nobody out
}

bool Operator::bringToRealTime(int patience)
{
    const qint64 end = now() + patience;
    while (now() < end) {
        m_hasNews = false;
        if (goOn())
            return true;
        waitForNews();
    }
    return false;
}

bool Operator::stop()
{
    return ask(messages::Stop());
}

bool Operator::sees(const QString &name)
{
    messages::State state;
    return ask(messages::GetState(), &state)
        && std::any_of(state.nodes.begin(), state.nodes.end(),
                       [&](const QPlcNodeInfo &info) { return info.name == name; });
}

QStringList Operator::datagramAddresses()
{
    messages::State state;
    QStringList addresses;
    if (!ask(messages::GetState(), &state))
        return addresses;
    for (const QPlcNodeInfo &info : state.nodes) {
        if (info.transport == QLatin1String("udp"))
            addresses << info.address;
    }
    return addresses;
}

}  // namespace soak
