// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcGui>

namespace awe {

/// A video of a recording without a person: it is made as soon as the window is there, and ends the
/// program. A program that ends before has failed.
class VideoTask : public QObject
{
    Q_OBJECT
public:
    /// \param window  outlives the task \param name  empty: no video is wanted, and nothing below
    ///         does anything
    VideoTask(QPlcControlCenter *window, const QString &name, const QPlcVideoExport::Options &options);

    void begin();
    /// What the program ends with. \param code  what its event loop ended with
    int exitCode(int code) const;

private:
    void start();
    void tell(int done);
    void end(bool isWritten);

    QPlcVideoExport m_export;
    const QString m_name;
    const QPlcVideoExport::Options m_options;
    bool m_hasEnded = false;
};

}  // namespace awe
