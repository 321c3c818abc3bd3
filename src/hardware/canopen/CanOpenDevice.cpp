// SPDX-License-Identifier: Apache-2.0
#include "CanOpenDevice.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr quint64 firstOnEvent = 254;        // transmission type
constexpr quint64 milliseconds = 1'000'000;  // [ns]
constexpr int entriesOfPdo = 8;

bool isMapping(quint16 index)
{
    return (index >= 0x1600 && index < 0x1600 + CanOpenDevice::Pdos)
        || (index >= 0x1A00 && index < 0x1A00 + CanOpenDevice::Pdos);
}

}  // namespace

CanOpenDevice::CanOpenDevice(int node)
    : m_node(quint32(node))
    , m_sdo(&m_objects, [this](ObjectAddress address, const QByteArray &bytes) { return checkWrite(address, bytes); })
{
    const auto add = [this](int index, int sub, quint64 number, int size) {
        m_objects.add({quint16(index), quint8(sub)}, littleEndian(number, size), CanOpenObjects::ReadWrite);
    };
    m_objects.add({0x1001, 0}, littleEndian(0, 1), CanOpenObjects::ReadOnly);
    add(0x1016, 1, 0, 4);
    add(0x1017, 0, 0, 2);
    for (int number = 0; number < Pdos; ++number) {
        add(0x1400 + number, 1, Pdo::IsOff | CanOpenIds::pdo(number + 1, false, node), 4);
        add(0x1400 + number, 2, Pdo::OnEvent, 1);
        add(0x1800 + number, 1, Pdo::IsOff | CanOpenIds::pdo(number + 1, true, node), 4);
        add(0x1800 + number, 2, Pdo::OnEvent, 1);
        add(0x1800 + number, 5, 0, 2);
        for (const int mapping : {0x1600, 0x1A00}) {
            for (int sub = 0; sub <= entriesOfPdo; ++sub)
                add(mapping + number, sub, 0, sub == 0 ? 1 : 4);
        }
    }
}

CanFrame CanOpenDevice::frameOf(quint32 id, const QByteArray &data) const
{
    CanFrame frame;
    frame.id = id;
    frame.size = quint8(data.size());
    std::copy(data.begin(), data.end(), frame.data.begin());
    return frame;
}

void CanOpenDevice::boot(Frames *out)
{
    m_state = NmtState::PreOperational;
    m_nextHeartbeat = 0;
    m_masterHeard = -1;
    m_isMasterLost = false;
    out->push_back(frameOf(CanOpenIds::Heartbeat + m_node, QByteArray(1, '\0')));
}

void CanOpenDevice::tellEmergency(quint16 code, quint8 errorRegister, Frames *out) const
{
    out->push_back(frameOf(CanOpenIds::Emergency + m_node,
                           littleEndian(code, 2) + littleEndian(errorRegister, 1) + QByteArray(5, '\0')));
}

// ---- what comes in ----

void CanOpenDevice::take(const CanFrame &frame, qint64 now, Frames *out)
{
    const quint64 consumer = value(0x1016, 1);
    if (frame.flags != 0)
        return;
    if (frame.id == CanOpenIds::Nmt)
        takeCommand(frame, out);
    else if (frame.id == CanOpenIds::Sync)
        takeSync(out);
    else if (frame.id == CanOpenIds::SdoRequest + m_node)
        takeSdo(frame, out);
    else if (consumer != 0 && frame.id == CanOpenIds::Heartbeat + quint32(consumer >> 16 & 0x7F)) {
        m_masterHeard = now;
        m_isMasterLost = false;
    } else
        takePdo(frame);
}

void CanOpenDevice::takeCommand(const CanFrame &frame, Frames *out)
{
    if (frame.size != 2 || (frame.data[1] != 0 && frame.data[1] != m_node))
        return;
    switch (NmtCommand(frame.data[0])) {
    case NmtCommand::Start:
        m_state = NmtState::Operational;
        m_hasCome.fill(false);
        m_syncs.fill(0);
        break;
    case NmtCommand::Stop:
        m_state = NmtState::Stopped;
        break;
    case NmtCommand::EnterPreOperational:
        m_state = NmtState::PreOperational;
        break;
    case NmtCommand::ResetNode:
    case NmtCommand::ResetCommunication:
        boot(out);
        break;
    }
    m_nextHeartbeat = 0;  // it tells its state soon
}

void CanOpenDevice::takeSdo(const CanFrame &frame, Frames *out)
{
    if (frame.size != SdoFrame::Size || m_state == NmtState::Stopped)
        return;
    if (const auto answer = m_sdo.answer(SdoFrame::fromFrame(frame)))
        out->push_back(SdoFrame::toFrame(CanOpenIds::SdoResponse + m_node, *answer));
}

void CanOpenDevice::takePdo(const CanFrame &frame)
{
    for (int number = 0; number < Pdos && m_state == NmtState::Operational; ++number) {
        if (!isOn(0x1400 + number) || (value(0x1400 + number, 1) & CanFrame::StandardIds) != frame.id)
            continue;
        m_waiting[std::size_t(number)] = frame;
        m_hasCome[std::size_t(number)] = true;
        if (value(0x1400 + number, 2) > Pdo::LastSynchronous)
            apply(number);
    }
}

void CanOpenDevice::takeSync(Frames *out)
{
    for (int number = 0; number < Pdos && m_state == NmtState::Operational; ++number) {
        if (m_hasCome[std::size_t(number)])
            apply(number);
        const quint64 transmission = value(0x1800 + number, 2);
        int &syncs = m_syncs[std::size_t(number)];
        if (isOn(0x1800 + number) && transmission <= Pdo::LastSynchronous
            && ++syncs >= std::max<int>(1, int(transmission))) {
            syncs = 0;
            sendPdo(number, out);
        }
    }
}

// The values of a PDO become those of its objects.
void CanOpenDevice::apply(int number)
{
    const CanFrame &frame = m_waiting[std::size_t(number)];
    m_hasCome[std::size_t(number)] = false;
    int first = 0;
    for (int sub = 1; sub <= int(value(0x1600 + number, 0)); ++sub) {
        const auto mapping = quint32(value(0x1600 + number, sub));
        const int bits = int(mapping & 0xFF);
        if (first + bits > 8 * int(frame.size))
            return;  // it is too short
        const quint64 number64 = Pdo::bitsOf(frame.data.data(), first, bits);
        m_objects.set({quint16(mapping >> 16), quint8(mapping >> 8)}, littleEndian(number64, (bits + 7) / 8));
        first += bits;
    }
}

// ---- what goes out ----

void CanOpenDevice::tick(qint64 now, Frames *out)
{
    const auto period = qint64(value(0x1017, 0) * milliseconds);
    if (period > 0 && now >= m_nextHeartbeat) {
        m_nextHeartbeat = m_nextHeartbeat + period > now ? m_nextHeartbeat + period : now + period;
        out->push_back(frameOf(CanOpenIds::Heartbeat + m_node, QByteArray(1, char(m_state))));
    }
    const auto longest = qint64((value(0x1016, 1) & 0xFFFF) * milliseconds);
    if (m_masterHeard >= 0 && longest > 0 && now - m_masterHeard > longest) {
        m_masterHeard = -1;
        m_isMasterLost = true;
        m_state = NmtState::PreOperational;
        tellEmergency(0x8130, 0x11, out);
    }
    for (int number = 0; number < Pdos && m_state == NmtState::Operational; ++number) {
        const auto event = qint64(value(0x1800 + number, 5) * milliseconds);
        qint64 &next = m_nextEvent[std::size_t(number)];
        if (!isOn(0x1800 + number) || value(0x1800 + number, 2) < firstOnEvent || event == 0 || now < next)
            continue;
        next = next + event > now ? next + event : now + event;
        sendPdo(number, out);
    }
}

bool CanOpenDevice::isOn(int communication) const
{
    return (value(communication, 1) & Pdo::IsOff) == 0;
}

void CanOpenDevice::sendPdo(int number, Frames *out) const
{
    CanFrame frame;
    frame.id = quint32(value(0x1800 + number, 1) & CanFrame::StandardIds);
    int first = 0;
    for (int sub = 1; sub <= int(value(0x1A00 + number, 0)); ++sub) {
        const auto mapping = quint32(value(0x1A00 + number, sub));
        const int bits = int(mapping & 0xFF);
        if (first + bits > Pdo::MaximumBits)
            break;
        Pdo::setBits(frame.data.data(), first, bits, value(int(mapping >> 16), int(mapping >> 8 & 0xFF)));
        first += bits;
    }
    frame.size = quint8((first + 7) / 8);
    out->push_back(frame);
}

// ---- what a master may write ----

// A PDO is off while its mapping is changed, and has no entries while they are written (CiA 301).
quint32 CanOpenDevice::checkWrite(ObjectAddress address, const QByteArray &bytes) const
{
    if (!isMapping(address.index))
        return 0;
    if (m_state == NmtState::Operational || isOn(address.index - 0x200))
        return SdoAbort::NotInThisState;
    if (address.sub > 0)
        return checkEntry(address.index, quint32(fromLittleEndian(bytes)));
    const quint64 count = fromLittleEndian(bytes);
    if (count > quint64(entriesOfPdo))
        return SdoAbort::TooLongForPdo;
    int bits = 0;
    for (int sub = 1; sub <= int(count); ++sub)
        bits += int(value(address.index, sub) & 0xFF);
    return bits > Pdo::MaximumBits ? SdoAbort::TooLongForPdo : 0;
}

quint32 CanOpenDevice::checkEntry(int index, quint32 mapping) const
{
    if (value(index, 0) != 0)
        return SdoAbort::UnsupportedAccess;
    const ObjectAddress address{quint16(mapping >> 16), quint8(mapping >> 8)};
    const CanOpenObjects::Object *object = m_objects.find(address);
    if (!object)
        return SdoAbort::NoObject;
    const bool isReceived = index < 0x1A00;
    const bool isAllowed = !isReceived || object->access == CanOpenObjects::ReadWrite;
    return isAllowed && object->value.size() * 8 == int(mapping & 0xFF) ? 0 : SdoAbort::NotMappable;
}

}  // namespace qplc
