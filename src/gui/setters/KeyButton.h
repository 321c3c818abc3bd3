// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QPushButton>

namespace qplc {

/// Shows a key; click it and press another one to change it. Esc leaves it as it is.
class KeyButton : public QPushButton
{
    Q_OBJECT
public:
    /// \param key  Qt::Key; 0: none
    KeyButton(int key, QWidget *parent);
    int key() const { return m_key; }

Q_SIGNALS:
    void keyChanged(int key);

protected:
    bool event(QEvent *event) override;
    void focusOutEvent(QFocusEvent *event) override;

private:
    void setWaiting(bool waiting);
    void take(int key);

    int m_key;
    bool m_isWaiting = false;
};

}  // namespace qplc
