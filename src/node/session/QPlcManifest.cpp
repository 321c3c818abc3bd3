// SPDX-License-Identifier: Apache-2.0
#include "QPlcManifest.h"

#include "NodeSession.h"
#include "node/cycle/NodeRegistry.h"
#include "node/security/Keyring.h"
#include "protocol/messages/Registration.h"
#include "signals/DurationText.h"
#include "signals/MessageText.h"
#include "signals/TableReader.h"
#include "transport/TransportRegistry.h"

#include <QtCore/QHash>

#include <algorithm>

namespace qplc {

namespace {

using Need = QPlcManifest::Need;

constexpr Need needs[] = {QPlcManifest::Critical, QPlcManifest::Required, QPlcManifest::Optional};
constexpr qint64 largestFile = 1024 * 1024;  // [byte]
constexpr double shortestWatchdog = 1e6;     // [ns]

QStringList needNames()
{
    QStringList names;
    for (const Need need : needs)
        names << QPlcManifest::needName(need);
    return names;
}

/// What `transport =` may name, for nodes in the process of the master, too.
QStringList transportNames()
{
    QStringList names;
    for (const auto &kind : TransportRegistry::instance().kinds()) {
        if (!kind->first())
            names << kind->name();
    }
    return names << NodeSession::inProcess();
}

/// Reads the entries of a manifest and finds everything that is wrong with it.
class ManifestReader
{
public:
    ManifestReader(const QByteArray &text, const QString &fileName)
        : m_parser(text)
        , m_errors(fileName)
    {
    }

    /// Not to be used when there are errors.
    QPlcManifest read();
    QVector<QPlcParseError> errors() const { return m_errors.errors(); }

private:
    /// What a key of a node does with its value. \return what is wrong with it; empty: nothing
    struct Key
    {
        const char *name;
        QString (*read)(const QString &value, QPlcManifest::Node *node);
    };
    static const Key keys[4];
    static QString readNeed(const QString &value, QPlcManifest::Node *node);
    static QString readTransports(const QString &value, QPlcManifest::Node *node);
    static QString readWatchdog(const QString &value, QPlcManifest::Node *node);
    static QString readIdentity(const QString &value, QPlcManifest::Node *node);

    void openSection(const IniItem &item);
    void addEntry(const IniItem &item);
    void readEntry(const IniItem &item);
    QString readPlantEntry(const IniItem &item);

    IniParser m_parser;
    ErrorCollector m_errors;
    QPlcManifest m_manifest;
    QHash<QString, int> m_firstLines;  // of nodes
    QHash<QString, int> m_keyLines;    // of the open section
};

const ManifestReader::Key ManifestReader::keys[]
    = {{"need", &readNeed}, {"transport", &readTransports}, {"watchdog", &readWatchdog}, {"identity", &readIdentity}};

QPlcManifest ManifestReader::read()
{
    for (IniItem item = m_parser.next(); item.kind != IniItem::End; item = m_parser.next()) {
        if (item.kind == IniItem::Section)
            openSection(item);
        if (!item.error.isEmpty())
            m_errors.add(item.line, item.errorColumn, item.error);
        else if (item.kind == IniItem::Entry)
            addEntry(item);
    }
    if (m_manifest.nodes.isEmpty() && m_errors.count() == 0)
        m_errors.add(0, 0,
                     QStringLiteral("the manifest names no node; write [NAME] for each node that the plant needs"));
    return m_manifest;
}

void ManifestReader::openSection(const IniItem &item)
{
    QPlcManifest::Node node;
    node.name = item.name;
    m_manifest.nodes.append(node);
    m_keyLines.clear();
    if (!item.error.isEmpty())
        return;
    const int first = m_firstLines.value(item.name);
    if (first > 0)
        m_errors.add(
            item.line, item.column,
            QStringLiteral("duplicate node %1 (first at line %2); remove one").arg(quoted(item.name)).arg(first));
    else if (item.name == NodeRegistry::masterName())
        m_errors.add(item.line, item.column,
                     QStringLiteral("%1 is the name of the master; name a node").arg(quoted(item.name)));
    else if (QString error = NodeDeclaration::nameError(item.name); !error.isEmpty())
        m_errors.add(item.line, item.column, error);
    else
        m_firstLines.insert(item.name, item.line);
}

void ManifestReader::addEntry(const IniItem &item)
{
    const int first = m_keyLines.value(item.name);
    if (first > 0)
        m_errors.add(
            item.line, item.column,
            QStringLiteral("duplicate key %1 (first at line %2); remove one").arg(quoted(item.name)).arg(first));
    else
        readEntry(item);
    m_keyLines.insert(item.name, item.line);
}

void ManifestReader::readEntry(const IniItem &item)
{
    if (m_manifest.nodes.isEmpty()) {
        if (const QString error = readPlantEntry(item); !error.isEmpty())
            m_errors.add(item.line, item.name == QLatin1String("profile") ? item.valueColumn : item.column, error);
        return;
    }
    QStringList names;
    for (const Key &key : keys) {
        names << QString::fromLatin1(key.name);
        if (item.name != names.constLast())
            continue;
        if (const QString error = key.read(item.value, &m_manifest.nodes.last()); !error.isEmpty())
            m_errors.add(item.line, item.valueColumn, error);
        return;
    }
    const QStringList close = closeNames(item.name, names);
    m_errors.add(item.line, item.column,
                 QStringLiteral("unknown key ") + quoted(item.name)
                     + (close.isEmpty() ? QStringLiteral("; the keys are ") + names.join(QStringLiteral(", "))
                                        : didYouMean(close)));
}

QString ManifestReader::readPlantEntry(const IniItem &item)
{
    if (item.name != QLatin1String("profile"))
        return QStringLiteral("the key %1 stands before the first node; only 'profile' may stand there")
            .arg(quoted(item.name));
    if (QPlcProfile::fromName(item.value, &m_manifest.profile))
        return {};
    return QStringLiteral("%1 is not a profile; use Plant, Simulation or Automatic").arg(quoted(item.value));
}

QString ManifestReader::readNeed(const QString &value, QPlcManifest::Node *node)
{
    for (const Need need : needs) {
        if (value == QPlcManifest::needName(need)) {
            node->need = need;
            return {};
        }
    }
    const QStringList names = needNames();
    return QStringLiteral("%1 is not a need; use %2%3")
        .arg(quoted(value), names.join(QStringLiteral(", ")), didYouMean(closeNames(value, names)));
}

QString ManifestReader::readTransports(const QString &value, QPlcManifest::Node *node)
{
    const QStringList known = transportNames();
    for (const QString &part : value.split(QLatin1Char(','))) {
        const QString name = part.trimmed();
        if (!known.contains(name))
            return QStringLiteral("%1 is not a transport; use one or more of %2")
                .arg(quoted(name), known.join(QStringLiteral(", ")));
        node->transports << name;
    }
    return {};
}

QString ManifestReader::readWatchdog(const QString &value, QPlcManifest::Node *node)
{
    double time = 0.0;
    if (!durationFromText(value, &time) || time < shortestWatchdog || time > messages::Register::longestWatchdog)
        return QStringLiteral("%1 is not the time of a watchdog; use 1 ms ... 24 h, as in 'watchdog = 500 ms'")
            .arg(quoted(value));
    node->watchdog = std::chrono::nanoseconds(qRound64(time));
    return {};
}

QString ManifestReader::readIdentity(const QString &value, QPlcManifest::Node *node)
{
    node->identity = value;
    if (Keyring::isIdentity(value))
        return {};
    return QStringLiteral("%1 is not a valid identity; use 1 ... %2 letters, digits, '.', '-', '_'")
        .arg(quoted(value))
        .arg(Keyring::LongestIdentity);
}

}  // namespace

}  // namespace qplc

const QPlcManifest::Node *QPlcManifest::find(const QString &name) const
{
    const auto found = std::find_if(nodes.begin(), nodes.end(), [&](const Node &node) { return node.name == name; });
    return found != nodes.end() ? &*found : nullptr;
}

QPlcManifest QPlcManifest::fromIni(const QByteArray &text, QVector<QPlcParseError> *errors, const QString &fileName)
{
    qplc::ManifestReader reader(text, fileName);
    QPlcManifest manifest = reader.read();
    const QVector<QPlcParseError> found = reader.errors();
    if (errors)
        *errors = found;
    manifest.fileName = fileName;
    return found.isEmpty() ? manifest : QPlcManifest();
}

QPlcManifest QPlcManifest::fromIniFile(const QString &fileName, QVector<QPlcParseError> *errors)
{
    QByteArray text;
    if (qplc::IniParser::readFile(fileName, QStringLiteral("a manifest"), qplc::largestFile, &text, errors))
        return fromIni(text, errors, fileName);
    return {};
}

QByteArray QPlcManifest::toIni() const
{
    QString text;
    if (profile != QPlcProfile::Automatic)
        text = QStringLiteral("profile = %1\n").arg(QPlcProfile::name(profile));
    for (const Node &node : nodes) {
        text += QStringLiteral("%1[%2]\nneed = %3\n")
                    .arg(text.isEmpty() ? QString() : QStringLiteral("\n"), node.name, needName(node.need));
        if (!node.transports.isEmpty())
            text += QStringLiteral("transport = %1\n").arg(node.transports.join(QStringLiteral(", ")));
        if (node.watchdog.count() > 0)
            text += QStringLiteral("watchdog = %1\n").arg(qplc::durationText(node.watchdog));
        if (!node.identity.isEmpty())
            text += QStringLiteral("identity = %1\n").arg(node.identity);
    }
    return text.toUtf8();
}

QString QPlcManifest::needName(Need need)
{
    switch (need) {
    case Optional:
        return QStringLiteral("optional");
    case Required:
        return QStringLiteral("required");
    case Critical:
        return QStringLiteral("critical");
    }
    return {};
}
