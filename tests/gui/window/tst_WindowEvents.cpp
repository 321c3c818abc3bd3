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
    void aNoteIsAnEventOfTheMaster();
    void nIsALetterWhileAPersonTypes();
    void escapeForgetsANoteAndStopsNothing();
    void aNoteBelongsToThePlantInWhichItWasBegun();
    void withoutAConnectionNobodyTakesANote();
    void aNoteStaysInItsLineWhenTheConnectionIsLost();
    void withoutAMasterANoteIsInTheLogOfTheWindow();

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
    QTRY_VERIFY(fixture.plant()->isConnected());
    auto *line = fixture.part<EventLine>();
    fixture.press(Qt::Key_F5);
    QTRY_VERIFY(line->detail().endsWith(QLatin1String("kite: state Real time")));
    // A warning does not hide it.
    fixture.window.context()->events()->append(
        {QDateTime::currentDateTime(), PlantEvent::Warning, QStringLiteral("kite"), QStringLiteral("late"), false});
    QVERIFY(line->text().contains(QLatin1String("late")));
    QVERIFY(line->detail().endsWith(QLatin1String("kite: state Real time")));
    fixture.plant()->stop();
    QTRY_VERIFY(line->detail().contains(QLatin1String("kite: state Off")));
    QVERIFY2(line->detail().contains(PlantLeases::whoever()), qPrintable(line->detail()));
}

namespace {

QVector<PlantEvent> notesOf(const EventLogModel &events)
{
    QVector<PlantEvent> notes;
    for (int row = 0; row < events.rowCount(); ++row) {
        if (events.at(row).isNote)
            notes.append(events.at(row));
    }
    return notes;
}

}  // namespace

void tst_WindowEvents::aNoteIsAnEventOfTheMaster()
{
    RunningMaster master;
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address(), QStringLiteral("kite"));
    QTRY_VERIFY(fixture.plant()->isConnected());
    auto *strip = fixture.part<NoteStrip>();
    QVERIFY(strip->isHidden());
    fixture.press(Qt::Key_N);
    QVERIFY(strip->isVisible() && strip->line()->hasFocus());
    fixture.type(QStringLiteral("  gust at  the mast "));
    fixture.press(Qt::Key_Return);
    const EventLogModel &events = *fixture.window.context()->events();
    QTRY_COMPARE(notesOf(events).size(), 1);
    QCOMPARE(notesOf(events).first().text, QStringLiteral("gust at the mast"));
    QVERIFY(notesOf(events).first().source.startsWith(QLatin1String("kite")));
    QCOMPARE(events.unacknowledged(), 0);  // it asks nobody
    QTRY_VERIFY(strip->isHidden());
}

void tst_WindowEvents::nIsALetterWhileAPersonTypes()
{
    RunningMaster master;
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address(), QStringLiteral("kite"));
    QTRY_VERIFY(fixture.plant()->isConnected());
    fixture.press(Qt::Key_O, Qt::ControlModifier);
    fixture.part<ConnectStrip>()->line()->clear();
    fixture.type(QStringLiteral("north"));
    QCOMPARE(fixture.part<ConnectStrip>()->line()->text(), QStringLiteral("north"));
    QVERIFY(fixture.part<NoteStrip>()->isHidden());
}

void tst_WindowEvents::escapeForgetsANoteAndStopsNothing()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address(), QStringLiteral("kite"));
    QTRY_VERIFY(fixture.plant()->isConnected());
    auto *strip = fixture.part<NoteStrip>();
    for (const bool hasText : {true, false}) {
        fixture.press(Qt::Key_N);
        fixture.type(hasText ? QStringLiteral("no") : QStringLiteral(" "));
        fixture.press(hasText ? Qt::Key_Escape : Qt::Key_Return);
        QVERIFY(strip->isHidden());
    }
    fixture.press(Qt::Key_N);
    QCOMPARE(strip->line()->text(), QString());
    fixture.press(Qt::Key_Escape);
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    QVERIFY(notesOf(*fixture.window.context()->events()).isEmpty());
}

void tst_WindowEvents::aNoteBelongsToThePlantInWhichItWasBegun()
{
    RunningMaster north;
    RunningMaster south;
    WindowFixture fixture;
    fixture.window.connectToMaster(north.address(), QStringLiteral("north"));
    fixture.window.connectToMaster(south.address(), QStringLiteral("south"));
    QTRY_VERIFY(fixture.plant(0)->isConnected() && fixture.plant(1)->isConnected());
    fixture.window.context()->plants()->select(fixture.plant(0));
    fixture.press(Qt::Key_N);
    fixture.type(QStringLiteral("calm"));
    fixture.window.context()->plants()->select(fixture.plant(1));
    fixture.press(Qt::Key_Return);
    const EventLogModel &events = *fixture.window.context()->events();
    QTRY_COMPARE(notesOf(events).size(), 1);
    QVERIFY(notesOf(events).first().source.startsWith(QLatin1String("north")));
}

void tst_WindowEvents::withoutAConnectionNobodyTakesANote()
{
    WindowFixture fixture;
    fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(freePort()), QStringLiteral("kite"));
    fixture.press(Qt::Key_N);
    QVERIFY(fixture.part<NoteStrip>()->isHidden());
    QVERIFY2(fixture.hint().contains(QLatin1String("kite is not connected")), qPrintable(fixture.hint()));
}

void tst_WindowEvents::aNoteStaysInItsLineWhenTheConnectionIsLost()
{
    auto master = std::make_unique<RunningMaster>();
    WindowFixture fixture;
    fixture.window.connectToMaster(master->address(), QStringLiteral("kite"));
    QTRY_VERIFY(fixture.plant()->isConnected());
    auto *strip = fixture.part<NoteStrip>();
    fixture.press(Qt::Key_N);
    fixture.type(QStringLiteral("gust"));
    master.reset();
    QTRY_VERIFY(!fixture.plant()->isConnected());
    fixture.press(Qt::Key_Return);
    QVERIFY(strip->isVisible());
    QCOMPARE(strip->line()->text(), QStringLiteral("gust"));
    QVERIFY2(strip->error().contains(QLatin1String("kite is not connected")), qPrintable(strip->error()));
}

void tst_WindowEvents::withoutAMasterANoteIsInTheLogOfTheWindow()
{
    WindowFixture fixture;
    fixture.window.context()->plants()->addFed(QStringLiteral("model"));
    fixture.window.context()->plants()->select(fixture.plant());
    fixture.press(Qt::Key_N);
    fixture.type(QStringLiteral("new gains"));
    fixture.press(Qt::Key_Return);
    const EventLogModel &events = *fixture.window.context()->events();
    QCOMPARE(notesOf(events).size(), 1);
    QCOMPARE(notesOf(events).first().source, QStringLiteral("model"));
    QVERIFY(fixture.part<NoteStrip>()->isHidden());
}

void tst_WindowEvents::eventsAndLeasesUseTheSamePersonName()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address(), QStringLiteral("kite"));
    QTRY_VERIFY(fixture.plant()->hasLeases());
    fixture.plant()->takeLease({QStringLiteral("echo")});
    QTRY_VERIFY(fixture.plant()->leases().size() == 1);
    const QString name = fixture.plant()->leases().first().holder;
    QCOMPARE(name, PlantLeases::whoever());
    fixture.plant()->setValues({{QStringLiteral("setpoint"), QPlcValue(1.0)}});
    const EventLogModel &events = *fixture.window.context()->events();
    const QString set = QStringLiteral("'%1' has set setpoint").arg(name);
    QTRY_COMPARE(columnTexts(events, EventLogModel::Text).filter(set).size(), 1);
    // The window is a node, too: nodes have names of their own, which begin with that of the
    // person.
    QVERIFY2(!columnTexts(events, EventLogModel::Text).filter(QStringLiteral("node %1-").arg(name)).isEmpty(),
             qPrintable(columnTexts(events, EventLogModel::Text).join('\n')));
    QVERIFY(columnTexts(events, EventLogModel::Text).filter(QStringLiteral("ControlCenter")).isEmpty());
    master.stop();
}

QTEST_MAIN(tst_WindowEvents)
#include "tst_WindowEvents.moc"
