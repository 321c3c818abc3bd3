// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ControlClient.h"

#include <QtPlcCore>

namespace tools {

/// What a command gets: the options, its arguments, and the connection to the master, which has been greeted.
struct CommandCall
{
    QPlcCoreApplication &application;
    ControlClient &client;
    QPlcUnderlyingProtocol master;
    QStringList arguments;  // without the name of the command
};

/// One command of qtplc.
struct Command
{
    const char *name;
    const char *arguments;  // as the help shows them
    const char *description;
    QStringList options;  // those of its own, beside --master and --timeout
    int minimumArguments;
    int maximumArguments;
    int (*run)(const CommandCall &call);  // returns the exit code
};

/// All commands, in the order of the help.
const QVector<Command> &commands();

// The commands, each in the file of its name.
int listSignals(const CommandCall &call);
int showState(const CommandCall &call);
int initializeStates(const CommandCall &call);
int startRealTime(const CommandCall &call);
int stopRealTime(const CommandCall &call);
int echoSignals(const CommandCall &call);
int setSignals(const CommandCall &call);

/// Prints what went wrong with the master. \return the exit code for it
int reportFailure(const ControlClient &client);
/// Checks that the table of the master has all \a names. \return false, with the message out, when it has not
bool knowsSignals(QPlcCoreApplication &application, const QPlcSignalTable &table, const QStringList &names);

}  // namespace tools
