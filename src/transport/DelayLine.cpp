// SPDX-License-Identifier: Apache-2.0
#include "DelayLine.h"

#include <algorithm>
#include <cstring>

namespace qplc {

namespace {

constexpr std::size_t Nowhere = std::numeric_limits<std::size_t>::max();

}  // namespace

DelayLine::DelayLine(std::size_t capacity, std::size_t largestFrame)
    : m_largestFrame(largestFrame)
    , m_bytes(capacity * largestFrame)
    , m_taken(Nowhere)
{
    m_free.reserve(capacity);
    m_waiting.reserve(capacity);
    for (std::size_t i = capacity; i > 0; --i)
        m_free.push_back((i - 1) * largestFrame);
}

bool DelayLine::isLater(const Entry &a, const Entry &b) noexcept
{
    return a.due != b.due ? a.due > b.due : a.number > b.number;
}

char *DelayLine::put(std::int64_t due, void *owner, const char *frame, std::size_t size) noexcept
{
    if (m_free.empty() || size > m_largestFrame)
        return nullptr;
    const std::size_t place = m_free.back();
    m_free.pop_back();
    std::memcpy(m_bytes.data() + place, frame, size);
    m_waiting.push_back({due, m_number++, place, owner, size});
    std::push_heap(m_waiting.begin(), m_waiting.end(), &isLater);
    return m_bytes.data() + place;
}

bool DelayLine::take(std::int64_t now, Frame *frame) noexcept
{
    if (m_taken != Nowhere)
        m_free.push_back(m_taken);
    m_taken = Nowhere;
    if (nextDue() > now || m_waiting.empty())
        return false;
    std::pop_heap(m_waiting.begin(), m_waiting.end(), &isLater);
    const Entry entry = m_waiting.back();
    m_waiting.pop_back();
    m_taken = entry.place;
    *frame = {entry.owner, m_bytes.data() + entry.place, entry.size};
    return true;
}

void DelayLine::forget(const void *owner) noexcept
{
    const auto gone = std::partition(m_waiting.begin(), m_waiting.end(),
                                     [owner](const Entry &entry) { return entry.owner != owner; });
    for (auto entry = gone; entry != m_waiting.end(); ++entry)
        m_free.push_back(entry->place);
    m_waiting.erase(gone, m_waiting.end());
    std::make_heap(m_waiting.begin(), m_waiting.end(), &isLater);
}

}  // namespace qplc
