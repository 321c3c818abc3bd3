// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QString>
#include <QtCore/QStringList>

#include <functional>

namespace qplc_export {

/// A line `key = value` of an INI text. Comments, which begin with ; or #, are cut.
struct IniLine
{
    QString section;
    QString key;
    QString value;
};

/// What a text may look like.
struct IniForm
{
    QStringList sections;
    QString line;       // for a message: "SIGNAL = RECORD"
    QStringList lists;  // keys that may be there several times
    std::function<bool(const IniLine &line, QString *error)> take;
};

/// Calls \a form.take for each line.
/// \return false, with all that is wrong in \a error: one line each, with name, number and remedy
bool readIni(const QByteArray &text, const QString &name, const IniForm &form, QString *error);

}  // namespace qplc_export
