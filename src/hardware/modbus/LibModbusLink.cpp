// SPDX-License-Identifier: Apache-2.0
#include "LibModbusLink.h"

#include <algorithm>
#include <cerrno>
#include <modbus/modbus.h>
#include <poll.h>
#include <sys/file.h>
#include <utility>
#include <vector>

namespace qplc {

namespace {

class LibModbusLink final : public ModbusLink
{
public:
    LibModbusLink(const QString &host, quint16 port, std::chrono::nanoseconds responseTimeout)
        : m_isSerial(false)
        , m_responseTimeout(responseTimeout)
        , m_context(modbus_new_tcp_pi(host.toUtf8().constData(), QByteArray::number(port).constData()))
        , m_bits(ModbusRequest::MostBitsRead)
    {
    }

    LibModbusLink(const ModbusSerialLine &line, std::chrono::nanoseconds responseTimeout)
        : m_isSerial(true)
        , m_mode(line.mode)
        , m_responseTimeout(responseTimeout)
        , m_context(modbus_new_rtu(line.device.toLocal8Bit().constData(), line.baud, line.parity, 8, line.stopBits))
        , m_bits(ModbusRequest::MostBitsRead)
    {
    }

    ~LibModbusLink() override = default;

    bool open() override
    {
        using namespace std::chrono;
        const auto timeout = std::uint32_t(duration_cast<microseconds>(m_responseTimeout).count());
        modbus_set_response_timeout(m_context.get(), timeout / 1'000'000, timeout % 1'000'000);
        modbus_set_byte_timeout(m_context.get(), 0, 0);  // the time of the response is that of its last byte
        m_isUnsettled = false;
        if (modbus_connect(m_context.get()) != 0)
            return fail(textOf(errno));
        if (m_isSerial && (!isAlone() || !setMode())) {
            close();
            return false;
        }
        return true;
    }

    void close() override { modbus_close(m_context.get()); }

    bool read(const ModbusRequest &request, quint16 *values) override
    {
        if (!settle() || !select(request.unit))
            return false;
        int count = 0;
        if (request.space == ModbusRegister::Holding)
            count = modbus_read_registers(m_context.get(), request.first, request.count, values);
        else if (request.space == ModbusRegister::Input)
            count = modbus_read_input_registers(m_context.get(), request.first, request.count, values);
        else
            count = readBits(request, values);
        return count == request.count || failWithErrno();
    }

    bool write(const ModbusRequest &request, const quint16 *values) override
    {
        if (!settle() || !select(request.unit))
            return false;
        int count = 0;
        if (request.space == ModbusRegister::Coil)
            count = writeBits(request, values);
        else if (request.isSingle)
            count = modbus_write_register(m_context.get(), request.first, *values);
        else
            count = modbus_write_registers(m_context.get(), request.first, request.count, values);
        return count == request.count || failWithErrno();
    }

private:
    struct Release
    {
        void operator()(modbus_t *context) const { modbus_free(context); }
    };
    /// Two programs on one serial line would read the answers of each other.
    bool isAlone()
    {
        return ::flock(modbus_get_socket(m_context.get()), LOCK_EX | LOCK_NB) == 0
            || fail(QStringLiteral("another program uses the line; end it, or wire its values in this section, too"));
    }

    bool setMode()
    {
        const QString problem = m_mode.apply(modbus_get_socket(m_context.get()));
        return problem.isEmpty() || fail(problem);
    }

    bool select(quint8 unit) { return modbus_set_slave(m_context.get(), unit) == 0 || failWithErrno(); }

    bool failWithErrno()
    {
        const int error = errno;
        if (error > MODBUS_ENOBASE && error <= EMBXGTAR)
            return fail(ModbusException(error - MODBUS_ENOBASE));
        m_isUnsettled = isOfAnswer(error);
        return m_isUnsettled ? failAnswer(textOf(error)) : fail(textOf(error));
    }

    QString textOf(int errorNumber) const
    {
        return QStringLiteral("%1; %2").arg(QString::fromLocal8Bit(modbus_strerror(errorNumber)), remedy(errorNumber));
    }

    static bool isOfAnswer(int errorNumber)
    {
        switch (errorNumber) {
        case EMBBADCRC:
        case EMBBADDATA:
        case EMBBADEXC:
        case EMBUNKEXC:
        case EMBMDATA:
        case EMBBADSLAVE:
        case ETIMEDOUT:
            return true;
        default:
            return false;
        }
    }

    /// After a bad answer the rest of it, or a late one, must not be taken for the next answer.
    bool settle()
    {
        if (!std::exchange(m_isUnsettled, false))
            return true;
        if (!m_isSerial) {
            close();  // what TCP delivers is not damaged: here the order of answers is lost
            return open();
        }
        pollfd line{modbus_get_socket(m_context.get()), POLLIN, 0};
        int left = MostFlushes;
        while (left-- > 0 && ::poll(&line, 1, QuietTime) != 0)
            modbus_flush(m_context.get());
        return true;
    }

    QString remedy(int errorNumber) const
    {
        switch (errorNumber) {
        case EMBBADCRC:
        case EMBBADDATA:
        case EMBBADEXC:
        case EMBUNKEXC:
        case EMBBADSLAVE:
            return m_isSerial
                ? QStringLiteral("look at baud, parity, termination and shield of the line, and whether two "
                                 "devices have the same unit")
                : QStringLiteral("look whether this is a Modbus TCP device");
        case ETIMEDOUT:
            return m_isSerial
                ? QStringLiteral("look at power and wires (A and B may be swapped), at unit, baud and parity")
                : QStringLiteral("look at power and network, at host, port and unit; a slow device needs a "
                                 "longer response-timeout");
        case ECONNREFUSED:
            return QStringLiteral(
                "there is no Modbus server; look at host and port (502 is usual), and whether it runs");
        case ECONNRESET:
        case EPIPE:
            return QStringLiteral("the device has closed the connection; many take only one or two at a time");
        case ENOENT:
        case ENODEV:
        case ENXIO:
        case EIO:
            return QStringLiteral("plug it in; \"ls /dev/serial/by-id\" shows what there is");
        case EACCES:
        case EPERM:
            return QStringLiteral("this user may not open it: \"sudo usermod -aG dialout USER\", then log in again");
        case EHOSTUNREACH:
        case ENETUNREACH:
            return QStringLiteral("this host cannot be reached; look at cable, address and netmask");
        default:
            return QStringLiteral("look whether the key device is right");
        }
    }

    int readBits(const ModbusRequest &request, quint16 *values)
    {
        const auto read = request.space == ModbusRegister::Coil ? modbus_read_bits : modbus_read_input_bits;
        const int count = read(m_context.get(), request.first, request.count, m_bits.data());
        std::copy_n(m_bits.begin(), std::max(count, 0), values);
        return count;
    }

    int writeBits(const ModbusRequest &request, const quint16 *values)
    {
        if (request.isSingle)
            return modbus_write_bit(m_context.get(), request.first, *values);
        std::transform(values, values + request.count, m_bits.begin(), [](quint16 bit) { return quint8(bit); });
        return modbus_write_bits(m_context.get(), request.first, request.count, m_bits.data());
    }

    static constexpr int QuietTime = 20;  // [ms] adapters at USB keep bytes for up to 16 ms
    static constexpr int MostFlushes = 20;

    const bool m_isSerial;
    const SerialMode m_mode;
    bool m_isUnsettled = false;  // the last answer was bad
    const std::chrono::nanoseconds m_responseTimeout;
    std::unique_ptr<modbus_t, Release> m_context;
    std::vector<quint8> m_bits;  // of a request
};

}  // namespace

std::unique_ptr<ModbusLink> createLibModbusLink(const QString &host, quint16 port,
                                                std::chrono::nanoseconds responseTimeout)
{
    return std::make_unique<LibModbusLink>(host, port, responseTimeout);
}

std::unique_ptr<ModbusLink> createLibModbusLink(const ModbusSerialLine &line, std::chrono::nanoseconds responseTimeout)
{
    return std::make_unique<LibModbusLink>(line, responseTimeout);
}

}  // namespace qplc
