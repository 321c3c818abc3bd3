// SPDX-License-Identifier: Apache-2.0
#include "SdoTransfer.h"

#include <algorithm>

namespace qplc {

namespace {

// Command specifiers (bits 5 ... 7) of CiA 301.
constexpr quint8 writeSegment = 0x00;
constexpr quint8 beginWrite = 0x20;
constexpr quint8 beginRead = 0x40;
constexpr quint8 readSegment = 0x60;
constexpr quint8 abortCommand = 0x80;
constexpr quint8 segmentRead = 0x00;
constexpr quint8 segmentWritten = 0x20;
constexpr quint8 readBegun = 0x40;
constexpr quint8 writeBegun = 0x60;
constexpr quint8 commandMask = 0xE0;

constexpr quint8 isExpedited = 0x02;
constexpr quint8 hasSize = 0x01;
constexpr quint8 isLast = 0x01;
constexpr quint8 toggleBit = 0x10;
constexpr int segmentSize = 7;  // [byte]

struct AbortText
{
    quint32 code;
    const char *text;
};

constexpr AbortText abortTexts[] = {
    {0x05030000, "the toggle bit did not alternate"},
    {0x05040000, "the device did not answer in time"},
    {0x05040001, "the command is not known"},
    {0x05040002, "the block size is not valid"},
    {0x05040003, "the sequence number is not valid"},
    {0x05040004, "the checksum is wrong"},
    {0x05040005, "there is not enough memory"},
    {0x06010000, "the object does not allow this access"},
    {0x06010001, "the object can only be written"},
    {0x06010002, "the object can only be read"},
    {0x06020000, "the object does not exist"},
    {0x06040041, "the object cannot be part of a PDO"},
    {0x06040042, "the objects are too many or too long for the PDO"},
    {0x06040043, "the parameters do not fit each other"},
    {0x06040047, "the device has an internal contradiction"},
    {0x06060000, "the hardware of the device has a fault"},
    {0x06070010, "the length does not fit the type of the object"},
    {0x06070012, "the value has too many bytes"},
    {0x06070013, "the value has too few bytes"},
    {0x06090011, "the subindex does not exist"},
    {0x06090030, "the value is not allowed"},
    {0x06090031, "the value is too high"},
    {0x06090032, "the value is too low"},
    {0x06090036, "the maximum is below the minimum"},
    {0x060A0023, "the resource is not available"},
    {0x08000000, "general error"},
    {0x08000020, "the value cannot be taken or stored"},
    {0x08000021, "the value cannot be taken or stored: the device is controlled locally"},
    {0x08000022, "the value cannot be taken or stored in the present state of the device"},
    {0x08000023, "the object dictionary could not be made, or is missing"},
    {0x08000024, "there are no data"},
};

}  // namespace

QString SdoTransfer::abortText(quint32 code)
{
    for (const AbortText &abort : abortTexts) {
        if (abort.code == code)
            return QLatin1String(abort.text);
    }
    return QStringLiteral("unknown reason");
}

SdoTransfer SdoTransfer::read(ObjectAddress address)
{
    SdoTransfer transfer(address, false, {});
    transfer.ask(beginRead);
    return transfer;
}

SdoTransfer SdoTransfer::write(ObjectAddress address, const QByteArray &value)
{
    SdoTransfer transfer(address, true, value);
    const int size = value.size();
    if (size >= 1 && size <= 4) {
        transfer.ask(quint8(beginWrite | (4 - size) << 2 | isExpedited | hasSize), quint32(fromLittleEndian(value)));
    } else {
        transfer.m_isInSegments = true;
        transfer.ask(beginWrite | hasSize, quint32(size));
    }
    return transfer;
}

SdoTransfer::SdoTransfer(ObjectAddress address, bool isWrite, const QByteArray &value)
    : m_address(address)
    , m_isWrite(isWrite)
    , m_value(value)
{
}

void SdoTransfer::ask(quint8 command, quint32 rest)
{
    m_request = SdoFrame::make(command, m_address, rest);
    m_hasRequest = true;
}

void SdoTransfer::abort(quint32 code)
{
    m_state = Aborted;
    m_abortCode = code;
    ask(abortCommand, code);
}

bool SdoTransfer::take(const Data &response)
{
    if (m_state != Running)
        return false;
    const quint8 command = response[0] & commandMask;
    if (command == abortCommand) {
        if (!isAddressed(response))
            return false;
        m_state = Aborted;
        m_abortCode = SdoFrame::restOf(response);
        m_hasRequest = false;
        return true;
    }
    const bool isFirst = command == readBegun || command == writeBegun;
    if (isFirst && !isAddressed(response))
        return false;  // a late answer to somebody else, or to an attempt that was given up
    if (m_isWrite)
        takeAnswerToWrite(response);
    else if (m_isInSegments)
        takeSegmentOfRead(response);
    else
        takeFirstOfRead(response);
    return true;
}

void SdoTransfer::takeFirstOfRead(const Data &response)
{
    if ((response[0] & commandMask) != readBegun)
        return abort(SdoAbort::UnknownCommand);
    if (response[0] & isExpedited) {
        const int unused = (response[0] & hasSize) ? (response[0] >> 2) & 3 : 0;
        m_value = QByteArray(reinterpret_cast<const char *>(response.data()) + 4, 4 - unused);
        m_state = Done;
        m_hasRequest = false;
        return;
    }
    if (response[0] & hasSize) {
        const quint32 size = SdoFrame::restOf(response);
        if (size > quint32(MaximumSize))
            return abort(SdoAbort::OutOfMemory);
        m_size = int(size);
    }
    m_isInSegments = true;
    askForSegment();
}

void SdoTransfer::askForSegment()
{
    m_request = {};
    m_request[0] = quint8(readSegment | m_toggle);
    m_hasRequest = true;
}

void SdoTransfer::takeSegmentOfRead(const Data &response)
{
    if ((response[0] & commandMask) != segmentRead)
        return abort(SdoAbort::UnknownCommand);
    if ((response[0] & toggleBit) != m_toggle)
        return abort(SdoAbort::WrongToggle);
    const int count = segmentSize - ((response[0] >> 1) & 7);
    const bool isEnd = response[0] & isLast;
    const int limit = m_size >= 0 ? m_size : MaximumSize;
    if (count == 0 && !isEnd)
        return abort(SdoAbort::WrongLength);  // it would never end
    if (m_value.size() + count > limit)
        return abort(m_size >= 0 ? SdoAbort::WrongLength : SdoAbort::OutOfMemory);
    m_value.append(reinterpret_cast<const char *>(response.data()) + 1, count);
    m_toggle ^= toggleBit;
    if (!isEnd)
        return askForSegment();
    if (m_size >= 0 && m_value.size() != m_size)
        return abort(SdoAbort::WrongLength);
    m_state = Done;
    m_hasRequest = false;
}

void SdoTransfer::takeAnswerToWrite(const Data &response)
{
    const quint8 command = response[0] & commandMask;
    const bool isFirst = m_request[0] & beginWrite;
    if (command != (isFirst ? writeBegun : segmentWritten))
        return abort(SdoAbort::UnknownCommand);
    if (isFirst && m_isInSegments)
        return sendSegment();
    if (!isFirst) {
        if ((response[0] & toggleBit) != m_toggle)
            return abort(SdoAbort::WrongToggle);
        m_toggle ^= toggleBit;
        if (m_position < m_value.size())
            return sendSegment();
    }
    m_state = Done;
    m_hasRequest = false;
}

void SdoTransfer::sendSegment()
{
    const int count = std::min(segmentSize, m_value.size() - m_position);
    const bool isEnd = m_position + count == m_value.size();
    m_request = {};
    m_request[0] = quint8(writeSegment | m_toggle | (segmentSize - count) << 1 | (isEnd ? isLast : 0));
    std::copy_n(m_value.constData() + m_position, count, m_request.begin() + 1);
    m_position += count;
    m_hasRequest = true;
}

}  // namespace qplc
