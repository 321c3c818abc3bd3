// SPDX-License-Identifier: Apache-2.0
#include "PlotLegend.h"

#include "ChartLook.h"
#include "QPlcQuality.h"
#include "gui/models/ValueFormat.h"
#include "gui/panel/FigureFont.h"

#include <QtGui/QHelpEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QToolTip>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr int legendSwatch = 10;   // [px]
constexpr int swatchGap = 2;       // [px] between dashes
constexpr int spacing = 6;         // [px] between parts of an entry
constexpr int entryGap = 14;       // [px] between entries
constexpr int margin = 4;          // [px] around all
constexpr int legendLineRoom = 3;  // [px] above and below a text, together
constexpr int legendDigits = 5;
constexpr int fewDigits = 4;            // in small panels
constexpr int leastName = 56;           // [px] of a name that is elided
constexpr double smallestShare = 1e-4;  // of the axis: a smaller value has the prefix of this one

/// Empty for values like others.
QString markText(QPlcQuality::Kind mark)
{
    switch (mark) {
    case QPlcQuality::Held:
        return PlotLegend::tr("held");
    case QPlcQuality::Safe:
        return PlotLegend::tr("safe");
    case QPlcQuality::Invalid:
        return PlotLegend::tr("not written");
    default:
        return {};
    }
}

QString hintOf(const PlotCurve &curve)
{
    if (curve.isMissing())
        return curve.source.problem;
    QString hint = curve.text();
    if (hint != curve.settings.signal)
        hint += QLatin1Char('\n') + curve.settings.signal;
    if (curve.source.minimum || curve.source.maximum)
        hint
            += PlotLegend::tr("\nlimits %1 ... %2")
                   .arg(numberText(curve.source.minimum.value_or(NAN)), numberText(curve.source.maximum.value_or(NAN)));
    if (curve.isStale())
        hint += PlotLegend::tr("\nlast value %1 ago").arg(ageText(curve.source.age()));
    return hint;
}

}  // namespace

PlotLegend::PlotLegend(QWidget *parent)
    : QWidget(parent)
{
    QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Minimum);
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
    setMouseTracking(true);
    setAccessibleName(tr("Legend"));
    measure();
}

void PlotLegend::setTheme(const QPlcTheme &theme)
{
    m_theme = theme;
    update();
}

void PlotLegend::setCompact(bool isCompact)
{
    if (isCompact == m_isCompact)
        return;
    m_isCompact = isCompact;
    m_valueWidth = 0;
    measure();
    update();
}

void PlotLegend::show(const PlotCurves &curves, std::optional<QPlcPast::Time> time)
{
    QVector<Entry> entries;
    m_prefixes.resize(curves.size());
    for (int place = 0; place < curves.size(); ++place) {
        const PlotCurve &curve = curves.at(place);
        Entry entry;
        entry.name = curve.text();
        fillValue(curves, place, time, &entry);
        entry.hint = hintOf(curve);
        entry.color = curve.swatchColor(curve.value(time));
        entry.penStyle = curve.isDrawnAsBands() ? Qt::SolidLine : curve.penStyle;
        entry.isVisible = curve.settings.isVisible && !curve.isReplaced;
        const bool isOld = curve.isStale() && !time;
        entry.doubt = isOld ? ageText(curve.source.age()) : markText(curve.mark(time));
        entry.isTrusted = !curve.isMissing() && !isOld && entry.doubt.isEmpty();
        entry.isSelected = place == curves.selected();
        entries.append(entry);
    }
    if (entries == m_entries)
        return;
    m_entries = entries;
    measure();
    update();
}

/// Names of states as they are; whole numbers without decimals; others with a prefix that stays
/// while it is good enough.
void PlotLegend::fillValue(const PlotCurves &curves, int place, std::optional<QPlcPast::Time> time, Entry *entry)
{
    const PlotCurve &curve = curves.at(place);
    SiPrefix &prefix = m_prefixes[place];
    if (prefix.tableUnit() != curve.source.unit)
        prefix = SiPrefix(curve.source.unit);
    if (curve.isMissing()) {
        entry->value = PlotLegend::tr("missing");
        return;
    }
    const double value = curve.value(time);
    const int digits = m_isCompact ? fewDigits : legendDigits;
    const bool isWhole = curve.source.isStepped && !curve.settings.isScaled();
    if (isWhole || !curve.names().isEmpty()) {
        entry->unit = prefix.unit();
        entry->value = numberText(value, legendDigits + 2, curve.names());
        return;
    }
    if (!std::isnan(value))
        prefix = prefix.kept(std::max(std::abs(value), smallestShare * curves.largest(curve.axis)));
    entry->unit = prefix.unit();
    entry->value = steadyNumberText(prefix.shown(value), digits);
}

/// Digits of one width.
QFont PlotLegend::valueFontOf(const Entry &entry) const
{
    return figureFont(fontOf(entry));
}

QFont PlotLegend::fontOf(const Entry &entry) const
{
    QFont font = smallFont(this->font());
    font.setBold(entry.isSelected);
    return font;
}

void PlotLegend::measure()
{
    Entry boldest;
    boldest.isSelected = true;
    const QFontMetrics metrics(fontOf(boldest));
    const int before = m_nameWidth + m_valueWidth + m_unitWidth;
    m_lineHeight = metrics.height() + legendLineRoom;
    const QFontMetrics figures(valueFontOf(boldest));
    m_valueWidth = std::max(m_valueWidth, figures.horizontalAdvance(QStringLiteral("-88.88")));
    m_nameWidth = 0;
    if (m_entries.isEmpty())
        m_unitWidth = 0;
    for (const Entry &entry : qAsConst(m_entries)) {
        m_nameWidth = std::max(m_nameWidth, metrics.horizontalAdvance(entry.name));
        // These grow only, so that nothing trembles.
        m_unitWidth = std::max(m_unitWidth, metrics.horizontalAdvance(entry.unit));
        m_valueWidth = std::max(m_valueWidth, figures.horizontalAdvance(entry.value));
    }
    if (m_nameWidth + m_valueWidth + m_unitWidth != before || sizeHint().height() != height())
        updateGeometry();
}

/// Of an entry with all that it says [px]
int PlotLegend::wantedWidth() const
{
    return legendSwatch + m_nameWidth + m_valueWidth + m_unitWidth + 3 * spacing;
}

/// Of an entry whose name is elided [px]
int PlotLegend::leastWidth() const
{
    return wantedWidth() - m_nameWidth + std::min(m_nameWidth, leastName);
}

/// With the room before it [px]; 0: there is no doubt.
int PlotLegend::doubtWidth(const Entry &entry) const
{
    return entry.doubt.isEmpty() ? 0 : spacing + QFontMetrics(fontOf(entry)).horizontalAdvance(entry.doubt);
}

int PlotLegend::columnsFor(int width) const
{
    const int room = width - 2 * margin + entryGap;
    const int wanted = (m_isCompact ? leastWidth() : wantedWidth()) + entryGap;
    return std::clamp(room / std::max(wanted, 1), 1, std::max(1, m_entries.size()));
}

int PlotLegend::heightForWidth(int width) const
{
    if (m_entries.isEmpty())
        return 0;
    const int columns = columnsFor(width);
    return (m_entries.size() + columns - 1) / columns * m_lineHeight + 2 * margin;
}

int PlotLegend::heightWithin(int width, int room) const
{
    const int lines = std::max(1, (room - 2 * margin) / m_lineHeight);
    return std::min(heightForWidth(width), lines * m_lineHeight + 2 * margin);
}

QSize PlotLegend::sizeHint() const
{
    return {200, heightForWidth(width())};
}

QRect PlotLegend::entryRect(int place) const
{
    const int columns = columnsFor(width());
    const int room = (width() - 2 * margin + entryGap) / columns;
    const int wanted = wantedWidth();
    const int column = place % columns;
    const int width = std::min(room - entryGap, wanted + doubtWidth(m_entries[place]));
    return {margin + column * room, margin + place / columns * m_lineHeight, width, m_lineHeight};
}

int PlotLegend::entryAt(QPoint position) const
{
    for (int place = 0; place < m_entries.size(); ++place) {
        if (entryRect(place).adjusted(-margin, 0, margin, 0).contains(position))
            return place;
    }
    return -1;
}

void PlotLegend::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    paint(&painter, true);
}

void PlotLegend::paint(QPainter *painter, bool hasHover) const
{
    for (int place = 0; place < m_entries.size(); ++place) {
        const QRect rect = entryRect(place);
        if (hasHover && place == m_hovered) {
            QColor hover = m_theme.accent;
            hover.setAlphaF(0.12);
            painter->fillRect(rect.adjusted(-margin, 0, margin, 0), hover);
        }
        paintEntry(painter, rect, m_entries[place]);
    }
}

/// Full, or as two dashes or three dots beside each other; hollow without values.
void PlotLegend::paintSwatch(QPainter *painter, const QRect &box, const Entry &entry) const
{
    const int parts = entry.penStyle == Qt::SolidLine ? 1 : entry.penStyle == Qt::DashLine ? 2 : 3;
    const int width = (legendSwatch - (parts - 1) * swatchGap) / parts;
    painter->setPen(entry.isVisible ? m_theme.stale : entry.color);
    painter->setBrush(Qt::NoBrush);
    for (int part = 0; part < parts; ++part) {
        const QRect rect(box.left() + part * (width + swatchGap), box.top(), width, box.height());
        if (entry.isVisible && entry.isTrusted)
            painter->fillRect(rect, entry.color);
        else
            painter->drawRect(rect.adjusted(0, 0, -1, -1));
    }
}

/// Name, value and unit, left to right. A name can be elided, a value cannot: the name gets what is
/// left.
PlotLegend::Parts PlotLegend::partsOf(const QRect &rect) const
{
    const int room = std::max(0, rect.width() - legendSwatch - 3 * spacing - m_unitWidth);
    const int valueWidth = std::min(m_valueWidth, room);
    Parts parts;
    parts.name = QRect(rect.left() + legendSwatch + spacing, rect.top(), room - valueWidth, rect.height());
    parts.value = QRect(parts.name.right() + 1 + spacing, rect.top(), valueWidth, rect.height());
    parts.unit = QRect(parts.value.right() + 1 + spacing, rect.top(), m_unitWidth, rect.height());
    return parts;
}

QRect PlotLegend::valueRect(int place) const
{
    const QRect rect = entryRect(place);
    const int doubt = doubtWidth(m_entries[place]);
    return partsOf(rect.width() >= wantedWidth() + doubt ? rect.adjusted(0, 0, -doubt, 0) : rect).value;
}

void PlotLegend::paintEntry(QPainter *painter, const QRect &wholeRect, const Entry &entry) const
{
    paintSwatch(painter, {wholeRect.left(), wholeRect.center().y() - legendSwatch / 2 + 1, legendSwatch, legendSwatch},
                entry);
    const QFont font = fontOf(entry);
    painter->setFont(font);
    const bool isQuiet = !entry.isVisible || !entry.isTrusted;
    const int doubt = doubtWidth(entry);
    const bool isDoubtLast
        = doubt > 0 && wholeRect.width() >= wantedWidth() + doubt;  // else it takes of the name: nothing moves
    painter->setPen(m_theme.stale);
    Parts parts = partsOf(isDoubtLast ? paintDoubt(painter, wholeRect, entry) : wholeRect);
    painter->setPen(isQuiet ? m_theme.stale : m_theme.text);
    if (!isDoubtLast && doubt > 0)
        parts.name = paintDoubt(painter, parts.name, entry);
    painter->drawText(parts.name, Qt::AlignVCenter | Qt::TextSingleLine,
                      QFontMetrics(font).elidedText(entry.name, Qt::ElideMiddle, parts.name.width()));
    painter->setFont(valueFontOf(entry));
    painter->drawText(parts.value, Qt::AlignVCenter | Qt::AlignRight | Qt::TextSingleLine, entry.value);
    painter->setFont(font);
    painter->setPen(isQuiet ? m_theme.stale : m_theme.mutedText);
    painter->drawText(parts.unit, Qt::AlignVCenter | Qt::TextSingleLine, entry.unit);
}

/// What is at the right end of an entry. \return the room that is left
QRect PlotLegend::paintDoubt(QPainter *painter, const QRect &room, const Entry &entry) const
{
    const int width = doubtWidth(entry);
    painter->drawText(room, Qt::AlignVCenter | Qt::AlignRight | Qt::TextSingleLine, entry.doubt);
    return room.adjusted(0, 0, -width, 0);
}

void PlotLegend::mousePressEvent(QMouseEvent *event)
{
    const int place = entryAt(event->pos());
    if (event->button() == Qt::LeftButton && place >= 0)
        Q_EMIT clicked(place);
    else
        QWidget::mousePressEvent(event);
}

void PlotLegend::mouseMoveEvent(QMouseEvent *event)
{
    const int place = entryAt(event->pos());
    setCursor(place >= 0 ? Qt::PointingHandCursor : Qt::ArrowCursor);
    if (place != m_hovered)
        update();
    m_hovered = place;
}

void PlotLegend::leaveEvent(QEvent *event)
{
    m_hovered = -1;
    update();
    QWidget::leaveEvent(event);
}

void PlotLegend::contextMenuEvent(QContextMenuEvent *event)
{
    Q_EMIT menuWanted(entryAt(event->pos()), event->globalPos());
}

bool PlotLegend::event(QEvent *event)
{
    if (event->type() == QEvent::ToolTip) {
        auto *help = static_cast<QHelpEvent *>(event);
        const int place = entryAt(help->pos());
        QToolTip::showText(help->globalPos(), place >= 0 ? m_entries[place].hint : QString(), this);
        return true;
    }
    return QWidget::event(event);
}

void PlotLegend::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::FontChange)
        measure();
}

}  // namespace qplc
