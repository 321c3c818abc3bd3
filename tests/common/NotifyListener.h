// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Waiting.h"

#include <QtCore/QFile>
#include <QtCore/QTemporaryDir>

#include <cstring>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

/// In the place of a service manager: hears what services tell it over $NOTIFY_SOCKET.
class NotifyListener
{
public:
    NotifyListener()
        : m_descriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0))
    {
        sockaddr_un address = {};
        address.sun_family = AF_UNIX;
        std::strncpy(address.sun_path, QFile::encodeName(path()).constData(), sizeof address.sun_path - 1);
        m_isOpen = ::bind(m_descriptor, reinterpret_cast<const sockaddr *>(&address), sizeof address) == 0;
    }
    ~NotifyListener() { ::close(m_descriptor); }
    NotifyListener(const NotifyListener &) = delete;
    NotifyListener &operator=(const NotifyListener &) = delete;

    bool isOpen() const { return m_isOpen; }
    QString path() const { return m_folder.filePath(QStringLiteral("notify")); }

    /// All lines that have come since the last call, in their order.
    QStringList take()
    {
        QByteArray lines;
        char text[4096];
        for (ssize_t size = 0; (size = ::recv(m_descriptor, text, sizeof text, 0)) >= 0;)
            lines += QByteArray(text, int(size)) + '\n';
        return QString::fromUtf8(lines).split(QLatin1Char('\n'), Qt::SkipEmptyParts);
    }
    /// Waits for \a line; what comes before it is gone then.
    bool waitFor(const QString &line, int milliseconds = 10000)
    {
        return waitUntil([&] { return take().contains(line); }, milliseconds);
    }

private:
    QTemporaryDir m_folder;
    int m_descriptor;
    bool m_isOpen = false;
};
