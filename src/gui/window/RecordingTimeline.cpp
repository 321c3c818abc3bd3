// SPDX-License-Identifier: Apache-2.0
#include "RecordingTimeline.h"

#include "BarButton.h"

#include <QtGui/QHelpEvent>
#include <QtGui/QKeyEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QToolTip>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr double margin = 9.0;      // [px] at both ends, for the handle
constexpr double lineHeight = 6.0;  // [px]
constexpr double handle = 6.0;      // [px] radius
constexpr int mostTexts = 8;        // of events, under the pointer
constexpr double catchEvent = 5.0;  // [px] around an event: a click means it

}  // namespace

RecordingTimeline::RecordingTimeline(Playback *playback, WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_playback(playback)
    , m_context(context)
{
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setAccessibleName(tr("Time of the recording"));
    const auto redraw = QOverload<>::of(&QWidget::update);
    connect(playback, &Playback::changed, this, &RecordingTimeline::findEvents);
    connect(playback, &Playback::positionChanged, this, redraw);
    connect(context, &WindowContext::themeChanged, this, redraw);
    connect(context->timeAxis(), &QPlcTimeAxis::viewChanged, this, redraw);
    connect(context->events(), &QAbstractItemModel::rowsInserted, this, &RecordingTimeline::findEvents);
    connect(context->events(), &QAbstractItemModel::rowsRemoved, this, &RecordingTimeline::findEvents);
    findEvents();
}

double RecordingTimeline::xOf(Time time) const
{
    const double length = double(std::max<Time>(m_playback->end() - m_playback->begin(), 1));
    return margin + double(time - m_playback->begin()) / length * (width() - 2.0 * margin);
}

RecordingTimeline::Time RecordingTimeline::timeAt(double x) const
{
    const double share = std::clamp((x - margin) / std::max(width() - 2.0 * margin, 1.0), 0.0, 1.0);
    return m_playback->begin() + Time(std::llround(share * double(m_playback->end() - m_playback->begin())));
}

/// They change seldom, and the playhead often.
void RecordingTimeline::findEvents()
{
    m_events.clear();
    const Plant *plant = m_playback->plant();
    for (int row = 0; plant && row < m_context->events()->rowCount(); ++row) {
        const PlantEvent &event = m_context->events()->at(row);
        const Time time = Time(event.time.toMSecsSinceEpoch()) * 1'000'000;
        const bool isOfPlant
            = event.source == plant->name() || event.source.startsWith(plant->name() + QLatin1Char('/'));
        if (isOfPlant && time >= m_playback->begin() && time <= m_playback->end())
            m_events.emplace_back(time, event.text);
    }
    update();
}

QString RecordingTimeline::clockText(Time time)
{
    return QDateTime::fromMSecsSinceEpoch(time / 1'000'000).toString(QStringLiteral("HH:mm:ss.zzz"));
}

bool RecordingTimeline::event(QEvent *event)
{
    if (event->type() == QEvent::ToolTip) {
        const auto *help = static_cast<QHelpEvent *>(event);
        QToolTip::showText(
            help->globalPos(),
            QStringList({clockText(timeAt(help->x())), textsAt(help->x())}).join(QLatin1Char('\n')).trimmed(), this);
        return true;
    }
    return QWidget::event(event);
}

void RecordingTimeline::paintEvent(QPaintEvent * /*event*/)
{
    const Theme &theme = m_context->theme();
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const double y = height() / 2.0;
    const auto fill = [&](double from, double to, double height, const QColor &color) {
        painter.setPen(Qt::NoPen);
        painter.setBrush(color);
        painter.drawRoundedRect(QRectF(from, y - height / 2.0, std::max(to - from, 2.0), height), 2.0, 2.0);
    };
    fill(margin, width() - margin, lineHeight, theme.line);
    const QPlcTimeAxis *axis = m_context->timeAxis();
    const double seenFrom = std::clamp(xOf(axis->begin()), margin, width() - margin);
    const double seenTo = std::clamp(xOf(axis->end()), margin, width() - margin);
    fill(seenFrom, seenTo, lineHeight, theme.mutedText);
    painter.setPen(QPen(theme.warning, 1.5));
    for (const auto &[time, text] : m_events)
        painter.drawLine(QPointF(xOf(time), y - 10.0), QPointF(xOf(time), y - 4.0));
    if (m_playback->isLoop()) {
        const auto [first, last] = m_playback->loopRange();
        painter.setPen(QPen(theme.accent, 2.0));
        painter.drawLine(QPointF(xOf(first), y + 9.0), QPointF(xOf(last), y + 9.0));
    }
    painter.setPen(QPen(theme.window, 1.5));
    painter.setBrush(theme.accent);
    painter.drawEllipse(QPointF(xOf(m_playback->position()), y), handle, handle);
    if (hasFocus())
        drawFocusRing(&painter, rect(), theme);
}

QString RecordingTimeline::textsAt(double x) const
{
    QStringList texts;
    for (const auto &[time, text] : m_events) {
        if (texts.size() < mostTexts && std::fabs(xOf(time) - x) < catchEvent)
            texts << text;
    }
    return texts.join(QLatin1Char('\n'));
}

/// An event that is near is meant.
void RecordingTimeline::seekTo(double x)
{
    Time time = timeAt(x);
    double distance = catchEvent;
    for (const auto &[event, text] : m_events) {
        if (std::fabs(xOf(event) - x) < distance) {
            distance = std::fabs(xOf(event) - x);
            time = event;
        }
    }
    m_playback->seek(time);
}

void RecordingTimeline::mousePressEvent(QMouseEvent *event)
{
    if (event->button() == Qt::LeftButton)
        seekTo(event->localPos().x());
    else
        QWidget::mousePressEvent(event);
}

void RecordingTimeline::mouseMoveEvent(QMouseEvent *event)
{
    if ((event->buttons() & Qt::LeftButton) != 0)
        m_playback->seek(timeAt(event->localPos().x()));
}

void RecordingTimeline::keyPressEvent(QKeyEvent *event)
{
    switch (event->key()) {
    case Qt::Key_Left:
        return m_playback->step(-1);
    case Qt::Key_Right:
        return m_playback->step(1);
    case Qt::Key_PageUp:
        return m_playback->seek(m_playback->position() - m_context->timeAxis()->span());
    case Qt::Key_PageDown:
        return m_playback->seek(m_playback->position() + m_context->timeAxis()->span());
    case Qt::Key_Home:
        return m_playback->seek(m_playback->begin());
    case Qt::Key_End:
        return m_playback->seek(m_playback->end());
    case Qt::Key_Space:
        return m_playback->toggle();
    default:
        return QWidget::keyPressEvent(event);
    }
}

}  // namespace qplc
