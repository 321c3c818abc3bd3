// SPDX-License-Identifier: Apache-2.0
#include "QPlcMasterNodePrivate.h"

#include "QPlcSignalIndexTable.h"
#include "QPlcSlaveNodePrivate.h"
#include "node/Logging.h"
#include "node/session/MasterReplies.h"
#include "realtime/Host.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QMetaEnum>

#include <cmath>

#include <algorithm>

using Message = QPlcMessage;
using Event = qplc::MasterEvent;
using qplc::NodeSlot;

namespace {

quint64 newSession()
{
    return qplc::Host::current().random() | 1;  // never 0
}

/// What an error is about, unless who tells it knows better.
qplc::JournalEvent::Kind kindOf(QPlcMasterNode::Error error)
{
    switch (error) {
    case QPlcMasterNode::SignalError:
        return qplc::JournalEvent::Set;
    case QPlcMasterNode::NodeError:
        return qplc::JournalEvent::Node;
    case QPlcMasterNode::InitializationError:
        return qplc::JournalEvent::Fault;
    default:
        return qplc::JournalEvent::State;
    }
}

}  // namespace

QPlcMasterNodePrivate::QPlcMasterNodePrivate(QPlcMasterNode *master)
    : q(master)
    , refusedValues(journal,
                    [this](QPlcSignalIndex signal) {
                        const qplc::SignalGuard &guard = cycle->signalGuard();
                        return guard.nonFinite(signal) + guard.outOfRange(signal);
                    })
    , session(newSession())
    , uuid(qplc::newUuid())
{
    stepTimer.setSingleShot(true);
    stepTimer.setInterval(2000);
    QObject::connect(&stepTimer, &QTimer::timeout, q, [this] { stepTimedOut(); });
}

QPlcMasterNodePrivate::~QPlcMasterNodePrivate() = default;

bool QPlcMasterNodePrivate::setError(QPlcMasterNode::Error newError, const QString &text)
{
    return setError(newError, text, qplc::NodeRegistry::masterName(), kindOf(newError));
}

bool QPlcMasterNodePrivate::setError(QPlcMasterNode::Error newError, const QString &text, const QString &source,
                                     qplc::JournalEvent::Kind kind)
{
    using qplc::JournalEvent;
    error = newError;
    errorString = text;
    const auto severity = newError == QPlcMasterNode::StateError ? JournalEvent::Warning : JournalEvent::Error;
    if (kind == JournalEvent::Fault)
        journal.raise(QStringLiteral("fault of ") + source, severity, kind, source, text);
    else
        journal.tell(severity, kind, source, text);
    Q_EMIT q->errorOccurred(newError);
    return false;
}

// ---- set-up ----

bool QPlcMasterNodePrivate::prepare()
{
    if (registry)
        return true;
    if (table.isEmpty())
        table = QPlcSignalIndexTable::current();
    if (table.isEmpty())
        return setError(
            QPlcMasterNode::SignalError,
            QStringLiteral(
                "the master has no signals; read a table with QPlcSignalIndexTable::initializeFromIniFile() %1")
                .arg(QPlcSignalIndexTable::lastErrorString())
                .trimmed());
    registry = std::make_unique<qplc::NodeRegistry>(table);
    cycle = std::make_unique<qplc::MasterCycle>(table, hub, lcCyclic().isDebugEnabled());
    settings = std::make_unique<qplc::MasterSettings>(*registry, *cycle, leaseBooks);
    m_reportNotifier = std::make_unique<QSocketNotifier>(cycle->reports().descriptor(), QSocketNotifier::Read);
    QObject::connect(m_reportNotifier.get(), &QSocketNotifier::activated, q, [this] { takeReports(); });
    const auto hello = [this] {
        qplc::messages::MasterHello message;
        message.protocol = qplc::messages::protocolVersion;
        message.name = qplc::NodeRegistry::masterName();
        message.uuid = uuid;
        message.session = session;
        message.tableHash = table.hash();
        message.state = qplc::messageStateOf(state);
        message.period = interval;
        message.security = networkSecurity;
        message.faults = faultPlan;
        return message;
    };
    const auto objection = [this](const qplc::NodeDeclaration &node) { return objectionTo(node); };
    server = std::make_unique<qplc::MasterServer>(*registry, cycle->image(), hub, session, hello, objection, nullptr);
    QObject::connect(server.get(), &qplc::MasterServer::attached, q, [this](Connection *connection) {
        settings->leaveToWriters();
        journal.tell(qplc::JournalEvent::Info, qplc::JournalEvent::Node, connection->name,
                     QStringLiteral("node %1 registered over %2").arg(connection->name, connection->cyclicKind));
        journal.clear(QStringLiteral("node ") + connection->name,
                      QStringLiteral("node %1 is back").arg(connection->name));
        if (!connection->slot->faultPlan.isEmpty())
            journal.tell(qplc::JournalEvent::Warning, qplc::JournalEvent::Node, connection->name,
                         QStringLiteral("node %1 injects faults on purpose: %2")
                             .arg(connection->name, connection->slot->faultPlan));
        Q_EMIT q->nodeRegistered(connection->name);
        m_joiner = connection;
        apply(connection->slot->listener ? Event::ListenerJoined : Event::NodeJoined,
              QStringLiteral("node %1 has joined").arg(connection->name));
        m_joiner = nullptr;
    });
    QObject::connect(server.get(), &qplc::MasterServer::lost, q,
                     [this](Connection *connection, const QString &reason) { nodeLost(connection, reason); });
    watchSecurity();
    QObject::connect(server.get(), &qplc::MasterServer::received, q,
                     [this](Connection *connection, const Message &message) { receive(connection, message); });
    prepareViewers();
    return true;
}

bool QPlcMasterNodePrivate::claimSignal(const QString &name, QPlcSignalIndex *place, bool (*accepts)(QPlcSignalType),
                                        const QString &wantedType)
{
    if (!prepare())
        return false;
    const QPlcSignalIndex index = table.indexOf(name);
    if (index == QPlcInvalidSignalIndex)
        return setError(QPlcMasterNode::SignalError, QStringLiteral("master: %1").arg(table.unknownSignalText(name)));
    if (!accepts(table.at(index).type))
        return setError(QPlcMasterNode::SignalError,
                        QStringLiteral("master: signal '%1' is %2; give it the type %3")
                            .arg(name, table.at(index).type.name(), wantedType));
    if (const qplc::Leases::Lease *lease = leaseBooks.find(index))
        return setError(QPlcMasterNode::SignalError,
                        QStringLiteral("master: %1").arg(qplc::leaseRefusal(name, *lease).text));
    if (*place != QPlcInvalidSignalIndex)
        registry->release(*place);
    if (!registry->claim(index))
        return setError(
            QPlcMasterNode::SignalError,
            QStringLiteral("master: signal '%1' is written by '%2' already").arg(name, registry->writer(index)));
    *place = index;
    settings->leaveToWriters();
    return true;
}

bool QPlcMasterNodePrivate::startServer(const QPlcUnderlyingProtocol &protocol)
{
    if (!prepare())
        return false;
    if (!apply(Event::Listen))
        return false;
    QHostAddress address = protocol.address();
    if (!checkSecurity()) {
        apply(Event::ServerFailed, errorString);
        return false;
    }
    chooseAddress(&address);
    server->setSecurity(security);
    injectFaults();
    server->setMaximumConnections(maximumConnections);
    if (!server->listen(address, protocol.port(), localName, multicastGroup)) {
        apply(Event::ServerFailed, server->errorString());
        return setError(QPlcMasterNode::ServerError, server->errorString());
    }
    apply(Event::ServerListens);
    beacon.begin(address,
                 {server->port(), !security.isNone(), table.hash(),
                  localName.isEmpty() ? QCoreApplication::applicationName() : localName},
                 hasBeacon);
    qCInfo(lcMaster).noquote() << "listening on" << address.toString() << "port" << server->port() << "security"
                               << security.modeName();
    return true;
}

void QPlcMasterNodePrivate::injectFaults()
{
    QString text;
    const std::optional<qplc::FaultPlan> plan = qplc::FaultPlan::fromText(faultPlan, &text);
    server->close();  // the frames of its nodes follow the last plan
    hub.setFaults(faultPlan.isEmpty() ? std::nullopt : plan);
    if (faultPlan.isEmpty())
        return;
    journal.tell(qplc::JournalEvent::Warning, qplc::JournalEvent::State, qplc::NodeRegistry::masterName(),
                 QStringLiteral("the master injects faults on purpose: %1").arg(faultPlan));
}

bool QPlcMasterNodePrivate::addLocalNode(QPlcSlaveNode *node)
{
    if (!prepare())
        return false;
    if (!apply(Event::AddNode, QStringLiteral("node '%1' is added").arg(node->name())))
        return false;
    if (QPlcSignalIndexTable::current().isEmpty())
        QPlcSignalIndexTable::setCurrent(table);  // what the node's lists of signals look their names up in
    QString text;
    const auto local = std::make_shared<qplc::LocalNode>(QPlcSlaveNodePrivate::of(*node));
    if (!local->bind(table, &text))
        return setError(QPlcMasterNode::SignalError, text);
    qplc::Refusal refusal;
    const std::shared_ptr<NodeSlot> slot
        = registry->admit(qplc::NodeDeclaration::fromRuntime(local->runtime()), &refusal);
    if (!slot)
        return setError(QPlcMasterNode::NodeError, refusal.text);
    slot->prepare(cycle->image(), session);
    settings->leaveToWriters();
    m_localNodes.push_back(local);
    local->join(q, slot);
    Q_EMIT q->nodeRegistered(slot->name);
    return true;
}

void QPlcMasterNodePrivate::removeLocalNode(QPlcSlaveNode *node)
{
    if (!registry)
        return;
    end(QStringLiteral("node '%1' is removed").arg(node->name()));
    const auto isOfNode
        = [node](const auto &local) { return &local->runtime() == &QPlcSlaveNodePrivate::of(*node).runtime; };
    const auto found = std::find_if(m_localNodes.begin(), m_localNodes.end(), isOfNode);
    if (found != m_localNodes.end()) {
        const std::shared_ptr<qplc::LocalNode> local = *found;
        m_localNodes.erase(found);
        registry->remove(local->slot());
        local->leave();
    }
    giveRoster();
}

/// Null: \a slot is none of a node in this process.
std::shared_ptr<qplc::LocalNode> QPlcMasterNodePrivate::localNode(const NodeSlot *slot) const
{
    const auto hasSlot = [slot](const auto &local) { return local->slot().get() == slot; };
    const auto found = std::find_if(m_localNodes.begin(), m_localNodes.end(), hasSlot);
    return found == m_localNodes.end() ? nullptr : *found;
}

// ---- messages ----

/// Answers a request that was refused now, or remembers who waits for its end.
void QPlcMasterNodePrivate::request(Connection *connection, bool accepted)
{
    if (!accepted)
        connection->fail(QStringLiteral("WrongState"), errorString);
    else if (m_step == Step::None)
        connection->send(qplc::messages::Done());
    else
        m_requester = connection->socket;
}

void QPlcMasterNodePrivate::answerRequester(bool done, const QString &text)
{
    if (m_requester)
        m_requester->sendMessage(
            done ? qplc::messages::toMessage(qplc::messages::Done())
                 : qplc::messages::toMessage(qplc::messages::Failed{QStringLiteral("NodeError"), text}));
    m_requester.clear();
}

// ---- values from outside ----

bool QPlcMasterNodePrivate::setSignalValue(const QString &name, const QPlcValue &value)
{
    if (!prepare())
        return false;
    qplc::Refusal refusal;
    if (!settings->setSignal(name, value, &refusal))
        return setError(refusal.error == QLatin1String("WrongState") ? QPlcMasterNode::StateError
                                                                     : QPlcMasterNode::SignalError,
                        refusal.text);
    return true;
}

QPlcNodeInfo QPlcMasterNodePrivate::info(const NodeSlot &slot) const
{
    QPlcNodeInfo node;
    node.name = slot.name;
    node.id = slot.id;
    node.policy
        = QString::fromLatin1(QMetaEnum::fromType<QPlcSlaveNode::RealTimeViolationPolicy>().valueToKey(slot.policy));
    node.listener = slot.listener;
    node.critical = slot.critical;
    node.state = stateOf(slot);
    node.every = slot.interval.cycles();
    node.inputs = int(slot.inputLayout.fields().size());
    node.outputs = int(slot.outputLayout.fields().size());
    node.lateAnswers = slot.statistics.late;
    node.duplicates = slot.statistics.duplicated + slot.statistics.reordered;
    node.rejected = slot.statistics.rejected;
    node.forged = slot.statistics.forged;
    node.resent = slot.statistics.resent;
    node.faultPlan = slot.faultPlan;
    node.transport = QStringLiteral("inprocess");
    if (const Connection *connection = slot.local ? nullptr : server->connectionOf(&slot)) {
        node.transport = connection->cyclicKind;
        node.address = connection->socket->peerName();
    }
    return node;
}
