// SPDX-License-Identifier: Apache-2.0
#include "KiteSettingsEditor.h"

#include <QtWidgets/QDoubleSpinBox>
#include <QtWidgets/QLineEdit>

namespace awe {

KiteSettingsEditor::KiteSettingsEditor(const KiteSettings &settings, QWidget *parent)
    : QWidget(parent)
    , m_settings(settings)
    , m_form(new QFormLayout(this))
{
    addTrail();
    addSignal(tr("Coloured by"), &KiteSettings::color);
    addLimit(tr("Colours from"), &KiteSettings::minimum);
    addLimit(tr("Colours to"), &KiteSettings::maximum);
    addSignal(tr("Position"), &KiteSettings::position);
    addSignal(tr("Velocity"), &KiteSettings::velocity);
    addSignal(tr("Wind"), &KiteSettings::wind);
    addSignal(tr("Pitch and yaw"), &KiteSettings::controlOrientation);
    addSignal(tr("Elevation and azimuth"), &KiteSettings::positionOrientation);
    addSignal(tr("Aerodynamic force"), &KiteSettings::force);
    addSignal(tr("Tether length"), &KiteSettings::tetherLength);
    addSignal(tr("Nodes of the tether"), &KiteSettings::tetherNode);
    addSignal(tr("Top of the mast"), &KiteSettings::mastTop);
}

KiteSettingsEditor::~KiteSettingsEditor()
{
    // A line that has the focus loses it only when the settings are no more: it must not write them
    // then.
    for (QLineEdit *line : findChildren<QLineEdit *>())
        line->disconnect(this);
}

void KiteSettingsEditor::addSignal(const QString &label, QString KiteSettings::*member)
{
    auto *edit = new QLineEdit(m_settings.*member);
    edit->setMinimumWidth(190);
    edit->setPlaceholderText(tr("no signal"));
    edit->setAccessibleName(label);
    m_form->addRow(label, edit);
    connect(edit, &QLineEdit::editingFinished, this, [this, edit, member] {
        const QString text = edit->text().trimmed();
        if (m_settings.*member == text)
            return;
        m_settings.*member = text;
        Q_EMIT edited();
    });
}

void KiteSettingsEditor::addTrail()
{
    auto *seconds = new QDoubleSpinBox;
    seconds->setDecimals(0);
    seconds->setRange(0.0, KiteSettings::longestTrail);
    seconds->setSingleStep(10.0);
    seconds->setSuffix(tr(" s"));
    seconds->setSpecialValueText(tr("none"));
    seconds->setKeyboardTracking(false);
    seconds->setValue(m_settings.trail);
    seconds->setAccessibleName(tr("Flight path"));
    m_form->addRow(tr("Flight path"), seconds);
    connect(seconds, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, [this](double value) {
        m_settings.trail = value;
        Q_EMIT edited();
    });
}

void KiteSettingsEditor::addLimit(const QString &label, std::optional<double> KiteSettings::*member)
{
    auto *edit = new QLineEdit(m_settings.*member ? QString::number(*(m_settings.*member)) : QString());
    edit->setPlaceholderText(tr("as what is seen"));
    edit->setAccessibleName(label);
    m_form->addRow(label, edit);
    connect(edit, &QLineEdit::editingFinished, this, [this, edit, member] {
        bool isNumber = false;
        const double value = edit->text().toDouble(&isNumber);
        const std::optional<double> limit = isNumber ? std::optional<double>(value) : std::nullopt;
        edit->setText(limit ? QString::number(*limit) : QString());
        if (m_settings.*member == limit)
            return;
        m_settings.*member = limit;
        Q_EMIT edited();
    });
}

}  // namespace awe
