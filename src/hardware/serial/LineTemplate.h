// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QStringList>

#include <vector>

namespace qplc {

/// A line of text with numbers, to be sent: `SP {setpoint:.2}`, as a printf of named values.
class LineTemplate
{
public:
    static constexpr int MaximumLength = 256;  // [byte] of a line that is sent

    /// \param bytes  of the text; `{name}`, `{name:.2}` and `{name:07.2}` are numbers, `{{` and
    /// `}}` are braces \return an error text with a remedy; empty if \a bytes is right
    static QString parse(const QByteArray &bytes, LineTemplate *line);

    /// Names of the numbers, each once, in their order.
    QStringList names() const { return m_names; }
    /// The largest amount of a number that fits into a line. \param name  place in names()
    double largest(int name) const;
    /// The fewest bytes that a line of it has.
    int shortest() const;
    /// \param values  of names() \return empty if a value is not finite, or the line would be too
    /// long
    QByteArray text(const std::vector<double> &values) const;

private:
    struct Part
    {
        QByteArray literal;  // before the number
        int name = -1;       // place in names(); -1: there is no number behind it
        int width = 0;       // at least so many characters
        bool isZeroFilled = false;
        int decimals = -1;  // -1: as many as the value needs
    };

    QString addNumber(const QByteArray &word, Part *part);
    static QByteArray numberText(const Part &part, double value);

    QStringList m_names;
    std::vector<Part> m_parts;
};

}  // namespace qplc
