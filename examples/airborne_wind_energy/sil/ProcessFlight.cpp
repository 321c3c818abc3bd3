// SPDX-License-Identifier: Apache-2.0
#include "ProcessFlight.h"

#include "FlightRun.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QJsonDocument>
#include <QtCore/QTimer>
#include <QtPlcCore>

namespace awe {

namespace {

const QString hardwareProgram = QStringLiteral("qtplc_hardware");
const QString driveProgram = QStringLiteral("awe_winch_drive");
constexpr int restartPause = 1000;  // [ms]

}  // namespace

bool ProcessFlight::begin(const ProcessArguments &arguments)
{
    m_arguments = arguments;
    const QString reportFile = m_directory.filePath(QStringLiteral("report.json"));
    connect(&m_processes, &ProcessGroup::ended, this, &ProcessFlight::ended);
    m_master = m_processes.start(QStringLiteral("awe_master"),
                                 arguments.master
                                     + QStringList{QStringLiteral("--port=0"),
                                                   QStringLiteral("--start-with=%1").arg(nodes().join(',')),
                                                   QStringLiteral("--report=%1").arg(reportFile)});
    if (!m_master)
        return false;
    connect(m_master, &QProcess::readyReadStandardOutput, this, &ProcessFlight::startNodes);
    return true;
}

QStringList ProcessFlight::nodes() const
{
    QStringList names{QStringLiteral("Model"), QStringLiteral("Autopilot")};
    if (!m_arguments.hardware.isEmpty())
        names << winchNode();
    return names;
}

void ProcessFlight::startNodes()
{
    if (m_nodesStarted || !m_master->canReadLine())
        return;
    const std::optional<quint16> port = portOfMaster(m_master->readLine());
    if (!port)
        return;
    m_nodesStarted = true;
    m_address = QStringLiteral("--master=%1://127.0.0.1:%2").arg(m_arguments.transport).arg(*port);
    const ProcessGroup::Errors errors = errorsOfNodes();
    if (!m_processes.start(m_arguments.modelProgram, QStringList{m_address} + m_arguments.model, errors)
        || !m_processes.start(QStringLiteral("awe_autopilot"), QStringList{m_address} + m_arguments.autopilot, errors)
        || !startDrive() || !startWinch())
        QMetaObject::invokeMethod(
            this, [this] { Q_EMIT finished(QPlcCoreApplication::UsageError); }, Qt::QueuedConnection);
}

ProcessGroup::Errors ProcessFlight::errorsOfNodes() const
{
    return m_arguments.watch ? ProcessGroup::HoldErrors : ProcessGroup::ShowErrors;
}

bool ProcessFlight::startDrive()
{
    if (m_arguments.winch.isEmpty())
        return true;
    plugInDevices();
    return m_processes.start(driveProgram, m_arguments.winch, errorsOfNodes());
}

bool ProcessFlight::startWinch()
{
    return m_arguments.hardware.isEmpty()
        || m_processes.start(hardwareProgram, {accessible(m_arguments.hardware), m_address}, errorsOfNodes());
}

/// Devices that are played lie in a folder: that of the user, or else of this flight. The contact
/// of the emergency stop is closed: low.
void ProcessFlight::plugInDevices() const
{
    constexpr int lines = 32;
    const char *const variable = "QTPLC_FAKE_DEVICES";
    if (qEnvironmentVariableIsEmpty(variable))
        qputenv(variable, m_directory.path().toLocal8Bit());
    const QDir folder(qEnvironmentVariable(variable));
    folder.mkpath(QStringLiteral("."));
    QFile buttons(folder.filePath(QStringLiteral("buttons")));
    if (!buttons.exists() && buttons.open(QIODevice::WriteOnly))
        buttons.write(QByteArray(lines, '\0'));
}

QString ProcessFlight::accessible(const QString &fileName)
{
    if (!fileName.startsWith(QLatin1Char(':')))
        return fileName;
    const QDir from = QFileInfo(fileName).dir();
    const QStringList names = from.entryList();
    for (const QString &name : names)  // what is named in it, too
        QFile::copy(from.filePath(name), m_directory.filePath(name));
    return m_directory.filePath(QFileInfo(fileName).fileName());
}

/// Hardware may come and go. The node is started again, as the system of a real plant would do; a
/// drive that has ended stays where it is.
void ProcessFlight::hardwareEnded(const QString &program, int exitCode)
{
    if (exitCode == QPlcCoreApplication::UsageError)
        Q_EMIT finished(exitCode);
    else if (program == hardwareProgram)
        QTimer::singleShot(restartPause, this, [this] {
            if (!m_ending)
                startWinch();
        });
    else
        QPlcCoreApplication::printError(QStringLiteral("%1 has ended: the winch stands still").arg(program));
}

void ProcessFlight::ended(const QString &program, int exitCode)
{
    if (program != QLatin1String("awe_master") && m_ending)
        return;  // the master has the last word
    if (program == hardwareProgram || program == driveProgram)
        return hardwareEnded(program, exitCode);
    if (program != QLatin1String("awe_master")) {
        // The master notices a lost node by itself and ends with a report; a node that it has never
        // seen leaves it waiting.
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
