// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcCompactSlaveNode.h"
#include "QPlcDriver.h"
#include "QPlcParseError.h"

#include <chrono>
#include <functional>
#include <memory>

/// A node whose inputs and outputs are wired to devices: buses, switches, sensors, drives. Which of them, is said by a file; no code is needed for the usual case, and the program
/// qtplc_hardware runs it:
///
/// ```ini
/// [node]
/// name = Winch
/// safeStop = buttons.emergencyStop      ; this channel stops the plant while it is not 0, or has no value
///
/// [drive]                               ; a section for each device, under a name of your choice
/// driver = can
/// device = can0
/// dbc = winch_drive.dbc
/// [drive.read]                          ; signal = channel, what comes from the device
/// winchSpeed = DriveStatus.Speed * 0.0314 + 0
/// [drive.write]                         ; channel = signal, what goes to it
/// DriveCommand.SpeedSetpoint = tetherSpeed * 31.8
/// [drive.safe]                          ; channel = value, in the unit of the device; else it is the safe value of the signal
/// DriveCommand.SpeedSetpoint = 0
///
/// [buttons]
/// driver = gpio
/// device = gpiochip0
/// input.emergencyStop = 17, pull-up, debounce 5 ms   ; normally closed contact to ground: a torn wire is 1, too
/// ```
///
/// A signal may go to several channels; a number in its place is a constant while the node computes, and needs a line in `safe`. An element of an array is `acceleration[0]`. Each driver also has the read channels `@online` (1 while the device is open), `@age` [s] (of the oldest value that is wired) and
/// `@failures` (how often the device was lost). The same as JSON: an object of sections, whose `read`, `write` and `safe` are objects of texts.
///
/// In each cycle the node gives its inputs to the devices, and takes its outputs from them. An output without a fresh value is told to have none (QPlcQuality). A device that
/// is missing or lost is opened again and again, and says so; the other devices and nodes go on. In the safe state of the node all devices get their safe values, at once, and again and again until
/// the next phase. So they do when no frame of the master has come for DefaultWatchdog.
/// Threads: that of the object.
class QTPLC_HARDWARE_EXPORT QPlcHardwareNode : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    /// The watchdog of a hardware node, unless activateWatchdog() or --watchdog says another one, or 0 for none: what moves something does not go on when its link is cut.
    /// At a master whose four periods are longer, it is these.
    static constexpr std::chrono::milliseconds DefaultWatchdog{500};

    explicit QPlcHardwareNode(const QString &name = QString(), QObject *parent = nullptr);
    ~QPlcHardwareNode() override;

    /// Reads the configuration; a name that ends with ".json" is JSON, else INI. Once in the life of a node, before it connects.
    /// \return false, with all that is wrong in configurationErrors(), and nothing is wired
    bool configureFromFile(const QString &fileName);
    /// As above. \param fileName  for messages and relative names of files
    bool configure(const QByteArray &text, const QString &fileName);
    QVector<QPlcParseError> configurationErrors() const;

    /// Lets configurations use a driver of your own: `driver = KIND`. Before the first node is configured; a kind that exists is replaced.
    /// \param description  a line for lists
    static void addDriverKind(const QString &kind, const QString &description,
                              std::function<std::unique_ptr<QPlcDriver>()> make);
    /// Kinds and their descriptions, sorted.
    static QVector<QPair<QString, QString>> driverKinds();

    struct DriverState
    {
        QString name;  ///< of the section
        QString kind;
        bool isOnline = false;
        quint64 failures = 0;  ///< how often the device was lost
        QString error;         ///< why it is not online; empty: it is being opened, or it is online
    };
    QVector<DriverState> drivers() const;

    /// A wire between a channel and a signal, with the newest value: for commissioning without a master.
    struct Wire
    {
        QString driver;
        QString channel;
        QPlcChannel::Direction direction = QPlcChannel::Read;
        QString signal;  ///< "acceleration[0]"
        bool isFresh = false;
        double value = 0.0;  ///< of the channel
        double age = 0.0;    ///< [s]
    };
    QVector<Wire> wires() const;
    /// Takes new values from devices that are open. \pre no real-time phase runs, where the cycles do that
    void readDevices();

public Q_SLOTS:
    /// Begins to open the devices. Called at the first initialization at the latest.
    void openDevices();
    /// Gives all devices their safe values and lets them go. \pre no real-time phase runs: nothing but a warning happens then
    void closeDevices();

Q_SIGNALS:
    /// A device was opened, for the first time or again.
    void deviceOpened(const QString &driver);
    /// A device could not be opened, or was lost; the node goes on trying. Told when the text is another one than before.
    void deviceFailed(const QString &driver, const QString &text);

protected:
    void reset() override;
    void step(const QPlcCycle &cycle) override;
    void safeState(SafeStateReason reason) override;

private:
    void deviceChanged(const QString &driver, const QString &error);

    struct Private;
    std::unique_ptr<Private> m_hardware;
};
