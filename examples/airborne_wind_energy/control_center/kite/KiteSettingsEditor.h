// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "KiteSettings.h"

#include <QtWidgets/QFormLayout>
#include <QtWidgets/QWidget>

class QDoubleSpinBox;
class QLineEdit;

namespace awe {

/// The form behind the toothed wheel of a view of a kite. Changes hold at once.
class KiteSettingsEditor : public QWidget
{
    Q_OBJECT
public:
    explicit KiteSettingsEditor(const KiteSettings &settings, QWidget *parent = nullptr);
    ~KiteSettingsEditor() override;

    const KiteSettings &settings() const { return m_settings; }
    QFormLayout *form() { return m_form; }

Q_SIGNALS:
    /// A person has changed something.
    void edited();

private:
    void addSignal(const QString &label, QString KiteSettings::*member);
    void addTrail();
    void addLimit(const QString &label, std::optional<double> KiteSettings::*member);

    KiteSettings m_settings;
    QFormLayout *m_form;
};

}  // namespace awe
