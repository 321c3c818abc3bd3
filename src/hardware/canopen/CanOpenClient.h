// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanOpenConfiguration.h"
#include "CanOpenEmergency.h"
#include "CanOpenIds.h"
#include "SdoTransfer.h"
#include "hardware/can/CanBus.h"

#include <functional>

namespace qplc {

/// The master's side of one device on a CAN bus, which waits for its answers: before the cycles,
/// never in them. It lives for one opening of the device: MostTime after it was made, every
/// transfer fails.
class CanOpenClient
{
public:
    /// Gets the frames that are no answers to an SDO of this client.
    using Listener = std::function<void(const CanFrame &)>;

    /// \param bus  open, outlives this
    /// \param device  of the bus, for messages
    /// \param node  0: no device; for send() and waitUntil() alone
    CanOpenClient(CanBus &bus, const QString &device, int node, std::chrono::nanoseconds answerTime);

    void setListener(Listener listener) { m_listener = std::move(listener); }
    /// Lets waiting end early. \param isEnding  is asked several times a second
    void setEnd(std::function<bool()> isEnding) { m_isEnding = std::move(isEnding); }

    /// Reads an object. \return false, with the reason in errorString()
    bool read(ObjectAddress address, QByteArray *value);
    bool readNumber(ObjectAddress address, quint32 *value);
    /// Asks the device for its errors (objects 1001h and 1003h). What it does not have is no error.
    CanOpenEmergency readError();
    /// Writes an object. \param value  as it travels, least significant byte first
    bool write(ObjectAddress address, const QByteArray &value);
    /// Sends a command of network management to the device.
    bool command(NmtCommand command);
    /// Gives a frame to the bus, and waits while it takes none.
    bool send(const CanFrame &frame);
    /// Takes frames until \a isDone says so. \return false when the time is over
    bool waitUntil(const std::function<bool()> &isDone, std::chrono::nanoseconds time);

    /// Checks the identity, writes settings, heartbeats and PDOs. The device has to be
    /// Pre-operational.
    bool configure(const CanOpenConfiguration &plan);

    QString errorString() const { return m_error; }
    /// The abort code of the last transfer; 0: it was not aborted.
    quint32 abortCode() const { return m_abortCode; }

private:
    void stopDrive();
    bool checkIdentity(const CanOpenIdentity &identity);
    bool checkNumber(const char *what, quint8 sub, quint32 wanted);
    bool configurePdo(const Pdo &pdo);
    bool configureHeartbeats(const CanOpenConfiguration &plan);
    bool writeNumber(ObjectAddress address, quint64 bits, int size);
    bool run(SdoTransfer *transfer);
    bool exchange(SdoTransfer *transfer);
    /// Takes what has come in. \return false when the bus is lost
    bool receive(SdoTransfer *transfer);
    void waitForFrames(std::chrono::nanoseconds time) const;
    bool failAtEnd();
    bool fail(const QString &error);
    QString title() const;

    static constexpr int Attempts = 3;  // of a transfer that the device does not answer
    static constexpr std::chrono::seconds MostTime{10};

    CanBus &m_bus;
    const QString m_device;
    const int m_node;
    const std::chrono::nanoseconds m_answerTime;
    const qint64 m_end;  // [ns]
    Listener m_listener;
    std::function<bool()> m_isEnding;
    QString m_error;
    quint32 m_abortCode = 0;
};

}  // namespace qplc
