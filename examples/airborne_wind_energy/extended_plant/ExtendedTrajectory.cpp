// SPDX-License-Identifier: Apache-2.0
#include "ExtendedTrajectory.h"

#include "CsvTable.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace awe {

namespace {

const char headerStart[] = "# plant2 = ";

// The columns of a row that are read; the others are only written.
enum Column { Time, PitchSpeed, YawInput, TetherSpeed, TurbineCoefficient, X, PitchAngle = 11, YawAngle = 12 };
constexpr std::size_t velocityColumn = 8, tetherLengthColumn = 14, nodeColumn = 38;
constexpr int nodesInFile = 5;

Eigen::Vector3d vectorAt(const ExtendedTrajectory::Row &row, std::size_t column)
{
    return {row[column], row[column + 1], row[column + 2]};
}

/// Takes a word of \a words as the number of its place. \return empty, or the remedy
template<typename Choice>
std::string chosen(const QJsonValue &value, const std::vector<const char *> &words, Choice *choice)
{
    std::string remedy = "use one of";
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (value.toString() == QLatin1String(words[i])) {
            *choice = Choice(int(i));
            return {};
        }
        remedy += std::string(i > 0 ? ", " : " ") + words[i];
    }
    return remedy;
}

std::string taken(const QJsonValue &value, double *number)
{
    if (!value.isDouble())
        return "use a number";
    *number = value.toDouble();
    return {};
}

/// Sets one of the `parameters`. \return empty, or the remedy
std::string setParameter(const QString &key, const QJsonValue &value, PlantOptions *options)
{
    if (key == QLatin1String("tether"))
        return chosen(value, {"spring", "straight", "segments"}, &options->tether.kind);
    if (key == QLatin1String("profile"))
        return chosen(value, {"uniform", "power", "log"}, &options->air.profile);
    if (key == QLatin1String("density"))
        return chosen(value, {"constant", "falling"}, &options->air.isThinner);
    if (key == QLatin1String("steering"))
        return chosen(value, {"kinematic", "turn_rate"}, &options->steering.kind);
    if (key == QLatin1String("hRef"))
        return taken(value, &options->air.referenceHeight);
    if (key == QLatin1String("p"))
        return taken(value, &options->air.exponent);
    if (key == QLatin1String("z0"))
        return taken(value, &options->air.roughness);
    if (key == QLatin1String("c1"))
        return taken(value, &options->steering.turnRateFactor);
    if (key == QLatin1String("c2"))
        return taken(value, &options->steering.weightFactor);
    if (key == QLatin1String("segments")) {
        options->tether.segments = value.toInt(-1);  // also of a number that is not whole
        return options->tether.segments < 0 ? "use a whole number" : std::string();
    }
    return "it is not known; use tether, segments, profile, hRef, p, z0, density, steering, c1 or c2";
}

}  // namespace

const std::array<const char *, ExtendedTrajectory::columnCount> &ExtendedTrajectory::columnNames()
{
    static const std::array<const char *, columnCount> names = {"t",
                                                                "pitchSpeed",
                                                                "yawInput",
                                                                "tetherSpeedSetpoint",
                                                                "turbineCoefficient",
                                                                "x",
                                                                "y",
                                                                "z",
                                                                "vx",
                                                                "vy",
                                                                "vz",
                                                                "pitchAngle",
                                                                "yawAngle",
                                                                "steering",
                                                                "tetherLength",
                                                                "tensionGround",
                                                                "tensionWing",
                                                                "angleOfAttack",
                                                                "dragCoefficient",
                                                                "liftCoefficient",
                                                                "airspeed",
                                                                "wx",
                                                                "wy",
                                                                "wz",
                                                                "Faex",
                                                                "Faey",
                                                                "Faez",
                                                                "power",
                                                                "averagePower",
                                                                "energy",
                                                                "turbinePower",
                                                                "turbineEnergy",
                                                                "driveSpeed",
                                                                "driveCurrent",
                                                                "drivePower",
                                                                "driveEnergy",
                                                                "copperHeat",
                                                                "frictionHeat",
                                                                "n1x",
                                                                "n1y",
                                                                "n1z",
                                                                "n2x",
                                                                "n2y",
                                                                "n2z",
                                                                "n3x",
                                                                "n3y",
                                                                "n3z",
                                                                "n4x",
                                                                "n4y",
                                                                "n4z",
                                                                "n5x",
                                                                "n5y",
                                                                "n5z"};
    return names;
}

bool ExtendedTrajectory::isOne(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    std::string line;
    while (std::getline(file, line) && line.rfind('#', 0) == 0) {
        if (line.rfind(headerStart, 0) == 0)
            return true;
    }
    return false;
}

std::string ExtendedTrajectory::load(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file)
        return path + ": cannot be opened for reading; check the name and the permissions";
    ExtendedTrajectory found;
    const std::string wrong = found.read(file, path);
    if (wrong.empty())
        *this = std::move(found);
    return wrong;
}

std::string ExtendedTrajectory::read(std::istream &stream, const std::string &name)
{
    std::string line;
    long number = 0;
    bool hasHeader = false, hasNames = false;
    while (std::getline(stream, line)) {
        ++number;
        if (!line.empty() && line.back() == '\r')
            line.pop_back();
        std::string wrong;
        if (!hasNames && line.rfind('#', 0) == 0) {
            m_comments.push_back(line);
            if (line.rfind(headerStart, 0) == 0) {
                wrong = hasHeader ? "a second header; leave one of them out"
                                  : readHeader(line.substr(sizeof headerStart - 1));
                hasHeader = true;
            }
        } else if (!hasNames) {
            hasNames = true;
            wrong = hasHeader ? checkCsvNames(line, columnNames().data(), columnCount)
                              : "no comment line '# plant2 = {...}' before the table; add it";
        } else {
            m_rows.emplace_back();
            wrong = readCsvRow(line, columnNames().data(), m_rows.back().data(), columnCount);
        }
        if (wrong.empty() && !m_rows.empty())
            wrong = m_rows.size() == 1 ? checkStart() : checkTime();
        if (!wrong.empty())
            return name + ':' + std::to_string(number) + ": " + wrong;
    }
    return m_rows.empty() ? name + ": has no rows; complete the file" : std::string();
}

std::string ExtendedTrajectory::readHeader(const std::string &json)
{
    QJsonParseError error;
    const QJsonDocument document = QJsonDocument::fromJson(QByteArray::fromStdString(json), &error);
    if (error.error != QJsonParseError::NoError)
        return "the header is not JSON: " + error.errorString().toStdString() + "; correct it";
    const QJsonObject header = document.object();
    for (auto it = header.begin(); it != header.end(); ++it) {
        const std::string remedy = setHeader(it.key(), it.value());
        if (!remedy.empty())
            return "'" + it.key().toStdString() + "' of the header: " + remedy;
    }
    for (const char *key : {"plant2", "wind_m_s", "winch"}) {
        if (!header.contains(QLatin1String(key)))
            return std::string("the header has no '") + key + "'; add it";
    }
    return {};
}

/// Takes one element of the header. \return empty, or the remedy
std::string ExtendedTrajectory::setHeader(const QString &key, const QJsonValue &value)
{
    if (key == QLatin1String("plant2"))
        return value == QJsonValue(1) ? std::string() : "use 1: this program knows no other version";
    if (key == QLatin1String("wind_m_s"))
        return setWind(value.toArray());
    if (key == QLatin1String("winch"))
        return chosen(value, {"ideal", "machine"}, &m_options.hasMachine);
    if (key != QLatin1String("parameters"))
        return "it is not known; use plant2, parameters, wind_m_s and winch";
    if (!value.isObject())
        return "use an object such as {\"tether\": \"segments\"}";
    const QJsonObject parameters = value.toObject();
    for (auto it = parameters.begin(); it != parameters.end(); ++it) {
        const std::string remedy = setParameter(it.key(), it.value(), &m_options);
        if (!remedy.empty())
            return "'" + it.key().toStdString() + "': " + remedy;
    }
    return {};
}

/// \return empty, or the remedy
std::string ExtendedTrajectory::setWind(const QJsonArray &components)
{
    constexpr double strongest = 100.0;  // [m/s]
    bool isWind = components.size() == 3;
    for (int i = 0; i < 3 && isWind; ++i) {
        m_wind[i] = components[i].toDouble(2.0 * strongest);  // also of what is no number
        isWind = std::abs(m_wind[i]) <= strongest;
    }
    return isWind ? std::string() : "use three numbers [x, y, z] from -100 to 100 m/s";
}

/// The first row is the start.
std::string ExtendedTrajectory::checkStart()
{
    const Row &row = m_rows.front();
    PlantState &start = m_parameters.initialState;
    start.position = vectorAt(row, X);
    start.velocity = vectorAt(row, velocityColumn);
    start.pitchAngle = row[PitchAngle];
    start.yawAngle = row[YawAngle];
    start.tetherLength = row[tetherLengthColumn];
    if (m_options.tether.kind == TetherKind::Segments && m_options.tether.segments != nodesInFile + 1)
        return "the tether has " + std::to_string(m_options.tether.segments) + " segments; the table has room for "
            + std::to_string(nodesInFile + 1);
    const std::string wrong = m_parameters.validate();
    return !wrong.empty() ? wrong : m_options.validateFor(m_parameters);
}

/// Each row is ten cycles after the one before.
std::string ExtendedTrajectory::checkTime() const
{
    const double period = cyclesPerRow * m_parameters.step, time = m_rows.back()[Time];
    const double passed = time - m_rows[m_rows.size() - 2][Time];
    if (std::abs(passed - period) < 1e-3 * period)
        return {};
    return "time " + std::to_string(time) + " s; it must be " + std::to_string(period)
        + " s after that of the row before";
}

std::string ExtendedTrajectory::save(const std::string &path) const
{
    return saveWhole(path, [this](std::ostream &stream) {
        for (const std::string &comment : m_comments)
            stream << comment << '\n';
        writeCsvNames(stream, columnNames().data(), columnCount);
        for (const Row &row : m_rows)
            writeCsvRow(stream, row.data(), columnCount);
    });
}

namespace {

PlantInputs inputsOf(const ExtendedTrajectory::Row &row, const Eigen::Vector3d &wind)
{
    PlantInputs inputs;
    inputs.pitchSpeed = row[PitchSpeed];
    inputs.yawSpeed = inputs.steering = row[YawInput];
    inputs.tetherSpeed = row[TetherSpeed];
    inputs.turbineCoefficient = row[TurbineCoefficient];
    inputs.windVelocity = wind;
    return inputs;
}

/// The row that \a plant tells, with the time and inputs of \a recorded.
ExtendedTrajectory::Row rowOf(const ExtendedPlant &plant, const PlantInputs &inputs,
                              const ExtendedTrajectory::Row &recorded)
{
    const PlantOutputs y = plant.outputs(inputs);
    const PlantDetails details = plant.details(inputs);
    ExtendedTrajectory::Row row = recorded;
    std::size_t column = X;
    const auto add = [&](double value) { row[column++] = value; };
    const auto addVector = [&](const Eigen::Vector3d &value) {
        for (int i = 0; i < 3; ++i)
            add(value[i]);
    };
    addVector(y.position);
    addVector(y.velocity);
    for (const double value : {y.bodyControlOrientation.y(), y.bodyControlOrientation.z(), details.steering,
                               y.tetherLength, y.groundTension, y.tetherForce.norm(), y.angleOfAttack,
                               y.dragCoefficient, y.liftCoefficient, (y.inputs.windVelocity - y.velocity).norm()})
        add(value);
    addVector(y.inputs.windVelocity);
    addVector(y.aerodynamicForce);
    for (const double value : {y.power, y.averagePower, y.energy, details.turbinePower, details.turbineEnergy,
                               details.machineSpeed, details.machineCurrent, details.electricalPower,
                               details.energies.electrical, details.energies.copper, details.energies.friction})
        add(value);
    const bool hasNodes = plant.segmentCount() > 1;
    for (int node = 1; node <= nodesInFile; ++node)
        addVector(hasNodes ? plant.position(node) : Eigen::Vector3d::Zero());
    return row;
}

}  // namespace

ExtendedTrajectory ExtendedTrajectory::replayed() const
{
    PlantOptions options = m_options;
    options.hasTurbines
        = std::any_of(m_rows.begin(), m_rows.end(), [](const Row &row) { return row[TurbineCoefficient] != 0.0; });
    ExtendedPlant plant(m_parameters, options);
    if (plant.segmentCount() > 1) {
        for (int node = 1; node <= nodesInFile; ++node)
            plant.setPoint(node, vectorAt(m_rows.front(), nodeColumn + 3 * std::size_t(node - 1)),
                           Eigen::Vector3d::Zero());
    }
    ExtendedTrajectory result = *this;
    for (Row &row : result.m_rows) {
        const PlantInputs inputs = inputsOf(row, m_wind);
        row = rowOf(plant, inputs, row);
        for (int i = 0; i < cyclesPerRow; ++i)
            plant.step(inputs);
    }
    return result;
}

}  // namespace awe
