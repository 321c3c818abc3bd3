// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <optional>

namespace qplc {

struct RingDescription;

/// The name of a file in the folder of a recorder:
/// `20261126T215512.123Z_PLANT_SESSION_phase1.mcap`, as RecordingFolder describes it.
struct RecordingName
{
    qint64 begin = 0;  // [ms since 1970]
    QString plant;     // letters and digits of ASCII, and _
    quint64 session = 0;
    quint64 phase = 0;
    bool isMarked = false;
    bool isUnfinished = false;

    /// Of a file that is begun now. \param begin [ms since 1970]
    static RecordingName of(const RingDescription &phase, qint64 begin);
    /// \return nothing if no recorder gives such a name
    static std::optional<RecordingName> parse(const QString &fileName);
    QString toString() const;
    bool isOfSamePhase(const RecordingName &other) const;
};

}  // namespace qplc
