// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeRegistry.h"
#include "TemporaryValues.h"

#include <QtCore/QJsonObject>
#include <QtCore/QObject>
#include <QtCore/QTimer>

#include <map>
#include <set>

namespace qplc {

/// Values from outside, for signals that no node writes: checks them, sets them, and brings the former ones back where they were set for a while only.
///
/// Threads: that of the master.
class MasterSettings : public QObject
{
    Q_OBJECT
public:
    MasterSettings(NodeRegistry &registry, MasterCycle &cycle);

    /// Carries out SetSignals: sets all signals of \a fields or none.
    /// \param owner  who asked; what it has set with a duration ends with it
    /// \return false, with the reason in \a refusal
    bool setSignals(const QObject *owner, const QJsonObject &fields, Refusal *refusal);
    /// Sets one signal. \return false, with the reason in \a refusal
    bool setSignal(const QString &name, const QPlcValue &value, Refusal *refusal);
    /// To be called when a node has registered: what it writes is its own, nothing comes back over it.
    void leaveToWriters();

private:
    bool isSettable(const QString &name, QPlcSignalIndex *signal, Refusal *refusal) const;
    bool checkValue(QPlcSignalIndex signal, const QPlcValue &value, SignalSetting *setting, Refusal *refusal) const;
    bool readValues(const QJsonValue &values, std::vector<SignalSetting> *settings, Refusal *refusal) const;
    bool give(const std::vector<SignalSetting> &settings, Refusal *refusal);
    void keepFor(const QObject *owner, const std::vector<SignalSetting> &settings, const std::vector<QPlcValue> &former,
                 std::int64_t deadline);
    QPlcValue presentValue(QPlcSignalIndex signal) const;
    void bringBack(const std::vector<SignalSetting> &settings);
    void payDebts();
    void waitForNext();

    NodeRegistry &m_registry;
    MasterCycle &m_cycle;
    const QPlcSignalTable &m_table;
    TemporaryValues m_temporary;
    std::map<QPlcSignalIndex, QPlcValue> m_given;  // newest values; the cycle may not have taken them yet
    std::map<QPlcSignalIndex, QPlcValue> m_debts;  // values to come back that the cycle had no room for
    std::set<const QObject *> m_owners;            // whose end is listened to
    QTimer m_timer;
};

}  // namespace qplc
