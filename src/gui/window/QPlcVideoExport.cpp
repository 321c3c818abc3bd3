// SPDX-License-Identifier: Apache-2.0
#include "QPlcVideoExport.h"

#include "QPlcControlCenter.h"
#include "RecordingTimeline.h"
#include "VideoSink.h"
#include "gui/layout/LayoutView.h"
#include "gui/layout/PageView.h"
#include "gui/layout/PanelTitleBar.h"
#include "gui/panel/DrawNow.h"
#include "gui/panel/Filming.h"
#include "gui/plant/PlantRecording.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QElapsedTimer>
#include <QtCore/QEventLoop>
#include <QtCore/QFileInfo>
#include <QtCore/QPointer>
#include <QtCore/QStorageInfo>

#include <cmath>

using namespace qplc;

namespace {

constexpr int Pause = 1;                        // [ms] between two looks at what is pending
constexpr int SettledLooks = 5;                 // the past of a formula comes in parts
constexpr int LongestWait = 60'000;             // [ms] for one picture, or for the end of the encoder
constexpr int LongestResize = 2'000;            // [ms]
constexpr int LargestSide = 7680;               // [pixel]
constexpr double LeastFree = double(64 << 20);  // [byte] that stay

double freeBytesFor(const QString &name)
{
    return double(QStorageInfo(QFileInfo(name).absolutePath()).bytesAvailable());
}

}  // namespace

struct QPlcVideoExport::Private : public QObject
{
    explicit Private(QPlcVideoExport *video, QPlcControlCenter *controlCenter)
        : q(video)
        , window(controlCenter)
        , view(controlCenter->findChild<LayoutView *>())
        , playback(controlCenter->findChild<RecordingTimeline *>()->playback())
    {
        timer.setInterval(Pause);
        connect(&timer, &QTimer::timeout, this, &Private::goOn);
        connect(window->context()->curveSources(), &CurveSources::filled, this, [this] { looks = 0; });
    }

    ~Private() override
    {
        if (sink && window)
            letPerson(Act);
    }

    bool begin(const QString &fileName, const Options &wanted);
    bool checkOptions();
    bool checkRange();
    bool resizeTo(const QSize &size);
    bool beginSink(const QString &fileName);
    enum Person { Watch, Act };
    void letPerson(Person person);
    PageView *page() const;
    qint64 timeOf(int frame) const;
    void showFrame();
    void goOn();
    bool isDrawn() const;
    QImage picture() const;
    void end(const QString &failure);
    bool fail(const QString &sentence)
    {
        error = sentence;
        return false;
    }

    QPlcVideoExport *q;
    QPointer<QPlcControlCenter> window;
    LayoutView *view;
    Playback *playback;
    Options options;
    std::unique_ptr<VideoSink> sink;  // null: not running
    QString error;
    QTimer timer;
    QElapsedTimer sinceProgress;
    QPointer<QWidget> focused;  // that has given up the keyboard
    qint64 first = 0;           // [ns] of the recording, on the clock of the window
    qint64 last = 0;
    QSize size;  // [pixel] of a picture
    int count = 0;
    int done = 0;
    int looks = 0;  // since formulas have got more of their past
};

bool QPlcVideoExport::Private::checkOptions()
{
    const auto isIn = [](double value, double least, double most) { return value >= least && value <= most; };
    if (!isIn(options.framesPerSecond, 1.0, 120.0))
        return fail(tr("%1 pictures in a second cannot be shown; use 1 to 120").arg(options.framesPerSecond));
    if (!isIn(options.speed, 0.001, 1e5))
        return fail(tr("the speed %1 is out of range; use 0.001 to 100000").arg(options.speed));
    if (!isIn(options.span, 0.0, 1e9))
        return fail(tr("plots cannot show %1 s; use 0 or more").arg(options.span));
    if (std::max(options.size.width(), options.size.height()) > LargestSide)
        return fail(tr("a picture has at most %1 pixels at a side").arg(LargestSide));
    return true;
}

/// Which times, and how many pictures.
bool QPlcVideoExport::Private::checkRange()
{
    if (!playback->plant())
        return fail(tr("no recording is open; open one first"));
    const qint64 begin = playback->begin();
    const double length = double(playback->end() - begin) * 1e-9;
    const double to = options.to < 0.0 ? length : std::min(options.to, length);
    if (!(options.from >= 0.0 && options.from <= to))
        return fail(tr("the recording has no times from %1 s to %2 s; it has 0 to %3 s")
                        .arg(options.from)
                        .arg(to)
                        .arg(length, 0, 'f', 3));
    first = begin + std::llround(options.from * 1e9);
    last = begin + std::llround(to * 1e9);
    const double frames = std::floor((to - options.from) / options.speed * options.framesPerSecond + 1e-6) + 1.0;
    if (frames > double(MostFrames))
        return fail(tr("these would be %1 pictures, at most %2 are made; use less time, or a higher speed")
                        .arg(frames, 0, 'f', 0)
                        .arg(MostFrames));
    count = int(frames);
    return true;
}

/// Null: it is not seen.
PageView *QPlcVideoExport::Private::page() const
{
    PageView *page = view->currentPage();
    return page && page->isVisible() ? page : nullptr;
}

/// Makes the window as large as its panels need it.
bool QPlcVideoExport::Private::resizeTo(const QSize &wanted)
{
    QElapsedTimer clock;
    clock.start();
    const double ratio = window->devicePixelRatioF();
    const QSize inner(int(std::lround(wanted.width() / ratio)), int(std::lround(wanted.height() / ratio)));
    while (page() && page()->size() != inner && clock.elapsed() < LongestResize) {
        window->resize(window->size() + inner - page()->size());
        QCoreApplication::processEvents(QEventLoop::AllEvents, Pause);
    }
    return (page() && page()->size() == inner)
        || fail(tr("the window cannot be so large that its panels have %1 x %2 pixels; use a smaller size, or a larger "
                   "screen")
                    .arg(wanted.width())
                    .arg(wanted.height()));
}

bool QPlcVideoExport::Private::beginSink(const QString &fileName)
{
    size = options.size.isEmpty() ? page()->size() * window->devicePixelRatioF() : options.size;
    if (VideoSink::isVideo(fileName))
        size = {size.width() & ~1, size.height() & ~1};  // its colours are those of four pixels
    const VideoSink::Format format{fileName, size, options.framesPerSecond, options.isReplacing};
    const double needed = VideoSink::mostBytes(format, count);
    const double free = freeBytesFor(fileName);
    if (needed + LeastFree > free)
        return fail(tr("%1 pictures of %2 x %3 pixels may take %4 GB, and the disk has %5 GB free; use less time, a "
                       "higher speed, or a smaller size")
                        .arg(count)
                        .arg(size.width())
                        .arg(size.height())
                        .arg(needed * 1e-9, 0, 'f', 1)
                        .arg(free * 1e-9, 0, 'f', 1));
    sink = VideoSink::create(format, &error);
    return sink != nullptr;
}

/// While pictures are made, the panels get nothing from mouse and keyboard, and show nothing of
/// them: no buttons, no focus, and not the values at the mouse in place of those of the playhead.
void QPlcVideoExport::Private::letPerson(Person person)
{
    const QList<PanelTitleBar *> bars = window->findChildren<PanelTitleBar *>();
    for (PanelTitleBar *bar : bars)
        bar->setButtonsShown(person == Act);
    const QList<PageView *> pages = window->findChildren<PageView *>();
    for (PageView *page : pages)
        page->setAttribute(Qt::WA_TransparentForMouseEvents, person == Watch);
    const QList<QPlcWidget *> panels = window->findChildren<QPlcWidget *>();
    for (QPlcWidget *panel : panels) {
        Filming event(person == Watch ? Filming::Begins : Filming::Ends);
        QCoreApplication::sendEvent(panel, &event);
    }
    if (person == Act) {
        if (focused)
            focused->setFocus();
        return;
    }
    focused = window->focusWidget();
    if (focused && page()->isAncestorOf(focused))
        focused->clearFocus();
    else
        focused.clear();
    const QList<QWidget *> parts = page()->findChildren<QWidget *>();
    for (QWidget *part : parts) {
        QEvent event(QEvent::Leave);
        QCoreApplication::sendEvent(part, &event);
    }
    window->context()->timeAxis()->setPointer(std::nullopt);
}

bool QPlcVideoExport::Private::begin(const QString &fileName, const Options &wanted)
{
    if (sink)
        return fail(tr("a video is being made; wait until it is ready, or cancel it"));
    error.clear();
    options = wanted;
    count = done = looks = 0;
    if (!checkOptions() || !checkRange())
        return false;
    if (!page() || !window->isVisible())
        return fail(tr("the window shows no panels; show it, and a tab with panels, first"));
    if ((!options.size.isEmpty() && !resizeTo(options.size)) || !beginSink(fileName))
        return false;
    letPerson(Watch);
    playback->pause();
    // Plots of a single picture show all of the recording.
    window->context()->timeAxis()->show(
        first < last ? first : playback->begin(),
        std::max(first < last ? last : playback->end(), first + QPlcTimeAxis::shortestSpan));
    showFrame();
    timer.start();
    return true;
}

qint64 QPlcVideoExport::Private::timeOf(int frame) const
{
    return std::min(last, first + std::llround(frame * options.speed / options.framesPerSecond * 1e9));
}

void QPlcVideoExport::Private::showFrame()
{
    sinceProgress.start();
    if (done == count)
        return sink->end();
    const qint64 time = timeOf(done);
    const auto span = std::llround(options.span * 1e9);
    if (span > 0)
        window->context()->timeAxis()->show(time - span, time);
    playback->seek(time);
}

/// Whether all panels show the playhead.
bool QPlcVideoExport::Private::isDrawn() const
{
    if (playback->plant()->recording()->isReading() || looks < SettledLooks)
        return false;
    bool isDrawn = true;
    const QList<QPlcWidget *> panels = page()->findChildren<QPlcWidget *>();
    for (QPlcWidget *panel : panels) {
        DrawNow event;
        if (panel->isVisible())
            QCoreApplication::sendEvent(panel, &event);
        isDrawn = isDrawn && !event.isPending();
    }
    return isDrawn;
}

QImage QPlcVideoExport::Private::picture() const
{
    QImage image = page()->grab().toImage().convertToFormat(QImage::Format_RGB32);
    image.setDevicePixelRatio(1.0);
    const bool isNearly = image.width() - size.width() <= 1 && image.height() - size.height() <= 1
        && image.width() >= size.width() && image.height() >= size.height();
    return isNearly ? image.copy(QRect(QPoint(), size))                                     // a video has even sides
                    : image.scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);  // resized meanwhile
}

void QPlcVideoExport::Private::goOn()
{
    if (!playback->plant() || !page())
        return end(tr("the window, the recording or its tab was closed before the last picture"));
    ++looks;
    const VideoSink::State state = sink->state();
    if (state == VideoSink::Failed)
        return end(sink->errorString());
    if (sinceProgress.elapsed() > LongestWait)
        return end(done == count ? tr("ffmpeg has not ended in %1 s").arg(LongestWait / 1000)
                                 : tr("picture %1 was not drawn in %2 s").arg(done).arg(LongestWait / 1000));
    if (state == VideoSink::Busy || (done < count && !isDrawn()))
        return;
    if (done == count)
        return end(sink->commit() ? QString() : sink->errorString());
    if (!sink->add(picture()))
        return end(sink->errorString());
    ++done;
    Q_EMIT q->progressed(done);
    if (sink)  // and not cancelled
        showFrame();
}

void QPlcVideoExport::Private::end(const QString &failure)
{
    timer.stop();
    error = failure;
    sink.reset();
    if (window)
        letPerson(Act);
    Q_EMIT q->finished(failure.isEmpty());
}

QPlcVideoExport::QPlcVideoExport(QPlcControlCenter *window)
    : d(std::make_unique<Private>(this, window))
{
}

QPlcVideoExport::~QPlcVideoExport() = default;

bool QPlcVideoExport::start(const QString &name, const Options &options)
{
    return d->begin(name, options);
}

void QPlcVideoExport::cancel()
{
    if (d->sink)
        d->end(tr("the video was cancelled"));
}

bool QPlcVideoExport::isRunning() const
{
    return d->sink != nullptr;
}

QString QPlcVideoExport::errorString() const
{
    return d->error;
}

int QPlcVideoExport::frames() const
{
    return d->count;
}
