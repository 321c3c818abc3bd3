// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantList.h"

namespace qplc {

/// What a signal, or its element, was at a time, out of the store of its plant: rounded to 32-bit
/// reals, in the type of the signal. Invalid when nothing is known: before the first row, in an
/// interruption, for texts and times.
QPlcValue pastValue(const PlantList::Signal &signal, SignalStore::Time time);
/// The same for one channel of a store, as a real number.
QPlcValue pastValue(const SignalStore &store, int channel, SignalStore::Time time);

}  // namespace qplc
