// SPDX-License-Identifier: Apache-2.0
#include "gui/panel/Theme.h"
#include "gui3d/FramePacer.h"
#include "gui3d/LineBatch.h"
#include "gui3d/ObjMesh.h"
#include "gui3d/OrbitCamera.h"
#include "gui3d/SceneDrawing.h"
#include "gui3d/SceneEntity.h"
#include "gui3d/View3DOverlay.h"
#include "gui3d/View3DSettings.h"
#include "kite/KiteGeometry.h"

#include <QtCore/QJsonArray>
#include <QtTest/QtTest>

#include <cmath>
#include <set>

using namespace awe;
using namespace qplc;

namespace {

const QSizeF screen(640, 480);
const QVector<View3DPart> parts{{QStringLiteral("ground"), {}}, {QStringLiteral("axes"), {}}};

OrbitCamera camera(OrbitCamera::Preset preset)
{
    OrbitCamera result;
    result.preset = preset;
    return result;
}

OrbitCamera::Scene sceneWithKite()
{
    OrbitCamera::Scene scene;
    scene.size = 100;
    scene.heading = 30;
    scene.body = positionOf({30, 30, 90});
    scene.course = courseOrientation(positionOrientation(scene.body), 90);
    return scene;
}

}  // namespace

class tst_SceneGeometry : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void everyPresetShowsTheKiteAndAllExceptChaseShowTheWinch_data();
    void everyPresetShowsTheKiteAndAllExceptChaseShowTheWinch();
    void groundStationCameraCentersTheDownwindDirection();
    void topCameraShowsDownwindUpwards();
    void theChaseCameraStandsBehindAndOutside();
    void upIsAcrossTheLineOfSight();
    void draggingTurnsAndHasLimits();
    void draggingSidewaysMovesThePictureWithTheMouse();
    void zoomHasLimits();
    void theSceneGrowsInStepsAndDoesNotFlicker();
    void pointsBehindTheCameraAreNotProjected();
    void aLineIsFourVerticesWithItsSides();
    void indicesMakeTwoTrianglesOfEachLine();
    void zeroLengthArrowIsNotDrawn();
    void sceneWithoutBodyDrawsOnlyTheGround();
    void distantKiteIsEnlargedAndNearKiteIsNot();
    void aModelIsReadWithItsColorsNormalsAndLines();
    void aBrokenModelIsRefusedWithLineAndReason_data();
    void aBrokenModelIsRefusedWithLineAndReason();
    void aMissingModelIsNamed();
    void entitiesAreMarksLinesAndArrowsAtSignals();
    void invalidEntitiesAreIgnoredAndMissingSignalsAreNamed();
    void settingsAreRestoredAndDefaultsAreNotWritten();
    void invalidSettingsGetTheirDefaults();
    void picturesComeAtMostThirtyTimesASecondAndLessWhenTheyCostMuch();
    void lengthsOfTheScaleAreRound();
};

void tst_SceneGeometry::everyPresetShowsTheKiteAndAllExceptChaseShowTheWinch_data()
{
    QTest::addColumn<int>("preset");
    for (int i = 0; i < OrbitCamera::presets; ++i)
        QTest::newRow(qPrintable(OrbitCamera::presetText(OrbitCamera::Preset(i)))) << i;
}

void tst_SceneGeometry::everyPresetShowsTheKiteAndAllExceptChaseShowTheWinch()
{
    QFETCH(int, preset);
    const OrbitCamera::Scene scene = sceneWithKite();
    const CameraPose pose = camera(OrbitCamera::Preset(preset)).pose(scene);
    const QRectF all(QPointF(), screen);
    const auto kite = projected(pose, scene.body, screen);
    QVERIFY(kite && all.contains(*kite));
    const auto winch = projected(pose, {}, screen);
    QCOMPARE(winch && all.contains(*winch), preset != OrbitCamera::Chase);
    QCOMPARE(OrbitCamera::presetOf(OrbitCamera::presetText(OrbitCamera::Preset(preset))), OrbitCamera::Preset(preset));
}

void tst_SceneGeometry::groundStationCameraCentersTheDownwindDirection()
{
    const CameraPose pose = camera(OrbitCamera::GroundStation).pose(sceneWithKite());
    const QPointF downwind = *projected(pose, positionOf({30, 20, 90}), screen);
    const QPointF left = *projected(pose, positionOf({60, 20, 90}), screen);
    const QPointF higher = *projected(pose, positionOf({30, 50, 90}), screen);
    QVERIFY(std::abs(downwind.x() - 320) < 1);
    QVERIFY(left.x() < 250);
    QVERIFY(higher.y() < downwind.y() - 20);
}

void tst_SceneGeometry::topCameraShowsDownwindUpwards()
{
    const CameraPose pose = camera(OrbitCamera::Top).pose(sceneWithKite());
    const QPointF winch = *projected(pose, {}, screen);
    const QPointF downwind = *projected(pose, positionOf({30, 0, 50}), screen);
    QVERIFY(std::abs(downwind.x() - winch.x()) < 1);
    QVERIFY(downwind.y() < winch.y() - 30);
}

void tst_SceneGeometry::theChaseCameraStandsBehindAndOutside()
{
    const OrbitCamera::Scene scene = sceneWithKite();
    const CameraPose pose = camera(OrbitCamera::Chase).pose(scene);
    const QVector3D toEye = scene.course.conjugated().rotatedVector(pose.eye - scene.body);
    QVERIFY(toEye.x() > 0);  // x_b points to the tail
    QVERIFY(toEye.z() > 0);  // away from the ground station
    QVERIFY(std::abs(toEye.y()) < 1e-3f);
    const QPointF ahead = *projected(pose, scene.body + scene.course.rotatedVector({-3, 0, 0}), screen);
    QVERIFY(ahead.y() < 240);
}

void tst_SceneGeometry::upIsAcrossTheLineOfSight()
{
    for (int i = 0; i < OrbitCamera::presets; ++i) {
        const CameraPose pose = camera(OrbitCamera::Preset(i)).pose(sceneWithKite());
        const QVector3D sight = (pose.target - pose.eye).normalized();
        QVERIFY(std::abs(QVector3D::dotProduct(sight, pose.up)) < 1e-4f);
        QVERIFY(std::abs(pose.up.length() - 1) < 1e-4f);
    }
}

void tst_SceneGeometry::draggingTurnsAndHasLimits()
{
    OrbitCamera turned;
    turned.drag({480, 0}, 480);
    QCOMPARE(std::abs(turned.yaw), 180.0f);
    turned.drag({0, 1e6}, 480);
    const CameraPose pose = turned.pose(sceneWithKite());
    QVERIFY(pose.eye.z() > pose.target.z());
    QVERIFY(std::abs((pose.eye - pose.target).normalized().z() - 1) < 1e-4f);  // straight from above, not beyond
    QVERIFY(turned.isMoved());
    QVERIFY(!OrbitCamera().isMoved());
}

void tst_SceneGeometry::draggingSidewaysMovesThePictureWithTheMouse()
{
    for (const auto preset : {OrbitCamera::GroundStation, OrbitCamera::Chase}) {
        const OrbitCamera::Scene scene = sceneWithKite();
        OrbitCamera moved = camera(preset);
        const QVector3D point = moved.pose(scene).target;
        moved.dragSideways({50, 30}, screen.height());
        const QPointF place = *projected(moved.pose(scene), point, screen);
        QVERIFY2(std::abs(place.x() - 370) < 1.5 && std::abs(place.y() - 270) < 1.5,
                 qPrintable(QStringLiteral("%1 %2").arg(place.x()).arg(place.y())));
    }
}

void tst_SceneGeometry::zoomHasLimits()
{
    OrbitCamera near;
    near.zoomBy(2);
    QCOMPARE(near.pose(sceneWithKite()).distance() * 2, OrbitCamera().pose(sceneWithKite()).distance());
    near.zoomBy(1e9);
    QCOMPARE(near.zoom, 40.0f);
    near.zoomBy(0);
    QCOMPARE(near.zoom, 0.1f);
}

void tst_SceneGeometry::theSceneGrowsInStepsAndDoesNotFlicker()
{
    QCOMPARE(roundSceneSize(90, 0), 100.0f);
    QCOMPARE(roundSceneSize(101, 100), 150.0f);
    QCOMPARE(roundSceneSize(99, 150), 150.0f);
    QCOMPARE(roundSceneSize(70, 150), 100.0f);
    QCOMPARE(roundSceneSize(1234, 0), 1300.0f);
    QCOMPARE(roundSceneSize(0, 0), 100.0f);
    QCOMPARE(roundSceneSize(NAN, 200), 200.0f);
}

void tst_SceneGeometry::pointsBehindTheCameraAreNotProjected()
{
    const CameraPose pose = OrbitCamera().pose(sceneWithKite());
    QVERIFY(!projected(pose, pose.eye - (pose.target - pose.eye), screen));
    const QPointF middle = *projected(pose, pose.target, screen);
    QVERIFY(std::abs(middle.x() - 320) < 0.5 && std::abs(middle.y() - 240) < 0.5);
}

void tst_SceneGeometry::aLineIsFourVerticesWithItsSides()
{
    LineBatch batch;
    batch.addLine({1, 2, 3}, {4, 5, 6}, Qt::red, 2);
    QCOMPARE(batch.lines(), 1);
    const std::vector<LineBatch::Vertex> &v = batch.vertices();
    QCOMPARE(v[0].position[0], 1.0f);
    QCOMPARE(v[0].otherEnd[2], 6.0f);
    QCOMPARE(v[3].position[0], 4.0f);
    // Along the line the sides are the same at both ends, so that the edge of the strip is the edge
    // of the line.
    QCOMPARE(v[0].side[0], v[2].side[0]);
    QCOMPARE(v[1].side[0], v[3].side[0]);
    QCOMPARE(v[0].side[1], -v[2].side[1]);
    QCOMPARE(batch.vertexBytes().size(), int(4 * 13 * sizeof(float)));
}

void tst_SceneGeometry::indicesMakeTwoTrianglesOfEachLine()
{
    const QByteArray bytes = LineBatch::indexBytes(2);
    QCOMPARE(bytes.size(), int(12 * sizeof(quint32)));
    const auto *index = reinterpret_cast<const quint32 *>(bytes.constData());
    QCOMPARE(std::set<quint32>(index, index + 6), std::set<quint32>({0, 1, 2, 3}));
    QCOMPARE(std::set<quint32>(index + 6, index + 12), std::set<quint32>({4, 5, 6, 7}));
    QVERIFY(LineBatch::indexBytes(0).isEmpty());
}

void tst_SceneGeometry::zeroLengthArrowIsNotDrawn()
{
    LineBatch batch;
    batch.addArrow({1, 1, 1}, {1, 1, 1}, Qt::red, 1, 1);
    QCOMPARE(batch.lines(), 0);
    batch.addArrow({}, {0, 0, 5}, Qt::red, 1, 1);
    QVERIFY(batch.lines() > 1);
    for (const LineBatch::Vertex &vertex : batch.vertices())
        QVERIFY(std::isfinite(vertex.position[0]) && vertex.position[2] <= 5.0f);
}

void tst_SceneGeometry::sceneWithoutBodyDrawsOnlyTheGround()
{
    QPlcScene3D scene;
    scene.theme = Theme::byName(Theme::Light);
    View3DSettings settings;
    const auto drawn = [&] {
        drawBody(&scene, settings, {});
        return scene.content().lines.lines();
    };
    QCOMPARE(drawn(), 0);
    LineBatch ground;
    drawGround(&ground, scene, settings);
    QVERIFY(ground.lines() > 100);
    scene.position = QVector3D(50, 0, 50);
    scene.orientation = QQuaternion();
    settings.hidden = QStringList{QStringLiteral("ground"), QStringLiteral("axes")};
    ground.clear();
    drawGround(&ground, scene, settings);
    QCOMPARE(ground.lines(), 0);
    QCOMPARE(drawn(), 0);
    settings.hidden.clear();
    QVERIFY(drawn() > 10);
}

void tst_SceneGeometry::distantKiteIsEnlargedAndNearKiteIsNot()
{
    const OrbitCamera::Scene scene = sceneWithKite();
    QVERIFY(visibleBodyScale(camera(OrbitCamera::Side).pose(scene), scene.body, 1.0f) > 2.0f);
    QCOMPARE(visibleBodyScale(camera(OrbitCamera::Chase).pose(scene), scene.body, scene.bodySize), 1.0f);
    QCOMPARE(visibleBodyScale(OrbitCamera().pose(scene), scene.body, 0.0f), 1.0f);
}

void tst_SceneGeometry::aModelIsReadWithItsColorsNormalsAndLines()
{
    QString error;
    const ObjMesh mesh
        = ObjMesh::fromText("# a square and its diagonal\nmtllib x.mtl\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                            "vn 0 0 2\nvt 0 0\nf 1/1/1 2//1 3/1/1 -1\n\nl 1 3 4\n",
                            &error);
    QCOMPARE(error, QString());
    QCOMPARE(mesh.triangles.size(), std::size_t(6));
    QCOMPARE(mesh.lines.size(), std::size_t(2));
    QCOMPARE(mesh.triangles[0].color, QVector3D(1, 0, 0));
    QCOMPARE(mesh.triangles[0].normal, QVector3D(0, 0, 1));
    QCOMPARE(mesh.triangles[5].normal, QVector3D(0, 0, 1));  // that of the face
    QCOMPARE(mesh.lines[1].second, QVector3D(0, 1, 0));
    QCOMPARE(mesh.radius(), std::sqrt(2.0f));
}

void tst_SceneGeometry::aBrokenModelIsRefusedWithLineAndReason_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("error");
    QTest::newRow("empty") << QByteArray() << QStringLiteral("neither faces nor lines");
    QTest::newRow("vertices only") << QByteArray("v 1 2 3\n") << QStringLiteral("neither faces nor lines");
    QTest::newRow("no number") << QByteArray("v 1 two 3\n") << QStringLiteral("line 1: 'two' is not a number");
    QTest::newRow("infinite") << QByteArray("v 1 inf 3\n") << QStringLiteral("line 1: 'inf'");
    QTest::newRow("no such vertex") << QByteArray("v 0 0 0\nf 1 2 3\n")
                                    << QStringLiteral("line 2: there is no vertex '2'");
    QTest::newRow("vertex 0") << QByteArray("v 0 0 0\nf 0 1 1\n") << QStringLiteral("no vertex '0'");
    QTest::newRow("too far back") << QByteArray("v 0 0 0\nl -2 1\n") << QStringLiteral("no vertex '-2'");
    QTest::newRow("two corners") << QByteArray("v 0 0 0\nf 1 1\n") << QStringLiteral("three corners");
    QTest::newRow("binary") << QByteArray("\0\1\2f\nf\n", 6) << QStringLiteral("three corners");
}

void tst_SceneGeometry::aBrokenModelIsRefusedWithLineAndReason()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, error);
    QString seen;
    QVERIFY(ObjMesh::fromText(text, &seen).isEmpty());
    QVERIFY2(seen.contains(error), qPrintable(seen));
}

void tst_SceneGeometry::aMissingModelIsNamed()
{
    QString error;
    QVERIFY(ObjMesh::fromFile(QStringLiteral("/nowhere/a.obj"), &error).isEmpty());
    QVERIFY(error.contains(QStringLiteral("/nowhere/a.obj")));
}

void tst_SceneGeometry::entitiesAreMarksLinesAndArrowsAtSignals()
{
    const QVector3D body(10, 20, 30);
    const QJsonArray json{QJsonObject{{"at", QJsonArray{1, 2, 3}}, {"name", "mast"}},
                          QJsonObject{{"at", "buoy"}, {"to", QJsonArray{0, 0, 0}}, {"color", "#00ff00"}},
                          QJsonObject{{"vector", "force"}, {"scale", 0.5}},
                          QJsonObject{{"at", "buoy"}, {"vector", "force"}}};
    const auto vectorOf
        = [](const QString &name) { return name == QLatin1String("buoy") ? QVector3D(5, 6, 7) : QVector3D(0, 0, 8); };
    QStringList missing;
    const std::vector<SceneEntity> all = SceneEntity::read(json, body, vectorOf, &missing);
    QCOMPARE(int(all.size()), 4);
    QVERIFY(missing.isEmpty());
    QCOMPARE(all[0].kind, SceneEntity::Mark);
    QCOMPARE(all[0].from, QVector3D(1, 2, 3));
    QCOMPARE(all[0].name, QStringLiteral("mast"));
    QCOMPARE(all[1].kind, SceneEntity::Line);
    QCOMPARE(all[1].from, QVector3D(5, 6, 7));
    QCOMPARE(all[1].to, QVector3D());
    QCOMPARE(all[1].color, QColor(0, 255, 0));
    QCOMPARE(all[2].kind, SceneEntity::Arrow);
    QCOMPARE(all[2].from, body);
    QCOMPARE(all[2].to, QVector3D(10, 20, 34));
    QCOMPARE(all[3].to, QVector3D(5, 6, 15));
    LineBatch arrow;
    arrow.addArrow({}, {0, 0, 8}, Qt::red, 2, 3);
    QPlcScene3D scene;
    drawEntities(&scene, all);
    QCOMPARE(scene.content().lines.lines(), 3 + 1 + 2 * arrow.lines());
    QCOMPARE(int(scene.content().labels.size()), 1);
    QCOMPARE(scene.content().labels[0].text, QStringLiteral("mast"));
    QCOMPARE(scene.content().labels[0].place, QVector3D(1, 2, 3));
}

void tst_SceneGeometry::invalidEntitiesAreIgnoredAndMissingSignalsAreNamed()
{
    const QJsonArray json{1,
                          "kite",
                          QJsonObject{{"at", QJsonArray{1, 2}}},
                          QJsonObject{{"at", 7}},
                          QJsonObject{{"at", QJsonArray{1, "x", 3}}},
                          QJsonObject{{"at", "gone"}},
                          QJsonObject{{"vector", "gone"}},
                          QJsonObject{{"to", "lost"}},
                          QJsonObject{{"at", ""}}};
    QStringList missing;
    const auto nothing = [](const QString &) { return std::optional<QVector3D>(); };
    QVERIFY(SceneEntity::read(json, {}, nothing, &missing).empty());
    QCOMPARE(missing, (QStringList{QStringLiteral("gone"), QStringLiteral("lost")}));
    const QJsonObject settings{{"entities", json}};
    QJsonObject rest = settings;
    QCOMPARE(View3DSettings::fromJson(settings, parts, &rest).toJson(),
             settings);  // kept, also what nobody understands
}

void tst_SceneGeometry::settingsAreRestoredAndDefaultsAreNotWritten()
{
    QCOMPARE(View3DSettings().toJson(), QJsonObject());
    const QJsonObject json{
        {"camera", "chase"}, {"view", QJsonObject{{"yaw", 12.5}, {"zoom", 2}, {"pan", QJsonArray{0.1, 0, -0.2}}}},
        {"model", "a.obj"},  {"bodyScale", 3},
        {"axes", false},     {"position", "buoy"}};
    QJsonObject rest;
    const View3DSettings settings = View3DSettings::fromJson(json, parts, &rest);
    QCOMPARE(QJsonDocument(settings.toJson()).toJson(), QJsonDocument(json).toJson());
    QVERIFY(rest.isEmpty());
    QCOMPARE(settings.camera.preset, OrbitCamera::Chase);
    QVERIFY(settings.isShown(QStringLiteral("ground")));
}

void tst_SceneGeometry::invalidSettingsGetTheirDefaults()
{
    QJsonObject rest;
    const QJsonObject json{{"camera", 7}, {"view", "far"}, {"bodyScale", 1e9}, {"ground", "yes"}, {"new", 1}};
    const View3DSettings settings = View3DSettings::fromJson(json, parts, &rest);
    QVERIFY(!settings.camera.isMoved());
    QCOMPARE(settings.camera.preset, OrbitCamera::GroundStation);
    QCOMPARE(settings.bodyScale, View3DSettings::largestBodyScale);
    QVERIFY(settings.isShown(QStringLiteral("ground")));
    QCOMPARE(rest, QJsonObject({{"new", 1}}));
}

void tst_SceneGeometry::picturesComeAtMostThirtyTimesASecondAndLessWhenTheyCostMuch()
{
    FramePacer pacer;
    QCOMPARE(pacer.interval(), FramePacer::shortestInterval);
    for (int i = 0; i < 50; ++i)
        pacer.frameDone(1, 8);
    QCOMPARE(pacer.interval(), FramePacer::shortestInterval);
    for (int i = 0; i < 50; ++i)
        pacer.frameDone(1, 60);
    QVERIFY(std::abs(pacer.interval() - 100) < 1);
    for (int i = 0; i < 50; ++i)
        pacer.frameDone(40, 60);
    QVERIFY(std::abs(pacer.interval() - 200) < 1);
    for (int i = 0; i < 50; ++i)
        pacer.frameDone(1e6, 1e6);
    QCOMPARE(pacer.interval(), FramePacer::longestInterval);
}

void tst_SceneGeometry::lengthsOfTheScaleAreRound()
{
    QCOMPARE(roundLength(49), 20.0);
    QCOMPARE(roundLength(50), 50.0);
    QCOMPARE(roundLength(1.9), 1.0);
    QCOMPARE(roundLength(0.3), 0.2);
    QCOMPARE(roundLength(0), 0.0);
    QCOMPARE(roundLength(NAN), 0.0);
}

QTEST_GUILESS_MAIN(tst_SceneGeometry)
#include "tst_SceneGeometry.moc"
