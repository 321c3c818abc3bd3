// SPDX-License-Identifier: Apache-2.0
#include "DatagramProbe.h"

#include "CyclicLink.h"

#include <QtCore/qendian.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace qplc {

namespace {

// A datagram: these bytes, a number, and zeros. No frame begins like this: CyclicFrame.h.
constexpr std::array<char, 4> mark{'Q', 'P', 'L', 'P'};
constexpr std::size_t leastSize = mark.size() + sizeof(std::uint64_t);

constexpr int looksPerQuestion = 5;
constexpr int readsPerLook = 32;  // a flood does not keep the node from other work

void setNumber(char *datagram, std::uint64_t number)
{
    qToLittleEndian<quint64>(number, datagram + mark.size());
}

bool hasNumber(const char *datagram, std::size_t size, std::uint64_t number)
{
    return size >= leastSize && std::memcmp(datagram, mark.data(), mark.size()) == 0
        && qFromLittleEndian<quint64>(datagram + mark.size()) == number;
}

std::vector<char> datagramOf(std::uint64_t number, std::size_t size)
{
    std::vector<char> datagram(std::max(size, leastSize));
    std::copy(mark.begin(), mark.end(), datagram.begin());
    setNumber(datagram.data(), number);
    return datagram;
}

}  // namespace

// ---- the node ----

DatagramProbe::DatagramProbe(CyclicLink &link, const ProbeNumbers &numbers, std::size_t size,
                             std::function<void(bool)> done)
    : m_link(link)
    , m_numbers(numbers)
    , m_question(datagramOf(numbers.question, size))
    , m_done(std::move(done))
{
    QObject::connect(&m_timer, &QTimer::timeout, &m_timer, [this] { look(); });
    m_timer.setTimerType(Qt::PreciseTimer);
    m_timer.start(Interval / looksPerQuestion);
    ask();
}

void DatagramProbe::look()
{
    const bool isAnswered = hasAnswer();
    if (isAnswered || m_looks == Questions * looksPerQuestion) {
        m_timer.stop();
        const auto done = std::move(m_done);
        done(isAnswered);
        return;
    }
    if (m_looks % looksPerQuestion == 0)
        ask();
    ++m_looks;
}

void DatagramProbe::ask()
{
    m_link.send(m_question.data(), m_question.size());
}

bool DatagramProbe::hasAnswer()
{
    const char *datagram = nullptr;
    std::size_t size = 0;
    for (int i = 0; i < readsPerLook && m_link.poll(&datagram, &size) == CyclicLink::Received; ++i) {
        if (hasNumber(datagram, size, m_numbers.answer))
            return true;
    }
    return false;
}

// ---- the master ----

ProbeAnswers::~ProbeAnswers() = default;

bool ProbeAnswers::answer(char *datagram, std::size_t size) noexcept
{
    if (m_questions == MostAnswers || !hasNumber(datagram, size, m_numbers.question))
        return false;
    ++m_questions;
    setNumber(datagram, m_numbers.answer);
    return true;
}

}  // namespace qplc
