// SPDX-License-Identifier: Apache-2.0
#include "QPlcSlaveNodePrivate.h"

#include "FrameLog.h"
#include "Logging.h"

#include <QtCore/QMetaMethod>
#include <QtCore/QUuid>

using Message = QPlcMessage;

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

}  // namespace

QPlcSlaveNodePrivate::QPlcSlaveNodePrivate(QPlcSlaveNode *node, const QString &nodeName,
                                           QPlcSlaveNode::RealTimeViolationPolicy violationPolicy)
    : q(node)
    , name(nodeName)
    , policy(violationPolicy)
    , runtime(*node)
    , m_uuid(QUuid::createUuid().toString(QUuid::WithoutBraces))
{
}

void QPlcSlaveNodePrivate::setState(QPlcSlaveNode::State newState)
{
    if (state == newState)
        return;
    state = newState;
    qCDebug(lcSlave) << name << newState;
    Q_EMIT q->stateChanged(newState);
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
    m_session = 0;
    if (!master.isValid()) {
        setError(QPlcSlaveNode::OptionError,
                 QStringLiteral("node '%1': no master given; use QPlcUnderlyingProtocol::tcp(), udp() or local()")
                     .arg(name));
        return;
    }
    setState(QPlcSlaveNode::Connecting);
    control = new QPlcMasterSocket(q);
    if (security)
        control->setSecurity(*security);
    QObject::connect(control, &QPlcAbstractSocket::connected, q, [this] { greet(); });
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
    if (!control)
        return;  // not connected, or in the process of its master, who removes it
    const bool wasRegistered = state >= QPlcSlaveNode::Off;
    stopCycles();
    closeSockets();
    setState(QPlcSlaveNode::Disconnected);
    if (wasRegistered)
        Q_EMIT q->disconnectedFromMaster();
}

void QPlcSlaveNodePrivate::closeSockets()
{
    for (QPlcMasterSocket **socket : {&control, &m_cyclicSocket}) {
        if (!*socket)
            continue;
        (*socket)->disconnect(q);
        (*socket)->close();
        (*socket)->deleteLater();
        *socket = nullptr;
    }
    m_link.reset();
    m_reportNotifier.reset();
    m_outputsAwaited = false;
    cycle.reset();
}

void QPlcSlaveNodePrivate::masterLost(QPlcAbstractSocket::Error socketError, const QString &text)
{
    const bool wasConnecting = state == QPlcSlaveNode::Connecting;
    const QString sentence = socketError == QPlcAbstractSocket::SecurityError
        ? QStringLiteral("node '%1' is not accepted at %2: %3")
        : wasConnecting
        ? QStringLiteral("node '%1' cannot reach a master at %2: %3; start the master, or check address and port")
        : QStringLiteral("node '%1' has lost the master at %2: %3");
    const QString full = sentence.arg(name, master.toString(), text);
    const QPlcAbstractSocket::Error reason
        = socketError == QPlcAbstractSocket::NoError ? QPlcAbstractSocket::ConnectionLostError : socketError;
    disconnectFromMaster();
    setError(reason == QPlcAbstractSocket::ProtocolError ? QPlcSlaveNode::ProtocolError
                                                         : QPlcSlaveNode::ConnectionError,
             full);
    Q_EMIT q->errorWithMaster(reason, full);
}

void QPlcSlaveNodePrivate::giveUp(QPlcSlaveNode::Error newError, const QString &text)
{
    disconnectFromMaster();
    setError(newError, text);
}

// ---- messages ----

/// Whether a master may send \a kind now. Anything else would call the code of the node before it is bound, or on two threads at a time.
bool QPlcSlaveNodePrivate::isExpected(Message::Kind kind) const
{
    switch (kind) {
    case Message::Hello:
        return state == QPlcSlaveNode::Connecting && m_session == 0;
    case Message::Registered:
        return state == QPlcSlaveNode::Connecting && m_session != 0 && !cycle;
    case Message::CyclicChannelAttached:
        return state == QPlcSlaveNode::Connecting && cycle && master.kind() != QPlcUnderlyingProtocol::Tcp;
    case Message::SendYourInitialOutputStates:
    case Message::InitializeWithValues:
        return state == QPlcSlaveNode::Off || state == QPlcSlaveNode::Initializing;
    case Message::RealTimeStarted:
        return state == QPlcSlaveNode::Off;
    default:
        return true;
    }
}

void QPlcSlaveNodePrivate::receive(const Message &message)
{
    if (state == QPlcSlaveNode::Connecting && m_cyclicSocket
        && message.kind() == Message::SendYourInitialOutputStates) {
        m_outputsAwaited = true;  // it overtook CyclicChannelAttached, which comes on the other connection
        return;
    }
    if (!isExpected(message.kind())) {
        qCWarning(lcSlave).noquote() << "node" << name << "ignores" << message.kindName()
                                     << "of the master: not possible now";
        return;
    }
    switch (message.kind()) {
    case Message::Hello:
        receiveHello(message);
        break;
    case Message::Registered:
        receiveRegistered(message);
        break;
    case Message::CyclicChannelAttached:
        cyclicChannelAttached();
        break;
    case Message::Rejected:
        giveUp(QPlcSlaveNode::RegistrationError,
               QStringLiteral("the master at %1 refuses node '%2': %3")
                   .arg(master.toString(), name, qplc::printable(message.text(QStringLiteral("text")))));
        break;
    case Message::MasterEnds:
        qCInfo(lcSlave).noquote() << "node" << name << "- the master has ended";
        disconnectFromMaster();
        break;
    case Message::SendYourInitialOutputStates:
        sendInitialOutputs();
        break;
    case Message::InitializeWithValues:
        initializeWith(message);
        break;
    case Message::RealTimeStarted:
        startCycles(message);
        break;
    case Message::RealTimeStopped:
        stopCycles();
        initializationFailed();
        break;
    case Message::StatesInitialized:
        if (!message.fields().value(QStringLiteral("ok")).toBool())
            initializationFailed();
        Q_EMIT q->messageReceived(message);
        break;
    case Message::Failed:
        qCWarning(lcSlave).noquote() << "node" << name
                                     << "asked in vain:" << qplc::printable(message.text(QStringLiteral("text")));
        Q_FALLTHROUGH();
    default:
        Q_EMIT q->messageReceived(message);
        break;
    }
}

// ---- phases ----

void QPlcSlaveNodePrivate::sendInitialOutputs()
{
    setState(QPlcSlaveNode::Initializing);
    QString text;
    if (!runtime.reset(&text)) {
        control->sendMessage(Message(Message::NodeFault, {{QStringLiteral("text"), text}}));
        setState(QPlcSlaveNode::Off);
        setError(QPlcSlaveNode::UserCodeError, QStringLiteral("node '%1': %2").arg(name, text));
        return;
    }
    const QByteArray values(runtime.outputs(), int(runtime.outputLayout().size()));
    control->sendMessage(
        Message(Message::ReceiveMyInitialOutputStates, {{QStringLiteral("values"), Message::fromBytes(values)}}));
}

void QPlcSlaveNodePrivate::initializeWith(const Message &message)
{
    const QByteArray values = message.bytes(QStringLiteral("values"));
    if (values.size() != int(runtime.inputLayout().size())) {
        giveUp(QPlcSlaveNode::ProtocolError,
               QStringLiteral("node '%1': initial values of %2 bytes instead of %3")
                   .arg(name)
                   .arg(values.size())
                   .arg(runtime.inputLayout().size()));
        return;
    }
    QString text;
    const bool initialized = runtime.initialize(values.constData(), &text);
    setState(QPlcSlaveNode::Off);
    if (!initialized) {
        control->sendMessage(Message(Message::NodeFault, {{QStringLiteral("text"), text}}));
        setError(QPlcSlaveNode::UserCodeError, QStringLiteral("node '%1': %2").arg(name, text));
        return;
    }
    control->sendMessage(Message(Message::Initialized));
    tellInitialized(values);
}

void QPlcSlaveNodePrivate::tellInitialized(const QByteArray &inputs)
{
    if (q->isSignalConnected(QMetaMethod::fromSignal(&QPlcSlaveNode::hasInitialized)))
        Q_EMIT q->hasInitialized(qplc::NodeRuntime::toList(runtime.inputLayout(), inputs.constData()));
}

/// The master has given up what it began: nothing more will come.
void QPlcSlaveNodePrivate::initializationFailed()
{
    m_outputsAwaited = false;
    if (state == QPlcSlaveNode::Initializing)
        setState(QPlcSlaveNode::Off);
}

void QPlcSlaveNodePrivate::startCycles(const Message &message)
{
    if (!cycle)
        return;
    qplc::SlaveCycle::Phase phase;
    phase.period = std::chrono::nanoseconds(qint64(message.fields().value(QStringLiteral("period")).toDouble()));
    phase.clock = clockOf(message);
    phase.cycleZero = message.hex64(QStringLiteral("cycleZero"));
    phase.firstCycle = message.hex64(QStringLiteral("firstCycle"));
    phase.group = groupOf(message, runtime.inputLayout());
    phase.interval = interval;
    phase.watchdog = watchdog;
    phase.realTimeOptions = realTimeOptions;
    if (!cycle->start(phase)) {
        control->sendMessage(Message(Message::NodeFault, {{QStringLiteral("text"), cycle->errorString()}}));
        setError(QPlcSlaveNode::OptionError, QStringLiteral("node '%1': %2").arg(name, cycle->errorString()));
        return;
    }
    for (const QPlcRealTimeSetting &setting : cycle->realTimeSettings()) {
        if (!setting.granted)
            qCWarning(lcSlave).noquote() << "node" << name << setting.toString();
    }
    setState(QPlcSlaveNode::RealTime);
    control->sendMessage(Message(Message::RealTimeReady));
    Q_EMIT q->realTimeHasStarted();
}

void QPlcSlaveNodePrivate::stopCycles()
{
    if (state != QPlcSlaveNode::RealTime)
        return;
    cycle->stop();
    takeReports();
    runtime.stopped();
    setState(QPlcSlaveNode::Off);
    Q_EMIT q->realTimeHasStopped();
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
    case qplc::CycleEvent::WatchdogTimedOut:
        setError(QPlcSlaveNode::WatchdogError,
                 QStringLiteral("node '%1': no frame of the master for %2 ms since cycle %3")
                     .arg(name)
                     .arg(double(watchdog.count()) * 1e-6)
                     .arg(event.cycle));
        Q_EMIT q->watchdogTimedOut(event.cycle);
        break;
    case qplc::CycleEvent::NodeFaulted: {
        const QString text = QStringLiteral("the code of the node threw in cycle %1: %2")
                                 .arg(event.cycle)
                                 .arg(QString::fromLocal8Bit(runtime.faultText()));
        if (control)
            control->sendMessage(Message(Message::NodeFault, {{QStringLiteral("text"), text}}));
        setError(QPlcSlaveNode::UserCodeError, QStringLiteral("node '%1': %2").arg(name, text));
        break;
    }
    case qplc::CycleEvent::LinkClosed:
        qCDebug(lcSlave).noquote()
            << "node" << name << "has lost its cyclic connection";  // the control connection follows, with the reason
        break;
    default:
        break;
    }
}
