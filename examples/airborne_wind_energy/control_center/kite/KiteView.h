// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "KiteSignals.h"
#include <QPlcView3D.h>

namespace awe {

/// A kite in space: its model and tether, the small earth on which it flies, axes of earth, wind
/// and body, the path of the last seconds coloured by a signal, the relative wind in blue and the
/// aerodynamic force in red.
///
/// The camera `chase` follows the course of the kite. Without OpenGL the wind window is shown.
///
/// Settings are those of QPlcView3D and of the wind window, and `smallEarth`, `vectors` and
/// `tether`, which are true by default. There is no `orientation`.
///
/// Threads: the thread of the window.
class KiteView : public QPlcView3D
{
    Q_OBJECT
public:
    explicit KiteView(QWidget *parent = nullptr);

    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QStringList shownSignals() const override;
    /// The path takes its colours from the first one.
    bool addSignals(const QStringList &references) override;

protected:
    void contextChanged() override;
    void prepareScene(QPlcScene3D *scene) override;
    void drawScene(QPlcScene3D *scene) override;
    void paintOver(QPainter *painter, const QRectF &area, const QPlcScene3D &scene) override;
    QString problem() const override;
    QWidget *createFallback() override;
    QWidget *createBodyEditor() override;

private:
    void take(const KiteSettings &settings);

    KiteSignals m_kite;
    KiteState m_state;  // of the next picture
    FlightTrail m_trail;
    ColorScale m_scale;
    float m_forceUnit = 500;  // [N] that is a vector of length 1
};

}  // namespace awe
