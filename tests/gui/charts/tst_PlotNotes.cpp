// SPDX-License-Identifier: Apache-2.0
// Notes of people as marks in a time plot.
#include "FedPlotWindow.h"
#include "gui/charts/PlotNotes.h"
#include "gui/charts/PlotOverlay.h"

#include <limits>

using namespace qplc;

namespace {

struct NotesWindow : FedPlotWindow
{
    explicit NotesWindow(const QByteArray &settings = R"({"curves":[{"signal":"speed"}]})")
        : FedPlotWindow(settings)
    {
    }
    void tell(int row, const QString &text, const QString &source = QStringLiteral("kite"), bool isNote = true)
    {
        FedPlotWindow::tell(row, text, source, isNote);
    }
    const QVector<PlotOverlay::Note> &marks() const { return plot->findChild<PlotOverlay *>()->picture().notes; }
};

}  // namespace

class tst_PlotNotes : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void aNoteIsAMarkAtItsTime();
    void marksAreInTheOrderOfTime();
    void otherEventsAndOtherPlantsHaveNoMarks();
    void aNoteThatComesIsShown();
    void notesOutsideOfTheViewAreNotShown();
    void onlyTheNewestOfManyAreShown();
    void theNewestOfVeryManyAreKept();
};

void tst_PlotNotes::aNoteIsAMarkAtItsTime()
{
    NotesWindow window;
    window.tell(150, QStringLiteral("gust"), QStringLiteral("kite/anna@desk"));
    QVERIFY(window.show());
    QTRY_COMPARE(window.marks().size(), 1);
    QCOMPARE(window.marks().first().text, QStringLiteral("gust"));
    const SignalStore *store = window.plant->store();
    const double place = window.canvas()->xOf(store->time(store->firstRow() + 150));
    QVERIFY(std::abs(window.marks().first().place - place) <= 1.0);
}

void tst_PlotNotes::marksAreInTheOrderOfTime()
{
    NotesWindow window;
    window.tell(200, QStringLiteral("second"));
    window.tell(100, QStringLiteral("first"));  // of a master that tells it only now
    QVERIFY(window.show());
    QTRY_COMPARE(window.marks().size(), 2);
    QCOMPARE(window.marks().first().text, QStringLiteral("first"));
    QVERIFY(window.marks().first().place < window.marks().last().place);
}

void tst_PlotNotes::otherEventsAndOtherPlantsHaveNoMarks()
{
    NotesWindow window;
    window.tell(100, QStringLiteral("tether late"), QStringLiteral("kite"), false);
    window.tell(120, QStringLiteral("reef"), QStringLiteral("boat"));
    window.tell(150, QStringLiteral("gust"));
    QVERIFY(window.show());
    QTRY_COMPARE(window.marks().size(), 1);
    QCOMPARE(window.marks().first().text, QStringLiteral("gust"));
}

void tst_PlotNotes::aNoteThatComesIsShown()
{
    NotesWindow window;
    QVERIFY(window.show());
    QVERIFY(window.marks().isEmpty());
    window.tell(150, QStringLiteral("gust"));
    QTRY_COMPARE(window.marks().size(), 1);
}

void tst_PlotNotes::notesOutsideOfTheViewAreNotShown()
{
    NotesWindow window;
    window.tell(50, QStringLiteral("early"));
    window.tell(290, QStringLiteral("late"));
    QVERIFY(window.show());
    QTRY_COMPARE(window.marks().size(), 2);
    window.context.timeAxis()->setSpan(500 * millisecond);
    QTRY_COMPARE(window.marks().size(), 1);
    QCOMPARE(window.marks().first().text, QStringLiteral("late"));
}

void tst_PlotNotes::onlyTheNewestOfManyAreShown()
{
    NotesWindow window;
    for (int i = 0; i < 120; ++i)
        window.tell(100 + i, QString::number(i));
    QVERIFY(window.show());
    QTRY_COMPARE(window.marks().size(), 50);
    QCOMPARE(window.marks().last().text, QStringLiteral("119"));
}

void tst_PlotNotes::theNewestOfVeryManyAreKept()
{
    NotesWindow window;
    constexpr int many = int(PlotNotes::MostKept);
    for (int i = 0; i < many; ++i)
        window.tell(100, QStringLiteral("old"));
    window.tell(200, QStringLiteral("new"));
    window.tell(50, QStringLiteral("older than all"));  // of a master that tells it only now
    QVERIFY(window.show());
    QTRY_VERIFY(!window.marks().isEmpty());
    QCOMPARE(window.marks().last().text, QStringLiteral("new"));
    PlotNotes notes;
    QVERIFY(notes.update(*window.plot->context()));
    const auto all = notes.between(std::numeric_limits<PlotNotes::Time>::min(),
                                   std::numeric_limits<PlotNotes::Time>::max(), {QStringLiteral("kite")}, 2 * many);
    QCOMPARE(all.size(), PlotNotes::MostKept);
    QCOMPARE(all.front().text, QStringLiteral("old"));
}

QTEST_MAIN(tst_PlotNotes)
#include "tst_PlotNotes.moc"
