// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/can/CanBus.h"

#include <QtCore/QJsonObject>
#include <QtCore/QtEndian>

#include <vector>

/// What the frames of the benchmark carry: 24, 24 and 16 bits, Intel byte order.
struct CanStamp
{
    static constexpr quint32 ToPartner = 0x200;    // first id
    static constexpr quint32 FromPartner = 0x300;  // first id
    static constexpr int Size = 8;                 // [byte]
    static constexpr quint32 CountMask = 0xFFFFFF;
    static constexpr quint32 TimeMask = 0xFFFFFF;
    static constexpr quint32 LongestTook = 0xFFFF;

    quint32 count = 0;  // of its message
    quint32 time = 0;   // when it was made, CLOCK_MONOTONIC [us]
    /// From the making of the frame before to the end of its sending [us]; the longest: that or
    /// longer.
    quint32 took = 0;

    quint64 packed() const
    {
        return qToLittleEndian(quint64(count) | quint64(time & TimeMask) << 24 | quint64(took) << 48);
    }
    static quint32 countOf(const qplc::CanFrame &frame)
    {
        return qFromLittleEndian<quint32>(frame.data.data()) & CountMask;
    }
};

/// The device at the other end: sends frames in each period as soon as the driver has sent the
/// first one, and looks whether those of the driver are complete and in order.
class CanPartner
{
public:
    /// \param frames  in each period, both ways
    CanPartner(const QString &device, int frames, qint64 period);

    /// Until the standard input ends. \return false with errorString()
    bool run();
    QString errorString() const { return m_error; }
    QJsonObject result() const;

private:
    bool step(bool isSending);
    void receive(const qplc::CanFrame &frame);

    QString m_device;
    qint64 m_period;
    QString m_error;
    std::unique_ptr<qplc::CanBus> m_bus;
    std::vector<qplc::CanFrame> m_outgoing;
    std::vector<quint32> m_next;  // count of the next frame of each message; 0: none came yet
    quint32 m_count = 0;
    quint32 m_took = 0;  // of the sending before [us]
    quint32 m_lastId = 0;
    quint64 m_lost = 0;
    quint64 m_reordered = 0;
};
