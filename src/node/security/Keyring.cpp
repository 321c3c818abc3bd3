// SPDX-License-Identifier: Apache-2.0
#include "Keyring.h"

#include "RightsFile.h"
#include "SecretFile.h"

#include <QtCore/QRegularExpression>

namespace qplc {

namespace {

bool readKey(const QString &text, QByteArray *key)
{
    static const QRegularExpression digits(QStringLiteral("\\A[0-9a-fA-F]{%1}\\z").arg(2 * Keyring::KeySize));
    *key = QByteArray::fromHex(text.toLatin1());
    return digits.match(text).hasMatch();
}

}  // namespace

bool Keyring::isIdentity(const QString &identity)
{
    static const QRegularExpression pattern(
        QStringLiteral("\\A[A-Za-z0-9][A-Za-z0-9._-]{0,%1}\\z").arg(LongestIdentity - 1));
    return pattern.match(identity).hasMatch();
}

const Keyring::Entry *Keyring::find(const QString &identity) const
{
    const auto found = m_entries.constFind(identity);
    return found == m_entries.constEnd() ? nullptr : &found.value();
}

bool Keyring::read(const QString &fileName, QString *error)
{
    QByteArray text;
    return SecretFile::read(fileName, SecretFile::Secret, &text, error) && parse(text, fileName, error);
}

bool Keyring::parse(const QByteArray &text, const QString &fileName, QString *error)
{
    m_entries.clear();
    QVector<RightsSection> sections;
    if (!RightsSection::parse(text, fileName, {QStringLiteral("key"), QStringLiteral("role")}, &sections, error))
        return false;
    for (const RightsSection &section : qAsConst(sections)) {
        Entry entry;
        entry.firstLine = section.line;
        if (!readKey(section.value(QStringLiteral("key")), &entry.key)) {
            *error = QStringLiteral("%1: '%2' needs key = %3 hexadecimal digits; make one with qtplc keys new")
                         .arg(section.place(QStringLiteral("key")), section.identity)
                         .arg(2 * KeySize);
            return false;
        }
        if (!section.readRole(&entry.role, error))
            return false;
        m_entries.insert(section.identity, entry);
    }
    return true;
}

}  // namespace qplc
