// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcChannel.h"

#include <QtCore/QStringList>

#include <array>
#include <chrono>
#include <vector>

class QPlcDriverSettings;
class QPlcReadChannel;

namespace qplc {
class DriverRunner;
}

/// What knows one kind of device or bus: opens it, reads values from it and writes values to it. A QPlcHardwareNode runs it.
///
/// ```cpp
/// class WindVane : public QPlcDriver
/// {
/// public:
///     WindVane() : QPlcDriver(OwnPace) {}
/// private:
///     QPlcReadChannel m_angle{this, "angle"};  // [rad]
///     void configure(QPlcDriverSettings &settings) override { m_device = settings.requiredText("device", "/dev/vane0"); }
///     bool open() override { return m_vane.open(m_device) || fail(m_vane.errorString()); }
///     void close() override { m_vane.close(); }
///     bool read() override
///     {
///         double angle = 0.0;
///         if (!m_vane.read(&angle))
///             return fail(m_vane.errorString());
///         m_angle.set(angle);
///         return true;
///     }
///     ...
/// };
/// ```
///
/// The node calls configure(), then channel() for each name in its configuration, open(), write() and read() until all three succeed (with growing pauses of 0.1 ... 5 s), then write() and
/// read() in turn, and close() when one of them has failed or the node ends. No two functions run at the same time. A function of these four that throws has failed: what() is its error.
///
/// Threads: configure() and channel() in that of the node; open() and close() in a thread of the driver, where they may take their time; read() and write() in that one, too (OwnPace, and
/// EveryCycle while no cycles run), or in the cycle thread (EveryCycle, from the first cycle of a phase to its safe state).
class QTPLC_HARDWARE_EXPORT QPlcDriver
{
public:
    enum Pace : quint8 {
        EveryCycle,  ///< read() and write() are part of each cycle: short, without waiting, without taking memory; every interval() while no cycles run
        OwnPace  ///< they are called every interval() and may wait for the device; the cycle takes the newest values and never waits
    };

    explicit QPlcDriver(Pace pace);
    virtual ~QPlcDriver();
    QPlcDriver(const QPlcDriver &) = delete;
    QPlcDriver &operator=(const QPlcDriver &) = delete;

    Pace pace() const { return m_pace; }
    /// Name of its section in the configuration.
    QString name() const { return m_name; }
    /// Time between two calls of read() by the thread of the driver: 10 ms; OwnPace: key `interval`.
    std::chrono::nanoseconds interval() const { return m_interval; }
    /// How long what is read is fresh: key `timeout`; unless given it is three intervals, and 100 ms for EveryCycle.
    std::chrono::nanoseconds timeout() const { return m_timeout; }

    /// What went wrong last: device, value, remedy.
    QString errorString() const;

protected:
    /// Takes the keys of the driver out of its section; `driver`, `interval` and `timeout` are read before. What is wrong is told to \a settings.
    virtual void configure(QPlcDriverSettings &settings) = 0;
    /// The channel that the configuration calls \a name. The default looks among those that exist; a driver whose channels depend on its settings may make one.
    /// \return null when there is none; \a error may say why, else close names are shown
    virtual QPlcChannel *channel(const QString &name, QPlcChannel::Direction direction, QString *error);
    /// Names of all channels that there could be, for messages and lists.
    virtual QStringList channelNames(QPlcChannel::Direction direction) const;

    /// Takes the device. Returns within a few seconds. \return false after fail()
    virtual bool open() = 0;
    /// Lets the device go. Called after each open() that succeeded.
    virtual void close() = 0;
    /// Takes new values from the device and sets the read channels that it has values for. \return false after fail(): the device is lost, and opened anew
    virtual bool read() { return true; }
    /// Gives the values of the write channels to the device. The last call before close() has the safe values. \return false after fail()
    virtual bool write() { return true; }

    /// What is to be done about an error of the operating system; the default knows the usual ones: no such device, no permission, busy, gone.
    virtual QString remedy(int errorNumber) const;
    /// Sets errorString(). Not on the cycle thread. \return false
    bool fail(const QString &text);
    /// As above, allowed in a cycle. \param operation  text that stays, "send to can0" for example \param errorNumber  errno
    bool fail(const char *operation, int errorNumber) noexcept;

    /// Monotonic time [ns]. EveryCycle: when read() or write() was called.
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
    qint64 m_now = 0;  // [ns]
    QString m_errorText;
    const char *m_operation = nullptr;  // that failed in a cycle; null: m_errorText says it
    int m_errorNumber = 0;
};
