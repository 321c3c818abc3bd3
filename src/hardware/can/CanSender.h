// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanConfiguration.h"
#include "CanFrame.h"
#include "QPlcWriteChannel.h"

#include <memory>
#include <vector>

namespace qplc {

/// A message that is sent: makes frames of the values of its channels when it is time.
///
/// A multiplexed message has a page for each value of the multiplexor that a wired signal belongs
/// to. All of them are sent, one after the other, unless the multiplexor itself is wired: then its
/// value says which one.
class CanSender
{
public:
    CanSender(QPlcDriver *driver, const CanMessage &message);

    const CanMessage &message() const { return m_message; }
    /// Of the frames that carry it.
    quint32 key() const { return m_key; }

    /// The channel of a signal; made when it is asked for the first time. \return null when the
    /// message has none of this name
    QPlcWriteChannel *channel(const QString &name);

    /// The signal that has a channel and bits in common with another one; empty: there is none.
    QString overlapWith(const DbcSignal &signal) const;

    /// Before the cycles: memory is taken here. Frames that it sends at a time are at most
    /// mostFrames().
    void prepare();
    int mostFrames() const { return int(m_pages.size()); }
    /// The bus was opened: everything is to be sent anew.
    void reset() noexcept;

    /// Somebody asks for the message (remote frame).
    void request() noexcept { m_isRequested = m_isRequested || m_message.rule.onRequest; }
    /// Puts the frames that are to be sent at \a now [ns] to \a frames. \return how many
    int collect(qint64 now, CanFrame *frames) noexcept;
    /// After collect(): whether the bus has taken the frames. Those that it has not taken are due
    /// at once again.
    void sent(bool isTaken) noexcept;
    /// What is sent on change is due again.
    void repeatChange() noexcept { m_isPending = m_isPending || m_message.rule.onChange; }

    /// Frames for the bus in which a value did not fit into the bits of its signal.
    quint64 saturated() const { return m_saturated; }

private:
    struct Part
    {
        DbcSignal signal;
        std::unique_ptr<QPlcWriteChannel> channel;
    };
    struct Page
    {
        quint64 value = 0;  // of the multiplexor
        CanFrame frame;     // as computed last
        CanFrame last;      // as sent last
        bool fits = true;   // each value into its bits
    };

    bool hasValues() const noexcept;
    bool isSafe() const noexcept;
    bool encode() noexcept;
    void encodePage(Page *page) noexcept;
    bool isDue(qint64 now) noexcept;
    bool isSelected(const Page &page) const noexcept;
    CanFrame emptyFrame(quint64 page) const;

    QPlcDriver *m_driver;
    CanMessage m_message;
    quint32 m_key = 0;
    DbcSignal m_multiplexor;
    bool m_isMultiplexed = false;
    const QPlcWriteChannel *m_selector = nullptr;  // channel of the multiplexor
    std::vector<Part> m_parts;
    std::vector<Page> m_pages;
    quint64 m_saturated = 0;

    qint64 m_period = 0;  // [ns]; 0: none
    qint64 m_next = 0;    // when it is due by its period [ns]
    qint64 m_now = 0;     // of the last collect() [ns]
    bool m_isFirst = true;
    bool m_isRequested = false;
    bool m_isPending = false;  // could not be sent
    bool m_wasSafe = false;
    bool m_hasChanged = false;
};

}  // namespace qplc
