// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Leases.h"
#include "node/cycle/NodeRegistry.h"
#include "node/cycle/TemporaryValues.h"
#include "protocol/messages/SignalValues.h"

#include <QtCore/QObject>
#include <QtCore/QTimer>

#include <map>
#include <set>

namespace qplc {

/// Why a signal cannot be set or taken: \a lease says who has it.
Refusal leaseRefusal(const QString &signal, const Leases::Lease &lease);

/// Why a value is set.
struct SettingCause
{
    enum Kind : std::uint8_t {
        Asked,     ///< somebody has asked for it
        Taken,     ///< with the lease that somebody has taken
        CameBack,  ///< the time of another value is over, or who had set it is gone
        Lost       ///< the lease of the signal was lost: its neutral value
    };
    Kind kind = Asked;
    const QObject *owner = nullptr;  // who asked; null: the program of the master, or nobody
};

/// Values from outside, for signals that no node writes, or that the asker holds by a lease: checks
/// them, sets them, and brings the former ones back where they were set for a while only.
///
/// Threads: that of the master.
class MasterWrites : public QObject
{
    Q_OBJECT
public:
    MasterWrites(NodeRegistry &registry, MasterCycle &cycle, const Leases &leases);

    /// Carries out SetSignals: sets all signals of \a wish or none.
    /// \param owner  who asked; what it has set with a duration ends with it
    /// \return false, with the reason in \a refusal
    bool setSignals(const QObject *owner, const messages::SetSignals &wish, Refusal *refusal);
    /// Sets one signal. \return false, with the reason in \a refusal
    bool setSignal(const QString &name, const QPlcValue &value, Refusal *refusal);
    /// To be called when a node has registered, or a lease was released: what a node writes is its
    /// own, nothing comes back over it.
    void leaveToWriters();

    // ---- for leases: without a look at who may set ----
    /// Reads and checks a value. \return false, with the reason in \a refusal
    bool readValue(QPlcSignalIndex signal, const QString &text, SignalSetting *setting, Refusal *refusal) const;
    /// Sets values for good. \return false, and none is set, when the cycle has no room for them
    /// now
    /// \param holder  of the lease
    bool setLeased(const QObject *holder, const std::vector<SignalSetting> &settings, Refusal *refusal);
    /// What was set before moves \a indices no further. \pre the cycle has room for them
    void endWays(const std::vector<QPlcSignalIndex> &indices);
    /// Sets values for good, as soon as the cycle has room.
    void setSoon(SettingCause::Kind cause, const std::vector<SignalSetting> &settings);
    /// The values that signals have now stay, also where they were set for a while only.
    void keepPresent(const std::vector<QPlcSignalIndex> &indices);

Q_SIGNALS:
    /// A value is about to be given to the cycle, which has room for it.
    /// \param number  that it will have: MasterCycle::settingsGiven(); 0: no cycle runs
    void giving(const qplc::SettingCause &cause, QPlcSignalIndex signal, const QPlcValue &former,
                const QPlcValue &value, quint64 number);
    /// \param owner  who asked; null: the program of the master
    void valueSet(const QObject *owner, QPlcSignalIndex signal, const QPlcValue &former, const QPlcValue &value);
    /// The time of a value is over, or who had set it is gone.
    void valueCameBack(QPlcSignalIndex signal, const QPlcValue &value);

private:
    struct Debt
    {
        SettingCause::Kind cause;
        SignalSetting setting;
    };
    bool isSettable(const QObject *owner, const QString &name, QPlcSignalIndex *signal, Refusal *refusal) const;
    bool checkValue(QPlcSignalIndex signal, const QPlcValue &value, SignalSetting *setting, Refusal *refusal) const;
    bool readValues(const QObject *owner, const QMap<QString, QString> &texts, std::vector<SignalSetting> *settings,
                    Refusal *refusal) const;
    bool give(const SettingCause &cause, const std::vector<SignalSetting> &settings, Refusal *refusal);
    void keepFor(const QObject *owner, const std::vector<SignalSetting> &settings, const std::vector<QPlcValue> &former,
                 std::int64_t deadline);
    QPlcValue presentValue(QPlcSignalIndex signal) const;
    QPlcValue formerValue(QPlcSignalIndex signal) const;
    void bringBack(const std::vector<SignalSetting> &settings);
    bool isOfWriter(QPlcSignalIndex signal) const;
    void payDebts();
    void waitForNext();

    NodeRegistry &m_registry;
    MasterCycle &m_cycle;
    const Leases &m_leases;
    const QPlcSignalTable &m_table;
    TemporaryValues m_temporary;
    std::map<QPlcSignalIndex, QPlcValue> m_given;  // newest values; the cycle may not have taken them yet
    std::map<QPlcSignalIndex, Debt> m_debts;       // values to come back that the cycle had no room for
    std::set<const QObject *> m_owners;            // whose end is listened to
    QTimer m_timer;
};

}  // namespace qplc
