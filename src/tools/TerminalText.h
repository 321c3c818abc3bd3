// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QJsonDocument>
#include <QtCore/QStringList>
#include <QtCore/QVector>

namespace tools {

/// \a text with its characters that are not fit to be shown (see signals/MessageText.h) as \xNN or \uNNNN: what came over the network must not command a terminal.
QString printable(const QString &text);
/// Whether the standard output is a terminal that a person looks at.
bool isTerminal();
/// \a text in bold on a terminal, as it is elsewhere (and where NO_COLOR is set).
QString bold(const QString &text);
/// Prints a line, at once, to the standard output.
void printLine(const QString &line);

/// Prints a text as it is, at once.
void printText(const QString &text);
/// Prints a document, or an object, as one line of JSON.
void printJson(const QJsonDocument &document);
/// Columns and lines of the terminal; what COLUMNS and LINES say, or 80 x 24, where the output is none.
struct TerminalSize
{
    int columns;
    int lines;
};
TerminalSize terminalSize();

/// Rows with aligned columns, two blanks apart; an empty cell is "-", so that every row has as many words.
class TextTable
{
public:
    enum Alignment { Left, Right };

    void addColumn(const QString &title, Alignment alignment = Left);
    /// \pre as many cells as columns
    void addRow(const QStringList &cells);
    void print() const;

private:
    struct Column
    {
        QString title;
        Alignment alignment;
        int width;
    };
    QString toLine(const QStringList &cells) const;

    QVector<Column> m_columns;
    QVector<QStringList> m_rows;
};

}  // namespace tools
