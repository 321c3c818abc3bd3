// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanFrame.h"
#include "realtime/SpscRing.h"

#include <QtCore/QFile>

#include <atomic>
#include <thread>

namespace qplc {

/// Writes frames into a file, in the format of CanLog, by a thread of its own. What it cannot take
/// in time, or cannot write, is left out and counted; without an open file that is everything.
class CanLogWriter
{
public:
    CanLogWriter() = default;
    ~CanLogWriter();
    CanLogWriter(const CanLogWriter &) = delete;
    CanLogWriter &operator=(const CanLogWriter &) = delete;

    /// Goes on at the end of the file. \param interface is named in each line \return false, with
    /// the reason in \a error
    bool open(const QString &fileName, const QString &interface, QString *error);
    /// Writes what is left.
    void close();

    /// Neither waits nor takes memory. One thread at a time.
    void put(const CanFrame &frame) noexcept
    {
        if (!m_thread.joinable() || !m_ring.push(frame))
            m_dropped.fetch_add(1, std::memory_order_relaxed);
    }
    /// Frames that are not in the file.
    quint64 dropped() const { return m_dropped.load(std::memory_order_relaxed); }

private:
    void run();
    void writeAll();

    QFile m_file;
    QString m_interface;
    SpscRing<CanFrame> m_ring{8192};
    std::atomic<quint64> m_dropped{0};
    std::atomic<bool> m_stop{false};
    std::thread m_thread;
};

}  // namespace qplc
