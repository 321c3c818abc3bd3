// SPDX-License-Identifier: Apache-2.0
#include "VideoTask.h"

#include <QtCore/QTimer>

#include <cstdio>

namespace awe {

VideoTask::VideoTask(QPlcControlCenter *window, const QString &name, const QPlcVideoExport::Options &options)
    : m_export(window)
    , m_name(name)
    , m_options(options)
{
    connect(&m_export, &QPlcVideoExport::progressed, this, &VideoTask::tell);
    connect(&m_export, &QPlcVideoExport::finished, this, &VideoTask::end);
}

void VideoTask::begin()
{
    if (!m_name.isEmpty())
        QTimer::singleShot(0, this, &VideoTask::start);
}

void VideoTask::start()
{
    if (!m_export.start(m_name, m_options))
        end(false);
}

/// Each tenth.
void VideoTask::tell(int done)
{
    const int all = m_export.frames();
    if (done * 10 / all == (done - 1) * 10 / all)
        return;
    std::printf("%d of %d pictures\n", done, all);
    std::fflush(stdout);
}

void VideoTask::end(bool isWritten)
{
    m_hasEnded = true;
    if (!isWritten)
        QPlcGuiApplication::printError(m_export.errorString());
    QCoreApplication::exit(isWritten ? QPlcGuiApplication::Success : QPlcGuiApplication::Failure);
}

int VideoTask::exitCode(int code) const
{
    if (m_name.isEmpty() || m_hasEnded)
        return code;
    QPlcGuiApplication::printError(
        tr("the program was ended before the video '%1' was complete: nothing was written").arg(m_name));
    return QPlcGuiApplication::Failure;
}

}  // namespace awe
