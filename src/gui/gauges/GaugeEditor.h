// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "GaugeSettings.h"
#include "QPlcSignalDefinition.h"
#include "gui/panel/SettingsEditor.h"

class QFormLayout;
class QLineEdit;

class QPlcPanelContext;

namespace qplc {

/// The settings of a gauge as a form; every change counts at once.
class GaugeEditor : public SettingsEditor
{
    Q_OBJECT
public:
    /// \param definition  of the present signal, for what an empty field means
    GaugeEditor(const PanelSettings &settings, const QString &title, const QPlcSignalDefinition &definition,
                QPlcPanelContext *context, QWidget *parent = nullptr);

Q_SIGNALS:
    void edited(const qplc::PanelSettings &settings);
    void titleEdited(const QString &title);

private:
    void addSignal(QFormLayout *form, QPlcPanelContext *context);
    void addStyles(QFormLayout *form);
    void addNumbers(QFormLayout *form, const QPlcSignalDefinition &definition);
    void addLimit(QFormLayout *form, const QString &label, const char *key, const QString &whenEmpty);
    void set(const char *key, const QJsonValue &value, const QJsonValue &defaultValue = QJsonValue());

    PanelSettings m_settings;
};

}  // namespace qplc
