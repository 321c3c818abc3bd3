// SPDX-License-Identifier: Apache-2.0
#include "QPlcScene3D.h"
#include "gui3d/ObjMesh.h"
#include "gui3d/SceneContent.h"
#include "kite/KiteScene.h"
#include "kite/KiteView.h"

#include <QtTest/QtTest>

#include <cmath>

using namespace awe;
using namespace qplc;

/// What the 3D view of the example draws of a kite.
class tst_KiteScene : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void aPathBecomesItsJoinedLines();
    void unknownKiteStateDrawsNothing();
    void tetherRunsThroughItsNodes();
    void mastStandsOnTheGround();
    void forcesKeepTheirScaleUntilALargerOneComes();
    void theModelOfTheKiteIsReadWhole();
};

void tst_KiteScene::aPathBecomesItsJoinedLines()
{
    FlightTrail::Samples past;
    for (int i = 0; i < 4; ++i)
        past.append({i, 1.0, 1.0, 1.0, QPlcQuality::Good, i != 0 && i != 2});
    FlightTrail trail;
    trail.read(past, past, past, past);
    QPlcScene3D scene;
    drawTrail(&scene, trail, ColorScale(), 2);
    QCOMPARE(scene.content().lines.lines(), 2);
}

void tst_KiteScene::unknownKiteStateDrawsNothing()
{
    QPlcScene3D scene;
    scene.heading = 0.0f;
    KiteState kite;
    const auto draw = [&] {
        drawWindAxes(&scene, kite);
        drawSmallEarth(&scene);
        drawTether(&scene, kite, {});
        drawVectors(&scene, kite, 500);
        return scene.content().lines.lines();
    };
    QCOMPARE(draw(), 0);
    kite.force = QVector3D(0, 0, 100);
    QCOMPARE(draw(), 0);
    scene.position = QVector3D(50, 0, 50);
    QVERIFY(draw() > 200);
    QCOMPARE(scene.content().labels.back().text, QStringLiteral("100 N"));
}

/// A sagging tether of three segments: three straight lines, none of them a curve that was made up.
void tst_KiteScene::tetherRunsThroughItsNodes()
{
    QPlcScene3D scene;
    scene.position = QVector3D(60, 0, 60);
    KiteState kite;
    kite.tetherLength = 90.0;
    drawTether(&scene, kite, {});
    const int madeUp = scene.content().lines.lines();
    QVERIFY(madeUp > 3);
    kite.tetherNodes = {QVector3D(20, 0, 15), QVector3D(40, 0, 35)};
    drawTether(&scene, kite, {});
    QCOMPARE(scene.content().lines.lines() - madeUp, 3);
}

void tst_KiteScene::mastStandsOnTheGround()
{
    QPlcScene3D scene;
    KiteState kite;
    drawMast(&scene, kite);
    QCOMPARE(scene.content().lines.lines(), 0);
    kite.mastTop = QVector3D(4, 0, 11);
    drawMast(&scene, kite);
    QCOMPARE(scene.content().lines.lines(), 1);
    QCOMPARE(scene.content().labels.back().text, QStringLiteral("mast"));
}

void tst_KiteScene::forcesKeepTheirScaleUntilALargerOneComes()
{
    QCOMPARE(forceReference(400, 500), 500.0f);
    QVERIFY(forceReference(1700, 500) >= 1700.0f);
    QCOMPARE(forceReference(NAN, 500), 500.0f);
}

void tst_KiteScene::theModelOfTheKiteIsReadWhole()
{
    const KiteView view;  // has the resource
    QString error;
    const ObjMesh kite = ObjMesh::fromFile(QStringLiteral(":/kite/kite.obj"), &error);
    QCOMPARE(error, QString());
    QVERIFY(kite.triangles.size() / 3 > 500 && kite.triangles.size() / 3 < 5000);
    QVERIFY(kite.lines.size() >= 12);
    QVERIFY(kite.radius() > 3 && kite.radius() < 7);
    int outwards = 0;
    for (const ObjMesh::Vertex &vertex : kite.triangles) {
        QVERIFY(std::abs(vertex.normal.length() - 1) < 1e-3f);
        outwards += vertex.normal.z() > 0.3f ? 1 : 0;
    }
    QVERIFY(outwards > int(kite.triangles.size()) / 4);
}

QTEST_MAIN(tst_KiteScene)
#include "tst_KiteScene.moc"
