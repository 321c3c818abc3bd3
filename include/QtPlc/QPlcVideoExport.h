// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"

#include <QtCore/QObject>
#include <QtCore/QSize>

#include <memory>

class QPlcControlCenter;

/// Makes a video of what the panels of a window show of a recording: plots, gauges, tables, 3D
/// views.
///
/// \code
/// QPlcControlCenter window;
/// QString error;
/// window.openRecording({"flight.mcap"}, &error);
/// window.show();
/// QPlcVideoExport video(&window);
/// QPlcVideoExport::Options options;
/// options.speed = 10.0;
/// if (!video.start("flight.mp4", options))
///     qWarning("%s", qPrintable(video.errorString()));
/// QObject::connect(&video, &QPlcVideoExport::finished, &window, &QWidget::close);
/// \endcode
///
/// It moves the playhead of the recording from picture to picture, and waits until all panels of
/// the tab in front have drawn. So each picture shows its time exactly, however long that takes.
/// The window has to be visible meanwhile. Nobody else should move the playhead.
///
/// A name that ends with `.mp4` or `.webm` is a video: the program `ffmpeg` makes it, and has to be
/// installed. Any other name is a folder that gets a file for each picture, `frame_000000.png` and
/// so on. The file or folder appears under its name when all of it is written. If something fails,
/// nothing is left.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup controlcenter
class QTPLC_GUI_EXPORT QPlcVideoExport : public QObject
{
    Q_OBJECT
public:
    /// What is shown, and how.
    struct Options
    {
        double from = 0.0;              ///< begin [s], from the begin of the recording
        double to = -1.0;               ///< end [s]; less than 0: the end of the recording
        double framesPerSecond = 25.0;  ///< 1 to 120
        double speed = 1.0;             ///< seconds of the recording in a second, 0.001 to 100 000
        double span = 0.0;              ///< time that plots show [s]; 0: all of the video
        QSize size;                     ///< of a picture [pixel]; empty: as large as the panels are
        bool isReplacing = false;       ///< a file of this name is replaced; a folder never is
    };
    /// Largest number of pictures: 200 000.
    static constexpr int MostFrames = 200'000;

    /// Makes an export that waits for start().
    /// \param window  outlives it, or owns it
    explicit QPlcVideoExport(QPlcControlCenter *window);
    /// Cancels an export that has not ended.
    ~QPlcVideoExport() override;

    /// Begins. The event loop does the rest.
    /// \param name  of the file or folder
    /// \return false if it cannot begin: no recording is open, an option is out of range, `ffmpeg`
    ///     is missing, the disk has too little room, or the name is there already; errorString()
    ///     says why
    bool start(const QString &name, const Options &options);
    /// Ends the export, and removes what it has written. Emits finished() if it was running.
    void cancel();
    /// Returns true from start() to finished().
    bool isRunning() const;
    /// Returns why the export has failed; empty: it has not.
    QString errorString() const;
    /// Returns the number of pictures; 0 before start().
    int frames() const;

Q_SIGNALS:
    /// Emitted when a picture was taken.
    /// \param done  number of pictures so far
    void progressed(int done);
    /// Emitted when the export has ended.
    /// \param isWritten  false: errorString() says why nothing was written
    void finished(bool isWritten);

private:
    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
