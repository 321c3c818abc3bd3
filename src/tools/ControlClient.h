// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMasterSocket.h"
#include "QPlcMessage.h"
#include "QPlcSignalTable.h"

#include <QtCore/QJsonArray>
#include <QtCore/QList>
#include <QtCore/QObject>

#include <chrono>

class QDeadlineTimer;

namespace tools {

/// Whether cycles run in this state of a master.
bool hasCycles(const QString &state);

/// A tool at the control channel of a master (docs/protocol.md): greets, asks, waits for the answer. Takes no part in the cycle.
class ControlClient : public QObject
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
    explicit ControlClient(std::chrono::milliseconds timeout);

    /// Offers a feature of the protocol; to be called before connectToMaster().
    void offer(const QString &feature) { m_features.append(feature); }
    /// Connects and greets. \return false when there is no master, or when it refuses
    bool connectToMaster(const QPlcUnderlyingProtocol &master);
    /// Sends \a request and waits for its answer. \return false when the master refused or was lost; \a answer is untouched then
    bool ask(const QPlcMessage &request, QPlcMessage *answer = nullptr);

    /// As ask(), for a kind that an older master may not know: then errorString() says so.
    bool askFor(QPlcMessage::Kind request, QPlcMessage::Kind expected, const QJsonObject &fields, QPlcMessage *answer);

    /// The signal table of the master; empty when it cannot be read, errorString() says why then.
    QPlcSignalTable table();
    Error error() const { return m_error; }
    QString errorString() const { return m_errorString; }
    std::chrono::milliseconds timeout() const { return m_timeout; }

Q_SIGNALS:
    /// The master has told something unasked, because of a feature.
    void pushed(const QPlcMessage &message);
    /// The connection has ended, or will never be: errorString() says why.
    void lost();

private:
    void greet();
    void receive(const QPlcMessage &message);
    void connectionLost(const QString &reason);
    bool waitForMessage(QDeadlineTimer deadline, QPlcMessage *message);
    bool setError(Error error, const QString &text);

    QPlcMasterSocket m_socket;
    std::chrono::milliseconds m_timeout;
    QString m_address;
    QJsonArray m_features;
    QPlcMessage m_hello;
    QList<QPlcMessage> m_inbox;
    Error m_error = NoError;
    QString m_errorString;
    QString m_refusal;  // code of the newest one
};

}  // namespace tools
