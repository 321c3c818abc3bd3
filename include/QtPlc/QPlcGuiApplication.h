// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcApplicationOptions.h"
#include "QPlcGuiGlobal.h"

#include <QtWidgets/QApplication>

/// A QApplication for the windows of a plant: sharp on every screen, one look on every desktop, and options and texts as QPlcCoreApplication has them.
///
/// ```cpp
/// QPlcGuiApplication application(argc, argv);
/// application.setDescription("The window of the winch.");
/// if (!application.parseOptions())
///     return application.exitCode();
/// QPlcControlCenter controlCenter;
/// controlCenter.connectToMaster("winch:50000");
/// controlCenter.show();
/// return application.exec();
/// ```
///
/// CMake: `find_package(QtPlc REQUIRED COMPONENTS Gui)`, and `target_link_libraries(window PRIVATE QtPlc::Gui)`.
///
/// Ctrl-C and SIGTERM close the windows and end the program, unless quitOnSignals() says something else. On Wayland the program runs by XWayland where there is one, because panels
/// that float cannot be put back to their places otherwise; QT_QPA_PLATFORM decides where it is set.
class QTPLC_GUI_EXPORT QPlcGuiApplication : public QApplication, public QPlcApplicationOptions
{
    Q_OBJECT
public:
    QPlcGuiApplication(int &argc, char **argv);
    ~QPlcGuiApplication() override;
};
