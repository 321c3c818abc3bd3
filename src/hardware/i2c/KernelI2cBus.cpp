// SPDX-License-Identifier: Apache-2.0
#include "I2cBus.h"

#include "hardware/DeviceFiles.h"

#include <QtCore/QFile>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <linux/i2c-dev.h>
#include <linux/i2c.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace qplc {

namespace {

DeviceFiles i2cFiles()
{
    return {
        QStringLiteral("the I2C bus"), QStringLiteral("i2c-*"), QStringLiteral("i2c"),
        QStringLiteral("this computer has no I2C buses: 'sudo modprobe i2c-dev', and switch the bus on (on a Raspberry "
                       "Pi: dtparam=i2c_arm=on in config.txt)")};
}

QString i2cAddressErrorText(const QString &device, int address, int errorNumber)
{
    return errorNumber == EBUSY
        ? QStringLiteral("address %1 of %2 is used by a driver of the kernel; take its values from there, or take it "
                         "away: echo N-00%3 | sudo tee /sys/bus/i2c/devices/N-00%3/driver/unbind")
              .arg(RegisterBus::byteText(address), device, RegisterBus::byteText(address).mid(2))
        : QStringLiteral("cannot use address %1 of %2: %3; is that an I2C bus?")
              .arg(RegisterBus::byteText(address), device, qt_error_string(errorNumber));
}

/// A device on a bus of the kernel, by its i2c-dev. Registers of 8 bits are SMBus calls, which
/// every adapter has, also those without plain I2C transfers.
class KernelI2cBus final : public I2cBus
{
public:
    static std::unique_ptr<KernelI2cBus> open(const QString &device, int address, QString *error, Numbers numbers)
    {
        auto bus = std::make_unique<KernelI2cBus>();
        bus->m_address = address;
        bus->m_numbers = numbers;
        const QString path = DeviceFiles::path(device);
        bus->m_descriptor = ::open(QFile::encodeName(path).constData(), O_RDWR | O_CLOEXEC);
        if (bus->m_descriptor < 0) {
            *error = i2cFiles().errorText(device, errno);
            return nullptr;
        }
        if (::ioctl(bus->m_descriptor, I2C_FUNCS, &bus->m_abilities) < 0
            || ::ioctl(bus->m_descriptor, I2C_SLAVE, address) < 0) {
            *error = i2cAddressErrorText(device, address, errno);
            return nullptr;
        }
        constexpr unsigned long needed = I2C_FUNC_SMBUS_BYTE_DATA;
        if ((bus->m_abilities & needed) != needed) {
            *error = QStringLiteral("the adapter of %1 cannot read and write single registers; take another adapter")
                         .arg(device);
            return nullptr;
        }
        if (numbers == SixteenBits && !(bus->m_abilities & I2C_FUNC_I2C)) {
            *error = QStringLiteral("cannot use registers of 16 bits at %1: %2").arg(device, i2cRemedy(EOPNOTSUPP));
            return nullptr;
        }
        return bus;
    }

    ~KernelI2cBus() override
    {
        if (m_descriptor >= 0)
            ::close(m_descriptor);
    }

    bool read(int first, quint8 *bytes, int count) noexcept override
    {
        if (first == NoRegister) {
            i2c_msg message = {__u16(m_address), I2C_M_RD, __u16(count), bytes};
            return transfer(&message, 1);
        }
        if (m_numbers == EightBits)
            return readRegisters(first, bytes, count);
        __u8 number[] = {__u8(first >> 8), __u8(first)};
        i2c_msg messages[]
            = {{__u16(m_address), 0, sizeof number, number}, {__u16(m_address), I2C_M_RD, __u16(count), bytes}};
        return transfer(messages, 2);
    }

    bool write(int first, const quint8 *bytes, int count) noexcept override
    {
        if (first != NoRegister && m_numbers == EightBits)
            return writeRegisters(first, bytes, count);
        __u8 all[2 + MostAtOnce] = {__u8(first >> 8), __u8(first)};
        const int head = first == NoRegister ? 0 : 2;
        if (count > MostAtOnce) {
            errno = EMSGSIZE;
            return false;
        }
        std::memcpy(all + head, bytes, std::size_t(count));
        i2c_msg message = {__u16(m_address), 0, __u16(head + count), all};
        return transfer(&message, 1);
    }

private:
    // Blocks come in one transfer, so that bytes of one measurement stay together; an adapter that
    // cannot do them gives words, then single bytes.
    bool readRegisters(int first, quint8 *bytes, int count) noexcept
    {
        for (int done = 0; done < count;) {
            i2c_smbus_data data = {};
            const auto reg = quint8(first + done);
            const int left = std::min(count - done, I2C_SMBUS_BLOCK_MAX);
            int taken = 1;
            if (left > 1 && (m_abilities & I2C_FUNC_SMBUS_READ_I2C_BLOCK)) {
                data.block[0] = __u8(left);
                if (!call(true, reg, I2C_SMBUS_I2C_BLOCK_DATA, &data))
                    return false;
                taken = std::min<int>(data.block[0], left);
                if (taken == 0) {
                    errno = EIO;
                    return false;
                }
                std::memcpy(bytes + done, data.block + 1, std::size_t(taken));
            } else if (left > 1 && (m_abilities & I2C_FUNC_SMBUS_READ_WORD_DATA)) {
                if (!call(true, reg, I2C_SMBUS_WORD_DATA, &data))
                    return false;
                taken = 2;
                bytes[done] = quint8(data.word & 0xff);  // the first byte on the wire is the low one
                bytes[done + 1] = quint8(data.word >> 8);
            } else {
                if (!call(true, reg, I2C_SMBUS_BYTE_DATA, &data))
                    return false;
                bytes[done] = data.byte;
            }
            done += taken;
        }
        return true;
    }

    bool writeRegisters(int first, const quint8 *bytes, int count) noexcept
    {
        for (int done = 0; done < count;) {
            i2c_smbus_data data = {};
            const auto reg = quint8(first + done);
            const int left = std::min(count - done, I2C_SMBUS_BLOCK_MAX);
            int given = 1;
            bool isRight = false;
            if (left > 1 && (m_abilities & I2C_FUNC_SMBUS_WRITE_I2C_BLOCK)) {
                given = left;
                data.block[0] = __u8(left);
                std::memcpy(data.block + 1, bytes + done, std::size_t(left));
                isRight = call(false, reg, I2C_SMBUS_I2C_BLOCK_DATA, &data);
            } else if (left > 1 && (m_abilities & I2C_FUNC_SMBUS_WRITE_WORD_DATA)) {
                given = 2;
                data.word = __u16(bytes[done] | bytes[done + 1] << 8);
                isRight = call(false, reg, I2C_SMBUS_WORD_DATA, &data);
            } else {
                data.byte = bytes[done];
                isRight = call(false, reg, I2C_SMBUS_BYTE_DATA, &data);
            }
            if (!isRight)
                return false;
            done += given;
        }
        return true;
    }

    bool transfer(i2c_msg *messages, int count) noexcept
    {
        i2c_rdwr_ioctl_data data = {messages, __u32(count)};
        if (m_abilities & I2C_FUNC_I2C)
            return ::ioctl(m_descriptor, I2C_RDWR, &data) == count;
        errno = EOPNOTSUPP;
        return false;
    }

    bool call(bool isRead, quint8 reg, quint32 size, void *data) noexcept
    {
        i2c_smbus_ioctl_data arguments = {};
        arguments.read_write = isRead ? I2C_SMBUS_READ : I2C_SMBUS_WRITE;
        arguments.command = reg;
        arguments.size = size;
        arguments.data = static_cast<i2c_smbus_data *>(data);
        return ::ioctl(m_descriptor, I2C_SMBUS, &arguments) >= 0;
    }

    int m_descriptor = -1;
    int m_address = 0;
    Numbers m_numbers = EightBits;
    unsigned long m_abilities = 0;  // I2C_FUNC_...
};

}  // namespace

std::unique_ptr<I2cBus> openKernelI2cBus(const QString &device, int address, QString *error, I2cBus::Numbers numbers)
{
    return KernelI2cBus::open(device, address, error, numbers);
}

}  // namespace qplc
