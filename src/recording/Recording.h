// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Overview.h"
#include "PlantMessage.h"
#include "RecordedFile.h"

#include <QtCore/QStringList>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace qplc {

/// A signal of a recording.
struct RecordedSignal
{
    QPlcSignalDefinition definition;
    std::vector<int> indices;  // in the table of each layout; -1: it is not there, or has another type
};

/// Files of one signal table.
struct RecordedLayout
{
    explicit RecordedLayout(const RingDescription &description);

    QByteArray ini;
    PlantMessage message;
    std::vector<std::uint32_t> offsets;  // of each signal in a message; empty: they vary
};

/// Recordings as one: a file, the files of a folder, or several of them, in the order of their
/// times.
///
/// open() reads a few bytes of each file. Everything else is read when it is needed, and not more
/// than that. For one thread.
class Recording
{
public:
    enum Unreadable { Refuse, LeaveOut };

    /// \param paths  files, and folders with files *.mcap. What is no recording in a folder is left
    ///     out
    /// \param unreadable  what happens with files of these names that are not recordings, or not
    ///     there
    /// \return false when a named file is not a recording, all are left out, or the times of two
    ///     phases overlap, as those of simulations do
    bool open(const QStringList &paths, QString *error, Unreadable unreadable = Refuse);

    /// Of the newest file.
    const RingDescription &description() const { return m_files.back().description; }
    const std::vector<RecordedSignal> &signalList() const { return m_signals; }
    /// -1: there is none of this name
    int indexOf(const QString &name) const;
    /// All definitions, for lists and selections.
    const QPlcSignalTable &table() const { return m_table; }
    RecordedTime begin() const { return m_files.front().begin; }
    RecordedTime end() const;
    /// Whether times are those of a clock, from 1970 on: not those of a simulation, from 0 on.
    bool isTimed() const;
    const std::vector<RecordedFile> &files() const { return m_files; }
    std::uint64_t bytes() const;
    /// For people: what has been left out.
    QStringList notes() const { return m_notes; }
    /// Files that are not recordings, or cannot be read, and were left out.
    int unreadable() const { return m_unreadable; }

    /// Extremes of an element of a signal in \a count intervals of equal length, from \a begin to
    /// before \a end. Strings have none.
    std::vector<overview::Bucket> overview(int signal, int element, RecordedTime begin, RecordedTime end, int count);

    /// With its index. \return null when the file cannot be read any more
    const mcap::Index *indexOf(std::size_t file);
    const RecordedLayout &layout(int number) const { return *m_layouts[std::size_t(number)]; }

private:
    bool openFile(const QString &name, QString *error);
    bool checkOrder(QString *error) const;
    int layoutOf(const RingDescription &description);
    void listSignals();
    overview::File *overviewOf(std::size_t file);
    void addRows(int signal, int element, RecordedTime begin, RecordedTime end, RecordedTime from, double width,
                 std::vector<overview::Bucket> *result);
    bool addBuckets(std::size_t file, int column, RecordedTime from, double width, RecordedTime begin, RecordedTime end,
                    std::vector<overview::Bucket> *result);

    std::vector<RecordedFile> m_files;
    std::vector<std::shared_ptr<RecordedLayout>> m_layouts;
    std::vector<RecordedSignal> m_signals;
    QPlcSignalTable m_table;
    std::vector<std::unique_ptr<overview::File>> m_overviews;  // of each file, once it was needed
    QStringList m_notes;
    int m_unreadable = 0;
};

/// The cycles of a recording from \a begin up to and with \a end, one after the other. Only the
/// chunks of these times are read, and only the values that are asked for.
///
/// \code
/// RecordedRows rows(recording, {recording.indexOf("power")}, begin, end);
/// while (rows.next())
///     sum += rows.number(0);
/// \endcode
class RecordedRows
{
public:
    /// \param recording  outlives this object
    RecordedRows(Recording &recording, std::vector<int> columns, RecordedTime begin, RecordedTime end);
    ~RecordedRows();

    /// \return false behind the last cycle
    bool next();
    RecordedTime time() const { return m_time; }
    std::int64_t wallTime() const { return m_wallTime; }  // when it ended [ns]
    const PlantMessage::Cycle &cycle() const { return m_cycle; }
    /// The bytes of the value of a column, little-endian, those of a text without its length. Null:
    /// the signal is not in this file.
    const char *value(std::size_t column) const { return m_values[column]; }
    /// [byte]
    std::uint32_t size(std::size_t column) const { return m_sizes[column]; }
    double number(std::size_t column, int element = 0) const;
    QPlcQuality quality(std::size_t column) const;

    /// Gets messages of other channels between the cycles, with the topic of each.
    using Other = std::function<void(const QByteArray &topic, const mcap::Message &message)>;
    void setOther(Other other) { m_other = std::move(other); }
    /// Chunks that are damaged, and were left out.
    int damages() const { return m_damages; }
    /// Chunks that were read.
    int chunks() const { return m_chunks; }
    /// Of the newest cycle.
    const RecordedFile &file() const;

private:
    bool openFile();
    bool openChunk();
    bool read(const mcap::Message &message);

    Recording &m_recording;
    std::vector<int> m_columns;
    RecordedTime m_begin;
    RecordedTime m_end;
    std::size_t m_file = 0;   // of m_reader
    std::size_t m_chunk = 0;  // that comes next
    std::unique_ptr<mcap::Reader> m_reader;
    const mcap::Index *m_index = nullptr;
    std::uint16_t m_plant = 0;                 // channel
    QMap<std::uint16_t, QByteArray> m_topics;  // of all channels
    QByteArray m_records;
    std::size_t m_at = 0;  // in m_records
    bool m_isOpen = false;
    bool m_hasRow = false;
    RecordedTime m_time = 0;
    std::int64_t m_wallTime = 0;
    PlantMessage::Cycle m_cycle;
    std::vector<int> m_indices;  // of the columns, in the table of this file
    std::vector<const char *> m_values;
    std::vector<std::uint32_t> m_sizes;
    std::vector<std::uint32_t> m_offsets;  // in the message, where they vary
    const char *m_qualities = nullptr;
    Other m_other;
    int m_damages = 0;
    int m_chunks = 0;
};

}  // namespace qplc
