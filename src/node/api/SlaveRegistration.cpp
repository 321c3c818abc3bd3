// SPDX-License-Identifier: Apache-2.0
// The registration of QPlcSlaveNodePrivate: from the greeting to the cyclic channel that is there.
#include "QPlcSignalIndexTable.h"
#include "QPlcSlaveNodePrivate.h"
#include "node/Logging.h"
#include "node/cycle/NodeRegistry.h"
#include "node/security/SealFields.h"
#include "signals/Fnv1a.h"
#include "transport/FaultLink.h"
#include "transport/TransportRegistry.h"

#include <algorithm>
#include <utility>

namespace messages = qplc::messages;
namespace feature = messages::feature;

namespace {

/// Whether an index means the same signal in both tables.
bool hasSameSignals(const QPlcSignalTable &a, const QPlcSignalTable &b)
{
    const auto isSame = [](const QPlcSignalDefinition &one, const QPlcSignalDefinition &other) {
        return one.name == other.name && one.type == other.type && one.unit == other.unit;
    };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), isSame);
}

}  // namespace

/// Whether cycles have an order because of this node. Before the table is known.
bool QPlcSlaveNodePrivate::isOrdered() const
{
    try {
        return sameCycle || twoPhase || code->declaresSameCycle();
    } catch (...) {
        return false;  // its code throws again when the node is bound, and is reported then
    }
}

/// Extensions that this node uses. A master that does not know `hardware` is as strict as a plant
/// anyway.
QStringList QPlcSlaveNodePrivate::features() const
{
    QStringList needed;
    if (isOrdered())
        needed.append(feature::sameCycle);
    if (quality)
        needed.append(feature::quality);
    if (outputQuality)
        needed.append(feature::outputQuality);
    if (hardware)
        needed.append(feature::hardware);
    return needed;
}

void QPlcSlaveNodePrivate::greet()
{
    qplc::ControlClient::Caller caller{name, messages::Part::Node, features(), m_uuid, {}};
    const QPlcSignalTable table = q->signalTable();
    if (!table.isEmpty())
        caller.tableHash = table.hash();
    control.setCaller(caller);
}

/// A table of the node's own stays. One that came from a master gives way to that of the present
/// master, which may have other safety parameters.
bool QPlcSlaveNodePrivate::chooseTable(QPlcSignalTable *table)
{
    *table = q->signalTable();
    const bool isOwn = !table->isEmpty() && !table->isFromMaster();
    const bool isCurrent = !table->isEmpty() && control.master().table.isEmpty();
    if (isOwn || isCurrent)
        return true;
    QVector<QPlcParseError> errors;
    const QPlcSignalTable offered = QPlcSignalTable::fromMaster(control.master().table.toUtf8(), &errors);
    if (offered.isEmpty()) {
        giveUp(QPlcSlaveNode::ProtocolError, QPlcParseError::toString(errors));
        return false;
    }
    if (!table->isEmpty() && !hasSameSignals(*table, offered))
        return true;  // lists of the program have indices of this table
    *table = offered;
    if (ownTable.isEmpty())
        QPlcSignalIndexTable::setCurrent(offered);
    else
        ownTable = offered;
    return true;
}

void QPlcSlaveNodePrivate::proceedAfterHello()
{
    const messages::MasterHello &hello = control.master();
    if (!hello.faults.isEmpty())
        qCWarning(lcSlave).noquote() << "the master at" << master.toString()
                                     << "injects faults on purpose:" << qplc::printable(hello.faults);
    const auto lacks = [&](bool needed, QLatin1String extension, const QString &what) {
        if (!needed || hello.features.contains(extension))
            return false;
        giveUp(
            QPlcSlaveNode::RegistrationError,
            QStringLiteral("the master at %1 does not know %2, which node '%3' needs; update the master, or do without "
                           "them")
                .arg(master.toString(), what, name));
        return true;
    };
    if (lacks(isOrdered(), feature::sameCycle, QStringLiteral("same-cycle inputs and two-phase nodes"))
        || lacks(outputQuality, feature::outputQuality, QStringLiteral("qualities of outputs")))
        return;
    runtime.setQualityOffered(hello.features.contains(feature::quality));
    QPlcSignalTable table;
    QString text;
    if (!chooseTable(&table))
        return;
    if (!runtime.bind(table, &text)) {
        giveUp(QPlcSlaveNode::SignalError, text);
        return;
    }
    registerAtMaster();
}

bool QPlcSlaveNodePrivate::hasSealedFrames() const
{
    return control.connection()->isSecured() && m_transport->isSealed();
}

qplc::ControlEnds QPlcSlaveNodePrivate::controlEnds() const
{
    const QPlcAbstractSocket &ends = *control.connection();
    return {qplc::SocketAddress(ends.localAddress(), ends.localPort()),
            qplc::SocketAddress(ends.peerAddress(), ends.peerPort()),
            control.master().session,
            {qplc::frameVolume(runtime.inputLayout(), hasSealedFrames()),
             qplc::frameVolume(runtime.outputLayout(), hasSealedFrames())}};
}

bool QPlcSlaveNodePrivate::beginLink(messages::Register *request)
{
    QString text;
    const bool hasBegun = m_transport->beginLink(controlEnds(), &request->transport, &m_link, &text);
    if (!hasBegun)
        giveUp(QPlcSlaveNode::ConnectionError, QStringLiteral("node '%1': %2").arg(name, text));
    return hasBegun;
}

/// The watchdog that the program has set, if it leads to the safe state; 0: it does not.
std::optional<std::chrono::nanoseconds> QPlcSlaveNodePrivate::ownWatchdog() const
{
    constexpr std::chrono::nanoseconds none{0};
    if (watchdogReaction == QPlcSlaveNode::WatchdogReaction::Report)
        return none;
    if (!watchdog || *watchdog == none)
        return watchdog;
    return std::max<std::chrono::nanoseconds>(*watchdog, watchdogPeriods * control.master().period);
}

void QPlcSlaveNodePrivate::registerAtMaster()
{
    messages::Register request = qplc::NodeDeclaration::fromRuntime(runtime).toMessage();
    request.uuid = m_uuid;
    request.watchdog = ownWatchdog();
    request.cyclic = master.kindName();
    request.faults = faultPlan;
    if (beginLink(&request))
        send(request);
}

void QPlcSlaveNodePrivate::proceedAfterRegistered(const messages::Registered &registered)
{
    if (registered.inputsHash != runtime.inputLayout().hash()
        || registered.outputsHash != runtime.outputLayout().hash()) {
        giveUp(QPlcSlaveNode::ProtocolError,
               QStringLiteral("master and node '%1' disagree on the layout of the frames").arg(name));
        return;
    }
    std::optional<qplc::SealKeys> keys;
    if (hasSealedFrames()) {
        keys = registered.seal ? qplc::sealKeys(*registered.seal) : std::nullopt;
        if (!keys) {
            giveUp(QPlcSlaveNode::ProtocolError,
                   QStringLiteral("the master at %1 gives node '%2' no keys for its frames; update the master")
                       .arg(master.toString(), name));
            return;
        }
    }
    const qplc::SlaveCycle::Identity identity{control.master().session, registered.node, keys};
    cycle = std::make_unique<qplc::SlaveCycle>(runtime, identity, lcCyclic().isDebugEnabled());
    m_reportNotifier = std::make_unique<QSocketNotifier>(cycle->reports().descriptor(), QSocketNotifier::Read);
    QObject::connect(m_reportNotifier.get(), &QSocketNotifier::activated, q, [this] { takeReports(); });
    if (registered.probe && m_transport->first())
        probe(registered);
    else
        openChannel(registered, m_transport->first() ? *m_transport->fallback() : *m_transport);
}

/// Looks whether frames would get through in both directions, with datagrams as long as the longest
/// one.
void QPlcSlaveNodePrivate::probe(const messages::Registered &registered)
{
    const qplc::CycleVolume volume = controlEnds().volume;
    const auto longest
        = [](const qplc::FrameVolume &frames) { return frames.frames > 1 ? qplc::MaximumCyclicFrame : frames.bytes; };
    const auto done
        = [this, registered](bool getsThrough) {
              const qplc::TransportKind &choice = *m_transport;
              m_probe.reset();
              if (!getsThrough)
                  qCWarning(lcSlave).noquote()
                      << QStringLiteral(
                             "node '%1': %2 does not get through (no answer within %3 ms to %4 datagrams): frames "
                             "use %5")
                             .arg(name, choice.first()->name().toUpper())
                             .arg(qplc::DatagramProbe::Questions * qplc::DatagramProbe::Interval)
                             .arg(qplc::DatagramProbe::Questions)
                             .arg(choice.fallback()->name().toUpper());
              openChannel(registered, getsThrough ? *choice.first() : *choice.fallback());
          };
    m_probe = std::make_unique<qplc::DatagramProbe>(
        *m_link, qplc::ProbeNumbers{registered.probe->question, registered.probe->answer},
        std::max(longest(volume.inputs), longest(volume.outputs)), done);
}

/// Begins the cyclic channel over \a kind: the transport of Register, or one that it stands for.
void QPlcSlaveNodePrivate::openChannel(const messages::Registered &registered, const qplc::TransportKind &kind)
{
    const bool isChosen = m_transport != &kind;
    m_transport = &kind;
    const messages::AttachCyclicChannel wish{registered.node, registered.token, isChosen ? kind.name() : QString()};
    if (kind.hasStreams()) {
        m_link.reset();
        connectCyclicChannel(wish);
    } else if (finishLink(registered)) {
        giveLink(std::move(m_link));
        if (isChosen)
            send(wish);
    }
}

bool QPlcSlaveNodePrivate::finishLink(const messages::Registered &registered)
{
    QString text;
    const bool isReady = m_transport->finishLink(controlEnds(), registered.transport, &m_link, &text);
    if (!isReady)
        giveUp(QPlcSlaveNode::ConnectionError, QStringLiteral("node '%1': %2").arg(name, qplc::printable(text)));
    return isReady;
}

/// Gives the cycle its link, with the faults that are wanted in between.
void QPlcSlaveNodePrivate::giveLink(std::unique_ptr<qplc::CyclicLink> link)
{
    QString text;
    if (const auto plan = qplc::FaultPlan::fromText(faultPlan, &text); plan && !faultPlan.isEmpty()) {
        qCWarning(lcSlave).noquote() << "node" << name << "injects faults on purpose:" << faultPlan;
        link = std::make_unique<qplc::FaultLink>(std::move(link), *plan, qplc::fnv1a64(name.toUtf8()));
    }
    cycle->setLink(std::move(link));
}

void QPlcSlaveNodePrivate::connectCyclicChannel(const messages::AttachCyclicChannel &wish)
{
    m_cyclicSocket = new QPlcMasterSocket(q);
    m_cyclicSocket->setSecurity(QPlcSecurity());  // frames are no TLS; the token came over the control connection
    QObject::connect(m_cyclicSocket, &QPlcAbstractSocket::connected, q,
                     [this, wish] { m_cyclicSocket->sendMessage(messages::toMessage(wish)); });
    QObject::connect(m_cyclicSocket, &QPlcAbstractSocket::errorOccurred, q,
                     [this](QPlcAbstractSocket::Error e) { masterLost(e, m_cyclicSocket->errorString()); });
    QObject::connect(m_cyclicSocket, &QPlcAbstractSocket::messageReceived, q, [this](const QPlcMessage &message) {
        if (!messages::readAs<messages::CyclicChannelAttached>(message)) {
            const auto rejected = messages::readAs<messages::Rejected>(message);
            giveUp(QPlcSlaveNode::RegistrationError,
                   QStringLiteral("the master refuses the cyclic connection: %1")
                       .arg(rejected ? qplc::printable(rejected->text) : message.kindName()));
            return;
        }
        const int descriptor = m_cyclicSocket->takeDescriptor();
        m_cyclicSocket->deleteLater();
        m_cyclicSocket = nullptr;
        giveLink(m_transport->makeStreamLink(descriptor, cycle->inputCutter(), qplc::MaximumCyclicFrame));
        apply(qplc::SlaveEvent::ChannelAttached);
    });
    m_cyclicSocket->connectToMaster(master);
}

void QPlcSlaveNodePrivate::tellRegistered()
{
    const bool isChosen = m_transport->name() != master.kindName();
    qCInfo(lcSlave).noquote().nospace() << "node " << name << " registered at " << master.toString()
                                        << (isChosen ? ", frames use " + m_transport->name() : QString());
    error = QPlcSlaveNode::NoError;
    errorString.clear();
    m_wasRegistered = true;
    m_backOff.reset();
    m_patience.stop();
    hasChannel = true;
    events.masterCame();
    Q_EMIT q->connectedToMaster();
    if (const auto request = std::exchange(m_outputsAwaited, std::nullopt))
        handle(*request);
}
