// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PastReader.h"

#include <QtCore/QObject>
#include <QtCore/QTimer>

#include <future>
#include <list>
#include <memory>

namespace qplc {

class Plant;

/// Shows what a window has not heard of a plant: what was before its first row, so that the last
/// hour is there after a restart of the window, what was while its connection was lost, and what
/// was while it was too slow.
///
/// Each such gap is read when the master has told its state and the first cycle behind the gap has
/// come: out of the recordings of the recorder, and out of the ring of the master, where this
/// computer has them. If there is no recorder, the ring alone is read. A gap in which something may
/// still be missing is read again when the master tells recordings in another folder, as of a
/// recorder that was started later. A thread reads, and the plant gets another store.
///
/// Threads: that of the window.
class PlantPast : public QObject
{
    Q_OBJECT
public:
    static constexpr int MostAttempts = 3;  // a recorder writes each second what the ring does not show
    static constexpr int Pause = 2000;      // [ms] between them
    /// Without a recorder, less than that is not worth the work before the first row [ns].
    static constexpr PlantValues::Time LeastOfRing = 5 * SignalStore::Second;
    static constexpr std::size_t MostGaps = 64;  // the newest ones

    /// \param plant  owns this object
    explicit PlantPast(Plant *plant);
    /// Waits until the thread has seen that its work is unwanted.
    ~PlantPast() override;

private:
    struct Gap
    {
        PastWish wish;                    // with `after` and `lost` from the begin on
        quint64 sessionBefore = 0;        // of `lost`; 0: not known
        quint64 run = 0;                  // PlantValues::run() behind the gap
        bool isClosed = false;            // the master has told what is behind it
        bool hasEnd = false;              // there are rows behind it
        bool isDone = false;              // there is nothing more to be found
        std::optional<QString> lookedIn;  // the folder of the recorder; empty: there was none
        int attempts = 0;                 // in this folder

        /// More may become known of what is behind it.
        bool isOpen() const { return !isClosed || (!hasEnd && !lookedIn); }
    };

    void begin();
    void look();
    void lose();
    void close(Gap *gap) const;
    void addHoles();
    void append(const Gap &gap);
    Gap *nextGap();
    bool isWanted(const Gap &gap) const;
    bool isOutdated(const Gap &gap) const;
    QString file() const;
    void start();
    void cancel();
    void collect();
    void finish(Past past);
    void give(const Gap &gap, Past past);

    Plant *m_plant;
    QTimer m_timer;
    QTimer m_retry;
    std::list<Gap> m_gaps;                       // oldest first
    Gap *m_reading = nullptr;                    // one of them
    std::shared_ptr<const SignalStore> m_store;  // to which they belong
    std::future<Past> m_work;
    std::shared_ptr<std::atomic<bool>> m_isUnwanted;
    QString m_problem;  // that was told
};

}  // namespace qplc
