// SPDX-License-Identifier: Apache-2.0
#include "CanLog.h"

#include <QtCore/QList>

#include <cstdio>
#include <cstring>
#include <linux/can.h>

namespace qplc {

namespace {

constexpr qint64 nanoseconds = 1'000'000'000;
constexpr int fdBitRateSwitch = 1;
constexpr int fdErrorPassive = 2;

/// Reads one line from left to right; the first thing that is wrong is kept.
class CanLogScanner
{
public:
    CanLogScanner(const QByteArray &text, QPlcParseError *error)
        : m_text(text)
        , m_error(error)
    {
    }

    bool line(CanLogLine *line)
    {
        return expect('(', "'(' and the time") && time(&line->time) && expect(')', "')' behind the time")
            && word(&line->interface) && id(&line->frame) && content(&line->frame) && end();
    }

private:
    char at(int offset = 0) const
    {
        return m_position + offset < m_text.size() ? m_text.at(m_position + offset) : '\0';
    }
    bool fail(const QString &message)
    {
        m_error->column = m_position + 1;
        m_error->message = message;
        return false;
    }
    bool fail(const char *expected)
    {
        return fail(QStringLiteral("%1 instead of %2")
                        .arg(m_position < m_text.size() ? QStringLiteral("'%1'").arg(QLatin1Char(at()))
                                                        : QStringLiteral("the end of the line"),
                             QLatin1String(expected)));
    }
    bool expect(char character, const char *what)
    {
        if (at() != character)
            return fail(what);
        ++m_position;
        return true;
    }

    static bool isDigit(char character) { return character >= '0' && character <= '9'; }
    static int hexDigit(char character)
    {
        if (isDigit(character))
            return character - '0';
        const char lower = char(character | 0x20);
        return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
    }

    bool time(qint64 *time)
    {
        const int begin = m_position;
        qint64 seconds = 0;
        for (; isDigit(at()) && m_position - begin < 10; ++m_position)
            seconds = seconds * 10 + (at() - '0');
        if (m_position == begin || at() != '.')
            return fail("the time in seconds, 1436509052.249713 for example");
        ++m_position;
        qint64 unit = nanoseconds;
        *time = seconds * nanoseconds;
        for (; isDigit(at()) && unit > 1; ++m_position) {
            unit /= 10;
            *time += (at() - '0') * unit;
        }
        return unit < nanoseconds || fail("digits behind the point");
    }

    bool word(QString *word)
    {
        while (at() == ' ')
            ++m_position;
        const int begin = m_position;
        while (at() != ' ' && at() != '\0')
            ++m_position;
        *word = QString::fromLatin1(m_text.constData() + begin, m_position - begin);
        if (word->isEmpty())
            return fail("the name of the interface");
        while (at() == ' ')
            ++m_position;
        return true;
    }

    bool id(CanFrame *frame)
    {
        const int begin = m_position;
        quint32 id = 0;
        for (; hexDigit(at()) >= 0 && m_position - begin < 8; ++m_position)
            id = id << 4 | quint32(hexDigit(at()));
        const int digits = m_position - begin;
        if (digits != 3 && digits != 8)
            return fail(QStringLiteral("the id has %1 digits; it has 3, or 8 if it is extended").arg(digits));
        const quint32 largest = digits == 3 ? CAN_SFF_MASK : CAN_ERR_FLAG | CAN_EFF_MASK;
        if (id > largest)
            return fail(QStringLiteral("the id is larger than 0x%1").arg(largest, 0, 16));
        frame->flags = digits == 3 ? 0 : (id & CAN_ERR_FLAG) ? CanFrame::Error : CanFrame::Extended;
        frame->id = id & CAN_EFF_MASK;
        return expect('#', "'#' behind the id");
    }

    bool content(CanFrame *frame)
    {
        if (at() == 'R' || at() == 'r')
            return remote(frame);
        if (at() != '#')
            return data(frame, 8);
        const int flags = hexDigit(at(1));
        m_position += 1;
        if (flags < 0)
            return fail("the flags of the frame of CAN FD, a digit");
        m_position += 1;
        frame->flags = quint8(frame->flags | CanFrame::Fd | ((flags & fdBitRateSwitch) ? CanFrame::BitRateSwitch : 0)
                              | ((flags & fdErrorPassive) ? CanFrame::ErrorPassive : 0));
        return data(frame, CanFrame::MaximumSize);
    }

    bool remote(CanFrame *frame)
    {
        ++m_position;
        frame->flags |= CanFrame::Remote;
        const int size = hexDigit(at());
        if (size < 0)
            return true;
        if (size > 8)
            return fail("the size, 0 ... 8");
        frame->size = quint8(size);
        ++m_position;
        return true;
    }

    bool data(CanFrame *frame, int largest)
    {
        while (hexDigit(at()) >= 0) {
            if (frame->size == largest)
                return fail(QStringLiteral("the frame has more than %1 bytes").arg(largest));
            if (hexDigit(at(1)) < 0) {
                ++m_position;
                return fail("the second digit of a byte");
            }
            frame->data[frame->size++] = quint8(hexDigit(at()) << 4 | hexDigit(at(1)));
            m_position += at(2) == '.' ? 3 : 2;
        }
        return CanFrame::isSize(frame->size, frame->has(CanFrame::Fd))
            || fail(QStringLiteral("no frame has %1 bytes").arg(frame->size));
    }

    // Behind the frame candump may say whether it was received or sent.
    bool end()
    {
        if (at() == ' ' && (at(1) == 'R' || at(1) == 'T'))
            m_position += 2;
        return m_position == m_text.size() || fail("the end of the line");
    }

    const QByteArray &m_text;
    QPlcParseError *m_error;
    int m_position = 0;
};

int fdFlagsOf(const CanFrame &frame)
{
    return (frame.has(CanFrame::BitRateSwitch) ? fdBitRateSwitch : 0)
        | (frame.has(CanFrame::ErrorPassive) ? fdErrorPassive : 0);
}

}  // namespace

QByteArray CanLog::text(const CanLogLine &line)
{
    const CanFrame &frame = line.frame;
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "(%010lld.%06lld) ", static_cast<long long>(line.time / nanoseconds),
                  static_cast<long long>(line.time % nanoseconds / 1000));
    QByteArray text = QByteArray(buffer) + line.interface.toLatin1();
    const bool hasLongId = frame.has(CanFrame::Extended) || frame.has(CanFrame::Error);
    std::snprintf(buffer, sizeof buffer, hasLongId ? " %08X#" : " %03X#",
                  frame.id | (frame.has(CanFrame::Error) ? CAN_ERR_FLAG : 0U));
    text += buffer;
    if (frame.has(CanFrame::Remote))
        return text + (frame.size > 0 ? "R" + QByteArray::number(frame.size) : "R") + '\n';
    if (frame.has(CanFrame::Fd))
        text += '#' + QByteArray::number(fdFlagsOf(frame));
    const QByteArray data(reinterpret_cast<const char *>(frame.data.data()), frame.size);
    return text + data.toHex().toUpper() + '\n';
}

bool CanLog::parse(const QByteArray &text, CanLogLine *line, QPlcParseError *error)
{
    const QByteArray trimmed = text.trimmed();
    return CanLogScanner(trimmed, error).line(line);
}

QVector<CanLogLine> CanLog::read(const QByteArray &text, const QString &fileName, QVector<QPlcParseError> *errors)
{
    QVector<CanLogLine> lines;
    int number = 0;
    for (int begin = 0; begin < text.size() && errors->size() < MaximumErrors;) {
        int end = text.indexOf('\n', begin);
        end = end < 0 ? text.size() : end;
        const QByteArray one = text.mid(begin, end - begin);
        begin = end + 1;
        ++number;
        CanLogLine line;
        QPlcParseError error{fileName, number, 0, QString()};
        if (one.trimmed().isEmpty())
            continue;
        if (parse(one, &line, &error))
            lines.append(line);
        else
            errors->append(error);
    }
    return lines;
}

}  // namespace qplc
