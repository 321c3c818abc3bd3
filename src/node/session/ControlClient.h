// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMasterSocket.h"
#include "protocol/messages/MessageTable.h"

#include <QtCore/QList>
#include <QtCore/QObject>
#include <QtCore/QTimer>

#include <chrono>
#include <cstdint>
#include <functional>
#include <variant>

namespace qplc {

/// The client side of the control channel (docs/protocol.md, section 5). It never waits: answers go
/// to functions.
///
/// \code
/// ControlClient client({"qtplc", messages::Part::Tool, {"events"}});
/// connect(&client, &ControlClient::greeted, [&] {
///     client.request(messages::GetState(), [](const ControlClient::Reply<messages::GetState> &reply) {
///         if (const auto *state = std::get_if<messages::State>(&reply))
///             show(state->state);
///         else
///             show(std::get<messages::Failed>(reply).text);
///     });
/// });
/// client.connectToMaster(address);
/// \endcode
///
/// Commands go out one after another, so that each gets its own answer; questions, Stop and
/// SafeStop do not wait for them. The connection ends when an answer does not come in time.
/// \threadsafe no: use it in the thread that made it
class ControlClient : public QObject
{
    Q_OBJECT
public:
    /// Who greets.
    struct Caller
    {
        QString name;
        messages::Part role = messages::Part::Tool;
        QStringList features;
        QString uuid{};                              // empty: a new one for each connection
        std::optional<messages::Hex64> tableHash{};  // of the table that it has
        bool wantsTable = true;                      // if the master has another one
    };
    /// Why there is no connection any more.
    enum class Loss : quint8 {
        Gone,         ///< nobody answers, or the connection ended: socketError() has the kind
        MasterEnded,  ///< the master has said so
        Rejected,     ///< the master said no: rejection() has its words
        NoGreeting,   ///< the first message was another one: the other end is no master. Tools only
        OtherVersion
    };
    Q_ENUM(Loss)

    template<typename Request>
    using Reply = std::variant<typename Request::Answer, messages::Failed>;
    /// Gets the answer as it came; Invalid: the connection ended before there was one.
    using RawHandler = std::function<void(const QPlcMessage &answer)>;

    explicit ControlClient(const Caller &caller, QObject *parent = nullptr);
    ~ControlClient() override;

    /// Changes who greets. Takes effect with the next greeting: in connected() at the latest.
    void setCaller(const Caller &caller) { m_caller = caller; }
    /// Offers a feature of the protocol. As setCaller().
    void offer(const QString &feature) { m_caller.features.append(feature); }
    /// Asks for no table: it may have many megabytes. As setCaller().
    void leaveTableOut() { m_caller.wantsTable = false; }
    /// Without a call: as the process does (QPlcSecurity::current()). Takes effect with
    /// connectToMaster().
    void setSecurity(const QPlcSecurity &security) { m_security = security; }
    /// Longest wait for the greeting and for answers to questions; for commands, which may wait for
    /// nodes. 0: without an end.
    void setAnswerTimes(std::chrono::milliseconds questions, std::chrono::milliseconds commands);

    /// Begins to connect; greeted() or lost() follows. Ends the connection that there is.
    void connectToMaster(const QPlcUnderlyingProtocol &master);
    /// Disconnects without emitting lost(). Requests without an answer fail.
    void close();

    bool isGreeted() const { return m_isGreeted; }
    /// The greeting of the master: its session, table, state, the features of both, our identity
    /// and role.
    const messages::MasterHello &master() const { return m_master; }
    /// Whether the role of this client, as the master has told it, allows messages of \a kind.
    bool may(QPlcMessage::Kind kind) const;
    /// The last Rejected of the master.
    const messages::Rejected &rejection() const { return m_rejection; }
    /// What ended the last connection; NoError: none of its errors.
    QPlcAbstractSocket::Error socketError() const { return m_socketError; }
    /// The connection, for its addresses and its security; null: there is none.
    const QPlcAbstractSocket *connection() const { return m_socket; }
    /// Whether a command waits for its answer.
    bool isBusy() const;

    /// Sends \a request. \a handler gets the answer, or why there is none: `error` is Lost when the
    /// connection ended.
    template<typename Request, typename Handler>
    void request(const Request &request, Handler &&handler)
    {
        static_assert(!std::is_same_v<typename Request::Answer, messages::NoAnswer>,
                      "a message with NoAnswer is not a request; send it with tell()");
        send(messages::toMessage(request), [handler = std::forward<Handler>(handler)](const QPlcMessage &answer) {
            handler(replyOf<typename Request::Answer>(answer));
        });
    }
    /// As request(), for a message that is passed on as it is.
    void send(const QPlcMessage &message, const RawHandler &handler);
    /// Sends \a message, greeted or not, and waits for nothing: an answer comes as unasked().
    void tell(const QPlcMessage &message);
    /// \a message as the answer that was wanted, or why it is not.
    template<typename Answer>
    static std::variant<Answer, messages::Failed> replyOf(const QPlcMessage &message)
    {
        QString error;
        if (auto answer = messages::readAs<Answer>(message, &error))
            return *answer;
        return failureOf(message, error);
    }
    /// Why \a message is not the answer that was wanted. \param error  what could not be read of it
    static messages::Failed failureOf(const QPlcMessage &message, const QString &error = QString());

Q_SIGNALS:
    /// The greeting is about to be sent.
    void connected();
    void greeted();
    /// The connection ended, or could not be made. Never while a message is being sent.
    /// \param reason  half a sentence; of Rejected the text of the master, of NoGreeting the kind
    ///                that came, of OtherVersion the version of the master
    void lost(qplc::ControlClient::Loss loss, const QString &reason);
    /// A message that answers no request, neither begins nor ends the connection.
    void unasked(const QPlcMessage &message);

private:
    static constexpr std::int64_t Never = INT64_MAX;

    struct Pending
    {
        QPlcMessage message;
        messages::Use use;
        RawHandler handler;
        std::int64_t deadline = Never;  // [ns] of monotonicNow()
        std::chrono::milliseconds patience{0};

        bool isCommand() const { return use.purpose == messages::Purpose::Command; }
        bool canBeRefused() const { return use.outcome != messages::Outcome::Certain; }
    };

    void greet();
    void receive(const QPlcMessage &message);
    void receiveGreeting(const messages::MasterHello &hello);
    void receiveRejection(const messages::Rejected &rejection);
    void answer(const QPlcMessage &message);
    void deliver(const QPlcMessage &message);
    bool isSequenceOpenAfter(int dones) const;
    bool isAnswer(const QPlcMessage &message) const;
    int pendingFor(QPlcMessage::Kind answer) const;
    void sendNow(Pending pending);
    void sendNextCommands();
    void watchDeadlines();
    void checkDeadlines();
    static std::int64_t deadlineAfter(std::chrono::milliseconds duration);
    void end(Loss loss, const QString &reason);

    Caller m_caller;
    std::optional<QPlcSecurity> m_security;
    QPlcMasterSocket *m_socket = nullptr;
    std::chrono::milliseconds m_questionTime{5000};
    std::chrono::milliseconds m_commandTime{60'000};
    QTimer m_timer;
    std::int64_t m_greetingDeadline = Never;  // [ns] of monotonicNow()
    bool m_isGreeted = false;
    messages::MasterHello m_master;
    messages::Rejected m_rejection;
    QPlcAbstractSocket::Error m_socketError = QPlcAbstractSocket::NoError;
    QList<Pending> m_sent;
    int m_keptDones = 0;       // that came while they could answer a sequence or a Stop
    QList<Pending> m_waiting;  // commands
};

}  // namespace qplc
