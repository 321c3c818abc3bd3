// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace qplc {

/// One word of a DBC file. Lines and columns count from 1.
struct DbcToken
{
    enum Kind : quint8 {
        End,
        Word,    ///< name or keyword
        Number,  ///< with its sign
        Text,    ///< between quotation marks, without them
        Sign,    ///< any other character
        Broken   ///< a text without an end
    };
    Kind kind = End;
    QString text;
    int line = 1;
    int column = 1;
    bool isFirst = false;  // in its line

    bool isSign(char sign) const { return kind == Sign && text.at(0) == QLatin1Char(sign); }
    bool isWord(const char *word) const { return kind == Word && text == QLatin1String(word); }
    /// As it is shown in messages.
    QString shown() const;
};

/// Cuts the text of a DBC file into words.
class DbcLexer
{
public:
    explicit DbcLexer(const QString &text);

    /// The next word, without taking it.
    const DbcToken &peek() const { return m_next; }
    DbcToken next();

private:
    void advance();
    void skipBlanks();
    void step();
    QChar at(int offset = 0) const;
    int wordLength() const;
    int numberLength() const;
    void takeText();

    const QString m_text;
    int m_position = 0;
    int m_line = 1;
    int m_column = 1;
    bool m_isLineBegin = true;
    DbcToken m_next;
};

}  // namespace qplc
