// SPDX-License-Identifier: Apache-2.0
// verify, recover: recordings, as files.
#include "Commands.h"
#include "TerminalText.h"
#include "recording/RecordingMessages.h"
#include "recording/Recovery.h"
#include "recording/Verification.h"

#include <QtCore/QFileInfo>
#include <QtCore/QJsonArray>

namespace tools {

namespace {

QJsonArray jsonOf(const QVector<qplc::VerifiedFile::Gap> &gaps)
{
    QJsonArray result;
    for (const qplc::VerifiedFile::Gap &gap : gaps)
        result.append(
            QJsonObject{{QStringLiteral("first"), double(gap.first)}, {QStringLiteral("last"), double(gap.last)}});
    return result;
}

QJsonDocument jsonOf(const qplc::VerifiedFile &file)
{
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
                                     {QStringLiteral("gaps"), jsonOf(file.gaps)},
                                     {QStringLiteral("digest"), QString::fromLatin1(qplc::digestText(file.digest))},
                                     {QStringLiteral("problems"), QJsonArray::fromStringList(file.problems)}});
}

void print(const QVector<qplc::VerifiedFile::Gap> &gaps, const QStringList &problems)
{
    for (const qplc::VerifiedFile::Gap &gap : gaps)
        printLine(QStringLiteral("gap: cycles %1 to %2 are missing").arg(gap.first).arg(gap.last));
    for (const QString &problem : problems)
        printLine(QStringLiteral("problem: ") + printable(problem));
}

void printDigest(quint64 digest, const QString &verdict)
{
    printLine(QStringLiteral("digest %1, %2").arg(QString::fromLatin1(qplc::digestText(digest)), verdict));
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
    print(file.gaps, file.problems);
    printDigest(file.digest,
                file.isComplete() ? QStringLiteral("as that of the flight: nothing is missing")
                                  : QStringLiteral("not the proof of a whole flight"));
}

QJsonObject jsonOf(const qplc::VerifiedPhase &phase)
{
    const qplc::RingDescription &description = phase.phase.description;
    return {{QStringLiteral("complete"), phase.isComplete()},
            {QStringLiteral("plant"), description.plant},
            {QStringLiteral("session"), QString::number(description.session, 16)},
            {QStringLiteral("phase"), double(description.phase)},
            {QStringLiteral("files"), QJsonArray::fromStringList(phase.phase.files)},
            {QStringLiteral("cycles"), double(phase.cycles)},
            {QStringLiteral("firstCycle"), double(phase.firstCycle)},
            {QStringLiteral("lastCycle"), double(phase.lastCycle)},
            {QStringLiteral("skipped"), double(phase.skipped)},
            {QStringLiteral("missing"), double(phase.missing)},
            {QStringLiteral("gaps"), jsonOf(phase.gaps)},
            {QStringLiteral("deleted"), jsonOf(phase.deleted)},
            {QStringLiteral("digest"), QString::fromLatin1(qplc::digestText(phase.digest))},
            {QStringLiteral("problems"), QJsonArray::fromStringList(phase.problems)}};
}

void print(const qplc::VerifiedPhase &phase)
{
    const qplc::RingDescription &description = phase.phase.description;
    printLine(QStringLiteral("plant '%1', session %2, phase %3: %4 cycles from %5 to %6 in %7 files, %8 skipped by the "
                             "master, %9 missing")
                  .arg(printable(description.plant), QString::number(description.session, 16))
                  .arg(description.phase)
                  .arg(phase.cycles)
                  .arg(phase.firstCycle)
                  .arg(phase.lastCycle)
                  .arg(phase.phase.files.size())
                  .arg(phase.skipped)
                  .arg(phase.missing));
    for (const qplc::VerifiedFile::Gap &gap : phase.deleted)
        printLine(QStringLiteral("deleted or not recorded: cycles %1 to %2").arg(gap.first).arg(gap.last));
    print(phase.gaps, phase.problems);
    const QString isWhole = phase.deleted.isEmpty() ? QStringLiteral("as that of the flight: nothing is missing")
                                                    : QStringLiteral("as that of the flight: nothing else is missing");
    printDigest(phase.digest, phase.isComplete() ? isWhole : QStringLiteral("not the proof of a whole flight"));
}

/// All phases whose files are in a folder.
int verifyFolder(const CommandCall &call, const QString &folder)
{
    QVector<qplc::RecordedPhase> phases;
    QStringList unreadable;
    QString error;
    if (!qplc::findPhases(folder, &phases, &unreadable, &error))
        return call.application.usageError(error);
    bool isComplete = unreadable.isEmpty();
    QJsonArray found;
    for (const qplc::RecordedPhase &phase : qAsConst(phases)) {
        const qplc::VerifiedPhase verified = qplc::verifyPhase(phase);
        isComplete = isComplete && verified.isComplete();
        if (call.isJson())
            found.append(jsonOf(verified));
        else
            print(verified);
    }
    if (call.isJson())
        printJson(QJsonDocument(QJsonObject{{QStringLiteral("complete"), isComplete},
                                            {QStringLiteral("phases"), found},
                                            {QStringLiteral("problems"), QJsonArray::fromStringList(unreadable)}}));
    else
        print({}, unreadable);
    return isComplete ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure;
}

}  // namespace

int verifyFile(const CommandCall &call)
{
    qplc::VerifiedFile file;
    QString error;
    const QString name = call.arguments.value(0);
    if (QFileInfo(name).isDir())
        return verifyFolder(call, name);
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
