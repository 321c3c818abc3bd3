// SPDX-License-Identifier: Apache-2.0
#include "SpiBus.h"

#include "hardware/DeviceFiles.h"

#include <QtCore/QFile>

#include <cerrno>
#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace qplc {

namespace {

DeviceFiles spiFiles()
{
    return {QStringLiteral("the SPI device"), QStringLiteral("spidev*"), QStringLiteral("spi"),
            QStringLiteral(
                "this computer has no SPI devices: 'sudo modprobe spidev', and switch the bus on (on a Raspberry "
                "Pi: dtparam=spi=on in config.txt)")};
}

class KernelSpiBus : public SpiBus
{
public:
    explicit KernelSpiBus(int descriptor)
        : m_descriptor(descriptor)
    {
    }
    ~KernelSpiBus() override { ::close(m_descriptor); }

    bool setUp(const SpiSettings &settings) noexcept
    {
        const auto mode = quint8(settings.mode);
        const quint8 bits = 8;
        return ::ioctl(m_descriptor, SPI_IOC_WR_MODE, &mode) >= 0
            && ::ioctl(m_descriptor, SPI_IOC_WR_BITS_PER_WORD, &bits) >= 0
            && ::ioctl(m_descriptor, SPI_IOC_WR_MAX_SPEED_HZ, &settings.speed) >= 0;
    }

    bool transfer(const quint8 *sent, quint8 *received, int count) noexcept override
    {
        spi_ioc_transfer message = {};
        message.tx_buf = quint64(quintptr(sent));
        message.rx_buf = quint64(quintptr(received));
        message.len = quint32(count);
        return ::ioctl(m_descriptor, SPI_IOC_MESSAGE(1), &message) >= 0;
    }

private:
    const int m_descriptor;
};

}  // namespace

std::unique_ptr<SpiBus> SpiBus::open(const QString &device, const SpiSettings &settings, QString *error)
{
    const QString path = DeviceFiles::path(device);
    const int descriptor = ::open(QFile::encodeName(path).constData(), O_RDWR | O_CLOEXEC);
    if (descriptor < 0) {
        *error = spiFiles().errorText(device, errno);
        return nullptr;
    }
    auto bus = std::make_unique<KernelSpiBus>(descriptor);
    if (bus->setUp(settings))
        return bus;
    *error = QStringLiteral("the SPI device '%1' refuses mode %2 at %3 Hz: %4; take another 'mode' or 'speed', and see "
                            "that it is an SPI device")
                 .arg(device)
                 .arg(settings.mode)
                 .arg(settings.speed)
                 .arg(qt_error_string(errno));
    return nullptr;
}

}  // namespace qplc
