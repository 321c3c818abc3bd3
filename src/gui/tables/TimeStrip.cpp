// SPDX-License-Identifier: Apache-2.0
#include "TimeStrip.h"

#include "QPlcPanelContext.h"

#include <QtCore/QDateTime>

namespace qplc {

namespace {

constexpr int pause = 250;           // [ms]
constexpr double shortestAge = 1.0;  // [s]; a hiccup is not worth a line

}  // namespace

TimeStrip::TimeStrip(QWidget *parent)
    : QLabel(parent)
{
    setMargin(3);
    setAlignment(Qt::AlignCenter);
    setWordWrap(true);  // it must not make a table wider
    setVisible(false);
    connect(&m_timer, &QTimer::timeout, this, &TimeStrip::renew);
}

void TimeStrip::setContext(QPlcPanelContext *context)
{
    m_context = context;
    connect(context, &QPlcPanelContext::timeChanged, this, &TimeStrip::renew);
    connect(context, &QPlcPanelContext::themeChanged, this, &TimeStrip::renew);
    m_timer.start(pause);
    renew();
}

void TimeStrip::renew()
{
    if (!m_context)
        return;
    if (const std::optional<QPlcPanelContext::Time> time = m_context->shownTime()) {
        const QDateTime shown = QDateTime::fromMSecsSinceEpoch(*time / 1'000'000);
        say(tr("Values at %1").arg(shown.toString(QStringLiteral("HH:mm:ss.zzz"))), m_context->theme().accent);
    } else {
        say(staleText(), m_context->theme().warning);
    }
}

QString TimeStrip::staleText() const
{
    QStringList texts;
    for (const QString &name : m_context->plants()) {
        const QPlcPanelContext::Plant plant = m_context->plant(name);
        if (plant.isStale && plant.age > shortestAge)
            texts << tr("%1: values are %2 old").arg(plant.name, QPlcPanelContext::ageText(plant.age));
    }
    return texts.join(QStringLiteral(" · "));
}

void TimeStrip::say(const QString &text, const QColor &color)
{
    setVisible(!text.isEmpty());
    setText(text);
    QPalette colors = palette();
    if (colors.color(QPalette::WindowText) == color)
        return;
    colors.setColor(QPalette::WindowText, color);
    setPalette(colors);
}

}  // namespace qplc
