// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "QPlcSignalTree.h"
#include "gui/SignalsMimeType.h"
#include "gui/models/SignalTreeModel.h"
#include "gui/panel/WindowContext.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QMimeData>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QTreeView>

using namespace qplc;

namespace {

/// A tree in a window with one plant.
class TreeBench
{
public:
    explicit TreeBench(const QJsonObject &settings = {})
    {
        context.plants()->add(master.address(), QStringLiteral("kite"), QStringLiteral("Window"));
        tree.setContext(&context);
        tree.applySettings(settings);
        tree.resize(320, 420);
        tree.show();
        tree.activateWindow();
        view = tree.findChild<QTreeView *>();
        search = tree.findChild<QLineEdit *>();
    }
    bool isThere()
    {
        return waitUntil([this] { return find("Counter").isValid() && view->isExpanded(find("Counter")); });
    }
    QModelIndex top() const { return view->model()->index(0, 0); }
    QModelIndex find(const char *name) const
    {
        const QModelIndexList found
            = view->model()->match(top(), Qt::DisplayRole, QString(name), 1, Qt::MatchRecursive | Qt::MatchExactly);
        return found.value(0);
    }

    RunningMaster master;
    WindowContext context;
    QPlcSignalTree tree;
    QTreeView *view;
    QLineEdit *search;
};

}  // namespace

class tst_SignalTree : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void settingsAreRestoredByteForByte();
    void treeWithoutWindowIsEmpty();
    void plantsAndNodesAreExpandedButVectorsAreNot();
    void keysAskForPanels();
    void enterInTheSearchShowsTheFirstHit();
    void lettersInTheSearchAreText();
    void selectedNodeSelectsItsSignals();
    void collapsedAndExpandedNodesKeepTheirState();
    void aSearchUnfoldsAndItsEndFoldsAgain();
    void selectedRowsAreDraggedAsReferences();
    void frozenPlotsShowThePastInTheTree();
    void namesHaveMostOfANarrowTree();
};

void tst_SignalTree::settingsAreRestoredByteForByte()
{
    const QByteArray json = R"({"collapsed":["kite"],"columns":["name","age"],"expanded":["kite/x/vector"],"later":1,)"
                            R"("search":"count","title":"T"})";
    QPlcSignalTree tree;
    tree.applySettings(QJsonDocument::fromJson(json).object());
    QCOMPARE(QJsonDocument(tree.settings()).toJson(QJsonDocument::Compact), json);
    TreeBench bench(QJsonDocument::fromJson(json).object());
    QCOMPARE(QJsonDocument(bench.tree.settings()).toJson(QJsonDocument::Compact), json);
    QVERIFY(bench.view->isColumnHidden(SignalTreeModel::Value));
    QVERIFY(!bench.view->isColumnHidden(SignalTreeModel::Age));
    bench.tree.applySettings({});
    QVERIFY(!bench.view->isColumnHidden(SignalTreeModel::Value));
    QCOMPARE(bench.search->text(), QString());
}

void tst_SignalTree::treeWithoutWindowIsEmpty()
{
    QPlcSignalTree tree;
    QSignalSpy requests(&tree, &QPlcSignalTree::showRequested);
    tree.show();
    QTest::keyClicks(tree.findChild<QLineEdit *>(), QStringLiteral("x\r"));
    QCOMPARE(requests.size(), 0);
    QVERIFY(tree.selectedReferences().isEmpty());
}

void tst_SignalTree::plantsAndNodesAreExpandedButVectorsAreNot()
{
    TreeBench bench;
    QVERIFY(bench.isThere());
    QTRY_VERIFY(bench.view->isExpanded(bench.find("Counter")));
    QTRY_VERIFY(bench.view->isExpanded(bench.find("Not written")));
    QVERIFY(!bench.view->isExpanded(bench.find("vector")));
    QVERIFY(bench.view->uniformRowHeights());
}

void tst_SignalTree::keysAskForPanels()
{
    TreeBench bench;
    QVERIFY(bench.isThere());
    QSignalSpy requests(&bench.tree, &QPlcSignalTree::showRequested);
    bench.view->setFocus();
    bench.view->setCurrentIndex(bench.find("count"));
    QTest::keyClick(bench.view, Qt::Key_Return);
    QTest::keyClick(bench.view, Qt::Key_G);
    bench.view->selectionModel()->select(bench.find("sum"), QItemSelectionModel::Select | QItemSelectionModel::Rows);
    QTest::keyClick(bench.view, Qt::Key_W);
    QCOMPARE(requests.size(), 3);
    QCOMPARE(requests.at(0), (QList<QVariant>{QStringList{"count"}, QStringLiteral("Time plot")}));
    QCOMPARE(requests.at(1), (QList<QVariant>{QStringList{"count"}, QStringLiteral("Gauge")}));
    QCOMPARE(requests.at(2), (QList<QVariant>{QStringList({"count", "sum"}), QStringLiteral("Value table")}));
}

void tst_SignalTree::enterInTheSearchShowsTheFirstHit()
{
    TreeBench bench;
    QVERIFY(bench.isThere());
    QSignalSpy requests(&bench.tree, &QPlcSignalTree::showRequested);
    QTest::keyClicks(bench.search, QStringLiteral("cou"));
    QTest::keyClick(bench.search, Qt::Key_Return);
    QCOMPARE(requests.size(), 1);
    QCOMPARE(requests.at(0).at(0).toStringList(), QStringList{QStringLiteral("count")});
    QTest::keyClicks(bench.search, QStringLiteral("nosuch"));
    QTest::keyClick(bench.search, Qt::Key_Return);
    QCOMPARE(requests.size(), 1);
}

void tst_SignalTree::lettersInTheSearchAreText()
{
    TreeBench bench;
    QVERIFY(bench.isThere());
    QSignalSpy requests(&bench.tree, &QPlcSignalTree::showRequested);
    bench.search->setFocus();
    QTest::keyClicks(bench.search, QStringLiteral("wg"));
    QCOMPARE(bench.search->text(), QStringLiteral("wg"));
    QCOMPARE(requests.size(), 0);
    QCOMPARE(bench.tree.settings().value(QStringLiteral("search")).toString(), QStringLiteral("wg"));
}

void tst_SignalTree::selectedNodeSelectsItsSignals()
{
    TreeBench bench;
    QVERIFY(bench.isThere());
    bench.view->setCurrentIndex(bench.find("Counter"));
    QCOMPARE(bench.tree.selectedReferences(), (QStringList{"count", "sum"}));
}

void tst_SignalTree::collapsedAndExpandedNodesKeepTheirState()
{
    TreeBench bench;
    QVERIFY(bench.isThere());
    QTRY_VERIFY(bench.view->isExpanded(bench.find("Not written")));
    QSignalSpy edits(&bench.tree, &QPlcWidget::settingsEdited);
    bench.view->collapse(bench.find("Counter"));
    bench.view->expand(bench.find("vector"));
    QCOMPARE(edits.size(), 2);
    QCOMPARE(
        bench.tree.settings(),
        (QJsonObject{{"collapsed", QJsonArray{"kite/Counter"}}, {"expanded", QJsonArray{"kite/Not written/vector"}}}));
    const QJsonObject settings = bench.tree.settings();
    bench.context.plants()->remove(bench.context.plants()->at(0));
    QCOMPARE(bench.view->model()->rowCount(), 0);
    bench.context.plants()->add(bench.master.address(), QStringLiteral("kite"), QStringLiteral("Window 2"));
    QTRY_VERIFY(bench.find("vector").isValid() && bench.view->isExpanded(bench.find("vector")));
    QVERIFY(!bench.view->isExpanded(bench.find("Counter")));
    QCOMPARE(bench.tree.settings(), settings);
    QCOMPARE(edits.size(), 2);
}

void tst_SignalTree::aSearchUnfoldsAndItsEndFoldsAgain()
{
    TreeBench bench;
    QVERIFY(bench.isThere());
    bench.view->collapse(bench.find("Counter"));
    const QJsonObject before = bench.tree.settings();
    bench.search->setText(QStringLiteral("count"));
    QVERIFY(bench.view->isExpanded(bench.find("Counter")));
    QVERIFY(!bench.find("vector").isValid());
    bench.search->clear();
    QVERIFY(!bench.view->isExpanded(bench.find("Counter")));
    QCOMPARE(bench.tree.settings(), before);
}

void tst_SignalTree::selectedRowsAreDraggedAsReferences()
{
    TreeBench bench;
    QVERIFY(bench.isThere());
    QVERIFY(bench.view->dragEnabled());
    const std::unique_ptr<QMimeData> data(bench.view->model()->mimeData({bench.find("count"), bench.find("sum")}));
    QCOMPARE(data->data(signalsMimeType()), QByteArray(R"(["count","sum"])"));
}

void tst_SignalTree::frozenPlotsShowThePastInTheTree()
{
    TreeBench bench;
    QVERIFY(bench.master.startRealTime());
    QVERIFY(bench.isThere());
    const Plant *plant = bench.context.plants()->at(0);
    QTRY_VERIFY(plant->store()->endRow() > plant->store()->firstRow() + 20);
    const SignalStore::Row row = plant->store()->firstRow() + 5;
    const int channel = plant->values().channels().channel(plant->table().indexOf(QStringLiteral("count")));
    const QString expected = QString::number(int(plant->store()->value(channel, row)));
    bench.context.timeAxis()->show(plant->store()->time(row) - 1'000'000'000, plant->store()->time(row));
    QCOMPARE(bench.find("count").siblingAtColumn(SignalTreeModel::Value).data().toString(), expected);
    bench.context.timeAxis()->goLive();
    QVERIFY(bench.find("count").siblingAtColumn(SignalTreeModel::Value).data().toString() != expected);
}

void tst_SignalTree::namesHaveMostOfANarrowTree()
{
    TreeBench bench;
    QVERIFY(bench.isThere());
    const QFontMetrics metrics(bench.view->font());
    const int figure = metrics.horizontalAdvance(QLatin1Char('0'));
    const int name = 24 * metrics.averageCharWidth();
    bench.tree.resize(name + 15 * figure + 24, 420);
    QTRY_COMPARE(bench.view->viewport()->width(),
                 bench.view->columnWidth(SignalTreeModel::Name) + bench.view->columnWidth(SignalTreeModel::Value)
                     + bench.view->columnWidth(SignalTreeModel::Unit));
    QVERIFY(bench.view->columnWidth(SignalTreeModel::Name) >= name);
    QVERIFY(bench.view->columnWidth(SignalTreeModel::Value) >= 9 * figure);
}

QTEST_MAIN(tst_SignalTree)
#include "tst_SignalTree.moc"
