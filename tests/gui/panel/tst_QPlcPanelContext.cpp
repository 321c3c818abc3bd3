// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "QPlcPanelContext.h"
#include "QPlcTimeAxis.h"
#include "QPlcWidget.h"
#include "gui/panel/WindowContext.h"
#include "gui/plant/PlantFeed.h"

#include <cmath>

using qplc::Plant;
using qplc::WindowContext;
using Context = QPlcPanelContext;
using Time = Context::Time;

namespace {

constexpr Time period = 10'000'000;
constexpr Time start = 1'700'000'000'000'000'000;

class Panel : public QPlcWidget
{
    Q_OBJECT
public:
    QStringList shown{QStringLiteral("count")};
    QStringList shownSignals() const override { return shown; }
    using QPlcWidget::setSetting;
    using QPlcWidget::setting;
};

/// A panel in a window with a plant that the test feeds: "count" is 0, 1, 2, ... each 10 ms.
class FedPanel
{
public:
    FedPanel()
        : kite(add(QStringLiteral("kite")))
    {
        panel.setContext(&window);
        take(kite, 100);
    }
    Plant *add(const QString &name)
    {
        QPlcSignalIndexTable::setCurrent(testTable());
        Plant *plant = window.plants()->addFed(name);
        plant->feed()->connected(testTable());
        plant->feed()->started();
        return plant;
    }
    void take(Plant *plant, int rows)
    {
        for (int i = 0; i < rows; ++i) {
            QPlcSignalList values = valueOf("count", QPlcValue(next++));
            values.insert(QStringLiteral("setpoint"), QPlcValue(1.25));
            values.insert(QStringLiteral("vector"), QPlcValue(std::array<double, 3>{1.0, 2.0, 3.0}));
            now += period;
            plant->feed()->add({values}, now);
        }
    }
    Context &context() { return *panel.context(); }
    QVector<Context::Sample> all(const QString &expression, int most = 2000)
    {
        return context().history(expression, 0, now, most);
    }

    WindowContext window;
    Panel panel;
    int next = 0;
    Time now = start;
    Plant *kite;
};

/// A panel in a window with a master that it asks.
class AskingPanel
{
public:
    AskingPanel()
        : kite(window.plants()->add(master.address(), QStringLiteral("kite"), QStringLiteral("Window")))
    {
        panel.setContext(&window);
    }
    bool ask(const QPlcMessage &question, const QString &plant = QString())
    {
        const auto take = [this](const QPlcMessage &answer) {
            answers << answer;
            if (answered)
                answered();
        };
        return panel.context()->ask(question, &panel, take, plant);
    }

    RunningMaster master;
    WindowContext window;
    Plant *const kite;
    Panel panel;
    QVector<QPlcMessage> answers;
    std::function<void()> answered;  // after each answer
};

}  // namespace

class tst_QPlcPanelContext : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void aPanelOutsideOfAWindowKnowsNoPlant();
    void aSignalHasItsMetadataAndItsNewestValue();
    void anElementOfAnArrayIsANumber();
    void aFormulaIsASignal();
    void missingSignalReportsTheProblem();
    void referenceUsesThePinnedPlant();
    void theHistoryHasEachCycle();
    void aLongHistoryHasFewStepsWithTheirExtremes();
    void historyIsInterruptedWhereThePlantStopped();
    void thePastIsReadRowByRow();
    void thePastOfAFormulaFollowsItsPlant();
    void aPastOutlivesItsPlant();
    void aPanelMovesTheTimeAxisOfItsWindow();
    void aPanelAsksForTheDurationsOfAMaster();
    void aPanelAsksForTheStateOfAMaster();
    void aPanelSendsNoCommands_data();
    void aPanelSendsNoCommands();
    void aPanelHasFewQuestionsOpen();
    void aLostConnectionFailsTheQuestionsOfAPanel();
    void aPanelWritesIntoTheEventLog();
    void aPanelAcknowledgesEvents();
    void tablesOfAPanelAreModels();
    void noteExplainsWhyAValueIsNotCurrent();
    void theWindowShowsThePast();
    void aLivePanelEndsWithItsOwnPlant();
    void cursorsAreSharedWithTheWindow();
    void lostPlantIsSignalledAndShown();
    void changesAreSignalledTogetherAndOnlyToVisiblePanels();
    void themeFollowsTheWindow();
    void numbersAreWrittenAsInTheWindow();
    void settingsAreSavedAndUndone();
};

void tst_QPlcPanelContext::aPanelOutsideOfAWindowKnowsNoPlant()
{
    Panel panel;
    QVERIFY(panel.context());
    const Context::Signal signal = panel.context()->shown(QStringLiteral("count"));
    QVERIFY(!signal);
    QCOMPARE(signal.problem, QStringLiteral("No plant is connected."));
    QVERIFY(panel.context()->history(QStringLiteral("count"), 0, start).isEmpty());
    QVERIFY(panel.context()->plants().isEmpty());
    QVERIFY(panel.context()->theme().surface.isValid());
    QCOMPARE(panel.context()->end(), Time(0));
}

void tst_QPlcPanelContext::aSignalHasItsMetadataAndItsNewestValue()
{
    FedPanel fed;
    const Context::Signal signal = fed.context().signal(QStringLiteral("setpoint"));
    QVERIFY(signal);
    QCOMPARE(signal.plant, QStringLiteral("kite"));
    QCOMPARE(signal.definition.unit, QStringLiteral("m/s"));
    QCOMPARE(signal.definition.maximum.toReal(), 10.0);
    QCOMPARE(signal.number(), 1.25);
    QVERIFY(signal.isCurrent);
    QVERIFY(signal.quality.isGood());
    QVERIFY(fed.context().numberNames().contains(QStringLiteral("vector[2]")));
    QVERIFY(!fed.context().numberNames().contains(QStringLiteral("vector")));
    QVERIFY(fed.context().signalNames().contains(QStringLiteral("vector")));
}

void tst_QPlcPanelContext::anElementOfAnArrayIsANumber()
{
    FedPanel fed;
    QCOMPARE(fed.context().signal(QStringLiteral("vector[1]")).number(), 2.0);
    QCOMPARE(fed.context().signal(QStringLiteral("vector")).number(2), 3.0);
    QVERIFY(std::isnan(fed.context().signal(QStringLiteral("vector")).number(3)));
}

void tst_QPlcPanelContext::aFormulaIsASignal()
{
    FedPanel fed;
    const QString formula = QStringLiteral("= 2 * count");
    fed.context().signal(formula);
    QTRY_COMPARE(fed.context().signal(formula).number(), 198.0);
    QTRY_COMPARE(fed.all(formula).size(), 100);
    QCOMPARE(fed.all(formula).constLast().value, 198.0);
    QVERIFY(!fed.context().signal(QStringLiteral("= 2 * nothing")).problem.isEmpty());
}

void tst_QPlcPanelContext::missingSignalReportsTheProblem()
{
    FedPanel fed;
    const Context::Signal missing = fed.context().signal(QStringLiteral("nothing"));
    QVERIFY(!missing);
    QCOMPARE(missing.problem, QStringLiteral("There is no signal nothing at the moment."));
    QVERIFY(std::isnan(missing.number()));
    QVERIFY(!fed.context().signal(QStringLiteral("[")).problem.isEmpty());
    QVERIFY(fed.all(QStringLiteral("nothing")).isEmpty());
}

void tst_QPlcPanelContext::referenceUsesThePinnedPlant()
{
    FedPanel fed;
    Plant *east = fed.add(QStringLiteral("east"));
    fed.next = 1000;
    fed.take(east, 1);
    QCOMPARE(fed.context().plants(), QStringList({QStringLiteral("kite"), QStringLiteral("east")}));
    QCOMPARE(fed.context().signal(QStringLiteral("count")).number(), 99.0);
    QCOMPARE(fed.context().signal(QStringLiteral("east/count")).number(), 1000.0);
    const QSignalSpy signalsChanged(&fed.context(), &Context::signalsChanged);
    fed.panel.setPinnedPlant(QStringLiteral("east"));
    QCOMPARE(signalsChanged.count(), 1);
    QCOMPARE(fed.context().signal(QStringLiteral("count")).number(), 1000.0);
    QCOMPARE(fed.context().plant().name, QStringLiteral("east"));
    QVERIFY(fed.context().plant(QStringLiteral("kite")).color != fed.context().plant().color);
}

void tst_QPlcPanelContext::theHistoryHasEachCycle()
{
    FedPanel fed;
    const QVector<Context::Sample> past = fed.all(QStringLiteral("count"));
    QCOMPARE(past.size(), 100);
    for (int i = 0; i < past.size(); ++i) {
        QCOMPARE(past.at(i).value, double(i));
        QCOMPARE(past.at(i).minimum, past.at(i).maximum);
        QCOMPARE(past.at(i).isJoined, i > 0);
        QCOMPARE(past.at(i).quality, QPlcQuality::Good);
    }
    const Time tenth = past.at(10).time;
    const QVector<Context::Sample> part = fed.context().history(QStringLiteral("count"), tenth, past.at(20).time);
    QCOMPARE(part.size(), 11);
    QCOMPARE(part.constFirst().time, tenth);
    QVERIFY(fed.context().history(QStringLiteral("count"), fed.now, 0).isEmpty());
}

void tst_QPlcPanelContext::aLongHistoryHasFewStepsWithTheirExtremes()
{
    FedPanel fed;
    fed.take(fed.kite, 901);
    const QVector<Context::Sample> past = fed.all(QStringLiteral("count"), 100);
    QVERIFY(past.size() <= 100 && past.size() > 40);
    QCOMPARE(past.at(1).value, 16.0);
    QCOMPARE(past.at(1).minimum, 16.0);
    QCOMPARE(past.at(1).maximum, 31.0);
    QCOMPARE(past.constLast().value, 1000.0);
    const Time second = past.at(1).time;
    fed.take(fed.kite, 3);
    QCOMPARE(fed.all(QStringLiteral("count"), 100).at(1).time, second);  // steps stay where they are
}

void tst_QPlcPanelContext::historyIsInterruptedWhereThePlantStopped()
{
    FedPanel fed;
    fed.kite->feed()->stopped();
    fed.now += 5'000'000'000;
    fed.kite->feed()->started();
    fed.take(fed.kite, 50);
    int begins = 0;
    for (const Context::Sample &sample : fed.all(QStringLiteral("count")))
        begins += sample.isJoined ? 0 : 1;
    QCOMPARE(begins, 2);
}

void tst_QPlcPanelContext::thePastIsReadRowByRow()
{
    FedPanel fed;
    const QPlcPast past = fed.context().past(QStringLiteral("count"));
    QVERIFY(past);
    QCOMPARE(past.plant, QStringLiteral("kite"));
    QVERIFY(past.isStepped);
    QVERIFY(past.isCurrent());
    QCOMPARE(past.endRow() - past.firstRow(), QPlcPast::Row(100));
    QCOMPARE(past.newestTime(), fed.now);
    const QPlcPast::Row tenth = past.rowAt(start + 11 * period);
    QCOMPARE(past.time(tenth), start + 11 * period);
    QCOMPARE(past.value(tenth), 10.0);
    QCOMPARE(past.value(*past.rowHoldingAt(start + 11 * period + 1)), 10.0);
    QVERIFY(!past.rowHoldingAt(start));
    QCOMPARE(past.range(tenth, tenth + 20).minimum, 10.0);
    QCOMPARE(past.range(tenth, tenth + 20).maximum, 29.0);
    QVERIFY(past.range(tenth, tenth).isEmpty());
    QCOMPARE(past.quality(past.firstRow(), past.endRow()), QPlcQuality::Good);
    fed.take(fed.kite, 1);  // no copy: new rows are there
    QCOMPARE(past.value(past.endRow() - 1), 100.0);
    const QPlcPast other = fed.context().past(QStringLiteral("setpoint"));
    QVERIFY(past.sharesRows(other));
    QCOMPARE(other.unit, QStringLiteral("m/s"));
    QCOMPARE(other.maximum.value_or(0.0), 10.0);
    const QPlcPast missing = fed.context().past(QStringLiteral("nothing"));
    QVERIFY(!missing);
    QCOMPARE(missing.problem, QStringLiteral("There is no signal nothing at the moment."));
}

void tst_QPlcPanelContext::thePastOfAFormulaFollowsItsPlant()
{
    FedPanel fed;
    fed.take(fed.kite, 20'900);  // more than is calculated at once
    const QSignalSpy filled(&fed.context(), &Context::pastChanged);
    const QPlcPast past = fed.context().past(QStringLiteral("= 2 * count"));
    QCOMPARE(past.text(), QStringLiteral("2 * count"));
    QTRY_VERIFY(filled.count() > 0);
    fed.take(fed.kite, 1);
    QCOMPARE(past.value(past.endRow() - 1), 42'000.0);
    QVERIFY(!past.sharesRows(fed.context().past(QStringLiteral("count"))));
    QVERIFY(past.sharesRows(fed.context().past(QStringLiteral("= 2 * count"))));
}

void tst_QPlcPanelContext::aPastOutlivesItsPlant()
{
    FedPanel fed;
    const QPlcPast raw = fed.context().past(QStringLiteral("count"));
    const QPlcPast derived = fed.context().past(QStringLiteral("= 2 * count"));
    QTRY_COMPARE(derived.endRow() - derived.firstRow(), QPlcPast::Row(100));
    const QSignalSpy signalsChanged(&fed.context(), &Context::signalsChanged);
    fed.window.plants()->remove(fed.kite);
    QVERIFY(signalsChanged.count() > 0);
    QVERIFY(!raw.isCurrent());
    QCOMPARE(raw.age(), -1.0);
    QCOMPARE(raw.value(raw.endRow() - 1), 99.0);
    QCOMPARE(derived.value(derived.endRow() - 1), 198.0);
    QVERIFY(!fed.context().past(QStringLiteral("count")));
}

void tst_QPlcPanelContext::aPanelMovesTheTimeAxisOfItsWindow()
{
    FedPanel fed;
    QCOMPARE(fed.context().timeAxis(), fed.window.timeAxis());
    fed.context().timeAxis()->pan(-20 * period);
    QVERIFY(!fed.context().isLive());
    QCOMPARE(fed.context().end(), fed.now - 20 * period);
    Panel alone;
    alone.context()->showRange(start, start + 10);
    QCOMPARE(alone.context()->timeAxis()->begin(), start + 10 - QPlcTimeAxis::shortestSpan);
}

void tst_QPlcPanelContext::aPanelAsksForTheDurationsOfAMaster()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    WindowContext window;
    Panel panel;
    panel.setContext(&window);
    QStringList found;
    const auto take = [&](const QVector<Context::Duration> &durations) {
        found.clear();
        for (const Context::Duration &each : durations) {
            if (each.statistics.sinceStart.count > 0 && !each.statistics.sinceStart.bins.isEmpty())
                found << each.owner + QLatin1Char('.') + each.name;
        }
    };
    QVERIFY(!panel.context()->askDurations(&panel, take));  // there is no plant
    window.plants()->add(master.address(), QStringLiteral("kite"), QStringLiteral("Window"));
    const auto isAnswered = [&](const char *key) {
        panel.context()->askDurations(&panel, take, QStringLiteral("kite"));
        return found.contains(QLatin1String(key));
    };
    QTRY_VERIFY(isAnswered("Master.lateness") && isAnswered("Master.execution") && isAnswered("Counter.execution"));
}

void tst_QPlcPanelContext::aPanelAsksForTheStateOfAMaster()
{
    AskingPanel asking;
    QVERIFY(!asking.ask(QPlcMessage::GetState, QStringLiteral("nowhere")));
    QTRY_VERIFY(asking.kite->isConnected());
    QVERIFY(asking.ask(QPlcMessage::GetState));
    QVERIFY(asking.answers.isEmpty());  // the event loop brings it
    QTRY_COMPARE(asking.answers.size(), 1);
    QCOMPARE(asking.answers.at(0).kind(), QPlcMessage::State);
    QCOMPARE(asking.answers.at(0).text("state"), QStringLiteral("Off"));
    QVERIFY(asking.ask(QPlcMessage(QPlcMessage::GetSignals, {{"names", 7}})));
    QTRY_COMPARE(asking.answers.size(), 2);
    QCOMPARE(asking.answers.at(1).kind(), QPlcMessage::Failed);
    QVERIFY(!asking.answers.at(1).text("text").isEmpty());
}

void tst_QPlcPanelContext::aPanelSendsNoCommands_data()
{
    QTest::addColumn<int>("kind");
    for (const QPlcMessage::Kind kind :
         {QPlcMessage::Invalid, QPlcMessage::Hello, QPlcMessage::Register, QPlcMessage::InitializeAllStates,
          QPlcMessage::StartRealTime, QPlcMessage::Stop, QPlcMessage::SafeStop, QPlcMessage::Reset, QPlcMessage::Arm,
          QPlcMessage::SetSignals, QPlcMessage::TakeLease, QPlcMessage::ReleaseLease, QPlcMessage::State,
          QPlcMessage::Done})
        QTest::newRow(qPrintable(QPlcMessage(kind).kindName())) << int(kind);
}

void tst_QPlcPanelContext::aPanelSendsNoCommands()
{
    QFETCH(int, kind);
    AskingPanel asking;
    QVERIFY(asking.master.startRealTime());
    QTRY_VERIFY(asking.kite->isConnected());
    QVERIFY(asking.ask(QPlcMessage::GetState));
    QTRY_COMPARE(asking.answers.size(), 1);
    QVERIFY(!asking.ask(QPlcMessage::Kind(kind)));
    QVERIFY(asking.ask(QPlcMessage::GetState));
    QTRY_COMPARE(asking.answers.size(), 2);
    QCOMPARE(asking.answers.at(1).text("state"), QStringLiteral("RealTime"));
}

void tst_QPlcPanelContext::aPanelHasFewQuestionsOpen()
{
    AskingPanel asking;
    QTRY_VERIFY(asking.kite->isConnected());
    QVERIFY(asking.ask(QPlcMessage::GetState));
    int asked = 1;
    while (asked < 1000 && asking.ask(QPlcMessage::GetSchedule))
        ++asked;
    QCOMPARE(asked, 16);
    QTRY_COMPARE(asking.answers.size(), asked);
    QVERIFY(asking.ask(QPlcMessage::GetState));
}

void tst_QPlcPanelContext::aLostConnectionFailsTheQuestionsOfAPanel()
{
    AskingPanel asking;
    bool isAskedAgain = false;
    asking.answered = [&] { isAskedAgain = asking.ask(QPlcMessage::GetState); };  // as one that polls
    QTRY_VERIFY(asking.kite->isConnected());
    QVERIFY(asking.ask(QPlcMessage::GetState));
    QTRY_VERIFY(isAskedAgain);
    asking.master.stopServer();
    QTRY_VERIFY(!isAskedAgain);
    QCOMPARE(asking.answers.last().kind(), QPlcMessage::Failed);
    QCOMPARE(asking.answers.last().text("error"), QStringLiteral("Lost"));
}

void tst_QPlcPanelContext::aPanelWritesIntoTheEventLog()
{
    FedPanel fed;
    const int before = fed.window.events()->rowCount();
    fed.context().report(Context::Warning, QStringLiteral("Trigger"), QStringLiteral("The disk is full."));
    QCOMPARE(fed.window.events()->rowCount(), before + 1);
    QCOMPARE(fed.window.events()->at(before).text, QStringLiteral("The disk is full."));
    QCOMPARE(fed.window.events()->at(before).severity, qplc::PlantEvent::Warning);
}

void tst_QPlcPanelContext::aPanelAcknowledgesEvents()
{
    FedPanel fed;
    Context &context = fed.context();
    context.acknowledgeEvents();
    QCOMPARE(context.unacknowledgedEvents(), 0);
    QSignalSpy counts(&context, &Context::unacknowledgedEventsChanged);
    context.report(Context::Warning, QStringLiteral("Trigger"), QStringLiteral("first"));
    context.report(Context::Error, QStringLiteral("Trigger"), QStringLiteral("second"));
    QCOMPARE(context.unacknowledgedEvents(), 2);
    QCOMPARE(counts.count(), 2);
    QAbstractItemModel *events = context.eventModel();
    const QModelIndex last = events->index(events->rowCount() - 1, 0);
    QCOMPARE(last.data(Context::SeverityRole).toInt(), int(Context::Error));
    QVERIFY(!last.data(Context::AcknowledgedRole).toBool());
    QVERIFY(!events->setData(last, false, Context::AcknowledgedRole));
    QVERIFY(events->setData(last, true, Context::AcknowledgedRole));
    QVERIFY(last.data(Context::AcknowledgedRole).toBool());
    QCOMPARE(context.unacknowledgedEvents(), 1);
}

void tst_QPlcPanelContext::tablesOfAPanelAreModels()
{
    Panel alone;
    QVERIFY(!alone.context()->createSignalModel(&alone) && !alone.context()->createNodeModel(&alone));
    QVERIFY(!alone.context()->eventModel());
    FedPanel fed;
    const QAbstractItemModel *model = fed.context().createSignalModel(&fed.panel);
    const QAbstractItemModel *nodes = fed.context().createNodeModel(&fed.panel);
    QCOMPARE(model->parent(), &fed.panel);
    QVERIFY(nodes->rowCount() > 0);
    const QModelIndexList found = model->match(model->index(0, 0), Context::ReferenceRole, QStringLiteral("count"), 1,
                                               Qt::MatchExactly | Qt::MatchRecursive);
    QCOMPARE(found.size(), 1);
    const QModelIndex value = found.first().siblingAtColumn(1);
    QTRY_COMPARE(value.data().toString(), QStringLiteral("99"));
    fed.context().timeAxis()->show(start, start + 11 * period);
    QTRY_COMPARE(value.data().toString(), QStringLiteral("10"));
}

void tst_QPlcPanelContext::noteExplainsWhyAValueIsNotCurrent()
{
    FedPanel fed;
    QCOMPARE(fed.context().signal(QStringLiteral("count")).note, QString());
    QCOMPARE(fed.context().signal(QStringLiteral("setpoint"), start + 5 * period).note.left(3), QStringLiteral("at "));
    QCOMPARE(fed.context().signal(QStringLiteral("count"), start - period).note.left(12),
             QStringLiteral("no value at "));
    fed.kite->feed()->disconnected();
    QCOMPARE(fed.context().signal(QStringLiteral("count")).note.left(7), QStringLiteral("stale, "));
    QCOMPARE(fed.context().signal(QStringLiteral("= 2*count")).note.left(7), QStringLiteral("stale, "));
}

void tst_QPlcPanelContext::theWindowShowsThePast()
{
    FedPanel fed;
    QVERIFY(fed.context().isLive());
    QVERIFY(!fed.context().shownTime());
    QCOMPARE(fed.context().shown(QStringLiteral("count")).number(), 99.0);
    const Time fortieth = fed.all(QStringLiteral("count")).at(40).time;
    const QSignalSpy timeChanged(&fed.context(), &Context::timeChanged);
    fed.context().showRange(fortieth - 20 * period, fortieth);
    QVERIFY(timeChanged.count() > 0);
    QVERIFY(!fed.context().isLive());
    QCOMPARE(fed.context().begin(), fortieth - 20 * period);
    QCOMPARE(fed.context().end(), fortieth);
    QCOMPARE(fed.context().shown(QStringLiteral("count")).number(), 40.0);
    QVERIFY(fed.context().shown(QStringLiteral("count")).isCurrent);
    QCOMPARE(fed.context().shown(QStringLiteral("vector")).number(1), 2.0);
    QCOMPARE(fed.context().signal(QStringLiteral("count")).number(), 99.0);
    QVERIFY(!fed.context().signal(QStringLiteral("count"), start - 1).value.isValid());
    fed.context().goLive();
    QCOMPARE(fed.context().shown(QStringLiteral("count")).number(), 99.0);
}

void tst_QPlcPanelContext::aLivePanelEndsWithItsOwnPlant()
{
    FedPanel fed;
    Plant *ahead = fed.add(QStringLiteral("simulation"));
    const Time newest = fed.kite->newestTime();
    fed.now += 3'600'000'000'000;
    fed.take(ahead, 10);
    QCOMPARE(fed.context().end(), newest);
    fed.panel.shown = QStringList{QStringLiteral("simulation/count")};
    QCOMPARE(fed.context().end(), ahead->newestTime());
    QCOMPARE(fed.context().end() - fed.context().begin(), fed.window.timeAxis()->span());
}

void tst_QPlcPanelContext::cursorsAreSharedWithTheWindow()
{
    FedPanel fed;
    fed.context().setCursor(Context::CursorB, start + 5);
    QVERIFY(!fed.context().cursor(Context::CursorA));
    QCOMPARE(*fed.context().cursor(Context::CursorB), start + 5);
    QCOMPARE(*fed.window.timeAxis()->cursor(QPlcTimeAxis::B), start + 5);
    fed.context().setPointer(start + 7);
    QCOMPARE(*fed.window.timeAxis()->pointer(), start + 7);
    fed.context().setPointer(std::nullopt);
    QVERIFY(!fed.context().pointer());
}

void tst_QPlcPanelContext::lostPlantIsSignalledAndShown()
{
    FedPanel fed;
    QVERIFY(fed.context().plant().isConnected);
    QVERIFY(fed.context().plant().isLive);
    const QSignalSpy told(&fed.context(), &Context::plantStateChanged);
    fed.kite->feed()->disconnected();
    QVERIFY(told.count() > 0);
    QCOMPARE(told.first().first().toString(), QStringLiteral("kite"));
    QVERIFY(!fed.context().plant().isConnected);
    QVERIFY(fed.context().plant().isStale);
    QVERIFY(!fed.context().signal(QStringLiteral("count")).isCurrent);
    QCOMPARE(fed.context().signal(QStringLiteral("count")).number(), 99.0);  // what it was
    fed.kite->feed()->connected(testTable());
    fed.kite->feed()->started();
    fed.take(fed.kite, 2);
    QVERIFY(fed.context().plant().isLive);
    QVERIFY(fed.context().signal(QStringLiteral("count")).isCurrent);
}

void tst_QPlcPanelContext::changesAreSignalledTogetherAndOnlyToVisiblePanels()
{
    FedPanel fed;
    const QSignalSpy changed(&fed.context(), &Context::changed);
    fed.take(fed.kite, 5);
    QCOMPARE(changed.count(), 0);
    fed.panel.show();
    QCOMPARE(changed.count(), 1);  // what has happened meanwhile
    fed.take(fed.kite, 50);
    QCOMPARE(changed.count(), 1);
    QTRY_COMPARE(changed.count(), 2);
    fed.panel.hide();
    fed.take(fed.kite, 5);
    QTest::qWait(50);
    QCOMPARE(changed.count(), 2);
}

void tst_QPlcPanelContext::themeFollowsTheWindow()
{
    FedPanel fed;
    const QSignalSpy themeChanged(&fed.context(), &Context::themeChanged);
    fed.window.setTheme(qplc::Theme::byName(qplc::Theme::Dark));
    QCOMPARE(themeChanged.count(), 1);
    QVERIFY(fed.context().theme().isDark);
    const QColor dark = fed.context().theme().surface;
    fed.window.setTheme(qplc::Theme::byName(qplc::Theme::Light));
    QVERIFY(fed.context().theme().surface.lightness() > dark.lightness());
    QFont large = fed.panel.font();
    large.setPointSizeF(20.0);
    fed.panel.setFont(large);
    QCOMPARE(fed.context().theme().font.pointSizeF(), 20.0);
    QVERIFY(fed.context().theme().labelFont.pointSizeF() < 20.0);
}

void tst_QPlcPanelContext::numbersAreWrittenAsInTheWindow()
{
    FedPanel fed;
    QCOMPARE(Context::text(1.008e6, QStringLiteral("W")), QStringLiteral("1.008 MW"));
    QCOMPARE(Context::text(1.39e-5, QStringLiteral("s")), QString::fromUtf8("13.90 µs"));
    QCOMPARE(Context::text(fed.context().signal(QStringLiteral("setpoint"))), QStringLiteral("1.250 m/s"));
    QVERIFY(Context::text(fed.context().signal(QStringLiteral("vector"))).startsWith(QLatin1Char('[')));
    QCOMPARE(Context::text(fed.context().signal(QStringLiteral("nothing"))), QString::fromUtf8("–"));
    QCOMPARE(Context::prefix(QStringLiteral("W"), 4e6).unit, QStringLiteral("MW"));
    QCOMPARE(Context::prefix(QStringLiteral("W"), 4e6).factor, 1e-6);
}

void tst_QPlcPanelContext::settingsAreSavedAndUndone()
{
    Panel panel;
    panel.applySettings({{"later", 1}});
    QCOMPARE(panel.setting(QStringLiteral("span"), 5).toInt(), 5);
    const QJsonObject before = panel.settings();
    const QSignalSpy edited(&panel, &QPlcWidget::settingsEdited);
    panel.setSetting(QStringLiteral("span"), 7, 5);
    panel.setSetting(QStringLiteral("span"), 7, 5);
    QCOMPARE(edited.count(), 1);
    QCOMPARE(panel.settings(), (QJsonObject{{"later", 1}, {"span", 7}}));
    panel.applySettings(before);  // undo
    QCOMPARE(panel.setting(QStringLiteral("span"), 5).toInt(), 5);
    QCOMPARE(panel.settings(), before);
    panel.setSetting(QStringLiteral("span"), 7, 5);
    panel.setSetting(QStringLiteral("span"), 5, 5);
    QCOMPARE(panel.settings(), before);
}

QTEST_MAIN(tst_QPlcPanelContext)
#include "tst_QPlcPanelContext.moc"
