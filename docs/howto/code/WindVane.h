// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcHardware>

#include <QtCore/QFile>

#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

/// A wind vane on a serial line: it says its angle in degrees ten times a second, a number and a
/// line feed.
class WindVane : public QPlcDriver
{
public:
    WindVane()
        : QPlcDriver(OwnPace)
    {
    }

private:
    QPlcReadChannel m_angle{this, QStringLiteral("angle")};  // [deg], 0 ... 360
    QPlcReadChannel m_lines{this, QStringLiteral("lines")};  // that could be read since the line was opened

    void configure(QPlcDriverSettings &settings) override
    {
        m_device = settings.requiredText(QStringLiteral("device"), QStringLiteral("/dev/ttyUSB0"));
    }

    bool open() override
    {
        m_line = ::open(QFile::encodeName(m_device).constData(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
        if (m_line < 0)
            return fail("open the line of the vane", errno);  // with what can be done about this error
        termios mode = {};
        if (::tcgetattr(m_line, &mode) < 0) {
            close();
            return fail(QStringLiteral("%1 is not a serial line; name one, for example /dev/ttyUSB0").arg(m_device));
        }
        ::cfmakeraw(&mode);
        ::cfsetspeed(&mode, B9600);
        ::tcsetattr(m_line, TCSANOW, &mode);
        m_text.clear();
        m_count = 0;
        return true;
    }

    void close() override
    {
        ::close(m_line);
        m_line = -1;
    }

    // Its own thread calls it: it may wait for the device, though not for long, because close()
    // waits for it.
    bool read() override
    {
        pollfd line = {m_line, POLLIN, 0};
        if (::poll(&line, 1, 100) <= 0)
            return true;  // no new data: the last value becomes stale after its timeout
        char bytes[64];
        const ssize_t size = ::read(m_line, bytes, sizeof bytes);
        if (size < 0 && errno == EAGAIN)
            return true;
        if (size <= 0)
            return fail("read from the vane", size < 0 ? errno : EIO);
        m_text.append(bytes, int(size));
        for (int end = 0; (end = m_text.indexOf('\n')) >= 0; m_text.remove(0, end + 1))
            handle(m_text.left(end));
        m_text.truncate(64);  // a line without an end is nonsense
        return true;
    }

    void handle(const QByteArray &line)
    {
        bool isNumber = false;
        const double angle = line.trimmed().toDouble(&isNumber);
        if (!isNumber || !(angle >= 0.0 && angle <= 360.0))
            return;  // a disturbed line is left out
        m_angle.set(angle);
        m_lines.set(++m_count);
    }

    QString m_device;
    int m_line = -1;
    QByteArray m_text;
    int m_count = 0;
};
