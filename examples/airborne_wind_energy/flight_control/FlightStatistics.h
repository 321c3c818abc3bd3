// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <string>

namespace awe {

struct PlantParameters;

/// What FlightStatistics sees of one cycle: signals only, so it also works where the plant is
/// another computer.
struct FlightSample
{
    Eigen::Vector3d position = Eigen::Vector3d::Zero();      // r [3] [m], z up
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      // v [3] [m/s]
    Eigen::Vector3d windVelocity = Eigen::Vector3d::Zero();  // w [3] [m/s]
    Eigen::Vector3d tetherForce = Eigen::Vector3d::Zero();   // F_t [3] [N]
    double tetherSpeed = 0.0;                                // v_t [m/s], > 0 reels out
    double power = 0.0;                                      // [W]
    double energy = 0.0;                                     // [J]
    double electricalEnergy = 0.0;                           // of the winch [J]
    double turbineEnergy = 0.0;                              // of turbines on board [J]
    std::int8_t flightPhase = 0;                             // number of the FlightPhase
    bool isDocked = false;                                   // on the mast
    int dockings = 0;                                        // so far
    double dockingSpeed = 0.0;                               // of the last one [m/s]
    bool crashed = false;                                    // the plant says that the wing hit ground or mast
    bool isMachineOff = false;                               // a fault has switched the machine of the winch off
};

struct FlightStatisticsParameters
{
    double step = 0.010;                // time between two samples [s]
    double airDensity = 1.2;            // rho [kg/m^3]
    double area = 10.0;                 // A [m^2]
    double aweCoefficient = 17.542698;  // largest c_AWE of the wing [-]
    double nominalWindSpeed = 0.0;      // v_w of eta [m/s]; 0: the mean of |w| over the time of the figures
    double warmUp = 60.0;               // left out of the figures ... [s]
    double shortestFlight = 120.0;      // ... when the flight is longer than this [s]

    /// Density, area and coefficient of the wing of \a plant.
    static FlightStatisticsParameters of(const PlantParameters &plant);

    /// \return empty when all is well, otherwise one sentence with the parameter, its value and the
    ///         remedy
    std::string validate() const;
};

/// The figures of a flight. "Window" means: everything, or everything after the warm-up when the
/// flight was longer than shortestFlight.
struct FlightReport
{
    std::int64_t cycles = 0;           // control cycles = samples, all
    double duration = 0.0;             // [s], all
    double energy = 0.0;               // last minus first sample [J], all
    double meanPower = 0.0;            // window [W]
    double electricalPower = 0.0;      // mean, of the winch, window [W]
    double turbinePower = 0.0;         // mean, of turbines on board, window [W]
    double eta = 0.0;                  // meanPower / (2/27 rho A v_w^3 c_AWE), window
    double etaPerMeanCubedWind = 0.0;  // the same with the mean of |w|^3 of the window for v_w^3
    double reelOutPower = 0.0;         // mean power while v_t > 0, window [W]
    double reelInPower = 0.0;          // mean power while v_t < 0, window [W]; negative: the winch works
    double meanWindSpeed = 0.0;        // mean of |w|, window [m/s]
    double meanSpeed = 0.0;            // mean of |v|, window [m/s]
    double maximumSpeed = 0.0;         // largest |v|, all [m/s]
    double maximumPower = 0.0;         // largest power, all [W]
    int pumpingCycles = 0;             // completed reel-ins (ReelIn left for Power), all
    int recoveries = 0;                // times the phase Recover began, all
    double minimumAltitude = 0.0;      // [m], all but the first Launch and the phases of the
                                       // mast; all when there is nothing else
    double maximumTetherForce = 0.0;   // [N], all
    int starts = 0;                    // from the mast, all
    int dockings = 0;                  // all
    double dockingSpeed = 0.0;         // fastest docking [m/s], all
    bool landed = false;               // started, and on the mast at the end
    bool crashed = false;              // z <= 0 in any sample, or the plant says so, all
    bool hitMast = false;              // crashed above the ground
    double crashTime = 0.0;            // of the first such sample, since the begin [s]
    bool wasMachineOff = false;        // in any sample, all
    double machineOffTime = 0.0;       // of the first such sample, since the begin [s]
};

/// Adds up a flight cycle by cycle. step() takes no memory. One thread at a time.
///
///     eta = mean(P) / (2/27 rho A v_w^3 c_AWE)        1 is the limit of Loyd without reeling in, 3091 W at 5.83 m/s
///
/// Reeling out and in are told by the sign of the tether speed, pumping cycles and recoveries by
/// the phase.
class FlightStatistics
{
public:
    /// \pre parameters.validate() is empty
    explicit FlightStatistics(const FlightStatisticsParameters &parameters = FlightStatisticsParameters());

    void reset();
    void step(const FlightSample &sample);

    /// The figures so far; all zero before the first sample.
    FlightReport report() const;

    const FlightStatisticsParameters &parameters() const { return m_parameters; }

private:
    struct Sums
    {
        std::int64_t count = 0, outCount = 0, inCount = 0;
        double power = 0.0, outPower = 0.0, inPower = 0.0;  // [W]
        double windSpeed = 0.0, cubedWind = 0.0;            // [m/s], [m^3/s^3]
        double speed = 0.0;                                 // [m/s]

        void add(const FlightSample &sample, double windSpeedNow);
    };

    void followPhase(std::int8_t phase);
    void followMast(const FlightSample &sample);
    double &altitudeIn(std::int8_t phase);
    double bestPower(double cubedWind) const;

    FlightStatisticsParameters m_parameters;
    Sums m_all, m_afterWarmUp;
    double m_firstEnergy = 0.0, m_lastEnergy = 0.0;
    struct Energies
    {
        double electrical = 0.0, turbine = 0.0;  // [J]
    };
    Energies m_first, m_firstAfterWarmUp, m_last;
    std::int8_t m_phase = 0;
    bool m_launched = false;
    bool m_isDocked = false;
    int m_starts = 0;
    int m_dockings = 0;
    double m_dockingSpeed = 0.0;  // fastest [m/s]
    int m_pumpingCycles = 0;
    int m_recoveries = 0;
    double m_minimumAltitude = std::numeric_limits<double>::infinity();
    double m_launchAltitude = std::numeric_limits<double>::infinity();  // the same in the first Launch
    double m_maximumTetherForce = 0.0;
    double m_maximumSpeed = 0.0;
    double m_maximumPower = 0.0;
    bool m_crashed = false;
    bool m_hitMast = false;
    double m_crashTime = 0.0;  // [s]
    bool m_wasMachineOff = false;
    double m_machineOffTime = 0.0;  // [s]
};

}  // namespace awe
