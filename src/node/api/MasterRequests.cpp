// SPDX-License-Identifier: Apache-2.0
// What nodes and tools ask of a master: one function for each message.
#include "QPlcMasterNodePrivate.h"
#include "node/Logging.h"
#include "node/session/MasterReplies.h"
#include "node/statistics/StatisticsReply.h"
#include "protocol/messages/MessageTable.h"
#include "realtime/TimeSource.h"

using Message = QPlcMessage;
namespace messages = qplc::messages;

namespace {

constexpr std::size_t mostEvents = 200;  // in one answer
constexpr int longestText = 64;          // [characters] of who stops or notes, and how
constexpr int longestReason = 1000;      // [characters] of what becomes the reason of a state

QString wordOf(const QString &given)
{
    return qplc::printable(given.left(longestText));
}

/// Each State has it, so a long one would make each of them long.
QString reasonOf(const QString &given)
{
    return qplc::printable(given.left(longestReason));
}

}  // namespace

/// Carries out one message of a connection. A kind of messages::Requests without a function here
/// does not compile.
class QPlcMasterNodePrivate::Requests
{
public:
    Requests(QPlcMasterNodePrivate &master, Connection *connection)
        : d(master)
        , m_connection(connection)
    {
    }

    // ---- of nodes ----
    void operator()(const messages::ReceiveMyInitialOutputStates &answer) const
    {
        handleAnswer(answer.kind, answer.values, answer.goesOn);
    }
    void operator()(const messages::Initialized &answer) const { handleAnswer(answer.kind); }
    void operator()(const messages::RealTimeReady &answer) const { handleAnswer(answer.kind); }
    void operator()(const messages::NodeFault &fault) const
    {
        if (!isOfNode(fault.kind))
            return;
        const QString text = reasonOf(fault.text);
        const std::shared_ptr<qplc::NodeSession> node = m_connection->session;
        if (fault.phase && !(d.parts->phase.isRunning() && d.parts->phase.cycleZero() == *fault.phase)) {
            qCWarning(lcMaster).noquote() << "node" << m_connection->name << "in a phase that has ended:" << text;
            if (node && d.state() != QPlcMasterNode::Initializing)
                node->setFailed(true);
            return;  // no reason to stop what has begun since
        }
        const bool isRunning = node && node->stage() == qplc::NodeSession::Running;
        const bool hasFailedToJoin = d.parts->phase.isRunning() && !isRunning;
        if (m_connection->slot->listener || hasFailedToJoin) {
            d.parts->server.drop(m_connection, text);  // no reason to stop the others
            return;
        }
        if (node)
            node->setFailed(true);
        d.parts->faults.nodeFailed(m_connection->name, m_connection->slot->critical,
                                   QStringLiteral("node '%1': %2").arg(m_connection->name, text));
    }

    void operator()(const messages::NodeEvent &event) const
    {
        if (isOfNode(event.kind))
            d.journal.nodeTold(m_connection->name, event, !m_connection->events.take(qplc::monotonicNow()));
    }

    // ---- states ----
    void operator()(const messages::InitializeAllStates &) const { finish(d.initializeAllStates()); }
    void operator()(const messages::StartRealTime &start) const
    {
        finish(d.startRealTime(start.cycles.value_or(0), start.token.value_or(messages::Hex64())));
    }
    void operator()(const messages::Stop &stop) const
    {
        const QString who = whoIs(stop.whoever);
        const QString how = wordOf(stop.how);
        if (d.parts->phase.isRunning() && d.state() != QPlcMasterNode::SafeStop)
            d.askedStop = {m_connection->socket, who, how, qplc::wallClockNow()};
        d.stop(how.isEmpty() ? QStringLiteral("'%1' asked for it").arg(who)
                             : QStringLiteral("'%1' asked for it (%2)").arg(who, how));
        m_connection->done();
    }
    void operator()(const messages::SafeStop &stop) const
    {
        const QString reason = stop.reason.isEmpty() ? QString() : QStringLiteral(": ") + reasonOf(stop.reason);
        d.parts->faults.safeStop(QStringLiteral("'%1' asked for it%2").arg(m_connection->shownName(), reason));
        m_connection->done();
    }
    void operator()(const messages::Reset &reset) const
    {
        if (qplc::isLatched(d.state()) && reset.latch != d.latch)
            m_connection->fail(qplc::messages::errorWord::wrongState,
                               QStringLiteral("there was another safe stop or fault (number %1: %2) than the one that "
                                              "you reset (number %3); read the state, then reset again")
                                   .arg(d.latch)
                                   .arg(d.stateReason)
                                   .arg(reset.latch));
        else
            finish(d.reset());
    }
    void operator()(const messages::Arm &) const
    {
        if (d.arm())
            m_connection->send(messages::Armed{d.arming.token(), std::chrono::nanoseconds(qplc::Arming::ValidFor)});
        else
            m_connection->fail(qplc::messages::errorWord::wrongState, d.error.text());
    }

    // ---- who may come ----
    void operator()(const messages::Evict &wish) const
    {
        qplc::Refusal refusal;
        finish(d.parts->evictions.evict(wish.name, m_connection, &refusal), refusal);
    }
    void operator()(const messages::Admit &wish) const
    {
        qplc::Refusal refusal;
        finish(d.parts->evictions.admit(wish.name, m_connection, &refusal), refusal);
    }

    // ---- values from outside ----
    void operator()(const messages::SetSignals &wish) const
    {
        qplc::Refusal refusal;
        finish(d.parts->settings.setSignals(m_connection->socket, wish, &refusal), refusal);
    }
    void operator()(const messages::TakeLease &wish) const
    {
        qplc::Refusal refusal;
        finish(d.parts->leases.take(*m_connection, wish, &refusal), refusal);
    }
    void operator()(const messages::ReleaseLease &wish) const
    {
        qplc::Refusal refusal;
        finish(d.parts->leases.release(*m_connection, wish, &refusal), refusal);
    }

    void operator()(const messages::Note &note) const
    {
        if (note.text.trimmed().isEmpty())
            m_connection->fail(qplc::messages::errorWord::malformedMessage,
                               QStringLiteral("the note is empty; write what has happened"));
        else if (note.text.size() > messages::Note::longest)
            m_connection->fail(qplc::messages::errorWord::malformedMessage,
                               QStringLiteral("the note has %1 characters; write at most %2")
                                   .arg(note.text.size())
                                   .arg(messages::Note::longest));
        else if (qplc::printable(note.text) != note.text)
            m_connection->fail(qplc::messages::errorWord::malformedMessage,
                               QStringLiteral("the note has a character that ends a line, controls a terminal or hides "
                                              "text, shown as '?': %1; leave it out")
                                   .arg(qplc::printable(note.text)));
        else if (!d.journal.note(whoIs(note.whoever), m_connection->socket->peerName(), note.text))
            m_connection->fail(qplc::messages::errorWord::tooMuch,
                               QStringLiteral("too many notes: the master takes one each second, and 20 after a pause; "
                                              "try again"));
        else
            m_connection->done();
    }

    // ---- questions ----
    void operator()(const messages::GetState &) const
    {
        messages::State reply = qplc::stateReply(*d.q, d.profile(), d.session);
        reply.evicted = d.evictions.entries();
        reply.latch = d.latch;
        reply.cycleZeroTime = quint64(d.parts->cycle.cycleZeroTime());
        reply.recorder = d.parts->phase.recorder().status();
        const qplc::AskedStop &stop = d.askedStop;
        if (!stop.whoever.isEmpty())
            reply.stopped
                = messages::StopEntry{stop.whoever, stop.how, quint64(stop.time), stop.asker == m_connection->socket};
        m_connection->send(reply);
    }
    void operator()(const messages::GetSchedule &) const
    {
        qplc::Refusal refusal;
        m_connection->listAnswer = qplc::scheduleReply(d.parts->registry, d.table, &refusal);
        if (!m_connection->listAnswer)
            m_connection->fail(refusal.error, refusal.text);
    }
    void operator()(const messages::GetSignals &question) const
    {
        qplc::Refusal refusal;
        m_connection->listAnswer
            = qplc::signalReply(d.parts->cycle, d.parts->registry, d.leaseBooks, question.names, &refusal);
        if (!m_connection->listAnswer)
            m_connection->fail(refusal.error, refusal.text);
    }
    void operator()(const messages::GetStatistics &question) const
    {
        const auto detail = question.histograms ? QPlcDistribution::WithBins : QPlcDistribution::FiguresOnly;
        m_connection->listAnswer = qplc::statisticsReply(d.parts->cycle, d.parts->registry, detail);
    }
    void operator()(const messages::GetLeases &) const
    {
        answer(messages::Leases{d.parts->leases.entries()}, QStringLiteral("too many leases for one answer"));
    }
    void operator()(const messages::GetRecords &question) const
    {
        const QString &uuid = m_connection->uuid;
        const qplc::RemoteRecorder::Asker asker{
            m_connection->socket, uuid.isEmpty() ? uuid : m_connection->peer.provenIdentity() + QLatin1Char('/') + uuid,
            QStringLiteral("'%1' at %2").arg(m_connection->shownName(), m_connection->socket->peerName())};
        qplc::Refusal refusal;
        const std::optional<messages::Records> records
            = d.parts->phase.remoteRecorder().answer(question, asker, qplc::monotonicNow(), &refusal);
        if (records)
            m_connection->send(*records);
        else
            m_connection->fail(refusal.error, refusal.text);
    }
    void operator()(const messages::GetEvents &question) const
    {
        const std::vector<qplc::JournalEvent> events = d.journal.events().after(question.since.value_or(0), mostEvents);
        messages::Events reply = qplc::eventReply(events);
        reply.more = !events.empty() && events.back().sequence < d.journal.events().newest();
        m_connection->send(reply);
    }

private:
    /// The asker, for people. \param given  the person as the asker says
    QString whoIs(const QString &given) const
    {
        const QString called = wordOf(given);
        return qplc::shownName(m_connection->peer, called.isEmpty() ? m_connection->name : called);
    }
    bool isOfNode(Message::Kind kind) const
    {
        if (!m_connection->isNode())
            m_connection->fail(qplc::messages::errorWord::malformedMessage,
                               QStringLiteral("%1 is for registered nodes only").arg(Message(kind).kindName()));
        return m_connection->isNode();
    }
    void handleAnswer(Message::Kind kind, const QByteArray &outputs = {}, bool goesOn = false) const
    {
        if (!isOfNode(kind))
            return;
        if (m_connection->owes(kind))
            handleOwed(outputs, goesOn);
        else if (m_connection->slot->listener)
            qCDebug(lcMaster).noquote() << "node" << m_connection->name << "gives the answer"
                                        << Message(kind).kindName() << "to a sequence that has ended";
        else
            m_connection->fail(qplc::messages::errorWord::wrongState,
                               QStringLiteral("%1 was not asked for").arg(Message(kind).kindName()));
    }
    void handleOwed(const QByteArray &outputs, bool goesOn) const
    {
        const std::shared_ptr<qplc::NodeSession> node = m_connection->session;  // it may be dropped for its answer
        if (d.parts->phase.isRunning() || !node->isAwaited())
            d.parts->joining.handleAnswer(*node, outputs, goesOn);
        else if (node->stage() == qplc::NodeSession::Starting)
            d.parts->starting.handleAnswer(*node);
        else
            d.parts->initialization.handleAnswer(*node, outputs);
    }
    /// Answers what was refused or is done; else the asker waits for the end of the sequence.
    void finish(bool isAccepted) const
    {
        if (!isAccepted)
            m_connection->fail(qplc::messages::errorWord::wrongState, d.error.text());
        else if (d.parts->step.isUnderWay())
            d.asker.wait(m_connection->socket);
        else
            m_connection->done();
    }
    void finish(bool isDone, const qplc::Refusal &refusal) const
    {
        if (isDone)
            m_connection->done();
        else
            m_connection->fail(refusal.error, refusal.text);
    }
    template<typename Answer>
    void answer(const Answer &answer, const QString &tooLong) const
    {
        if (!m_connection->send(answer))
            m_connection->fail(qplc::messages::errorWord::tooLong, tooLong);
    }

    QPlcMasterNodePrivate &d;
    Connection *const m_connection;
};

void QPlcMasterNodePrivate::receive(Connection *connection, const Message &message)
{
    parts->leases.heard(connection->socket);
    QString fault;
    switch (messages::dispatch(messages::Requests(), message, Requests(*this, connection), &fault)) {
    case messages::Dispatch::Delivered:
        break;
    case messages::Dispatch::Malformed:
        if (connection->owes(message.kind()))
            parts->server.drop(connection, fault);  // nobody waits for an answer that will not come
        else
            connection->fail(qplc::messages::errorWord::malformedMessage, fault);
        break;
    case messages::Dispatch::Unknown:
        connection->fail(qplc::messages::errorWord::malformedMessage,
                         QStringLiteral("a master does not handle %1").arg(message.kindName()));
        break;
    }
}
