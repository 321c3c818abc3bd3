// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcApplicationOptions.h"

#include <QtCore/QCoreApplication>

/// A QCoreApplication for the programs of a plant: UTF-8 everywhere, numbers with a decimal point,
/// options with clear errors, and an orderly end on Ctrl-C.
///
/// \code
/// int main(int argc, char **argv)
/// {
///     QPlcCoreApplication application(argc, argv);
///     application.setDescription("The master of the winch.");
///     application.addOption({"period", "Period of the cycle [s].", "SECONDS", "0.01"});
///     if (!application.parseOptions())
///         return application.exitCode();
///     QPlcMasterNode master;
///     double period = 0.0;
///     if (!application.number("period", 0.0001, 10.0, &period))
///         return application.exitCode();
///     master.setInterval(period);
///     application.quitOnSignals();
///     return application.exec();
/// }
/// \endcode
///
/// QPlcApplicationOptions has the functions for options.
///
/// \threadsafe no: use it in the main thread
///
/// \ingroup programs
class QTPLC_EXPORT QPlcCoreApplication : public QCoreApplication, public QPlcApplicationOptions
{
    Q_OBJECT
public:
    /// Makes the application.
    /// \param argc,  argv of main(); they outlive the object
    QPlcCoreApplication(int &argc, char **argv);
    /// Ends the application. SIGINT and SIGTERM have their usual effect again.
    ~QPlcCoreApplication() override;
};
