// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChildProcess.h"

#include <QtPlcCore>

#include <memory>

namespace awe {

/// Records each phase of a master into a file, by `qtplc record`: the first one into FILE, the next
/// ones into FILE-2, FILE-3, ...
class FlightRecorder : public QObject
{
    Q_OBJECT
public:
    /// \param master  outlives this object
    /// \param file  empty: nothing is recorded
    FlightRecorder(QPlcMasterNode &master, const QString &file);
    ~FlightRecorder() override;

    /// Waits until all cycles of the phase that has ended are in the file.
    /// \return whether they are, or nothing is recorded
    bool finish();

Q_SIGNALS:
    /// The phase cannot be recorded. \param text  empty: the recorder has said why
    void failed(const QString &text);

private:
    void record(const QString &ring);
    QString nextFile();

    const QString m_file;
    int m_count = 0;
    std::unique_ptr<ChildProcess> m_process;
};

}  // namespace awe
