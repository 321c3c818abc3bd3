// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcIOBufferSlaveNode.h"

#include <QtCore/QList>
#include <QtCore/QObject>
#include <QtCore/QPointer>
#include <QtCore/QTimer>

/// Hands the inputs of a QPlcIOBufferSlaveNode to a window, in batches, as often as the window wants.
///
/// ```cpp
/// QPlcFrameRateLimiter limiter(slaveNode);
/// limiter.setFrameRateLimit(50);
/// connect(&limiter, &QPlcFrameRateLimiter::realTimeout, plot, &Plot::append);
/// ```
///
/// Threads: lives in the thread of the receiver.
class QTPLC_EXPORT QPlcFrameRateLimiter : public QObject
{
    Q_OBJECT
public:
    /// \param node  outlives this object, or takes it out of service by its end
    explicit QPlcFrameRateLimiter(QPlcIOBufferSlaveNode *node, QObject *parent = nullptr);

    /// Batches per second, 1 ... 1000; 50 unless set. Values beyond are taken as the nearest.
    void setFrameRateLimit(double framesPerSecond);
    double frameRateLimit() const;

Q_SIGNALS:
    /// The inputs of all cycles since the last batch, oldest first; never empty.
    void realTimeout(const QList<QPlcSignalList> &inputSignals);
    /// The same, under the name that the thesis gives it.
    void timedOut(const QList<QPlcSignalList> &inputSignals);

private:
    void takeBatch();

    QPointer<QPlcIOBufferSlaveNode> m_node;
    QTimer m_timer{this};  // moves to another thread with its parent
    double m_framesPerSecond = 50.0;
};
