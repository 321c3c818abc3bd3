// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlotExport.h"
#include "QPlcPast.h"

#include <QtCore/QJsonObject>

#include <deque>

namespace qplc {

/// Whether and where a trigger saves what it shows. A value type.
struct EventFileSettings
{
    static constexpr int UsualMost = 100;
    static constexpr int LargestMost = 10'000;

    bool isOn = false;
    QString folder;        // empty: usualFolder()
    int most = UsualMost;  // files of events in the folder, 1 ... LargestMost

    QString usedFolder() const { return folder.isEmpty() ? usualFolder() : folder; }
    static QString usualFolder();
    bool operator==(const EventFileSettings &other) const
    {
        return isOn == other.isOn && folder == other.folder && most == other.most;
    }
    /// {"on": true, "folder": "/data/events", "most": 20}; defaults are left out.
    QJsonObject toJson() const;
    static EventFileSettings fromJson(const QJsonObject &object);
};

/// Writes a table for each event into a folder, one after another between events of the window:
/// "event_2026-11-22_12-35-37.123_power.csv".
///
/// It overwrites and deletes nothing: when the folder has as many files of events as it may have,
/// it says so, and saves no more until begin().
class EventFiles : public QObject
{
    Q_OBJECT
public:
    static constexpr int MostWaiting = 8;

    explicit EventFiles(QObject *parent);

    /// From here on events are saved so; what went wrong before is told again.
    void begin(const EventFileSettings &settings);
    /// Writes \a table, whose stores have to live until it is done: else cancel() first. \param
    /// event time of it [ns since 1970] \param signal that the event is of
    void save(QPlcPast::Time event, const QString &signal, std::shared_ptr<TextTable> table);
    /// Gives up what is not written yet.
    void cancel(const QString &reason);
    /// Files since begin().
    int saved() const { return m_saved; }

    /// The name of the file of an event, in the local time.
    static QString fileName(QPlcPast::Time event, const QString &signal);

Q_SIGNALS:
    void savedChanged();
    /// A sentence for people; once until begin() for what stays wrong.
    void failed(const QString &sentence);

private:
    struct Wanted
    {
        QString file;
        std::shared_ptr<TextTable> table;
    };
    void next();
    void fail(const QString &sentence);

    EventFileSettings m_settings;
    PlotExport m_export;
    std::deque<Wanted> m_waiting;
    int m_saved = 0;
    bool m_hasFailed = false;
};

}  // namespace qplc
