// SPDX-License-Identifier: Apache-2.0
// verify, recover: recordings, as files.
#include "Commands.h"
#include "TerminalText.h"
#include "recording/RecordingMessages.h"
#include "recording/Recovery.h"
#include "recording/Verification.h"

#include <QtCore/QJsonArray>

namespace tools {

namespace {

QJsonDocument jsonOf(const qplc::VerifiedFile &file)
{
    QJsonArray gaps;
    for (const qplc::VerifiedFile::Gap &gap : file.gaps)
        gaps.append(
            QJsonObject{{QStringLiteral("first"), double(gap.first)}, {QStringLiteral("last"), double(gap.last)}});
    return QJsonDocument(QJsonObject{{QStringLiteral("complete"), file.isComplete()},
                                     {QStringLiteral("finished"), file.isFinished},
                                     {QStringLiteral("plant"), file.description.plant},
                                     {QStringLiteral("cycles"), double(file.cycles)},
                                     {QStringLiteral("firstCycle"), double(file.firstCycle)},
                                     {QStringLiteral("lastCycle"), double(file.lastCycle)},
                                     {QStringLiteral("from"), double(file.from)},
                                     {QStringLiteral("next"), double(file.next)},
                                     {QStringLiteral("skipped"), double(file.skipped)},
                                     {QStringLiteral("missing"), double(file.missing)},
                                     {QStringLiteral("gaps"), gaps},
                                     {QStringLiteral("digest"), QString::fromLatin1(qplc::digestText(file.digest))},
                                     {QStringLiteral("problems"), QJsonArray::fromStringList(file.problems)}});
}

void print(const QString &name, const qplc::VerifiedFile &file)
{
    printLine(QStringLiteral("%1: plant '%2', %3 cycles from %4 to %5, %6 skipped by the master, %7 missing")
                  .arg(printable(name), printable(file.description.plant))
                  .arg(file.cycles)
                  .arg(file.firstCycle)
                  .arg(file.lastCycle)
                  .arg(file.skipped)
                  .arg(file.missing));
    for (const qplc::VerifiedFile::Gap &gap : file.gaps)
        printLine(QStringLiteral("gap: cycles %1 to %2 are missing").arg(gap.first).arg(gap.last));
    for (const QString &problem : file.problems)
        printLine(QStringLiteral("problem: ") + printable(problem));
    printLine(QStringLiteral("digest %1, %2")
                  .arg(QString::fromLatin1(qplc::digestText(file.digest)),
                       file.isComplete() ? QStringLiteral("as that of the flight: nothing is missing")
                                         : QStringLiteral("not the proof of a whole flight")));
}

}  // namespace

int verifyFile(const CommandCall &call)
{
    qplc::VerifiedFile file;
    QString error;
    const QString name = call.arguments.value(0);
    if (!qplc::verifyRecording(name, &file, &error))
        return call.application.usageError(error);
    if (call.isJson())
        printJson(jsonOf(file));
    else
        print(name, file);
    return file.isComplete() ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure;
}

int recoverFile(const CommandCall &call)
{
    qplc::RecoveredFile file;
    QString error;
    const QString name = call.arguments.value(0);
    if (!qplc::recoverRecording(name, &file, &error))
        return call.application.usageError(error);
    if (call.isJson())
        printJson(QJsonDocument(QJsonObject{{QStringLiteral("wasFinished"), file.wasFinished},
                                            {QStringLiteral("chunks"), double(file.chunks)},
                                            {QStringLiteral("lostBytes"), double(file.lostBytes)},
                                            {QStringLiteral("damages"), file.damages}}));
    else if (file.wasFinished)
        printLine(QStringLiteral("%1: finished, nothing to do").arg(printable(name)));
    else
        printLine(QStringLiteral("%1: finished now, with %2 chunks; %3 bytes at its end were not whole, %4 places are "
                                 "damaged")
                      .arg(printable(name))
                      .arg(file.chunks)
                      .arg(file.lostBytes)
                      .arg(file.damages));
    return file.damages == 0 ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure;
}

}  // namespace tools
