// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BarButton.h"
#include "RecordingTimeline.h"

class QLabel;

namespace qplc {

/// The bar of a window in which a recording is open: play, step, speed, loop, and the line of its
/// times. It is hidden while no recording is open.
class PlaybackBar : public QWidget
{
    Q_OBJECT
public:
    /// \param playback, context  outlive the bar
    PlaybackBar(Playback *playback, WindowContext *context, QWidget *parent = nullptr);

    RecordingTimeline *timeline() const { return m_timeline; }
    BarButton *playButton() const { return m_play; }
    BarButton *speedButton() const { return m_speed; }
    BarButton *loopButton() const { return m_loop; }
    /// Slower or faster. \param by  +1: the next faster one
    void stepSpeed(int by);
    /// "1 x", "0.1 x", "As fast as it can".
    static QString speedText(double speed);

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    void follow();
    void followPosition();
    void openSpeedMenu();

    Playback *m_playback;
    WindowContext *m_context;
    BarButton *m_play;
    BarButton *m_speed;
    BarButton *m_loop;
    QLabel *m_time;
    RecordingTimeline *m_timeline;
};

}  // namespace qplc
