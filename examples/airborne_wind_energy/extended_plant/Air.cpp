// SPDX-License-Identifier: Apache-2.0
#include "Air.h"

#include "RangeCheck.h"

#include <algorithm>
#include <cmath>

namespace awe {

std::string AirParameters::validate() const
{
    RangeCheck check;
    check.constants(*this);
    return check.message();
}

Air::Air(const AirParameters &parameters, double groundDensity)
    : m_parameters(parameters)
    , m_groundDensity(groundDensity)
    , m_logOfReference(std::log(parameters.referenceHeight / parameters.roughness))
{
}

double Air::windFactor(double height) const
{
    const double z = std::max(height, lowest);
    switch (m_parameters.profile) {
    case WindProfile::Uniform:
        break;
    case WindProfile::Power:
        return std::pow(z / m_parameters.referenceHeight, m_parameters.exponent);
    case WindProfile::Log:
        return std::log(z / m_parameters.roughness) / m_logOfReference;
    }
    return 1.0;
}

double Air::density(double height) const
{
    return m_parameters.isThinner ? m_groundDensity * std::exp(-height / m_parameters.scaleHeight) : m_groundDensity;
}

}  // namespace awe
