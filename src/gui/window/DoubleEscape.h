// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QElapsedTimer>
#include <QtCore/QObject>

namespace qplc {

/// Hears Escape pressed twice within 0.6 s, anywhere in the program, and takes it from nobody.
///
/// One press goes through several objects, and whoever gets it first may take his time. A press is known by when it was made, which all of its deliveries say; where nobody says that (a press that a program makes), the key
/// has to be released before the next one.
class DoubleEscape : public QObject
{
    Q_OBJECT
public:
    explicit DoubleEscape(QObject *parent = nullptr);
    bool eventFilter(QObject *watched, QEvent *event) override;

Q_SIGNALS:
    void pressed();

private:
    void hear(qint64 time);

    qint64 m_lastTime = 0;  // of the last press [ms]; 0: not known
    QElapsedTimer m_sinceLast;
    bool m_isHeld = false;   // it was not released since
    bool m_isArmed = false;  // the first one was heard
};

}  // namespace qplc
