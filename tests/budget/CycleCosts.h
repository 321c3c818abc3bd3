// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ThreadCosts.h"

#include <QtPlcCore>

#include <QtCore/QJsonObject>

/// What the cycle thread on which a node runs has cost between the end of the warm-up and the last
/// cycles.
///
/// take() in each cycle; everything else when the cycles are over.
class CycleCosts
{
public:
    /// \param cycles  length of the phase
    explicit CycleCosts(quint64 cycles);

    void take(quint64 cycle);
    /// Empty when the phase ended too early.
    QJsonObject toJson() const;

private:
    quint64 m_begin;  // number of a cycle
    quint64 m_end;
    bool m_hasBegun = false;
    bool m_hasEnded = false;
    ThreadCosts m_before;
    ThreadCosts m_spent;
};
