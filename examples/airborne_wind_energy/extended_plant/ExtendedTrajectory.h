// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ExtendedPlant.h"

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

class QJsonArray;
class QJsonValue;
class QString;

namespace awe {

/// A flight of an ExtendedPlant as a table: a row for each ten cycles, whose inputs act until the
/// next row.
///
/// File format, lines of text (CSV):
///
///     # name: free description
///     # plant2 = {"plant2": 1, "parameters": {"tether": "segments"}, "wind_m_s": [5, 3, 0], "winch": "ideal"}
///     # any further comments
///     t,pitchSpeed,yawInput,...                                the 53 names of columnNames(), in this order
///     0,0,0,0,...
///
/// `parameters` has what differs from the plant of the thesis: `tether` (spring, straight,
/// segments), `segments`, `profile` (uniform, power, log), `hRef`, `p`, `z0`, `density` (constant,
/// falling), `steering` (kinematic, turn_rate), `c1`, `c2`. `winch` is ideal or machine. A flight
/// with a turbine coefficient has turbines. With the turn-rate law, `yawInput` is the command of
/// the steering, otherwise the yaw speed. The start is the state of the first row; the machine
/// stands.
class ExtendedTrajectory
{
public:
    static constexpr std::size_t columnCount = 53;
    static constexpr int cyclesPerRow = 10;
    using Row = std::array<double, columnCount>;

    static const std::array<const char *, columnCount> &columnNames();

    /// true if the file \a path begins like one of these; such files have another header than those
    /// of Trajectory
    static bool isOne(const std::string &path);

    /// Reads a file. On failure the object is unchanged.
    /// \return empty when all is well, otherwise "file:line: what is wrong; remedy"
    std::string load(const std::string &path);
    /// Writes a file, as Trajectory does.
    std::string save(const std::string &path) const;

    const PlantOptions &options() const { return m_options; }
    const std::vector<Row> &rows() const { return m_rows; }

    /// The plant of the header, started in the state of the first row and driven by the inputs of
    /// every row. \return the same header with the rows that the plant gives
    ExtendedTrajectory replayed() const;

private:
    std::string read(std::istream &stream, const std::string &name);
    std::string readHeader(const std::string &json);
    std::string setHeader(const QString &key, const QJsonValue &value);
    std::string setWind(const QJsonArray &components);
    std::string checkStart();
    std::string checkTime() const;

    std::vector<std::string> m_comments;
    PlantParameters m_parameters;
    PlantOptions m_options;
    Eigen::Vector3d m_wind = Eigen::Vector3d::Zero();  // w_ref [m/s]
    std::vector<Row> m_rows;
};

}  // namespace awe
