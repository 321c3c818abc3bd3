// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../../common/Waiting.h"
#include "NodeFixtures.h"
#include "gui/panel/WindowContext.h"
#include "kite/KiteGeometry.h"

#include <cmath>

/// The signals of a kite, named as in the example.
inline QPlcSignalTable kiteTable()
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni("[bodyPosition_earth]\ntype = RealTriple\nunit = m\n"
                                                           "[bodyVelocity_earth]\ntype = RealTriple\nunit = m/s\n"
                                                           "[windVelocity_earth]\ntype = RealTriple\nunit = m/s\n"
                                                           "[bodyControlOrientation]\ntype = RealTriple\nunit = deg\n"
                                                           "[bodyPositionOrientation]\ntype = RealTriple\nunit = deg\n"
                                                           "[aerodynamicForce_earth]\ntype = RealTriple\nunit = N\n"
                                                           "[tetherLength]\ntype = Real\nunit = m\n"
                                                           "[power]\ntype = Real\nunit = W\n",
                                                           &errors);
    Q_ASSERT_X(errors.isEmpty(), "kiteTable", qPrintable(QPlcParseError::toString(errors)));
    return table;
}

/// Circles at elevation 35 deg downwind of a wind to the east, 100 m away; a second for 90 deg.
class CirclingKite : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    CirclingKite()
        : QPlcCompactSlaveNode(QStringLiteral("Kite"))
    {
    }
    bool isStanding = false;  // stays in the middle, its nose to the zenith

protected:
    void reset() override { m_angle = 0.0; }
    void step(const QPlcCycle &cycle) override
    {
        using namespace awe;
        m_angle = isStanding ? 0.0 : m_angle + cycle.dt() * 1.57;
        const float radius = isStanding ? 0.0f : 15.0f;
        const auto azimuth = float(radius * std::cos(m_angle));
        const auto elevation = float(35 + radius * std::sin(m_angle));
        const QVector3D position = positionOf({azimuth, elevation, 100});
        m_position = triple(position);
        m_velocity = std::array<double, 3>{0.0, 10.0 * -std::sin(m_angle), 10.0 * std::cos(m_angle)};
        m_wind = std::array<double, 3>{8.0, 0.0, 0.0};
        m_control = std::array<double, 3>{0.0, 8.5, isStanding ? 0.0 : 90.0 + m_angle * 57.3};
        m_sky = std::array<double, 3>{0.0, 90.0 - double(elevation), double(azimuth)};
        m_force = triple(12.0f * position);
        m_length = 100.0;
        m_power = 1500.0 + 1500.0 * std::sin(m_angle);
    }

private:
    static std::array<double, 3> triple(const QVector3D &v) { return {double(v.x()), double(v.y()), double(v.z())}; }

    double m_angle = 0.0;  // [rad]
    QPlcOutput<std::array<double, 3>> m_position{this, "bodyPosition_earth"};
    QPlcOutput<std::array<double, 3>> m_velocity{this, "bodyVelocity_earth"};
    QPlcOutput<std::array<double, 3>> m_wind{this, "windVelocity_earth"};
    QPlcOutput<std::array<double, 3>> m_control{this, "bodyControlOrientation"};
    QPlcOutput<std::array<double, 3>> m_sky{this, "bodyPositionOrientation"};
    QPlcOutput<std::array<double, 3>> m_force{this, "aerodynamicForce_earth"};
    QPlcOutput<double> m_length{this, "tetherLength"};
    QPlcOutput<double> m_power{this, "power"};
};

/// A master in this process whose kite flies in real time, and a window that sees it.
struct FlyingPlant
{
    explicit FlyingPlant(bool isStanding = false, const QString &kind = QStringLiteral("local"))
        : master(QPlcClock::realTime(), kiteTable())
    {
        kite.isStanding = isStanding;
        master.setInterval(std::chrono::milliseconds(10));
        QVERIFY(master.listen());
        QVERIFY(master.admit(kite, kind));
    }
    ~FlyingPlant() { kite.disconnectFromMaster(); }

    /// Connects, starts, and waits for values.
    bool fly()
    {
        context.plants()->add(QStringLiteral("127.0.0.1:%1").arg(master.serverPort()));
        qplc::Plant *plant = context.plants()->at(0);
        if (!waitUntil([plant] { return plant->nextAction() == qplc::Plant::Start; }, 10'000))
            return false;
        plant->start();
        return waitUntil([plant] { return plant->store() && plant->store()->endRow() > 20; }, 10'000);
    }

    CirclingKite kite;
    TestMaster master;
    qplc::WindowContext context;
};

/// Pixels of an area that are as \a matches says.
template<typename Matches>
int countPixels(const QImage &image, const QRect &area, Matches matches)
{
    int count = 0;
    const QRect inside = area.intersected(image.rect());
    for (int y = inside.top(); y <= inside.bottom(); ++y) {
        for (int x = inside.left(); x <= inside.right(); ++x)
            count += matches(image.pixelColor(x, y)) ? 1 : 0;
    }
    return count;
}
