// SPDX-License-Identifier: Apache-2.0
#include "Plant.h"

#include "PlantFeed.h"

#include "node/Logging.h"
#include "node/state/StateText.h"

#include <QtCore/QJsonArray>

#include <algorithm>

namespace qplc {

namespace {

using Message = QPlcMessage;

constexpr int framePause = 20;             // [ms]
constexpr int pollPause = 500;             // [ms]
constexpr double shortestStaleTime = 0.5;  // [s]
constexpr int statisticsEvery = 2;         // polls

PlantValues::Time wallTime()
{
    return PlantValues::Time(QDateTime::currentMSecsSinceEpoch()) * 1'000'000;
}

/// Names of signals in groups whose answers fit into a control frame.
QVector<QStringList> groupsOfNames(const QPlcSignalTable &table)
{
    constexpr int most = 256 * 1024;  // [byte], of 1 MiB
    QVector<QStringList> groups;
    int size = most;
    for (const QPlcSignalDefinition &definition : table) {
        const int answer = 200 + 4 * (definition.name.size() + definition.description.size() + definition.unit.size())
            + 8 * definition.type.size();
        if (size + answer > most) {
            groups.append(QStringList());
            size = 0;
        }
        groups.last().append(definition.name);
        size += answer;
    }
    return groups;
}

/// The alarm that lasts while a master is looked for.
QString lostMaster()
{
    return QStringLiteral("connection");
}

}  // namespace

Plant::Plant(const QString &address, const QString &name, const QString &nodeName, QObject *parent)
    : QObject(parent)
    , m_name(name.isEmpty() ? address : name)
    , m_connection(address, nodeName)
{
    qRegisterMetaType<qplc::PlantEvent>("qplc::PlantEvent");
    m_frameTimer.setTimerType(Qt::PreciseTimer);
    m_frameTimer.setInterval(framePause);
    m_pollTimer.setInterval(pollPause);
    connect(&m_frameTimer, &QTimer::timeout, this, &Plant::takeFrames);
    connect(&m_pollTimer, &QTimer::timeout, this, &Plant::poll);
    connect(&m_connection, &PlantConnection::connected, this, &Plant::connected);
    connect(&m_connection, &PlantConnection::disconnected, this, &Plant::disconnected);
    connect(&m_connection, &PlantConnection::refused, this, &Plant::refused);
    connect(&m_connection, &PlantConnection::stateChanged, this, &Plant::stateChanged);
    connect(&m_connection, &PlantConnection::listenerFailed, this,
            [this](const QString &sentence) { tell(PlantEvent::Error, sentence); });
    connect(&m_connection.control(), &ControlChannel::pushed, this, &Plant::takePushed);
    connect(&m_leases, &PlantLeases::changed, this, &Plant::leasesChanged);
    connect(&m_journal, &MasterJournal::fetched, this, &Plant::tellWaiting);
    connect(&m_journal, &MasterJournal::happened, this, [this](PlantEvent event) {
        event.source = sourceOf(event.source);
        Q_EMIT eventOccurred(event);
    });
}

Plant::~Plant()
{
    m_connection.disconnect(this);
    m_connection.control().disconnect(this);
    m_leases.disconnect(this);
    m_journal.disconnect(this);
}

// ---- events ----

QString Plant::sourceOf(const QString &node) const
{
    return node.isEmpty() ? m_name : m_name + QLatin1Char('/') + node;
}

void Plant::tell(PlantEvent::Severity severity, const QString &text, const QString &node)
{
    tell({QDateTime::currentDateTime(), severity, sourceOf(node), text, false});
}

void Plant::tell(const PlantEvent &event)
{
    if (m_journal.isFetching())
        m_waitingEvents.append(event);
    else
        Q_EMIT eventOccurred(event);
}

/// What has happened to the master, if it does not tell it itself.
void Plant::tellOfMaster(PlantEvent::Severity severity, const QString &text, const QString &node, EventKind kind)
{
    if (m_journal.hasFeature())
        return;
    PlantEvent event{QDateTime::currentDateTime(), severity, sourceOf(node), text, false};
    event.isStateChange = kind == IsStateChange;
    tell(event);
}

void Plant::tellWaiting()
{
    const QVector<PlantEvent> events = m_waitingEvents;
    m_waitingEvents.clear();
    for (const PlantEvent &event : events)
        Q_EMIT eventOccurred(event);
}

void Plant::takePushed(const Message &message)
{
    switch (message.kind()) {
    case Message::StatesInitialized:
        refresh();
        break;
    case Message::LeasesChanged:
        m_leases.take(message);
        break;
    case Message::Events:
        m_journal.take(message);
        refresh();  // what has happened may have changed the state
        break;
    default:
        break;
    }
    Q_EMIT messagePushed(message);
}

// ---- connection ----

void Plant::connected(const Message &hello, const QPlcSignalTable &newTable)
{
    const bool isNewTable = newTable.toIni() != table().toIni();
    if (isNewTable) {
        m_values.setTable(newTable, qint64(hello.fields().value(QStringLiteral("period")).toDouble()));
        m_writers.fill(QString(), newTable.size());
    } else {
        m_values.interrupt();
    }
    m_status = {};
    m_status.state = printable(hello.text(QStringLiteral("state")));
    m_isInsecure = hello.text(QStringLiteral("security")) == QLatin1String("insecure");
    m_identity = printable(hello.text(QStringLiteral("identity")));
    m_role = printable(hello.text(QStringLiteral("role")));
    m_refusal.clear();
    m_polls = 0;
    m_frameTimer.start();
    m_pollTimer.start();
    m_sinceRate.start();
    m_rowsAtRate = m_values.rows();
    if (isNewTable) {
        Q_EMIT tableChanged();
        Q_EMIT storeChanged();
    }
    const QJsonArray features = hello.fields().value(QStringLiteral("features")).toArray();
    m_leases.begin(features.contains(QStringLiteral("leases")));
    m_journal.begin(hello.hex64(QStringLiteral("session")), features.contains(QStringLiteral("events")));
    tell({QDateTime::currentDateTime(), PlantEvent::Information, sourceOf({}),
          QStringLiteral("connected to the master at %1").arg(address()), false, PlantEvent::Ends, lostMaster()});
    Q_EMIT stateChanged();
    poll();
    askSignals();
}

/// Told once, however often it is tried.
void Plant::refused(const QString &reason)
{
    if (reason == m_refusal)
        return;
    m_refusal = reason;
    tell({QDateTime::currentDateTime(), PlantEvent::Error, sourceOf({}),
          QStringLiteral("cannot work with the master at %1: %2").arg(address(), reason), false, PlantEvent::Begins,
          lostMaster()});
}

void Plant::disconnected(const QString &reason)
{
    takeFrames();
    m_frameTimer.stop();
    m_pollTimer.stop();
    m_updateRate = 0.0;
    m_values.interrupt();
    m_status = {};
    m_leases.end();
    m_journal.end();
    if (m_connection.isOpen())
        tell({QDateTime::currentDateTime(), PlantEvent::Error, sourceOf({}),
              QStringLiteral("lost the master at %1: %2").arg(address(), reason), false, PlantEvent::Begins,
              lostMaster()});
    else
        tell(PlantEvent::Information, QStringLiteral("left the master at %1").arg(address()));
    Q_EMIT statusChanged();
    Q_EMIT stateChanged();
}

PlantFeed *Plant::makeFeed()
{
    if (!m_feed)
        m_feed = new PlantFeed(this);
    return m_feed;
}

PlantConnection::State Plant::connectionState() const
{
    if (m_feed)
        return m_feed->isConnected() ? PlantConnection::Connected : PlantConnection::Disconnected;
    return m_connection.state();
}

QString Plant::stateText() const
{
    switch (connectionState()) {
    case PlantConnection::Connected:
        return qplc::stateText(m_status.state);
    case PlantConnection::Connecting:
        return tr("Connecting to %1").arg(address());
    case PlantConnection::Disconnected:
        break;
    }
    return tr("Disconnected: %1").arg(m_connection.reason());
}

Plant::Action Plant::nextAction() const
{
    if (!isConnected())
        return NoAction;
    if (m_status.isLatched())
        return Reset;
    if (m_status.isRunning())
        return StopAction;
    if (m_status.state == QLatin1String("Off"))
        return m_status.isArmingRequired ? Initialize : Start;
    if (m_status.state == QLatin1String("Ready"))
        return m_status.isArmingRequired && !m_status.isArmed ? Arm : Start;
    return NoAction;
}

QString Plant::actionText(Action action)
{
    switch (action) {
    case Initialize:
        return tr("Initialize");
    case Arm:
        return tr("Arm");
    case Start:
        return tr("Start");
    case Reset:
        return tr("Reset");
    case StopAction:
        return tr("Stop");
    case NoAction:
        break;
    }
    return {};
}

// ---- values ----

void Plant::takeFrames()
{
    const SignalStore *storeBefore = store();
    m_values.beginBatch();
    const PlantValues::Time now = wallTime();
    const int taken = m_connection.listener().takeFrames(
        [&](const QPlcIOBufferSlaveNode::Frame &frame) { m_values.takeFrame(frame, now); });
    if (taken > 0)
        m_sinceValues.start();
    measureRate();
    if (store() != storeBefore)
        Q_EMIT storeChanged();
    if (taken > 0 || m_hasNewValues) {
        m_hasNewValues = false;
        Q_EMIT updated();
    }
}

void Plant::measureRate()
{
    constexpr double time = 2.0;  // [s]
    const double elapsed = double(m_sinceRate.elapsed()) * 1e-3;
    if (elapsed < time)
        return;
    m_updateRate = double(m_values.rows() - m_rowsAtRate) / elapsed;
    m_rowsAtRate = m_values.rows();
    m_sinceRate.start();
}

double Plant::age() const
{
    return m_sinceValues.isValid() && m_values.hasValues() ? double(m_sinceValues.nsecsElapsed()) * 1e-9 : -1.0;
}

double Plant::staleAfter() const
{
    return std::max(shortestStaleTime, 3.0 * double(m_values.rowPeriod()) * 1e-9);
}

Plant::Quality Plant::quality() const
{
    if (age() < 0.0)
        return NoValue;
    if (!isConnected())
        return Stale;
    // Without cycles values come with the polls.
    const bool isRunning = m_status.isRunning();
    if (m_feed && !isRunning)
        return AtRest;
    if (age() > (isRunning ? staleAfter() : 4.0 * pollPause * 1e-3))
        return Stale;
    return isRunning ? Good : AtRest;
}

// ---- questions ----

void Plant::refresh()
{
    if (isConnected() && !m_feed)
        askState();
}

bool Plant::ask(const Message &question, const ControlChannel::Handler &handler)
{
    if (!isConnected() || m_connection.control().isBusy())
        return false;
    m_connection.control().ask(question, handler);
    return true;
}

void Plant::poll()
{
    askState();
    if (m_connection.control().isBusy())
        return;
    if (m_polls % statisticsEvery == 0)
        m_connection.control().ask(Message(Message::GetStatistics),
                                   [this](const Message &answer) { takeStatistics(answer); });
    if (!m_status.isRunning() && m_polls > 0)
        askSignals();
    ++m_polls;
}

void Plant::askState()
{
    m_connection.control().ask(Message(Message::GetState), [this](const Message &answer) { takeState(answer); });
}

void Plant::askSignals()
{
    if (m_connection.control().isBusy())
        return;  // the next poll asks again
    const QVector<QStringList> groups = groupsOfNames(table());
    for (const QStringList &names : groups)
        m_connection.control().ask(
            Message(Message::GetSignals, {{QStringLiteral("names"), QJsonArray::fromStringList(names)}}),
            [this](const Message &answer) { takeSignals(answer); });
}

QStringList Plant::nodeNames() const
{
    QStringList names;
    for (const NodeStatus &node : m_status.nodes)
        names << node.name;
    return names;
}

void Plant::takeState(const Message &answer)
{
    if (answer.kind() != Message::State)
        return;
    const QString stateBefore = m_status.state;
    const bool wasArmed = m_status.isArmed;
    const QStringList nodesBefore = nodeNames();
    m_status.takeState(answer.fields());
    if (!m_status.isArmed && wasArmed)
        m_token.clear();
    if (m_status.isArmed != wasArmed)
        Q_EMIT stateChanged();
    if (m_status.period > 0)
        m_connection.setPeriod(m_status.scale > 0.0 ? qint64(double(m_status.period) / m_status.scale)
                                                    : m_status.period);
    if (m_status.state != stateBefore) {
        tellOfMaster(PlantEvent::Information, QStringLiteral("state %1").arg(qplc::stateText(m_status.state)),
                     QString(), IsStateChange);
        Q_EMIT stateChanged();
    }
    if (nodeNames() != nodesBefore)
        nodesChanged(nodesBefore, nodeNames());
    Q_EMIT statusChanged();
}

void Plant::nodesChanged(const QStringList &before, const QStringList &now)
{
    for (const QString &name : now) {
        if (!before.contains(name))
            tellOfMaster(PlantEvent::Information, QStringLiteral("node %1 is there").arg(name), name);
    }
    for (const QString &name : before) {
        if (!now.contains(name))
            tellOfMaster(PlantEvent::Warning, QStringLiteral("node %1 has gone").arg(name), name);
    }
    askSignals();
    if (!m_connection.control().isBusy())
        m_connection.control().ask(Message(Message::GetSchedule), [this](const Message &answer) {
            if (answer.kind() == Message::Schedule)
                m_status.takeSchedule(answer.fields());
        });
}

void Plant::takeStatistics(const Message &answer)
{
    if (answer.kind() != Message::Statistics)
        return;
    const PlantStatus before = m_status;
    m_status.takeStatistics(answer.fields());
    if (before.isCounted && m_status.overruns > before.overruns)
        tellOfMaster(PlantEvent::Warning,
                     QStringLiteral("%1 new overruns of the cycle, %2 since the start")
                         .arg(m_status.overruns - before.overruns)
                         .arg(m_status.overruns));
    for (const NodeStatus &node : qAsConst(m_status.nodes)) {
        const NodeStatus *was = before.node(node.name);
        if (node.isLate && was)
            tellOfMaster(PlantEvent::Warning,
                         QStringLiteral("%1 new late answers of node %2, %3 since the start")
                             .arg(node.late - was->late)
                             .arg(node.name)
                             .arg(node.late),
                         node.name);
    }
    Q_EMIT statusChanged();
}

void Plant::takeSignals(const Message &answer)
{
    if (answer.kind() != Message::Signals)
        return;
    const QVector<QString> writersBefore = m_writers;
    const bool isAtRest = !m_status.isRunning();
    const QJsonArray rows = answer.fields().value(QStringLiteral("signals")).toArray();
    for (const QJsonValue &row : rows) {
        const QJsonObject of = row.toObject();
        const QPlcSignalIndex signal = table().indexOf(of.value(QStringLiteral("name")).toString());
        if (signal == QPlcInvalidSignalIndex)
            continue;
        m_writers[signal] = printable(of.value(QStringLiteral("writer")).toString());
        if (isAtRest)
            m_values.takeValue(
                signal, QPlcValue::fromString(table().at(signal).type, of.value(QStringLiteral("value")).toString()),
                QPlcQuality::fromByte(quint8(of.value(QStringLiteral("quality")).toInt(0))));
    }
    if (isAtRest) {
        m_sinceValues.start();
        m_hasNewValues = true;
    }
    if (m_writers != writersBefore)
        Q_EMIT writersChanged();
}

}  // namespace qplc
