// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AutopilotGains.h"
#include "PlantConfiguration.h"

#include <QtPlcCore>

#include <Eigen/Core>

namespace awe {

/// What the model computes: the kite of the plant, with what the command line says.
struct ModelSettings
{
    PlantParameters plant;
    WindParameters wind;
    int substeps = 1;
    PlantOptions options;
};

/// What can be said of the autopilot on the command line.
struct AutopilotSettings
{
    AutopilotGains gains;
    int extraDeadTime = 0;  // cycles on top of linkDeadTime()
};

/// Cycles from sensor to actuator that the links alone cost: one from the model to the autopilot,
/// one back; none with --same-cycle.
int linkDeadTime(bool sameCycle);

/// The table of the example, compiled into the programs.
QString builtInSignals();
/// Those of the options of a plant; addOptionSignals() adds some of them to a table.
QString builtInOptionSignals();

/// Adds the signals that the options of a plant need to \a table, unless it has them already.
/// \return false when the table of the options is wrong; \a error is a message for people then
bool addOptionSignals(const PlantOptions &options, QPlcSignalTable *table, QString *error);
/// The same for the table of the process.
/// \return false, with the message out, when a table is wrong
bool addOptionSignals(QPlcCoreApplication &application, const PlantOptions &options);

/// Administratively scoped: no router passes it on.
QHostAddress defaultMulticastGroup();

/// Reads "X,Y,Z". \return false, with the message out, when the option holds something else
bool readVector(QPlcCoreApplication &application, const QString &option, Eigen::Vector3d *vector);

void addModelOptions(QPlcCoreApplication &application);
/// What the options say wins over \a plant. \return false, with the message out, when an option has
/// no valid value
bool readModelOptions(QPlcCoreApplication &application, const PlantConfiguration &plant, ModelSettings *settings);
/// --plant, --winch and --mode: what of the plant is hardware, and the data of the model.
void addPlantOptions(QPlcCoreApplication &application);
/// \return false, with the message out, when the file or a word in it is not valid
bool readPlantOptions(QPlcCoreApplication &application, PlantConfiguration *configuration);
void addAutopilotOptions(QPlcCoreApplication &application);
/// \param plant  decides which gains are the default ones
/// \pre the application has an option --same-cycle
bool readAutopilotOptions(QPlcCoreApplication &application, const PlantConfiguration &plant,
                          AutopilotSettings *settings);

/// Those of the plant, model and autopilot options that were given, to be handed on to another
/// program.
QStringList givenPlantOptions(const QPlcCoreApplication &application);
QStringList givenModelOptions(const QPlcCoreApplication &application);
QStringList givenAutopilotOptions(const QPlcCoreApplication &application);

}  // namespace awe
