// SPDX-License-Identifier: Apache-2.0
#include "SetterView.h"

#include "gui/panel/DragEscape.h"

#include <QtCore/QTimer>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QSlider>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr int positions = 1000;
constexpr int digitsOfWanted = 4;

/// A value that is dragged: sent at most 20 times a second on the way, and always where it ends.
class SliderView : public SetterView
{
public:
    static constexpr int Pause = 50;  // [ms] between two values on the way

    SliderView(SetterTarget *target, QWidget *parent)
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

    void refresh() override
    {
        const bool mayWrite = target().control().mayWrite();
        if (!mayWrite) {
            m_hasSent = false;
            m_pause.stop();
            m_sentPosition = -1;
        }
        m_slider->setEnabled(mayWrite && target().hasRange() && target().isNumber());
        if (target().hasRange())  // so that the slider keeps its length
            m_wanted->setMinimumWidth(std::max({fontMetrics().horizontalAdvance(QStringLiteral("-00.000")),
                                                fontMetrics().horizontalAdvance(readingAt(0)),
                                                fontMetrics().horizontalAdvance(readingAt(positions))}));
        if (target().signal() && !target().hasRange())
            Q_EMIT said(
                tr("'%1' has no limits in the table: give the slider some in its settings").arg(target().reference()));
        showActual();
    }

    void showActual() override
    {
        if (!m_hasSent && target().hasRange() && !m_slider->isSliderDown()) {
            m_isShowing = true;
            m_slider->setValue(positionOf(target().actualNumber()));
            m_isShowing = false;
        }
        showWanted();
    }

private:
    double valueAt(int position) const
    {
        const double range = *target().maximum() - *target().minimum();
        return *target().minimum() + range * double(position) / positions;
    }

    QString readingAt(int position) const { return target().reading(valueAt(position), digitsOfWanted); }

    int positionOf(double value) const
    {
        const double range = *target().maximum() - *target().minimum();
        if (!(range > 0.0) || std::isnan(value))
            return 0;
        return int(std::clamp(std::round((value - *target().minimum()) / range * positions), 0.0, double(positions)));
    }

    void moved()
    {
        if (m_isShowing || !target().hasRange() || !target().control().mayWrite())
            return;
        m_hasSent = true;
        showWanted();
        if (!m_pause.isActive())
            send();
    }

    void send()
    {
        m_sentPosition = m_slider->value();
        m_pause.start();
        target().stream(valueAt(m_sentPosition));
    }

    void showWanted()
    {
        const QString text = target().hasRange() && m_hasSent ? readingAt(m_slider->value()) : QString();
        if (text != m_wanted->text())
            m_wanted->setText(text);
    }

    QSlider *m_slider;
    QLabel *m_wanted;
    QTimer m_pause;
    bool m_hasSent = false;  // the slider shows what was sent, not what is
    bool m_isShowing = false;
    int m_sentPosition = -1;
};

}  // namespace

SetterView *createSliderView(SetterTarget *target, QWidget *parent)
{
    return new SliderView(target, parent);
}

}  // namespace qplc
