// SPDX-License-Identifier: Apache-2.0
#include "TrajectoryReader.h"

#include "CsvTable.h"
#include "PlantParameters.h"

#include <cmath>
#include <istream>

namespace awe {

namespace {

bool startsWith(std::string_view text, std::string_view start)
{
    return text.substr(0, start.size()) == start;
}

// The text between the first \a before and the next \a after; no value when one of them is missing.
bool between(std::string_view text, std::string_view before, std::string_view after, std::string_view &found)
{
    const std::size_t start = text.find(before);
    if (start == std::string_view::npos)
        return false;
    const std::string_view rest = text.substr(start + before.size());
    const std::size_t end = rest.find(after);
    if (end == std::string_view::npos)
        return false;
    found = rest.substr(0, end);
    return true;
}

}  // namespace

TrajectoryReader::TrajectoryReader(std::istream &stream, const std::string &name)
    : m_stream(stream)
    , m_name(name)
{
}

bool TrajectoryReader::read(Trajectory &trajectory)
{
    return readComments(trajectory) && readColumnNames() && checkParameters(trajectory) && readRows(trajectory);
}

bool TrajectoryReader::nextLine()
{
    ++m_lineNumber;
    if (!std::getline(m_stream, m_line)) {
        m_line.clear();
        return false;
    }
    if (!m_line.empty() && m_line.back() == '\r')
        m_line.pop_back();
    return true;
}

/// \return true when there is nothing wrong
bool TrajectoryReader::accept(const std::string &wrong)
{
    return wrong.empty() || fail(wrong);
}

bool TrajectoryReader::fail(const std::string &what)
{
    m_message = m_name + ':' + std::to_string(m_lineNumber) + ": " + what;
    return false;
}

bool TrajectoryReader::readComments(Trajectory &trajectory)
{
    bool hasWind = false, hasInitialState = false;
    while (nextLine() && startsWith(m_line, "#")) {
        trajectory.m_comments.push_back(m_line);
        if (startsWith(m_line, "# wind = ")) {
            hasWind = true;
            if (!readWindLine(trajectory))
                return false;
        } else if (startsWith(m_line, "# x0 = ")) {
            hasInitialState = true;
            if (!readInitialState(trajectory))
                return false;
        }
    }
    if (!hasWind)
        return fail("no comment line '# wind = [x y z] m/s; T = ... s; rk4 step ... s' before the table; add it");
    if (!hasInitialState)
        return fail("no comment line '# x0 = [names] = [11 numbers]' before the table; add it");
    return true;
}

bool TrajectoryReader::readWindLine(Trajectory &trajectory)
{
    std::string_view wind, duration, step;
    if (!between(m_line, "# wind = [", "] m/s; ", wind))
        return fail("the wind is not written as '# wind = [x y z] m/s; '; write it so");
    if (!between(m_line, "; T = ", " s;", duration))
        return fail("the duration is not written as '; T = 6 s;'; write it so");
    if (!between(m_line, "rk4 step ", " s", step))
        return fail("the step is not written as 'rk4 step 0.01 s'; write it so");
    return readNumbers(wind, "wind", trajectory.m_windVelocity.data(), 3)
        && readNumber(duration, "T", trajectory.m_duration) && readNumber(step, "rk4 step", trajectory.m_step);
}

bool TrajectoryReader::readInitialState(Trajectory &trajectory)
{
    std::string_view numbers;
    if (!between(m_line, "] = [", "]", numbers))
        return fail("the initial state is not written as '# x0 = [names] = [11 numbers]'; write it so");
    std::array<double, 11> x{};
    if (!readNumbers(numbers, "x0", x.data(), x.size()))
        return false;
    PlantState &state = trajectory.m_initialState;
    state.position = {x[0], x[1], x[2]};
    state.velocity = {x[3], x[4], x[5]};
    state.pitchAngle = x[6];
    state.yawAngle = x[7];
    state.tetherLength = x[8];
    state.averagePower = x[9];
    state.energy = x[10];
    return true;
}

bool TrajectoryReader::readColumnNames()
{
    return accept(checkCsvNames(m_line, Trajectory::columnNames().data(), Trajectory::columnCount));
}

bool TrajectoryReader::checkParameters(const Trajectory &trajectory)
{
    PlantParameters parameters;
    parameters.step = trajectory.m_step;
    parameters.initialState = trajectory.m_initialState;
    const std::string complaint = parameters.validate();
    if (!complaint.empty())
        return fail(complaint);
    if (!(trajectory.m_duration >= 0.0 && trajectory.m_duration <= 1e6))
        return fail("T is not between 0 and 1e6 s; correct the comment line with the wind");
    return true;
}

bool TrajectoryReader::readRows(Trajectory &trajectory)
{
    const long wanted = std::lround(trajectory.m_duration / trajectory.m_step) + 1;
    while (nextLine()) {
        const long index = static_cast<long>(trajectory.m_rows.size());
        if (index == wanted)
            return fail("more rows than the " + std::to_string(wanted) + " of T / step + 1; remove them or correct T");
        Trajectory::Row row;
        if (!readRow(row))
            return false;
        if (std::abs(row.time - static_cast<double>(index) * trajectory.m_step) > 1e-3 * trajectory.m_step)
            return fail("time " + std::to_string(row.time) + " s in row " + std::to_string(index)
                        + "; it must be row times step");
        trajectory.m_rows.push_back(row);
    }
    if (static_cast<long>(trajectory.m_rows.size()) != wanted)
        return fail("the file ends after " + std::to_string(trajectory.m_rows.size()) + " rows; T / step + 1 are "
                    + std::to_string(wanted) + ", complete the file or correct T");
    return true;
}

bool TrajectoryReader::readRow(Trajectory::Row &row)
{
    Trajectory::Columns columns{};
    if (!accept(readCsvRow(m_line, Trajectory::columnNames().data(), columns.data(), columns.size())))
        return false;
    row = Trajectory::fromColumns(columns);
    return true;
}

bool TrajectoryReader::readNumber(std::string_view text, const char *what, double &value)
{
    return accept(awe::readNumber(text, what, &value));
}

bool TrajectoryReader::readNumbers(std::string_view text, const char *what, double *values, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t space = text.find(' ');
        if ((space == std::string_view::npos) != (i + 1 == count))
            return fail(std::string(what) + " has not " + std::to_string(count)
                        + " numbers; separate them by one space each");
        if (!readNumber(text.substr(0, space), what, values[i]))
            return false;
        text.remove_prefix(space == std::string_view::npos ? text.size() : space + 1);
    }
    return true;
}

}  // namespace awe
