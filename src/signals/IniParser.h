// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcParseError.h"

#include <QtCore/QByteArray>
#include <QtCore/QString>

namespace qplc {

/// What one line of an INI text says. Lines and columns count from 1, columns in characters.
struct IniItem
{
    enum Kind : quint8 {
        Section,  ///< [name]
        Entry,    ///< name = value
        Broken,   ///< neither
        End
    };
    Kind kind = End;
    int line = 0;
    int column = 0;       // of the name
    int valueColumn = 0;  // of the value
    QString name;
    QString value;
    QString
        error;  // what is wrong with the line, and the remedy; empty: nothing. Name or value are not to be used then
    int errorColumn = 0;
};

/// Cuts an INI text into sections and entries and says where each stands; knows nothing of what
/// they mean.
///
/// Strict: UTF-8 (a byte order mark is skipped), lines ended by LF or CRLF and of at most
/// MaximumLine bytes, no control characters. Comments begin with `;` or `#` at the start of a line,
/// or with ` ;` behind a value. A value that begins with `"` ends with `"`; inside, \n \r \t \" and
/// \\ are line feed, carriage return, tab, quotation mark and backslash.
class IniParser
{
public:
    static constexpr int MaximumLine = 4096;  // [byte]

    explicit IniParser(const QByteArray &text);

    /// The next line that is neither blank nor a comment; kind End behind the last. A text that is
    /// no text at all (zero bytes, UTF-16) ends with its first error.
    IniItem next();

    /// Reads a whole file that an IniParser is to cut.
    /// \param what  "a signal table", for messages
    /// \param errors  gets the only one; null: nobody wants it
    /// \return false when the file cannot be read, or has more than \a largest bytes
    static bool readFile(const QString &fileName, const QString &what, qint64 largest, QByteArray *text,
                         QVector<QPlcParseError> *errors);

    /// The text of a value that next() reads back as \a value, which has no control characters but
    /// \n, \r and \t.
    static QString valueText(const QString &value);

private:
    QByteArray takeLine();
    bool readLine(const QByteArray &line, IniItem *item);
    bool refuseBytes(const QByteArray &line, IniItem *item);

    QByteArray m_text;
    int m_position = 0;
    int m_line = 0;
};

}  // namespace qplc
