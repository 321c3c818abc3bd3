// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "QPlcValueTable.h"
#include "TableText.h"
#include "gui/panel/WindowContext.h"
#include "gui/tables/ValueTableModel.h"

#include <QtCore/QJsonArray>
#include <QtWidgets/QAction>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QTreeView>

using namespace qplc;

namespace {

/// A value table in a window with one plant.
struct TableBench
{
    explicit TableBench(const QJsonObject &settings)
    {
        plant = context.plants()->add(master.address(), QStringLiteral("kite"), QStringLiteral("Window"));
        panel.setContext(&context);
        panel.applySettings(settings);
        panel.resize(700, 200);
        panel.show();
        view = panel.findChild<QTreeView *>();
    }
    QStringList names() const { return columnTexts(*view->model(), ValueTableModel::Name); }

    RunningMaster master;
    WindowContext context;
    Plant *plant;
    QPlcValueTable panel;
    QTreeView *view;
};

}  // namespace

class tst_ValueTableSearch : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aSearchShowsTheRowsThatFit();
    void keysControlTheTableSearch();
    void addedSignalClearsTheSearch();
};

void tst_ValueTableSearch::aSearchShowsTheRowsThatFit()
{
    TableBench bench({{"signals", QJsonArray{"count", "setpoint", "sum"}}, {"search", "m/S set"}});
    QTRY_VERIFY(!bench.plant->table().isEmpty());
    QTRY_COMPARE(bench.names(), QStringList{QStringLiteral("setpoint")});
    auto *line = bench.panel.findChild<QLineEdit *>();
    QVERIFY(line && line->isVisible());
    QCOMPARE(line->text(), QStringLiteral("m/S set"));
    const auto *hint = bench.panel.findChildren<QLabel *>().last();
    QVERIFY(!hint->isVisible());
    // What is removed is what is seen.
    bench.panel.activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&bench.panel));
    bench.view->setFocus();
    bench.view->selectAll();
    QTest::keyClick(bench.view, Qt::Key_Delete);
    QCOMPARE(bench.panel.settings().value("signals").toArray(), (QJsonArray{"count", "sum"}));
    QVERIFY(hint->isVisible());
    QCOMPARE(hint->text(), QStringLiteral("No signal of this table fits the search."));
    bench.panel.applySettings({{"signals", QJsonArray{"count", "sum"}}});
    QCOMPARE(bench.names(), (QStringList{"count", "sum"}));
    QVERIFY(!hint->isVisible());
}

void tst_ValueTableSearch::keysControlTheTableSearch()
{
    TableBench bench({{"signals", QJsonArray{"count", "setpoint", "sum"}}});
    bench.panel.activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&bench.panel));
    QSignalSpy edits(&bench.panel, &QPlcWidget::settingsEdited);
    bench.view->setFocus();
    QVERIFY(!bench.panel.findChild<QLineEdit *>());
    QTest::keyClick(bench.view, Qt::Key_F, Qt::ControlModifier);
    auto *line = bench.panel.findChild<QLineEdit *>();
    QVERIFY(line && line->hasFocus());
    QTest::keyClicks(line, QStringLiteral("su"));
    QCOMPARE(bench.names(), QStringList{QStringLiteral("sum")});
    QCOMPARE(edits.size(), 2);
    QCOMPARE(bench.panel.settings().value("search").toString(), QStringLiteral("su"));
    QTest::keyClick(line, Qt::Key_Down);
    QVERIFY(bench.view->hasFocus());
    QCOMPARE(bench.view->currentIndex().row(), 0);
    QTest::keyClick(bench.view, Qt::Key_F, Qt::ControlModifier);
    QVERIFY(line->hasFocus());
    QTest::keyClick(line, Qt::Key_Escape);
    QVERIFY(bench.view->hasFocus());
    QTRY_VERIFY(!bench.panel.findChild<QLineEdit *>());
    QCOMPARE(bench.names().size(), 3);
    QVERIFY(!bench.panel.settings().contains("search"));
}

void tst_ValueTableSearch::addedSignalClearsTheSearch()
{
    TableBench bench({{"signals", QJsonArray{"count"}}, {"search", "count"}});
    QVERIFY(bench.panel.addSignals({"sum"}));
    QCOMPARE(bench.names(), (QStringList{"count", "sum"}));
    QVERIFY(!bench.panel.settings().contains("search"));
}

QTEST_MAIN(tst_ValueTableSearch)
#include "tst_ValueTableSearch.moc"
