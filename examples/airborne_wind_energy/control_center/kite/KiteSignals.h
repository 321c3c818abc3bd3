// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ColorScale.h"
#include "FlightTrail.h"
#include "KiteGeometry.h"
#include "KiteSettings.h"
#include <QPlcPanelContext.h>

#include <vector>

namespace awe {

/// A kite at one time, as far as it is known: a value that stands in for that of a lost writer is
/// none.
struct KiteState
{
    std::optional<QVector3D> position;               // [m], earth
    std::optional<QVector3D> velocity;               // [m/s], earth
    std::optional<QVector3D> wind;                   // [m/s], earth
    std::optional<QVector3D> force;                  // [N], earth
    std::optional<QQuaternion> body;                 // body to earth
    std::optional<QQuaternion> course;               // the same without pitch
    std::optional<double> tetherLength;              // [m]
    std::vector<QVector3D> tetherNodes;              // [m], earth, from the ground; empty: not known
    std::optional<QVector3D> mastTop;                // [m], earth
    std::optional<double> value;                     // of the signal that colours
    std::optional<QPlcPanelContext::Time> pastTime;  // these are the values of that time; none: now
    bool isStale = false;                            // the plant is lost, or its cycles stay away
    double age = -1.0;                               // [s]

    /// Wind as the kite feels it [m/s].
    std::optional<QVector3D> relativeWind() const;
    /// Azimuth to which the wind blows [deg]; 0 without wind.
    float downwind() const { return wind ? downwindAzimuth(*wind) : 0.0f; }
};

/// Finds the signals of a kite in the plants of a window, and tells when there is something new to
/// draw.
///
/// Threads: that of the window.
class KiteSignals : public QObject
{
    Q_OBJECT
public:
    using QObject::QObject;

    /// \param context  of the panel that shows the kite, which outlives this object
    void setContext(QPlcPanelContext *context);
    void setSettings(const KiteSettings &settings);
    const KiteSettings &settings() const { return m_settings; }

    /// Why there is nothing to show, for people; empty: there is.
    QString problem() const;
    /// Now, or at the time that the window shows.
    KiteState state() const;
    /// Another signal with three elements at the same time; nothing if the signal or its value is
    /// missing.
    std::optional<QVector3D> vectorOf(const QString &reference) const;
    /// The path up to the time that the window shows. \return false if there is no path; \a trail
    /// is empty then
    bool readTrail(FlightTrail *trail) const;
    /// The scale of the settings; what they leave open is taken from the path.
    ColorScale colorScale(const FlightTrail &trail) const;
    /// "power [W]"; empty without a signal that colours.
    QString colorTitle() const;

Q_SIGNALS:
    /// Values, times or signals: draw again.
    void changed();

private:
    std::vector<QVector3D> tetherNodes() const;
    QPlcPanelContext::Signal find(const QString &reference) const;
    std::optional<double> number(const QString &reference) const;

    QPlcPanelContext *m_context = nullptr;
    KiteSettings m_settings;
};

}  // namespace awe
