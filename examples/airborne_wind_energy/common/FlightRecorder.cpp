// SPDX-License-Identifier: Apache-2.0
#include "FlightRecorder.h"

#include <cstdio>

namespace awe {

FlightRecorder::FlightRecorder(QPlcMasterNode &master, const QString &target)
{
    if (target.isEmpty())
        return;
    m_recorder.setTarget(target);
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
