// SPDX-License-Identifier: Apache-2.0
#include "SerialLine.h"

#include "hardware/DeviceFiles.h"
#include "hardware/fake/FakeMemory.h"

#include <QtCore/QDir>
#include <QtCore/QFile>

#include <cerrno>
#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace qplc {

namespace {

struct SerialRate
{
    int baud;
    speed_t code;
};
constexpr SerialRate serialRates[] = {
    {1200, B1200},       {2400, B2400},       {4800, B4800},       {9600, B9600},       {19200, B19200},
    {38400, B38400},     {57600, B57600},     {115200, B115200},   {230400, B230400},   {460800, B460800},
    {500000, B500000},   {576000, B576000},   {921600, B921600},   {1000000, B1000000}, {1152000, B1152000},
    {1500000, B1500000}, {2000000, B2000000}, {2500000, B2500000}, {3000000, B3000000}, {3500000, B3500000},
    {4000000, B4000000},
};

speed_t codeOf(int baud)
{
    for (const SerialRate &rate : serialRates) {
        if (rate.baud == baud)
            return rate.code;
    }
    return B0;
}

tcflag_t flagsOf(const SerialSettings &settings)
{
    constexpr tcflag_t sizes[] = {CS5, CS6, CS7, CS8};
    tcflag_t flags = CREAD | CLOCAL | sizes[settings.dataBits - 5];
    if (settings.stopBits == 2)
        flags |= CSTOPB;
    if (settings.parity != SerialSettings::NoParity)
        flags |= PARENB;
    if (settings.parity == SerialSettings::Odd)
        flags |= PARODD;
    return flags;
}

QString serialOpenErrorText(const QString &device, int errorNumber)
{
    QString remedy = QStringLiteral("is that a serial line?");
    if (errorNumber == EACCES || errorNumber == EPERM)
        remedy = DeviceFiles::permissionRemedy(QStringLiteral("dialout"), errorNumber);
    else if (errorNumber == EBUSY)
        remedy = QStringLiteral("another program has it: 'fuser -v %1' tells which").arg(device);
    else if (errorNumber == ENOENT || errorNumber == ENODEV || errorNumber == ENXIO) {
        const QStringList names
            = QDir(QStringLiteral("/dev/serial/by-id")).entryList(QDir::NoDotAndDotDot | QDir::AllEntries);
        remedy = names.isEmpty()
            ? QStringLiteral("plug the adapter in, and look for it with 'ls /dev/ttyUSB* /dev/ttyACM*'")
            : QStringLiteral("in /dev/serial/by-id there are %1").arg(names.join(QStringLiteral(", ")));
    }
    return QStringLiteral("cannot open the serial line '%1': %2; %3").arg(device, qt_error_string(errorNumber), remedy);
}

}  // namespace

bool SerialSettings::setFormat(const QString &text)
{
    if (text.size() != 3)
        return false;
    const int bits = text.at(0).digitValue();
    const int parityIndex = QStringLiteral("NEO").indexOf(text.at(1).toUpper());
    const int stops = text.at(2).digitValue();
    if (bits < 5 || bits > 8 || parityIndex < 0 || stops < 1 || stops > 2)
        return false;
    dataBits = bits;
    parity = Parity(parityIndex);
    stopBits = stops;
    return true;
}

QString SerialSettings::toString() const
{
    return QStringLiteral("%1 %2%3%4").arg(baud).arg(dataBits).arg(QStringLiteral("NEO").at(parity)).arg(stopBits);
}

SerialLine::~SerialLine()
{
    close();
}

bool SerialLine::open(const QString &device, const SerialSettings &settings, QString *error)
{
    close();
    m_device = device;
    const bool isFake = FakeMemory::isFake(device);
    const QString path = isFake ? FakeMemory::path(device) : device;
    // O_NONBLOCK also because open() would wait for a modem otherwise.
    m_descriptor = ::open(QFile::encodeName(path).constData(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (m_descriptor < 0) {
        *error = isFake && errno == ENOENT ? FakeMemory::missingText(device) : serialOpenErrorText(device, errno);
        return false;
    }
    if (setUp(settings, error))
        return true;
    close();
    return false;
}

bool SerialLine::setUp(const SerialSettings &settings, QString *error)
{
    termios wanted = {};
    if (::ioctl(m_descriptor, TIOCEXCL) < 0 || ::tcgetattr(m_descriptor, &wanted) < 0) {
        *error = serialOpenErrorText(m_device, errno);
        return false;
    }
    ::cfmakeraw(&wanted);
    wanted.c_iflag &= ~tcflag_t(IXON | IXOFF | IXANY);
    wanted.c_cflag = flagsOf(settings);
    if (settings.parity != SerialSettings::NoParity)
        wanted.c_iflag |= INPCK;  // a byte with a wrong parity is read as 0
    wanted.c_cc[VMIN] = 1;        // no bytes and no line are different things then
    wanted.c_cc[VTIME] = 0;
    const speed_t speed = codeOf(settings.baud);
    const bool isUsual = speed != B0;
    ::cfsetispeed(&wanted, isUsual ? speed : B9600);
    ::cfsetospeed(&wanted, isUsual ? speed : B9600);
    termios obtained = {};
    // tcsetattr() is content when it could set anything: what matters is looked at.
    constexpr tcflag_t format = CSIZE | CSTOPB | PARENB | PARODD;
    const bool isSet = ::tcsetattr(m_descriptor, TCSANOW, &wanted) == 0 && ::tcgetattr(m_descriptor, &obtained) == 0
        && (obtained.c_cflag & format) == (wanted.c_cflag & format)
        && (isUsual ? ::cfgetospeed(&obtained) == speed : setSerialRate(m_descriptor, settings.baud));
    if (!isSet) {
        *error = QStringLiteral("the serial line '%1' cannot do %2; take another rate or format, or another adapter")
                     .arg(m_device, settings.toString());
        return false;
    }
    const QString problem = settings.mode.apply(m_descriptor);
    if (!problem.isEmpty()) {
        *error = QStringLiteral("cannot set up the serial line '%1': %2").arg(m_device, problem);
        return false;
    }
    ::tcflush(m_descriptor, TCIFLUSH);
    return true;
}

void SerialLine::close()
{
    if (m_descriptor >= 0) {
        ::ioctl(m_descriptor, TIOCNXCL);
        ::close(m_descriptor);
    }
    m_descriptor = -1;
}

int SerialLine::read(char *bytes, int size) noexcept
{
    const ssize_t count = ::read(m_descriptor, bytes, std::size_t(size));
    if (count > 0)
        return int(count);
    if (count < 0 && (errno == EAGAIN || errno == EINTR))
        return 0;
    if (count == 0 || errno == EIO)  // hung up
        errno = ENODEV;
    return -1;
}

int SerialLine::write(const char *bytes, int size) noexcept
{
    const ssize_t count = ::write(m_descriptor, bytes, std::size_t(size));
    if (count >= 0)
        return int(count);
    if (errno == EAGAIN || errno == EINTR)
        return 0;
    if (errno == EIO)
        errno = ENODEV;
    return -1;
}

int SerialLine::waiting() const noexcept
{
    int count = 0;
    return ::ioctl(m_descriptor, TIOCOUTQ, &count) == 0 ? count : 0;
}

bool SerialLine::isUsualRate(int baud)
{
    return codeOf(baud) != B0;
}

QString SerialLine::usualRates()
{
    QStringList texts;
    for (const SerialRate &rate : serialRates)
        texts << QString::number(rate.baud);
    return texts.join(QStringLiteral(", "));
}

QString SerialLine::remedy(int errorNumber)
{
    return errorNumber == ENODEV ? QStringLiteral("the line is gone: plug the adapter in again; a name of "
                                                  "/dev/serial/by-id stays the same then")
                                 : QString();
}

}  // namespace qplc
