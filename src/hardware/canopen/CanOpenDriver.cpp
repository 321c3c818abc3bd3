// SPDX-License-Identifier: Apache-2.0
#include "CanOpenAxisChannels.h"
#include "CanOpenClient.h"
#include "CanOpenMonitor.h"
#include "CanOpenPdos.h"
#include "QPlcDriverSettings.h"
#include "hardware/Drivers.h"
#include "hardware/HardwareLogging.h"

#include <algorithm>
#include <cerrno>

namespace qplc {

namespace {

constexpr qint64 restartTime = 1'000'000'000;            // [ns] that a controller has to come back by itself
constexpr std::chrono::milliseconds shortestStart{500};  // in which a device tells that it is Operational

/// A device on a CANopen bus; kind `canopen`, part of each cycle.
///
/// ```ini
/// [drive]
/// driver = canopen
/// device = can0                        ; as of driver can; several sections may share a bus
/// node = 5
/// eds = drive.eds                      ; optional: names, types, default PDOs, identity
/// sync = every cycle                   ; this section sends SYNC; or: from others, none
/// heartbeat = 100 ms                   ; of the device and of the master; lost after two of them
/// master = 127                         ; node id in the heartbeats of the master; 0: it sends none
/// profile = 402                        ; a drive: channels enable, velocity, ... (Cia402Axis)
/// mode = cyclic synchronous velocity
/// limit.velocity = 3000                ; targets are cut to it; also torque, position-min, -max
/// tpdo1 = 6041:00, 6061:00, 606C:00    ; objects that the device sends, by address or name
/// rpdo1 = 6040:00, 6060:00, 60FF:00
/// tpdo2 = every 20 ms, 2001:03 u16     ; on event; or: every sync, every 5 syncs, id 0x2A5
/// set.6085:00 = 3000                   ; before it is started
/// ```
///
/// A section without `node` only sends the SYNC of the bus, so that the loss of one device does not
/// stop it for the others.
///
/// It is open when the device has answered, is the right one, was configured, and tells in its
/// heartbeat that it is Operational. It is lost when two heartbeats are missing, when it has
/// restarted, or when it is not Operational any more; it is configured and started anew then.
class CanOpenDriver final : public QPlcDriver
{
public:
    CanOpenDriver()
        : QPlcDriver(EveryCycle)
        , m_pdos(this)
        , m_axis(this)
    {
    }

protected:
    void configure(QPlcDriverSettings &settings) override
    {
        m_plan.read(settings);
        QString error;
        if (!m_plan.device.isEmpty())
            m_bus = CanBus::make(m_plan.device, &error);
        if (!error.isEmpty())
            settings.addError(QStringLiteral("device"), error);
        m_pdos.setPlan(m_plan);
        m_axis.setPlan(m_plan);
        const QByteArray title = QStringLiteral("node %1 at %2").arg(m_plan.node).arg(m_plan.device).toLocal8Bit();
        m_receiveText = "receive from " + m_plan.device.toLocal8Bit();
        m_sendText = "send to " + m_plan.device.toLocal8Bit();
        m_lossText = "heartbeat of " + title;
        m_stateText = "state of " + title;
    }

    QPlcChannel *channel(const QString &name, QPlcChannel::Direction direction, QString *error) override
    {
        const bool isRead = direction == QPlcChannel::Read;
        if (name.startsWith(QLatin1Char('@')))
            return isRead ? ownChannel(name) : nullptr;
        if (isRead) {
            QPlcChannel *channel = m_axis.readChannel(name);
            return channel ? channel : m_pdos.readChannel(m_axis.objectOf(name), name);
        }
        QPlcChannel *channel = m_axis.writeChannel(name, error);
        return channel || !error->isEmpty() ? channel : m_pdos.writeChannel(name);
    }

    QStringList channelNames(QPlcChannel::Direction direction) const override
    {
        const bool isRead = direction == QPlcChannel::Read;
        QStringList names = m_axis.names(isRead) + m_pdos.names(isRead);
        for (const OwnKind &kind : ownKinds()) {
            if (isRead)
                names << QLatin1String(kind.name);
        }
        return names;
    }

    bool open() override
    {
        if (!m_bus->open(busOptions()))
            return fail(m_bus->errorString());
        if (m_plan.node > 0 && !startNode()) {
            m_bus->close();
            return false;
        }
        m_busOffSince = -1;
        m_nextHeartbeat = 0;
        m_pdos.begin();
        m_axis.begin();
        return true;
    }

    void close() override
    {
        if (m_plan.node > 0)
            stopNode();
        m_bus->close();
    }

    bool read() override
    {
        if (!takeFrames())
            return false;
        for (const OwnChannel &own : m_ownChannels)
            own.channel->set(double((this->*own.number)()), now());
        m_axis.show(now());
        return checkNode() && checkBusOff();
    }

    bool write() override
    {
        if (!takeFrames())  // what came since the last SYNC belongs to it
            return false;
        const int sent = m_bus->send(m_outgoing.data(), collect());
        return sent >= 0 || fail(m_sendText.constData(), m_bus->errorNumber());
    }

    QString remedy(int errorNumber) const override
    {
        switch (errorNumber) {
        case ETIMEDOUT:
            return QStringLiteral("it was switched off, has lost the bus, or is much too busy%1").arg(lastEmergency());
        case ECONNRESET:
            return QStringLiteral("it has restarted by itself, and is configured anew; look at its supply%1")
                .arg(lastEmergency());
        case ECONNABORTED:
            return QStringLiteral("it has left Operational, by itself or for another master, and is configured anew%1")
                .arg(lastEmergency());
        case ENETDOWN:
            return QStringLiteral(
                       "the interface is down or bus-off; check wires, terminators and bit rate, and bring it up as "
                       "root (ip link set %1 up type can bitrate 500000 restart-ms 100)")
                .arg(m_plan.device);
        case ENODEV:
        case ENXIO:
            return QStringLiteral("the adapter is gone; plug it in again");
        default:
            return QPlcDriver::remedy(errorNumber);
        }
    }

private:
    using Number = quint64 (CanOpenDriver::*)() const;
    struct OwnKind
    {
        const char *name;
        Number number;
    };
    struct OwnChannel
    {
        Number number;
        std::unique_ptr<QPlcReadChannel> channel;
    };
    static const std::vector<OwnKind> &ownKinds()
    {
        static const std::vector<OwnKind> kinds{
            {"@state", &CanOpenDriver::state},
            {"@emergency", &CanOpenDriver::emergency},
            {"@errorRegister", &CanOpenDriver::errorRegister},
            {"@emergencies", &CanOpenDriver::emergencies},
            {"@heartbeatLost", &CanOpenDriver::heartbeatLost},
            {"@missed", &CanOpenDriver::missed},
            {"@saturated", &CanOpenDriver::saturated},
            {"@busState", &CanOpenDriver::busState},
            {"@received", &CanOpenDriver::received},
            {"@sent", &CanOpenDriver::sent},
            {"@unsent", &CanOpenDriver::unsent},
        };
        return kinds;
    }

    QPlcChannel *ownChannel(const QString &name)
    {
        for (const OwnChannel &own : m_ownChannels) {
            if (own.channel->name() == name)
                return own.channel.get();
        }
        for (const OwnKind &kind : ownKinds()) {
            if (name != QLatin1String(kind.name))
                continue;
            m_ownChannels.push_back({kind.number, std::make_unique<QPlcReadChannel>(this, name)});
            return m_ownChannels.back().channel.get();
        }
        return nullptr;
    }

    CanBus::Options busOptions() const
    {
        CanBus::Options options;
        options.bitRate = m_plan.bitRate;
        const auto node = quint32(m_plan.node);
        if (node > 0)
            options.keys = {CanOpenIds::Emergency + node, CanOpenIds::SdoResponse + node, CanOpenIds::Heartbeat + node};
        if (m_plan.sync == SyncSource::FromOthers)
            options.keys.push_back(CanOpenIds::Sync);
        for (const Pdo &pdo : m_plan.pdos) {
            if (pdo.isTransmit)
                options.keys.push_back(pdo.id);
        }
        return options;
    }

    // ---- before and after the cycles ----

    bool startNode()
    {
        m_monitor.forget();
        CanOpenClient client(*m_bus, m_plan.device, m_plan.node, m_plan.answerTime);
        client.setListener([this](const CanFrame &frame) { listen(frame); });
        if (!client.command(NmtCommand::EnterPreOperational) || !client.configure(m_plan)
            || !client.command(NmtCommand::Start))
            return fail(client.errorString());
        const auto isRunning = [this] { return m_monitor.state() == NmtState::Operational; };
        if (client.waitUntil(isRunning, std::max<std::chrono::nanoseconds>(3 * m_plan.heartbeat, shortestStart)))
            return true;
        return fail(QStringLiteral("node %1 at %2 was configured, and does not become Operational (it is %3); look at "
                                   "its error, and whether another master commands it%4")
                        .arg(m_plan.node)
                        .arg(m_plan.device, nmtStateText(m_monitor.state()), lastEmergency()));
    }

    // While the device is started, no cycle waits for the log.
    void listen(const CanFrame &frame)
    {
        const quint64 before = m_monitor.emergencies();
        m_monitor.take(frame, m_plan.node, timeOf(frame));
        if (m_monitor.emergencies() != before)
            qCWarning(lcHardware).noquote()
                << name() << "(node" << m_plan.node << ") tells an emergency" << lastEmergency();
    }

    // A drive brakes by itself; everything else does what it does without a master.
    void stopNode()
    {
        int count = 0;
        if (m_axis.hasCommand()) {
            m_axis.stop();
            count = m_pdos.collect(m_axis.outputs(), m_outgoing.data());
            if (m_plan.sync == SyncSource::EveryCycle)
                m_outgoing[std::size_t(count++)] = syncFrame();
        }
        CanFrame frame;
        frame.id = CanOpenIds::Nmt;
        frame.size = 2;
        frame.data[0] = quint8(NmtCommand::EnterPreOperational);
        frame.data[1] = quint8(m_plan.node);
        m_outgoing[std::size_t(count++)] = frame;
        m_bus->send(m_outgoing.data(), count);
    }

    QString lastEmergency() const
    {
        if (m_monitor.emergencies() == 0)
            return {};
        return QStringLiteral("; its last emergency was %1: %2")
            .arg(QString::asprintf("%04X", m_monitor.lastEmergency()), emergencyText(m_monitor.lastEmergency()));
    }

    // ---- in the cycle ----

    bool takeFrames() noexcept
    {
        for (int batch = 0; batch < MostBatches; ++batch) {
            const int count = m_bus->receive(m_incoming.data(), BatchSize);
            if (count < 0)
                return fail(m_receiveText.constData(), m_bus->errorNumber());
            for (int i = 0; i < count; ++i)
                deliver(m_incoming[std::size_t(i)]);
            if (count < BatchSize)
                break;
        }
        return true;
    }

    void deliver(const CanFrame &frame) noexcept
    {
        if (frame.has(CanFrame::Error) || frame.has(CanFrame::Remote) || frame.has(CanFrame::Extended))
            return;
        const qint64 time = timeOf(frame);
        if (frame.id == CanOpenIds::Sync) {
            m_pdos.noteSync();
            return;
        }
        if (m_monitor.take(frame, m_plan.node, time))
            return;
        if (const auto *pdo = m_pdos.take(frame, time))
            m_axis.take(*pdo, frame, time);
    }

    /// The frames of this cycle: values, heartbeat, and SYNC as the last one. \return their number
    int collect() noexcept
    {
        m_axis.step(now());
        int count = m_plan.node > 0 ? m_pdos.collect(m_axis.outputs(), m_outgoing.data()) : 0;
        if (m_plan.node > 0 && m_plan.master > 0 && now() >= m_nextHeartbeat) {
            const qint64 period = std::chrono::nanoseconds(m_plan.heartbeat).count();
            const qint64 next = m_nextHeartbeat + period;
            m_nextHeartbeat = next > now() ? next : now() + period;
            CanFrame &frame = m_outgoing[std::size_t(count++)];
            frame = CanFrame();
            frame.id = CanOpenIds::Heartbeat + quint32(m_plan.master);
            frame.size = 1;
            frame.data[0] = quint8(NmtState::Operational);
        }
        if (m_plan.sync == SyncSource::EveryCycle) {
            m_pdos.noteSync();
            m_outgoing[std::size_t(count++)] = syncFrame();
        }
        return count;
    }

    qint64 timeOf(const CanFrame &frame) const noexcept { return frame.time != 0 ? frame.time : now(); }

    static CanFrame syncFrame() noexcept
    {
        CanFrame frame;
        frame.id = CanOpenIds::Sync;
        return frame;
    }

    bool checkNode() noexcept
    {
        if (m_plan.node == 0)
            return true;
        switch (m_monitor.look(now(), std::chrono::nanoseconds(2 * m_plan.heartbeat).count())) {
        case CanOpenMonitor::Fine:
            return true;
        case CanOpenMonitor::Silent:
            ++m_heartbeatLost;
            return fail(m_lossText.constData(), ETIMEDOUT);
        case CanOpenMonitor::Restarted:
            return fail(m_stateText.constData(), ECONNRESET);
        case CanOpenMonitor::NotOperational:
            break;
        }
        return fail(m_stateText.constData(), ECONNABORTED);
    }

    bool checkBusOff() noexcept
    {
        if (m_bus->state() != CanBus::BusOff) {
            m_busOffSince = -1;
            return true;
        }
        if (m_busOffSince < 0)
            m_busOffSince = now();
        return now() - m_busOffSince < restartTime || fail(m_receiveText.constData(), ENETDOWN);
    }

    quint64 state() const { return quint64(m_monitor.state()); }
    quint64 emergency() const { return m_monitor.emergency(); }
    quint64 errorRegister() const { return m_monitor.errorRegister(); }
    quint64 emergencies() const { return m_monitor.emergencies(); }
    quint64 heartbeatLost() const { return m_heartbeatLost; }
    quint64 missed() const { return m_pdos.missed(); }
    quint64 saturated() const { return m_pdos.saturated(); }
    quint64 busState() const { return m_bus->state(); }
    quint64 received() const { return m_bus->counters().received; }
    quint64 sent() const { return m_bus->counters().sent; }
    quint64 unsent() const { return m_bus->counters().unsent; }

    static constexpr int BatchSize = 64;
    static constexpr int MostBatches = 64;  // of one cycle, so that it ends

    CanOpenConfiguration m_plan;
    std::unique_ptr<CanBus> m_bus;
    CanOpenMonitor m_monitor;
    CanOpenPdos m_pdos;
    CanOpenAxisChannels m_axis;
    std::vector<OwnChannel> m_ownChannels;
    QByteArray m_receiveText;  // for errors
    QByteArray m_sendText;
    QByteArray m_lossText;
    QByteArray m_stateText;
    std::array<CanFrame, BatchSize> m_incoming;
    std::array<CanFrame, 2 * Pdo::MaximumNumber + 3> m_outgoing;
    qint64 m_busOffSince = -1;   // [ns]; -1: it is not
    qint64 m_nextHeartbeat = 0;  // of the master [ns]
    quint64 m_heartbeatLost = 0;
};

}  // namespace

std::unique_ptr<QPlcDriver> createCanOpenDriver()
{
    return std::make_unique<CanOpenDriver>();
}

}  // namespace qplc
