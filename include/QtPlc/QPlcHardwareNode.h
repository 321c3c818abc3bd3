// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcCompactSlaveNode.h"
#include "QPlcDeviceEvent.h"
#include "QPlcDriver.h"
#include "QPlcParseError.h"

#include <chrono>
#include <functional>
#include <memory>

/// A node whose inputs and outputs are wired to devices: buses, switches, sensors, drives. A
/// configuration file selects them. The usual case needs no code: the program qtplc_hardware runs
/// such a file.
///
/// \code{.ini}
/// [node]
/// name = Winch
/// ; this channel stops the plant while it is not 0, or has no value
/// safeStop = buttons.emergencyStop
///
/// ; a section for each device, under a name of your choice
/// [drive]
/// driver = can
/// device = can0
/// dbc = winch_drive.dbc
/// ; signal = channel: what comes from the device
/// [drive.read]
/// winchSpeed = DriveStatus.Speed * 0.0314 + 0
/// ; channel = signal: what goes to the device
/// [drive.write]
/// DriveCommand.SpeedSetpoint = tetherSpeed * 31.8
/// ; channel = value in the unit of the device; without it the safe value of the signal
/// [drive.safe]
/// DriveCommand.SpeedSetpoint = 0
///
/// [buttons]
/// driver = gpio
/// device = gpiochip0
/// ; normally closed contact to ground: a broken wire reads 1, too
/// input.emergencyStop = 17, pull-up, debounce 5 ms
/// \endcode
///
/// \code
/// QPlcHardwareNode node("Winch");
/// if (!node.configureFromFile("winch.ini"))
///     qFatal("%s", qPrintable(QPlcParseError::toString(node.configurationErrors())));
/// node.connectToMaster(QPlcUnderlyingProtocol::automatic(QHostAddress::LocalHost));
/// \endcode
///
/// A signal may go to several channels. A number in its place is a constant while the node
/// computes, and needs a line in `safe`. An element of an array is `acceleration[0]`. Each driver
/// also has the read channels `@online` (1 while the device is open), `@age` (age of the oldest
/// wired value [s]) and `@failures` (how often the device was lost). A JSON configuration has the
/// same contents: an object of sections, in which `read`, `write` and `safe` are objects of texts.
///
/// In each cycle the node writes its inputs to the devices and takes its outputs from them. An
/// output without a fresh value has the quality Invalid (QPlcQuality). The node opens a missing or
/// lost device again and again, and reports it; other devices and nodes go on. In the safe state of
/// the node all devices get their safe values at once, and again and again until the next phase.
/// The watchdog brings the node into its safe state when the master is silent for DefaultWatchdog.
///
/// \threadsafe no: use it in the thread of the object
///
/// \ingroup hardware
class QTPLC_HARDWARE_EXPORT QPlcHardwareNode : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    /// Watchdog time of a hardware node: 500 ms or four periods of the master, whichever is longer.
    /// activateWatchdog() or --watchdog sets another one, or none (0).
    static constexpr std::chrono::milliseconds DefaultWatchdog{500};

    /// Makes a node without devices. It sends the quality of its outputs, and its watchdog leads to
    /// the safe state.
    /// \param name  under which the node registers; the configuration may set another one
    /// \param parent  owns the node, if given
    explicit QPlcHardwareNode(const QString &name = QString(), QObject *parent = nullptr);
    /// Disconnects from the master, writes the safe values to all devices, and closes them.
    ~QPlcHardwareNode() override;

    /// Reads the configuration, of at most 1 MiB: JSON if the name ends with ".json", else INI.
    /// Call it once, before the node connects.
    /// \return false on any error: see configurationErrors(); nothing is wired then
    bool configureFromFile(const QString &fileName);
    /// Reads the configuration from a text, as above.
    /// \param fileName  for messages, for the format, and for relative file names in the text
    bool configure(const QByteArray &text, const QString &fileName);
    /// Returns all errors of the last configuration, in the order in which they were found.
    QVector<QPlcParseError> configurationErrors() const;

    /// Returns what is doubtful in the last configuration, and no error: for example a `safeStop`
    /// that reads "not pressed" when its wire is torn.
    QVector<QPlcParseError> configurationWarnings() const;

    /// Makes a driver of your own available to configurations (`driver = KIND`). A kind with this
    /// name is replaced. Call it before the first node is configured.
    /// \param kind  name in the configuration
    /// \param description  one line, for lists
    /// \param make  makes a driver; the node owns it
    static void addDriverKind(const QString &kind, const QString &description,
                              std::function<std::unique_ptr<QPlcDriver>()> make);
    /// Returns the names and descriptions of all kinds of drivers, sorted by name.
    static QVector<QPair<QString, QString>> driverKinds();

    /// What the node knows about one of its devices.
    struct DriverState
    {
        QString name;           ///< name of its section
        QString kind;           ///< kind of its driver
        bool isOnline = false;  ///< the device is open
        quint64 failures = 0;   ///< how often the device was lost
        /// Why it is not online; empty: it is being opened, or it is online.
        QString error;
    };
    /// Returns the state of all devices, in the order of the configuration.
    QVector<DriverState> drivers() const;

    /// A wire between a channel and a signal, with its newest value: for commissioning without a
    /// master.
    struct Wire
    {
        /// Name of the section of the device.
        QString driver;
        QString channel;  ///< name of the channel
        /// Whether the value comes from the device.
        QPlcChannel::Direction direction = QPlcChannel::Read;
        /// "acceleration[0]"; of a constant its value.
        QString signal;
        /// There is a value, and it is not too old.
        bool isFresh = false;
        /// Value of the channel, in the unit of the device.
        double value = 0.0;
        /// Age of a read value [s]; infinite: it was never read.
        double age = 0.0;
    };
    /// Returns all wires with their newest values.
    QVector<Wire> wires() const;
    /// Takes new values from the devices that are open.
    /// \pre no real-time phase runs: there the cycles do it
    void readDevices();

    /// Opens all devices with outputs, and waits until they have the safe values of the
    /// configuration: after a crash of the node, without a master. They keep getting these values
    /// until closeDevices().
    /// \param timeout  how long to wait for devices that do not answer
    /// \return a sentence for each device that was not reached or has not taken its values
    ///     (QPlcDriver::setDelivered()), and for each output without a safe value in the
    ///     configuration; empty: all are safe
    QStringList makeSafe(std::chrono::milliseconds timeout);

public Q_SLOTS:
    /// Begins to open the devices: deviceOpened() or deviceFailed() follows for each. The first
    /// initialization calls it, too.
    void openDevices();
    /// Writes the safe values to all devices and closes them. While cycles run it only warns.
    void closeDevices();

Q_SIGNALS:
    /// Emitted when a device was opened, for the first time or again.
    /// \param driver  name of the section
    void deviceOpened(const QString &driver);
    /// Emitted when a device could not be opened or was lost, if the text differs from the last
    /// one. The node keeps trying.
    /// \param driver  name of the section
    /// \param text  what is wrong, and what to do
    void deviceFailed(const QString &driver, const QString &text);
    /// Emitted when a device has told that something has happened: the emergency of a drive, and
    /// its end. The event log of the master has it, too, as it has the loss and the return of
    /// devices.
    void deviceEvent(const QPlcDeviceEvent &event);

protected:
    void reset() override;
    void step(const QPlcCycle &cycle) override;
    void safeState(SafeStateReason reason) override;

private:
    Q_DECL_HIDDEN void deviceChanged(const QString &driver, const QString &error);
    Q_DECL_HIDDEN void tellEvent(const QPlcDeviceEvent &event);

    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> m_hardware;
};
