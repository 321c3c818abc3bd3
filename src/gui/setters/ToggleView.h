// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SetterView.h"

namespace qplc {

class SwitchButton;

/// Two values: on (`on`, 1 unless set) and off (neutral). A click sends once; the switch shows what
/// the plant has.
class ToggleView : public SetterView
{
    Q_OBJECT
public:
    ToggleView(SetterTarget *target, QWidget *parent);
    void refresh() override;
    void showActual() override;
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;

private:
    void clicked();

    SwitchButton *m_switch;
    double m_on = 1.0;
    int m_waits = 0;  // calls of showActual() in which the plant may still show the value from before
};

}  // namespace qplc
