// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/cycle/RecordRing.h"
#include "node/cycle/RingDescription.h"
#include "node/statistics/Journal.h"

#include <functional>
#include <memory>

namespace qplc {

/// The ring of each phase of a master: makes it, and deletes those that nobody needs any more.
class PhaseRing
{
public:
    explicit PhaseRing(Journal &journal);
    ~PhaseRing();

    /// Of the rings from now on. \param plant  empty: phases have no ring
    void setPlant(const QString &plant, quint64 session);
    /// Called with the file of each ring before the first cycle: a recorder that begins here gets
    /// all of them.
    void setCallback(std::function<void(const QString &file)> isReady) { m_isReady = std::move(isReady); }
    /// The ring of a phase that is about to begin. Null: it has none, and the journal says why.
    /// \param description  plant, session and number of the phase come from here
    std::shared_ptr<RecordRing> make(RingDescription description, std::size_t recordSize);
    /// As make() has made it. Empty: there is none.
    QString file() const;

    /// Deletes rings whose master was killed, but the newest four: they show what happened before.
    static void removeDead();

private:
    void leave();

    Journal &m_journal;
    QString m_plant;
    quint64 m_session = 0;
    quint64 m_phase = 0;
    std::shared_ptr<RecordRing> m_ring;
    std::function<void(const QString &file)> m_isReady;
};

}  // namespace qplc
