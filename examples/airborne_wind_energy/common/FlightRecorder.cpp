// SPDX-License-Identifier: Apache-2.0
#include "FlightRecorder.h"

#include <cstdio>

namespace awe {

void FlightRecorder::addLimitOptions(QPlcCoreApplication &application)
{
    const auto add = [&application](const char *name, const QString &value, const QString &text) {
        application.addOption(QCommandLineOption(QString::fromLatin1(name), text, value));
    };
    add("keep-days", QStringLiteral("DAYS"), QStringLiteral("With --record FOLDER/: older files are deleted."));
    add("keep-gib", QStringLiteral("GIB"), QStringLiteral("With --record FOLDER/: keeps no more of them."));
    add("free-gib", QStringLiteral("GIB"),
        QStringLiteral("With --record FOLDER/: keeps so much of the disk free, default 1."));
}

bool FlightRecorder::readLimits(QPlcCoreApplication &application, Limits *limits)
{
    const auto read = [&application](const char *name, double least, double most, double *value) {
        return !application.isSet(QString::fromLatin1(name))
            || application.number(QString::fromLatin1(name), least, most, value);
    };
    return read("keep-days", 0.001, 1e5, &limits->days) && read("keep-gib", 0.001, 1e6, &limits->gibibytes)
        && read("free-gib", 0.0, 1e6, &limits->free);
}

FlightRecorder::FlightRecorder(QPlcMasterNode &master, const QString &target, const Limits &limits)
{
    if (target.isEmpty())
        return;
    constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;
    m_recorder.setTarget(target);
    m_recorder.setLongestAge(std::chrono::seconds(qRound64(limits.days * 86400.0)));
    m_recorder.setLargestTotal(quint64(limits.gibibytes * gibibyte));
    m_recorder.setLeastFree(quint64(limits.free * gibibyte));
    m_recorder.setMaster(&master);
    connect(&m_recorder, &QPlcRecorder::fileFinished, this, [](const QString &file, quint64 cycles, quint64 missing) {
        std::printf("%llu cycles in %s, %llu missing\n", cycles, qPrintable(file), missing);
    });
    connect(&m_recorder, &QPlcRecorder::errorOccurred, this, [this] {
        m_hasFailed = m_hasFailed || m_recorder.error() != QPlcRecorder::WriteError;
        if (m_recorder.error() == QPlcRecorder::WriteError)  // it goes on by itself
            QPlcCoreApplication::printError(m_recorder.errorString());
        else
            Q_EMIT failed(m_recorder.errorString());
    });
}

bool FlightRecorder::start()
{
    return m_recorder.target().isEmpty() || m_recorder.start();
}

bool FlightRecorder::finish()
{
    constexpr std::chrono::seconds patience(10);
    if (m_recorder.waitForFinished(patience))
        return !m_hasFailed;
    QPlcCoreApplication::printError(
        QStringLiteral("the last cycles are not in the file yet: %1").arg(m_recorder.status().error));
    return false;
}

}  // namespace awe
