// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QElapsedTimer>
#include <QtCore/QObject>

namespace qplc {

/// Hears Escape pressed twice within 0.6 s, anywhere in the program, and takes it from nobody.
class DoubleEscape : public QObject
{
    Q_OBJECT
public:
    explicit DoubleEscape(QObject *parent = nullptr);
    bool eventFilter(QObject *watched, QEvent *event) override;

Q_SIGNALS:
    void pressed();

private:
    void hear();

    QElapsedTimer m_sinceLast;
    bool m_isArmed = false;  // the first one was heard
};

}  // namespace qplc
