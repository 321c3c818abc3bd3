// SPDX-License-Identifier: Apache-2.0
#include "CanPartner.h"

#include "realtime/CycleClock.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <poll.h>
#include <unistd.h>

CanPartner::CanPartner(const QString &device, int frames, qint64 period)
    : m_device(device)
    , m_period(period)
    , m_outgoing(std::size_t(frames))
    , m_next(std::size_t(frames))
{
    for (std::size_t i = 0; i < m_outgoing.size(); ++i) {
        m_outgoing[i].id = CanStamp::FromPartner + quint32(i);
        m_outgoing[i].size = CanStamp::Size;
    }
}

bool CanPartner::run()
{
    qplc::CanBus::Options options;
    options.receivesAll = true;
    m_bus = qplc::CanBus::make(m_device, &m_error);
    if (!m_bus)
        return false;
    if (!m_bus->open(options)) {
        m_error = m_bus->errorString();
        return false;
    }
    std::puts("ready");
    std::fflush(stdout);
    qplc::CycleClock clock(qplc::TimeSource::monotonic(), m_period);
    clock.start();
    int quiet = 0;
    while (quiet < 200) {  // periods: what is under way arrives
        clock.next([] { return false; });
        pollfd input{STDIN_FILENO, POLLIN, 0};
        quiet = poll(&input, 1, 0) > 0 ? quiet + 1 : 0;
        if (!step(quiet == 0))
            return false;
    }
    return true;
}

bool CanPartner::step(bool isSending)
{
    std::array<qplc::CanFrame, 64> frames;
    int count = 0;
    do {
        count = m_bus->receive(frames.data(), int(frames.size()));
        for (int i = 0; i < count; ++i)
            receive(frames[std::size_t(i)]);
    } while (count == int(frames.size()));
    if (!isSending || m_lastId == 0)
        return count >= 0;
    const qint64 begin = qplc::monotonicNow() / 1000;  // [us]
    const quint64 stamp = CanStamp{++m_count, quint32(begin), m_took}.packed();
    for (qplc::CanFrame &frame : m_outgoing)
        std::memcpy(frame.data.data(), &stamp, sizeof stamp);
    const bool isSent = m_bus->send(m_outgoing.data(), int(m_outgoing.size())) >= 0;
    m_took = quint32(std::min<qint64>(qplc::monotonicNow() / 1000 + 1 - begin, CanStamp::LongestTook));
    return count >= 0 && isSent;
}

void CanPartner::receive(const qplc::CanFrame &frame)
{
    const quint32 message = frame.id - CanStamp::ToPartner;
    if (message >= m_next.size())
        return;
    const quint32 count = CanStamp::countOf(frame);
    quint32 &next = m_next[message];
    const bool isInTurn = m_lastId == 0 || frame.id == m_lastId + 1 || message == 0;
    if (next != 0 && count > next)
        m_lost += count - next;
    if ((next != 0 && count < next) || !isInTurn)
        ++m_reordered;
    next = count + 1;
    m_lastId = frame.id;
}

QJsonObject CanPartner::result() const
{
    const qplc::CanBus::Counters &counters = m_bus->counters();
    return {{QStringLiteral("sent"), double(counters.sent)},
            {QStringLiteral("unsent"), double(counters.unsent)},
            {QStringLiteral("received"), double(counters.received)},
            {QStringLiteral("lost"), double(m_lost + counters.lost)},
            {QStringLiteral("reordered"), double(m_reordered)}};
}
