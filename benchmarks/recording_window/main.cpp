// SPDX-License-Identifier: Apache-2.0
// recording_window FILE LAYOUT: opens a recording in a window, moves its playhead to 200 times, and
// prints how long it takes until all panels have drawn them: with the whole recording in the plots,
// and with 30 s of it, where the plots move, too.
#include "QPlcControlCenter.h"
#include "QPlcGuiApplication.h"
#include "gui/plant/PlantRecording.h"
#include "gui/window/RecordingTimeline.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QRandomGenerator>

#include <algorithm>
#include <cstdio>

namespace {

constexpr int moves = 200;
constexpr int settled = 60;  // [ms] without a paint event: all is drawn
constexpr QPlcTimeAxis::Time closeSpan = 30'000'000'000;

/// When the window has last drawn something.
class Paints : public QObject
{
public:
    void begin() { m_clock.start(), m_last = 0; }
    /// [ns] until the last of the paint events that follow each other
    qint64 wait()
    {
        QElapsedTimer quiet;
        quiet.start();
        qint64 seen = m_last;
        while (quiet.elapsed() < settled) {
            QCoreApplication::processEvents(QEventLoop::AllEvents, 1);
            if (m_last != seen) {
                seen = m_last;
                quiet.start();
            }
        }
        return m_last;
    }
    bool eventFilter(QObject * /*watched*/, QEvent *event) override
    {
        if (event->type() == QEvent::Paint)
            QMetaObject::invokeMethod(
                this, [this] { m_last = m_clock.nsecsElapsed(); }, Qt::QueuedConnection);
        return false;
    }

private:
    QElapsedTimer m_clock;
    qint64 m_last = 0;
};

struct Figures
{
    double median;  // [ms]
    double p95;
    double longest;
};

Figures measure(Paints *paints, qplc::Playback *playback)
{
    QRandomGenerator random(1);
    std::vector<double> times;
    for (int move = 0; move < moves; ++move) {
        const double share = random.generateDouble();
        paints->begin();
        playback->seek(playback->begin() + qint64(share * double(playback->end() - playback->begin())));
        times.push_back(double(paints->wait()) * 1e-6);
    }
    std::sort(times.begin(), times.end());
    return {times[moves / 2], times[moves * 95 / 100], times.back()};
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcGuiApplication application(argc, argv);
    const QStringList arguments = QCoreApplication::arguments();
    if (arguments.size() != 3) {
        std::fputs("usage: recording_window FILE.mcap LAYOUT.json\n", stderr);
        return 2;
    }
    QPlcControlCenter window;
    QString error;
    if (!window.openLayout(arguments.at(2), &error) || window.openRecording({arguments.at(1)}, &error).isEmpty()) {
        std::fprintf(stderr, "recording_window: %s\n", qPrintable(error));
        return 1;
    }
    window.resize(1366, 740);
    window.show();
    qplc::Playback *playback = window.findChild<qplc::RecordingTimeline *>()->playback();
    QElapsedTimer clock;
    clock.start();
    while (playback->plant()->recording()->isReading())
        QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
    const double reading = double(clock.nsecsElapsed()) * 1e-6;
    Paints paints;
    qApp->installEventFilter(&paints);
    paints.begin();
    paints.wait();
    const Figures whole = measure(&paints, playback);
    window.context()->timeAxis()->setSpan(closeSpan);
    const Figures close = measure(&paints, playback);
    std::printf("{\"recording_s\": %.1f, \"signals\": %d, \"read_ms\": %.0f, "
                "\"whole_ms\": {\"p50\": %.1f, \"p95\": %.1f, \"max\": %.1f}, "
                "\"30_s_ms\": {\"p50\": %.1f, \"p95\": %.1f, \"max\": %.1f}}\n",
                double(playback->end() - playback->begin()) * 1e-9, playback->plant()->table().size(), reading,
                whole.median, whole.p95, whole.longest, close.median, close.p95, close.longest);
    return 0;
}
