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
/// A multiplexed message has pages: settings of its multiplexors. Each wired signal is on one of
/// them, and all are sent, one after the other. A signal that is on several is sent on those of the
/// others; without others, on its first one. If a multiplexor itself is wired, its value says which
/// pages are sent.
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

    /// Returns the signal with a channel that has bits in common with \a signal, or an empty name.
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
        CanFrame empty;    // with the multiplexors, and what signals have before anybody writes them
        CanFrame frame;    // as computed last
        CanFrame last;     // as sent last
        bool fits = true;  // each value into its bits
    };

    bool hasValues() const noexcept;
    bool isSafe() const noexcept;
    bool encode() noexcept;
    void encodePage(Page *page) noexcept;
    bool isDue(qint64 now) noexcept;
    bool isSelected(const Page &page) const noexcept;
    void encodePart(Page *page, const Part &part) noexcept;
    CanFrame emptyFrame(const DbcSignal *onPage) const;
    bool isTooEarly(qint64 now) const noexcept;
    void protect(CanFrame *frame, int number) const noexcept;
    bool isBefore(const Page &a, const Page &b) const noexcept;
    static bool hasOneValue(const DbcSignal &signal);

    QPlcDriver *m_driver;
    CanMessage m_message;
    quint32 m_key = 0;
    std::vector<DbcSignal> m_multiplexors;  // those that select others first
    std::vector<Part> m_parts;              // likewise, multiplexors in front of other signals
    std::size_t m_selectors = 0;            // of m_parts: wired multiplexors, at its beginning
    std::vector<Page> m_pages;
    quint64 m_saturated = 0;

    const DbcSignal *m_counter = nullptr;   // of m_message; null: none
    quint64 m_counted = 0;                  // value of the next frame
    const DbcSignal *m_checksum = nullptr;  // likewise
    int m_frames = 0;                       // of the last collect()

    qint64 m_period = 0;  // [ns]; 0: none
    qint64 m_gap = 0;     // [ns]; 0: none
    qint64 m_sentAt = 0;  // last [ns]
    bool m_hasSent = false;
    qint64 m_next = 0;  // when it is due by its period [ns]
    qint64 m_now = 0;   // of the last collect() [ns]
    bool m_isFirst = true;
    bool m_isRequested = false;
    bool m_isPending = false;  // could not be sent
    bool m_wasSafe = false;
    bool m_hasChanged = false;
};

}  // namespace qplc
