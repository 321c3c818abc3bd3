// SPDX-License-Identifier: Apache-2.0
#include "StateStepper.h"

#include <QtGui/QPainter>

namespace qplc {

namespace {

constexpr StateStep::Step steps[] = {StateStep::Off, StateStep::Initialized, StateStep::RealTime};
constexpr int usualWidth = 104;    // [px] of a step
constexpr int smallestWidth = 78;  // [px] "Initialized" in bold

}  // namespace

StateStepper::StateStepper(WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
{
    setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
    connect(context, &WindowContext::themeChanged, this, QOverload<>::of(&QWidget::update));
    show(StateStep());
}

void StateStepper::show(const StateStep &step)
{
    m_step = step;
    setAccessibleName(step.step == StateStep::None ? tr("State of the master is not known")
                                                   : tr("State of the master: %1").arg(textOf(step.step)));
    setToolTip(accessibleName());
    update();
}

QString StateStepper::textOf(StateStep::Step step) const
{
    return step == m_step.step && !m_step.text.isEmpty() ? m_step.text : StateStep::name(step);
}

QSize StateStepper::sizeHint() const
{
    return {3 * usualWidth, 44};
}

QSize StateStepper::minimumSizeHint() const
{
    return {3 * smallestWidth, 44};
}

void StateStepper::paintEvent(QPaintEvent * /*event*/)
{
    const Theme &theme = m_context->theme();
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    constexpr double dotY = 14.0;
    const double stepWidth = width() / 3.0;
    const auto center = [stepWidth](int place) { return (place + 0.5) * stepWidth; };
    for (int place = 0; place < 3; ++place) {
        const bool isPresent = steps[place] == m_step.step;
        const bool isDone = steps[place] < m_step.step;
        const QColor color = isPresent ? (m_step.tone == Tone::Calm ? theme.text : colorOf(theme, m_step.tone))
                                       : (isDone ? theme.mutedText : theme.line);
        if (place > 0) {
            painter.setPen(QPen(steps[place] <= m_step.step ? theme.mutedText : theme.line, 2.0));
            painter.drawLine(QPointF(center(place - 1) + 10, dotY), QPointF(center(place) - 10, dotY));
        }
        painter.setPen(QPen(color, 2.0));
        painter.setBrush(isPresent || isDone ? QBrush(color) : QBrush(Qt::NoBrush));
        painter.drawEllipse(QPointF(center(place), dotY), isPresent ? 6.0 : 4.0, isPresent ? 6.0 : 4.0);
        QFont textFont = font();
        textFont.setBold(isPresent);
        painter.setFont(textFont);
        painter.setPen(isPresent ? color : theme.mutedText);
        const QRectF textRect(place * stepWidth - 12, 24, stepWidth + 24, 18);
        painter.drawText(textRect, Qt::AlignCenter, textOf(steps[place]));
    }
}

}  // namespace qplc
