// SPDX-License-Identifier: Apache-2.0
#include "VideoSink.h"

#include "gui/WindowText.h"
#include "recording/OutputFile.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtCore/QProcess>
#include <QtCore/QStandardPaths>
#include <QtCore/QTemporaryDir>

#include <cerrno>
#include <cstdio>

namespace qplc {

namespace {

constexpr qint64 FramesAhead = 2;         // that wait for ffmpeg
constexpr int ChildEnds = 2000;           // [ms] that a child gets to end
constexpr double VideoByteOfPixel = 0.3;  // at most: 2.4 bit
constexpr double PngBytesOfPixel = 3.1;   // at most: noise

QString writeError(const QString &name, const QString &reason)
{
    return WindowText::tr("'%1' cannot be written: %2").arg(name, reason);
}

/// A picture for each file of a folder.
class FrameFolder final : public VideoSink
{
public:
    explicit FrameFolder(const Format &format)
        : m_name(QDir::cleanPath(format.name))
        , m_folder(QFileInfo(m_name).absolutePath() + QStringLiteral("/.qtplc-XXXXXX"))
    {
    }
    bool begin()
    {
        if (QFileInfo::exists(m_name))
            return fail(WindowText::tr("'%1' is there already; choose another name").arg(m_name));
        return m_folder.isValid() || fail(writeError(m_name, m_folder.errorString()));
    }
    State state() override { return errorString().isEmpty() ? Ready : Failed; }
    bool add(const QImage &image) override
    {
        const QString file = m_folder.filePath(QStringLiteral("frame_%1.png").arg(m_frames++, 6, 10, QLatin1Char('0')));
        return image.save(file) || fail(writeError(m_name, WindowText::tr("the disk may be full")));
    }
    void end() override {}
    bool commit() override
    {
        // A folder that came meanwhile is refused, unless it is empty.
        const QByteArray from = QFile::encodeName(m_folder.path());
        if (::rename(from.constData(), QFile::encodeName(m_name).constData()) != 0)
            return fail(writeError(m_name, qt_error_string(errno)));
        m_folder.setAutoRemove(false);
        QFile::setPermissions(m_name,
                              QFile::permissions(m_name) | QFile::ReadGroup | QFile::ExeGroup | QFile::ReadOther
                                  | QFile::ExeOther);
        return true;
    }

private:
    QString m_name;
    QTemporaryDir m_folder;
    int m_frames = 0;
};

/// What ffmpeg makes of pictures that it is given.
class VideoFile final : public VideoSink
{
public:
    explicit VideoFile(const Format &format)
        : m_format(format)
        , m_file(format.name, format.isReplacing ? OutputFile::Replace : OutputFile::Refuse)
    {
    }
    ~VideoFile() override
    {
        if (m_encoder.state() == QProcess::NotRunning)
            return;
        m_encoder.kill();
        m_encoder.waitForFinished(ChildEnds);
    }
    bool begin()
    {
        QString error;
        const QString program = QStandardPaths::findExecutable(QStringLiteral("ffmpeg"));
        if (program.isEmpty())
            return fail(WindowText::tr("a video needs the program ffmpeg, which is not installed (Debian: ffmpeg); a "
                                       "name without .mp4 or .webm gives a folder of pictures without it"));
        if (!m_file.open(&error))
            return fail(error);
        m_encoder.setStandardOutputFile(QProcess::nullDevice());
        m_encoder.start(program, arguments());
        return m_encoder.waitForStarted(ChildEnds)
            || fail(WindowText::tr("'%1' does not start: %2").arg(program, m_encoder.errorString()));
    }
    State state() override
    {
        if (!errorString().isEmpty())
            return Failed;
        if (m_encoder.state() == QProcess::NotRunning)
            return hasSucceeded() ? Ready : Failed;
        const qint64 most = FramesAhead * m_format.size.width() * m_format.size.height() * 4;
        return m_hasEnded || m_encoder.bytesToWrite() > most ? Busy : Ready;
    }
    bool add(const QImage &image) override
    {
        // Rows of RGB32 have no padding.
        const auto *bytes = reinterpret_cast<const char *>(image.constBits());
        return m_encoder.write(bytes, image.sizeInBytes()) == image.sizeInBytes() || hasSucceeded();
    }
    void end() override
    {
        m_hasEnded = true;
        m_encoder.closeWriteChannel();
    }
    bool commit() override
    {
        QString error;
        return m_file.commit(&error) || fail(error);
    }

private:
    QStringList arguments() const
    {
        const QString size = QStringLiteral("%1x%2").arg(m_format.size.width()).arg(m_format.size.height());
        const QString rate = QString::number(m_format.framesPerSecond, 'g', 10);
        QStringList all{QStringLiteral("-y"),
                        QStringLiteral("-loglevel"),
                        QStringLiteral("error"),
                        QStringLiteral("-f"),
                        QStringLiteral("rawvideo"),
                        QStringLiteral("-pixel_format"),
                        QStringLiteral("bgr0"),
                        QStringLiteral("-video_size"),
                        size,
                        QStringLiteral("-framerate"),
                        rate,
                        QStringLiteral("-i"),
                        QStringLiteral("pipe:0"),
                        QStringLiteral("-pix_fmt"),
                        QStringLiteral("yuv420p")};
        if (m_format.name.endsWith(QLatin1String(".webm"), Qt::CaseInsensitive))
            all << QStringLiteral("-c:v") << QStringLiteral("libvpx-vp9") << QStringLiteral("-b:v")
                << QStringLiteral("0") << QStringLiteral("-crf") << QStringLiteral("32") << QStringLiteral("-f")
                << QStringLiteral("webm");
        else
            all << QStringLiteral("-c:v") << QStringLiteral("libx264") << QStringLiteral("-crf") << QStringLiteral("20")
                << QStringLiteral("-movflags") << QStringLiteral("+faststart") << QStringLiteral("-f")
                << QStringLiteral("mp4");
        return all << m_file.temporaryName();
    }
    /// \return false, with the reason, when ffmpeg has ended too early or with an error
    bool hasSucceeded()
    {
        m_encoder.waitForFinished(ChildEnds);  // it may have closed its input only
        const bool isGood = m_encoder.exitStatus() == QProcess::NormalExit && m_encoder.exitCode() == 0;
        if (m_hasEnded && isGood && m_encoder.state() == QProcess::NotRunning)
            return true;
        const QString said = QString::fromLocal8Bit(m_encoder.readAllStandardError()).trimmed();
        const QString last = said.section(QLatin1Char('\n'), -1).left(300);
        const QString how = isGood ? WindowText::tr("it has ended before the last picture")
                                   : WindowText::tr("it has ended with code %1").arg(m_encoder.exitCode());
        return fail(WindowText::tr("ffmpeg makes no video '%1': %2").arg(m_format.name, last.isEmpty() ? how : last));
    }

    Format m_format;
    OutputFile m_file;  // under its temporary name, ffmpeg writes it
    QProcess m_encoder;
    bool m_hasEnded = false;
};

template<typename Sink>
std::unique_ptr<VideoSink> begun(const VideoSink::Format &format, QString *error)
{
    auto sink = std::make_unique<Sink>(format);
    if (sink->begin())
        return sink;
    *error = sink->errorString();
    return nullptr;
}

}  // namespace

VideoSink::~VideoSink() = default;

bool VideoSink::fail(const QString &error)
{
    if (m_error.isEmpty())
        m_error = error;
    return false;
}

bool VideoSink::isVideo(const QString &name)
{
    return name.endsWith(QLatin1String(".mp4"), Qt::CaseInsensitive)
        || name.endsWith(QLatin1String(".webm"), Qt::CaseInsensitive);
}

double VideoSink::mostBytes(const Format &format, int frames)
{
    const double pixels = double(format.size.width()) * format.size.height() * frames;
    return pixels * (isVideo(format.name) ? VideoByteOfPixel : PngBytesOfPixel);
}

std::unique_ptr<VideoSink> VideoSink::create(const Format &format, QString *error)
{
    return isVideo(format.name) ? begun<VideoFile>(format, error) : begun<FrameFolder>(format, error);
}

}  // namespace qplc
