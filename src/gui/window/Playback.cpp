// SPDX-License-Identifier: Apache-2.0
#include "Playback.h"

#include "gui/plant/PlantRecording.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr int framePause = 20;             // [ms]
constexpr Playback::Time anyFrames = 400;  // frames that AnySpeed takes for a recording
constexpr int pausePeriods = 100;          // without cycles: nothing happens there

}  // namespace

Playback::Playback(WindowContext *context, QObject *parent)
    : QObject(parent)
    , m_context(context)
{
    m_timer.setTimerType(Qt::PreciseTimer);
    m_timer.setInterval(framePause);
    connect(&m_timer, &QTimer::timeout, this, [this] { advance(m_sinceStep.nsecsElapsed()); });
    PlantList *plants = context->plants();
    plants->forEach(this, &Playback::followRecording);
    connect(plants, &PlantList::removed, this, &Playback::follow);
    connect(plants, &PlantList::selectionChanged, this, &Playback::follow);
    connect(context->timeAxis(), &QPlcTimeAxis::playheadChanged, this, &Playback::positionChanged);
    connect(context->timeAxis(), &QPlcTimeAxis::cursorsChanged, this, &Playback::changed);
    connect(context->timeAxis(), &QPlcTimeAxis::viewChanged, this, [this] {
        if (m_context->timeAxis()->isLive())
            pause();  // a person wants to see the newest values
    });
}

Plant *Playback::plant() const
{
    Plant *selected = m_context->plants()->selected();
    if (selected && selected->recording())
        return selected;
    const QVector<Plant *> all = m_context->plants()->all();
    const auto found = std::find_if(all.begin(), all.end(), [](const Plant *plant) { return plant->recording(); });
    return found == all.end() ? nullptr : *found;
}

Playback::Time Playback::begin() const
{
    return plant() ? plant()->recording()->begin() : 0;
}

Playback::Time Playback::end() const
{
    return plant() ? plant()->recording()->end() : 0;
}

Playback::Time Playback::position() const
{
    return std::clamp(m_context->timeAxis()->playhead().value_or(begin()), begin(), end());
}

void Playback::followRecording(Plant *plant)
{
    PlantRecording *recording = plant->recording();
    if (!recording)
        return;
    connect(recording, &PlantRecording::read, this, &Playback::changed);
    if (this->plant() == plant) {
        QPlcTimeAxis *axis = m_context->timeAxis();
        if (!axis->playhead())
            axis->show(recording->begin(),
                       std::max<Time>(recording->end(), recording->begin() + QPlcTimeAxis::shortestSpan));
        follow();
    }
}

/// The playhead belongs to the recording that is played.
void Playback::follow()
{
    if (plant()) {
        seek(position());
    } else {
        pause();
        m_context->timeAxis()->setPlayhead(std::nullopt);
    }
    Q_EMIT changed();
}

void Playback::play()
{
    if (!plant() || isPlaying())
        return;
    const auto [first, last] = loopRange();
    if (position() >= last || position() < first)
        seek(first);
    m_sinceStep.start();
    m_timer.start();
    Q_EMIT changed();
}

void Playback::pause()
{
    if (!isPlaying())
        return;
    m_timer.stop();
    Q_EMIT changed();
}

void Playback::toggle()
{
    if (isPlaying())
        pause();
    else
        play();
}

void Playback::setSpeed(double speed)
{
    const double allowed = speed > AnySpeed ? std::max(speed, SlowestSpeed) : AnySpeed;
    if (allowed == m_speed)
        return;
    m_speed = allowed;
    Q_EMIT changed();
}

void Playback::setLoop(bool isLoop)
{
    if (isLoop == m_isLoop)
        return;
    m_isLoop = isLoop;
    Q_EMIT changed();
}

std::pair<Playback::Time, Playback::Time> Playback::loopRange() const
{
    const QPlcTimeAxis *axis = m_context->timeAxis();
    const std::optional<Time> a = axis->cursor(QPlcTimeAxis::A);
    const std::optional<Time> b = axis->cursor(QPlcTimeAxis::B);
    if (!m_isLoop || !a || !b)
        return {begin(), end()};
    const auto [first, last] = std::minmax({*a, *b});
    return {std::clamp(first, begin(), end()), std::clamp(last, begin(), end())};
}

void Playback::seek(Time time)
{
    if (plant())
        m_context->timeAxis()->setPlayhead(std::clamp(time, begin(), end()));
}

void Playback::step(int cycles)
{
    const SignalStore *store = plant() ? plant()->store() : nullptr;
    if (!store || store->isEmpty())
        return;
    pause();
    const auto row = std::int64_t(store->rowUpTo(position()).value_or(store->firstRow()));
    const auto wanted
        = std::clamp<std::int64_t>(row + cycles, std::int64_t(store->firstRow()), std::int64_t(store->endRow()) - 1);
    seek(store->time(SignalStore::Row(wanted)));
}

/// Skips a pause in the recording. \return the time of the next cycle if \a time is in a pause,
/// otherwise \a time
Playback::Time Playback::withoutPause(Time time) const
{
    const SignalStore *store = plant()->store();
    if (!store || store->isEmpty())
        return time;
    const SignalStore::Row next = store->rowAt(time);
    const bool isPause = next < store->endRow() && store->beginsAnew(next)
        && store->time(next) - time > pausePeriods * plant()->recording()->period();
    return isPause ? store->time(next) : time;
}

void Playback::advance(Time elapsed)
{
    m_sinceStep.start();
    if (!plant())
        return pause();
    const auto [first, last] = loopRange();
    const Time by = m_speed == AnySpeed ? std::max<Time>((last - first) / anyFrames, plant()->recording()->period())
                                        : Time(double(elapsed) * m_speed);
    const Time next = withoutPause(position() + by);
    if (next < last)
        return seek(next);
    seek(m_isLoop ? first : last);
    if (!m_isLoop)
        pause();
}

}  // namespace qplc
