// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanOpenPeer.h"
#include "DriverBench.h"
#include "FakeDevices.h"

#include <memory>
#include <vector>

/// Drivers of kind canopen on benches, and the devices of their bus, all on the clock of the
/// benches.
///
/// While the drivers are opened, which waits for answers, the devices live in a thread; then they
/// take turns with the drivers.
class CanOpenBench
{
public:
    CanOpenBench()
        : bus(QStringLiteral("bench"), m_clock)
    {
    }

    /// A driver; its section has the keys \a keys besides the bus.
    DriverBench &addDriver(const QByteArray &keys)
    {
        drivers.push_back(std::make_unique<DriverBench>("canopen", "device = fake:bench\n" + keys,
                                                        m_devices.path(QStringLiteral("bench.ini"))));
        return *drivers.back();
    }
    QString filePath(const QString &name) const { return m_devices.path(name); }

    /// \return what is wrong; empty: all are open
    QString open()
    {
        if (!bus.open())
            return QStringLiteral("no bus");
        // While one driver waits for answers, nobody calls the others, the masters of other
        // devices.
        for (const auto &device : bus.devices)
            device->watchMaster(false);
        bus.start();
        QString error;
        for (const auto &driver : drivers) {
            if (!driver->errors().isEmpty())
                error += driver->errors();
            else if (!driver->open())
                error += driver->errorString();
        }
        bus.stop();
        m_clock.time = qplc::monotonicNow();
        m_clock.isVirtual = true;
        // What has come in meanwhile is taken, before the drivers, too, know how late it is.
        for (int i = 0; i < 50 && error.isEmpty(); ++i) {
            for (const auto &driver : drivers)
                driver->exchange();
            bus.process();
        }
        for (const auto &driver : drivers)
            driver->advance(std::chrono::nanoseconds(m_clock.time - driver->now()));
        for (const auto &device : bus.devices)
            device->watchMaster(true);
        return error;
    }
    /// One cycle of all drivers, then the devices. \return whether all are still open
    bool cycle(std::chrono::nanoseconds time = std::chrono::milliseconds(1))
    {
        bool isOnline = true;
        m_clock.time += time.count();
        for (const auto &driver : drivers) {
            driver->advance(time);
            isOnline = driver->exchange() && isOnline;
        }
        bus.process();
        return isOnline;
    }
    /// As many cycles of a millisecond. \return whether all are still open
    bool cycles(int count)
    {
        for (int i = 0; i < count; ++i) {
            if (!cycle())
                return false;
        }
        return true;
    }

    /// Only the devices go on: nobody commands them.
    void passTime(std::chrono::nanoseconds time)
    {
        m_clock.time += time.count();
        bus.process();
    }

private:
    /// That of the machine until the drivers are open, then that of the benches.
    class Clock : public qplc::TimeSource
    {
    public:
        std::int64_t now() noexcept override { return isVirtual ? time : qplc::monotonicNow(); }
        bool sleepUntil(std::int64_t) noexcept override { return true; }
        std::int64_t time = 0;
        bool isVirtual = false;
    };

    const FakeDevices m_devices;
    Clock m_clock;

public:
    std::vector<std::unique_ptr<DriverBench>> drivers;
    peer::Bus bus;
};
