// SPDX-License-Identifier: Apache-2.0
#include "QPlcRecorder.h"

#include "QPlcMasterNode.h"
#include "RecorderThread.h"

#include <QtCore/QFile>
#include <QtCore/QFileInfo>

#include <algorithm>

using qplc::RecorderLoop;
using qplc::RecorderThread;

struct QPlcRecorder::Private
{
    QString target;
    RecorderLoop::Settings settings;
    std::unique_ptr<RecorderThread> thread;  // null: off
    QMetaObject::Connection master;
    QPlcRecorder::State state = Off;  // as it was told
    Error error = NoError;
    QString errorString;
};

QPlcRecorder::QPlcRecorder(QObject *parent)
    : QObject(parent)
    , d(std::make_unique<Private>())
{
    qRegisterMetaType<QPlcRecorder::State>("QPlcRecorder::State");
}

QPlcRecorder::~QPlcRecorder()
{
    stop();
}

bool QPlcRecorder::setError(Error error, const QString &text)
{
    d->error = error;
    d->errorString = text;
    Q_EMIT errorOccurred();
    return false;
}

void QPlcRecorder::setTarget(const QString &path)
{
    d->target = path;
}

QString QPlcRecorder::target() const
{
    return d->target;
}

bool QPlcRecorder::isFolder() const
{
    return d->target.endsWith(QLatin1Char('/')) || QFileInfo(d->target).isDir();
}

void QPlcRecorder::setSegmentDuration(std::chrono::seconds duration)
{
    d->settings.segmentTime = std::chrono::nanoseconds(std::max(duration, std::chrono::seconds(1))).count();
}

std::chrono::seconds QPlcRecorder::segmentDuration() const
{
    return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::nanoseconds(d->settings.segmentTime));
}

void QPlcRecorder::setSegmentSize(quint64 bytes)
{
    d->settings.segmentSize = std::max<quint64>(bytes, 1 << 20);
}

quint64 QPlcRecorder::segmentSize() const
{
    return d->settings.segmentSize;
}

void QPlcRecorder::setLongestAge(std::chrono::seconds age)
{
    d->settings.limits.longestAge = std::chrono::milliseconds(age).count();
}

void QPlcRecorder::setLargestTotal(quint64 bytes)
{
    d->settings.limits.largestTotal = bytes;
}

void QPlcRecorder::setLeastFree(quint64 bytes)
{
    d->settings.limits.leastFree = bytes;
}

void QPlcRecorder::setMaster(QPlcMasterNode *master)
{
    disconnect(d->master);
    // Direct: cycles begin behind this, so none of them is missing.
    if (master)
        d->master = connect(
            master, &QPlcMasterNode::ringIsReady, this,
            [this](const QString &ring) {
                if (d->thread)
                    addRing(ring);
            },
            Qt::DirectConnection);
}

void QPlcRecorder::setPlant(const QString &plant)
{
    d->settings.plant = plant;
    d->settings.looksForRings = true;
}

bool QPlcRecorder::start()
{
    if (d->thread)
        return true;
    d->settings.file = isFolder() ? QString() : d->target;
    d->settings.folder = isFolder() ? d->target : QString();
    if (d->target.isEmpty())
        return setError(TargetError, tr("there is no target to record to; call setTarget() first"));
    auto thread = std::make_unique<RecorderThread>(d->settings, qplc::Disk::machine());
    thread->setCallback([this] {
        QMetaObject::invokeMethod(
            this, [this] { tell(); }, Qt::QueuedConnection);
    });
    QString error;
    if (!thread->start(&error))
        return setError(TargetError, error);
    d->thread = std::move(thread);
    d->state = Waiting;
    Q_EMIT stateChanged(Waiting);
    return true;
}

bool QPlcRecorder::stop()
{
    if (!d->thread)
        return true;
    QString error;
    const bool isWritten = d->thread->stop(&error);
    tell();
    d->thread.reset();
    d->state = Off;
    Q_EMIT stateChanged(Off);
    return isWritten || setError(WriteError, error);
}

/// What the thread has to tell.
void QPlcRecorder::tell()
{
    if (!d->thread)  // stopped meanwhile
        return;
    const std::vector<RecorderLoop::FileNews> files = d->thread->takeNews();
    const State now = state();
    const QString reason = status().error;
    for (const RecorderLoop::FileNews &file : files) {
        if (file.isFinished)
            Q_EMIT fileFinished(file.file, file.cycles, file.missing);
        else
            Q_EMIT fileStarted(file.file, file.plant);
        if (file.isAbandoned)
            Q_EMIT masterLost(file.file);
    }
    if (now == d->state)
        return;
    d->state = now;
    if (now == Retrying)
        setError(WriteError, reason);
    Q_EMIT stateChanged(now);
}

bool QPlcRecorder::addRing(const QString &ring)
{
    if (!d->thread)
        return setError(RingError, tr("the recorder is off; call start() first"));
    QString error;
    if (!d->thread->add(QFile::encodeName(ring), &error))
        return setError(RingError, error);
    if (d->state == Waiting) {
        d->state = Recording;
        Q_EMIT stateChanged(Recording);
    }
    return true;
}

bool QPlcRecorder::mark()
{
    return d->thread && d->thread->mark();
}

bool QPlcRecorder::waitForFinished(std::chrono::milliseconds timeout)
{
    const bool hasEnded = !d->thread || d->thread->waitForEnds(timeout);
    tell();
    return hasEnded;
}

QPlcRecorder::Status QPlcRecorder::status() const
{
    Status status;
    if (!d->thread)
        return status;
    const RecorderLoop::Status now = d->thread->status();
    status.state = now.isStopped ? Paused : now.hasFailed ? Retrying : now.phases > 0 ? Recording : Waiting;
    status.file = now.file;
    status.cycles = now.cycles;
    status.missing = now.missing;
    status.bytes = now.bytes;
    status.bytesPerSecond = now.bytesPerSecond;
    status.freeBytes = now.freeBytes;
    status.error = now.error;
    return status;
}

QPlcRecorder::State QPlcRecorder::state() const
{
    return status().state;
}

QPlcRecorder::Error QPlcRecorder::error() const
{
    return d->error;
}

QString QPlcRecorder::errorString() const
{
    return d->errorString;
}
