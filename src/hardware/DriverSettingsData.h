// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "HardwareConfiguration.h"
#include "QPlcDriverSettings.h"

#include <QtCore/QMap>
#include <QtCore/QSet>

struct QPlcDriverSettings::Private
{
    QString name;
    QString fileName;
    qplc::ConfigurationEntry section;
    QVector<qplc::ConfigurationEntry> entries;
    QVector<QPlcParseError> *errors = nullptr;
    QVector<QPlcParseError> *warnings = nullptr;
    QMap<QString, qplc::HardwareConfiguration::Claim> *claims = nullptr;  // of all drivers
    QStringList failedKeys;                                               // that have an error
    bool hasErrorsElsewhere = false;                                      // in another file
    QSet<QString> used;
    QStringList usedChannels;
    QStringList asked;  // keys that the driver knows

    /// The value of \a key, which is used now; null: it is missing.
    const qplc::ConfigurationEntry *find(const QString &key);
    /// Where to tell something of \a key: at its entry, else at the section.
    const qplc::ConfigurationEntry &placeOf(const QString &key)
    {
        const qplc::ConfigurationEntry *entry = key.isEmpty() ? nullptr : find(key);
        return entry ? *entry : section;
    }
    void addError(const qplc::ConfigurationEntry &entry, const QString &message)
    {
        errors->append({fileName, entry.line, entry.column, message});
        failedKeys << entry.key;
    }
};
