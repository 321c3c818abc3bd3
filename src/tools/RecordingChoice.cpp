// SPDX-License-Identifier: Apache-2.0
#include "RecordingChoice.h"

#include "SignalSelection.h"
#include "TerminalText.h"

#include <QtCore/QDateTime>
#include <QtCore/QFileInfo>

#include <cmath>

namespace tools {

namespace {

using qplc::RecordedTime;

constexpr double Second = 1e9;  // [ns]

/// \return false, with the message out
bool readTime(const CommandCall &call, const char *option, const qplc::Recording &recording, RecordedTime *time)
{
    const QString name = QString::fromLatin1(option);
    if (!call.application.isSet(name))
        return true;
    const QString text = call.application.value(name);
    bool isNumber = false;
    const double seconds = text.toDouble(&isNumber);
    if (isNumber && std::abs(seconds) < 1e9) {
        *time = recording.begin() + RecordedTime(std::llround(seconds * Second));
        return true;
    }
    QDateTime moment = QDateTime::fromString(text, Qt::ISODateWithMs);
    if (moment.timeSpec() == Qt::LocalTime)
        moment.setTimeSpec(Qt::UTC);
    if (moment.isValid() && !isNumber) {
        *time = RecordedTime(moment.toMSecsSinceEpoch()) * 1'000'000;
        return true;
    }
    call.application.usageError(QStringLiteral("--%1: '%2' is not a time; use seconds since the begin of the "
                                               "recording, or a moment as 2026-11-20T14:03:12 (UTC)")
                                    .arg(name, text));
    return false;
}

}  // namespace

bool openRecording(const CommandCall &call, const QString &path, qplc::Recording *recording)
{
    QString error;
    if (!recording->open({path}, &error)) {
        call.application.usageError(error);
        return false;
    }
    const QStringList notes = recording->notes();
    for (const QString &note : notes)
        QPlcCoreApplication::printError(note);
    return true;
}

bool readTimes(const CommandCall &call, const qplc::Recording &recording, RecordedTime *begin, RecordedTime *end)
{
    *begin = recording.begin();
    *end = recording.end();
    if (!readTime(call, "from", recording, begin) || !readTime(call, "to", recording, end))
        return false;
    if (*begin <= *end && *begin <= recording.end() && *end >= recording.begin())
        return true;
    call.application.usageError(QStringLiteral("the recording has no cycle of these times: it takes %1 s")
                                    .arg(double(recording.end() - recording.begin()) / Second));
    return false;
}

bool readSignals(const CommandCall &call, const qplc::Recording &recording, std::vector<int> *numbers)
{
    QStringList names;
    if (!selectSignalsOrAll(call.application, recording.table(), call.listOf("signals"), &names))
        return false;
    for (const QString &name : qAsConst(names))
        numbers->push_back(recording.indexOf(name));
    return true;
}

std::unique_ptr<qplc::OutputFile> openOutput(const CommandCall &call, const qplc::Recording &recording)
{
    const QString name = call.application.value(QStringLiteral("output"));
    const QString target = QFileInfo(name).canonicalFilePath();  // empty: no file has this name
    for (const qplc::RecordedFile &file : recording.files()) {
        if (target.isEmpty() || QFileInfo(file.name).canonicalFilePath() != target)
            continue;
        call.application.usageError(
            QStringLiteral("'%1' is a file of the recording, which would be lost; choose another name").arg(name));
        return nullptr;
    }
    const bool replaces = call.application.isSet(QStringLiteral("force"));
    auto file
        = std::make_unique<qplc::OutputFile>(name, replaces ? qplc::OutputFile::Replace : qplc::OutputFile::Refuse);
    QString error;
    if (file->open(&error))
        return file;
    call.application.usageError(error);
    return nullptr;
}

void printWritten(const CommandCall &call, QJsonObject facts, const QString &text)
{
    const QString name = call.application.value(QStringLiteral("output"));
    if (name == QLatin1String(qplc::OutputFile::StandardOutput))
        return;
    facts.insert(QStringLiteral("file"), name);
    if (call.isJson())
        printJson(QJsonDocument(facts));
    else
        printLine(QStringLiteral("%1: %2").arg(printable(name), text));
}

int exitCodeOf(const qplc::Recording &recording, int damages)
{
    if (damages == 0)
        return recording.unreadable() == 0 ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure;
    QPlcCoreApplication::printError(
        QStringLiteral("%1 places of the recording are damaged: what they had was left out").arg(damages));
    return QPlcCoreApplication::Failure;
}

}  // namespace tools
