// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Playback.h"

#include <QtWidgets/QWidget>

namespace qplc {

/// The whole of a recording as a line: what the plots show of it, the playhead, the cursors, and a
/// tick for each event, whose text is shown under the pointer. A click or a drag moves the
/// playhead.
///
/// Keys: left and right step a cycle, page up and page down a screen, home and end go to the ends.
class RecordingTimeline : public QWidget
{
    Q_OBJECT
public:
    using Time = Playback::Time;

    /// \param playback, context  outlive the widget
    RecordingTimeline(Playback *playback, WindowContext *context, QWidget *parent = nullptr);

    Playback *playback() const { return m_playback; }
    QSize sizeHint() const override { return {400, 32}; }
    QSize minimumSizeHint() const override { return {120, 32}; }
    /// [px] from the left edge
    double xOf(Time time) const;
    Time timeAt(double x) const;
    /// What has happened near to this place, a line for each event. \param x [px]
    QString textsAt(double x) const;
    /// The time of the day, with milliseconds.
    static QString clockText(Time time);

protected:
    bool event(QEvent *event) override;
    void paintEvent(QPaintEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;

private:
    void findEvents();
    void seekTo(double x);

    Playback *m_playback;
    WindowContext *m_context;
    std::vector<std::pair<Time, QString>> m_events;  // of the recording that is played, with their texts
};

}  // namespace qplc
