// SPDX-License-Identifier: Apache-2.0
#include "CanBusDriver.h"
#include "CanConfiguration.h"
#include "CanLogWriter.h"
#include "CanReceiver.h"
#include "CanSender.h"
#include "QPlcDriverSettings.h"
#include "hardware/Drivers.h"
#include "hardware/HardwareLogging.h"
#include "realtime/TimeSource.h"

#include <algorithm>
#include <vector>

namespace qplc {

namespace {

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
/// @sent, @lost, @unsent, @unconfirmed, @errors, @busOffs, @saturated, @tooShort, @corrupt and
/// @logDropped. Write channels: MESSAGE.SIGNAL; a message is sent when all of its wired signals
/// have a value, the others have their start value (GenSigStartValue), else 0.
///
/// A message is sent with its GenMsgCycleTime, else in every cycle, unless send.MESSAGE says
/// something else; safe values at once. It is fresh for three times its cycle time, else for the
/// timeout of the driver, unless timeout.MESSAGE says something else.
///
/// When the controller is bus-off, the driver waits a second for its restart (restart-ms of the
/// interface), and then opens the bus again and again.
class CanDriver final : public CanBusDriver
{
public:
    CanDriver()
        : CanBusDriver(EveryCycle)
    {
        addOwn("@state", [this] { return quint64(bus().state()); });
        addOwn("@received", [this] { return bus().counters().received; });
        addOwn("@sent", [this] { return bus().counters().sent; });
        addOwn("@lost", [this] { return bus().counters().lost; });
        addOwn("@unsent", [this] { return bus().counters().unsent; });
        addOwn("@unconfirmed", [this] { return quint64(bus().unconfirmed()); });
        addOwn("@errors", [this] { return bus().counters().errorFrames; });
        addOwn("@busOffs", [this] { return bus().counters().busOffs; });
        addOwn("@saturated", [this] { return sum(m_senders, &CanSender::saturated); });
        addOwn("@tooShort", [this] { return sum(m_receivers, &CanReceiver::tooShort); });
        addOwn("@corrupt", [this] { return sum(m_receivers, &CanReceiver::corrupt); });
        addOwn("@logDropped", [this] { return m_log.dropped(); });
    }

protected:
    void configure(QPlcDriverSettings &settings) override
    {
        m_configuration.read(settings);
        makeBus(m_configuration.device(), settings);
        m_hasLog = !m_configuration.logFile().isEmpty();
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
        if (message->description.isJ1939 && (message->sentId() & 0xFF) >= 0xFE) {
            *error = QStringLiteral("message '%1' has no source address (the last byte of its id is 0x%2); write "
                                    "source.%1 = address of this node, 0 ... 253")
                         .arg(message->description.name)
                         .arg(message->sentId() & 0xFF, 0, 16);
            return nullptr;
        }
        if (signal == message->protection.counter || signal == message->protection.checksum) {
            *error = QStringLiteral("the driver writes signal '%1' of message '%2' itself (counter.%2, checksum.%2); "
                                    "remove this line")
                         .arg(signal, message->description.name);
            return nullptr;
        }
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
        if (direction == QPlcChannel::Read)
            names += ownNames();
        return names;
    }

    bool open() override
    {
        prepare();
        if (!openBus(busOptions()))
            return false;
        m_hasTakenAll = false;
        setDelivered(false);
        QString error;
        if (m_hasLog && !m_log.open(m_configuration.logFile(), m_configuration.device(), &error))
            qCWarning(lcHardware).noquote() << name() << "goes on without a log:" << error;
        return true;
    }

    void close() override
    {
        bus().close();
        m_log.close();
    }

    bool read() override
    {
        if (!takeFrames())
            return false;
        refresh();
        return checkBusOff();
    }

    bool write() override
    {
        // The bus takes new frames when it has confirmed those of the cycle before.
        if (bus().unconfirmed() > 0 && !takeFrames())
            return false;
        setDelivered(m_hasTakenAll && bus().unconfirmed() == 0);
        repeatFailed();
        int count = 0;
        for (std::size_t i = 0; i < m_senders.size(); ++i) {
            m_counts[i] = m_senders[i]->collect(now(), m_outgoing.data() + count);
            count += m_counts[i];
        }
        int sent = 0;
        if (!send(m_outgoing.data(), count, &sent))
            return false;
        tellSent(sent);
        m_hasTakenAll = sent == count;
        if (m_hasLog && sent > 0) {
            const qint64 time = monotonicNow();
            for (int i = 0; i < sent; ++i)
                m_outgoing[std::size_t(i)].time = time;
            log(m_outgoing.data(), sent);
        }
        return true;
    }

    QString undeliveredText() const override
    {
        return QStringLiteral("nobody on its bus acknowledges them; switch the device on, check wires, terminators and "
                              "bit rate");
    }

private:
    struct Entry
    {
        quint32 key;
        std::size_t index;
    };

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

    CanBus::Options busOptions() const
    {
        CanBus::Options options;
        options.receivesAll = m_hasLog;
        options.bitRate = m_configuration.bitRate();
        options.dataBitRate = m_configuration.dataBitRate();
        for (const auto &receiver : m_receivers) {
            if (receiver->message().description.isJ1939)
                options.groups.push_back(CanFrame::groupOf(receiver->message().description.id));
            else
                options.keys.push_back(receiver->key());
            options.needsFd = options.needsFd || receiver->message().description.isFd;
        }
        for (const auto &sender : m_senders) {
            options.sentKeys.push_back(sender->key());
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
        m_receiverOfGroup.clear();
        m_senderOfKey.clear();
        for (std::size_t i = 0; i < m_receivers.size(); ++i) {
            const DbcMessage &description = m_receivers[i]->message().description;
            m_receivers[i]->reset();
            if (description.isJ1939)
                m_receiverOfGroup.push_back({CanFrame::groupOf(description.id), i});
            else
                m_receiverOfKey.push_back({m_receivers[i]->key(), i});
        }
        for (std::size_t i = 0; i < m_senders.size(); ++i) {
            m_senders[i]->prepare();
            m_senders[i]->reset();
            most += std::size_t(m_senders[i]->mostFrames());
            m_senderOfKey.push_back({m_senders[i]->key(), i});
        }
        std::sort(m_receiverOfKey.begin(), m_receiverOfKey.end(), isBefore);
        std::sort(m_receiverOfGroup.begin(), m_receiverOfGroup.end(), isBefore);
        std::sort(m_senderOfKey.begin(), m_senderOfKey.end(), isBefore);
        m_outgoing.assign(most, CanFrame());
        m_counts.assign(m_senders.size(), 0);
    }

    bool takeFrames() noexcept
    {
        return receive([this](const CanFrame &frame) {
            log(&frame, 1);
            deliver(frame);
        });
    }

    void deliver(const CanFrame &frame) noexcept
    {
        if (frame.has(CanFrame::Error))
            return;
        if (frame.has(CanFrame::Remote)) {
            forEach(m_senderOfKey, frame.key(), [this](std::size_t index) { m_senders[index]->request(); });
            return;
        }
        const auto decode = [this, &frame](std::size_t index) { m_receivers[index]->decode(frame); };
        forEach(m_receiverOfKey, frame.key(), decode);
        if (frame.has(CanFrame::Extended))
            forEach(m_receiverOfGroup, CanFrame::groupOf(frame.id), decode);
    }

    /// Calls \a call with the index of each entry of a key.
    template<typename Call>
    static void forEach(const std::vector<Entry> &table, quint32 key, Call call) noexcept
    {
        auto entry = std::lower_bound(table.begin(), table.end(), key,
                                      [](const Entry &one, quint32 wanted) { return one.key < wanted; });
        for (; entry != table.end() && entry->key == key; ++entry)
            call(entry->index);
    }

    void refresh() noexcept
    {
        for (const auto &receiver : m_receivers)
            receiver->refresh(now());
        showOwn();
    }

    // Frames that the bus had taken were not sent, and nobody knows which: changes are sent again,
    // the others are anyway.
    void repeatFailed() noexcept
    {
        if (bus().counters().failed == m_failed)
            return;
        m_failed = bus().counters().failed;
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

    /// Of a number that each sender or receiver has counted.
    template<typename Part>
    static quint64 sum(const std::vector<std::unique_ptr<Part>> &parts, quint64 (Part::*number)() const) noexcept
    {
        quint64 result = 0;
        for (const auto &part : parts)
            result += (part.get()->*number)();
        return result;
    }

    CanConfiguration m_configuration;
    CanLogWriter m_log;
    bool m_hasLog = false;
    bool m_hasTakenAll = false;  // the bus, of what the last write() had for it
    std::vector<std::unique_ptr<CanReceiver>> m_receivers;
    std::vector<std::unique_ptr<CanSender>> m_senders;

    std::vector<Entry> m_receiverOfKey;    // sorted
    std::vector<Entry> m_receiverOfGroup;  // sorted; of J1939
    std::vector<Entry> m_senderOfKey;      // sorted; of those that can be asked for
    std::vector<CanFrame> m_outgoing;
    std::vector<int> m_counts;  // frames of each sender in m_outgoing
    quint64 m_failed = 0;       // frames, as the bus has counted them
};

}  // namespace

std::unique_ptr<QPlcDriver> createCanDriver()
{
    return std::make_unique<CanDriver>();
}

}  // namespace qplc
