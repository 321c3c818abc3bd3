// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Playback.h"
#include "QPlcVideoExport.h"

#include <QtWidgets/QAction>

class QPlcControlCenter;

namespace qplc {

/// The command that saves a video of the recording that is played: what is between the cursors,
/// otherwise all of it, with the speed of the playback. A line of the window shows how far it is,
/// and cancels it.
class VideoCommand : public QObject
{
    Q_OBJECT
public:
    /// \param action  of the menu; enabled while a recording is open
    /// \param window  its parent
    VideoCommand(QAction *action, Playback *playback, QPlcControlCenter *window);

    /// Begins, or says why not.
    void save(const QString &name);
    bool isRunning() const { return m_export && m_export->isRunning(); }

private:
    void ask();
    QPlcVideoExport::Options options() const;
    void follow();
    void tell(int done);
    void end(bool isWritten);

    QAction *m_action;
    QAction m_cancel;
    Playback *m_playback;
    QPlcControlCenter *m_window;
    std::unique_ptr<QPlcVideoExport> m_export;
    QString m_name;
};

}  // namespace qplc
