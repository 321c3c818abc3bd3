// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "KiteConfiguration.h"
#include "PlantOptions.h"

#include <QtCore/QString>

namespace awe {

enum class WinchKind {
    Ideal,  ///< does what the autopilot wants, at once: a part of the model
    Drive   ///< hardware behind the node Winch, which tells what it really does
};

/// What of the plant is a model, and what is hardware, and the data of the model.
/// hardware/plant.ini lists all keys; it also holds without a file.
struct PlantConfiguration
{
    WinchKind winch = WinchKind::Ideal;
    QString winchHardware;   // configuration of the node Winch
    QString simulatedWinch;  // CAN bus of the simulated drive; empty: the drive is a real one
    KiteConfiguration kite;
    PlantOptions options;  // sections [wind] and [tether]

    bool hasDrive() const { return winch == WinchKind::Drive; }

    /// The one that is compiled into the programs.
    static QString builtInFile();
    /// Reads the file \a fileName. Relative names in it begin at its folder. A section that it
    /// leaves out is that of the built-in file.
    /// \return false, with file, line, value and remedy in \a error
    static bool read(const QString &fileName, PlantConfiguration *configuration, QString *error);
};

/// "ideal", "drive". \return false when \a word is none of them
bool winchKindFromText(const QString &word, WinchKind *kind);

/// The signal that tells the speed of the tether [m/s]: what is wanted, or what the drive does.
const char *winchSpeedSignal(WinchKind kind);

}  // namespace awe
