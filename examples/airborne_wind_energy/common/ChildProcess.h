// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QCoreApplication>
#include <QtCore/QProcess>

#include <optional>

namespace awe {

/// A program that ends with this one, however this one ends, and that Ctrl-C in the terminal does
/// not reach: it is told by us.
class ChildProcess : public QProcess
{
    Q_OBJECT
public:
    using QProcess::QProcess;

    /// The path of a program that lies beside this one, or else in the search path: programs of an
    /// installed QtPLC.
    static QString pathOf(const QString &program);

protected:
    void setupChildProcess() override;

private:
    const qint64 m_parent = QCoreApplication::applicationPid();
};

/// What awe_master says first, "port NUMBER": where it listens. Nothing when \a line says something
/// else.
std::optional<quint16> portOfMaster(const QByteArray &line);

}  // namespace awe
