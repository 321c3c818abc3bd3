// SPDX-License-Identifier: Apache-2.0
#include "ExtendedPlant.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace awe {

namespace {

constexpr double slowestTurn = 5.0;            // below it the weight does not turn the wing faster [m/s]
constexpr double dampingRamp = 1e-4;           // strain up to which the damping grows [-]
constexpr double longestSubstepLength = 75.0;  // of a segment in a step of a whole cycle [m]
constexpr int machineSubsteps = 5;
constexpr int driveStepsInCycle = 10;
constexpr double dockingDistance = 0.3;      // the wing docks up to this far beyond the mast's top [m]
constexpr double mastClearance = 1.0;        // further in it hit the mast [m]
constexpr double fastestTouchdown = 1000.0;  // [m/s]

}  // namespace

ExtendedPlant::ExtendedPlant(const PlantParameters &parameters, const PlantOptions &options)
    : m_parameters(parameters)
    , m_options(options)
    , m_isThesis(options.isThesis())
    , m_points(options.tether.kind == TetherKind::Segments ? options.tether.segments : 1)
    , m_thesis(parameters)
    , m_aerodynamics(parameters.dragFactor, parameters.angleOfAttackRange)
    , m_air(options.air, parameters.airDensity)
    , m_machine(options.machine)
{
    reset();
}

void ExtendedPlant::reset()
{
    m_thesis.reset();
    m_machine.reset();
    m_crashed = false;
    const PlantState &start = m_parameters.initialState;
    m_state.setZero(6 * m_points + SingleCount);
    for (int point = 1; point <= m_points; ++point) {
        const double share = double(point) / m_points;
        setPoint(point, share * start.position, share * start.velocity);
    }
    single(m_state, PitchAngle) = start.pitchAngle;
    single(m_state, YawAngle) = start.yawAngle;
    single(m_state, TetherLength) = start.tetherLength;
    single(m_state, AveragePower) = start.averagePower;
    single(m_state, Energy) = start.energy;
    m_isDocked = false;
    m_dockings = 0;
    m_dockingSpeed = 0.0;
    if (m_options.mast.isPresent)
        hangOnMast();
    noticeGround();
}

inline Eigen::Vector3d ExtendedPlant::pointIn(const State &state, int point) const
{
    if (point == 0)
        return Eigen::Vector3d::Zero();
    return state.segment<3>(3 * (point - 1));
}

inline Eigen::Vector3d ExtendedPlant::velocityIn(const State &state, int point) const
{
    if (point == 0)
        return Eigen::Vector3d::Zero();
    return state.segment<3>(3 * (m_points + point - 1));
}

Eigen::Vector3d ExtendedPlant::position(int point) const
{
    return m_isThesis && point == m_points ? m_thesis.state().position : pointIn(m_state, point);
}

Eigen::Vector3d ExtendedPlant::velocity(int point) const
{
    return m_isThesis && point == m_points ? m_thesis.state().velocity : velocityIn(m_state, point);
}

void ExtendedPlant::setPoint(int point, const Eigen::Vector3d &position, const Eigen::Vector3d &velocity)
{
    m_state.segment<3>(3 * (point - 1)) = position;
    m_state.segment<3>(3 * (m_points + point - 1)) = velocity;
}

// ---- air ----

ExtendedPlant::AirAt ExtendedPlant::airAt(double height, const PlantInputs &inputs) const
{
    const Eigen::Vector3d mean = inputs.windVelocity - inputs.turbulence;
    return {m_air.windFactor(height) * mean + inputs.turbulence, m_air.density(height)};
}

ExtendedPlant::Sample ExtendedPlant::sampled(const PlantInputs &inputs) const
{
    Sample sample;
    double lower = 0.0;
    for (int segment = 0; segment < m_points; ++segment) {
        const double upper = pointIn(m_state, segment + 1).z();
        if (m_options.tether.kind == TetherKind::Segments)
            sample.segments[std::size_t(segment)] = airAt(0.5 * (lower + upper), inputs);
        lower = upper;
    }
    sample.wing = airAt(lower, inputs);
    return sample;
}

// ---- forces ----

inline ExtendedPlant::Segment ExtendedPlant::segment(const State &state, int number) const
{
    Segment segment;
    const Eigen::Vector3d s = pointIn(state, number + 1) - pointIn(state, number);
    segment.length = s.norm();
    segment.along = s / segment.length;
    return segment;
}

inline double ExtendedPlant::tension(const State &state, int number, const Segment &segment, double tetherSpeed) const
{
    const double unstretched = single(state, TetherLength) / m_points;
    const double stretch = segment.length - unstretched;
    if (!(stretch > 0.0))
        return 0.0;
    const TetherParameters &tether = m_options.tether;
    const bool isSpring = tether.kind != TetherKind::Segments;
    const double stiffness = isSpring ? m_parameters.tetherStiffness : tether.axialStiffness / unstretched;
    const double damping = isSpring ? m_parameters.tetherDamping
                                    : tether.segmentDamping * std::min(1.0, stretch / (dampingRamp * unstretched));
    if (damping == 0.0)
        return stiffness * stretch;
    const double growth
        = (velocityIn(state, number + 1) - velocityIn(state, number)).dot(segment.along) - tetherSpeed / m_points;
    return std::max(0.0, stiffness * stretch + damping * growth);
}

inline Eigen::Vector3d ExtendedPlant::drag(const State &state, int number, const Segment &segment,
                                           const AirAt &air) const
{
    const Eigen::Vector3d flow = air.wind - 0.5 * (velocityIn(state, number) + velocityIn(state, number + 1));
    const Eigen::Vector3d across = flow - flow.dot(segment.along) * segment.along;
    return m_options.tether.drag(across, segment.length, air.density);
}

ExtendedPlant::Wing ExtendedPlant::wing(const State &state, const AirAt &air, const PlantInputs &inputs) const
{
    const PlantParameters &kite = m_parameters;
    const Sphere sphere(pointIn(state, m_points) - pointIn(state, m_points - 1));
    const WingFrame frame(sphere, Attitude::of(single(state, PitchAngle), single(state, YawAngle)));
    Aerodynamics::MoreDrag moreDrag;
    if (m_options.steering.kind == SteeringKind::TurnRate)
        moreDrag.factor = 1.0 + m_options.steering.steeringDrag * std::abs(single(state, Steering));
    if (m_options.tether.kind == TetherKind::Straight)
        moreDrag.coefficient = m_options.tether.dragCoefficient * m_options.tether.diameter
            * single(state, TetherLength) / (4.0 * kite.area);
    const Eigen::Vector3d relativeWind = air.wind - velocityIn(state, m_points);
    const double dynamicArea = 0.5 * air.density * kite.area;
    Wing wing;
    wing.air
        = m_aerodynamics.airflow(relativeWind, frame.tailwards, frame.sideways, frame.topwards, dynamicArea, moreDrag);
    wing.airspeed = relativeWind.norm();
    if (m_options.hasTurbines) {
        const double drag = dynamicArea * inputs.turbineCoefficient * wing.airspeed;
        wing.turbines = drag * relativeWind;
        wing.turbinePower = drag * wing.airspeed * wing.airspeed;
    }
    return wing;
}

// ---- motion ----

/// How the control angles and the actuator move.
void ExtendedPlant::turn(const State &state, double airspeed, const PlantInputs &inputs, State *rates) const
{
    single(*rates, PitchAngle) = inputs.pitchSpeed;
    if (m_options.steering.kind == SteeringKind::Kinematic) {
        single(*rates, YawAngle) = inputs.yawSpeed;
        return;
    }
    const SteeringParameters &law = m_options.steering;
    const Eigen::Vector3d r = pointIn(state, m_points), v = velocityIn(state, m_points);
    const Sphere sphere(r);
    const double course = -single(state, YawAngle) * radiansPerDegree;
    const double azimuthSpeed = sphere.horizontal < sphere.distance / 1000.0
        ? 0.0
        : (r.x() * v.y() - r.y() * v.x()) / (sphere.horizontal * sphere.horizontal);
    const double turnRate = law.turnRateFactor * airspeed * single(state, Steering)
        + law.weightFactor / std::max(airspeed, slowestTurn) * std::sin(course) * sphere.cosElevation
        + azimuthSpeed * sphere.sinElevation;
    single(*rates, YawAngle) = -turnRate * degreesPerRadian;
    const double missing = std::clamp(inputs.steering, -1.0, 1.0) - single(state, Steering);
    single(*rates, Steering) = std::clamp(missing / law.actuatorTime, -law.actuatorRate, law.actuatorRate);
}

ExtendedPlant::State ExtendedPlant::rates(const State &state, const Sample &air, double tetherSpeed,
                                          const PlantInputs &inputs) const
{
    const PlantParameters &kite = m_parameters;
    const TetherParameters &tether = m_options.tether;
    const double tetherLength = single(state, TetherLength);
    const bool hasSegments = tether.kind == TetherKind::Segments;
    const double nodeMass = hasSegments ? tether.massPerLength() * tetherLength / m_points : 0.0;
    double wingMass = kite.mass + 0.5 * nodeMass;
    if (tether.kind == TetherKind::Straight)
        wingMass += tether.massPerLength() * tetherLength / 3.0;

    State rates = State::Zero(state.size());
    rates.head(3 * m_points) = state.segment(3 * m_points, 3 * m_points);
    const Wing wing = this->wing(state, air.wing, inputs);
    const auto force = [&](int point) { return rates.segment<3>(3 * (m_points + point - 1)); };
    force(m_points) = wing.air.force + wing.turbines;
    double groundTension = 0.0;
    for (int number = 0; number < m_points; ++number) {
        const Segment segment = this->segment(state, number);
        if (hasSegments) {
            const Eigen::Vector3d halfDrag = 0.5 * drag(state, number, segment, air.segments[std::size_t(number)]);
            force(number + 1) += halfDrag;
            if (number > 0)
                force(number) += halfDrag;
        }
        const double tension = this->tension(state, number, segment, tetherSpeed);
        force(number + 1) -= tension * segment.along;
        if (number > 0)
            force(number) += tension * segment.along;
        else
            groundTension = tension;
    }
    for (int point = 1; point <= m_points; ++point) {
        force(point) /= point < m_points ? nodeMass : wingMass;
        rates[3 * (m_points + point - 1) + 2] -= kite.gravity;
    }
    turn(state, wing.airspeed, inputs, &rates);
    single(rates, TetherLength) = tetherSpeed;
    const double power = tetherSpeed * groundTension;
    single(rates, AveragePower) = (power - single(state, AveragePower)) / kite.averagePowerTime;
    single(rates, Energy) = power;
    single(rates, TurbineEnergy) = wing.turbinePower;
    return rates;
}

int ExtendedPlant::substeps() const
{
    if (m_options.tether.kind == TetherKind::Segments) {
        const double length = std::max(single(m_state, TetherLength) / m_points, TetherParameters::shortestSegment);
        return std::max(machineSubsteps, int(std::ceil(longestSubstepLength / length)));
    }
    return m_options.hasMachine ? machineSubsteps : 1;
}

double ExtendedPlant::drumSpeed(const PlantInputs &inputs) const
{
    if (m_options.hasMachine)
        return m_machine.speed() * m_options.machine.leverage();
    return m_isDocked ? 0.0 : inputs.tetherSpeed;
}

double ExtendedPlant::tensionNow(int number, double tetherSpeed) const
{
    return tension(m_state, number, segment(m_state, number), tetherSpeed);
}

/// Moves the machine \a time on, in \a driveSteps steps. \return the mean speed of the drum [m/s]
double ExtendedPlant::driven(double time, int driveSteps, const PlantInputs &inputs)
{
    const double leverage = m_options.machine.leverage();
    WinchDriveInputs drive;
    drive.hasCommand = true;
    drive.enable = true;
    drive.speedSetpoint = inputs.tetherSpeed / leverage;
    drive.tetherForce = tensionNow(0, drumSpeed(inputs));
    const double before = m_machine.position();
    for (int i = 0; i < driveSteps; ++i)
        m_machine.step(drive, time / driveSteps);
    return (m_machine.position() - before) * leverage / time;
}

void ExtendedPlant::step(const PlantInputs &inputs)
{
    if (m_isThesis)
        return m_thesis.step(inputs);
    if (isHeld())
        return;
    m_isDocked = m_isDocked && !inputs.release;
    if (m_isDocked)
        return waitOnMast();
    const Sample air = sampled(inputs);
    const int count = substeps();
    const double h = m_parameters.step / count;
    const int driveSteps = driveStepsInCycle % count == 0 ? driveStepsInCycle / count : 1;
    for (int i = 0; i < count; ++i) {
        const double tetherSpeed = m_options.hasMachine ? driven(h, driveSteps, inputs) : inputs.tetherSpeed;
        const State k1 = rates(m_state, air, tetherSpeed, inputs);
        const State k2 = rates(m_state + 0.5 * h * k1, air, tetherSpeed, inputs);
        const State k3 = rates(m_state + 0.5 * h * k2, air, tetherSpeed, inputs);
        const State k4 = rates(m_state + h * k3, air, tetherSpeed, inputs);
        m_state += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
    }
    noticeGround();
    if (m_options.mast.isPresent)
        noticeMast(inputs.release);
}

void ExtendedPlant::noticeGround()
{
    if (m_isThesis || m_crashed || !(pointIn(m_state, m_points).z() <= 0.0))
        return;
    // Faster or not a number: the computation diverges, which standing on the ground would hide.
    if (velocityIn(m_state, m_points).norm() < fastestTouchdown)
        crash();
}

void ExtendedPlant::crash()
{
    m_crashed = true;
    if (m_parameters.groundContact == GroundContact::Hold)
        m_state.segment(3 * m_points, 3 * m_points).setZero();
}

// ---- mast ----

void ExtendedPlant::noticeMast(bool release)
{
    if (m_crashed)
        return;
    const MastParameters &mast = m_options.mast;
    const Eigen::Vector3d wing = pointIn(m_state, m_points);
    const double distance = wing.norm();
    if (distance < mast.distance - mastClearance)
        return crash();
    const bool isThere = distance <= mast.distance + dockingDistance && (wing - mast.top()).norm() <= mast.reach;
    if (release || !isThere)
        return;
    ++m_dockings;
    m_dockingSpeed = velocityIn(m_state, m_points).norm();
    hangOnMast();
}

void ExtendedPlant::hangOnMast()
{
    m_isDocked = true;
    for (int point = 1; point <= m_points; ++point)
        setPoint(point, double(point) / m_points * m_options.mast.top(), Eigen::Vector3d::Zero());
    const PlantState atRest = PlantParameters::stateAtRest(m_options.mast.elevation, m_options.mast.azimuth, 1.0);
    single(m_state, PitchAngle) = atRest.pitchAngle;
    single(m_state, YawAngle) = atRest.yawAngle;
    single(m_state, Steering) = 0.0;
    single(m_state, TetherLength) = m_options.mast.distance;
}

/// A cycle on the mast: the drum holds, the average power falls.
void ExtendedPlant::waitOnMast()
{
    const double h = m_parameters.step;
    single(m_state, AveragePower) *= 1.0 - h / m_parameters.averagePowerTime;
    if (!m_options.hasMachine)
        return;
    WinchDriveInputs hold;
    hold.hasCommand = true;
    hold.enable = true;
    for (int i = 0; i < driveStepsInCycle; ++i)
        m_machine.step(hold, h / driveStepsInCycle);
}

// ---- what it tells ----

PlantState ExtendedPlant::state() const
{
    if (m_isThesis)
        return m_thesis.state();
    PlantState state;
    state.position = pointIn(m_state, m_points);
    state.velocity = velocityIn(m_state, m_points);
    state.pitchAngle = single(m_state, PitchAngle);
    state.yawAngle = single(m_state, YawAngle);
    state.tetherLength = single(m_state, TetherLength);
    state.averagePower = single(m_state, AveragePower);
    state.energy = single(m_state, Energy);
    return state;
}

PlantOutputs ExtendedPlant::outputs(const PlantInputs &inputs) const
{
    if (m_isThesis) {
        PlantOutputs y = m_thesis.outputs(inputs);
        y.groundTension = y.tetherForce.norm();
        return y;
    }
    const PlantState state = this->state();
    const Eigen::Vector3d &r = state.position;
    const Sphere sphere(r);
    const AirAt air = airAt(r.z(), inputs);
    PlantOutputs y;
    y.inputs = inputs;
    y.inputs.windVelocity = air.wind;
    y.position = r;
    y.velocity = state.velocity;
    y.bodyControlOrientation = {0.0, state.pitchAngle, state.yawAngle};
    y.bodyPositionOrientation = {0.0, 90.0 - std::atan2(r.z(), sphere.horizontal) * degreesPerRadian,
                                 std::atan2(r.y(), r.x()) * degreesPerRadian};
    const Wing wing = this->wing(m_state, air, inputs);
    y.angleOfAttack = wing.air.angleOfAttack;
    y.dragCoefficient = wing.air.drag;
    y.liftCoefficient = wing.air.lift;
    y.aweCoefficient = m_aerodynamics.coefficients(wing.air.angleOfAttack).awe;
    y.gravitationalForce = {0.0, 0.0, -m_parameters.mass * m_parameters.gravity};
    y.tetherLength = state.tetherLength;
    y.averagePower = state.averagePower;
    y.energy = state.energy;
    y.crashed = m_crashed;
    if (isAtRest())
        return y;
    const double speed = drumSpeed(inputs);
    y.aerodynamicForce = wing.air.force;
    y.tetherForce = -tensionNow(m_points - 1, speed) * segment(m_state, m_points - 1).along;
    y.groundTension = tensionNow(0, speed);
    y.power = speed * y.groundTension;
    return y;
}

PlantDetails ExtendedPlant::details(const PlantInputs &inputs) const
{
    constexpr double stationHeight = 6.0;  // [m]
    PlantDetails details;
    details.windAt6m = airAt(stationHeight, inputs).wind;
    details.tetherSpeed = drumSpeed(inputs);
    if (m_isThesis) {
        details.airDensity = m_parameters.airDensity;
        return details;
    }
    const AirAt air = airAt(pointIn(m_state, m_points).z(), inputs);
    details.airDensity = air.density;
    details.steering = single(m_state, Steering);
    details.turbineEnergy = single(m_state, TurbineEnergy);
    details.machineSpeed = m_machine.speed();
    details.machineCurrent = m_machine.current();
    details.machinePosition = m_machine.position();
    details.energies = m_machine.energies();
    details.isMachineOff = isMachineOff();
    details.isDocked = m_isDocked;
    details.dockings = m_dockings;
    details.dockingSpeed = m_dockingSpeed;
    if (!isHeld())
        details.electricalPower = m_machine.electricalPower();  // on the mast, too: the converter is on
    if (!isAtRest())
        details.turbinePower = wing(m_state, air, inputs).turbinePower;
    return details;
}

}  // namespace awe
