// SPDX-License-Identifier: Apache-2.0
// The registration of QPlcSlaveNodePrivate: from the greeting to the cyclic channel that is there.
#include "QPlcSignalIndexTable.h"
#include "QPlcSlaveNodePrivate.h"
#include "node/Logging.h"
#include "node/security/SealFields.h"
#include "signals/Fnv1a.h"
#include "transport/FaultLink.h"
#include "transport/TransportRegistry.h"

#include <QtCore/QJsonArray>
#include <QtCore/QMetaEnum>

#include <utility>

using Message = QPlcMessage;

namespace {

const QString sameCycleFeature = QStringLiteral("sameCycle");
const QString qualityFeature = QStringLiteral("quality");
const QString outputQualityFeature = QStringLiteral("outputQuality");
const QString hardwareFeature = QStringLiteral("hardware");

QJsonArray describe(const QPlcSignalTable &table, const qplc::PayloadLayout &layout,
                    const std::vector<bool> &sameCycle = {})
{
    QJsonArray signalArray;
    for (const qplc::PayloadLayout::Field &field : layout.fields()) {
        const QPlcSignalDefinition &definition = table.at(field.signal);
        QJsonObject signal{{QStringLiteral("name"), definition.name},
                           {QStringLiteral("type"), definition.type.name()},
                           {QStringLiteral("unit"), definition.unit}};
        const auto place = std::size_t(signalArray.size());
        if (place < sameCycle.size() && sameCycle[place])
            signal.insert(QStringLiteral("sameCycle"), true);
        signalArray.append(signal);
    }
    return signalArray;
}

}  // namespace

/// Whether cycles have an order because of this node. Before the table is known.
bool QPlcSlaveNodePrivate::isOrdered() const
{
    try {
        return sameCycle || twoPhase || q->declaresSameCycle();
    } catch (...) {
        return false;  // its code throws again when the node is bound, and is reported then
    }
}

/// Extensions that this node uses. A master that does not know `hardware` is as strict as a plant anyway.
QJsonArray QPlcSlaveNodePrivate::features() const
{
    QJsonArray needed;
    if (isOrdered())
        needed.append(sameCycleFeature);
    if (receivesQuality)
        needed.append(qualityFeature);
    if (sendsQuality)
        needed.append(outputQualityFeature);
    if (hardware)
        needed.append(hardwareFeature);
    return needed;
}

void QPlcSlaveNodePrivate::greet()
{
    QJsonObject fields{{QStringLiteral("protocol"), 1},
                       {QStringLiteral("name"), name},
                       {QStringLiteral("uuid"), m_uuid},
                       {QStringLiteral("role"), QStringLiteral("node")},
                       {QStringLiteral("features"), features()}};
    const QPlcSignalTable table = q->signalTable();
    if (!table.isEmpty())
        fields.insert(QStringLiteral("tableHash"), Message::fromHex64(table.hash()));
    control->sendMessage(Message(Message::Hello, fields));
}

bool QPlcSlaveNodePrivate::chooseTable(const Message &hello, QPlcSignalTable *table)
{
    *table = q->signalTable();
    if (!table->isEmpty())
        return true;
    QVector<QPlcParseError> errors;
    *table = QPlcSignalTable::fromMaster(hello.text(QStringLiteral("table")).toUtf8(), &errors);
    if (table->isEmpty()) {
        giveUp(QPlcSlaveNode::ProtocolError, QPlcParseError::toString(errors));
        return false;
    }
    QPlcSignalIndexTable::setCurrent(*table);
    return true;
}

void QPlcSlaveNodePrivate::receiveHello(const Message &message)
{
    const int protocol = message.fields().value(QStringLiteral("protocol")).toInt();
    if (protocol != 1) {
        giveUp(QPlcSlaveNode::ProtocolError,
               QStringLiteral("the master at %1 speaks protocol version %2, node '%3' version 1; update the older one")
                   .arg(master.toString())
                   .arg(protocol)
                   .arg(name));
        return;
    }
    m_session = message.hex64(QStringLiteral("session"));
    if (const QString faults = message.text(QStringLiteral("faults")); !faults.isEmpty())
        qCWarning(lcSlave).noquote() << "the master at" << master.toString()
                                     << "injects faults on purpose:" << qplc::printable(faults);
    const QJsonArray offered = message.fields().value(QStringLiteral("features")).toArray();
    const auto lacks = [&](bool needed, const QString &feature, const QString &what) {
        if (!needed || offered.contains(feature))
            return false;
        giveUp(QPlcSlaveNode::RegistrationError,
               QStringLiteral("the master at %1 knows no %2, which node '%3' needs; update the master, or do without "
                              "them")
                   .arg(master.toString(), what, name));
        return true;
    };
    if (lacks(isOrdered(), sameCycleFeature, QStringLiteral("same-cycle inputs and two-phase nodes"))
        || lacks(sendsQuality, outputQualityFeature, QStringLiteral("qualities of outputs")))
        return;
    runtime.setQualityOffered(offered.contains(qualityFeature));
    QPlcSignalTable table;
    QString text;
    if (!chooseTable(message, &table))
        return;
    if (!runtime.bind(table, &text)) {
        giveUp(QPlcSlaveNode::SignalError, text);
        return;
    }
    registerAtMaster();
}

qplc::ControlEnds QPlcSlaveNodePrivate::controlEnds() const
{
    return {qplc::SocketAddress(control->localAddress(), control->localPort()),
            qplc::SocketAddress(control->peerAddress(), control->peerPort()), master.toString()};
}

bool QPlcSlaveNodePrivate::beginLink(QJsonObject *request)
{
    QString text;
    const bool hasBegun = m_transport->beginLink(controlEnds(), request, &m_link, &text);
    if (!hasBegun)
        giveUp(QPlcSlaveNode::ConnectionError, QStringLiteral("node '%1': %2").arg(name, text));
    return hasBegun;
}

void QPlcSlaveNodePrivate::registerAtMaster()
{
    QJsonObject fields{
        {QStringLiteral("name"), name},
        {QStringLiteral("uuid"), m_uuid},
        {QStringLiteral("policy"),
         QLatin1String(QMetaEnum::fromType<QPlcSlaveNode::RealTimeViolationPolicy>().valueToKey(policy))},
        {QStringLiteral("listener"), listener},
        {QStringLiteral("inputs"), describe(runtime.table(), runtime.inputLayout(), runtime.sameCycle())},
        {QStringLiteral("outputs"), describe(runtime.table(), runtime.outputLayout())},
        {QStringLiteral("cyclic"), master.kindName()}};
    if (critical)
        fields.insert(QStringLiteral("critical"), true);
    if (!interval.isEveryCycle())
        fields.insert(QStringLiteral("every"), interval.cycles());
    if (twoPhase)
        fields.insert(QStringLiteral("twoPhase"), true);
    if (runtime.inputLayout().hasQualities())
        fields.insert(QStringLiteral("quality"), true);
    if (runtime.outputLayout().hasQualities())
        fields.insert(QStringLiteral("outputQuality"), true);
    if (!faultPlan.isEmpty())
        fields.insert(QStringLiteral("faults"), faultPlan);
    if (!beginLink(&fields))
        return;
    control->sendMessage(Message(Message::Register, fields));
}

void QPlcSlaveNodePrivate::receiveRegistered(const Message &message)
{
    m_id = message.fields().value(QStringLiteral("node")).toInt();
    m_token = message.text(QStringLiteral("token"));
    if (message.hex64(QStringLiteral("inputsHash")) != runtime.inputLayout().hash()
        || message.hex64(QStringLiteral("outputsHash")) != runtime.outputLayout().hash()) {
        giveUp(QPlcSlaveNode::ProtocolError,
               QStringLiteral("master and node '%1' disagree on the layout of the frames").arg(name));
        return;
    }
    std::optional<qplc::SealKeys> keys;
    if (control->isSecured() && m_transport->isSealed()) {
        keys = qplc::sealKeys(message.fields().value(QStringLiteral("seal")).toObject());
        if (!keys) {
            giveUp(QPlcSlaveNode::ProtocolError,
                   QStringLiteral("the master at %1 gives node '%2' no keys for its frames; update the master")
                       .arg(master.toString(), name));
            return;
        }
    }
    cycle = std::make_unique<qplc::SlaveCycle>(runtime, qplc::SlaveCycle::Identity{m_session, quint16(m_id), keys},
                                               lcCyclic().isDebugEnabled());
    m_reportNotifier = std::make_unique<QSocketNotifier>(cycle->reports().descriptor(), QSocketNotifier::Read);
    QObject::connect(m_reportNotifier.get(), &QSocketNotifier::activated, q, [this] { takeReports(); });
    if (m_transport->hasStreams())
        connectCyclicChannel();
    else if (finishLink(message))
        giveLink(std::move(m_link));
}

bool QPlcSlaveNodePrivate::finishLink(const Message &registered)
{
    QString text;
    const bool isReady = m_transport->finishLink(controlEnds(), registered.fields(), &m_link, &text);
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

void QPlcSlaveNodePrivate::connectCyclicChannel()
{
    m_cyclicSocket = new QPlcMasterSocket(q);
    m_cyclicSocket->setSecurity(QPlcSecurity());  // frames are no TLS; the token came over the control connection
    QObject::connect(m_cyclicSocket, &QPlcAbstractSocket::connected, q, [this] {
        m_cyclicSocket->sendMessage(Message(Message::AttachCyclicChannel,
                                            {{QStringLiteral("node"), m_id}, {QStringLiteral("token"), m_token}}));
    });
    QObject::connect(m_cyclicSocket, &QPlcAbstractSocket::errorOccurred, q,
                     [this](QPlcAbstractSocket::Error e) { masterLost(e, m_cyclicSocket->errorString()); });
    QObject::connect(m_cyclicSocket, &QPlcAbstractSocket::messageReceived, q, [this](const Message &message) {
        if (message.kind() != Message::CyclicChannelAttached) {
            giveUp(QPlcSlaveNode::RegistrationError,
                   QStringLiteral("the master refuses the cyclic connection: %1")
                       .arg(qplc::printable(message.text(QStringLiteral("text")))));
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
    qCInfo(lcSlave).noquote() << "node" << name << "registered at" << master.toString();
    error = QPlcSlaveNode::NoError;
    errorString.clear();
    m_wasRegistered = true;
    m_backOff.reset();
    m_patience.stop();
    hasChannel = true;
    Q_EMIT q->connectedToMaster();
    if (const auto request = std::exchange(m_outputsAwaited, std::nullopt))
        apply(qplc::SlaveEvent::OutputsWanted, *request);
}
