// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/SignalsMimeType.h"
#include "gui/plant/PlantList.h"

#include <QtCore/QMimeData>
#include <QtCore/QVariant>

#include <memory>

namespace qplc {

std::unique_ptr<QMimeData> mimeDataOf(const QVector<SignalReference> &references);
/// Empty when there are none; what is no reference is left out.
QVector<SignalReference> referencesIn(const QMimeData *mimeData);

/// A value as tables show it: 7 digits for Real32, 10 for Real64, elements in brackets, times as
/// local time of the day; empty before the first.
QString valueText(const QPlcValue &value);
/// The same with the names of values where \a definition has some: "ReelIn", "[Off, ReelIn]".
QString valueText(const QPlcValue &value, const QPlcSignalDefinition &definition);
/// The same in as little space as a tree has: numbers of at most nine characters, 6 digits or as
/// many as fit, elements of 3, times to a tenth of a second; whole digits are never left out.
QString shortValueText(const QPlcValue &value);
QString shortValueText(const QPlcValue &value, const QPlcSignalDefinition &definition);
/// A number with so many significant digits, "–" when it is not there.
QString numberText(double value, int digits = 7);
/// The name of a value, or its number.
QString numberText(double value, int digits, const QPlcValueNames &names);
/// "12 ms", "3.4 s", "5 min"; empty when negative.
QString ageText(double seconds);
/// "12.3 µs", "4.56 ms": three digits.
QString durationText(double nanoseconds);
/// "good", "at rest", "stale", "no value".
QString qualityText(Plant::Quality quality);
/// What stands in the way of trust in the newest value of a signal: the plant, or else its own
/// quality.
QString qualityText(const PlantList::Signal &signal);
/// Whether the newest value of a signal is of now, or of the plant at rest, and usable.
bool isTrusted(const PlantList::Signal &signal);
/// The state of a plant in a word or two: that of its master, see stateText(), or "lost",
/// "connecting", "not there"; Plant::stateText() says why.
QString stateWord(const Plant &plant);
/// What Qt::ForegroundRole gives: grey for what is not to be trusted, else nothing.
QVariant foregroundOf(bool isTrusted);

}  // namespace qplc
