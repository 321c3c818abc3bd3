// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plot/CurveShape.h"

namespace qplc {

/// The states of a channel as pieces of a view, left to right: where which value held, and, apart
/// from that, where it could not be trusted.
class StateRuns
{
public:
    /// From \a begin up to \a end [px].
    struct Run
    {
        int begin;
        int end;
        float value;
    };
    /// A part of a run whose values have a mark, from \a begin up to \a end [px].
    struct MarkedPart
    {
        int begin;
        int end;
        float value;
    };

    /// Reads a shape anew.
    void read(const CurveShape &shape);

    const std::vector<Run> &runs() const { return m_runs; }
    const std::vector<MarkedPart> &markedParts() const { return m_markedParts; }
    /// Columns in which a value was there for less than a column [px]: a spike that no run shows.
    const std::vector<int> &spikes() const { return m_spikes; }

private:
    void addMarkedPart(int begin, int end, float value);

    std::vector<Run> m_runs;
    std::vector<MarkedPart> m_markedParts;
    std::vector<int> m_spikes;
};

}  // namespace qplc
