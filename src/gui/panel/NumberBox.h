// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QDoubleSpinBox>

namespace qplc {

/// A line for a number of any size: 0.0003, 250000 and 1e-09 alike, with ten digits that count.
///
/// value() is to the last bit what was set, until a person writes another number. Told when it is
/// complete, not with each key. Steps are a tenth of the first digit, and 0.001 about zero.
class NumberBox : public QDoubleSpinBox
{
    Q_OBJECT
public:
    NumberBox(double minimum, double maximum, QWidget *parent = nullptr);

    QString textFromValue(double value) const override;
    double valueFromText(const QString &text) const override;
    QValidator::State validate(QString &text, int &position) const override;
    void stepBy(int steps) override;

private:
    QString numberIn(const QString &text) const;
};

}  // namespace qplc
