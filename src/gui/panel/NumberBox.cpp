// SPDX-License-Identifier: Apache-2.0
#include "NumberBox.h"

#include <QtGui/QDoubleValidator>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr int shownDigits = 10;
constexpr int allDecimals = 323;  // of a double: values are not rounded
constexpr double smallestStep = 0.001;

double stepAt(double value)
{
    const double size = std::fabs(value);
    const double tenth = size > 0.0 ? std::pow(10.0, std::floor(std::log10(size)) - 1.0) : smallestStep;
    return size < smallestStep ? tenth : std::max(tenth, smallestStep);
}

}  // namespace

NumberBox::NumberBox(double minimum, double maximum, QWidget *parent)
    : QDoubleSpinBox(parent)
{
    setLocale(QLocale::c());
    setDecimals(allDecimals);
    setRange(minimum, maximum);
    setKeyboardTracking(false);
}

/// Without prefix and suffix.
QString NumberBox::numberIn(const QString &text) const
{
    QString number = text;
    if (!prefix().isEmpty() && number.startsWith(prefix()))
        number.remove(0, prefix().size());
    if (!suffix().isEmpty() && number.endsWith(suffix()))
        number.chop(suffix().size());
    return number.trimmed();
}

QString NumberBox::textFromValue(double value) const
{
    return QString::number(value, 'g', shownDigits);
}

/// What nobody has written is what was set, also when it has more digits than are seen.
double NumberBox::valueFromText(const QString &text) const
{
    const QString number = numberIn(text);
    return number == textFromValue(value()) ? value() : number.toDouble();
}

QValidator::State NumberBox::validate(QString &text, int &position) const
{
    QDoubleValidator validator(minimum(), maximum(), allDecimals, nullptr);
    validator.setLocale(QLocale::c());
    QString number = numberIn(text);
    return validator.validate(number, position);
}

void NumberBox::stepBy(int steps)
{
    interpretText();
    setValue(textFromValue(value() + steps * stepAt(value())).toDouble());
    selectAll();
}

}  // namespace qplc
