// SPDX-License-Identifier: Apache-2.0
#include "DemoFlight.h"
#include "ScreenshotTask.h"
#include "Settings.h"
#include "VideoTask.h"
#include "kite/OptionFigures.h"
#include "kite/WindWindow.h"

#ifdef QTPLC_HAS_GUI3D
#include "kite/KiteView.h"
#endif

#include <QtCore/QFile>

#include <algorithm>
#include <cstdio>

namespace {

/// \return false, with the message out, when there is no screen to open a window on, which is
///         needed for all but texts
bool hasScreen(int argc, char **argv)
{
    for (const char *variable : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}) {
        if (!qEnvironmentVariableIsEmpty(variable))
            return true;
    }
    qputenv("QT_QPA_PLATFORM", "offscreen");
    const auto isText = [](const char *argument) {
        return qstrcmp(argument, "--help") == 0 || qstrcmp(argument, "-h") == 0 || qstrcmp(argument, "--version") == 0;
    };
    if (std::any_of(argv + 1, argv + argc, isText))
        return true;
    std::fputs("awe_control_center: there is no display; log in to a desktop, use ssh -X, or xvfb-run -a "
               "awe_control_center ...\n",
               stderr);
    return false;
}

QByteArray builtInLayout(const QString &name)
{
    QFile file(QStringLiteral(":/layouts/%1.json").arg(name));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// Layouts, plants and look of the window. \return false, with the message out, when a layout or
/// tab is not there
bool prepare(QPlcGuiApplication &application, QPlcControlCenter &window, const awe::ControlCenterSettings &settings)
{
    QString error;
    const auto add
        = [&](const QString &name, const QString &file) { return window.addLayout(name, builtInLayout(file), &error); };
    if (!add(QStringLiteral("Airborne wind energy"), QStringLiteral("airborne_wind_energy"))
        || !add(QStringLiteral("Four views"), QStringLiteral("four_views"))
        || !add(QStringLiteral("Options of the plant"), QStringLiteral("plant_options"))
        || !add(QStringLiteral("Start and landing"), QStringLiteral("mast"))
        || !add(QStringLiteral("Steered wing"), QStringLiteral("steered_wing")))
        return application.usageError(error), false;
    if (settings.screenshot.isEmpty() && settings.video.isEmpty())
        window.restoreView();
    else
        window.resetLayout();
    if (settings.namesPlants()) {
        for (const QString &plant : window.plants())
            window.disconnectFromMaster(plant);
    }
    if (!settings.layout.isEmpty() && !window.openLayout(settings.layout, &error))
        return application.usageError(error), false;
    if (!settings.tab.isEmpty() && !window.showTab(settings.tab))
        return application.usageError(QStringLiteral("--tab '%1': the layout has no such tab").arg(settings.tab)),
               false;
    if (settings.theme)
        window.setTheme(*settings.theme);
    if (!settings.size.isEmpty())
        window.resize(settings.size);
    for (const awe::ControlCenterSettings::Master &master : settings.masters)
        window.connectToMaster(master.address, master.name);
    for (const QString &recording : settings.recordings) {
        if (window.openRecording({recording}, &error).isEmpty())
            return application.usageError(error), false;
    }
    return true;
}

void addTexts(QPlcGuiApplication &application)
{
    application.setDescription(QStringLiteral(
        "The Control Center of the airborne wind energy example: to see, steer and understand a running plant. "
        "Without options it shows what it did last, the first time its start page."));
    application.setExamples(
        {QStringLiteral("awe_control_center --demo"), QStringLiteral("awe_control_center --master 192.168.1.5:50000"),
         QStringLiteral("awe_control_center --master north=winch1:50000 --master south=winch2:50000"),
         QStringLiteral("awe_control_center --recording flight.mcap"),
         QStringLiteral("awe_control_center --recording flight.mcap --video kite.mp4 --from 10 --to 60 --speed 2"),
         QStringLiteral("awe_control_center --demo --tab 'Real time' --theme dark"),
         QStringLiteral("awe_control_center --demo --size 1366x768 --screenshot kite.png --after 20")});
    awe::addControlCenterOptions(application);
}

/// Begins with the demo, or with what the settings name, and makes the picture that is wanted.
void begin(awe::DemoFlight &demo, awe::ScreenshotTask &screenshot, const awe::ControlCenterSettings &settings,
           const QElapsedTimer &clock)
{
    QObject::connect(&demo, &awe::DemoFlight::flying, &screenshot, [&screenshot](double seconds) {
        std::printf("flying after %.1f s\n", seconds);
        std::fflush(stdout);
        screenshot.begin();
    });
    QObject::connect(&demo, &awe::DemoFlight::failed, &screenshot, [&screenshot](const QString &sentence) {
        QPlcGuiApplication::printError(sentence);
        screenshot.giveUp();
    });
    if (settings.demo)
        demo.begin(clock);
    else
        screenshot.begin();
}

}  // namespace

int main(int argc, char **argv)
{
    QElapsedTimer clock;
    clock.start();
    if (!hasScreen(argc, argv))
        return QPlcGuiApplication::UsageError;
    QPlcGuiApplication application(argc, argv);
    QApplication::setOrganizationName(QStringLiteral("QtPLC"));  // the folder of its settings
    QApplication::setApplicationName(QStringLiteral("awe_control_center"));
    QApplication::setApplicationDisplayName(QStringLiteral("Airborne Wind Energy"));
    addTexts(application);
    awe::ControlCenterSettings settings;
    if (!application.parseOptions() || !awe::readControlCenterOptions(application, &settings))
        return application.exitCode();

    QPlcControlCenter window;
    window.addPanel<awe::WindWindow>();
    window.addPanel<awe::OptionFigures>();
#ifdef QTPLC_HAS_GUI3D
    window.addPanel<awe::KiteView>();
#endif
    awe::DemoFlight demo(&window);
    if (!prepare(application, window, settings))
        return application.exitCode();
    awe::ScreenshotTask screenshot(&window, settings.screenshot, settings.after);
    awe::VideoTask video(&window, settings.video, settings.videoOptions);
    window.show();
    begin(demo, screenshot, settings, clock);
    video.begin();
    return video.exitCode(screenshot.exitCode(QApplication::exec()));
}
