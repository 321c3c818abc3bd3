// SPDX-License-Identifier: Apache-2.0
// What a time plot holds of its sources, how they are named, and how often it draws.
#include "../../common/Waiting.h"
#include "PlotFixtures.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QRegularExpression>
#include <QtCore/QTemporaryDir>
#include <QtGui/QClipboard>
#include <QtGui/QGuiApplication>

using namespace qplc;
using Time = QPlcTimeAxis::Time;

namespace {

constexpr Time s = 1'000'000'000;
const QString formula = QStringLiteral("= mean(count, 1)");
const QByteArray derivedCurve = R"json({"curves":[{"signal":"= mean(count, 1)"}]})json";

}  // namespace

class tst_PlotSources : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void aPlotHoldsItsDerivedSignalUntilItIsClosed();
    void anEditKeepsTheDerivedSignals();
    void heldCurveIsDrawnAfterItsPlantIsRemoved();
    void moreOfThePastIsDrawnInFrozenViews();
    void aFormulaIsShownWithoutTheEqualsSign();
    void aNameIsShownInsteadOfTheExpression();
    void aPlotDrawsAtMostFiftyPicturesASecond();
    void narrowLegendsKeepTheirValues();
    void aLegendGetsALineMoreWhenItsValuesGetWider();
    void valuesOfTheLegendDoNotMove();
};

void tst_PlotSources::aPlotHoldsItsDerivedSignalUntilItIsClosed()
{
    PlotWindow window(derivedCurve);
    QVERIFY(window.run(0.2));
    std::weak_ptr<DerivedSignal> held = window.context.curveSources()->find(formula).derived;
    QVERIFY(!held.expired());
    delete window.plot;
    window.plot = nullptr;
    QVERIFY(held.expired());
}

void tst_PlotSources::anEditKeepsTheDerivedSignals()
{
    PlotWindow window(derivedCurve);
    QVERIFY(window.run(0.2));
    const std::weak_ptr<DerivedSignal> before = window.context.curveSources()->find(formula).derived;
    window.apply(R"json({"curves":[{"signal":"= mean(count, 1)","gain":2}],"grid":false})json");
    QVERIFY(!before.expired());
    window.apply("{}");
    QVERIFY(before.expired());
}

void tst_PlotSources::heldCurveIsDrawnAfterItsPlantIsRemoved()
{
    PlotWindow window(derivedCurve);
    QVERIFY(window.run(0.2));
    window.trigger("copyTable");
    window.context.plants()->remove(window.context.plants()->at(0));
    QTRY_VERIFY(window.hint().contains(QStringLiteral("Missing")));
    const int before = window.plot->drawnPictures();
    window.time()->pan(-s);
    QTRY_VERIFY(window.plot->drawnPictures() > before);
}

void tst_PlotSources::moreOfThePastIsDrawnInFrozenViews()
{
    PlotWindow window(derivedCurve);
    QVERIFY(window.run(0.3));
    window.time()->freeze();
    QVERIFY(window.isDrawn());
    const int before = window.plot->drawnPictures();
    Q_EMIT window.context.curveSources()->filled();
    QTRY_VERIFY(window.plot->drawnPictures() > before);
}

void tst_PlotSources::aFormulaIsShownWithoutTheEqualsSign()
{
    PlotCurveSettings curve;
    curve.signal = QStringLiteral(" =a + b ");
    QCOMPARE(curve.text(), QStringLiteral("a + b"));
    curve.gain = 2.0;
    QCOMPARE(curve.text(), QStringLiteral("2*(a + b)"));
}

void tst_PlotSources::aNameIsShownInsteadOfTheExpression()
{
    PlotWindow window(R"json({"curves":[{"name":"Average","signal":"= mean(count, 1)"}]})json");
    QVERIFY(window.run(0.2));
    QTRY_COMPARE(window.part<PlotLegend>()->entries().value(0).name, QStringLiteral("Average"));
    QVERIFY(window.part<PlotLegend>()->entries().value(0).hint.contains(formula));
    window.trigger("copyTable");
    QTRY_VERIFY(QGuiApplication::clipboard()->text().startsWith(QStringLiteral("UTC\ttime [s]\tAverage")));
}

/// Whatever a mouse does meanwhile: its steps come as often as they like.
void tst_PlotSources::aPlotDrawsAtMostFiftyPicturesASecond()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QVERIFY(window.run(0.2));
    QElapsedTimer clock;
    clock.start();
    const int before = window.plot->drawnPictures();
    while (clock.elapsed() < 1'000) {
        window.trigger("larger");
        window.time()->setSpan(s + clock.nsecsElapsed());
        QCoreApplication::processEvents(QEventLoop::AllEvents, 1);
    }
    const int drawn = window.plot->drawnPictures() - before;
    QVERIFY2(drawn > 0 && drawn <= clock.elapsed() / 20 + 1, qPrintable(QString::number(drawn)));
}

void tst_PlotSources::narrowLegendsKeepTheirValues()
{
    PlotWindow window(R"({"curves":[{"signal":"count"},{"signal":"sum"},{"signal":"setpoint"}]})");
    QVERIFY(window.run(0.1));
    const auto *legend = window.part<PlotLegend>();
    for (const QSize size : {QSize(170, 180), QSize(250, 200), QSize(330, 240), QSize(700, 300)}) {
        window.plot->resize(size);
        QTRY_VERIFY(legend->isVisible() && legend->width() <= size.width());
        for (int place = 0; place < 3; ++place) {
            const QRect value = legend->valueRect(place);
            const int wanted = QFontMetrics(legend->font()).horizontalAdvance(QStringLiteral("88"));
            QVERIFY2(value.width() >= wanted && legend->rect().contains(value), qPrintable(QString::number(place)));
        }
        QTRY_VERIFY2(window.canvas()->height() >= 0.6 * window.plot->height(),
                     qPrintable(QString::number(window.canvas()->height())));
    }
    window.plot->resize(240, 90);
    QTRY_VERIFY(!legend->isVisible());
}

void tst_PlotSources::aLegendGetsALineMoreWhenItsValuesGetWider()
{
    PlotWindow window(
        R"({"curves":[{"signal":"count"},{"gain":1e7,"signal":"count"},{"gain":1e-7,"signal":"count"}]})");
    window.plot->resize(280, 240);
    QVERIFY(window.run(0.3));
    const auto *legend = window.part<PlotLegend>();
    QTRY_VERIFY2(legend->entries().value(1).value.size() > 7,
                 qPrintable(QStringLiteral("'%1' after %2 s, %3 pictures")
                                .arg(legend->entries().value(1).value)
                                .arg(window.past())
                                .arg(window.plot->drawnPictures())));
    QTRY_VERIFY(legend->entryRect(2).bottom() <= legend->parentWidget()->height());
    QVERIFY(legend->entryRect(2).top() > legend->entryRect(0).top());
}

void tst_PlotSources::valuesOfTheLegendDoNotMove()
{
    PlotWindow window(R"({"curves":[{"gain":0.37,"signal":"count"}]})");
    QVERIFY(window.run(0.1));
    const auto *legend = window.part<PlotLegend>();
    const auto digits
        = [&] { return legend->entries().value(0).value.count(QRegularExpression(QStringLiteral("\\d"))); };
    QTRY_VERIFY(legend->entries().value(0).value.toDouble() > 0.0);
    QTRY_COMPARE(digits(), 5);
    const QRect before = legend->valueRect(0);
    QTRY_VERIFY(legend->entries().value(0).value.toDouble() > 10.0);
    QCOMPARE(legend->valueRect(0), before);
}

QTEST_MAIN(tst_PlotSources)
#include "tst_PlotSources.moc"
