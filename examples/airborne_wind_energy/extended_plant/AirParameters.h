// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace awe {

/// How the mean wind grows with the height.
enum class WindProfile {
    Uniform,  ///< the same at every height
    Power,    ///< (z / h_ref)^p
    Log       ///< ln(z / z0) / ln(h_ref / z0)
};

/// Wind and density over the height. The values here leave both as they are on the ground.
struct AirParameters
{
    WindProfile profile = WindProfile::Uniform;
    double referenceHeight = 50.0;  // h_ref: where the wind of the inputs blows [m]
    double exponent = 1.0 / 7.0;    // p of the power law [-]
    double roughness = 0.03;        // z0 of the log law: low grass [m]
    bool isThinner = false;         // whether the density falls with the height
    double scaleHeight = 8550.0;    // H of the density, rho = rho_0 exp(-z / H) [m]

    /// Calls visit(name, value, smallest, largest, unit) for each constant that a file may set.
    template<typename Parameters, typename Visitor>
    static void visitConstants(Parameters &parameters, Visitor visit)
    {
        visit("referenceHeight", parameters.referenceHeight, 2.0, 1000.0, "m");
        visit("exponent", parameters.exponent, 0.0, 1.0, "");
        visit("roughness", parameters.roughness, 1e-6, 1.0, "m");
        visit("scaleHeight", parameters.scaleHeight, 1000.0, 100000.0, "m");
    }

    /// \return empty when all is well, otherwise one sentence with the parameter, its value and the
    ///         remedy
    std::string validate() const;
};

}  // namespace awe
