// SPDX-License-Identifier: Apache-2.0
#include "CanOpenDevice.h"
#include "QPlcDriverSettings.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"
#include "hardware/Drivers.h"
#include "hardware/can/CanBusDriver.h"

#include <algorithm>
#include <memory>

namespace qplc {

namespace {

/// Plays a device on a CANopen bus, for a master at the other end; kind `canopen-device`, at its
/// own pace.
///
/// ```ini
/// [bus]
/// driver = canopen-device
/// device = fake:winch        ; as of driver can
/// node = 5
/// eds = winch_drive.eds      ; the objects that it has, and their values at first
/// interval = 1 ms
/// ```
///
/// Read channels: objects that the master writes (address or name), which have values while the
/// device is Operational; @state (NMT), @masterLost. Write channels: all objects, but those of
/// communication (1000h ... 1FFFh). The master maps the PDOs.
class CanOpenDeviceDriver final : public CanBusDriver
{
public:
    CanOpenDeviceDriver()
        : CanBusDriver(OwnPace)
    {
    }

protected:
    void configure(QPlcDriverSettings &settings) override
    {
        const QString device = settings.requiredText(QStringLiteral("device"), QStringLiteral("can0"));
        m_bitRate = CanOpenConfiguration::readBitRate(device, settings);
        const int node = int(settings.integer(QStringLiteral("node"), 1, 1, CanOpenIds::MaximumNode));
        m_node = std::make_unique<CanOpenDevice>(node);
        makeBus(device, settings);
        settings.requiredText(QStringLiteral("eds"), QStringLiteral("drive.eds"));
        const QString fileName = settings.fileName(QStringLiteral("eds"));
        QVector<QPlcParseError> errors;
        if (!fileName.isEmpty())
            m_file = EdsFile::fromFile(fileName, node, &errors);
        settings.addErrors(errors);
        addObjects();
    }

    QPlcChannel *channel(const QString &name, QPlcChannel::Direction direction, QString *) override
    {
        const bool isRead = direction == QPlcChannel::Read;
        if (isRead && (name == QLatin1String(stateName) || name == QLatin1String(lostName))) {
            auto &own = name == QLatin1String(stateName) ? m_state : m_masterLost;
            if (!own)
                own = std::make_unique<QPlcReadChannel>(this, name);
            return own.get();
        }
        const CanOpenObject *object = m_file.dictionary().find(name);
        if (!object || !object->number || isCommunication(*object))
            return nullptr;
        if (isRead)
            return addChannel(*object, name, &m_inputs);
        return addChannel(*object, name, &m_outputs);
    }

    QStringList channelNames(QPlcChannel::Direction direction) const override
    {
        QStringList names;
        for (const CanOpenObject &object : m_file.dictionary().objects()) {
            if (object.number && !isCommunication(object))
                names << (object.name.isEmpty() ? object.address.toText() : object.name);
        }
        if (direction == QPlcChannel::Read)
            names << QLatin1String(stateName) << QLatin1String(lostName);
        return names;
    }

    bool open() override
    {
        CanBus::Options options;
        options.receivesAll = true;  // the master chooses the ids of PDOs
        options.bitRate = m_bitRate;
        if (!openBus(options))
            return false;
        m_out.clear();
        m_node->boot(&m_out);
        return true;
    }

    void close() override { bus().close(); }

    bool write() override
    {
        for (const auto &output : m_outputs) {
            if (!output.channel->hasValue())
                continue;
            const quint64 bits = output.number.encode(output.channel->value());
            m_node->objects().set(output.address, littleEndian(bits, (output.number.bits + 7) / 8));
        }
        return true;
    }

    bool read() override
    {
        if (!receive([this](const CanFrame &frame) { m_node->take(frame, now(), &m_out); }))
            return false;
        m_node->tick(now(), &m_out);
        const bool isThere = send(m_out.data(), int(m_out.size()));
        m_out.clear();
        if (!isThere)
            return false;
        show();
        return true;
    }

private:
    template<typename Channel>
    struct Part
    {
        ObjectAddress address;
        RawNumber number;
        std::unique_ptr<Channel> channel;
    };

    static bool isCommunication(const CanOpenObject &object) { return object.address.index < 0x2000; }

    template<typename Channel>
    Channel *addChannel(const CanOpenObject &object, const QString &name, std::vector<Part<Channel>> *parts)
    {
        for (const Part<Channel> &part : *parts) {
            if (part.address == object.address)
                return part.channel.get();
        }
        parts->push_back({object.address, *object.number, std::make_unique<Channel>(this, name)});
        return parts->back().channel.get();
    }

    // Those of PDOs and heartbeats are the device's own.
    void addObjects()
    {
        for (const CanOpenObject &object : m_file.dictionary().objects()) {
            if (!object.number || m_node->objects().find(object.address))
                continue;
            const QByteArray value = littleEndian(object.value.value_or(0), (object.number->bits + 7) / 8);
            m_node->objects().add(object.address, value,
                                  object.isWritable ? CanOpenObjects::ReadWrite : CanOpenObjects::ReadOnly);
        }
    }

    void show()
    {
        const bool isRunning = m_node->state() == NmtState::Operational;
        for (const auto &input : m_inputs) {
            if (isRunning)
                input.channel->set(input.number.decode(m_node->objects().number(input.address)));
            else
                input.channel->invalidate();
        }
        if (m_state)
            m_state->set(double(quint8(m_node->state())));
        if (m_masterLost)
            m_masterLost->set(m_node->isMasterLost() ? 1.0 : 0.0);
    }

    static constexpr const char *stateName = "@state";
    static constexpr const char *lostName = "@masterLost";

    int m_bitRate = 0;
    std::unique_ptr<CanOpenDevice> m_node;
    EdsFile m_file;
    CanOpenDevice::Frames m_out;
    std::vector<Part<QPlcReadChannel>> m_inputs;
    std::vector<Part<QPlcWriteChannel>> m_outputs;
    std::unique_ptr<QPlcReadChannel> m_state;
    std::unique_ptr<QPlcReadChannel> m_masterLost;
};

}  // namespace

std::unique_ptr<QPlcDriver> createCanOpenDeviceDriver()
{
    return std::make_unique<CanOpenDeviceDriver>();
}

}  // namespace qplc
