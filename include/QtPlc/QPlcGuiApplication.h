// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcApplicationOptions.h"
#include "QPlcGuiGlobal.h"

#include <QtWidgets/QApplication>

/// A QApplication for the windows of a plant: sharp on every screen, the same look on every
/// desktop, and the options and texts of QPlcApplicationOptions.
///
/// \code
/// int main(int argc, char **argv)
/// {
///     QPlcGuiApplication application(argc, argv);
///     application.setDescription("The window of the winch.");
///     if (!application.parseOptions())
///         return application.exitCode();
///     QPlcControlCenter controlCenter;
///     controlCenter.connectToMaster("winch:50000");
///     controlCenter.show();
///     return application.exec();
/// }
/// \endcode
///
/// CMake: `find_package(QtPlc REQUIRED COMPONENTS Gui)`, and `target_link_libraries(window PRIVATE
/// QtPlc::Gui)`.
///
/// Ctrl-C and SIGTERM close the windows and end the program. On Wayland the program uses XWayland
/// if there is one, because floating panels cannot be put back to their places otherwise;
/// QT_QPA_PLATFORM takes precedence. If the display cannot be opened, the program prints why and
/// ends with exit code 2.
///
/// \threadsafe no: use it in the main thread
///
/// \ingroup programs
class QTPLC_GUI_EXPORT QPlcGuiApplication : public QApplication, public QPlcApplicationOptions
{
    Q_OBJECT
public:
    /// Makes the application.
    /// \param argc,  argv of main(); they outlive the object
    QPlcGuiApplication(int &argc, char **argv);
    /// Ends the application. SIGINT and SIGTERM have their usual effect again.
    ~QPlcGuiApplication() override;
};
