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
    /// Of its frames; of a parameter group of J1939 they have others, too.
    quint32 key() const { return m_key; }

    /// The channel of a signal, of @age or of @count; made when it is asked for the first time.
    /// \return null when the message has none of this name
    QPlcReadChannel *channel(const QString &name);

    /// A frame with the id of the message, or of its parameter group, has come in; one of another
    /// source or message is left alone, and one that is too short is counted.
    void decode(const CanFrame &frame) noexcept;
    /// Sets @age and @count. \param now  [ns]
    void refresh(qint64 now) noexcept;
    /// The bus was opened: what came in before is no more.
    void reset() noexcept;

    quint64 tooShort() const { return m_tooShort; }
    /// Frames with a wrong checksum, or with the alive counter of the one before.
    quint64 corrupt() const { return m_corrupt; }

private:
    struct Part
    {
        DbcSignal signal;
        std::unique_ptr<QPlcReadChannel> channel;
    };

    bool isSound(const CanFrame &frame) noexcept;
    QPlcReadChannel *makeOwn(std::unique_ptr<QPlcReadChannel> *channel, const QString &name);

    QPlcDriver *m_driver;
    CanMessage m_message;
    quint32 m_key = 0;
    std::vector<Part> m_parts;
    std::unique_ptr<QPlcReadChannel> m_age;
    std::unique_ptr<QPlcReadChannel> m_count;
    quint64 m_frames = 0;
    quint64 m_tooShort = 0;
    quint64 m_corrupt = 0;
    const DbcSignal *m_counter = nullptr;   // of m_message; null: none
    quint64 m_counted = 0;                  // value of the last frame
    const DbcSignal *m_checksum = nullptr;  // likewise
    bool m_hasFrame = false;                // since reset()
    qint64 m_time = 0;                      // of the last frame [ns]
};

}  // namespace qplc
