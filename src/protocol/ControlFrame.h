// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMessage.h"

#include <QtCore/QByteArray>

#include <deque>

namespace qplc {

/// Largest control frame behind its length field [byte] on a connection that has agreed on no other
/// one, and of every answer to a question.
constexpr quint32 UsualControlFrame = 1024 * 1024;
/// Largest one of all: what a client takes from its master, for the sake of large tables.
constexpr quint32 MaximumControlFrame = 64 * 1024 * 1024;
/// Deepest nesting of arrays and objects in the JSON of a control frame.
constexpr int MaximumControlDepth = 16;

/// The bytes of \a message on the wire; empty when it is longer than \a limit or nested deeper than
/// MaximumControlDepth, which no receiver would take.
QByteArray encodeControlFrame(const QPlcMessage &message, quint32 limit = UsualControlFrame);

/// The bytes of a message whose fields are \a json already; empty when they are too long.
/// \param behind  bytes of the fields that are sent behind these
QByteArray encodeControlFrame(QPlcMessage::Kind kind, const QByteArray &json, quint32 limit = UsualControlFrame,
                              int behind = 0);

/// A control frame that was cut out of its stream, and not read yet.
struct UnreadControlFrame
{
    QByteArray bytes;      // all of it
    quint64 position = 0;  // [byte] of the stream at which it begins

    /// \pre it is not empty
    QPlcMessage::Kind kind() const { return QPlcMessage::Kind(quint8(bytes.at(int(sizeof(quint32))))); }
};

/// Cuts a byte stream into control messages. Nothing is allocated for a frame before its length has
/// been checked.
///
/// After an error the stream is lost: the reader stays in the error state and the connection has to
/// be closed.
class ControlFrameReader
{
public:
    enum Error {
        NoError,
        FrameTooLong,   ///< length beyond the limit
        FrameTooShort,  ///< length 0: not even a kind
        NestedTooDeep,
        InvalidJson  ///< not UTF-8, not JSON, not an object, or a name stands twice in one
    };

    /// To read a longer message takes milliseconds [byte].
    static constexpr quint32 ReadAtOnce = 64 * 1024;

    /// Frames behind those that were taken already may have so many bytes behind their length
    /// field; UsualControlFrame unless set.
    void setLimit(quint32 bytes) { m_limit = bytes; }
    /// Only frames of kinds that \a mayBeLong may have more than UsualControlFrame bytes, as far as
    /// the limit allows; all kinds unless set.
    void setLongKinds(bool (*mayBeLong)(QPlcMessage::Kind)) { m_mayBeLong = mayBeLong; }
    /// Takes bytes of the stream.
    void append(const QByteArray &bytes);
    /// Takes the next complete message. \return false when there is none (yet), or error() is set
    bool next(QPlcMessage *message);
    /// Takes the next message as it is, if it is complete and has more than ReadAtOnce bytes.
    /// fail() is for the one who reads it later.
    bool takeLong(UnreadControlFrame *frame);
    /// Reads what takeLong() has taken. \return NoError, or what is wrong with it, with a sentence
    /// in \a text. \threadsafe yes
    static Error read(const UnreadControlFrame &frame, QPlcMessage *message, QString *text);
    /// From now on there is this error.
    bool fail(Error error, const QString &text);
    /// Takes the next complete message of a kind that \a isUrgent, and that is not long, before
    /// those in front of it. next() gives it once more when it comes to its place: wasTakenAhead()
    /// is true then.
    bool takeAhead(bool (*isUrgent)(QPlcMessage::Kind), QPlcMessage *message);
    /// Whether next() has returned a message that takeAhead() has returned before.
    bool wasTakenAhead() const { return m_wasTakenAhead; }
    /// Whether a message behind the one of next() was taken ahead.
    bool isOvertaken() const { return !m_ahead.empty(); }
    /// Length of the message that next() waits for [byte]; 0: it is not known yet.
    quint32 announced() const;
    /// Bytes that no message has used [byte].
    int waiting() const { return m_buffer.size() - m_begin; }
    /// Exact bytes of the message that next() returned last, for the debug log.
    QByteArray lastFrame() const { return m_lastFrame; }
    /// Bytes of the stream that no message has used: what follows the control messages on a cyclic
    /// TCP connection.
    QByteArray takeRest();

    Error error() const { return m_error; }
    /// "control frame of 4294967295 bytes at byte 120 of the stream; at most 1048576 are allowed"
    QString errorString() const { return m_errorString; }

private:
    quint32 limitAt(int begin) const;
    bool isComplete(int begin, quint32 *length) const;
    bool findWhole(quint32 *length);
    void pass(int bytes);

    quint32 m_limit = UsualControlFrame;               // [byte]
    bool (*m_mayBeLong)(QPlcMessage::Kind) = nullptr;  // null: all
    QByteArray m_buffer;
    int m_begin = 0;  // [byte] of m_buffer: what is before it has been used
    QByteArray m_lastFrame;
    quint64 m_position = 0;       // [byte] of the stream at m_begin
    quint64 m_lookedAt = 0;       // [byte] of the stream: takeAhead() knows what is before
    std::deque<quint64> m_ahead;  // [byte] of the stream: where messages begin that were taken ahead
    bool m_wasTakenAhead = false;
    Error m_error = NoError;
    QString m_errorString;
};

}  // namespace qplc
