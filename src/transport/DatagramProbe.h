// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QTimer>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace qplc {

class CyclicLink;

/// Numbers by which two ends recognise their datagrams while a node looks whether these travel both
/// ways: random, for one registration. The question does not tell the answer.
struct ProbeNumbers
{
    std::uint64_t question = 0;
    std::uint64_t answer = 0;
};

/// A node's end: asks over its link until an answer comes, or gives up.
///
/// Thread of the node.
class DatagramProbe
{
public:
    static constexpr int Questions = 20;
    static constexpr int Interval = 25;  // [ms] from one to the next

    /// \param size  of a question [byte]; shorter ones are not made than the numbers need
    /// \param done  told once whether an answer came; may destroy this object
    DatagramProbe(CyclicLink &link, const ProbeNumbers &numbers, std::size_t size, std::function<void(bool)> done);

private:
    void look();
    void ask();
    bool hasAnswer();

    CyclicLink &m_link;
    const ProbeNumbers m_numbers;
    const std::vector<char> m_question;
    std::function<void(bool)> m_done;
    int m_looks = 1;
    QTimer m_timer;
};

/// The master's end: answers the questions of one node, until it is destroyed. A transport sends
/// and receives.
///
/// Thread of the master.
class ProbeAnswers
{
public:
    static constexpr int MostAnswers = 2 * DatagramProbe::Questions;  // networks repeat datagrams

    explicit ProbeAnswers(const ProbeNumbers &numbers)
        : m_numbers(numbers)
    {
    }
    virtual ~ProbeAnswers();
    ProbeAnswers(const ProbeAnswers &) = delete;
    ProbeAnswers &operator=(const ProbeAnswers &) = delete;

    /// Questions that have arrived so far.
    int questions() const { return m_questions; }

protected:
    /// Makes an answer of \a datagram, of the same length. \return false when it is not the
    /// question, or there were enough of them
    bool answer(char *datagram, std::size_t size) noexcept;

private:
    const ProbeNumbers m_numbers;
    int m_questions = 0;
};

}  // namespace qplc
