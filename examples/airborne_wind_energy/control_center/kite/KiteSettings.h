// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QJsonObject>
#include <QtCore/QString>

#include <optional>

namespace awe {

/// Which signals are a kite, and how its path is drawn. A value type; the defaults are those of the
/// example's signal table.
struct KiteSettings
{
    QString position = QStringLiteral("bodyPosition_earth");                  // [m], three elements
    QString velocity = QStringLiteral("bodyVelocity_earth");                  // [m/s]
    QString wind = QStringLiteral("windVelocity_earth");                      // [m/s]
    QString controlOrientation = QStringLiteral("bodyControlOrientation");    // roll, pitch, yaw [deg]
    QString positionOrientation = QStringLiteral("bodyPositionOrientation");  // 0, 90 - elevation, azimuth [deg]
    QString force = QStringLiteral("aerodynamicForce_earth");                 // [N]
    QString tetherLength = QStringLiteral("tetherLength");                    // [m]
    QString tetherNode = QStringLiteral("tetherNode%1_earth");                // [m], %1: 1 ...; missing: no segments
    QString mastTop = QStringLiteral("mastTop_earth");                        // [m]; missing: no mast
    QString color = QStringLiteral("power");                                  // colours the path; empty: nothing does
    double trail = 30.0;                                                      // [s] of path, 0 ... 600
    std::optional<double> minimum;                                            // of the colours; none: as what is seen
    std::optional<double> maximum;

    /// What is missing, or of another kind, has its default. \param rest takes what was no key of
    /// this
    static KiteSettings fromJson(const QJsonObject &json, QJsonObject *rest);
    /// All that differs from the defaults.
    QJsonObject toJson() const;

    static constexpr double longestTrail = 600.0;  // [s]
};

}  // namespace awe
