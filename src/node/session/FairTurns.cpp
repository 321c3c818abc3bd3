// SPDX-License-Identifier: Apache-2.0
#include "FairTurns.h"

#include <algorithm>

namespace qplc {

FairTurns::FairTurns(std::function<bool(Client)> step, TimeSource &time)
    : m_step(std::move(step))
    , m_time(time)
{
}

void FairTurns::add(Client client)
{
    if (!isWaiting(client))
        m_waiting.push_back({client});
}

void FairTurns::remove(Client client)
{
    const auto isIt = [client](const Place &place) { return place.client == client; };
    m_waiting.erase(std::remove_if(m_waiting.begin(), m_waiting.end(), isIt), m_waiting.end());
    for (Place *place : m_served) {
        if (place->client == client)
            place->client = nullptr;
    }
}

bool FairTurns::isWaiting(Client client) const
{
    return std::any_of(m_waiting.begin(), m_waiting.end(),
                       [client](const Place &place) { return place.client == client; });
}

std::vector<FairTurns::Client> FairTurns::waiting() const
{
    std::vector<Client> clients;
    for (const Place &place : m_waiting)
        clients.push_back(place.client);
    return clients;
}

void FairTurns::serve()
{
    const std::int64_t end = m_time.now() + Turn;
    while (!m_waiting.empty()) {
        Place place = m_waiting.front();
        m_waiting.pop_front();
        m_served.push_back(&place);
        const bool wantsMore = serve(&place);
        m_served.pop_back();
        if (wantsMore && place.client && !isWaiting(place.client))
            m_waiting.push_back(place);
        if (m_time.now() >= end)
            break;
    }
}

/// Serves one client for its quantum. \return whether it wants more
bool FairTurns::serve(Place *place)
{
    place->credit = std::min(place->credit + Quantum, Quantum);
    bool wantsMore = true;
    for (std::int64_t before = m_time.now(); wantsMore && place->client && place->credit > 0;) {
        wantsMore = m_step(place->client);
        const std::int64_t now = m_time.now();
        place->credit -= now - before;
        before = now;
    }
    return wantsMore;
}

}  // namespace qplc
