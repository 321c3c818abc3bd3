// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SetterView.h"

#include <QtCore/QTimer>

class QLabel;
class QSlider;

namespace qplc {

/// A value that is dragged: sent at most 20 times a second on the way, and always where it ends.
class SliderView : public SetterView
{
    Q_OBJECT
public:
    static constexpr int Pause = 50;  // [ms] between two values on the way

    SliderView(SetterTarget *target, QWidget *parent);
    void refresh() override;
    void showActual() override;

private:
    bool hasRange() const { return target().minimum() && target().maximum(); }
    double valueAt(int position) const;
    QString readingAt(int position) const;
    int positionOf(double value) const;
    void moved();
    void send();
    void showWanted();

    QSlider *m_slider;
    QLabel *m_wanted;
    QTimer m_pause;
    bool m_hasSent = false;  // the slider shows what was sent, not what is
    bool m_isShowing = false;
    int m_sentPosition = -1;
};

}  // namespace qplc
