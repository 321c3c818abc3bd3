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
    /// What the description of the next ring tells of the master, besides that of the phase.
    void setParameters(const QMap<QString, QString> &parameters) { m_parameters = parameters; }
    /// Called with the file of each ring before the first cycle: a recorder that begins here gets
    /// all of them.
    void setCallback(std::function<void(const QString &file)> isReady) { m_isReady = std::move(isReady); }
    /// The ring of a phase that is about to begin. Null: it has none, and the journal says why.
    /// \param description  plant, session and number of the phase come from here
    std::shared_ptr<RecordRing> make(RingDescription description, std::size_t recordSize);
    /// Called when a ring has been made, before anybody reads it: what happened before the phase.
    void setBegin(std::function<void()> begins) { m_begins = std::move(begins); }
    /// Whether a phase is under way that has a ring.
    bool isOpen() const { return m_isOpen; }
    /// Something has happened. \pre isOpen()
    /// \param text  one object of JSON
    void tell(RecordedText head, const QByteArray &text);
    /// Something has happened that is only counted. \pre isOpen()
    void leaveOut() { m_ring->leaveOutText(); }
    /// The phase is over, and all is told: recorders need not wait for more.
    void close();
    /// Whether somebody records.
    bool isRead() const { return m_ring && m_ring->isRead(); }
    /// Whether the ring stays after its phase, though nobody records: until the next make().
    void setKept(bool isKept) { m_isKept = isKept; }
    /// As make() has made it. Empty: there is none.
    QString file() const;

    /// Deletes rings whose master was killed, but the newest four: they show what happened before.
    static void removeDead();

private:
    void leave();

    Journal &m_journal;
    QString m_plant;
    QMap<QString, QString> m_parameters;
    quint64 m_session = 0;
    quint64 m_phase = 0;
    std::shared_ptr<RecordRing> m_ring;
    bool m_isKept = false;
    std::function<void(const QString &file)> m_isReady;
    std::function<void()> m_begins;
    bool m_isOpen = false;
};

}  // namespace qplc
