// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QByteArray>
#include <QtCore/QMap>
#include <QtCore/QString>
#include <QtCore/QVector>

namespace qplc {

/// What a ring says of the phase whose cycles it shows; the same text describes a recording.
struct RingDescription
{
    QString plant;                        // name of the master, or of its program
    QString version;                      // of QtPLC
    quint64 session = 0;                  // of the master
    quint64 phase = 0;                    // of this session, from 1
    qint64 period = 0;                    // between two cycles, as nodes see it [ns]
    QString clock;                        // "real-time", "scaled", "lockstep" or "external"
    double scale = 1.0;                   // simulated seconds per second; 0: not timed
    QVector<QPlcSignalIndex> ownSignals;  // that the master writes in each cycle
    QString profile;                      // "Simulation" or "Plant"; empty: of a version that did not tell it
    QMap<QString, QString> parameters;    // of the master, by name: for people
    QByteArray table;                     // signal table, INI

    /// "key: value" lines, an empty line, and the table.
    QByteArray toText() const;
    /// \return false when \a text is not such a text
    static bool fromText(const QByteArray &text, RingDescription *description);
};

}  // namespace qplc
