// SPDX-License-Identifier: Apache-2.0
#include "QtCanBus.h"

#include "hardware/HardwareLogging.h"

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
#include <linux/can/error.h>
#include <mutex>
#include <sys/eventfd.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr int qtCanTimeout = 3000;               // [ms] that a plugin may take to connect
constexpr int qtCanFarewell = 100;               // [ms] that it may take to write what is left, and to disconnect
constexpr int qtCanStatusPause = 100;            // [ms] between two looks at the state of the controller
constexpr qint64 qtCanPatience = 1'000'000'000;  // [ns] with errors only

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

CanBus::State stateOfQt(QCanBusDevice::CanBusStatus status, CanBus::State before)
{
    switch (status) {
    case QCanBusDevice::CanBusStatus::Good:
        return CanBus::Active;
    case QCanBusDevice::CanBusStatus::Warning:
        return CanBus::Warning;
    case QCanBusDevice::CanBusStatus::Error:
        return CanBus::Passive;
    case QCanBusDevice::CanBusStatus::BusOff:
        return CanBus::BusOff;
    case QCanBusDevice::CanBusStatus::Unknown:
        break;
    }
    return before;
}

// As the kernel would tell it.
CanFrame frameOfState(CanBus::State state)
{
    static constexpr quint8 controller[]{CAN_ERR_CRTL_ACTIVE, CAN_ERR_CRTL_TX_WARNING, CAN_ERR_CRTL_TX_PASSIVE, 0};
    CanFrame frame;
    frame.flags = CanFrame::Error;
    frame.id = state == CanBus::BusOff ? CAN_ERR_BUSOFF : CAN_ERR_CRTL;
    frame.size = CAN_ERR_DLC;
    frame.data[1] = controller[state];
    frame.time = monotonicNow();
    return frame;
}

// Runs the event loop until something is done, but at most for a time [ms].
template<typename Condition>
void runQtCanLoop(int time, Condition isDone)
{
    QEventLoop loop;
    bool isOver = false;
    QTimer::singleShot(time, &loop, [&isOver] { isOver = true; });
    while (!isOver && !isDone())
        loop.processEvents(QEventLoop::WaitForMoreEvents);
}

}  // namespace

QtCanBus::QtCanBus(const QString &plugin, const QString &interface, TimeSource &time)
    : m_plugin(plugin)
    , m_interface(interface)
    , m_time(time)
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
    m_endedBy = 0;
    m_firstError = 0;
    m_unwritten = 0;
    m_status = Active;
    m_wakeUp = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    const auto answer = std::make_shared<std::promise<QString>>();
    std::future<QString> answered = answer->get_future();
    m_thread = std::thread(
        [this, options, answer] { run(options, [answer](const QString &error) { answer->set_value(error); }); });
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

QString QtCanBus::name() const
{
    return QStringLiteral("qtcan:%1:%2").arg(m_plugin, m_interface);
}

void QtCanBus::run(const Options &options, const Answer &answer)
{
    const QEventLoop events;  // the thread has them from here on: sockets ask when they are made
    QString error;
    const std::unique_ptr<QCanBusDevice> device = makeDevice(&error);
    const bool isConnected = device && configure(device.get(), options, &error) && connectDevice(device.get(), &error);
    answer(error);
    if (isConnected)
        runLoop(device.get());
}

std::unique_ptr<QCanBusDevice> QtCanBus::makeDevice(QString *error) const
{
    static std::mutex mutex;  // Qt Serial Bus loads its plugins when they are asked for, without a lock
    const std::lock_guard<std::mutex> lock(mutex);
    QString reason;
    std::unique_ptr<QCanBusDevice> device(QCanBus::instance()->createDevice(m_plugin, m_interface, &reason));
    if (!device)
        *error = QStringLiteral("Qt Serial Bus has no device '%1' of plugin '%2': %3; there are the plugins %4")
                     .arg(m_interface, m_plugin, reason, QCanBus::instance()->plugins().join(QStringLiteral(", ")));
    return device;
}

bool QtCanBus::configure(QCanBusDevice *device, const Options &options, QString *error) const
{
    const struct
    {
        QCanBusDevice::ConfigurationKey key;
        QVariant value;
        QString name;
    } settings[]{
        // In this order: plugins have other bit rates with CAN FD.
        {QCanBusDevice::CanFdKey, options.needsFd || options.dataBitRate > 0, QStringLiteral("CAN FD")},
        {QCanBusDevice::BitRateKey, options.bitRate, QStringLiteral("bitrate = %1").arg(options.bitRate)},
        {QCanBusDevice::DataBitRateKey, options.dataBitRate,
         QStringLiteral("data-bitrate = %1").arg(options.dataBitRate)},
    };
    bool isTaken = true;
    const QObject here;
    QObject::connect(device, &QCanBusDevice::errorOccurred, &here, [&isTaken] { isTaken = false; });
    for (const auto &setting : settings) {
        if (!setting.value.toBool())
            continue;
        device->setConfigurationParameter(setting.key, setting.value);
        if (!isTaken) {
            *error = QStringLiteral("%1 does not take %2: %3; see what the adapter can do")
                         .arg(name(), setting.name, device->errorString());
            return false;
        }
    }
    return true;
}

bool QtCanBus::connectDevice(QCanBusDevice *device, QString *error) const
{
    if (device->connectDevice())
        runQtCanLoop(qtCanTimeout, [device] { return device->state() != QCanBusDevice::ConnectingState; });
    if (device->state() == QCanBusDevice::ConnectedState)
        return true;
    const QString reason = device->errorString();
    *error = QStringLiteral("%1 cannot be connected: %2; check the adapter, its name and its bit rate")
                 .arg(name(), reason.isEmpty() ? QStringLiteral("it does not answer") : reason);
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
        const bool isLast = m_stop;  // before the frames, so that none is left
        giveFrames(device);
        if (isLast)
            loop.quit();
    });
    QObject::connect(device, &QCanBusDevice::framesReceived, &loop, [this, device] { takeFrames(device); });
    QObject::connect(device, &QCanBusDevice::framesWritten, &loop, [this](qint64 count) {
        m_unwritten -= count;
        m_firstError = 0;
    });
    QObject::connect(device, &QCanBusDevice::errorOccurred, &loop,
                     [this, device](QCanBusDevice::CanBusError error) { noteError(device, error); });
    QObject::connect(device, &QCanBusDevice::stateChanged, &loop, [this](QCanBusDevice::CanBusDeviceState state) {
        if (state == QCanBusDevice::UnconnectedState)
            m_endedBy = ENODEV;
    });
    QTimer statusTimer;
    QObject::connect(&statusTimer, &QTimer::timeout, &loop, [this, device] { lookAtStatus(device); });
    if (device->hasBusStatus())
        statusTimer.start(qtCanStatusPause);
    takeFrames(device);
    loop.exec();
    letGo(device);
}

// What was given to the device last, safe values perhaps, has to leave it; some plugins need the
// event loop for that, and for their end.
void QtCanBus::letGo(QCanBusDevice *device)
{
    runQtCanLoop(qtCanFarewell, [this, device] {
        return device->state() != QCanBusDevice::ConnectedState || (m_unwritten <= 0 && device->framesToWrite() == 0);
    });
    if (device->state() == QCanBusDevice::UnconnectedState)
        return;
    device->disconnectDevice();
    runQtCanLoop(qtCanFarewell, [device] { return device->state() == QCanBusDevice::UnconnectedState; });
}

void QtCanBus::takeFrames(QCanBusDevice *device)
{
    if (device->state() != QCanBusDevice::ConnectedState)
        return;
    const auto frames = device->readAllFrames();
    for (const QCanBusFrame &frame : frames)
        put(frameOfQt(frame));
    if (!frames.isEmpty())
        m_firstError = 0;
}

void QtCanBus::put(const CanFrame &frame) noexcept
{
    if (!m_incoming.push(frame))
        m_lost.fetch_add(1, std::memory_order_relaxed);
}

void QtCanBus::giveFrames(QCanBusDevice *device)
{
    CanFrame frame;
    m_isGiving = true;
    while (m_outgoing.pop(&frame)) {
        ++m_unwritten;  // some plugins tell that it is written before they return
        if (device->writeFrame(qtFrame(frame)))
            continue;
        --m_unwritten;
        m_failed.fetch_add(1, std::memory_order_relaxed);
    }
    m_isGiving = false;
}

void QtCanBus::lookAtStatus(QCanBusDevice *device)
{
    const State state = stateOfQt(device->busStatus(), m_status);
    if (state != m_status)
        put(frameOfState(state));
    m_status = state;
}

void QtCanBus::noteError(const QCanBusDevice *device, int error)
{
    const bool isOfFrames = error == QCanBusDevice::ReadError || error == QCanBusDevice::WriteError;
    if (m_stop || m_endedBy != 0 || !(isOfFrames || error == QCanBusDevice::ConnectionError))
        return;
    if (error == QCanBusDevice::WriteError && !m_isGiving)  // else it is counted there
        m_failed.fetch_add(1, std::memory_order_relaxed);
    const qint64 now = m_time.now();
    if (m_firstError == 0)
        m_firstError = now;
    if (isOfFrames && now - m_firstError < qtCanPatience)
        return;
    qCWarning(lcHardware).noquote() << name() + QLatin1Char(':') << device->errorString();
    m_endedBy = EIO;
}

int QtCanBus::readFrames(CanFrame *frames, int capacity) noexcept
{
    const quint32 lost = m_lost.load(std::memory_order_relaxed);
    countLost(quint32(lost - m_lostSeen));
    m_lostSeen = lost;
    const quint32 failed = m_failed.load(std::memory_order_relaxed);
    countFailed(quint32(failed - m_failedSeen));
    m_failedSeen = failed;
    int count = 0;
    while (count < capacity && m_incoming.pop(&frames[count])) {
        if (accepts(frames[count]))
            ++count;
    }
    const int endedBy = m_endedBy.load(std::memory_order_relaxed);
    return count == 0 && endedBy != 0 ? lose(endedBy) : count;
}

int QtCanBus::writeFrames(const CanFrame *frames, int count) noexcept
{
    const int endedBy = m_endedBy.load(std::memory_order_relaxed);
    if (endedBy != 0)
        return lose(endedBy);
    int sent = 0;
    while (sent < count && m_outgoing.push(frames[sent]))
        ++sent;
    wake();
    return sent;
}

}  // namespace qplc
