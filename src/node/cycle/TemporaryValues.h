// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MasterCycle.h"

#include <map>
#include <optional>
#include <vector>

namespace qplc {

/// Values that signals have for a while only, in layers: when the upper layer of a signal ends, the
/// value below it comes back. Bookkeeping only: looks at no clock, sets no signal.
class TemporaryValues
{
public:
    using Owner = const void *;

    /// Lays a value on top of its signal; an older layer of the same owner goes.
    /// \param ground  what the signal has below all layers; of use for the first layer only
    /// \param deadline  when the layer ends [ns]
    void set(Owner owner, const SignalSetting &setting, const QPlcValue &ground, std::int64_t deadline);
    /// Whether \a signal has a layer.
    bool contains(QPlcSignalIndex signal) const { return m_stacks.count(signal) > 0; }
    /// Drops the layers of \a signal; the value that it has now stays.
    void forget(QPlcSignalIndex signal) { m_stacks.erase(signal); }
    /// Signals that have a layer.
    std::vector<QPlcSignalIndex> signalIndices() const;
    /// When the next layer ends [ns]; none: there is no layer.
    std::optional<std::int64_t> nextDeadline() const;

    /// Ends the layers that are due at \a now [ns]. \return the values that come back
    std::vector<SignalSetting> endDue(std::int64_t now);
    /// Ends the layers of \a owner. \return the values that come back
    std::vector<SignalSetting> endAllOf(Owner owner);

private:
    struct Layer
    {
        Owner owner;
        QPlcValue value;
        std::int64_t deadline;
    };
    struct Stack
    {
        QPlcValue ground;
        std::vector<Layer> layers;  // the last one is on top; never empty
    };
    template<typename Predicate>
    std::vector<SignalSetting> end(Predicate ends);

    std::map<QPlcSignalIndex, Stack> m_stacks;
};

}  // namespace qplc
