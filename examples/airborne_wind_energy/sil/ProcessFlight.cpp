// SPDX-License-Identifier: Apache-2.0
#include "ProcessFlight.h"

#include <QtCore/QFile>
#include <QtCore/QJsonDocument>
#include <QtCore/QTimer>
#include <QtPlcCore>

namespace awe {

bool ProcessFlight::begin(const ProcessArguments &arguments)
{
    m_arguments = arguments;
    const QString reportFile = m_directory.filePath(QStringLiteral("report.json"));
    connect(&m_processes, &ProcessGroup::ended, this, &ProcessFlight::ended);
    m_master = m_processes.start(QStringLiteral("awe_master"),
                                 arguments.master
                                     + QStringList{QStringLiteral("--port=0"),
                                                   QStringLiteral("--start-with=Model,Autopilot"),
                                                   QStringLiteral("--report=%1").arg(reportFile)});
    if (!m_master)
        return false;
    connect(m_master, &QProcess::readyReadStandardOutput, this, &ProcessFlight::startNodes);
    return true;
}

void ProcessFlight::startNodes()
{
    if (m_nodesStarted || !m_master->canReadLine())
        return;
    const std::optional<quint16> port = portOfMaster(m_master->readLine());
    if (!port)
        return;
    m_nodesStarted = true;
    const QString address = QStringLiteral("--master=%1://127.0.0.1:%2").arg(m_arguments.transport).arg(*port);
    const ProcessGroup::Errors errors = m_arguments.watch ? ProcessGroup::HoldErrors : ProcessGroup::ShowErrors;
    if (!m_processes.start(QStringLiteral("awe_compact_model"), QStringList{address} + m_arguments.model, errors)
        || !m_processes.start(QStringLiteral("awe_autopilot"), QStringList{address} + m_arguments.autopilot, errors))
        QMetaObject::invokeMethod(
            this, [this] { Q_EMIT finished(QPlcCoreApplication::UsageError); }, Qt::QueuedConnection);
}

void ProcessFlight::ended(const QString &program, int exitCode)
{
    if (program != QLatin1String("awe_master") && m_ending)
        return;  // the master has the last word
    if (program != QLatin1String("awe_master")) {
        // The master notices a lost node by itself and ends with a report; a node that it has never seen leaves it waiting.
        if (exitCode == QPlcCoreApplication::UsageError)
            Q_EMIT finished(exitCode);
        else
            QTimer::singleShot(2000, this, [this, program] {
                QPlcCoreApplication::printError(
                    QStringLiteral("%1 has ended, and the master waits for it: the flight ends").arg(program));
                Q_EMIT finished(QPlcCoreApplication::Failure);
            });
        return;
    }
    QFile file(m_directory.filePath(QStringLiteral("report.json")));
    if (file.open(QIODevice::ReadOnly))
        m_report = QJsonDocument::fromJson(file.readAll()).object();
    if (exitCode < 0)
        QPlcCoreApplication::printError(QStringLiteral("the master has crashed"));
    Q_EMIT finished(exitCode < 0 ? int(QPlcCoreApplication::Failure) : exitCode);
}

void ProcessFlight::end()
{
    m_ending = true;
    m_master->terminate();  // its end brings the report, and is ours
}

}  // namespace awe
