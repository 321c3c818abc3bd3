// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FmuInstance.h"

#include <vector>

namespace qplc {

/// Variables of an FMU that are read, or written, in each cycle: for each type one array of
/// references and one of values, so that one call moves all of them.
class FmuExchange
{
public:
    /// Where the values of a variable are.
    struct Place
    {
        int group = -1;
        std::size_t offset = 0;  // [byte]
    };

    /// \param version  of FMI
    /// \param splitsDiscrete  variables that change at events only have groups of their own
    FmuExchange(int version, bool splitsDiscrete)
        : m_version(version)
        , m_splitsDiscrete(splitsDiscrete)
    {
    }

    /// Adds \a variable, if it is not there yet. \pre it is a number
    Place add(const FmuVariable &variable);
    void clear() { m_groups.clear(); }
    bool isEmpty() const { return m_groups.empty(); }
    /// The values of a variable. They move when one is added.
    char *at(Place place) { return m_groups[std::size_t(place.group)].bytes() + place.offset; }

    /// Calls of get() or set() of \a instance, one for each group. \return the first status that is
    /// worse than a warning
    int get(FmuInstance &instance) noexcept;
    /// \param discrete  whether also those that change at events only
    int set(FmuInstance &instance, bool discrete) noexcept;
    /// Whether a discrete value is another one than at the last set().
    bool hasDiscreteChange() const noexcept;

private:
    struct Group
    {
        FmuVariable::Kind kind = FmuVariable::Float64;
        bool isDiscrete = false;
        std::vector<fmi::ValueReference> references;
        std::vector<std::size_t> offsets;  // of each reference [byte]
        std::size_t count = 0;             // of values
        std::size_t size = 0;              // [byte]
        std::vector<double> values;        // as memory that fits every type
        std::vector<char> last;            // discrete values, as they were set

        char *bytes() { return reinterpret_cast<char *>(values.data()); }
        const char *bytes() const { return reinterpret_cast<const char *>(values.data()); }
    };

    int m_version;
    bool m_splitsDiscrete;
    std::vector<Group> m_groups;
};

}  // namespace qplc
