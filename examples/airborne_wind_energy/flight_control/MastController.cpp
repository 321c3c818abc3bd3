// SPDX-License-Identifier: Apache-2.0
#include "MastController.h"

#include "AngleMath.h"
#include "WingFrame.h"

#include <cmath>

namespace awe {

namespace {

constexpr double leastLift = 20.0;                                  // less moves nothing [N]
constexpr double leastFlow = 1.0;                                   // the same for v_rr [m/s]
constexpr double releaseMargin = 2.0;                               // the mast catches the wing again beyond it [m]
constexpr int bisections = 12;                                      // 14 deg / 2^12 is far below what the pitch follows
constexpr double lowestKnownAngle = 2.0, highestKnownAngle = 20.0;  // where lift grows with alpha [deg]

}  // namespace

MastController::MastController(const AutopilotGains &gains)
    : m_gains(gains)
    , m_mast(gains.mast)
    , m_wind(gains.mast.windFilterTime, gains.step)
    , m_shortWind(gains.mast.lullFilterTime, gains.step)
    , m_force(gains.forceFilterTime, gains.step)
{
}

void MastController::reset()
{
    *this = MastController(m_gains);
}

void MastController::enter(Stage stage)
{
    m_stage = stage;
    m_stageTime = 0.0;
}

void MastController::observe(const FlightMeasurements &measurements)
{
    const double wind = measurements.windVelocity.norm();
    if (!m_hasMeasured) {
        m_wind.reset(wind);
        m_shortWind.reset(wind);
        m_hasMeasured = true;
    }
    m_wind.step(wind);
    m_shortWind.step(wind);
    m_force.step(measurements.tetherForce);
    m_stageTime += m_gains.step;
    m_flightTime = m_stage == Stage::Docked ? 0.0 : m_flightTime + m_gains.step;
}

bool MastController::wantsToFly(FlightRequest request) const
{
    if (isLull() || request == FlightRequest::Land)
        return false;
    return request == FlightRequest::Fly
        || (m_stageTime >= m_mast.leastDockedTime && m_wind.value() >= m_mast.startWind
            && m_wind.value() <= m_mast.stormStartWind);
}

bool MastController::wantsToLand(FlightRequest request) const
{
    if (isLull() || request == FlightRequest::Land)
        return true;
    return request == FlightRequest::Automatic && m_flightTime >= m_mast.leastFlightTime
        && (m_wind.value() < m_mast.landWind || m_wind.value() > m_mast.stormLandWind);
}

void MastController::chooseNext(const FlightMeasurements &measurements, FlightPhase cyclePhase)
{
    if (m_stage == Stage::Docked) {
        if (!measurements.isDocked)
            enter(Stage::Descend);
        else if (wantsToFly(measurements.request))
            enter(Stage::Ascend);
        return;
    }
    if (m_stage == Stage::Descend) {
        if (measurements.isDocked)
            enter(Stage::Docked);
        return;
    }
    const bool isTurning
        = m_stage == Stage::Cycle && (cyclePhase == FlightPhase::Retract || cyclePhase == FlightPhase::Recover);
    const bool isLeaving = m_stage == Stage::Ascend && m_stageTime < m_mast.startTime;
    if (wantsToLand(measurements.request) && (isLull() || (!isTurning && !isLeaving)))
        enter(Stage::Descend);
    else if (m_stage == Stage::Ascend && measurements.tetherLength >= m_mast.parkTether)
        enter(Stage::Park);
    else if (m_stage == Stage::Park && m_stageTime >= m_mast.parkTime)
        enter(Stage::Cycle);
}

MastController::Flow MastController::flowAt(const FlightMeasurements &measurements)
{
    const Eigen::Vector3d relativeWind = measurements.windVelocity - measurements.velocity;
    const Sphere sphere(measurements.position);
    return {relativeWind.dot(sphere.outwards()), relativeWind.dot(sphere.zenithwards()),
            relativeWind.dot(sphere.azimuthwards()), relativeWind.norm(), measurements.velocity.dot(sphere.outwards())};
}

double MastController::dynamicForce(const Flow &flow) const
{
    return 0.5 * m_mast.density * m_mast.area * flow.speed * flow.speed;
}

Aerodynamics::Coefficients MastController::coefficientsAt(double angleOfAttack) const
{
    return m_aerodynamics.coefficients(std::clamp(angleOfAttack, lowestKnownAngle, highestKnownAngle));
}

double MastController::yawReference(const Flow &flow, const FlightGeometry &geometry, double angleOfAttack) const
{
    // Behind the winch the way round is the long one.
    const double sine
        = std::abs(geometry.azimuth) > 0.5 * pi ? std::copysign(1.0, geometry.azimuth) : std::sin(geometry.azimuth);
    const double sideways = geometry.distance * geometry.cosElevation * sine;
    const double speed = -saturate(m_mast.positionGain * sideways, m_mast.fastestDrift);
    const double force = m_mast.mass * m_mast.speedGain * (speed - geometry.azimuthSpeed);
    const Aerodynamics::Coefficients coefficients = coefficientsAt(angleOfAttack);
    const double pressure = dynamicForce(flow);
    const double drag = pressure * coefficients.drag * flow.azimuthwards / std::max(flow.speed, leastFlow);
    const double along = std::max(leastFlow, std::hypot(flow.outwards, flow.zenithwards));
    const double lift = std::max(leastLift, pressure * coefficients.lift * std::max(flow.outwards, leastFlow) / along);
    const double largest = std::sin(m_mast.largestYaw * radiansPerDegree);
    return std::asin(saturate((drag - force) / lift, largest)) * degreesPerRadian;
}

double MastController::angleOfAttackFor(double force, double lift, double drag) const
{
    double low = m_mast.lowestAngleOfAttack, high = m_mast.highestAngleOfAttack;
    for (int i = 0; i < bisections; ++i) {
        const double middle = 0.5 * (low + high);
        const Aerodynamics::Coefficients coefficients = m_aerodynamics.coefficients(middle);
        (lift * coefficients.lift + drag * coefficients.drag < force ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double MastController::zenithForce(const FlightGeometry &geometry) const
{
    const double missing = m_mast.elevation * radiansPerDegree - geometry.elevation;
    const double speed = saturate(m_mast.positionGain * geometry.distance * missing, m_mast.fastestDrift);
    return m_mast.mass * (m_mast.speedGain * (speed - geometry.zenithSpeed) + m_mast.gravity * geometry.cosElevation);
}

double MastController::outwardForce(const FlightGeometry &geometry) const
{
    return m_mast.leastTension + m_mast.mass * m_mast.gravity * std::sin(geometry.elevation);
}

double MastController::angleOfAttackReference(const Flow &flow, const FlightGeometry &geometry,
                                              double tetherSpeed) const
{
    const double pressure = dynamicForce(flow);
    const double speed = std::max(flow.speed, leastFlow);
    const double lift = pressure * std::cos(geometry.heading * radiansPerDegree)
        / std::max(leastFlow, std::hypot(flow.outwards, flow.zenithwards));
    const double angle
        = angleOfAttackFor(zenithForce(geometry), lift * flow.outwards, pressure * flow.zenithwards / speed);
    if (isLull() || flow.zenithwards >= 0.0)  // lift would pull over the mast, or towards the winch
        return angle;
    const double force = outwardForce(geometry) + m_mast.mass * m_mast.speedGain * (tetherSpeed - flow.outwardSpeed);
    return std::max(angle, angleOfAttackFor(force, -lift * flow.zenithwards, pressure * flow.outwards / speed));
}

double MastController::fastestFollow(const Flow &flow, const FlightGeometry &geometry, double angleOfAttack) const
{
    const double drag = dynamicForce(flow) * coefficientsAt(angleOfAttack).drag / std::max(flow.speed, leastFlow);
    const double zenithLift = zenithForce(geometry) - drag * flow.zenithwards;
    const double outwardLift = std::max(leastLift, outwardForce(geometry) - drag * flow.outwards);
    return flow.outwardSpeed + flow.outwards + std::min(0.0, flow.zenithwards) * zenithLift / outwardLift;
}

double MastController::tetherSpeed(const Flow &flow, const FlightGeometry &geometry, double tetherLength) const
{
    const double force = m_force.value();
    if (m_stage == Stage::Ascend) {
        const double speed = std::clamp(m_mast.ascentGain * (force - m_mast.ascentForce), -1.0, m_mast.fastestAscent);
        return tetherLength <= m_mast.distance ? std::max(0.0, speed) : speed;
    }
    if (m_stage != Stage::Descend)
        return 0.0;
    const double before = tetherLength - m_mast.distance;
    if (before <= -m_mast.shortestOvershoot)
        return 0.0;
    const double descent = std::clamp(m_mast.slowestDescent + m_mast.descentSlope * (before - m_mast.slowDistance),
                                      m_mast.slowestDescent, m_mast.fastestDescent)
        * saturate((m_mast.highestForce - force) / m_mast.forceRange, 1.0)
        * std::clamp((m_mast.fastestCrosswind - geometry.tangentialSpeed) / m_mast.crosswindRange, 0.0, 1.0);
    const double pull = std::clamp(m_mast.airspeedGain * (m_mast.leastAirspeed - flow.speed), 0.0, m_mast.fastestPull)
        * std::clamp(before / m_mast.gentleDistance, 0.0, 1.0);
    return -descent - pull;
}

MastController::References MastController::step(const FlightMeasurements &measurements, const FlightGeometry &geometry,
                                                FlightPhase cyclePhase, double tetherSpeed)
{
    observe(measurements);
    const Stage before = m_stage;
    chooseNext(measurements, cyclePhase);

    References references;
    references.fliesCycle = m_stage == Stage::Cycle;
    references.beginsCycle = references.fliesCycle && before != Stage::Cycle;
    if (references.fliesCycle || m_stage == Stage::Docked)
        return references;
    references.phase = m_stage == Stage::Ascend ? FlightPhase::Ascend
        : m_stage == Stage::Park                ? FlightPhase::Park
                                                : FlightPhase::Descend;
    const Flow flow = flowAt(measurements);
    references.yaw = yawReference(flow, geometry, measurements.angleOfAttack);
    const double turn = angleOfAttackReference(flow, geometry, tetherSpeed) - measurements.angleOfAttack;
    references.pitch.angle = std::clamp(measurements.pitchAngle + turn, m_gains.lowestPitch, m_mast.highestPitch);
    double speed = this->tetherSpeed(flow, geometry, measurements.tetherLength);
    if (m_stage == Stage::Descend && !isLull())
        speed = std::max(speed, std::min(0.0, fastestFollow(flow, geometry, measurements.angleOfAttack)));
    const double most = m_gains.winchAcceleration * m_gains.step;
    references.tetherSpeed = std::clamp(speed, tetherSpeed - most, tetherSpeed + most);
    references.release = m_stage == Stage::Ascend && geometry.distance < m_mast.distance + releaseMargin;
    return references;
}

}  // namespace awe
