// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DriverBench.h"
#include "FakeDevices.h"
#include "hardware/can/FakeCanBus.h"

#include <vector>

/// A CAN driver on a bench, and a partner on the same bus, whose clock is that of the bench.
class CanBench
{
public:
    /// \param keys  of the driver, without the device
    /// \param files  name and content, beside the configuration
    explicit CanBench(const QByteArray &keys, const QVector<QPair<QString, QByteArray>> &files = {})
        : m_hasFiles(writeFiles(files))
        , driver("can", "device = fake:bench\n" + keys, m_devices.path(QStringLiteral("bench.ini")))
        , m_clock(driver)
        , m_partner(QStringLiteral("bench"), m_clock)
    {
    }

    /// A file beside the configuration.
    QString filePath(const QString &name) const { return m_devices.path(name); }

    /// Both join the bus.
    bool open()
    {
        qplc::CanBus::Options options;
        options.receivesAll = true;
        return m_partner.open(options) && driver.open();
    }

    /// A frame of the partner.
    void send(quint32 id, const QByteArray &hex, quint8 flags = 0)
    {
        qplc::CanFrame frame;
        const QByteArray data = QByteArray::fromHex(hex);
        frame.id = id;
        frame.flags = flags;
        frame.size = quint8(data.size());
        std::copy(data.begin(), data.end(), frame.data.begin());
        m_partner.send(&frame, 1);
    }
    /// What the partner has received since the last call, as text: "123#0102 124#".
    QByteArray received()
    {
        QByteArray text;
        qplc::CanFrame frame;
        while (m_partner.receive(&frame, 1) == 1) {
            const QByteArray data(reinterpret_cast<const char *>(frame.data.data()), frame.size);
            text += (text.isEmpty() ? "" : " ") + QByteArray::number(frame.id, 16) + '#' + data.toHex();
        }
        return text;
    }
    /// A cycle, \a time after the one before.
    bool cycle(std::chrono::nanoseconds time = std::chrono::milliseconds(1))
    {
        driver.advance(time);
        return driver.exchange();
    }
    /// As many cycles of a millisecond; \return number of frames that the partner got in them
    int framesIn(int cycles)
    {
        int count = 0;
        for (int i = 0; i < cycles; ++i) {
            cycle();
            const QByteArray text = received();
            count += text.isEmpty() ? 0 : text.count(' ') + 1;
        }
        return count;
    }
    qplc::CanBus &partner() { return m_partner; }

private:
    class Clock : public qplc::TimeSource
    {
    public:
        explicit Clock(const DriverBench &bench)
            : m_bench(bench)
        {
        }
        std::int64_t now() noexcept override { return m_bench.now(); }
        bool sleepUntil(std::int64_t) noexcept override { return true; }

    private:
        const DriverBench &m_bench;
    };

    bool writeFiles(const QVector<QPair<QString, QByteArray>> &files) const
    {
        for (const auto &one : files) {
            QFile file(filePath(one.first));
            if (!file.open(QIODevice::WriteOnly) || file.write(one.second) != one.second.size())
                qFatal("cannot write %s", qPrintable(file.fileName()));
        }
        return true;
    }

    const FakeDevices m_devices;
    const bool m_hasFiles;  // before the driver reads them

public:
    DriverBench driver;

private:
    Clock m_clock;
    qplc::FakeCanBus m_partner;
};
