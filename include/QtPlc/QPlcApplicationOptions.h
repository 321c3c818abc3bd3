// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"
#include "QPlcManifest.h"
#include "QPlcProfile.h"
#include "QPlcRealTimeOptions.h"
#include "QPlcSecurity.h"

#include <QtCore/QCommandLineOption>
#include <QtCore/QString>
#include <QtCore/QStringList>

#include <functional>
#include <memory>

class QPlcMasterNode;

/// What all programs of QtPLC have in common, with or without a window: UTF-8, numbers with a
/// decimal point, options with clear errors, and an orderly end on Ctrl-C. It is a base class of
/// QPlcCoreApplication and QPlcGuiApplication.
///
/// \code
/// int main(int argc, char **argv)
/// {
///     QPlcCoreApplication application(argc, argv);
///     application.addOption({"cycles", "Number of cycles.", "NUMBER", "1000"});
///     application.addRealTimeOptions();
///     qint64 cycles = 0;
///     QPlcRealTimeOptions options;
///     if (!application.parseOptions() || !application.integer("cycles", 1, 1000000, &cycles)
///         || !application.readRealTimeOptions(&options))
///         return application.exitCode();
///     return application.exec();
/// }
/// \endcode
///
/// Exit codes of all QtPLC programs: 0 when the program ends as wanted, 1 when it has failed while
/// running, 2 when it could not begin (wrong option, wrong file, port in use, no master).
///
/// \threadsafe no: use it in the main thread
///
/// \ingroup programs
class QTPLC_EXPORT QPlcApplicationOptions
{
public:
    /// Exit codes of all QtPLC programs.
    enum ExitCode {
        Success = 0,    ///< the program has ended as wanted
        Failure = 1,    ///< it has failed while running
        UsageError = 2  ///< it could not begin
    };

    /// Sets UTF-8 and the decimal point for the process, and adds the options -h, --help and
    /// --version.
    QPlcApplicationOptions();
    /// Gives SIGINT and SIGTERM their usual effect again, if quitOnSignals() was called.
    ~QPlcApplicationOptions();
    Q_DISABLE_COPY(QPlcApplicationOptions)

    /// Sets what the program does, in a sentence for --help.
    void setDescription(const QString &text);
    /// Sets examples for the end of --help, one command per entry.
    void setExamples(const QStringList &commands);
    /// Sets a function whose text --help prints instead of description, options and examples. It is
    /// called when the options have been read.
    void setHelpText(std::function<QString()> text);
    /// Adds an option. Its names have no dashes.
    void addOption(const QCommandLineOption &option);
    /// Adds an argument without dashes. A program without such arguments refuses them.
    /// \param syntax  as the usage line shows it; empty: like \a name
    void addPositionalArgument(const QString &name, const QString &description, const QString &syntax = QString());

    /// Reads the command line. --help and --version are printed here. What begins like a negative
    /// number (-2, -.5) is an argument, not an option.
    /// \return false when the program has to end with exitCode(): help was printed, or an option is
    ///     wrong and the message was printed
    bool parseOptions();
    /// Returns the exit code for a program that ends because a function of this class returned
    /// false.
    int exitCode() const;

    /// Returns true if the option was given.
    bool isSet(const QString &option) const;
    /// Returns the value of an option: the last one that was given, else its default.
    QString value(const QString &option) const;
    /// Returns all values of an option, in the order of the command line; without one, its
    /// defaults.
    QStringList values(const QString &option) const;
    /// Returns the arguments without dashes.
    QStringList positionalArguments() const;

    /// Reads the value of an option as a number.
    /// \param minimum,  maximum allowed range, both included
    /// \param result  gets the number; unchanged on an error
    /// \return false when the value is not a number or out of range; the message was printed and
    ///     exitCode() is UsageError
    bool number(const QString &option, double minimum, double maximum, double *result);
    /// Reads the value of an option as a decimal integer, as number() does.
    bool integer(const QString &option, qint64 minimum, qint64 maximum, qint64 *result);

    /// Adds --priority, --cpu, --spin-us, --idle-latency-us and --lock-memory: what a cycle thread
    /// asks of the operating system.
    void addRealTimeOptions();
    /// Reads the options of addRealTimeOptions().
    /// \param options  gets what was given. lockMemory becomes false without --lock-memory; other
    ///     fields without an option keep their value
    /// \return false when one is out of range; the message was printed and exitCode() is UsageError
    bool readRealTimeOptions(QPlcRealTimeOptions *options);

    /// Adds --profile to a master: how strict the plant is (QPlcProfile). Default "automatic".
    void addProfileOption();
    /// Reads the option of addProfileOption().
    /// \return false when the value is not valid; the message was printed and exitCode() is
    ///     UsageError
    bool readProfile(QPlcProfile::Value *profile);
    /// Adds --manifest FILE to a master: the nodes that the plant needs (QPlcManifest).
    void addManifestOption();
    /// Reads the file of --manifest.
    /// \param manifest  gets the result; empty without the option
    /// \return false, with the message printed and exitCode() UsageError, when the file cannot be
    ///     read or has errors
    bool readManifest(QPlcManifest *manifest);

    /// Adds --events FILE|none to a master: where its events go (QPlcMasterNode::setEventFile()).
    void addEventOption();
    /// Gives \a master the file of --events. Without the option it decides itself.
    void readEventOption(QPlcMasterNode *master) const;

    /// Adds --enable-fault-injection and --faults, which belong together: the faults of a bad
    /// network, for a test.
    void addFaultOptions();
    /// Reads the options of addFaultOptions().
    /// \param plan  gets the plan for setFaultPlan() of master or node; empty: no faults
    /// \return false when the plan is not valid, or only one of the two options was given; the
    ///     message was printed and exitCode() is UsageError
    bool readFaultPlan(QString *plan);

    /// Adds --security, --keys, --certificate, --key and --authority, for a master --access, for a
    /// node --identity: how this program and others authenticate each other.
    void addSecurityOptions(QPlcSecurity::Side side);
    /// Reads the options of addSecurityOptions().
    /// \param security  gets the result; no security without --security
    /// \return false when the options do not fit together, or a file is missing, wrong, or
    ///     accessible to others; the message was printed and exitCode() is UsageError
    bool readSecurityOptions(QPlcSecurity::Side side, QPlcSecurity *security);

    /// Prints "program: text" to the standard error.
    static void printError(const QString &text);
    /// Prints the error and returns UsageError, for `return application.usageError(...)`.
    /// exitCode() is UsageError then.
    int usageError(const QString &text);

    /// Turns SIGINT (Ctrl-C) and SIGTERM into an orderly end. Only the first call counts, and only
    /// one object of a process can do this.
    /// \param onSignal  called in the event loop of the main thread for each signal; empty:
    ///     QCoreApplication::quit()
    void quitOnSignals(std::function<void()> onSignal = {});

protected:
    /// Starts a thread that writes the messages of Qt (qWarning(), qCInfo()) to the standard error
    /// output, so that a reader that stands still does not stop the program. Up to 1 MiB of lines
    /// wait for their reader; a line in the place of dropped ones tells how many. If the program
    /// has a message handler of its own, it stays. Both application classes call this.
    void startAsynchronousLogging();

private:
    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
