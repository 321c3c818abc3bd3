// SPDX-License-Identifier: Apache-2.0
#include "SdoServer.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr quint8 toggleOfRequest = 0x10;
constexpr int bytesOfSegment = 7;
constexpr int mostBytes = 64 << 10;  // of a value that is being written

}  // namespace

std::optional<SdoServer::Data> SdoServer::answer(const Data &request)
{
    const int command = request[0] >> 5;
    const bool isSegment = command == 0 || command == 3;
    if (!isSegment)
        m_address = SdoFrame::addressOf(request);
    switch (command) {
    case 0:
        return writeSegment(request);
    case 1:
        return beginWrite(request);
    case 2:
        return beginRead();
    case 3:
        return readSegment(request);
    case 4:  // the master has aborted
        m_transfer = None;
        return std::nullopt;
    default:
        return abort(SdoAbort::UnknownCommand);
    }
}

SdoServer::Data SdoServer::abort(quint32 code)
{
    m_transfer = None;
    return frame(0x80, code);
}

SdoServer::Data SdoServer::beginRead()
{
    const CanOpenObjects::Object *object = m_objects->find(m_address);
    if (!object)
        return abort(m_objects->hasIndex(m_address.index) ? SdoAbort::NoSubindex : SdoAbort::NoObject);
    const int size = object->value.size();
    if (size >= 1 && size <= 4)
        return frame(quint8(0x43 | (4 - size) << 2), quint32(fromLittleEndian(object->value)));
    m_transfer = Reading;
    m_value = object->value;
    m_position = 0;
    m_toggle = 0;
    return frame(0x41, quint32(size));
}

SdoServer::Data SdoServer::beginWrite(const Data &request)
{
    const CanOpenObjects::Object *object = m_objects->find(m_address);
    if (!object)
        return abort(m_objects->hasIndex(m_address.index) ? SdoAbort::NoSubindex : SdoAbort::NoObject);
    if (object->access == CanOpenObjects::ReadOnly)
        return abort(SdoAbort::CannotBeWritten);
    m_transfer = Writing;
    m_value.clear();
    m_toggle = 0;
    if (!(request[0] & 2))
        return frame(0x60);
    const int size = (request[0] & 1) ? 4 - ((request[0] >> 2) & 3) : std::min(4, object->value.size());
    const quint32 code = store(QByteArray(reinterpret_cast<const char *>(request.data()) + 4, size));
    m_transfer = None;
    return code == 0 ? frame(0x60) : abort(code);
}

SdoServer::Data SdoServer::readSegment(const Data &request)
{
    if (m_transfer != Reading)
        return abort(SdoAbort::UnknownCommand);
    if ((request[0] & toggleOfRequest) != m_toggle)
        return abort(SdoAbort::WrongToggle);
    const QByteArray part = m_value.mid(m_position, bytesOfSegment);
    m_position += part.size();
    const bool isEnd = m_position >= m_value.size();
    Data answer{};
    answer[0] = quint8(m_toggle | (bytesOfSegment - part.size()) << 1 | (isEnd ? 1 : 0));
    std::copy(part.begin(), part.end(), answer.begin() + 1);
    m_toggle ^= toggleOfRequest;
    if (isEnd)
        m_transfer = None;
    return answer;
}

SdoServer::Data SdoServer::writeSegment(const Data &request)
{
    if (m_transfer != Writing)
        return abort(SdoAbort::UnknownCommand);
    if ((request[0] & toggleOfRequest) != m_toggle)
        return abort(SdoAbort::WrongToggle);
    m_value.append(reinterpret_cast<const char *>(request.data()) + 1, bytesOfSegment - ((request[0] >> 1) & 7));
    if (m_value.size() > mostBytes)
        return abort(SdoAbort::TooManyBytes);
    if (request[0] & 1) {
        m_transfer = None;
        if (const quint32 code = store(m_value))
            return abort(code);
    }
    Data answer{};
    answer[0] = quint8(0x20 | m_toggle);
    m_toggle ^= toggleOfRequest;
    return answer;
}

quint32 SdoServer::store(const QByteArray &value)
{
    const CanOpenObjects::Object *object = m_objects->find(m_address);
    if (value.size() > object->value.size())
        return SdoAbort::TooManyBytes;
    if (value.size() < object->value.size())
        return SdoAbort::TooFewBytes;
    const quint32 code = m_check ? m_check(m_address, value) : 0;
    if (code == 0)
        m_objects->set(m_address, value);
    return code;
}

}  // namespace qplc
