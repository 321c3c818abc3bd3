// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Formula.h"

#include <cstdint>
#include <deque>

namespace qplc {

/// A function with a past: Formula says which there are and what they give.
class PastFilter
{
public:
    using Time = std::int64_t;  // [ns]

    PastFilter(Formula::Function function, double seconds);

    /// The next row comes after an interruption. One of at most longestLoss is as a NaN: cycles
    /// were lost. After a longer one everything begins anew.
    void interrupt() { m_isInterrupted = true; }
    static constexpr Time longestLoss = 500'000'000;
    /// \param time  after that of the row before
    double next(Time time, double value);

private:
    struct Row
    {
        Time time;
        double value;
    };

    double derivative(Row row) const;
    double integral(Row row);
    double lowPass(Row row);
    double mean(Row row);
    void goOnAt(Time time);
    void forgetBefore(Time time);
    double secondsTo(Time time) const { return double(time - m_last.time) * 1e-9; }

    Formula::Function m_function;
    double m_seconds;
    bool m_isInterrupted = false;
    bool m_hasLast = false;
    Row m_last{0, 0.0};     // the row before; its value, if it had one
    double m_result = 0.0;  // of integral and low-pass
    double m_weightTime = 0.0;
    double m_weight = 0.0;  // of a new value in the low-pass, for rows that are m_weightTime apart
    std::deque<Row> m_window;
    double m_sum = 0.0;           // of the window
    std::size_t m_forgotten = 0;  // rows since the sum was made anew
};

}  // namespace qplc
