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

QLineEdit *SettingsEditor::makeText(const QString &name, const QString &text,
                                    const std::function<void(const QString &)> &write)
{
    auto *line = new QLineEdit(text, this);
    line->setAccessibleName(name);
    connect(line, &QLineEdit::editingFinished, this, [line, write, last = text]() mutable {
        if (line->text().trimmed() != last)
            write(last = line->text().trimmed());
    });
    return line;
}

QLineEdit *SettingsEditor::makeNumberLine(const QString &name, std::optional<double> number, const QString &whenEmpty)
{
    constexpr int digits = 10;
    auto *line = new QLineEdit(number ? QLocale::c().toString(*number, 'g', digits) : QString(), this);
    auto *validator = new QDoubleValidator(line);
    validator->setLocale(QLocale::c());
    line->setValidator(validator);
    line->setPlaceholderText(whenEmpty);
    line->setAccessibleName(name);
    return line;
}

QLineEdit *SettingsEditor::makeNumber(const QString &name, std::optional<double> number, const QString &whenEmpty,
                                      const std::function<void(std::optional<double>)> &write)
{
    QLineEdit *line = makeNumberLine(name, number, whenEmpty);
    const bool canBeEmpty = !whenEmpty.isEmpty();
    connect(line, &QLineEdit::textEdited, this, [write, canBeEmpty, last = number](const QString &text) mutable {
        bool isNumber = false;
        const double typed = text.toDouble(&isNumber);
        const std::optional<double> wanted = isNumber ? std::optional<double>(typed) : std::nullopt;
        const bool isFinished = isNumber || (canBeEmpty && text.isEmpty());  // "-" is not
        if (isFinished && wanted != last)
            write(last = wanted);
    });
    return line;
}

QLineEdit *SettingsEditor::addNumber(QFormLayout *form, const QString &label, std::optional<double> number,
                                     const QString &whenEmpty, const std::function<void(std::optional<double>)> &write)
{
    QLineEdit *line = makeNumberLine(label, number, whenEmpty);
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
