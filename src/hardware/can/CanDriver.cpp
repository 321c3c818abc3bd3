// SPDX-License-Identifier: Apache-2.0
#include "CanBus.h"
#include "CanConfiguration.h"
#include "CanLogWriter.h"
#include "CanReceiver.h"
#include "CanSender.h"
#include "QPlcDriverSettings.h"
#include "hardware/Drivers.h"
#include "hardware/HardwareLogging.h"
#include "realtime/TimeSource.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <vector>

namespace qplc {

namespace {

constexpr qint64 canRestartTime = 1'000'000'000;  // [ns] that a controller has to come back by itself

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
class CanDriver final : public QPlcDriver
{
public:
    CanDriver()
        : QPlcDriver(EveryCycle)
    {
    }

protected:
    void configure(QPlcDriverSettings &settings) override
    {
        m_configuration.read(settings);
        QString error;
        if (!m_configuration.device().isEmpty())
            m_bus = CanBus::make(m_configuration.device(), &error);
        if (!error.isEmpty())
            settings.addError(QStringLiteral("device"), error);
        m_hasLog = !m_configuration.logFile().isEmpty();
        m_receiveText = "receive from " + m_configuration.device().toLocal8Bit();
        m_sendText = "send to " + m_configuration.device().toLocal8Bit();
    }

    QPlcChannel *channel(const QString &name, QPlcChannel::Direction direction, QString *error) override
    {
        if (name.startsWith(QLatin1Char('@')))
            return direction == QPlcChannel::Read ? ownChannel(name) : nullptr;
        const CanMessage *message = m_configuration.find(name.section(QLatin1Char('.'), 0, 0));
        const QString signal = name.section(QLatin1Char('.'), 1);
        const bool isOwn = direction == QPlcChannel::Read && signal.startsWith(QLatin1Char('@'));
        if (!message || (!message->description.find(signal) && !isOwn))
            return nullptr;
        if (!message->description.unsupported.isEmpty()) {
            *error = QStringLiteral("message '%1' cannot be used: %2")
                         .arg(message->description.name, message->description.unsupported);
            return nullptr;
        }
        if (direction == QPlcChannel::Read)
            return receiverOf(*message).channel(signal);
        CanSender &sender = senderOf(*message);
        const QString other = sender.overlapWith(*message->description.find(signal));
        if (!other.isEmpty()) {
            *error = QStringLiteral("signals '%1' and '%2' of message '%3' have bits in common; write one of them")
                         .arg(other, signal, message->description.name);
            return nullptr;
        }
        return sender.channel(signal);
    }

    QStringList channelNames(QPlcChannel::Direction direction) const override
    {
        QStringList names;
        for (const CanMessage &message : m_configuration.messages()) {
            const QString prefix = message.description.name + QLatin1Char('.');
            for (const DbcSignal &signal : message.description.content)
                names << prefix + signal.name;
            if (direction == QPlcChannel::Read)
                names << prefix + QStringLiteral("@age") << prefix + QStringLiteral("@count");
        }
        if (direction == QPlcChannel::Read) {
            for (const OwnKind &kind : ownKinds())
                names << QLatin1String(kind.name);
        }
        return names;
    }

    bool open() override
    {
        prepare();
        if (!m_bus->open(busOptions()))
            return fail(m_bus->errorString());
        QString error;
        if (m_hasLog && !m_log.open(m_configuration.logFile(), m_configuration.device(), &error))
            qCWarning(lcHardware).noquote() << name() << "goes on without a log:" << error;
        return true;
    }

    void close() override
    {
        m_bus->close();
        m_log.close();
    }

    bool read() override
    {
        for (int batch = 0; batch < MostBatches; ++batch) {
            const int count = m_bus->receive(m_incoming.data(), BatchSize);
            if (count < 0)
                return fail(m_receiveText.constData(), m_bus->errorNumber());
            log(m_incoming.data(), count);
            for (int i = 0; i < count; ++i)
                deliver(m_incoming[std::size_t(i)]);
            if (count < BatchSize)
                break;
        }
        refresh();
        return checkBusOff();
    }

    bool write() override
    {
        repeatFailed();
        int count = 0;
        for (std::size_t i = 0; i < m_senders.size(); ++i) {
            m_counts[i] = m_senders[i]->collect(now(), m_outgoing.data() + count);
            count += m_counts[i];
        }
        const int sent = m_bus->send(m_outgoing.data(), count);
        if (sent < 0)
            return fail(m_sendText.constData(), m_bus->errorNumber());
        tellSent(sent);
        if (m_hasLog && sent > 0) {
            const qint64 time = monotonicNow();
            for (int i = 0; i < sent; ++i)
                m_outgoing[std::size_t(i)].time = time;
            log(m_outgoing.data(), sent);
        }
        return true;
    }

    QString remedy(int errorNumber) const override
    {
        switch (errorNumber) {
        case ENETDOWN:
            return QStringLiteral(
                       "the interface is down or bus-off; check wires, terminators and bit rate, and bring it up as "
                       "root (ip link set %1 up type can bitrate 500000 restart-ms 100)")
                .arg(m_configuration.device());
        case ENODEV:
        case ENXIO:
            return QStringLiteral("the adapter is gone; plug it in again");
        case EIO:
            return QStringLiteral(
                "for a second the adapter reported only errors, and the log has the last one; check wires, "
                "terminators and bit rate, and plug it in again");
        default:
            return QPlcDriver::remedy(errorNumber);
        }
    }

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
    static const std::vector<OwnKind> &ownKinds()
    {
        static const std::vector<OwnKind> kinds{
            {"@state", &CanDriver::state},       {"@received", &CanDriver::received},
            {"@sent", &CanDriver::sent},         {"@lost", &CanDriver::lost},
            {"@unsent", &CanDriver::unsent},     {"@errors", &CanDriver::errorFrames},
            {"@busOffs", &CanDriver::busOffs},   {"@saturated", &CanDriver::saturated},
            {"@tooShort", &CanDriver::tooShort}, {"@logDropped", &CanDriver::logDropped},
        };
        return kinds;
    }

    CanReceiver &receiverOf(const CanMessage &message)
    {
        for (const auto &receiver : m_receivers) {
            if (receiver->message().description.name == message.description.name)
                return *receiver;
        }
        m_receivers.push_back(std::make_unique<CanReceiver>(this, message));
        return *m_receivers.back();
    }

    CanSender &senderOf(const CanMessage &message)
    {
        for (const auto &sender : m_senders) {
            if (sender->message().description.name == message.description.name)
                return *sender;
        }
        m_senders.push_back(std::make_unique<CanSender>(this, message));
        return *m_senders.back();
    }

    QPlcChannel *ownChannel(const QString &name)
    {
        for (const OwnChannel &own : m_ownChannels) {
            if (own.channel->name() == name)
                return own.channel.get();
        }
        for (const OwnKind &kind : ownKinds()) {
            if (name != QLatin1String(kind.name))
                continue;
            m_ownChannels.push_back({kind.number, std::make_unique<QPlcReadChannel>(this, name)});
            return m_ownChannels.back().channel.get();
        }
        return nullptr;
    }

    CanBus::Options busOptions() const
    {
        CanBus::Options options;
        options.receivesAll = m_hasLog;
        options.bitRate = m_configuration.bitRate();
        options.dataBitRate = m_configuration.dataBitRate();
        for (const auto &receiver : m_receivers) {
            options.keys.push_back(receiver->key());
            options.needsFd = options.needsFd || receiver->message().description.isFd;
        }
        for (const auto &sender : m_senders) {
            if (sender->message().rule.onRequest)
                options.keys.push_back(sender->key());
            options.needsFd = options.needsFd || sender->message().description.isFd;
        }
        return options;
    }

    // Memory for the cycles.
    void prepare()
    {
        const auto isBefore = [](const Entry &a, const Entry &b) { return a.key < b.key; };
        std::size_t most = 0;
        m_receiverOfKey.clear();
        m_senderOfKey.clear();
        for (std::size_t i = 0; i < m_receivers.size(); ++i) {
            m_receivers[i]->reset();
            m_receiverOfKey.push_back({m_receivers[i]->key(), i});
        }
        for (std::size_t i = 0; i < m_senders.size(); ++i) {
            m_senders[i]->prepare();
            m_senders[i]->reset();
            most += std::size_t(m_senders[i]->mostFrames());
            m_senderOfKey.push_back({m_senders[i]->key(), i});
        }
        std::sort(m_receiverOfKey.begin(), m_receiverOfKey.end(), isBefore);
        std::sort(m_senderOfKey.begin(), m_senderOfKey.end(), isBefore);
        m_outgoing.assign(most, CanFrame());
        m_counts.assign(m_senders.size(), 0);
        m_busOffSince = -1;
    }

    void deliver(const CanFrame &frame) noexcept
    {
        if (frame.has(CanFrame::Error))
            return;
        const auto &table = frame.has(CanFrame::Remote) ? m_senderOfKey : m_receiverOfKey;
        const auto found = std::lower_bound(table.begin(), table.end(), frame.key(),
                                            [](const Entry &entry, quint32 key) { return entry.key < key; });
        if (found == table.end() || found->key != frame.key())
            return;
        if (frame.has(CanFrame::Remote))
            m_senders[found->index]->request();
        else
            m_receivers[found->index]->decode(frame);
    }

    void refresh() noexcept
    {
        for (const auto &receiver : m_receivers)
            receiver->refresh(now());
        for (const OwnChannel &own : m_ownChannels)
            own.channel->set(double((this->*own.number)()), now());
    }

    bool checkBusOff() noexcept
    {
        if (m_bus->state() != CanBus::BusOff) {
            m_busOffSince = -1;
            return true;
        }
        if (m_busOffSince < 0)
            m_busOffSince = now();
        return now() - m_busOffSince < canRestartTime || fail(m_receiveText.constData(), ENETDOWN);
    }

    // Frames that the bus had taken were not sent, and nobody knows which: changes are sent again,
    // the others are anyway.
    void repeatFailed() noexcept
    {
        if (m_bus->counters().failed == m_failed)
            return;
        m_failed = m_bus->counters().failed;
        for (const auto &sender : m_senders)
            sender->repeatChange();
    }

    // The bus has taken the first `count` frames.
    void tellSent(int count) noexcept
    {
        int end = 0;
        for (std::size_t i = 0; i < m_senders.size(); ++i) {
            end += m_counts[i];
            if (m_counts[i] > 0)
                m_senders[i]->sent(end <= count);
        }
    }

    void log(const CanFrame *frames, int count) noexcept
    {
        for (int i = 0; m_hasLog && i < count; ++i)
            m_log.put(frames[i]);
    }

    quint64 state() const { return m_bus->state(); }
    quint64 received() const { return m_bus->counters().received; }
    quint64 sent() const { return m_bus->counters().sent; }
    quint64 lost() const { return m_bus->counters().lost; }
    quint64 unsent() const { return m_bus->counters().unsent; }
    quint64 errorFrames() const { return m_bus->counters().errorFrames; }
    quint64 busOffs() const { return m_bus->counters().busOffs; }
    quint64 saturated() const
    {
        quint64 sum = 0;
        for (const auto &sender : m_senders)
            sum += sender->saturated();
        return sum;
    }

    quint64 tooShort() const
    {
        quint64 sum = 0;
        for (const auto &receiver : m_receivers)
            sum += receiver->tooShort();
        return sum;
    }

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

}  // namespace

std::unique_ptr<QPlcDriver> createCanDriver()
{
    return std::make_unique<CanDriver>();
}

}  // namespace qplc
