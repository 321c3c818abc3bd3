// SPDX-License-Identifier: Apache-2.0
#include "LineText.h"

#include "signals/ConfigurationFile.h"
#include "signals/MessageText.h"

namespace qplc {

void LineStream::reset()
{
    m_next.clear();
    m_isTooLong = false;
}

bool LineStream::feed(char byte)
{
    if (!m_ends.contains(byte)) {
        m_isTooLong = m_isTooLong || m_next.size() == MaximumLength;
        if (!m_isTooLong)
            m_next.append(byte);
        return false;
    }
    const bool isLine = !m_isTooLong && !m_next.isEmpty();
    m_refused += m_isTooLong ? 1 : 0;
    if (isLine)
        m_line = m_next;
    reset();
    return isLine;
}

QString LinePattern::parse(const QString &text, LinePattern *pattern)
{
    pattern->m_expression = QRegularExpression(text);
    pattern->m_names.clear();
    pattern->m_groups.clear();
    if (!pattern->m_expression.isValid())
        return QStringLiteral("%1 is not a regular expression: %2 at character %3; correct it")
            .arg(quoted(text), pattern->m_expression.errorString())
            .arg(pattern->m_expression.patternErrorOffset() + 1);
    const QStringList groups = pattern->m_expression.namedCaptureGroups();
    for (int i = 0; i < groups.size(); ++i) {
        if (groups[i].isEmpty())
            continue;
        pattern->m_names << groups[i];
        pattern->m_groups << i;
    }
    return pattern->m_names.isEmpty()
        ? QStringLiteral("%1 has no value; give the group of each number a name: '(?<weight>[-+0-9.]+)'")
              .arg(quoted(text))
        : QString();
}

QVector<std::optional<double>> LinePattern::match(const QByteArray &line) const
{
    const QRegularExpressionMatch match = m_expression.match(QString::fromLatin1(line));
    QVector<std::optional<double>> values;
    if (!match.hasMatch())
        return values;
    for (const int group : m_groups) {
        double value = 0.0;
        const bool isNumber = finiteNumberFromText(match.captured(group).simplified().remove(QLatin1Char(' ')), &value);
        values << (isNumber ? std::optional<double>(value) : std::nullopt);
    }
    return values;
}

bool bytesOfText(const QString &text, QByteArray *bytes)
{
    bytes->clear();
    for (int i = 0; i < text.size(); ++i) {
        if (text[i] != QLatin1Char('\\')) {
            bytes->append(text.mid(i, 1).toLatin1());
            continue;
        }
        const QString kind = text.mid(++i, 1);
        bool isNumber = kind == QLatin1String("x");
        const int place = QStringLiteral("rnt\\").indexOf(kind);
        if (isNumber) {
            bytes->append(char(text.mid(i + 1, 2).toUInt(&isNumber, 16)));
            isNumber = isNumber && text.size() >= i + 3;
            i += 2;
        } else if (!kind.isEmpty() && place >= 0) {
            bytes->append("\r\n\t\\"[place]);
            isNumber = true;
        }
        if (!isNumber)
            return false;
    }
    return true;
}

}  // namespace qplc
