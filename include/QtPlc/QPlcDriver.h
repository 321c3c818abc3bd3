// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcChannel.h"
#include "QPlcDeviceEvent.h"

#include <QtCore/QStringList>

#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <vector>

class QPlcDriverSettings;
class QPlcReadChannel;

namespace qplc {
class DriverRunner;
struct NotedEvents;
}  // namespace qplc

/// Base of drivers. A driver opens one kind of device or bus, reads values from it and writes
/// values to it. A QPlcHardwareNode runs it.
///
/// \code
/// class WindVane : public QPlcDriver
/// {
/// public:
///     WindVane() : QPlcDriver(OwnPace) {}
///
/// private:
///     QPlcReadChannel m_angle{this, "angle"};  // [rad]
///     QFile m_file;
///     void configure(QPlcDriverSettings &settings) override
///     {
///         m_file.setFileName(settings.requiredText("device", "/dev/vane0"));
///     }
///     bool open() override
///     {
///         return m_file.open(QIODevice::ReadOnly) || fail(m_file.errorString());
///     }
///     void close() override { m_file.close(); }
///     bool read() override
///     {
///         bool ok = false;
///         const double angle = m_file.readLine().trimmed().toDouble(&ok);
///         if (!ok)
///             return fail("the vane sent no number; look at its cable");
///         m_angle.set(angle);
///         return true;
///     }
/// };
/// \endcode
///
/// The node calls configure(), then channel() for each name in its configuration. After that it
/// calls open(), write() and read() until all three succeed, with growing pauses of 0.1 s to 5 s.
/// Then it calls write() and read() in turn, and close() when one of them has failed or the node
/// ends. No two functions run at the same time. An exception from open(), close(), read() or
/// write() is a failure, and its what() is the error. docs/howto/write-a-driver.md shows a driver
/// step by step.
///
/// \threadsafe no: the node calls configure() and channel() in its own thread. It calls open() and
///     close() in a thread of the driver, where they may take their time. read() and write() are
///     called in that thread, too, or with EveryCycle in the cycle thread, from the first cycle of
///     a phase to its safe state
///
/// \ingroup hardware
class QTPLC_HARDWARE_EXPORT QPlcDriver
{
public:
    /// When read() and write() are called.
    enum Pace : quint8 {
        /// In each cycle: they have to be short and must neither wait nor allocate. While no cycles
        /// run, they are called every interval().
        EveryCycle,
        /// Every interval(), in a thread of the driver: they may wait for the device. A cycle uses
        /// the newest values and never waits.
        OwnPace
    };

    /// Makes a driver that calls read() and write() at \a pace.
    explicit QPlcDriver(Pace pace);
    /// Destroys the driver; the node has called close() before.
    virtual ~QPlcDriver();
    QPlcDriver(const QPlcDriver &) = delete;
    QPlcDriver &operator=(const QPlcDriver &) = delete;

    /// Returns when read() and write() are called.
    Pace pace() const { return m_pace; }
    /// Returns the name of its section in the configuration; empty before configure().
    QString name() const { return m_name; }
    /// Returns the time between two calls of read() by the thread of the driver: 10 ms; for OwnPace
    /// the key `interval`, 100 us to 24 h.
    std::chrono::nanoseconds interval() const { return m_interval; }
    /// Returns for how long a value is fresh: the key `timeout`, 1 ms to 24 h. Default three
    /// intervals for OwnPace, 100 ms for EveryCycle.
    std::chrono::nanoseconds timeout() const { return m_timeout; }

    /// Returns the last error: device, value, remedy.
    QString errorString() const;

protected:
    /// Reads the keys of the driver from its section. Wrong values are reported to \a settings, not
    /// here. The keys `driver`, `interval` and `timeout` belong to the node.
    virtual void configure(QPlcDriverSettings &settings) = 0;
    /// Returns the channel with a name of the configuration. The default looks among the channels
    /// that exist. A driver whose channels depend on its settings may make one here.
    /// \param error  gets the reason for a null result; empty: the node lists close names
    /// \return null if there is no such channel. The driver owns its channels
    virtual QPlcChannel *channel(const QString &name, QPlcChannel::Direction direction, QString *error);
    /// Returns the names of all channels that are possible, for messages and lists. The default
    /// returns those that exist.
    virtual QStringList channelNames(QPlcChannel::Direction direction) const;

    /// Returns true when the node is closing the device: an open() that waits should return false.
    /// \threadsafe yes
    bool isClosing() const { return m_isClosing.load(std::memory_order_relaxed); }
    /// Opens the device. It has to return within a few seconds.
    /// \return false after fail(): the node tries again
    virtual bool open() = 0;
    /// Closes the device. Called after each open() that has succeeded.
    virtual void close() = 0;
    /// Reads new values from the device and sets the read channels that have one. The default does
    /// nothing.
    /// \return false after fail(): the device counts as lost, and the node opens it again
    virtual bool read() { return true; }
    /// Writes the values of the write channels to the device. In the last call before close() they
    /// are the safe values. The default does nothing.
    /// \return false after fail(): the device counts as lost, and the node opens it again
    virtual bool write() { return true; }

    /// Tells whether the device has taken the values of write(). The default is true: write()
    /// returns when it has. A driver of a bus that confirms frames later calls this in open(), with
    /// false, and in each read() or write(). QPlcHardwareNode::makeSafe() waits for it.
    void setDelivered(bool isDelivered) { m_isDelivered.store(isDelivered, std::memory_order_relaxed); }
    /// Returns why the device has not taken the values of write(), and what to do; after
    /// setDelivered(false). For the report of QPlcHardwareNode::makeSafe(), in the thread of the
    /// driver. The default says that the device has not confirmed them.
    virtual QString undeliveredText() const;
    /// Tells in configure() that outputs of other devices need this one, for example because it
    /// sends the clock of their bus: QPlcHardwareNode::makeSafe() opens it, too.
    void setServesOthers() { m_servesOthers = true; }

    /// Notes that something has happened at the device, for the event log of the plant. It neither
    /// waits nor allocates: call it in open(), read() or write(), also in the cycle. The node calls
    /// describeEvent() for it, and tells the result to the master (QPlcSlaveNode::reportEvent()).
    /// \param data  numbers of the device that describeEvent() understands
    /// \return false when too many events wait (64): note the newest state of the device later
    bool noteEvent(quint64 data) noexcept;
    /// Returns what a number of noteEvent() means. The node calls it in a thread of the driver,
    /// also while read() and write() run in the cycle: use only what configure() has set. The
    /// default returns the number.
    virtual QPlcDeviceEvent describeEvent(quint64 data) const;

    /// Returns what to do about an error of the operating system, for errorString(). The default
    /// knows the usual ones: no such device, no permission, busy, no answer. Empty: nothing is
    /// known.
    /// \param errorNumber  errno
    virtual QString remedy(int errorNumber) const;
    /// Sets errorString(). It allocates: do not call it on the cycle thread.
    /// \param text  device, value, and what to do
    /// \return false, for `return fail(...)`
    bool fail(const QString &text);
    /// Sets errorString() without allocating: also for the cycle thread.
    /// \param operation  a text that stays, for example "send to can0"
    /// \param errorNumber  errno
    /// \return false, for `return fail(...)`
    bool fail(const char *operation, int errorNumber) noexcept;

    /// Returns the monotonic time at which the current call of open(), read() or write() began
    /// [ns].
    qint64 now() const { return m_now; }

private:
    friend class QPlcChannel;
    friend class QPlcReadChannel;
    friend class qplc::DriverRunner;

    const Pace m_pace;
    QString m_name;
    std::chrono::nanoseconds m_interval;
    std::chrono::nanoseconds m_timeout;
    std::vector<QPlcChannel *> m_channels;
    const std::unique_ptr<qplc::NotedEvents> m_events;
    qint64 m_now = 0;  // [ns]
    std::atomic<bool> m_isDelivered{true};
    std::atomic<bool> m_isClosing{false};
    bool m_servesOthers = false;
    QString m_errorText;
    const char *m_operation = nullptr;  // that failed in a cycle; null: m_errorText says it
    int m_errorNumber = 0;
};
