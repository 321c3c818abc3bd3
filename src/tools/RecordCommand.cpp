// SPDX-License-Identifier: Apache-2.0
// record: from the rings of masters on this computer, or of one on another computer, into a file or
// a folder.
#include "Commands.h"
#include "RemoteRings.h"
#include "TerminalText.h"
#include "recording/RingFiles.h"

#include <QtPlcRecording>

#include <cstdio>
#include <functional>

namespace tools {

namespace {

constexpr double Mebibyte = 1024.0 * 1024.0;
constexpr double Gibibyte = 1024.0 * Mebibyte;

/// The ring of the only master of this user. Empty, with the message out: none, or several.
QString onlyRing(const CommandCall &call)
{
    const QStringList rings = qplc::ringsOfMasters();
    if (rings.size() == 1)
        return rings.constFirst();
    call.application.usageError(
        rings.isEmpty() ? QStringLiteral("no master of this user runs cycles on this computer; start the plant first")
                        : QStringLiteral("several masters run cycles: name one of their rings, --ring %1")
                              .arg(rings.join(QStringLiteral(" or --ring "))));
    return {};
}

/// All plants, or the one of --ring. The master keeps the cycles, or its recorder does.
int markPlants(const CommandCall &call)
{
    const QString option = QStringLiteral("ring");
    const QStringList rings
        = call.application.isSet(option) ? QStringList(call.application.value(option)) : qplc::ringsOfMasters();
    if (rings.isEmpty())
        return call.application.usageError(
            QStringLiteral("no master of this user runs cycles on this computer; start the plant first"));
    for (const QString &ring : rings) {
        QString error;
        if (!qplc::markRing(ring, &error))
            return call.application.usageError(error);
        printLine(QStringLiteral("marked %1: the cycles of 30 s before and 10 s after are kept").arg(printable(ring)));
    }
    return QPlcCoreApplication::Success;
}

/// \return false, with the message out
bool readLimits(const CommandCall &call, QPlcRecorder *recorder)
{
    double hours = 1.0;
    double megabytes = 256.0;
    double days = 0.0;
    double total = 0.0;
    double free = 1.0;
    if (!call.readNumber("segment-hours", 0.001, 1000.0, &hours)
        || !call.readNumber("segment-mib", 1.0, 1e6, &megabytes) || !call.readNumber("keep-days", 0.001, 1e5, &days)
        || !call.readNumber("keep-gib", 0.001, 1e6, &total) || !call.readNumber("free-gib", 0.0, 1e6, &free))
        return false;
    const auto seconds = [](double value) { return std::chrono::seconds(qRound64(value)); };
    recorder->setSegmentDuration(seconds(hours * 3600.0));
    recorder->setSegmentSize(quint64(megabytes * Mebibyte));
    recorder->setLongestAge(seconds(days * 86400.0));
    recorder->setLargestTotal(quint64(total * Gibibyte));
    recorder->setLeastFree(quint64(free * Gibibyte));
    return true;
}

void tellFiles(QPlcRecorder *recorder)
{
    QObject::connect(recorder, &QPlcRecorder::fileStarted, recorder, [](const QString &file, const QString &plant) {
        printLine(QStringLiteral("recording plant '%1' to %2").arg(printable(plant), printable(file)));
        std::fflush(stdout);
    });
    QObject::connect(
        recorder, &QPlcRecorder::fileFinished, recorder, [](const QString &file, quint64 cycles, quint64 missing) {
            printLine(QStringLiteral("%1 cycles in %2, %3 missing").arg(cycles).arg(printable(file)).arg(missing));
            std::fflush(stdout);
        });
    QObject::connect(recorder, &QPlcRecorder::masterLost, recorder, [](const QString &file) {
        QPlcCoreApplication::printError(
            QStringLiteral("the master has ended without the end of its phase, which is recorded to %1")
                .arg(printable(file)));
    });
    QObject::connect(recorder, &QPlcRecorder::errorOccurred, recorder, [recorder] {
        if (recorder->error() == QPlcRecorder::WriteError)
            QPlcCoreApplication::printError(recorder->errorString()
                                            + QStringLiteral("; the ring keeps the cycles, and it is tried again"));
    });
}

/// A phase is over, or people want the end.
void quitAtTheEndOfThePhase(QPlcRecorder *recorder)
{
    QObject::connect(recorder, &QPlcRecorder::stateChanged, recorder, [](QPlcRecorder::State state) {
        if (state == QPlcRecorder::Waiting)
            QCoreApplication::quit();
    });
}

/// Records until a person ends it.
/// \param isOnePhase  the end of a phase ends it, too
/// \param begin       tells the recorder what to record. \return false when the recorder refuses it
/// \param end         runs after the recorder has stopped. \return empty, or what went wrong
int record(const CommandCall &call, QPlcRecorder *recorder, bool isOnePhase, const std::function<bool()> &begin,
           const std::function<QString()> &end)
{
    bool isAbandoned = false;
    QObject::connect(recorder, &QPlcRecorder::masterLost, recorder, [&isAbandoned] { isAbandoned = true; });
    if (isOnePhase)
        quitAtTheEndOfThePhase(recorder);
    const std::shared_ptr<const bool> isStopped = call.quitOnSignals();
    if (!recorder->start() || !begin())
        return call.application.usageError(recorder->errorString());
    if (!isOnePhase) {
        printLine(QStringLiteral("recording into %1").arg(printable(recorder->target())));
        std::fflush(stdout);
    }
    if (!*isStopped)
        call.application.exec();
    const bool isWritten = recorder->stop();
    const QString trouble = end();
    if (!trouble.isEmpty() || !isWritten) {
        QPlcCoreApplication::printError(trouble.isEmpty() ? recorder->errorString() : trouble);
        return QPlcCoreApplication::Failure;
    }
    return isOnePhase && isAbandoned ? QPlcCoreApplication::Failure : QPlcCoreApplication::Success;
}

/// Records rings of this computer. \param ring  the only one; empty: all
int recordRings(const CommandCall &call, QPlcRecorder *recorder, const QString &ring)
{
    if (ring.isEmpty())
        recorder->setPlant(call.application.value(QStringLiteral("plant")));
    const auto begin = [&] { return ring.isEmpty() || recorder->addRing(ring); };
    return record(call, recorder, !ring.isEmpty(), begin, [] { return QString(); });
}

/// Records the phases of a master on another computer.
int recordRemotely(const CommandCall &call, QPlcRecorder *recorder)
{
    for (const char *option : {"ring", "plant"}) {
        if (call.application.isSet(QLatin1String(option)))
            return call.application.usageError(
                QStringLiteral("--%1 is for masters of this computer; leave it out with --master")
                    .arg(QLatin1String(option)));
    }
    RemoteRings remote(recorder, call.master);
    QObject::connect(&remote, &RemoteRings::failed, &remote, [] { QCoreApplication::quit(); });
    QObject::connect(&remote, &RemoteRings::troubled, &remote, &QPlcCoreApplication::printError);
    const auto begin = [&remote] {
        remote.start();
        return true;
    };
    const auto end = [&remote] {
        remote.finish();
        return remote.errorString();
    };
    return record(call, recorder, !recorder->isFolder(), begin, end);
}

}  // namespace

int recordPlant(const CommandCall &call)
{
    if (call.arguments.size() == 2)
        return controlRecorder(call);
    const QString target = call.arguments.value(0);
    if (target == QLatin1String("mark"))
        return markPlants(call);
    const QStringList verbs{QStringLiteral("start"), QStringLiteral("stop"), QStringLiteral("status"),
                            QStringLiteral("list")};
    if (verbs.contains(target))
        return call.application.usageError(
            QStringLiteral("'record %1' needs the FOLDER of a recorder; for a file of this name, write ./%1")
                .arg(target));
    QPlcRecorder recorder;
    recorder.setTarget(target);
    if (!readLimits(call, &recorder))
        return QPlcCoreApplication::UsageError;
    tellFiles(&recorder);
    if (call.application.isSet(QStringLiteral("master")))
        return recordRemotely(call, &recorder);
    const QString option = QStringLiteral("ring");
    const bool isOnePhase = call.application.isSet(option) || !recorder.isFolder();
    const QString ring
        = !isOnePhase || call.application.isSet(option) ? call.application.value(option) : onlyRing(call);
    if (isOnePhase && ring.isEmpty())
        return QPlcCoreApplication::UsageError;
    return recordRings(call, &recorder, ring);
}

}  // namespace tools
