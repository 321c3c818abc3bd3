// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantValues.h"
#include "recording/Happenings.h"

#include <QtCore/QObject>
#include <QtCore/QTimer>

namespace qplc {

class Plant;

/// What a plant lives from that is a recording: the values of its past, of which the store of the
/// plant has a part.
///
/// That part is the whole recording if it fits into the memory of a store. If not, it is an
/// overview, with the smallest and the largest value of each of its intervals, or, once a person
/// looks closer, all cycles around what is seen. Files are read a little at a time, beside what
/// people do.
///
/// The plant then tells what has happened in the recording: its events, commands and leases, the
/// first MostHappenings of them. Before, it warns of what is left out: files that cannot be read.
///
/// Times are those of the recording. A simulation, whose times begin at 0, begins at 00:00 of the
/// clock of this computer.
///
/// Threads: that of the window.
class PlantRecording : public QObject
{
    Q_OBJECT
public:
    using Time = PlantValues::Time;

    /// Of all recordings of a window together [byte].
    static constexpr std::int64_t UsualMemory = std::int64_t(512) << 20;
    static constexpr int MostHappenings = 2000;

    /// Begins to read the cycles.
    /// \param plant  owns this object; never open()ed
    /// \param recording  open \param memory  of the store [byte]
    PlantRecording(Plant *plant, std::unique_ptr<Recording> recording, std::int64_t memory = UsualMemory);
    ~PlantRecording() override;

    const Recording &recording() const { return *m_recording; }
    /// Of the first and of the last cycle, on the clock of the window [ns].
    Time begin() const { return m_begin; }
    Time end() const { return m_end; }
    Time period() const { return m_period; }  // [ns]
    bool isReading() const { return m_section != nullptr; }
    /// What has been read of what is wanted, 0 to 1.
    double progress() const;
    /// "32 signals, 100 Hz, 10 min" and what the files lack.
    QString text() const;
    /// Of the store from now on [byte]. What no longer fits becomes an overview, and what fits now
    /// is read.
    void setMemory(std::int64_t memory);
    std::int64_t memory() const { return m_memory; }
    /// Looked at are now the times \a begin to \a end.
    void see(Time begin, Time end);

Q_SIGNALS:
    /// The store has what is looked at.
    void read();

private:
    /// Of the recording, on the clock of the window.
    struct Part
    {
        Time begin = 0;
        Time end = 0;
        bool hasCycles = false;  // all of them, and no overview
    };
    struct Section;

    bool fits(Time begin, Time end) const;
    void beginSection(Time begin, Time end);
    void readSome();
    bool readRow();
    bool readColumn();
    void storeRow(const RecordedRows &rows);
    void storeOverview();
    void finish();
    void tellWhatIsLeftOut();
    void tellSome();
    void tell(const Happening &happening);

    Plant *m_plant;
    std::unique_ptr<Recording> m_recording;
    std::unique_ptr<Section> m_section;  // that is being read; null: none
    QTimer m_timer;
    QTimer m_happeningTimer;
    std::unique_ptr<HappeningReader> m_happenings;  // that are being told; null: none
    int m_told = 0;
    std::int64_t m_memory;    // of the store [byte]
    std::int64_t m_mostRows;  // of the store
    Time m_shift = 0;         // to the clock of the window
    Time m_begin = 0;
    Time m_end = 0;
    Time m_period = 1;
    Part m_part;            // that the store has
    bool m_isRead = false;  // the store has something
    int m_damages = 0;
};

}  // namespace qplc
