// SPDX-License-Identifier: Apache-2.0
#include "ControlClient.h"

#include "node/security/AccessRights.h"
#include "protocol/ControlFrame.h"
#include "protocol/messages/Vocabulary.h"
#include "realtime/Host.h"
#include "realtime/TimeSource.h"

#include <QtCore/QPointer>

#include <algorithm>

namespace qplc {

namespace {

bool answersARequest(QPlcMessage::Kind kind)
{
    const auto &uses = messages::ClientTable::uses;
    return kind != QPlcMessage::Invalid
        && std::any_of(std::begin(uses), std::end(uses),
                       [kind](const messages::Use &use) { return use.answer == kind; });
}

}  // namespace

ControlClient::ControlClient(const Caller &caller, QObject *parent)
    : QObject(parent)
    , m_caller(caller)
    , m_timer(this)
{
    m_timer.setSingleShot(true);
    connect(&m_timer, &QTimer::timeout, this, &ControlClient::checkDeadlines);
}

ControlClient::~ControlClient()
{
    if (m_socket)
        m_socket->disconnect(this);
}

void ControlClient::setAnswerTimes(std::chrono::milliseconds questions, std::chrono::milliseconds commands)
{
    m_questionTime = questions;
    m_commandTime = commands;
}

// ---- the connection ----

void ControlClient::connectToMaster(const QPlcUnderlyingProtocol &master)
{
    close();
    m_master = {};
    m_rejection = {};
    m_socketError = QPlcAbstractSocket::NoError;
    m_socket = new QPlcMasterSocket(this);
    if (m_security)
        m_socket->setSecurity(*m_security);
    connect(m_socket, &QPlcAbstractSocket::connected, this, &ControlClient::greet);
    connect(m_socket, &QPlcAbstractSocket::messageReceived, this, &ControlClient::receive);
    // Not at once: a message that cannot be sent ends the connection, and who sends has more to do.
    const auto gone = [this, socket = m_socket](QPlcAbstractSocket::Error error) {
        if (socket != m_socket)
            return;  // closed meanwhile, or an error and its end
        m_socketError = error;
        end(Loss::Gone,
            error == QPlcAbstractSocket::NoError ? QStringLiteral("the connection was closed") : socket->errorString());
    };
    connect(m_socket, &QPlcAbstractSocket::errorOccurred, this, gone, Qt::QueuedConnection);
    connect(
        m_socket, &QPlcAbstractSocket::disconnected, this, [gone] { gone(QPlcAbstractSocket::NoError); },
        Qt::QueuedConnection);
    m_greetingDeadline = deadlineAfter(m_questionTime);
    watchDeadlines();
    m_socket->connectToMaster(master);
}

void ControlClient::greet()
{
    QPlcMasterSocket *socket = m_socket;
    Q_EMIT connected();
    if (socket != m_socket)
        return;  // closed by who heard of it
    const QString uuid = m_caller.uuid.isEmpty() ? newUuid() : m_caller.uuid;
    const messages::ClientHello hello{
        messages::protocolVersion, m_caller.name,      uuid, m_caller.role, m_caller.tableHash,
        m_caller.features,         m_caller.wantsTable};
    m_socket->setMessageLimit(MaximumControlFrame);
    m_socket->sendMessage(messages::toMessage(hello));
}

void ControlClient::close()
{
    m_isGreeted = false;
    m_greetingDeadline = Never;
    m_timer.stop();
    if (m_socket) {
        m_socket->disconnect(this);
        m_socket->close();
        m_socket->deleteLater();
        m_socket = nullptr;
    }
    const QList<Pending> unanswered = m_sent + m_waiting;
    m_sent.clear();
    m_waiting.clear();
    m_keptDones = 0;
    for (const Pending &pending : unanswered)
        pending.handler(QPlcMessage());
}

void ControlClient::end(Loss loss, const QString &reason)
{
    if (!m_socket)
        return;  // closed by who got the last answer
    close();
    Q_EMIT lost(loss, reason);
}

// ---- from the master ----

void ControlClient::receive(const QPlcMessage &message)
{
    const auto hello = m_isGreeted ? std::nullopt : messages::readAs<messages::MasterHello>(message);
    if (hello)
        receiveGreeting(*hello);
    else if (const auto rejection = messages::readAs<messages::Rejected>(message))
        receiveRejection(*rejection);
    else if (message.kind() == QPlcMessage::MasterEnds)
        end(Loss::MasterEnded, QStringLiteral("the master has ended"));
    else if (!m_isGreeted && m_caller.role == messages::Part::Tool)
        end(Loss::NoGreeting, message.kindName());
    else if (isAnswer(message))
        answer(message);
    else
        Q_EMIT unasked(message);
}

void ControlClient::receiveGreeting(const messages::MasterHello &hello)
{
    if (hello.protocol != messages::protocolVersion) {
        end(Loss::OtherVersion, QString::number(hello.protocol));
        return;
    }
    m_master = hello;
    m_socket->setSendLimit(std::max(hello.longestMessage, UsualControlFrame));
    m_isGreeted = true;
    m_greetingDeadline = Never;
    watchDeadlines();
    Q_EMIT greeted();
}

/// The master closes the connection after it: the request that it refuses is told so first.
void ControlClient::receiveRejection(const messages::Rejected &rejection)
{
    m_rejection = rejection;
    const QPointer<ControlClient> self(this);  // who gets an answer may delete us
    if (!m_sent.isEmpty())
        answer(messages::toMessage(rejection));
    if (self)
        end(Loss::Rejected, m_rejection.text);
}

bool ControlClient::may(QPlcMessage::Kind kind) const
{
    const std::optional<Role> role = roleOf(m_master.role);  // nothing: without security everybody may do everything
    return !role || whoMaySend(kind).contains(*role);
}

/// Whether a request waits for such a message. Events come unasked, too: then without `more`.
bool ControlClient::isAnswer(const QPlcMessage &message) const
{
    const auto events = messages::readAs<messages::Events>(message);
    return !m_sent.isEmpty() && !(events && !events->more)
        && (message.kind() == QPlcMessage::Failed || answersARequest(message.kind()));
}

/// The request that this kind answers. The master answers questions while a command waits for
/// nodes, so the order alone does not tell. An answer that fits no request goes to the oldest.
int ControlClient::pendingFor(QPlcMessage::Kind answer) const
{
    const bool isRefusal = answer == QPlcMessage::Failed || answer == QPlcMessage::Rejected;
    const auto fits
        = [&](const Pending &pending) { return isRefusal ? pending.canBeRefused() : pending.use.answer == answer; };
    const auto found = std::find_if(m_sent.begin(), m_sent.end(), fits);
    return found == m_sent.end() ? 0 : int(found - m_sent.begin());
}

/// Whether the outcome of a sequence is still unknown after so many `Done`, which do not name
/// their requests: the master may answer a Stop before the sequence that it ends.
bool ControlClient::isSequenceOpenAfter(int dones) const
{
    const auto isSequence = [](const Pending &pending) { return pending.use.outcome == messages::Outcome::Late; };
    const auto waitsForDone = [](const Pending &pending) { return pending.use.answer == QPlcMessage::Done; };
    return std::any_of(m_sent.begin(), m_sent.end(), isSequence)
        && std::count_if(m_sent.begin(), m_sent.end(), waitsForDone) > dones;
}

void ControlClient::answer(const QPlcMessage &message)
{
    if (message.kind() == QPlcMessage::Done && isSequenceOpenAfter(m_keptDones + 1)) {
        ++m_keptDones;
        return;
    }
    const QPointer<ControlClient> self(this);
    deliver(message);
    while (self && m_keptDones > 0 && !isSequenceOpenAfter(m_keptDones)) {
        --m_keptDones;
        deliver(QPlcMessage(QPlcMessage::Done));
    }
}

void ControlClient::deliver(const QPlcMessage &message)
{
    const RawHandler handler = m_sent.takeAt(pendingFor(message.kind())).handler;
    sendNextCommands();
    watchDeadlines();
    handler(message);
}

messages::Failed ControlClient::failureOf(const QPlcMessage &message, const QString &error)
{
    if (message.kind() == QPlcMessage::Invalid)
        return {messages::errorWord::lost, QStringLiteral("the master was lost before it answered")};
    if (const auto failed = messages::readAs<messages::Failed>(message))
        return *failed;
    if (const auto rejected = messages::readAs<messages::Rejected>(message))
        return {rejected->error, rejected->text};
    return {messages::errorWord::malformedMessage,
            error.isEmpty() ? QStringLiteral("the master answers with %1").arg(message.kindName()) : error};
}

// ---- to the master ----

bool ControlClient::isBusy() const
{
    return std::any_of(m_sent.begin(), m_sent.end(), [](const Pending &pending) { return pending.isCommand(); });
}

void ControlClient::send(const QPlcMessage &message, const RawHandler &handler)
{
    Pending pending{message, messages::useOf(message.kind()), handler, {}};
    if (!m_isGreeted)
        handler(QPlcMessage());
    else if (pending.isCommand() && pending.canBeRefused() && isBusy())
        m_waiting.append(pending);
    else
        sendNow(pending);
}

void ControlClient::tell(const QPlcMessage &message)
{
    if (m_socket)
        m_socket->sendMessage(message);
}

void ControlClient::sendNow(Pending pending)
{
    if (!m_socket->sendMessage(pending.message)) {
        const messages::Failed tooLong{messages::errorWord::malformedMessage,
                                       QStringLiteral("the message is too long to be sent")};
        pending.handler(messages::toMessage(tooLong));
        return;
    }
    pending.patience = pending.isCommand() ? m_commandTime : m_questionTime;
    pending.deadline = deadlineAfter(pending.patience);
    m_sent.append(pending);
    watchDeadlines();
}

void ControlClient::sendNextCommands()
{
    while (!m_waiting.isEmpty() && !isBusy())
        sendNow(m_waiting.takeFirst());
}

// ---- time ----

/// On the clock of monotonicNow() [ns].
std::int64_t ControlClient::deadlineAfter(std::chrono::milliseconds duration)
{
    return duration.count() > 0 ? monotonicNow() + std::chrono::nanoseconds(duration).count() : Never;
}

void ControlClient::watchDeadlines()
{
    std::int64_t next = m_greetingDeadline;
    for (const Pending &pending : qAsConst(m_sent))
        next = std::min(next, pending.deadline);
    if (next == Never)
        m_timer.stop();
    else
        m_timer.start(int(std::max<std::int64_t>(next - monotonicNow(), 0) / 1'000'000) + 1);
}

void ControlClient::checkDeadlines()
{
    const auto isLate = [](const Pending &pending) { return pending.deadline <= monotonicNow(); };
    const auto late = std::find_if(m_sent.begin(), m_sent.end(), isLate);
    if (m_greetingDeadline > monotonicNow() && late == m_sent.end()) {
        watchDeadlines();
        return;
    }
    const std::chrono::milliseconds patience = late == m_sent.end() ? m_questionTime : late->patience;
    end(Loss::Gone, QStringLiteral("no answer within %1 s").arg(double(patience.count()) * 1e-3));
}

}  // namespace qplc
