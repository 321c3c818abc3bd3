// SPDX-License-Identifier: Apache-2.0
// Searches gains of the autopilot that take out more power with a given dead time, and says what
// they are worth: in the flights they were found with, in others, and with the dead time of the
// default links. This is where the tuned gains are from.

#include "GainTuning.h"
#include "PlantConfiguration.h"

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

namespace {

using namespace awe;

constexpr int defaultDeadTime = 2;  // cycles

const char usage[]
    = "usage: awe_tune_gains [--plant PLANT] [--dead-time CYCLES] [--halvings N] [--least-gain ETA] [--seconds S]\n"
      "Searches gains of the autopilot for most power; takes some minutes.\n"
      "  --plant PLANT       name or file of the plant that is flown, as for awe_sil (thesis)\n"
      "  --dead-time CYCLES  from sensor to actuator, 0 ... 63 (0)\n"
      "  --halvings N        how often the steps are halved before it ends, 0: only compares, 0 ... 10 (2)\n"
      "  --least-gain ETA    smaller gains are not worth a change, 0 ... 1 (0.0002)\n"
      "  --seconds S         of each flight of the search, 0 ... 3600; the comparison flies 1800 (1800)\n"
      "Exit code 0: done; 2: bad option.\n";

struct Options
{
    double deadTime = 0.0;
    double halvings = 2.0;
    double leastGain = 0.0002;
    double seconds = 1800.0;
    std::string plant = "thesis";
    bool help = false;
};

struct NumberOption
{
    const char *name;
    double Options::*number;
    double largest;
    bool isWhole;
};

const NumberOption numberOptions[] = {{"--dead-time", &Options::deadTime, ClosedLoopParameters::largestDeadTime, true},
                                      {"--halvings", &Options::halvings, 10.0, true},
                                      {"--least-gain", &Options::leastGain, 1.0, false},
                                      {"--seconds", &Options::seconds, 3600.0, true}};

const NumberOption *optionOf(const std::string &name)
{
    for (const NumberOption &option : numberOptions) {
        if (name == option.name)
            return &option;
    }
    return nullptr;
}

/// \return empty when all is well, otherwise what is wrong and how to mend it
std::string readNumber(const NumberOption &option, const char *text, Options &options)
{
    char *end = nullptr;
    const double number = text ? std::strtod(text, &end) : 0.0;
    const bool isNumber = text && end != text && *end == '\0' && number >= 0.0 && number <= option.largest;
    if (!isNumber || (option.isWhole && number != static_cast<double>(static_cast<int>(number)))) {
        return std::string(option.name) + " " + (text ? text : "without a value") + ": use a "
            + (option.isWhole ? "whole " : "") + "number of 0 ... " + std::to_string(static_cast<int>(option.largest));
    }
    options.*option.number = number;
    return {};
}

std::string parse(int argc, char **argv, Options &options)
{
    for (int i = 1; i < argc; i += 2) {
        const std::string name = argv[i];
        options.help = options.help || name == "--help" || name == "-h";
        if (name == "--plant") {
            if (!argv[i + 1])
                return "--plant without a value: use a name or a file";
            options.plant = argv[i + 1];
            continue;
        }
        const NumberOption *option = optionOf(name);
        if (!option && !options.help)
            return "unknown option '" + name + "'; see --help";
        const std::string complaint = option ? readNumber(*option, argv[i + 1], options) : std::string();
        if (!complaint.empty())
            return complaint;
    }
    return {};
}

void print(const char *what, const GainScore &score)
{
    std::printf("%-40s %9.5f %9.5f %9.5f %9.2f %9.2f %9.0f %s\n", what, score.calmEta, score.turbulentEta,
                score.strongEta, score.calmAltitude, score.turbulentAltitude, score.limitedForce,
                score.crashed ? "CRASHED" : "");
    std::fflush(stdout);
}

/// What is flown, without its gains. \return empty when all is well, otherwise what is wrong
std::string readPlant(const Options &options, ClosedLoopParameters *parameters)
{
    PlantConfiguration plant;
    QString error;
    if (!PlantConfiguration::read(QString::fromStdString(options.plant), &plant, &error))
        return error.toStdString();
    if (plant.hasDrive() || plant.options.hasTurbines || plant.options.mast.isPresent)
        return "--plant " + options.plant
            + ": the search flies pumping cycles, without hardware and without a mast; use another plant";
    parameters->plant = plant.kite.plantIn(plant.kite.wind);
    parameters->plant.groundContact = GroundContact::Hold;
    parameters->wind = plant.kite.wind;
    parameters->options = plant.options;
    parameters->deadTime = static_cast<int>(options.deadTime);
    return parameters->validate();
}

void printScores(const char *name, const AutopilotGains &gains, ClosedLoopParameters parameters)
{
    const std::string what = name;
    parameters.gains = gains;
    print((what + ", seeds 1...8").c_str(), scoreOf(parameters));
    print((what + ", seeds 9...24").c_str(), scoreOf(parameters, TuningSeeds::Fresh));
    if (parameters.deadTime == defaultDeadTime)
        return;
    parameters.deadTime = defaultDeadTime;
    print((what + ", dead time 2, seeds 1...8").c_str(), scoreOf(parameters));
    print((what + ", dead time 2, seeds 9...24").c_str(), scoreOf(parameters, TuningSeeds::Fresh));
}

void printChanges(std::FILE *file, const char *end, const AutopilotGains &start, const AutopilotGains &gains)
{
    for (const TunableGain &tunable : TunableGain::all()) {
        if (start.*tunable.gain != gains.*tunable.gain)
            std::fprintf(file, "%s %.6g -> %.6g%s", tunable.name, start.*tunable.gain, gains.*tunable.gain, end);
    }
}

AutopilotGains search(const Options &options, ClosedLoopParameters parameters, const AutopilotGains &start)
{
    std::vector<Coordinate> ranges;
    for (const TunableGain &tunable : TunableGain::all())
        ranges.push_back(tunable.range);
    double best = 0.0;
    const auto function = [&](const CoordinateSearch::Point &point) {
        parameters.gains = TunableGain::write(start, point);
        if (!parameters.gains.validate().empty())
            return -std::numeric_limits<double>::infinity();
        const double value = scoreOf(parameters, TuningSeeds::Tuned, options.seconds).value();
        if (value > best) {
            std::fprintf(stderr, "%.5f  ", best = value);
            printChanges(stderr, ", ", start, parameters.gains);
            std::fprintf(stderr, "\n");
        }
        return value;
    };
    CoordinateSearch search(function, ranges, options.leastGain);
    const CoordinateSearch::Point point = search.climb(TunableGain::read(start), static_cast<int>(options.halvings));
    std::printf("%d sets of gains flown\n", search.evaluations());
    return TunableGain::write(start, point);
}

}  // namespace

int main(int argc, char **argv)
{
    Options options;
    ClosedLoopParameters parameters;
    std::string complaint = parse(argc, argv, options);
    if (complaint.empty() && !options.help)
        complaint = readPlant(options, &parameters);
    if (!complaint.empty()) {
        std::fprintf(stderr, "awe_tune_gains: %s\n", complaint.c_str());
        return 2;
    }
    if (options.help) {
        std::fputs(usage, stdout);
        return 0;
    }
    const SteeringParameters &steering = parameters.options.steering;
    const AutopilotGains start = startOfTuning(steering);
    std::printf("%-40s %9s %9s %9s %9s %9s %9s\n", "", "calm eta", "turb. eta", "8-12 m/s", "calm z", "turb. z",
                "4 kN");
    printScores("start", start, parameters);
    const bool isSteered = steering.kind == SteeringKind::TurnRate;
    const AutopilotGains tuned = isSteered
        ? AutopilotGains::steeredTuned().invertedFor(steering.turnRateFactor, steering.weightFactor)
        : AutopilotGains::tuned();
    printScores("tuned gains", tuned, parameters);
    if (options.halvings > 0.0) {
        const AutopilotGains found = search(options, parameters, start);
        printChanges(stdout, "\n", start, found);
        printScores("found gains", found, parameters);
    }
    return 0;
}
