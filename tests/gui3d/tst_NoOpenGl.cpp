// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "gui3d/OpenGlProbe.h"
#include "kite/KiteView.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QCheckBox>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QLabel>

using namespace awe;
using namespace qplc;

namespace {

/// Why there is no OpenGL: switched off by ourselves, unless who runs this test has seen to it and
/// says which reason is to be told.
QString expectedReason()
{
    return qEnvironmentVariable("QTPLC_EXPECTED_REASON", QStringLiteral("QTPLC_OPENGL"));
}

}  // namespace

/// What the 3D view does where OpenGL fails; and all of it that needs none.
class tst_NoOpenGl : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void probeReportsTheReason();
    void theWindWindowIsShownWithTheReason();
    void theReasonStaysInThePanel();
    void settingsAreRestoredByteForByte();
    void keysChooseCameras();
    void aWheelIsOneStepForUndo();
    void editorAppliesChangesImmediately();
    void everyActionHasAKeyAndAText();
};

void tst_NoOpenGl::initTestCase()
{
    if (!qEnvironmentVariableIsSet("QTPLC_EXPECTED_REASON"))
        qputenv("QTPLC_OPENGL", "off");
    QPlcWidget::registerFactory(new QPlcWidgetFactoryOf<KiteView>);
    QVERIFY(QPlcWidget::factory(QStringLiteral("3D view")));
}

void tst_NoOpenGl::probeReportsTheReason()
{
    const QString reason = OpenGlProbe::probe().error;
    QVERIFY2(reason.contains(expectedReason()), qPrintable(reason));
}

void tst_NoOpenGl::theWindWindowIsShownWithTheReason()
{
    KiteView view;
    view.resize(400, 300);
    QVERIFY(!view.findChild<QWidget *>(QStringLiteral("windWindow")));
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
    auto *instead = view.findChild<QWidget *>(QStringLiteral("windWindow"));
    QVERIFY(instead && instead->isVisible());
    QVERIFY(!view.openGlError().isEmpty());
    auto *reason = view.findChild<QLabel *>(QStringLiteral("openGlError"));
    QVERIFY(reason && reason->isVisible() && reason->text().contains(view.openGlError()));
    QVERIFY(!reason->text().contains(QLatin1Char('\n')));
    QVERIFY(!instead->geometry().intersects(reason->geometry()));
}

void tst_NoOpenGl::theReasonStaysInThePanel()
{
    KiteView view;
    view.show();
    for (const QSize &size : {QSize(240, 120), QSize(900, 700)}) {
        view.resize(size);
        QCoreApplication::processEvents();
        auto *reason = view.findChild<QLabel *>(QStringLiteral("openGlError"));
        QVERIFY(view.rect().contains(reason->geometry()));
    }
}

void tst_NoOpenGl::settingsAreRestoredByteForByte()
{
    KiteView view;
    QCOMPARE(view.settings(), QJsonObject());
    const QJsonObject json{{"camera", "top"}, {"vectors", false}, {"trail", 10}, {"title", "Kite"}, {"later", 3}};
    view.applySettings(json);
    QCOMPARE(QJsonDocument(view.settings()).toJson(), QJsonDocument(json).toJson());
}

void tst_NoOpenGl::keysChooseCameras()
{
    KiteView view;
    QSignalSpy edits(&view, &QPlcWidget::settingsEdited);
    view.show();
    view.activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&view));
    view.setFocus();
    QTest::keyClick(&view, Qt::Key_5);
    QCOMPARE(view.settings().value(QStringLiteral("camera")).toString(), QStringLiteral("chase"));
    QTest::keyClick(&view, Qt::Key_2);
    QCOMPARE(view.settings().value(QStringLiteral("camera")).toString(), QStringLiteral("side"));
    QCOMPARE(edits.count(), 2);
    QTest::keyClick(&view, Qt::Key_Left);
    QVERIFY(view.settings().contains(QStringLiteral("view")));
    QTest::keyClick(&view, Qt::Key_0);
    QVERIFY(!view.settings().contains(QStringLiteral("view")));
    QTest::keyClick(&view, Qt::Key_1);
    QCOMPARE(view.settings(), QJsonObject());
}

void tst_NoOpenGl::aWheelIsOneStepForUndo()
{
    KiteView view;
    QSignalSpy edits(&view, &QPlcWidget::settingsEdited);
    for (int i = 0; i < 5; ++i) {
        QWheelEvent event({10, 10}, {10, 10}, {}, {0, 120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(&view, &event);
    }
    const double zoom
        = view.settings().value(QStringLiteral("view")).toObject().value(QStringLiteral("zoom")).toDouble();
    QVERIFY(std::abs(zoom - std::pow(1.2, 5)) < 0.01);
    QTRY_COMPARE(edits.count(), 1);
    QTest::qWait(500);
    QCOMPARE(edits.count(), 1);
}

void tst_NoOpenGl::editorAppliesChangesImmediately()
{
    KiteView view;
    QSignalSpy edits(&view, &QPlcWidget::settingsEdited);
    const std::unique_ptr<QWidget> editor(view.createSettingsEditor());
    const QList<QCheckBox *> boxes = editor->findChildren<QCheckBox *>();
    QCOMPARE(boxes.size(), 5);
    boxes.first()->setChecked(false);
    QCOMPARE(view.settings(), QJsonObject({{"ground", false}}));
    auto *camera = editor->findChild<QComboBox *>();
    camera->setCurrentIndex(2);
    Q_EMIT camera->activated(2);
    QCOMPARE(view.settings().value(QStringLiteral("camera")).toString(), QStringLiteral("top"));
    QCOMPARE(edits.count(), 2);
}

void tst_NoOpenGl::everyActionHasAKeyAndAText()
{
    KiteView view;
    QCOMPARE(view.actions().size(), 8);
    for (const QAction *action : view.actions()) {
        QVERIFY(!action->text().isEmpty());
        QVERIFY(!action->shortcut().isEmpty());
        QCOMPARE(action->shortcutContext(), Qt::WidgetWithChildrenShortcut);
    }
}

QTEST_MAIN(tst_NoOpenGl)
#include "tst_NoOpenGl.moc"
