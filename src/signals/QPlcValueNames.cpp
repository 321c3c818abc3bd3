// SPDX-License-Identifier: Apache-2.0
#include "QPlcValueNames.h"

#include "MessageText.h"

#include <QtCore/QStringList>

#include <algorithm>

using qplc::quoted;

namespace {

constexpr int longestName = 63;

bool isNumber(const QString &text)
{
    bool isIt = false;
    text.toDouble(&isIt);
    return isIt;
}

bool isBelow(const QPlcValueNames::Entry &entry, qint64 value)
{
    return entry.value < value;
}

QString complaintAboutName(const QString &name)
{
    if (name.isEmpty() || name.size() > longestName)
        return QStringLiteral("the name %1 has %2 characters; give it 1 ... %3")
            .arg(quoted(name))
            .arg(name.size())
            .arg(longestName);
    if (name.contains(QLatin1Char(':')))
        return QStringLiteral("a name cannot contain ':' as in %1; write ',' between two names").arg(quoted(name));
    if (isNumber(name))
        return QStringLiteral("the name %1 is a number; give it a letter").arg(quoted(name));
    return {};
}

}  // namespace

QPlcValueNames QPlcValueNames::fromText(const QString &text, QString *error)
{
    QPlcValueNames names;
    QString complaint;
    const QStringList parts = text.split(QLatin1Char(','));
    for (auto part = parts.begin(); part != parts.end() && complaint.isEmpty(); ++part)
        complaint = names.add(*part);
    if (error)
        *error = complaint;
    return complaint.isEmpty() ? names : QPlcValueNames();
}

QString QPlcValueNames::add(const QString &text)
{
    const int colon = text.indexOf(QLatin1Char(':'));
    if (colon < 0)
        return QStringLiteral("%1 does not name a value; write names as '0: Off, 1: On'").arg(quoted(text.trimmed()));
    const QString number = text.left(colon).trimmed();
    const QString name = text.mid(colon + 1).trimmed();
    bool isInteger = false;
    const qint64 value = number.toLongLong(&isInteger);
    if (!isInteger)
        return QStringLiteral("%1 is not an integer; only integers have names").arg(quoted(number));
    const QString complaint = complaintAboutName(name);
    if (!complaint.isEmpty())
        return complaint;
    const auto place = std::lower_bound(m_entries.begin(), m_entries.end(), value, isBelow);
    if (place != m_entries.end() && place->value == value)
        return QStringLiteral("the value %1 has two names, %2 and %3; remove one")
            .arg(value)
            .arg(quoted(place->name), quoted(name));
    for (const Entry &entry : qAsConst(m_entries)) {
        if (entry.name == name)
            return QStringLiteral("the name %1 stands for %2 and for %3; rename one")
                .arg(quoted(name))
                .arg(entry.value)
                .arg(value);
    }
    m_entries.insert(place, {value, name});
    return {};
}

QString QPlcValueNames::toText() const
{
    QStringList parts;
    for (const Entry &entry : m_entries)
        parts.append(QStringLiteral("%1: %2").arg(entry.value).arg(entry.name));
    return parts.join(QStringLiteral(", "));
}

QString QPlcValueNames::nameOf(qint64 value) const
{
    const auto place = std::lower_bound(m_entries.begin(), m_entries.end(), value, isBelow);
    return place != m_entries.end() && place->value == value ? place->name : QString();
}

std::optional<qint64> QPlcValueNames::valueOf(const QString &name) const
{
    std::optional<qint64> similar;
    for (const Entry &entry : m_entries) {
        if (entry.name == name)
            return entry.value;
        if (!similar && entry.name.compare(name, Qt::CaseInsensitive) == 0)
            similar = entry.value;
    }
    return similar;
}
