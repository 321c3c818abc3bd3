// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Program.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QRegularExpression>

#include <memory>

/// The path of a program of the build.
inline QString programPath(const char *program)
{
    return QStringLiteral(QTPLC_PROGRAMS "/") + QString::fromLatin1(program);
}

/// The master of the kite on a free port; model and autopilot when they are wanted.
class ProcessPlant
{
public:
    /// \return false when the master does not listen
    bool start(const QStringList &options = {})
    {
        m_master
            = std::make_unique<Program>(programPath("awe_master"), QStringList{QStringLiteral("--port=0")} + options);
        if (!m_master->waitForOutput(QStringLiteral("\n")))
            return false;
        port = m_master->output().section(QLatin1Char('\n'), 0, 0).section(QLatin1Char(' '), 1);
        return true;
    }
    bool startNodes(const QStringList &autopilotOptions = {})
    {
        m_model = std::make_unique<Program>(programPath("awe_model"), QStringList{address()});
        m_autopilot
            = std::make_unique<Program>(programPath("awe_autopilot"), QStringList{address()} + autopilotOptions);
        return m_model->waitForErrors(QStringLiteral("registered"))
            && m_autopilot->waitForErrors(QStringLiteral("registered"));
    }
    QString address() const { return QStringLiteral("--master=127.0.0.1:%1").arg(port); }
    QStringList withMaster(const QString &command) const
    {
        return QStringList{address()} + command.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    }
    /// Runs qtplc with words that have no blanks.
    Outcome qtplc(const QString &command) const { return runProgram(programPath("qtplc"), withMaster(command)); }
    Program &master() { return *m_master; }
    Program &autopilot() { return *m_autopilot; }

    QString port;

private:
    std::unique_ptr<Program> m_master, m_model, m_autopilot;
};

/// The document that a program has printed: exactly one line of JSON; null else.
inline QJsonDocument jsonOf(const QString &output)
{
    if (!output.endsWith(QLatin1Char('\n')) || output.count(QLatin1Char('\n')) != 1)
        return {};
    return QJsonDocument::fromJson(output.toUtf8());
}
