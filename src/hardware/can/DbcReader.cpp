// SPDX-License-Identifier: Apache-2.0
#include "DbcReader.h"

#include "DbcFile.h"

#include <cmath>
#include <limits>

namespace qplc {

DbcReader::DbcReader(const QString &text, const QString &fileName)
    : m_lexer(text)
    , m_fileName(fileName)
{
}

bool DbcReader::fail(const DbcToken &at, const QString &message)
{
    m_isBroken = true;
    m_errors.append({m_fileName, at.line, at.column, message});
    return false;
}

bool DbcReader::expected(const char *what)
{
    return fail(peek(), QStringLiteral("%1 instead of %2").arg(peek().shown(), QLatin1String(what)));
}

bool DbcReader::takes(char sign)
{
    if (m_isBroken || !peek().isSign(sign))
        return false;
    next();
    return true;
}

bool DbcReader::expectSign(char sign, const char *what)
{
    return takes(sign) || (!m_isBroken && expected(what));
}

bool DbcReader::expectWord(QString *word, const char *what)
{
    if (m_isBroken)
        return false;
    if (peek().kind != DbcToken::Word)
        return expected(what);
    *word = next().text;
    return true;
}

bool DbcReader::expectText(QString *text, const char *what)
{
    if (m_isBroken)
        return false;
    if (peek().kind != DbcToken::Text)
        return expected(what);
    *text = next().text;
    return true;
}

bool DbcReader::expectNumber(double *number, const char *what)
{
    if (m_isBroken)
        return false;
    if (peek().kind != DbcToken::Number)
        return expected(what);
    bool isNumber = false;
    *number = peek().text.toDouble(&isNumber);
    if (!isNumber || !std::isfinite(*number))
        return expected(what);
    next();
    return true;
}

bool DbcReader::expectInteger(qint64 *number, qint64 minimum, qint64 maximum, const char *what)
{
    if (m_isBroken)
        return false;
    bool isNumber = false;
    *number = peek().kind == DbcToken::Number ? peek().text.toLongLong(&isNumber) : 0;
    if (!isNumber)
        return expected(what);
    if (*number < minimum || *number > maximum)
        return fail(peek(),
                    QStringLiteral("%1 is %2; it has to be %3 ... %4")
                        .arg(QLatin1String(what), peek().text)
                        .arg(minimum)
                        .arg(maximum));
    next();
    return true;
}

bool DbcReader::expectUnsigned(quint64 *number, const char *what)
{
    if (m_isBroken)
        return false;
    bool isNumber = false;
    *number = peek().kind == DbcToken::Number ? peek().text.toULongLong(&isNumber) : 0;
    if (!isNumber)
        return expected(what);
    next();
    return true;
}

bool DbcReader::expectRole(DbcSignal *signal)
{
    if (m_isBroken)
        return false;
    if (peek().kind != DbcToken::Word)
        return true;
    const DbcToken token = next();
    signal->isMultiplexor = token.text.endsWith(QLatin1Char('M'));
    if (token.text == QLatin1String("M"))
        return true;
    bool isNumber = false;
    const int digits = token.text.size() - (signal->isMultiplexor ? 2 : 1);
    const quint64 value = token.text.mid(1, digits).toULongLong(&isNumber);
    signal->pages = {{value, value}};
    if (!isNumber || token.text.at(0) != QLatin1Char('m'))
        return fail(token,
                    QStringLiteral("%1 behind the name of signal '%2'; use ':', M for a multiplexor, m with a "
                                   "number, m3 for example, or m3M for both")
                        .arg(token.shown(), signal->name));
    return true;
}

// Read as words, 3-7 is the number 3 and the number -7.
bool DbcReader::expectPages(QVector<DbcSignal::Range> *pages)
{
    do {
        const DbcToken at = peek();
        DbcSignal::Range range;
        qint64 last = 0;
        if (!expectUnsigned(&range.first, "the first value of a range of the multiplexor, as in 3-5")
            || !expectInteger(&last, -std::numeric_limits<qint64>::max(), 0,
                              "the last value of the range, with a '-' in front"))
            return false;
        range.last = quint64(-last);
        if (range.last < range.first)
            return fail(at,
                        QStringLiteral("the range %1-%2 is empty; write the smaller value first")
                            .arg(range.first)
                            .arg(range.last));
        pages->append(range);
    } while (takes(','));
    return true;
}

bool DbcReader::expectPlace(DbcSignal *signal)
{
    qint64 start = 0;
    qint64 length = 0;
    if (!expectInteger(&start, 0, 8 * DbcFile::LongestMessage - 1, "the start bit of the signal")
        || !expectSign('|', "'|' behind the start bit: write start|length@order sign, 8|16@1- for example")
        || !expectInteger(&length, 1, 64, "the length of the signal in bits")
        || !expectSign('@', "'@' behind the length: write start|length@order sign, 8|16@1- for example"))
        return false;
    signal->start = int(start);
    signal->length = int(length);
    return expectByteOrder(signal) && expectScale(signal);
}

bool DbcReader::expectByteOrder(DbcSignal *signal)
{
    qint64 order = 0;
    if (!expectInteger(&order, 0, 1, "the byte order (1: little endian, Intel; 0: big endian, Motorola)"))
        return false;
    signal->byteOrder = order == 1 ? DbcSignal::Intel : DbcSignal::Motorola;
    if (takes('-'))
        signal->kind = DbcSignal::Signed;
    else if (peek().isWord("f")) {
        next();
        signal->kind = signal->length == 64 ? DbcSignal::Float64 : DbcSignal::Float32;
    } else
        return expectSign('+', "'+' (without sign) or '-' (with sign) behind the byte order");
    return true;
}

bool DbcReader::expectScale(DbcSignal *signal)
{
    if (takes('(')) {
        const DbcToken token = peek();
        if (!expectNumber(&signal->factor, "the factor") || !expectSign(',', "',' between factor and offset")
            || !expectNumber(&signal->offset, "the offset") || !expectSign(')', "')' behind the offset"))
            return false;
        if (signal->factor == 0.0)
            return fail(token, QStringLiteral("the factor is 0; all values would be the same"));
    }
    if (takes('[')
        && (!expectNumber(&signal->minimum, "the minimum") || !expectSign('|', "'|' between minimum and maximum")
            || !expectNumber(&signal->maximum, "the maximum") || !expectSign(']', "']' behind the maximum")))
        return false;
    if (!m_isBroken && peek().kind == DbcToken::Text)
        signal->unit = next().text;
    return !m_isBroken;
}

void DbcReader::skipStatement()
{
    while (!atEnd() && !peek().isSign(';') && peek().kind != DbcToken::Broken)
        next();
    if (peek().isSign(';'))
        next();
    else if (!m_isBroken)
        expected("';' at the end of the statement");
}

void DbcReader::skipToLine(bool (*isKeyword)(const QString &word))
{
    while (!atEnd() && !(peek().kind == DbcToken::Word && peek().isFirst && isKeyword(peek().text)))
        next();
}

}  // namespace qplc
