// SPDX-License-Identifier: Apache-2.0
#include "SetterView.h"

#include "gui/panel/DragEscape.h"

#include <QtGui/QKeyEvent>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>

#include <qwt_knob.h>
#include <qwt_round_scale_draw.h>
#include <qwt_scale_div.h>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr int smallestKnob = 96;      // [px]
constexpr double totalAngle = 270.0;  // [deg]
constexpr uint stepsOfRange = 100;    // of a key
constexpr uint stepsOfPage = 10;
constexpr int digits = 4;
constexpr int majorTicks = 5;
constexpr double tickLength = 5.0;  // [px]

/// A value that is turned: sent once when the mouse lets go, or, when wheel or keys have turned it,
/// by Enter. Esc takes the turning back; nothing is overwritten meanwhile.
class KnobView : public SetterView
{
public:
    KnobView(SetterTarget *target, QWidget *parent)
        : SetterView(target, parent)
        , m_knob(new QwtKnob(this))
        , m_wanted(new QLabel(this))
    {
        auto *row = new QHBoxLayout(this);
        row->setContentsMargins(0, 0, 0, 0);
        row->addWidget(m_knob, 2);
        row->addWidget(m_wanted, 1);
        m_knob->setMinimumSize(smallestKnob, smallestKnob);
        m_knob->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
        m_knob->setKnobStyle(QwtKnob::Flat);
        m_knob->setMarkerStyle(QwtKnob::Tick);
        m_knob->setTotalAngle(totalAngle);
        m_knob->setPageSteps(stepsOfPage);
        m_knob->setScaleMaxMajor(majorTicks);
        m_knob->scaleDraw()->enableComponent(QwtAbstractScaleDraw::Labels, false);  // they would leave the knob no room
        m_knob->scaleDraw()->setTickLength(QwtScaleDiv::MajorTick, tickLength);
        m_knob->setFocusPolicy(Qt::StrongFocus);
        m_knob->setAccessibleName(tr("New value"));
        m_knob->installEventFilter(this);
        m_wanted->setAlignment(Qt::AlignCenter);
        m_wanted->setMinimumWidth(fontMetrics().horizontalAdvance(QStringLiteral("-00.000")));
        setFocusProxy(m_knob);
        connect(m_knob, &QwtKnob::valueChanged, this, &KnobView::turned);
        connect(m_knob, &QwtKnob::sliderReleased, this, &KnobView::apply);
        connect(new DragEscape(m_knob, this), &DragEscape::escaped, this, [this] {
            revert();  // before the release, which would send
            sendRelease(m_knob);
        });
        refresh();
    }

    void refresh() override
    {
        const bool mayWrite = target().control().mayWrite();
        if (!mayWrite) {
            m_hasSent = false;
            setEdited(false);
        }
        takeRange();
        m_knob->setEnabled(mayWrite && hasRange() && target().isNumber());
        if (target().signal() && !hasRange())
            Q_EMIT said(
                tr("'%1' has no limits in the table: give the knob some in its settings").arg(target().reference()));
        showActual();
    }

    void showActual() override
    {
        const double actual = target().actualNumber();
        if (!m_isEdited && !m_hasSent && hasRange() && !std::isnan(actual)) {
            m_isShowing = true;
            m_knob->setValue(target().clamped(actual));
            m_isShowing = false;
        }
        showWanted();
    }

protected:
    bool eventFilter(QObject *watched, QEvent *event) override
    {
        if (watched == m_knob && event->type() == QEvent::KeyPress && m_isEdited) {
            const auto *press = static_cast<QKeyEvent *>(event);
            const bool isEnter = press->key() == Qt::Key_Return || press->key() == Qt::Key_Enter;
            if (isEnter && !press->isAutoRepeat())
                apply();
            else if (press->key() == Qt::Key_Escape)
                revert();
            else
                return false;
            return true;
        }
        return SetterView::eventFilter(watched, event);
    }

private:
    bool hasRange() const { return target().hasRange() && *target().minimum() < *target().maximum(); }

    void takeRange()
    {
        if (!hasRange() || (m_knob->lowerBound() == *target().minimum() && m_knob->upperBound() == *target().maximum()))
            return;
        const double range = *target().maximum() - *target().minimum();
        const bool isReal = target().signal() && target().signal().definition.type.isReal();
        m_isShowing = true;
        m_knob->setScale(*target().minimum(), *target().maximum());
        m_knob->setToolTip(QStringLiteral("%1 … %2").arg(target().reading(*target().minimum(), digits),
                                                         target().reading(*target().maximum(), digits)));
        m_knob->setTotalSteps(isReal || range > stepsOfRange ? stepsOfRange : uint(range));
        m_isShowing = false;
    }

    void turned()
    {
        if (m_isShowing)
            return;
        setEdited(true);
        showWanted();
    }

    void setEdited(bool edited)
    {
        if (edited == m_isEdited)
            return;
        m_isEdited = edited;
        QFont font = m_wanted->font();
        font.setBold(edited);
        m_wanted->setFont(font);
        Q_EMIT said(edited ? tr("Not sent yet: letting go, or Enter, sends; Esc takes it back") : QString());
    }

    void apply()
    {
        if (!m_isEdited || !target().control().mayWrite())
            return;
        setEdited(false);
        m_hasSent = true;
        target().sendOnce(m_knob->value());
        showWanted();
    }

    void revert()
    {
        setEdited(false);
        m_hasSent = false;
        showActual();
    }

    void showWanted()
    {
        const bool isWanted = hasRange() && (m_isEdited || m_hasSent);
        const QString text = isWanted ? target().reading(m_knob->value(), digits) : QString();
        if (text != m_wanted->text())
            m_wanted->setText(text);
    }

    QwtKnob *m_knob;
    QLabel *m_wanted;
    bool m_isShowing = false;  // the knob follows the signal
    bool m_isEdited = false;
    bool m_hasSent = false;  // the knob shows what was sent, not what is
};

}  // namespace

SetterView *createKnobView(SetterTarget *target, QWidget *parent)
{
    return new KnobView(target, parent);
}

}  // namespace qplc
