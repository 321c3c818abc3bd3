// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanBus.h"
#include "realtime/SpscRing.h"

#include <atomic>
#include <functional>
#include <thread>

class QCanBusDevice;

namespace qplc {

/// A CAN bus behind a plugin of Qt Serial Bus: adapters that the kernel has no driver for.
///
/// The plugin needs an event loop and takes memory: it has a thread of its own, and frames go through rings. They are stamped when the plugin hands them over, which may be
/// later than they came in, by some milliseconds.
class QtCanBus : public CanBus
{
public:
    QtCanBus(const QString &plugin, const QString &interface);
    ~QtCanBus() override;

    void close() override;

protected:
    bool join(const Options &options) override;
    int take(CanFrame *frames, int capacity) noexcept override;
    int give(const CanFrame *frames, int count) noexcept override;

private:
    /// Told once by the thread: connected (no error), or why not.
    using Answer = std::function<void(const QString &error)>;

    void run(bool needsFd, const Answer &answer);
    bool connectDevice(QCanBusDevice *device, QString *error) const;
    void runLoop(QCanBusDevice *device);
    void takeFrames(QCanBusDevice *device);
    void giveFrames(QCanBusDevice *device);
    void wake() noexcept;

    const QString m_plugin;
    const QString m_interface;
    SpscRing<CanFrame> m_incoming{4096};
    SpscRing<CanFrame> m_outgoing{1024};
    std::atomic<quint32> m_lost{0};  // found no room in m_incoming
    quint32 m_lostSeen = 0;
    std::atomic<bool> m_isGone{false};  // the plugin has lost its device
    std::atomic<bool> m_stop{false};
    int m_wakeUp = -1;  // eventfd
    std::thread m_thread;
};

}  // namespace qplc
