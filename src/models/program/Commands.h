// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>
#include <QtCore/QVector>

class QPlcApplicationOptions;

namespace fmu {

/// A command of qtplc_fmu: it has options of its own, and reads the whole command line.
struct Command
{
    const char *name;
    const char *summary;  // one line for the list of commands
    int (*run)(int argc, char **argv);
};
const QVector<Command> &commands();

int showInfo(int argc, char **argv);
int printSignals(int argc, char **argv);
int runNode(int argc, char **argv);
int runAlone(int argc, char **argv);
int check(int argc, char **argv);
int bench(int argc, char **argv);

/// The arguments that all commands but `node` have: their own name, and an FMU.
void addArguments(QPlcApplicationOptions &application, const char *command);
/// \return the file of the FMU; empty, with the message out, when there is none
QString fileOf(QPlcApplicationOptions &application);
void print(const QString &text);

}  // namespace fmu
