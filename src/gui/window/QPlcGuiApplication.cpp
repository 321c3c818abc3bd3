// SPDX-License-Identifier: Apache-2.0
#include "QPlcGuiApplication.h"

#include <QtWidgets/QStyleFactory>

namespace {

/// What has to be said before there is an application.
int &prepared(int &argc)
{
    QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
    QCoreApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
    QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
    QGuiApplication::setHighDpiScaleFactorRoundingPolicy(Qt::HighDpiScaleFactorRoundingPolicy::PassThrough);
    if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM") && qEnvironmentVariableIsSet("WAYLAND_DISPLAY")
        && qEnvironmentVariableIsSet("DISPLAY"))
        qputenv("QT_QPA_PLATFORM", "xcb");
    return argc;
}

}  // namespace

QPlcGuiApplication::QPlcGuiApplication(int &argc, char **argv)
    : QApplication(prepared(argc), argv)
{
    if (!qEnvironmentVariableIsSet("QT_STYLE_OVERRIDE"))
        setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
    quitOnSignals([] { closeAllWindows(), quit(); });
}

QPlcGuiApplication::~QPlcGuiApplication() = default;
