// SPDX-License-Identifier: Apache-2.0
#include "QPlcCompactSlaveNode.h"

#include "QPlcSlaveNodePrivate.h"
#include "signals/PayloadLayout.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace {

/// memcpy() that knows the usual sizes: a number is one move.
inline void copyBytes(char *to, const char *from, quint32 size)
{
    if (size == sizeof(float))
        std::memcpy(to, from, sizeof(float));
    else if (size == sizeof(double))
        std::memcpy(to, from, sizeof(double));
    else
        std::memcpy(to, from, size);
}

}  // namespace

QPlcCompactSlaveNode::QPlcCompactSlaveNode(const QString &name, RealTimeViolationPolicy policy, QObject *parent)
    : QPlcSlaveNode(name, policy, parent)
{
}

QPlcCompactSlaveNode::~QPlcCompactSlaveNode()
{
    d->endBeforeDestruction();
    for (QPlcPort *port : m_ports)
        port->m_node = nullptr;  // it lives longer
}

void QPlcCompactSlaveNode::setSendsQuality(bool sends)
{
    Q_ASSERT_X(!d->hasChannel, "QPlcCompactSlaveNode::setSendsQuality", "a registered node stays what it is");
    d->sendsQuality = sends;
}

bool QPlcCompactSlaveNode::sendsQuality() const
{
    return d->sendsQuality;
}

/// Its variable is in use as long as cycles run.
void QPlcCompactSlaveNode::remove(const QPlcPort *port)
{
    d->endBeforeDestruction();
    const auto found = std::find(m_ports.rbegin(), m_ports.rend(), port);  // most often the last one
    if (found != m_ports.rend())
        m_ports.erase(std::next(found).base());
}

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

void QPlcCompactSlaveNode::Plan::add(QPlcPort *port, quint32 offset, quint32 size)
{
    char *variable = port->plainBytes();
    if (!variable) {
        conversions.push_back({port, offset});
        return;
    }
    if (!copies.empty()) {
        Copy &last = copies.back();
        if (last.variable + last.size == variable && last.offset + last.size == offset) {
            last.size += size;  // neighbours here and there: one copy
            return;
        }
    }
    copies.push_back({variable, offset, size});
}

void QPlcCompactSlaveNode::attachPorts(const qplc::PayloadLayout &inputs, const qplc::PayloadLayout &outputs)
{
    m_inputs = m_outputs = Plan();
    m_inputValues = inputs.valueSize();
    m_qualities.assign(inputs.hasQualities() ? inputs.fields().size() : 0, char(QPlcQuality().toByte()));
    m_outputValues = outputs.valueSize();
    m_qualifying.clear();
    std::size_t number = 0;  // of the input
    // The layouts follow the order in which bindPorts() named the ports.
    auto input = inputs.fields().begin();
    auto output = outputs.fields().begin();
    for (QPlcPort *port : m_ports) {
        const qplc::PayloadLayout::Field &field = port->isInput() ? *input++ : *output++;
        port->attach(field.type);
        if (port->isInput())
            port->m_quality = m_qualities.empty() ? nullptr : &m_qualities[number++];
        else if (outputs.hasQualities())
            m_qualifying.push_back(port);
        (port->isInput() ? m_inputs : m_outputs).add(port, field.offset, quint32(field.type.size()));
    }
}

void QPlcCompactSlaveNode::load(const char *inputs)
{
    for (const Plan::Copy &copy : m_inputs.copies)
        copyBytes(copy.variable, inputs + copy.offset, copy.size);
    for (const Plan::Conversion &conversion : m_inputs.conversions)
        conversion.port->load(inputs + conversion.offset);
    if (!m_qualities.empty())
        std::memcpy(m_qualities.data(), inputs + m_inputValues, m_qualities.size());
}

void QPlcCompactSlaveNode::store(char *outputs) const
{
    for (const Plan::Copy &copy : m_outputs.copies)
        copyBytes(outputs + copy.offset, copy.variable, copy.size);
    for (const Plan::Conversion &conversion : m_outputs.conversions)
        conversion.port->store(outputs + conversion.offset);
    char *quality = outputs + m_outputValues;
    for (const QPlcPort *port : m_qualifying)
        *quality++ = port->m_given;
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

void QPlcCompactSlaveNode::safeFrame(SafeStateReason reason, const char *safeInputs)
{
    load(safeInputs);
    safeState(reason);
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
