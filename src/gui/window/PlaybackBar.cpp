// SPDX-License-Identifier: Apache-2.0
#include "PlaybackBar.h"

#include "gui/plant/PlantRecording.h"

#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>

#include <algorithm>
#include <iterator>

namespace qplc {

namespace {

constexpr double speeds[] = {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, Playback::AnySpeed};

}  // namespace

QString PlaybackBar::speedText(double speed)
{
    return speed == Playback::AnySpeed ? tr("As fast as it can") : tr("%1 x").arg(speed);
}

PlaybackBar::PlaybackBar(Playback *playback, WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_playback(playback)
    , m_context(context)
    , m_play(new BarButton(BarButton::Outlined, context))
    , m_speed(new BarButton(BarButton::Quiet, context))
    , m_loop(new BarButton(BarButton::Quiet, context))
    , m_time(new QLabel)
    , m_timeline(new RecordingTimeline(playback, context))
{
    auto *back = new BarButton(BarButton::Quiet, context);
    auto *forth = new BarButton(BarButton::Quiet, context);
    back->setText(QStringLiteral("❙◀"));
    back->setToolTip(tr("A cycle back (Alt+Left)"));
    back->setAccessibleName(tr("A cycle back"));
    forth->setText(QStringLiteral("▶❙"));
    forth->setToolTip(tr("A cycle on (Alt+Right)"));
    forth->setAccessibleName(tr("A cycle on"));
    m_speed->setToolTip(tr("Seconds of the recording in a second (Alt+Up, Alt+Down)"));
    m_loop->setText(tr("Loop A-B"));
    m_loop->setCheckable(true);
    m_loop->setToolTip(tr("Plays what is between the cursors A and B again and again"));
    m_time->setMinimumWidth(m_time->fontMetrics().horizontalAdvance(QStringLiteral("00:00:00.000 ")));
    m_play->setText(QStringLiteral("❚❚"));
    m_play->setMinimumWidth(m_play->sizeHint().width() + 8);
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(6, 2, 6, 2);
    row->setSpacing(4);
    for (BarButton *button : {m_play, back, forth, m_speed, m_loop})
        row->addWidget(button);
    row->addWidget(m_time);
    row->addWidget(m_timeline, 1);

    connect(m_play, &QAbstractButton::clicked, playback, &Playback::toggle);
    connect(back, &QAbstractButton::clicked, playback, [playback] { playback->step(-1); });
    connect(forth, &QAbstractButton::clicked, playback, [playback] { playback->step(1); });
    connect(m_speed, &QAbstractButton::clicked, this, &PlaybackBar::openSpeedMenu);
    connect(m_loop, &QAbstractButton::toggled, playback, &Playback::setLoop);
    connect(playback, &Playback::changed, this, &PlaybackBar::follow);
    connect(playback, &Playback::positionChanged, this, &PlaybackBar::followPosition);
    connect(context, &WindowContext::themeChanged, this, &PlaybackBar::follow);
    follow();
}

void PlaybackBar::follow()
{
    const Plant *plant = m_playback->plant();
    setVisible(plant != nullptr);
    m_play->setText(m_playback->isPlaying() ? QStringLiteral("❚❚") : QStringLiteral("▶"));
    m_play->setAccessibleName(m_playback->isPlaying() ? tr("Pause") : tr("Play"));
    m_play->setToolTip(plant ? tr("%1 %2 (Ctrl+Space)").arg(m_play->accessibleName(), plant->name()) : QString());
    m_speed->setText(speedText(m_playback->speed()));
    m_speed->updateGeometry();
    m_loop->setChecked(m_playback->isLoop());
    m_loop->setTextColor(m_playback->isLoop() ? m_context->theme().accent : m_context->theme().mutedText);
    followPosition();
}

void PlaybackBar::followPosition()
{
    m_time->setText(RecordingTimeline::clockText(m_playback->position()));
}

void PlaybackBar::stepSpeed(int by)
{
    const auto *present = std::find(std::begin(speeds), std::end(speeds), m_playback->speed());
    const auto place = std::clamp<std::ptrdiff_t>(present - std::begin(speeds) + by, 0, std::size(speeds) - 1);
    m_playback->setSpeed(speeds[place]);
}

void PlaybackBar::openSpeedMenu()
{
    auto *menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    for (const double speed : speeds) {
        QAction *action = menu->addAction(speedText(speed), this, [this, speed] { m_playback->setSpeed(speed); });
        action->setCheckable(true);
        action->setChecked(speed == m_playback->speed());
    }
    menu->popup(m_speed->mapToGlobal(QPoint(0, -menu->sizeHint().height())));
}

void PlaybackBar::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    painter.fillRect(QRect(0, 0, width(), 1), m_context->theme().line);
}

}  // namespace qplc
