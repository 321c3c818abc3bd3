// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SetterView.h"

class QPushButton;

namespace qplc {

/// A value (`pressed`; the maximum, or 1, unless set) as long as a button is held, by mouse or
/// space bar; neutral when it is released, hidden, loses the focus, or may not write any more.
class MomentaryView : public SetterView
{
    Q_OBJECT
public:
    MomentaryView(SetterTarget *target, QWidget *parent);
    ~MomentaryView() override;
    void refresh() override;
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    double pressedValue() const;
    void press();
    void release();

    QPushButton *m_button;
    std::optional<double> m_pressed;
};

}  // namespace qplc
