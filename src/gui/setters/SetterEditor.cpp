// SPDX-License-Identifier: Apache-2.0
#include "SetterEditor.h"
#include "gui/panel/SignalEdit.h"

#include "SetterView.h"

#include <QtWidgets/QComboBox>
#include <QtWidgets/QFormLayout>
#include <QtWidgets/QLineEdit>

namespace qplc {

SetterEditor::SetterEditor(const SetterSettings &settings, QPlcPanelContext *context, QWidget *parent)
    : SettingsEditor(parent)
    , m_settings(settings)
{
    auto *form = new QFormLayout(this);
    auto *signal = new SignalEdit(context, SignalEdit::AllSignals, this);
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
    addLimit(form, tr("Minimum"), &SetterSettings::minimum);
    addLimit(form, tr("Maximum"), &SetterSettings::maximum);
    addLimit(form, tr("Toggle: on"), &SetterSettings::on);
    addLimit(form, tr("Momentary: held"), &SetterSettings::pressed);
}

void SetterEditor::addLimit(QFormLayout *form, const QString &label, std::optional<double> SetterSettings::*number)
{
    addNumber(form, label, m_settings.*number, tr("as in the table"), [this, number](std::optional<double> wanted) {
        if (wanted == m_settings.*number)
            return;
        m_settings.*number = wanted;
        Q_EMIT edited(m_settings);
    });
}

}  // namespace qplc
