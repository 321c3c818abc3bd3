// SPDX-License-Identifier: Apache-2.0
#include "Settings.h"

#include <QtCore/QFileInfo>
#include <QtCore/QRegularExpression>
#include <QtGui/QImageWriter>

namespace awe {

namespace {

const QStringList themes{QStringLiteral("system"), QStringLiteral("light"), QStringLiteral("dark"),
                         QStringLiteral("sunlight")};  // as QPlcControlCenter::Theme

void add(QPlcApplicationOptions &application, const char *name, const QString &description,
         const char *valueName = nullptr)
{
    application.addOption(QCommandLineOption(QString::fromLatin1(name), description, QString::fromLatin1(valueName)));
}

QString readMasters(const QStringList &values, ControlCenterSettings *settings)
{
    for (const QString &value : values) {
        const int sign = value.section(QLatin1Char('?'), 0, 0).indexOf(QLatin1Char('='));  // '?keys=FILE' has one, too
        const ControlCenterSettings::Master master{value.left(qMax(sign, 0)), value.mid(sign + 1)};
        if (sign == 0 || master.address.isEmpty())
            return QStringLiteral("--master '%1': use HOST:PORT or NAME=HOST:PORT, for example kite=192.168.1.5:50000")
                .arg(value);
        settings->masters.append(master);
    }
    return {};
}

/// What would keep a picture from being written, as far as it can be known before.
QString pictureError(const QString &fileName)
{
    const QFileInfo file(fileName);
    if (!QImageWriter::supportedImageFormats().contains(file.suffix().toLower().toLatin1()))
        return QStringLiteral("--screenshot '%1': use a name that ends in .png").arg(fileName);
    const QFileInfo folder(file.absolutePath());
    if (!folder.isDir())
        return QStringLiteral("--screenshot '%1': there is no folder '%2'; make it, or use another one")
            .arg(fileName, folder.filePath());
    if (file.exists() && !file.isFile())
        return QStringLiteral("--screenshot '%1': this is no ordinary file; use another name").arg(fileName);
    if (!(file.exists() ? file.isWritable() : folder.isWritable()))
        return QStringLiteral("--screenshot '%1' cannot be written: check the rights, or use another file")
            .arg(fileName);
    return {};
}

QString readSize(const QString &text, QSize *size)
{
    const QRegularExpressionMatch match = QRegularExpression(QStringLiteral("^(\\d{3,5})x(\\d{3,5})$")).match(text);
    *size = QSize(match.captured(1).toInt(), match.captured(2).toInt());
    return match.hasMatch() ? QString()
                            : QStringLiteral("--size '%1': use WIDTHxHEIGHT, for example 1366x768").arg(text);
}

QString readLook(const QPlcApplicationOptions &application, ControlCenterSettings *settings)
{
    settings->layout = application.value(QStringLiteral("layout"));
    settings->tab = application.value(QStringLiteral("tab"));
    if (application.isSet(QStringLiteral("theme"))) {
        const int theme = themes.indexOf(application.value(QStringLiteral("theme")));
        if (theme < 0)
            return QStringLiteral("--theme '%1': use one of %2")
                .arg(application.value(QStringLiteral("theme")), themes.join(QStringLiteral(", ")));
        settings->theme = QPlcControlCenter::Theme(theme);
    }
    return application.isSet(QStringLiteral("size"))
        ? readSize(application.value(QStringLiteral("size")), &settings->size)
        : QString();
}

}  // namespace

void addControlCenterOptions(QPlcApplicationOptions &application)
{
    add(application, "master",
        QStringLiteral("Master to connect to, for ever; may be given several times, NAME=HOST:PORT then."),
        "HOST:PORT");
    add(application, "recording", QStringLiteral("Recording to open, a file or a folder; may be given several times."),
        "PATH");
    add(application, "demo",
        QStringLiteral("Flies the kite of the demo: master, model and autopilot on this computer."));
    add(application, "layout", QStringLiteral("Layout of the window."), "FILE");
    add(application, "tab", QStringLiteral("Tab to begin with, for example 'Real time'."), "NAME");
    add(application, "theme", QStringLiteral("Colours: system, light, dark or sunlight."), "NAME");
    add(application, "size", QStringLiteral("Size of the window, for example 1366x768."), "WxH");
    add(application, "screenshot",
        QStringLiteral(
            "Makes a picture of the window without a person, and ends. The layout is the one of the program."),
        "FILE.png");
    add(application, "after",
        QStringLiteral(
            "Time until the picture is made: of flight with --demo, else since the window is open [s]. Without it 5."),
        "SECONDS");
    add(application, "video",
        QStringLiteral(
            "Makes a video of a recording without a person, and ends: NAME.mp4 or NAME.webm with ffmpeg, any "
            "other name is a folder that gets a picture for each frame. --size is that of the pictures."),
        "NAME");
    add(application, "from", QStringLiteral("Begin of the video, from the begin of the recording [s]."), "SECONDS");
    add(application, "to", QStringLiteral("End of the video [s]."), "SECONDS");
    add(application, "fps", QStringLiteral("Pictures in a second of the video. Without it 25."), "NUMBER");
    add(application, "speed", QStringLiteral("Seconds of the recording in a second of the video. Without it 1."),
        "FACTOR");
    add(application, "span", QStringLiteral("Time that plots show in the video [s]. Without it all of its time."),
        "SECONDS");
    add(application, "force", QStringLiteral("Replaces a video of this name."));
    application.addSecurityOptions(QPlcSecurity::NodeSide);
}

/// \return false, with the message out, when an option of --video is not a number in its range
static bool readVideo(QPlcApplicationOptions &application, ControlCenterSettings *settings)
{
    struct Number
    {
        const char *name;
        double least;
        double most;
        double *value;
    };
    QPlcVideoExport::Options &options = settings->videoOptions;
    settings->video = application.value(QStringLiteral("video"));
    options.isReplacing = application.isSet(QStringLiteral("force"));
    const Number numbers[] = {{"from", 0.0, 1e9, &options.from},
                              {"to", 0.0, 1e9, &options.to},
                              {"fps", 1.0, 120.0, &options.framesPerSecond},
                              {"speed", 0.001, 1e5, &options.speed},
                              {"span", 0.001, 1e9, &options.span}};
    for (const Number &number : numbers) {
        const QString name = QLatin1String(number.name);
        if (!application.isSet(name))
            continue;
        if (settings->video.isEmpty())
            return application.usageError(QStringLiteral("--%1 belongs to a video: give --video NAME, too").arg(name)),
                   false;
        if (!application.number(name, number.least, number.most, number.value))
            return false;
    }
    if (!settings->video.isEmpty() && (settings->recordings.size() != 1 || !settings->screenshot.isEmpty()))
        return application.usageError(QStringLiteral("--video shows one recording: give --recording FILE once, and no "
                                                     "--screenshot")),
               false;
    return true;
}

bool readControlCenterOptions(QPlcApplicationOptions &application, ControlCenterSettings *settings)
{
    settings->demo = application.isSet(QStringLiteral("demo"));
    settings->screenshot = application.value(QStringLiteral("screenshot"));
    if (application.isSet(QStringLiteral("after"))
        && !application.number(QStringLiteral("after"), 0.0, 86400.0, &settings->after))
        return false;
    QPlcSecurity security;
    if (!application.readSecurityOptions(QPlcSecurity::NodeSide, &security))
        return false;
    QPlcSecurity::setCurrent(security);
    QString error = settings->demo && !security.isNone()
        ? QStringLiteral("--demo flies without security, on this computer; leave out --security")
        : QString();
    if (error.isEmpty())
        error = readMasters(application.values(QStringLiteral("master")), settings);
    settings->recordings = application.values(QStringLiteral("recording"));
    if (error.isEmpty())
        error = readLook(application, settings);
    if (error.isEmpty() && application.isSet(QStringLiteral("screenshot")))
        error = pictureError(settings->screenshot);
    if (error.isEmpty() && application.isSet(QStringLiteral("after")) && settings->screenshot.isEmpty())
        error = QStringLiteral("--after says when a picture is made: give --screenshot FILE.png, too");
    if (!error.isEmpty())
        return application.usageError(error), false;
    const bool isRead = readVideo(application, settings);
    settings->videoOptions.size = settings->size;
    return isRead;
}

}  // namespace awe
