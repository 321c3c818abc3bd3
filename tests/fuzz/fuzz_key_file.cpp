// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "node/security/Keyring.h"
#include "node/security/RightsFile.h"

namespace {

const QString fileName = QStringLiteral("fuzzed.ini");

/// Values of the entry "key" that stand nowhere else in \a text, so that they are no name or role.
QStringList secretsOf(const QByteArray &text)
{
    QVector<qplc::RightsSection> sections;
    QString error;
    QStringList secrets;
    if (!qplc::RightsSection::parse(text, fileName, {QStringLiteral("key"), QStringLiteral("role")}, &sections, &error))
        return secrets;
    for (const qplc::RightsSection &section : sections) {
        const QString key = section.value(QStringLiteral("key"));
        if (key.size() >= 16 && text.count(key.toUtf8()) == 1)
            secrets << key;
    }
    return secrets;
}

void readKeys(const QByteArray &text)
{
    qplc::Keyring keys;
    QString error;
    const bool isRead = keys.parse(text, fileName, &error);
    fuzz::check(isRead == error.isEmpty(), "a refusal has a reason");
    for (const QString &secret : secretsOf(text))
        fuzz::check(!error.contains(secret), "an error shows no key");
    for (auto entry = keys.entries().begin(); isRead && entry != keys.entries().end(); ++entry) {
        fuzz::check(qplc::Keyring::isIdentity(entry.key()), "each key belongs to an identity");
        fuzz::check(entry->key.size() == qplc::Keyring::KeySize && entry->firstLine > 0, "each key is a whole one");
    }
}

void readRights(const QByteArray &text)
{
    qplc::AccessList rights;
    QString error;
    const bool isRead = rights.parse(text, fileName, &error);
    fuzz::check(isRead == error.isEmpty(), "a refusal has a reason");
    qplc::messages::SetSignals values;
    values.values.insert(QStringLiteral("tetherLength"), QStringLiteral("1"));
    const QPlcMessage wish = qplc::messages::toMessage(values);
    for (const QString &identity : isRead ? rights.identities() : QStringList()) {
        qplc::Peer peer;
        peer.isSecured = true;
        peer.identity = identity;
        rights.apply(&peer);
        const bool maySend = qplc::whoMaySend(wish.kind()).contains(peer.role);
        fuzz::check(qplc::refusalOf(peer, wish).isEmpty() || !maySend || !peer.mayWriteAll,
                    "who may write everything may write a signal");
    }
}

}  // namespace

// Input: a file with keys, and the same text as a file with rights.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    const QByteArray text(reinterpret_cast<const char *>(data), int(size));
    readKeys(text);
    readRights(text);
    return 0;
}
