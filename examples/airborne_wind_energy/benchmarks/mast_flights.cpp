// SPDX-License-Identifier: Apache-2.0
// Starts the wing from a mast and lands it there, in calm and turbulent air, and flies days at the
// mast. What it prints as JSON is the source of the table and the pictures of docs/plant.md.

#include "MastFlights.h"

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace {

using namespace awe;

constexpr std::uint64_t firstSeed = 10, lastSeed = 17;
constexpr double turbulence = 0.15;
constexpr double curvePeriod = 10.0;                                // [s]
const std::vector<double> calmWinds = {6.0, 7.0, 8.0, 10.0, 12.0};  // [m/s]
const std::vector<double> turbulentWinds = {8.0, 10.0, 12.0};       // [m/s]

struct Plant
{
    const char *name;
    PlantOptions options;
    AutopilotGains gains;
};

std::vector<Plant> plants()
{
    PlantOptions steered;
    steered.steering.kind = SteeringKind::TurnRate;
    return {{"spring", {}, AutopilotGains::safe()},
            {"turn-rate", steered, AutopilotGains::steered()},
            {"realistic", PlantOptions::realistic(), AutopilotGains::steered()},
            {"drag", PlantOptions::drag(), AutopilotGains::drag()}};
}

/// The separator before the next element of a list.
const char *comma(bool *isFirst)
{
    const char *text = *isFirst ? "\n" : ",\n";
    *isFirst = false;
    return text;
}

/// Flies by request, and lands by request.
void printFlight(const Plant &plant, double speed, double intensity, std::uint64_t seed, bool *isFirst)
{
    ClosedLoopParameters parameters;
    parameters.options = plant.options;
    parameters.gains = plant.gains;
    parameters.wind.seed = seed;
    const FlightReport report = startAndLand(atMast(speed, intensity, parameters));
    std::printf("%s  {\"plant\": \"%s\", \"wind\": %g, \"turbulence\": %g, \"seed\": %d, \"docked\": %s, "
                "\"crashed\": %s, \"dockingSpeed\": %.3f}",
                comma(isFirst), plant.name, speed, intensity, int(seed), report.landed ? "true" : "false",
                report.crashed ? "true" : "false", report.dockingSpeed);
}

void printFlights()
{
    bool isFirst = true;
    std::printf(" \"flights\": [");
    for (const Plant &plant : plants()) {
        for (const double speed : calmWinds)
            printFlight(plant, speed, 0.0, firstSeed, &isFirst);
        for (const double speed : turbulentWinds) {
            for (std::uint64_t seed = firstSeed; seed <= lastSeed; ++seed)
                printFlight(plant, speed, turbulence, seed, &isFirst);
        }
    }
    std::printf("\n ],\n");
}

/// Without a request.
void printDays()
{
    bool isFirst = true;
    std::printf(" \"days\": [");
    for (std::uint64_t seed = firstSeed - 1; seed <= lastSeed; ++seed) {
        const double intensity = seed < firstSeed ? 0.0 : turbulence;
        ClosedLoopParameters parameters = dayAtMast(intensity);
        parameters.wind.seed = seed;
        ClosedLoopFlight flight(parameters);
        flight.fly(mastDayDuration);
        const FlightReport report = flight.report();
        std::printf("%s  {\"turbulence\": %g, \"seed\": %d, \"docked\": %s, \"crashed\": %s, \"dockingSpeed\": %.3f, "
                    "\"cycles\": %d, \"starts\": %d, \"energy\": %.0f}",
                    comma(&isFirst), intensity, int(seed), report.landed ? "true" : "false",
                    report.crashed ? "true" : "false", report.dockingSpeed, report.pumpingCycles, report.starts,
                    report.energy);
    }
    std::printf("\n ],\n");
}

/// Time [s], mean wind [m/s] and tether length [m] of a calm day.
void printCurve()
{
    ClosedLoopFlight flight(dayAtMast());
    bool isFirst = true;
    std::printf(" \"day\": [");
    for (double time = 0.0; time < mastDayDuration; time += curvePeriod) {
        flight.fly(curvePeriod);
        std::printf("%s  [%g, %.2f, %.1f]", comma(&isFirst), time + curvePeriod,
                    flight.outputs().inputs.windVelocity.norm(), flight.outputs().tetherLength);
    }
    std::printf("\n ]\n");
}

}  // namespace

int main(int argc, char **argv)
{
    if (argc > 1) {
        const bool isHelp = std::strcmp(argv[1], "--help") == 0;
        std::fprintf(isHelp ? stdout : stderr,
                     "usage: awe_mast_flights\nFlies starts, landings and days at a mast, and prints them as JSON; "
                     "takes a minute or two.\n");
        return isHelp ? 0 : 2;
    }
    std::printf("{\n");
    printFlights();
    printDays();
    printCurve();
    std::printf("}\n");
    return 0;
}
