// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QSize>
#include <QtCore/QString>
#include <QtCore/QVector>
#include <QtPlcGui>

#include <optional>

namespace awe {

/// What can be said of the Control Center on the command line.
struct ControlCenterSettings
{
    struct Master
    {
        QString name;  // empty: the address
        QString address;
    };

    QVector<Master> masters;
    QStringList recordings;  // to open
    bool demo = false;
    QString screenshot;  // file name; empty: none
    double after = 5.0;  // [s]
    QString video;       // file or folder; empty: none
    QPlcVideoExport::Options videoOptions;
    std::optional<QPlcControlCenter::Theme> theme;
    QString layout;  // file name; empty: as it was
    QString tab;     // empty: as it was
    QSize size;      // empty: as it was

    /// Whether it is said what the window shows; else it shows what it did last.
    bool namesPlants() const { return demo || !masters.isEmpty() || !recordings.isEmpty(); }
};

void addControlCenterOptions(QPlcApplicationOptions &application);
/// \return false, with the message out, when an option cannot be meant
bool readControlCenterOptions(QPlcApplicationOptions &application, ControlCenterSettings *settings);

}  // namespace awe
