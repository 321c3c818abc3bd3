// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QMap>
#include <QtCore/QString>

namespace qplc {

/// How other programs ask the recorder of a folder for something, and hear from it: by files in
/// that folder (docs/design/record-control.md). Who may write into the folder, may ask.
class RecorderControl
{
public:
    using Status = QMap<QByteArray, QByteArray>;

    /// The file that the recorder of a folder has locked. It holds its status.
    static QString lockFile(const QString &folder);

    // ---- for other programs ----

    /// Whether a recorder has the folder.
    static bool hasRecorder(const QString &folder);
    /// What it has told last. Empty: nothing
    static Status status(const QString &folder);
    /// Asks for a mark; isMarkTaken() says when the recorder has got it.
    static bool askForMark(const QString &folder, QString *error);
    static bool isMarkTaken(const QString &folder);
    /// The recorder has not answered.
    static void withdrawMark(const QString &folder);
    /// Whether recorders of this folder are to record nothing, from now on and after a new start.
    static bool setStopped(const QString &folder, bool isStopped, QString *error);

    // ---- for the recorder ----

    static bool isStopped(const QString &folder);
    /// \return whether somebody has asked for a mark since the last call
    static bool takeMark(const QString &folder);
    /// \param descriptor  of the lock file
    static void tell(int descriptor, const Status &status);
};

}  // namespace qplc
