// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcRecording>

namespace awe {

/// Records each phase of a master into a file or folder, and prints what it has recorded.
class FlightRecorder : public QObject
{
    Q_OBJECT
public:
    /// Which recordings of a folder are deleted; 0: there is no limit.
    struct Limits
    {
        double days = 0.0;       ///< older ones
        double gibibytes = 0.0;  ///< the oldest ones, while all have more
        double free = 1.0;       ///< the oldest ones, while the disk has less free [GiB]
    };

    /// \param master  outlives this object
    /// \param target  see QPlcRecorder::setTarget(); empty: nothing is recorded
    FlightRecorder(QPlcMasterNode &master, const QString &target, const Limits &limits);

    static void addLimitOptions(QPlcCoreApplication &application);
    /// \return false, with the message out
    static bool readLimits(QPlcCoreApplication &application, Limits *limits);

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
