// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QLineEdit>

namespace qplc {

/// A line over a name, in which it is changed: Enter or a click elsewhere takes it, Escape does
/// not, nor does a layout that moves or hides it. It deletes itself.
class InlineEdit : public QLineEdit
{
    Q_OBJECT
public:
    InlineEdit(const QString &text, const QRect &place, QWidget *parent);

Q_SIGNALS:
    void accepted(const QString &text);

protected:
    void keyPressEvent(QKeyEvent *event) override;
    void focusOutEvent(QFocusEvent *event) override;
    void hideEvent(QHideEvent *event) override;

private:
    enum Outcome { Take, Forget };
    void finish(Outcome outcome);
    bool m_isFinished = false;
};

}  // namespace qplc
