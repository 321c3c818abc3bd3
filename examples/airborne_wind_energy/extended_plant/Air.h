// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AirParameters.h"

#include <Eigen/Core>

namespace awe {

/// The air at a height: wind and density.
///
///     w(z) = w_ref f(z) + w'            w_ref: mean wind with its gust at h_ref,  w': turbulence, the same everywhere
///     f    = 1,  (z / h_ref)^p,  or  ln(z / z0) / ln(h_ref / z0),  z not below 2 m
///     rho  = rho_0 exp(-z / H), or rho_0
///
/// Figures of others that it gives (KiteModels.jl, test of KPS3): rho(100 m) = 1.210756 kg/m^3 of
/// 1.225; with p = 1/7 and h_ref = 6 m f(10 m) = 1.0757037 and f(100 m) = 1.494685.
class Air
{
public:
    static constexpr double lowest = 2.0;  // below it the wind is that of this height [m]

    /// \param groundDensity  rho_0 [kg/m^3]
    /// \pre parameters.validate() is empty
    Air(const AirParameters &parameters, double groundDensity);

    /// f [-] \param height  z [m]
    double windFactor(double height) const;
    /// rho [kg/m^3] \param height  z [m]
    double density(double height) const;

private:
    AirParameters m_parameters;
    double m_groundDensity;
    double m_logOfReference;  // ln(h_ref / z0)
};

}  // namespace awe
