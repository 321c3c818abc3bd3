// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FlightView.h"

#include <QtCore/QTimer>
#include <QtPlcCore>

namespace awe {

/// Shows a flight of a master on the terminal behind the standard error: one line, or a picture.
/// In the background of a shell there is no line, until the program comes to the foreground. Where
/// there is no terminal it shows nothing, unless a script asks for it by QTPLC_PROGRESS=lines in
/// the environment: then a line "progress: 210 of 1800" each second.
class FlightDisplay : public QObject
{
    Q_OBJECT
public:
    enum Kind {
        Line,    ///< progressLine(), rewritten in place
        Picture  ///< FlightView on the whole screen, which is given back as it was
    };

    /// Whether the standard error is a terminal that can be drawn on: not with TERM=dumb.
    static bool hasTerminal();

    /// \param master  outlives this object \param duration  planned [s], 0: open end
    FlightDisplay(QPlcMasterNode &master, double duration, Kind kind);
    ~FlightDisplay() override;

    /// \return false when the master refused the display; it has said why
    bool isValid() const { return m_valid; }
    /// The flight has begun.
    void begin();
    /// The flight has ended: the terminal is as before.
    void end();

private:
    bool joinMaster();
    FlightMoment momentOf(const QPlcSignalList &values, double time) const;
    void drawLine();
    void logLine();
    void drawPicture();

    QPlcMasterNode &m_master;
    double m_duration;  // [s]
    Kind m_kind;
    FlightView m_view;
    QPlcIOBufferSlaveNode m_listener;  // every cycle, for the trail
    QTimer m_timer;
    bool m_valid = true;
};

}  // namespace awe
