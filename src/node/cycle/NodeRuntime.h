// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeCode.h"
#include "QPlcCycle.h"
#include "SignalGuard.h"
#include "realtime/TimeSource.h"
#include "realtime/WakeUp.h"
#include "signals/PayloadLayout.h"

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

namespace qplc {

/// A node without its link: what its declared signals are, and its code called with the bytes of
/// frames.
///
/// Used by a slave (over a CyclicLink) and by a master (for a local node) alike. bind(), reset()
/// and initialize() in the thread of the node, step() on a cycle thread, never at the same time.
class NodeRuntime : private SignalGuard::Observer
{
public:
    /// \param traits  may change as long as the node is not registered
    NodeRuntime(NodeCode &code, const NodeTraits &traits);

    const NodeTraits &traits() const { return m_traits; }
    void setWorkloadSignal(const QString &name) { m_workloadSignal = name; }

    /// Whether the master sends qualities to who asks for them. Takes effect with bind().
    void setQualityOffered(bool offered) { m_qualityOffered = offered; }

    /// Looks all declared signals up in \a table. \return false with a message that names every
    /// mismatch
    bool bind(const QPlcSignalTable &table, QString *error);
    const QPlcSignalTable &table() const { return m_table; }
    /// As the frames of the master have them.
    const PayloadLayout &inputLayout() const { return m_inputLayout; }
    const PayloadLayout &outputLayout() const { return m_outputLayout; }
    /// Whether the node wants the value of the cycle at hand, for each field of inputLayout().
    const std::vector<bool> &sameCycle() const { return m_sameCycle; }

    /// Brings the node into its initial state: outputs() holds its initial outputs. \return false
    /// when its code threw
    bool reset(QString *error);
    bool initialize(const char *inputs, QString *error);
    /// Instead of reset(): outputs() are those of the last step again, and the code of the node
    /// hears nothing of it.
    /// \pre the node has taken part in a phase since bind(), or the same signals were bound before,
    ///         and its code has not failed
    void goOn() { m_outputs = m_scratch; }
    /// Instead of initialize(): takes the inputs; the code of the node hears of them with its next
    /// step.
    void storeInputs(const char *inputs);
    /// Whether the code of the node has thrown in this phase.
    bool hasFailed() const { return m_hasFailed; }
    /// The inputs of the node as it sees them: guarded, and with qualities behind them if it wants
    /// them.
    const char *inputs() const { return m_inputs.data(); }
    /// Values of inputs that were not taken since initialize(): not finite, or outside of the
    /// limits of the table. \threadsafe yes
    std::uint64_t refusedInputs() const { return m_refusedInputs; }
    /// Tells the node that the phase has ended.
    void stopped();

    /// A real-time phase begins. In lockstep no clock is read and the workload is 0.
    /// \param usualHold  [cycles] of inputs without `hold`
    void beginPhase(bool isLockstep, TimeSource &time = TimeSource::monotonic(),
                    std::int64_t usualHold = SignalGuard::UsualHold);
    /// Brings the node into its safe state, once in a phase: outputs() have their safe values,
    /// safeState() is called, and step() computes nothing any more (but for a listener, which goes
    /// on watching). On the thread of step(), or that of the node while no cycle runs.
    void makeSafe(QPlcSlaveNode::SafeStateReason reason) noexcept;
    bool isSafe() const { return m_isSafe; }
    /// The master shall stop safely: it is told with the outputs of the next cycle. Until the next
    /// phase. \threadsafe yes
    void requestSafeStop() { m_wantsSafeStop.store(true, std::memory_order_relaxed); }
    bool wantsSafeStop() const { return m_wantsSafeStop.load(std::memory_order_relaxed); }
    /// The class of the user is about to be destroyed: makeSafe() and stopped() call nothing of it
    /// any more, until bind(). \threadsafe yes
    void leaveCodeAlone() { m_isCodeGone.store(true, std::memory_order_relaxed); }
    /// One cycle. \return false when the code of the node threw, now or before in this phase: it is
    /// in its safe state then
    bool step(const QPlcCycle &cycle, const char *inputs) noexcept;
    /// Wakes up a reader in the thread of the node after each step, from the first call on. It is
    /// made then; call it there.
    WakeUp &stepWakeUp();
    const char *outputs() const { return m_outputs.data(); }
    /// Duration of the last step, the code of the node alone [ns].
    std::int64_t executionTime() const { return m_executionTime; }
    /// When the last step ended on the clock [ns]; 0 in lockstep.
    std::int64_t endOfStep() const { return m_endOfStep; }
    const QPlcCycle &cycle() const { return m_cycle; }
    /// What the code threw first since reset(), null-terminated.
    const char *faultText() const { return m_faultText.data(); }

    /// The values of \a frame as a list, under the indices of the table of the node.
    static QPlcSignalList toList(const PayloadLayout &layout, const char *frame);
    /// Writes the values of \a list into \a frame. \throws std::runtime_error when one of them does
    /// not fit
    static void fromList(const QPlcSignalList &list, const QPlcSignalTable &table, const PayloadLayout &layout,
                         char *frame);

private:
    void bindInputs(const QVector<QPlcSignalIndex> &inputs);
    void restartGuard();
    const char *guardedInputs(const char *payload, std::int64_t cycle) noexcept;
    void valueRefused(std::uint16_t, SignalGuard::Place, const ValueFault &, bool) noexcept override
    {
        m_refusedInputs.add();
    }
    void signalBecameSafe(SignalGuard::Place) noexcept override {}
    void sourceChanged(SignalGuard::Place, std::uint16_t, std::uint16_t) noexcept override {}
    void bindWorkloadSignal(QVector<QPlcSignalIndex> *outputs, QStringList *errors);
    std::int64_t now() noexcept { return m_time ? m_time->now() : 0; }
    void measure(std::int64_t begin) noexcept;
    template<typename Code>
    bool attempt(Code code) noexcept;
    void writeWorkload(std::int64_t duration);
    void setFault(const char *text) noexcept;

    NodeCode &m_code;
    const NodeTraits &m_traits;
    QPlcSignalTable m_table;
    bool m_qualityOffered = true;
    PayloadLayout m_inputLayout;
    PayloadLayout m_outputLayout;
    PayloadLayout m_seenLayout;          // of m_inputs
    std::vector<char> m_inputs;          // that the node sees
    std::vector<char> m_ownQualities;    // what the guard thinks of them
    std::optional<SignalGuard> m_guard;  // before m_inputs
    SignalGuard::Frame m_inputFrame;
    SignalGuard::Writer m_master;
    Counter m_refusedInputs;
    std::vector<bool> m_sameCycle;
    std::vector<char> m_outputs;  // given away
    std::vector<char> m_scratch;  // being computed
    std::vector<char> m_safeInputs;
    std::vector<char> m_safeOutputs;
    std::atomic<bool> m_isCodeGone{false};
    std::atomic<bool> m_wantsSafeStop{false};
    bool m_isSafe = false;
    bool m_hasFailed = false;  // in this phase
    QString m_workloadSignal;
    const PayloadLayout::Field *m_workload = nullptr;
    TimeSource *m_time = &TimeSource::monotonic();  // null: lockstep
    QPlcCycle m_cycle;
    std::int64_t m_executionTime = 0;
    std::int64_t m_endOfStep = 0;
    std::array<char, 256> m_faultText{};
    std::unique_ptr<WakeUp> m_ownStepWakeUp;
    std::atomic<WakeUp *> m_stepWakeUp{nullptr};  // null: nobody wants it
};

}  // namespace qplc
