// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QWidget>

#include <functional>
#include <optional>

class QFormLayout;
class QLineEdit;

namespace qplc {

/// What editors of settings have in common: lines for numbers that may be left empty, and an end in
/// which no line writes any more.
class SettingsEditor : public QWidget
{
    Q_OBJECT
public:
    using QWidget::QWidget;
    /// A line that has the focus loses it, and says so, only when the settings of the editor are no
    /// more. It must not write them then.
    ~SettingsEditor() override;

protected:
    /// A line for a text, without spaces at its ends. \param write gets what a person has
    /// completed, if it is another text
    QLineEdit *makeText(const QString &name, const QString &text, const std::function<void(const QString &)> &write);
    /// A line for a number. \param whenEmpty  as in addNumber(); empty: there has to be a number
    /// \param write  gets each other number while it is typed
    QLineEdit *makeNumber(const QString &name, std::optional<double> number, const QString &whenEmpty,
                          const std::function<void(std::optional<double>)> &write);
    /// Adds a line for a number. \param whenEmpty  what an empty line means, for people
    /// \param write gets what a person has completed, at once when the line is emptied; may be the
    ///         same number again
    QLineEdit *addNumber(QFormLayout *form, const QString &label, std::optional<double> number,
                         const QString &whenEmpty, const std::function<void(std::optional<double>)> &write);

private:
    QLineEdit *makeNumberLine(const QString &name, std::optional<double> number, const QString &whenEmpty);
};

}  // namespace qplc
