// SPDX-License-Identifier: Apache-2.0
#include "DemoPlant.h"
#include "Witness.h"

#include <QtCore/QFile>
#include <QtCore/QTemporaryDir>
#include <QtPlcGui>
#include <QtTest/QtTest>
#include <QtWidgets/QAbstractButton>

#include <array>
#include <cmath>

namespace {

constexpr double Pi = 3.14159265358979323846;

/// Sees what the kite does.
class KiteWitness : public Witness
{
    Q_OBJECT
public:
    ~KiteWitness() override { disconnectFromMaster(); }

    double yawSpeed() const { return m_yawSpeed; }  // [deg/s]
    double turned() const
    {
        return m_turned;
    }  // of the course since the begin, as seen from the winch; > 0 to the left [deg]
    double course() const { return m_course; }  // 0 up, 90 to the left, as seen from the winch [deg]
    bool isCrashed() const { return m_isCrashed; }

private:
    using Vector = std::array<double, 3>;

    void step(const QPlcCycle &cycle) override
    {
        const double course = courseNow();
        m_turned = m_turned + std::remainder(course - m_course, 360.0);
        m_course = course;
        m_yawSpeed = m_yawSpeedInput;
        m_isCrashed = m_isCrashed || m_crashed;
        Witness::step(cycle);
    }
    /// The velocity across the tether: to the left (azimuth grows), and up (elevation grows).
    double courseNow() const
    {
        const Vector &position = m_position, &velocity = m_velocity;
        const double ground = std::hypot(position[0], position[1]);
        const double left = (position[0] * velocity[1] - position[1] * velocity[0]) / ground;
        const double away = (position[0] * velocity[0] + position[1] * velocity[1]) / ground;
        const double up = (ground * velocity[2] - position[2] * away) / std::hypot(ground, position[2]);
        return std::atan2(left, up) * 180.0 / Pi;
    }

    std::atomic<double> m_yawSpeed{0.0};
    std::atomic<double> m_turned{0.0};
    std::atomic<double> m_course{0.0};
    std::atomic<bool> m_isCrashed{false};
    QPlcInput<double> m_yawSpeedInput{this, "bodyControlYawSpeed"};  // [deg/s]
    QPlcInput<Vector> m_position{this, "bodyPosition_earth"};        // [m]
    QPlcInput<Vector> m_velocity{this, "bodyVelocity_earth"};        // [m/s]
    QPlcInput<bool> m_crashed{this, "crashed"};
};

QByteArray layoutText()
{
    QFile file(QStringLiteral(AWE_LAYOUTS "/airborne_wind_energy.json"));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// The button of a panel that a person sees; null when there is none of this text.
QAbstractButton *visibleButton(const QWidget &panel, const QString &text)
{
    for (QAbstractButton *button : panel.findChildren<QAbstractButton *>()) {
        if (button->isVisible() && button->text() == text)
            return button;
    }
    return nullptr;
}

/// Clicks it as soon as it can be. \return false when it does not come
bool click(const QWidget &panel, const QString &text)
{
    const auto isThere = [&] {
        const QAbstractButton *button = visibleButton(panel, text);
        return button && button->isEnabled();
    };
    if (!QTest::qWaitFor(isThere, Program::patience))
        return false;
    QTest::mouseClick(visibleButton(panel, text), Qt::LeftButton);
    return true;
}

}  // namespace

/// The kite of the demo in the hands of a person, with the keys of the layout 'Fly'.
class tst_ManualFlight : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void leftTurnsTheKiteToTheLeftAndTheAutopilotFliesOn();
    void cleanupTestCase();

private:
    QTemporaryDir m_home;  // for the settings of the window
};

void tst_ManualFlight::initTestCase()
{
    QVERIFY(qputenv("XDG_CONFIG_HOME", m_home.path().toUtf8()));
}

void tst_ManualFlight::cleanupTestCase()
{
    QCOMPARE(childrenOf(QCoreApplication::applicationPid()), QList<qint64>());
}

void tst_ManualFlight::leftTurnsTheKiteToTheLeftAndTheAutopilotFliesOn()
{
    awe::DemoPlant demo(QStringLiteral(AWE_PROGRAMS));
    QSignalSpy listening(&demo, &awe::DemoPlant::listening);
    demo.start();
    QVERIFY(listening.wait(Program::patience));
    QPlcControlCenter window;
    QVERIFY(window.addLayout(QStringLiteral("Kite"), layoutText()));
    window.resetLayout();
    const QString plant = window.connectToMaster(demo.address(), QStringLiteral("kite"));
    window.resize(1366, 768);
    window.show();
    window.activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&window));
    QTRY_VERIFY_WITH_TIMEOUT(window.isLive(plant), Program::patience);
    auto *panel = window.findChild<QPlcKeyboardControl *>();
    QVERIFY(panel);
    KiteWitness kite;
    QVERIFY(kite.join(demo.address()));

    // It flies eights: up and to the right is a good moment, since the way to the left goes over
    // the top.
    QTRY_VERIFY_WITH_TIMEOUT(kite.cycles() > 100 && kite.course() < -20.0 && kite.course() > -80.0, Program::patience);
    QVERIFY(click(*panel, QStringLiteral("Take control")));
    QTRY_VERIFY_WITH_TIMEOUT(visibleButton(*panel, QStringLiteral("Give back")), Program::patience);
    QVERIFY(panel->hasFocus());
    QTRY_COMPARE_WITH_TIMEOUT(kite.yawSpeed(), 0.0, Program::patience);
    const double before = kite.turned();
    QTest::keyPress(window.windowHandle(), Qt::Key_Left);
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(kite.turned() - before) > 60.0, Program::patience);
    QVERIFY2(kite.turned() > before, qPrintable(QStringLiteral("turned by %1").arg(kite.turned() - before)));
    QVERIFY(kite.yawSpeed() != 0.0);
    QTest::keyRelease(window.windowHandle(), Qt::Key_Left);
    QTRY_COMPARE_WITH_TIMEOUT(kite.yawSpeed(), 0.0, Program::patience);
    QVERIFY(click(*panel, QStringLiteral("Give back")));
    QTRY_VERIFY_WITH_TIMEOUT(visibleButton(*panel, QStringLiteral("Take control")), Program::patience);
    QTRY_VERIFY_WITH_TIMEOUT(kite.yawSpeed() != 0.0, Program::patience);
    const int cycles = kite.cycles();
    QTRY_VERIFY_WITH_TIMEOUT(kite.cycles() > cycles + 300, Program::patience);
    QVERIFY(!kite.isCrashed());

    window.disconnectFromMaster(plant);  // the panel is calm about it
    QVERIFY(!visibleButton(*panel, QStringLiteral("Take control")));
    kite.disconnectFromMaster();
}

QTEST_MAIN(tst_ManualFlight)
#include "tst_ManualFlight.moc"
