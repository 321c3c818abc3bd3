// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanOpenIds.h"
#include "hardware/can/CanFrame.h"

namespace qplc {

/// What a device tells of itself without being asked: heartbeats and emergencies. Takes no memory.
class CanOpenMonitor
{
public:
    enum Finding : quint8 {
        Fine,
        Silent,         ///< no heartbeat for too long
        Restarted,      ///< a boot-up message came in
        NotOperational  ///< its heartbeat tells another state
    };

    /// Nothing is known of the device: it is about to be started.
    void forget() noexcept
    {
        m_state = NmtState::Unknown;
        m_heartbeat = None;
        m_hasRestarted = false;
    }
    /// \param time  of the frame [ns] \return whether the frame was a heartbeat or an emergency of
    /// the device
    bool take(const CanFrame &frame, int node, qint64 time) noexcept
    {
        if (node == 0 || frame.has(CanFrame::Extended) || frame.has(CanFrame::Remote) || frame.has(CanFrame::Error))
            return false;
        if (frame.id == CanOpenIds::Heartbeat + quint32(node) && frame.size >= 1) {
            m_state = NmtState(frame.data[0] & 0x7F);
            m_heartbeat = time;
            m_hasRestarted = m_hasRestarted || m_state == NmtState::BootUp;
            return true;
        }
        if (frame.id != CanOpenIds::Emergency + quint32(node) || frame.size != 8)
            return false;
        m_emergency = quint16(frame.data[0] | frame.data[1] << 8);
        m_errorRegister = frame.data[2];
        if (m_emergency != 0) {
            m_lastEmergency = m_emergency;
            ++m_emergencies;
        }
        return true;
    }
    /// \param longest  without a heartbeat [ns]
    Finding look(qint64 now, qint64 longest) noexcept
    {
        if (m_heartbeat == None)
            m_heartbeat = now;
        if (m_hasRestarted)
            return Restarted;
        if (m_state != NmtState::Operational)
            return NotOperational;
        return now - m_heartbeat > longest ? Silent : Fine;
    }

    NmtState state() const { return m_state; }
    quint16 emergency() const { return m_emergency; }          ///< 0: there is none any more
    quint16 lastEmergency() const { return m_lastEmergency; }  ///< that was not its end
    quint8 errorRegister() const { return m_errorRegister; }
    quint64 emergencies() const { return m_emergencies; }

private:
    static constexpr qint64 None = -1;

    NmtState m_state = NmtState::Unknown;
    bool m_hasRestarted = false;
    qint64 m_heartbeat = None;  // when the last one came in [ns]
    quint16 m_emergency = 0;
    quint16 m_lastEmergency = 0;
    quint8 m_errorRegister = 0;
    quint64 m_emergencies = 0;
};

}  // namespace qplc
