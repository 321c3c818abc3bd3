// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMessage.h"
#include "QPlcSignalTable.h"
#include "node/session/ControlClient.h"

#include <QtCore/QObject>

#include <chrono>
#include <optional>

namespace tools {

/// Whether cycles run in this state of a master.
bool hasCycles(const QString &state);

/// A tool at the control channel of a master that waits for each answer. Takes no part in the cycle.
class BlockingClient : public QObject
{
    Q_OBJECT
public:
    enum Error {
        NoError,
        Unreachable,  ///< nobody there, or no QtPLC master
        Refused,      ///< the master said no: errorString() is its sentence
        Lost          ///< the connection ended, or no answer came in time
    };

    /// \param timeout  longest wait for the greeting and for each answer
    explicit BlockingClient(std::chrono::milliseconds timeout);

    /// Tells what comes unasked, and what offers features of the protocol before connectToMaster().
    qplc::ControlClient &control() { return m_control; }
    /// Connects and greets. \return false when there is no master, or when it refuses
    bool connectToMaster(const QPlcUnderlyingProtocol &master);
    /// Sends \a request and waits for its answer.
    /// \return false when the master refused or was lost; \a answer is untouched then
    bool ask(const QPlcMessage &request, QPlcMessage *answer = nullptr);
    /// As ask(), for a kind that an older master may not know: then errorString() says so.
    bool askFor(QPlcMessage::Kind request, QPlcMessage::Kind expected, const QJsonObject &fields, QPlcMessage *answer);

    template<typename Request>
    bool ask(const Request &request, typename qplc::AnswerTo<Request>::Type *answer)
    {
        QPlcMessage message;
        return ask(qplc::messages::toMessage(request), &message) && read(Request::kind, message, answer);
    }
    template<typename Request>
    bool askFor(const Request &request, typename Request::Answer *answer)
    {
        QPlcMessage message;
        const QPlcMessage sent = qplc::messages::toMessage(request);
        return askFor(sent.kind(), Request::Answer::kind, sent.fields(), &message)
            && read(Request::kind, message, answer);
    }

    /// The signal table of the master; empty when it cannot be read, errorString() says why then.
    QPlcSignalTable table();
    Error error() const { return m_error; }
    QString errorString() const { return m_errorString; }
    std::chrono::milliseconds timeout() const { return m_timeout; }

Q_SIGNALS:
    /// The connection has ended, or will never be: errorString() says why.
    void lost();

private:
    template<typename Answer>
    bool read(QPlcMessage::Kind request, const QPlcMessage &message, Answer *answer)
    {
        QString error;
        Answer received;
        if (message.kind() != Answer::kind || !qplc::messages::fromObject(message.fields(), &received, &error))
            return setUnknown(request);
        *answer = received;
        return true;
    }
    void end(qplc::ControlClient::Loss loss, const QString &reason);
    bool setUnknown(QPlcMessage::Kind request);
    bool setError(Error error, const QString &text);

    qplc::ControlClient m_control;
    std::chrono::milliseconds m_timeout;
    QString m_address;
    bool m_wasGreeted = false;
    Error m_error = NoError;
    QString m_errorString;
    QString m_refusal;  // code of the newest one
};

}  // namespace tools
