// SPDX-License-Identifier: Apache-2.0
#include "KeyMapView.h"

#include "ManualControl.h"
#include "gui/LimitOf.h"
#include "gui/models/ValueFormat.h"

#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr int gap = 6;  // [px]

QString capText(int key)
{
    switch (key) {
    case Qt::Key_Left:
        return QStringLiteral("←");
    case Qt::Key_Right:
        return QStringLiteral("→");
    case Qt::Key_Up:
        return QStringLiteral("↑");
    case Qt::Key_Down:
        return QStringLiteral("↓");
    case 0:
        return QStringLiteral("?");
    default:
        return KeyBinding::keyName(key);
    }
}

QString signedText(double value)
{
    return (value > 0.0 ? QStringLiteral("+") : QString())
        + numberText(value, 4).replace(QLatin1Char('-'), QStringLiteral("−"));
}

}  // namespace

KeyMapView::KeyMapView(const ManualControl *control, QWidget *parent)
    : QWidget(parent)
    , m_control(control)
{
    setAccessibleName(tr("Keys"));
    QSizePolicy policy = sizePolicy();
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
}

void KeyMapView::setTheme(const QPlcTheme &theme)
{
    m_theme = theme;
    update();
}

void KeyMapView::setAxesShown(bool shown)
{
    m_areAxesShown = shown;
    refresh();
}

void KeyMapView::refresh()
{
    QStringList texts;
    const QVector<Row> all = rows();
    for (const Row &row : all) {
        for (const Cap &cap : row.caps)
            texts << tr("%1: %2 %3").arg(cap.text, row.name, cap.effect);
    }
    setAccessibleDescription(texts.join(QStringLiteral("; ")));
    updateGeometry();
    update();
}

QVector<KeyMapView::Row> KeyMapView::rows() const
{
    QVector<Row> rows;
    const QVector<SignalReference> references = m_control->bindings().signalReferences();
    for (const SignalReference &reference : references) {
        const QPlcPanelContext::Signal signal = m_control->context()->signal(reference.toString());
        const SiPrefix prefix = prefixOf(reference, signal);
        Row row{reference.toString(), tr("not there"), true, capsOf(reference, prefix)};
        if (signal) {
            row.actual
                = QStringLiteral("%1 %2").arg(numberText(prefix.shown(signal.number()), 3), prefix.unit()).trimmed();
            const QPlcPanelContext::Plant plant = m_control->context()->plant(signal.plant);
            row.isStale = plant.isStale || plant.age < 0.0;
            if (row.isStale)
                row.actual = tr("%1, %2 old").arg(row.actual, ageText(plant.age));
        }
        rows.append(row);
    }
    return rows;
}

/// Of a row, so that its value and what its keys do are read alike: that of its limits, else that
/// of the largest value of its keys and axes.
SiPrefix KeyMapView::prefixOf(const SignalReference &reference, const QPlcPanelContext::Signal &signal) const
{
    if (!signal)
        return {};
    const QPlcSignalDefinition &definition = signal.definition;
    const std::optional<double> minimum = limitOf(definition.minimum);
    const std::optional<double> maximum = limitOf(definition.maximum);
    if (minimum && maximum)
        return SiPrefix::fitting(definition.unit, std::max(std::abs(*minimum), std::abs(*maximum)));
    double largest = 0.0;
    for (const KeyBinding &key : m_control->bindings().keys)
        largest = key.signal == reference ? std::max(largest, std::abs(key.value)) : largest;
    for (const AxisBinding &axis : m_control->bindings().axes)
        largest = axis.signal == reference ? std::max(largest, std::abs(axis.value)) : largest;
    return SiPrefix::fitting(definition.unit, largest);
}

QVector<KeyMapView::Cap> KeyMapView::capsOf(const SignalReference &reference, const SiPrefix &prefix) const
{
    QVector<Cap> caps;
    for (const KeyBinding &key : m_control->bindings().keys) {
        if (key.signal == reference)
            caps.append({capText(key.key), signedText(prefix.shown(key.value)), m_control->isHeld(key.key)});
    }
    for (const AxisBinding &axis : m_control->bindings().axes) {
        if (axis.signal != reference || !m_areAxesShown)
            continue;
        const bool isMoved = m_control->isArmed() && axis.shaped(m_control->deflection(axis.axis)) != 0.0;
        caps.append({axis.axis, QStringLiteral("±%1").arg(numberText(std::abs(prefix.shown(axis.value)), 4)), isMoved});
    }
    return caps;
}

QFont KeyMapView::smallFont() const
{
    QFont small = font();
    small.setPointSizeF(small.pointSizeF() * 0.82);
    return small;
}

int KeyMapView::capSize() const
{
    return fontMetrics().height() + 10;
}

int KeyMapView::rowHeight(NamePlace place) const
{
    return capSize() + QFontMetrics(smallFont()).height() + gap + (place == NameAbove ? fontMetrics().height() : 0);
}

int KeyMapView::capsWidth(const Row &row) const
{
    int width = 0;
    for (const Cap &cap : row.caps)
        width += widthOf(cap) + gap;
    return width;
}

KeyMapView::NamePlace KeyMapView::namePlace(int width) const
{
    const QVector<Row> all = rows();
    const bool haveAllRoom = std::all_of(all.begin(), all.end(), [&](const Row &row) {
        return fontMetrics().horizontalAdvance(row.name) + gap + capsWidth(row) <= width;
    });
    return haveAllRoom ? NameBeside : NameAbove;
}

int KeyMapView::widthOf(const Cap &cap) const
{
    const int text = fontMetrics().horizontalAdvance(cap.text) + 14;
    return std::max({capSize(), text, QFontMetrics(smallFont()).horizontalAdvance(cap.effect) + 2});
}

/// With room for a value [px]
int KeyMapView::leastWidth() const
{
    int caps = 0;
    for (const Row &row : rows())
        caps = std::max(caps, capsWidth(row));
    return caps + fontMetrics().averageCharWidth() * 12;
}

QSize KeyMapView::sizeHint() const
{
    const int width = std::max(leastWidth(), this->width());
    return {leastWidth(), heightForWidth(width)};
}

int KeyMapView::heightForWidth(int width) const
{
    return rowHeight(namePlace(width)) * rows().size();
}

void KeyMapView::paintEvent(QPaintEvent *)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    int top = 0;
    const QVector<Row> all = rows();
    const NamePlace place = namePlace(width());
    for (const Row &row : all) {
        paintRow(painter, row, top, place);
        top += rowHeight(place);
    }
}

void KeyMapView::paintRow(QPainter &painter, const Row &row, int top, NamePlace place) const
{
    const int line = fontMetrics().height();
    double left = width() - capsWidth(row);
    const double texts = left - gap;
    const double nameWidth = place == NameAbove ? width() : texts;
    painter.setFont(font());
    painter.setPen(m_theme.text);
    painter.drawText(QRectF(0.0, top, nameWidth, line), Qt::AlignLeft | Qt::AlignVCenter,
                     fontMetrics().elidedText(row.name, Qt::ElideMiddle, int(nameWidth)));
    painter.setPen(row.isStale ? m_theme.stale : m_theme.mutedText);
    painter.drawText(QRectF(0.0, top + line, texts, line), Qt::AlignLeft | Qt::AlignVCenter,
                     fontMetrics().elidedText(row.actual, Qt::ElideRight, int(texts)));
    top += place == NameAbove ? line : 0;
    for (const Cap &cap : row.caps) {
        paintCap(painter, cap, QRectF(left + 0.5, top + 0.5, widthOf(cap) - 1.0, capSize() - 1.0));
        left += widthOf(cap) + gap;
    }
}

void KeyMapView::paintCap(QPainter &painter, const Cap &cap, const QRectF &place) const
{
    constexpr double corner = 4.0;
    painter.setFont(font());
    painter.setPen(QPen(cap.isLit ? m_theme.held : m_theme.line, cap.isLit ? 2.0 : 1.0));
    painter.setBrush(cap.isLit ? m_theme.held : m_theme.window);
    painter.drawRoundedRect(place, corner, corner);
    painter.setPen(cap.isLit ? m_theme.surface : m_theme.text);
    painter.drawText(place, Qt::AlignCenter, cap.text);
    painter.setFont(smallFont());
    painter.setPen(cap.isLit ? m_theme.held : m_theme.mutedText);
    painter.drawText(
        QRectF(place.left() - gap, place.bottom(), place.width() + 2 * gap, QFontMetrics(smallFont()).height()),
        Qt::AlignCenter, cap.effect);
}

}  // namespace qplc
