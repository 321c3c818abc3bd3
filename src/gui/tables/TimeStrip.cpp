// SPDX-License-Identifier: Apache-2.0
#include "TimeStrip.h"

#include "gui/panel/WindowContext.h"

#include <QtCore/QDateTime>

namespace qplc {

TimeStrip::TimeStrip(QWidget *parent)
    : QLabel(parent)
{
    setMargin(3);
    setAlignment(Qt::AlignCenter);
    setVisible(false);
}

void TimeStrip::setContext(WindowContext *context)
{
    const auto follow = [this, context] { show(context); };
    connect(context->timeView(), &TimeView::displayTimeChanged, this, follow);
    connect(context, &WindowContext::themeChanged, this, follow);
    follow();
}

void TimeStrip::show(WindowContext *context)
{
    const std::optional<TimeView::Time> time = context->timeView()->displayTime();
    setVisible(time.has_value());
    if (!time)
        return;
    const QDateTime shown = QDateTime::fromMSecsSinceEpoch(*time / 1'000'000);
    setText(tr("Values at %1").arg(shown.toString(QStringLiteral("HH:mm:ss.zzz"))));
    QPalette colors = palette();
    colors.setColor(QPalette::WindowText, context->theme().accent);
    setPalette(colors);
}

}  // namespace qplc
