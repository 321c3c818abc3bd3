// SPDX-License-Identifier: Apache-2.0
#include "DriveProfile.h"
#include "WinchDrive.h"

#include "Near.h"

#include <algorithm>
#include <functional>
#include <limits>

using namespace awe;

class tst_WinchDrive : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void badParameterIsNamedWithItsRemedy();
    void driveIsDisabledAndHoldsTheTetherBeforeTheFirstCommand();
    void driveFollowsTheSetpoint_data();
    void driveFollowsTheSetpoint();
    void steadyCurrentBalancesForceAndFriction();
    void speedRisesAlongTheRampWithoutOvershoot();
    void loadStepIsHeldWithinAStatedError();
    void currentNeverExceedsItsLimitAndTheDriveRecovers();
    void energyBalanceHoldsToRounding();
    void heatIsNeverNegative();
    void driveGeneratesPowerReelingOutAndConsumesPowerReelingIn();
    void silenceStopsTheDriveAndTheNextCommandStartsItAgain();
    void commandWithoutEnableStopsTheDrive();
    void driveToleratesShortCommandGaps();
    void emergencyStopClosesTheBrakeAtOnce();
    void faultLastsUntilTheEnableCommandIsWithdrawn();
    void overspeedIsAFault();
    void brakeSlipsUnderMoreThanItCanHoldAndHoldsAgain();
    void resetRestoresTheInitialState();
    void theProfileLeadsTheDriveThroughItsStates();
    void everyLossOfTheMasterOfAProfileIsAQuickStopWithinItsRamp_data();
    void everyLossOfTheMasterOfAProfileIsAQuickStopWithinItsRamp();
    void aFaultOfAProfileEndsWithItsReset();

private:
    static WinchDriveInputs command(double speed, double force);
    /// Steps of \a seconds with the same inputs.
    static void run(WinchDrive &drive, const WinchDriveInputs &inputs, double seconds,
                    const std::function<void()> &look = {});
    static WinchDriveInputs silence(double force);
    /// Steps of the drive behind its profile.
    static void run(DriveProfile &profile, WinchDrive &drive, bool isConnected, std::uint16_t controlword,
                    double seconds);
    static void enable(DriveProfile &profile, WinchDrive &drive);
    static constexpr double wantedSpeed = 120.0;  // [rad/s]
};

WinchDriveInputs tst_WinchDrive::command(double speed, double force)
{
    WinchDriveInputs inputs;
    inputs.hasCommand = true;
    inputs.enable = true;
    inputs.speedSetpoint = speed;
    inputs.tetherForce = force;
    return inputs;
}

WinchDriveInputs tst_WinchDrive::silence(double force)
{
    WinchDriveInputs inputs;
    inputs.tetherForce = force;
    return inputs;
}

void tst_WinchDrive::run(WinchDrive &drive, const WinchDriveInputs &inputs, double seconds,
                         const std::function<void()> &look)
{
    const long steps = std::lround(seconds / drive.parameters().step);
    for (long i = 0; i < steps; ++i) {
        drive.step(inputs);
        if (look)
            look();
    }
}

void tst_WinchDrive::badParameterIsNamedWithItsRemedy()
{
    WinchDriveParameters parameters;
    QCOMPARE(parameters.validate(), std::string());
    parameters.drumRadius = std::numeric_limits<double>::quiet_NaN();
    VERIFY_CONTAINS(parameters.validate(), "drumRadius is nan m; choose a value from ");
    parameters = WinchDriveParameters();
    parameters.commandTimeout = 0.0;
    VERIFY_CONTAINS(parameters.validate(), "commandTimeout is 0 s; choose a value from ");
}

void tst_WinchDrive::driveIsDisabledAndHoldsTheTetherBeforeTheFirstCommand()
{
    WinchDrive drive;
    run(drive, silence(5000.0), 1.0);
    QCOMPARE(drive.state(), DriveState::Disabled);
    QVERIFY(drive.isBrakeClosed());
    QCOMPARE(drive.speed(), 0.0);
    QCOMPARE(drive.position(), 0.0);
    QCOMPARE(drive.current(), 0.0);
    QCOMPARE(drive.electricalPower(), 0.0);
}

void tst_WinchDrive::driveFollowsTheSetpoint_data()
{
    QTest::addColumn<double>("speed");
    QTest::addColumn<double>("force");
    QTest::newRow("reeling out") << 65.0 << 1600.0;
    QTest::newRow("reeling out without a load") << 65.0 << 0.0;
    QTest::newRow("standing") << 0.0 << 3000.0;
    QTest::newRow("reeling in") << -133.0 << 200.0;
    QTest::newRow("fast") << 300.0 << 4000.0;
}

void tst_WinchDrive::driveFollowsTheSetpoint()
{
    QFETCH(double, speed);
    QFETCH(double, force);
    WinchDrive drive;
    run(drive, command(speed, force), 5.0);
    QCOMPARE(drive.state(), DriveState::Enabled);
    COMPARE_NEAR(drive.speed(), speed, 1e-6);
    const double before = drive.position();
    run(drive, command(speed, force), 1.0);
    COMPARE_NEAR(drive.position() - before, speed, 1e-5);
}

void tst_WinchDrive::steadyCurrentBalancesForceAndFriction()
{
    const WinchDriveParameters p;
    WinchDrive drive;
    const double speed = 65.0, force = 1600.0;
    run(drive, command(speed, force), 5.0);
    const double torque = p.dryFriction + p.viscousFriction * speed - force * p.drumRadius / p.gearRatio;
    COMPARE_NEAR(drive.current(), torque / p.torqueConstant, 1e-6);
    const double copper = 1.5 * p.windingResistance * drive.current() * drive.current();
    COMPARE_NEAR(drive.electricalPower(), -torque * speed - copper - p.converterLoss, 1e-3);
}

void tst_WinchDrive::speedRisesAlongTheRampWithoutOvershoot()
{
    WinchDrive drive;
    run(drive, command(0.0, 0.0), 0.5);
    double greatest = 0.0;
    run(drive, command(100.0, 0.0), 0.25);  // of 0.5 s that the ramp takes
    COMPARE_NEAR(drive.speed(), 50.0, 3.0);
    run(drive, command(100.0, 0.0), 2.0, [&] { greatest = std::max(greatest, drive.speed()); });
    COMPARE_NEAR(drive.speed(), 100.0, 1e-3);
    QVERIFY2(greatest < 104.0, qPrintable(QString::number(greatest)));
}

/// 1 kN more in one step, which no tether does, moves the machine by less than 5 rad/s (0.15 m/s),
/// and that is over soon.
void tst_WinchDrive::loadStepIsHeldWithinAStatedError()
{
    WinchDrive drive;
    run(drive, command(65.0, 1000.0), 3.0);
    double worst = 0.0;
    run(drive, command(65.0, 2000.0), 0.3, [&] { worst = std::max(worst, std::abs(drive.speed() - 65.0)); });
    QVERIFY2(worst < 5.0 && worst > 0.5, qPrintable(QString::number(worst)));
    COMPARE_NEAR(drive.speed(), 65.0, 0.1);
}

void tst_WinchDrive::currentNeverExceedsItsLimitAndTheDriveRecovers()
{
    WinchDrive drive;
    const double limit = drive.parameters().currentLimit;
    run(drive, command(0.0, 1000.0), 1.0);
    double greatest = 0.0;
    const auto look = [&] { greatest = std::max(greatest, std::abs(drive.current())); };
    run(drive, command(0.0, 9000.0), 0.05, look);  // more than it can hold: it slips
    QVERIFY(drive.speed() > 1.0);
    run(drive, command(0.0, 1000.0), 1.0, look);
    QVERIFY(greatest <= limit && greatest > 0.99 * limit);
    QCOMPARE(drive.state(), DriveState::Enabled);
    COMPARE_NEAR(drive.speed(), 0.0, 0.01);
}

void tst_WinchDrive::energyBalanceHoldsToRounding()
{
    WinchDrive drive;
    for (int i = 0; i < 60000; ++i) {
        const double t = i * drive.parameters().step;
        const double force = 1500.0 + 1200.0 * std::sin(6.0 * t);
        WinchDriveInputs inputs = command(t < 30.0 ? 65.0 : -120.0, force);
        inputs.hasCommand = t < 50.0;  // with a quick stop at the end
        drive.step(inputs);
    }
    const WinchEnergies &e = drive.energies();
    QCOMPARE(drive.state(), DriveState::Disabled);
    const double rest = e.tether - e.electrical - e.copper - e.converter - e.friction - e.brake - drive.kineticEnergy();
    QVERIFY(e.copper > 1e3 && e.friction > 1e3 && e.converter > 1e3);
    COMPARE_NEAR(rest, 0.0, 1e-9 * (std::abs(e.tether) + e.copper + e.friction + e.converter));
}

void tst_WinchDrive::heatIsNeverNegative()
{
    WinchDrive drive;
    WinchEnergies before;
    for (int i = 0; i < 20000; ++i) {
        const double t = i * drive.parameters().step;
        drive.step(command(3.0 * std::sin(25.0 * t), 100.0 + 100.0 * std::sin(40.0 * t)));  // through zero, often
        const WinchEnergies now = drive.energies();
        QVERIFY(now.friction >= before.friction && now.brake >= before.brake && now.copper >= before.copper
                && now.converter >= before.converter);
        before = now;
    }
    QVERIFY(before.friction > 0.0);
}

void tst_WinchDrive::driveGeneratesPowerReelingOutAndConsumesPowerReelingIn()
{
    WinchDrive out;
    run(out, command(65.0, 1600.0), 20.0);
    QVERIFY(out.electricalPower() > 0.8 * 65.0 * 48.0 && out.electricalPower() < 65.0 * 48.0);
    QVERIFY(out.energies().electrical > 0.0 && out.energies().electrical < out.energies().tether);
    WinchDrive in;
    run(in, command(-133.0, 200.0), 20.0);
    QVERIFY(in.electricalPower() < -133.0 * 6.0);
    QVERIFY(in.energies().electrical < in.energies().tether && in.energies().tether < 0.0);
}

void tst_WinchDrive::silenceStopsTheDriveAndTheNextCommandStartsItAgain()
{
    WinchDrive drive;
    run(drive, command(100.0, 1000.0), 2.0);
    run(drive, silence(1000.0), 0.099);
    QCOMPARE(drive.state(), DriveState::Enabled);
    COMPARE_NEAR(drive.speed(), 100.0, 0.1);
    run(drive, silence(1000.0), 0.002);
    QCOMPARE(drive.state(), DriveState::QuickStop);
    QCOMPARE(drive.stop(), DriveStop::CommandLost);
    run(drive, silence(1000.0), 0.5);
    QCOMPARE(drive.state(), DriveState::Disabled);
    QCOMPARE(drive.speed(), 0.0);
    QVERIFY(drive.isBrakeClosed());
    run(drive, command(100.0, 1000.0), 2.0);
    QCOMPARE(drive.state(), DriveState::Enabled);
    COMPARE_NEAR(drive.speed(), 100.0, 0.1);
}

void tst_WinchDrive::commandWithoutEnableStopsTheDrive()
{
    WinchDrive drive;
    run(drive, command(100.0, 1000.0), 2.0);
    WinchDriveInputs off = command(100.0, 1000.0);
    off.enable = false;
    drive.step(off);
    QCOMPARE(drive.state(), DriveState::QuickStop);
    QCOMPARE(drive.stop(), DriveStop::Command);
    run(drive, off, 0.5);
    QCOMPARE(drive.state(), DriveState::Disabled);
    QCOMPARE(drive.speed(), 0.0);
}

void tst_WinchDrive::driveToleratesShortCommandGaps()
{
    WinchDrive drive;
    run(drive, command(100.0, 1000.0), 2.0);
    for (int i = 0; i < 20; ++i) {
        run(drive, silence(1000.0), 0.09);
        drive.step(command(100.0, 1000.0));
    }
    QCOMPARE(drive.state(), DriveState::Enabled);
    COMPARE_NEAR(drive.speed(), 100.0, 0.1);
}

void tst_WinchDrive::emergencyStopClosesTheBrakeAtOnce()
{
    WinchDrive drive;
    run(drive, command(100.0, 1000.0), 2.0);
    WinchDriveInputs pressed = command(100.0, 1000.0);
    pressed.emergencyStop = true;
    drive.step(pressed);
    QCOMPARE(drive.state(), DriveState::Fault);
    QCOMPARE(drive.stop(), DriveStop::EmergencyStop);
    QVERIFY(drive.isBrakeClosed());
    run(drive, pressed, 0.05);
    QCOMPARE(drive.speed(), 0.0);
    QVERIFY(std::abs(drive.current()) < 1e-6);
    QVERIFY(drive.energies().brake > 100.0);
}

void tst_WinchDrive::faultLastsUntilTheEnableCommandIsWithdrawn()
{
    WinchDrive drive;
    WinchDriveInputs inputs = command(100.0, 1000.0);
    inputs.emergencyStop = true;
    run(drive, inputs, 0.1);
    inputs.emergencyStop = false;
    run(drive, inputs, 1.0);
    QCOMPARE(drive.state(), DriveState::Fault);  // nothing moves because a button was released
    inputs.enable = false;
    drive.step(inputs);
    QCOMPARE(drive.state(), DriveState::Disabled);
    inputs.enable = true;
    drive.step(inputs);
    QCOMPARE(drive.state(), DriveState::Enabled);
}

void tst_WinchDrive::overspeedIsAFault()
{
    WinchDrive drive;
    run(drive, command(300.0, 0.0), 3.0);
    run(drive, command(300.0, 20000.0), 0.2);
    QCOMPARE(drive.state(), DriveState::Fault);
    QCOMPARE(drive.stop(), DriveStop::Overspeed);
}

void tst_WinchDrive::brakeSlipsUnderMoreThanItCanHoldAndHoldsAgain()
{
    WinchDrive drive;
    run(drive, silence(11000.0), 0.1);
    QVERIFY(drive.speed() > 0.0);
    run(drive, silence(5000.0), 0.5);
    QCOMPARE(drive.speed(), 0.0);
    QVERIFY(drive.energies().brake > 0.0);
    QCOMPARE(drive.energies().electrical, 0.0);
}

void tst_WinchDrive::resetRestoresTheInitialState()
{
    WinchDrive drive;
    run(drive, command(100.0, 1000.0), 2.0);
    drive.reset();
    QCOMPARE(drive.state(), DriveState::Disabled);
    QCOMPARE(drive.position(), 0.0);
    QCOMPARE(drive.energies().tether, 0.0);
    run(drive, silence(1000.0), 0.5);
    QCOMPARE(drive.state(), DriveState::Disabled);  // the old command is forgotten
}

// ---- CiA 402 ----

void tst_WinchDrive::run(DriveProfile &profile, WinchDrive &drive, bool isConnected, std::uint16_t controlword,
                         double seconds)
{
    const long steps = std::lround(seconds / drive.parameters().step);
    for (long i = 0; i < steps; ++i) {
        profile.step(isConnected, controlword, drive.state());
        WinchDriveInputs inputs = command(wantedSpeed, 500.0);
        inputs.enable = profile.isEnabled();
        drive.step(inputs);
    }
}

void tst_WinchDrive::enable(DriveProfile &profile, WinchDrive &drive)
{
    for (const int controlword : {0x06, 0x07, 0x0F})
        run(profile, drive, true, std::uint16_t(controlword), 0.01);
    run(profile, drive, true, 0x0F, 2.0);
}

void tst_WinchDrive::theProfileLeadsTheDriveThroughItsStates()
{
    WinchDrive drive;
    DriveProfile profile;
    run(profile, drive, true, 0x0F, 0.1);
    QCOMPARE(int(profile.statusword() & 0x4F), 0x40);  // a drive cannot be enabled at once
    run(profile, drive, true, 0x06, 0.1);
    QCOMPARE(int(profile.statusword() & 0x6F), 0x21);
    run(profile, drive, true, 0x07, 0.1);
    QCOMPARE(int(profile.statusword() & 0x6F), 0x23);
    QCOMPARE(drive.state(), DriveState::Disabled);
    run(profile, drive, true, 0x0F, 2.0);
    QCOMPARE(int(profile.statusword() & 0x6F), 0x27);
    COMPARE_NEAR(drive.speed(), wantedSpeed, 1.0);
    run(profile, drive, true, 0x07, 1.0);
    QCOMPARE(int(profile.statusword() & 0x6F), 0x23);
    QCOMPARE(drive.state(), DriveState::Disabled);
}

void tst_WinchDrive::everyLossOfTheMasterOfAProfileIsAQuickStopWithinItsRamp_data()
{
    QTest::addColumn<bool>("isConnected");
    QTest::addColumn<int>("controlword");
    QTest::newRow("its heartbeat or the bus is lost") << false << 0x0F;
    QTest::newRow("it commands the quick stop") << true << 0x02;
}

void tst_WinchDrive::everyLossOfTheMasterOfAProfileIsAQuickStopWithinItsRamp()
{
    QFETCH(bool, isConnected);
    QFETCH(int, controlword);
    WinchDrive drive;
    DriveProfile profile;
    enable(profile, drive);
    COMPARE_NEAR(drive.speed(), wantedSpeed, 1.0);
    const double ramp = wantedSpeed / drive.parameters().stopDeceleration;
    run(profile, drive, isConnected, std::uint16_t(controlword), 0.5 * ramp);
    QVERIFY(drive.speed() > 0.4 * wantedSpeed);  // a ramp, and no blow
    QCOMPARE(int(profile.statusword() & 0x6F), 0x07);
    run(profile, drive, isConnected, std::uint16_t(controlword), 0.5 * ramp + 0.05);
    QVERIFY(std::abs(drive.speed()) < 1.0);
    run(profile, drive, isConnected, std::uint16_t(controlword), 0.1);
    QCOMPARE(int(profile.statusword() & 0x4F), 0x40);
    QVERIFY(drive.isBrakeClosed());
}

void tst_WinchDrive::aFaultOfAProfileEndsWithItsReset()
{
    WinchDrive drive;
    DriveProfile profile;
    enable(profile, drive);
    WinchDriveInputs inputs = command(wantedSpeed, 0.0);
    inputs.emergencyStop = true;
    drive.step(inputs);
    run(profile, drive, true, 0x0F, 2.0);
    QCOMPARE(int(profile.statusword() & 0x4F), 0x08);
    run(profile, drive, true, 0x80, 0.01);
    QCOMPARE(int(profile.statusword() & 0x4F), 0x40);
}

QTEST_APPLESS_MAIN(tst_WinchDrive)
#include "tst_WinchDrive.moc"
