// SPDX-License-Identifier: Apache-2.0
#include "ExampleOptions.h"

#include "OptionSignals.h"

#include <limits>

// Resources of a static library are found only by programs that ask for them, outside of any
// namespace.
static void loadSignals()
{
    Q_INIT_RESOURCE(signals);
}

namespace awe {

namespace {

const char *const plantOptions[] = {"plant", "winch", "mode"};
const char *const modelOptions[] = {"wind", "turbulence", "seed"};
const char *const autopilotOptions[] = {"gains", "force-limit", "dead-time"};

void add(QPlcCoreApplication &application, const char *name, const QString &description, const char *valueName,
         const char *defaultValue)
{
    application.addOption(QCommandLineOption(QString::fromLatin1(name), description, QString::fromLatin1(valueName),
                                             QString::fromLatin1(defaultValue)));
}

template<std::size_t N>
QStringList given(const QPlcCoreApplication &application, const char *const (&names)[N])
{
    QStringList arguments;
    for (const char *latin1 : names) {
        const QString name = QString::fromLatin1(latin1);
        if (application.isSet(name))
            arguments << QStringLiteral("--%1=%2").arg(name, application.value(name));
    }
    return arguments;
}

bool accept(QPlcCoreApplication &application, const QString &error)
{
    if (error.isEmpty())
        return true;
    application.usageError(error);
    return false;
}

bool accept(QPlcCoreApplication &application, const std::string &error)
{
    return accept(application, QString::fromStdString(error));
}

}  // namespace

bool readVector(QPlcCoreApplication &application, const QString &option, Eigen::Vector3d *vector)
{
    const QPlcValue read = QPlcValue::fromString(QPlcSignalType(QPlcSignalType::Real64, 3), application.value(option));
    const QString text = application.value(option);
    if (!read.isValid() || !read.isFinite() || text.count(QLatin1Char(',')) != 2) {
        application.usageError(QStringLiteral("--%1 %2: use three numbers X,Y,Z").arg(option, text));
        return false;
    }
    *vector = Eigen::Vector3d(read.toReal(0), read.toReal(1), read.toReal(2));
    return true;
}

int linkDeadTime(bool sameCycle)
{
    return sameCycle ? 0 : 2;
}

QString builtInSignals()
{
    loadSignals();
    return QStringLiteral(":/signals/airborne_wind_energy.ini");
}

QString builtInOptionSignals()
{
    loadSignals();
    return QStringLiteral(":/signals/airborne_wind_energy_options.ini");
}

bool addOptionSignals(const PlantOptions &options, QPlcSignalTable *table, QString *error)
{
    const QStringList wanted = optionSignalNames(options);
    QVector<QPlcParseError> errors;
    const QPlcSignalTable all = QPlcSignalTable::fromIniFile(builtInOptionSignals(), &errors);
    *error = QPlcParseError::toString(errors);
    for (const QPlcSignalDefinition &signal : all) {
        if (error->isEmpty() && wanted.contains(signal.name) && !table->contains(signal.name))
            table->append(signal, error);
    }
    return error->isEmpty();
}

bool addOptionSignals(QPlcCoreApplication &application, const PlantOptions &options)
{
    if (options.isThesis())
        return true;
    QString error;
    QPlcSignalTable table = QPlcSignalIndexTable::current();
    if (addOptionSignals(options, &table, &error))
        QPlcSignalIndexTable::setCurrent(table);
    return accept(application, error);
}

QHostAddress defaultMulticastGroup()
{
    return QHostAddress(QStringLiteral("239.255.76.68"));
}

/// \return false, with the message out, when it cannot be the mean wind
static bool readWind(QPlcCoreApplication &application, Eigen::Vector3d *wind)
{
    const QString name = QStringLiteral("wind");
    if (!readVector(application, name, wind))
        return false;
    constexpr double strongest = 100.0;  // [m/s] east, north and up
    if (!(wind->cwiseAbs().maxCoeff() > strongest))
        return true;
    application.usageError(
        QStringLiteral("--%1 %2: use numbers from -%3 to %3 m/s").arg(name, application.value(name)).arg(strongest));
    return false;
}

void addModelOptions(QPlcCoreApplication &application)
{
    add(application, "wind",
        QStringLiteral("Mean wind velocity, x east, y north, z up [m/s]. Without it that of --plant: 5,3,0."), "X,Y,Z",
        "");
    add(application, "turbulence", QStringLiteral("Turbulence intensity, 0 ... 1. Without it that of --plant: 0."),
        "TI", "");
    add(application, "seed", QStringLiteral("Chooses one course of the turbulence. Without it that of --plant: 1."),
        "N", "");
}

bool readModelOptions(QPlcCoreApplication &application, const PlantConfiguration &plant, ModelSettings *settings)
{
    const QString wind = QStringLiteral("wind"), turbulence = QStringLiteral("turbulence"),
                  seed = QStringLiteral("seed");
    const KiteConfiguration &kite = plant.kite;
    settings->wind = kite.wind;
    qint64 course = 0;
    if ((application.isSet(wind) && !readWind(application, &settings->wind.meanVelocity))
        || (application.isSet(turbulence)
            && !application.number(turbulence, 0.0, 1.0, &settings->wind.turbulenceIntensity))
        || (application.isSet(seed) && !application.integer(seed, 0, std::numeric_limits<qint64>::max(), &course)))
        return false;
    if (application.isSet(seed))
        settings->wind.seed = std::uint64_t(course);
    settings->options = plant.optionsIn(settings->wind);
    settings->plant = kite.plantIn(settings->wind);
    settings->substeps = kite.substeps;
    return accept(application, settings->wind.validate()) && accept(application, settings->plant.validate())
        && accept(application, settings->options.validateFor(settings->plant));
}

void addPlantOptions(QPlcCoreApplication &application)
{
    add(application, "plant",
        QStringLiteral(
            "File that says what of the plant is hardware ([winch]), and the data of the model ([kite], [wind], "
            "[tether], [steering], [turbines], [mast]), or the name of a plant: %1. Without one all is a model, that "
            "of the "
            "thesis.")
            .arg(PlantConfiguration::names().join(QStringLiteral(", "))),
        "PLANT", "");
    add(application, "winch",
        QStringLiteral("ideal, machine, drive, or canopen (a servo drive with CiA 402): in place of the word in the "
                       "file of --plant."),
        "KIND", "");
    add(application, "mode",
        QStringLiteral("pumping: the winch generates, or drag: turbines on board do. In place of the word in the file "
                       "of --plant."),
        "MODE", "");
}

bool readPlantOptions(QPlcCoreApplication &application, PlantConfiguration *configuration)
{
    const QString builtIn = PlantConfiguration::builtInFile();
    const QString fileName = application.value(QStringLiteral("plant"));
    QString error;
    const PlantWords words{application.value(QStringLiteral("winch")), application.value(QStringLiteral("mode"))};
    if (PlantConfiguration::read(fileName.isEmpty() ? builtIn : fileName, configuration, &error, words))
        return true;
    application.usageError(error);
    return false;
}

void addAutopilotOptions(QPlcCoreApplication &application)
{
    add(application, "gains", QStringLiteral("Gain set: default (more height) or tuned (more power)."), "SET",
        "default");
    add(application, "force-limit", QStringLiteral("Upper limit of the tether force [N]. Without one there is none."),
        "N", "");
    add(application, "dead-time",
        QStringLiteral(
            "Cycles from sensor to actuator. The two links cost 2, with --same-cycle here and at the model 0; "
            "unless given there are no more."),
        "CYCLES", "");
}

/// Reads the set of gains that --gains names for a plant.
/// \return false, with the message out, when the plant has no such set
static bool readGains(QPlcCoreApplication &application, const PlantConfiguration &plant, AutopilotGains *gains)
{
    const QString set = application.value(QStringLiteral("gains"));
    const bool isTuned = set == QLatin1String("tuned");
    const bool isSteered = plant.options.steering.kind == SteeringKind::TurnRate;
    QString error;
    if (!isTuned && set != QLatin1String("default"))
        error = QStringLiteral("--gains %1: use default or tuned").arg(set);
    else if (isTuned && isSteered && plant.options.hasTurbines)
        error = QStringLiteral("--gains tuned: there is no tuned set for turbines on a wing that the air turns; use "
                               "default");
    if (!accept(application, error))
        return false;
    if (isSteered) {
        const AutopilotGains steered = isTuned ? AutopilotGains::steeredTuned() : AutopilotGains::steered();
        *gains = steered.invertedFor(plant.options.steering.turnRateFactor, plant.options.steering.weightFactor);
    } else {
        *gains = isTuned ? AutopilotGains::tuned() : AutopilotGains::safe();
    }
    if (plant.options.hasTurbines) {
        if (isTuned)
            *gains = AutopilotGains::dragTuned();
        gains->reelOutPitch = AutopilotGains::drag().reelOutPitch;
        gains->constantTether = plant.turbines.tetherLength;
        gains->turbineCoefficient = plant.turbines.coefficient;
    }
    gains->mast = plant.gainsOfMast();
    return true;
}

bool readAutopilotOptions(QPlcCoreApplication &application, const PlantConfiguration &plant,
                          AutopilotSettings *settings)
{
    if (!readGains(application, plant, &settings->gains))
        return false;
    if (application.isSet(QStringLiteral("force-limit"))
        && !application.number(QStringLiteral("force-limit"), 100.0, 1e6, &settings->gains.forceLimit))
        return false;
    const int least = linkDeadTime(application.isSet(QStringLiteral("same-cycle")));
    qint64 deadTime = least;
    if (application.isSet(QStringLiteral("dead-time"))
        && !application.integer(QStringLiteral("dead-time"), least, 100, &deadTime))
        return false;
    settings->extraDeadTime = int(deadTime) - least;
    return accept(application, settings->gains.validate());
}

QStringList givenPlantOptions(const QPlcCoreApplication &application)
{
    return given(application, plantOptions);
}

QStringList givenModelOptions(const QPlcCoreApplication &application)
{
    return given(application, modelOptions);
}

QStringList givenAutopilotOptions(const QPlcCoreApplication &application)
{
    return given(application, autopilotOptions);
}

}  // namespace awe
