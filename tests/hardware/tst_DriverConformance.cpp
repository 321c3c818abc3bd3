// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "DriverBench.h"
#include "FakeDevices.h"
#include "conformance/CanOpenTestDevices.h"
#include "conformance/CanTestDevices.h"
#include "conformance/GpioTestDevices.h"
#include "conformance/I2cTestDevices.h"
#include "conformance/ModbusTestDevices.h"
#include "conformance/SerialTestDevices.h"
#include "conformance/SpiTestDevices.h"
#include "conformance/SysfsTestDevices.h"

#include <mutex>

using namespace std::chrono_literals;
using qplc::monotonicNow;

namespace {

/// A driver, its device, and all wires between.
struct Rig
{
    explicit Rig(std::unique_ptr<TestDevice> testDevice)
        : device(std::move(testDevice))
        , bench(device->kind(), device->keys())
    {
        errors = bench.errors();
        for (const QString &input : device->inputs())
            errors += bench.wireRead(input);
        for (const QString &output : device->outputs())
            errors += bench.wireWrite(output);
    }

    void give(double value)
    {
        for (const QString &input : device->inputs())
            device->give(input, value);
    }
    void set(double value, bool isSafe)
    {
        for (const QString &output : device->outputs())
            bench.set(output, value, isSafe);
    }
    bool hasTaken(double value)
    {
        for (const QString &output : device->outputs()) {
            if (device->taken(output) != value)
                return false;
        }
        return true;
    }

    // ---- step by step ----
    /// \return whether the device is still open
    bool step()
    {
        if (!bench.isOnline())
            return false;
        device->live();
        bench.advance(1ms);
        return bench.exchange();
    }
    bool isFresh() const
    {
        bool isAll = true;
        for (const QString &input : device->inputs())
            isAll = isAll && bench.isFresh(input);
        return isAll;
    }
    bool hasFresh(double value) const
    {
        bool isAll = true;
        for (const QString &input : device->inputs())
            isAll = isAll && std::abs(bench.value(input) - value) < 1e-9;
        return isAll;
    }

    // ---- with the thread of the driver ----
    void start()
    {
        bench.runner().start([this](const QString &text) {
            const std::lock_guard lock(mutex);
            reports << text;
        });
    }
    void cycle()
    {
        device->live();
        bench.runner().write(monotonicNow());
        bench.runner().read(monotonicNow());
    }
    bool isFreshInCycle()
    {
        cycle();
        return bench.runner().sample(0, monotonicNow()).isFresh;
    }
    bool takesInCycle(double value)
    {
        cycle();
        return hasTaken(value);
    }
    QStringList told()
    {
        const std::lock_guard lock(mutex);
        return reports;
    }

    std::unique_ptr<TestDevice> device;
    std::mutex mutex;
    QStringList reports;
    QString errors;
    DriverBench bench;  // the last one: it stops its thread first
};

}  // namespace

/// What every driver has to do, for every driver.
class tst_DriverConformance : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void everyDriverKindIsTested();
    void valuesArriveFresh_data() { addRows(); }
    void valuesArriveFresh();
    void aSilentDeviceHasNoFreshValues_data() { addRows(&TestDevice::isEverSilent); }
    void aSilentDeviceHasNoFreshValues();
    void aMissingDeviceIsNamedWithARemedy_data() { addRows(&TestDevice::isPluggable); }
    void aMissingDeviceIsNamedWithARemedy();
    void unpluggedDeviceIsDetectedAndReconnects_data() { addRows(&TestDevice::isPluggable); }
    void unpluggedDeviceIsDetectedAndReconnects();
    void aMissingDeviceIsOpenedAgainAndAgain_data() { addRows(&TestDevice::isPluggable); }
    void aMissingDeviceIsOpenedAgainAndAgain();
    void outputsStayUnchangedUntilTheirValueIsKnown_data() { addRows(&TestDevice::hasOutputs); }
    void outputsStayUnchangedUntilTheirValueIsKnown();
    void outputsAreSafeBeforeTheFirstCycle_data() { addRows(&TestDevice::hasOutputs); }
    void outputsAreSafeBeforeTheFirstCycle();
    void outputsAreSafeAgainAtTheEnd_data() { addRows(&TestDevice::hasOutputs); }
    void outputsAreSafeAgainAtTheEnd();
    void reconnectedDeviceGetsCurrentOutputs_data() { addRows(&TestDevice::hasOutputsAndIsPluggable); }
    void reconnectedDeviceGetsCurrentOutputs();

private:
    /// A row for each device that is fit for it.
    void addRows(bool (TestDevice::*isFit)() const = nullptr)
    {
        QTest::addColumn<QString>("row");
        for (auto row = m_devices.cbegin(); row != m_devices.cend(); ++row) {
            const std::unique_ptr<TestDevice> device = row.value()();
            if (!isFit || (device.get()->*isFit)())
                QTest::newRow(qPrintable(row.key())) << row.key();
        }
    }
    std::unique_ptr<TestDevice> deviceOfRow() const
    {
        QFETCH(QString, row);
        const std::unique_ptr<TestDevice> last = m_devices[row]();
        last->unplug();  // of the last test
        return m_devices[row]();
    }

    const FakeDevices m_fakes;
    TestDevices m_devices;
};

void tst_DriverConformance::initTestCase()
{
    addCanDevices(&m_devices);
    addCanOpenDevices(&m_devices);
    addGpioDevices(&m_devices);
    addI2cDevices(&m_devices);
    addModbusDevices(&m_devices);
    addSerialDevices(&m_devices);
    addSpiDevices(&m_devices);
    addSysfsDevices(&m_devices);
}

void tst_DriverConformance::everyDriverKindIsTested()
{
    QStringList kinds;
    for (const auto &make : m_devices)
        kinds << make()->kind();
    for (const QString &kind : qplc::DriverCatalog::instance().kinds().keys())
        QVERIFY2(kinds.contains(kind), qPrintable(kind + " has no device for this test"));
}

void tst_DriverConformance::valuesArriveFresh()
{
    Rig rig(deviceOfRow());
    QCOMPARE(rig.errors, QString());
    QVERIFY(rig.device->plugIn());
    QVERIFY2(rig.bench.open(), qPrintable(rig.bench.errorString()));
    for (const double value : rig.device->values()) {
        rig.give(value);
        QTRY_VERIFY(rig.step() && rig.hasFresh(value));
    }
}

void tst_DriverConformance::aSilentDeviceHasNoFreshValues()
{
    Rig rig(deviceOfRow());
    QVERIFY(rig.device->plugIn());
    rig.give(rig.device->values().first());
    QVERIFY2(rig.bench.open(), qPrintable(rig.bench.errorString()));
    QTRY_VERIFY(rig.step() && rig.isFresh());
    QVERIFY(rig.device->fallSilent());
    // What was under way may still come.
    const auto hasGoneOld = [&] {
        if (!rig.step())
            return !rig.isFresh();
        rig.bench.advance(3s);
        return !rig.step() || !rig.isFresh();
    };
    QTRY_VERIFY(hasGoneOld());
}

void tst_DriverConformance::aMissingDeviceIsNamedWithARemedy()
{
    Rig rig(deviceOfRow());
    QVERIFY(rig.device->unplug());
    QVERIFY(!rig.bench.open());
    QVERIFY(!rig.bench.isOnline());
    const QString error = rig.bench.errorString();
    QVERIFY2(error.contains(rig.device->name()), qPrintable(error));
    QVERIFY2(error.contains(QLatin1String("; ")), qPrintable(error));  // what, and behind that the remedy
}

void tst_DriverConformance::unpluggedDeviceIsDetectedAndReconnects()
{
    Rig rig(deviceOfRow());
    QVERIFY(rig.device->plugIn());
    rig.give(rig.device->values().first());
    QVERIFY2(rig.bench.open(), qPrintable(rig.bench.errorString()));
    QTRY_VERIFY(rig.step() && rig.isFresh());
    QVERIFY(rig.device->unplug());
    QVERIFY(!rig.step());
    QVERIFY(!rig.isFresh());
    QVERIFY2(rig.bench.errorString().contains(rig.device->name()), qPrintable(rig.bench.errorString()));
    rig.bench.close();
    QVERIFY(!rig.bench.open());
    QVERIFY(rig.device->plugIn());
    rig.give(rig.device->values().last());
    QVERIFY2(rig.bench.open(), qPrintable(rig.bench.errorString()));
    QTRY_VERIFY(rig.step() && rig.hasFresh(rig.device->values().last()));
}

void tst_DriverConformance::aMissingDeviceIsOpenedAgainAndAgain()
{
    Rig rig(deviceOfRow());
    QVERIFY(rig.device->unplug());
    rig.start();
    QTRY_VERIFY(rig.told().value(0).contains(rig.device->name()));
    QVERIFY(!rig.bench.isOnline());
    QVERIFY(rig.device->plugIn());
    rig.give(rig.device->values().first());
    QTRY_VERIFY(rig.isFreshInCycle());
    QTRY_COMPARE(rig.told().last(), QString());
    QVERIFY(rig.device->unplug());
    QTRY_VERIFY(!rig.isFreshInCycle() && !rig.told().last().isEmpty());
    QTRY_COMPARE(rig.bench.runner().failures(), quint64(1));
    QVERIFY(rig.device->plugIn());
    rig.give(rig.device->values().first());
    QTRY_VERIFY(rig.isFreshInCycle());
    rig.bench.runner().stop();
}

void tst_DriverConformance::outputsStayUnchangedUntilTheirValueIsKnown()
{
    Rig rig(deviceOfRow());
    QVERIFY(rig.device->plugIn());
    const auto before = rig.device->taken(rig.device->outputs().first());
    QVERIFY2(rig.bench.open(), qPrintable(rig.bench.errorString()));
    QVERIFY(rig.step());
    QCOMPARE(rig.device->taken(rig.device->outputs().first()).value_or(-1e9), before.value_or(-1e9));
}

void tst_DriverConformance::outputsAreSafeBeforeTheFirstCycle()
{
    Rig rig(deviceOfRow());
    QVERIFY(rig.device->plugIn());
    const double safe = rig.device->values().first();
    rig.set(safe, true);
    rig.bench.runner().leave(monotonicNow());
    rig.start();
    QTRY_VERIFY(rig.hasTaken(safe));
    rig.bench.runner().stop();
}

void tst_DriverConformance::outputsAreSafeAgainAtTheEnd()
{
    Rig rig(deviceOfRow());
    QVERIFY(rig.device->plugIn());
    const double safe = rig.device->values().first();
    const double computed = rig.device->values().last();
    rig.set(safe, true);
    rig.start();
    QTRY_VERIFY(rig.takesInCycle(safe));
    rig.set(computed, false);
    QTRY_VERIFY(rig.takesInCycle(computed));
    rig.set(safe, true);
    rig.bench.runner().leave(monotonicNow());
    if (!rig.device->remembersOutputs())
        QTRY_VERIFY(rig.hasTaken(safe));
    rig.bench.runner().stop();
    if (rig.device->remembersOutputs())
        QVERIFY(rig.hasTaken(safe));
}

// A value from before it was lost must not come first.
void tst_DriverConformance::reconnectedDeviceGetsCurrentOutputs()
{
    Rig rig(deviceOfRow());
    QVERIFY(rig.device->plugIn());
    const double safe = rig.device->values().first();
    const double computed = rig.device->values().last();
    rig.set(computed, false);
    QVERIFY2(rig.bench.open(), qPrintable(rig.bench.errorString()));
    QVERIFY(rig.step());
    QVERIFY(rig.hasTaken(computed));
    QVERIFY(rig.device->unplug());
    QVERIFY(!rig.step());
    rig.bench.close();
    rig.set(safe, true);
    rig.bench.runner().write(rig.bench.now());
    QVERIFY(rig.device->plugIn());
    QVERIFY2(rig.bench.open(), qPrintable(rig.bench.errorString()));
    const auto taken = rig.device->taken(rig.device->outputs().first());
    QVERIFY(!taken || *taken == safe);
    QVERIFY(rig.step());
    QVERIFY(rig.hasTaken(safe));
}

QTEST_GUILESS_MAIN(tst_DriverConformance)
#include "tst_DriverConformance.moc"
