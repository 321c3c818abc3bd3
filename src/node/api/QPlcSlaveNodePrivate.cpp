// SPDX-License-Identifier: Apache-2.0
#include "QPlcSlaveNodePrivate.h"

#include "QPlcMasterNodePrivate.h"
#include "node/Logging.h"
#include "node/session/MasterReplies.h"
#include "realtime/Host.h"
#include "transport/TransportRegistry.h"

#include <QtCore/QCoreApplication>

#include <optional>
#include <utility>

using Message = QPlcMessage;
using qplc::SlaveEvent;
namespace messages = qplc::messages;

namespace {

constexpr int lookAgain = 5;  // [ms] whether the rest of a phase is there

/// What a message of the master means to the node; none: nothing to its state.
std::optional<SlaveEvent> eventOf(const Message &message)
{
    switch (message.kind()) {
    case Message::Registered:
        return SlaveEvent::Accepted;
    case Message::CyclicChannelAttached:
        return SlaveEvent::ChannelAttached;
    case Message::SendYourInitialOutputStates:
        return SlaveEvent::OutputsWanted;
    case Message::InitializeWithValues:
        return SlaveEvent::ValuesCame;
    case Message::RealTimeStarted:
        return SlaveEvent::PhaseStarted;
    case Message::RealTimeStopped:
        return SlaveEvent::PhaseStopped;
    default:
        return {};
    }
}

/// Why there can be no master at \a master; empty: there can.
QString objectionTo(const QPlcUnderlyingProtocol &master)
{
    const qplc::TransportRegistry &registry = qplc::TransportRegistry::instance();
    if (!master.isValid())
        return QStringLiteral("the address of the master is not valid; use QPlcUnderlyingProtocol::automatic() or "
                              "local(), or fromString(), which says why in its argument error");
    if (!registry.named(master.kindName())->isAtHand())
        return QStringLiteral("this host has no transport %1://; use %2")
            .arg(master.kindName(), registry.namesText(QStringLiteral("://")));
    return {};
}

}  // namespace

QPlcSlaveNodePrivate::QPlcSlaveNodePrivate(QPlcSlaveNode *node, const QString &nodeName,
                                           QPlcSlaveNode::RealTimeViolationPolicy violationPolicy,
                                           std::unique_ptr<qplc::NodeCode> nodeCode)
    : q(node)
    , code(std::move(nodeCode))
    , runtime(*code, *this)
    , control({}, q)
    , events([this](const messages::NodeEvent &event) { return sendEvent(event); }, q)
    , m_retryTimer(q)
    , m_patience(q)
    , m_rest(q)
    , m_uuid(qplc::newUuid())
{
    name = nodeName;
    policy = violationPolicy;
    m_retryTimer.setSingleShot(true);
    QObject::connect(&m_retryTimer, &QTimer::timeout, q, [this] { apply(SlaveEvent::Retry); });
    QObject::connect(&m_patience, &QTimer::timeout, q, [this] {
        masterLost(QPlcAbstractSocket::NoError,
                   QStringLiteral("no answer within %1 s").arg(m_patience.interval() / 1000));
    });
    m_rest.setInterval(lookAgain);
    QObject::connect(&m_rest, &QTimer::timeout, q, [this] { lookForRest(); });
    using qplc::ControlClient;
    control.setAnswerTimes({}, {});  // an attempt has its own patience
    QObject::connect(&control, &ControlClient::connected, q, [this] { apply(SlaveEvent::Connected); });
    QObject::connect(&control, &ControlClient::greeted, q, [this] { apply(SlaveEvent::HelloCame); });
    QObject::connect(&control, &ControlClient::unasked, q, [this](const Message &message) { handle(message); });
    QObject::connect(&control, &ControlClient::lost, q,
                     [this](ControlClient::Loss loss, const QString &reason) { controlLost(loss, reason); });
    // A program that ends says goodbye in time: its node reaches its safe state before its
    // destructor runs.
    if (QCoreApplication *application = QCoreApplication::instance())
        QObject::connect(application, &QCoreApplication::aboutToQuit, q, [this] {
            if (!localMaster)  // else its master ends, too
                disconnectFromMaster();
        });
}

void QPlcSlaveNodePrivate::setError(QPlcSlaveNode::Error newError, const QString &text)
{
    error = newError;
    errorString = text;
    qCWarning(lcSlave).noquote() << text;
    Q_EMIT q->errorOccurred(newError);
}

bool QPlcSlaveNodePrivate::sendEvent(const messages::NodeEvent &event)
{
    if (!hasChannel)
        return false;
    if (localMaster)
        QPlcMasterNodePrivate::of(*localMaster).journal.nodeTold(name, event, false);
    else
        send(event);
    return true;
}

// ---- connection ----

void QPlcSlaveNodePrivate::connectToMaster(const QPlcUnderlyingProtocol &newMaster)
{
    disconnectFromMaster();
    error = QPlcSlaveNode::NoError;
    errorString.clear();
    master = newMaster;
    m_wasRegistered = false;
    m_backOff.reset();
    const QString unusable = objectionTo(master);
    if (unusable.isEmpty())
        apply(SlaveEvent::Connect);
    else
        setError(QPlcSlaveNode::OptionError, QStringLiteral("node '%1': %2").arg(name, unusable));
}

void QPlcSlaveNodePrivate::openConnection()
{
    m_transport = qplc::TransportRegistry::instance().named(master.kindName());
    if (m_wasRegistered || reconnectPolicy == QPlcSlaveNode::ReconnectAlways)
        m_patience.start(m_backOff.patience());
    control.connectToMaster(master);
}

void QPlcSlaveNodePrivate::disconnectFromMaster()
{
    if (localMaster)
        localMaster->removeLocalNode(q);
    else
        apply(SlaveEvent::Leave);
}

void QPlcSlaveNodePrivate::endBeforeDestruction()
{
    const bool cyclesRun = localMaster ? messages::hasCycles(qplc::messageStateOf(localMaster->state())) : m_inPhase;
    if (!cyclesRun)
        return;
    qCWarning(lcSlave).noquote() << "node" << name
                                 << "is destroyed while its cycles run: they end here, without its safeState(); call "
                                    "disconnectFromMaster() first, in the destructor of its class at the latest";
    runtime.leaveCodeAlone();
    if (localMaster) {
        localMaster->removeLocalNode(q);
        return;
    }
    cycle->stop();
    m_inPhase = false;
}

void QPlcSlaveNodePrivate::closeConnection(QPlcSlaveNode::SafeStateReason reason)
{
    endPhase(reason);
    control.close();
    if (m_cyclicSocket) {
        m_cyclicSocket->disconnect(q);
        m_cyclicSocket->close();
        m_cyclicSocket->deleteLater();
        m_cyclicSocket = nullptr;
    }
    m_patience.stop();
    m_probe.reset();
    m_link.reset();
    m_reportNotifier.reset();
    m_outputsAwaited.reset();
    hasChannel = false;
    cycle.reset();
}

/// The reports of the cycle, which tell of the watchdog, are being read: the cycle ends behind
/// them.
void QPlcSlaveNodePrivate::closeAfterWatchdog()
{
    const auto close = [this, phase = m_phase] {
        if (phase != m_phase || !m_inPhase)
            return;  // ended meanwhile
        const bool hadChannel = hasChannel;
        haltCycles();
        closeConnection(QPlcSlaveNode::WatchdogReason);
        retryLater(SlaveEvent::WatchdogTimedOut);
        Q_EMIT q->realTimeHasStopped();
        if (hadChannel)
            Q_EMIT q->disconnectedFromMaster();
    };
    QMetaObject::invokeMethod(q, close, Qt::QueuedConnection);
}

void QPlcSlaveNodePrivate::retryLater(SlaveEvent event)
{
    const bool isWanted = reconnectPolicy == QPlcSlaveNode::ReconnectAlways
        || (reconnectPolicy == QPlcSlaveNode::ReconnectWhenLost && m_wasRegistered && event != SlaveEvent::MasterEnded);
    if (!isWanted || QCoreApplication::closingDown())
        return;
    const double chance = qplc::randomFraction();
    m_retryTimer.start(event == SlaveEvent::Refused ? m_backOff.afterRefusal(chance) : m_backOff.next(chance));
}

void QPlcSlaveNodePrivate::controlLost(qplc::ControlClient::Loss loss, const QString &reason)
{
    using Loss = qplc::ControlClient::Loss;
    switch (loss) {
    case Loss::Gone:
    case Loss::NoGreeting:
        masterLost(control.socketError(), reason);
        break;
    case Loss::MasterEnded:
        qCInfo(lcSlave).noquote() << "node" << name << "- the master has ended";
        apply(SlaveEvent::MasterEnded);
        break;
    case Loss::Rejected:
        giveUp(QPlcSlaveNode::RegistrationError,
               QStringLiteral("the master at %1 refuses node '%2': %3")
                   .arg(master.toString(), name, qplc::printable(reason)));
        break;
    case Loss::OtherVersion:
        giveUp(QPlcSlaveNode::ProtocolError,
               QStringLiteral("the master at %1 speaks protocol version %2, node '%3' version %4; update the older one")
                   .arg(master.toString(), reason, name)
                   .arg(messages::protocolVersion));
        break;
    }
}

void QPlcSlaveNodePrivate::masterLost(QPlcAbstractSocket::Error socketError, const QString &text)
{
    const bool wasConnecting = state == QPlcSlaveNode::Connecting || state == QPlcSlaveNode::Registering;
    const QString sentence = socketError == QPlcAbstractSocket::SecurityError
        ? QStringLiteral("node '%1' is not accepted at %2: %3")
        : wasConnecting
        ? QStringLiteral("node '%1' cannot reach a master at %2: %3; start the master, or check address and port")
        : QStringLiteral("node '%1' has lost the master at %2: %3");
    const QString full = sentence.arg(name, master.toString(), text);
    const QPlcAbstractSocket::Error reason
        = socketError == QPlcAbstractSocket::NoError ? QPlcAbstractSocket::ConnectionLostError : socketError;
    apply(socketError == QPlcAbstractSocket::SecurityError ? SlaveEvent::Refused : SlaveEvent::ConnectionLost);
    setError(reason == QPlcAbstractSocket::ProtocolError ? QPlcSlaveNode::ProtocolError
                                                         : QPlcSlaveNode::ConnectionError,
             full);
    Q_EMIT q->errorWithMaster(reason, full);
}

/// What master and node say of each other cannot be: it does not pass by itself.
void QPlcSlaveNodePrivate::giveUp(QPlcSlaveNode::Error newError, const QString &text)
{
    apply(SlaveEvent::Refused);
    setError(newError, text);
}

// ---- messages ----

/// Whether a master may send \a message now. Anything else would call the code of the node before
/// it is bound, or on two threads at a time.
bool QPlcSlaveNodePrivate::isExpected(const Message &message) const
{
    const std::optional<SlaveEvent> event = eventOf(message);
    if (event && qplc::slaveStates().at(state, *event).verdict == qplc::Verdict::Refused)
        return false;
    switch (message.kind()) {  // steps of the registration
    case Message::Hello:
        return false;  // a second one
    case Message::Registered:
        return control.isGreeted() && !cycle;
    case Message::CyclicChannelAttached:
        return cycle && !m_probe && !m_transport->hasStreams();
    default:
        return true;
    }
}

/// What each message of a master does. A kind of messages::ToNode without a function here does not
/// compile.
class QPlcSlaveNodePrivate::FromMaster
{
public:
    explicit FromMaster(QPlcSlaveNodePrivate &node)
        : d(node)
    {
    }

    // ---- registration ----
    void operator()(const messages::Registered &registered) const { d.apply(SlaveEvent::Accepted, registered); }
    void operator()(const messages::CyclicChannelAttached &) const { d.apply(SlaveEvent::ChannelAttached); }

    // ---- phases ----
    void operator()(const messages::SendYourInitialOutputStates &request) const
    {
        d.apply(SlaveEvent::OutputsWanted, request);
    }
    void operator()(const messages::InitializeWithValues &initial) const { d.apply(SlaveEvent::ValuesCame, initial); }
    void operator()(const messages::StatesInitialized &outcome) const
    {
        if (outcome.ok)
            return;
        d.m_outputsAwaited.reset();  // the master has given up what it began
        d.apply(SlaveEvent::InitializationFailed);
    }
    void operator()(const messages::RealTimeStarted &start) const { d.apply(SlaveEvent::PhaseStarted, start); }
    void operator()(const messages::RealTimeStopped &stop) const
    {
        d.m_outputsAwaited.reset();
        d.stopPhase(stop);
    }

private:
    QPlcSlaveNodePrivate &d;
};

void QPlcSlaveNodePrivate::handle(const Message &message)
{
    if (state == QPlcSlaveNode::Registering && m_cyclicSocket
        && message.kind() == Message::SendYourInitialOutputStates) {
        m_outputsAwaited = message;  // it overtook CyclicChannelAttached, which comes on the other connection
        return;
    }
    if (eventOf(message))
        endRest();  // the master goes on: the phase that it has stopped is over
    if (!isExpected(message)) {
        qCWarning(lcSlave).noquote() << "node" << name << "ignores" << message.kindName()
                                     << "of the master: not possible now";
        return;
    }
    QString fault;
    if (messages::dispatch(messages::ToNode(), message, FromMaster(*this), &fault) == messages::Dispatch::Malformed)
        refuseUnreadable(message, fault);
    if (const auto failed = messages::readAs<messages::Failed>(message))
        qCWarning(lcSlave).noquote() << "node" << name << "asked in vain:" << qplc::printable(failed->text);
    if (!eventOf(message))
        Q_EMIT q->messageReceived(message);
}

/// A master that cannot be understood is none. Of a phase it is told why its node takes no part.
void QPlcSlaveNodePrivate::refuseUnreadable(const Message &message, const QString &reason)
{
    if (message.kind() == Message::RealTimeStarted)
        refusePhase(QPlcSlaveNode::ProtocolError,
                    QStringLiteral("the phase that the master begins is refused: %1").arg(reason));
    else
        giveUp(QPlcSlaveNode::ProtocolError,
               QStringLiteral("node '%1' cannot use %2 of the master at %3: %4")
                   .arg(name, message.kindName(), master.toString(), reason));
}
