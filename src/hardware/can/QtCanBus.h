// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanBus.h"
#include "realtime/SpscRing.h"
#include "realtime/TimeSource.h"

#include <atomic>
#include <functional>
#include <thread>

class QCanBusDevice;

namespace qplc {

/// A CAN bus behind a plugin of Qt Serial Bus: adapters that the kernel has no driver for.
///
/// The plugin needs an event loop and takes memory: it has a thread of its own, and frames go
/// through rings. They are stamped when the plugin hands them over, which may be later than they
/// came in, by some milliseconds.
///
/// A plugin does not say whether an error passes (a queue is full) or stays (the adapter is gone).
/// The bus is lost when there were only errors for a second, with no frame in between that was
/// written or received.
class QtCanBus : public CanBus
{
public:
    /// \param time  for errors; outlives this object
    QtCanBus(const QString &plugin, const QString &interface, TimeSource &time = TimeSource::monotonic());
    ~QtCanBus() override;

    void close() override;

protected:
    bool join(const Options &options) override;
    int readFrames(CanFrame *frames, int capacity) noexcept override;
    int writeFrames(const CanFrame *frames, int count) noexcept override;

private:
    /// Told once by the thread: connected (no error), or why not.
    using Answer = std::function<void(const QString &error)>;

    void run(const Options &options, const Answer &answer);
    std::unique_ptr<QCanBusDevice> makeDevice(QString *error) const;
    bool configure(QCanBusDevice *device, const Options &options, QString *error) const;
    bool connectDevice(QCanBusDevice *device, QString *error) const;
    void runLoop(QCanBusDevice *device);
    void letGo(QCanBusDevice *device);
    void takeFrames(QCanBusDevice *device);
    void giveFrames(QCanBusDevice *device);
    void lookAtStatus(QCanBusDevice *device);
    void noteError(const QCanBusDevice *device, int error);
    void put(const CanFrame &frame) noexcept;
    QString name() const;
    void wake() noexcept;

    const QString m_plugin;
    const QString m_interface;
    SpscRing<CanFrame> m_incoming{4096};
    SpscRing<CanFrame> m_outgoing{1024};
    std::atomic<quint32> m_lost{0};  // found no room in m_incoming
    quint32 m_lostSeen = 0;
    std::atomic<quint32> m_failed{0};  // were taken from m_outgoing, and not written
    quint32 m_failedSeen = 0;
    std::atomic<int> m_endedBy{0};  // errno of the end of the bus; 0: it goes on
    std::atomic<bool> m_stop{false};
    int m_wakeUp = -1;  // eventfd
    std::thread m_thread;

    // Of the thread.
    TimeSource &m_time;
    qint64 m_firstError = 0;  // of those without a good frame in between [ns]; 0: there was none
    qint64 m_unwritten = 0;   // frames that the device has taken, and not told as written
    bool m_isGiving = false;  // frames to the device
    State m_status = Active;  // as told last
};

}  // namespace qplc
