// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "KiteSignals.h"
#include <QPlcWidget.h>

namespace awe {

/// The sky downwind of a ground station, with the kite, its course, and the path of the last
/// seconds coloured by a signal.
///
/// What a person at the ground station sees who looks downwind: the ground below, the downwind
/// direction in the middle of the horizon, larger azimuths to the left. The distance from there is
/// the angle to the wind, so that the half circle is the edge of the wind window (90 deg). Angles
/// stand in degrees at the grid, azimuths from the downwind direction. A circle with a cross is the
/// wind that blows away from the eye. Needs no graphics driver, and is readable from 240 x 160
/// pixels on.
///
/// Settings; what is missing has its default, which is a signal of
/// `signals/airborne_wind_energy.ini`:
/// ```json
/// {"position": "bodyPosition_earth", "velocity": "bodyVelocity_earth",
///  "wind": "windVelocity_earth", "controlOrientation": "bodyControlOrientation",
///  "positionOrientation": "bodyPositionOrientation", "force": "aerodynamicForce_earth",
///  "tetherLength": "tetherLength", "color": "power", "minimum": 0, "maximum": 4000, "trail": 30}
/// ```
/// Positions are in metres, x, y, z with z upwards and the ground station in the origin. `color` is
/// the signal that colours the path, `minimum` and `maximum` its range (as what is seen, when
/// missing), `trail` the length of the path in seconds (0 ... 600). Without an orientation the nose
/// looks to the zenith.
///
/// Threads: the thread of the window.
class WindWindow : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("Wind window"); }

    explicit WindWindow(QWidget *parent = nullptr);

    QString kind() const override { return typeName(); }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    /// The path takes its colours from the first one.
    bool addSignals(const QStringList &references) override;

    QSize minimumSizeHint() const override;
    QSize sizeHint() const override;

protected:
    void contextChanged() override;
    void paintEvent(QPaintEvent *event) override;

private:
    KiteSignals m_kite;
};

}  // namespace awe
