// SPDX-License-Identifier: Apache-2.0
#include "ControlFrame.h"

#include "LittleEndian.h"
#include "signals/JsonNames.h"

#include <QtCore/QJsonDocument>

#include <algorithm>

namespace qplc {

namespace {

constexpr int LengthSize = sizeof(quint32);
constexpr int KindSize = 1;

// Deepest nesting of arrays and objects in a JSON text. Counts right up to the first error of the
// text, which is as far as a parser gets.
int nestingDepth(const QByteArray &json)
{
    int depth = 0;
    int deepest = 0;
    const char *const text = json.constData();
    const int size = json.size();
    for (int i = 0; i < size; ++i) {
        const char character = text[i];
        if (character == '"') {
            for (++i; i < size && text[i] != '"'; ++i)
                i += text[i] == '\\' ? 1 : 0;
        } else if (character == '{' || character == '[') {
            deepest = std::max(deepest, ++depth);
        } else if (character == '}' || character == ']') {
            --depth;
        }
    }
    return deepest;
}

QString placeText(quint64 position)
{
    return QStringLiteral(" at byte %1 of the stream").arg(position);
}

QString jsonErrorText(const QJsonParseError &error)
{
    if (error.error == QJsonParseError::NoError)
        return QStringLiteral("its JSON is an array; an object is needed");
    return QStringLiteral("%1 at byte %2 of its JSON").arg(error.errorString()).arg(error.offset);
}

}  // namespace

QByteArray encodeControlFrame(const QPlcMessage &message, quint32 limit)
{
    const QByteArray json = QJsonDocument(message.fields()).toJson(QJsonDocument::Compact);
    return nestingDepth(json) > MaximumControlDepth ? QByteArray() : encodeControlFrame(message.kind(), json, limit);
}

QByteArray encodeControlFrame(QPlcMessage::Kind kind, const QByteArray &json, quint32 limit, int behind)
{
    const quint32 length = quint32(KindSize) + quint32(json.size()) + quint32(behind);
    if (length > limit)
        return QByteArray();

    QByteArray frame(LengthSize, Qt::Uninitialized);
    storeLittle(length, frame.data());
    frame.append(char(kind));
    frame.append(json);
    return frame;
}

void ControlFrameReader::append(const QByteArray &bytes)
{
    if (m_error != NoError)
        return;
    m_buffer.remove(0, m_begin);
    m_begin = 0;
    m_buffer.append(bytes);
}

/// Whether the next frame is there, of \a length behind its length field. A length that is not
/// allowed is an error.
bool ControlFrameReader::findWhole(quint32 *length)
{
    const int available = m_buffer.size() - m_begin;
    if (m_error != NoError || available < LengthSize)
        return false;
    *length = loadLittle<quint32>(m_buffer.constData() + m_begin);
    if (*length < quint32(KindSize))
        return fail(FrameTooShort,
                    QStringLiteral("control frame of 0 bytes%1; the kind needs one").arg(placeText(m_position)));
    if (m_mayBeLong && *length > UsualControlFrame && *length <= m_limit && available < LengthSize + KindSize)
        return false;  // its limit is not known yet
    if (const quint32 limit = limitAt(m_begin); *length > limit) {
        const QString text = QStringLiteral("control frame of %1 bytes%2; at most %3 are allowed");
        return fail(FrameTooLong, text.arg(*length).arg(placeText(m_position)).arg(limit));
    }
    return available - LengthSize >= int(*length);
}

/// The next frame, of \a bytes, is used.
void ControlFrameReader::pass(int bytes)
{
    m_wasTakenAhead = !m_ahead.empty() && m_ahead.front() == m_position;
    if (m_wasTakenAhead)
        m_ahead.pop_front();
    m_begin += bytes;
    m_position += quint64(bytes);
}

bool ControlFrameReader::next(QPlcMessage *message)
{
    quint32 length = 0;
    if (!findWhole(&length))
        return false;
    const UnreadControlFrame frame{m_buffer.mid(m_begin, LengthSize + int(length)), m_position};
    QString text;
    if (const Error error = read(frame, message, &text); error != NoError)
        return fail(error, text);
    pass(frame.bytes.size());
    m_lastFrame = frame.bytes;
    return true;
}

bool ControlFrameReader::takeLong(UnreadControlFrame *frame)
{
    quint32 length = 0;
    if (!findWhole(&length) || length <= ReadAtOnce)
        return false;
    const int size = LengthSize + int(length);
    const quint64 position = m_position;
    const bool isAll = m_begin == 0 && m_buffer.size() == size;  // to copy megabytes takes milliseconds
    const QByteArray bytes = isAll ? m_buffer : m_buffer.mid(m_begin, size);
    pass(size);
    if (isAll) {
        m_buffer = QByteArray();
        m_begin = 0;
    }
    *frame = {bytes, position};
    return true;
}

/// [byte] that the frame may have behind its length, which begins at \a begin of m_buffer. \pre its
/// kind is there, or it is not long
quint32 ControlFrameReader::limitAt(int begin) const
{
    if (!m_mayBeLong || m_limit <= UsualControlFrame || m_buffer.size() <= begin + LengthSize)
        return m_limit;
    const auto kind = QPlcMessage::Kind(quint8(m_buffer.at(begin + LengthSize)));
    return m_mayBeLong(kind) ? m_limit : UsualControlFrame;
}

quint32 ControlFrameReader::announced() const
{
    return waiting() < LengthSize ? 0 : loadLittle<quint32>(m_buffer.constData() + m_begin);
}

/// Whether the bytes of m_buffer from \a begin on hold a whole frame whose length is allowed.
bool ControlFrameReader::isComplete(int begin, quint32 *length) const
{
    const int available = m_buffer.size() - begin;
    if (available < LengthSize)
        return false;
    *length = loadLittle<quint32>(m_buffer.constData() + begin);
    return *length >= quint32(KindSize) && *length <= limitAt(begin) && int(*length) <= available - LengthSize;
}

bool ControlFrameReader::takeAhead(bool (*isUrgent)(QPlcMessage::Kind), QPlcMessage *message)
{
    m_lookedAt = std::max(m_lookedAt, m_position);
    quint32 length = 0;
    for (int begin; m_error == NoError && isComplete(begin = m_begin + int(m_lookedAt - m_position), &length);) {
        const quint64 position = m_lookedAt;
        m_lookedAt += quint64(LengthSize) + length;
        if (length > ReadAtOnce || !isUrgent(QPlcMessage::Kind(quint8(m_buffer.at(begin + LengthSize)))))
            continue;
        QString text;
        const UnreadControlFrame frame{m_buffer.mid(begin, LengthSize + int(length)), position};
        if (const Error error = read(frame, message, &text); error != NoError)
            return fail(error, text);
        m_ahead.push_back(position);
        return true;
    }
    return false;
}

QByteArray ControlFrameReader::takeRest()
{
    const QByteArray rest = m_buffer.mid(m_begin);
    m_position += quint64(rest.size());
    m_buffer.clear();
    m_begin = 0;
    return rest;
}

ControlFrameReader::Error ControlFrameReader::read(const UnreadControlFrame &unread, QPlcMessage *message,
                                                   QString *text)
{
    const QByteArray &frame = unread.bytes;
    const QPlcMessage::Kind kind = unread.kind();
    const int jsonBegin = LengthSize + KindSize;
    const QByteArray json = QByteArray::fromRawData(frame.constData() + jsonBegin, frame.size() - jsonBegin);
    if (json.isEmpty()) {
        *message = QPlcMessage(kind);
        return NoError;
    }

    const auto thing = [&] {
        return QStringLiteral("control frame (%1)%2").arg(QPlcMessage::kindName(kind), placeText(unread.position));
    };
    const int depth = nestingDepth(json);
    if (depth > MaximumControlDepth) {
        *text = QStringLiteral("%1: arrays and objects %2 deep; at most %3 are allowed")
                    .arg(thing())
                    .arg(depth)
                    .arg(MaximumControlDepth);
        return NestedTooDeep;
    }
    if (const std::optional<QString> name = doubledJsonName(json)) {
        *text = QStringLiteral("%1: the name '%2' stands twice in an object").arg(thing(), *name);
        return InvalidJson;
    }
    QJsonParseError error;
    const QJsonDocument document = QJsonDocument::fromJson(json, &error);
    if (!document.isObject()) {
        *text = QStringLiteral("%1: %2").arg(thing(), jsonErrorText(error));
        return InvalidJson;
    }
    *message = QPlcMessage(kind, document.object());
    return NoError;
}

bool ControlFrameReader::fail(Error error, const QString &text)
{
    m_error = error;
    m_errorString = text;
    return false;
}

}  // namespace qplc
