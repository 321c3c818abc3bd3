// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/session/BackOff.h"
#include "node/session/ControlClient.h"
#include "recording/RingCopy.h"

#include <QtCore/QTimer>

#include <memory>

class QPlcRecorder;

namespace tools {

/// Lets a recorder of this computer record the phases of a master on another one: connects, again
/// after each loss, and copies its rings.
class RemoteRings : public QObject
{
    Q_OBJECT
public:
    /// \param recorder  outlives this object, and is started
    RemoteRings(QPlcRecorder *recorder, const QPlcUnderlyingProtocol &master);

    void start();
    /// Tells the master that nobody records any more. Waits for it, not longer than 2 s.
    void finish();
    QString errorString() const { return m_error; }

Q_SIGNALS:
    /// There will be no recording: errorString() says why.
    void failed();
    /// Something that passes, for people.
    void troubled(const QString &text);

private:
    using Reply = qplc::ControlClient::Reply<qplc::messages::GetRecords>;

    void lost(qplc::ControlClient::Loss loss, const QString &reason);
    void ask();
    void handle(const Reply &reply);
    void refused(const qplc::messages::Failed &refusal);
    void taken();
    void forget();
    void fail(const QString &text);
    void trouble(const QString &text);

    QPlcRecorder *const m_recorder;
    const QPlcUnderlyingProtocol m_master;
    qplc::ControlClient m_control;
    qplc::BackOff m_backOff;
    std::unique_ptr<qplc::RingCopy> m_copy;
    QTimer m_retry;
    QTimer m_due;
    QString m_error;
    QString m_trouble;  // told last
    bool m_wasThere = false;
    bool m_isRecording = false;  // the recorder has the copy
    bool m_isFinishing = false;
};

}  // namespace tools
