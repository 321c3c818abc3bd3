// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "KiteConfiguration.h"
#include "MastGains.h"
#include "PlantOptions.h"

#include <QtCore/QString>

namespace awe {

enum class WinchKind {
    Ideal,    ///< does what the autopilot wants, at once: a part of the model
    Machine,  ///< an electrical machine that has to follow what the autopilot wants: a part of the model
    Drive,    ///< hardware behind the node Winch, which tells what it really does
    CanOpen   ///< likewise, a servo drive on a CANopen bus
};

/// Whether the winch is hardware, and tells what it does.
constexpr bool isDrive(WinchKind kind)
{
    return kind == WinchKind::Drive || kind == WinchKind::CanOpen;
}

/// What the autopilot does with turbines on board: section [turbines].
struct TurbineSettings
{
    double coefficient = 0.1106;  // c_dt on the eight: half of c_d at the best angle of attack [-]
    double tetherLength = 150.0;  // [m]
};

/// Words of the command line that are stronger than those of a plant file; empty: none.
struct PlantWords
{
    QString winch;  // kind of [winch]
    QString mode;   // mode of [kite]
};

/// What of the plant is a model, and what is hardware, and the data of the model.
/// hardware/plant.ini lists all keys; it also holds without a file.
struct PlantConfiguration
{
    WinchKind winch = WinchKind::Ideal;
    QString winchHardware;    // configuration of the node Winch for WinchKind::Drive
    QString canOpenHardware;  // likewise, for WinchKind::CanOpen
    QString simulatedWinch;   // CAN bus of the simulated drive; empty: the drive is a real one
    KiteConfiguration kite;
    PlantOptions options;  // sections [wind], [tether], [steering], [mast], and what winch and mode ask for
    TurbineSettings turbines;
    MastGains mastGains;  // section [mast]: the wind in which the kite flies

    PlantConfiguration() { options.mast.azimuth = KiteConfiguration::derived; }

    bool hasDrive() const { return isDrive(winch); }
    /// The configuration of the node Winch for the kind of the winch.
    QString hardware() const { return winch == WinchKind::CanOpen ? canOpenHardware : winchHardware; }

    /// The options, with the mast downwind unless the file says where it stands. \param wind
    /// decides where downwind is
    PlantOptions optionsIn(const WindParameters &wind) const;
    /// What the autopilot knows of mast and wing; without a mast isPresent is false.
    MastGains gainsOfMast() const;

    /// The one that is compiled into the programs.
    static QString builtInFile();
    /// Plants that have a name instead of a file, in alphabetical order: files of plants/ that are
    /// compiled into the programs.
    static QStringList names();
    /// What the plant \a name is, in a sentence: the first one of its file.
    static QString description(const QString &name);
    /// Reads the file \a plant, or the plant of that name. Relative names in it begin at its
    /// folder. A section that it leaves out is that of the built-in file.
    /// \return false, with file, line, value and remedy in \a error; also if what the file and \a
    ///         words say excludes each other
    static bool read(const QString &plant, PlantConfiguration *configuration, QString *error,
                     const PlantWords &words = PlantWords());
};

/// The signal that tells the speed of the tether [m/s]: what is wanted, or what the drive does.
const char *winchSpeedSignal(WinchKind kind);

}  // namespace awe
