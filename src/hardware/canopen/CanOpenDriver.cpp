// SPDX-License-Identifier: Apache-2.0
#include "CanOpenAxisChannels.h"
#include "CanOpenClient.h"
#include "CanOpenMonitor.h"
#include "CanOpenPdos.h"
#include "QPlcDeviceEvent.h"
#include "QPlcDriverSettings.h"
#include "hardware/Drivers.h"
#include "hardware/can/CanBusDriver.h"

#include <algorithm>
#include <array>
#include <cerrno>

namespace qplc {

namespace {

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
class CanOpenDriver final : public CanBusDriver
{
public:
    CanOpenDriver()
        : CanBusDriver(EveryCycle)
        , m_pdos(this)
        , m_axis(this)
    {
        addOwn("@state", [this] { return quint64(m_monitor.state()); });
        addOwn("@emergency", [this] { return quint64(m_monitor.emergency().code); });
        addOwn("@emergencyBytes", [this] { return m_monitor.emergency().manufacturerBits(); });
        addOwn("@errorRegister", [this] { return quint64(m_monitor.emergency().errorRegister); });
        addOwn("@emergencies", [this] { return m_monitor.emergencies(); });
        addOwn("@heartbeatLost", [this] { return m_heartbeatLost; });
        addOwn("@missed", [this] { return m_pdos.missed(); });
        addOwn("@saturated", [this] { return m_pdos.saturated(); });
        addOwn("@busState", [this] { return quint64(bus().state()); });
        addOwn("@received", [this] { return bus().counters().received; });
        addOwn("@sent", [this] { return bus().counters().sent; });
        addOwn("@unsent", [this] { return bus().counters().unsent; });
    }

protected:
    void configure(QPlcDriverSettings &settings) override
    {
        m_plan.timeout = timeout();
        m_plan.read(settings);
        makeBus(m_plan.device, settings);
        if (m_plan.node == 0 || m_plan.sync == SyncSource::EveryCycle)
            setServesOthers();  // they wait for its SYNC
        m_pdos.setPlan(m_plan);
        m_axis.setPlan(m_plan);
        const QByteArray title = QStringLiteral("node %1 at %2").arg(m_plan.node).arg(m_plan.device).toLocal8Bit();
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
        return m_axis.names(isRead) + m_pdos.names(isRead) + (isRead ? ownNames() : QStringList());
    }

    bool open() override
    {
        if (!openBus(busOptions()))
            return false;
        if (m_plan.node > 0 && !startNode()) {
            bus().close();
            return false;
        }
        setDelivered(false);
        m_nextHeartbeat = 0;
        m_sentCount = 0;
        m_syncAt = m_heardAt = 0;
        m_pdos.begin();
        m_axis.begin();
        return true;
    }

    void close() override
    {
        if (m_plan.node > 0)
            stopNode();
        bus().close();
    }

    bool read() override
    {
        if (!takeFrames())
            return false;
        tellEmergency();
        showOwn();
        m_axis.show(now());
        return checkNode() && checkBusOff();
    }

    bool write() override
    {
        if (!takeFrames())  // what came since the last SYNC belongs to it
            return false;
        setDelivered(isAnswered());
        const int count = collect();
        int sent = 0;
        if (!send(m_outgoing.data(), count, &sent))
            return false;
        noteSent(sent == count);
        return true;
    }

    QString undeliveredText() const override
    {
        if (m_plan.node == 0)
            return QStringLiteral("the bus does not take its SYNC; check wires, terminators and bit rate");
        if (m_sentCount == 0)
            return QStringLiteral("it is sent nothing before each object that is written in a PDO has a value, and "
                                  "while the bus takes no frames; give each of them a safe value");
        if (m_pdos.waitsForSync() && m_syncAt < m_sentAt)
            return QStringLiteral("no SYNC came after them, and its PDOs wait for one; start the device or section "
                                  "that sends it");
        if (m_axis.isAxis() && m_axis.state() != AxisState::Unknown)
            return QStringLiteral(
                       "it still tells the state %1, in spite of the quick stop; use the emergency stop, and "
                       "look at its local control and its quick stop option code (605Ah)")
                .arg(Cia402Axis::stateText(m_axis.state()));
        return QStringLiteral("it has told nothing since they were sent; check its TPDOs, its power and the bus");
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
        default:
            return CanBusDriver::remedy(errorNumber);
        }
    }

    QPlcDeviceEvent describeEvent(quint64 data) const override
    {
        const CanOpenEmergency emergency = CanOpenEmergency::fromBits(data);
        const bool remains = !emergency.isError() && emergency.errorRegister != 0;
        QPlcDeviceEvent event;
        event.severity = emergency.isError() ? QPlcSlaveNode::ErrorEvent
            : remains                        ? QPlcSlaveNode::WarningEvent
                                             : QPlcSlaveNode::InfoEvent;
        event.text
            = QStringLiteral("device '%1' (node %2 at %3): %4")
                  .arg(name())
                  .arg(m_plan.node)
                  .arg(m_plan.device,
                       emergency.isError() ? emergency.text()
                           : remains ? QStringLiteral("an error is gone, and others remain: %1").arg(emergency.text())
                                     : QStringLiteral("no error any more"));
        event.alarm = QStringLiteral("emergency of %1").arg(name());
        event.isActive = emergency.isError() || remains;
        return event;
    }

private:
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
        CanOpenClient client(bus(), m_plan.device, m_plan.node, m_plan.answerTime);
        client.setListener([this](const CanFrame &frame) { takeReport(frame); });
        client.setEnd([this] { return isClosing(); });
        if (!client.command(NmtCommand::EnterPreOperational) || !client.configure(m_plan))
            return fail(client.errorString());
        m_monitor.takeError(client.readError());
        tellEmergency();
        if (!client.command(NmtCommand::Start))
            return fail(client.errorString());
        const auto isRunning = [this] { return m_monitor.state() == NmtState::Operational; };
        if (client.waitUntil(isRunning, std::max<std::chrono::nanoseconds>(3 * m_plan.heartbeat, shortestStart)))
            return true;
        return fail(QStringLiteral("node %1 at %2 was configured, and does not become Operational (it is %3); look at "
                                   "its error, and whether another master commands it%4")
                        .arg(m_plan.node)
                        .arg(m_plan.device, nmtStateText(m_monitor.state()), lastEmergency()));
    }

    /// Heartbeats and emergencies. \return whether \a frame was one of the device
    bool takeReport(const CanFrame &frame) noexcept
    {
        const bool isReport = m_monitor.take(frame, m_plan.node, timeOf(frame));
        tellEmergency();
        return isReport;
    }

    // If many of them wait, the newest one is told later.
    void tellEmergency() noexcept
    {
        if (m_monitor.isUntold() && noteEvent(m_monitor.emergency().toBits()))
            m_monitor.setTold();
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
        m_outgoing[std::size_t(count++)] = nmtFrame(NmtCommand::EnterPreOperational, m_plan.node);
        bus().send(m_outgoing.data(), count);
    }

    QString lastEmergency() const
    {
        const quint16 code = m_monitor.lastError();
        return code == 0 ? QString()
                         : QStringLiteral("; its last emergency was %1: %2")
                               .arg(QString::asprintf("%04X", code), emergencyText(code));
    }

    // ---- in the cycle ----

    /// Whether the device has told something since it got the present values: it lives, and as a
    /// drive it does what was commanded.
    bool isAnswered() const noexcept
    {
        if (m_plan.node == 0)
            return m_hasSentAll;
        const bool isTaken = m_sentCount > 0 && (!m_pdos.waitsForSync() || m_syncAt >= m_sentAt);
        return isTaken && (m_axis.isAxis() ? m_axis.hasAnswered(m_sentAt) : m_heardAt > m_sentAt);
    }

    /// The frames of collect() have gone out. \param all  the bus has taken each of them
    void noteSent(bool all) noexcept
    {
        const auto isSame
            = [](const CanFrame &one, const CanFrame &other) { return one.id == other.id && one.data == other.data; };
        const auto end = m_outgoing.begin() + m_pdoCount;
        m_hasSentAll = all;
        if (!all || m_pdoCount != m_sentCount || !std::equal(m_outgoing.begin(), end, m_sent.begin(), isSame)) {
            std::copy(m_outgoing.begin(), end, m_sent.begin());
            m_sentCount = all ? m_pdoCount : 0;
            m_sentAt = now();
        }
        if (all && m_plan.sync == SyncSource::EveryCycle)
            m_syncAt = now();
    }

    bool takeFrames() noexcept
    {
        return receive([this](const CanFrame &frame) { deliver(frame); });
    }

    void deliver(const CanFrame &frame) noexcept
    {
        if (frame.has(CanFrame::Error) || frame.has(CanFrame::Remote) || frame.has(CanFrame::Extended))
            return;
        const qint64 time = timeOf(frame);
        if (frame.id == CanOpenIds::Sync) {
            m_pdos.noteSync();
            m_syncAt = time;
            return;
        }
        if (takeReport(frame)) {
            m_heardAt = time;
        } else if (const auto *pdo = m_pdos.take(frame, time)) {
            m_heardAt = time;
            m_axis.take(*pdo, frame, time);
        }
    }

    /// The frames of this cycle: values, heartbeat, and SYNC as the last one. \return their number
    int collect() noexcept
    {
        m_axis.step(now());
        int count = m_plan.node > 0 ? m_pdos.collect(m_axis.outputs(), m_outgoing.data()) : 0;
        m_pdoCount = count;
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

    CanOpenConfiguration m_plan;
    CanOpenMonitor m_monitor;
    CanOpenPdos m_pdos;
    CanOpenAxisChannels m_axis;
    QByteArray m_lossText;  // for errors
    QByteArray m_stateText;
    std::array<CanFrame, 2 * Pdo::MaximumNumber + 3> m_outgoing;
    int m_pdoCount = 0;                                   // of the device, at its begin
    std::array<CanFrame, 2 * Pdo::MaximumNumber> m_sent;  // PDOs, as the device has them
    int m_sentCount = 0;
    bool m_hasSentAll = false;
    qint64 m_sentAt = 0;         // the first time with these values [ns]
    qint64 m_syncAt = 0;         // the last SYNC [ns]
    qint64 m_heardAt = 0;        // the last frame of the device [ns]
    qint64 m_nextHeartbeat = 0;  // of the master [ns]
    quint64 m_heartbeatLost = 0;
};

}  // namespace

std::unique_ptr<QPlcDriver> createCanOpenDriver()
{
    return std::make_unique<CanOpenDriver>();
}

}  // namespace qplc
