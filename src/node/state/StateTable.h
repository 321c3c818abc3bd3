// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace qplc {

/// What becomes of an event in a state.
enum class Verdict : std::uint8_t {
    Accepted,  ///< the state becomes `next`, and `action` is carried out
    Ignored,   ///< nothing: it comes too late, or has no meaning here
    Refused    ///< nothing changes, and who asked is told `text`
};

template<typename State, typename Action>
struct StateCell
{
    Verdict verdict = Verdict::Ignored;
    State next{};
    Action action{};
    const char *text = "";  ///< of a refusal; "%1" stands for the reason of the present state
};

/// A row as it is written down: what becomes of one event in some states.
template<typename State, typename Event, typename Action>
struct StateRule
{
    Event event{};
    std::uint32_t states = 0;  ///< a bit for each of them
    StateCell<State, Action> cell{};
    bool stays = false;  ///< accepted, and the state remains what it is
};

/// Every state x every event: the table that drives the code, that its test walks through and that
/// its page is made of.
///
/// Made of rules at compile time. Rules are complete when each pair has exactly one; check it with
/// a static_assert(isComplete()).
template<typename State, typename Event, typename Action, std::size_t States, std::size_t Events>
class StateTable
{
public:
    using Cell = StateCell<State, Action>;
    using Rule = StateRule<State, Event, Action>;
    static constexpr std::size_t StateCount = States;
    static constexpr std::size_t EventCount = Events;

    template<std::size_t Rules>
    constexpr explicit StateTable(const Rule (&rules)[Rules])
    {
        for (const Rule &rule : rules) {
            for (std::size_t state = 0; state < States; ++state) {
                if (((rule.states >> state) & 1U) == 0)
                    continue;
                const std::size_t place = state * Events + std::size_t(rule.event);
                m_cells[place] = rule.cell;
                if (rule.stays || rule.cell.verdict != Verdict::Accepted)
                    m_cells[place].next = State(state);
                ++m_rules[place];
            }
        }
    }

    constexpr const Cell &at(State state, Event event) const
    {
        return m_cells[std::size_t(state) * Events + std::size_t(event)];
    }

    /// Whether each pair of state and event has one rule, no more and no less.
    constexpr bool isComplete() const
    {
        for (const std::uint8_t rules : m_rules) {
            if (rules != 1)
                return false;
        }
        return true;
    }

private:
    std::array<Cell, States * Events> m_cells{};
    std::array<std::uint8_t, States * Events> m_rules{};
};

/// How rules are written:
/// `on(Event::Stop, in(State::Off, State::Ready), go(State::Off, Action::Forget))`.
template<typename State, typename Event, typename Action>
struct StateRules
{
    using Rule = StateRule<State, Event, Action>;
    struct Outcome
    {
        StateCell<State, Action> cell{};
        bool stays = false;
    };

    template<typename... More>
    static constexpr std::uint32_t in(State first, More... more)
    {
        return (1U << unsigned(first)) | (0U | ... | (1U << unsigned(more)));
    }
    static constexpr Outcome go(State next, Action action = Action{})
    {
        return {{Verdict::Accepted, next, action, ""}, false};
    }
    static constexpr Outcome stay(Action action = Action{}) { return {{Verdict::Accepted, State{}, action, ""}, true}; }
    static constexpr Outcome ignore() { return {{Verdict::Ignored, State{}, Action{}, ""}, false}; }
    static constexpr Outcome refuse(const char *text) { return {{Verdict::Refused, State{}, Action{}, text}, false}; }
    static constexpr Rule on(Event event, std::uint32_t states, Outcome outcome)
    {
        return {event, states, outcome.cell, outcome.stays};
    }
};

}  // namespace qplc
