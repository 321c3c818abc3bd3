// SPDX-License-Identifier: Apache-2.0
#include "AutopilotNode.h"
#include "ExampleOptions.h"

int main(int argc, char **argv)
{
    QPlcNodeApplication application(argc, argv);
    application.setDescription(QStringLiteral("The autopilot of the kite, as a node of a QtPLC master."));
    application.setExamples({QStringLiteral("awe_autopilot --gains tuned --force-limit 4000"),
                             QStringLiteral("awe_autopilot --plant realistic")});
    application.setDefaultSignals(awe::builtInSignals());
    application.setWorkloadSignal(QStringLiteral("autopilotWorkload"));
    awe::addPlantOptions(application);
    awe::addAutopilotOptions(application);
    awe::PlantConfiguration plant;
    awe::AutopilotSettings settings;
    if (!application.parseNodeOptions() || !awe::readPlantOptions(application, &plant)
        || !awe::readAutopilotOptions(application, plant, &settings)
        || !awe::addOptionSignals(application, plant.options))
        return application.exitCode();
    awe::AutopilotNode node(settings.gains, settings.extraDeadTime);
    return application.run(node);
}
