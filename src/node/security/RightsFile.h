// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AccessRights.h"

#include <QtCore/QMap>
#include <QtCore/QVector>

namespace qplc {

/// What a file with keys or rights says of one identity: a section with entries.
struct RightsSection
{
    struct Value
    {
        QString text;
        int line = 0;
        int column = 0;
    };

    QString fileName;
    QString identity;
    int line = 0;
    QMap<QString, Value> values;

    /// Cuts \a text into sections; each of them may have the entries \a keys, and no other. \return
    /// false, with file, line, column and remedy in \a error
    static bool parse(const QByteArray &text, const QString &fileName, const QStringList &keys,
                      QVector<RightsSection> *sections, QString *error);

    QString value(const QString &key) const { return values.value(key).text; }
    /// "keys.ini:3:7" of an entry, or of the section when it has none of this name
    QString place(const QString &key) const;
    /// The entry "role", which has to be there.
    bool readRole(Role *role, QString *error) const;
};

/// Roles of identities, and the signals that they may write (access.ini).
///
/// ```ini
/// [Winch]
/// role = Node
/// writes = tetherLength, tether*
/// ```
/// Without `writes` an identity may write what its role may.
class AccessList
{
public:
    /// \return false, with file, line, column and remedy in \a error
    bool read(const QString &fileName, QString *error);
    bool parse(const QByteArray &text, const QString &fileName, QString *error);

    QStringList identities() const { return m_peers.keys(); }
    bool contains(const QString &identity) const { return m_peers.contains(identity); }
    /// Gives \a peer the role and rights of its identity, if they are known here.
    void apply(Peer *peer) const;

private:
    QMap<QString, Peer> m_peers;
};

}  // namespace qplc
