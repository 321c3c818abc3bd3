// SPDX-License-Identifier: Apache-2.0
#include "SetterView.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QHBoxLayout>

#include <cmath>

namespace qplc {

namespace {

/// A switch: a knob that is left (off) or right (on), and the words for both.
class SwitchButton : public QAbstractButton
{
public:
    explicit SwitchButton(QWidget *parent)
        : QAbstractButton(parent)
    {
        setCheckable(true);
        setFocusPolicy(Qt::StrongFocus);
    }

    QSize sizeHint() const override
    {
        const int height = fontMetrics().height() + 6;
        return {2 * height + 8 + fontMetrics().horizontalAdvance(SetterView::tr("off")) + 8, height + 4};
    }

    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent *) override
    {
        QPainter painter(this);
        painter.setRenderHint(QPainter::Antialiasing);
        const QPalette::ColorGroup group = isEnabled() ? QPalette::Active : QPalette::Disabled;
        const double height = fontMetrics().height() + 4.0;
        const QRectF track(2.5, (this->height() - height) / 2.0, 1.9 * height, height);
        const QColor on = isEnabled() ? palette().color(QPalette::Highlight) : palette().color(QPalette::Mid);
        painter.setPen(QPen(hasFocus() ? palette().color(QPalette::Highlight) : palette().color(QPalette::Mid),
                            hasFocus() ? 2.0 : 1.0));
        painter.setBrush(isChecked() ? on : palette().color(QPalette::Window));
        painter.drawRoundedRect(track, height / 2.0, height / 2.0);
        const double radius = height / 2.0 - 3.0;
        const QPointF knob(isChecked() ? track.right() - height / 2.0 : track.left() + height / 2.0,
                           track.center().y());
        painter.setPen(Qt::NoPen);
        painter.setBrush(isChecked() ? palette().color(group, QPalette::HighlightedText)
                                     : palette().color(group, QPalette::WindowText));
        painter.drawEllipse(knob, radius, radius);
        painter.setPen(palette().color(group, QPalette::WindowText));
        painter.drawText(QRectF(track.right() + 8.0, 0.0, width() - track.right() - 8.0, this->height()),
                         Qt::AlignVCenter | Qt::AlignLeft, isChecked() ? SetterView::tr("on") : SetterView::tr("off"));
    }

    void keyPressEvent(QKeyEvent *event) override
    {
        const bool isEnter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
        if (isEnter && !event->isAutoRepeat())
            click();
        else if (!isEnter)
            QAbstractButton::keyPressEvent(event);
    }
};

/// Two values: on (`on`, 1 unless set) and off (neutral). A click sends once; the switch shows what
/// the plant has.
class ToggleView : public SetterView
{
public:
    ToggleView(SetterTarget *target, QWidget *parent)
        : SetterView(target, parent)
        , m_switch(new SwitchButton(this))
    {
        auto *row = new QHBoxLayout(this);
        row->setContentsMargins(0, 0, 0, 0);
        row->addWidget(m_switch);
        row->addStretch();
        m_switch->setAccessibleName(tr("On or off"));
        setFocusProxy(m_switch);
        connect(m_switch, &QAbstractButton::clicked, this, &ToggleView::clicked);
        refresh();
    }

    void refresh() override
    {
        m_switch->setEnabled(target().control().mayWrite() && target().isNumber());
        showActual();
    }

    void showActual() override
    {
        if (m_waits > 0) {
            --m_waits;
            return;
        }
        const double actual = target().actualNumber();
        const double off = target().neutral();
        m_switch->setChecked(!std::isnan(actual) && std::abs(actual - m_on) < std::abs(actual - off));
    }

    /// A word, as the switch has it, in place of 0 or 1.
    QString actualText() const override
    {
        const QPlcSignalDefinition &definition = target().signal().definition;
        const bool isPlain = definition.typeName == QLatin1String("Bool") && definition.valueNames.isEmpty();
        const double actual = target().actualNumber();
        if (!isPlain || std::isnan(actual))
            return SetterView::actualText();
        return actual != 0.0 ? tr("on") : tr("off");
    }

    void applySettings(const QJsonObject &settings) override
    {
        m_on = settings.value(QStringLiteral("on")).toDouble(1.0);
        refresh();
    }

private:
    void clicked()
    {
        m_waits = 3;
        target().sendOnce(m_switch->isChecked() ? m_on : target().neutral());
    }

    SwitchButton *m_switch;
    double m_on = 1.0;
    int m_waits = 0;  // calls of showActual() in which the plant may still show the value from before
};

}  // namespace

SetterView *createToggleView(SetterTarget *target, QWidget *parent)
{
    return new ToggleView(target, parent);
}

}  // namespace qplc
