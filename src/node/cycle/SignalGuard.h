// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcQuality.h"
#include "realtime/Counter.h"
#include "signals/PayloadRules.h"
#include "signals/ProcessImage.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace qplc {

/// Stands before an image and lets no bad value in: what is not finite or outside of the limits of
/// the table is counted and not taken, and a signal without a good value is Held, and after `hold`
/// cycles Safe.
///
/// The master has one before its process image, every node one before its inputs: same rules, same
/// class. A signal is named by its place: its index in the process image, or the number of the
/// field in the frame of a node. Cycles are counted in the phase; times are looked at nowhere.
///
/// store(), miss(), settle() allocate nothing and cost nothing per signal as long as all is well.
/// One thread at a time; counters may be read by any.
class SignalGuard
{
public:
    using Place = quint32;
    static constexpr std::int64_t Never = std::numeric_limits<std::int64_t>::min() / 2;
    /// Cycles for which a signal without `hold` is held, unless setUsualHold() says otherwise.
    static constexpr std::int64_t UsualHold = 3;
    static constexpr std::int64_t HoldForever = std::numeric_limits<std::int64_t>::max();

    /// Who wants to know; called by the thread that takes values.
    class Observer
    {
    public:
        virtual ~Observer() = default;
        /// A value was not taken. \param isFirst  of a row of bad values
        virtual void valueRefused(std::uint16_t writer, Place place, const ValueFault &fault,
                                  bool isFirst) noexcept = 0;
        /// There has been no good value for longer than `hold`: the signal has its safe one.
        virtual void signalBecameSafe(Place place) noexcept = 0;
        /// A contested signal has its value from another writer; 0: from none.
        virtual void sourceChanged(Place place, std::uint16_t from, std::uint16_t to) noexcept = 0;
    };

    /// The values of a writer: which field of its payload goes where.
    struct Frame
    {
        struct Field
        {
            std::size_t number;  // in the layout
            quint32 from;        // [byte] in the payload
            Place place;
        };
        PayloadRules rules;
        std::vector<Field> fields;
        std::vector<CopyRun> runs;     // of all fields
        std::vector<Field> contested;  // of signals with several writers: see Contest
        quint32 qualities = 0;         // [byte] where those that the writer gives begin
        quint32 qualityCount = 0;      // 0: it gives none, all its values are good

        /// How far the writer trusts a value; one that is not usable is none.
        QPlcQuality quality(const Field &field, const char *payload) const noexcept
        {
            return qualityCount == 0 ? QPlcQuality(QPlcQuality::Good)
                                     : QPlcQuality::fromByte(quint8(payload[qualities + field.number]));
        }
        /// What is wrong with a value; nothing, when the writer says that there is none.
        ValueFault fault(const Field &field, const char *payload) const noexcept
        {
            return quality(field, payload).isUsable() ? rules.fault(field.number, payload) : ValueFault();
        }
        /// Whether the writer calls a value anything but Good.
        bool hasDoubt(const char *payload) const noexcept
        {
            return std::any_of(payload + qualities, payload + qualities + qualityCount,
                               [](char quality) { return quality != 0; });
        }
        /// Whether every value is good and allowed.
        bool isGood(const char *payload) const noexcept
        {
            quint8 worst = 0;
            for (quint32 i = 0; i < qualityCount; ++i)
                worst |= quint8(payload[qualities + i]);
            return worst == 0 && rules.allow(payload);
        }
    };
    /// What is known of a writer. As long as it is whole, all its signals are Good and of the cycle
    /// `taken`; else each signal has an age of its own.
    struct Writer
    {
        std::uint16_t id = 0;
        bool isWhole = false;
        std::int64_t taken = Never;
    };

    /// What a writer says of signals that others write, too: its newest good values.
    struct Claims
    {
        std::vector<char> bytes;         // as in its payload
        std::vector<std::int64_t> good;  // cycles, of each field; Never: there is none
        void resize(const PayloadLayout &layout);
        void forget();
    };
    /// A signal with several writers: the first candidate whose newest value is good and fresh is
    /// the source.
    struct Contest
    {
        struct Candidate
        {
            std::uint16_t writer;
            const Claims *claims;
            std::size_t field;  // number in the layout of the writer
            quint32 from;       // [byte] in its payload
        };
        Place place;
        std::vector<Candidate> candidates;  // in the order of the table
    };
    /// A value is fresh for so many cycles, or for `hold` of its signal, if that is less.
    static constexpr std::int64_t FreshCycles = 5;

    /// Before a process image, which outlives this object.
    SignalGuard(ProcessImage &image, Observer *observer);
    /// Before values in the order of a payload, which begin as the initial values, or, where these
    /// are not finite, as the safe ones.
    /// \param values layout.valueSize() bytes, \param qualities a byte for each field; both outlive
    ///         this object
    SignalGuard(const QPlcSignalTable &table, const PayloadLayout &layout, char *values, char *qualities,
                Observer *observer);

    /// Signals without `hold` in the table are held for \a cycles. Between phases.
    void setUsualHold(std::int64_t cycles) noexcept;

    /// The frame of a writer of the process image, but for the signals that are \a held (by index;
    /// those behind its end are not).
    static Frame frameFor(const ProcessImage &image, const PayloadLayout &layout, const std::vector<bool> &held = {});
    /// The frame of all values of a payload.
    static Frame frameFor(const QPlcSignalTable &table, const PayloadLayout &layout);

    /// Takes the values of \a cycle out of \a payload; \a now is the cycle at hand: older values
    /// are Held, and not taken when they are too old. A value that its writer calls Held is that
    /// much older, one that it calls Safe or Invalid is none.
    void store(const Frame &frame, Writer &writer, const char *payload, std::int64_t cycle, std::int64_t now) noexcept
    {
        if (writer.isWhole && cycle >= now && frame.isGood(payload)) {
            copyRuns(frame.runs, payload, m_values);
            writer.taken = cycle;
        } else {
            storeOneByOne(frame, writer, payload, cycle, now);
        }
    }
    /// \a writer has no more to say to the cycle \a now: what it has not written in it grows old.
    void miss(const Frame &frame, Writer &writer, std::int64_t now) noexcept
    {
        if (writer.taken < now || !writer.isWhole)
            grow(frame, writer, now);
    }
    /// \a writer is gone: its signals grow old.
    void leave(const Frame &frame, Writer &writer) noexcept;
    /// Signals whose writer is gone are as old as they are in the cycle \a now, for who reads them
    /// in it; those of others may still get a value.
    void ageAbandoned(std::int64_t now) noexcept;
    /// Nobody writes the signal any more, and nobody who did is among the writers.
    void abandon(Place place) noexcept;
    /// Other signals of \a writer than before are held: \a frame is new. \param last the newest
    /// cycle that has ended
    void resume(const Frame &frame, Writer &writer, std::int64_t last) noexcept;
    /// Takes down what \a writer says of contested signals.
    void claim(const Frame &frame, const Writer &writer, Claims &claims, const char *payload,
               std::int64_t cycle) noexcept;
    /// Gives the signal the value of its source, or lets it grow old when there is none.
    void decide(const Contest &contest, std::int64_t now) noexcept;
    /// At the end of the cycle \a now: signals without a value of it are Held or Safe.
    void settle(std::int64_t now) noexcept;

    /// A value was given from outside and stays: it does not grow old.
    void set(Place place, QPlcQuality quality) noexcept;
    /// The signal keeps the value that it has.
    void keep(Place place) noexcept;
    /// Cycles are counted anew: what has no new value by the next settle() is Safe, unless it was
    /// given from outside.
    void forget() noexcept;

    /// Values that were not taken because they were NaN or infinite. \threadsafe yes
    std::uint64_t nonFinite(Place place) const { return m_nonFinite[place]; }
    /// Values that were not taken because they were outside of the limits. \threadsafe yes
    std::uint64_t outOfRange(Place place) const { return m_outOfRange[place]; }
    void clearCounters() noexcept;
    /// Writer that a contested signal has its value from; 0: none. \threadsafe yes
    std::uint16_t source(Place place) const { return std::uint16_t(m_sources[place]); }

private:
    static constexpr std::int64_t Forever = std::numeric_limits<std::int64_t>::max();

    struct Signal
    {
        quint32 offset = 0;         // [byte] of its value, and of its safe one
        quint32 size = 0;           // [byte]
        std::int64_t hold = 0;      // [cycles]
        bool hasOwnHold = false;    // of the table
        std::int64_t good = Never;  // cycle of its newest good value; only while it is growing old
        bool isGrowing = false;     // has no value of the cycle at hand
        bool isListed = false;      // in m_growing: growing, or until the next settle()
        bool isAbandoned = false;   // its writer is gone
        bool isRefused = false;     // its newest value was not taken
    };

    void add(const QPlcSignalDefinition &definition, quint32 offset);
    void storeOneByOne(const Frame &frame, Writer &writer, const char *payload, std::int64_t cycle,
                       std::int64_t now) noexcept;
    void setSource(Place place, std::uint16_t writer) noexcept;
    void put(Place place, const char *value, std::int64_t cycle, std::int64_t now) noexcept;
    void refuse(std::uint16_t writer, Place place, const ValueFault &fault, bool isFirst) noexcept;
    void grow(const Frame &frame, Writer &writer, std::int64_t now) noexcept;
    void partWays(const Frame &frame, Writer &writer) noexcept;
    void startGrowing(Place place) noexcept;
    bool age(Place place, std::int64_t now) noexcept;
    QPlcQuality quality(Place place) const { return QPlcQuality::fromByte(quint8(m_qualities[place])); }
    void setQuality(Place place, QPlcQuality quality) { m_qualities[place] = char(quality.toByte()); }

    char *m_values = nullptr;
    char *m_qualities = nullptr;
    Observer *m_observer = nullptr;
    std::vector<Signal> m_signals;
    std::vector<char> m_safe;      // values, in the order of m_values
    std::vector<Place> m_growing;  // signals that are growing old; has room for all
    std::vector<Counter> m_nonFinite;
    std::vector<Counter> m_outOfRange;
    std::vector<Counter> m_sources;
};

}  // namespace qplc
