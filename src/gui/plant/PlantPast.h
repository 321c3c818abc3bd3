// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PastReader.h"

#include <QtCore/QObject>
#include <QtCore/QTimer>

#include <future>
#include <memory>

namespace qplc {

class Plant;

/// Puts before the rows that a window hears what the plant has done before: so the last hour is
/// there after a restart of the window.
///
/// It looks once for each store, when the master has told its state and the first cycle has come:
/// for the recordings of the recorder, and for what the ring of the master has, where this computer
/// has them. A thread reads them, and the plant gets another store. If there is no recorder, the
/// ring alone is read. A recorder that is started later changes nothing: by then the window has its
/// own rows.
///
/// Threads: that of the window.
class PlantPast : public QObject
{
    Q_OBJECT
public:
    static constexpr int MostAttempts = 3;  // a recorder writes each second what the ring does not show
    static constexpr int Pause = 2000;      // [ms] between them
    /// Without a recorder, less than that is not worth the work [ns].
    static constexpr PlantValues::Time LeastOfRing = 5 * SignalStore::Second;

    /// \param plant  owns this object
    explicit PlantPast(Plant *plant);
    /// Waits until the thread has seen that its work is unwanted.
    ~PlantPast() override;

private:
    void begin();
    void look();
    std::optional<PastWish> wish() const;
    void start();
    void cancel();
    void collect();
    void give(Past past);

    Plant *m_plant;
    QTimer m_timer;
    QTimer m_retry;
    PastWish m_wish;                             // of m_work
    std::shared_ptr<const SignalStore> m_store;  // to which the past belongs
    std::future<Past> m_work;
    std::shared_ptr<std::atomic<bool>> m_isUnwanted;
    int m_attempts = 0;
    bool m_isDone = true;
};

}  // namespace qplc
