// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanFrame.h"

#include <QtCore/QString>

#include <memory>
#include <vector>

namespace qplc {

/// A participant of a CAN bus. Which bus, and by whom it is reached, is said by the text of the
/// device:
///
///   can0                     interface of the kernel (SocketCAN)
///   qtcan:PLUGIN:INTERFACE   plugin of Qt Serial Bus
///   fake:NAME                a bus of this computer alone, without kernel and
///                            hardware, for tests and for devices that are programs
///
/// receive() and send() neither wait nor take memory. Frames of one sender arrive in the order in
/// which they were sent; a participant does not hear itself. Threads: one at a time.
///
/// A controller repeats a frame until another participant acknowledges it, and frames behind it
/// wait in the queue of the kernel. After an outage they would reach the bus with values of the
/// past. So a bus that confirms frames holds back: it takes no frame while one that it took
/// earlier is unconfirmed. The sender then offers its newest values again.
class CanBus
{
public:
    enum State : quint8 {
        Active,   ///< all is well
        Warning,  ///< many errors on the bus
        Passive,  ///< so many that the controller does not disturb others any more
        BusOff    ///< so many that the controller has left the bus; nothing is received or sent until it is restarted
    };

    struct Options
    {
        std::vector<quint32> keys;      ///< of the messages that are received (CanFrame::key())
        std::vector<quint32> groups;    ///< parameter groups of J1939 that are received (CanFrame::groupOf())
        std::vector<quint32> sentKeys;  ///< of messages that are sent: the bus holds back; empty: it never does
        bool receivesAll = false;       ///< all frames of the bus
        bool needsFd = false;           ///< frames of CAN FD are sent or received
        int bitRate = 0;                ///< [bit/s]; 0: that of the plugin; of qtcan only (setsBitRate())
        int dataBitRate = 0;            ///< likewise, of the data of CAN FD
    };

    struct Counters
    {
        quint64 received = 0;     ///< frames, without error frames
        quint64 sent = 0;         ///< frames that the bus has taken
        quint64 lost = 0;         ///< frames that came in and found no room
        quint64 unsent = 0;       ///< frames that the bus has not taken, or not sent
        quint64 failed = 0;       ///< those of them that it had taken
        quint64 errorFrames = 0;  ///< what the controller told of errors
        quint64 busOffs = 0;      ///< how often the controller has left the bus
    };

    /// \return null, with the reason in \a error, for a text that names no bus
    static std::unique_ptr<CanBus> make(const QString &device, QString *error);
    /// Whether a bus of this name sets the bit rate itself.
    static bool setsBitRate(const QString &device);

    CanBus() = default;
    virtual ~CanBus() = default;
    CanBus(const CanBus &) = delete;
    CanBus &operator=(const CanBus &) = delete;

    /// Joins the bus. Counters go on. \return false, with the reason in errorString()
    bool open(const Options &options);
    virtual void close() = 0;

    /// Takes what has come in, the oldest first, error frames of the own controller among them.
    /// \return number of frames; -1 when the bus is lost: errorNumber()
    int receive(CanFrame *frames, int capacity) noexcept;
    /// Gives frames to the bus, in this order. With Options::sentKeys, a bus that confirms frames
    /// takes none while one that it took before the last receive() is unconfirmed.
    /// \param now  CLOCK_MONOTONIC [ns], for frames that are never confirmed because a kernel or an
    /// adapter has dropped them; 0: wait for them without end
    /// \return how many it has taken, the others are not sent; -1 when the bus is lost:
    /// errorNumber()
    int send(const CanFrame *frames, int count, qint64 now = 0) noexcept;
    /// Frames that the bus has taken and that nobody has acknowledged yet.
    int unconfirmed() const { return m_unconfirmed; }

    /// For poll(): readable when there is something to receive; -1: the bus has none.
    virtual int descriptor() const { return -1; }

    State state() const { return m_state; }
    const Counters &counters() const { return m_counters; }
    QString errorString() const { return m_error; }
    int errorNumber() const { return m_errorNumber; }

protected:
    virtual bool join(const Options &options) = 0;
    virtual int readFrames(CanFrame *frames, int capacity) noexcept = 0;
    virtual int writeFrames(const CanFrame *frames, int count) noexcept = 0;
    /// Whether taken frames wait for the controller, in a queue in front of it.
    virtual bool hasQueue() const noexcept { return false; }

    /// \return false
    bool fail(const QString &error);
    /// \return -1
    int lose(int errorNumber) noexcept;
    /// \a count frames have come in and found no room.
    void countLost(quint64 count) noexcept { m_counters.lost += count; }
    /// \a count frames that were taken could not be sent.
    void countFailed(quint64 count) noexcept;
    /// In join(): the bus tells by confirm() which frames have reached it.
    void expectConfirmations() { m_confirms = true; }
    /// The oldest \a count frames that were taken have reached the bus.
    void confirm(int count) noexcept;
    /// Frames that are unconfirmed will not be confirmed any more.
    void giveUpUnconfirmed() noexcept;
    /// In join(): what the controller was before.
    void setState(State state) { m_state = state; }
    /// Whether the options let a frame in: for a bus that does not look itself.
    bool accepts(const CanFrame &frame) const noexcept;

private:
    void noteError(const CanFrame &frame) noexcept;
    bool holdsBack(qint64 now) noexcept;

    Options m_options;
    Counters m_counters;
    State m_state = Active;
    QString m_error;
    int m_errorNumber = 0;

    bool m_confirms = false;
    int m_unconfirmed = 0;
    int m_overdue = 0;     // those of them that were taken before the last receive()
    qint64 m_takenAt = 0;  // the first of them [ns]
};

/// \return null: no interface of the kernel can have this name
std::unique_ptr<CanBus> createSocketCanBus(const QString &interface);

}  // namespace qplc
