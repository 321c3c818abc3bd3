// SPDX-License-Identifier: Apache-2.0
#include "QPlcHardwareNode.h"

#include "ChannelPort.h"
#include "DriverCatalog.h"
#include "DriverRunner.h"
#include "HardwareConfiguration.h"
#include "HardwareLogging.h"
#include "realtime/Host.h"
#include "realtime/TimeSource.h"
#include "signals/IniParser.h"
#include "signals/MessageText.h"

#include <QtCore/QCoreApplication>

#include <algorithm>
#include <cmath>
#include <thread>

using qplc::ChannelPort;
using qplc::DriverCatalog;
using qplc::DriverRunner;
using qplc::HardwareConfiguration;

namespace {

/// The name of the condition that the device of a driver is lost, or cannot be opened.
QString alarmOf(const QString &driver)
{
    return QStringLiteral("device %1").arg(driver);
}

}  // namespace

struct QPlcHardwareNode::Private
{
    /// A channel that stops the plant.
    struct SafeStop
    {
        DriverRunner *runner = nullptr;
        int channel = -1;
    };
    /// A value that the configuration gives to a channel.
    struct GivenValue
    {
        DriverRunner *runner = nullptr;
        int channel = -1;
        double value = 0.0;
    };

    explicit Private(QPlcHardwareNode *node)
        : q(node)
    {
    }

    /// Of what can be read of the file, also when another part of it is wrong: so all errors are
    /// told at once.
    void build(HardwareConfiguration *configuration)
    {
        for (const HardwareConfiguration::Driver &driver : configuration->drivers())
            buildDriver(configuration, driver);
        for (const HardwareConfiguration::Watched &watched : configuration->safeStops())
            buildSafeStop(configuration, watched);
        if (!configuration->errors().isEmpty())
            return;  // a wire that is wrong would be missed here
        for (const std::unique_ptr<ChannelPort> &port : ports) {
            const QString missing = port->isInput() ? QString() : port->missingElements();
            if (!missing.isEmpty())
                configuration->addError(
                    {}, QStringLiteral("no channel gives a value to %1; add it to a section 'read'").arg(missing));
        }
    }

    void buildDriver(HardwareConfiguration *configuration, const HardwareConfiguration::Driver &driver)
    {
        const QMap<QString, DriverCatalog::Kind> &kinds = DriverCatalog::instance().kinds();
        const auto kind = kinds.find(driver.kind);
        if (kind == kinds.end()) {
            if (!driver.kind.isEmpty())
                configuration->addError(driver.entry,
                                        QStringLiteral("there is no driver %1%2%3")
                                            .arg(qplc::quoted(driver.kind),
                                                 qplc::didYouMean(qplc::closeNames(driver.kind, kinds.keys())),
                                                 qplc::knownAre(kinds.keys())));
            return;
        }
        runners.push_back(std::make_unique<DriverRunner>(driver.name, driver.kind, kind->make()));
        DriverRunner *runner = runners.back().get();
        const std::unique_ptr<QPlcDriverSettings> settings = configuration->settings(driver);
        runner->configure(*settings);
        configuration->checkUse(*settings);
        for (const HardwareConfiguration::SafeValue &safe : driver.safeValues)
            buildSafeValue(configuration, runner, *settings, safe);
        for (const HardwareConfiguration::Wire &wire : driver.wires)
            buildWire(configuration, runner, *settings, wire);
    }

    /// A channel that is missing because of another error is not told: it would be an echo.
    static void tellMissingChannel(HardwareConfiguration *configuration, const QPlcDriverSettings &settings,
                                   const QString &channel, const qplc::ConfigurationEntry &entry, const QString &error)
    {
        if (!HardwareConfiguration::isExcused(settings, channel))
            configuration->addError(entry, error);
    }

    void buildWire(HardwareConfiguration *configuration, DriverRunner *runner, const QPlcDriverSettings &settings,
                   const HardwareConfiguration::Wire &wire)
    {
        const bool isRead = wire.direction == QPlcChannel::Read;
        const qplc::ConfigurationTerm &signal = isRead ? wire.target : wire.source;
        const QString channel = (isRead ? wire.source : wire.target).name;
        QString error;
        const int number = runner->wire(channel, wire.direction, &error);
        if (number < 0) {
            tellMissingChannel(configuration, settings, channel, wire.entry, error);
            return;
        }
        bool isConstant = false;
        const double constant = isRead ? 0.0 : signal.name.toDouble(&isConstant);
        if (isConstant) {
            checkValue(configuration, runner, number, constant * signal.factor + signal.offset, wire.entry);
            addConstant(configuration, {runner, number, constant * signal.factor + signal.offset}, wire.entry);
            return;
        }
        ChannelPort *port = this->port(signal.name, isRead ? QPlcPort::Output : QPlcPort::Input);
        if (!port->add(signal.element, {runner, number, wire.source.factor, wire.source.offset}))
            configuration->addError(
                wire.entry,
                QStringLiteral("%1 is wired twice, or with brackets and without; wire each element once")
                    .arg(qplc::quoted(signal.name)));
    }

    void buildSafeValue(HardwareConfiguration *configuration, DriverRunner *runner, const QPlcDriverSettings &settings,
                        const HardwareConfiguration::SafeValue &safe)
    {
        QString error;
        const int number = runner->wire(safe.channel, QPlcChannel::Write, &error);
        if (number < 0) {
            tellMissingChannel(configuration, settings, safe.channel, safe.entry, error);
            return;
        }
        checkValue(configuration, runner, number, safe.value, safe.entry);
        const std::optional<double> rest = runner->restValue(number);
        if (rest && *rest != safe.value)
            configuration->addWarning(
                safe.entry,
                QStringLiteral("the safe value of %1 is %2, and without the program or its power it is %3; wire the "
                               "device so that %3 is safe")
                    .arg(qplc::quoted(safe.channel))
                    .arg(safe.value)
                    .arg(*rest));
        safeValues.push_back({runner, number, safe.value});
    }

    static void checkValue(HardwareConfiguration *configuration, const DriverRunner *runner, int channel, double value,
                           const qplc::ConfigurationEntry &entry)
    {
        const QString problem = runner->problemOf(channel, value);
        if (!problem.isEmpty())
            configuration->addError(entry, problem);
    }

    void buildSafeStop(HardwareConfiguration *configuration, const HardwareConfiguration::Watched &watched)
    {
        QStringList names;
        for (const std::unique_ptr<DriverRunner> &runner : runners) {
            names << runner->name();
            if (runner->name() != watched.driver)
                continue;
            QString error;
            const int number = runner->wire(watched.channel, QPlcChannel::Read, &error);
            if (number < 0) {
                configuration->addError(watched.entry, error);
                return;
            }
            safeStops.push_back({runner.get(), number});
            warnOfTornWire(configuration, watched, runner->tornValue(number));
            return;
        }
        for (const HardwareConfiguration::Driver &driver : configuration->drivers()) {
            if (driver.name == watched.driver)
                return;  // its section has an error
        }
        configuration->addError(
            watched.entry,
            QStringLiteral("there is no device %1%2")
                .arg(qplc::quoted(watched.driver), qplc::didYouMean(qplc::closeNames(watched.driver, names))));
    }

    static void warnOfTornWire(HardwareConfiguration *configuration, const HardwareConfiguration::Watched &watched,
                               std::optional<double> value)
    {
        const QString name = watched.driver + QLatin1Char('.') + watched.channel;
        if (value && std::isnan(*value))
            configuration->addWarning(watched.entry,
                                      QStringLiteral("%1 has no resistor: with a torn wire its value is undefined; add "
                                                     "pull-up, or no-pull if there is an external resistor")
                                          .arg(qplc::quoted(name)));
        else if (value && *value == 0.0)
            configuration->addWarning(
                watched.entry,
                QStringLiteral("%1 is 0 with a torn wire, so the plant would not stop; use a contact that is normally "
                               "closed to ground, pull-up, and no active-low")
                    .arg(qplc::quoted(name)));
    }

    /// A number in place of a signal: while the node computes, the channel has it.
    void addConstant(HardwareConfiguration *configuration, const GivenValue &constant,
                     const qplc::ConfigurationEntry &entry)
    {
        const auto isSame = [&](const GivenValue &safe) {
            return safe.runner == constant.runner && safe.channel == constant.channel;
        };
        if (std::any_of(safeValues.begin(), safeValues.end(), isSame))
            constants.push_back(constant);
        else
            configuration->addError(entry,
                                    QStringLiteral("no signal gives %1 a safe value; add '%2 = ...' to the "
                                                   "section 'safe' of the device")
                                        .arg(qplc::quoted(entry.key), entry.key));
    }

    ChannelPort *port(const QString &signal, QPlcPort::Direction direction)
    {
        const auto found = std::find_if(ports.begin(), ports.end(), [&](const std::unique_ptr<ChannelPort> &port) {
            return port->name() == signal && port->direction() == direction;
        });
        if (found != ports.end())
            return found->get();
        ports.push_back(std::make_unique<ChannelPort>(q, signal, direction));
        return ports.back().get();
    }

    void clear()
    {
        ports.clear();
        runners.clear();
        safeStops.clear();
        safeValues.clear();
        constants.clear();
    }

    void writeAll() noexcept
    {
        const qint64 now = qplc::monotonicNow();
        for (const std::unique_ptr<DriverRunner> &runner : runners)
            runner->write(now);
    }

    /// Likewise, at once; then the devices belong to the threads of their drivers until the next
    /// writeAll().
    void leaveAll() noexcept
    {
        const qint64 now = qplc::monotonicNow();
        for (const std::unique_ptr<DriverRunner> &runner : runners)
            runner->leave(now);
    }

    void readAll(qint64 now) noexcept
    {
        for (const std::unique_ptr<DriverRunner> &runner : runners)
            runner->read(now);
        for (const std::unique_ptr<ChannelPort> &port : ports) {
            if (!port->isInput())
                port->refresh(now);
        }
    }

    /// What the configuration says wins over the signal table. \param knowTable that the ports are
    /// bound to
    void setSafeValues(bool knowTable)
    {
        const QPlcSignalTable table = knowTable ? q->signalTable() : QPlcSignalTable();
        for (const std::unique_ptr<ChannelPort> &port : ports) {
            const QPlcSignalIndex index = table.indexOf(port->name());
            if (port->isInput() && index != QPlcInvalidSignalIndex)
                port->setSafe(table.at(index).safeValue());
        }
        give(safeValues, true);
    }

    /// \param isWatched  whether it is told which values a device has not taken
    void open(DriverRunner *runner, bool isWatched = false)
    {
        QPlcHardwareNode *node = q;
        const auto report = [node, name = runner->name()](const QString &error) {
            QMetaObject::invokeMethod(
                node, [node, name, error] { node->deviceChanged(name, error); }, Qt::QueuedConnection);
        };
        const auto reportEvent = [node](const QPlcDeviceEvent &event) {
            QMetaObject::invokeMethod(
                node, [node, event] { node->tellEvent(event); }, Qt::QueuedConnection);
        };
        const auto reportDelivery = [this, node, name = runner->name()](const QString &problem) {
            QMetaObject::invokeMethod(
                node, [this, name, problem] { undelivered.insert(name, problem); }, Qt::QueuedConnection);
        };
        runner->start(report, reportEvent, isWatched ? DriverRunner::Report(reportDelivery) : DriverRunner::Report());
    }

    static void give(const std::vector<GivenValue> &values, bool isSafe) noexcept
    {
        for (const GivenValue &given : values)
            given.runner->setValue(given.channel, given.value, isSafe);
    }

    /// A device that has just been asked for, or has nothing to say yet, would be an emergency stop
    /// in the first cycle.
    void awaitSafeStops()
    {
        constexpr qint64 patience = 500'000'000;  // [ns]
        const qint64 end = qplc::monotonicNow() + patience;
        const auto isMissing = [](const SafeStop &stop) {
            const qint64 now = qplc::monotonicNow();
            stop.runner->read(now);
            return !stop.runner->sample(stop.channel, now).isFresh;
        };
        while (std::any_of(safeStops.begin(), safeStops.end(), isMissing) && qplc::monotonicNow() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }

    QPlcHardwareNode *q;
    QVector<QPlcParseError> errors;
    QVector<QPlcParseError> warnings;
    std::vector<std::unique_ptr<DriverRunner>> runners;
    std::vector<std::unique_ptr<ChannelPort>> ports;  // destroyed before the runners
    std::vector<SafeStop> safeStops;
    std::vector<GivenValue> safeValues;
    std::vector<GivenValue> constants;   // while the node computes
    QMap<QString, QString> failures;     // of drivers that are not online
    QMap<QString, QString> undelivered;  // why the device of a driver has not taken its values, of makeSafe()
    bool isOpen = false;
    bool isSafe = false;  // until the next initialization
};

// ---- configuration ----

QPlcHardwareNode::QPlcHardwareNode(const QString &name, QObject *parent)
    : QPlcCompactSlaveNode(name, ErrorZeroOrderHold, parent)
    , m_hardware(std::make_unique<Private>(this))
{
    qRegisterMetaType<QPlcDeviceEvent>("QPlcDeviceEvent");
    setSendsQuality(true);
    setDefaultWatchdog(DefaultWatchdog, 4);
    setWatchdogReaction(WatchdogReaction::SafeState);
}

QPlcHardwareNode::~QPlcHardwareNode()
{
    disconnectFromMaster();
    closeDevices();
    m_hardware->clear();
}

bool QPlcHardwareNode::configureFromFile(const QString &fileName)
{
    constexpr qint64 largest = 1 << 20;  // [byte]
    QByteArray text;
    return qplc::IniParser::readFile(fileName, QStringLiteral("the configuration of a hardware node"), largest, &text,
                                     &m_hardware->errors)
        && configure(text, fileName);
}

bool QPlcHardwareNode::configure(const QByteArray &text, const QString &fileName)
{
    Q_ASSERT_X(m_hardware->runners.empty(), "QPlcHardwareNode::configure", "a node is configured once");
    HardwareConfiguration configuration(text, fileName);
    m_hardware->build(&configuration);
    m_hardware->errors = configuration.errors();
    m_hardware->warnings = configuration.warnings();
    if (!m_hardware->errors.isEmpty()) {
        m_hardware->clear();
        return false;
    }
    setHardware(configuration.hasRealDevices());
    for (const std::unique_ptr<DriverRunner> &runner : m_hardware->runners)
        runner->prepare();
    m_hardware->setSafeValues(false);
    m_hardware->leaveAll();
    if (!configuration.nodeName().isEmpty())
        setName(configuration.nodeName());
    return true;
}

QVector<QPlcParseError> QPlcHardwareNode::configurationErrors() const
{
    return m_hardware->errors;
}

QVector<QPlcParseError> QPlcHardwareNode::configurationWarnings() const
{
    return m_hardware->warnings;
}

void QPlcHardwareNode::addDriverKind(const QString &kind, const QString &description,
                                     std::function<std::unique_ptr<QPlcDriver>()> make)
{
    DriverCatalog::instance().add(kind, {description, std::move(make)});
}

QVector<QPair<QString, QString>> QPlcHardwareNode::driverKinds()
{
    QVector<QPair<QString, QString>> kinds;
    const QMap<QString, DriverCatalog::Kind> &known = DriverCatalog::instance().kinds();
    for (auto kind = known.begin(); kind != known.end(); ++kind)
        kinds.append({kind.key(), kind->description});
    return kinds;
}

// ---- devices ----

void QPlcHardwareNode::openDevices()
{
    if (m_hardware->isOpen)
        return;
    m_hardware->isOpen = true;
    for (const std::unique_ptr<DriverRunner> &runner : m_hardware->runners)
        m_hardware->open(runner.get());
}

QStringList QPlcHardwareNode::makeSafe(std::chrono::milliseconds timeout)
{
    m_hardware->setSafeValues(false);
    m_hardware->leaveAll();
    m_hardware->isOpen = true;
    std::vector<DriverRunner *> runners;
    for (const std::unique_ptr<DriverRunner> &runner : m_hardware->runners) {
        if (runner->isNeededForSafety())
            runners.push_back(runner.get());
    }
    for (DriverRunner *runner : runners)
        m_hardware->open(runner, true);
    const auto isMissing = [](const DriverRunner *runner) { return !runner->isDelivered(); };
    const qint64 end = qplc::monotonicNow() + std::chrono::nanoseconds(timeout).count();
    while (std::any_of(runners.begin(), runners.end(), isMissing) && qplc::monotonicNow() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    QCoreApplication::sendPostedEvents(this, QEvent::MetaCall);  // what the threads have reported
    QStringList problems;
    for (const DriverRunner *runner : runners) {
        if (runner->isOnline() && isMissing(runner))
            problems << QStringLiteral("device '%1' has not taken its safe values: %2")
                            .arg(runner->name(),
                                 m_hardware->undelivered.value(runner->name(), QStringLiteral("no answer yet")));
        else if (isMissing(runner))
            problems << QStringLiteral("device '%1' was not reached: %2")
                            .arg(runner->name(),
                                 m_hardware->failures.value(runner->name(), QStringLiteral("no answer")));
        for (const QString &output : runner->unsetOutputs())
            problems << QStringLiteral("%1.%2 has no safe value in the configuration; add it to the section '%1.safe'")
                            .arg(runner->name(), output);
    }
    return problems;
}

void QPlcHardwareNode::deviceChanged(const QString &driver, const QString &error)
{
    if (error.isEmpty()) {
        const QString text = QStringLiteral("device '%1' is open").arg(driver);
        m_hardware->failures.remove(driver);
        qCInfo(lcHardware).noquote() << name() + QStringLiteral(": ") + text;
        endAlarm(alarmOf(driver), text);
        Q_EMIT deviceOpened(driver);
        return;
    }
    const QString text = QStringLiteral("device '%1': %2 (trying again)").arg(driver, error);
    m_hardware->failures.insert(driver, error);
    qCWarning(lcHardware).noquote() << name() + QStringLiteral(": ") + text;
    if (m_hardware->isOpen)  // else it was told before the device was closed
        beginAlarm(alarmOf(driver), ErrorEvent, text);
    Q_EMIT deviceFailed(driver, error);
}

void QPlcHardwareNode::tellEvent(const QPlcDeviceEvent &event)
{
    const QString line = name() + QStringLiteral(": ") + event.text;
    if (event.severity == InfoEvent)
        qCInfo(lcHardware).noquote() << line;
    else
        qCWarning(lcHardware).noquote() << line;
    if (event.alarm.isEmpty())
        reportEvent(event.severity, event.text);
    else if (event.isActive)
        beginAlarm(event.alarm, event.severity, event.text);
    else
        endAlarm(event.alarm, event.text);
    Q_EMIT deviceEvent(event);
}

void QPlcHardwareNode::closeDevices()
{
    if (!m_hardware->isOpen)
        return;
    if (state() == RealTime) {
        qCWarning(lcHardware).noquote()
            << QStringLiteral("%1: devices are not closed while cycles run; stop the real-time phase first, or "
                              "disconnect the node")
                   .arg(name());
        return;
    }
    m_hardware->setSafeValues(true);
    m_hardware->leaveAll();
    for (const std::unique_ptr<DriverRunner> &runner : m_hardware->runners) {
        runner->stop();
        endAlarm(alarmOf(runner->name()), QStringLiteral("device '%1' is closed").arg(runner->name()));
    }
    m_hardware->isOpen = false;
}

QVector<QPlcHardwareNode::DriverState> QPlcHardwareNode::drivers() const
{
    QVector<DriverState> states;
    for (const std::unique_ptr<DriverRunner> &runner : m_hardware->runners)
        states.append({runner->name(), runner->kind(), runner->isOnline(), runner->failures(),
                       m_hardware->failures.value(runner->name())});
    return states;
}

QVector<QPlcHardwareNode::Wire> QPlcHardwareNode::wires() const
{
    const qint64 now = qplc::monotonicNow();
    QVector<Wire> wires;
    for (const std::unique_ptr<ChannelPort> &port : m_hardware->ports) {
        for (const ChannelPort::Wire &wire : port->wires()) {
            const auto direction = port->isInput() ? QPlcChannel::Write : QPlcChannel::Read;
            wires.append(wire.runner->wireState(wire.channel, direction, now));
            wires.last().signal = port->elementName(wire.element);
        }
    }
    for (const Private::GivenValue &constant : m_hardware->constants) {
        wires.append(constant.runner->wireState(constant.channel, QPlcChannel::Write, now));
        wires.last().signal = QString::number(constant.value);
    }
    return wires;
}

void QPlcHardwareNode::readDevices()
{
    m_hardware->readAll(qplc::monotonicNow());
}

// ---- cycles ----

void QPlcHardwareNode::reset()
{
    if (&qplc::Host::current() != &qplc::Host::machine())
        throw std::runtime_error(
            "a simulated computer has no devices; test the code of this node with a node of your own");
    m_hardware->isSafe = false;
    m_hardware->setSafeValues(true);
    m_hardware->leaveAll();
    openDevices();
    m_hardware->awaitSafeStops();
    m_hardware->readAll(qplc::monotonicNow());
}

void QPlcHardwareNode::step(const QPlcCycle &)
{
    if (m_hardware->isSafe)
        return;  // a listener is asked all the same
    Private::give(m_hardware->constants, false);
    m_hardware->writeAll();
    const qint64 now = qplc::monotonicNow();
    m_hardware->readAll(now);
    for (const Private::SafeStop &stop : m_hardware->safeStops) {
        const DriverRunner::Sample sample = stop.runner->sample(stop.channel, now);
        if (!sample.isFresh || sample.value != 0.0)
            requestSafeStop();
    }
}

/// The ports have passed the safe values of the table already; those of the configuration win.
void QPlcHardwareNode::safeState(SafeStateReason)
{
    m_hardware->isSafe = true;
    for (const std::unique_ptr<ChannelPort> &port : m_hardware->ports) {
        if (port->isInput())
            port->pass(true);
    }
    Private::give(m_hardware->safeValues, true);
    m_hardware->leaveAll();
}
