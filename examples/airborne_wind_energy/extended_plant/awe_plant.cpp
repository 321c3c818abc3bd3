// SPDX-License-Identifier: Apache-2.0
// Replays a recorded flight: the plant starts in the state of the file, gets its inputs and its
// wind, and writes what it does into a second file of the same form.

#include "ExtendedTrajectory.h"
#include "Trajectory.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

constexpr int success = 0;
constexpr int badUse = 2;

const char usage[] = "usage: awe_plant --replay IN.csv --out OUT.csv\n"
                     "Flies the inputs and the wind of IN.csv with the airborne wind energy plant, with the options\n"
                     "that its header names, and writes the flight to OUT.csv. Exit code 0: written; 2: bad option or "
                     "bad file, nothing written.\n";

struct Options
{
    std::string input, output;
    bool help = false;
};

// Empty when all is well, otherwise what is wrong and how to mend it.
std::string parse(const std::vector<std::string> &arguments, Options &options)
{
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string &option = arguments[i];
        if (option == "--help" || option == "-h") {
            options.help = true;
            return {};
        }
        if (option != "--replay" && option != "--out")
            return "unknown option '" + option + "'; the options are --replay, --out and --help";
        if (i + 1 == arguments.size())
            return "option '" + option + "' has no value; put a file name behind it";
        std::string &value = option == "--replay" ? options.input : options.output;
        if (!value.empty())
            return "option '" + option + "' is there twice; give it once";
        value = arguments[++i];
        if (value.empty())
            return "option '" + option + "' has an empty value; put a file name behind it";
    }
    if (options.input.empty())
        return "option '--replay' is missing; name the flight to replay: --replay IN.csv";
    if (options.output.empty())
        return "option '--out' is missing; name the file to write: --out OUT.csv";
    return {};
}

const awe::ExtendedTrajectory::Row &columnsOf(const awe::ExtendedTrajectory::Row &row)
{
    return row;
}

awe::Trajectory::Columns columnsOf(const awe::Trajectory::Row &row)
{
    return awe::Trajectory::toColumns(row);
}

/// \return empty, or from where on \a flight has values that are not finite, and the remedy
template<typename Flight>
std::string divergence(const Flight &flight)
{
    for (const auto &row : flight.rows()) {
        const auto &columns = columnsOf(row);
        if (!std::all_of(columns.begin(), columns.end(), [](double value) { return std::isfinite(value); }))
            return "the flight diverges before " + std::to_string(columns[0])
                + " s; look for values in its start and inputs that no kite survives";
    }
    return {};
}

template<typename Flight>
std::string replay(const Options &options)
{
    Flight recorded;
    std::string complaint = recorded.load(options.input);
    if (!complaint.empty())
        return complaint;
    const Flight flown = recorded.replayed();
    complaint = divergence(flown);
    return complaint.empty() ? flown.save(options.output) : options.input + ": " + complaint;
}

}  // namespace

int main(int argc, char **argv)
{
    Options options;
    std::string complaint = parse(std::vector<std::string>(argv + 1, argv + argc), options);
    if (complaint.empty() && options.help) {
        std::fputs(usage, stdout);
        return success;
    }
    if (complaint.empty())
        complaint = awe::ExtendedTrajectory::isOne(options.input) ? replay<awe::ExtendedTrajectory>(options)
                                                                  : replay<awe::Trajectory>(options);
    if (complaint.empty())
        return success;
    std::fprintf(stderr, "awe_plant: %s\n", complaint.c_str());
    return badUse;
}
