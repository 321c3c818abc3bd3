// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"

#include <limits>

namespace tools {

const QVector<Command> &commands()
{
    constexpr int any = std::numeric_limits<int>::max();
    static const QVector<Command> table{
        {"list",
         "",
         "Shows all signals: type, unit, value and who writes them.",
         {QStringLiteral("verbose")},
         0,
         0,
         &listSignals},
        {"state",
         "",
         "Shows the state of the master, its counters and its nodes.",
         {QStringLiteral("verbose")},
         0,
         0,
         &showState},
        {"init", "", "Asks all nodes for their initial values.", {}, 0, 0, &initializeStates},
        {"start", "", "Starts the real-time phase.", {QStringLiteral("cycles")}, 0, 0, &startRealTime},
        {"stop", "", "Ends the real-time phase.", {}, 0, 0, &stopRealTime},
        {"echo",
         "SIGNAL...",
         "Prints values as they come, until Ctrl-C.",
         {QStringLiteral("rate"), QStringLiteral("count")},
         1,
         any,
         &echoSignals},
        {"set", "SIGNAL VALUE ...", "Sets signals that no node writes: all of them or none.", {}, 2, any, &setSignals},
    };
    return table;
}

int reportFailure(const ControlClient &client)
{
    QPlcCoreApplication::printError(client.errorString());
    return client.error() == ControlClient::Unreachable ? QPlcCoreApplication::UsageError
                                                        : QPlcCoreApplication::Failure;
}

bool knowsSignals(QPlcCoreApplication &application, const QPlcSignalTable &table, const QStringList &names)
{
    QStringList errors;
    for (const QString &name : names) {
        if (!table.contains(name))
            errors << table.unknownSignalText(name);
    }
    errors.removeDuplicates();
    if (!errors.isEmpty())
        application.usageError(errors.join(QStringLiteral("; ")));
    return errors.isEmpty();
}

}  // namespace tools
