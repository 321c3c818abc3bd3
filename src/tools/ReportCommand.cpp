// SPDX-License-Identifier: Apache-2.0
// report: a recording as a page for people.
#include "RecordingChoice.h"
#include "TerminalText.h"
#include "recording/OutputFile.h"
#include "recording/RecordingReport.h"

#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QJsonObject>

#include <cstdio>

namespace tools {

namespace {

constexpr qint64 LargestSection = 1 << 20;   // [byte]
constexpr qint64 LargestPicture = 16 << 20;  // [byte]
constexpr qint64 LargestLayout = 4 << 20;    // [byte]

enum class Input { Files, FilesAndStandardInput };

/// \param from  with FilesAndStandardInput the name - means the standard input
/// \return false, with the message out
bool readFile(const CommandCall &call, const char *option, const QString &name, qint64 largest, QByteArray *bytes,
              Input from = Input::Files)
{
    const bool isInput = from == Input::FilesAndStandardInput && name == QLatin1String("-");
    QFile file(name);
    if (!(isInput ? file.open(stdin, QIODevice::ReadOnly) : file.open(QIODevice::ReadOnly))) {
        call.application.usageError(
            QStringLiteral("--%1: cannot open '%2': %3").arg(QLatin1String(option), name, file.errorString()));
        return false;
    }
    *bytes = file.read(largest + 1);
    if (bytes->size() <= largest)
        return true;
    call.application.usageError(
        QStringLiteral("--%1: '%2' is longer than %3 MiB").arg(QLatin1String(option), name).arg(largest >> 20));
    return false;
}

/// The files of --section; -: the standard input.
bool readSections(const CommandCall &call, QStringList *sections)
{
    const QStringList names = call.listOf("section");
    for (const QString &name : names) {
        QByteArray text;
        if (!readFile(call, "section", name, LargestSection, &text, Input::FilesAndStandardInput))
            return false;
        *sections << QString::fromUtf8(text);
    }
    return true;
}

/// The files of --picture.
bool readPictures(const CommandCall &call, std::vector<qplc::ReportSelection::Picture> *pictures)
{
    const QStringList names = call.listOf("picture");
    for (const QString &name : names) {
        QByteArray bytes;
        if (!readFile(call, "picture", name, LargestPicture, &bytes))
            return false;
        if (qplc::mediaTypeOf(bytes).isEmpty()) {
            call.application.usageError(
                QStringLiteral("--picture: '%1' is not a picture; use PNG, JPEG or SVG").arg(name));
            return false;
        }
        pictures->push_back({QFileInfo(name).completeBaseName(), bytes});
    }
    return true;
}

/// The time plots of the file of --layout.
bool readLayout(const CommandCall &call, std::vector<qplc::ReportPanel> *panels)
{
    const QString name = call.application.value(QStringLiteral("layout"));
    QByteArray json;
    if (name.isEmpty())
        return true;
    if (!readFile(call, "layout", name, LargestLayout, &json))
        return false;
    QString error;
    if (qplc::readLayoutPlots(json, panels, &error))
        return true;
    call.application.usageError(QStringLiteral("--layout '%1': %2").arg(name, error));
    return false;
}

}  // namespace

int writeReport(const CommandCall &call)
{
    const QString name = call.application.value(QStringLiteral("output"));
    if (name.isEmpty())
        return call.application.usageError(QStringLiteral("no file to write to; use --output FILE"));
    qplc::Recording recording;
    qplc::ReportSelection selection;
    if (!openRecording(call, call.arguments.value(0), &recording)
        || !readTimes(call, recording, &selection.begin, &selection.end) || !readSections(call, &selection.sections)
        || !readPictures(call, &selection.pictures) || !readLayout(call, &selection.panels))
        return call.application.exitCode();
    selection.begin = std::max(selection.begin, recording.begin());
    selection.end = std::min(selection.end, recording.end());
    if (call.application.isSet(QStringLiteral("signals")) && !readSignals(call, recording, &selection.signalNumbers))
        return call.application.exitCode();
    const std::unique_ptr<qplc::OutputFile> file = openOutput(call, recording);
    if (!file)
        return call.application.exitCode();
    int damages = 0;
    const QByteArray page = qplc::reportOf(recording, selection, &damages);
    QString error;
    if (!file->write(page, &error) || !file->commit(&error)) {
        QPlcCoreApplication::printError(error);
        return QPlcCoreApplication::Failure;
    }
    printWritten(call, {{QStringLiteral("bytes"), page.size()}, {QStringLiteral("damages"), damages}},
                 QStringLiteral("a report of %1 kB").arg((page.size() + 999) / 1000));
    return exitCodeOf(recording, damages);
}

}  // namespace tools
