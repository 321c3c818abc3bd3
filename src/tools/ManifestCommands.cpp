// SPDX-License-Identifier: Apache-2.0
// manifest, check: the nodes that a plant needs, as a file.
#include "Commands.h"
#include "TerminalText.h"
#include "signals/MessageText.h"

#include <QtCore/QJsonArray>

namespace tools {

namespace messages = qplc::messages;

namespace {

/// What the plant that \a state is about would need, if it were right as it is.
QPlcManifest manifestOf(const messages::State &state)
{
    QPlcManifest manifest;
    QPlcProfile::fromName(state.profile, &manifest.profile);
    for (const QPlcNodeInfo &node : state.nodes) {
        if (!node.listener)
            manifest.nodes.append({node.name,
                                   node.critical ? QPlcManifest::Critical : QPlcManifest::Required,
                                   {node.transport},
                                   node.watchdog,
                                   node.identity});
    }
    return manifest;
}

QJsonDocument jsonOf(const QPlcManifest &manifest)
{
    QJsonArray nodes;
    for (const QPlcManifest::Node &node : manifest.nodes)
        nodes.append(QJsonObject{{QStringLiteral("need"), QPlcManifest::needName(node.need)},
                                 {QStringLiteral("name"), node.name},
                                 {QStringLiteral("transport"), QJsonArray::fromStringList(node.transports)},
                                 {QStringLiteral("watchdog"), double(node.watchdog.count())},
                                 {QStringLiteral("identity"), node.identity}});
    return QJsonDocument(QJsonObject{{QStringLiteral("profile"), QPlcProfile::name(manifest.profile)},
                                     {QStringLiteral("nodes"), nodes}});
}

int refused(const QString &text)
{
    QPlcCoreApplication::printError(text);
    return QPlcCoreApplication::Failure;
}

/// Signals whose writers are all missing in \a manifest: no start waits for any of them.
QStringList unneededWriters(const QPlcManifest &manifest, const QPlcSignalTable &table)
{
    const auto isNeeded = [&](const QString &name) {
        const QPlcManifest::Node *node = manifest.find(name);
        return node && node->need != QPlcManifest::Optional;
    };
    QStringList texts;
    for (const QPlcSignalDefinition &signal : table) {
        if (!signal.writers.isEmpty() && std::none_of(signal.writers.begin(), signal.writers.end(), isNeeded))
            texts << QStringLiteral(
                         "signal '%1' has 'writer = %2' in the table, and the plant starts without that node; "
                         "add [%3] to the manifest, or make it required")
                         .arg(signal.name, signal.writers.join(QStringLiteral(" > ")), signal.writers.constFirst());
    }
    return texts;
}

}  // namespace

int writeManifest(const CommandCall &call)
{
    messages::State state;
    if (!call.connect() || !call.ask(messages::GetState(), &state))
        return call.exitCode();
    const QPlcManifest manifest = manifestOf(state);
    if (manifest.isEmpty())
        return refused(QStringLiteral("no node is registered; start the nodes of the plant first"));
    const QByteArray text = manifest.toIni();
    QVector<QPlcParseError> errors;
    if (QPlcManifest::fromIni(text, &errors).toIni() != text)
        return refused(
            QStringLiteral("a manifest cannot have a node of this plant: %1")
                .arg(errors.isEmpty() ? QStringLiteral("give it a name without ']'") : errors.constFirst().message));
    if (call.isJson())
        printJson(jsonOf(manifest));
    else
        printText(QString::fromUtf8(text));
    return QPlcCoreApplication::Success;
}

int checkManifest(const CommandCall &call)
{
    QVector<QPlcParseError> errors;
    const QString fileName = call.arguments.value(0);
    const QPlcManifest manifest = QPlcManifest::fromIniFile(fileName, &errors);
    QPlcSignalTable table;
    if (call.arguments.size() > 1) {
        QVector<QPlcParseError> errorsOfTable;
        table = QPlcSignalTable::fromIniFile(call.arguments.at(1), &errorsOfTable);
        errors += errorsOfTable;
    }
    if (!errors.isEmpty())
        return call.application.usageError(QPlcParseError::toString(errors));
    const QStringList writers = unneededWriters(manifest, table);
    for (const QString &text : writers)
        QPlcCoreApplication::printError(QStringLiteral("%1: %2").arg(fileName, text));
    if (call.isJson())
        printJson(jsonOf(manifest));
    else if (writers.isEmpty())
        printLine(QStringLiteral("%1: %2 node%3, no errors")
                      .arg(fileName)
                      .arg(manifest.nodes.size())
                      .arg(manifest.nodes.size() == 1 ? QString() : QStringLiteral("s")));
    return writers.isEmpty() ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure;
}

}  // namespace tools
