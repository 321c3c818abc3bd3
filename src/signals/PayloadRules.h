// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PayloadLayout.h"

namespace qplc {

/// Why a value is not taken.
struct ValueFault
{
    enum Kind : quint8 { None, NotFinite, BelowMinimum, AboveMaximum };
    Kind kind = None;
    double value = 0.0;  // the first element that is to blame, rounded to a double
    explicit operator bool() const { return kind != None; }
};

/// "12 is above its maximum 10", "nan is not a finite number"
QString faultText(const QPlcSignalDefinition &signal, const ValueFault &fault);

/// What the signal table allows the values of a payload to be, as flat lists: finite, not below
/// `min`, not above `max`. Every element of an array counts.
class PayloadRules
{
public:
    PayloadRules() = default;
    PayloadRules(const QPlcSignalTable &table, const PayloadLayout &layout);

    /// Whether every value of \a payload is allowed.
    bool allow(const char *payload) const noexcept
    {
        for (const RealRun &run : m_realRuns) {
            if (!isFinite(run, payload))
                return false;
        }
        for (const Limits &limits : m_limits) {
            if (firstOutside(limits, payload))
                return false;
        }
        return true;
    }
    /// What is wrong with the value of one field of the layout.
    ValueFault fault(std::size_t field, const char *payload) const noexcept;

private:
    /// Real values of one type that lie side by side and have to be finite.
    struct RealRun
    {
        QPlcSignalType::Scalar scalar;
        quint32 offset;  // [byte]
        quint32 size;    // [byte]
    };
    union Bound
    {
        double real;
        qint64 integer;
        quint64 natural;
    };
    struct Limits
    {
        QPlcSignalType::Scalar scalar;
        quint16 count;
        quint32 offset;  // [byte]
        Bound minimum;
        Bound maximum;
    };
    struct Field
    {
        RealRun run{};    // of this field alone; size 0: none
        int limits = -1;  // its place in m_limits; -1: none
    };

    static bool isFinite(const RealRun &run, const char *payload) noexcept;
    static ValueFault firstOutside(const Limits &limits, const char *payload) noexcept;
    static Limits limitsOf(const QPlcSignalDefinition &signal, quint32 offset);
    void add(const RealRun &run);

    std::vector<RealRun> m_realRuns;
    std::vector<Limits> m_limits;
    std::vector<Field> m_fields;
};

}  // namespace qplc
