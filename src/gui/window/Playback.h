// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QTimer>

namespace qplc {

/// Plays the recording of a window: moves the playhead of its time axis.
///
/// It plays the selected plant if that is a recording, or else the first recording. A pause between
/// two phases of it is passed over.
///
/// Threads: that of the window.
class Playback : public QObject
{
    Q_OBJECT
public:
    using Time = QPlcTimeAxis::Time;

    static constexpr double SlowestSpeed = 0.1;
    static constexpr double AnySpeed = 0.0;  ///< as fast as it can: the recording in some seconds

    /// \param context  outlives the playback
    explicit Playback(WindowContext *context, QObject *parent = nullptr);

    /// What is played; null: no recording is open.
    Plant *plant() const;
    Time begin() const;
    Time end() const;
    /// The playhead; begin() before there is one.
    Time position() const;

    bool isPlaying() const { return m_timer.isActive(); }
    /// From the begin again when the playhead is at the end.
    void play();
    void pause();
    void toggle();
    /// Seconds of the recording in a second; SlowestSpeed and more, or AnySpeed.
    double speed() const { return m_speed; }
    void setSpeed(double speed);
    /// Plays what is between the two cursors again and again.
    bool isLoop() const { return m_isLoop; }
    void setLoop(bool isLoop);
    /// What a loop plays; the whole recording without two cursors.
    std::pair<Time, Time> loopRange() const;

    /// To a time, the nearest one of the recording.
    void seek(Time time);
    /// To the cycle that is so many behind, or before, the present one.
    void step(int cycles);
    /// Goes on by what is played in \a elapsed [ns].
    void advance(Time elapsed);

Q_SIGNALS:
    /// Another recording, or none; playing or not, the speed, the loop.
    void changed();
    void positionChanged();

private:
    void follow();
    void followRecording(Plant *plant);
    Time withoutPause(Time time) const;

    WindowContext *m_context;
    QTimer m_timer;
    QElapsedTimer m_sinceStep;
    double m_speed = 1.0;
    bool m_isLoop = false;
};

}  // namespace qplc
