// SPDX-License-Identifier: Apache-2.0
// record start, stop, mark, status, list: the recorder of a folder.
#include "Commands.h"
#include "TerminalText.h"
#include "WaitFor.h"
#include "recording/RecorderControl.h"
#include "recording/RecordingFolder.h"

#include <QtCore/QDateTime>
#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtCore/QJsonArray>

namespace tools {

namespace {

using qplc::RecorderControl;
using qplc::RecordingFolder;

constexpr std::chrono::seconds LongestAnswer{10};
constexpr std::chrono::milliseconds LookAfter{20};

/// Asks \a isTrue again and again. \return false: for 10 s it was not true
template<typename Condition>
bool waitUntil(Condition isTrue)
{
    return isTrue() || waitFor(LongestAnswer, LookAfter, isTrue) == Waited::Done || isTrue();
}

int fail(const QString &text)
{
    QPlcCoreApplication::printError(text);
    return QPlcCoreApplication::Failure;
}

int failWithoutRecorder(const QString &folder)
{
    return fail(QStringLiteral("no recorder records into '%1'; start it: qtplc record %1/").arg(printable(folder)));
}

int failWithoutAnswer(const QString &folder)
{
    return fail(QStringLiteral("the recorder of '%1' does not answer; its disk may stall").arg(printable(folder)));
}

int markNow(const QString &folder)
{
    QString error;
    if (!RecorderControl::hasRecorder(folder))
        return failWithoutRecorder(folder);
    if (RecorderControl::status(folder).value("phases").toInt() == 0)
        return fail(
            QStringLiteral("nothing is being recorded into '%1', so there is nothing to mark").arg(printable(folder)));
    if (!RecorderControl::askForMark(folder, &error))
        return fail(error);
    if (waitUntil([&] { return RecorderControl::isMarkTaken(folder); }))
        return QPlcCoreApplication::Success;
    RecorderControl::withdrawMark(folder);
    return failWithoutAnswer(folder);
}

/// Without a recorder it holds for the next one.
int setStopped(const QString &folder, bool isStopped)
{
    QString error;
    if (!RecorderControl::setStopped(folder, isStopped, &error))
        return fail(error);
    const auto isDone = [&] { return (RecorderControl::status(folder).value("state") == "stopped") == isStopped; };
    if (!RecorderControl::hasRecorder(folder))
        return isStopped ? QPlcCoreApplication::Success : failWithoutRecorder(folder);
    return waitUntil(isDone) ? QPlcCoreApplication::Success : failWithoutAnswer(folder);
}

int showStatus(const CommandCall &call, const QString &folder)
{
    RecorderControl::Status status = RecorderControl::status(folder);
    const bool isThere = RecorderControl::hasRecorder(folder);
    if (!isThere)
        status["state"] = "off";
    if (call.isJson()) {
        QJsonObject object;
        for (auto it = status.begin(); it != status.end(); ++it) {
            bool isNumber = false;
            const double number = it.value().toDouble(&isNumber);
            object.insert(QString::fromUtf8(it.key()),
                          isNumber ? QJsonValue(number) : QJsonValue(QString::fromUtf8(it.value())));
        }
        printJson(QJsonDocument(object));
        return isThere ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure;
    }
    if (!isThere)
        return failWithoutRecorder(folder);
    printLine(QStringLiteral("%1, %2 cycles, %3 missing, %4 kB/s, %5 GB free")
                  .arg(QString::fromUtf8(status.value("state")), QString::fromUtf8(status.value("cycles")),
                       QString::fromUtf8(status.value("missing")))
                  .arg(status.value("bytes_per_second").toDouble() / 1e3, 0, 'f', 1)
                  .arg(status.value("free_bytes").toDouble() / 1e9, 0, 'f', 1));
    if (!status.value("file").isEmpty())
        printLine(QStringLiteral("file: ") + printable(QString::fromUtf8(status.value("file"))));
    if (!status.value("error").isEmpty())
        printLine(QStringLiteral("last error: ") + printable(QString::fromUtf8(status.value("error"))));
    return QPlcCoreApplication::Success;
}

int listFiles(const CommandCall &call, const QString &folder)
{
    const QVector<RecordingFolder::File> files = RecordingFolder::files(folder);
    QJsonArray array;
    for (const RecordingFolder::File &file : files) {
        const QString begin = QDateTime::fromMSecsSinceEpoch(file.begin, Qt::UTC).toString(Qt::ISODateWithMs);
        array.append(QJsonObject{{QStringLiteral("file"), file.path},
                                 {QStringLiteral("begin"), begin},
                                 {QStringLiteral("bytes"), double(file.size)},
                                 {QStringLiteral("marked"), file.isMarked},
                                 {QStringLiteral("finished"), !file.isUnfinished}});
        if (!call.isJson())
            printLine(QStringLiteral("%1 %2 MB%3%4")
                          .arg(printable(QDir(folder).relativeFilePath(file.path)))
                          .arg(double(file.size) / 1e6, 0, 'f', 1)
                          .arg(file.isMarked ? QStringLiteral(", marked") : QString(),
                               file.isUnfinished ? QStringLiteral(", not finished") : QString()));
    }
    if (call.isJson())
        printJson(QJsonDocument(array));
    return QPlcCoreApplication::Success;
}

}  // namespace

int controlRecorder(const CommandCall &call)
{
    const QString what = call.arguments.value(0);
    const QString folder = QDir(call.arguments.value(1)).absolutePath();
    if (!QDir(folder).exists())
        return call.application.usageError(QStringLiteral("there is no folder '%1'").arg(folder));
    if (!QFileInfo(folder).isReadable() || !QFileInfo(folder).isExecutable())
        return call.application.usageError(
            QStringLiteral("cannot read the folder '%1': permission denied").arg(folder));
    if (what == QLatin1String("start") || what == QLatin1String("stop"))
        return setStopped(folder, what == QLatin1String("stop"));
    if (what == QLatin1String("mark"))
        return markNow(folder);
    if (what == QLatin1String("status"))
        return showStatus(call, folder);
    if (what == QLatin1String("list"))
        return listFiles(call, folder);
    return call.application.usageError(
        QStringLiteral("'record %1' is not a command; use start, stop, mark, status or list, and a folder").arg(what));
}

}  // namespace tools
