// SPDX-License-Identifier: Apache-2.0
#include "LongMessages.h"

#include <algorithm>
#include <utility>

namespace qplc {

bool LongMessages::admit(Client client, const QString &origin, quint32 length, qint64 now)
{
    bool isTaken = m_arriving.size() >= std::size_t(MostAtOnce);
    for (const Arriving &arriving : m_arriving) {
        if (arriving.client == client)
            return true;
        isTaken = isTaken || arriving.origin == origin;
    }
    if (!isTaken)
        m_arriving.push_back({client, origin, now + Patience + qint64(length) * NanosecondsPerByte});
    else if (std::find(m_waiting.begin(), m_waiting.end(), client) == m_waiting.end())
        m_waiting.push_back(client);
    return !isTaken;
}

std::vector<LongMessages::Client> LongMessages::leave(Client client)
{
    m_waiting.erase(std::remove(m_waiting.begin(), m_waiting.end(), client), m_waiting.end());
    const auto isIt = [client](const Arriving &arriving) { return arriving.client == client; };
    const auto found = std::find_if(m_arriving.begin(), m_arriving.end(), isIt);
    if (found == m_arriving.end())
        return {};
    m_arriving.erase(found);
    return std::exchange(m_waiting, {});
}

std::vector<LongMessages::Client> LongMessages::overdue(qint64 now) const
{
    std::vector<Client> clients;
    for (const Arriving &arriving : m_arriving) {
        if (now >= arriving.deadline)
            clients.push_back(arriving.client);
    }
    return clients;
}

}  // namespace qplc
