// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcManifest.h"
#include "QPlcSignalTable.h"

namespace qplc_export {

/// What a plant inside of a host is: the file CONFIGURATION of qtplc_add_master_fmu() and
/// qtplc_add_master_discon().
///
///     [plant]
///     critical = Model, Autopilot     ; nodes without which it does not run
///     required = Display              ; nodes without which it does not begin
///     port = 50000                    ; where it listens; 0: a free port
///     listen = 127.0.0.1              ; another address needs keys
///     keys = keys.ini                 ; of nodes and persons; default: no security
///     access = access.ini             ; their rights
///     start_timeout = 30 s            ; longest wait for the nodes
///     longest_wait = 5 s              ; of a cycle
///     time_signal = masterTime        ; that the master writes
///     profile = Simulation            ; or Plant
///     [host]
///     gives = tetherSpeed             ; signals that the host writes: inputs of the FMU
///     gets = power, energy            ; signals that the host reads: outputs of the FMU
struct HeldPlantConfiguration
{
    /// \param table  of the plant
    /// \return false, with line and remedy in \a error
    bool read(const QByteArray &text, const QPlcSignalTable &table, QString *error);
    /// Reads the value of one of the settings from a text.
    /// \return false, with a sentence in \a error
    bool readSetting(const QString &key, const QString &text, QPlcValue *value, QString *error) const;

    /// What a host may change before it begins: port, listen, keys, access, start_timeout,
    /// longest_wait. Their values are the initial ones.
    QVector<QPlcSignalDefinition> settings;
    QPlcManifest manifest;
    QString timeSignal;  // empty: none
    QStringList gives;
    QStringList gets;

private:
    bool readPlant(const QString &key, const QString &value, const QPlcSignalTable &table, QString *error);
    bool readHost(const QString &key, const QString &value, const QPlcSignalTable &table, QString *error);
    bool addNodes(const QString &names, QPlcManifest::Need need, QString *error);
};

}  // namespace qplc_export
