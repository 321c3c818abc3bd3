// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SetterView.h"

class QLabel;
class QwtKnob;

namespace qplc {

/// A value that is turned: sent once when the mouse lets go, or, when wheel or keys have turned it,
/// by Enter. Esc takes the turning back; nothing is overwritten meanwhile.
class KnobView : public SetterView
{
    Q_OBJECT
public:
    KnobView(SetterTarget *target, QWidget *parent);
    void refresh() override;
    void showActual() override;

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    bool hasRange() const
    {
        return target().minimum() && target().maximum() && *target().minimum() < *target().maximum();
    }
    void takeRange();
    void turned();
    void setEdited(bool edited);
    void apply();
    void revert();
    void showWanted();

    QwtKnob *m_knob;
    QLabel *m_wanted;
    bool m_isShowing = false;  // the knob follows the signal
    bool m_isEdited = false;
    bool m_hasSent = false;  // the knob shows what was sent, not what is
};

}  // namespace qplc
