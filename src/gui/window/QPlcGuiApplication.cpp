// SPDX-License-Identifier: Apache-2.0
#include "QPlcGuiApplication.h"

#include <QtWidgets/QStyleFactory>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

QtMessageHandler handlerBefore = nullptr;
const char *programName = "";

/// Qt ends a program by SIGABRT if it cannot open its display.
void tellUnreachableDisplay(QtMsgType type, const QMessageLogContext &context, const QString &text)
{
    if (type == QtFatalMsg) {
        std::fprintf(
            stderr,
            "%s: cannot open a window on display '%s'; log in to a desktop, use ssh -X, or xvfb-run -a %s ...\n",
            programName, qgetenv("DISPLAY").constData(), programName);
        std::_Exit(QPlcApplicationOptions::UsageError);
    }
    handlerBefore(type, context, text);
}

void awaitDisplay(const char *program)
{
    const char *folderEnd = program ? std::strrchr(program, '/') : nullptr;
    programName = folderEnd ? folderEnd + 1 : (program ? program : "");
    handlerBefore = qInstallMessageHandler(tellUnreachableDisplay);
}

/// What has to be said before there is an application.
int &prepared(int &argc, char **argv)
{
    QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
    QCoreApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
    QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
    QGuiApplication::setHighDpiScaleFactorRoundingPolicy(Qt::HighDpiScaleFactorRoundingPolicy::PassThrough);
    if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM") && qEnvironmentVariableIsSet("WAYLAND_DISPLAY")
        && qEnvironmentVariableIsSet("DISPLAY"))
        qputenv("QT_QPA_PLATFORM", "xcb");
    awaitDisplay(argc > 0 ? argv[0] : nullptr);
    return argc;
}

}  // namespace

QPlcGuiApplication::QPlcGuiApplication(int &argc, char **argv)
    : QApplication(prepared(argc, argv), argv)
{
    qInstallMessageHandler(handlerBefore);
    startAsynchronousLogging();
    if (!qEnvironmentVariableIsSet("QT_STYLE_OVERRIDE"))
        setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
    quitOnSignals([] { closeAllWindows(), quit(); });
}

QPlcGuiApplication::~QPlcGuiApplication() = default;
