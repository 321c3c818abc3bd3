// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcEventLog.h"
#include "TableText.h"
#include "WindowFixtures.h"
#include "gui/plant/PlantLeases.h"
#include "gui/window/EventLine.h"

#include <QtWidgets/QScrollBar>
#include <QtWidgets/QTreeView>

using namespace qplc;

namespace {

PlantEvent eventAt(int second, const char *text, PlantEvent::Severity severity = PlantEvent::Information)
{
    return {QDateTime(QDate(2026, 1, 31), QTime(12, 0, second)), severity, QStringLiteral("kite"),
            QString::fromLatin1(text), false};
}

}  // namespace

/// How the window tells what happens.
class tst_WindowEvents : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void fiveEventsAreSeenInTheDefaultLayout();
    void theLogIsInTheOrderOfTime();
    void startsAndStopsAreOnTheBottomLine();
    void eventsAndLeasesUseTheSamePersonName();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_WindowEvents::fiveEventsAreSeenInTheDefaultLayout()
{
    WindowFixture fixture;
    fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    fixture.window.showHint(QStringLiteral("A hint takes a line."), nullptr);
    QVERIFY(fixture.window.showTab(QStringLiteral("Real time")));
    for (int second = 0; second < 30; ++second)
        fixture.window.context()->events()->append(eventAt(second, "tether late"));
    auto *log = fixture.part<QPlcEventLog>();
    QTRY_VERIFY(log && log->isVisible());
    auto *table = log->findChild<QTreeView *>();
    const int rows
        = table->viewport()->height() / table->visualRect(table->model()->index(29, EventLogModel::Text)).height();
    QVERIFY2(rows >= 5, qPrintable(QString::number(rows)));
}

void tst_WindowEvents::theLogIsInTheOrderOfTime()
{
    WindowFixture fixture;
    fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    EventLogModel *events = fixture.window.context()->events();
    QVERIFY(fixture.window.showTab(QStringLiteral("Real time")));
    events->append(eventAt(10, "ten"));
    events->append(eventAt(5, "five"));  // of a master that tells it only now
    events->append(eventAt(5, "five again"));
    events->append(eventAt(20, "twenty"));
    auto *table = fixture.part<QPlcEventLog>()->findChild<QTreeView *>();
    const QRegularExpression ours("^(five|five again|ten|twenty)$");
    QCOMPARE(columnTexts(*table->model(), EventLogModel::Text).filter(ours),
             (QStringList{"five", "five again", "ten", "twenty"}));
}

void tst_WindowEvents::startsAndStopsAreOnTheBottomLine()
{
    RunningMaster master;
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address(), QStringLiteral("kite"));
    QTRY_VERIFY_WITH_TIMEOUT(fixture.plant()->isConnected(), patience);
    auto *line = fixture.part<EventLine>();
    fixture.press(Qt::Key_F5);
    QTRY_VERIFY_WITH_TIMEOUT(line->detail().endsWith(QLatin1String("kite: state Real time")), patience);
    // A warning does not hide it.
    fixture.window.context()->events()->append(
        {QDateTime::currentDateTime(), PlantEvent::Warning, QStringLiteral("kite"), QStringLiteral("late"), false});
    QVERIFY(line->text().contains(QLatin1String("late")));
    QVERIFY(line->detail().endsWith(QLatin1String("kite: state Real time")));
    fixture.plant()->stop();
    QTRY_VERIFY_WITH_TIMEOUT(line->detail().contains(QLatin1String("kite: state Off")), patience);
    QVERIFY2(line->detail().contains(PlantLeases::whoever()), qPrintable(line->detail()));
}

void tst_WindowEvents::eventsAndLeasesUseTheSamePersonName()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address(), QStringLiteral("kite"));
    QTRY_VERIFY_WITH_TIMEOUT(fixture.plant()->hasLeases(), patience);
    fixture.plant()->takeLease({QStringLiteral("echo")});
    QTRY_VERIFY_WITH_TIMEOUT(fixture.plant()->leases().size() == 1, patience);
    const QString name = fixture.plant()->leases().first().holder;
    QCOMPARE(name, PlantLeases::whoever());
    fixture.plant()->setValues({{QStringLiteral("setpoint"), QPlcValue(1.0)}});
    const EventLogModel &events = *fixture.window.context()->events();
    const QString set = QStringLiteral("'%1' has set setpoint").arg(name);
    QTRY_COMPARE_WITH_TIMEOUT(columnTexts(events, EventLogModel::Text).filter(set).size(), 1, patience);
    // The window is a node, too: nodes have names of their own, which begin with that of the
    // person.
    QVERIFY2(!columnTexts(events, EventLogModel::Text).filter(QStringLiteral("node %1-").arg(name)).isEmpty(),
             qPrintable(columnTexts(events, EventLogModel::Text).join('\n')));
    QVERIFY(columnTexts(events, EventLogModel::Text).filter(QStringLiteral("ControlCenter")).isEmpty());
    master.stop();
}

QTEST_MAIN(tst_WindowEvents)
#include "tst_WindowEvents.moc"
