// SPDX-License-Identifier: Apache-2.0
#include "QPlcDriverSettings.h"

#include "DriverSettingsData.h"
#include "signals/DurationText.h"
#include "signals/MessageText.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>

#include <algorithm>
#include <cmath>

using qplc::ConfigurationEntry;
using qplc::durationText;
using qplc::quoted;

const ConfigurationEntry *QPlcDriverSettings::Private::find(const QString &key)
{
    asked << key;
    used.insert(key);
    const auto found = std::find_if(entries.cbegin(), entries.cend(),
                                    [&](const ConfigurationEntry &entry) { return entry.key == key; });
    return found == entries.cend() ? nullptr : &*found;
}

QPlcDriverSettings::QPlcDriverSettings(std::unique_ptr<Private> data)
    : d(std::move(data))
{
}

QPlcDriverSettings::~QPlcDriverSettings() = default;

QString QPlcDriverSettings::name() const
{
    return d->name;
}

bool QPlcDriverSettings::has(const QString &key) const
{
    return std::any_of(d->entries.cbegin(), d->entries.cend(),
                       [&](const ConfigurationEntry &entry) { return entry.key == key; });
}

QString QPlcDriverSettings::text(const QString &key, const QString &defaultValue)
{
    const ConfigurationEntry *entry = d->find(key);
    return entry ? entry->value : defaultValue;
}

QString QPlcDriverSettings::requiredText(const QString &key, const QString &example)
{
    const QString value = text(key);
    if (value.isEmpty())
        d->addError(
            d->section,
            QStringLiteral("section %1 needs the key '%2', for example '%2 = %3'").arg(quoted(d->name), key, example));
    return value;
}

double QPlcDriverSettings::number(const QString &key, double defaultValue, double minimum, double maximum)
{
    const ConfigurationEntry *entry = d->find(key);
    if (!entry)
        return defaultValue;
    bool isNumber = false;
    const double value = entry->value.toDouble(&isNumber);
    if (isNumber && value >= minimum && value <= maximum)
        return value;
    d->addError(*entry,
                QStringLiteral("%1 = %2 is not a number from %3 to %4")
                    .arg(key, quoted(entry->value))
                    .arg(minimum)
                    .arg(maximum));
    return defaultValue;
}

qint64 QPlcDriverSettings::integer(const QString &key, qint64 defaultValue, qint64 minimum, qint64 maximum)
{
    const ConfigurationEntry *entry = d->find(key);
    if (!entry)
        return defaultValue;
    bool isNumber = false;
    const bool isHexadecimal = entry->value.startsWith(QLatin1String("0x"), Qt::CaseInsensitive);
    const qint64 value = entry->value.toLongLong(&isNumber, isHexadecimal ? 16 : 10);
    if (isNumber && value >= minimum && value <= maximum)
        return value;
    d->addError(*entry,
                QStringLiteral("%1 = %2 is not a whole number from %3 to %4")
                    .arg(key, quoted(entry->value))
                    .arg(minimum)
                    .arg(maximum));
    return defaultValue;
}

bool QPlcDriverSettings::truth(const QString &key, bool defaultValue)
{
    static const QStringList yes{QStringLiteral("yes"), QStringLiteral("true"), QStringLiteral("on"),
                                 QStringLiteral("1")};
    static const QStringList no{QStringLiteral("no"), QStringLiteral("false"), QStringLiteral("off"),
                                QStringLiteral("0")};
    const ConfigurationEntry *entry = d->find(key);
    if (!entry)
        return defaultValue;
    if (!yes.contains(entry->value) && !no.contains(entry->value))
        d->addError(*entry,
                    QStringLiteral("%1 = %2 is not a truth value; write 'yes' or 'no'").arg(key, quoted(entry->value)));
    return yes.contains(entry->value) || (defaultValue && !no.contains(entry->value));
}

std::chrono::nanoseconds QPlcDriverSettings::duration(const QString &key, std::chrono::nanoseconds defaultValue,
                                                      std::chrono::nanoseconds minimum,
                                                      std::chrono::nanoseconds maximum)
{
    const ConfigurationEntry *entry = d->find(key);
    if (!entry)
        return defaultValue;
    double value = 0.0;
    if (!qplc::durationFromText(entry->value, &value))
        d->addError(*entry,
                    QStringLiteral("%1 = %2 is not a duration; write a number and its unit: '10 ms', '250 us', '2 s'")
                        .arg(key, quoted(entry->value)));
    else if (value < double(minimum.count()) || value > double(maximum.count()))
        d->addError(*entry,
                    QStringLiteral("%1 = %2 is not in the range of %3 to %4")
                        .arg(key, quoted(entry->value), durationText(minimum), durationText(maximum)));
    else
        return std::chrono::nanoseconds(qint64(std::llround(value)));
    return defaultValue;
}

int QPlcDriverSettings::choice(const QString &key, const QStringList &words, int defaultValue)
{
    const ConfigurationEntry *entry = d->find(key);
    if (!entry)
        return defaultValue;
    const int index = words.indexOf(entry->value);
    if (index >= 0)
        return index;
    d->addError(*entry,
                QStringLiteral("%1 = %2 is not one of '%3'")
                    .arg(key, quoted(entry->value), words.join(QStringLiteral("', '"))));
    return defaultValue;
}

QStringList QPlcDriverSettings::list(const QString &key)
{
    QStringList words;
    for (const QString &word : text(key).split(QLatin1Char(','), Qt::SkipEmptyParts))
        words << word.trimmed();
    return words;
}

QString QPlcDriverSettings::fileName(const QString &key)
{
    const QString value = text(key);
    if (value.isEmpty() || QFileInfo(value).isAbsolute())
        return value;
    return QFileInfo(d->fileName).dir().filePath(value);
}

QStringList QPlcDriverSettings::namesBehind(const QString &prefix) const
{
    QStringList names;
    for (const ConfigurationEntry &entry : d->entries) {
        if (entry.key.startsWith(prefix))
            names << entry.key.mid(prefix.size());
    }
    return names;
}

QStringList QPlcDriverSettings::usedChannels() const
{
    return d->usedChannels;
}

void QPlcDriverSettings::addError(const QString &key, const QString &message)
{
    d->addError(d->placeOf(key), message);
}

void QPlcDriverSettings::addWarning(const QString &key, const QString &message)
{
    const ConfigurationEntry &place = d->placeOf(key);
    d->warnings->append({d->fileName, place.line, place.column, message});
}

void QPlcDriverSettings::claim(const QString &key, const QString &what, const QString &user)
{
    const ConfigurationEntry &place = d->placeOf(key);
    const auto former = d->claims->constFind(what);
    if (former == d->claims->constEnd())
        d->claims->insert(what, {place.line, user});
    else if (user.isEmpty() || former->user != user)
        d->addError(place,
                    QStringLiteral("%1 is used twice, first in line %2; use it once").arg(what).arg(former->line));
}

void QPlcDriverSettings::addErrors(const QVector<QPlcParseError> &errors)
{
    d->hasErrorsElsewhere = d->hasErrorsElsewhere || !errors.isEmpty();
    *d->errors += errors;
}
