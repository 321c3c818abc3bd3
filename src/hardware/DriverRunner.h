// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDriver.h"
#include "QPlcHardwareNode.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"
#include "realtime/SnapshotBuffer.h"
#include "realtime/TimeSource.h"

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <thread>

namespace qplc {

/// Runs one driver: opens its device again and again until that works, and lets values flow between
/// the cycle and the device, at the pace of the driver.
///
/// Every driver has a thread, which opens its device, writes and reads at its interval, and closes
/// it; a cycle meets copies of the newest values. With EveryCycle the cycle takes an open device
/// for itself with its first write() and calls the driver from then on; leave() gives it back to
/// the thread.
class DriverRunner
{
public:
    /// A device was opened and has answered (\a error is empty), or it cannot be used. Called in
    /// the thread of the driver.
    using Report = std::function<void(const QString &error)>;
    /// Something has happened at the device. In the same thread.
    using EventReport = std::function<void(const QPlcDeviceEvent &event)>;
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
    /// Wires a channel. \return its number among those of its direction; -1, with the reason in \a
    /// error, when there is none of this name
    int wire(const QString &channel, QPlcChannel::Direction direction, QString *error);
    /// Whether the device can take a value. \param writeChannel  its number, of wire() \return an
    /// empty text, or what is wrong and what would be right
    QString problemOf(int writeChannel, double value) const;
    /// Of the channel \a readChannel, and \a writeChannel.
    std::optional<double> tornValue(int readChannel) const;
    std::optional<double> restValue(int writeChannel) const;

    /// The wires are known: values can be set. start() and openNow() do it, too.
    void prepare();
    /// Begins to open the device. What the reports need outlives stop().
    /// \param deliveryReport  gets the reason when the device has not taken its values, and an
    /// empty text when it has
    void start(Report report, EventReport eventReport = {}, Report deliveryReport = {});
    /// Gives the device its safe values and lets it go.
    void stop();
    /// Whether it can bring something into a safe state, or others need it for that.
    bool isNeededForSafety() const { return !m_writeChannels.empty() || m_driver->m_servesOthers; }
    /// Outputs that nobody has given a value.
    QStringList unsetOutputs() const;
    bool isOnline() const { return m_state.load(std::memory_order_acquire) >= Open; }
    /// Whether the device has the values of the driver, as far as that can be known.
    bool isDelivered() const { return isOnline() && m_driver->m_isDelivered.load(std::memory_order_relaxed); }
    quint64 failures() const { return m_failures.load(std::memory_order_relaxed); }

    // ---- in the cycle ----
    // (Or, while none runs, in the thread of the node.) Neither waits nor takes memory.
    void setValue(int writeChannel, double value, bool isSafe) noexcept;
    /// Gives the values that were set to the device.
    void write(qint64 now) noexcept;
    /// As write(), for the last time until the next write(): the thread of the driver goes on with
    /// these values, at once.
    void leave(qint64 now) noexcept;
    void read(qint64 now) noexcept;
    Sample sample(int readChannel, qint64 now) const noexcept;
    /// The newest value of a channel, for people.
    QPlcHardwareNode::Wire wireState(int channel, QPlcChannel::Direction direction, qint64 now) const;

    // ---- without start(): for tests and commissioning; one call after the other ----
    /// Opens the device and exchanges values with it: only what answers is open.
    /// \param now  the time of each of these steps [ns]
    bool openNow(const std::function<qint64()> &now = monotonicNow);
    void closeNow();
    bool readNow(qint64 now);
    bool writeNow(qint64 now);
    /// What has happened at the device, the oldest event first; nothing: no more. Also for the
    /// thread of the driver.
    std::optional<QPlcDeviceEvent> takeEvent();

private:
    /// Closed and Failed: the device belongs to the thread of the driver. Open: to nobody, and who
    /// wants it takes it. The others: to the one they name.
    enum State : int { Closed, Failed, Open, InThread, InCycle };
    /// Channels that every driver has.
    enum class Own : quint8 { No, Online, Age, Failures };
    struct ReadEnd
    {
        QPlcReadChannel *channel = nullptr;  // null: one of its own
        Own own = Own::No;
        friend bool operator==(const ReadEnd &a, const ReadEnd &b) { return a.channel == b.channel && a.own == b.own; }
    };
    struct Order
    {
        enum Kind : quint64 { None, Safe, Computed };
        double value = 0.0;
        Kind kind = None;
    };
    struct Reading
    {
        double value = 0.0;
        qint64 time = QPlcReadChannel::Never;  // [ns]
        qint64 timeout = 0;                    // [ns]; 0: it is fresh for ever
    };

    static QString ownName(Own own);
    template<typename End>
    static int placeOf(std::vector<End> *ends, const End &end);
    void run();
    void setPriority();
    void tell(const QString &error);
    bool tellEvents();
    bool mayTellEvent();
    void tellDelivery();
    void waitFor(std::chrono::nanoseconds time);
    void wake() noexcept;
    void wakeForEvents() noexcept;
    template<typename Code>
    bool attempt(const char *function, Code code) noexcept;
    bool readDevice(qint64 now) noexcept;
    bool writeDevice(qint64 now) noexcept;
    void closeDevice() noexcept;
    void lose() noexcept;
    bool takeForCycle() noexcept;
    bool exchange();
    void give(const std::vector<Order> &orders) noexcept;
    void copyChannels(std::vector<Reading> *readings) const noexcept;
    static void forget(std::vector<Reading> *readings) noexcept;
    void takeOrders();
    void publish();
    double age(qint64 now) const noexcept;

    const QString m_kind;
    std::unique_ptr<QPlcDriver> m_driver;
    std::vector<ReadEnd> m_readChannels;              // that are wired
    std::vector<QPlcWriteChannel *> m_writeChannels;  // that are wired
    std::vector<Order> m_orders;                      // of the cycle
    std::vector<Reading> m_readings;                  // of the cycle
    std::vector<Order> m_newOrders;                   // of the thread of the driver
    std::vector<Reading> m_newReadings;               // of the thread of the driver
    std::unique_ptr<SnapshotBuffer> m_toDevice;
    std::unique_ptr<SnapshotBuffer> m_fromDevice;

    Report m_report;
    EventReport m_eventReport;
    qint64 m_eventsSince = 0;  // begin of this second of events [ns]
    int m_eventsTold = 0;      // in it
    Report m_deliveryReport;
    std::atomic<State> m_state{Closed};
    std::atomic<quint64> m_failures{0};
    std::atomic<bool> m_stop{false};
    int m_priority = 0;  // of the thread: SCHED_FIFO; 0: ordinary
    int m_wakeUp = -1;   // eventfd
    QString m_told;      // last error
    QString m_toldDelivery;
    std::thread m_thread;
};

}  // namespace qplc
