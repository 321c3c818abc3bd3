// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/SettingsEditor.h"

#include <QtCore/QJsonObject>
#include <QtCore/QStringList>

class QFormLayout;
class QVBoxLayout;

namespace qplc {

/// The settings of a panel of spectra, as the toothed wheel shows them. What is changed is told at
/// once.
class SpectrumEditor : public SettingsEditor
{
    Q_OBJECT
public:
    /// \param settings  those of the panel, with all of its keys
    SpectrumEditor(const QStringList &references, const QJsonObject &settings, QWidget *parent = nullptr);

Q_SIGNALS:
    void signalsChanged(const QStringList &references);
    void settingChanged(const QString &key, const QJsonValue &value);

private:
    struct Choice
    {
        QString text;
        QJsonValue value;
    };
    void addChoice(QFormLayout *form, const QString &label, const QString &key, const QVector<Choice> &choices);
    void addBox(QVBoxLayout *all, const QString &text, const QString &key);
    void addRow(const QString &reference);
    void tellSignals();

    QJsonObject m_settings;
    QVBoxLayout *m_rows;
};

}  // namespace qplc
