// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDriver.h"
#include "QPlcDriverSettings.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"

#include <atomic>
#include <cerrno>
#include <memory>
#include <sched.h>
#include <stdexcept>
#include <thread>

/// The device behind a BenchDriver, as the test holds it: it can be unplugged, break, and be
/// silent.
struct BenchDevice
{
    std::atomic<bool> isPlugged{true};
    std::atomic<bool> isBroken{false};       // each exchange fails
    std::atomic<const char *> throwing{""};  // function whose code throws
    std::atomic<bool> isSilent{false};       // nothing new is measured
    std::atomic<int> silentReads{0};         // so many reads find nothing
    std::atomic<bool> isFull{false};         // it takes no values, as a bus without a partner
    std::atomic<bool> isHeld{false};         // write() does not return
    std::atomic<double> speed{0.0};
    std::atomic<double> torque{-1.0};  // as written last
    std::atomic<double> brake{-1.0};
    std::atomic<bool> torqueWasSafe{false};
    std::atomic<int> opened{0};
    std::atomic<int> closed{0};
    std::atomic<int> reads{0};
    std::atomic<int> priority{-1};  // of the thread that reads; 0: ordinary
    std::atomic<int> writes{0};
    std::atomic<double> torqueAtClose{-1.0};
    std::atomic<quint64> event{0};        // that the next read finds: 1: hot, 2: cold, more: others; 0: none
    std::atomic<bool> isFlooding{false};  // each read finds an event
    std::atomic<bool> isSlow{false};      // a call takes its time
    std::atomic<bool> isVisited{false};
    std::atomic<bool> hasMet{false};  // two threads have called the driver at a time
};

/// A driver whose device is a piece of memory of the test.
class BenchDriver : public QPlcDriver
{
public:
    BenchDriver(std::shared_ptr<BenchDevice> device, Pace pace)
        : QPlcDriver(pace)
        , m_device(std::move(device))
    {
    }

private:
    struct Visit
    {
        explicit Visit(BenchDevice *visited)
            : device(visited)
        {
            if (device->isVisited.exchange(true))
                device->hasMet = true;
            if (device->isSlow)
                std::this_thread::sleep_for(std::chrono::microseconds(1));
        }
        ~Visit() { device->isVisited = false; }
        BenchDevice *const device;
    };

    void configure(QPlcDriverSettings &settings) override
    {
        m_port = settings.requiredText(QStringLiteral("device"), QStringLiteral("bench0"));
        m_gain = settings.number(QStringLiteral("gain"), 1.0, 0.0, 100.0);
    }
    bool open() override
    {
        const Visit visit(m_device.get());
        throwIf("open");
        if (!m_device->isPlugged)
            return fail(QStringLiteral("there is no device '%1'; plug it in").arg(m_port));
        ++m_device->opened;
        return true;
    }
    void close() override
    {
        const Visit visit(m_device.get());
        throwIf("close");
        ++m_device->closed;
        m_device->torqueAtClose = m_device->torque.load();
    }
    bool read() override
    {
        const Visit visit(m_device.get());
        ++m_device->reads;
        sched_param parameters{};
        m_device->priority = sched_getscheduler(0) == SCHED_OTHER || sched_getparam(0, &parameters) != 0
            ? 0
            : parameters.sched_priority;
        throwIf("read");
        if (m_device->isBroken)
            return fail("read from the bench", EIO);
        if (const quint64 event = m_device->event.exchange(0))
            noteEvent(event);
        if (m_device->isFlooding)
            noteEvent(quint64(m_device->reads));
        if (!m_device->isSilent && m_device->reads > m_device->silentReads)
            m_speed.set(m_gain * m_device->speed);
        return true;
    }
    bool write() override
    {
        const Visit visit(m_device.get());
        ++m_device->writes;
        throwIf("write");
        while (m_device->isHeld)
            std::this_thread::yield();
        if (m_device->isFull)
            return true;
        if (m_torque.hasValue()) {
            m_device->torqueWasSafe = m_torque.isSafe();
            m_device->torque = m_torque.value();
        }
        if (m_brake.hasValue())
            m_device->brake = m_brake.isOn() ? 1.0 : 0.0;
        return true;
    }

    QPlcDeviceEvent describeEvent(quint64 data) const override
    {
        if (data > 2)
            return QPlcDriver::describeEvent(data);
        QPlcDeviceEvent event;
        event.severity = data == 1 ? QPlcSlaveNode::WarningEvent : QPlcSlaveNode::InfoEvent;
        event.text = data == 1 ? QStringLiteral("the motor is hot") : QStringLiteral("the motor is cold");
        event.alarm = QStringLiteral("motor");
        event.isActive = data == 1;
        return event;
    }
    void throwIf(const char *function) const
    {
        if (qstrcmp(m_device->throwing, function) == 0)
            throw std::runtime_error("the wire is too thin");
    }

    std::shared_ptr<BenchDevice> m_device;
    QString m_port;
    double m_gain = 1.0;
    QPlcReadChannel m_speed{this, QStringLiteral("speed")};
    QPlcWriteChannel m_torque{this, QStringLiteral("torque")};
    QPlcWriteChannel m_brake{this, QStringLiteral("brake")};
};
