// SPDX-License-Identifier: Apache-2.0
// replay: a node computes again what a recording says.
#include "Commands.h"
#include "TerminalText.h"
#include "replay/NodeReplay.h"

#include <QtCore/QJsonArray>

namespace tools {

namespace {

using qplc::ReplayResult;

QString cycleText(const ReplayResult::Difference &difference)
{
    return difference.cycle == ReplayResult::Initial
        ? QStringLiteral("initial value")
        : QStringLiteral("cycle %1, %2 s").arg(difference.cycle).arg(difference.time, 0, 'f', 3);
}

QJsonDocument jsonOf(const ReplayResult &result)
{
    QJsonObject object{{QStringLiteral("node"), result.node},
                       {QStringLiteral("cycles"), double(result.cycles)},
                       {QStringLiteral("compared"), double(result.compared)},
                       {QStringLiteral("unknown"), double(result.unknown)},
                       {QStringLiteral("differences"), double(result.differences)},
                       {QStringLiteral("simulated"), result.simulated},
                       {QStringLiteral("elapsed"), result.elapsed},
                       {QStringLiteral("notes"), QJsonArray::fromStringList(result.notes)}};
    if (!result.first)
        return QJsonDocument(object);
    QJsonObject first{{QStringLiteral("signal"), result.first->signal},
                      {QStringLiteral("time"), result.first->time},
                      {QStringLiteral("recorded"), result.first->recorded},
                      {QStringLiteral("computed"), result.first->computed}};
    if (result.first->cycle != ReplayResult::Initial)
        first.insert(QStringLiteral("cycle"), double(result.first->cycle));
    object.insert(QStringLiteral("first"), first);
    return QJsonDocument(object);
}

void print(const ReplayResult &result, bool compares)
{
    printLine(QStringLiteral("node '%1' has computed %2 cycles, %3 s in %4 s: %5 x real time")
                  .arg(printable(result.node))
                  .arg(result.cycles)
                  .arg(result.simulated, 0, 'f', 1)
                  .arg(result.elapsed, 0, 'f', 1)
                  .arg(result.speed(), 0, 'f', 0));
    for (const QString &note : result.notes)
        printLine(printable(note));
    if (!compares)
        return;
    printLine(QStringLiteral("%1 cycles compared, %2 that the recording does not show, %3 differences")
                  .arg(result.compared)
                  .arg(result.unknown)
                  .arg(result.differences));
    if (result.first)
        printLine(QStringLiteral("first difference: %1, %2: recorded %3, computed %4")
                      .arg(printable(result.first->signal), cycleText(*result.first), printable(result.first->recorded),
                           printable(result.first->computed)));
}

/// \return false, with the message out, when an option is wrong
bool readOptions(const CommandCall &call, qplc::ReplayRequest *request)
{
    request->file = call.arguments.value(0);
    request->program = call.application.value(QStringLiteral("node")).trimmed();
    request->name = call.application.value(QStringLiteral("name"));
    if (!call.readNumber("from", 0.0, 1e9, &request->from))
        return false;
    const QString speed = call.application.value(QStringLiteral("speed"));
    bool isSpeed = true;
    if (call.application.isSet(QStringLiteral("speed")) && speed != QLatin1String("lockstep")) {
        request->speed = speed.toDouble(&isSpeed);
        isSpeed = isSpeed && request->speed > 0.0;
    }
    QString error;
    if (request->program.isEmpty())
        error = QStringLiteral("no program is given; name it with --node 'PROGRAM ARGUMENTS'");
    else if (!isSpeed)
        error = QStringLiteral("--speed '%1' is not a speed; give lockstep, or a factor as 1 or 0.5").arg(speed);
    if (!error.isEmpty())
        call.application.usageError(error);
    return error.isEmpty();
}

}  // namespace

int replayRecording(const CommandCall &call)
{
    qplc::ReplayRequest request;
    if (!readOptions(call, &request))
        return QPlcCoreApplication::UsageError;
    const bool compares = call.application.isSet(QStringLiteral("compare"));
    const ReplayResult result = qplc::replayNode(request);
    if (result.kind == ReplayResult::Refused)
        return call.application.usageError(result.error);
    if (call.isJson())
        printJson(jsonOf(result));
    else if (!result.node.isEmpty())
        print(result, compares);
    if (result.kind == ReplayResult::Failed)
        QPlcCoreApplication::printError(result.error);
    const bool isGood = result.kind == ReplayResult::Done && (!compares || result.differences == 0);
    return isGood ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure;
}

}  // namespace tools
