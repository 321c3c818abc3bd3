// SPDX-License-Identifier: Apache-2.0
// Flies in lockstep and prints every value of every cycle, bit by bit: a line "CYCLE SIGNAL BYTES
// VALUE" each. scripts/test-arm64 compares what two processors print.
//
//   awe_flight_values --duration SECONDS [--turbulence ...]
#include "AutopilotNode.h"
#include "CompactModelNode.h"
#include "ExampleOptions.h"
#include "FlightRun.h"

#include <cstdio>

namespace {

/// Reads all signals of the table. It computes after all that it reads in the cycle before.
class Printer : public QPlcSlaveNode
{
public:
    Printer()
        : QPlcSlaveNode(QStringLiteral("Printer"))
    {
    }

private:
    QPlcSignalIndexList declareInputSignals() override
    {
        QPlcSignalIndexList list;
        for (const QPlcSignalDefinition &signal : QPlcSignalIndexTable::current())
            list.insert(signal.name);
        return list;
    }
    QPlcSignalList realTimeout(const QPlcSignalList &inputs) override
    {
        for (QPlcSignalIndex index : inputs.indices()) {
            const QPlcValue value = inputs.value(index);
            std::printf("%llu %s %s %s\n", static_cast<unsigned long long>(cycle().number()),
                        qPrintable(QPlcSignalIndexTable::name(index)), value.toBytes().toHex().constData(),
                        qPrintable(value.toString()));
        }
        return {};
    }
};

}  // namespace

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    application.setDescription(
        QStringLiteral("Flies in lockstep and prints every value of every cycle: cycle, signal, bytes, value."));
    awe::addRunOptions(application, QStringLiteral("10"));
    awe::addModelOptions(application);
    awe::RunSettings settings;
    awe::ModelSettings model;
    QPlcSignalIndexTable table;
    if (!application.parseOptions() || !awe::readRunOptions(application, &settings)
        || !awe::readModelOptions(application, awe::PlantConfiguration(), &model))
        return application.exitCode();
    if (!table.initializeFromIniFile(awe::builtInSignals()))
        return application.usageError(table.errorString());
    settings.clock = QPlcClock::lockstep();
    settings.awaitedNodes = QStringList{QStringLiteral("Model"), QStringLiteral("Autopilot")};

    awe::CompactModelNode kite{awe::KiteSimulation{model.plant, model.wind}};
    awe::AutopilotNode autopilot{awe::AutopilotGains{}, 0};
    Printer printer;
    QPlcMasterNode master;
    awe::FlightRun run(master, settings);
    if (!run.isValid() || !master.addLocalNode(&printer) || !master.addLocalNode(&kite)
        || !master.addLocalNode(&autopilot))
        return QPlcCoreApplication::UsageError;
    QObject::connect(&run, &awe::FlightRun::finished, &application,
                     [](int exitCode) { QCoreApplication::exit(exitCode); });
    run.begin();
    const int exitCode = QCoreApplication::exec();
    for (QPlcSlaveNode *node : std::initializer_list<QPlcSlaveNode *>{&printer, &kite, &autopilot})
        node->disconnectFromMaster();
    return exitCode;
}
