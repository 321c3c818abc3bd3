// SPDX-License-Identifier: Apache-2.0
#include "ConfigurationFile.h"

#include "IniParser.h"
#include "MessageText.h"

#include <QtCore/QRegularExpression>

#include <algorithm>
#include <cmath>

namespace qplc {

bool finiteNumberFromText(const QString &text, double *number)
{
    bool isNumber = false;
    *number = text.toDouble(&isNumber);
    return isNumber && std::isfinite(*number);
}

bool ConfigurationTerm::fromText(const QString &text, ConfigurationTerm *term, QString *error)
{
    static const QRegularExpression pattern(
        QStringLiteral(R"(^([^\s*+\[\]]+)(?:\[(\d{1,4})\])?(?:\s*\*\s*(\S+))?(?:\s+([+-])\s*(\S+))?$)"));
    const QRegularExpressionMatch match = pattern.match(text);
    *term = {};
    error->clear();
    const QString sign = match.captured(4);
    const QString factor = match.captured(3);
    if (!match.hasMatch())
        *error
            = QStringLiteral("%1 is not a name with a factor and an offset; write for example 'speed', 'speed * 0.1' "
                             "or 'position[2] * 0.001 - 5'")
                  .arg(quoted(text));
    else if (!factor.isEmpty() && !finiteNumberFromText(factor, &term->factor))
        *error = QStringLiteral("the factor %1 is not a finite number").arg(quoted(factor));
    else if (term->factor == 0.0)
        *error = QStringLiteral("with the factor %1, nothing is left of the value").arg(quoted(factor));
    else if (!sign.isEmpty() && !finiteNumberFromText(match.captured(5), &term->offset))
        *error = QStringLiteral("the offset %1 is not a finite number").arg(quoted(match.captured(5)));
    if (!error->isEmpty())
        return false;
    term->name = match.captured(1);
    term->element = match.captured(2).isEmpty() ? -1 : match.captured(2).toInt();
    term->offset = sign == QLatin1String("-") ? -term->offset : term->offset;
    return true;
}

void ConfigurationFile::readIni(const QByteArray &text, const QString &firstSections)
{
    IniParser parser(text);
    for (IniItem item = parser.next(); item.kind != IniItem::End; item = parser.next()) {
        if (!item.error.isEmpty())
            addError(item.line, item.errorColumn, item.error);
        else if (item.kind == IniItem::Section)
            addSection(item.name, item.line, item.column);
        else if (m_sections.isEmpty())
            addError(item.line, item.column,
                     QStringLiteral("%1 stands before the first section; begin with %2")
                         .arg(quoted(item.name), firstSections));
        else
            addEntry(m_sections.size() - 1, {item.name, item.value, item.line, item.valueColumn});
    }
}

void ConfigurationFile::addSection(const QString &name, int line, int column)
{
    const auto isSame = [&](const ConfigurationSection &section) { return section.name == name; };
    if (std::any_of(m_sections.begin(), m_sections.end(), isSame))
        addError(line, column, QStringLiteral("section %1 is there twice; put its lines together").arg(quoted(name)));
    m_sections.append({name, line, {}});
}

void ConfigurationFile::addEntry(int section, const ConfigurationEntry &entry)
{
    QVector<ConfigurationEntry> &entries = m_sections[section].entries;
    const auto isSame = [&](const ConfigurationEntry &other) { return other.key == entry.key; };
    const auto former = std::find_if(entries.begin(), entries.end(), isSame);
    if (former != entries.end())
        addError(entry.line, 1,
                 QStringLiteral("%1 is there twice, first in line %2; leave one of them out")
                     .arg(quoted(entry.key))
                     .arg(former->line));
    else
        entries.append(entry);
}

void ConfigurationFile::addError(int line, int column, const QString &message)
{
    m_errors.append({m_fileName, line, column, message});
}

void ConfigurationFile::addError(const ConfigurationEntry &entry, const QString &message)
{
    addError(entry.line, entry.column, message);
}

}  // namespace qplc
