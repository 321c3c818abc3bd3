// SPDX-License-Identifier: Apache-2.0
#include "Happenings.h"

#include "RecordingMessages.h"
#include "signals/MessageText.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace qplc {

namespace {

std::optional<Happening::Topic> topicOf(const QByteArray &name)
{
    for (std::size_t i = 0; i < std::size(happeningChannels); ++i) {
        if (name == happeningChannels[i])
            return Happening::Topic(1U << i);
    }
    return std::nullopt;
}

QString textIn(const QJsonObject &object, const char *key)
{
    return object.value(QLatin1String(key)).toString();
}

/// " (operator, 127.0.0.1:4711)"
QString placeOf(const QJsonObject &object)
{
    QStringList parts{textIn(object, "role"), textIn(object, "address")};
    parts.removeAll(QString());
    return parts.isEmpty() ? QString() : QStringLiteral(" (%1)").arg(parts.join(QStringLiteral(", ")));
}

QString commandSentence(const QJsonObject &object)
{
    const QString who = QStringLiteral("'%1'%2").arg(textIn(object, "by"), placeOf(object));
    if (!object.contains(QStringLiteral("signal")))
        return QStringLiteral("%1 commands %2").arg(who, textIn(object, "command"));
    QString sentence = QStringLiteral("%1 has set %2: %3 -> %4")
                           .arg(who, textIn(object, "signal"), textIn(object, "from"), textIn(object, "to"));
    const QString how = textIn(object, "how");
    if (how == QLatin1String("came back"))
        sentence += QStringLiteral(" (the former value came back)");
    else if (how == QLatin1String("lease") || how == QLatin1String("lease lost"))
        sentence += QStringLiteral(" (%1)").arg(how);
    const double count = object.value(QStringLiteral("count")).toDouble();
    if (count > 1)
        sentence += QStringLiteral(", in %1 steps").arg(count, 0, 'f', 0);
    if (object.value(QStringLiteral("adopted")) == QJsonValue(false))
        sentence += QStringLiteral("; no cycle has adopted it");
    return sentence;
}

QString leaseSentence(const QJsonObject &object)
{
    const QStringList names = object.value(QStringLiteral("signals")).toVariant().toStringList();
    const QStringList from = object.value(QStringLiteral("from")).toVariant().toStringList();
    QString sentence = QStringLiteral("'%1'%2 has %3 the lease of %4")
                           .arg(textIn(object, "by"), placeOf(object), textIn(object, "what"), firstOf(names));
    if (!from.isEmpty())
        sentence += QStringLiteral(", held by '%1'").arg(from.join(QStringLiteral("', '")));
    if (object.contains(QStringLiteral("reason")))
        sentence += QStringLiteral(": ") + textIn(object, "reason");
    return sentence;
}

}  // namespace

quint64 Happening::cycle() const
{
    return quint64(std::max(text.value(QStringLiteral("cycle")).toDouble(), 0.0));
}

bool Happening::isAbout(const QString &signal) const
{
    return textIn(text, "signal") == signal
        || (topic == Lease && text.value(QStringLiteral("signals")).toArray().contains(signal));
}

QString Happening::severity() const
{
    const QString own = textIn(text, "severity");
    if (topic == Lease && textIn(text, "what") == QLatin1String("lost"))
        return QStringLiteral("warning");
    return own.isEmpty() ? QStringLiteral("info") : own;
}

QString Happening::kind() const
{
    return topic == Event  ? textIn(text, "kind")
        : topic == Command ? QStringLiteral("command")
        : topic == Lease   ? QStringLiteral("lease")
                           : QStringLiteral("statistics");
}

QString Happening::source() const
{
    return textIn(text, topic == Event ? "source" : "by");
}

QString Happening::sentence() const
{
    const QString sentence = topic == Event ? textIn(text, "text")
        : topic == Command                  ? commandSentence(text)
        : topic == Lease                    ? leaseSentence(text)
                                            : QString::fromUtf8(QJsonDocument(text).toJson(QJsonDocument::Compact));
    return printable(sentence);
}

QJsonObject Happening::toJson() const
{
    QJsonObject object = text;
    for (const char *channel : happeningChannels) {
        if (topicOf(channel) == topic)
            object.insert(QStringLiteral("channel"), QLatin1String(channel));
    }
    return object;
}

bool readHappening(const QByteArray &topic, const mcap::Message &message, Happening *happening)
{
    const std::optional<Happening::Topic> known = topicOf(topic);
    if (!known)
        return false;
    happening->topic = *known;
    happening->time = RecordedTime(message.time);
    happening->wallTime = std::int64_t(message.published);
    happening->text = QJsonDocument::fromJson(QByteArray::fromRawData(message.bytes, int(message.size))).object();
    return !happening->text.isEmpty();
}

HappeningReader::HappeningReader(Recording &recording, int topics)
    : m_recording(recording)
    , m_topics(topics)
{
}

HappeningReader::~HappeningReader() = default;

bool HappeningReader::next(Happening *happening)
{
    while (m_found.empty()) {
        if (m_index && m_chunk < m_index->chunks.size())
            readChunk(m_index->chunks[m_chunk++]);
        else if (m_file == m_recording.files().size())
            return false;
        else
            m_damages += openFile() ? 0 : 1;
    }
    *happening = std::move(m_found.front());
    m_found.pop_front();
    return true;
}

bool HappeningReader::openFile()
{
    const std::size_t number = m_file++;
    m_index = m_recording.indexOf(number);
    m_reader = std::make_unique<mcap::Reader>();
    m_channels.clear();
    m_chunk = 0;
    QString error;
    if (!m_index || !m_reader->open(m_recording.files()[number].name, &error)) {
        m_index = nullptr;
        return false;
    }
    for (const mcap::Channel &channel : m_index->channels) {
        const std::optional<Happening::Topic> topic = topicOf(channel.topic);
        if (topic && (m_topics & *topic) != 0)
            m_channels.insert(channel.id, channel.topic);
    }
    if (m_channels.isEmpty())
        m_index = nullptr;
    return true;
}

/// One without an index may have any messages.
void HappeningReader::readChunk(const mcap::ChunkEntry &chunk)
{
    const QList<std::uint16_t> channels = chunk.indexOffsets.keys();
    const auto isWanted = [this](std::uint16_t channel) { return m_channels.contains(channel); };
    if (!channels.isEmpty() && std::none_of(channels.begin(), channels.end(), isWanted))
        return;
    QByteArray records;
    if (!m_reader->readChunk(chunk, &records)) {
        ++m_damages;
        return;
    }
    const RingDescription &description = m_recording.files()[m_file - 1].description;
    quint32 &newest = m_newest[{description.session, description.phase}];
    const auto take = [&](const mcap::Message &message, std::uint64_t) {
        Happening happening;
        if (!isWanted(message.channel) || message.sequence <= newest
            || !readHappening(m_channels.value(message.channel), message, &happening))
            return;
        newest = message.sequence;
        m_found.push_back(std::move(happening));
    };
    mcap::forEachMessage(
        records, [](const mcap::Channel &) {}, take);
    // A phase begins with what led to it, one topic after the other.
    std::stable_sort(m_found.begin(), m_found.end(),
                     [](const Happening &a, const Happening &b) { return a.wallTime < b.wallTime; });
}

}  // namespace qplc
