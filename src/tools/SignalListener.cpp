// SPDX-License-Identifier: Apache-2.0
#include "SignalListener.h"

#include "SignalSelection.h"
#include "signals/PayloadLayout.h"

#include <QtCore/QPointer>

namespace tools {

namespace messages = qplc::messages;

SignalListener::SignalListener(const CommandCall &call, const QString &purpose, const QPlcSignalTable &table,
                               const QStringList &names, int pause)
    : m_call(call)
    , m_names(names)
    , m_node(QStringLiteral("qtplc-%1-%2").arg(purpose).arg(QCoreApplication::applicationPid()))
{
    QPlcSignalIndexTable::setCurrent(table);
    QPlcSignalIndexList indices;
    for (const QString &name : names) {
        indices.insert(name);
        m_definitions << table.at(table.indexOf(name));
    }
    const QVector<QPlcSignalIndex> inputs = indices.toVector();
    const qplc::PayloadLayout layout(table, inputs);
    for (const QPlcSignalDefinition &definition : qAsConst(m_definitions)) {
        m_places << inputs.indexOf(table.indexOf(definition.name));
        m_offsets << int(layout.fields()[std::size_t(m_places.last())].offset);
    }
    m_node.setReconnectPolicy(QPlcSlaveNode::NeverReconnect);
    m_node.setInputSignalIndices(indices);
    m_node.setBufferSize(10000);
    m_timer.setTimerType(Qt::PreciseTimer);
    m_timer.setInterval(pause);
    connect(&m_timer, &QTimer::timeout, this, [this] { takeCycles(); });
    connect(&m_node, &QPlcSlaveNode::realTimeHasStarted, this, [this] {
        m_isRunning = true;
        askForState();
    });
    connect(&m_node, &QPlcSlaveNode::realTimeHasStopped, this, [this] {
        m_isRunning = false;
        askForState();
    });
    connect(&m_node, &QPlcSlaveNode::disconnectedFromMaster, this, [this] {
        // When the master was lost, and did not just end, the error follows.
        QMetaObject::invokeMethod(this, &SignalListener::masterEnded, Qt::QueuedConnection);
    });
}

SignalListener::~SignalListener()
{
    m_node.disconnect(this);
}

QJsonObject SignalListener::toJson(const QVector<QPlcValue> &values) const
{
    QJsonObject object;
    for (int i = 0; i < m_names.size(); ++i)
        object.insert(m_names.at(i), tools::toJson(values.at(i)));
    return object;
}

void SignalListener::handleState(const messages::State &state)
{
    m_period = double(state.period.count()) * 1e-9;
    m_state = state.state;
    m_isRunning = messages::hasCycles(m_state);
    if (!m_isRunning && m_node.state() != QPlcSlaveNode::Disconnected)
        askForValues();
}

void SignalListener::handleValues(const messages::Signals &answer)
{
    if (m_isRunning || int(answer.signals.size()) < m_definitions.size())
        return;
    QVector<QPlcValue> values;
    QVector<QPlcQuality> qualities;
    for (int i = 0; i < m_definitions.size(); ++i) {
        const messages::SignalEntry &entry = answer.signals[std::size_t(i)];
        values << QPlcValue::fromString(m_definitions.at(i).type, entry.value);
        qualities << QPlcQuality::fromByte(entry.quality);
    }
    Q_EMIT valuesAtRest(values, qualities);
}

bool SignalListener::join()
{
    m_timer.start();
    if (!m_node.connectToMasterAndWaitForConnected(m_call.master, m_call.client.timeout()))  // says why not
        return false;
    askForState();  // a phase may have ended meanwhile
    return true;
}

/// A refusal, and a master that is lost, are left to the node.
template<typename Request, typename Answer>
void SignalListener::ask(const Request &request, void (SignalListener::*take)(const Answer &))
{
    const auto pass = [listener = QPointer(this), take](const qplc::ControlClient::Reply<Request> &reply) {
        const auto *answer = std::get_if<Answer>(&reply);
        if (answer && listener)
            (listener->*take)(*answer);
    };
    m_call.client.control().request(request, pass);
}

void SignalListener::askForState()
{
    ask(messages::GetState(), &SignalListener::handleState);
}

void SignalListener::askForValues()
{
    ask(question(), &SignalListener::handleValues);
}

void SignalListener::takeCycles()
{
    QVector<Sample> samples;
    m_node.takeFrames([&](const QPlcIOBufferSlaveNode::Frame &frame) {
        Sample sample{frame.cycle, {}, {}};
        for (int i = 0; i < m_definitions.size(); ++i) {
            sample.values << QPlcValue::fromBytes(m_definitions.at(i).type, frame.inputs + m_offsets.at(i));
            sample.qualities << QPlcQuality::fromByte(quint8(frame.qualities[m_places.at(i)]));
        }
        samples << sample;
    });
    Q_EMIT heard(samples);
}

}  // namespace tools
