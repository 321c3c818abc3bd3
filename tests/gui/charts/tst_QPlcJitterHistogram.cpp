// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcJitterHistogram.h"

#include "PanelFixtures.h"
#include "PlantFixtures.h"
#include "gui/charts/JitterCanvas.h"
#include "gui/panel/WindowContext.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtWidgets/QAction>
#include <QtWidgets/QCheckBox>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QLabel>

using namespace qplc;

namespace {

int curvesOf(const QPlcJitterHistogram &panel)
{
    return panel.findChild<JitterCanvas *>()->itemList(QwtPlotItem::Rtti_PlotUserItem + 3).size();
}

/// A histogram in a window, and the plant of a master.
struct ShownHistogram
{
    explicit ShownHistogram(const RunningMaster &master, const char *settings = "{}")
    {
        panel.setContext(&context);
        panel.applySettings(objectOf(settings));
        panel.resize(400, 300);
        panel.show();
        context.plants()->add(master.address());
    }
    WindowContext context;
    QPlcJitterHistogram panel;
};

}  // namespace

class tst_QPlcJitterHistogram : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void settingsAreRestoredUnchanged_data();
    void settingsAreRestoredUnchanged();
    void panelReportsAMissingPlant();
    void panelGivesAHintBeforeTheFirstCycle();
    void theLatenessOfARunningMasterIsShown();
    void masterAndNodesAreShownTogether();
    void hiddenPanelRequestsNoStatistics();
    void actionsAndEditorChooseTheHistograms();
    void histogramsOfALostMasterAreStale();
    void aSettingThatIsMissingIsADefault();
    void captionFitsOnOneLine();
    void panelNamesTheChosenPlantAmongSeveral();
    void singlePlantNeedsNoChoice();
};

void tst_QPlcJitterHistogram::settingsAreRestoredUnchanged_data()
{
    QTest::addColumn<QByteArray>("json");
    QTest::newRow("none") << QByteArray("{}");
    QTest::newRow("all") << QByteArray(
        R"({"plant":"a","show":["Master.lateness","Kite.execution"],"title":"T","unknown":3,"window":"last10s"})");
    QTest::newRow("nothing shown") << QByteArray(R"({"show":[]})");
}

void tst_QPlcJitterHistogram::settingsAreRestoredUnchanged()
{
    QFETCH(QByteArray, json);
    QPlcJitterHistogram panel;
    panel.applySettings(QJsonDocument::fromJson(json).object());
    QCOMPARE(QJsonDocument(panel.settings()).toJson(QJsonDocument::Compact), json);
}

void tst_QPlcJitterHistogram::panelReportsAMissingPlant()
{
    WindowContext context;
    QPlcJitterHistogram panel;
    panel.resize(400, 300);
    panel.show();
    QVERIFY(showsText(panel, "no plant yet"));
    panel.setContext(&context);
    panel.applySettings(objectOf(R"({"plant":"tower"})"));
    QVERIFY(showsText(panel, "no plant tower"));
}

void tst_QPlcJitterHistogram::panelGivesAHintBeforeTheFirstCycle()
{
    RunningMaster master;
    ShownHistogram shown(master);
    QTRY_VERIFY(showsText(shown.panel, "No cycles yet"));
}

void tst_QPlcJitterHistogram::theLatenessOfARunningMasterIsShown()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    ShownHistogram shown(master);
    QTRY_COMPARE(curvesOf(shown.panel), 1);
    QVERIFY(shown.panel.findChild<JitterCanvas *>()->isVisible());
    QVERIFY(showsText(shown.panel, "since start"));
    QVERIFY(showsText(shown.panel, "Master lateness"));
}

void tst_QPlcJitterHistogram::masterAndNodesAreShownTogether()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    ShownHistogram shown(master,
                         R"({"show":["Master.execution","Counter.execution","Nobody.execution"],"window":"last10s"})");
    QTRY_COMPARE(curvesOf(shown.panel), 2);
    QVERIFY(showsText(shown.panel, "last 10 s"));
    shown.panel.applySettings(objectOf(R"({"show":["Nobody.execution"]})"));
    QVERIFY(showsText(shown.panel, "no figures of Nobody.execution"));
}

void tst_QPlcJitterHistogram::hiddenPanelRequestsNoStatistics()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    WindowContext context;
    QPlcJitterHistogram panel;
    panel.setContext(&context);
    Plant *plant = context.plants()->add(master.address());
    QTRY_VERIFY(plant->values().rows() > 100);
    QCOMPARE(curvesOf(panel), 0);
    panel.resize(400, 300);
    panel.show();
    QTRY_COMPARE(curvesOf(panel), 1);
}

void tst_QPlcJitterHistogram::actionsAndEditorChooseTheHistograms()
{
    QPlcJitterHistogram panel;
    QSignalSpy edited(&panel, &QPlcJitterHistogram::settingsEdited);
    const QList<QAction *> actions = panel.actions();
    actions.at(0)->trigger();
    QCOMPARE(panel.settings(), objectOf(R"({"window":"last10s"})"));
    actions.at(2)->trigger();
    QCOMPARE(panel.settings().value("show").toArray(), (QJsonArray{"Master.lateness", "Master.execution"}));
    QCOMPARE(edited.size(), 2);
    const std::unique_ptr<QWidget> editor(panel.createSettingsEditor());
    const QList<QCheckBox *> boxes = editor->findChildren<QCheckBox *>();
    const auto lateness = std::find_if(boxes.begin(), boxes.end(),
                                       [](const QCheckBox *box) { return box->text() == "Master lateness"; });
    QVERIFY((*lateness)->isChecked());
    (*lateness)->click();
    QCOMPARE(panel.settings().value("show").toArray(), (QJsonArray{"Master.execution"}));
    QVERIFY(!actions.at(1)->isChecked());
}

void tst_QPlcJitterHistogram::histogramsOfALostMasterAreStale()
{
    auto master = std::make_unique<RunningMaster>();
    QVERIFY(master->startRealTime());
    ShownHistogram shown(*master);
    QTRY_COMPARE(curvesOf(shown.panel), 1);
    master.reset();
    QTRY_VERIFY_WITH_TIMEOUT(showsText(shown.panel, "stale"), 10000);
    QCOMPARE(curvesOf(shown.panel), 1);
}

/// Undo brings back the settings of before.
void tst_QPlcJitterHistogram::aSettingThatIsMissingIsADefault()
{
    QPlcJitterHistogram panel;
    panel.applySettings(objectOf(R"({"show":["Master.execution"],"window":"last10s"})"));
    panel.applySettings({});
    QCOMPARE(panel.settings(), QJsonObject());
    QVERIFY(!panel.actions().at(0)->isChecked());
    QVERIFY(panel.actions().at(1)->isChecked());
    QVERIFY(!panel.actions().at(2)->isChecked());
    panel.actions().at(0)->trigger();
    panel.actions().at(0)->trigger();
    QCOMPARE(panel.settings(), QJsonObject());
}

void tst_QPlcJitterHistogram::captionFitsOnOneLine()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    ShownHistogram shown(master);
    QTRY_VERIFY(showsText(shown.panel, "values"));
    for (const int width : {500, 274, 160, 60}) {
        shown.panel.resize(width, 300);
        const QList<QLabel *> labels = shown.panel.findChildren<QLabel *>();
        const auto caption = std::find_if(labels.begin(), labels.end(), [](const QLabel *label) {
            return label->text().contains(QStringLiteral("lateness"));
        });
        QVERIFY(caption != labels.end());
        QCOMPARE((*caption)->text().contains(QStringLiteral("values")), width == 500);
        const int twoLines = 2 * (*caption)->fontMetrics().height();
        QVERIFY(width == 60 || (*caption)->heightForWidth(width - 4) < twoLines);
    }
}

void tst_QPlcJitterHistogram::panelNamesTheChosenPlantAmongSeveral()
{
    RunningMaster north;
    RunningMaster south;
    QVERIFY(north.startRealTime() && south.startRealTime());
    WindowContext context;
    context.plants()->add(north.address(), QStringLiteral("north"), QStringLiteral("Window"));
    context.plants()->add(south.address(), QStringLiteral("south"), QStringLiteral("Window"));
    QPlcJitterHistogram panel;
    panel.setContext(&context);
    panel.resize(400, 300);
    panel.show();
    QTRY_VERIFY(showsText(panel, "north: Master lateness"));
    const std::unique_ptr<QWidget> editor(panel.createSettingsEditor());
    auto *choice = editor->findChild<QComboBox *>();
    QVERIFY(choice);
    QCOMPARE(choice->count(), 3);
    QCOMPARE(choice->currentText(), QStringLiteral("The selected one"));
    QSignalSpy edited(&panel, &QPlcJitterHistogram::settingsEdited);
    choice->setFocus();
    QTest::keyClick(choice, Qt::Key_End);
    QCOMPARE(panel.settings(), objectOf(R"({"plant":"south"})"));
    QCOMPARE(edited.count(), 1);
    QTRY_VERIFY(showsText(panel, "south: Master lateness"));
    // So do several histograms.
    panel.applySettings(objectOf(R"({"plant":"south","show":["Master.lateness","Master.execution"]})"));
    QTRY_VERIFY(showsText(panel, "since start · south"));
    panel.applySettings({});
    QTRY_VERIFY(showsText(panel, "north: Master lateness"));
}

void tst_QPlcJitterHistogram::singlePlantNeedsNoChoice()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    ShownHistogram shown(master);
    QTRY_VERIFY(showsText(shown.panel, "Master lateness"));
    QVERIFY(!showsText(shown.panel, ": Master lateness"));
    const std::unique_ptr<QWidget> editor(shown.panel.createSettingsEditor());
    QVERIFY(!editor->findChild<QComboBox *>());
    // Unless it is not the one that was wanted.
    shown.panel.applySettings(objectOf(R"({"plant":"tower"})"));
    const std::unique_ptr<QWidget> other(shown.panel.createSettingsEditor());
    QCOMPARE(other->findChild<QComboBox *>()->currentText(), QStringLiteral("tower, which is not there"));
}

QTEST_MAIN(tst_QPlcJitterHistogram)
#include "tst_QPlcJitterHistogram.moc"
