// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcIOSlaveNode.h"

#include <QtCore/QList>

#include <chrono>
#include <functional>

/// A QPlcIOSlaveNode that keeps the inputs of every cycle until a slower reader takes them: the
/// node of a window, a recorder or a plot.
///
/// \code
/// QPlcSignalIndexList inputs;
/// inputs.insert("tetherLength");
/// QPlcIOBufferSlaveNode node("Recorder");
/// node.setInputSignalIndices(inputs);
/// node.connectToMaster(QPlcUnderlyingProtocol::automatic(QHostAddress::LocalHost));
///
/// const QList<QPlcSignalList> cycles = node.takeInputSignals();  // now and then
/// for (const QPlcSignalList &cycle : cycles)
///     qInfo("%f m", cycle.value("tetherLength").toReal());
/// \endcode
///
/// The node is a listener: the master never waits for it. A reader that is too slow loses the
/// newest cycles, and lostCycles() counts them; the plant is not slowed down. QPlcFrameRateLimiter
/// takes the values at a fixed rate.
///
/// \threadsafe the take functions and lostCycles() may be called in one thread other than that of
///     the object; everything else in the thread of the object, which may be one of its own
///     (moveToThread())
///
/// \ingroup nodes
class QTPLC_EXPORT QPlcIOBufferSlaveNode : public QPlcIOSlaveNode
{
    Q_OBJECT
public:
    /// Makes a listener that is not connected and has no signals.
    /// \param name  under which the node registers; unique at its master
    /// \param policy  has no effect on a listener
    /// \param parent  owns the node, if given
    explicit QPlcIOBufferSlaveNode(const QString &name, RealTimeViolationPolicy policy = SilentZeroOrderHold,
                                   QObject *parent = nullptr);
    /// Disconnects from the master. Cycles that were not taken are lost.
    ~QPlcIOBufferSlaveNode() override;

    /// Sets how many cycles are kept; default 1000. Takes effect at the next registration.
    /// \param cycles  1 or more
    /// \pre the node is not registered
    void setBufferSize(int cycles);

    /// Returns the inputs of all cycles since the last call, oldest first, and removes them from
    /// the buffer.
    /// \threadsafe from one thread at a time
    QList<QPlcSignalList> takeInputSignals();
    /// Does the same, and appends the number of each cycle to \a cycles. Numbers begin at 0 in each
    /// real-time phase.
    QList<QPlcSignalList> takeInputSignals(QVector<quint64> *cycles);

    /// Does the same as takeInputSignals(); the name of the thesis.
    QList<QPlcSignalList> returnAndClearInputSignalsBuffer() { return takeInputSignals(); }

    /// The inputs of one cycle as they came.
    struct Frame
    {
        /// Number of the cycle since the start of the phase, from 0.
        quint64 cycle;
        /// Number of the real-time phase of this object; it grows with each phase.
        quint64 phase;
        std::chrono::nanoseconds period;  ///< nominal time between two cycles
        /// Values in the order of the inputs, packed and little-endian (QPlcValue::fromBytes()).
        /// Valid during the call only.
        const char *inputs;
        int size;       ///< bytes of the values, without qualities
        int every = 1;  ///< cycles from one frame to the next: listeningInterval()
        /// A byte for each input in their order (QPlcQuality::fromByte()). Null if the node
        /// receives no qualities. Valid during the call only.
        const char *qualities = nullptr;
    };
    /// Calls \a take for each cycle since the last call, oldest first, and removes it from the
    /// buffer. For readers of many signals: no list is made. At most as many cycles as the buffer
    /// holds are taken.
    /// \return number of cycles
    /// \threadsafe from one thread at a time
    int takeFrames(const std::function<void(const Frame &)> &take);
    /// Returns the number of cycles that were lost since the object was made, because the buffer
    /// was full.
    /// \threadsafe yes
    quint64 lostCycles() const;

private:
    class Q_DECL_HIDDEN BufferCode;
    BufferCode *const m_buffer;  // owned by the base class
};
