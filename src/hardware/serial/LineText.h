// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QRegularExpression>
#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <optional>

namespace qplc {

/// Finds the lines in what comes from a serial line, in whatever pieces it comes.
class LineStream
{
public:
    static constexpr int MaximumLength = 512;  // [byte] a longer line is thrown away, up to its end

    /// \param bytes  each of them ends a line
    void setEnds(const QByteArray &bytes) { m_ends = bytes; }
    void reset();

    /// The next byte. \return whether it has ended a line that is not empty: line()
    bool feed(char byte);
    QByteArray line() const { return m_line; }
    /// Lines that were too long.
    quint64 refused() const { return m_refused; }

private:
    QByteArray m_ends = "\r\n";
    QByteArray m_next;
    QByteArray m_line;
    bool m_isTooLong = false;
    quint64 m_refused = 0;
};

/// A regular expression whose groups with a name are numbers: `^ST,(?<weight>[-+0-9.]+)kg`.
class LinePattern
{
public:
    /// \return an error text with a remedy; empty if \a text is right
    static QString parse(const QString &text, LinePattern *pattern);

    /// Names of the groups, in their order.
    QStringList names() const { return m_names; }
    /// Returns the numbers of names(), without a value where a group is not a finite number; empty
    /// if the line does not match.
    QVector<std::optional<double>> match(const QByteArray &line) const;

private:
    QRegularExpression m_expression;
    QStringList m_names;
    QVector<int> m_groups;
};

/// Reads the bytes of a text with \r, \n, \t, \\ and \xNN. \return false if it has another escape
bool bytesOfText(const QString &text, QByteArray *bytes);

}  // namespace qplc
