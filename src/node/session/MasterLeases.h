// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Leases.h"
#include "MasterConnection.h"
#include "MasterWrites.h"
#include "QPlcLease.h"
#include "node/statistics/EventLog.h"

#include <QtCore/QObject>
#include <QtCore/QTimer>
#include <QtCore/QVector>

#include <set>

namespace qplc {

/// Who holds what has changed.
struct LeaseNews
{
    enum Kind : std::uint8_t { Taken, Released, Lost };
    Kind kind = Taken;
    const QObject *holder = nullptr;  // null: it is lost
    QString name;                     // of the holder
    std::vector<QPlcSignalIndex> indices;
    QStringList from{};  // who had them, if others had
    QString reason{};    // of a loss
};

/// The leases of a master: carries out TakeLease and ReleaseLease, and brings the signals of a lost
/// holder to their neutral values.
///
/// Holders are known by the object of their connection. Threads: that of the master.
class MasterLeases : public QObject
{
    Q_OBJECT
public:
    /// Most leases at a time: a list of all of them fits into one message.
    static constexpr std::size_t MaximumLeases = 1000;
    /// \param leases  the books, which others read
    MasterLeases(Leases &leases, NodeRegistry &registry, MasterCycle &cycle, MasterWrites &settings);

    /// Carries out TakeLease: takes all signals of \a request or none. \return false, with the
    /// reason in \a refusal
    bool take(const MasterConnection &asker, const messages::TakeLease &request, Refusal *refusal);
    /// Carries out ReleaseLease.
    bool release(const MasterConnection &asker, const messages::ReleaseLease &request, Refusal *refusal);
    /// A message of \a sender came. Before anything is done with it, leases end that are over:
    /// their timer may be late.
    void heard(const QObject *sender);

    QVector<QPlcLease> list() const;
    /// For the messages Leases and LeasesChanged.
    std::vector<messages::LeaseEntry> entries() const;

Q_SIGNALS:
    /// The same as changed(), for those who write it down.
    void told(const qplc::LeaseNews &news);
    /// From the next cycle on, other signals than before are to keep the values that they are
    /// given. Comes before those values.
    void heldSignalsChanged();
    /// Who holds what has changed. \param text  what happened, for people
    void changed(qplc::JournalEvent::Severity severity, const QString &text);

private:
    struct Wish
    {
        Leases::Signals indices;
        std::vector<SignalSetting> settings;
        QString name;
        std::int64_t timeout = 0;
    };
    bool readWish(const messages::TakeLease &request, Wish *wish, Refusal *refusal) const;
    bool readSignals(const QStringList &names, Leases::Signals *indices, Refusal *refusal) const;
    bool readValues(const QMap<QString, QString> &texts, Wish *wish, Refusal *refusal) const;
    Leases::Signals keptSignals(const QObject *holder, const Wish &wish) const;
    bool mayTake(const QObject *holder, const Leases::Signals &indices, bool takeOver, Refusal *refusal) const;
    void loseSilent();
    void lose(const Leases::Signals &indices, const QString &why);
    void tellLost(const QString &name, const Leases::Signals &indices, const QString &why);
    QStringList others(const QObject *holder, const Leases::Signals &indices) const;
    void listenToTheEndOf(const QObject *holder);
    void waitForNext();
    QString names(const Leases::Signals &indices) const;

    Leases &m_leases;
    NodeRegistry &m_registry;
    MasterCycle &m_cycle;
    MasterWrites &m_settings;
    const QPlcSignalTable &m_table;
    std::set<const QObject *> m_holders;  // whose end is listened to
    QTimer m_timer;
    std::optional<std::int64_t> m_next;  // [ns] no lease is over before
};

}  // namespace qplc
