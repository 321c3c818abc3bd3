// SPDX-License-Identifier: Apache-2.0
#include "ExampleOptions.h"
#include "ModelNode.h"

int main(int argc, char **argv)
{
    QPlcNodeApplication application(argc, argv);
    application.setDescription(
        QStringLiteral("The kite on its tether, as a node of a QtPLC master (written with lists of values)."));
    application.setExamples({QStringLiteral("awe_model --wind 8,0,0 --turbulence 0.15 --seed 3")});
    application.setDefaultSignals(awe::builtInSignals());
    application.setWorkloadSignal(QStringLiteral("modelWorkload"));
    awe::addModelOptions(application);
    awe::ModelSettings settings;
    if (!application.parseNodeOptions() || !awe::readModelOptions(application, &settings))
        return application.exitCode();
    awe::ModelNode node(awe::KiteSimulation(settings.plant, settings.wind));
    return application.run(node);
}
