// SPDX-License-Identifier: Apache-2.0
#include "CanReceiver.h"

#include "QPlcDriver.h"

#include <algorithm>

namespace qplc {

CanReceiver::CanReceiver(QPlcDriver *driver, const CanMessage &message)
    : m_driver(driver)
    , m_message(message)
    , m_key(CanFrame::keyOf(message.description.id, message.description.isExtended))
    , m_isMultiplexed(message.description.multiplexor >= 0)
{
    if (m_isMultiplexed)
        m_multiplexor = message.description.content.at(message.description.multiplexor);
}

QPlcReadChannel *CanReceiver::channel(const QString &name)
{
    if (name == QLatin1String("@age"))
        return makeOwn(&m_age, name);
    if (name == QLatin1String("@count"))
        return makeOwn(&m_count, name);
    for (const Part &part : m_parts) {
        if (part.signal.name == name)
            return part.channel.get();
    }
    const DbcSignal *signal = m_message.description.find(name);
    if (!signal)
        return nullptr;
    Part part{*signal, nullptr};
    makeOwn(&part.channel, name);
    if (m_message.timeout.count() > 0)
        part.channel->setTimeout(m_message.timeout);
    m_parts.push_back(std::move(part));
    return m_parts.back().channel.get();
}

QPlcReadChannel *CanReceiver::makeOwn(std::unique_ptr<QPlcReadChannel> *channel, const QString &name)
{
    if (!*channel)
        *channel = std::make_unique<QPlcReadChannel>(m_driver, m_message.description.name + QLatin1Char('.') + name);
    return channel->get();
}

void CanReceiver::decode(const CanFrame &frame) noexcept
{
    if (frame.size < m_message.description.size) {
        ++m_tooShort;
        return;
    }
    ++m_frames;
    m_hasFrame = true;
    m_time = frame.time;
    const quint64 page = m_isMultiplexed ? m_multiplexor.bits(frame.data.data()) : 0;
    for (Part &part : m_parts) {
        if (part.signal.role != DbcSignal::Multiplexed || part.signal.multiplexValue == page)
            part.channel->set(part.signal.decode(frame.data.data()), frame.time);
    }
}

void CanReceiver::refresh(qint64 now) noexcept
{
    if (m_age && m_hasFrame)
        m_age->set(double(std::max<qint64>(0, now - m_time)) * 1e-9, now);
    if (m_count)
        m_count->set(double(m_frames), now);
}

void CanReceiver::reset() noexcept
{
    m_hasFrame = false;
}

}  // namespace qplc
