// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BlockingClient.h"

#include <QtPlcCore>

#include <memory>

namespace tools {

/// What a command gets: the options, its arguments, and a client that is not connected yet. A
/// command checks what it was given before it connects.
struct CommandCall
{
    QPlcCoreApplication &application;
    BlockingClient &client;
    QPlcUnderlyingProtocol master;
    QStringList arguments;  // without the name of the command

    bool isJson() const { return application.isSet(QStringLiteral("json")); }
    /// Connects and greets. \return false, with the message out; exitCode() then
    bool connect() const;
    /// As connect(), and reads the signal table of the master.
    bool connect(QPlcSignalTable *table) const;
    /// Asks the master. \return false, with the message out; exitCode() then
    template<typename Request>
    bool ask(const Request &request, typename Request::Answer *answer = nullptr) const
    {
        return tell(client.ask(request, answer));
    }
    /// As ask(), for something that an older master may not know: its refusal becomes a sentence
    /// that says so, and so does an answer of another kind.
    template<typename Request>
    bool askFor(const Request &request, typename Request::Answer *answer) const
    {
        return tell(client.askFor(request, answer));
    }
    /// Puts the message of the client out where \a succeeded is false. \return \a succeeded
    bool tell(bool succeeded) const;
    /// The exit code for what went wrong: a bad call, or the master.
    int exitCode() const;
    /// From now on SIGINT and SIGTERM end the event loop in an orderly way.
    /// \return what becomes true then, for those that come before the loop has begun
    std::shared_ptr<const bool> quitOnSignals() const;
    /// The words of \a option, with commas between them.
    QStringList listOf(const char *option) const;
    /// A number given as \a option, in \a minimum ... \a maximum; \a result stays when the option
    /// is not there. \return false, with the message out
    bool readNumber(const char *option, double minimum, double maximum, double *result) const;
    bool readInteger(const char *option, qint64 minimum, qint64 maximum, qint64 *result) const;
};

/// An option of one command.
struct Option
{
    const char *name;
    const char *value;  // as the help shows it; empty: the option is a switch
    const char *description;
    const char *letter = "";  // a short name, as in -o
};

/// One command of qtplc.
struct Command
{
    enum Arguments { NoArguments, Signals, SignalsAndValues, CommandNames };  // what the shell completes

    const char *name;
    const char *usage;    // of its arguments
    const char *summary;  // one line for the list of commands
    const char *details;  // the rest of its own help
    QVector<Option> options;
    QStringList examples;
    Arguments arguments;
    int minimumArguments;
    int maximumArguments;
    int (*run)(const CommandCall &call);  // returns the exit code
};

/// All commands, in the order of the help.
const QVector<Command> &commands();
/// null: there is none of this name
const Command *findCommand(const QString &name);
/// What is said of a command of this name, which there is not.
QString unknownCommand(const QString &name);
/// Options that every command has.
const QVector<Option> &commonOptions();

// The commands, each in the file of its name.
int listSignals(const CommandCall &call);
int getSignals(const CommandCall &call);
int setSignals(const CommandCall &call);
int echoSignals(const CommandCall &call);
int watchSignals(const CommandCall &call);
int measureRate(const CommandCall &call);
int showState(const CommandCall &call);
int initializeStates(const CommandCall &call);
int armMaster(const CommandCall &call);
int stopSafely(const CommandCall &call);
int resetMaster(const CommandCall &call);
int evict(const CommandCall &call);
int admit(const CommandCall &call);
int writeNote(const CommandCall &call);
int startRealTime(const CommandCall &call);
int stopRealTime(const CommandCall &call);
int showSchedule(const CommandCall &call);
int showJitter(const CommandCall &call);
int showLeases(const CommandCall &call);
int showEvents(const CommandCall &call);
int findMasters(const CommandCall &call);
int manageKeys(const CommandCall &call);
int examineComputer(const CommandCall &call);
int runCampaign(const CommandCall &call);
int writeManifest(const CommandCall &call);
int checkManifest(const CommandCall &call);
int recordPlant(const CommandCall &call);
int controlRecorder(const CommandCall &call);
int verifyFile(const CommandCall &call);
int recoverFile(const CommandCall &call);
int exportRecording(const CommandCall &call);
int writeReport(const CommandCall &call);
int replayRecording(const CommandCall &call);
int showHelp(const CommandCall &call);
int completeWord(const CommandCall &call);

}  // namespace tools
