// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BarButton.h"
#include "ControlNotice.h"
#include "FlatToolBar.h"
#include "PlantSelector.h"
#include "StateStepper.h"

namespace qplc {

/// What is always there, above everything: the selected plant, where its master is, the one next
/// thing to do, who controls by hand, and STOP. It cannot be moved or hidden.
class TopBar : public FlatToolBar
{
    Q_OBJECT
public:
    /// \param selection, context  outlive the bar
    TopBar(PlantSelection *selection, WindowContext *context, QWidget *parent = nullptr);

    PlantSelector *selector() const { return m_selector; }
    StateStepper *stepper() const { return m_stepper; }
    BarButton *nextButton() const { return m_next; }
    ControlNotice *controlNotice() const { return m_control; }
    BarButton *stopButton() const { return m_stop; }

Q_SIGNALS:
    void nextRequested();
    void stopRequested();

private:
    void follow();

    PlantSelection *m_selection;
    PlantSelector *m_selector;
    StateStepper *m_stepper;
    BarButton *m_next;
    ControlNotice *m_control;
    BarButton *m_stop;
};

/// The plants that STOP means, by name; with a question mark where there are several and the window
/// will ask.
QString stopText(const PlantSelection &selection);

}  // namespace qplc
