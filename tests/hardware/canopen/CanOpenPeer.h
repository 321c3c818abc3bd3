// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/can/FakeCanBus.h"
#include "realtime/TimeSource.h"

#include <QtCore/QByteArray>

#include <atomic>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <poll.h>

/// The other end of a CANopen bus, written from the tables of CiA 301 and CiA 402 and without any
/// code of the master: devices with an object dictionary, an SDO server, heartbeats, emergencies,
/// PDOs whose mapping can be changed in the order of the standard only, and a drive.
namespace peer {

/// An object, its value as it travels, least significant byte first.
struct Object
{
    QByteArray value;
    bool isReadable = true;
    bool isWritable = true;
    bool isMappable = true;
    bool isSigned = false;
    bool hasAnySize = false;  // a text or a domain
    std::optional<qint64> lowest;
    std::optional<qint64> highest;
    quint32 abortOfRead = 0;   // what it answers instead of its value
    quint32 abortOfWrite = 0;  // likewise
};

inline quint32 keyOf(int index, int sub)
{
    return quint32(index) << 8 | quint32(sub);
}
inline QByteArray bytesOf(qint64 number, int size)
{
    QByteArray bytes;
    for (int i = 0; i < size; ++i)
        bytes.append(char(quint8(quint64(number) >> (8 * i))));
    return bytes;
}
inline qint64 numberOf(const QByteArray &bytes, bool isSigned = false)
{
    quint64 number = 0;
    for (int i = 0; i < bytes.size() && i < 8; ++i)
        number |= quint64(quint8(bytes.at(i))) << (8 * i);
    const int unused = 64 - 8 * bytes.size();
    return isSigned && unused > 0 && unused < 64 ? qint64(number << unused) >> unused : qint64(number);
}

using Dictionary = std::map<quint32, Object>;

/// SDO server: CiA 301, expedited and in segments.
class SdoServer
{
public:
    using Data = std::array<quint8, 8>;

    /// What the device says to a write; 0: it is allowed, and the value is stored.
    using Check = std::function<quint32(quint32 key, const QByteArray &value)>;

    SdoServer(Dictionary *objects, Check check)
        : m_objects(objects)
        , m_check(std::move(check))
    {
    }

    /// Nothing: no answer.
    std::optional<Data> answer(const Data &request)
    {
        switch (request[0] >> 5) {
        case 0:
            return takeSegment(request);
        case 1:
            return beginDownload(request);
        case 2:
            return beginUpload(request);
        case 3:
            return giveSegment(request);
        case 4:
            m_kind = Nothing;
            return std::nullopt;
        default:
            m_key = addressOf(request);
            return abort(0x05040001);
        }
    }
    int segments() const { return m_segments; }

private:
    enum Kind { Nothing, Upload, Download };

    static quint32 addressOf(const Data &data) { return keyOf(data[1] | data[2] << 8, data[3]); }
    Data frame(quint8 command, quint32 rest = 0) const
    {
        return {command,      quint8(m_key >> 8), quint8(m_key >> 16), quint8(m_key),
                quint8(rest), quint8(rest >> 8),  quint8(rest >> 16),  quint8(rest >> 24)};
    }
    Data abort(quint32 code)
    {
        m_kind = Nothing;
        return frame(0x80, code);
    }
    quint32 findError() const
    {
        if (m_objects->count(m_key))
            return 0;
        for (const auto &[key, object] : *m_objects) {
            if (key >> 8 == m_key >> 8)
                return 0x06090011;
        }
        return 0x06020000;
    }
    Data beginUpload(const Data &request)
    {
        m_key = addressOf(request);
        if (const quint32 error = findError())
            return abort(error);
        const Object &object = m_objects->at(m_key);
        if (object.abortOfRead)
            return abort(object.abortOfRead);
        if (!object.isReadable)
            return abort(0x06010001);
        const int size = object.value.size();
        if (size >= 1 && size <= 4)
            return frame(quint8(0x43 | (4 - size) << 2), quint32(numberOf(object.value)));
        begin(Upload, object.value);
        return frame(0x41, quint32(size));
    }
    Data beginDownload(const Data &request)
    {
        m_key = addressOf(request);
        if (const quint32 error = findError())
            return abort(error);
        const Object &object = m_objects->at(m_key);
        if (!object.isWritable)
            return abort(0x06010002);
        if (!(request[0] & 2)) {
            begin(Download, {});
            m_promised = (request[0] & 1) ? int(numberOf(restOf(request, 4))) : -1;
            return frame(0x60);
        }
        const int size = (request[0] & 1) ? 4 - ((request[0] >> 2) & 3) : std::min(4, object.value.size());
        return store(restOf(request, size)) ? frame(0x60) : abort(m_error);
    }
    static QByteArray restOf(const Data &data, int size)
    {
        return QByteArray(reinterpret_cast<const char *>(data.data()) + 4, size);
    }
    void begin(Kind kind, const QByteArray &value)
    {
        m_kind = kind;
        m_value = value;
        m_position = 0;
        m_toggle = 0;
        m_segments = 0;
    }
    Data takeSegment(const Data &request)
    {
        if (m_kind != Download)
            return abort(0x05040001);
        if ((request[0] & 0x10) != m_toggle)
            return abort(0x05030000);
        ++m_segments;
        m_value.append(reinterpret_cast<const char *>(request.data()) + 1, 7 - ((request[0] >> 1) & 7));
        Data answer{};
        answer[0] = quint8(0x20 | m_toggle);
        m_toggle ^= 0x10;
        if (request[0] & 1) {
            if (m_promised >= 0 && m_value.size() != m_promised)
                return abort(0x06070010);
            if (!store(m_value))
                return abort(m_error);
            m_kind = Nothing;
        }
        return answer;
    }
    Data giveSegment(const Data &request)
    {
        if (m_kind != Upload)
            return abort(0x05040001);
        if ((request[0] & 0x10) != m_toggle)
            return abort(0x05030000);
        ++m_segments;
        const QByteArray part = m_value.mid(m_position, 7);
        m_position += part.size();
        const bool isEnd = m_position >= m_value.size();
        Data answer{};
        answer[0] = quint8(m_toggle | (7 - part.size()) << 1 | (isEnd ? 1 : 0));
        std::copy(part.begin(), part.end(), answer.begin() + 1);
        m_toggle ^= 0x10;
        if (isEnd)
            m_kind = Nothing;
        return answer;
    }
    bool store(const QByteArray &value)
    {
        Object &object = m_objects->at(m_key);
        const qint64 number = numberOf(value, object.isSigned);
        m_error = object.abortOfWrite;
        if (!m_error && !object.hasAnySize && value.size() > object.value.size())
            m_error = 0x06070012;
        if (!m_error && !object.hasAnySize && value.size() < object.value.size())
            m_error = 0x06070013;
        if (!m_error && object.highest && number > *object.highest)
            m_error = 0x06090031;
        if (!m_error && object.lowest && number < *object.lowest)
            m_error = 0x06090032;
        if (!m_error && m_check)
            m_error = m_check(m_key, value);
        if (!m_error)
            object.value = value;
        return m_error == 0;
    }

    Dictionary *m_objects;
    Check m_check;
    Kind m_kind = Nothing;
    quint32 m_key = 0;
    quint32 m_error = 0;
    QByteArray m_value;
    int m_position = 0;
    int m_promised = -1;
    int m_segments = 0;
    quint8 m_toggle = 0;
};

/// The power drive system of CiA 402: its states, and a machine that follows its speed at once.
class Drive
{
public:
    enum State { SwitchOnDisabled, Ready, SwitchedOn, Enabled, QuickStop, FaultReaction, Fault };

    /// \param time  since the last step [s]
    void step(quint16 word, qint8 mode, qint32 targetVelocity, double time)
    {
        if ((word & 0x80) && !(m_word & 0x80) && state == Fault)
            state = SwitchOnDisabled;
        m_word = word;
        if (!isStubborn)
            command(word);
        modeDisplay = mode;
        const bool isBraking = state == QuickStop || state == FaultReaction;
        if (state == Enabled && mode == 9)
            velocity = targetVelocity;
        else if (isBraking)
            velocity -= std::copysign(std::min(std::abs(velocity), quickStopDeceleration * time), velocity);
        else
            velocity = 0.0;
        if (isBraking && velocity == 0.0)
            state = state == FaultReaction ? Fault : quickStopOption <= 4 ? SwitchOnDisabled : QuickStop;
        position += velocity * time;
    }
    void fail() { state = FaultReaction; }
    void stopQuickly()
    {
        if (isStubborn)
            return;
        if (state == Enabled)
            state = QuickStop;
        else if (state == Ready || state == SwitchedOn)
            state = SwitchOnDisabled;
    }
    quint16 statusword() const
    {
        switch (state) {
        case SwitchOnDisabled:
            return 0x0240;
        case Ready:
            return 0x0231;
        case SwitchedOn:
            return 0x0233;
        case Enabled:
            return quint16(0x0237 | (isHomed ? 0x1400 : 0));
        case QuickStop:
            return 0x0217;
        case FaultReaction:
            return 0x021F;
        case Fault:
            return 0x0218;
        }
        return 0;
    }

    State state = SwitchOnDisabled;
    double velocity = 0.0;
    double position = 0.0;
    double quickStopDeceleration = 1000.0;  // [1/s]
    int quickStopOption = 2;
    qint8 modeDisplay = 0;
    bool isHomed = false;
    bool isStubborn = false;  // it does not do what it is told

private:
    // The table of commands; a command that the state does not know changes nothing.
    void command(quint16 word)
    {
        const bool isPowered = state == Ready || state == SwitchedOn || state == Enabled || state == QuickStop;
        if (state == FaultReaction || state == Fault)
            return;
        if (!(word & 0x02)) {
            if (isPowered)
                state = SwitchOnDisabled;
        } else if (!(word & 0x04)) {
            stopQuickly();
        } else if ((word & 0x01) == 0) {
            if (state == SwitchOnDisabled || state == SwitchedOn || state == Enabled)
                state = Ready;
        } else if (!(word & 0x08)) {
            if (state == Ready || state == Enabled)
                state = SwitchedOn;
        } else if (state == SwitchedOn || (state == QuickStop && quickStopOption > 4)) {
            state = Enabled;
        }
    }

    quint16 m_word = 0;
};

/// A device of the bus.
class Device
{
public:
    enum Nmt : quint8 { Stopped = 4, Operational = 5, PreOperational = 127 };

    explicit Device(int id)
        : node(id)
        , m_sdo(&objects, [this](quint32 key, const QByteArray &value) { return checkWrite(key, value); })
    {
        add(0x1000, 0, 0x00020192, 4, false);
        add(0x1001, 0, 0, 1, false);
        add(0x1016, 1, 0, 4);
        add(0x1017, 0, 0, 2);
        for (int sub = 1; sub <= 4; ++sub)
            add(0x1018, sub, 0x11110000 * sub + id, 4, false);
        for (int number = 0; number < 4; ++number) {
            add(0x1400 + number, 1, 0x80000000LL + 0x200 + 0x100 * number + id, 4);
            add(0x1400 + number, 2, 255, 1);
            add(0x1800 + number, 1, 0xC0000000LL + 0x180 + 0x100 * number + id, 4);
            add(0x1800 + number, 2, 255, 1);
            add(0x1800 + number, 5, 0, 2);
            for (const int mapping : {0x1600, 0x1A00}) {
                add(mapping + number, 0, 0, 1);
                for (int sub = 1; sub <= 8; ++sub)
                    add(mapping + number, sub, 0, 4);
            }
        }
    }
    Device(const Device &) = delete;
    Device &operator=(const Device &) = delete;

    Object &add(int index, int sub, qint64 value, int size, bool isWritable = true)
    {
        Object object;
        object.value = bytesOf(value, size);
        object.isWritable = isWritable;
        return objects[keyOf(index, sub)] = object;
    }
    qint64 value(int index, int sub = 0, bool isSigned = false) const
    {
        return numberOf(objects.at(keyOf(index, sub)).value, isSigned);
    }
    void set(int index, int sub, qint64 value)
    {
        QByteArray &bytes = objects[keyOf(index, sub)].value;
        bytes = bytesOf(value, bytes.size());
    }
    /// Gives it the objects of a drive.
    void makeDrive()
    {
        drive.emplace();
        add(0x6040, 0, 0, 2);
        add(0x6041, 0, 0, 2, false);
        add(0x605A, 0, 2, 2);
        add(0x6060, 0, 0, 1);
        add(0x6061, 0, 0, 1, false);
        add(0x6064, 0, 0, 4, false);
        add(0x606C, 0, 0, 4, false);
        add(0x6071, 0, 0, 2);
        add(0x6077, 0, 0, 2, false);
        add(0x607A, 0, 0, 4);
        add(0x6085, 0, 1000, 4);
        add(0x60FF, 0, 0, 4);
    }

    const int node;
    Dictionary objects;
    std::optional<Drive> drive;
    Nmt nmt = PreOperational;
    bool isAlive = true;         // else it says and hears nothing
    bool isSilentToSdo = false;  // as a device that hangs
    bool ignoresStart = false;
    quint64 syncs = 0;
    quint64 missedPdos = 0;    // synchronous RPDOs that did not come between two SYNCs
    quint64 takenPdos = 0;     // RPDOs
    quint64 masterLosses = 0;  // times that its consumer of the heartbeat has run out

    using Frames = std::vector<qplc::CanFrame>;

    /// It was switched on.
    void boot(Frames *out)
    {
        nmt = PreOperational;
        m_nextHeartbeat = 0;
        m_masterHeard = -1;
        out->push_back(frame(0x700 + node, QByteArray(1, '\0')));
    }
    /// Whether it reacts when the heartbeat of the master is missing, from its next one on.
    void watchMaster(bool isWatching)
    {
        m_watchesMaster = isWatching;
        m_masterHeard = -1;
    }
    void tellEmergency(quint16 code, quint8 errorRegister, Frames *out)
    {
        out->push_back(frame(0x80 + node, bytesOf(code, 2) + bytesOf(errorRegister, 1) + QByteArray(5, '\0')));
    }
    void take(const qplc::CanFrame &in, qint64 now, Frames *out)
    {
        if (!isAlive || in.flags != 0)
            return;
        if (in.id == 0x000)
            takeCommand(in, out);
        else if (in.id == 0x080)
            takeSync(now, out);
        else if (in.id == quint32(0x600 + node) && in.size == 8 && !isSilentToSdo && nmt != Stopped)
            takeSdo(in, out);
        else if (in.id == 0x700 + quint32(value(0x1016, 1) >> 16) && value(0x1016, 1) != 0)
            m_masterHeard = now;
        else
            takePdo(in, now);
    }
    void tick(qint64 now, Frames *out)
    {
        if (!isAlive)
            return;
        const qint64 period = value(0x1017) * 1'000'000;
        if (period > 0 && now >= m_nextHeartbeat) {
            m_nextHeartbeat = m_nextHeartbeat + period > now ? m_nextHeartbeat + period : now + period;
            out->push_back(frame(0x700 + node, QByteArray(1, char(nmt))));
        }
        const qint64 longest = (value(0x1016, 1) & 0xFFFF) * 1'000'000;
        if (m_watchesMaster && m_masterHeard >= 0 && longest > 0 && now - m_masterHeard > longest) {
            m_masterHeard = -1;
            ++masterLosses;
            nmt = PreOperational;
            tellEmergency(0x8130, 0x11, out);
            if (drive)
                drive->stopQuickly();
        }
        if (drive && (nmt != Operational || drive->state >= Drive::QuickStop))
            moveDrive(now);
        for (int number = 0; number < 4 && nmt == Operational; ++number) {
            const qint64 event = value(0x1800 + number, 5) * 1'000'000;
            if (value(0x1800 + number, 2) >= 254 && event > 0 && now >= m_nextEvent[number]) {
                m_nextEvent[number] = now + event;
                sendPdo(number, out);
            }
        }
    }

private:
    static qplc::CanFrame frame(int id, const QByteArray &data)
    {
        qplc::CanFrame frame;
        frame.id = quint32(id);
        frame.size = quint8(data.size());
        std::copy(data.begin(), data.end(), frame.data.begin());
        return frame;
    }
    void takeCommand(const qplc::CanFrame &in, Frames *out)
    {
        if (in.size != 2 || (in.data[1] != 0 && in.data[1] != node))
            return;
        switch (in.data[0]) {
        case 1:
            if (!ignoresStart)
                nmt = Operational;
            m_hasCome.fill(true);
            break;
        case 2:
            nmt = Stopped;
            break;
        case 128:
            nmt = PreOperational;
            if (drive)
                drive->stopQuickly();
            break;
        default:
            boot(out);
        }
        m_nextHeartbeat = m_nextHeartbeat == 0 ? 0 : 1;  // tell the new state soon
    }
    void takeSdo(const qplc::CanFrame &in, Frames *out)
    {
        SdoServer::Data request;
        std::copy_n(in.data.begin(), 8, request.begin());
        if (const auto answer = m_sdo.answer(request))
            out->push_back(frame(0x580 + node, QByteArray(reinterpret_cast<const char *>(answer->data()), 8)));
    }
    void takePdo(const qplc::CanFrame &in, qint64 now)
    {
        for (int number = 0; number < 4 && nmt == Operational; ++number) {
            if (quint64(value(0x1400 + number, 1)) != in.id)
                continue;
            ++takenPdos;
            m_hasCome[std::size_t(number)] = true;
            m_waiting[std::size_t(number)] = in;
            if (value(0x1400 + number, 2) > 240)
                apply(number, now);
        }
    }
    void takeSync(qint64 now, Frames *out)
    {
        if (nmt != Operational)
            return;
        ++syncs;
        for (int number = 0; number < 4; ++number) {
            const bool isSynchronous = !(value(0x1400 + number, 1) & 0x80000000) && value(0x1400 + number, 2) <= 240;
            if (isSynchronous && m_hasCome[std::size_t(number)] && m_waiting[std::size_t(number)].size > 0)
                apply(number, now);
            else if (isSynchronous && m_isRunning[std::size_t(number)])
                ++missedPdos;
            m_isRunning[std::size_t(number)] = isSynchronous && m_waiting[std::size_t(number)].size > 0;
            m_hasCome[std::size_t(number)] = false;
        }
        if (drive)
            moveDrive(now);
        for (int number = 0; number < 4; ++number) {
            if (value(0x1800 + number, 2) <= 240)
                sendPdo(number, out);
        }
    }
    void apply(int number, qint64 now)
    {
        quint64 bits = quint64(
            numberOf(QByteArray(reinterpret_cast<const char *>(m_waiting[std::size_t(number)].data.data()), 8)));
        for (int sub = 1; sub <= value(0x1600 + number, 0); ++sub) {
            const qint64 mapping = value(0x1600 + number, sub);
            const int size = int(mapping & 0xFF);
            const auto found = objects.find(quint32(mapping >> 8));
            if (found != objects.end())
                found->second.value = bytesOf(qint64(bits), size / 8);
            bits = size < 64 ? bits >> size : 0;
        }
        if (drive)
            moveDrive(now);
    }
    void sendPdo(int number, Frames *out)
    {
        const qint64 id = value(0x1800 + number, 1);
        if (id & 0x80000000)
            return;
        QByteArray data;
        for (int sub = 1; sub <= value(0x1A00 + number, 0); ++sub)
            data += objects[quint32(value(0x1A00 + number, sub) >> 8)].value;
        out->push_back(frame(int(id & 0x7FF), data));
    }
    void moveDrive(qint64 now)
    {
        const double time = m_moved < 0 ? 0.0 : double(now - m_moved) * 1e-9;
        m_moved = now;
        drive->quickStopDeceleration = double(value(0x6085));
        drive->quickStopOption = int(value(0x605A, 0, true));
        // Without process data only what it does by itself goes on.
        const quint16 word = nmt == Operational ? quint16(value(0x6040)) : quint16(0x0002);
        drive->step(word, qint8(value(0x6060, 0, true)), qint32(value(0x60FF, 0, true)), time);
        set(0x6041, 0, drive->statusword());
        set(0x6061, 0, drive->modeDisplay);
        set(0x606C, 0, qint64(drive->velocity));
        set(0x6064, 0, qint64(drive->position));
    }
    // CiA 301: a PDO is off while its mapping is changed, and has no entries while they are
    // written.
    quint32 checkWrite(quint32 key, const QByteArray &bytes)
    {
        const int index = int(key >> 8);
        const int sub = int(key & 0xFF);
        const bool isMapping = (index >= 0x1600 && index < 0x1604) || (index >= 0x1A00 && index < 0x1A04);
        if (!isMapping)
            return 0;
        const int communication = index - 0x200;
        if (nmt == Operational || !(value(communication, 1) & 0x80000000))
            return 0x08000022;
        if (sub > 0)
            return checkEntry(index, quint32(numberOf(bytes)));
        int bits = 0;
        for (int i = 1; i <= numberOf(bytes); ++i)
            bits += int(value(index, i) & 0xFF);
        return bits > 64 ? 0x06040042 : 0;
    }
    quint32 checkEntry(int index, quint32 mapping)
    {
        if (value(index, 0) != 0)
            return 0x06010000;
        const auto object = objects.find(mapping >> 8);
        if (object == objects.end())
            return 0x06020000;
        const bool isReceived = index < 0x1A00;
        const bool isMappable = object->second.isMappable && (!isReceived || object->second.isWritable);
        return !isMappable || object->second.value.size() * 8 != int(mapping & 0xFF) ? 0x06040041 : 0;
    }

    SdoServer m_sdo;
    qint64 m_nextHeartbeat = 0;
    qint64 m_masterHeard = -1;  // -1: not yet
    bool m_watchesMaster = true;
    qint64 m_moved = -1;
    std::array<qint64, 4> m_nextEvent{};
    std::array<qplc::CanFrame, 4> m_waiting{};
    std::array<bool, 4> m_hasCome{};
    std::array<bool, 4> m_isRunning{};
};

/// The devices at a bus. run() lives in a thread of its own, until stop(); process() does one round
/// in the thread of the caller.
class Bus
{
public:
    explicit Bus(const QString &name, qplc::TimeSource &time = qplc::TimeSource::monotonic())
        : m_time(time)
        , m_bus(name, time)
    {
    }
    ~Bus() { stop(); }
    Bus(const Bus &) = delete;
    Bus &operator=(const Bus &) = delete;

    Device &addDevice(int node)
    {
        devices.push_back(std::make_unique<Device>(node));
        return *devices.back();
    }
    bool open()
    {
        qplc::CanBus::Options options;
        options.receivesAll = true;
        return m_bus.open(options);
    }
    void process()
    {
        const std::lock_guard lock(mutex);
        m_out.clear();
        qplc::CanFrame frame;
        const qint64 now = m_time.now();
        while (m_bus.receive(&frame, 1) == 1) {
            for (const auto &device : devices)
                device->take(frame, now, &m_out);
        }
        for (const auto &device : devices)
            device->tick(now, &m_out);
        if (!m_out.empty())
            m_bus.send(m_out.data(), int(m_out.size()));
    }
    void tellEmergency(Device &device, quint16 code, quint8 errorRegister)
    {
        const std::lock_guard lock(mutex);
        Device::Frames out;
        device.tellEmergency(code, errorRegister, &out);
        m_bus.send(out.data(), int(out.size()));
    }
    /// A frame of some device.
    void send(quint32 id, const QByteArray &data)
    {
        const std::lock_guard lock(mutex);
        qplc::CanFrame frame;
        frame.id = id;
        frame.size = quint8(data.size());
        std::copy(data.begin(), data.end(), frame.data.begin());
        m_bus.send(&frame, 1);
    }
    void boot(Device &device)
    {
        const std::lock_guard lock(mutex);
        Device::Frames out;
        device.boot(&out);
        m_bus.send(out.data(), int(out.size()));
    }
    void start()
    {
        m_isRunning = true;
        m_thread = std::thread([this] {
            while (m_isRunning) {
                process();
                pollfd descriptor{m_bus.descriptor(), POLLIN, 0};
                ::poll(&descriptor, 1, 1);
            }
        });
    }
    void stop()
    {
        m_isRunning = false;
        if (m_thread.joinable())
            m_thread.join();
    }

    std::vector<std::unique_ptr<Device>> devices;
    std::mutex mutex;  // of the devices, while the thread runs

private:
    qplc::TimeSource &m_time;
    qplc::FakeCanBus m_bus;
    Device::Frames m_out;
    std::atomic<bool> m_isRunning{false};
    std::thread m_thread;
};

}  // namespace peer
