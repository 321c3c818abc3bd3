// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcIOBufferSlaveNode.h"

#include <QtCore/QList>
#include <QtCore/QObject>
#include <QtCore/QPointer>
#include <QtCore/QTimer>

/// Hands the inputs of a QPlcIOBufferSlaveNode to a window, in batches, at a fixed rate.
///
/// \code
/// auto *node = new QPlcIOBufferSlaveNode("Plot");
/// auto *limiter = new QPlcFrameRateLimiter(node, node);
/// limiter->setFrameRateLimit(50);
/// QObject::connect(
///     limiter, &QPlcFrameRateLimiter::realTimeout, node,
///     [](const QList<QPlcSignalList> &cycles) { qInfo("%d new cycles", cycles.size()); });
/// \endcode
///
/// \threadsafe no: it lives in the thread of the receiver. Its node may live in another thread
///
/// \ingroup nodes
class QTPLC_EXPORT QPlcFrameRateLimiter : public QObject
{
    Q_OBJECT
public:
    /// Begins to take batches from \a node, 50 times a second.
    /// \param node  not owned; when it is destroyed, no batch comes any more
    /// \param parent  owns this object, if given
    explicit QPlcFrameRateLimiter(QPlcIOBufferSlaveNode *node, QObject *parent = nullptr);

    /// Sets the number of batches per second; default 50. The interval is rounded to 1 ms.
    /// \param framesPerSecond  1 to 1000; a value outside becomes the nearest limit, and NaN 1
    void setFrameRateLimit(double framesPerSecond);
    /// Returns the number of batches per second.
    double frameRateLimit() const;

Q_SIGNALS:
    /// Emitted at the set rate when there are new cycles.
    /// \param inputSignals  inputs of all cycles since the last batch, oldest first; never empty
    void realTimeout(const QList<QPlcSignalList> &inputSignals);
    /// Emitted after realTimeout() with the same values; the name of the thesis.
    void timedOut(const QList<QPlcSignalList> &inputSignals);

private:
    Q_DECL_HIDDEN void takeBatch();

    QPointer<QPlcIOBufferSlaveNode> m_node;
    QTimer m_timer{this};  // moves to another thread with its parent
    double m_framesPerSecond = 50.0;
};
