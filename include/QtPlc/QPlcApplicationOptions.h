// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"
#include "QPlcProfile.h"
#include "QPlcRealTimeOptions.h"
#include "QPlcSecurity.h"

#include <QtCore/QCommandLineOption>
#include <QtCore/QString>
#include <QtCore/QStringList>

#include <functional>
#include <memory>

/// What all programs of QtPLC have in common, with a window or without: UTF-8, numbers with a decimal point, options with clear errors, orderly end on Ctrl-C.
///
/// It is a base of QPlcCoreApplication and QPlcGuiApplication; see there.
/// Exit codes of all QtPLC programs: 0 ended as wanted, 1 failed while running, 2 could not begin (bad option, bad file, port in use, master not there).
///
/// Threads: that of the application.
class QTPLC_EXPORT QPlcApplicationOptions
{
public:
    enum ExitCode { Success = 0, Failure = 1, UsageError = 2 };

    QPlcApplicationOptions();
    ~QPlcApplicationOptions();
    Q_DISABLE_COPY(QPlcApplicationOptions)

    /// What the program is, for --help.
    void setDescription(const QString &text);
    /// Examples for the end of --help, one command a line.
    void setExamples(const QStringList &commands);
    /// What --help prints in place of description, options and examples; asked when the options have been read.
    void setHelpText(std::function<QString()> text);
    void addOption(const QCommandLineOption &option);
    /// An argument without dashes, for --help. \param syntax  as shown in the usage line, empty: like the name
    void addPositionalArgument(const QString &name, const QString &description, const QString &syntax = QString());

    /// Reads the command line. --help and --version are printed here. What begins like a negative number (-2, -.5) is an argument, never an option.
    /// \return false when the program is to end now, with exitCode(): help was printed, or an option is wrong (then the message is out already)
    bool parseOptions();
    int exitCode() const;

    bool isSet(const QString &option) const;
    QString value(const QString &option) const;
    QStringList values(const QString &option) const;
    QStringList positionalArguments() const;

    /// A number given as \a option. \return false, with the message out, when it is none or not in \a minimum ... \a maximum
    bool number(const QString &option, double minimum, double maximum, double *result);
    bool integer(const QString &option, qint64 minimum, qint64 maximum, qint64 *result);

    /// Adds --priority, --cpu, --spin-us, --idle-latency-us and --lock-memory: what a cycle thread asks of the operating system.
    void addRealTimeOptions();
    /// \return false, with the message out, when one of them cannot be meant
    bool readRealTimeOptions(QPlcRealTimeOptions *options);

    /// Adds --profile to a master: how strict the plant is (QPlcProfile).
    void addProfileOption();
    /// \return false, with a message on stderr, if the value is not valid
    bool readProfile(QPlcProfile::Value *profile);

    /// Adds --enable-fault-injection and --faults, which are wanted together: a bad network, for a test.
    void addFaultOptions();
    /// \param plan  for setFaultPlan(); empty: none. \return false, with the message out, when it cannot be meant
    bool readFaultPlan(QString *plan);

    /// Adds --security, --keys, --identity, --certificate, --key and --authority, and for a master --access: how this program and others know each other.
    void addSecurityOptions(QPlcSecurity::Side side);
    /// \return false, with the message out, when they do not fit together, or when a file cannot be used: missing, wrong, or open to others
    bool readSecurityOptions(QPlcSecurity::Side side, QPlcSecurity *security);

    /// Prints "program: text" to the standard error.
    static void printError(const QString &text);
    /// Prints the error and returns UsageError, for `return application.usageError(...)`.
    int usageError(const QString &text);

    /// From now on SIGINT and SIGTERM are an orderly end: \a onSignal in the thread of the event loop, and when it is empty, quit().
    void quitOnSignals(std::function<void()> onSignal = {});

private:
    struct Private;
    std::unique_ptr<Private> d;
};
