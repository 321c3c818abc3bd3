// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanOpenConfiguration.h"
#include "CanOpenIds.h"
#include "SdoServer.h"
#include "hardware/can/CanFrame.h"

#include <array>
#include <vector>

namespace qplc {

/// The device's side of CANopen (CiA 301): a dictionary of objects, an SDO server, network
/// management, heartbeats in both directions, and PDOs whose mapping a master may change. It knows
/// no bus: frames come in by take(), and tick() says what goes out.
class CanOpenDevice
{
public:
    using Frames = std::vector<CanFrame>;
    static constexpr int Pdos = 4;  // of each direction

    /// \param node  its id
    explicit CanOpenDevice(int node);

    CanOpenObjects &objects() { return m_objects; }
    const CanOpenObjects &objects() const { return m_objects; }
    NmtState state() const { return m_state; }
    /// Whether the heartbeat of the master is missing that the device was told to watch. It ends
    /// with the next one.
    bool isMasterLost() const { return m_isMasterLost; }

    /// It was switched on.
    void boot(Frames *out);
    /// \param now  [ns]
    void take(const CanFrame &frame, qint64 now, Frames *out);
    void tick(qint64 now, Frames *out);
    /// Sends an emergency message; code 0: the end of all errors.
    void tellEmergency(quint16 code, quint8 errorRegister, Frames *out) const;

private:
    CanFrame frameOf(quint32 id, const QByteArray &data) const;
    quint64 value(int index, int sub) const { return m_objects.number({quint16(index), quint8(sub)}); }
    void takeCommand(const CanFrame &frame, Frames *out);
    void takeSdo(const CanFrame &frame, Frames *out);
    void takePdo(const CanFrame &frame);
    void takeSync(Frames *out);
    void apply(int number);
    void sendPdo(int number, Frames *out) const;
    bool isOn(int communication) const;
    quint32 checkWrite(ObjectAddress address, const QByteArray &bytes) const;
    quint32 checkEntry(int index, quint32 mapping) const;

    const quint32 m_node;
    CanOpenObjects m_objects;
    SdoServer m_sdo;
    NmtState m_state = NmtState::PreOperational;
    qint64 m_nextHeartbeat = 0;  // [ns]
    qint64 m_masterHeard = -1;   // [ns]; -1: not yet
    bool m_isMasterLost = false;
    std::array<qint64, Pdos> m_nextEvent{};  // [ns]
    std::array<int, Pdos> m_syncs{};         // since a PDO was sent
    std::array<CanFrame, Pdos> m_waiting{};
    std::array<bool, Pdos> m_hasCome{};  // a PDO that waits for SYNC
};

}  // namespace qplc
