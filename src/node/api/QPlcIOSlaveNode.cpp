// SPDX-License-Identifier: Apache-2.0
#include "QPlcIOSlaveNode.h"

#include "IOCode.h"
#include "QPlcSlaveNodePrivate.h"
#include "node/Logging.h"

#include <QtCore/QTimer>

#include <algorithm>
#include <numeric>

QPlcIOSlaveNode::QPlcIOSlaveNode(const QString &name, RealTimeViolationPolicy policy, QObject *parent)
    : QPlcIOSlaveNode(name, policy, std::make_unique<Code>(*this), parent)
{
}

QPlcIOSlaveNode::QPlcIOSlaveNode(const QString &name, RealTimeViolationPolicy policy, std::unique_ptr<Code> code,
                                 QObject *parent)
    : QPlcSlaveNode(name, policy, std::move(code), parent)
    , m_code(static_cast<Code *>(QPlcSlaveNodePrivate::of(*this).code.get()))
{
    setReceivesQuality(true);
}

QPlcIOSlaveNode::~QPlcIOSlaveNode()
{
    disconnectFromMaster();
}

QPlcSignalIndexList QPlcIOSlaveNode::inputSignalIndices() const
{
    return m_code->inputIndices;
}

QPlcSignalIndexList QPlcIOSlaveNode::outputSignalIndices() const
{
    return m_code->outputIndices;
}

QPlcSignalList QPlcIOSlaveNode::inputSignals() const
{
    const std::lock_guard<std::mutex> lock(m_code->layoutMutex);
    if (!m_code->newInputs)
        return {};
    std::vector<char> bytes(m_code->inputLayout.size());
    std::uint64_t cycle = 0;
    if (!m_code->newInputs->read(bytes.data(), &cycle))
        return {};
    return qplc::NodeRuntime::toList(m_code->inputLayout, bytes.data());
}

QPlcQuality QPlcIOSlaveNode::inputQuality(QPlcSignalIndex signal) const
{
    const std::lock_guard<std::mutex> lock(m_code->layoutMutex);
    std::vector<char> bytes(m_code->inputLayout.size());
    std::uint64_t cycle = 0;
    const std::vector<qplc::PayloadLayout::Field> &fields = m_code->inputLayout.fields();
    const auto found = std::find_if(fields.begin(), fields.end(), [signal](const qplc::PayloadLayout::Field &field) {
        return field.signal == signal;
    });
    if (found == fields.end() || !m_code->inputLayout.hasQualities() || !m_code->newInputs->read(bytes.data(), &cycle))
        return {};
    return QPlcQuality::fromByte(quint8(bytes[m_code->inputLayout.valueSize() + std::size_t(found - fields.begin())]));
}

void QPlcIOSlaveNode::setInputSignalIndices(const QPlcSignalIndexList &indices)
{
    m_code->inputIndices = indices;
    registerAgain();
}

void QPlcIOSlaveNode::setOutputSignalIndices(const QPlcSignalIndexList &indices)
{
    m_code->outputIndices = indices;
    registerAgain();
}

void QPlcIOSlaveNode::readAllSignals()
{
    m_code->readsAll = true;
}

void QPlcIOSlaveNode::registerAgain()
{
    if (state() == Disconnected)
        return;
    if (masterProtocol().isValid())
        connectToMaster(masterProtocol());
    else
        qCWarning(lcSlave)
            << "node" << name()
            << "lives in the process of its master: remove it there, and add it again to register its signals";
}

void QPlcIOSlaveNode::setInitialOutputSignals(const QPlcSignalList &signalList)
{
    setOutputSignals(signalList);
}

void QPlcIOSlaveNode::setOutputSignals(const QPlcSignalList &signalList)
{
    for (const QPlcSignalList::Entry &entry : signalList) {
        if (m_code->outputIndices.contains(entry.index))
            m_code->wanted.insert(entry.index, entry.value);
        else
            qCWarning(lcSlave) << "node" << name() << "does not write the signal with the index" << entry.index
                               << "- declare it by setOutputSignalIndices()";
    }
    m_code->writeOutputs();
}

// ---- frames ----

bool QPlcIOSlaveNode::Code::declare(const QPlcSignalTable &table, Declaration *declaration, QString *error)
{
    if (!readsAll)
        return IndexListCode::declare(table, declaration, error);
    declaration->inputs.resize(table.size());
    std::iota(declaration->inputs.begin(), declaration->inputs.end(), QPlcSignalIndex(0));
    return true;
}

void QPlcIOSlaveNode::Code::writeOutputs()
{
    for (const qplc::PayloadLayout::Field &field : outputLayout.fields()) {
        const QPlcValue given = wanted.value(field.signal);
        const QPlcValue value = given.convertedTo(field.type);
        if (value.isValid())
            value.toBytes(payload.data() + field.offset);
        else if (given.isValid())
            qCWarning(lcSlave).noquote() << "node" << node.name() << "- the value" << given.toString()
                                         << "does not fit its signal of type" << field.type.name() << "and is not set";
    }
    passOutputs();
}

/// Gives the outputs to the cycle thread; tries again when it has not taken the last ones yet.
void QPlcIOSlaveNode::Code::passOutputs()
{
    if (!newOutputs || payload.empty())
        return;
    char *place = newOutputs->beginPush();
    if (place) {
        std::memcpy(place, payload.data(), payload.size());
        newOutputs->commitPush();
    } else if (!mustPass) {
        mustPass = true;
        QTimer::singleShot(1, &node, [this] {
            mustPass = false;
            passOutputs();
        });
    }
}

void QPlcIOSlaveNode::Code::bind(const QPlcSignalTable &table, const qplc::PayloadLayout &newInputLayout,
                                 const qplc::PayloadLayout &newOutputLayout)
{
    const std::lock_guard<std::mutex> lock(layoutMutex);
    inputLayout = newInputLayout;
    outputLayout = newOutputLayout;
    payload.assign(outputLayout.size(), 0);
    for (const qplc::PayloadLayout::Field &field : outputLayout.fields())
        table.at(field.signal).initial.toBytes(payload.data() + field.offset);
    newOutputs = std::make_unique<qplc::ByteRing>(std::max<std::size_t>(1, payload.size()), 64);
    newInputs = std::make_unique<qplc::SnapshotBuffer>(inputLayout.size());
    writeOutputs();
}

void QPlcIOSlaveNode::Code::reset(char *frame)
{
    while (newOutputs->front())
        newOutputs->pop();
    std::copy(payload.begin(), payload.end(), frame);  // may be none at all
}

void QPlcIOSlaveNode::Code::step(const QPlcCycle &cycle, const char *inputs, char *frame)
{
    newInputs->publish(inputs, cycle.number());
    while (const char *newest = newOutputs->front()) {
        std::memcpy(frame, newest, payload.size());
        newOutputs->pop();
    }
}
