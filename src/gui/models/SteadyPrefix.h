// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SiPrefix.h"

namespace qplc {

/// The prefix of a value that is written again and again and has no known range. A value type.
///
/// It becomes larger at once when the value needs it, and smaller after the value has been too
/// small for it in Patience texts in a row. A value that passes zero keeps its prefix.
class SteadyPrefix
{
public:
    static constexpr int Patience = 20;  // texts: 2 s of those that are renewed ten times a second

    /// Call it once for each text. \param size of the value, or of the largest one that gets the
    /// same prefix [unit]; NaN changes nothing
    const SiPrefix &next(const QString &unit, double size);
    const SiPrefix &current() const { return m_prefix; }

private:
    SiPrefix m_prefix;
    bool m_isNew = true;  // no value has had it
    int m_tooSmall = 0;   // texts in a row
};

}  // namespace qplc
