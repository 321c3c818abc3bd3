// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QString>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace qplc {

/// Rows of a table as text: CSV after RFC 4180, or tabs for spreadsheets and clipboards. Numbers
/// are those of the C locale, with as many digits as they need to be read back exactly.
class TableText
{
public:
    enum Format { Csv, Tsv };

    explicit TableText(Format format)
        : m_format(format)
    {
    }

    /// The title of a column: "kite.elevation [deg]".
    void addTitle(const QString &name, const QString &unit);
    void addText(const QString &text);
    void addNothing() { begin(); }
    /// NaN is an empty field.
    template<typename Number>
    void addNumber(Number number)
    {
        begin();
        if constexpr (std::is_floating_point_v<Number>) {
            if (std::isnan(number))
                return;
        }
        char digits[32];
        const std::to_chars_result result = std::to_chars(digits, digits + sizeof digits, number);
        m_text.append(digits, int(result.ptr - digits));
    }
    /// "12.345", with nine digits at most. \param time [ns], >= 0
    void addSeconds(std::int64_t time);
    /// "2026-11-20T14:03:12.340000Z" \param time [ns since 1970], \param digits  of the fraction
    void addMoment(std::int64_t time, int digits = 6);
    void endRow();

    const QByteArray &text() const { return m_text; }
    /// The text, which begins anew.
    QByteArray take();

private:
    void begin();

    Format m_format;
    QByteArray m_text;
    bool m_isInRow = false;
};

}  // namespace qplc
