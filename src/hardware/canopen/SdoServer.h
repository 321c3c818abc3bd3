// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SdoFrame.h"

#include <functional>
#include <map>

namespace qplc {

/// The objects that a device has, with their values.
class CanOpenObjects
{
public:
    enum Access : quint8 { ReadOnly, ReadWrite };  ///< for the master
    struct Object
    {
        QByteArray value;  // as it travels, least significant byte first
        Access access = ReadWrite;
    };

    /// Adds an object. One that is there keeps its place and gets these.
    void add(ObjectAddress address, const QByteArray &value, Access access)
    {
        m_objects[address.key()] = {value, access};
    }
    /// Null when there is none.
    const Object *find(ObjectAddress address) const
    {
        const auto found = m_objects.find(address.key());
        return found == m_objects.end() ? nullptr : &found->second;
    }
    bool hasIndex(quint16 index) const
    {
        const auto found = m_objects.lower_bound(ObjectAddress{index, 0}.key());
        return found != m_objects.end() && found->first >> 8 == index;
    }
    /// The number; 0 when there is no such object.
    quint64 number(ObjectAddress address) const
    {
        const Object *object = find(address);
        return object ? fromLittleEndian(object->value) : 0;
    }
    /// Sets a value of the same size; nothing when there is no such object.
    void set(ObjectAddress address, const QByteArray &value)
    {
        const auto found = m_objects.find(address.key());
        if (found != m_objects.end() && found->second.value.size() == value.size())
            found->second.value = value;
    }

private:
    std::map<quint32, Object> m_objects;  // by ObjectAddress::key()
};

/// The device's side of SDO (CiA 301): answers requests for its objects, expedited and in segments.
class SdoServer
{
public:
    using Data = SdoFrame::Data;
    /// What the device says to a write: an abort code; 0: it is allowed.
    using Check = std::function<quint32(ObjectAddress, const QByteArray &)>;

    SdoServer(CanOpenObjects *objects, Check check)
        : m_objects(objects)
        , m_check(std::move(check))
    {
    }

    /// \return nothing when a request has no answer
    std::optional<Data> answer(const Data &request);

private:
    enum Transfer : quint8 { None, Reading, Writing };

    Data beginRead();
    Data beginWrite(const Data &request);
    Data readSegment(const Data &request);
    Data writeSegment(const Data &request);
    quint32 store(const QByteArray &value);
    Data frame(quint8 command, quint32 rest = 0) const { return SdoFrame::make(command, m_address, rest); }
    Data abort(quint32 code);

    CanOpenObjects *m_objects;
    Check m_check;
    Transfer m_transfer = None;
    ObjectAddress m_address;
    QByteArray m_value;
    int m_position = 0;
    quint8 m_toggle = 0;  // 0 or 0x10
};

}  // namespace qplc
