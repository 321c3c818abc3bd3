// SPDX-License-Identifier: Apache-2.0
#include "QPlcCompactSlaveNode.h"

#include "signals/PayloadLayout.h"

#include <algorithm>

QPlcCompactSlaveNode::QPlcCompactSlaveNode(const QString &name, RealTimeViolationPolicy policy, QObject *parent)
    : QPlcSlaveNode(name, policy, parent)
{
}

QPlcCompactSlaveNode::~QPlcCompactSlaveNode() = default;

bool QPlcCompactSlaveNode::bindPorts(const QPlcSignalTable &table, QVector<QPlcSignalIndex> *inputs,
                                     QVector<QPlcSignalIndex> *outputs, QVector<QPlcSignalIndex> *sameCycle,
                                     QString *error)
{
    QStringList errors;
    for (const QPlcPort *port : m_ports) {
        const QPlcSignalIndex index = table.indexOf(port->name());
        if (index == QPlcInvalidSignalIndex)
            errors << table.unknownSignalText(port->name());
        else if (!port->accepts(table.at(index).type))
            errors << QStringLiteral("signal '%1' is %2 in the table, but the node %3 it as %4")
                          .arg(port->name(), table.at(index).type.name(),
                               port->isInput() ? QStringLiteral("reads") : QStringLiteral("writes"),
                               port->variableType());
        else
            (port->isInput() ? inputs : outputs)->append(index);
        if (port->isSameCycle())
            sameCycle->append(index);
    }
    *error = errors.join(QStringLiteral("; "));
    return errors.isEmpty();
}

void QPlcCompactSlaveNode::attachPorts(const qplc::PayloadLayout &inputs, const qplc::PayloadLayout &outputs)
{
    m_inputs.clear();
    m_outputs.clear();
    // The layouts follow the order in which bindPorts() named the ports.
    for (QPlcPort *port : m_ports) {
        std::vector<Place> &places = port->isInput() ? m_inputs : m_outputs;
        const qplc::PayloadLayout::Field &field = (port->isInput() ? inputs : outputs).fields()[places.size()];
        port->attach(field.type);
        places.push_back({port, field.offset});
    }
}

void QPlcCompactSlaveNode::load(const char *inputs)
{
    for (const Place &place : m_inputs)
        place.port->load(inputs + place.offset);
}

void QPlcCompactSlaveNode::store(char *outputs) const
{
    for (const Place &place : m_outputs)
        place.port->store(outputs + place.offset);
}

void QPlcCompactSlaveNode::resetFrame(char *outputs)
{
    reset();
    if (isTwoPhase())
        this->outputs();
    store(outputs);
}

void QPlcCompactSlaveNode::initializeFrame(const char *inputs)
{
    load(inputs);
    initialized();
}

void QPlcCompactSlaveNode::stepFrame(const QPlcCycle &cycle, const char *inputs, char *outputs)
{
    load(inputs);
    if (isTwoPhase()) {
        update(cycle);
        this->outputs();
    } else {
        step(cycle);
    }
    store(outputs);
}

bool QPlcCompactSlaveNode::declaresSameCycle()
{
    return std::any_of(m_ports.begin(), m_ports.end(), [](const QPlcPort *port) { return port->isSameCycle(); });
}

// Ports take the place of lists: these are never called.
QPlcSignalList QPlcCompactSlaveNode::realTimeout(const QPlcSignalList &)
{
    return {};
}

QPlcSignalList QPlcCompactSlaveNode::outputSignals()
{
    return {};
}

void QPlcCompactSlaveNode::updateStates(const QPlcSignalList &) {}

QPlcSignalIndexList QPlcCompactSlaveNode::declareInputSignals()
{
    return {};
}

QPlcSignalIndexList QPlcCompactSlaveNode::declareOutputSignals()
{
    return {};
}
