// SPDX-License-Identifier: Apache-2.0
#include "CanOpenClient.h"

#include "realtime/TimeSource.h"

#include <algorithm>
#include <cerrno>
#include <poll.h>

namespace qplc {

namespace {

constexpr quint32 pdoNoRemote = 1U << 30;                     // it cannot be asked for by a remote frame
constexpr std::chrono::nanoseconds longestPause{1'000'000};   // between two looks at a bus without a descriptor
constexpr std::chrono::nanoseconds longestWait{100'000'000};  // until it is asked whether to end
constexpr int mostFrames = 4096;                              // that are taken at once, so that it ends

QString hexText(quint32 number)
{
    return QString::asprintf("0x%08X", number);
}

}  // namespace

CanOpenClient::CanOpenClient(CanBus &bus, const QString &device, int node, std::chrono::nanoseconds answerTime)
    : m_bus(bus)
    , m_device(device)
    , m_node(node)
    , m_answerTime(answerTime)
    , m_end(monotonicNow() + std::chrono::nanoseconds(MostTime).count())
{
}

QString CanOpenClient::title() const
{
    return QStringLiteral("node %1 at %2").arg(m_node).arg(m_device);
}

bool CanOpenClient::fail(const QString &error)
{
    m_error = error;
    return false;
}

// ---- frames ----

bool CanOpenClient::send(const CanFrame &frame)
{
    const qint64 end = monotonicNow() + m_answerTime.count();
    for (;;) {
        const int sent = m_bus.send(&frame, 1);
        if (sent == 1)
            return true;
        if (sent < 0)
            return fail(QStringLiteral("the bus %1 is lost (%2); plug its adapter in and bring it up")
                            .arg(m_device, qt_error_string(m_bus.errorNumber())));
        if (monotonicNow() >= end)
            return fail(
                QStringLiteral("the bus %1 takes no frame; check wires, terminators and bit rate").arg(m_device));
        waitForFrames(longestPause);
    }
}

void CanOpenClient::waitForFrames(std::chrono::nanoseconds time) const
{
    pollfd descriptor{m_bus.descriptor(), POLLIN, 0};
    const std::chrono::nanoseconds pause = std::min(time, descriptor.fd >= 0 ? longestWait : longestPause);
    const timespec duration = timeSpec(std::max<qint64>(0, pause.count()));
    ::ppoll(&descriptor, 1, &duration, nullptr);
}

bool CanOpenClient::receive(SdoTransfer *transfer)
{
    CanFrame frame;
    for (int i = 0; i < mostFrames; ++i) {
        const int count = m_bus.receive(&frame, 1);
        if (count < 0)
            return fail(QStringLiteral("the bus %1 is lost (%2); plug its adapter in and bring it up")
                            .arg(m_device, qt_error_string(m_bus.errorNumber())));
        if (count == 0)
            return true;
        const bool isAnswer = frame.key() == CanOpenIds::SdoResponse + quint32(m_node) && frame.size == SdoFrame::Size
            && !frame.has(CanFrame::Error) && !frame.has(CanFrame::Remote);
        if (isAnswer && transfer) {
            if (transfer->take(SdoFrame::fromFrame(frame)))
                return true;
        } else if (m_listener && !isAnswer) {
            m_listener(frame);
        }
    }
    return true;
}

bool CanOpenClient::waitUntil(const std::function<bool()> &isDone, std::chrono::nanoseconds time)
{
    const qint64 end = monotonicNow() + time.count();
    while (!isDone()) {
        const qint64 left = end - monotonicNow();
        if (left <= 0 || failAtEnd())
            return false;
        waitForFrames(std::chrono::nanoseconds(left));
        if (!receive(nullptr))
            return false;
    }
    return true;
}

/// \return whether waiting ends early
bool CanOpenClient::failAtEnd()
{
    const bool isEnding = m_isEnding && m_isEnding();
    if (isEnding)
        fail(QStringLiteral("%1 was given up, because its node ends").arg(title()));
    return isEnding;
}

bool CanOpenClient::command(NmtCommand command)
{
    return send(nmtFrame(command, m_node));
}

// ---- SDO ----

// One attempt. \return false: the device did not answer, or the bus is lost
bool CanOpenClient::exchange(SdoTransfer *transfer)
{
    const auto nextEnd = [this] { return std::min<qint64>(monotonicNow() + m_answerTime.count(), m_end); };
    qint64 end = nextEnd();
    while (transfer->state() == SdoTransfer::Running || transfer->hasRequest()) {
        if (failAtEnd())
            return false;
        if (transfer->hasRequest()) {
            if (!send(SdoFrame::toFrame(CanOpenIds::SdoRequest + quint32(m_node), transfer->request())))
                return false;
            transfer->sent();
            end = nextEnd();
            continue;
        }
        const qint64 left = end - monotonicNow();
        if (left <= 0) {
            transfer->abort(SdoAbort::TimedOut);
            continue;
        }
        waitForFrames(std::chrono::nanoseconds(left));
        if (!receive(transfer))
            return false;
    }
    return true;
}

bool CanOpenClient::run(SdoTransfer *transfer)
{
    const SdoTransfer begin = *transfer;
    m_abortCode = 0;
    for (int attempt = 0; attempt < Attempts; ++attempt) {
        *transfer = begin;
        if (!exchange(transfer))
            return false;
        if (transfer->state() == SdoTransfer::Done)
            return true;
        m_abortCode = transfer->abortCode();
        if (m_abortCode != SdoAbort::TimedOut)
            break;
    }
    const QString what = transfer->isWrite() ? QStringLiteral("write") : QStringLiteral("read");
    if (m_abortCode == SdoAbort::TimedOut)
        return fail(
            QStringLiteral("%1 does not answer (SDO, object %2); is it switched on, and are its node id and the "
                           "bit rate right?")
                .arg(title(), transfer->address().toText()));
    return fail(
        QStringLiteral("%1 refuses to %2 object %3: %4 (abort code %5); look at the key that names it, and into "
                       "the manual of the device")
            .arg(title(), what, transfer->address().toText(), SdoTransfer::abortText(m_abortCode),
                 hexText(m_abortCode)));
}

bool CanOpenClient::read(ObjectAddress address, QByteArray *value)
{
    SdoTransfer transfer = SdoTransfer::read(address);
    if (!run(&transfer))
        return false;
    *value = transfer.value();
    return true;
}

bool CanOpenClient::readNumber(ObjectAddress address, quint32 *value)
{
    QByteArray bytes;
    if (!read(address, &bytes))
        return false;
    *value = quint32(fromLittleEndian(bytes));
    return true;
}

CanOpenEmergency CanOpenClient::readError()
{
    CanOpenEmergency emergency;
    quint32 errors = 0;
    quint32 newest = 0;  // code of the newest error, and information of the manufacturer
    if (!readNumber({0x1001, 0}, &errors) || errors == 0)
        return emergency;
    const bool isKnown = readNumber({0x1003, 1}, &newest) && newest != 0;
    emergency.errorRegister = quint8(errors);
    emergency.code = isKnown ? quint16(newest) : CanOpenEmergency::GenericError;
    emergency.manufacturer[0] = quint8(newest >> 16);
    emergency.manufacturer[1] = quint8(newest >> 24);
    return emergency;
}

bool CanOpenClient::write(ObjectAddress address, const QByteArray &value)
{
    SdoTransfer transfer = SdoTransfer::write(address, value);
    return run(&transfer);
}

bool CanOpenClient::writeNumber(ObjectAddress address, quint64 bits, int size)
{
    return write(address, littleEndian(bits, size));
}

// ---- configuration ----

bool CanOpenClient::configure(const CanOpenConfiguration &plan)
{
    if (!checkIdentity(plan.identity))
        return false;
    if (plan.isAxis)
        stopDrive();
    for (const CanOpenSetting &setting : plan.startValues) {
        if (!write(setting.address, setting.value))
            return false;
    }
    for (const Pdo &pdo : plan.pdos) {
        if (!configurePdo(pdo))
            return false;
    }
    int pdo = 0;
    int entry = 0;
    const bool needsMode = plan.isAxis && !plan.find(QStringLiteral("6060:00"), false, &pdo, &entry);
    if (needsMode && !writeNumber({0x6060, 0}, quint8(plan.mode), 1))
        return false;
    return configureHeartbeats(plan);
}

// A drive that another program has left running brakes before it is configured, also if it refuses
// the configuration.
void CanOpenClient::stopDrive()
{
    constexpr quint16 quickStop = 0x0002;  // of the controlword
    writeNumber({0x6040, 0}, quickStop, 2);
}

bool CanOpenClient::checkIdentity(const CanOpenIdentity &identity)
{
    quint32 vendor = 0;  // it is read in any case: is the device there?
    return readNumber({0x1018, 1}, &vendor) && checkNumber("vendor", 1, identity.vendor)
        && checkNumber("product", 2, identity.product) && checkNumber("revision", 3, identity.revision)
        && checkNumber("serial", 4, identity.serial);
}

bool CanOpenClient::checkNumber(const char *what, quint8 sub, quint32 wanted)
{
    quint32 is = 0;
    if (wanted == 0)
        return true;
    if (!readNumber({0x1018, sub}, &is))
        return false;
    return is == wanted
        || fail(QStringLiteral(
                    "%1 is another device: its %2 is %3, and the configuration wants %4; look at the node id, "
                    "or correct the key '%2' or the EDS file")
                    .arg(title(), QLatin1String(what), hexText(is), hexText(wanted)));
}

// The order of CiA 301: switch it off, then change it, then switch it on.
bool CanOpenClient::configurePdo(const Pdo &pdo)
{
    const auto at = [](quint16 index, int sub) { return ObjectAddress{index, quint8(sub)}; };
    const quint16 communication = pdo.communicationIndex();
    const quint16 mapping = pdo.mappingIndex();
    quint32 before = 0;
    if (pdo.isFixed)
        return true;
    if (!readNumber(at(communication, 1), &before))
        return false;
    const quint32 id = pdo.id | (before & pdoNoRemote);
    if (!writeNumber(at(communication, 1), id | Pdo::IsOff, 4)
        || !writeNumber(at(communication, 2), quint64(pdo.transmission), 1))
        return false;
    if (pdo.isTransmit && !pdo.isSynchronous() && pdo.eventTime > 0
        && !writeNumber(at(communication, 5), quint64(pdo.eventTime), 2))
        return false;
    if (!writeNumber(at(mapping, 0), 0, 1))
        return false;
    for (int i = 0; i < pdo.entries.size(); ++i) {
        if (!writeNumber(at(mapping, i + 1), pdo.entries.at(i).mapping(), 4))
            return false;
    }
    return writeNumber(at(mapping, 0), quint64(pdo.entries.size()), 1) && writeNumber(at(communication, 1), id, 4);
}

// Each hears the other, and stops after two periods without it.
bool CanOpenClient::configureHeartbeats(const CanOpenConfiguration &plan)
{
    const auto period = quint64(plan.heartbeat.count());
    if (!writeNumber({0x1017, 0}, period, 2))
        return false;
    if (plan.master == 0)
        return true;
    if (writeNumber({0x1016, 1}, quint64(plan.master) << 16 | 2 * period, 4))
        return true;
    const bool hasNone = m_abortCode == SdoAbort::NoObject || m_abortCode == SdoAbort::NoSubindex;
    return hasNone
        ? fail(QStringLiteral("%1 cannot hear the heartbeat of the master (it has no object 1016:01), and so "
                              "would not stop when the master is lost; give it another watchdog, and write "
                              "'master = 0'")
                   .arg(title()))
        : false;
}

}  // namespace qplc
