// SPDX-License-Identifier: Apache-2.0
#include "QtCanBus.h"

#include "realtime/TimeSource.h"

#include <QtCore/QEventLoop>
#include <QtCore/QSocketNotifier>
#include <QtCore/QTimer>
#include <QtCore/QVariant>
#include <QtSerialBus/QCanBus>
#include <QtSerialBus/QCanBusDevice>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <future>
#include <sys/eventfd.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr int qtCanTimeout = 3000;  // [ms] that a plugin may take to connect

QCanBusFrame qtFrame(const CanFrame &frame)
{
    QCanBusFrame result(frame.id,
                        QByteArray(reinterpret_cast<const char *>(frame.data.data()),
                                   frame.has(CanFrame::Remote) ? 0 : int(frame.size)));
    result.setExtendedFrameFormat(frame.has(CanFrame::Extended));
    result.setFlexibleDataRateFormat(frame.has(CanFrame::Fd));
    result.setBitrateSwitch(frame.has(CanFrame::BitRateSwitch));
    if (frame.has(CanFrame::Remote))
        result.setFrameType(QCanBusFrame::RemoteRequestFrame);
    return result;
}

quint8 flagsOfQtFrame(const QCanBusFrame &frame)
{
    if (frame.frameType() == QCanBusFrame::ErrorFrame)
        return CanFrame::Error;
    return quint8((frame.hasExtendedFrameFormat() ? CanFrame::Extended : 0)
                  | (frame.hasFlexibleDataRateFormat() ? CanFrame::Fd : 0)
                  | (frame.hasBitrateSwitch() ? CanFrame::BitRateSwitch : 0)
                  | (frame.hasErrorStateIndicator() ? CanFrame::ErrorPassive : 0)
                  | (frame.frameType() == QCanBusFrame::RemoteRequestFrame ? CanFrame::Remote : 0));
}

CanFrame frameOfQt(const QCanBusFrame &frame)
{
    CanFrame result;
    result.flags = flagsOfQtFrame(frame);
    result.id = result.has(CanFrame::Error) ? quint32(frame.error()) : frame.frameId();  // the bits are those of Linux
    const QByteArray payload = frame.payload();
    result.size = quint8(std::min(payload.size(), CanFrame::MaximumSize));
    std::memcpy(result.data.data(), payload.constData(), result.size);
    result.time = monotonicNow();
    return result;
}

}  // namespace

QtCanBus::QtCanBus(const QString &plugin, const QString &interface)
    : m_plugin(plugin)
    , m_interface(interface)
{
}

QtCanBus::~QtCanBus()
{
    QtCanBus::close();
}

bool QtCanBus::join(const Options &options)
{
    close();
    m_stop = false;
    m_isGone = false;
    m_wakeUp = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    const auto answer = std::make_shared<std::promise<QString>>();
    std::future<QString> answered = answer->get_future();
    m_thread = std::thread([this, needsFd = options.needsFd, answer] {
        run(needsFd, [answer](const QString &error) { answer->set_value(error); });
    });
    const QString error = answered.get();
    if (error.isEmpty())
        return true;
    close();
    return fail(error);
}

void QtCanBus::close()
{
    if (!m_thread.joinable())
        return;
    m_stop = true;
    wake();
    m_thread.join();
    ::close(m_wakeUp);
    m_wakeUp = -1;
    while (m_incoming.front())
        m_incoming.pop();
    while (m_outgoing.front())
        m_outgoing.pop();
}

void QtCanBus::wake() noexcept
{
    const quint64 one = 1;
    const ssize_t written = write(m_wakeUp, &one, sizeof one);
    Q_UNUSED(written)  // a full counter wakes, too
}

void QtCanBus::run(bool needsFd, const Answer &answer)
{
    QString error;
    const std::unique_ptr<QCanBusDevice> device(QCanBus::instance()->createDevice(m_plugin, m_interface, &error));
    if (!device) {
        answer(QStringLiteral("Qt Serial Bus has no device '%1' of plugin '%2': %3; there are the plugins %4")
                   .arg(m_interface, m_plugin, error, QCanBus::instance()->plugins().join(QStringLiteral(", "))));
        return;
    }
    if (needsFd)
        device->setConfigurationParameter(QCanBusDevice::CanFdKey, QVariant(true));
    const bool isConnected = connectDevice(device.get(), &error);
    answer(error);
    if (isConnected)
        runLoop(device.get());
    device->disconnectDevice();
}

bool QtCanBus::connectDevice(QCanBusDevice *device, QString *error) const
{
    QEventLoop loop;
    QObject::connect(device, &QCanBusDevice::stateChanged, &loop, &QEventLoop::quit);
    QTimer::singleShot(qtCanTimeout, &loop, &QEventLoop::quit);
    const bool isConnecting = device->connectDevice();
    while (isConnecting && device->state() == QCanBusDevice::ConnectingState && loop.exec() == 0) {
        if (device->state() == QCanBusDevice::ConnectingState)
            break;  // by the timer
    }
    if (device->state() == QCanBusDevice::ConnectedState)
        return true;
    const QString reason = device->errorString();
    *error = QStringLiteral("qtcan:%1:%2 cannot be connected: %3; check the adapter and its name")
                 .arg(m_plugin, m_interface, reason.isEmpty() ? QStringLiteral("it does not answer") : reason);
    return false;
}

void QtCanBus::runLoop(QCanBusDevice *device)
{
    QEventLoop loop;
    QSocketNotifier notifier(m_wakeUp, QSocketNotifier::Read);
    QObject::connect(&notifier, &QSocketNotifier::activated, &loop, [this, device, &loop] {
        quint64 count = 0;
        const ssize_t size = read(m_wakeUp, &count, sizeof count);
        Q_UNUSED(size)
        giveFrames(device);
        if (m_stop)
            loop.quit();
    });
    QObject::connect(device, &QCanBusDevice::framesReceived, &loop, [this, device] { takeFrames(device); });
    QObject::connect(device, &QCanBusDevice::stateChanged, &loop, [this](QCanBusDevice::CanBusDeviceState state) {
        m_isGone = state == QCanBusDevice::UnconnectedState;
    });
    takeFrames(device);
    loop.exec();
}

void QtCanBus::takeFrames(QCanBusDevice *device)
{
    const auto frames = device->readAllFrames();
    for (const QCanBusFrame &frame : frames) {
        if (!m_incoming.push(frameOfQt(frame)))
            m_lost.fetch_add(1, std::memory_order_relaxed);
    }
}

void QtCanBus::giveFrames(QCanBusDevice *device)
{
    CanFrame frame;
    while (m_outgoing.pop(&frame))
        device->writeFrame(qtFrame(frame));
}

int QtCanBus::take(CanFrame *frames, int capacity) noexcept
{
    const quint32 lost = m_lost.load(std::memory_order_relaxed);
    countLost(quint32(lost - m_lostSeen));
    m_lostSeen = lost;
    int count = 0;
    while (count < capacity && m_incoming.pop(&frames[count])) {
        if (accepts(frames[count]))
            ++count;
    }
    return count == 0 && m_isGone.load(std::memory_order_relaxed) ? lose(ENODEV) : count;
}

int QtCanBus::give(const CanFrame *frames, int count) noexcept
{
    if (m_isGone.load(std::memory_order_relaxed))
        return lose(ENODEV);
    int sent = 0;
    while (sent < count && m_outgoing.push(frames[sent]))
        ++sent;
    wake();
    return sent;
}

}  // namespace qplc
