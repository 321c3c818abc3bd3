// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcUnderlyingProtocol.h"
#include "protocol/messages/Vocabulary.h"

#include <QtCore/QJsonDocument>
#include <QtCore/QStringList>
#include <QtCore/QVector>

namespace tools {

/// \a text with its characters that are not fit to be shown (see signals/MessageText.h) as \xNN or
/// \uNNNN: what came over the network must not command a terminal.
QString printable(const QString &text);
/// Whether the standard output is a terminal that a person looks at.
bool isTerminal();
/// Whether the standard output is a terminal that can move its cursor and take the whole screen:
/// not with TERM=dumb.
bool isScreen();

/// What a text means. There is one colour for each meaning.
enum class Tone { Plain, Title, Good, Caution, Bad };
/// Whether tones are seen: on a terminal other than TERM=dumb, unless NO_COLOR is set and not
/// empty.
bool hasColors();
/// \a text in the colour of \a tone where hasColors(), as it is elsewhere.
QString toned(const QString &text, Tone tone);
Tone toneOfState(qplc::messages::MasterState state);
/// Of a quality, as QPlcQuality::toString() names it: "held 3" is a caution.
Tone toneOfQuality(const QString &quality);

/// Columns that \a text takes on a terminal: two for a wide character, none for a combining one.
int displayWidth(const QString &text);
enum Alignment { Left, Right };
/// \a text with blanks, \a width columns wide at least.
QString padded(const QString &text, int width, Alignment alignment = Left);
/// \a text in at most \a width columns; "…" stands for what was cut. What stands in brackets at the
/// end is kept: "bodyPositio…[2]".
QString cut(const QString &text, int width);
/// \a text in lines of at most \a width columns, broken at blanks; a longer word stays whole.
QStringList wrapped(const QString &text, int width);

/// Prints a line, at once, to the standard output.
void printLine(const QString &line);

/// Prints \a head and \a text behind it. On a terminal the next lines of a long text begin below
/// its first one. \a head may have colours and is \a headWidth columns wide.
void printWrapped(const QString &head, int headWidth, const QString &text);

/// Prints a text as it is, at once.
void printText(const QString &text);
/// Prints a document, or an object, as one line of JSON.
void printJson(const QJsonDocument &document);
/// "192.168.1.5:50000": the address of \a master, whichever way its frames go.
QString placeText(const QPlcUnderlyingProtocol &master);
/// Columns and lines of the terminal; what COLUMNS and LINES say, or 80 x 24, where the output is
/// none.
struct TerminalSize
{
    int columns;
    int lines;
};
TerminalSize terminalSize();

/// Rows with aligned columns, two blanks apart; an empty cell is "-", so that every row has as many
/// words. On a terminal that is too narrow long cells get several lines; where that is not enough,
/// the table becomes several ones, each with the first column.
class TextTable
{
public:
    void addColumn(const QString &title, Alignment alignment = Left);
    /// \pre as many cells as columns
    void addRow(const QStringList &cells);
    /// Shows a cell of the row that was added last in \a tone.
    void setTone(int column, Tone tone);
    void print() const;
    /// The lines of print() for \a width columns; 0: as many as they need.
    QStringList lines(int width) const;

private:
    struct Column
    {
        QString title;
        Alignment alignment;
        int width;
    };
    struct Cell
    {
        QString text;
        Tone tone;
    };
    QVector<int> widthsFor(int width) const;
    QString toLine(const QVector<Cell> &cells, const QVector<int> &widths) const;
    TextTable part(const QVector<int> &columns) const;
    QStringList linesOfParts(int width) const;
    QStringList toLines(const QVector<Cell> &cells, const QVector<int> &widths) const;

    QVector<Column> m_columns;
    QVector<QVector<Cell>> m_rows;
};

}  // namespace tools
