// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BarButton.h"

namespace qplc {

/// The time that all panels show: live or frozen and how far behind, and the span of the plots.
class TimeBar : public QWidget
{
    Q_OBJECT
public:
    /// \param context  outlives the bar
    explicit TimeBar(WindowContext *context, QWidget *parent = nullptr);

    /// "Live", or "Frozen, 12.3 s behind".
    QString stateText() const { return m_state->text(); }
    BarButton *stateButton() const { return m_state; }
    BarButton *spanButton() const { return m_span; }

    /// Live to frozen, and back.
    void toggle();
    /// Steps through 1 s, 2 s, 5 s, ... \param by  +1: a longer span
    void stepSpan(int by);

private:
    void follow();
    void openSpanMenu();

    WindowContext *m_context;
    BarButton *m_state;
    BarButton *m_span;
    QString m_shown;
};

/// "30 s", "5 min", "0.2 ms".
QString spanText(TimeView::Time span);

}  // namespace qplc
