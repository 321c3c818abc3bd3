// SPDX-License-Identifier: Apache-2.0
#include "ClosedLoopFlight.h"
#include "ExtendedPlant.h"
#include "WinchDrive.h"
#include "WinchStatistics.h"

#include "Near.h"

#include <cstdlib>
#include <new>

namespace {

long allocations = 0;

}  // namespace

// Counted for the whole program; the aligned forms too, because Eigen may ask for them.
void *operator new(std::size_t size)
{
    ++allocations;
    if (void *memory = std::malloc(size))
        return memory;
    throw std::bad_alloc();
}

void *operator new(std::size_t size, std::align_val_t alignment)
{
    ++allocations;
    const std::size_t step = static_cast<std::size_t>(alignment);
    if (void *memory = std::aligned_alloc(step, (size + step - 1) / step * step))
        return memory;
    throw std::bad_alloc();
}

void operator delete(void *memory) noexcept
{
    std::free(memory);
}

void operator delete(void *memory, std::size_t) noexcept
{
    std::free(memory);
}

void operator delete(void *memory, std::align_val_t) noexcept
{
    std::free(memory);
}

void operator delete(void *memory, std::size_t, std::align_val_t) noexcept
{
    std::free(memory);
}

using namespace awe;

class tst_Allocations : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void counterDetectsAllocations();
    void closedLoopAllocatesNoMemoryInAnyPhase();
    void crashedFlightAllocatesNoMemory();
    void resetAllocatesNoMemory();
    void winchDriveAllocatesNoMemory();
    void plantWithAllOptionsAllocatesNoMemory();
};

void tst_Allocations::counterDetectsAllocations()
{
    const long before = allocations;
    ::operator delete(::operator new(1));  // written as calls: a compiler may drop a new-expression
    QVERIFY(allocations > before);
}

/// Up, ten seconds of the pumping cycle, and down again.
static void flyFromMast(bool *seen)
{
    ClosedLoopParameters parameters;
    parameters.options.mast.isPresent = parameters.gains.mast.isPresent = true;
    parameters.wind.meanVelocity *= 1.5;
    ClosedLoopFlight flight(parameters);
    flight.setRequest(FlightRequest::Fly);
    for (int i = 0; i < 20000; ++i) {
        if (i == 12000)
            flight.setRequest(FlightRequest::Land);
        flight.step();
        seen[static_cast<int>(flight.autopilotOutputs().phase)] = true;
    }
}

void tst_Allocations::closedLoopAllocatesNoMemoryInAnyPhase()
{
    ClosedLoopParameters parameters;
    parameters.wind.turbulenceIntensity = 0.25;  // with recoveries
    parameters.wind.gustAmplitude = 0.5;
    parameters.wind.seed = 10;
    parameters.gains.forceLimit = 4000.0;
    ClosedLoopFlight flight(parameters);
    bool seen[flightPhaseCount] = {};
    const long before = allocations;
    for (int i = 0; i < 180000; ++i) {
        flight.step();
        seen[static_cast<int>(flight.autopilotOutputs().phase)] = true;
    }
    const FlightReport report = flight.report();
    flyFromMast(seen);
    QCOMPARE(allocations - before, 0L);
    for (int phase = 0; phase < flightPhaseCount; ++phase)
        QVERIFY2(seen[phase], flightPhaseName(static_cast<FlightPhase>(phase)));
    QVERIFY(report.recoveries > 0);
}

void tst_Allocations::crashedFlightAllocatesNoMemory()
{
    ClosedLoopParameters parameters;
    parameters.plant.initialState.position.z() = 0.1;
    parameters.wind.meanVelocity = {0.5, 0.0, 0.0};
    ClosedLoopFlight flight(parameters);
    const long before = allocations;
    for (int i = 0; i < 5000; ++i)
        flight.step();
    QCOMPARE(allocations - before, 0L);
    QVERIFY(flight.report().crashed);
}

void tst_Allocations::resetAllocatesNoMemory()
{
    ClosedLoopFlight flight{ClosedLoopParameters()};
    flight.fly(10.0);
    const long before = allocations;
    flight.reset();
    QCOMPARE(allocations - before, 0L);
}

void tst_Allocations::winchDriveAllocatesNoMemory()
{
    WinchDrive drive;
    WinchStatistics statistics;
    WinchDriveInputs inputs;
    inputs.enable = true;
    const long before = allocations;
    for (int i = 0; i < 10000; ++i) {
        inputs.hasCommand = i < 5000;  // then it stops by itself
        inputs.speedSetpoint = i < 2500 ? 65.0 : -130.0;
        inputs.tetherForce = 1000.0;
        inputs.emergencyStop = i > 9000;
        drive.step(inputs);
        WinchSample sample;
        sample.speed = drive.speed();
        statistics.step(sample);
    }
    const WinchReport report = statistics.report();
    QCOMPARE(allocations - before, 0L);
    QCOMPARE(drive.state(), DriveState::Fault);
    QCOMPARE(report.interruptions, 0);
}

void tst_Allocations::plantWithAllOptionsAllocatesNoMemory()
{
    PlantOptions options;
    options.air.profile = WindProfile::Log;
    options.tether.kind = TetherKind::Segments;
    options.steering.kind = SteeringKind::TurnRate;
    options.hasMachine = options.hasTurbines = true;
    ExtendedPlant plant(PlantParameters(), options);
    PlantInputs inputs;
    inputs.windVelocity = {5.0, 3.0, 0.0};
    const long before = allocations;
    for (int i = 0; i < 500; ++i) {
        plant.step(inputs);
        (void)plant.outputs(inputs);
        (void)plant.details(inputs);
    }
    plant.reset();
    QCOMPARE(allocations - before, 0L);
}

QTEST_APPLESS_MAIN(tst_Allocations)
#include "tst_Allocations.moc"
