// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SetterView.h"

class QLabel;
class QLineEdit;
class QToolButton;

namespace qplc {

/// A value that is typed: Enter sends it once, Esc takes the typing back, and nothing is
/// overwritten while it is edited. Keys and buttons step by 1 % and 10 % of the range. The number
/// is in the unit of the signal table, without a prefix: one that changed while it is typed would
/// make 4 kN out of 4 N.
class NumberView : public SetterView
{
    Q_OBJECT
public:
    NumberView(SetterTarget *target, QWidget *parent);
    void refresh() override;
    void showActual() override;

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void makeButtons();
    void apply();
    void applyNumber(const QString &text);
    void revert();
    void step(int steps);
    void setEdited(bool edited);
    void showValue();

    QLineEdit *m_edit;
    QLabel *m_unit;
    QToolButton *m_apply = nullptr;
    QVector<QToolButton *> m_steps;
    bool m_isEdited = false;
    QString m_sent;  // last text that was sent while this window may write; empty: the actual value is shown
};

}  // namespace qplc
