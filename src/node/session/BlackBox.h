// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PhaseRing.h"
#include "realtime/Worker.h"

#include <QtCore/QTimer>

#include <chrono>
#include <functional>
#include <memory>

namespace qplc {

class RingReader;

/// Keeps the cycles around a safe stop, a fault or a mark while nobody records: a part of the ring
/// goes into a file beside it, which looks like the ring of a master that was killed. So the next
/// recorder of a folder finds it, and only the newest of them stay.
///
/// If the phase ends before, its whole ring stays. The same happens if the master is killed, also
/// while a part is being written, which appears complete or not at all.
///
/// Threads: that of the master. Parts are written by a worker.
class BlackBox
{
public:
    static constexpr std::chrono::seconds Before{30};  // of the plant
    static constexpr std::chrono::seconds After{10};

    /// What the cycles of the phase at hand are.
    struct Cycles
    {
        std::function<bool()> areRunning;
        std::function<std::uint64_t()> newest;
    };

    BlackBox(Journal &journal, PhaseRing &ring, Cycles cycles);

    /// A phase is about to begin. \param ring  null: it has none
    void watch(const std::shared_ptr<RecordRing> &ring, std::chrono::nanoseconds period);
    /// The cycles around the present one stay. \param reason  "safe stop"
    void keep(const QString &reason);
    /// Done five times a second: takes marks, and writes the part when it is time.
    void look();

private:
    struct Part;

    bool isDue(const RecordRing &ring) const;
    void begin();
    void finish(const Part &part);
    static void write(Part *part);
    static void copy(RingReader *reader, Part *part);

    Journal &m_journal;
    PhaseRing &m_phaseRing;
    const Cycles m_cycles;
    QTimer m_timer;
    std::weak_ptr<RecordRing> m_ring;
    std::uint64_t m_before = 0;  // cycles
    std::uint64_t m_after = 0;
    std::uint32_t m_marks = 0;  // taken
    int m_parts = 0;            // of this ring
    QString m_reason;           // empty: nothing is to be kept
    std::uint64_t m_first = 0;  // cycle
    std::uint64_t m_last = 0;
    std::uint64_t m_place = 0;  // of the ring, when it was wanted
    bool m_isWriting = false;
    Worker m_worker;
};

}  // namespace qplc
