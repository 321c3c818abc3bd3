// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "View3DSettings.h"

#include <QtWidgets/QWidget>

class QFormLayout;

namespace qplc {

/// The form behind the toothed wheel of a 3D view. Changes hold at once.
class View3DEditor : public QWidget
{
    Q_OBJECT
public:
    /// \param body what stands in place of the lines for position and orientation, or null; belongs
    ///         to this
    View3DEditor(const View3DSettings &settings, const QVector<View3DPart> &parts, QWidget *body);
    ~View3DEditor() override;

    const View3DSettings &settings() const { return m_settings; }

Q_SIGNALS:
    /// A person has changed something.
    void edited();

private:
    void addCamera(QFormLayout *form);
    void addModel(QFormLayout *form);
    void addScale(QFormLayout *form);
    QWidget *makeShow(const QVector<View3DPart> &parts);
    void addSignal(QFormLayout *form, const QString &label, QString View3DSettings::*member);

    View3DSettings m_settings;
};

/// What a camera is called: "Ground station".
QString cameraTitle(OrbitCamera::Preset preset);

}  // namespace qplc
