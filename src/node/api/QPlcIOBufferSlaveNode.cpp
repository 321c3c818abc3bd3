// SPDX-License-Identifier: Apache-2.0
#include "QPlcIOBufferSlaveNode.h"

#include "IOCode.h"
#include "QPlcSlaveNodePrivate.h"

#include <atomic>
#include <cstring>
#include <mutex>

namespace {

struct Head
{
    quint64 cycle;
    quint64 phase;
    std::chrono::nanoseconds period;
};

}  // namespace

/// Keeps the inputs of each cycle for a reader besides.
class QPlcIOBufferSlaveNode::BufferCode : public QPlcIOSlaveNode::Code
{
public:
    explicit BufferCode(QPlcIOBufferSlaveNode &bufferNode)
        : Code(bufferNode)
    {
    }

    void bind(const QPlcSignalTable &table, const qplc::PayloadLayout &inputs,
              const qplc::PayloadLayout &outputs) override;
    void step(const QPlcCycle &cycle, const char *inputs, char *outputs) override;

    int size = 1000;
    std::mutex mutex;  // reader against registration; not for the cycle thread
    qplc::PayloadLayout layout;
    int every = 1;                         // of the frames in the ring
    std::unique_ptr<qplc::ByteRing> ring;  // items: Head, payload
    std::atomic<quint64> phase{0};
    std::atomic<quint64> lost{0};
};

QPlcIOBufferSlaveNode::QPlcIOBufferSlaveNode(const QString &name, RealTimeViolationPolicy policy, QObject *parent)
    : QPlcIOSlaveNode(name, policy, std::make_unique<BufferCode>(*this), parent)
    , m_buffer(static_cast<BufferCode *>(QPlcSlaveNodePrivate::of(*this).code.get()))
{
    setListener(true);
    connect(this, &QPlcSlaveNode::stateChanged, this, [this](State state) {
        if (state == RealTime)  // before the first frame of the phase is asked for
            m_buffer->phase.fetch_add(1, std::memory_order_relaxed);
    });
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
    QList<QPlcSignalList> batch;
    takeFrames([&](const Frame &frame) {
        if (cycles)
            cycles->append(frame.cycle);
        batch.append(qplc::NodeRuntime::toList(m_buffer->layout, frame.inputs));
    });
    return batch;
}

int QPlcIOBufferSlaveNode::takeFrames(const std::function<void(const Frame &)> &take)
{
    const std::lock_guard<std::mutex> lock(m_buffer->mutex);
    if (!m_buffer->ring)
        return 0;
    // Not more than the buffer holds: a reader that is slower than the cycle comes to an end, too.
    const int most = int(m_buffer->ring->capacity());
    for (int count = 0; count < most; ++count) {
        const char *item = m_buffer->ring->front();
        if (!item)
            return count;
        Head head;
        std::memcpy(&head, item, sizeof head);
        const char *inputs = item + sizeof head;
        const auto size = int(m_buffer->layout.valueSize());
        take({head.cycle, head.phase, head.period, inputs, size, m_buffer->every,
              m_buffer->layout.hasQualities() ? inputs + size : nullptr});
        m_buffer->ring->pop();
    }
    return most;
}

quint64 QPlcIOBufferSlaveNode::lostCycles() const
{
    return m_buffer->lost.load(std::memory_order_relaxed);
}

// ---- frames ----

void QPlcIOBufferSlaveNode::BufferCode::bind(const QPlcSignalTable &table, const qplc::PayloadLayout &inputs,
                                             const qplc::PayloadLayout &outputs)
{
    const std::lock_guard<std::mutex> lock(mutex);
    layout = inputs;
    every = node.listeningInterval();
    ring = std::make_unique<qplc::ByteRing>(sizeof(Head) + inputs.size(), std::size_t(size));
    Code::bind(table, inputs, outputs);
}

void QPlcIOBufferSlaveNode::BufferCode::step(const QPlcCycle &cycle, const char *inputs, char *outputs)
{
    if (char *item = ring->beginPush()) {
        const Head head{cycle.number(), phase.load(std::memory_order_relaxed), cycle.period()};
        std::memcpy(item, &head, sizeof head);
        std::memcpy(item + sizeof head, inputs, ring->itemSize() - sizeof head);
        ring->commitPush();
    } else {
        lost.fetch_add(1, std::memory_order_relaxed);
    }
    Code::step(cycle, inputs, outputs);
}
