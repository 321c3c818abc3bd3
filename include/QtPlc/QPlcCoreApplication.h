// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcApplicationOptions.h"

#include <QtCore/QCoreApplication>

/// A QCoreApplication for the programs of a plant: UTF-8 everywhere, numbers with a decimal point, options with clear errors, orderly end on Ctrl-C.
///
/// ```cpp
/// QPlcCoreApplication application(argc, argv);
/// application.setDescription("The winch.");
/// application.addOption({"drum", "Radius of the drum [m].", "METRES", "0.25"});
/// if (!application.parseOptions())
///     return application.exitCode();
/// ```
class QTPLC_EXPORT QPlcCoreApplication : public QCoreApplication, public QPlcApplicationOptions
{
    Q_OBJECT
public:
    QPlcCoreApplication(int &argc, char **argv);
    ~QPlcCoreApplication() override;
};
