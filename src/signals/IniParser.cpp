// SPDX-License-Identifier: Apache-2.0
#include "IniParser.h"

#include "BoundedRead.h"
#include "MessageText.h"
#include "Utf8.h"

#include <QtCore/QFile>

namespace qplc {

namespace {

bool isBlank(char character)
{
    return character == ' ' || character == '\t';
}

int skipBlanks(const QByteArray &line, int position)
{
    while (position < line.size() && isBlank(line.at(position)))
        ++position;
    return position;
}

// The text [begin, end) without blanks at its end.
QString trimmedText(const QByteArray &line, int begin, int end)
{
    while (end > begin && isBlank(line.at(end - 1)))
        --end;
    return QString::fromUtf8(line.constData() + begin, end - begin);
}

int columnOf(const QByteArray &line, int position)
{
    return utf8Characters(line.constData(), position) + 1;
}

void setError(IniItem *item, const QByteArray &line, int position, const QString &error)
{
    item->error = error;
    item->errorColumn = columnOf(line, position);
}

// Position of the first control character other than a tab, -1 when there is none.
int firstControlCharacter(const QByteArray &line)
{
    for (int i = 0; i < line.size(); ++i) {
        const auto byte = static_cast<unsigned char>(line.at(i));
        if ((byte < 0x20 && byte != '\t') || byte == 0x7F)
            return i;
    }
    return -1;
}

QString hex(char byte)
{
    return QString::asprintf("0x%02X", unsigned(static_cast<unsigned char>(byte)));
}

void readSection(const QByteArray &line, int begin, IniItem *item)
{
    item->kind = IniItem::Section;
    item->column = columnOf(line, begin + 1);
    const int end = line.indexOf(']', begin);
    if (end < 0) {
        setError(item, line, line.size(), QStringLiteral("']' is missing; write the section as [name]"));
        return;
    }
    item->name = QString::fromUtf8(line.constData() + begin + 1, end - begin - 1);
    const int rest = skipBlanks(line, end + 1);
    if (rest < line.size() && line.at(rest) != ';')
        setError(item, line, rest,
                 QStringLiteral("stray characters %1 behind ']'; remove them, or begin a comment with ';'")
                     .arg(quoted(trimmedText(line, rest, line.size()))));
}

// The character that `\` and `escape` stand for, 0 when they stand for none.
char escapedCharacter(char escape)
{
    switch (escape) {
    case 'n':
        return '\n';
    case 'r':
        return '\r';
    case 't':
        return '\t';
    case '"':
    case '\\':
        return escape;
    default:
        return '\0';
    }
}

void readQuotedValue(const QByteArray &line, int begin, IniItem *item)
{
    QByteArray value;
    int position = begin + 1;
    for (; position < line.size() && line.at(position) != '"'; ++position) {
        char character = line.at(position);
        if (character == '\\') {
            character = position + 1 < line.size() ? escapedCharacter(line.at(position + 1)) : '\0';
            if (character == '\0') {
                setError(item, line, position,
                         QStringLiteral("'\\' must stand before n, r, t, \" or \\; write '\\\\'"));
                return;
            }
            ++position;
        }
        value.append(character);
    }
    if (position == line.size()) {
        setError(item, line, begin, QStringLiteral("the quotation is not closed; end it with '\"'"));
        return;
    }
    item->value = QString::fromUtf8(value);
    const int rest = skipBlanks(line, position + 1);
    if (rest < line.size() && line.at(rest) != ';')
        setError(item, line, rest,
                 QStringLiteral("stray characters %1 behind the quotation; write '\\\"' for a quotation mark inside it")
                     .arg(quoted(trimmedText(line, rest, line.size()))));
}

void readPlainValue(const QByteArray &line, int begin, IniItem *item)
{
    int end = begin;
    while (end < line.size() && (line.at(end) != ';' || (end > begin && !isBlank(line.at(end - 1)))))
        ++end;
    item->value = trimmedText(line, begin, end);
}

void readEntry(const QByteArray &line, int begin, IniItem *item)
{
    const int equals = line.indexOf('=', begin);
    item->column = columnOf(line, begin);
    if (equals < 0) {
        setError(item, line, begin,
                 QStringLiteral("%1 is neither [name] nor key = value; begin a comment with ';'")
                     .arg(quoted(trimmedText(line, begin, line.size()))));
        return;
    }
    item->name = trimmedText(line, begin, equals);
    if (item->name.isEmpty()) {
        setError(item, line, begin, QStringLiteral("the key before '=' is missing; write key = value"));
        return;
    }
    item->kind = IniItem::Entry;
    const int value = skipBlanks(line, equals + 1);
    item->valueColumn = columnOf(line, value);
    if (value < line.size() && line.at(value) == '"')
        readQuotedValue(line, value, item);
    else
        readPlainValue(line, value, item);
}

}  // namespace

IniParser::IniParser(const QByteArray &text)
    : m_text(text)
{
    if (m_text.startsWith("\xEF\xBB\xBF"))
        m_position = 3;
}

IniItem IniParser::next()
{
    while (m_position < m_text.size()) {
        IniItem item;
        if (readLine(takeLine(), &item))
            return item;
    }
    return IniItem();
}

// The next line without its end. It shares the memory of the text.
QByteArray IniParser::takeLine()
{
    const int end = m_text.indexOf('\n', m_position);
    int size = (end < 0 ? m_text.size() : end) - m_position;
    const int begin = m_position;
    m_position = end < 0 ? m_text.size() : end + 1;
    ++m_line;
    if (size > 0 && m_text.at(begin + size - 1) == '\r')
        --size;
    return QByteArray::fromRawData(m_text.constData() + begin, size);
}

// False for a line that says nothing.
bool IniParser::readLine(const QByteArray &line, IniItem *item)
{
    const int begin = skipBlanks(line, 0);
    if (begin == line.size())
        return false;
    item->line = m_line;
    item->kind = line.at(begin) == '[' ? IniItem::Section : IniItem::Broken;
    item->column = columnOf(line, begin);
    if (refuseBytes(line, item))
        return true;
    if (line.at(begin) == ';' || line.at(begin) == '#')
        return false;
    if (line.at(begin) == '[')
        readSection(line, begin, item);
    else
        readEntry(line, begin, item);
    return true;
}

// Whether the bytes of a line are no text that this parser reads; the reason is then in `item`.
bool IniParser::refuseBytes(const QByteArray &line, IniItem *item)
{
    const bool isUtf16 = m_line == 1 && (m_text.startsWith("\xFF\xFE") || m_text.startsWith("\xFE\xFF"));
    const int zero = line.indexOf('\0');
    if (isUtf16 || zero >= 0) {
        m_position = m_text.size();
        setError(item, line, isUtf16 ? 0 : zero,
                 isUtf16 ? QStringLiteral("the file is UTF-16; save it as UTF-8")
                         : QStringLiteral("byte 0x00: this is not text; give a file in UTF-8"));
        return true;
    }
    if (line.size() > MaximumLine) {
        setError(item, line, 0,
                 QStringLiteral("the line has %1 bytes; shorten it to at most %2").arg(line.size()).arg(MaximumLine));
        return true;
    }
    const int invalid = firstInvalidUtf8(line.constData(), line.size());
    if (invalid >= 0) {
        setError(item, line, invalid,
                 QStringLiteral("byte %1 is not UTF-8; save the file as UTF-8").arg(hex(line.at(invalid))));
        return true;
    }
    const int control = firstControlCharacter(line);
    if (control >= 0) {
        setError(item, line, control,
                 line.at(control) == '\r'
                     ? QStringLiteral("a carriage return without line feed; end lines with LF or CRLF")
                     : QStringLiteral("control character %1; remove it").arg(hex(line.at(control))));
        return true;
    }
    return false;
}

bool IniParser::readFile(const QString &fileName, const QString &what, qint64 largest, QByteArray *text,
                         QVector<QPlcParseError> *errors)
{
    QString error;
    QFile file(fileName);
    if (fileName.isEmpty()) {
        error = QStringLiteral("the name of the file is empty; give the path of %1").arg(what);
    } else if (!file.open(QIODevice::ReadOnly)) {
        error = QStringLiteral("cannot open: %1; give the path of %2").arg(file.errorString(), what);
    } else {
        *text = readBounded(&file, largest);
        if (file.error() != QFileDevice::NoError)
            error = QStringLiteral("cannot read: %1").arg(file.errorString());
        else if (text->size() > largest)
            error = QStringLiteral("has more than %1 bytes; give %2, which has fewer").arg(largest).arg(what);
    }
    if (errors && !error.isEmpty())
        *errors = {{fileName, 0, 0, error}};
    return error.isEmpty();
}

QString IniParser::valueText(const QString &value)
{
    const auto isBlankAt
        = [&value](int i) { return value.at(i) == QLatin1Char(' ') || value.at(i) == QLatin1Char('\t'); };
    bool needsQuotes = !value.isEmpty()
        && (value.startsWith(QLatin1Char('"')) || value.startsWith(QLatin1Char(';')) || isBlankAt(0)
            || isBlankAt(value.size() - 1));
    QString inside;
    for (int i = 0; i < value.size(); ++i) {
        const QChar character = value.at(i);
        if (character == QLatin1Char('\n'))
            inside += QStringLiteral("\\n");
        else if (character == QLatin1Char('\r'))
            inside += QStringLiteral("\\r");
        else if (character == QLatin1Char('\t'))
            inside += QStringLiteral("\\t");
        else if (character == QLatin1Char('"') || character == QLatin1Char('\\'))
            inside += QLatin1Char('\\') + QString(character);
        else
            inside += character;
        const bool isComment = character == QLatin1Char(';') && i > 0 && isBlankAt(i - 1);
        needsQuotes = needsQuotes || isComment || character.unicode() < 0x20;
    }
    return needsQuotes ? QLatin1Char('"') + inside + QLatin1Char('"') : value;
}

}  // namespace qplc
