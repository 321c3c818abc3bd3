// SPDX-License-Identifier: Apache-2.0
#include "DriverRunner.h"

#include "HardwareLogging.h"
#include "NotedEvents.h"
#include "QPlcDriverSettings.h"
#include "node/session/BackOff.h"
#include "signals/DurationText.h"
#include "signals/MessageText.h"

#include <QtCore/QRandomGenerator>

#include <algorithm>
#include <cmath>

#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr std::chrono::hours longestTime{24};
constexpr std::chrono::milliseconds eventPause{100};  // when there are too many
constexpr int mostEvents = 64;                        // that are told in a second
constexpr qint64 Never = QPlcReadChannel::Never;

/// For a message about the channel \a name: those that it might have meant, or all.
QString remedyFor(const QString &name, const QStringList &channels)
{
    const QStringList close = closeNames(name, channels);
    return close.isEmpty() ? knownAre(channels) : didYouMean(close);
}

}  // namespace

QString DriverRunner::ownName(Own own)
{
    return own == Own::Online ? QStringLiteral("@online")
        : own == Own::Age     ? QStringLiteral("@age")
                              : QStringLiteral("@failures");
}

DriverRunner::DriverRunner(const QString &name, const QString &kind, std::unique_ptr<QPlcDriver> driver)
    : m_kind(kind)
    , m_driver(std::move(driver))
    , m_wakeUp(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC))
{
    m_driver->m_name = name;
}

DriverRunner::~DriverRunner()
{
    stop();
    ::close(m_wakeUp);
}

// ---- before the start ----

void DriverRunner::configure(QPlcDriverSettings &settings)
{
    using namespace std::chrono_literals;
    const bool isOwnPace = m_driver->pace() == QPlcDriver::OwnPace;
    if (isOwnPace)
        m_driver->m_interval = settings.duration(QStringLiteral("interval"), 10ms, 100us, longestTime);
    m_driver->m_timeout
        = settings.duration(QStringLiteral("timeout"),
                            isOwnPace ? 3 * m_driver->m_interval : std::chrono::nanoseconds(100ms), 1ms, longestTime);
    m_priority = int(settings.integer(QStringLiteral("priority"), 0, 0, 98));
    if (isOwnPace && m_driver->m_timeout < m_driver->m_interval)
        settings.addError(QStringLiteral("timeout"),
                          QStringLiteral("timeout is shorter than interval (%1), so values would be invalid between "
                                         "two readings; write at least that")
                              .arg(durationText(m_driver->m_interval)));
    m_driver->configure(settings);
}

int DriverRunner::wire(const QString &name, QPlcChannel::Direction direction, QString *error)
{
    const bool isRead = direction == QPlcChannel::Read;
    for (const Own own : {Own::Online, Own::Age, Own::Failures}) {
        if (isRead && name == ownName(own))
            return placeOf(&m_readChannels, ReadEnd{nullptr, own});
    }
    QPlcChannel *channel = m_driver->channel(name, direction, error);
    if (!channel) {
        if (error->isEmpty())
            *error = QStringLiteral("driver '%1' has no channel %2 to %3%4")
                         .arg(m_kind, quoted(name), isRead ? QStringLiteral("read") : QStringLiteral("write"),
                              remedyFor(name, m_driver->channelNames(direction)));
        return -1;
    }
    channel->m_isWired = true;
    if (isRead)
        return placeOf(&m_readChannels, ReadEnd{static_cast<QPlcReadChannel *>(channel), Own::No});
    return placeOf(&m_writeChannels, static_cast<QPlcWriteChannel *>(channel));
}

QString DriverRunner::problemOf(int writeChannel, double value) const
{
    const QPlcWriteChannel &channel = *m_writeChannels[std::size_t(writeChannel)];
    const double lowest = channel.minimum();
    const double highest = channel.maximum();
    // 327.67 is 32767 * 0.01, and a bit more.
    const double slack = 1e-9 * std::min(std::max(std::abs(lowest), std::abs(highest)), 1e300);
    if (value >= lowest - slack && value <= highest + slack)
        return {};
    return QStringLiteral("%1 is not in the range %2 to %3 of '%4'; write a value of this range, in the unit of the "
                          "device")
        .arg(QString::number(value, 'g', 10), QString::number(lowest, 'g', 10), QString::number(highest, 'g', 10),
             channel.name());
}

std::optional<double> DriverRunner::tornValue(int readChannel) const
{
    const QPlcReadChannel *channel = m_readChannels[std::size_t(readChannel)].channel;
    return channel ? channel->tornValue() : std::nullopt;
}

std::optional<double> DriverRunner::restValue(int writeChannel) const
{
    return m_writeChannels[std::size_t(writeChannel)]->restValue();
}

QStringList DriverRunner::unsetOutputs() const
{
    QStringList names;
    for (std::size_t i = 0; i < m_orders.size(); ++i) {
        if (m_orders[i].kind == Order::None)
            names << m_writeChannels[i]->name();
    }
    return names;
}

/// Number of \a end among \a ends; one that is new goes to their end.
template<typename End>
int DriverRunner::placeOf(std::vector<End> *ends, const End &end)
{
    const auto found = std::find(ends->begin(), ends->end(), end);
    const auto place = int(found - ends->begin());
    if (found == ends->end())
        ends->push_back(end);
    return place;
}

void DriverRunner::prepare()
{
    if (m_toDevice && m_orders.size() == m_writeChannels.size() && m_readings.size() == m_readChannels.size())
        return;
    m_orders.assign(m_writeChannels.size(), {});
    m_readings.assign(m_readChannels.size(), {});
    m_newReadings = m_readings;
    m_newOrders = m_orders;
    m_toDevice = std::make_unique<SnapshotBuffer>(m_orders.size() * sizeof(Order));
    m_fromDevice = std::make_unique<SnapshotBuffer>(m_readings.size() * sizeof(Reading));
    for (const ReadEnd &end : m_readChannels) {
        if (end.channel && end.channel->m_timeout < 0)
            end.channel->m_timeout = m_driver->m_timeout.count();
    }
}

// ---- the cycle ----

void DriverRunner::setValue(int writeChannel, double value, bool isSafe) noexcept
{
    m_orders[std::size_t(writeChannel)] = {value, isSafe ? Order::Safe : Order::Computed};
}

void DriverRunner::write(qint64 now) noexcept
{
    m_toDevice->publish(m_orders.data(), quint64(now));
    if (!takeForCycle())
        return;
    give(m_orders);
    if (!writeDevice(now))
        lose();
    else
        wakeForEvents();
}

void DriverRunner::leave(qint64 now) noexcept
{
    write(now);
    State state = InCycle;
    m_state.compare_exchange_strong(state, Open, std::memory_order_release, std::memory_order_relaxed);
    wake();
}

void DriverRunner::read(qint64 now) noexcept
{
    if (m_state.load(std::memory_order_acquire) == InCycle) {
        if (readDevice(now)) {
            copyChannels(&m_readings);
            wakeForEvents();
            return;
        }
        lose();
    }
    if (isOnline())
        m_fromDevice->read(m_readings.data(), nullptr);
    else
        forget(&m_readings);  // its channels belong to the thread of the driver now
}

DriverRunner::Sample DriverRunner::sample(int readChannel, qint64 now) const noexcept
{
    const Reading &reading = m_readings[std::size_t(readChannel)];
    switch (m_readChannels[std::size_t(readChannel)].own) {
    case Own::Online:
        return {isOnline() ? 1.0 : 0.0, now, true};
    case Own::Failures:
        return {double(failures()), now, true};
    case Own::Age:
        return {age(now), now, true};
    case Own::No:
        break;
    }
    const bool isFresh = reading.time != Never && (reading.timeout == 0 || now - reading.time <= reading.timeout);
    return {reading.value, reading.time, isFresh};
}

QPlcHardwareNode::Wire DriverRunner::wireState(int channel, QPlcChannel::Direction direction, qint64 now) const
{
    const auto place = std::size_t(channel);
    QPlcHardwareNode::Wire wire;
    wire.driver = name();
    wire.direction = direction;
    if (direction == QPlcChannel::Write) {
        wire.channel = m_writeChannels[place]->name();
        wire.value = m_orders[place].value;
        wire.isFresh = m_orders[place].kind != Order::None;
        return wire;
    }
    const Sample sample = this->sample(channel, now);
    const ReadEnd &end = m_readChannels[place];
    wire.channel = end.channel ? end.channel->name() : ownName(end.own);
    wire.value = sample.value;
    wire.isFresh = sample.isFresh;
    // What has come in since the cycle began is new, not of the future.
    wire.age = sample.time == Never ? std::numeric_limits<double>::infinity()
                                    : double(std::max<qint64>(now - sample.time, 0)) * 1e-9;
    return wire;
}

/// Of the oldest value that is wired [s]; infinite: one of them was never read.
double DriverRunner::age(qint64 now) const noexcept
{
    qint64 oldest = now;
    for (std::size_t i = 0; i < m_readings.size(); ++i) {
        if (m_readChannels[i].own == Own::No)
            oldest = std::min(oldest, m_readings[i].time);
    }
    return oldest == Never ? std::numeric_limits<double>::infinity() : double(now - oldest) * 1e-9;
}

/// Whether the device is the cycle's, now or already; it never waits for a thread that is at it.
bool DriverRunner::takeForCycle() noexcept
{
    State state = m_state.load(std::memory_order_acquire);
    if (state == Open && m_driver->pace() == QPlcDriver::EveryCycle
        && m_state.compare_exchange_strong(state, InCycle, std::memory_order_acquire))
        return true;
    return state == InCycle;
}

/// The cycle has met an error: from here on the device belongs to the thread of the driver.
void DriverRunner::lose() noexcept
{
    m_state.store(Failed, std::memory_order_release);
    wake();
}

/// In the cycle: the thread of the driver tells what has happened.
void DriverRunner::wakeForEvents() noexcept
{
    if (m_driver->m_events->takeNews())
        wake();
}

void DriverRunner::wake() noexcept
{
    const std::uint64_t one = 1;
    const ssize_t written = ::write(m_wakeUp, &one, sizeof one);
    Q_UNUSED(written)  // a counter that is full wakes, too
}

// ---- code of the driver ----

/// What it throws is a failure. Its text takes memory, in a cycle too, as the exception has done.
template<typename Code>
bool DriverRunner::attempt(const char *function, Code code) noexcept
{
    const auto fail = [&](const QString &what) {
        return m_driver->fail(QStringLiteral("%1() threw: %2").arg(QLatin1String(function), what));
    };
    try {
        return code();
    } catch (const std::exception &thrown) {
        return fail(QString::fromLocal8Bit(thrown.what()));
    } catch (...) {
        return fail(QStringLiteral("an exception that is not derived from std::exception"));
    }
}

bool DriverRunner::readDevice(qint64 now) noexcept
{
    m_driver->m_now = now;
    return attempt("read", [this] { return m_driver->read(); });
}

bool DriverRunner::writeDevice(qint64 now) noexcept
{
    m_driver->m_now = now;
    return attempt("write", [this] { return m_driver->write(); });
}

void DriverRunner::closeDevice() noexcept
{
    const auto close = [this] {
        m_driver->close();
        return true;
    };
    if (!attempt("close", close))
        tell(m_driver->errorString());
    for (const ReadEnd &end : m_readChannels) {
        if (end.channel)
            end.channel->invalidate();
    }
}

// ---- channels ----

void DriverRunner::give(const std::vector<Order> &orders) noexcept
{
    for (std::size_t i = 0; i < orders.size(); ++i) {
        QPlcWriteChannel &channel = *m_writeChannels[i];
        channel.m_hasValue = orders[i].kind != Order::None;
        channel.m_isSafe = orders[i].kind != Order::Computed;
        channel.m_value = orders[i].value;
    }
}

void DriverRunner::copyChannels(std::vector<Reading> *readings) const noexcept
{
    for (std::size_t i = 0; i < readings->size(); ++i) {
        if (const QPlcReadChannel *channel = m_readChannels[i].channel)
            (*readings)[i] = {channel->m_value, channel->m_time, channel->m_timeout};
    }
}

void DriverRunner::forget(std::vector<Reading> *readings) noexcept
{
    for (Reading &reading : *readings)
        reading.time = Never;
}

void DriverRunner::takeOrders()
{
    if (m_toDevice->read(m_newOrders.data(), nullptr))
        give(m_newOrders);
}

/// What the thread of the driver has read.
void DriverRunner::publish()
{
    copyChannels(&m_newReadings);
    m_fromDevice->publish(m_newReadings.data(), quint64(m_driver->m_now));
}

// ---- the thread of the driver ----

void DriverRunner::start(Report report, EventReport eventReport, Report deliveryReport)
{
    if (m_thread.joinable())
        return;
    prepare();
    m_report = std::move(report);
    m_eventReport = std::move(eventReport);
    m_deliveryReport = std::move(deliveryReport);
    m_stop = false;
    m_driver->m_isClosing = false;
    m_thread = std::thread([this] { run(); });
}

void DriverRunner::stop()
{
    if (!m_thread.joinable())
        return;
    m_stop = true;
    m_driver->m_isClosing = true;
    wake();
    m_thread.join();
}

void DriverRunner::run()
{
    setPriority();
    pthread_setname_np(pthread_self(), m_driver->m_name.toLocal8Bit().left(15).constData());
    BackOff backOff;
    qint64 next = monotonicNow();
    while (!m_stop.load(std::memory_order_acquire)) {
        const bool doEventsWait = tellEvents();
        switch (m_state.load(std::memory_order_acquire)) {
        case Closed:
            if (openNow()) {
                backOff.reset();
                next = monotonicNow();
                tell({});
                tellEvents();
                tellDelivery();
            } else {
                tell(m_driver->errorString());
                waitFor(backOff.next(QRandomGenerator::global()->generateDouble()));
            }
            break;
        case Open:
            if (exchange()) {
                tellEvents();
                tellDelivery();
                next = std::max<qint64>(next + m_driver->m_interval.count(), monotonicNow());
                waitFor(std::chrono::nanoseconds(next - monotonicNow()));
            }
            break;
        case InThread:  // only within exchange()
        case InCycle:
            waitFor(doEventsWait ? std::chrono::nanoseconds(eventPause) : std::chrono::nanoseconds(longestTime));
            break;
        case Failed:
            tell(m_driver->errorString());
            closeNow();
            waitFor(backOff.next(QRandomGenerator::global()->generateDouble()));
            break;
        }
    }
    if (isOnline())
        writeNow(monotonicNow());
    closeNow();
    tellEvents();
}

/// A slow bus is no part of the cycle, whatever chrt says, unless its section says so.
void DriverRunner::setPriority()
{
    const sched_param ordinary{};
    sched_param wanted{};
    wanted.sched_priority = m_priority;
    int policy = SCHED_OTHER;
    sched_param obtained{};
    const int error = m_priority > 0 ? pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted) : 0;
    pthread_getschedparam(pthread_self(), &policy, &obtained);
    const bool isObtained = policy == SCHED_FIFO && obtained.sched_priority == m_priority;
    if (m_priority > 0 && isObtained)
        return;
    pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
    if (m_priority > 0)
        qCWarning(lcHardware).noquote()
            << QStringLiteral(
                   "device '%1': its thread did not get the priority %2 (%3) and has the ordinary one; allow "
                   "it with LimitRTPRIO= in the unit, or 'ulimit -r'")
                   .arg(name())
                   .arg(m_priority)
                   .arg(qt_error_string(error));
}

void DriverRunner::tell(const QString &error)
{
    if (m_report && (error.isEmpty() || error != m_told))
        m_report(error);
    m_told = error;
}

std::optional<QPlcDeviceEvent> DriverRunner::takeEvent()
{
    const std::optional<quint64> data = m_driver->m_events->take();
    if (!data)
        return std::nullopt;
    QPlcDeviceEvent event = m_driver->describeEvent(*data);
    event.driver = name();
    event.data = *data;
    return event;
}

bool DriverRunner::mayTellEvent()
{
    const qint64 now = monotonicNow();
    if (now - m_eventsSince > 1'000'000'000) {
        m_eventsSince = now;
        m_eventsTold = 0;
    }
    return m_eventsTold++ < mostEvents;
}

/// \return whether some of them wait, and the driver notes the newest state later: there were too
/// many
bool DriverRunner::tellEvents()
{
    while (!m_driver->m_events->isEmpty()) {
        if (!mayTellEvent())
            return true;
        const std::optional<QPlcDeviceEvent> event = takeEvent();
        if (event && m_eventReport)
            m_eventReport(*event);
    }
    return false;
}

void DriverRunner::tellDelivery()
{
    if (!m_deliveryReport)
        return;
    const bool isDelivered = m_driver->m_isDelivered.load(std::memory_order_relaxed);
    const QString problem = isDelivered ? QString() : m_driver->undeliveredText();
    if (problem != m_toldDelivery)
        m_deliveryReport(problem);
    m_toldDelivery = problem;
}

void DriverRunner::waitFor(std::chrono::nanoseconds time)
{
    pollfd descriptor{m_wakeUp, POLLIN, 0};
    const timespec duration = timeSpec(std::max<qint64>(0, time.count()));
    std::uint64_t count = 0;
    if (::ppoll(&descriptor, 1, &duration, nullptr) > 0 && ::read(m_wakeUp, &count, sizeof count) < 0)
        return;  // somebody else has read it: nobody does
}

bool DriverRunner::openNow(const std::function<qint64()> &now)
{
    prepare();
    m_driver->m_now = now();
    if (!attempt("open", [this] { return m_driver->open(); }))
        return false;
    takeOrders();
    if (!writeDevice(now()) || !readDevice(now())) {  // before the cycle may come between
        closeDevice();
        return false;
    }
    publish();
    m_state.store(Open, std::memory_order_release);
    return true;
}

void DriverRunner::closeNow()
{
    const State state = m_state.exchange(Closed, std::memory_order_acq_rel);
    if (state == Closed)
        return;
    if (state == Failed)
        m_failures.fetch_add(1, std::memory_order_relaxed);
    closeDevice();
    publish();
}

/// Writes and reads once. \return false when the device was lost, or the cycle has taken it
bool DriverRunner::exchange()
{
    State state = Open;
    if (!m_state.compare_exchange_strong(state, InThread, std::memory_order_acquire, std::memory_order_relaxed)
        || !writeNow(monotonicNow()) || !readNow(monotonicNow()))
        return false;
    m_state.store(Open, std::memory_order_release);
    return true;
}

bool DriverRunner::readNow(qint64 now)
{
    const bool isRead = readDevice(now);
    if (isRead)
        publish();
    else
        m_state.store(Failed, std::memory_order_release);
    return isRead;
}

bool DriverRunner::writeNow(qint64 now)
{
    takeOrders();
    const bool isWritten = writeDevice(now);
    if (!isWritten)
        m_state.store(Failed, std::memory_order_release);
    return isWritten;
}

}  // namespace qplc
