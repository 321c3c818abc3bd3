// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "QPlcWidget.h"
#include "TableText.h"
#include "gui/models/SignalFilterModel.h"
#include "gui/models/SignalTreeModel.h"
#include "gui/panel/WindowContext.h"
#include "gui/tables/ValueTableModel.h"

#include <QtTest/QAbstractItemModelTester>
#include <QtWidgets/QTreeView>

using namespace qplc;

namespace {

constexpr auto fatal = QAbstractItemModelTester::FailureReportingMode::QtTest;

/// The tree as text, a line for each row: "  count".
QStringList linesOf(const QAbstractItemModel &model, const QModelIndex &parent = {}, int depth = 0)
{
    QStringList lines;
    for (int row = 0; row < model.rowCount(parent); ++row) {
        const QModelIndex index = model.index(row, 0, parent);
        lines << QString(depth, QLatin1Char(' ')) + index.data().toString();
        lines += linesOf(model, index, depth + 1);
    }
    return lines;
}

SignalReference reference(const char *text)
{
    return SignalReference::fromString(QString(text));
}

struct PanelInWindow
{
    PanelInWindow() { panel.setContext(&window); }
    WindowContext window;
    QPlcWidget panel;
};

}  // namespace

class tst_SignalModels : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void emptyTreeIsAValidModel();
    void theTreeShowsPlantsNodesSignalsAndElements();
    void aSignalMovesToTheNodeThatWritesIt();
    void removedPlantRemovesItsRows();
    void visibleRowsAreUpdatedAtMostTenTimesASecond();
    void draggedRowsAreReferences();
    void everyWordOfASearchMustOccur_data();
    void everyWordOfASearchMustOccur();
    void chosenSignalsShowRangeQualityAndRate();
    void placeholderShowsItsSignalWhenItAppears();
    void signalsAreDroppedIntoTheTableOnce();
    void textsAreShort();
    void numbersOfTheTreeFitInNineCharacters_data();
    void numbersOfTheTreeFitInNineCharacters();
};

void tst_SignalModels::emptyTreeIsAValidModel()
{
    PlantList plants;
    SignalTreeModel tree(&plants);
    const QAbstractItemModelTester tester(&tree, fatal);
    QCOMPARE(tree.rowCount(), 0);
    QVERIFY(!tree.find(reference("count")).isValid());
    QVERIFY(tree.references({}).isEmpty());
    plants.add(QStringLiteral("127.0.0.1:%1").arg(freePort()), QStringLiteral("nobody"));
    QCOMPARE(linesOf(tree), QStringList{QStringLiteral("nobody")});
    QTRY_COMPARE(tree.index(0, SignalTreeModel::Value).data().toString(), QStringLiteral("not there"));
}

void tst_SignalModels::theTreeShowsPlantsNodesSignalsAndElements()
{
    RunningMaster master;
    PlantList plants;
    SignalTreeModel tree(&plants);
    const QAbstractItemModelTester tester(&tree, fatal);
    plants.add(master.address(), QStringLiteral("kite"));
    const QStringList expected{"kite",     " Counter",         "  count",    "  sum",      " Not written", "  time",
                               "  jitter", "  masterWorkload", "  workload", "  setpoint", "  echo",       "  vector",
                               "   [0]",   "   [1]",           "   [2]",     "  free"};
    QTRY_COMPARE(linesOf(tree), expected);
    const QModelIndex setpoint = tree.find(reference("setpoint"));
    QCOMPARE(setpoint.siblingAtColumn(SignalTreeModel::Unit).data().toString(), QStringLiteral("m/s"));
    QVERIFY(setpoint.data(Qt::ToolTipRole).toString().contains(QStringLiteral("-10 ... 10 m/s")));
    QVERIFY(master.setSignalValue(QStringLiteral("vector"), QPlcValue({1.0, 2.5, 3.0})));
    const QModelIndex element = tree.find(reference("kite/vector[1]"));
    QCOMPARE(element.data().toString(), QStringLiteral("[1]"));
    QCOMPARE(element.data(SignalTreeModel::ReferenceRole).toString(), QStringLiteral("vector[1]"));
    QTRY_COMPARE(element.siblingAtColumn(SignalTreeModel::Value).data().toString(), QStringLiteral("2.5"));
    QTRY_COMPARE(element.parent().siblingAtColumn(SignalTreeModel::Value).data().toString(),
                 QStringLiteral("[1, 2.5, 3]"));
    QVERIFY(!tree.find(reference("vector[3]")).isValid());
}

void tst_SignalModels::aSignalMovesToTheNodeThatWritesIt()
{
    RunningMaster master;
    PlantList plants;
    SignalTreeModel tree(&plants);
    const QAbstractItemModelTester tester(&tree, fatal);
    plants.add(master.address(), QStringLiteral("kite"));
    QTRY_VERIFY(linesOf(tree).contains(QStringLiteral(" Counter")));
    const QPersistentModelIndex setpoint = tree.find(reference("setpoint"));
    auto echo = std::make_unique<EchoNode>(QStringLiteral("Aa"));
    echo->setSignalTable(testTable());
    QVERIFY(echo->connectToMasterAndWaitForConnected(master.protocol("tcp")));
    QTRY_COMPARE(linesOf(tree).mid(0, 4), (QStringList{"kite", " Aa", "  echo", " Counter"}));
    echo->disconnectFromMaster();
    echo.reset();
    QTRY_VERIFY(!linesOf(tree).contains(QStringLiteral(" Aa")));
    QCOMPARE(tree.find(reference("echo")).row(), 5);  // between setpoint and vector, as in the table
    QVERIFY(setpoint.isValid());
    QCOMPARE(setpoint.data().toString(), QStringLiteral("setpoint"));
}

void tst_SignalModels::removedPlantRemovesItsRows()
{
    RunningMaster north;
    RunningMaster south;
    PlantList plants;
    SignalTreeModel tree(&plants);
    const QAbstractItemModelTester tester(&tree, fatal);
    Plant *first = plants.add(north.address(), QStringLiteral("north"));
    plants.add(south.address(), QStringLiteral("south"));
    QTRY_COMPARE(linesOf(tree).filter(QStringLiteral("count")).size(), 2);
    QCOMPARE(tree.find(reference("south/count")).data(SignalTreeModel::ReferenceRole).toString(),
             QStringLiteral("south/count"));
    plants.remove(first);
    QCOMPARE(linesOf(tree).filter(QStringLiteral("count")).size(), 1);
    QCOMPARE(linesOf(tree).constFirst(), QStringLiteral("south"));
    QCOMPARE(tree.find(reference("south/count")).data(SignalTreeModel::ReferenceRole).toString(),
             QStringLiteral("count"));
}

void tst_SignalModels::visibleRowsAreUpdatedAtMostTenTimesASecond()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    PlantList plants;
    SignalTreeModel tree(&plants);
    Plant *plant = plants.add(master.address());
    QTRY_VERIFY(tree.find(reference("count")).parent().data().toString() == QLatin1String("Counter"));
    QTRY_VERIFY(plant->values().rows() > 10);
    QTest::qWait(3 * SignalTreeModel::RefreshPause);
    QSignalSpy changes(&tree, &QAbstractItemModel::dataChanged);
    const quint64 rows = plant->values().rows();
    QTRY_VERIFY(plant->values().rows() > rows + 50);
    QCOMPARE(changes.size(), 0);  // nobody looks

    bool wasStale = false;  // on a loaded computer: then all rows change
    connect(&tree, &QAbstractItemModel::dataChanged, plant,
            [&] { wasStale = wasStale || plant->quality() != Plant::Good; });
    QTreeView view;
    view.setModel(&tree);
    view.setUniformRowHeights(true);
    view.resize(400, 400);
    view.expandAll();
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
    QElapsedTimer time;
    time.start();
    changes.clear();
    QTRY_VERIFY(changes.size() > 5);
    int ofCounter = 0;
    for (const QList<QVariant> &change : qAsConst(changes)) {
        const QString node = change.at(0).toModelIndex().parent().data().toString();
        ofCounter += node == QLatin1String("Counter") ? 1 : 0;
        QVERIFY2(node == QLatin1String("Counter") || wasStale, qPrintable(node));
        QCOMPARE(change.at(0).toModelIndex().column(), int(SignalTreeModel::Value));
    }
    QVERIFY(double(ofCounter)
            <= double(time.elapsed()) / SignalTreeModel::RefreshPause * 2 + 2);  // count, sum: a range or two
    view.collapseAll();
    QTest::qWait(3 * SignalTreeModel::RefreshPause);
    changes.clear();
    QTest::qWait(3 * SignalTreeModel::RefreshPause);
    QCOMPARE(changes.size(), 0);
}

void tst_SignalModels::draggedRowsAreReferences()
{
    RunningMaster master;
    PlantList plants;
    SignalTreeModel tree(&plants);
    plants.add(master.address(), QStringLiteral("kite"));
    QTRY_VERIFY(linesOf(tree).contains(QStringLiteral(" Counter")));
    const QModelIndex vector = tree.find(reference("vector[2]"));
    const QModelIndex group = tree.find(reference("count")).parent();
    const std::unique_ptr<QMimeData> data(
        tree.mimeData({vector, vector.siblingAtColumn(1), group, tree.find(reference("count"))}));
    QCOMPARE(data->data(QStringLiteral("application/x-qtplc-signals")), QByteArray(R"(["vector[2]","count","sum"])"));
    QCOMPARE(referencesIn(data.get()).size(), 3);
    QVERIFY(tree.flags(vector) & Qt::ItemIsDragEnabled);
    QVERIFY(!tree.mimeData({}));
    QMimeData garbage;
    garbage.setData(signalsMimeType(), R"([1, "a b", "x", {}])");
    QCOMPARE(referencesIn(&garbage), QVector<SignalReference>{reference("x")});
    garbage.setData(signalsMimeType(), "no JSON");
    QVERIFY(referencesIn(&garbage).isEmpty());
}

void tst_SignalModels::everyWordOfASearchMustOccur_data()
{
    QTest::addColumn<QString>("search");
    QTest::addColumn<QStringList>("found");
    QTest::newRow("name") << "SETP" << QStringList{"kite", " Not written", "  setpoint"};
    QTest::newRow("unit") << "m/s" << QStringList{"kite", " Not written", "  setpoint"};
    QTest::newRow("node") << "counter" << QStringList{"kite", " Counter", "  count", "  sum"};
    QTest::newRow("two words") << "  counter   s" << QStringList{"kite", " Counter", "  sum"};
    QTest::newRow("array") << "vector" << QStringList{"kite", " Not written", "  vector", "   [0]", "   [1]", "   [2]"};
    QTest::newRow("nothing") << "counter nowhere" << QStringList();
}

void tst_SignalModels::everyWordOfASearchMustOccur()
{
    QFETCH(QString, search);
    RunningMaster master;
    PlantList plants;
    SignalTreeModel tree(&plants);
    SignalFilterModel filter;
    const QAbstractItemModelTester tester(&filter, fatal);
    filter.setSourceModel(&tree);
    plants.add(master.address(), QStringLiteral("kite"));
    QTRY_VERIFY(linesOf(tree).contains(QStringLiteral(" Counter")));
    QCOMPARE(linesOf(filter), linesOf(tree));
    filter.setSearch(search);
    QTEST(linesOf(filter), "found");
    filter.setSearch(QString());
    QCOMPARE(linesOf(filter), linesOf(tree));
}

void tst_SignalModels::chosenSignalsShowRangeQualityAndRate()
{
    RunningMaster master;
    PanelInWindow bench;
    PlantList &plants = *bench.window.plants();
    ValueTableModel table(bench.panel.context());
    const QAbstractItemModelTester tester(&table, fatal);
    table.setReferences({reference("count"), reference("setpoint"), reference("time"), reference("vector")});
    Plant *plant = plants.add(master.address());
    QTRY_COMPARE(cellText(table, 0, ValueTableModel::QualityColumn), QStringLiteral("at rest"));
    QCOMPARE(cellText(table, 0, ValueTableModel::Minimum), QStringLiteral("–"));
    QTRY_COMPARE(master.nodes().size(), 2);  // the window hears the first cycles
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(cellText(table, 0, ValueTableModel::QualityColumn), QStringLiteral("good"));
    QTRY_VERIFY(cellText(table, 0, ValueTableModel::Maximum).toInt() > 50);
    const SignalStore *store = plant->store();  // a loaded computer may hear the first cycles too late
    const int count = plant->values().channels().channel(plant->table().indexOf(QStringLiteral("count")));
    QCOMPARE(cellText(table, 0, ValueTableModel::Minimum).toFloat(), store->value(count, store->firstRow()));
    QTRY_VERIFY(cellText(table, 0, ValueTableModel::Rate).endsWith(QStringLiteral(" Hz")));
    QCOMPARE(cellText(table, 2, ValueTableModel::Minimum), QString());
    QCOMPARE(cellText(table, 3, ValueTableModel::Minimum), QString());
    QCOMPARE(cellText(table, 3, ValueTableModel::Value), QStringLiteral("[0, 0, 0]"));
    QCOMPARE(cellText(table, 1, ValueTableModel::QualityColumn), QStringLiteral("not written"));
    QCOMPARE(cellText(table, 1, ValueTableModel::Age), QString());
    QVERIFY(table.index(1, 0).data(Qt::ForegroundRole).isValid());
    // A spike of few cycles between two looks at the table counts.
    QVERIFY(master.setSignalValue(QStringLiteral("setpoint"), 9.0));
    QTest::qWait(40);
    QVERIFY(master.setSignalValue(QStringLiteral("setpoint"), 1.0));
    QTRY_COMPARE(cellText(table, 1, ValueTableModel::Value), QStringLiteral("1"));
    QTRY_COMPARE(cellText(table, 1, ValueTableModel::Maximum), QStringLiteral("9"));
    QTRY_COMPARE(cellText(table, 1, ValueTableModel::QualityColumn), QStringLiteral("good"));
    table.reset();
    QCOMPARE(cellText(table, 1, ValueTableModel::Maximum), QStringLiteral("1"));
    plant->close();
    QTRY_COMPARE(cellText(table, 0, ValueTableModel::QualityColumn), QStringLiteral("stale"));
    QVERIFY(table.index(0, 0).data(Qt::ForegroundRole).isValid());
    plants.remove(plant);
    QCOMPARE(cellText(table, 0, ValueTableModel::QualityColumn), QStringLiteral("not there"));
}

void tst_SignalModels::placeholderShowsItsSignalWhenItAppears()
{
    RunningMaster master;
    PanelInWindow bench;
    PlantList &plants = *bench.window.plants();
    ValueTableModel table(bench.panel.context());
    const QAbstractItemModelTester tester(&table, fatal);
    table.setReferences({reference("kite/count"), reference("kite/nowhere")});
    QCOMPARE(cellText(table, 0, ValueTableModel::QualityColumn), QStringLiteral("not there"));
    plants.add(master.address(), QStringLiteral("kite"));
    QTRY_COMPARE(cellText(table, 0, ValueTableModel::QualityColumn), QStringLiteral("at rest"));
    QCOMPARE(cellText(table, 1, ValueTableModel::Name), QStringLiteral("kite/nowhere"));
    QCOMPARE(cellText(table, 1, ValueTableModel::QualityColumn), QStringLiteral("not there"));
    QCOMPARE(table.references().at(1), reference("kite/nowhere"));
}

void tst_SignalModels::signalsAreDroppedIntoTheTableOnce()
{
    PanelInWindow bench;
    ValueTableModel table(bench.panel.context());
    const QAbstractItemModelTester tester(&table, fatal);
    const auto drop = [&](const QVector<SignalReference> &references, int row) {
        return table.dropMimeData(mimeDataOf(references).get(), Qt::CopyAction, row, 0, {});
    };
    QVERIFY(drop({reference("a"), reference("b"), reference("a")}, -1));
    QVERIFY(drop({reference("c"), reference("b")}, 1));
    QCOMPARE(table.references(), (QVector<SignalReference>{reference("a"), reference("c"), reference("b")}));
    QMimeData nothing;
    QVERIFY(!table.dropMimeData(&nothing, Qt::CopyAction, -1, 0, {}));
    QVERIFY(!table.removeRows(2, 2));
    QVERIFY(table.removeRows(0, 2));
    QCOMPARE(table.references(), QVector<SignalReference>{reference("b")});
    QVERIFY(!table.mimeData({}));
}

void tst_SignalModels::textsAreShort()
{
    QCOMPARE(valueText({}), QString());
    QCOMPARE(valueText(0.1F), QStringLiteral("0.1"));
    QCOMPARE(valueText(1.0 / 3.0), QStringLiteral("0.3333333333"));
    QCOMPARE(valueText(-7), QStringLiteral("-7"));
    QCOMPARE(valueText(QPlcValue({1, 2})), QStringLiteral("[1, 2]"));
    QCOMPARE(valueText(QPlcValue("text")), QStringLiteral("text"));
    QVERIFY(
        valueText(QPlcValue(QPlcSignalType(QPlcSignalType::Real32, 100))).endsWith(QStringLiteral("… 100 elements]")));
    QCOMPARE(numberText(std::numeric_limits<double>::quiet_NaN()), QStringLiteral("–"));
    QCOMPARE(ageText(-1), QString());
    QCOMPARE(ageText(0.01), QStringLiteral("< 0.1 s"));
    QCOMPARE(ageText(1.24), QStringLiteral("1.2 s"));
    QCOMPARE(ageText(150), QStringLiteral("2 min"));
    QCOMPARE(ageText(7300), QStringLiteral("2 h"));
    QCOMPARE(durationText(0), QStringLiteral("0 µs"));
    QCOMPARE(durationText(12345), QStringLiteral("12.3 µs"));
    QCOMPARE(durationText(999.7e3), QStringLiteral("1 ms"));
    QCOMPARE(durationText(4.567e6), QStringLiteral("4.57 ms"));
    QCOMPARE(durationText(2e9), QStringLiteral("2 s"));
}

void tst_SignalModels::numbersOfTheTreeFitInNineCharacters_data()
{
    QTest::addColumn<QPlcValue>("value");
    QTest::addColumn<QString>("expected");
    QTest::newRow("none") << QPlcValue() << QString();
    QTest::newRow("zero") << QPlcValue(0.0) << QStringLiteral("0");
    QTest::newRow("six digits") << QPlcValue(-11.812134) << QStringLiteral("-11.8121");
    QTest::newRow("small") << QPlcValue(-4.38691e-05) << QStringLiteral("-4.39e-05");
    QTest::newRow("zeros first") << QPlcValue(0.000161511) << QStringLiteral("0.0001615");
    QTest::newRow("large") << QPlcValue(-123456789.0) << QStringLiteral("-1.23e+08");
    QTest::newRow("not a number") << QPlcValue(std::numeric_limits<double>::quiet_NaN()) << QStringLiteral("–");
    QTest::newRow("integer, in full") << QPlcValue(1234567890) << QStringLiteral("1234567890");
    QTest::newRow("elements") << QPlcValue({80.32243, -764.9438, 12345.6}) << QStringLiteral("[80.3, -765, 12346]");
    QTest::newRow("text") << QPlcValue("reel out") << QStringLiteral("reel out");
    const QDateTime time(QDate(2026, 1, 31), QTime(12, 0, 1, 259));
    QTest::newRow("time") << QPlcValue(time) << QStringLiteral("12:00:01.2");
}

void tst_SignalModels::numbersOfTheTreeFitInNineCharacters()
{
    QFETCH(QPlcValue, value);
    QTEST(shortValueText(value), "expected");
}

QTEST_MAIN(tst_SignalModels)
#include "tst_SignalModels.moc"
