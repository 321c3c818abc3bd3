// SPDX-License-Identifier: Apache-2.0
#include "RangeCheck.h"

#include <sstream>

namespace awe {

void RangeCheck::within(const char *name, double value, double smallest, double largest, const char *unit)
{
    if (!m_message.empty() || (value >= smallest && value <= largest))  // NaN fails both comparisons
        return;
    const std::string suffix = *unit != '\0' ? std::string(" ") + unit : std::string();
    std::ostringstream text;
    text << name << " is " << value << suffix << "; choose a value from " << smallest << " to " << largest << suffix;
    m_message = text.str();
}

}  // namespace awe
