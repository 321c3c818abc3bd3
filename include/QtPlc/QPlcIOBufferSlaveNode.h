// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcIOSlaveNode.h"

#include <QtCore/QList>

#include <chrono>
#include <functional>

/// A QPlcIOSlaveNode that keeps the inputs of every cycle until a slower reader takes them: the node of a window, a recorder, a plot.
///
/// It is a listener: in lockstep nobody waits for it. A reader that is too slow loses the newest cycles, and is told how many; it never slows the plant.
/// Take the values with a QPlcFrameRateLimiter, or by takeInputSignals().
///
/// Threads: the object may live in a thread of its own (moveToThread()); takeInputSignals() from one other thread at a time.
class QTPLC_EXPORT QPlcIOBufferSlaveNode : public QPlcIOSlaveNode
{
    Q_OBJECT
public:
    explicit QPlcIOBufferSlaveNode(const QString &name, RealTimeViolationPolicy policy = SilentZeroOrderHold,
                                   QObject *parent = nullptr);
    ~QPlcIOBufferSlaveNode() override;

    /// Number of cycles that are kept, 1000 unless set. \pre not connected
    void setBufferSize(int cycles);

    /// The inputs of all cycles since the last call, oldest first. \threadsafe from one thread at a time
    QList<QPlcSignalList> takeInputSignals();
    /// As above, with the number of each cycle.
    QList<QPlcSignalList> takeInputSignals(QVector<quint64> *cycles);

    /// takeInputSignals(), under the name that the thesis gives it.
    QList<QPlcSignalList> returnAndClearInputSignalsBuffer() { return takeInputSignals(); }

    /// The inputs of one cycle as they came.
    struct Frame
    {
        quint64 cycle;  ///< number since the start of the phase
        quint64 phase;  ///< greater in each real-time phase of this object than in the one before
        std::chrono::nanoseconds period;
        const char *
            inputs;  ///< values one behind the other in the order of the inputs, little-endian and packed (QPlcValue::fromBytes()); valid during the call
        int size;    ///< [byte]
        int every = 1;  ///< listeningInterval(): cycles from one frame to the next
        /// A byte for each input (QPlcQuality::fromByte()), in their order; null: none are received.
        const char *qualities = nullptr;
    };
    /// As takeInputSignals() for readers of many signals: no list is made, \a take gets the bytes of each cycle. \return number of cycles
    int takeFrames(const std::function<void(const Frame &)> &take);
    /// Cycles that found the buffer full. \threadsafe yes
    quint64 lostCycles() const;

private:
    class BufferCode;
    BufferCode *const m_buffer;  // owned by the base class
};
