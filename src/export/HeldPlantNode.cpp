// SPDX-License-Identifier: Apache-2.0
#include "HeldPlantNode.h"

#include <algorithm>
#include <stdexcept>
#include <thread>

using namespace std::chrono_literals;

namespace qplc_export {

namespace {

QPlcValue setting(const QPlcNodeRunner &runner, const char *key)
{
    return runner.value(QLatin1String(ExportedNode::SettingPrefix) + QLatin1String(key));
}

/// What a signal has before anybody has written it.
void writeFirst(const QPlcSignalDefinition &signal, char *bytes)
{
    (signal.initial.isFinite() ? signal.initial : signal.safeValue()).toBytes(bytes);
}

std::chrono::nanoseconds duration(const QPlcNodeRunner &runner, const char *key)
{
    return std::chrono::nanoseconds(qRound64(setting(runner, key).toReal() * 1e9));
}

}  // namespace

// ---- ports ----

BytesPort::BytesPort(QPlcCompactSlaveNode *node, const QPlcSignalDefinition &signal, Direction direction,
                     QPlcInputTiming::Value timing)
    : QPlcPort(node, signal.name.toUtf8().constData(), direction, timing)
    , m_type(signal.type)
{
    writeFirst(signal, m_bytes.data());
}

bool BytesPort::set(const char *bytes)
{
    const auto size = std::size_t(m_type.size());
    const bool isOther = std::memcmp(m_bytes.data(), bytes, size) != 0;
    std::memcpy(m_bytes.data(), bytes, size);
    return isOther;
}

HostNode::HostNode(const QString &name, const QVector<QPlcSignalDefinition> &signalList, QPlcPort::Direction direction)
    : QPlcCompactSlaveNode(name)
{
    for (const QPlcSignalDefinition &signal : signalList)
        m_ports.push_back(std::make_unique<BytesPort>(this, signal, direction, QPlcInputTiming::SameCycle));
}

// ---- before a phase ----

HeldPlantNode::HeldPlantNode(const char *configuration)
    : QPlcCompactSlaveNode(QStringLiteral("Plant"))
    , m_text(configuration)
{
}

HeldPlantNode::~HeldPlantNode() = default;

bool HeldPlantNode::prepare(const QPlcSignalTable &table, QPlcSignalTable *host, QString *error)
{
    if (!m_configuration.read(m_text, table, error))
        return false;
    m_table = table;
    QPlcSignalTable seen;
    for (QPlcSignalDefinition signal : qAsConst(m_table)) {
        signal.writers.clear();
        seen.append(signal);
    }
    for (const QPlcSignalDefinition &signal : qAsConst(m_configuration.settings)) {
        if (!seen.append(signal, error))
            return false;
        m_settingPorts.push_back(std::make_unique<BytesPort>(this, signal, QPlcPort::Input));
    }
    for (const QString &name : qAsConst(m_configuration.gives))
        m_inputs.push_back(std::make_unique<BytesPort>(this, table.at(table.indexOf(name)), QPlcPort::Input));
    for (const QString &name : qAsConst(m_configuration.gets))
        m_outputs.push_back(std::make_unique<BytesPort>(this, table.at(table.indexOf(name)), QPlcPort::Output));
    *host = seen;
    return true;
}

bool HeldPlantNode::open(const QPlcNodeRunner &runner, QString *error)
{
    m_startTimeout = std::chrono::duration_cast<std::chrono::milliseconds>(duration(runner, "start_timeout"));
    for (const std::unique_ptr<BytesPort> &input : m_inputs)
        input->set(runner.bytes(m_table.indexOf(input->name())));
    QVector<QPlcValue> settings;
    for (const QPlcSignalDefinition &signal : qAsConst(m_configuration.settings)) {
        settings << runner.value(signal.name);
        if (settings.last().isFinite() && signal.isInRange(settings.last()))
            continue;
        *error = QStringLiteral("%1 is %2; use %3").arg(signal.name, settings.last().toString(), signal.rangeText());
        return false;
    }
    if (settings != m_settings) {
        if (!setUp(runner, error))
            return false;
        m_settings = settings;
    }
    if (!makeReady(error))
        return false;
    giveInputs();
    if (!m_master->initialize(m_startTimeout)) {
        *error = m_master->errorString();
        return false;
    }
    return m_isOpen = true;
}

/// Makes the master anew, unless it is new.
bool HeldPlantNode::setUp(const QPlcNodeRunner &runner, QString *error)
{
    if (m_giver || m_reader)
        m_master = std::make_unique<QPlcEmbeddedMaster>();
    m_giver = m_reader = nullptr;
    m_settings.clear();
    bool isConfigured = false;
    m_master->call([&](QPlcMasterNode &master) { isConfigured = configure(master, runner, error); });
    if (isConfigured && addHost() && listen(runner))
        return true;
    if (error->isEmpty())
        *error = m_master->errorString();
    m_giver = m_reader = nullptr;
    m_master = std::make_unique<QPlcEmbeddedMaster>();
    return false;
}

bool HeldPlantNode::addHost()
{
    const auto add = [this](const QString &name, const QStringList &names, QPlcPort::Direction direction) {
        QVector<QPlcSignalDefinition> definitions;
        for (const QString &signal : names)
            definitions << m_table.at(m_table.indexOf(signal));
        return names.isEmpty() ? nullptr : m_master->addNode<HostNode>(name, definitions, direction);
    };
    m_giver = add(QStringLiteral("Host"), m_configuration.gives, QPlcPort::Output);
    m_reader = add(QStringLiteral("HostReader"), m_configuration.gets, QPlcPort::Input);
    return (m_giver || m_configuration.gives.isEmpty()) && (m_reader || m_configuration.gets.isEmpty());
}

bool HeldPlantNode::listen(const QPlcNodeRunner &runner)
{
    const QString given = setting(runner, "listen").toString();
    const QHostAddress address = given.isEmpty() ? QHostAddress(QHostAddress::LocalHost) : QHostAddress(given);
    const auto port = quint16(setting(runner, "port").toInt64());
    quint16 own = 0;
    m_master->call([&](QPlcMasterNode &master) {
        if (master.startServer(QPlcUnderlyingProtocol::tcp(address, port)))
            own = master.serverPort();
    });
    if (own != 0)
        m_tell(News::Address,
               QStringLiteral("the plant listens on %1, port %2, and waits up to %3 s for its nodes")
                   .arg(address.toString())
                   .arg(own)
                   .arg(double(m_startTimeout.count()) * 1e-3));
    return own != 0;
}

/// In the thread of the master.
bool HeldPlantNode::configure(QPlcMasterNode &master, const QPlcNodeRunner &runner, QString *error) const
{
    const QString listen = setting(runner, "listen").toString();
    const QString keys = setting(runner, "keys").toString();
    if (!listen.isEmpty() && QHostAddress(listen).isNull())
        *error = QStringLiteral("plant.listen '%1' is no address; use one of this computer, for example 127.0.0.1")
                     .arg(listen);
    else if (!listen.isEmpty() && !QHostAddress(listen).isLoopback() && keys.isEmpty())
        *error = QStringLiteral("plant.listen '%1': everybody in that network could command the plant; name a file of "
                                "keys in plant.keys (qtplc keys new), or listen on 127.0.0.1")
                     .arg(listen);
    if (!error->isEmpty())
        return false;
    if (!keys.isEmpty()) {
        QPlcSecurity security = QPlcSecurity::preSharedKeys(keys);
        security.setAccessFile(setting(runner, "access").toString());
        *error = security.errorString(QPlcSecurity::MasterSide);
        if (!error->isEmpty())
            return false;
        master.setSecurity(security);
    }
    master.setProfile(m_configuration.manifest.profile);
    if (master.setSignalTable(m_table) && master.setManifest(m_configuration.manifest)
        && master.setInterval(runner.period()) && master.setLongestWait(duration(runner, "longest_wait"))
        && (m_configuration.timeSignal.isEmpty() || master.setTimeSignal(m_configuration.timeSignal)))
        return true;
    *error = master.errorString();
    return false;
}

/// A former phase may have ended in a safe stop.
bool HeldPlantNode::makeReady(QString *error)
{
    m_late.clear();
    m_warning.clear();
    m_endReason.clear();
    bool isReady = true;
    m_master->call([&](QPlcMasterNode &master) {
        master.stop();
        if (master.state() == State::SafeStop || master.state() == State::Fault)
            isReady = master.reset();
        if (!isReady)
            *error = master.errorString();
    });
    return isReady;
}

void HeldPlantNode::reset()
{
    for (std::size_t i = 0; i < m_outputs.size(); ++i) {
        BytesPort::Bytes bytes;
        writeFirst(m_table.at(m_table.indexOf(m_outputs[i]->name())), bytes.data());
        m_outputs[i]->set(m_isOpen ? m_reader->ports()[i]->bytes() : bytes.data());
    }
}

/// Begins the phase. The host may have given other inputs since open().
void HeldPlantNode::initialized()
{
    if (!m_isOpen)
        fail(QStringLiteral("the plant is not open"));
    if ((giveInputs() && !m_master->initialize(m_startTimeout)) || !m_master->start(m_startTimeout))
        fail(m_master->errorString());
}

// ---- cycles ----

/// \return true when one of them is another one than before
bool HeldPlantNode::giveInputs()
{
    bool isOther = false;
    for (std::size_t i = 0; i < m_inputs.size(); ++i)
        isOther = m_giver->ports()[i]->set(m_inputs[i]->bytes()) || isOther;
    return isOther;
}

void HeldPlantNode::takeOutputs()
{
    for (std::size_t i = 0; i < m_outputs.size(); ++i)
        m_outputs[i]->set(m_reader->ports()[i]->bytes());
}

void HeldPlantNode::step(const QPlcCycle &cycle)
{
    using Result = QPlcMasterNode::StepResult;
    m_warning.clear();
    giveInputs();
    switch (m_master->step()) {
    case Result::Complete:
        return takeOutputs();
    case Result::Late:
        m_warning = lateText(cycle.number());
        return takeOutputs();
    case Result::SafeStop:
        fail(QStringLiteral("the plant has stopped safely in cycle %1: %2").arg(cycle.number()).arg(failure()));
    case Result::Stopped:
        if (const QString text = failure(); !text.isEmpty())
            fail(QStringLiteral("the plant has stopped in cycle %1: %2").arg(cycle.number()).arg(text));
        m_endReason = QStringLiteral("a person or a program has stopped the plant in cycle %1").arg(cycle.number());
        return requestSafeStop();
    case Result::Busy:
        fail(QStringLiteral("another thread is in a step of this plant; let one thread call it"));
    }
}

void HeldPlantNode::fail(const QString &text)
{
    m_endReason = text;
    throw std::runtime_error(text.toLocal8Bit().constData());
}

/// Why the phase has ended; empty: a person or a program has stopped it. The thread of the master
/// knows it a little later than the step.
QString HeldPlantNode::failure()
{
    QString reason;
    bool hasEnded = false;
    for (int i = 0; i < 100 && !hasEnded; ++i) {
        if (i > 0)
            std::this_thread::sleep_for(10ms);
        m_master->call([&](QPlcMasterNode &master) {
            hasEnded = master.state() != State::RealTime;
            reason = master.stateReason();
            if (reason.isEmpty() && master.error() == QPlcMasterNode::NodeError)
                reason = master.errorString();
        });
    }
    return reason;
}

/// Which nodes have not answered, or are gone.
QString HeldPlantNode::lateText(quint64 cycle)
{
    QStringList names;
    m_master->call([&](QPlcMasterNode &master) {
        const QVector<QPlcNodeInfo> nodes = master.nodes();
        for (const QPlcManifest::Node &needed : m_configuration.manifest.nodes) {
            const auto isNeeded = [&](const QPlcNodeInfo &node) { return node.name == needed.name; };
            if (std::none_of(nodes.begin(), nodes.end(), isNeeded))
                names << needed.name;
        }
        for (const QPlcNodeInfo &node : nodes) {
            if (std::exchange(m_late[node.name], node.lateAnswers) < node.lateAnswers)
                names << node.name;
        }
    });
    return QStringLiteral("cycle %1 went on without new values of %2: it did not answer within plant.longest_wait, or "
                          "is lost")
        .arg(cycle)
        .arg(names.isEmpty() ? QStringLiteral("a node")
                             : QStringLiteral("'%1'").arg(names.join(QStringLiteral("', '"))));
}

void HeldPlantNode::stopped()
{
    QPlcMasterStatistics statistics;
    m_master->call([&](QPlcMasterNode &master) {
        master.stop();
        statistics = master.statistics();
    });
    m_tell(News::Result,
           QStringLiteral("the plant has computed %1 cycles; the digest of all values is %2")
               .arg(statistics.cycles)
               .arg(statistics.imageDigest, 16, 16, QLatin1Char('0')));
}

}  // namespace qplc_export
