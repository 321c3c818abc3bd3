// SPDX-License-Identifier: Apache-2.0
#include "IniText.h"

#include <QtCore/QHash>

namespace qplc_export {

namespace {

constexpr int MostErrors = 10;  // that a log can show

/// "[a], [b] or [c]"
QString listOf(const QStringList &sections)
{
    QStringList names;
    for (const QString &section : sections)
        names << QStringLiteral("[%1]").arg(section);
    const QString last = names.takeLast();
    return names.isEmpty() ? last : QStringLiteral("%1 or %2").arg(names.join(QStringLiteral(", ")), last);
}

/// Reads one line after the other.
class Reader
{
public:
    explicit Reader(const IniForm &form)
        : m_form(form)
    {
    }

    /// \return what is wrong with the line; empty: nothing
    QString read(const QString &text, int number)
    {
        if (text.startsWith(QLatin1Char('[')))
            return beginSection(text);
        if (m_isUnknown)
            return {};  // its head has been told
        const int equals = text.indexOf(QLatin1Char('='));
        if (equals < 1 || m_section.isEmpty())
            return QStringLiteral("'%1' is not expected here; write %2 in a section %3")
                .arg(text, m_form.line, listOf(m_form.sections));
        return takeLine({m_section, text.left(equals).trimmed(), text.mid(equals + 1).trimmed()}, number);
    }

private:
    QString beginSection(const QString &text)
    {
        m_section = text.mid(1, text.size() - 2);
        m_isUnknown = !text.endsWith(QLatin1Char(']')) || !m_form.sections.contains(m_section);
        return m_isUnknown ? QStringLiteral("unknown section %1; use %2").arg(text, listOf(m_form.sections))
                           : QString();
    }
    QString takeLine(const IniLine &line, int number)
    {
        const QString place = line.section + QLatin1Char('\n') + line.key;
        const auto first = m_lines.constFind(place);
        if (first != m_lines.constEnd() && !m_form.lists.contains(line.key))
            return QStringLiteral("'%1' is there twice, first in line %2; leave one of them out")
                .arg(line.key)
                .arg(*first);
        if (first == m_lines.constEnd())
            m_lines.insert(place, number);
        QString error;
        return m_form.take(line, &error) ? QString() : error;
    }

    const IniForm &m_form;
    QString m_section;
    bool m_isUnknown = false;
    QHash<QString, int> m_lines;  // of each key
};

}  // namespace

bool readIni(const QByteArray &text, const QString &name, const IniForm &form, QString *error)
{
    Reader reader(form);
    QStringList errors;
    int more = 0;
    const QStringList lines = QString::fromUtf8(text).split(QLatin1Char('\n'));
    for (int number = 1; number <= lines.size(); ++number) {
        const QString line
            = lines.at(number - 1).section(QLatin1Char(';'), 0, 0).section(QLatin1Char('#'), 0, 0).trimmed();
        const QString problem = line.isEmpty() ? QString() : reader.read(line, number);
        if (problem.isEmpty())
            continue;
        if (errors.size() < MostErrors)
            errors << QStringLiteral("%1:%2: %3").arg(name).arg(number).arg(problem);
        else
            ++more;
    }
    if (more > 0)
        errors << QStringLiteral("%1: there are %2 more errors").arg(name).arg(more);
    *error = errors.join(QLatin1Char('\n'));
    return errors.isEmpty();
}

}  // namespace qplc_export
