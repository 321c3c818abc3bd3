// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QTimer>
#include <QtWidgets/QWidget>

namespace awe {

/// A picture of the window without a person: it is made a time after begin(), and ends the program.
/// A program that ends before has failed.
class ScreenshotTask : public QObject
{
    Q_OBJECT
public:
    /// \param window outlives the task \param fileName empty: no picture is wanted, and nothing
    ///         below does anything \param after [s]
    ScreenshotTask(QWidget *window, const QString &fileName, double after);

    /// The time begins to run. Once it runs, nothing stops it: the picture shows what has happened.
    void begin();
    /// What should be seen does not come: ends the program, also one that has not come to its event
    /// loop yet, unless the time runs.
    void giveUp();
    /// What the program ends with. \param code  what its event loop ended with
    int exitCode(int code) const;

private:
    void makePicture();

    QWidget &m_window;
    const QString m_fileName;
    QTimer m_timer;
    bool m_hasBegun = false;
    bool m_hasEnded = false;  // by itself, with whatever outcome
};

}  // namespace awe
