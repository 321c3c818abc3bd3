// SPDX-License-Identifier: Apache-2.0
#include "TestCanPlugin.h"

#include <QtCore/QTimer>
#include <QtSerialBus/QCanBusFactoryV2>

namespace {

TestCanDevice *theDevice = nullptr;

}  // namespace

TestCanDevice::Play &TestCanDevice::play()
{
    static Play play;
    return play;
}

void TestCanDevice::ask(const std::function<void(TestCanDevice &)> &what)
{
    QMetaObject::invokeMethod(
        theDevice, [&what] { what(*theDevice); }, Qt::BlockingQueuedConnection);
}

TestCanDevice::TestCanDevice()
{
    theDevice = this;
    setCanBusStatusGetter([] { return play().status; });
}

TestCanDevice::~TestCanDevice()
{
    theDevice = nullptr;
}

void TestCanDevice::setConfigurationParameter(int key, const QVariant &value)
{
    if (key == BitRateKey && value.toInt() == play().refusedBitRate)
        setError(QStringLiteral("no such rate"), ConfigurationError);
    else
        play().configuration.insert(key, value);
}

bool TestCanDevice::open()
{
    setState(ConnectedState);
    return true;
}

bool TestCanDevice::writeFrame(const QCanBusFrame &frame)
{
    switch (play().manner) {
    case Refused:
        tellError(WriteError);
        return false;
    case Failed:
        QTimer::singleShot(1, this, [this] { tellError(WriteError); });
        return true;
    case Written:
        enqueueOutgoingFrame(frame);
        writeNext();
        return true;
    case Later:
        QTimer::singleShot(5, this, &TestCanDevice::writeNext);
        break;
    case Never:
        break;
    }
    enqueueOutgoingFrame(frame);
    return true;
}

void TestCanDevice::writeNext()
{
    play().written.append(dequeueOutgoingFrame().frameId());
    Q_EMIT framesWritten(1);
}

class TestCanPlugin : public QObject, public QCanBusFactoryV2
{
    Q_OBJECT
    Q_PLUGIN_METADATA(IID "org.qt-project.Qt.QCanBusFactory" FILE "test_can_plugin.json")
    Q_INTERFACES(QCanBusFactoryV2)

public:
    QCanBusDevice *createDevice(const QString &, QString *) const override { return new TestCanDevice; }
    QList<QCanBusDeviceInfo> availableDevices(QString *) const override { return {}; }
};

#include "TestCanPlugin.moc"
