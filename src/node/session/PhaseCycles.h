// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace qplc {

/// The cycles of a master as its sequences see them.
class PhaseCycles
{
public:
    /// Starts them with the nodes that are ready. \return false, with the reason in \a error, when
    /// there is no thread for them
    virtual bool start(QString *error) = 0;
    /// Whether they run, safe ones or others.
    virtual bool isRunning() const = 0;
    /// Number of the newest complete cycle, from 0.
    virtual quint64 cycle() const = 0;
    /// Number on the wire of cycle 0 of the next phase, or of the one at hand.
    virtual quint64 cycleZero() const = 0;
    /// From the next cycle on they have the nodes that are ready now.
    virtual void renewRoster() = 0;
    /// Whether a node of this name has left the phase at hand.
    virtual bool hasLeft(const QString &name) const = 0;

protected:
    ~PhaseCycles() = default;
};

}  // namespace qplc
