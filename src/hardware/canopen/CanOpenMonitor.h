// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanOpenEmergency.h"
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
        m_hasEmergency = false;
    }
    /// What the device has told when it was asked, while it is started: \a emergency, if it has not
    /// told a newer one by itself.
    void takeError(const CanOpenEmergency &emergency) noexcept
    {
        if (!m_hasEmergency)
            note(emergency);
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
        note(CanOpenEmergency::fromFrame(frame));
        m_emergencies += m_emergency.isError() ? 1 : 0;
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
    const CanOpenEmergency &emergency() const { return m_emergency; }  ///< the newest one
    quint16 lastError() const { return m_lastError; }                  ///< its code; 0: there was none
    quint64 emergencies() const { return m_emergencies; }              ///< that have told an error
    /// Whether the newest one has not been told yet, by setTold().
    bool isUntold() const { return m_isUntold; }
    void setTold() { m_isUntold = false; }

private:
    static constexpr qint64 None = -1;

    void note(const CanOpenEmergency &emergency) noexcept
    {
        m_emergency = emergency;
        m_lastError = emergency.isError() ? emergency.code : m_lastError;
        m_hasEmergency = true;
        m_isUntold = true;
    }

    NmtState m_state = NmtState::Unknown;
    bool m_hasRestarted = false;
    qint64 m_heartbeat = None;  // when the last one came in [ns]
    CanOpenEmergency m_emergency;
    bool m_hasEmergency = false;  // since it was started
    bool m_isUntold = false;
    quint16 m_lastError = 0;
    quint64 m_emergencies = 0;
};

}  // namespace qplc
