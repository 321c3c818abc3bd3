// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMasterSocket.h"

#include <QtCore/QObject>
#include <QtCore/QQueue>

#include <functional>
#include <optional>

class QTimer;

namespace qplc {

/// A tool at the control channel of a master (docs/protocol.md) that never waits: answers come to functions, everything else as Qt signals.
///
/// Commands go out one after another, so that each gets its own answer; Stop waits for none. A master that leaves a question without an answer for longer than
/// AnswerTime is lost. One connection at a time; connectToMaster() may be called again and again.
class ControlChannel : public QObject
{
    Q_OBJECT
public:
    using Message = QPlcMessage;
    using Handler = std::function<void(const Message &answer)>;

    static constexpr int AnswerTime = 5000;     // [ms] for the greeting and for questions
    static constexpr int CommandTime = 60'000;  // [ms] for commands, which may wait for nodes

    explicit ControlChannel(QObject *parent = nullptr);
    ~ControlChannel() override;

    /// The time for answers to questions [ms], AnswerTime unless set.
    void setAnswerTime(int milliseconds) { m_answerTime = milliseconds; }

    /// How both ends know each other; none: as the process does (QPlcSecurity::current()). Takes effect with connectToMaster().
    void setSecurity(const std::optional<QPlcSecurity> &security) { m_security = security; }
    /// Begins to connect; greeted() or lost() follows.
    void connectToMaster(const QPlcUnderlyingProtocol &master);
    /// Ends the connection without a word. Who waits for an answer gets Failed.
    void close();
    bool isGreeted() const { return m_isGreeted; }
    /// Whether the last attempt reached a master, with which this window cannot work: of another version, say.
    bool isRefused() const { return m_isRefused; }

    /// Asks GetState, GetSignals, GetStatistics, GetSchedule, GetLeases or GetEvents. \a handler gets the answer, or Failed.
    void ask(const Message &question, const Handler &handler);
    /// Sends anything else; \a handler gets Done, or Failed with `text`.
    void command(const Message &command, const Handler &handler);
    /// Whether a command waits for its answer. Questions other than GetState should not be asked meanwhile: nobody could tell their refusal from that of the command.
    bool isBusy() const;

Q_SIGNALS:
    void greeted(const QPlcMessage &hello);
    /// The connection has ended, or could not be made. \param reason  half a sentence
    void lost(const QString &reason);
    /// The master has said something without being asked: StatesInitialized, LeasesChanged, Events, ...
    void pushed(const QPlcMessage &message);

private:
    struct Request
    {
        Message message;
        Handler handler;
        qint64 sent = 0;  // [ms] on m_clock
    };

    void receive(const Message &message);
    void receiveHello(const Message &message);
    void answer(const Message &message);
    int requestFor(Message::Kind answer) const;
    void send(const Request &request);
    void sendNextCommand();
    void checkAnswerTimes();
    void end(const QString &reason);
    void refuse(const QString &form, const Message &message);
    static bool isQuestion(Message::Kind kind);

    QPlcMasterSocket *m_socket = nullptr;
    std::optional<QPlcSecurity> m_security;
    QTimer *m_timer;
    bool m_isGreeted = false;
    bool m_isRefused = false;
    int m_answerTime = AnswerTime;
    qint64 m_begin = 0;  // [ms] of the attempt
    QQueue<Request> m_sent;
    QQueue<Request> m_waiting;  // commands
};

}  // namespace qplc
