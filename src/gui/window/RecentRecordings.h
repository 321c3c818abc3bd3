// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QStringList>
#include <QtCore/QVector>

namespace qplc {

/// Recordings that a person opened, newest first, at most eight; kept in the QSettings of the
/// application. Each one is the paths of its files and folders.
class RecentRecordings
{
public:
    QVector<QStringList> all() const;
    /// \param paths  of one recording; relative ones are those of the current folder
    void add(const QStringList &paths);
    /// "flight.mcap", "flight.mcap and 2 more"
    static QString textOf(const QStringList &paths);
};

}  // namespace qplc
