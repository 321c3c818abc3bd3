// SPDX-License-Identifier: Apache-2.0
#include "QPlcFrameRateLimiter.h"

QPlcFrameRateLimiter::QPlcFrameRateLimiter(QPlcIOBufferSlaveNode *node, QObject *parent)
    : QObject(parent)
    , m_node(node)
{
    qRegisterMetaType<QList<QPlcSignalList>>("QList<QPlcSignalList>");
    connect(&m_timer, &QTimer::timeout, this, &QPlcFrameRateLimiter::takeBatch);
    setFrameRateLimit(m_framesPerSecond);
}

void QPlcFrameRateLimiter::setFrameRateLimit(double framesPerSecond)
{
    m_framesPerSecond = qBound(1.0, framesPerSecond, 1000.0);
    m_timer.start(qRound(1000.0 / m_framesPerSecond));
}

double QPlcFrameRateLimiter::frameRateLimit() const
{
    return m_framesPerSecond;
}

void QPlcFrameRateLimiter::takeBatch()
{
    if (!m_node)
        return;
    const QList<QPlcSignalList> batch = m_node->takeInputSignals();
    if (batch.isEmpty())
        return;
    Q_EMIT realTimeout(batch);
    Q_EMIT timedOut(batch);
}
