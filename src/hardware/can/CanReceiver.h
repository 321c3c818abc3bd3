// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanConfiguration.h"
#include "CanFrame.h"
#include "QPlcReadChannel.h"

#include <memory>
#include <vector>

namespace qplc {

/// A message that is received: sets the channels of its signals.
class CanReceiver
{
public:
    CanReceiver(QPlcDriver *driver, const CanMessage &message);

    const CanMessage &message() const { return m_message; }
    quint32 key() const { return m_key; }

    /// The channel of a signal, of @age or of @count; made when it is asked for the first time.
    /// \return null when the message has none of this name
    QPlcReadChannel *channel(const QString &name);

    /// A frame of the message has come in; one that is too short is counted and left alone.
    void decode(const CanFrame &frame) noexcept;
    /// Sets @age and @count. \param now  [ns]
    void refresh(qint64 now) noexcept;
    /// The bus was opened: what came in before is no more.
    void reset() noexcept;

    quint64 tooShort() const { return m_tooShort; }

private:
    struct Part
    {
        DbcSignal signal;
        std::unique_ptr<QPlcReadChannel> channel;
    };

    QPlcReadChannel *makeOwn(std::unique_ptr<QPlcReadChannel> *channel, const QString &name);

    QPlcDriver *m_driver;
    CanMessage m_message;
    quint32 m_key = 0;
    DbcSignal m_multiplexor;
    bool m_isMultiplexed = false;
    std::vector<Part> m_parts;
    std::unique_ptr<QPlcReadChannel> m_age;
    std::unique_ptr<QPlcReadChannel> m_count;
    quint64 m_frames = 0;
    quint64 m_tooShort = 0;
    bool m_hasFrame = false;  // since reset()
    qint64 m_time = 0;        // of the last frame [ns]
};

}  // namespace qplc
