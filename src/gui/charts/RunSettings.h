// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QJsonObject>
#include <QtCore/QString>
#include <QtCore/QStringList>

namespace qplc {

/// Which runs lie over the curves of a time plot, and how they are aligned. A value type.
///
/// What has its default is not written:
///
/// ```json
/// {"on": true, "plants": ["flight2"], "align": "edge", "signal": "reelOut", "level": 0.5,
///  "last": 10, "apart": 2, "differences": true, "hidden": ["flight1"]}
/// ```
struct RunSettings
{
    enum Alignment {
        Begins,       // their first values lie over each other
        Clock,        // they have the same time
        RisingEdges,  // the last times at which a signal rose lie over each other
        Events,       // the last events with the same text do
        Pauses        // the last begins of values after a pause do: where phases begin
    };

    static constexpr int MostLast = 100;

    bool isOn = false;
    QStringList plants;  // over those of the curves: recordings, or plants that run
    Alignment alignment = Begins;
    QString signal;             // that rises: an expression as that of a curve
    double level = 0.0;         // [unit of the signal]
    QString event;              // text of an event
    int last = 10;              // of edges, events or pauses, 1 to MostLast
    double apart = 0.0;         // of edges, at least [s]
    bool isDifference = false;  // each run minus the one below, in place of all of them
    QStringList hidden{};       // names of runs that are not drawn
    QJsonObject others{};       // keys that nobody knows

    /// Runs are pieces of the past, each of which begins where something happened.
    bool hasPieces() const { return isOn && alignment >= RisingEdges; }
    bool hasDifferences() const { return isOn && isDifference; }
    static RunSettings fromJson(const QJsonObject &json);
    QJsonObject toJson() const;
    friend bool operator==(const RunSettings &a, const RunSettings &b) { return a.toJson() == b.toJson(); }
    friend bool operator!=(const RunSettings &a, const RunSettings &b) { return !(a == b); }
};

}  // namespace qplc
