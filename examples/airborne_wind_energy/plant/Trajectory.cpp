// SPDX-License-Identifier: Apache-2.0
#include "Trajectory.h"

#include "CsvTable.h"
#include "KitePlant.h"
#include "TrajectoryReader.h"

#include <fstream>
#include <ostream>

namespace awe {

const std::array<const char *, Trajectory::columnCount> &Trajectory::columnNames()
{
    static const std::array<const char *, columnCount> names = {"t",
                                                                "bodyControlPitchSpeed",
                                                                "bodyControlYawSpeed",
                                                                "tetherSpeed",
                                                                "x",
                                                                "y",
                                                                "z",
                                                                "vx",
                                                                "vy",
                                                                "vz",
                                                                "wx",
                                                                "wy",
                                                                "wz",
                                                                "ctrl_roll",
                                                                "ctrl_pitch",
                                                                "ctrl_yaw",
                                                                "pos_roll",
                                                                "pos_pitch",
                                                                "pos_yaw",
                                                                "angleOfAttack",
                                                                "dragCoefficient",
                                                                "liftCoefficient",
                                                                "aweCoefficient",
                                                                "Fgx",
                                                                "Fgy",
                                                                "Fgz",
                                                                "Faex",
                                                                "Faey",
                                                                "Faez",
                                                                "Ftx",
                                                                "Fty",
                                                                "Ftz",
                                                                "tetherLength",
                                                                "power",
                                                                "averagePower",
                                                                "energy"};
    return names;
}

namespace {

// Visits every column of a row in the order of the file, for reading and for writing alike.
template<typename RowType, typename Visitor>
void visitColumns(RowType &row, Visitor visit)
{
    auto &y = row.outputs;
    const auto visitVector = [&visit](auto &vector) {
        for (int i = 0; i < 3; ++i)
            visit(vector[i]);
    };
    visit(row.time);
    visit(y.inputs.pitchSpeed);
    visit(y.inputs.yawSpeed);
    visit(y.inputs.tetherSpeed);
    visitVector(y.position);
    visitVector(y.velocity);
    visitVector(y.inputs.windVelocity);
    visitVector(y.bodyControlOrientation);
    visitVector(y.bodyPositionOrientation);
    visit(y.angleOfAttack);
    visit(y.dragCoefficient);
    visit(y.liftCoefficient);
    visit(y.aweCoefficient);
    visitVector(y.gravitationalForce);
    visitVector(y.aerodynamicForce);
    visitVector(y.tetherForce);
    visit(y.tetherLength);
    visit(y.power);
    visit(y.averagePower);
    visit(y.energy);
}

}  // namespace

Trajectory::Columns Trajectory::toColumns(const Row &row)
{
    Columns columns{};
    std::size_t i = 0;
    visitColumns(row, [&](const double &value) { columns[i++] = value; });
    return columns;
}

Trajectory::Row Trajectory::fromColumns(const Columns &columns)
{
    Row row;
    std::size_t i = 0;
    visitColumns(row, [&](double &value) { value = columns[i++]; });
    return row;
}

std::string Trajectory::load(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file)
        return path + ": cannot be opened for reading; check the name and the permissions";
    return read(file, path);
}

std::string Trajectory::read(std::istream &stream, const std::string &name)
{
    TrajectoryReader reader(stream, name);
    Trajectory found;
    if (!reader.read(found))
        return reader.message();
    *this = std::move(found);
    return {};
}

std::string Trajectory::save(const std::string &path) const
{
    return saveWhole(path, [this](std::ostream &stream) { write(stream); });
}

void Trajectory::write(std::ostream &stream) const
{
    for (const std::string &comment : m_comments)
        stream << comment << '\n';
    writeCsvNames(stream, columnNames().data(), columnCount);
    for (const Row &row : m_rows)
        writeCsvRow(stream, toColumns(row).data(), columnCount);
}

Trajectory Trajectory::replayed() const
{
    PlantParameters parameters;
    parameters.initialState = m_initialState;
    parameters.step = m_step;
    KitePlant plant(parameters);
    Trajectory result = *this;
    for (Row &row : result.m_rows) {
        const PlantInputs inputs = row.outputs.inputs;
        row.outputs = plant.outputs(inputs);
        plant.step(inputs);
    }
    return result;
}

}  // namespace awe
