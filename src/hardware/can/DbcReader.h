// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DbcLexer.h"
#include "DbcSignal.h"
#include "QPlcParseError.h"

#include <QtCore/QVector>

namespace qplc {

/// Takes the words of a DBC file one after the other and tells where one is not what is expected.
/// After the first thing that is wrong all functions that expect something return false until
/// resume().
class DbcReader
{
public:
    DbcReader(const QString &text, const QString &fileName);

    const DbcToken &peek() const { return m_lexer.peek(); }
    DbcToken next() { return m_lexer.next(); }
    bool atEnd() const { return peek().kind == DbcToken::End; }
    /// Takes \a sign if it is next.
    bool takes(char sign);

    // Each takes what it expects; \param what  names it in the error
    bool expectSign(char sign, const char *what);
    bool expectWord(QString *word, const char *what);
    bool expectText(QString *text, const char *what);
    bool expectNumber(double *number, const char *what);
    bool expectInteger(qint64 *number, qint64 minimum, qint64 maximum, const char *what);
    bool expectUnsigned(quint64 *number, const char *what);
    /// What stands behind the name of a signal and its role: start|length@order sign
    /// (factor,offset) [minimum|maximum] "unit"; the rest behind `sign` may be missing.
    bool expectPlace(DbcSignal *signal);
    /// M, m3 or m3M, if that is next.
    bool expectRole(DbcSignal *signal);
    /// Ranges of a multiplexor: 3-3, 5-7.
    bool expectPages(QVector<DbcSignal::Range> *pages);

    /// Goes behind the next ';'.
    void skipStatement();
    /// Goes to the next line that begins with a word that \a isKeyword knows.
    void skipToLine(bool (*isKeyword)(const QString &word));

    bool fail(const DbcToken &at, const QString &message);
    void resume() { m_isBroken = false; }
    const QVector<QPlcParseError> &errors() const { return m_errors; }

private:
    bool expected(const char *what);
    bool expectByteOrder(DbcSignal *signal);
    bool expectScale(DbcSignal *signal);

    DbcLexer m_lexer;
    QString m_fileName;
    QVector<QPlcParseError> m_errors;
    bool m_isBroken = false;
};

}  // namespace qplc
