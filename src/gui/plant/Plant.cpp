// SPDX-License-Identifier: Apache-2.0
#include "Plant.h"

#include "PlantFeed.h"
#include "PlantPast.h"
#include "PlantRecording.h"

#include "node/Logging.h"
#include "node/state/StateText.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr int framePause = 20;             // [ms]
constexpr int longestHold = 1000;          // [ms] that frames of a new connection wait for the state of the master
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
    new PlantPast(this);
    m_frameTimer.setTimerType(Qt::PreciseTimer);
    m_frameTimer.setInterval(framePause);
    m_pollTimer.setInterval(pollPause);
    connect(&m_frameTimer, &QTimer::timeout, this, [this] {
        if (!m_values.isPhaseNeeded() || m_sinceRejoined.elapsed() >= longestHold)
            takeFrames();
    });
    connect(&m_pollTimer, &QTimer::timeout, this, &Plant::poll);
    connect(&m_connection, &PlantConnection::connected, this, &Plant::connected);
    connect(&m_connection, &PlantConnection::disconnected, this, &Plant::disconnected);
    connect(&m_connection, &PlantConnection::refused, this, &Plant::refused);
    connect(&m_connection, &PlantConnection::stateChanged, this, &Plant::stateChanged);
    connect(&m_connection, &PlantConnection::listenerFailed, this, [this](const QString &sentence) {
        tell(PlantEvent::Error, sentence);
        rejoin();
        refresh();
    });
    connect(&m_connection.control(), &ControlClient::unasked, this, &Plant::handleUnasked);
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

void Plant::handleUnasked(const QPlcMessage &message)
{
    if (const auto outcome = messages::readAs<messages::StatesInitialized>(message)) {
        refresh();
        if (outcome->ok)
            Q_EMIT initialized();
    } else if (const auto leases = messages::readAs<messages::LeasesChanged>(message)) {
        m_leases.handle(leases->leases);
    } else if (const auto events = messages::readAs<messages::Events>(message)) {
        m_journal.handle(*events);
        refresh();  // what has happened may have changed the state
    }
}

// ---- connection ----

void Plant::connected(const QPlcSignalTable &newTable)
{
    const messages::MasterHello &hello = m_connection.control().master();
    const bool isNewTable = newTable.toIni() != table().toIni();
    if (isNewTable) {
        m_values.setTable(newTable, hello.period.count());
        m_writers.fill(QString(), newTable.size());
    } else {
        m_values.interrupt();
        rejoin();
    }
    m_status = {};
    m_status.master.state = hello.state;
    m_isInsecure = hello.security == messages::insecure;
    m_identity = printable(hello.identity);
    m_role = printable(hello.role);
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
    m_leases.begin(hello.features.contains(messages::feature::leases));
    m_journal.begin(hello.session, hello.features.contains(messages::feature::events));
    tell({QDateTime::currentDateTime(), PlantEvent::Information, sourceOf({}),
          QStringLiteral("connected to the master at %1").arg(address()), false, PlantEvent::Ends, lostMaster()});
    Q_EMIT stateChanged();
    poll();
    askSignals();
}

void Plant::rejoin()
{
    m_values.rejoin();
    m_sinceRejoined.start();
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

PlantRecording *Plant::makeRecording(std::unique_ptr<Recording> recording)
{
    if (!m_recording)
        m_recording = new PlantRecording(this, std::move(recording));
    return m_recording;
}

/// Those of another part of a recording.
void Plant::giveValues(PlantValues values)
{
    m_values = std::move(values);
    m_writers.resize(table().size());
}

PlantConnection::State Plant::connectionState() const
{
    if (m_recording)
        return PlantConnection::Disconnected;
    if (m_feed)
        return m_feed->isConnected() ? PlantConnection::Connected : PlantConnection::Disconnected;
    return m_connection.state();
}

QString Plant::stateText() const
{
    if (m_recording)
        return m_recording->isReading() ? tr("Reading the recording, %1 %").arg(int(100.0 * m_recording->progress()))
                                        : tr("Recording: %1").arg(m_recording->text());
    switch (connectionState()) {
    case PlantConnection::Connected:
        return qplc::stateText(m_status.master.state);
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
    const messages::State &master = m_status.master;
    if (master.state == messages::MasterState::Off)
        return master.armingRequired ? Initialize : Start;
    if (master.state == messages::MasterState::Ready)
        return master.armingRequired && !master.armed ? Arm : Start;
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
        [&](const QPlcIOBufferSlaveNode::Frame &frame) { m_values.storeFrame(frame, now); });
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
    if (m_recording)
        return m_values.hasValues() ? AtRest : NoValue;
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

bool Plant::ask(const QPlcMessage &question, const ControlClient::RawHandler &handler)
{
    ControlClient &control = m_connection.control();
    const bool isQuestion = messages::useOf(question.kind()).purpose == messages::Purpose::Question;
    // Not greeted, but connected: the connection is about to end, and fails its questions.
    if (!isConnected() || !control.isGreeted() || !isQuestion || control.isBusy() || m_questions == MostQuestions)
        return false;
    ++m_questions;
    control.send(question, [this, handler](const QPlcMessage &answer) {
        --m_questions;
        const bool isLost = answer.kind() == QPlcMessage::Invalid;
        handler(isLost ? messages::toMessage(ControlClient::failureOf(answer)) : answer);
    });
    return true;
}

/// A question to which a refusal is no answer: the next poll asks again.
template<typename Question, typename Answer>
void Plant::askFor(const Question &question, void (Plant::*take)(const Answer &))
{
    const auto pass = [this, take](const ControlClient::Reply<Question> &reply) {
        if (const auto *answer = std::get_if<Answer>(&reply))
            (this->*take)(*answer);
    };
    m_connection.control().request(question, pass);
}

void Plant::poll()
{
    askState();
    if (m_connection.control().isBusy())
        return;
    if (m_polls % statisticsEvery == 0)
        askFor(messages::GetStatistics(), &Plant::handleStatistics);
    if (!m_status.isRunning() && m_polls > 0)
        askSignals();
    ++m_polls;
}

void Plant::askState()
{
    askFor(messages::GetState(), &Plant::handleState);
}

void Plant::askSignals()
{
    if (m_connection.control().isBusy())
        return;  // the next poll asks again
    const QVector<QStringList> groups = groupsOfNames(table());
    for (const QStringList &names : groups)
        askFor(messages::GetSignals{names}, &Plant::handleSignals);
}

QStringList Plant::nodeNames() const
{
    QStringList names;
    for (const NodeStatus &node : m_status.nodes)
        names << node.info.name;
    return names;
}

void Plant::handleState(const messages::State &answer)
{
    const messages::MasterState stateBefore = m_status.master.state;
    const bool wasArmed = m_status.master.armed;
    const QStringList nodesBefore = nodeNames();
    m_status.handleState(answer);
    const messages::State &master = m_status.master;
    if (m_status.isRunning())
        m_values.setPhase({master.session, PlantValues::Time(quint64(master.cycleZeroTime))});
    if (!master.armed && wasArmed)
        m_token.reset();
    if (master.armed != wasArmed)
        Q_EMIT stateChanged();
    if (master.period.count() > 0)
        m_connection.setPeriod(master.scale > 0.0 ? qint64(double(master.period.count()) / master.scale)
                                                  : master.period.count());
    if (master.state != stateBefore) {
        tellOfMaster(PlantEvent::Information, QStringLiteral("state %1").arg(qplc::stateText(master.state)), QString(),
                     IsStateChange);
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
        askFor(messages::GetSchedule(), &Plant::handleSchedule);
}

void Plant::handleSchedule(const messages::Schedule &answer)
{
    m_status.handleSchedule(answer);
}

void Plant::handleStatistics(const messages::Statistics &answer)
{
    const PlantStatus before = m_status;
    m_status.handleStatistics(answer);
    const quint64 overruns = m_status.statistics.overruns;
    if (before.isCounted && overruns > before.statistics.overruns)
        tellOfMaster(PlantEvent::Warning,
                     QStringLiteral("%1 new overruns of the cycle, %2 since the start")
                         .arg(overruns - before.statistics.overruns)
                         .arg(overruns));
    for (const NodeStatus &node : qAsConst(m_status.nodes)) {
        const QString &name = node.info.name;
        const NodeStatus *was = before.node(name);
        if (node.isLate && was)
            tellOfMaster(PlantEvent::Warning,
                         QStringLiteral("%1 new late answers of node %2, %3 since the start")
                             .arg(node.statistics.late - was->statistics.late)
                             .arg(name)
                             .arg(node.statistics.late),
                         name);
    }
    Q_EMIT statusChanged();
}

void Plant::handleSignals(const messages::Signals &answer)
{
    const QVector<QString> writersBefore = m_writers;
    const bool isAtRest = !m_status.isRunning();
    for (const messages::SignalEntry &entry : answer.signals) {
        const QPlcSignalIndex signal = table().indexOf(entry.name);
        if (signal == QPlcInvalidSignalIndex)
            continue;
        m_writers[signal] = printable(entry.writer);
        if (isAtRest)
            m_values.storeValue(signal, QPlcValue::fromString(table().at(signal).type, entry.value),
                                QPlcQuality::fromByte(entry.quality));
    }
    if (isAtRest) {
        m_sinceValues.start();
        m_hasNewValues = true;
    }
    if (m_writers != writersBefore)
        Q_EMIT writersChanged();
}

}  // namespace qplc
