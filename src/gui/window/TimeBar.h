// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BarButton.h"

namespace qplc {

/// The time that all panels show, and the span of the plots: frozen and how far behind, or live, as
/// long as there are new values.
class TimeBar : public QWidget
{
    Q_OBJECT
public:
    /// \param context  outlives the bar
    explicit TimeBar(WindowContext *context, QWidget *parent = nullptr);

    /// "Live", "No new values for 12 s", "At rest", "No values", "Recording", or "Frozen, 12.3 s
    /// behind".
    QString stateText() const { return m_state->text(); }
    BarButton *stateButton() const { return m_state; }

    /// Live to frozen, and back.
    void toggle();
    /// Steps through 1 s, 2 s, 5 s, ... \param by  +1: a longer span
    void stepSpan(int by);

private:
    /// What is shown at the left. Texts of one kind differ in their numbers only, and have the same
    /// width.
    struct State
    {
        enum Kind { Live, Partly, Missing, AtRest, Empty, Frozen } kind;
        QString text;
    };
    State stateNow() const;
    State liveState() const;
    bool hasRecordingsAlone() const;
    void show(const State &state);
    void follow();
    void openSpanMenu();

    WindowContext *m_context;
    BarButton *m_state;
    BarButton *m_span;
    QString m_shown;
    State::Kind m_kind = State::Empty;
};

/// "30 s", "5 min", "0.2 ms".
QString spanText(QPlcTimeAxis::Time span);

}  // namespace qplc
