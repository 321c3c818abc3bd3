// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>
#include <QtGui/QImage>

#include <memory>

namespace qplc {

/// Takes the pictures of a video. What it writes has another name until it is complete, and is
/// removed with the sink otherwise.
class VideoSink
{
public:
    enum State { Ready, Busy, Failed };
    struct Format
    {
        QString name;  // of the file or folder
        QSize size;    // [pixel]
        double framesPerSecond = 25.0;
        bool isReplacing = false;
    };

    virtual ~VideoSink();
    /// Whether add() may be called. Failed: errorString() says why.
    virtual State state() = 0;
    /// \param image  of the format RGB32 and of the size of the video
    virtual bool add(const QImage &image) = 0;
    /// No picture comes any more: state() is Busy until all is written, then Ready.
    virtual void end() = 0;
    /// Gives the complete video its name.
    virtual bool commit() = 0;
    QString errorString() const { return m_error; }

    /// A video for ".mp4" and ".webm", otherwise a folder.
    static bool isVideo(const QString &name);
    /// [byte] that so many pictures may take
    static double mostBytes(const Format &format, int frames);
    /// \return null, with an error
    static std::unique_ptr<VideoSink> create(const Format &format, QString *error);

protected:
    bool fail(const QString &error);

private:
    QString m_error;
};

}  // namespace qplc
