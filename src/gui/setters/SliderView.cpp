// SPDX-License-Identifier: Apache-2.0
#include "SliderView.h"

#include "gui/panel/DragEscape.h"

#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QSlider>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr int positions = 1000;
constexpr int digitsOfWanted = 4;

}  // namespace

SliderView::SliderView(SetterTarget *target, QWidget *parent)
    : SetterView(target, parent)
    , m_slider(new QSlider(Qt::Horizontal, this))
    , m_wanted(new QLabel(this))
{
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(m_slider);
    row->addWidget(m_wanted);
    m_slider->setRange(0, positions);
    m_slider->setPageStep(positions / 10);
    m_slider->setSingleStep(positions / 100);
    m_slider->setAccessibleName(tr("New value"));
    m_wanted->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    setFocusProxy(m_slider);
    m_pause.setSingleShot(true);
    m_pause.setInterval(Pause);
    connect(&m_pause, &QTimer::timeout, this, [this] {
        if (m_slider->value() != m_sentPosition)
            send();
    });
    connect(m_slider, &QSlider::valueChanged, this, &SliderView::moved);
    connect(m_slider, &QSlider::sliderReleased, this, [this] {
        m_pause.stop();
        if (m_slider->value() != m_sentPosition)
            send();
    });
    connect(new DragEscape(m_slider, this), &DragEscape::escaped, this, [this] { sendRelease(m_slider); });
    refresh();
}

double SliderView::valueAt(int position) const
{
    const double range = *target().maximum() - *target().minimum();
    return *target().minimum() + range * double(position) / positions;
}

QString SliderView::readingAt(int position) const
{
    return target().reading(valueAt(position), digitsOfWanted);
}

int SliderView::positionOf(double value) const
{
    const double range = *target().maximum() - *target().minimum();
    if (!(range > 0.0) || std::isnan(value))
        return 0;
    return int(std::clamp(std::round((value - *target().minimum()) / range * positions), 0.0, double(positions)));
}

void SliderView::refresh()
{
    const bool mayWrite = target().control().mayWrite();
    if (!mayWrite) {
        m_hasSent = false;
        m_pause.stop();
        m_sentPosition = -1;
    }
    m_slider->setEnabled(mayWrite && hasRange() && target().isNumber());
    if (hasRange())  // so that the slider keeps its length
        m_wanted->setMinimumWidth(std::max({fontMetrics().horizontalAdvance(QStringLiteral("-00.000")),
                                            fontMetrics().horizontalAdvance(readingAt(0)),
                                            fontMetrics().horizontalAdvance(readingAt(positions))}));
    if (target().signal() && !hasRange())
        Q_EMIT said(
            tr("'%1' has no limits in the table: give the slider some in its settings").arg(target().reference()));
    showActual();
}

void SliderView::showActual()
{
    if (!m_hasSent && hasRange() && !m_slider->isSliderDown()) {
        m_isShowing = true;
        m_slider->setValue(positionOf(target().actualNumber()));
        m_isShowing = false;
    }
    showWanted();
}

void SliderView::showWanted()
{
    const QString text = hasRange() && m_hasSent ? readingAt(m_slider->value()) : QString();
    if (text != m_wanted->text())
        m_wanted->setText(text);
}

void SliderView::moved()
{
    if (m_isShowing || !hasRange() || !target().control().mayWrite())
        return;
    m_hasSent = true;
    showWanted();
    if (!m_pause.isActive())
        send();
}

void SliderView::send()
{
    m_sentPosition = m_slider->value();
    m_pause.start();
    target().stream(valueAt(m_sentPosition));
}

}  // namespace qplc
