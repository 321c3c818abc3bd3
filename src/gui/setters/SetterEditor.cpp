// SPDX-License-Identifier: Apache-2.0
#include "SetterEditor.h"
#include "gui/panel/SignalEdit.h"

#include "SetterView.h"
#include "gui/panel/EndOfEditor.h"

#include <QtGui/QDoubleValidator>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QFormLayout>
#include <QtWidgets/QLineEdit>

namespace qplc {

SetterEditor::SetterEditor(const SetterSettings &settings, const PlantList *plants, QWidget *parent)
    : QWidget(parent)
    , m_settings(settings)
{
    auto *form = new QFormLayout(this);
    auto *signal = new SignalEdit(plants, SignalEdit::AllSignals, this);
    signal->setText(settings.signal.toString());
    signal->setMinimumWidth(180);
    form->addRow(tr("Signal"), signal);
    setFocusProxy(signal);
    connect(signal, &QLineEdit::editingFinished, this, [this, signal] {
        const SignalReference reference = SignalReference::fromString(signal->text());
        if (reference == m_settings.signal)
            return;
        m_settings.signal = reference;
        Q_EMIT edited(m_settings);
    });
    auto *style = new QComboBox(this);
    style->addItems(SetterView::styles());
    style->setCurrentText(settings.style);
    style->setAccessibleName(tr("Style"));
    form->addRow(tr("Style"), style);
    connect(style, &QComboBox::currentTextChanged, this, [this](const QString &text) {
        m_settings.style = text;
        Q_EMIT edited(m_settings);
    });
    addNumber(form, tr("Minimum"), &SetterSettings::minimum);
    addNumber(form, tr("Maximum"), &SetterSettings::maximum);
    addNumber(form, tr("Toggle: on"), &SetterSettings::on);
    addNumber(form, tr("Momentary: held"), &SetterSettings::pressed);
}

SetterEditor::~SetterEditor()
{
    disconnectLines(this);
}

void SetterEditor::addNumber(QFormLayout *form, const QString &label, std::optional<double> SetterSettings::*number)
{
    auto *field = new QLineEdit(this);
    auto *validator = new QDoubleValidator(field);
    validator->setLocale(QLocale::c());
    field->setValidator(validator);
    field->setPlaceholderText(tr("as in the table"));
    field->setAccessibleName(label);
    if (m_settings.*number)
        field->setText(QString::number(*(m_settings.*number), 'g', 10));
    form->addRow(label, field);
    connect(field, &QLineEdit::editingFinished, this, [this, field, number] {
        bool isNumber = false;
        const double value = field->text().toDouble(&isNumber);
        const std::optional<double> wanted = isNumber ? std::make_optional(value) : std::nullopt;
        if (wanted == m_settings.*number)
            return;
        m_settings.*number = wanted;
        Q_EMIT edited(m_settings);
    });
}

}  // namespace qplc
