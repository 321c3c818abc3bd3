// SPDX-License-Identifier: Apache-2.0
#include "ScreenshotTask.h"

#include "Screenshot.h"

#include <QtPlcGui>

#include <chrono>

namespace awe {

ScreenshotTask::ScreenshotTask(QWidget *window, const QString &fileName, double after)
    : m_window(*window)
    , m_fileName(fileName)
{
    m_timer.setSingleShot(true);
    m_timer.setInterval(std::chrono::milliseconds(qRound64(after * 1000.0)));
    connect(&m_timer, &QTimer::timeout, this, &ScreenshotTask::makePicture);
}

void ScreenshotTask::begin()
{
    if (m_hasBegun || m_fileName.isEmpty())
        return;
    m_hasBegun = true;
    m_timer.start();
}

void ScreenshotTask::giveUp()
{
    if (m_hasBegun || m_fileName.isEmpty())
        return;
    m_hasEnded = true;
    QTimer::singleShot(0, this, [] { QCoreApplication::exit(QPlcGuiApplication::Failure); });
}

void ScreenshotTask::makePicture()
{
    m_hasEnded = true;
    QString error;
    const bool isWritten = writeScreenshot(&m_window, m_fileName, &error);
    if (!isWritten)
        QPlcGuiApplication::printError(error);
    QCoreApplication::exit(isWritten ? QPlcGuiApplication::Success : QPlcGuiApplication::Failure);
}

int ScreenshotTask::exitCode(int code) const
{
    if (m_fileName.isEmpty() || m_hasEnded)
        return code;
    QPlcGuiApplication::printError(
        tr("the program was ended before the picture '%1' was made: give it the time of --after").arg(m_fileName));
    return QPlcGuiApplication::Failure;
}

}  // namespace awe
