// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Kite.h"
#include "View3DSettings.h"
#include "kite/KiteSettingsEditor.h"

#include <QtWidgets/QWidget>

namespace qplc {

/// The form behind the toothed wheel of a 3D view. Changes hold at once.
class View3DEditor : public QWidget
{
    Q_OBJECT
public:
    explicit View3DEditor(const View3DSettings &settings, QWidget *parent = nullptr);
    ~View3DEditor() override;

    const View3DSettings &settings() const { return m_settings; }

Q_SIGNALS:
    /// A person has changed something.
    void edited();

private:
    void addCamera(QFormLayout *form);
    void addModel(QFormLayout *form);
    void addScale(QFormLayout *form);
    QWidget *makeShow();

    View3DSettings m_settings;
    KiteSettingsEditor *m_kite;
};

/// What a camera is called: "Ground station".
QString cameraTitle(OrbitCamera::Preset preset);

}  // namespace qplc
