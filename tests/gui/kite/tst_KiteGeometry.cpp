// SPDX-License-Identifier: Apache-2.0
#include "kite/ColorScale.h"
#include "kite/KiteGeometry.h"
#include "kite/KiteSettings.h"
#include "kite/WindWindowDrawing.h"

#include <QtTest/QtTest>

#include <cmath>

using namespace awe;

namespace {

constexpr float close = 1e-4f;

bool isNear(const QVector3D &a, const QVector3D &b, float tolerance = close)
{
    return (a - b).length() <= tolerance;
}

bool isNear(const QPointF &a, const QPointF &b, double tolerance = 1e-3)
{
    return std::hypot(a.x() - b.x(), a.y() - b.y()) <= tolerance;
}

QByteArray text(const QVector3D &v)
{
    return QStringLiteral("(%1, %2, %3)").arg(double(v.x())).arg(double(v.y())).arg(double(v.z())).toUtf8();
}

}  // namespace

class tst_KiteGeometry : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void aPositionIsAzimuthElevationAndDistance();
    void positionSurvivesConversionToTheSkyAndBack();
    void anglesAreWrapped();
    void nosePointsToTheZenithAtZeroPitchAndYaw();
    void bodyAxesAgreeWithThePlant_data();
    void bodyAxesAgreeWithThePlant();
    void theDownwindDirectionIsTheMiddleOfTheHorizon();
    void largerAzimuthsAreToTheLeftWhenLookingDownwind();
    void theDistanceOnPaperIsTheAngleToTheWind();
    void directionsOnPaperFollowTheSky();
    void aTetherBeginsAtTheWinchAndEndsAtTheKite();
    void slackTetherSagsAndKeepsItsLength();
    void colorsEndWhereTheScaleEnds();
    void scalesHaveRoundEnds_data();
    void scalesHaveRoundEnds();
    void settingsAreRestoredAndDefaultsAreNotWritten();
    void invalidSettingsGetTheirDefaults();
    void theHalfCircleFitsIntoAnyPanel_data();
    void theHalfCircleFitsIntoAnyPanel();
};

void tst_KiteGeometry::aPositionIsAzimuthElevationAndDistance()
{
    const SkyPosition sky = skyPosition({0, 100, 100});
    QCOMPARE(sky.azimuth, 90.0f);
    QCOMPARE(sky.elevation, 45.0f);
    QCOMPARE(sky.distance, std::sqrt(20000.0f));
    QCOMPARE(skyPosition({0, 0, 0}).distance, 0.0f);
    QCOMPARE(skyPosition({0, 0, -5}).elevation, -90.0f);
}

void tst_KiteGeometry::positionSurvivesConversionToTheSkyAndBack()
{
    for (const QVector3D &point : {QVector3D(100, 0, 0), QVector3D(-30, 40, 12), QVector3D(1, -2, -3)})
        QVERIFY2(isNear(positionOf(skyPosition(point)), point, 1e-3f), text(positionOf(skyPosition(point))));
}

void tst_KiteGeometry::anglesAreWrapped()
{
    QCOMPARE(wrappedAngle(190), -170.0);
    QCOMPARE(wrappedAngle(-180), 180.0);
    QCOMPARE(wrappedAngle(180), 180.0);
    QCOMPARE(wrappedAngle(725), 5.0);
}

void tst_KiteGeometry::nosePointsToTheZenithAtZeroPitchAndYaw()
{
    const QVector3D position = positionOf({0, 30, 100});
    const QQuaternion body = bodyOrientation(positionOrientation(position), {});
    const QVector3D nose = body.rotatedVector({-1, 0, 0});
    const QVector3D top = body.rotatedVector({0, 0, 1});
    QVERIFY2(isNear(nose, {-std::sin(float(M_PI) / 6), 0, std::cos(float(M_PI) / 6)}), text(nose));
    QVERIFY2(isNear(top, position.normalized()), text(top));
}

void tst_KiteGeometry::bodyAxesAgreeWithThePlant_data()
{
    QTest::addColumn<float>("azimuth");
    QTest::addColumn<float>("elevation");
    QTest::addColumn<float>("pitch");
    QTest::addColumn<float>("yaw");
    QTest::newRow("level") << 0.0f << 30.0f << 0.0f << 0.0f;
    QTest::newRow("aside") << 40.0f << 20.0f << 8.5f << 90.0f;
    QTest::newRow("reel-in") << -70.0f << 65.0f << -90.0f << -20.0f;
    QTest::newRow("behind") << 179.0f << 5.0f << 20.0f << 200.0f;
}

/// x_b, y_b, z_b from e_r, e_u, e_a as the plant has them, without matrices.
void tst_KiteGeometry::bodyAxesAgreeWithThePlant()
{
    QFETCH(float, azimuth);
    QFETCH(float, elevation);
    QFETCH(float, pitch);
    QFETCH(float, yaw);
    const auto cosine = [](float degrees) { return std::cos(qDegreesToRadians(degrees)); };
    const auto sine = [](float degrees) { return std::sin(qDegreesToRadians(degrees)); };
    const QVector3D away = positionOf({azimuth, elevation, 1});
    const QVector3D up(-sine(elevation) * cosine(azimuth), -sine(elevation) * sine(azimuth), cosine(elevation));
    const QVector3D left(-sine(azimuth), cosine(azimuth), 0);
    const QVector3D back = sine(yaw) * left - cosine(yaw) * up;
    const QQuaternion body = bodyOrientation({0, 90 - elevation, azimuth}, {0, pitch, yaw});
    QVERIFY(isNear(body.rotatedVector({1, 0, 0}), cosine(pitch) * back - sine(pitch) * away));
    QVERIFY(isNear(body.rotatedVector({0, 1, 0}), sine(yaw) * up + cosine(yaw) * left));
    QVERIFY(isNear(body.rotatedVector({0, 0, 1}), sine(pitch) * back + cosine(pitch) * away));
    const QQuaternion course = courseOrientation({0, 90 - elevation, azimuth}, yaw);
    QVERIFY(isNear(course.rotatedVector({1, 0, 0}), back));
    QVERIFY(isNear(course.rotatedVector({0, 0, 1}), away));
}

void tst_KiteGeometry::theDownwindDirectionIsTheMiddleOfTheHorizon()
{
    QVERIFY(isNear(windWindowPoint(31, 0,
                                   downwindAzimuth({6 * std::cos(qDegreesToRadians(31.0f)),
                                                    6 * std::sin(qDegreesToRadians(31.0f)), 0})),
                   {0, 0}));
    QCOMPARE(downwindAzimuth({0, 0, 0}), 0.0f);
}

void tst_KiteGeometry::largerAzimuthsAreToTheLeftWhenLookingDownwind()
{
    // The wind blows to the east; north is to the left.
    QVERIFY(isNear(windWindowPoint(90, 0, 0), {-90, 0}));
    QVERIFY(isNear(windWindowPoint(-30, 0, 0), {30, 0}));
    QVERIFY(isNear(windWindowPoint(-170, 0, 150), {-40, 0}));
}

void tst_KiteGeometry::theDistanceOnPaperIsTheAngleToTheWind()
{
    QVERIFY(isNear(windWindowPoint(0, 90, 0), {0, 90}));
    QVERIFY(isNear(windWindowPoint(0, 35, 0), {0, 35}));
    const QPointF point = windWindowPoint(40, 25, 0);
    const double angle
        = qRadiansToDegrees(std::acos(std::cos(qDegreesToRadians(40.0)) * std::cos(qDegreesToRadians(25.0))));
    QCOMPARE(std::round(std::hypot(point.x(), point.y()) * 1e3), std::round(angle * 1e3));
    QVERIFY(std::isfinite(windWindowPoint(180, 0, 0).x()));
}

void tst_KiteGeometry::directionsOnPaperFollowTheSky()
{
    const QVector3D position = positionOf({0, 20, 100});
    QVERIFY(isNear(windWindowDirection(position, {0, 1, 0}, 0), {-1, 0}, 0.02));
    QVERIFY(isNear(windWindowDirection(position, {0, 0, 1}, 0), {0, 1}, 0.02));
    QCOMPARE(windWindowDirection(position, position, 0), QPointF());
    QCOMPARE(windWindowDirection({}, {1, 0, 0}, 0), QPointF());
}

void tst_KiteGeometry::aTetherBeginsAtTheWinchAndEndsAtTheKite()
{
    const QVector3D kite(80, 20, 60);
    for (const float length : {0.0f, kite.length(), 150.0f}) {
        QVERIFY(isNear(tetherPoint(kite, length, 0, 20), {}));
        QVERIFY(isNear(tetherPoint(kite, length, 19, 20), kite));
    }
}

void tst_KiteGeometry::slackTetherSagsAndKeepsItsLength()
{
    const QVector3D kite(100, 0, 0);
    constexpr int count = 200;
    float length = 0;
    for (int i = 1; i < count; ++i)
        length += (tetherPoint(kite, 104, i, count) - tetherPoint(kite, 104, i - 1, count)).length();
    QVERIFY2(std::abs(length - 104.0f) < 0.5f, QByteArray::number(double(length)));
    QVERIFY(tetherPoint(kite, 104, count / 2, count).z() < tetherPoint(kite, 100, count / 2, count).z());
}

void tst_KiteGeometry::colorsEndWhereTheScaleEnds()
{
    const ColorScale scale{0, 10};
    QCOMPARE(scale.color(-5), scale.color(0));
    QCOMPARE(scale.color(99), scale.color(10));
    QVERIFY(scale.color(0) != scale.color(5));
    QVERIFY(scale.color(5) != scale.color(10));
    QVERIFY(scale.color(std::numeric_limits<double>::quiet_NaN()).saturation() < 60);
    QCOMPARE(ColorScale({3, 3}).color(3), scale.color(5));
}

void tst_KiteGeometry::scalesHaveRoundEnds_data()
{
    QTest::addColumn<double>("from");
    QTest::addColumn<double>("to");
    QTest::addColumn<double>("minimum");
    QTest::addColumn<double>("maximum");
    QTest::newRow("power") << -180.0 << 3891.0 << -2000.0 << 4000.0;
    QTest::newRow("small") << 0.0011 << 0.0034 << 0.001 << 0.004;
    QTest::newRow("one value") << 5.0 << 5.0 << 4.5 << 5.5;
    QTest::newRow("nothing") << 1.0 << -1.0 << 0.0 << 1.0;
    QTest::newRow("infinite") << -double(INFINITY) << 1.0 << 0.0 << 1.0;
}

void tst_KiteGeometry::scalesHaveRoundEnds()
{
    QFETCH(double, from);
    QFETCH(double, to);
    const ColorScale scale = ColorScale::around(from, to);
    QTEST(scale.minimum, "minimum");
    QTEST(scale.maximum, "maximum");
}

void tst_KiteGeometry::settingsAreRestoredAndDefaultsAreNotWritten()
{
    QCOMPARE(KiteSettings().toJson(), QJsonObject());
    const QJsonObject json{{"position", "east/kite.position"}, {"color", ""}, {"trail", 120}, {"maximum", 4000}};
    QJsonObject rest;
    QCOMPARE(KiteSettings::fromJson(json, &rest).toJson(), json);
    QVERIFY(rest.isEmpty());
}

void tst_KiteGeometry::invalidSettingsGetTheirDefaults()
{
    QJsonObject rest;
    const KiteSettings settings
        = KiteSettings::fromJson({{"trail", -4}, {"minimum", "low"}, {"position", 7}, {"unknown", true}}, &rest);
    QCOMPARE(settings.trail, 0.0);
    QVERIFY(!settings.minimum);
    QCOMPARE(settings.position, KiteSettings().position);
    QCOMPARE(rest, QJsonObject({{"unknown", true}}));
}

void tst_KiteGeometry::theHalfCircleFitsIntoAnyPanel_data()
{
    QTest::addColumn<QSize>("size");
    for (const QSize &size : {QSize(240, 160), QSize(640, 480), QSize(300, 700), QSize(1366, 200)})
        QTest::addRow("%d x %d", size.width(), size.height()) << size;
}

void tst_KiteGeometry::theHalfCircleFitsIntoAnyPanel()
{
    QFETCH(QSize, size);
    const WindWindowFrame frame(size, 12);
    const QRectF panel(QPointF(), size);
    for (const QPointF &edge : {QPointF(-90, 0), QPointF(90, 0), QPointF(0, 90), QPointF(0, -5)})
        QVERIFY(panel.contains(frame.toPixels(edge)));
    QVERIFY(frame.toPixels(QPointF(90, 0)).x() > frame.toPixels(QPointF(0, 0)).x());
    QVERIFY(frame.toPixels(QPointF(0, 90)).y() < frame.toPixels(QPointF(0, 0)).y());
}

QTEST_GUILESS_MAIN(tst_KiteGeometry)
#include "tst_KiteGeometry.moc"
