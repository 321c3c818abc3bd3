// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcIOSlaveNode.h"

#include <QtCore/QList>

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
    /// Cycles that found the buffer full. \threadsafe yes
    quint64 lostCycles() const;

private:
    void attachPorts(const qplc::PayloadLayout &inputs, const qplc::PayloadLayout &outputs) override;
    void stepFrame(const QPlcCycle &cycle, const char *inputs, char *outputs) override;

    struct Buffer;
    std::unique_ptr<Buffer> m_buffer;
};
