// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcRecording>

namespace awe {

/// Records each phase of a master into a file or folder, and prints what it has recorded.
class FlightRecorder : public QObject
{
    Q_OBJECT
public:
    /// \param master  outlives this object
    /// \param target  see QPlcRecorder::setTarget(); empty: nothing is recorded
    FlightRecorder(QPlcMasterNode &master, const QString &target);

    /// Begins. \return false when nothing can be recorded there, and failed() has told why
    bool start();
    /// Waits until all cycles of the phase that has ended are in its file.
    /// \return whether they are, or nothing is recorded
    bool finish();

Q_SIGNALS:
    /// A phase cannot be recorded.
    void failed(const QString &text);

private:
    QPlcRecorder m_recorder;
    bool m_hasFailed = false;
};

}  // namespace awe
