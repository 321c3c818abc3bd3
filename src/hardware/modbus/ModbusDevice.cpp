// SPDX-License-Identifier: Apache-2.0
#include "ModbusDevice.h"

#include "FakeModbusDevice.h"
#include "LibModbusLink.h"
#include "QPlcDriverSettings.h"
#include "signals/MessageText.h"

#include <vector>

namespace qplc {

namespace {

using namespace std::chrono_literals;

constexpr quint16 usualPort = 502;

std::unique_ptr<ModbusLink> refuseDevice(QPlcDriverSettings &settings, const QString &message)
{
    settings.addError(QStringLiteral("device"), message);
    return nullptr;
}

/// "host", "host:port", "[ipv6]", "[ipv6]:port"
bool splitHost(const QString &text, QString *host, quint16 *port)
{
    const bool isBracketed = text.startsWith(QLatin1Char('['));
    const int end = isBracketed ? text.indexOf(QLatin1Char(']')) : text.indexOf(QLatin1Char(':'));
    *host = isBracketed ? text.mid(1, end - 1) : text.left(end);
    const QString rest = end < 0 ? QString() : text.mid(isBracketed ? end + 1 : end);
    *port = usualPort;
    bool isNumber = true;
    if (!rest.isEmpty())
        *port = rest.midRef(1).toUShort(&isNumber);
    const bool hasColon = rest.isEmpty() || rest.startsWith(QLatin1Char(':'));
    return !host->isEmpty() && !(isBracketed && end < 0) && hasColon && isNumber && *port != 0;
}

ModbusSerialLine readSerialLine(QPlcDriverSettings &settings)
{
    const std::vector<int> rates{1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800, 500000, 921600};
    QStringList words;
    for (int rate : rates)
        words << QString::number(rate);
    ModbusSerialLine line;
    const int rate = settings.choice(QStringLiteral("baud"), words, words.indexOf(QString::number(line.baud)));
    line.baud = rates[std::size_t(rate)];
    line.parity = "ENO"[settings.choice(QStringLiteral("parity"),
                                        {QStringLiteral("even"), QStringLiteral("none"), QStringLiteral("odd")})];
    line.stopBits = int(settings.integer(QStringLiteral("stop-bits"), line.stopBits, 1, 2));
    line.mode.read(settings);
    return line;
}

#if defined(QTPLC_HAS_MODBUS)
template<typename... Arguments>
std::unique_ptr<ModbusLink> makeRealLink(QPlcDriverSettings &, const Arguments &...arguments)
{
    return createLibModbusLink(arguments...);
}
#else
template<typename... Arguments>
std::unique_ptr<ModbusLink> makeRealLink(QPlcDriverSettings &settings, const Arguments &...)
{
    return refuseDevice(settings,
                        QStringLiteral("this library was built without libmodbus and knows only fake:NAME; install "
                                       "libmodbus-dev and build it again"));
}
#endif

std::unique_ptr<ModbusLink> makeTcpLink(QPlcDriverSettings &settings, const QString &place,
                                        std::chrono::nanoseconds timeout)
{
    QString host;
    quint16 port = 0;
    if (splitHost(place, &host, &port))
        return makeRealLink(settings, host, port, timeout);
    return refuseDevice(
        settings,
        QStringLiteral(
            "%1 is not a host and port; write tcp:192.168.1.20, tcp:drive.local:1502 or tcp:[fe80::1%eth0]:502")
            .arg(quoted(place)));
}

std::unique_ptr<ModbusLink> makeSerialLink(QPlcDriverSettings &settings, const QString &place,
                                           std::chrono::nanoseconds timeout)
{
    ModbusSerialLine line = readSerialLine(settings);
    line.device = place;
    if (place.startsWith(QLatin1Char('/')))
        return makeRealLink(settings, line, timeout);
    return refuseDevice(
        settings,
        QStringLiteral("%1 is not the path of a serial line; write for example rtu:/dev/ttyUSB0").arg(quoted(place)));
}

}  // namespace

std::unique_ptr<ModbusLink> makeModbusLink(QPlcDriverSettings &settings)
{
    const QString device = settings.requiredText(QStringLiteral("device"), QStringLiteral("tcp:192.168.1.20"));
    const std::chrono::nanoseconds timeout = settings.duration(QStringLiteral("response-timeout"), 500ms, 1ms, 60s);
    const QString way = device.section(QLatin1Char(':'), 0, 0);
    const QString place = device.section(QLatin1Char(':'), 1);
    if (device.isEmpty())
        return nullptr;  // an error already
    if (way == QLatin1String("tcp"))
        return makeTcpLink(settings, place, timeout);
    if (way == QLatin1String("rtu"))
        return makeSerialLink(settings, place, timeout);
    if (way == QLatin1String("fake") && !place.isEmpty()) {
        readSerialLine(settings);  // a fake device stands for one of each kind
        return std::make_unique<FakeModbusLink>(place);
    }
    return refuseDevice(
        settings,
        QStringLiteral("%1 is not a Modbus device; write tcp:HOST, tcp:HOST:PORT, rtu:/dev/ttyUSB0 or fake:NAME")
            .arg(quoted(device)));
}

}  // namespace qplc
