// SPDX-License-Identifier: Apache-2.0
#include "Operator.h"

#include "SoakPlant.h"
#include "realtime/TimeSource.h"

#include <QtCore/QEventLoop>
#include <QtCore/QTimer>

using Message = QPlcMessage;

namespace soak {

namespace {

int registeredIn(const Message &state)
{
    return state.fields().value(QStringLiteral("nodes")).toArray().size() - 1;  // the recorder is one
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

int Operator::idOf(const Message &state, int node)
{
    const QJsonArray nodes = state.fields().value(QStringLiteral("nodes")).toArray();
    for (const QJsonValue &value : nodes) {
        const QJsonObject fields = value.toObject();
        if (fields.value(QStringLiteral("name")).toString() == nodeName(node))
            return fields.value(QStringLiteral("id")).toInt();
    }
    return 0;
}

void Operator::expectAnother(int node)
{
    Message state;
    m_formerNode = node;
    m_formerId = ask(Message::GetState, &state) ? idOf(state, node) : 0;
}

void Operator::wait(int milliseconds)
{
    QEventLoop loop;
    QTimer::singleShot(milliseconds, Qt::PreciseTimer, &loop, &QEventLoop::quit);
    loop.exec();
}

qint64 Operator::now()
{
    return qplc::monotonicNow() / 1'000'000;
}

void Operator::start(const Message &state)
{
    QJsonObject fields;
    Message answer;
    if (state.fields().value(QStringLiteral("armingRequired")).toBool()) {  // permits are given in Ready
        if (state.text(QStringLiteral("state")) == QLatin1String("Off") && !ask(Message::InitializeAllStates, &answer))
            return;
        if (!ask(Message::Arm, &answer))
            return;
        fields.insert(QStringLiteral("token"), answer.text(QStringLiteral("token")));
    }
    ask(Message(Message::StartRealTime, fields), &answer);
}

bool Operator::waitForNodes(int count, int patience)
{
    const qint64 end = now() + patience;
    Message state;
    while (now() < end) {
        if (ask(Message::GetState, &state) && registeredIn(state) >= count)
            return true;
        wait(10 + m_nodes / 4);
    }
    m_errorString = QStringLiteral("%1 of the first %2 nodes have registered").arg(registeredIn(state)).arg(count);
    return false;
}

bool Operator::ask(const Message &request, Message *answer)
{
    if (!m_client || m_client->error() != tools::BlockingClient::NoError) {
        m_client = std::make_unique<tools::BlockingClient>(std::chrono::seconds(3));
        m_client->connectToMaster(m_master);
    }
    if (m_client->ask(request, answer))
        return true;
    m_errorString = QStringLiteral("%1: %2").arg(request.kindName(), m_client->errorString());
    return false;
}

bool Operator::areAllThere(const Message &state) const
{
    return registeredIn(state) >= m_nodes && (m_formerId == 0 || idOf(state, m_formerNode) != m_formerId);
}

bool Operator::isRunning()
{
    Message state;
    return ask(Message::GetState, &state) && areAllThere(state)
        && state.text(QStringLiteral("state")) == QLatin1String("RealTime");
}

bool Operator::goOn()
{
    Message state;
    if (!ask(Message::GetState, &state))
        return false;
    const QString name = state.text(QStringLiteral("state"));
    m_errorString = QStringLiteral("the master is in %1; %2 of %3 nodes are there")
                        .arg(name)
                        .arg(registeredIn(state))
                        .arg(m_nodes);
    if (!areAllThere(state))
        return false;
    if (name == QLatin1String("SafeStop") || name == QLatin1String("Fault"))
        ask(Message::Reset, &state);
    if (name == QLatin1String("Off") || name == QLatin1String("Ready")) {
        m_history.append(Record::Command, -1);
        start(state);
    }
    return name == QLatin1String("RealTime");
}

bool Operator::bringToRealTime(int patience)
{
    const qint64 end = now() + patience;
    while (now() < end) {
        if (goOn())
            return true;
        wait(10 + m_nodes / 4);  // the answer has a part for each node: it is work for the master
    }
    return false;
}

bool Operator::stop()
{
    Message done;
    return ask(Message::Stop, &done);
}

QStringList Operator::datagramAddresses()
{
    Message state;
    QStringList addresses;
    if (!ask(Message::GetState, &state))
        return addresses;
    const QJsonArray nodes = state.fields().value(QStringLiteral("nodes")).toArray();
    for (const QJsonValue &node : nodes) {
        const QJsonObject fields = node.toObject();
        if (fields.value(QStringLiteral("transport")).toString() == QLatin1String("udp"))
            addresses << fields.value(QStringLiteral("address")).toString();
    }
    return addresses;
}

}  // namespace soak
