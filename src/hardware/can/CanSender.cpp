// SPDX-License-Identifier: Apache-2.0
#include "CanSender.h"

#include "QPlcDriver.h"

#include <algorithm>

namespace qplc {

CanSender::CanSender(QPlcDriver *driver, const CanMessage &message)
    : m_driver(driver)
    , m_message(message)
    , m_key(CanFrame::keyOf(message.sentId(), message.description.isExtended))
    , m_counter(m_message.description.find(m_message.protection.counter))
    , m_checksum(m_message.description.find(m_message.protection.checksum))
    , m_period(message.rule.period.count())
    , m_gap(message.rule.gap.count())
{
    for (const DbcSignal &signal : message.description.content) {
        if (signal.isMultiplexor)
            m_multiplexors.push_back(signal);
    }
    std::stable_sort(m_multiplexors.begin(), m_multiplexors.end(), [this](const DbcSignal &a, const DbcSignal &b) {
        return m_message.description.depthOf(a) < m_message.description.depthOf(b);
    });
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
    return m_parts.back().channel.get();
}

QString CanSender::overlapWith(const DbcSignal &signal) const
{
    const auto found = std::find_if(m_parts.begin(), m_parts.end(), [this, &signal](const Part &part) {
        return part.signal.name != signal.name && m_message.description.overlap(part.signal, signal);
    });
    return found == m_parts.end() ? QString() : found->signal.name;
}

void CanSender::prepare()
{
    const DbcMessage &description = m_message.description;
    const auto rank = [&description](const Part &part) {
        return part.signal.isMultiplexor ? description.depthOf(part.signal) : description.content.size() + 1;
    };
    std::stable_sort(m_parts.begin(), m_parts.end(),
                     [&rank](const Part &a, const Part &b) { return rank(a) < rank(b); });
    m_selectors = std::size_t(
        std::count_if(m_parts.begin(), m_parts.end(), [](const Part &part) { return part.signal.isMultiplexor; }));
    m_pages.clear();
    for (const bool hasChoice : {false, true}) {
        for (const Part &part : m_parts) {
            const auto has = [&](const Page &page) { return description.isThere(part.signal, page.empty.data.data()); };
            if (!part.signal.isMultiplexed() || hasOneValue(part.signal) == hasChoice
                || std::any_of(m_pages.begin(), m_pages.end(), has))
                continue;
            const CanFrame frame = emptyFrame(&part.signal);
            m_pages.push_back({frame, frame, frame, true});
        }
    }
    if (m_pages.empty()) {
        const CanFrame frame = emptyFrame(nullptr);
        m_pages.push_back({frame, frame, frame, true});
    }
    std::sort(m_pages.begin(), m_pages.end(), [this](const Page &a, const Page &b) { return isBefore(a, b); });
}

bool CanSender::hasOneValue(const DbcSignal &signal)
{
    return signal.pages.size() == 1 && signal.pages.first().first == signal.pages.first().last;
}

bool CanSender::isBefore(const Page &a, const Page &b) const noexcept
{
    for (const DbcSignal &multiplexor : m_multiplexors) {
        const quint64 valueOfA = multiplexor.bits(a.empty.data.data());
        const quint64 valueOfB = multiplexor.bits(b.empty.data.data());
        if (valueOfA != valueOfB)
            return valueOfA < valueOfB;
    }
    return false;
}

// With the values that signals have before anybody writes them, on the page of a signal.
CanFrame CanSender::emptyFrame(const DbcSignal *onPage) const
{
    const DbcMessage &description = m_message.description;
    CanFrame frame;
    frame.id = m_message.sentId();
    frame.size = quint8(description.size);
    frame.flags = quint8((description.isExtended ? CanFrame::Extended : 0) | (description.isFd ? CanFrame::Fd : 0)
                         | (description.isFd && description.hasBitRateSwitch ? CanFrame::BitRateSwitch : 0));
    quint8 *data = frame.data.data();
    for (const DbcSignal &multiplexor : m_multiplexors) {
        if (!description.isThere(multiplexor, data))
            continue;
        multiplexor.encodeRaw(data, multiplexor.initial);
        for (const DbcSignal *part = onPage; part && part->multiplexor >= 0;) {
            const DbcSignal &selector = description.content.at(part->multiplexor);
            if (selector.name == multiplexor.name)
                multiplexor.setBits(data, part->pages.first().first);
            part = &selector;
        }
    }
    for (const DbcSignal &signal : description.content) {
        if (!signal.isMultiplexor && signal.initial != 0.0 && description.isThere(signal, data))
            signal.encodeRaw(data, signal.initial);
    }
    return frame;
}

void CanSender::reset() noexcept
{
    m_isFirst = true;
    m_isRequested = false;
    m_isPending = false;
    m_wasSafe = false;
    m_hasSent = false;
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
    page->frame.data = page->empty.data;
    for (const Part &part : m_parts)  // multiplexors first: the others are there, or not
        encodePart(page, part);
}

void CanSender::encodePart(Page *page, const Part &part) noexcept
{
    quint8 *data = page->frame.data.data();
    if (m_message.description.isThere(part.signal, data)
        && part.signal.encode(data, part.channel->value()) != DbcSignal::Fits)
        page->fits = false;
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

// A wired multiplexor has put its value into the frame, and only its page has the same one.
bool CanSender::isSelected(const Page &page) const noexcept
{
    if (m_pages.size() == 1)
        return true;
    return std::all_of(m_parts.begin(), m_parts.begin() + std::ptrdiff_t(m_selectors), [this, &page](const Part &part) {
        const quint8 *empty = page.empty.data.data();
        return !m_message.description.isThere(part.signal, empty)
            || part.signal.bits(empty) == part.signal.bits(page.frame.data.data());
    });
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

bool CanSender::isTooEarly(qint64 now) const noexcept
{
    // A cycle that begins a bit early is the right one, as above.
    return m_hasSent && now - m_sentAt < m_gap - m_gap / 100;
}

// The checksum is made last: the counter is a part of it.
void CanSender::protect(CanFrame *frame, int number) const noexcept
{
    const CanProtection &protection = m_message.protection;
    if (m_counter)
        m_counter->setBits(frame->data.data(), (m_counted + quint64(number)) % (protection.mostCounted + 1));
    if (m_checksum)
        m_checksum->setBits(frame->data.data(), protection.checksumOf(frame->data.data(), frame->size));
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
    bool isDueNow = isDue(now) || isFirst || isSafeNews;  // in this order: the period goes on
    if (isDueNow && !isSafeNews && isTooEarly(now)) {
        isDueNow = false;
        m_isPending = true;
    }
    m_isFirst = false;
    m_wasSafe = isSafeNow;
    m_now = now;
    int count = 0;
    for (const Page &page : m_pages) {
        if (!isDueNow || !isSelected(page))
            continue;
        frames[count] = page.frame;
        protect(&frames[count], count);
        ++count;
        m_saturated += page.fits ? 0 : 1;
    }
    m_frames = count;
    return count;
}

void CanSender::sent(bool isTaken) noexcept
{
    m_isPending = !isTaken;
    if (!isTaken)
        return;
    m_isRequested = false;
    m_hasSent = true;
    m_sentAt = m_now;
    m_counted += quint64(m_frames);
    for (Page &page : m_pages) {
        if (isSelected(page))
            page.last = page.frame;
    }
}

}  // namespace qplc
