// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantOutputs.h"
#include "PlantState.h"

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

namespace awe {

/// A flight as a table: one row per step, row k holds the inputs from t(k) to t(k+1) and the
/// outputs at t(k).
///
/// File format, lines of text (CSV):
///
///     # name: free description
///     # wind = [5 3 0] m/s; T = 6 s; rk4 step 0.01 s; free text
///     # x0 = [r v beta_c gamma_c l_t averagePower energy] = [11 numbers]
///     # any further comments
///     t,bodyControlPitchSpeed,...,energy                      the 36 names of columnNames(), in this order
///     0,0,0,0,43.9888...                                      T / step + 1 rows of 36 numbers
///
/// Reading is strict: everything above must be there and every number must be finite. Numbers are
/// written with 17 significant digits, which is enough to get the same double back. Files do not
/// depend on the locale.
class Trajectory
{
public:
    static constexpr std::size_t columnCount = 36;
    using Columns = std::array<double, columnCount>;

    struct Row
    {
        double time = 0.0;  // [s]
        PlantOutputs outputs;
    };

    /// The names of the columns, in the order of the file.
    static const std::array<const char *, columnCount> &columnNames();
    static Columns toColumns(const Row &row);
    static Row fromColumns(const Columns &columns);

    /// Reads a file. On failure the object is unchanged.
    /// \return empty when all is well, otherwise "file:line: what is wrong; remedy"
    std::string load(const std::string &path);

    /// Reads from a stream; \a name stands for the file in messages.
    std::string read(std::istream &stream, const std::string &name);

    /// Writes a file: first completely to a temporary one beside it, which then takes the name.
    /// \return empty when all is well, otherwise one sentence; an older file of that name is then
    ///         untouched
    std::string save(const std::string &path) const;

    void write(std::ostream &stream) const;

    const std::vector<std::string> &comments() const { return m_comments; }  // whole lines, '#' included
    const Eigen::Vector3d &windVelocity() const { return m_windVelocity; }   // of the header [m/s]
    double duration() const { return m_duration; }                           // T of the header [s]
    double step() const { return m_step; }                                   // [s]
    const PlantState &initialState() const { return m_initialState; }
    const std::vector<Row> &rows() const { return m_rows; }

    /// The plant of the thesis, started in initialState() and driven by the inputs and the wind of
    /// every row.
    /// \return the same header with the rows the plant gives
    Trajectory replayed() const;

private:
    friend class TrajectoryReader;

    std::vector<std::string> m_comments;
    Eigen::Vector3d m_windVelocity = Eigen::Vector3d::Zero();
    double m_duration = 0.0;
    double m_step = 0.0;
    PlantState m_initialState;
    std::vector<Row> m_rows;
};

}  // namespace awe
