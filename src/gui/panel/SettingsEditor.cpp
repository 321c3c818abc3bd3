// SPDX-License-Identifier: Apache-2.0
#include "SettingsEditor.h"

#include <QtGui/QDoubleValidator>
#include <QtWidgets/QFormLayout>
#include <QtWidgets/QLineEdit>

namespace qplc {

SettingsEditor::~SettingsEditor()
{
    const QList<QLineEdit *> lines = findChildren<QLineEdit *>();
    for (QLineEdit *line : lines)
        line->disconnect(this);
}

QLineEdit *SettingsEditor::addNumber(QFormLayout *form, const QString &label, std::optional<double> number,
                                     const QString &whenEmpty, const std::function<void(std::optional<double>)> &write)
{
    constexpr int digits = 10;
    auto *line = new QLineEdit(number ? QLocale::c().toString(*number, 'g', digits) : QString(), this);
    auto *validator = new QDoubleValidator(line);
    validator->setLocale(QLocale::c());
    line->setValidator(validator);
    line->setPlaceholderText(whenEmpty);
    line->setAccessibleName(label);
    form->addRow(label, line);
    connect(line, &QLineEdit::editingFinished, this, [line, write] {
        if (line->text().isEmpty())
            write(std::nullopt);
        else if (line->hasAcceptableInput())
            write(QLocale::c().toDouble(line->text()));
    });
    connect(line, &QLineEdit::textEdited, this, [write](const QString &text) {
        if (text.isEmpty())  // an empty line is no number, but finished
            write(std::nullopt);
    });
    return line;
}

}  // namespace qplc
