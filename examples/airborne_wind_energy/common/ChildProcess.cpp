// SPDX-License-Identifier: Apache-2.0
#include "ChildProcess.h"

#include <QtCore/QFile>
#include <QtCore/QStandardPaths>

#include <csignal>
#include <sys/prctl.h>
#include <unistd.h>

namespace awe {

QString ChildProcess::pathOf(const QString &program)
{
    const QString beside = QStringLiteral("%1/%2").arg(QCoreApplication::applicationDirPath(), program);
    const QString installed = QFile::exists(beside) ? QString() : QStandardPaths::findExecutable(program);
    return installed.isEmpty() ? beside : installed;
}

void ChildProcess::setupChildProcess()
{
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != m_parent)  // it has ended meanwhile
        ::_exit(1);
}

std::optional<quint16> portOfMaster(const QByteArray &line)
{
    const QByteArray prefix = QByteArrayLiteral("port ");
    bool isNumber = false;
    const quint16 port = line.mid(prefix.size()).trimmed().toUShort(&isNumber);
    return line.startsWith(prefix) && isNumber && port > 0 ? std::optional<quint16>(port) : std::nullopt;
}

}  // namespace awe
