// SPDX-License-Identifier: Apache-2.0
#include "CanLogWriter.h"

#include "CanLog.h"
#include "realtime/TimeSource.h"

namespace qplc {

namespace {

constexpr qint64 canLogPause = 20'000'000;  // [ns] between two looks at the ring

}  // namespace

CanLogWriter::~CanLogWriter()
{
    close();
}

bool CanLogWriter::open(const QString &fileName, const QString &interface, QString *error)
{
    close();
    m_interface = interface;
    m_file.setFileName(fileName);
    if (!m_file.open(QIODevice::WriteOnly | QIODevice::Append)) {
        *error = QStringLiteral("cannot write the log %1: %2; correct the key log").arg(fileName, m_file.errorString());
        return false;
    }
    m_stop = false;
    m_thread = std::thread([this] { run(); });
    return true;
}

void CanLogWriter::close()
{
    if (!m_thread.joinable())
        return;
    m_stop = true;
    m_thread.join();
    m_file.close();
}

void CanLogWriter::run()
{
    TimeSource &clock = TimeSource::monotonic();
    while (!m_stop.load(std::memory_order_acquire)) {
        writeAll();
        clock.sleepUntil(clock.now() + canLogPause);
    }
    writeAll();
}

void CanLogWriter::writeAll()
{
    const qint64 offset = wallClockNow() - monotonicNow();
    CanLogLine line;
    line.interface = m_interface;
    while (m_ring.pop(&line.frame)) {
        line.time = line.frame.time + offset;
        const QByteArray text = CanLog::text(line);
        if (m_file.write(text) != text.size())
            m_dropped.fetch_add(1, std::memory_order_relaxed);
    }
    if (!m_file.flush())
        m_dropped.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace qplc
