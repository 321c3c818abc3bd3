// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SetterSettings.h"

#include <QtWidgets/QWidget>

class QFormLayout;

namespace qplc {

class PlantList;

/// The settings of a setter; each change applies at once.
class SetterEditor : public QWidget
{
    Q_OBJECT
public:
    SetterEditor(const SetterSettings &settings, const PlantList *plants, QWidget *parent = nullptr);
    ~SetterEditor() override;

Q_SIGNALS:
    void edited(const qplc::SetterSettings &settings);

private:
    void addNumber(QFormLayout *form, const QString &label, std::optional<double> SetterSettings::*number);

    SetterSettings m_settings;
};

}  // namespace qplc
