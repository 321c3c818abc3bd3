// SPDX-License-Identifier: Apache-2.0
#include "CanReceiver.h"

#include "QPlcDriver.h"

#include <algorithm>

namespace qplc {

CanReceiver::CanReceiver(QPlcDriver *driver, const CanMessage &message)
    : m_driver(driver)
    , m_message(message)
    , m_key(CanFrame::keyOf(message.description.id, message.description.isExtended))
    , m_counter(m_message.description.find(m_message.protection.counter))
    , m_checksum(m_message.description.find(m_message.protection.checksum))
{
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

bool CanReceiver::isSound(const CanFrame &frame) noexcept
{
    const quint8 *data = frame.data.data();
    const CanProtection &protection = m_message.protection;
    if (m_checksum && m_checksum->bits(data) != protection.checksumOf(data, m_message.description.size))
        return false;
    if (!m_counter)
        return true;
    const quint64 before = m_counted;
    m_counted = m_counter->bits(data);
    return !m_hasFrame || m_counted != before;
}

void CanReceiver::decode(const CanFrame &frame) noexcept
{
    const DbcMessage &description = m_message.description;
    if (!m_message.accepts(frame.id))
        return;
    if (frame.size < description.size) {
        ++m_tooShort;
        return;
    }
    if (m_message.sharesId && !description.hasPage(frame.data.data()))
        return;
    if (!isSound(frame)) {
        ++m_corrupt;
        return;
    }
    ++m_frames;
    m_hasFrame = true;
    m_time = frame.time;
    for (Part &part : m_parts) {
        if (description.isThere(part.signal, frame.data.data()))
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
