// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QEvent>

namespace qplc {

/// Comes to a panel when pictures of it begin to be made, for a video, and when they end. Meanwhile
/// it leaves out what only a person at the window can use: a button over the curves, say.
class Filming : public QEvent
{
public:
    static constexpr Type Kind = Type(MaxUser - 8);
    enum Moment { Begins, Ends };

    explicit Filming(Moment moment)
        : QEvent(Kind)
        , m_moment(moment)
    {
    }

    Moment moment() const { return m_moment; }

private:
    Moment m_moment;
};

}  // namespace qplc
