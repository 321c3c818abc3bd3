// SPDX-License-Identifier: Apache-2.0
// keys: makes, shows and revokes pre-shared keys. Needs no master. Keys themselves are never
// printed.
#include "Commands.h"
#include "TerminalText.h"
#include "node/security/Keyring.h"
#include "node/security/SecretFile.h"

#include <QtCore/QFile>
#include <QtCore/QJsonArray>
#include <QtCore/QRandomGenerator>

namespace tools {

namespace {

using qplc::Keyring;
using qplc::SecretFile;

QByteArray newKey()
{
    quint32 words[Keyring::KeySize / sizeof(quint32)];
    QRandomGenerator::system()->fillRange(words);
    return QByteArray(reinterpret_cast<const char *>(words), sizeof words).toHex();
}

QByteArray sectionOf(const QString &identity, const QByteArray &key, qplc::Role role)
{
    return QStringLiteral("[%1]\nkey = %2\nrole = %3\n")
        .arg(identity, QString::fromLatin1(key), qplc::roleName(role))
        .toUtf8();
}

/// The lines of a file without the section that begins in \a line, up to the next one.
QByteArray without(const QByteArray &text, int line)
{
    QByteArray rest;
    int number = 0;
    bool isInside = false;
    for (const QByteArray &content : text.split('\n')) {
        ++number;
        if (number == line)
            isInside = true;
        else if (isInside && content.trimmed().startsWith('['))
            isInside = false;
        if (!isInside)
            rest += content + '\n';
    }
    while (rest.endsWith("\n\n"))
        rest.chop(1);
    return rest == "\n" ? QByteArray() : rest;
}

/// A file with keys: its text, and what it says. One that is not there is empty.
struct KeyFile
{
    QString name;
    QByteArray text;
    Keyring keys;

    bool read(QString *error)
    {
        return SecretFile::read(name, SecretFile::Secret, &text, error) && keys.parse(text, name, error);
    }
};

/// Tells what is wrong. \return whether the file is written
bool write(const QString &fileName, const QByteArray &content)
{
    QString problem;
    const bool isWritten = SecretFile::write(fileName, content, &problem);
    if (!problem.isEmpty())
        QPlcCoreApplication::printError(problem);
    return isWritten;
}

int failure(const QString &text)
{
    QPlcCoreApplication::printError(text);
    return QPlcCoreApplication::Failure;
}

int newOne(const CommandCall &call, KeyFile &file, const QString &identity)
{
    const QString roleText = call.application.value(QStringLiteral("role"));
    const std::optional<qplc::Role> role
        = call.application.isSet(QStringLiteral("role")) ? qplc::roleOf(roleText) : qplc::Role::Node;
    if (!role)
        return call.application.usageError(
            QStringLiteral("--role '%1': use Observer, Operator, Node or Engineer").arg(printable(roleText)));
    QString error;
    if (QFile::exists(file.name) && !file.read(&error))
        return failure(error);
    const Keyring::Entry *known = file.keys.find(identity);
    if (known && !call.application.isSet(QStringLiteral("replace")))
        return failure(
            QStringLiteral("%1 has a key of '%2' already; use --replace for another one").arg(file.name, identity));
    const QString copy = call.application.value(QStringLiteral("copy"));
    if (!copy.isEmpty() && QFile::exists(copy) && !call.application.isSet(QStringLiteral("replace")))
        return failure(QStringLiteral("%1 is there already; use --replace to write over it").arg(copy));
    const QByteArray section = sectionOf(identity, newKey(), *role);
    const QByteArray rest = known ? without(file.text, known->firstLine) : file.text;
    const QByteArray gap = rest.isEmpty() || rest.endsWith('\n') ? QByteArray() : QByteArrayLiteral("\n");
    if (!write(file.name, rest + gap + section) || (!copy.isEmpty() && !write(copy, section)))
        return QPlcCoreApplication::Failure;
    printText(QStringLiteral("%1: key of '%2' with role %3%4\n")
                  .arg(file.name, identity, qplc::roleName(*role),
                       copy.isEmpty() ? QString() : QStringLiteral("; alone in %1").arg(copy)));
    return QPlcCoreApplication::Success;
}

int list(const CommandCall &call, KeyFile &file)
{
    QString error;
    if (!file.read(&error))
        return failure(error);
    TextTable table;
    table.addColumn(QStringLiteral("identity"));
    table.addColumn(QStringLiteral("role"));
    QJsonArray array;
    const QMap<QString, Keyring::Entry> &entries = file.keys.entries();
    for (auto entry = entries.begin(); entry != entries.end(); ++entry) {
        table.addRow({entry.key(), qplc::roleName(entry->role)});
        array.append(QJsonObject{{QStringLiteral("identity"), entry.key()},
                                 {QStringLiteral("role"), qplc::roleName(entry->role)}});
    }
    if (call.isJson())
        printJson(QJsonDocument(array));
    else
        table.print();
    return QPlcCoreApplication::Success;
}

int revoke(KeyFile &file, const QString &identity)
{
    QString error;
    if (!file.read(&error))
        return failure(error);
    const Keyring::Entry *entry = file.keys.find(identity);
    if (!entry)
        return failure(QStringLiteral("%1 has no key of '%2'").arg(file.name, printable(identity)));
    if (!write(file.name, without(file.text, entry->firstLine)))
        return QPlcCoreApplication::Failure;
    printText(QStringLiteral("%1: the key of '%2' is revoked; a master that runs ends its connections within 0.5 s\n")
                  .arg(file.name, identity));
    return QPlcCoreApplication::Success;
}

}  // namespace

int manageKeys(const CommandCall &call)
{
    const QString action = call.arguments.value(0);
    const bool isList = action == QLatin1String("list");
    if (!isList && action != QLatin1String("new") && action != QLatin1String("revoke"))
        return call.application.usageError(QStringLiteral("keys %1: use new, list or revoke").arg(printable(action)));
    if (call.arguments.size() != (isList ? 1 : 2))
        return call.application.usageError(isList ? QStringLiteral("keys list takes no IDENTITY")
                                                  : QStringLiteral("keys %1 needs an IDENTITY").arg(action));
    if (!call.application.isSet(QStringLiteral("keys")))
        return call.application.usageError(QStringLiteral("keys %1 needs --keys FILE").arg(action));
    const QString identity = call.arguments.value(1);
    if (!isList && !Keyring::isIdentity(identity))
        return call.application.usageError(
            QStringLiteral("'%1' is not a valid identity; use 1 ... %2 letters, digits, '.', '-', '_'")
                .arg(printable(identity))
                .arg(Keyring::LongestIdentity));
    KeyFile file{call.application.value(QStringLiteral("keys")), {}, {}};
    if (isList)
        return list(call, file);
    return action == QLatin1String("new") ? newOne(call, file, identity) : revoke(file, identity);
}

}  // namespace tools
