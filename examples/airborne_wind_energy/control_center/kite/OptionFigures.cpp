// SPDX-License-Identifier: Apache-2.0
#include "OptionFigures.h"

#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>

namespace awe {

namespace {

constexpr double edge = 8.0;            // [px]
constexpr double valueBarHeight = 5.0;  // [px]

/// A bar grows from zero, or from the end of the scale that is nearest to it.
QRectF barOf(const QRectF &track, double minimum, double maximum, double value)
{
    const auto x = [&](double number) {
        return track.left() + track.width() * (std::clamp(number, minimum, maximum) - minimum) / (maximum - minimum);
    };
    const double from = x(0.0), to = x(value);
    return {std::min(from, to), track.top(), std::abs(to - from), track.height()};
}

}  // namespace

OptionFigures::OptionFigures(QWidget *parent)
    : QPlcWidget(parent)
{
    setAccessibleName(tr("Plant options: what the options of the plant show"));
    connect(context(), &QPlcPanelContext::changed, this, QOverload<>::of(&QWidget::update));
}

QVector<OptionFigures::Row> OptionFigures::rows() const
{
    const Row known[] = {
        {tr("Electrical power"), QStringLiteral("electricalPower"), -4000.0, 8000.0, {}},
        {tr("Efficiency of the winch"), QStringLiteral("winchEfficiency"), 0.0, 1.0, {}},
        {tr("Speed of the drum"), QStringLiteral("drumSpeed"), -10.0, 10.0, {}},
        {tr("Machine switched off"), QStringLiteral("machineOff"), 0.0, 1.0, {}},
        {tr("Power of the turbines"), QStringLiteral("turbinePower"), 0.0, 8000.0, {}},
        {tr("Drag of the turbines"), QStringLiteral("turbineCoefficient"), 0.0, 0.3, {}},
        {tr("Steering command"), QStringLiteral("steeringCommand"), -1.0, 1.0, {}},
        {tr("Steering"), QStringLiteral("steering"), -1.0, 1.0, {}},
        {tr("Tension at the wing"), QStringLiteral("wingTension"), 0.0, 4000.0, {}},
        {tr("Tension at the winch"), QStringLiteral("winchTension"), 0.0, 4000.0, {}},
        {tr("Wind at 6 m"), QStringLiteral("= norm(windVelocity6m_earth)"), 0.0, 15.0, {}},
        {tr("Density at the wing"), QStringLiteral("airDensity"), 0.0, 1.3, {}},
        {tr("On the mast"), QStringLiteral("mastDocked"), 0.0, 1.0, {}},
        {tr("Dockings"), QStringLiteral("mastDockings"), 0.0, 10.0, {}},
        {tr("Speed of the last docking"), QStringLiteral("mastDockingSpeed"), 0.0, 3.0, {}},
    };
    QVector<Row> present;
    for (Row row : known) {
        row.signal = context()->shown(row.reference);
        if (row.signal)
            present.append(row);
    }
    return present;
}

QStringList OptionFigures::shownSignals() const
{
    QStringList references;
    for (const Row &row : rows())
        references << row.reference;
    return references;
}

QSize OptionFigures::minimumSizeHint() const
{
    return {120, 90};
}

QSize OptionFigures::sizeHint() const
{
    return {260, 320};
}

void OptionFigures::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    const QPlcTheme theme = context()->theme();
    painter.fillRect(rect(), theme.surface);
    const QVector<Row> present = rows();
    const QRectF area = QRectF(rect()).adjusted(edge, edge, -edge, -edge);
    if (present.isEmpty()) {
        painter.setFont(theme.labelFont);
        painter.setPen(theme.mutedText);
        painter.drawText(area, Qt::AlignCenter | Qt::TextWordWrap, tr("This plant has no options."));
        return;
    }
    const double wanted = QFontMetricsF(theme.figureFont).height() + valueBarHeight + edge;
    const double height = std::min(wanted, area.height() / present.size());
    for (int i = 0; i < present.size(); ++i)
        drawRow(&painter, {area.left(), area.top() + i * height, area.width(), height}, present.at(i));
}

void OptionFigures::drawRow(QPainter *painter, const QRectF &area, const Row &row) const
{
    const QPlcTheme theme = context()->theme();
    const bool isUsable = row.signal.quality.isUsable();
    const QString value = isUsable ? QPlcPanelContext::text(row.signal, 3) : tr("no value");
    const QRectF track(area.left(), area.bottom() - valueBarHeight - 0.5 * edge, area.width(), valueBarHeight);
    const QRectF words(area.left(), area.top(), area.width(), track.top() - area.top());
    painter->setFont(theme.labelFont);
    painter->setPen(theme.mutedText);
    painter->drawText(words, Qt::AlignLeft | Qt::AlignVCenter, row.title);
    painter->setFont(theme.figureFont);
    painter->setPen(row.signal.isCurrent ? theme.text : theme.stale);
    painter->drawText(words, Qt::AlignRight | Qt::AlignVCenter, value);
    painter->fillRect(track, theme.line);
    const double number = row.signal.number();
    if (isUsable && std::isfinite(number))
        painter->fillRect(barOf(track, row.minimum, row.maximum, number),
                          row.signal.isCurrent ? theme.accent : theme.stale);
}

}  // namespace awe
