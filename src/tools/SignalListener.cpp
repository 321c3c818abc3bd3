// SPDX-License-Identifier: Apache-2.0
#include "SignalListener.h"

#include "SignalSelection.h"
#include "signals/PayloadLayout.h"

#include <QtCore/QJsonArray>

namespace tools {

SignalListener::SignalListener(const QString &purpose, const QPlcSignalTable &table, const QStringList &names,
                               int pause)
    : m_names(names)
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
    connect(&m_node, &QPlcSlaveNode::messageReceived, this, &SignalListener::take);
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

void SignalListener::take(const QPlcMessage &answer)
{
    if (answer.kind() == QPlcMessage::State) {
        m_period = answer.fields().value(QStringLiteral("period")).toDouble() * 1e-9;
        m_state = answer.text(QStringLiteral("state"));
        m_isRunning = hasCycles(m_state);
        if (!m_isRunning && m_node.state() != QPlcSlaveNode::Disconnected)
            askForValues();
    } else if (answer.kind() == QPlcMessage::Signals) {
        const QJsonArray rows = answer.fields().value(QStringLiteral("signals")).toArray();
        QVector<QPlcValue> values;
        QVector<QPlcQuality> qualities;
        for (int i = 0; i < rows.size() && i < m_definitions.size(); ++i) {
            const QJsonObject row = rows.at(i).toObject();
            values << QPlcValue::fromString(m_definitions.at(i).type, row.value(QStringLiteral("value")).toString());
            qualities << qualityOf(row);
        }
        if (!m_isRunning && values.size() == m_definitions.size())
            Q_EMIT valuesAtRest(values, qualities);
    }
}

bool SignalListener::join(const CommandCall &call)
{
    m_timer.start();
    if (!m_node.connectToMasterAndWaitForConnected(call.master, call.client.timeout()))  // says why not
        return false;
    askForState();  // a phase may have ended meanwhile
    return true;
}

void SignalListener::askForState()
{
    m_node.sendMessageToMaster(QPlcMessage(QPlcMessage::GetState));
}

void SignalListener::askForValues()
{
    m_node.sendMessageToMaster(
        QPlcMessage(QPlcMessage::GetSignals, {{QStringLiteral("names"), QJsonArray::fromStringList(m_names)}}));
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
