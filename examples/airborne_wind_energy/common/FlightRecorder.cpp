// SPDX-License-Identifier: Apache-2.0
#include "FlightRecorder.h"

#include <QtCore/QFileInfo>

#include <cstdio>

namespace awe {

namespace {

constexpr int patience = 10'000;  // [ms] for the begin and for the end of the recorder

}  // namespace

FlightRecorder::FlightRecorder(QPlcMasterNode &master, const QString &file)
    : m_file(file)
{
    if (!file.isEmpty())
        connect(&master, &QPlcMasterNode::ringIsReady, this, &FlightRecorder::record, Qt::DirectConnection);
}

FlightRecorder::~FlightRecorder()
{
    finish();
}

QString FlightRecorder::nextFile()
{
    ++m_count;
    if (m_count == 1)
        return m_file;
    const QFileInfo info(m_file);
    const QString suffix = info.suffix().isEmpty() ? QString() : QLatin1Char('.') + info.suffix();
    return m_file.left(m_file.size() - suffix.size()) + QStringLiteral("-%1").arg(m_count) + suffix;
}

/// Cycles begin when this returns: the recorder gets all of them.
void FlightRecorder::record(const QString &ring)
{
    finish();
    m_process = std::make_unique<ChildProcess>();
    m_process->setProcessChannelMode(QProcess::ForwardedErrorChannel);
    m_process->start(ChildProcess::pathOf(QStringLiteral("qtplc")),
                     {QStringLiteral("record"), nextFile(), QStringLiteral("--ring"), ring});
    if (!m_process->waitForStarted(patience))
        Q_EMIT failed(QStringLiteral("cannot start %1: %2; is it beside this program?")
                          .arg(m_process->program(), m_process->errorString()));
    else if (!m_process->waitForReadyRead(patience) || !m_process->readLine().startsWith("recording "))
        Q_EMIT failed({});
}

bool FlightRecorder::finish()
{
    if (!m_process)
        return true;
    const std::unique_ptr<ChildProcess> process = std::move(m_process);
    const bool hasEnded = process->state() == QProcess::NotRunning || process->waitForFinished(patience);
    std::fputs(process->readAllStandardOutput().constData(), stdout);
    if (!hasEnded)
        process->terminate();
    return process->waitForFinished(patience) || hasEnded
        ? process->exitStatus() == QProcess::NormalExit && process->exitCode() == QPlcCoreApplication::Success
        : false;
}

}  // namespace awe
