// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalTable.h"
#include "node/session/ControlClient.h"

#include <QtCore/QObject>

#include <chrono>
#include <optional>

namespace tools {

/// A tool at the control channel of a master that waits for each answer. Takes no part in the
/// cycle.
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

    /// An answer has at most 1 MiB, a signal up to 9 kB of values, and its description.
    static constexpr int SignalsPerAnswer = 100;

    /// \param timeout  longest wait for the greeting and for each answer
    explicit BlockingClient(std::chrono::milliseconds timeout);

    /// Tells what comes unasked, and what offers features of the protocol before connectToMaster().
    qplc::ControlClient &control() { return m_control; }
    /// Connects and greets. \return false when there is no master, or when it refuses
    bool connectToMaster(const QPlcUnderlyingProtocol &master);
    /// Sends \a request and waits for its answer.
    /// \return false when the master refused or was lost; \a answer is untouched then
    template<typename Request>
    bool ask(const Request &request, typename Request::Answer *answer = nullptr)
    {
        using Answer = typename Request::Answer;
        if (!exchange(qplc::messages::toMessage(request)))
            return false;
        const std::optional<Answer> received = qplc::messages::readAs<Answer>(m_answer);
        if (received && answer)
            *answer = *received;
        return received || setUnknown(Request::kind);
    }
    /// Asks how the signals \a names are, in so many questions that each answer is short enough.
    /// \return false when the master refused or was lost
    bool askForSignals(const QStringList &names, std::vector<qplc::messages::SignalEntry> *signals);
    /// As ask(), for a kind that an older master may not know: then errorString() says so.
    template<typename Request>
    bool askFor(const Request &request, typename Request::Answer *answer)
    {
        return ask(request, answer) || (isUnknownKind() && setUnknown(Request::kind));
    }
    /// The last answer as it came: also what this version does not know of it.
    QJsonDocument lastAnswer() const { return qplc::messages::jsonOf(m_answer); }

    /// The signal table of the master; empty when it cannot be read, errorString() says why then.
    QPlcSignalTable table();
    Error error() const { return m_error; }
    QString errorString() const { return m_errorString; }
    std::chrono::milliseconds timeout() const { return m_timeout; }

Q_SIGNALS:
    /// The connection has ended, or will never be: errorString() says why.
    void lost();

private:
    bool exchange(const QPlcMessage &request);
    bool isUnknownKind() const;
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
    QPlcMessage m_answer;
};

}  // namespace tools
