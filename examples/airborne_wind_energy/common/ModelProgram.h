// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ExampleOptions.h"
#include "KiteSimulation.h"

namespace awe {

/// main() of a program around a model node.
template<typename Node>
int runModelProgram(int argc, char **argv, const QString &description)
{
    QPlcNodeApplication application(argc, argv);
    application.setDescription(description);
    application.setExamples(
        {QStringLiteral("%1 --wind 8,0,0 --turbulence 0.15 --seed 3").arg(QCoreApplication::applicationName()),
         QStringLiteral("%1 --plant realistic").arg(QCoreApplication::applicationName())});
    application.setDefaultSignals(builtInSignals());
    application.setWorkloadSignal(QStringLiteral("modelWorkload"));
    addModelOptions(application);
    addPlantOptions(application);
    ModelSettings settings;
    PlantConfiguration plant;
    if (!application.parseNodeOptions() || !readPlantOptions(application, &plant)
        || !readModelOptions(application, plant, &settings) || !addOptionSignals(application, plant.options))
        return application.exitCode();
    Node node(KiteSimulation(settings.plant, settings.wind, settings.substeps, settings.options), plant.winch);
    node.setTwoPhase(application.isSet(QStringLiteral("same-cycle")));  // else it would close an algebraic loop
    return application.run(node);
}

}  // namespace awe
