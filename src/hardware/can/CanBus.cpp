// SPDX-License-Identifier: Apache-2.0
#include "CanBus.h"

#include "FakeCanBus.h"
#if defined(QTPLC_HAS_QT_SERIAL_BUS)
#include "QtCanBus.h"
#endif

#include <algorithm>
#include <linux/can/error.h>

namespace qplc {

namespace {

// After this time without a confirmation, frames were dropped by the kernel or the adapter. A
// controller that is error passive tells that it still repeats one.
constexpr qint64 canDroppedAfter = 100'000'000;            // [ns]
constexpr qint64 canDroppedAfterPassive = 10'000'000'000;  // [ns]

// What the controller says of itself in an error frame; `before` when it says nothing.
CanBus::State canStateOf(const CanFrame &frame, CanBus::State before)
{
    if (frame.id & CAN_ERR_BUSOFF)
        return CanBus::BusOff;
    if (frame.id & CAN_ERR_RESTARTED)
        return CanBus::Active;
    if (!(frame.id & CAN_ERR_CRTL))
        return before;
    const quint8 controller = frame.data[1];
    if (controller & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE))
        return CanBus::Passive;
    if (controller & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING))
        return CanBus::Warning;
    return (controller & CAN_ERR_CRTL_ACTIVE) ? CanBus::Active : before;
}

bool isControllerOverflow(const CanFrame &frame)
{
    return (frame.id & CAN_ERR_CRTL) && (frame.data[1] & CAN_ERR_CRTL_RX_OVERFLOW);
}

std::unique_ptr<CanBus> makeQtCanBus(const QString &device, QString *error)
{
#if defined(QTPLC_HAS_QT_SERIAL_BUS)
    const QString plugin = device.section(QLatin1Char(':'), 0, 0);
    const QString interface = device.section(QLatin1Char(':'), 1);
    if (!plugin.isEmpty() && !interface.isEmpty())
        return std::make_unique<QtCanBus>(plugin, interface);
    *error = QStringLiteral("'qtcan:%1' does not name a plugin and an interface; write qtcan:PLUGIN:INTERFACE, "
                            "qtcan:peakcan:usb0 for example")
                 .arg(device);
#else
    *error = QStringLiteral("'qtcan:%1': this build has no Qt Serial Bus; install libqt5serialbus5-dev and build again")
                 .arg(device);
#endif
    return nullptr;
}

}  // namespace

std::unique_ptr<CanBus> CanBus::make(const QString &device, QString *error)
{
    const QString rest = device.section(QLatin1Char(':'), 1);
    if (device.startsWith(QLatin1String("qtcan:")))
        return makeQtCanBus(rest, error);
    if (device.startsWith(QLatin1String("fake:"))) {
        if (FakeCanBus::isName(rest))
            return std::make_unique<FakeCanBus>(rest);
        *error = QStringLiteral(
                     "'%1' does not name a fake bus; write fake:NAME, with 1 ... 32 letters, digits, '-' and '_'")
                     .arg(device);
        return nullptr;
    }
    if (auto bus = createSocketCanBus(device))
        return bus;
    *error = QStringLiteral(
                 "'%1' does not name a CAN bus; write an interface like can0, qtcan:PLUGIN:INTERFACE, or fake:NAME")
                 .arg(device);
    return nullptr;
}

bool CanBus::setsBitRate(const QString &device)
{
    return device.startsWith(QLatin1String("qtcan:")) && !device.startsWith(QLatin1String("qtcan:socketcan:"));
}

bool CanBus::open(const Options &options)
{
    m_options = options;
    std::sort(m_options.keys.begin(), m_options.keys.end());
    std::sort(m_options.groups.begin(), m_options.groups.end());
    m_state = Active;
    m_errorNumber = 0;
    m_confirms = false;
    m_unconfirmed = m_overdue = 0;
    return join(m_options);
}

int CanBus::receive(CanFrame *frames, int capacity) noexcept
{
    const int count = readFrames(frames, capacity);
    for (int i = 0; i < count; ++i) {
        if (frames[i].has(CanFrame::Error))
            noteError(frames[i]);
        else
            ++m_counters.received;
    }
    m_overdue = m_unconfirmed;
    return count;
}

int CanBus::send(const CanFrame *frames, int count, qint64 now) noexcept
{
    const int sent = count > 0 && !holdsBack(now) ? writeFrames(frames, count) : 0;
    if (m_confirms && sent > 0) {
        m_takenAt = m_unconfirmed == 0 ? now : m_takenAt;
        m_unconfirmed += sent;
    }
    m_counters.sent += quint64(std::max(sent, 0));
    m_counters.unsent += quint64(count - std::max(sent, 0));
    return sent;
}

bool CanBus::holdsBack(qint64 now) noexcept
{
    const qint64 patience = m_state >= Passive ? canDroppedAfterPassive : canDroppedAfter;
    if (m_overdue > 0 && now - m_takenAt >= patience && !hasQueue())
        giveUpUnconfirmed();
    return m_overdue > 0;
}

void CanBus::confirm(int count) noexcept
{
    m_unconfirmed -= std::min(count, m_unconfirmed);
    m_overdue -= std::min(count, m_overdue);
}

void CanBus::giveUpUnconfirmed() noexcept
{
    countFailed(quint64(m_unconfirmed));
    m_unconfirmed = m_overdue = 0;
}

void CanBus::countFailed(quint64 count) noexcept
{
    m_counters.sent -= std::min(count, m_counters.sent);
    m_counters.unsent += count;
    m_counters.failed += count;
}

bool CanBus::fail(const QString &error)
{
    m_error = error;
    return false;
}

int CanBus::lose(int errorNumber) noexcept
{
    m_errorNumber = errorNumber;
    return -1;
}

bool CanBus::accepts(const CanFrame &frame) const noexcept
{
    return m_options.receivesAll || frame.has(CanFrame::Error)
        || std::binary_search(m_options.keys.begin(), m_options.keys.end(), frame.key())
        || (frame.has(CanFrame::Extended)
            && std::binary_search(m_options.groups.begin(), m_options.groups.end(), CanFrame::groupOf(frame.id)));
}

void CanBus::noteError(const CanFrame &frame) noexcept
{
    ++m_counters.errorFrames;
    if (isControllerOverflow(frame))
        ++m_counters.lost;
    const State before = m_state;
    m_state = canStateOf(frame, before);
    if (m_state == BusOff && before != BusOff)
        ++m_counters.busOffs;
    if (frame.id & CAN_ERR_RESTARTED)
        giveUpUnconfirmed();  // the restart has emptied the controller
}

}  // namespace qplc
