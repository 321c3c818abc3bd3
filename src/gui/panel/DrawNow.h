// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QEvent>

namespace qplc {

/// Comes to a panel of which a picture is to be made, for a video: it draws what it shows at once.
/// Otherwise panels draw at the rate that a person can follow.
class DrawNow : public QEvent
{
public:
    static constexpr Type Kind = Type(MaxUser - 7);

    DrawNow()
        : QEvent(Kind)
    {
    }

    /// The panel says that its picture is still to come. It is asked again a little later.
    void setPending() { m_isPending = true; }
    bool isPending() const { return m_isPending; }

private:
    bool m_isPending = false;
};

}  // namespace qplc
