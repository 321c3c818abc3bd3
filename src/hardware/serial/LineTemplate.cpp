// SPDX-License-Identifier: Apache-2.0
#include "LineTemplate.h"

#include "signals/MessageText.h"

#include <QtCore/QRegularExpression>

#include <algorithm>
#include <cmath>
#include <limits>

namespace qplc {

QString LineTemplate::parse(const QByteArray &bytes, LineTemplate *line)
{
    *line = LineTemplate();
    Part part;
    for (int i = 0; i < bytes.size(); ++i) {
        const char byte = bytes[i];
        if (byte != '{' && byte != '}') {
            part.literal.append(byte);
            continue;
        }
        if (i + 1 < bytes.size() && bytes[i + 1] == byte) {  // a brace
            part.literal.append(byte);
            ++i;
            continue;
        }
        const int end = byte == '{' ? bytes.indexOf('}', i) : -1;
        if (end < 0)
            return QStringLiteral("a brace at byte %1 has no partner; write {name} for a number, and {{ or }} for a "
                                  "brace")
                .arg(i + 1);
        const QString error = line->addNumber(bytes.mid(i + 1, end - i - 1), &part);
        if (!error.isEmpty())
            return error;
        line->m_parts.push_back(part);
        part = Part();
        i = end;
    }
    if (!part.literal.isEmpty())
        line->m_parts.push_back(part);
    if (line->m_names.isEmpty())
        return QStringLiteral("it has no value; give each number a name: 'SP {setpoint:.2}\\r\\n'");
    if (line->shortest() > MaximumLength)
        return QStringLiteral("it has more than %1 bytes; make several lines of it").arg(MaximumLength);
    return {};
}

QString LineTemplate::addNumber(const QByteArray &word, Part *part)
{
    static const QRegularExpression numbers(
        QStringLiteral("^([A-Za-z_][A-Za-z0-9_]*)(?::(0?)([1-9][0-9]?)?(?:\\.([0-9]))?)?$"));
    const QString text = QString::fromLatin1(word);
    const QRegularExpressionMatch match = numbers.match(text);
    if (!match.hasMatch())
        return QStringLiteral("%1 is not a number of a line; write {name}, {name:.2} for two decimals, or {name:07.2} "
                              "for at least seven characters, filled with zeros")
            .arg(quoted(text));
    const QString name = match.captured(1);
    if (!m_names.contains(name))
        m_names << name;
    part->name = m_names.indexOf(name);
    part->isZeroFilled = !match.captured(2).isEmpty();
    part->width = match.captured(3).toInt();
    part->decimals = match.captured(4).isEmpty() ? -1 : match.captured(4).toInt();
    return {};
}

double LineTemplate::largest(int name) const
{
    constexpr double largestFixed = 1e15;  // beyond it, a double has no digit behind the point
    const auto isFixed = [name](const Part &part) { return part.name == name && part.decimals >= 0; };
    const bool isAnyFixed = std::any_of(m_parts.begin(), m_parts.end(), isFixed);
    return isAnyFixed ? largestFixed : std::numeric_limits<double>::max();
}

int LineTemplate::shortest() const
{
    int length = 0;
    for (const Part &part : m_parts)
        length += part.literal.size() + (part.name < 0 ? 0 : std::max(1, part.width));
    return length;
}

QByteArray LineTemplate::text(const std::vector<double> &values) const
{
    QByteArray line;
    for (const Part &part : m_parts) {
        line += part.literal;
        if (part.name < 0)
            continue;
        const double value = values[std::size_t(part.name)];
        if (!std::isfinite(value))
            return {};
        line += numberText(part, value);
    }
    return line.size() > MaximumLength ? QByteArray() : line;
}

// Without "-0.00", which few instruments read.
QByteArray LineTemplate::numberText(const Part &part, double value)
{
    QByteArray number
        = part.decimals < 0 ? QByteArray::number(value, 'g', 10) : QByteArray::number(value, 'f', part.decimals);
    const auto isNothing = [](char byte) { return byte == '-' || byte == '0' || byte == '.'; };
    if (number.startsWith('-') && std::all_of(number.begin(), number.end(), isNothing))
        number.remove(0, 1);
    const int missing = std::max(0, part.width - number.size());
    const bool isBehindSign = part.isZeroFilled && number.startsWith('-');
    number.insert(isBehindSign ? 1 : 0, QByteArray(missing, part.isZeroFilled ? '0' : ' '));
    return number;
}

}  // namespace qplc
