// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "QPlcEventLog.h"
#include "QPlcNodeTable.h"
#include "QPlcValueTable.h"
#include "TableText.h"
#include "gui/models/EventLogModel.h"
#include "gui/models/NodeTableModel.h"
#include "gui/panel/WindowContext.h"
#include "gui/tables/TableDelegate.h"
#include "gui/tables/ValueTableModel.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtGui/QClipboard>
#include <QtGui/QStandardItemModel>
#include <QtWidgets/QAction>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QHeaderView>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QScrollBar>
#include <QtWidgets/QTreeView>

using namespace qplc;

namespace {

/// A panel of a window with one plant.
template<typename Panel>
class Bench
{
public:
    explicit Bench(const QJsonObject &settings = {})
    {
        plant = context.plants()->add(master.address(), QStringLiteral("kite"), QStringLiteral("Window"));
        panel.setContext(&context);
        panel.applySettings(settings);
        panel.resize(700, 200);
        panel.show();
        view = panel.template findChild<QTreeView *>();
    }
    QString cell(int row, int column) const { return cellText(*view->model(), row, column); }
    QStringList cells(int column) const { return columnTexts(*view->model(), column); }
    void select(int row)
    {
        view->selectionModel()->select(view->model()->index(row, 0),
                                       QItemSelectionModel::Select | QItemSelectionModel::Rows);
    }
    void trigger(const char *text)
    {
        for (QAction *action : panel.actions()) {
            if (action->text() == QLatin1String(text))
                return action->trigger();
        }
        QFAIL(text);
    }

    RunningMaster master;
    WindowContext context;
    Plant *plant;
    Panel panel;
    QTreeView *view;
};

/// Shows a log as a window does.
bool openLog(QPlcEventLog *log, WindowContext *context)
{
    log->setContext(context);
    log->show();
    log->activateWindow();
    return QTest::qWaitForWindowActive(log);
}

PlantEvent eventOf(PlantEvent::Severity severity, const QString &text)
{
    return {QDateTime(QDate(2026, 1, 31), QTime(12, 0, 1, 250)), severity, QStringLiteral("kite"), text, false};
}

template<typename Panel>
void verifySettings(const QByteArray &json)
{
    const QJsonObject settings = QJsonDocument::fromJson(json).object();
    Panel alone;
    alone.applySettings(settings);
    QCOMPARE(QJsonDocument(alone.settings()).toJson(QJsonDocument::Compact), json);
    alone.show();
    Bench<Panel> bench(settings);
    QCOMPARE(QJsonDocument(bench.panel.settings()).toJson(QJsonDocument::Compact), json);
    bench.panel.applySettings({});
    QCOMPARE(bench.panel.settings().keys(), QJsonObject::fromVariantMap({{"later", 1}, {"title", "T"}}).keys());
}

}  // namespace

class tst_Tables : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void settingsAreRestoredByteForByte();
    void signalsAreAddedOnceAndRemoved();
    void aSignalIsAddedByKeys();
    void missingSignalsAndStaleValuesAreMarked();
    void valuesAreSortedAsNumbersAndDoNotJump();
    void selectedRowsAreCopiedWithTabs();
    void pastValuesShowTheirTime();
    void columnsAreChosenInAMenu();
    void narrowTablesLeaveOutTheLessImportantColumns();
    void addedColumnsStayInANarrowTable();
    void nodeTableShowsTheHealthOfEachNode();
    void columnsOfNodesGrowWithTheirTexts();
    void aLongNameGetsItsSpace();
    void longNamesAreElidedInTheMiddle();
    void aWindowWithoutPlantsHasAnEmptyTable();
    void eventsAreFilteredAndAcknowledged();
    void logScrollsToNewEventsUnlessTheUserScrolledBack();
    void anEventLeadsToItsTime();
};

void tst_Tables::settingsAreRestoredByteForByte()
{
    verifySettings<QPlcValueTable>(
        R"({"columns":["signal","rate"],"descending":true,"later":1,"search":"count","signals":["count",)"
        R"("north/sum","nowhere[2]"],"sort":"value","title":"T"})");
    verifySettings<QPlcNodeTable>(R"({"columns":["rejected","node"],"later":1,"sort":"late","title":"T"})");
    verifySettings<QPlcEventLog>(
        R"({"columns":["event"],"later":1,"search":"a b","severity":"warning","title":"T","unacknowledged":true})");
}

void tst_Tables::signalsAreAddedOnceAndRemoved()
{
    Bench<QPlcValueTable> bench;
    QSignalSpy edits(&bench.panel, &QPlcWidget::settingsEdited);
    const auto *hint = bench.panel.findChildren<QLabel *>().last();
    QVERIFY(hint->isVisible());
    QVERIFY(!bench.panel.addSignals({"[[", ""}));
    QVERIFY(bench.panel.addSignals({"count", "sum", "count", "jitter"}));
    QVERIFY(bench.panel.addSignals({"sum"}));
    QVERIFY(!hint->isVisible());
    QCOMPARE(bench.panel.settings(), (QJsonObject{{"signals", QJsonArray{"count", "sum", "jitter"}}}));
    QCOMPARE(edits.size(), 1);
    bench.select(0);
    bench.select(2);
    bench.trigger("Remove the selected signals");
    QCOMPARE(bench.panel.settings(), (QJsonObject{{"signals", QJsonArray{"sum"}}}));
    bench.select(0);
    bench.trigger("Remove the selected signals");
    QCOMPARE(bench.panel.settings(), QJsonObject());
    QVERIFY(hint->isVisible());
}

void tst_Tables::aSignalIsAddedByKeys()
{
    Bench<QPlcValueTable> bench;
    QTRY_VERIFY(!bench.plant->table().isEmpty());
    bench.trigger("Add a signal");
    auto *edit = bench.panel.findChild<QLineEdit *>();
    QVERIFY(edit);
    QTest::keyClicks(edit, QStringLiteral("vector[1]"));
    QTest::keyClick(edit, Qt::Key_Return);
    QCOMPARE(bench.cells(ValueTableModel::Name), QStringList{QStringLiteral("vector[1]")});
    QTRY_COMPARE(edit->text(), QString());
}

void tst_Tables::missingSignalsAndStaleValuesAreMarked()
{
    Bench<QPlcValueTable> bench({{"signals", QJsonArray{"kite/count", "nowhere"}}});
    QTRY_COMPARE(bench.cell(0, ValueTableModel::QualityColumn), QStringLiteral("at rest"));
    QCOMPARE(bench.cell(1, ValueTableModel::QualityColumn), QStringLiteral("not there"));
    bench.plant->close();
    QTRY_COMPARE(bench.cell(0, ValueTableModel::QualityColumn), QStringLiteral("stale"));
    QVERIFY(bench.view->model()->index(0, 0).data(Qt::ForegroundRole).isValid());
    const auto *strip = bench.panel.findChildren<QLabel *>().first();
    QTRY_VERIFY(strip->isVisible());
    QVERIFY(strip->text().startsWith(QStringLiteral("kite: values are ")));
}

void tst_Tables::valuesAreSortedAsNumbersAndDoNotJump()
{
    Bench<QPlcValueTable> bench({{"signals", QJsonArray{"setpoint", "echo", "free"}}});
    QTRY_COMPARE(bench.plant->quality(), Plant::AtRest);
    const auto set = [&](double setpoint, double echo, double free) {
        bench.plant->setValues({{QStringLiteral("setpoint"), QPlcValue(setpoint)},
                                {QStringLiteral("echo"), QPlcValue(echo)},
                                {QStringLiteral("free"), QPlcValue(float(free))}});
        bench.plant->refresh();
    };
    set(9.0, 10.0, -3.0);
    QTRY_COMPARE(bench.cells(ValueTableModel::Value), (QStringList{"9", "10", "-3"}));
    QSignalSpy edits(&bench.panel, &QPlcWidget::settingsEdited);
    const QHeaderView *header = bench.view->header();
    const auto click = [&] {
        QTest::mouseClick(header->viewport(), Qt::LeftButton, {},
                          QPoint(header->sectionViewportPosition(ValueTableModel::Value) + 20, header->height() / 2));
    };
    click();
    QCOMPARE(bench.cells(ValueTableModel::Value), (QStringList{"-3", "9", "10"}));
    click();
    QCOMPARE(bench.cells(ValueTableModel::Value), (QStringList{"10", "9", "-3"}));
    QCOMPARE(bench.panel.settings().value(QStringLiteral("descending")), QJsonValue(true));
    set(1.0, 2.0, 3.0);
    QTRY_COMPARE(bench.cells(ValueTableModel::Value), (QStringList{"2", "1", "3"}));
    click();
    QCOMPARE(bench.cells(ValueTableModel::Value), (QStringList{"1", "2", "3"}));
    QCOMPARE(edits.size(), 3);
    QVERIFY(!bench.panel.settings().contains(QStringLiteral("sort")));
}

void tst_Tables::selectedRowsAreCopiedWithTabs()
{
    Bench<QPlcValueTable> bench(
        {{"signals", QJsonArray{"count", "setpoint", "nowhere"}}, {"columns", QJsonArray{"signal", "unit"}}});
    QTRY_COMPARE(bench.cell(1, ValueTableModel::Unit), QStringLiteral("m/s"));
    bench.trigger("Copy as text");
    QCOMPARE(QGuiApplication::clipboard()->text(), QStringLiteral("Signal\tUnit\ncount\t\nsetpoint\tm/s\nnowhere\t\n"));
    bench.select(1);
    bench.trigger("Copy as text");
    QCOMPARE(QGuiApplication::clipboard()->text(), QStringLiteral("Signal\tUnit\nsetpoint\tm/s\n"));
}

void tst_Tables::pastValuesShowTheirTime()
{
    Bench<QPlcValueTable> bench({{"signals", QJsonArray{"count"}}});
    QVERIFY(bench.master.startRealTime());
    QTRY_VERIFY(bench.plant->store() && bench.plant->store()->endRow() > bench.plant->store()->firstRow() + 20);
    const SignalStore::Row row = bench.plant->store()->firstRow() + 5;
    const int channel = bench.plant->values().channels().channel(bench.plant->table().indexOf(QStringLiteral("count")));
    const QString expected = QString::number(int(bench.plant->store()->value(channel, row)));
    auto *strip = bench.panel.findChildren<QLabel *>().first();
    QVERIFY(!strip->isVisible());
    bench.context.timeAxis()->show(1, bench.plant->store()->time(row));
    QVERIFY(strip->isVisible());
    QVERIFY(strip->text().startsWith(QStringLiteral("Values at ")));
    QCOMPARE(bench.cell(0, ValueTableModel::Value), expected);
    QCOMPARE(bench.cell(0, ValueTableModel::QualityColumn), QStringLiteral("past"));
    bench.context.timeAxis()->show(1, 1'000'000'000);
    QCOMPARE(bench.cell(0, ValueTableModel::QualityColumn), QStringLiteral("no value"));
    bench.context.timeAxis()->goLive();
    QVERIFY(!strip->isVisible());
    QCOMPARE(bench.cell(0, ValueTableModel::QualityColumn), QStringLiteral("good"));
}

void tst_Tables::columnsAreChosenInAMenu()
{
    Bench<QPlcNodeTable> bench;
    QSignalSpy edits(&bench.panel, &QPlcWidget::settingsEdited);
    QMenu *menu = bench.panel.actions().last()->menu();
    QVERIFY(menu);
    QCOMPARE(menu->actions().size(), NodeTableModel::ColumnCount - 1);
    QVERIFY(bench.view->isColumnHidden(NodeTableModel::Forged));
    menu->actions().last()->trigger();
    QVERIFY(!bench.view->isColumnHidden(NodeTableModel::Forged));
    QCOMPARE(edits.size(), 1);
    QVERIFY(bench.panel.settings().value(QStringLiteral("columns")).toArray().contains(QStringLiteral("forged")));
    menu->actions().last()->trigger();
    QCOMPARE(bench.panel.settings(), QJsonObject());
    Q_EMIT bench.view->header()->customContextMenuRequested(QPoint(5, 5));
    QMenu *popup = qobject_cast<QMenu *>(QApplication::activePopupWidget());
    QVERIFY(popup);
    popup->close();
}

void tst_Tables::narrowTablesLeaveOutTheLessImportantColumns()
{
    Bench<QPlcEventLog> log;
    log.context.events()->append(eventOf(PlantEvent::Error, QStringLiteral("Node 'Winch' did not answer in time")));
    Bench<QPlcValueTable> values;
    QVERIFY(values.panel.addSignals({"count"}));
    for (const int width : {700, 420, 300}) {
        log.panel.resize(width, 200);
        values.panel.resize(width, 200);
        QTRY_COMPARE(log.view->horizontalScrollBar()->maximum(), 0);
        QTRY_COMPARE(values.view->horizontalScrollBar()->maximum(), 0);
    }
    QVERIFY(!log.view->isColumnHidden(EventLogModel::Time));
    QVERIFY(!log.view->isColumnHidden(EventLogModel::Text));
    QVERIFY(log.view->isColumnHidden(EventLogModel::Source));
    QVERIFY(!values.view->isColumnHidden(ValueTableModel::Value));
    QVERIFY(values.view->isColumnHidden(ValueTableModel::Minimum));
    QCOMPARE(log.panel.settings(), QJsonObject());  // the columns are chosen as before
    log.panel.resize(1400, 200);
    values.panel.resize(1400, 200);
    QVERIFY(!log.view->isColumnHidden(EventLogModel::Source));
    QVERIFY(!values.view->isColumnHidden(ValueTableModel::Minimum));
}

void tst_Tables::addedColumnsStayInANarrowTable()
{
    Bench<QPlcValueTable> bench;
    QVERIFY(bench.panel.addSignals({"count"}));
    bench.panel.resize(300, 200);
    QTRY_VERIFY(bench.view->isColumnHidden(ValueTableModel::Minimum));
    QMenu *menu = bench.panel.actions().last()->menu();
    const auto choose = [&](int column) {
        Q_EMIT menu->aboutToShow();
        const QString title = bench.view->model()->headerData(column, Qt::Horizontal).toString();
        for (QAction *action : menu->actions()) {
            if (action->text() == title)
                action->trigger();
        }
    };
    for (const int column : {ValueTableModel::Rate, ValueTableModel::Minimum}) {
        choose(column);
        QVERIFY(!bench.view->isColumnHidden(column));
    }
    bench.panel.resize(290, 200);
    QVERIFY(!bench.view->isColumnHidden(ValueTableModel::Rate));
    QVERIFY(!bench.view->isColumnHidden(ValueTableModel::Minimum));
    QVERIFY(bench.view->isColumnHidden(ValueTableModel::Maximum));
    const QJsonObject settings = bench.panel.settings();

    choose(ValueTableModel::Rate);
    QVERIFY(bench.view->isColumnHidden(ValueTableModel::Rate));
    bench.panel.applySettings(settings);  // as a window does after a start, or an undo
    QVERIFY(!bench.view->isColumnHidden(ValueTableModel::Rate));
}

void tst_Tables::nodeTableShowsTheHealthOfEachNode()
{
    Bench<QPlcNodeTable> bench;
    QTRY_COMPARE(bench.cells(NodeTableModel::Name), (QStringList{"Master", "Counter", "Window"}));
    QTRY_COMPARE(bench.cells(NodeTableModel::Health), (QStringList{"OK", "OK", "OK"}));
    bench.plant->close();
    QTRY_COMPARE(bench.cells(NodeTableModel::Health), (QStringList{"Unavailable", "Unavailable"}));  // without itself
    QVERIFY(!bench.view->grab().isNull());
}

void tst_Tables::columnsOfNodesGrowWithTheirTexts()
{
    Bench<QPlcNodeTable> bench;
    bench.panel.resize(632, 200);
    QTRY_COMPARE(bench.cells(NodeTableModel::Health), (QStringList{"OK", "OK", "OK"}));
    const QFontMetrics metrics(bench.view->font());
    QVERIFY(bench.view->columnWidth(NodeTableModel::Health) > metrics.horizontalAdvance(QStringLiteral("Unavailable")));
    QVERIFY(bench.view->columnWidth(NodeTableModel::State)
            > metrics.horizontalAdvance(QStringLiteral("good, was late")));
    for (const int column : {NodeTableModel::Name, NodeTableModel::RoundTripP99, NodeTableModel::Lost})
        QTRY_VERIFY(bench.view->columnWidth(column)
                    >= bench.view->header()->fontMetrics().horizontalAdvance(
                           bench.view->model()->headerData(column, Qt::Horizontal).toString())
                        + 8);
    const int figure = QFontMetrics(bench.view->font()).horizontalAdvance(QLatin1Char('0'));
    QVERIFY(bench.view->columnWidth(NodeTableModel::RoundTripP99) > 8 * figure + 12);
    // What a person makes narrow stays so.
    bench.view->setColumnWidth(NodeTableModel::RoundTripP99, 40);
    QSignalSpy changes(bench.view->model(), &QAbstractItemModel::dataChanged);
    QTRY_VERIFY(changes.size() > 2);
    QCOMPARE(bench.view->columnWidth(NodeTableModel::RoundTripP99), 40);
}

void tst_Tables::aLongNameGetsItsSpace()
{
    Bench<QPlcNodeTable> bench;
    bench.panel.resize(632, 200);
    const int before = bench.view->columnWidth(NodeTableModel::Name);
    const QString name = QStringLiteral("ControlCenterOfTheWinch-329");
    bench.context.plants()->add(bench.master.address(), QStringLiteral("again"), name);
    QTRY_VERIFY(bench.cells(NodeTableModel::Name).contains(QStringLiteral("again/") + name));
    QTRY_VERIFY(bench.view->columnWidth(NodeTableModel::Name) > before);
}

void tst_Tables::longNamesAreElidedInTheMiddle()
{
    class Open : public TableDelegate
    {
    public:
        using TableDelegate::initStyleOption;
        using TableDelegate::TableDelegate;
    };
    QStandardItemModel model(1, 2);
    Open delegate(nullptr);
    QStyleOptionViewItem option;
    delegate.initStyleOption(&option, model.index(0, 0));
    QCOMPARE(option.textElideMode, Qt::ElideRight);
    delegate.setNameColumn(0);
    delegate.initStyleOption(&option, model.index(0, 0));
    QCOMPARE(option.textElideMode, Qt::ElideMiddle);
    delegate.initStyleOption(&option, model.index(0, 1));
    QCOMPARE(option.textElideMode, Qt::ElideRight);
}

void tst_Tables::aWindowWithoutPlantsHasAnEmptyTable()
{
    WindowContext context;
    QPlcNodeTable table;
    table.setContext(&context);
    table.show();
    QCOMPARE(table.findChild<QTreeView *>()->model()->rowCount(), 0);
}

void tst_Tables::eventsAreFilteredAndAcknowledged()
{
    WindowContext context;
    QPlcEventLog log;
    QVERIFY(openLog(&log, &context));
    const QAbstractItemModel *shown = log.findChild<QTreeView *>()->model();
    context.events()->append(eventOf(PlantEvent::Information, QStringLiteral("begin")));
    context.events()->append(eventOf(PlantEvent::Warning, QStringLiteral("late")));
    context.events()->append(eventOf(PlantEvent::Error, QStringLiteral("lost")));
    QSignalSpy edits(&log, &QPlcWidget::settingsEdited);
    QCOMPARE(shown->rowCount(), 3);
    auto *severity = log.findChild<QComboBox *>();
    QTest::keyClick(severity, Qt::Key_Down);
    QCOMPARE(shown->rowCount(), 2);
    QCOMPARE(log.settings(), (QJsonObject{{"severity", "warning"}}));
    QTest::keyClicks(log.findChild<QLineEdit *>(QStringLiteral("search")), QStringLiteral("los"));
    QCOMPARE(shown->rowCount(), 1);
    log.findChild<QLineEdit *>(QStringLiteral("search"))->clear();
    QCOMPARE(shown->rowCount(), 2);
    QCOMPARE(log.settings(), (QJsonObject{{"severity", "warning"}}));
    auto *view = log.findChild<QTreeView *>();
    view->setFocus();
    view->setCurrentIndex(shown->index(0, 0));
    QTest::keyClick(view, Qt::Key_O);
    QCOMPARE(log.settings().value(QStringLiteral("unacknowledged")), QJsonValue(true));
    QTest::keyClick(view, Qt::Key_A);
    QCOMPARE(context.events()->unacknowledged(), 1);
    QCOMPARE(shown->rowCount(), 1);
    QTest::keyClick(view, Qt::Key_A, Qt::ShiftModifier);
    QCOMPARE(context.events()->unacknowledged(), 0);
    QCOMPARE(shown->rowCount(), 0);
    QVERIFY(edits.size() > 0);
}

void tst_Tables::logScrollsToNewEventsUnlessTheUserScrolledBack()
{
    WindowContext context;
    QPlcEventLog log;
    log.setContext(&context);
    log.resize(500, 200);
    log.show();
    const QScrollBar *bar = log.findChild<QTreeView *>()->verticalScrollBar();
    const auto append = [&] {
        for (int i = 0; i < 50; ++i)
            context.events()->append(eventOf(PlantEvent::Warning, QString::number(i)));
        QCoreApplication::processEvents();
    };
    append();
    QTRY_VERIFY(bar->maximum() > 0);
    QTRY_COMPARE(bar->value(), bar->maximum());
    const_cast<QScrollBar *>(bar)->setValue(3);
    append();
    QTRY_VERIFY(bar->maximum() > 60);
    QCOMPARE(bar->value(), 3);
    const_cast<QScrollBar *>(bar)->setValue(bar->maximum());
    append();
    QTRY_VERIFY(bar->maximum() > 110);
    QTRY_COMPARE(bar->value(), bar->maximum());
}

void tst_Tables::anEventLeadsToItsTime()
{
    WindowContext context;
    QPlcEventLog log;
    QVERIFY(openLog(&log, &context));
    const PlantEvent event = eventOf(PlantEvent::Warning, QStringLiteral("late"));
    context.events()->append(eventOf(PlantEvent::Information, QStringLiteral("begin")));
    context.events()->append(event);
    context.timeAxis()->setNewest((event.time.toMSecsSinceEpoch() + 60'000) * 1'000'000);  // there are values of it
    auto *view = log.findChild<QTreeView *>();
    log.applySettings({{"severity", "warning"}});
    view->setFocus();
    view->setCurrentIndex(view->model()->index(0, 0));
    QTest::keyClick(view, Qt::Key_Return);
    const QPlcTimeAxis *time = context.timeAxis();
    QVERIFY(!time->isLive());
    QCOMPARE(time->displayTime().value_or(0), event.time.toMSecsSinceEpoch() * 1'000'000);
    QCOMPARE((time->begin() + time->end()) / 2, event.time.toMSecsSinceEpoch() * 1'000'000);
    context.timeAxis()->goLive();
    QVERIFY(!time->pointer());  // legends show what is now
}

QTEST_MAIN(tst_Tables)
#include "tst_Tables.moc"
