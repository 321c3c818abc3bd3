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

/// Calls \a take for each line; stops at the first one that it refuses.
/// \param sections  that the text may have
/// \param expected  what a line should look like, for a message: "SIGNAL = RECORD"
/// \return false, with name, line and remedy in \a error
bool readIni(const QByteArray &text, const QString &name, const QStringList &sections, const QString &expected,
             const std::function<bool(const IniLine &line, QString *error)> &take, QString *error);

}  // namespace qplc_export
