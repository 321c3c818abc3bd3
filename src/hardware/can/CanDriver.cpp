// SPDX-License-Identifier: Apache-2.0
#include "CanDriver.h"

#include "QPlcDriverSettings.h"
#include "hardware/HardwareLogging.h"
#include "realtime/TimeSource.h"

#include <algorithm>
#include <cerrno>

namespace qplc {

namespace {

constexpr qint64 canRestartTime = 1'000'000'000;  // [ns] that a controller has to come back by itself

}  // namespace

CanDriver::CanDriver()
    : QPlcDriver(EveryCycle)
{
}

CanDriver::~CanDriver() = default;

// ---- before the cycles ----

void CanDriver::configure(QPlcDriverSettings &settings)
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

const std::vector<CanDriver::OwnKind> &CanDriver::ownKinds()
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

QPlcChannel *CanDriver::channel(const QString &name, QPlcChannel::Direction direction, QString *error)
{
    if (name.startsWith(QLatin1Char('@')))
        return direction == QPlcChannel::Read ? ownChannel(name) : nullptr;
    const CanMessage *message = m_configuration.find(name.section(QLatin1Char('.'), 0, 0));
    const QString signal = name.section(QLatin1Char('.'), 1);
    if (!message || (!message->description.find(signal) && !signal.startsWith(QLatin1Char('@'))))
        return nullptr;
    if (!message->description.unsupported.isEmpty()) {
        *error = QStringLiteral("message '%1' cannot be used: %2")
                     .arg(message->description.name, message->description.unsupported);
        return nullptr;
    }
    if (direction == QPlcChannel::Read)
        return receiverOf(*message).channel(signal);
    return senderOf(*message).channel(signal);
}

QPlcChannel *CanDriver::ownChannel(const QString &name)
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

CanReceiver &CanDriver::receiverOf(const CanMessage &message)
{
    for (const auto &receiver : m_receivers) {
        if (receiver->message().description.name == message.description.name)
            return *receiver;
    }
    m_receivers.push_back(std::make_unique<CanReceiver>(this, message));
    return *m_receivers.back();
}

CanSender &CanDriver::senderOf(const CanMessage &message)
{
    for (const auto &sender : m_senders) {
        if (sender->message().description.name == message.description.name)
            return *sender;
    }
    m_senders.push_back(std::make_unique<CanSender>(this, message));
    return *m_senders.back();
}

QStringList CanDriver::channelNames(QPlcChannel::Direction direction) const
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

// ---- the bus ----

CanBus::Options CanDriver::busOptions() const
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
void CanDriver::prepare()
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

bool CanDriver::open()
{
    prepare();
    if (!m_bus->open(busOptions()))
        return fail(m_bus->errorString());
    QString error;
    if (m_hasLog && !m_log.open(m_configuration.logFile(), m_configuration.device(), &error))
        qCWarning(lcHardware).noquote() << name() << "goes on without a log:" << error;
    return true;
}

void CanDriver::close()
{
    m_bus->close();
    m_log.close();
}

QString CanDriver::remedy(int errorNumber) const
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

// ---- the cycle ----

bool CanDriver::read()
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

void CanDriver::deliver(const CanFrame &frame) noexcept
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

void CanDriver::refresh() noexcept
{
    for (const auto &receiver : m_receivers)
        receiver->refresh(now());
    for (const OwnChannel &own : m_ownChannels)
        own.channel->set(double((this->*own.number)()), now());
}

bool CanDriver::checkBusOff() noexcept
{
    if (m_bus->state() != CanBus::BusOff) {
        m_busOffSince = -1;
        return true;
    }
    if (m_busOffSince < 0)
        m_busOffSince = now();
    return now() - m_busOffSince < canRestartTime || fail(m_receiveText.constData(), ENETDOWN);
}

bool CanDriver::write()
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

// Frames that the bus had taken were not sent, and nobody knows which: changes are sent again, the
// others are anyway.
void CanDriver::repeatFailed() noexcept
{
    if (m_bus->counters().failed == m_failed)
        return;
    m_failed = m_bus->counters().failed;
    for (const auto &sender : m_senders)
        sender->repeatChange();
}

// The bus has taken the first `count` frames.
void CanDriver::tellSent(int count) noexcept
{
    int end = 0;
    for (std::size_t i = 0; i < m_senders.size(); ++i) {
        end += m_counts[i];
        if (m_counts[i] > 0)
            m_senders[i]->sent(end <= count);
    }
}

void CanDriver::log(const CanFrame *frames, int count) noexcept
{
    for (int i = 0; m_hasLog && i < count; ++i)
        m_log.put(frames[i]);
}

quint64 CanDriver::saturated() const
{
    quint64 sum = 0;
    for (const auto &sender : m_senders)
        sum += sender->saturated();
    return sum;
}

quint64 CanDriver::tooShort() const
{
    quint64 sum = 0;
    for (const auto &receiver : m_receivers)
        sum += receiver->tooShort();
    return sum;
}

}  // namespace qplc
