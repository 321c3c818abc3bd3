// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace awe {

/// Collects the first value that leaves its range and says so in one sentence.
class RangeCheck
{
public:
    /// smallest <= value <= largest, otherwise the message is set, unless an earlier one is there.
    /// NaN never passes.
    /// \param unit  empty for a pure number
    void within(const char *name, double value, double smallest, double largest, const char *unit);

    /// The same for each constant that \a parameters visits: PlantParameters and its like.
    template<typename Parameters>
    void constants(const Parameters &parameters)
    {
        Parameters::visitConstants(parameters,
                                   [this](const char *name, double value, double smallest, double largest,
                                          const char *unit) { within(name, value, smallest, largest, unit); });
    }

    /// \return empty when every value was in its range
    const std::string &message() const { return m_message; }

private:
    std::string m_message;
};

}  // namespace awe
