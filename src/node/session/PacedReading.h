// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcAbstractSocket.h"
#include "protocol/ControlFrame.h"

#include <functional>

namespace qplc {

/// Reads a control connection message by message, when its owner wants to. Other connections give
/// away what comes as it comes.
class PacedReading
{
public:
    /// From now on \a onArrival is called when there may be something to read, and nothing is read
    /// before next().
    static void begin(QPlcAbstractSocket &socket, std::function<void()> onArrival);
    /// A message of more than UsualControlFrame bytes is read only if its kind \a mayBeLong, and
    /// only while \a admits says so, which gets its length. Whoever was not admitted is read again
    /// with next().
    static void setLong(QPlcAbstractSocket &socket, bool (*mayBeLong)(QPlcMessage::Kind),
                        std::function<bool(quint32)> admits);
    /// Emits messageReceived() for the next message. A receiver may delete the connection.
    /// \return false if there is no message, or if the other end does not read its answers
    static bool next(QPlcAbstractSocket &socket);
    /// Takes the next message unread if it is whole and takes long to be read. Its owner reads it
    /// elsewhere, gives it back, and calls neither next() nor takeLong() before.
    static bool takeLong(QPlcAbstractSocket &socket, UnreadControlFrame *frame);
    /// Emits messageReceived() for what takeLong() has taken. A receiver may delete the connection.
    static void giveLong(QPlcAbstractSocket &socket, const QPlcMessage &message);
    /// Ends the connection: what takeLong() has taken is no message.
    static void refuseLong(QPlcAbstractSocket &socket, ControlFrameReader::Error error, const QString &text);
    /// See ControlFrameReader::takeAhead(). Works also when the other end takes in no answers.
    static bool takeAhead(QPlcAbstractSocket &socket, bool (*isUrgent)(QPlcMessage::Kind), QPlcMessage *message);
    /// Whether the message at hand was taken ahead.
    static bool wasTakenAhead(const QPlcAbstractSocket &socket);
    /// Whether one behind it was.
    static bool isOvertaken(const QPlcAbstractSocket &socket);
    /// Sends a message whose fields are \a json and \a end already. However slowly the other end
    /// reads, \a end is not copied as a whole. \return false when they are too long
    static bool send(QPlcAbstractSocket &socket, QPlcMessage::Kind kind, const QByteArray &json,
                     const QByteArray &end = {});
};

}  // namespace qplc
