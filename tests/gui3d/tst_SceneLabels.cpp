// SPDX-License-Identifier: Apache-2.0
#include "gui3d/OrbitCamera.h"
#include "gui3d/SceneDrawing.h"
#include "gui3d/View3DOverlay.h"

#include <QtTest/QtTest>

using namespace qplc;

// Where the names of axes and vectors stand in the picture.
class tst_SceneLabels : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void axisNameIsHiddenWhenTheAxisPointsAtTheViewer_data();
    void axisNameIsHiddenWhenTheAxisPointsAtTheViewer();
    void labelsDoNotLieOnEachOther();
};

namespace {

constexpr QSizeF viewSize(640, 480);

std::vector<QRectF> boxesOf(const std::vector<SceneLabel> &labels, const CameraPose &pose)
{
    return labelBoxes(labels, pose, viewSize, [](const QString &text) { return QSizeF(8.0 * text.size(), 16.0); });
}

}  // namespace

void tst_SceneLabels::axisNameIsHiddenWhenTheAxisPointsAtTheViewer_data()
{
    QTest::addColumn<QVector3D>("eye");
    QTest::addColumn<QVector3D>("up");
    QTest::addColumn<QString>("hidden");
    QTest::newRow("from the east") << QVector3D(300, 0, 0) << QVector3D(0, 0, 1) << "east";
    QTest::newRow("from the south") << QVector3D(0, -300, 0) << QVector3D(0, 0, 1) << "north";
    QTest::newRow("from above") << QVector3D(0, 0, 300) << QVector3D(0, 1, 0) << "up";
    QTest::newRow("from a corner") << QVector3D(200, -200, 100) << QVector3D(-0.24f, 0.24f, 0.94f) << "";
}

void tst_SceneLabels::axisNameIsHiddenWhenTheAxisPointsAtTheViewer()
{
    QFETCH(QVector3D, eye);
    QFETCH(QVector3D, up);
    QFETCH(QString, hidden);
    QPlcScene3D scene;
    scene.size = 300;
    drawBody(&scene, {}, {});
    scene.addName({93, 0, 0}, QStringLiteral("wind"), Qt::black);
    const std::vector<SceneLabel> &labels = scene.content().labels;
    QCOMPARE(int(labels.size()), 4);
    const std::vector<QRectF> boxes = boxesOf(labels, {eye, {}, up});
    for (std::size_t i = 0; i < labels.size(); ++i)
        QVERIFY2(boxes[i].isNull() == (labels[i].text == hidden), qPrintable(labels[i].text));
}

void tst_SceneLabels::labelsDoNotLieOnEachOther()
{
    std::vector<SceneLabel> labels;
    for (const char *text : {"one", "two", "a longer one", "four", "five"})
        labels.push_back({{0, 0, float(labels.size() % 2)}, QString::fromLatin1(text), {}});
    const std::vector<QRectF> boxes = boxesOf(labels, {{0, -300, 0}, {}, {0, 0, 1}});
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        QVERIFY(!boxes[i].isNull());
        for (std::size_t other = 0; other < i; ++other)
            QVERIFY(!boxes[i].intersects(boxes[other]));
    }
}

QTEST_GUILESS_MAIN(tst_SceneLabels)
#include "tst_SceneLabels.moc"
