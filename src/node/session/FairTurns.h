// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "realtime/TimeSource.h"

#include <deque>
#include <functional>
#include <vector>

namespace qplc {

/// Serves clients one after the other, in small steps, so that none waits for all that another one
/// has asked. What counts is time: each client gets a quantum of it in a round, and who has used
/// more waits until it is paid back. A turn ends when its time is over; then its owner looks at the
/// world before the next one.
///
/// One thread. A step may add and remove clients, or begin a turn in an event loop of its own.
class FairTurns
{
public:
    using Client = void *;
    static constexpr std::int64_t Quantum = 1'000'000;  // [ns]
    static constexpr std::int64_t Turn = 4'000'000;     // [ns] the last step may end later

    /// \param step  does a small piece of what a client wants. \return whether there is more
    /// \param time  outlives this object
    explicit FairTurns(std::function<bool(Client)> step, TimeSource &time = TimeSource::monotonic());

    /// \a client wants something.
    void add(Client client);
    void remove(Client client);
    bool isEmpty() const { return m_waiting.empty(); }
    std::vector<Client> waiting() const;
    /// Serves those who wait, until the time of a turn is over or nobody wants anything more.
    void serve();

private:
    struct Place
    {
        Client client = nullptr;  // null: removed while it was served
        std::int64_t credit = 0;  // [ns] below 0: it has used more than its share
    };
    bool serve(Place *place);
    bool isWaiting(Client client) const;

    std::function<bool(Client)> m_step;
    TimeSource &m_time;
    std::deque<Place> m_waiting;
    std::vector<Place *> m_served;  // the last one is served now, the others called its event loop
};

}  // namespace qplc
