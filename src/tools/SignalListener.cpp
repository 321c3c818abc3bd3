// SPDX-License-Identifier: Apache-2.0
#include "SignalListener.h"

#include "SignalSelection.h"
#include "signals/PayloadLayout.h"

#include <QtCore/QHash>
#include <QtCore/QPointer>

namespace tools {

namespace messages = qplc::messages;

namespace {

constexpr int joinPause = 200;  // [ms] between two questions whether the phase that is joined still runs

}  // namespace

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
    QHash<QPlcSignalIndex, int> places;
    for (const QPlcSignalIndex index : inputs)
        places.insert(index, places.size());
    for (const QPlcSignalDefinition &definition : qAsConst(m_definitions)) {
        m_places << places.value(table.indexOf(definition.name));
        m_offsets << int(layout.fields()[std::size_t(m_places.last())].offset);
    }
    m_node.setReconnectPolicy(QPlcSlaveNode::NeverReconnect);
    m_node.setInputSignalIndices(indices);
    m_node.setBufferSize(10000);
    m_timer.setTimerType(Qt::PreciseTimer);
    m_timer.setInterval(pause);
    m_joinTimer.setSingleShot(true);
    m_joinTimer.setInterval(joinPause);
    connect(&m_joinTimer, &QTimer::timeout, this, &SignalListener::askForState);
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
    const QPlcSlaveNode::State own = m_node.state();
    if (own == QPlcSlaveNode::Disconnected)
        return;
    if (!m_isRunning)
        askForValues(std::make_shared<Values>());
    else if (own != QPlcSlaveNode::RealTime && own != QPlcSlaveNode::SafeStop)
        m_joinTimer.start();  // a phase that ends before it has begun here is told by nobody
}

void SignalListener::handleValues(const std::vector<messages::SignalEntry> &values)
{
    if (m_isRunning || int(values.size()) < m_definitions.size())
        return;
    QVector<QPlcValue> numbers;
    QVector<QPlcQuality> qualities;
    for (int i = 0; i < m_definitions.size(); ++i) {
        const messages::SignalEntry &entry = values[std::size_t(i)];
        numbers << QPlcValue::fromString(m_definitions.at(i).type, entry.value);
        qualities << QPlcQuality::fromByte(entry.quality);
    }
    Q_EMIT valuesAtRest(numbers, qualities);
}

bool SignalListener::join()
{
    m_timer.start();
    if (!m_node.connectToMasterAndWaitForConnected(m_call.master, m_call.client.timeout()))  // says why not
        return false;
    askForState();  // a phase may have ended meanwhile
    return true;
}

/// \param take  gets the answer, or null: the master refused or is lost, which is left to the node
template<typename Request, typename Take>
void SignalListener::ask(const Request &request, Take take)
{
    const auto pass = [listener = QPointer(this), take](const qplc::ControlClient::Reply<Request> &reply) {
        if (listener)
            take(std::get_if<typename Request::Answer>(&reply));
    };
    m_call.client.control().request(request, pass);
}

void SignalListener::askForState()
{
    ask(messages::GetState(), [this](const messages::State *state) {
        if (state)
            handleState(*state);
    });
}

/// \param known  what the answers to the questions before have told
void SignalListener::askForValues(const std::shared_ptr<Values> &known)
{
    if (known->empty() && std::exchange(m_isAsking, true))
        return;
    const messages::GetSignals next{m_names.mid(int(known->size()), BlockingClient::SignalsPerAnswer)};
    ask(next, [this, known](const messages::Signals *answer) {
        if (answer)
            known->insert(known->end(), answer->signals.begin(), answer->signals.end());
        if (answer && !answer->signals.empty() && int(known->size()) < m_names.size()) {
            askForValues(known);
            return;
        }
        m_isAsking = false;
        handleValues(*known);
    });
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
