// SPDX-License-Identifier: Apache-2.0
#include "TableText.h"

#include <QtCore/QDateTime>

#include <algorithm>

namespace qplc {

namespace {

constexpr std::int64_t Second = 1'000'000'000;
constexpr int MostDigits = 9;

}  // namespace

void TableText::begin()
{
    if (m_isInRow)
        m_text += m_format == Csv ? ',' : '\t';
    m_isInRow = true;
}

void TableText::addTitle(const QString &name, const QString &unit)
{
    addText(unit.isEmpty() ? name : QStringLiteral("%1 [%2]").arg(name, unit));
}

void TableText::addText(const QString &text)
{
    begin();
    if (m_format == Tsv) {
        m_text += QString(text).replace(QLatin1Char('\t'), QLatin1Char(' ')).toUtf8();
        return;
    }
    const bool needsQuotes = std::any_of(text.begin(), text.end(), [](QChar c) {
        return c == QLatin1Char(',') || c == QLatin1Char('"') || c == QLatin1Char('\r') || c == QLatin1Char('\n');
    });
    QByteArray field = text.toUtf8();
    m_text += needsQuotes ? '"' + field.replace("\"", "\"\"") + '"' : field;
}

void TableText::addSeconds(std::int64_t time)
{
    begin();
    m_text += QByteArray::number(qint64(time / Second));
    QByteArray fraction = QByteArray::number(qint64(time % Second)).rightJustified(MostDigits, '0');
    while (fraction.endsWith('0'))
        fraction.chop(1);
    if (!fraction.isEmpty())
        m_text += '.' + fraction;
}

void TableText::addMoment(std::int64_t time, int digits)
{
    begin();
    const std::int64_t seconds = time / Second - (time % Second < 0 ? 1 : 0);
    const QDateTime moment = QDateTime::fromSecsSinceEpoch(seconds, Qt::UTC);
    m_text += moment.toString(QStringLiteral("yyyy-MM-ddTHH:mm:ss.")).toLatin1();
    m_text += QByteArray::number(qint64(time - seconds * Second)).rightJustified(MostDigits, '0').left(digits) + 'Z';
}

void TableText::endRow()
{
    m_text += m_format == Csv ? "\r\n" : "\n";
    m_isInRow = false;
}

QByteArray TableText::take()
{
    QByteArray text;
    text.swap(m_text);
    return text;
}

}  // namespace qplc
