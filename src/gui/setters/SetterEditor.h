// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SetterSettings.h"
#include "gui/panel/SettingsEditor.h"

class QFormLayout;

class QPlcPanelContext;

namespace qplc {

/// The settings of a setter; each change applies at once.
class SetterEditor : public SettingsEditor
{
    Q_OBJECT
public:
    SetterEditor(const SetterSettings &settings, QPlcPanelContext *context, QWidget *parent = nullptr);

Q_SIGNALS:
    void edited(const qplc::SetterSettings &settings);

private:
    void addLimit(QFormLayout *form, const QString &label, std::optional<double> SetterSettings::*number);

    SetterSettings m_settings;
};

}  // namespace qplc
