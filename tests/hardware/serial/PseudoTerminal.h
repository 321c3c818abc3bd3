// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/fake/FakeMemory.h"

#include <QtCore/QByteArray>
#include <QtCore/QDir>
#include <QtCore/QFile>

#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

/// The far end of a serial line, and the plug: what is written here comes out of the near end.
class PseudoTerminal
{
public:
    PseudoTerminal() = default;
    ~PseudoTerminal() { unplug(); }
    PseudoTerminal(const PseudoTerminal &) = delete;
    PseudoTerminal &operator=(const PseudoTerminal &) = delete;

    /// Makes the near end, and calls it \a device ("fake:NAME") if that is not empty.
    bool plugIn(const QString &device = {})
    {
        unplug();
        m_master = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
        if (m_master < 0 || ::grantpt(m_master) < 0 || ::unlockpt(m_master) < 0)
            return false;
        m_path = QFile::decodeName(::ptsname(m_master));
        if (device.isEmpty())
            return true;
        m_link = qplc::FakeMemory::path(device);
        QDir().mkpath(qplc::FakeMemory::folder());
        QFile::remove(m_link);
        return QFile::link(m_path, m_link);
    }
    void unplug()
    {
        if (m_master >= 0)
            ::close(m_master);
        m_master = -1;
        if (!m_link.isEmpty())
            QFile::remove(m_link);
        m_link.clear();
    }
    /// Of the near end.
    QString path() const { return m_path; }

    /// \return whether all bytes went
    bool send(const QByteArray &bytes)
    {
        return ::write(m_master, bytes.constData(), size_t(bytes.size())) == bytes.size();
    }
    /// What has come, after a wait for the first byte of at most 5 s.
    QByteArray receive()
    {
        pollfd descriptor{m_master, POLLIN, 0};
        char bytes[4096];
        const ssize_t count = ::poll(&descriptor, 1, 5000) > 0 ? ::read(m_master, bytes, sizeof bytes) : 0;
        return QByteArray(bytes, int(qMax<ssize_t>(0, count)));
    }

private:
    int m_master = -1;
    QString m_path;
    QString m_link;
};
