// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ModbusRegister.h"

namespace qplc {

/// Neighbouring values of a device that one request reads or writes.
struct ModbusRequest
{
    quint8 unit = 1;
    ModbusRegister::Space space = ModbusRegister::Holding;
    quint16 first = 0;
    int count = 0;          // of bits or registers
    bool isSingle = false;  // to be written as a single value

    /// Most that the protocol carries in a request.
    static constexpr int MostBitsRead = 2000;
    static constexpr int MostBitsWritten = 1968;
    static constexpr int MostRegistersRead = 125;
    static constexpr int MostRegistersWritten = 123;
};

/// The answer of a device that does not do what it is asked for. The numbers are those of the
/// protocol.
enum class ModbusException : quint8 {
    None = 0,
    UnknownFunction = 1,
    UnknownAddress = 2,
    RefusedValue = 3,
    DeviceFailure = 4,
    Acknowledge = 5,
    Busy = 6,
    NegativeAcknowledge = 7,
    MemoryParity = 8,
    NoPath = 10,
    NoAnswerBehindGateway = 11
};

/// What carries requests to a device and its answers back. Each function waits for the device.
class ModbusLink
{
public:
    ModbusLink() = default;
    virtual ~ModbusLink() = default;
    ModbusLink(const ModbusLink &) = delete;
    ModbusLink &operator=(const ModbusLink &) = delete;

    virtual bool open() = 0;
    virtual void close() = 0;
    /// \param values  one for each bit or register
    virtual bool read(const ModbusRequest &request, quint16 *values) = 0;
    virtual bool write(const ModbusRequest &request, const quint16 *values) = 0;

    /// Why a function returned false: the device said so, unless it is None.
    ModbusException exception() const { return m_exception; }
    /// As above, when the device said nothing: "Connection refused", and what to do.
    QString errorText() const { return m_errorText; }
    /// Whether only this answer was missing or damaged: the next one may be right. Else the way to
    /// all units is gone, or the device has said what it thinks.
    bool isAnswerBad() const { return m_isAnswerBad; }

protected:
    bool fail(ModbusException exception)
    {
        m_exception = exception;
        m_errorText.clear();
        m_isAnswerBad = exception == ModbusException::NoAnswerBehindGateway;
        return false;
    }
    bool fail(const QString &text)
    {
        m_exception = ModbusException::None;
        m_errorText = text;
        m_isAnswerBad = false;
        return false;
    }
    bool failAnswer(const QString &text)
    {
        fail(text);
        m_isAnswerBad = true;
        return false;
    }

private:
    ModbusException m_exception = ModbusException::None;
    QString m_errorText;
    bool m_isAnswerBad = false;
};

}  // namespace qplc
