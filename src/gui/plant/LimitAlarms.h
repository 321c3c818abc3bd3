// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LimitWatch.h"
#include "PlantList.h"

#include <QtCore/QSet>

#include <map>

namespace qplc {

/// Tells when signals of plants that a program feeds leave the limits of their tables, and when
/// they are back: alarms of the event log. A master refuses such values, and tells that itself.
///
/// Threads: that of the window.
class LimitAlarms : public QObject
{
    Q_OBJECT
public:
    explicit LimitAlarms(PlantList *plants, QObject *parent = nullptr);

Q_SIGNALS:
    void eventOccurred(const qplc::PlantEvent &event);

private:
    void follow(Plant *plant);
    void begin(Plant *plant);
    void check(Plant *plant);
    static PlantEvent eventOf(const Plant &plant, const LimitWatch::Change &change);

    struct Watched
    {
        LimitWatch watch;
        QSet<QString> alarms;  // that last
    };
    std::map<Plant *, Watched> m_plants;
};

}  // namespace qplc
