// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcCompactSlaveNode.h"
#include "QPlcModelsGlobal.h"
#include "QPlcParseError.h"

#include <memory>

/// A node whose code is an FMU: a model or controller that a simulation tool has exported (FMI 2.0
/// or 3.0, co-simulation). A configuration file says which one, and which of its variables are
/// signals. The usual case needs no code: the program qtplc_fmu runs such a file.
///
/// \code{.ini}
/// [node]
/// name = Model
///
/// [fmu]
/// ; relative to the folder of this file
/// file = model.fmu
/// ; communication step: a divisor of the period of the master, which is the default
/// step = 10 ms
/// ; relative tolerance; default: that of the FMU
/// tolerance = 1e-6
/// ; on: the FMU reports more than warnings and errors, if it can
/// log = off
///
/// ; parameters and start values
/// [fmu.start]
/// mass = 6.2
///
/// ; signal = variable: what the FMU writes
/// [fmu.read]
/// bodyPosition_earth = r
/// power = P * 1e-3
///
/// ; variable = signal: what the FMU reads
/// [fmu.write]
/// u_pitch = bodyControlPitchSpeed * 0.0174533
/// \endcode
///
/// \code
/// QPlcFmuNode node;
/// if (!node.configureFromFile("model.ini"))
///     qWarning("%s", qPrintable(QPlcParseError::toString(node.configurationErrors())));
/// node.connectToMaster(QPlcUnderlyingProtocol::fromString("127.0.0.1:50000"));
/// \endcode
///
/// Without the sections `fmu.read` and `fmu.write` the inputs and outputs of the FMU are signals
/// of the same name; those that the signal table does not have are left out. The name of a variable
/// may stand for an array whose elements are variables: `r` for `r[1]`, `r[2]` and `r[3]`. `r[2]`
/// is the variable of this name, or if there is none, the element 2 of the array `r`, counted from
/// 0. Matrices have their elements row after row.
///
/// The node is a two-phase node: its outputs are those that the FMU has at the beginning of a
/// cycle, and then the FMU takes the inputs and moves on by a period. The FMU counts the cycles
/// that it computes: for cycles that the node missed, its time stands still.
///
/// If the FMU ends the simulation or discards a step, the node asks for a safe stop. If a function
/// of the FMU reports an error, the node goes to State::Fault. A value that is not finite is not
/// taken, as from every node.
///
/// An FMU is a program of somebody else, which has all rights of the process that loads it. Run
/// only FMUs that you trust, each in a process of its own: a crash is then the loss of one node.
///
/// \threadsafe no: as QPlcCompactSlaveNode
///
/// \ingroup models
class QTPLC_MODELS_EXPORT QPlcFmuNode : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    /// Makes a node without an FMU.
    /// \param name  under which the node registers; the configuration may set another one
    /// \param parent  owns the node, if given
    explicit QPlcFmuNode(const QString &name = QString(), QObject *parent = nullptr);
    /// Disconnects from the master, ends the FMU, and removes its unpacked files.
    ~QPlcFmuNode() override;

    /// Reads the configuration, opens the FMU and loads its library. Call it once, before the node
    /// connects.
    /// \param fileName  an INI file, or an FMU (".fmu"), whose variables are then signals of the
    ///     same name; without another name, the node has the name of the model
    /// \return false on any error: see configurationErrors()
    bool configureFromFile(const QString &fileName);
    /// Reads the configuration from an INI text, as above.
    /// \param fileName  for messages, and for relative file names in the text
    bool configure(const QByteArray &text, const QString &fileName);
    /// Returns all errors of the last configuration, in the order in which they were found.
    QVector<QPlcParseError> configurationErrors() const;

    /// Returns the name of the model of the FMU; empty before the configuration.
    QString modelName() const;
    /// Returns the version of FMI that the FMU follows, for example "2.0".
    QString fmiVersion() const;

    /// A wire between a signal and a number of the FMU.
    struct Wire
    {
        /// "position[0]", or the name alone.
        QString signal;
        /// "r[0]", or the name alone; the element counts from 0.
        QString variable;
        /// Whether the FMU reads the signal or writes it.
        QPlcPort::Direction direction = QPlcPort::Input;
        double factor = 1.0;  ///< target = source * factor + offset
        double offset = 0.0;  ///< target = source * factor + offset
    };
    /// Returns all wires. Those that follow from names are known after the registration.
    QVector<Wire> wires() const;

Q_SIGNALS:
    /// Emitted once in a phase, when the FMU has ended the simulation or discarded a step. The node
    /// asks for a safe stop then.
    /// \param reason  what happened, and when
    void modelEnded(const QString &reason);

protected:
    void declarePorts(const QPlcSignalTable &table) override;
    void reset() override;
    void initialized() override;
    void outputs() override;
    void update(const QPlcCycle &cycle) override;
    void stopped() override;

private:
    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> m_fmu;
};
