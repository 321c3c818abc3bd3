// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanBus.h"
#include "CanConfiguration.h"
#include "CanLogWriter.h"
#include "CanReceiver.h"
#include "CanSender.h"
#include "QPlcDriver.h"

#include <array>
#include <memory>
#include <vector>

namespace qplc {

/// Messages of a CAN bus; kind `can`, part of each cycle.
///
/// ```ini
/// [drive]
/// driver = can
/// device = can0                         ; or qtcan:PLUGIN:INTERFACE, or fake:NAME (CanBus)
/// bitrate = 500000                      ; [bit/s] of qtcan only; data-bitrate: data of CAN FD
/// dbc = winch_drive.dbc                 ; what the messages carry (DbcFile), and/or, without DBC:
/// ; id, size; more: extended, fd, no bit rate switch
/// frame.Wind = 0x321, 8 bytes, every 100 ms
/// ; start|length@order sign (factor,offset) as in DBC; @1f is a float; before it M or m3 of a
/// ; multiplexed one
/// signal.Wind.Speed = 0|16@1- (0.01,0)
/// ; or: every cycle, on request (remote frame); some of them with commas between
/// send.DriveCommand = every 10 ms, on change
/// timeout.DriveStatus = 50 ms
/// log = drive.log                       ; everything on the bus, in the format of candump -L
/// ```
///
/// Read channels: MESSAGE.SIGNAL, MESSAGE.@age [s] and MESSAGE.@count of the frames received, and
/// of the bus @state (0 active, 1 warning, 2 passive, 3 bus-off), @received,
/// @sent, @lost, @unsent, @errors, @busOffs, @saturated, @tooShort and @logDropped. Write channels:
/// MESSAGE.SIGNAL; a message is sent when all of its wired signals have a value, the others have
/// their start value (GenSigStartValue), else 0.
///
/// A message is sent with its GenMsgCycleTime, else in every cycle, unless send.MESSAGE says
/// something else; safe values at once. It is fresh for three times its cycle time, else for the
/// timeout of the driver, unless timeout.MESSAGE says something else.
///
/// When the controller is bus-off, the driver waits a second for its restart (restart-ms of the
/// interface), and then opens the bus again and again.
class CanDriver : public QPlcDriver
{
public:
    CanDriver();
    ~CanDriver() override;

protected:
    void configure(QPlcDriverSettings &settings) override;
    QPlcChannel *channel(const QString &name, QPlcChannel::Direction direction, QString *error) override;
    QStringList channelNames(QPlcChannel::Direction direction) const override;
    bool open() override;
    void close() override;
    bool read() override;
    bool write() override;
    QString remedy(int errorNumber) const override;

private:
    using Number = quint64 (CanDriver::*)() const;
    struct OwnKind
    {
        const char *name;
        Number number;
    };
    struct OwnChannel
    {
        Number number;
        std::unique_ptr<QPlcReadChannel> channel;
    };
    struct Entry
    {
        quint32 key;
        std::size_t index;
    };
    static const std::vector<OwnKind> &ownKinds();

    CanReceiver &receiverOf(const CanMessage &message);
    CanSender &senderOf(const CanMessage &message);
    QPlcChannel *ownChannel(const QString &name);
    CanBus::Options busOptions() const;
    void prepare();
    void deliver(const CanFrame &frame) noexcept;
    void refresh() noexcept;
    bool checkBusOff() noexcept;
    void repeatFailed() noexcept;
    void tellSent(int count) noexcept;
    void log(const CanFrame *frames, int count) noexcept;

    quint64 state() const { return m_bus->state(); }
    quint64 received() const { return m_bus->counters().received; }
    quint64 sent() const { return m_bus->counters().sent; }
    quint64 lost() const { return m_bus->counters().lost; }
    quint64 unsent() const { return m_bus->counters().unsent; }
    quint64 errorFrames() const { return m_bus->counters().errorFrames; }
    quint64 busOffs() const { return m_bus->counters().busOffs; }
    quint64 saturated() const;
    quint64 tooShort() const;
    quint64 logDropped() const { return m_log.dropped(); }

    static constexpr int BatchSize = 64;
    static constexpr int MostBatches = 64;  // of one cycle, so that it ends

    CanConfiguration m_configuration;
    std::unique_ptr<CanBus> m_bus;
    CanLogWriter m_log;
    bool m_hasLog = false;
    QByteArray m_receiveText;  // for errors
    QByteArray m_sendText;
    std::vector<std::unique_ptr<CanReceiver>> m_receivers;
    std::vector<std::unique_ptr<CanSender>> m_senders;
    std::vector<OwnChannel> m_ownChannels;

    std::vector<Entry> m_receiverOfKey;  // sorted
    std::vector<Entry> m_senderOfKey;    // sorted; of those that can be asked for
    std::array<CanFrame, BatchSize> m_incoming;
    std::vector<CanFrame> m_outgoing;
    std::vector<int> m_counts;  // frames of each sender in m_outgoing
    qint64 m_busOffSince = -1;  // [ns]; -1: it is not
    quint64 m_failed = 0;       // frames, as the bus has counted them
};

}  // namespace qplc
