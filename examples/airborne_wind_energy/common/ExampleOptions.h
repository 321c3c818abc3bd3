// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AutopilotGains.h"
#include "PlantConfiguration.h"
#include "PlantParameters.h"
#include "WindParameters.h"

#include <QtPlcCore>

namespace awe {

/// What can be said of the model on the command line.
struct ModelSettings
{
    PlantParameters plant;
    WindParameters wind;
};

/// What can be said of the autopilot on the command line.
struct AutopilotSettings
{
    AutopilotGains gains;
    int extraDeadTime = 0;  // cycles on top of linkDeadTime()
};

/// Cycles from sensor to actuator that the links alone cost: one from the model to the autopilot, one back; none with --same-cycle.
int linkDeadTime(bool sameCycle);

/// The table of the example, compiled into the programs.
QString builtInSignals();

/// Administratively scoped: no router passes it on.
QHostAddress defaultMulticastGroup();

void addModelOptions(QPlcCoreApplication &application);
/// \return false, with the message out, when an option cannot be meant
bool readModelOptions(QPlcCoreApplication &application, ModelSettings *settings);
/// --plant and --winch: what of the plant is hardware.
void addPlantOptions(QPlcCoreApplication &application);
/// \return false, with the message out, when the file or a word in it cannot be meant
bool readPlantOptions(QPlcCoreApplication &application, PlantConfiguration *configuration);
void addAutopilotOptions(QPlcCoreApplication &application);
/// \pre the application has an option --same-cycle
bool readAutopilotOptions(QPlcCoreApplication &application, AutopilotSettings *settings);

/// Those of the model and autopilot options that were given, to be handed on to another program.
QStringList givenModelOptions(const QPlcCoreApplication &application);
QStringList givenAutopilotOptions(const QPlcCoreApplication &application);

}  // namespace awe
