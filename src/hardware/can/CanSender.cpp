// SPDX-License-Identifier: Apache-2.0
#include "CanSender.h"

#include "QPlcDriver.h"

#include <algorithm>

namespace qplc {

CanSender::CanSender(QPlcDriver *driver, const CanMessage &message)
    : m_driver(driver)
    , m_message(message)
    , m_key(CanFrame::keyOf(message.description.id, message.description.isExtended))
    , m_isMultiplexed(message.description.multiplexor >= 0)
    , m_period(message.rule.period.count())
{
    if (m_isMultiplexed)
        m_multiplexor = message.description.content.at(message.description.multiplexor);
}

QPlcWriteChannel *CanSender::channel(const QString &name)
{
    for (const Part &part : m_parts) {
        if (part.signal.name == name)
            return part.channel.get();
    }
    const DbcSignal *signal = m_message.description.find(name);
    if (!signal)
        return nullptr;
    m_parts.push_back(
        {*signal, std::make_unique<QPlcWriteChannel>(m_driver, m_message.description.name + QLatin1Char('.') + name)});
    const RawNumber::Limits limits = signal->limits();
    m_parts.back().channel->setRange(limits.lowest, limits.highest);
    if (signal->role == DbcSignal::Multiplexor)
        m_selector = m_parts.back().channel.get();
    return m_parts.back().channel.get();
}

QString CanSender::overlapWith(const DbcSignal &signal) const
{
    const auto found = std::find_if(m_parts.begin(), m_parts.end(), [&signal](const Part &part) {
        return part.signal.name != signal.name && part.signal.overlaps(signal);
    });
    return found == m_parts.end() ? QString() : found->signal.name;
}

void CanSender::prepare()
{
    std::vector<quint64> values;
    for (const Part &part : m_parts) {
        if (part.signal.role == DbcSignal::Multiplexed)
            values.push_back(part.signal.multiplexValue);
    }
    if (values.empty())
        values.push_back(m_isMultiplexed ? static_cast<quint64>(std::max(0.0, m_multiplexor.initial)) : 0);
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    m_pages.clear();
    for (const quint64 value : values) {
        const CanFrame frame = emptyFrame(value);
        m_pages.push_back({value, frame, frame, true});
    }
}

// With the values that signals have before anybody writes them.
CanFrame CanSender::emptyFrame(quint64 page) const
{
    const DbcMessage &description = m_message.description;
    CanFrame frame;
    frame.id = description.id;
    frame.size = quint8(description.size);
    frame.flags = quint8((description.isExtended ? CanFrame::Extended : 0) | (description.isFd ? CanFrame::Fd : 0)
                         | (description.isFd && description.hasBitRateSwitch ? CanFrame::BitRateSwitch : 0));
    for (const DbcSignal &signal : description.content) {
        const bool isThere = signal.role != DbcSignal::Multiplexed || signal.multiplexValue == page;
        if (isThere && signal.initial != 0.0)
            signal.encodeRaw(frame.data.data(), signal.initial);
    }
    if (m_isMultiplexed)
        m_multiplexor.setBits(frame.data.data(), page);
    return frame;
}

void CanSender::reset() noexcept
{
    m_isFirst = true;
    m_isRequested = false;
    m_isPending = false;
    m_wasSafe = false;
}

bool CanSender::hasValues() const noexcept
{
    return std::all_of(m_parts.begin(), m_parts.end(), [](const Part &part) { return part.channel->hasValue(); });
}

bool CanSender::isSafe() const noexcept
{
    return std::any_of(m_parts.begin(), m_parts.end(), [](const Part &part) { return part.channel->isSafe(); });
}

void CanSender::encodePage(Page *page) noexcept
{
    page->fits = true;
    for (const Part &part : m_parts) {
        const bool isThere = part.signal.role != DbcSignal::Multiplexed || part.signal.multiplexValue == page->value;
        if (isThere && part.signal.encode(page->frame.data.data(), part.channel->value()) != DbcSignal::Fits)
            page->fits = false;
    }
}

// Whether something is to be sent that has not been sent before.
bool CanSender::encode() noexcept
{
    bool hasChanged = false;
    for (Page &page : m_pages) {
        encodePage(&page);
        hasChanged = hasChanged || (isSelected(page) && page.frame.data != page.last.data);
    }
    return hasChanged;
}

bool CanSender::isSelected(const Page &page) const noexcept
{
    return !m_selector || m_pages.size() == 1 || m_multiplexor.bits(page.frame.data.data()) == page.value;
}

bool CanSender::isDue(qint64 now) noexcept
{
    const CanSendRule &rule = m_message.rule;
    // A cycle that begins a bit early is the right one, else a period of ten cycles would now and
    // then be eleven.
    const qint64 tolerance = std::min((now - m_now) / 2, m_period / 2);
    const bool isTime = m_period > 0 && now + tolerance >= m_next;
    if (isTime)
        m_next = m_next + m_period > now ? m_next + m_period : now + m_period;
    return rule.everyCycle || isTime || (rule.onChange && m_hasChanged) || m_isRequested || m_isPending;
}

int CanSender::collect(qint64 now, CanFrame *frames) noexcept
{
    if (!hasValues())
        return 0;
    m_hasChanged = encode();
    const bool isSafeNow = isSafe();
    const bool isFirst = m_isFirst && !(m_message.rule.onRequest && m_period == 0 && !m_message.rule.everyCycle);
    if (m_isFirst) {
        m_next = now;
        m_now = now;
    }
    const bool isSafeNews = isSafeNow && !m_wasSafe;
    const bool isDueNow = isDue(now) || isFirst || isSafeNews;  // in this order: the period goes on
    m_isFirst = false;
    m_wasSafe = isSafeNow;
    m_now = now;
    int count = 0;
    for (const Page &page : m_pages) {
        if (!isDueNow || !isSelected(page))
            continue;
        frames[count++] = page.frame;
        m_saturated += page.fits ? 0 : 1;
    }
    return count;
}

void CanSender::sent(bool isTaken) noexcept
{
    m_isPending = !isTaken;
    if (!isTaken)
        return;
    m_isRequested = false;
    for (Page &page : m_pages) {
        if (isSelected(page))
            page.last = page.frame;
    }
}

}  // namespace qplc
