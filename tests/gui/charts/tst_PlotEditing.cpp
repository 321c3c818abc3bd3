// SPDX-License-Identifier: Apache-2.0
// What people change of a time plot: curves, settings, exports.
#include "../../common/Waiting.h"
#include "PlotFixtures.h"
#include "gui/charts/PlotPicture.h"
#include "gui/charts/PlotSettingsEditor.h"
#include "gui/panel/SignalEdit.h"

#include <QtCore/QJsonArray>
#include <QtCore/QTemporaryDir>
#include <QtGui/QClipboard>
#include <QtWidgets/QApplication>
#include <QtWidgets/QCheckBox>
#include <QtWidgets/QFileDialog>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>
#include <QtWidgets/QToolButton>

using namespace qplc;

namespace {

template<typename Part>
Part *named(const QWidget *parent, const QString &name)
{
    for (Part *part : parent->findChildren<Part *>()) {
        if (part->accessibleName() == name)
            return part;
    }
    qFatal("there is no '%s'", qPrintable(name));
}

}  // namespace

class tst_PlotEditing : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void titleListsTheCurvesUnlessTheUserNamesThePlot();
    void appliedSettingsAreReturnedUnchanged();
    void missingSettingsGetTheirDefaults();
    void signalsAreAddedOnce();
    void arraysAddTheirElementsAndTextsAddNoCurve();
    void formulasArePassedThrough();
    void aClickInTheLegendHidesAndSelects();
    void fromTheNinthOnCurvesHaveDashes();
    void keysChooseHideAndRemoveCurves();
    void theAddBarCompletesNames();
    void plusAddsOnlyToAnEmptyPlot();
    void everyActionHasAKeyAndNoTwoShareOne();
    void editorAppliesChangesImmediately();
    void theEditorAddsAndRemovesCurves();
    void keyboardOpensTheContextMenu();
    void visibleCurvesAreCopiedToTheClipboard();
    void picturesHaveTwiceThePixels();
    void rowsBetweenTheCursorsAreCopiedToTheClipboard();
    void fileDialogDoesNotBlockAndFailuresAreReported();
    void smallPanelsKeepTheirCurves();
    void statisticsLegendLeavesRoomForManyCurves();
    void legendShowsTheQualityAtThePointer();
    void staleValuesAreNotTrusted();
};

void tst_PlotEditing::appliedSettingsAreReturnedUnchanged()
{
    PlotWindow window;
    const QByteArray text = R"({"curves":[{"color":"#112233","signal":"count"},{"signal":"gone.away","tool":"x"}],)"
                            R"("limits":true,"other":[1],"title":"Force"})";
    window.apply(text);
    QCOMPARE(window.settings(), text);
    QCOMPARE(window.plot->title(), QStringLiteral("Force"));
}

void tst_PlotEditing::missingSettingsGetTheirDefaults()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}],"grid":false,"time":"own"})");
    window.apply(R"({"curves":[]})");
    QCOMPARE(window.settings(), QByteArray("{}"));
}

void tst_PlotEditing::signalsAreAddedOnce()
{
    PlotWindow window;
    QSignalSpy edited(window.plot, &QPlcWidget::settingsEdited);
    QVERIFY(window.plot->addSignals({"a", "b", "a"}));
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"signal":"a"},{"signal":"b"}]})"));
    QCOMPARE(edited.size(), 1);
    QVERIFY(window.plot->addSignals({"b"}));
    QCOMPARE(edited.size(), 1);
    QVERIFY(!window.plot->addSignals({}));
    QVERIFY(!window.plot->addSignals({QString()}));
}

void tst_PlotEditing::arraysAddTheirElementsAndTextsAddNoCurve()
{
    PlotWindow window;
    QVERIFY(window.run(0.05));
    QVERIFY(!window.plot->addSignals({"time"}));
    QVERIFY(window.plot->addSignals({"vector", "time", "vector[1]"}));
    QCOMPARE(window.settings(),
             QByteArray(R"({"curves":[{"signal":"vector[0]"},{"signal":"vector[1]"},{"signal":"vector[2]"}]})"));
    QTRY_COMPARE(window.hint(), QString());
}

void tst_PlotEditing::formulasArePassedThrough()
{
    PlotWindow window;
    QVERIFY(window.plot->addSignals({"= count * 2"}));
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"signal":"= count * 2"}]})"));
}

void tst_PlotEditing::aClickInTheLegendHidesAndSelects()
{
    PlotWindow window(R"({"curves":[{"signal":"count"},{"signal":"sum"}]})");
    QVERIFY(window.run(0.1));
    QSignalSpy edited(window.plot, &QPlcWidget::settingsEdited);
    auto *legend = window.part<PlotLegend>();
    QTRY_VERIFY(legend->isVisible());
    QTest::mouseClick(legend, Qt::LeftButton, {}, legend->entryRect(1).center());
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"signal":"count"},{"signal":"sum","visible":false}]})"));
    QCOMPARE(edited.size(), 1);
    QVERIFY(legend->entries().value(1).isSelected && !legend->entries().value(1).isVisible);
    QCOMPARE(window.canvas()->itemList(QwtPlotItem::Rtti_PlotUserItem + 1).size(), 1);
    QTest::mouseClick(legend, Qt::LeftButton, {}, legend->entryRect(1).center());
    QCOMPARE(window.canvas()->itemList(QwtPlotItem::Rtti_PlotUserItem + 1).size(), 2);
}

void tst_PlotEditing::fromTheNinthOnCurvesHaveDashes()
{
    QJsonArray wanted;
    for (int i = 0; i < 17; ++i)
        wanted.append(QJsonObject{{"signal", "count"}, {"offset", 10 * i}});
    PlotWindow window;
    window.plot->applySettings({{"curves", wanted}});
    QVERIFY(window.run(0.2));
    auto *legend = window.part<PlotLegend>();
    QTRY_VERIFY(legend->isVisible() && legend->entries().size() == 17 && legend->entries().value(0).isTrusted);
    const QList<QwtPlotItem *> curves = window.canvas()->itemList(QwtPlotItem::Rtti_PlotUserItem + 1);
    QCOMPARE(curves.size(), 17);
    QImage picture(legend->size(), QImage::Format_RGB32);
    legend->render(&picture);
    for (int i = 0; i < 17; ++i) {
        const Qt::PenStyle expected = i < 8 ? Qt::SolidLine : i < 16 ? Qt::DashLine : Qt::DotLine;
        QCOMPARE(static_cast<const StoreCurve *>(curves[i])->penStyle(), expected);
        const PlotLegend::Entry entry = legend->entries().value(i);
        QCOMPARE(entry.penStyle, expected);
        // The swatch: pieces of its colour, from left to right.
        const QRect rect = legend->entryRect(i);
        int pieces = 0;
        bool isColored = false;
        for (int x = rect.left(); x < rect.left() + 11; ++x) {
            const bool isHere = picture.pixel(x, rect.center().y()) == entry.color.rgb();
            pieces += isHere && !isColored ? 1 : 0;
            isColored = isHere;
        }
        QCOMPARE(pieces, i < 8 ? 1 : i < 16 ? 2 : 3);
    }
}

void tst_PlotEditing::keysChooseHideAndRemoveCurves()
{
    PlotWindow window(R"({"curves":[{"signal":"a"},{"signal":"b"},{"signal":"c"}]})");
    window.plot->show();
    window.plot->activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(window.plot));
    window.plot->setFocus();
    QTest::keyClick(window.plot, Qt::Key_J);
    QTest::keyClick(window.plot, Qt::Key_J);
    QTest::keyClick(window.plot, Qt::Key_V);
    QCOMPARE(window.settings(),
             QByteArray(R"({"curves":[{"signal":"a"},{"signal":"b","visible":false},{"signal":"c"}]})"));
    QTest::keyClick(window.plot, Qt::Key_Delete);
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"signal":"a"},{"signal":"c"}]})"));
    QTest::keyClick(window.plot, Qt::Key_J, Qt::ShiftModifier);
    QTest::keyClick(window.plot, Qt::Key_Delete);
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"signal":"c"}]})"));
    QTest::keyClick(window.plot, Qt::Key_Space);
    QVERIFY(!window.time()->isLive());
    QTest::keyClick(window.plot, Qt::Key_L);
    QVERIFY(window.time()->isLive());
}

void tst_PlotEditing::theAddBarCompletesNames()
{
    PlotWindow window;
    QVERIFY(window.run(0.05));
    QVERIFY(SignalEdit::names(*window.context.plants(), SignalEdit::Curves).contains(QStringLiteral("vector[2]")));
    QVERIFY(!SignalEdit::names(*window.context.plants(), SignalEdit::Curves).contains(QStringLiteral("time")));
    window.trigger("add");
    auto *bar = window.part<SignalEdit>();
    QVERIFY(bar);
    QTest::keyClicks(bar, QStringLiteral("setp"));
    QTest::keyClick(bar, Qt::Key_Return);
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"signal":"setpoint"}]})"));
    QTRY_VERIFY(!window.part<SignalEdit>());
    window.trigger("add");
    QTest::keyClicks(window.part<SignalEdit>(), QStringLiteral("comes.later"));
    QTest::keyClick(window.part<SignalEdit>(), Qt::Key_Return);
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"signal":"setpoint"},{"signal":"comes.later"}]})"));
}

void tst_PlotEditing::plusAddsOnlyToAnEmptyPlot()
{
    PlotWindow window;
    window.plot->show();
    window.trigger("zoomIn");
    QVERIFY(window.part<SignalEdit>());
    QTest::keyClick(window.part<SignalEdit>(), Qt::Key_Escape);
    QTRY_VERIFY(!window.part<SignalEdit>());
    window.plot->addSignals({"count"});
    const QPlcTimeAxis::Time span = window.time()->span();
    window.trigger("zoomIn");
    QVERIFY(!window.part<SignalEdit>());
    QVERIFY(window.time()->span() < span);
}

void tst_PlotEditing::everyActionHasAKeyAndNoTwoShareOne()
{
    const QPlcTimePlot plot;
    QSet<QString> keys;
    QVERIFY(plot.actions().size() > 20);
    for (const QAction *action : plot.actions()) {
        QVERIFY2(!action->shortcuts().isEmpty() && !action->text().isEmpty(), qPrintable(action->text()));
        for (const QKeySequence &key : action->shortcuts()) {
            QVERIFY2(!keys.contains(key.toString()), qPrintable(key.toString()));
            keys.insert(key.toString());
        }
    }
}

void tst_PlotEditing::editorAppliesChangesImmediately()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QSignalSpy edited(window.plot, &QPlcWidget::settingsEdited);
    const std::unique_ptr<QWidget> editor(window.plot->createSettingsEditor());
    editor->show();
    auto *gain = named<QLineEdit>(editor.get(), QStringLiteral("Gain of count"));
    gain->selectAll();
    QTest::keyClicks(gain, QStringLiteral("-2"));
    QTest::keyClicks(named<QLineEdit>(editor.get(), QStringLiteral("Left axis: smallest value")), QStringLiteral("5"));
    for (QCheckBox *check : editor->findChildren<QCheckBox *>()) {
        if (check->text() == QLatin1String("Limits"))
            check->click();
    }
    QCOMPARE(window.settings(),
             QByteArray(R"({"curves":[{"gain":-2,"signal":"count"}],"left":{"minimum":5},"limits":false})"));
    QCOMPARE(edited.size(), 3);
}

void tst_PlotEditing::theEditorAddsAndRemovesCurves()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    const std::unique_ptr<QWidget> editor(window.plot->createSettingsEditor());
    editor->show();
    QTest::keyClicks(editor->focusProxy(), QStringLiteral("sum"));
    QTest::keyClick(editor->focusProxy(), Qt::Key_Return);
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"signal":"count"},{"signal":"sum"}]})"));
    named<QToolButton>(editor.get(), QStringLiteral("Colour of sum"))->menu()->actions().at(2)->trigger();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    named<QToolButton>(editor.get(), QStringLiteral("Remove count"))->click();
    const QByteArray color = window.context.theme().curve(0).name().toLatin1();
    QCOMPARE(window.settings(), "{\"curves\":[{\"color\":\"" + color + "\",\"signal\":\"sum\"}]}");
}

void tst_PlotEditing::keyboardOpensTheContextMenu()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    window.plot->show();
    window.trigger("next");
    QContextMenuEvent event(QContextMenuEvent::Keyboard, {10, 10}, {10, 10});
    QCoreApplication::sendEvent(window.plot, &event);
    auto *menu = qobject_cast<QMenu *>(QApplication::activePopupWidget());
    QVERIFY(menu);
    QStringList names;
    for (const QAction *action : menu->actions())
        names << action->objectName();
    for (const char *name :
         {"add", "remove", "toggle", "cursorA", "cursorB", "all", "live", "saveTable", "copyPicture"})
        QVERIFY2(names.contains(QLatin1String(name)), name);
    menu->close();
}

void tst_PlotEditing::visibleCurvesAreCopiedToTheClipboard()
{
    PlotWindow window(R"({"curves":[{"signal":"count"},{"signal":"sum","gain":2},{"signal":"echo","visible":false}]})");
    QVERIFY(window.run(0.5));
    QVERIFY(window.show(window.time()->newest() - 100'000'000, window.time()->newest()));
    QGuiApplication::clipboard()->clear();
    window.trigger("copyTable");
    QTRY_VERIFY(!QGuiApplication::clipboard()->text().isEmpty());
    const QStringList lines = QGuiApplication::clipboard()->text().split(QLatin1Char('\n'));
    QCOMPARE(lines.first(), QStringLiteral("UTC\ttime [s]\tcount\t2*sum [m]"));
    const SignalStore &store = *window.context.plants()->at(0)->store();
    const auto rows = store.rowAt(window.canvas()->end()) - store.rowAt(window.canvas()->begin());
    QVERIFY(rows > 0 && rows < 20);
    QCOMPARE(lines.size(), int(rows) + 2);  // with the header, and nothing behind the last line
}

void tst_PlotEditing::rowsBetweenTheCursorsAreCopiedToTheClipboard()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.5));
    const CurveSource source = window.context.curveSources()->find(QStringLiteral("count"));
    const SignalStore &store = *source.store;
    const SignalStore::Row last = store.endRow() - 1;
    window.time()->setCursor(QPlcTimeAxis::B, store.time(last - 20));  // in any order
    window.time()->setCursor(QPlcTimeAxis::A, store.time(last - 10));
    QGuiApplication::clipboard()->clear();
    window.trigger("copyBetween");
    QTRY_VERIFY(!QGuiApplication::clipboard()->text().isEmpty());
    const QStringList lines = QGuiApplication::clipboard()->text().split(QLatin1Char('\n'));
    QCOMPARE(lines.size(), 1 + 11 + 1);
    QCOMPARE(lines.at(1).section(QLatin1Char('\t'), 2).toFloat(), store.value(source.channel, last - 20));
}

void tst_PlotEditing::picturesHaveTwiceThePixels()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.1));
    window.trigger("copyPicture");
    const QImage image = QGuiApplication::clipboard()->image();
    QVERIFY(image.width() >= 2 * window.canvas()->width());
    const QTemporaryDir folder;
    const PlotPicture picture(window.canvas(), window.part<PlotOverlay>(), window.part<PlotLegend>());
    QCOMPARE(picture.save(folder.filePath(QStringLiteral("a.svg"))), QString());
    QCOMPARE(picture.save(folder.filePath(QStringLiteral("a.png"))), QString());
    QFile svg(folder.filePath(QStringLiteral("a.svg")));
    QVERIFY(svg.open(QIODevice::ReadOnly));
    QVERIFY(svg.readAll().contains("<polyline"));
    QCOMPARE(picture.save(folder.filePath(QStringLiteral("a.pdf"))), QString());
    QFile pdf(folder.filePath(QStringLiteral("a.pdf")));
    QVERIFY(pdf.open(QIODevice::ReadOnly));
    QVERIFY(pdf.readAll().startsWith("%PDF-"));
    QVERIFY(!QImage(folder.filePath(QStringLiteral("a.png"))).isNull());
    QVERIFY(picture.save(QStringLiteral("/nowhere/a.png")).contains(QStringLiteral("/nowhere/a.png")));
}

void tst_PlotEditing::fileDialogDoesNotBlockAndFailuresAreReported()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.1));
    window.trigger("saveTable");
    auto *dialog = window.part<QFileDialog>();
    QVERIFY(dialog && dialog->isVisible());
    Q_EMIT dialog->fileSelected(QStringLiteral("/nowhere/a.csv"));
    dialog->close();
    bool isSaid = false;
    for (const QLabel *label : window.plot->findChildren<QLabel *>())
        isSaid = isSaid || (label->isVisible() && label->text().contains(QStringLiteral("/nowhere/a.csv")));
    QVERIFY(isSaid);
}

void tst_PlotEditing::smallPanelsKeepTheirCurves()
{
    PlotWindow window(R"({"curves":[{"signal":"count"},{"signal":"sum"},{"signal":"echo"}]})");
    window.plot->resize(240, 120);
    QVERIFY(window.run(0.1));
    QTRY_VERIFY(window.canvas()->canvas()->height() >= 40);
    QVERIFY(window.canvas()->canvas()->width() >= 120);
    window.plot->resize(240, 80);
    QTRY_VERIFY(!window.part<PlotLegend>()->isVisible());
}

void tst_PlotEditing::statisticsLegendLeavesRoomForManyCurves()
{
    PlotWindow window;
    QJsonArray curves;
    for (int i = 0; i < 12; ++i)
        curves.append(QJsonObject{{QStringLiteral("signal"), QStringLiteral("= count + %1").arg(i)}});
    window.plot->applySettings({{QStringLiteral("curves"), curves}});
    window.plot->resize(500, 300);
    QVERIFY(window.run(0.3));
    window.trigger("cursorA");
    window.trigger("cursorB");
    QTRY_VERIFY(window.part<StatisticsView>()->isVisible());
    QVERIFY(window.part<StatisticsView>()->isUnfolded());
    QTRY_VERIFY(window.canvas()->height() >= 110);
}

void tst_PlotEditing::legendShowsTheQualityAtThePointer()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.3));
    window.time()->freeze();
    window.context.plants()->at(0)->close();
    SignalStore *store = window.context.plants()->at(0)->store();
    const auto channel = window.context.plants()->at(0)->values().channels().channel(
        window.context.plants()->at(0)->table().indexOf(QStringLiteral("count")));
    store->mark(channel, QPlcQuality::Safe);
    const SignalStore::Row newest = *store->newestRow();
    auto *legend = window.part<PlotLegend>();
    window.time()->setPointer(store->time(newest));
    QTRY_COMPARE(legend->entries().value(0).doubt, QStringLiteral("safe"));
    QVERIFY(!legend->entries().value(0).isTrusted);
    window.time()->setPointer(store->time(newest - 1));
    QTRY_COMPARE(legend->entries().value(0).doubt, QString());
    QVERIFY(legend->entries().value(0).isTrusted);
}

void tst_PlotEditing::staleValuesAreNotTrusted()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.1));
    auto *legend = window.part<PlotLegend>();
    QTRY_VERIFY(legend->entries().value(0).isTrusted);
    const int height = legend->heightForWidth(300);
    window.context.plants()->at(0)->close();
    QTRY_VERIFY(!legend->entries().value(0).isTrusted);
    QTRY_VERIFY2(legend->entries().value(0).doubt.contains(QLatin1Char('s')),
                 qPrintable(legend->entries().value(0).doubt));
    QCOMPARE(legend->heightForWidth(300), height);
}

void tst_PlotEditing::titleListsTheCurvesUnlessTheUserNamesThePlot()
{
    QPlcWidget::registerFactory(new QPlcTimePlotFactory);
    QPlcTimePlot plot;
    QCOMPARE(plot.title(), QStringLiteral("Time plot"));
    QSignalSpy changed(&plot, &QPlcWidget::titleChanged);
    plot.applySettings(
        QJsonDocument::fromJson(R"({"curves":[{"signal":"power"},{"name":"Length","signal":"x"}]})").object());
    QCOMPARE(plot.title(), QStringLiteral("power, Length"));
    QCOMPARE(changed.size(), 1);
    QVERIFY(!plot.settings().contains(QStringLiteral("title")));
    plot.setTitle(QStringLiteral("Winch"));
    plot.addSignals({QStringLiteral("speed")});
    QCOMPARE(plot.title(), QStringLiteral("Winch"));
    plot.setTitle({});
    QCOMPARE(plot.title(), QStringLiteral("power, Length, speed"));
    plot.addSignals({QStringLiteral("a"), QStringLiteral("b")});
    QCOMPARE(plot.title(), QStringLiteral("power, Length, speed, a, …"));
}

QTEST_MAIN(tst_PlotEditing)
#include "tst_PlotEditing.moc"
