// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <string>

namespace awe {

/// What the tether is in the model.
enum class TetherKind {
    Spring,    ///< a spring without mass and drag (thesis, equation 4.11)
    Straight,  ///< the same, and the wing carries a third of the mass and a quarter of the drag of a straight tether
    Segments   ///< point masses between springs with drag: it sags, and can be slack in a part of it
};

/// The tether. Its values are those of a braided line of Dyneema of 4 mm (Fechner et al.,
/// "Dynamic Model of a Pumping Kite Power System", Renewable Energy 83, 2015); the damping is our
/// own choice: stable in steps of 2 ms from a length of 12 m on.
struct TetherParameters
{
    static constexpr int mostSegments = 20;
    static constexpr double shortestSegment = 0.05;  // the steps get shorter with the segments [m]
    static constexpr double leastNodeDensity = 1.0;  // of a tether with nodes [kg/m^3]

    TetherKind kind = TetherKind::Spring;
    int segments = 6;
    double diameter = 0.004;          // d [m]
    double axialStiffness = 614.6e3;  // EA: force of a strain of 1 [N]
    double density = 724.0;           // rho_T [kg/m^3]
    double dragCoefficient = 0.958;   // c_dT of a cylinder across the flow [-]
    double segmentDamping = 15.0;     // c of each segment [N s/m]

    /// mu [kg/m]
    double massPerLength() const { return density * 0.78539816339744830962 * diameter * diameter; }

    /// 1/2 rho c_dT d L |v_p| v_p [3] [N]
    /// \param across  v_p, the part of the flow that is across the tether [3] [m/s]
    /// \param length  L [m] \param airDensity  rho [kg/m^3]
    Eigen::Vector3d drag(const Eigen::Vector3d &across, double length, double airDensity) const
    {
        return 0.5 * airDensity * dragCoefficient * diameter * length * across.norm() * across;
    }

    /// Calls visit(name, value, smallest, largest, unit) for each constant that a file may set.
    template<typename Parameters, typename Visitor>
    static void visitConstants(Parameters &parameters, Visitor visit)
    {
        visit("diameter", parameters.diameter, 1e-4, 0.1, "m");
        visit("axialStiffness", parameters.axialStiffness, 1.0, 1e9, "N");
        visit("density", parameters.density, 0.0, 2e4, "kg/m³");
        visit("dragCoefficient", parameters.dragCoefficient, 0.0, 10.0, "");
        visit("segmentDamping", parameters.segmentDamping, 0.0, 1e4, "N s/m");
    }

    /// \return empty when all is well, otherwise one sentence with the parameter, its value and the
    ///         remedy
    std::string validate() const;
};

}  // namespace awe
