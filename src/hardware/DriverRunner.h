// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDriver.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"
#include "realtime/SnapshotBuffer.h"

#include <atomic>
#include <functional>
#include <memory>
#include <thread>

namespace qplc {

/// Runs one driver: opens its device again and again until that works, and lets values flow between the cycle and the device, at the pace of the driver.
///
/// A driver with EveryCycle is called by the cycle itself while its device is open; one with OwnPace by a thread of its own, and the cycle meets copies of the newest values.
class DriverRunner
{
public:
    /// A device was opened (\a error is empty) or cannot be used. Called in the thread of the driver.
    using Report = std::function<void(const QString &error)>;
    /// What the cycle sees of a read channel.
    struct Sample
    {
        double value = 0.0;
        qint64 time = 0;  // [ns]
        bool isFresh = false;
    };

    DriverRunner(const QString &name, const QString &kind, std::unique_ptr<QPlcDriver> driver);
    ~DriverRunner();

    QString name() const { return m_driver->name(); }
    QString kind() const { return m_kind; }
    QPlcDriver &driver() { return *m_driver; }

    // ---- before start(), in the thread of the node ----
    void configure(QPlcDriverSettings &settings);
    /// Wires a channel. \return its number among those of its direction; -1, with the reason in \a error, when there is none of this name
    int wire(const QString &channel, QPlcChannel::Direction direction, QString *error);

    /// \param report  outlives this object
    void start(Report report);
    /// Gives the device its safe values and lets it go.
    void stop();
    bool isOnline() const { return m_state.load(std::memory_order_acquire) == Open; }
    quint64 failures() const { return m_failures.load(std::memory_order_relaxed); }

    // ---- in the cycle (or, while none runs, in the thread of the node): neither waits nor takes memory ----
    void setValue(int writeChannel, double value, bool isSafe) noexcept;
    /// Gives the values that were set to the device; OwnPace: wakes its thread if \a isUrgent.
    void write(qint64 now, bool isUrgent = false) noexcept;
    void read(qint64 now) noexcept;
    Sample sample(int readChannel, qint64 now) const noexcept;

    // ---- without start(): for tests and commissioning; one call after the other ----
    bool openNow();
    void closeNow();
    bool readNow(qint64 now);
    bool writeNow(qint64 now);

private:
    enum State : int { Closed, Open, Failed };

    void run();
    void attemptToOpen();
    void exchange();
    void waitFor(std::chrono::nanoseconds time);
    void takeOrders();
    void publish();
    void letGo();

    const QString m_kind;
    std::unique_ptr<QPlcDriver> m_driver;
    std::vector<QPlcReadChannel *> m_readChannels;    // that are wired
    std::vector<QPlcWriteChannel *> m_writeChannels;  // that are wired

    struct Order
    {
        double value = 0.0;
        quint64 flags = 0;
    };
    struct Reading
    {
        double value = 0.0;
        qint64 time = 0;
        qint64 timeout = 0;
    };
    std::vector<Order> m_orders;      // of the cycle
    std::vector<Reading> m_readings;  // of the cycle

    // between the cycle and a driver with OwnPace
    std::unique_ptr<SnapshotBuffer> m_toDevice;
    std::unique_ptr<SnapshotBuffer> m_fromDevice;

    Report m_report;
    std::atomic<State> m_state{Closed};
    std::atomic<quint64> m_failures{0};
    std::atomic<bool> m_isUrgent{false};
    std::atomic<bool> m_stop{false};
    int m_wakeUp = -1;  // eventfd
    std::thread m_thread;
};

}  // namespace qplc
