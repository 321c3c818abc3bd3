// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "TableText.h"
#include "gui/models/EventLogModel.h"
#include "gui/models/NodeTableModel.h"

#include <QtCore/QJsonArray>
#include <QtTest/QAbstractItemModelTester>

using namespace qplc;

namespace {

constexpr auto fatal = QAbstractItemModelTester::FailureReportingMode::QtTest;

PlantEvent eventOf(PlantEvent::Severity severity, const QString &text)
{
    return {QDateTime(QDate(2026, 1, 31), QTime(12, 0, 1, 250)), severity, QStringLiteral("kite"), text, false};
}

/// \param time  [ms] after those of other events
PlantEvent alarmOf(PlantEvent::Stage stage, const char *alarm, int time)
{
    PlantEvent event
        = eventOf(stage == PlantEvent::Begins ? PlantEvent::Warning : PlantEvent::Information, QLatin1String(alarm));
    event.time = event.time.addMSecs(time);
    event.stage = stage;
    event.alarm = QLatin1String(alarm);
    return event;
}

QStringList namesOf(const NodeTableModel &table)
{
    return columnTexts(table, NodeTableModel::Name);
}

}  // namespace

class tst_PlantModels : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void nodeTableFollowsRegistrations();
    void missingNodeKeepsItsRow();
    void safeStopIsAnErrorUntilReset();
    void newPhaseReportsNoMissingNode();
    void figuresOfNodesAreDurationsAndCounters();
    void eventsAreShownAndAcknowledged();
    void theLogIsBounded();
    void eventsAreFiltered();
    void anAlarmIsActiveUntilItEndsAcknowledgedOrNot();
    void alarmsOfTwoPlantsDoNotEndEachOther();
    void anAlarmThatBeginsAgainIsActiveOnce();
    void firstAlarmOfABurstIsMarked();
    void eachPlantHasBurstsOfItsOwn();
    void endOfADiscardedAlarmIsLoggedOnly();
    void plantEventsAreLogged();
};

void tst_PlantModels::nodeTableFollowsRegistrations()
{
    RunningMaster north;
    RunningMaster south;
    PlantList plants;
    NodeTableModel table(&plants);
    const QAbstractItemModelTester tester(&table, fatal);
    QCOMPARE(table.rowCount(), 0);
    Plant *first = plants.add(north.address(), QStringLiteral("north"), QStringLiteral("Window"));
    plants.add(south.address(), QStringLiteral("south"), QStringLiteral("Window"));
    QTRY_COMPARE(namesOf(table),
                 (QStringList{"north/Master", "north/Counter", "north/Window", "south/Master", "south/Counter",
                              "south/Window"}));
    auto echo = std::make_unique<EchoNode>();
    echo->setSignalTable(testTable());
    QVERIFY(echo->connectToMasterAndWaitForConnected(north.protocol("udp")));
    QTRY_COMPARE(namesOf(table).indexOf(QStringLiteral("north/Echo")), 3);
    QCOMPARE(cellText(table, 3, NodeTableModel::Transport), QStringLiteral("udp"));
    QCOMPARE(cellText(table, 3, NodeTableModel::Policy), QStringLiteral("ErrorZeroOrderHold"));
    QCOMPARE(cellText(table, 2, NodeTableModel::State), QStringLiteral("Listens"));
    QCOMPARE(cellText(table, 3, NodeTableModel::Late), QStringLiteral("0"));
    plants.remove(first);
    QCOMPARE(namesOf(table), (QStringList{"Master", "Counter", "Window"}));  // one plant needs no name
}

void tst_PlantModels::missingNodeKeepsItsRow()
{
    auto master = std::make_unique<RunningMaster>();
    const QString address = master->address();
    PlantList plants;
    NodeTableModel table(&plants);
    const QAbstractItemModelTester tester(&table, fatal);
    Plant *plant = plants.add(address, QStringLiteral("kite"), QStringLiteral("Window"));
    const auto cell = [&](int row, int column) { return cellText(table, row, column); };
    EchoNode echo;
    echo.setSignalTable(testTable());
    QVERIFY(echo.connectToMasterAndWaitForConnected(master->protocol("udp")));
    QTRY_COMPARE(namesOf(table).filter(QStringLiteral("Echo")).size(), 1);
    echo.disconnectFromMaster();
    const auto rowOfEcho = [&] { return namesOf(table).indexOf(QStringLiteral("Echo")); };
    QTRY_COMPARE(cell(rowOfEcho(), NodeTableModel::State), QStringLiteral("gone"));
    QCOMPARE(cell(rowOfEcho(), NodeTableModel::Health), QStringLiteral("Unavailable"));
    QCOMPARE(cell(rowOfEcho(), NodeTableModel::Late), QString());
    QVERIFY(table.index(rowOfEcho(), 0).data(Qt::ForegroundRole).isValid());
    QVERIFY(echo.connectToMasterAndWaitForConnected(master->protocol("udp")));
    QTRY_COMPARE(cell(rowOfEcho(), NodeTableModel::State), QStringLiteral("Registered"));

    master.reset();
    QTRY_COMPARE(cell(0, NodeTableModel::State), QStringLiteral("lost"));
    QVERIFY(table.index(0, NodeTableModel::State).data(Qt::ToolTipRole).toString().startsWith(QStringLiteral("Disc")));
    QCOMPARE(namesOf(table), (QStringList{"Master", "Counter", "Echo"}));  // the window itself is missed by nobody
    for (int row = 0; row < 3; ++row)
        QCOMPARE(cell(row, NodeTableModel::Health), QStringLiteral("Unavailable"));
    QCOMPARE(cell(1, NodeTableModel::State), QStringLiteral("not known"));
    plants.remove(plant);
    QCOMPARE(table.rowCount(), 0);
}

void tst_PlantModels::safeStopIsAnErrorUntilReset()
{
    RunningMaster master;
    master.setInterval(std::chrono::milliseconds(100));  // a busy computer is not to be the reason
    EchoNode echo;
    echo.setSignalTable(testTable());
    QVERIFY(echo.connectToMasterAndWaitForConnected(master.protocol("udp")));
    PlantList plants;
    NodeTableModel table(&plants);
    const QAbstractItemModelTester tester(&table, fatal);
    plants.add(master.address(), QStringLiteral("kite"), QStringLiteral("Window"));
    const auto cells = [&](int column) { return columnTexts(table, column); };
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(cells(NodeTableModel::State), (QStringList{"Real time", "Real time", "Real time", "Listens"}));
    QTRY_COMPARE(cells(NodeTableModel::Health), (QStringList{"OK", "OK", "OK", "OK"}));
    master.safeStop(QStringLiteral("smoke at the winch"));
    QTRY_COMPARE(cells(NodeTableModel::State), (QStringList{"Safe stop", "Safe stop", "Safe stop", "Safe stop"}));
    QCOMPARE(cells(NodeTableModel::Health), (QStringList{"Error", "Error", "Error", "Error"}));
    QTRY_VERIFY(master.reset());
    QTRY_COMPARE(cells(NodeTableModel::State).first(), QStringLiteral("Off"));
    QTRY_COMPARE(cells(NodeTableModel::Health), (QStringList{"OK", "OK", "OK", "OK"}));
    echo.disconnectFromMaster();
}

void tst_PlantModels::newPhaseReportsNoMissingNode()
{
    const auto state = [](messages::MasterState of, const QStringList &nodes) {
        messages::State answer;
        answer.state = of;
        for (const QString &name : nodes) {
            QPlcNodeInfo node;
            node.name = name;
            node.listener = name.startsWith(QLatin1String("Window"));
            answer.nodes.append(node);
        }
        return answer;
    };
    using messages::MasterState;
    PlantStatus status;
    status.handleState(state(MasterState::RealTime, {"Model", "Autopilot", "Window1"}));
    QCOMPARE(status.gone, QStringList());
    status.handleState(state(MasterState::RealTime, {"Autopilot"}));
    QCOMPARE(status.gone, QStringList{"Model"});
    status.handleState(state(MasterState::Off, {}));
    QCOMPARE(status.gone, (QStringList{"Model", "Autopilot"}));
    status.handleState(state(MasterState::Off, {"Model"}));
    QCOMPARE(status.gone, QStringList{"Autopilot"});
    status.handleState(state(MasterState::RealTime, {"Model"}));
    QCOMPARE(status.gone, QStringList());
}

void tst_PlantModels::figuresOfNodesAreDurationsAndCounters()
{
    bool hasSlept = false;  // some cycles are skipped on a busy machine: not in a cycle of one number
    RunningMaster master;
    master.counter.onStep = [&hasSlept](const QPlcCycle &cycle) {
        if (cycle.number() < 300 || hasSlept)
            return;
        hasSlept = true;
        QTest::qSleep(40);  // longer than a period: the master overruns
    };
    QVERIFY(master.startRealTime());
    PlantList plants;
    NodeTableModel table(&plants);
    const QAbstractItemModelTester tester(&table, fatal);
    Plant *plant = plants.add(master.address(), QStringLiteral("kite"));
    QSignalSpy events(plant, &Plant::eventOccurred);
    const auto number
        = [&](int row, int column) { return table.index(row, column).data(NodeTableModel::SortRole).toDouble(); };
    QTRY_VERIFY_WITH_TIMEOUT(number(1, NodeTableModel::ExecutionP99) > 0.0, 10000);
    QTRY_VERIFY_WITH_TIMEOUT(number(0, NodeTableModel::LatenessP99) > 0.0, 10000);
    QVERIFY(cellText(table, 0, NodeTableModel::LatenessP99).endsWith(QStringLiteral("s")));
    QCOMPARE(cellText(table, 1, NodeTableModel::LatenessP99), QString());
    QCOMPARE(cellText(table, 1, NodeTableModel::Lost), QStringLiteral("0"));
    QTRY_VERIFY_WITH_TIMEOUT(number(1, NodeTableModel::ExecutionMaximum) >= 40e6, 10000);
    const auto isOverrun = [](const QList<QVariant> &call) {
        return qvariant_cast<PlantEvent>(call.at(0)).text.contains(QStringLiteral("began a period or more late"));
    };
    QTRY_VERIFY(std::any_of(events.begin(), events.end(), isOverrun));
}

void tst_PlantModels::eventsAreShownAndAcknowledged()
{
    EventLogModel log;
    const QAbstractItemModelTester tester(&log, fatal);
    QSignalSpy counts(&log, &EventLogModel::unacknowledgedChanged);
    log.acknowledgeAll();
    log.acknowledge({});
    log.append(eventOf(PlantEvent::Information, QStringLiteral("begin")));
    QCOMPARE(log.unacknowledged(), 0);
    log.append(eventOf(PlantEvent::Warning, QStringLiteral("late")));
    log.append(eventOf(PlantEvent::Error, QStringLiteral("lost")));
    QCOMPARE(log.unacknowledged(), 2);
    QCOMPARE(cellText(log, 1, EventLogModel::Time), QStringLiteral("12:00:01.250"));
    QCOMPARE(cellText(log, 1, EventLogModel::Severity), QStringLiteral("Warning"));
    QCOMPARE(cellText(log, 1, EventLogModel::Source), QStringLiteral("kite"));
    QCOMPARE(cellText(log, 1, EventLogModel::Text), QStringLiteral("late"));
    log.acknowledge(log.index(1, 2));
    log.acknowledge(log.index(1, 2));
    log.acknowledge(log.index(0, 0));
    QCOMPARE(log.unacknowledged(), 1);
    QVERIFY(log.index(1, 0).data(EventLogModel::AcknowledgedRole).toBool());
    log.acknowledgeAll();
    QCOMPARE(log.unacknowledged(), 0);
    QVERIFY(!log.at(0).isAcknowledged);  // it asked nobody
    QCOMPARE(counts.size(), 4);
}

void tst_PlantModels::theLogIsBounded()
{
    EventLogModel log;
    for (int i = 0; i < EventLogModel::MostEvents + 10; ++i)
        log.append(eventOf(PlantEvent::Warning, QString::number(i)));
    QCOMPARE(log.rowCount(), EventLogModel::MostEvents);
    QCOMPARE(log.at(0).text, QStringLiteral("10"));
    QCOMPARE(log.unacknowledged(), EventLogModel::MostEvents);
    log.append(eventOf(PlantEvent::Information, QString()));
    QCOMPARE(log.unacknowledged(), EventLogModel::MostEvents - 1);
}

void tst_PlantModels::eventsAreFiltered()
{
    EventLogModel log;
    EventFilterModel filter;
    const QAbstractItemModelTester tester(&filter, fatal);
    filter.setSourceModel(&log);
    log.append(eventOf(PlantEvent::Information, QStringLiteral("node Winch is there")));
    log.append(eventOf(PlantEvent::Warning, QStringLiteral("node Winch has gone")));
    log.append(eventOf(PlantEvent::Error, QStringLiteral("lost the master")));
    filter.setLeastSeverity(PlantEvent::Warning);
    QCOMPARE(filter.rowCount(), 2);
    filter.setSearch(QStringLiteral(" KITE  winch"));
    QCOMPARE(filter.rowCount(), 1);
    filter.setSearch(QString());
    filter.setOnlyOpen(true);
    log.acknowledge(log.index(2, 0));
    QCOMPARE(filter.rowCount(), 1);
    filter.setLeastSeverity(PlantEvent::Information);
    QCOMPARE(filter.rowCount(), 1);  // information asks nobody
    filter.setOnlyOpen(false);
    QCOMPARE(filter.rowCount(), 3);
}

void tst_PlantModels::anAlarmIsActiveUntilItEndsAcknowledgedOrNot()
{
    EventLogModel log;
    const QAbstractItemModelTester tester(&log, fatal);
    EventFilterModel open;
    open.setSourceModel(&log);
    open.setOnlyOpen(true);
    const auto state = [&](int row) { return cellText(log, row, EventLogModel::State); };
    log.append(alarmOf(PlantEvent::Begins, "hot", 0));
    log.append(eventOf(PlantEvent::Warning, QStringLiteral("late")));
    QCOMPARE(state(0), QStringLiteral("Active"));
    QCOMPARE(state(1), QString());
    QCOMPARE(log.active(), 1);
    log.acknowledge(log.index(0, 0));
    log.acknowledge(log.index(1, 0));
    QCOMPARE(state(0), QStringLiteral("Acknowledged"));
    QCOMPARE(open.rowCount(), 1);  // it lasts
    QCOMPARE(log.active(), 1);
    log.append(alarmOf(PlantEvent::Ends, "hot", 3200));
    QCOMPARE(state(0), QStringLiteral("Cleared"));
    QVERIFY(
        log.index(0, EventLogModel::State).data(Qt::ToolTipRole).toString().endsWith(QStringLiteral("after 3.2 s")));
    QCOMPARE(log.active(), 0);
    QCOMPARE(open.rowCount(), 0);
    log.append(alarmOf(PlantEvent::Begins, "cold", 4000));
    log.append(alarmOf(PlantEvent::Ends, "cold", 5000));
    QCOMPARE(state(3), QStringLiteral("Cleared"));
    QCOMPARE(log.unacknowledged(), 1);  // over, but nobody has seen it yet
    QCOMPARE(open.rowCount(), 1);
}

void tst_PlantModels::alarmsOfTwoPlantsDoNotEndEachOther()
{
    EventLogModel log;
    log.append(alarmOf(PlantEvent::Begins, "hot", 0));
    PlantEvent other = alarmOf(PlantEvent::Ends, "hot", 1000);
    other.source = QStringLiteral("south");
    log.append(other);
    QCOMPARE(log.active(), 1);
}

void tst_PlantModels::anAlarmThatBeginsAgainIsActiveOnce()
{
    EventLogModel log;
    log.append(alarmOf(PlantEvent::Begins, "hot", 0));
    log.append(alarmOf(PlantEvent::Begins, "hot", 1000));
    QCOMPARE(log.active(), 1);
    QCOMPARE(cellText(log, 0, EventLogModel::State), QStringLiteral("Cleared"));
    QCOMPARE(cellText(log, 1, EventLogModel::State), QStringLiteral("Active"));
}

void tst_PlantModels::firstAlarmOfABurstIsMarked()
{
    EventLogModel log;
    const QAbstractItemModelTester tester(&log, fatal);
    const auto state = [&](int row) { return cellText(log, row, EventLogModel::State); };
    log.append(alarmOf(PlantEvent::Begins, "node Winch", 0));
    QCOMPARE(state(0), QStringLiteral("Active"));  // alone it is the first of nothing
    log.append(eventOf(PlantEvent::Warning, QStringLiteral("late")));
    log.append(alarmOf(PlantEvent::Begins, "value of force", 3000));
    log.append(alarmOf(PlantEvent::Begins, "value of speed", 7000));
    QCOMPARE(state(0), QStringLiteral("1st · Active"));
    QCOMPARE(state(2), QStringLiteral("Active"));
    QCOMPARE(state(3), QStringLiteral("Active"));
    QVERIFY(log.index(0, EventLogModel::State).data(Qt::ToolTipRole).toString().endsWith(QStringLiteral("from it: 2")));
    log.append(alarmOf(PlantEvent::Ends, "node Winch", 8000));
    QCOMPARE(state(0), QStringLiteral("1st · Cleared"));
    log.append(alarmOf(PlantEvent::Begins, "node Kite", 12'001));  // another burst
    log.append(alarmOf(PlantEvent::Begins, "value of position", 12'002));
    QCOMPARE(state(5), QStringLiteral("1st · Active"));
    QCOMPARE(log.index(0, 0).data(EventLogModel::FollowersRole).toInt(), 2);
}

void tst_PlantModels::eachPlantHasBurstsOfItsOwn()
{
    EventLogModel log;
    log.append(alarmOf(PlantEvent::Begins, "hot", 0));
    PlantEvent other = alarmOf(PlantEvent::Begins, "cold", 1);
    other.source = QStringLiteral("south/Winch");
    log.append(other);
    QCOMPARE(log.index(0, 0).data(EventLogModel::FollowersRole).toInt(), 0);
    QCOMPARE(log.index(1, 0).data(EventLogModel::FollowersRole).toInt(), 0);
}

void tst_PlantModels::endOfADiscardedAlarmIsLoggedOnly()
{
    EventLogModel log;
    log.append(alarmOf(PlantEvent::Begins, "hot", 0));
    for (int i = 0; i < EventLogModel::MostEvents; ++i)
        log.append(eventOf(PlantEvent::Information, QString::number(i)));
    QCOMPARE(log.active(), 0);
    log.append(alarmOf(PlantEvent::Ends, "hot", 1000));
    QCOMPARE(log.rowCount(), EventLogModel::MostEvents);
}

void tst_PlantModels::plantEventsAreLogged()
{
    PlantList plants;
    EventLogModel log;
    connect(&plants, &PlantList::eventOccurred, &log, &EventLogModel::append);
    auto master = std::make_unique<RunningMaster>();
    plants.add(master->address(), QStringLiteral("kite"));
    QTRY_COMPARE(log.rowCount() > 0 ? log.at(0).text : QString(),
                 QStringLiteral("connected to the master at %1").arg(master->address()));
    QVERIFY(master->startRealTime());
    const auto texts = [&] {
        QStringList all;
        for (int row = 0; row < log.rowCount(); ++row)
            all << log.at(row).text;
        return all.join(QLatin1Char('\n'));
    };
    QTRY_VERIFY(texts().contains(QStringLiteral("state Real time")));
    QCOMPARE(log.unacknowledged(), 0);
    master.reset();
    QTRY_VERIFY(texts().contains(QStringLiteral("lost the master")));
    QCOMPARE(log.unacknowledged(), 1);
}

QTEST_MAIN(tst_PlantModels)
#include "tst_PlantModels.moc"
