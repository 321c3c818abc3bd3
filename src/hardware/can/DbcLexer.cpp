// SPDX-License-Identifier: Apache-2.0
#include "DbcLexer.h"

namespace qplc {

namespace {

constexpr int longestShown = 40;

bool isDbcLetter(QChar character)
{
    return character.isLetter() || character == QLatin1Char('_');
}

bool isDbcDigit(QChar character)
{
    return character >= QLatin1Char('0') && character <= QLatin1Char('9');
}

}  // namespace

QString DbcToken::shown() const
{
    switch (kind) {
    case End:
        return QStringLiteral("the end of the file");
    case Broken:
        return QStringLiteral("a text without a closing '\"'");
    case Text:
        return QStringLiteral("the text \"%1\"").arg(text.left(longestShown));
    default:
        return QStringLiteral("'%1'").arg(text.left(longestShown));
    }
}

DbcLexer::DbcLexer(const QString &text)
    : m_text(text)
{
    if (m_text.startsWith(QChar(0xFEFF)))
        m_position = 1;  // byte order mark
    advance();
}

DbcToken DbcLexer::next()
{
    const DbcToken token = m_next;
    if (token.kind != DbcToken::End)
        advance();
    return token;
}

QChar DbcLexer::at(int offset) const
{
    const int position = m_position + offset;
    return position < m_text.size() ? m_text.at(position) : QChar();
}

void DbcLexer::step()
{
    if (m_text.at(m_position) == QLatin1Char('\n')) {
        ++m_line;
        m_column = 0;
        m_isLineBegin = true;
    }
    ++m_column;
    ++m_position;
}

void DbcLexer::skipBlanks()
{
    while (m_position < m_text.size() && m_text.at(m_position).isSpace())
        step();
}

int DbcLexer::wordLength() const
{
    int length = 0;
    while (isDbcLetter(at(length)) || (length > 0 && isDbcDigit(at(length))))
        ++length;
    return length;
}

// Of an integer or a real with its sign; 0 when none begins here.
int DbcLexer::numberLength() const
{
    const auto isSign = [this](int offset) { return at(offset) == QLatin1Char('-') || at(offset) == QLatin1Char('+'); };
    int length = isSign(0) ? 1 : 0;
    const int begin = length;
    while (isDbcDigit(at(length)) || at(length) == QLatin1Char('.'))
        ++length;
    if (length == begin)
        return 0;
    if (at(length) == QLatin1Char('e') || at(length) == QLatin1Char('E')) {
        const int digits = isSign(length + 1) ? length + 2 : length + 1;
        if (isDbcDigit(at(digits))) {
            length = digits;
            while (isDbcDigit(at(length)))
                ++length;
        }
    }
    return length;
}

void DbcLexer::takeText()
{
    m_next.kind = DbcToken::Broken;
    step();
    while (m_position < m_text.size() && m_next.kind == DbcToken::Broken) {
        const QChar character = at();
        if (character == QLatin1Char('"'))
            m_next.kind = DbcToken::Text;
        else if (character == QLatin1Char('\\') && (at(1) == QLatin1Char('"') || at(1) == QLatin1Char('\\')))
            step();
        if (m_next.kind == DbcToken::Broken)
            m_next.text += at();
        step();
    }
}

void DbcLexer::advance()
{
    skipBlanks();
    m_next = DbcToken();
    m_next.line = m_line;
    m_next.column = m_column;
    m_next.isFirst = m_isLineBegin;
    m_isLineBegin = false;
    if (m_position >= m_text.size())
        return;
    if (at() == QLatin1Char('"')) {
        takeText();
        return;
    }
    int length = wordLength();
    m_next.kind = length > 0 ? DbcToken::Word : DbcToken::Number;
    if (length == 0)
        length = numberLength();
    if (length == 0) {
        m_next.kind = DbcToken::Sign;
        length = 1;
    }
    m_next.text = m_text.mid(m_position, length);
    m_position += length;
    m_column += length;
}

}  // namespace qplc
