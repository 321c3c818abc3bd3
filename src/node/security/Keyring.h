// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AccessRights.h"

#include <QtCore/QByteArray>
#include <QtCore/QMap>

namespace qplc {

/// What a file with keys holds (keys.ini): for each identity a key and a role.
///
/// ```ini
/// [Winch]
/// key = 64 hexadecimal digits
/// role = Node
/// ```
class Keyring
{
public:
    static constexpr int KeySize = 32;  // [byte]
    static constexpr int LongestIdentity = 64;

    struct Entry
    {
        QByteArray key;
        Role role = Role::Node;
        int firstLine = 0;  // of the file, from 1: its section and what follows up to the next one
    };

    /// \return false, with file, line, column and remedy in \a error; keys are never part of it
    bool read(const QString &fileName, QString *error);
    /// As read(), of a text. \param fileName  for errors
    bool parse(const QByteArray &text, const QString &fileName, QString *error);

    const QMap<QString, Entry> &entries() const { return m_entries; }
    /// null: there is none of this name
    const Entry *find(const QString &identity) const;

    /// Whether \a identity can be one: 1 ... 64 letters, digits, '.', '-', '_', the first one a
    /// letter or digit.
    static bool isIdentity(const QString &identity);

private:
    QMap<QString, Entry> m_entries;
};

}  // namespace qplc
