// SPDX-License-Identifier: Apache-2.0
#include "QPlcSlaveNodePrivate.h"

#include "FrameLog.h"
#include "Logging.h"
#include "PeriodRange.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QMetaMethod>
#include <QtCore/QRandomGenerator>
#include <QtCore/QUuid>

#include <algorithm>
#include <optional>
#include <utility>

using Message = QPlcMessage;
using qplc::SlaveEvent;

namespace {

QPlcClock clockOf(const Message &message)
{
    const QString kind = message.text(QStringLiteral("clock"));
    if (kind == QLatin1String("Lockstep"))
        return QPlcClock::lockstep();
    if (kind == QLatin1String("Scaled"))
        return QPlcClock::scaled(message.fields().value(QStringLiteral("scale")).toDouble(1.0));
    return QPlcClock::realTime();
}

/// What a node cannot compute with of a phase that its master begins; empty: nothing.
QString phaseError(const Message &message)
{
    const double period = message.fields().value(QStringLiteral("period")).toDouble();  // [ns]
    if (!(period >= double(qplc::ShortestPeriod.count()) && period <= double(qplc::LongestPeriod.count())))
        return QStringLiteral("a period of %1 s is out of range; use 0.00001 ... 10 s").arg(period * 1e-9);
    const QPlcClock clock = clockOf(message);
    if (!clock.isValid())
        return QStringLiteral("a clock of %1 times real time is out of range; use 0.001 ... 1000, or lockstep")
            .arg(clock.scale());
    const quint64 first = message.hex64(QStringLiteral("firstCycle")) - message.hex64(QStringLiteral("cycleZero"));
    if (first >= qplc::mostCycles(std::chrono::nanoseconds(qint64(period))))
        return QStringLiteral("it begins with cycle %1, which has no time").arg(qint64(first));
    return {};
}

/// Where the inputs lie in datagrams for many nodes; what is out of place is refused by its size of 0, and no frame will fit.
qplc::SlaveCycle::Group groupOf(const Message &message, const qplc::PayloadLayout &inputs)
{
    const QJsonObject fields = message.fields().value(QStringLiteral("group")).toObject();
    const double offset = fields.value(QStringLiteral("offset")).toDouble();
    const double size = fields.value(QStringLiteral("size")).toDouble();
    if (fields.isEmpty() || offset < 2 || size > double(qplc::MaximumCyclicPayload)
        || offset + double(inputs.size()) > size)
        return {};
    return {std::uint16_t(fields.value(QStringLiteral("part")).toInt()), std::uint32_t(offset), std::uint32_t(size),
            QPlcMessage(Message::RealTimeStarted, fields).hex64(QStringLiteral("hash"))};
}

bool hasCycles(QPlcMasterNode::State state)
{
    return state == QPlcMasterNode::RealTime || state == QPlcMasterNode::WaitingForLateSlaves
        || state == QPlcMasterNode::SafeStop;
}

/// What a message of the master means to the node; none: nothing to its state.
std::optional<SlaveEvent> eventOf(const Message &message)
{
    switch (message.kind()) {
    case Message::Hello:
        return SlaveEvent::HelloCame;
    case Message::Registered:
        return SlaveEvent::Accepted;
    case Message::CyclicChannelAttached:
        return SlaveEvent::ChannelAttached;
    case Message::Rejected:
        return SlaveEvent::Refused;
    case Message::MasterEnds:
        return SlaveEvent::MasterEnded;
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

}  // namespace

QPlcSlaveNodePrivate::QPlcSlaveNodePrivate(QPlcSlaveNode *node, const QString &nodeName,
                                           QPlcSlaveNode::RealTimeViolationPolicy violationPolicy)
    : q(node)
    , name(nodeName)
    , policy(violationPolicy)
    , runtime(*node)
    , m_retryTimer(q)
    , m_patience(q)
    , m_uuid(QUuid::createUuid().toString(QUuid::WithoutBraces))
{
    m_retryTimer.setSingleShot(true);
    QObject::connect(&m_retryTimer, &QTimer::timeout, q, [this] { apply(SlaveEvent::Retry); });
    m_patience.setSingleShot(true);
    QObject::connect(&m_patience, &QTimer::timeout, q, [this] {
        masterLost(QPlcAbstractSocket::NoError,
                   QStringLiteral("no answer within %1 s").arg(m_patience.interval() / 1000));
    });
    // A program that ends says goodbye in time: its node reaches its safe state before its destructor runs.
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

// ---- connection ----

void QPlcSlaveNodePrivate::connectToMaster(const QPlcUnderlyingProtocol &newMaster)
{
    disconnectFromMaster();
    error = QPlcSlaveNode::NoError;
    errorString.clear();
    master = newMaster;
    m_wasRegistered = false;
    m_backOff.reset();
    if (!master.isValid()) {
        setError(QPlcSlaveNode::OptionError,
                 QStringLiteral("node '%1': no master given; use QPlcUnderlyingProtocol::tcp(), udp() or local()")
                     .arg(name));
        return;
    }
    apply(SlaveEvent::Connect);
}

void QPlcSlaveNodePrivate::openConnection()
{
    m_session = 0;
    if (m_wasRegistered || reconnectPolicy == QPlcSlaveNode::ReconnectAlways)
        m_patience.start(m_backOff.patience());
    control = new QPlcMasterSocket(q);
    if (security)
        control->setSecurity(*security);
    QObject::connect(control, &QPlcAbstractSocket::connected, q, [this] { apply(SlaveEvent::Connected); });
    QObject::connect(control, &QPlcAbstractSocket::messageReceived, q,
                     [this](const Message &message) { receive(message); });
    // Not at once: a message that cannot be sent ends the connection, and who sends has more to do.
    const auto controlLost = [this, socket = control](QPlcAbstractSocket::Error socketError) {
        if (socket == control)  // else given up meanwhile
            masterLost(socketError,
                       socketError == QPlcAbstractSocket::NoError ? QStringLiteral("the connection was closed")
                                                                  : socket->errorString());
    };
    QObject::connect(control, &QPlcAbstractSocket::errorOccurred, q, controlLost, Qt::QueuedConnection);
    QObject::connect(
        control, &QPlcAbstractSocket::disconnected, q, [controlLost] { controlLost(QPlcAbstractSocket::NoError); },
        Qt::QueuedConnection);
    control->connectToMaster(master);
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
    const bool cyclesRun = localMaster ? hasCycles(localMaster->state()) : m_inPhase;
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
    for (QPlcMasterSocket **socket : {&control, &m_cyclicSocket}) {
        if (!*socket)
            continue;
        (*socket)->disconnect(q);
        (*socket)->close();
        (*socket)->deleteLater();
        *socket = nullptr;
    }
    m_patience.stop();
    m_link.reset();
    m_reportNotifier.reset();
    m_outputsAwaited = false;
    hasChannel = false;
    cycle.reset();
}

/// The reports of the cycle, which tell of the watchdog, are being read: the cycle ends behind them.
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
    const double chance = QRandomGenerator::global()->generateDouble();
    m_retryTimer.start(event == SlaveEvent::Refused ? m_backOff.afterRefusal(chance) : m_backOff.next(chance));
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

/// Whether a master may send \a message now. Anything else would call the code of the node before it is bound, or on two threads at a time.
bool QPlcSlaveNodePrivate::isExpected(const Message &message) const
{
    const std::optional<SlaveEvent> event = eventOf(message);
    if (event && qplc::slaveStates().at(state, *event).verdict == qplc::Verdict::Refused)
        return false;
    switch (message.kind()) {  // steps of the registration
    case Message::Hello:
        return m_session == 0;
    case Message::Registered:
        return m_session != 0 && !cycle;
    case Message::CyclicChannelAttached:
        return cycle && master.kind() != QPlcUnderlyingProtocol::Tcp;
    default:
        return true;
    }
}

void QPlcSlaveNodePrivate::receive(const Message &message)
{
    if (state == QPlcSlaveNode::Registering && m_cyclicSocket
        && message.kind() == Message::SendYourInitialOutputStates) {
        m_outputsAwaited = true;  // it overtook CyclicChannelAttached, which comes on the other connection
        return;
    }
    if (!isExpected(message)) {
        qCWarning(lcSlave).noquote() << "node" << name << "ignores" << message.kindName()
                                     << "of the master: not possible now";
        return;
    }
    switch (message.kind()) {
    case Message::Rejected:
        giveUp(QPlcSlaveNode::RegistrationError,
               QStringLiteral("the master at %1 refuses node '%2': %3")
                   .arg(master.toString(), name, qplc::printable(message.text(QStringLiteral("text")))));
        return;
    case Message::MasterEnds:
        qCInfo(lcSlave).noquote() << "node" << name << "- the master has ended";
        break;
    case Message::RealTimeStopped:
        m_outputsAwaited = false;
        break;
    case Message::StatesInitialized:
        if (!message.fields().value(QStringLiteral("ok")).toBool()) {
            m_outputsAwaited = false;  // the master has given up what it began
            apply(SlaveEvent::InitializationFailed);
        }
        break;
    case Message::Failed:
        qCWarning(lcSlave).noquote() << "node" << name
                                     << "asked in vain:" << qplc::printable(message.text(QStringLiteral("text")));
        break;
    default:
        break;
    }
    if (const std::optional<SlaveEvent> event = eventOf(message))
        apply(*event, message);
    else
        Q_EMIT q->messageReceived(message);
}

void QPlcSlaveNodePrivate::proceed(SlaveEvent event, const Message &message)
{
    if (event == SlaveEvent::HelloCame)
        receiveHello(message);
    else
        receiveRegistered(message);
}

// ---- phases ----

/// The code of the derived class threw: the master is told, and the node waits in its safe state for the next initialization.
void QPlcSlaveNodePrivate::codeFailed(const QString &text)
{
    if (control)
        control->sendMessage(Message(Message::NodeFault, {{QStringLiteral("text"), text}}));
    makeSafe(QPlcSlaveNode::CodeFailed);
    apply(SlaveEvent::CodeFailed);
    setError(QPlcSlaveNode::UserCodeError, QStringLiteral("node '%1': %2").arg(name, text));
}

void QPlcSlaveNodePrivate::sendInitialOutputs()
{
    QString text;
    if (!runtime.reset(&text)) {
        codeFailed(text);
        return;
    }
    const QByteArray values(runtime.outputs(), int(runtime.outputLayout().size()));
    control->sendMessage(
        Message(Message::ReceiveMyInitialOutputStates, {{QStringLiteral("values"), Message::fromBytes(values)}}));
}

bool QPlcSlaveNodePrivate::initializeWith(const Message &message)
{
    const QByteArray values = message.bytes(QStringLiteral("values"));
    if (values.size() != int(runtime.inputLayout().size())) {
        giveUp(QPlcSlaveNode::ProtocolError,
               QStringLiteral("node '%1': initial values of %2 bytes instead of %3")
                   .arg(name)
                   .arg(values.size())
                   .arg(runtime.inputLayout().size()));
        return false;
    }
    QString text;
    if (!runtime.initialize(values.constData(), &text)) {
        codeFailed(text);
        return false;
    }
    control->sendMessage(Message(Message::Initialized));
    tellInitialized();
    return true;
}

void QPlcSlaveNodePrivate::tellInitialized()
{
    if (q->isSignalConnected(QMetaMethod::fromSignal(&QPlcSlaveNode::hasInitialized)))
        Q_EMIT q->hasInitialized(qplc::NodeRuntime::toList(runtime.inputLayout(), runtime.inputs()));
}

bool QPlcSlaveNodePrivate::refusePhase(QPlcSlaveNode::Error reason, const QString &text)
{
    control->sendMessage(Message(Message::NodeFault, {{QStringLiteral("text"), text}}));
    setError(reason, QStringLiteral("node '%1': %2").arg(name, text));
    return false;
}

bool QPlcSlaveNodePrivate::startCycles(const Message &message)
{
    const QString wrong = phaseError(message);
    if (!wrong.isEmpty())
        return refusePhase(QPlcSlaveNode::ProtocolError,
                           QStringLiteral("the phase that the master begins is refused: %1").arg(wrong));
    qplc::SlaveCycle::Phase phase;
    phase.period = std::chrono::nanoseconds(qint64(message.fields().value(QStringLiteral("period")).toDouble()));
    phase.clock = clockOf(message);
    phase.cycleZero = message.hex64(QStringLiteral("cycleZero"));
    phase.firstCycle = message.hex64(QStringLiteral("firstCycle"));
    phase.group = groupOf(message, runtime.inputLayout());
    phase.interval = interval;
    phase.watchdog = watchdogOfPhase = std::max(watchdog, watchdogPeriods * interval.cycles() * phase.period);
    phase.realTimeOptions = realTimeOptions;
    if (!cycle->start(phase))
        return refusePhase(QPlcSlaveNode::OptionError, cycle->errorString());
    for (const QPlcRealTimeSetting &setting : cycle->realTimeSettings()) {
        if (!setting.granted)
            qCWarning(lcSlave).noquote() << "node" << name << setting.toString();
    }
    m_inPhase = true;
    ++m_phase;
    return true;
}

void QPlcSlaveNodePrivate::haltCycles()
{
    if (!m_inPhase)
        return;
    cycle->stop();
    takeReports();
}

/// \pre haltCycles()
void QPlcSlaveNodePrivate::endPhase(QPlcSlaveNode::SafeStateReason reason)
{
    if (!m_inPhase)
        return;
    m_inPhase = false;
    makeSafe(reason);
    runtime.stopped();
}

void QPlcSlaveNodePrivate::takeReports()
{
    if (!cycle)
        return;
    cycle->reports().take([this](const qplc::CycleEvent &event) { report(event); },
                          [this](const qplc::TappedFrame &frame) { qplc::logFrame(name, frame); });
}

void QPlcSlaveNodePrivate::report(const qplc::CycleEvent &event)
{
    switch (event.kind) {
    case qplc::CycleEvent::ToldSafeStop:
        qCWarning(lcSlave).noquote() << "node" << name << "- the master stops safely, in cycle" << event.cycle;
        tellSafe(QPlcSlaveNode::MasterStopsSafely);
        apply(SlaveEvent::ToldSafeStop);
        break;
    case qplc::CycleEvent::WatchdogTimedOut:
        tellSafe(QPlcSlaveNode::WatchdogReason);
        apply(SlaveEvent::WatchdogTimedOut);
        setError(QPlcSlaveNode::WatchdogError,
                 QStringLiteral("node '%1': no frame of the master for %2 ms since cycle %3: safe state")
                     .arg(name)
                     .arg(double(watchdogOfPhase.count()) * 1e-6)
                     .arg(event.cycle));
        Q_EMIT q->watchdogTimedOut(event.cycle);
        break;
    case qplc::CycleEvent::NodeFaulted:
        codeFailed(QStringLiteral("the code of the node threw in cycle %1: %2")
                       .arg(event.cycle)
                       .arg(QString::fromLocal8Bit(runtime.faultText())));
        break;
    case qplc::CycleEvent::ForgedFrame:
        qCWarning(lcSlave).noquote() << "node" << name
                                     << "drops frames that are not as its master seals them, since cycle" << event.cycle
                                     << "- somebody else sends them, or they are changed on the way";
        break;
    case qplc::CycleEvent::LinkClosed:
        qCDebug(lcSlave).noquote()
            << "node" << name << "has lost its cyclic connection";  // the control connection follows, with the reason
        break;
    default:
        break;
    }
}
