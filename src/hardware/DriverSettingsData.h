// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "HardwareConfiguration.h"
#include "QPlcDriverSettings.h"

#include <QtCore/QSet>

struct QPlcDriverSettings::Private
{
    QString name;
    QString fileName;
    qplc::ConfigurationEntry section;
    QVector<qplc::ConfigurationEntry> entries;
    QVector<QPlcParseError> *errors = nullptr;
    QSet<QString> used;
    QStringList asked;  // keys that the driver knows

    /// The value of \a key, which is used now; null: it is missing.
    const qplc::ConfigurationEntry *find(const QString &key);
    void addError(const qplc::ConfigurationEntry &entry, const QString &message)
    {
        errors->append({fileName, entry.line, entry.column, message});
    }
};
