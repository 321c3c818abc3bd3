// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "KiteSignals.h"

class QPlcScene3D;

namespace awe {

// What a 3D view draws of a kite. Without a position, or what else is missing, nothing is drawn.

/// Sizes of vectors: a relative wind of 30 m/s is 1 long, and a force of \a reference.
float windVectorLength(float speed);
float forceVectorLength(float force, float reference);
/// The largest force seen so far, in round steps: the force that is 1 long [N].
float forceReference(float force, float before);

void drawTrail(QPlcScene3D *scene, const FlightTrail &trail, const ColorScale &scale, float width);
/// Arrows from the ground station downwind and across, with the speed of the wind.
void drawWindAxes(QPlcScene3D *scene, const KiteState &kite);
/// A pole from the ground to the top of the mast, with its name.
void drawMast(QPlcScene3D *scene, const KiteState &kite);
/// Meridians and parallels of the quarter sphere downwind.
void drawSmallEarth(QPlcScene3D *scene);
/// Straight between the nodes of the tether if they are known, else as a curve that is as long as
/// the tether. \param bridle  where the tether ends, in the axes of the body [m]
void drawTether(QPlcScene3D *scene, const KiteState &kite, const QVector3D &bridle);
/// The relative wind and the aerodynamic force, with their sizes.
void drawVectors(QPlcScene3D *scene, const KiteState &kite, float forceUnit);

}  // namespace awe
