// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SetterView.h"

class QComboBox;

namespace qplc {

/// A list of the names that the values of a signal have in its table: what is chosen is sent once,
/// as its number. Keys open the list, so that nothing is sent on the way.
class ChoiceView : public SetterView
{
    Q_OBJECT
public:
    ChoiceView(SetterTarget *target, QWidget *parent);
    void refresh() override;
    void showActual() override;

private:
    void fill();
    void choose(int place);

    QComboBox *m_list;
    QPlcValueNames m_names;
    std::optional<double> m_minimum;  // of what is in the list
    std::optional<double> m_maximum;
    int m_waits = 0;  // looks at the actual value until what was chosen is there
};

}  // namespace qplc
