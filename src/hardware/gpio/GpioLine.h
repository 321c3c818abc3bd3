// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace qplc {

/// How a line of a GPIO chip is wanted.
struct GpioLineRequest
{
    enum Pull : quint8 { AsItIs, NoPull, PullUp, PullDown };

    QString line;  // its number ("17") or its name ("GPIO17")
    bool isOutput = false;
    bool isActiveLow = false;  // on is the low level
    bool isOpenDrain = false;  // outputs: the high level is not driven
    Pull pull = AsItIs;        // inputs
    bool wantsEdges = false;   // inputs: edges are kept with their times until takeEdges()
    bool isOn = false;         // outputs: from the first instant on
};

/// A change of an input, as its chip saw it.
struct GpioEdge
{
    bool isOn = false;  // after it
    qint64 time = 0;    // on the monotonic clock [ns]
};

/// A line of a GPIO chip that belongs to us; it is let go by the destructor. On and off are as the
/// request says (active-low).
///
/// No function waits or takes memory. They return false or -1, with errno, when the chip is gone.
class GpioLine
{
public:
    GpioLine() = default;
    virtual ~GpioLine() = default;
    GpioLine(const GpioLine &) = delete;
    GpioLine &operator=(const GpioLine &) = delete;

    /// \return 1 when the line is on, 0 when it is off, -1
    virtual int value() noexcept = 0;
    virtual bool setValue(bool isOn) noexcept = 0;
    /// Edges since the last call, oldest first. \return how many, at most \a most; 0: there are no
    /// more; -1
    virtual int takeEdges(GpioEdge *edges, int most) noexcept = 0;
};

}  // namespace qplc
