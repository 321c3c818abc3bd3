// SPDX-License-Identifier: Apache-2.0
#include "WatchTable.h"

#include "TerminalText.h"

#include <cmath>

namespace tools {

namespace {

constexpr int numberWidth = 11;  // of extremes
constexpr int ageWidth = 8;      // of an age, or a quality
constexpr int columnGap = 2;     // between two columns
constexpr int leastName = 16;    // of a name, or no extremes are shown
constexpr int titleLines = 1;

/// Six digits, fewer where an exponent needs the room.
QString shortNumber(double number)
{
    int digits = 6;
    QString text = QString::number(number, 'g', digits);
    while (text.size() > numberWidth && digits > 1)
        text = QString::number(number, 'g', --digits);
    return text;
}

/// "0.3 s", "12 s", "5 min", "3 h"
QString ageText(double seconds)
{
    if (seconds < 10.0)
        return QStringLiteral("%1 s").arg(seconds, 0, 'f', 1);
    if (seconds < 120.0)
        return QStringLiteral("%1 s").arg(std::floor(seconds));
    if (seconds < 7200.0)
        return QStringLiteral("%1 min").arg(std::floor(seconds / 60.0));
    return QStringLiteral("%1 h").arg(std::floor(seconds / 3600.0));
}

int elementRows(const QPlcSignalDefinition &definition)
{
    return definition.type.isNumeric() ? definition.type.count() : 1;
}

}  // namespace

WatchTable::WatchTable(const QVector<QPlcSignalDefinition> &definitions)
    : m_definitions(definitions)
{
    for (const QPlcSignalDefinition &definition : definitions) {
        const bool isNumber = definition.type.isNumeric();
        const int count = elementRows(definition);
        for (int i = 0; i < count; ++i) {
            const QString name = count > 1 ? QStringLiteral("%1[%2]").arg(definition.name).arg(i) : definition.name;
            m_rows.append({name, printable(definition.unit), isNumber, QString()});
        }
    }
}

void WatchTable::update(const QVector<QPlcValue> &values, double now, const QVector<QPlcQuality> &qualities)
{
    int row = 0;
    for (int i = 0; i < m_definitions.size(); ++i) {
        const QPlcQuality quality = qualities.value(i, QPlcQuality::Good);
        for (int k = row; k < row + elementRows(m_definitions.at(i)); ++k)
            m_rows[k].quality = quality;
        const QPlcSignalType type = m_definitions.at(i).type;
        const QString text = printable(m_definitions.at(i).textOf(values.at(i)));
        if (!m_rows.at(row).isNumber) {
            update(&m_rows[row++], text, 0.0, now);
            continue;
        }
        const QStringList texts = text.split(QStringLiteral(", "));
        for (int element = 0; element < type.count(); ++element)
            update(&m_rows[row++], texts.value(element), values.at(i).toReal(element), now);
    }
}

void WatchTable::update(Row *row, const QString &text, double number, double now)
{
    if (text != row->value)
        row->changedAt = now;
    row->value = text;
    row->number = number;
    if (!row->isNumber || std::isnan(number))
        return;
    row->minimum = row->hasExtremes ? std::fmin(row->minimum, number) : number;
    row->maximum = row->hasExtremes ? std::fmax(row->maximum, number) : number;
    row->hasExtremes = true;
}

void WatchTable::forgetExtremes()
{
    for (Row &row : m_rows)
        row.hasExtremes = false;
}

/// The name is given what it needs where the line is wide enough; a value may be cut, being a text
/// then. Where the line is too narrow for names that can be read, there are no extremes.
WatchTable::Widths WatchTable::widths(int first, int count, int width) const
{
    Widths widths{6, 13, 4, true};
    for (int i = first; i < first + count; ++i) {
        widths.name = qMax(widths.name, displayWidth(m_rows.at(i).name));
        widths.unit = qMax(widths.unit, displayWidth(m_rows.at(i).unit));
        widths.value = qMax(widths.value, displayWidth(m_rows.at(i).value));
    }
    widths.unit = qMin(widths.unit, 8);
    int room = width - ageWidth - 3 * columnGap;
    const int withExtremes = room - 2 * (numberWidth + columnGap);
    widths.hasExtremes = withExtremes - widths.unit - 13 >= qMin(widths.name, leastName);
    if (widths.hasExtremes)
        room = withExtremes;
    widths.value = qBound(13, widths.value, qMax(13, room - widths.unit - qMin(widths.name, 24)));
    widths.name = qBound(6, widths.name, qMax(6, room - widths.unit - widths.value));
    return widths;
}

QStringList WatchTable::lines(int first, int width, int height, double now) const
{
    const int count = qBound(0, height - titleLines, m_rows.size() - first);
    const Widths columns = widths(first, count, width);
    const auto line = [&](const QString &name, const QString &value, const QString &unit, const QString &minimum,
                          const QString &maximum, const QString &age) {
        QStringList cells{padded(cut(name, columns.name), columns.name),
                          padded(cut(value, columns.value), columns.value, Right),
                          padded(cut(unit, columns.unit), columns.unit)};
        if (columns.hasExtremes)
            cells << padded(minimum, numberWidth, Right) << padded(maximum, numberWidth, Right);
        cells << padded(age, ageWidth, Right);
        return cells.join(QString(columnGap, QLatin1Char(' ')));
    };
    const QString titles = line(QStringLiteral("signal"), QStringLiteral("value"), QStringLiteral("unit"),
                                QStringLiteral("min"), QStringLiteral("max"), QStringLiteral("age"));
    QStringList lines{toned(titles, Tone::Title)};
    for (int i = first; i < first + count; ++i) {
        const Row &row = m_rows.at(i);
        const QString none = QStringLiteral("-");
        const QString quality = row.quality.isGood() ? QString() : row.quality.toString();
        const QString text = line(row.name, row.value, row.unit, row.hasExtremes ? shortNumber(row.minimum) : none,
                                  row.hasExtremes ? shortNumber(row.maximum) : none,
                                  row.value.isEmpty()     ? none
                                      : quality.isEmpty() ? ageText(now - row.changedAt)
                                                          : quality);
        lines << toned(text, row.value.isEmpty() ? Tone::Plain : toneOfQuality(quality));
    }
    return lines;
}

}  // namespace tools
