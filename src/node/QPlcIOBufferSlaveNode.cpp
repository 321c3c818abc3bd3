// SPDX-License-Identifier: Apache-2.0
#include "QPlcIOBufferSlaveNode.h"

#include "NodeRuntime.h"
#include "realtime/ByteRing.h"
#include "signals/PayloadLayout.h"

#include <atomic>
#include <cstring>
#include <mutex>

struct QPlcIOBufferSlaveNode::Buffer
{
    int size = 1000;
    std::mutex mutex;  // reader against registration; not for the cycle thread
    qplc::PayloadLayout layout;
    std::unique_ptr<qplc::ByteRing> ring;  // items: u64 cycle, payload
    std::atomic<quint64> lost{0};
};

QPlcIOBufferSlaveNode::QPlcIOBufferSlaveNode(const QString &name, RealTimeViolationPolicy policy, QObject *parent)
    : QPlcIOSlaveNode(name, policy, parent)
    , m_buffer(std::make_unique<Buffer>())
{
    setListener(true);
}

QPlcIOBufferSlaveNode::~QPlcIOBufferSlaveNode()
{
    disconnectFromMaster();
}

void QPlcIOBufferSlaveNode::setBufferSize(int cycles)
{
    Q_ASSERT_X(cycles > 0, "QPlcIOBufferSlaveNode::setBufferSize", "at least one cycle is kept");
    m_buffer->size = cycles;
}

QList<QPlcSignalList> QPlcIOBufferSlaveNode::takeInputSignals()
{
    return takeInputSignals(nullptr);
}

QList<QPlcSignalList> QPlcIOBufferSlaveNode::takeInputSignals(QVector<quint64> *cycles)
{
    const std::lock_guard<std::mutex> lock(m_buffer->mutex);
    QList<QPlcSignalList> batch;
    if (!m_buffer->ring)
        return batch;
    // Not more than the buffer holds: a reader that is slower than the cycle comes to an end, too.
    for (std::size_t left = m_buffer->ring->capacity(); left > 0; --left) {
        const char *item = m_buffer->ring->front();
        if (!item)
            break;
        quint64 cycle = 0;
        std::memcpy(&cycle, item, sizeof cycle);
        if (cycles)
            cycles->append(cycle);
        batch.append(qplc::NodeRuntime::toList(m_buffer->layout, item + sizeof cycle));
        m_buffer->ring->pop();
    }
    return batch;
}

quint64 QPlcIOBufferSlaveNode::lostCycles() const
{
    return m_buffer->lost.load(std::memory_order_relaxed);
}

void QPlcIOBufferSlaveNode::attachPorts(const qplc::PayloadLayout &inputs, const qplc::PayloadLayout &outputs)
{
    const std::lock_guard<std::mutex> lock(m_buffer->mutex);
    m_buffer->layout = inputs;
    m_buffer->ring = std::make_unique<qplc::ByteRing>(sizeof(quint64) + inputs.size(), std::size_t(m_buffer->size));
    QPlcIOSlaveNode::attachPorts(inputs, outputs);
}

void QPlcIOBufferSlaveNode::stepFrame(const QPlcCycle &cycle, const char *inputs, char *outputs)
{
    if (char *item = m_buffer->ring->beginPush()) {
        const quint64 number = cycle.number();
        std::memcpy(item, &number, sizeof number);
        std::memcpy(item + sizeof number, inputs, m_buffer->ring->itemSize() - sizeof number);
        m_buffer->ring->commitPush();
    } else {
        m_buffer->lost.fetch_add(1, std::memory_order_relaxed);
    }
    QPlcIOSlaveNode::stepFrame(cycle, inputs, outputs);
}
