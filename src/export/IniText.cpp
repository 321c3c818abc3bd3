// SPDX-License-Identifier: Apache-2.0
#include "IniText.h"

namespace qplc_export {

namespace {

/// "[a], [b] or [c]"
QString listOf(const QStringList &sections)
{
    QStringList names;
    for (const QString &section : sections)
        names << QStringLiteral("[%1]").arg(section);
    const QString last = names.takeLast();
    return names.isEmpty() ? last : QStringLiteral("%1 or %2").arg(names.join(QStringLiteral(", ")), last);
}

/// \param section  the current one; a line may begin another one
bool readLine(const QString &text, const QStringList &sections, const QString &expected, QString *section,
              const std::function<bool(const IniLine &, QString *)> &take, QString *error)
{
    if (text.startsWith(QLatin1Char('['))) {
        *section = text.mid(1, text.size() - 2);
        const bool isKnown = text.endsWith(QLatin1Char(']')) && sections.contains(*section);
        if (!isKnown)
            *error = QStringLiteral("unknown section %1; use %2").arg(text, listOf(sections));
        return isKnown;
    }
    const int equals = text.indexOf(QLatin1Char('='));
    if (equals >= 1 && !section->isEmpty())
        return take({*section, text.left(equals).trimmed(), text.mid(equals + 1).trimmed()}, error);
    *error
        = QStringLiteral("'%1' is not expected here; write %2 in a section %3").arg(text, expected, listOf(sections));
    return false;
}

}  // namespace

bool readIni(const QByteArray &text, const QString &name, const QStringList &sections, const QString &expected,
             const std::function<bool(const IniLine &line, QString *error)> &take, QString *error)
{
    QString section;
    const QStringList lines = QString::fromUtf8(text).split(QLatin1Char('\n'));
    for (int number = 0; number < lines.size(); ++number) {
        const QString line = lines.at(number).section(QLatin1Char(';'), 0, 0).section(QLatin1Char('#'), 0, 0).trimmed();
        if (line.isEmpty() || readLine(line, sections, expected, &section, take, error))
            continue;
        *error = QStringLiteral("%1:%2: %3").arg(name).arg(number + 1).arg(*error);
        return false;
    }
    return true;
}

}  // namespace qplc_export
