// SPDX-License-Identifier: Apache-2.0
#include "RightsFile.h"

#include "Keyring.h"
#include "SecretFile.h"
#include "signals/IniParser.h"
#include "signals/MessageText.h"

#include <QtCore/QHash>

namespace qplc {

namespace {

QString placeOf(const QString &fileName, int line, int column)
{
    return QStringLiteral("%1:%2:%3").arg(fileName).arg(line).arg(column);
}

/// A word of such a file for a message. A long one may be a key, or most of one, in a wrong place.
QString shown(const QString &word)
{
    return word.size() > Keyring::KeySize ? QStringLiteral("a text of %1 characters").arg(word.size()) : quoted(word);
}

/// What is wrong with a line of such a file; empty: nothing.
/// \param lines  of the identities so far
QString complaint(const IniItem &item, const QStringList &keys, const QVector<RightsSection> &sections,
                  const QHash<QString, int> &lines)
{
    if (!item.error.isEmpty() || item.kind == IniItem::Broken)
        return QStringLiteral("this line cannot be read; use [identity] or name = value, in UTF-8");  // it may be a key
    if (item.kind == IniItem::Section) {
        if (!Keyring::isIdentity(item.name))
            return QStringLiteral("%1 is not a valid identity; use 1 ... %2 letters, digits, '.', '-', '_'")
                .arg(shown(item.name))
                .arg(Keyring::LongestIdentity);
        if (const auto line = lines.constFind(item.name); line != lines.constEnd())
            return QStringLiteral("'%1' has a section in line %2 already").arg(item.name).arg(*line);
        return {};
    }
    if (sections.isEmpty())
        return QStringLiteral("an entry before the first [identity]");
    if (!keys.contains(item.name))
        return QStringLiteral("unknown entry %1; use %2").arg(shown(item.name), keys.join(QStringLiteral(", ")));
    if (sections.constLast().values.contains(item.name))
        return QStringLiteral("'%1' twice").arg(item.name);
    return {};
}

}  // namespace

bool RightsSection::parse(const QByteArray &text, const QString &fileName, const QStringList &keys,
                          QVector<RightsSection> *sections, QString *error)
{
    IniParser parser(text);
    QHash<QString, int> lines;
    for (IniItem item = parser.next(); item.kind != IniItem::End; item = parser.next()) {
        const QString wrong = complaint(item, keys, *sections, lines);
        if (!wrong.isEmpty()) {
            *error = QStringLiteral("%1: %2").arg(
                placeOf(fileName, item.line, item.error.isEmpty() ? item.column : item.errorColumn), wrong);
            return false;
        }
        if (item.kind == IniItem::Section) {
            sections->append({fileName, item.name, item.line, {}});
            lines.insert(item.name, item.line);
        } else {
            sections->last().values.insert(item.name, {item.value, item.line, item.valueColumn});
        }
    }
    return true;
}

QString RightsSection::place(const QString &key) const
{
    const Value value = values.value(key);
    return value.line > 0 ? placeOf(fileName, value.line, value.column) : placeOf(fileName, line, 1);
}

bool RightsSection::readRole(Role *role, QString *error) const
{
    const QString name = QStringLiteral("role");
    if (const std::optional<Role> known = roleOf(value(name))) {
        *role = *known;
        return true;
    }
    *error = QStringLiteral("%1: '%2' has the role %3; use role = Observer, Operator, Node or Engineer")
                 .arg(place(name), identity, shown(value(name)));
    return false;
}

bool AccessList::read(const QString &fileName, QString *error)
{
    QByteArray text;
    return SecretFile::read(fileName, SecretFile::Trusted, &text, error) && parse(text, fileName, error);
}

bool AccessList::parse(const QByteArray &text, const QString &fileName, QString *error)
{
    m_peers.clear();
    QVector<RightsSection> sections;
    const QString writes = QStringLiteral("writes");
    if (!RightsSection::parse(text, fileName, {QStringLiteral("role"), writes}, &sections, error))
        return false;
    for (const RightsSection &section : qAsConst(sections)) {
        Peer peer;
        if (!section.readRole(&peer.role, error))
            return false;
        peer.mayWriteAll = !section.values.contains(writes);
        for (const QString &pattern : section.value(writes).split(QLatin1Char(','), Qt::SkipEmptyParts))
            peer.writes << pattern.trimmed();
        if (peer.role == Role::Observer && !peer.writes.isEmpty()) {
            *error = QStringLiteral("%1: '%2' is an Observer, who writes nothing; give it another role")
                         .arg(section.place(writes), section.identity);
            return false;
        }
        m_peers.insert(section.identity, peer);
    }
    return true;
}

void AccessList::apply(Peer *peer) const
{
    const auto known = m_peers.constFind(peer->identity);
    if (known == m_peers.constEnd())
        return;
    peer->role = known->role;
    peer->mayWriteAll = known->mayWriteAll;
    peer->writes = known->writes;
}

}  // namespace qplc
