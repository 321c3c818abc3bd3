// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "signals/ProcessImage.h"

#include <vector>

namespace qplc {

/// Moves signals of a process image towards the values that were set from outside, in each element
/// by at most the `slope` of the table in a second. Takes its memory at the begin; a table without
/// slopes costs nothing.
///
/// One thread at a time.
class SlopeLimits
{
public:
    /// \param image  outlives this object
    explicit SlopeLimits(ProcessImage &image);

    bool isLimited(QPlcSignalIndex signal) const noexcept { return !m_places.empty() && m_places[signal] != None; }
    bool isMoving() const noexcept { return m_moving > 0; }

    /// Moves \a signal from its present value to \a target from now on. \pre isLimited()
    /// \param target  bytes of a value of its type
    void aim(QPlcSignalIndex signal, const char *target) noexcept;
    /// \a signal keeps the value that it has, or gets one from elsewhere.
    void leave(QPlcSignalIndex signal) noexcept;
    void leaveAll() noexcept;
    /// As leave(), for all that are true. \param which  by index; the last ones may be missing
    void leaveAll(const std::vector<bool> &which) noexcept;
    /// Moves all signals for \a seconds.
    void advance(double seconds) noexcept;
    /// Gives all signals the values to which they move.
    void finish() noexcept;

private:
    static constexpr quint16 None = 0xFFFF;

    struct Signal
    {
        quint32 offset = 0;  // [byte] in the image
        QPlcSignalIndex index = 0;
        std::size_t first = 0;
        std::size_t count = 0;  // of elements
        double slope = 0.0;     // per second
        bool isFloat = false;
        bool isMoving = false;
    };

    double valueOf(const Signal &signal, const char *bytes, std::size_t element) const noexcept;
    void write(const Signal &signal, std::size_t element) noexcept;
    bool step(const Signal &signal, double largest) noexcept;

    char *m_image;
    std::vector<Signal> m_signals;
    std::vector<quint16> m_places;  // by index of a signal; empty: none is limited
    std::vector<double> m_present;  // of all elements: what a float has lost is kept
    std::vector<double> m_targets;
    std::size_t m_moving = 0;
};

}  // namespace qplc
