// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Recording.h"

#include <QtCore/QJsonObject>
#include <QtCore/QPair>

#include <deque>

namespace qplc {

/// What has happened beside the cycles of a recording: docs/recording.md has the messages.
struct Happening
{
    enum Topic : std::uint8_t { Event = 1, Command = 2, Lease = 4, Statistics = 8 };

    Topic topic = Event;
    RecordedTime time = 0;      // nominal, of its cycle
    std::int64_t wallTime = 0;  // [ns since 1970]; of a simulation: its time
    QJsonObject text;

    /// Of a command: the cycle that has adopted it.
    quint64 cycle() const;
    /// Whether it sets \a signal, or takes, releases or loses its lease.
    bool isAbout(const QString &signal) const;
    /// "info", "warning" or "error"
    QString severity() const;
    /// Of an event: its own one. Else "command", "lease", "statistics".
    QString kind() const;
    /// Who or what it comes from.
    QString source() const;
    /// A sentence for people, in one line.
    QString sentence() const;
    /// The message, and the channel that it comes from.
    QJsonObject toJson() const;
};

/// Reads a message. \return false when it tells no happening
bool readHappening(const QByteArray &topic, const mcap::Message &message, Happening *happening);

/// What has happened in a recording, one after the other. Only the chunks that have such messages
/// are read, each when it is needed; a recording of an older version has none.
class HappeningReader
{
public:
    /// \param recording  outlives this object \param topics  of Happening::Topic
    HappeningReader(Recording &recording, int topics);
    ~HappeningReader();

    /// \return false when there are no more
    bool next(Happening *happening);
    /// Chunks and files that are damaged, and were left out.
    int damages() const { return m_damages; }

private:
    bool openFile();
    void readChunk(const mcap::ChunkEntry &chunk);

    Recording &m_recording;
    const int m_topics;
    std::size_t m_file = 0;   // that comes next
    std::size_t m_chunk = 0;  // of the file that is open, that comes next
    const mcap::Index *m_index = nullptr;
    std::unique_ptr<mcap::Reader> m_reader;
    QMap<std::uint16_t, QByteArray> m_channels;       // of the file that is open
    QMap<QPair<quint64, quint64>, quint32> m_newest;  // number, by session and phase: none comes twice
    std::deque<Happening> m_found;
    int m_damages = 0;
};

}  // namespace qplc
