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

/// The struct that answers a request: `Done` unless the request names another one.
template<typename Request, typename = void>
struct AnswerTo
{
    using Type = messages::Done;
};
template<typename Request>
struct AnswerTo<Request, std::void_t<typename Request::Answer>>
{
    using Type = typename Request::Answer;
};

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
    };
    /// Why there is no connection any more.
    enum class Loss : quint8 {
        Gone,        ///< nobody answers, or the connection ended
        Rejected,    ///< the master said no: rejection() has its words
        NoGreeting,  ///< the first message was another one: the other end is no master
        OtherVersion
    };
    Q_ENUM(Loss)

    template<typename Request>
    using Reply = std::variant<typename AnswerTo<Request>::Type, messages::Failed>;
    /// Gets the answer as it came; Invalid: the connection ended before there was one.
    using RawHandler = std::function<void(const QPlcMessage &answer)>;

    explicit ControlClient(const Caller &caller, QObject *parent = nullptr);
    ~ControlClient() override;

    /// Offers a feature of the protocol. Takes effect with connectToMaster().
    void offer(const QString &feature) { m_caller.features.append(feature); }
    /// Without a call: as the process does (QPlcSecurity::current()). Takes effect with
    /// connectToMaster().
    void setSecurity(const QPlcSecurity &security) { m_security = security; }
    /// Longest wait for the greeting and for answers to questions; for commands, which may wait for
    /// nodes.
    void setAnswerTimes(std::chrono::milliseconds questions, std::chrono::milliseconds commands);

    /// Begins to connect; greeted() or lost() follows. Ends the connection that there is.
    void connectToMaster(const QPlcUnderlyingProtocol &master);
    /// Disconnects without emitting lost(). Requests without an answer fail.
    void close();

    bool isGreeted() const { return m_isGreeted; }
    /// The greeting of the master: its session, table, state, the features of both, our identity
    /// and role.
    const messages::MasterHello &master() const { return m_master; }
    /// The last Rejected of the master.
    const messages::Rejected &rejection() const { return m_rejection; }
    /// Whether a command waits for its answer.
    bool isBusy() const;

    /// Sends \a request. \a handler gets the answer, or why there is none: `error` is Lost when the
    /// connection ended.
    template<typename Request, typename Handler>
    void request(const Request &request, Handler &&handler)
    {
        send(messages::toMessage(request), [handler = std::forward<Handler>(handler)](const QPlcMessage &answer) {
            handler(replyOf<typename AnswerTo<Request>::Type>(answer));
        });
    }
    /// As request(), for a message that is passed on as it is.
    void send(const QPlcMessage &message, const RawHandler &handler);
    /// Why \a message is not the answer that was wanted. \param error  what could not be read of it
    static messages::Failed failureOf(const QPlcMessage &message, const QString &error = QString());

Q_SIGNALS:
    void greeted();
    /// The connection ended, or could not be made.
    /// \param reason half a sentence; of Rejected the text of the master, of NoGreeting the kind
    ///         that came, of OtherVersion the version of the master
    void lost(qplc::ControlClient::Loss loss, const QString &reason);
    /// Unasked, with the feature "leases".
    void leasesChanged(const qplc::messages::LeasesChanged &leases);
    /// Unasked, with the feature "events".
    void eventsHappened(const qplc::messages::Events &events);
    /// All nodes have their initial values, or not.
    void statesInitialized(const qplc::messages::StatesInitialized &outcome);

private:
    static constexpr std::int64_t Never = INT64_MAX;

    struct Pending
    {
        QPlcMessage message;
        QPlcMessage::Kind answer = QPlcMessage::Invalid;
        RawHandler handler;
        std::int64_t deadline = Never;  // [ns] of monotonicNow()

        bool isCommand() const { return answer == QPlcMessage::Done || message.kind() == QPlcMessage::Arm; }
        bool isUrgent() const { return message.kind() == QPlcMessage::Stop || message.kind() == QPlcMessage::SafeStop; }
        bool isSequence() const
        {
            return message.kind() == QPlcMessage::InitializeAllStates || message.kind() == QPlcMessage::StartRealTime;
        }
    };

    template<typename Answer>
    static std::variant<Answer, messages::Failed> replyOf(const QPlcMessage &message)
    {
        QString error;
        if (auto answer = messages::readAs<Answer>(message, &error))
            return *answer;
        return failureOf(message, error);
    }

    void greet();
    void receive(const QPlcMessage &message);
    void receiveGreeting(const QPlcMessage &message);
    void receiveRejection(const QPlcMessage &message);
    void receiveEvents(const QPlcMessage &message);
    void answer(const QPlcMessage &message);
    void deliver(const QPlcMessage &message);
    bool isSequenceOpenAfter(int dones) const;
    static bool isAnswer(QPlcMessage::Kind kind);
    int pendingFor(QPlcMessage::Kind answer) const;
    void sendNow(Pending pending);
    void sendNextCommands();
    void watchDeadlines();
    void checkDeadlines();
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
    QList<Pending> m_sent;
    int m_keptDones = 0;       // that came while they could answer a sequence or a Stop
    QList<Pending> m_waiting;  // commands
};

}  // namespace qplc
