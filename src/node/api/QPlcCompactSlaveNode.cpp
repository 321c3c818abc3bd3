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

/// The code of a node with ports: copies between them and the frames.
class QPlcCompactSlaveNode::PortCode : public qplc::NodeCode
{
public:
    explicit PortCode(QPlcCompactSlaveNode &node)
        : m_node(node)
    {
    }

    void add(QPlcPort *port) { m_ports.push_back(port); }
    void remove(const QPlcPort *port);
    /// They live longer than their node.
    void leavePorts();

    bool declaresSameCycle() override;
    bool declare(const QPlcSignalTable &table, Declaration *declaration, QString *error) override;
    void bind(const QPlcSignalTable &table, const qplc::PayloadLayout &inputs,
              const qplc::PayloadLayout &outputs) override;
    void reset(char *outputs) override;
    void initialize(const char *inputs) override;
    void step(const QPlcCycle &cycle, const char *inputs, char *outputs) override;
    void makeSafe(SafeStateReason reason, const char *safeInputs) override;
    void stopped() override { m_node.stopped(); }

private:
    /// What is done with the ports of one direction in each cycle: bytes that are copied as they
    /// are, and values that are converted.
    struct Plan
    {
        struct Copy
        {
            char *variable;
            quint32 offset;  // in the frame
            quint32 size;
        };
        struct Conversion
        {
            QPlcPort *port;
            quint32 offset;
        };
        std::vector<Copy> copies;
        std::vector<Conversion> conversions;

        void add(QPlcPort *port, quint32 offset, quint32 size);
    };
    void load(const char *inputs);
    void store(char *outputs) const;

    QPlcCompactSlaveNode &m_node;
    std::vector<QPlcPort *> m_ports;
    Plan m_inputs;
    Plan m_outputs;
    quint32 m_inputValues = 0;                   // [byte]
    std::vector<char> m_qualities;               // of the inputs, when they are received
    quint32 m_outputValues = 0;                  // [byte]
    std::vector<const QPlcPort *> m_qualifying;  // outputs, when their qualities are sent
};

QPlcCompactSlaveNode::QPlcCompactSlaveNode(const QString &name, RealTimeViolationPolicy policy, QObject *parent)
    : QPlcSlaveNode(name, policy, std::make_unique<PortCode>(*this), parent)
    , m_code(static_cast<PortCode *>(QPlcSlaveNodePrivate::of(*this).code.get()))
{
}

QPlcCompactSlaveNode::~QPlcCompactSlaveNode()
{
    QPlcSlaveNodePrivate::of(*this).endBeforeDestruction();
    m_code->leavePorts();
}

void QPlcCompactSlaveNode::setSendsQuality(bool sends)
{
    QPlcSlaveNodePrivate &own = QPlcSlaveNodePrivate::of(*this);
    Q_ASSERT_X(!own.hasChannel, "QPlcCompactSlaveNode::setSendsQuality", "a registered node stays what it is");
    own.outputQuality = sends;
}

bool QPlcCompactSlaveNode::sendsQuality() const
{
    return QPlcSlaveNodePrivate::of(*this).outputQuality;
}

void QPlcCompactSlaveNode::add(QPlcPort *port)
{
    m_code->add(port);
}

/// Its variable is in use as long as cycles run.
void QPlcCompactSlaveNode::remove(const QPlcPort *port)
{
    QPlcSlaveNodePrivate::of(*this).endBeforeDestruction();
    m_code->remove(port);
}

// ---- frames ----

void QPlcCompactSlaveNode::PortCode::remove(const QPlcPort *port)
{
    const auto found = std::find(m_ports.rbegin(), m_ports.rend(), port);  // most often the last one
    if (found != m_ports.rend())
        m_ports.erase(std::next(found).base());
}

void QPlcCompactSlaveNode::PortCode::leavePorts()
{
    for (QPlcPort *port : m_ports)
        port->m_node = nullptr;
}

bool QPlcCompactSlaveNode::PortCode::declaresSameCycle()
{
    return std::any_of(m_ports.begin(), m_ports.end(), [](const QPlcPort *port) { return port->isSameCycle(); });
}

bool QPlcCompactSlaveNode::PortCode::declare(const QPlcSignalTable &table, Declaration *declaration, QString *error)
{
    m_node.declarePorts(table);
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
            (port->isInput() ? declaration->inputs : declaration->outputs).append(index);
        if (port->isSameCycle())
            declaration->sameCycle.append(index);
    }
    *error = errors.join(QStringLiteral("; "));
    return errors.isEmpty();
}

void QPlcCompactSlaveNode::PortCode::Plan::add(QPlcPort *port, quint32 offset, quint32 size)
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

void QPlcCompactSlaveNode::PortCode::bind(const QPlcSignalTable &, const qplc::PayloadLayout &inputs,
                                          const qplc::PayloadLayout &outputs)
{
    m_inputs = m_outputs = Plan();
    m_inputValues = inputs.valueSize();
    m_qualities.assign(inputs.hasQualities() ? inputs.fields().size() : 0, char(QPlcQuality().toByte()));
    m_outputValues = outputs.valueSize();
    m_qualifying.clear();
    std::size_t number = 0;  // of the input
    // The layouts follow the order in which declare() named the ports.
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

void QPlcCompactSlaveNode::PortCode::load(const char *inputs)
{
    for (const Plan::Copy &copy : m_inputs.copies)
        copyBytes(copy.variable, inputs + copy.offset, copy.size);
    for (const Plan::Conversion &conversion : m_inputs.conversions)
        conversion.port->load(inputs + conversion.offset);
    if (!m_qualities.empty())
        std::memcpy(m_qualities.data(), inputs + m_inputValues, m_qualities.size());
}

void QPlcCompactSlaveNode::PortCode::store(char *outputs) const
{
    for (const Plan::Copy &copy : m_outputs.copies)
        copyBytes(outputs + copy.offset, copy.variable, copy.size);
    for (const Plan::Conversion &conversion : m_outputs.conversions)
        conversion.port->store(outputs + conversion.offset);
    char *quality = outputs + m_outputValues;
    for (const QPlcPort *port : m_qualifying)
        *quality++ = port->m_given;
}

void QPlcCompactSlaveNode::PortCode::reset(char *outputs)
{
    m_node.reset();
    if (m_node.isTwoPhase())
        m_node.outputs();
    store(outputs);
}

void QPlcCompactSlaveNode::PortCode::initialize(const char *inputs)
{
    load(inputs);
    m_node.initialized();
}

void QPlcCompactSlaveNode::PortCode::step(const QPlcCycle &cycle, const char *inputs, char *outputs)
{
    load(inputs);
    if (m_node.isTwoPhase()) {
        m_node.update(cycle);
        m_node.outputs();
    } else {
        m_node.step(cycle);
    }
    store(outputs);
}

void QPlcCompactSlaveNode::PortCode::makeSafe(SafeStateReason reason, const char *safeInputs)
{
    load(safeInputs);
    m_node.safeState(reason);
}
