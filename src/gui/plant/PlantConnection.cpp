// SPDX-License-Identifier: Apache-2.0
#include "PlantConnection.h"

#include "PlantLeases.h"
#include "node/Logging.h"
#include "node/cycle/ListeningInterval.h"
#include "protocol/messages/Vocabulary.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QRegularExpression>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr int longestWindowName = 64;  // [characters] of the protocol

/// The person, and which window: names of nodes are unique.
QString defaultName()
{
    const QString window = QStringLiteral("-%1").arg(QCoreApplication::applicationPid());
    return PlantLeases::whoever().left(longestWindowName - window.size()) + window;
}

/// A window at the control channel.
ControlClient::Caller caller()
{
    return {PlantLeases::whoever(), messages::Part::Tool, {messages::feature::leases, messages::feature::events}};
}

/// Why there is no connection, as half a sentence.
QString sentenceOf(ControlClient::Loss loss, const QString &reason, const messages::Rejected &rejection)
{
    const QString shown = printable(reason);
    switch (loss) {
    case ControlClient::Loss::Gone:
    case ControlClient::Loss::MasterEnded:
        break;
    case ControlClient::Loss::NoGreeting:
        return QStringLiteral("it answers with %1 instead of a greeting; is it a QtPLC master?").arg(shown);
    case ControlClient::Loss::Rejected:
        return (rejection.error == messages::errorWord::versionMismatch
                    ? QStringLiteral("versions differ: %1; update the older one")
                    : QStringLiteral("the master refuses: %1"))
            .arg(shown);
    case ControlClient::Loss::OtherVersion:
        return QStringLiteral("versions differ: the master speaks protocol version %1, this window version %2; update "
                              "the older one")
            .arg(shown)
            .arg(qplc::messages::protocolVersion);
    }
    return reason;
}

/// \param rate  most frames a second, 0: every cycle \param period  [ns]
int cyclesForEach(double rate, qint64 period)
{
    if (rate <= 0.0 || period <= 0)
        return 1;
    constexpr double tolerance = 1e-6;  // a period of 10 ms is 100 Hz
    return int(
        std::clamp(std::ceil(1e9 / (rate * double(period)) - tolerance), 1.0, double(ListeningInterval::Longest)));
}

}  // namespace

PlantConnection::PlantConnection(const QString &address, const QString &nodeName, QObject *parent)
    : QObject(parent)
    , m_address(address)
    , m_nodeName(nodeName.isEmpty() ? defaultName() : nodeName)
    , m_control(caller())
    , m_listener(m_nodeName)
    , m_reason(QStringLiteral("not connected yet"))
{
    m_parts = PlantAddress::fromString(address, &m_addressError);
    if (m_parts.security)
        m_control.setSecurity(*m_parts.security);
    m_listener.setSecurity(m_parts.security);
    m_retry.setSingleShot(true);
    m_listenerRetry.setSingleShot(true);
    connect(&m_retry, &QTimer::timeout, this, &PlantConnection::attempt);
    connect(&m_listenerRetry, &QTimer::timeout, this, [this] {
        Q_EMIT listenerFailed(
            m_listenerReason);  // not before: when the master is gone, the control channel says so meanwhile
        listen();
    });
    connect(&m_resolver, &AddressResolver::failed, this, [this](const QString &reason) { failed(reason); });
    connect(&m_resolver, &AddressResolver::resolved, this, [this](const QPlcUnderlyingProtocol &master) {
        m_master = master;
        m_control.connectToMaster(master);
    });
    connect(&m_control, &ControlClient::greeted, this, &PlantConnection::greeted);
    connect(&m_control, &ControlClient::lost, this, &PlantConnection::lost);
    connect(&m_listener, &Listener::joined, this, [this] { m_listenerFailures = 0; });
    connect(&m_listener, &Listener::lost, this, &PlantConnection::listenerLost);
}

PlantConnection::~PlantConnection()
{
    m_control.disconnect(this);
    m_listener.disconnect(this);
}

QString PlantConnection::personOf(const QPlcNodeInfo &node)
{
    static const QRegularExpression window(QStringLiteral("^(.+@.*)-[0-9]+$"));  // see defaultName()
    const QRegularExpressionMatch match = window.match(node.name);
    if (!node.listener || !match.hasMatch())
        return {};
    return node.identity.isEmpty() ? match.captured(1) : node.identity;
}

int PlantConnection::pauseAfter(int failures)
{
    constexpr int first = 250;  // [ms]
    constexpr int longest = 5000;
    return std::min(longest, first << std::clamp(failures - 1, 0, 10));
}

void PlantConnection::open()
{
    if (m_isOpen)
        return;
    m_isOpen = true;
    m_failures = 0;
    attempt();
}

void PlantConnection::close()
{
    m_isOpen = false;
    m_retry.stop();
    m_listenerRetry.stop();
    m_resolver.cancel();
    m_listener.disconnectFromMaster();
    m_control.close();
    const bool wasConnected = m_state == Connected;
    setState(Disconnected, QStringLiteral("disconnected by the user"));
    if (wasConnected)
        Q_EMIT disconnected(m_reason);
}

void PlantConnection::attempt()
{
    setState(Connecting, m_reason);
    if (m_addressError.isEmpty())
        m_resolver.resolve(m_parts.master);
    else
        failed(m_addressError);
}

void PlantConnection::greeted()
{
    const messages::MasterHello &hello = m_control.master();
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromMaster(hello.table.toUtf8(), &errors);
    if (table.isEmpty()) {
        m_control.close();
        failed(QPlcParseError::toString(errors));
        return;
    }
    m_failures = 0;
    m_listenerFailures = 0;
    m_table = table;
    m_period = hello.period.count();
    m_every = cyclesForEach(m_rate, m_period);
    listen();
    setState(Connected, {});
    Q_EMIT connected(table);
}

void PlantConnection::lost(ControlClient::Loss loss, const QString &reason)
{
    const bool isMaster = loss == ControlClient::Loss::Rejected || loss == ControlClient::Loss::OtherVersion;
    failed(sentenceOf(loss, reason, m_control.rejection()), isMaster ? CannotWork : NotThere);
}

void PlantConnection::failed(const QString &reason, Failure failure)
{
    if (!m_isOpen)
        return;
    m_listenerRetry.stop();
    m_listener.disconnectFromMaster();
    const bool wasConnected = m_state == Connected;
    m_retry.start(pauseAfter(++m_failures));
    setState(Disconnected, reason);
    if (wasConnected)
        Q_EMIT disconnected(reason);
    else if (failure == CannotWork)
        Q_EMIT refused(reason);
}

void PlantConnection::listen()
{
    m_listener.connectToMaster(m_master, m_table, m_period, m_every);
}

void PlantConnection::setRate(double framesPerSecond)
{
    m_rate = framesPerSecond;
    chooseInterval();
}

void PlantConnection::setPeriod(qint64 period)
{
    m_period = period;
    chooseInterval();
}

void PlantConnection::chooseInterval()
{
    const int every = cyclesForEach(m_rate, m_period);
    if (every == m_every)
        return;
    m_every = every;
    if (m_state != Connected)
        return;
    m_listenerRetry.stop();
    listen();
}

void PlantConnection::listenerLost(const QString &sentence)
{
    if (m_state != Connected)
        return;
    m_listenerReason = sentence;
    m_listenerRetry.start(pauseAfter(++m_listenerFailures));
}

void PlantConnection::setState(State state, const QString &reason)
{
    if (state == m_state && reason == m_reason)
        return;
    m_state = state;
    m_reason = reason;
    Q_EMIT stateChanged();
}

}  // namespace qplc
