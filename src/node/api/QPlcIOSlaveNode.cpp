// SPDX-License-Identifier: Apache-2.0
#include "QPlcIOSlaveNode.h"

#include "QPlcSlaveNodePrivate.h"
#include "node/Logging.h"
#include "realtime/ByteRing.h"
#include "realtime/SnapshotBuffer.h"
#include "signals/PayloadLayout.h"

#include <QtCore/QTimer>

#include <algorithm>
#include <mutex>

struct QPlcIOSlaveNode::Private
{
    QPlcSignalIndexList inputIndices;
    QPlcSignalIndexList outputIndices;
    QPlcSignalList wanted;  // newest value of every output that was ever set

    // made at registration
    mutable std::mutex layoutMutex;  // not for the cycle thread: layouts change only while no cycle runs
    qplc::PayloadLayout inputLayout;
    qplc::PayloadLayout outputLayout;
    std::vector<char> outputs;                        // payload of `wanted`
    std::unique_ptr<qplc::ByteRing> newOutputs;       // owner -> cycle thread
    std::unique_ptr<qplc::SnapshotBuffer> newInputs;  // cycle thread -> anyone
    bool mustPass = false;                            // `outputs` found the ring full
};

QPlcIOSlaveNode::QPlcIOSlaveNode(const QString &name, RealTimeViolationPolicy policy, QObject *parent)
    : QPlcSlaveNode(name, policy, parent)
    , d(std::make_unique<Private>())
{
    setReceivesQuality(true);
}

QPlcIOSlaveNode::~QPlcIOSlaveNode()
{
    disconnectFromMaster();
}

QPlcSignalIndexList QPlcIOSlaveNode::inputSignalIndices() const
{
    return d->inputIndices;
}

QPlcSignalIndexList QPlcIOSlaveNode::outputSignalIndices() const
{
    return d->outputIndices;
}

QPlcSignalList QPlcIOSlaveNode::inputSignals() const
{
    const std::lock_guard<std::mutex> lock(d->layoutMutex);
    if (!d->newInputs)
        return {};
    std::vector<char> bytes(d->inputLayout.size());
    std::uint64_t cycle = 0;
    if (!d->newInputs->read(bytes.data(), &cycle))
        return {};
    return qplc::NodeRuntime::toList(d->inputLayout, bytes.data());
}

QPlcQuality QPlcIOSlaveNode::inputQuality(QPlcSignalIndex signal) const
{
    const std::lock_guard<std::mutex> lock(d->layoutMutex);
    std::vector<char> bytes(d->inputLayout.size());
    std::uint64_t cycle = 0;
    const std::vector<qplc::PayloadLayout::Field> &fields = d->inputLayout.fields();
    const auto found = std::find_if(fields.begin(), fields.end(), [signal](const qplc::PayloadLayout::Field &field) {
        return field.signal == signal;
    });
    if (found == fields.end() || !d->inputLayout.hasQualities() || !d->newInputs->read(bytes.data(), &cycle))
        return {};
    return QPlcQuality::fromByte(quint8(bytes[d->inputLayout.valueSize() + std::size_t(found - fields.begin())]));
}

void QPlcIOSlaveNode::setInputSignalIndices(const QPlcSignalIndexList &indices)
{
    d->inputIndices = indices;
    registerAgain();
}

void QPlcIOSlaveNode::setOutputSignalIndices(const QPlcSignalIndexList &indices)
{
    d->outputIndices = indices;
    registerAgain();
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
        if (d->outputIndices.contains(entry.index))
            d->wanted.insert(entry.index, entry.value);
        else
            qCWarning(lcSlave) << "node" << name() << "does not write the signal with the index" << entry.index
                               << "- declare it by setOutputSignalIndices()";
    }
    for (const qplc::PayloadLayout::Field &field : d->outputLayout.fields()) {
        const QPlcValue wanted = d->wanted.value(field.signal);
        const QPlcValue value = wanted.convertedTo(field.type);
        if (value.isValid())
            value.toBytes(d->outputs.data() + field.offset);
        else if (wanted.isValid())
            qCWarning(lcSlave).noquote() << "node" << name() << "- the value" << wanted.toString()
                                         << "does not fit its signal of type" << field.type.name() << "and is not set";
    }
    passOutputs();
}

/// Gives the outputs to the cycle thread; tries again when it has not taken the last ones yet.
void QPlcIOSlaveNode::passOutputs()
{
    if (!d->newOutputs || d->outputs.empty())
        return;
    char *place = d->newOutputs->beginPush();
    if (place) {
        std::memcpy(place, d->outputs.data(), d->outputs.size());
        d->newOutputs->commitPush();
    } else if (!d->mustPass) {
        d->mustPass = true;
        QTimer::singleShot(1, this, [this] {
            d->mustPass = false;
            passOutputs();
        });
    }
}

QPlcSignalIndexList QPlcIOSlaveNode::declareInputSignals()
{
    return d->inputIndices;
}

QPlcSignalIndexList QPlcIOSlaveNode::declareOutputSignals()
{
    return d->outputIndices;
}

// Frames take the place of lists: these are never called.
QPlcSignalList QPlcIOSlaveNode::realTimeout(const QPlcSignalList &)
{
    return {};
}

QPlcSignalList QPlcIOSlaveNode::initialOutputSignals()
{
    return {};
}

void QPlcIOSlaveNode::attachPorts(const qplc::PayloadLayout &inputs, const qplc::PayloadLayout &outputs)
{
    const std::lock_guard<std::mutex> lock(d->layoutMutex);
    d->inputLayout = inputs;
    d->outputLayout = outputs;
    d->outputs.assign(outputs.size(), 0);
    for (const qplc::PayloadLayout::Field &field : outputs.fields())
        QPlcSlaveNode::d->runtime.table().at(field.signal).initial.toBytes(d->outputs.data() + field.offset);
    d->newOutputs = std::make_unique<qplc::ByteRing>(std::max<std::size_t>(1, outputs.size()), 64);
    d->newInputs = std::make_unique<qplc::SnapshotBuffer>(inputs.size());
    setOutputSignals({});
}

void QPlcIOSlaveNode::resetFrame(char *outputs)
{
    while (d->newOutputs->front())
        d->newOutputs->pop();
    std::copy(d->outputs.begin(), d->outputs.end(), outputs);  // may be none at all
}

void QPlcIOSlaveNode::initializeFrame(const char *inputs)
{
    d->newInputs->publish(inputs, 0);
}

void QPlcIOSlaveNode::stepFrame(const QPlcCycle &cycle, const char *inputs, char *outputs)
{
    d->newInputs->publish(inputs, cycle.number());
    while (const char *newest = d->newOutputs->front()) {
        std::memcpy(outputs, newest, d->outputs.size());
        d->newOutputs->pop();
    }
}
