// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcSpectrum.h"

#include "NodeFixtures.h"
#include "PanelFixtures.h"
#include "gui/charts/SpectrumCanvas.h"
#include "gui/panel/WindowContext.h"
#include "gui/plant/PlantFeed.h"

#include <QtGui/QClipboard>
#include <QtGui/QGuiApplication>
#include <QtWidgets/QAction>
#include <QtWidgets/QComboBox>

#include <cmath>

using namespace qplc;

namespace {

constexpr qint64 aMillisecond = 1'000'000;
constexpr double pi = 3.14159265358979323846;

/// A panel with a plant whose cycles, 100 of them each second, have a force that swings with 5 Hz
/// and 3 N, and a speed that swings with 12.5 Hz and 2 m/s.
struct SpectrumWindow
{
    SpectrumWindow()
    {
        panel.resize(640, 400);
        panel.setContext(&context);
        const QPlcSignalTable table = QPlcSignalTable::fromIni("[force]\ntype = Real\nunit = N\n"
                                                               "[speed]\ntype = Real\nunit = m/s\n");
        QPlcSignalIndexTable::setCurrent(table);
        plant = context.plants()->addFed(QStringLiteral("kite"));
        plant->feed()->connected(table);
        plant->feed()->started();
        context.timeAxis()->setSpan(3600 * Second);
    }
    static constexpr qint64 Second = 1000 * aMillisecond;

    void take(int cycles)
    {
        for (int i = 0; i < cycles; ++i) {
            now += 10 * aMillisecond;
            const double t = double(count++) * 0.01;
            QPlcSignalList values = valueOf("force", QPlcValue(float(100.0 + 3.0 * std::sin(2.0 * pi * 5.0 * t))));
            values.insert(QStringLiteral("speed"), QPlcValue(float(2.0 * std::cos(2.0 * pi * 12.5 * t))));
            plant->feed()->add({values}, now);
        }
    }
    void apply(const char *settings) { panel.applySettings(objectOf(settings)); }
    bool show()
    {
        panel.show();
        return QTest::qWaitForWindowExposed(&panel);
    }
    SpectrumCanvas *canvas() const { return panel.findChild<SpectrumCanvas *>(); }
    /// And they have got their place.
    bool hasCurves(int curves) const
    {
        return canvas()->curves().size() == curves && canvas()->isVisible() && canvas()->canvas()->width() > 100;
    }
    /// The lines of the table in the clipboard.
    QStringList copied()
    {
        QGuiApplication::clipboard()->clear();
        trigger("copyTable");
        waitUntil([] { return !QGuiApplication::clipboard()->text().isEmpty(); }, 10000);
        return QGuiApplication::clipboard()->text().split(QLatin1Char('\n'), Qt::SkipEmptyParts);
    }
    void trigger(const char *name) { panel.findChild<QAction *>(QLatin1String(name))->trigger(); }
    double height(int curve, double frequency) const
    {
        const Spectrum::Lines &lines = canvas()->curves().at(curve).lines;
        return lines.values.at(std::size_t(std::llround(frequency / lines.step)));
    }

    WindowContext context;
    Plant *plant = nullptr;
    qint64 now = 1'700'000'000'000 * aMillisecond;
    qint64 count = 0;
    QPlcSpectrum panel;
};

}  // namespace

class tst_QPlcSpectrum : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void settingsAreRestoredUnchanged_data();
    void settingsAreRestoredUnchanged();
    void panelWithoutWindowSaysWhy();
    void amplitudesAreThoseOfTheSignals();
    void densityHasTheUnitPerHertz();
    void valuesAreThoseBetweenTheCursors();
    void longestPieceWithoutAGapIsShownAndSaid();
    void tooFewValuesAreRefusedWithASentence();
    void newValuesAreShownWhileTheWindowIsLive();
    void spectrogramIsThatOfOneSignal();
    void onlyEightSignalsAreShown();
    void cursorGoesToTheHighestLine();
    void zoomedAxesStay();
    void settingsAreEdited();
    void formulasHaveSpectra();
    void whatIsShownIsCopiedAsATable();
};

void tst_QPlcSpectrum::settingsAreRestoredUnchanged_data()
{
    QTest::addColumn<QByteArray>("json");
    QTest::newRow("none") << QByteArray("{}");
    QTest::newRow("all") << QByteArray(
        R"({"logFrequency":true,"logValues":false,"overlap":75,"segment":256,"show":"density","signals":["a"],)"
        R"("title":"T","unknown":[1],"window":"flatTop"})");
}

void tst_QPlcSpectrum::settingsAreRestoredUnchanged()
{
    QFETCH(QByteArray, json);
    QPlcSpectrum panel;
    panel.applySettings(objectOf(json.constData()));
    QCOMPARE(QJsonDocument(panel.settings()).toJson(QJsonDocument::Compact), json);
}

void tst_QPlcSpectrum::panelWithoutWindowSaysWhy()
{
    QPlcSpectrum panel;
    panel.show();
    QVERIFY(showsText(panel, "Drop signals here"));
    QVERIFY(!panel.addSignals({}));
    QVERIFY(panel.addSignals({"a"}));
    QTRY_VERIFY(showsText(panel, "No plant is connected."));
}

void tst_QPlcSpectrum::amplitudesAreThoseOfTheSignals()
{
    SpectrumWindow window;
    window.take(1000);
    window.apply(R"({"signals":["force","speed"]})");
    QVERIFY(window.show());
    QTRY_VERIFY(window.hasCurves(2));
    QVERIFY2(std::fabs(window.height(0, 5.0) - 3.0) < 0.01, qPrintable(QString::number(window.height(0, 5.0))));
    QVERIFY(std::fabs(window.height(1, 12.5) - 2.0) < 0.01);
    QVERIFY(window.height(0, 20.0) < 0.01);
    QVERIFY(showsText(window.panel, "1000 values"));
    QVERIFY(showsText(window.panel, "100.0 Hz"));
    const QImage picture = window.canvas()->canvas()->grab().toImage();
    const QRgb color = window.context.theme().curve(0).rgb();
    int pixels = 0;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x)
            pixels += picture.pixel(x, y) == color ? 1 : 0;
    }
    QVERIFY2(pixels > 100, qPrintable(QString::number(pixels)));  // the curve is drawn
}

void tst_QPlcSpectrum::densityHasTheUnitPerHertz()
{
    SpectrumWindow window;
    window.take(1000);
    window.apply(R"({"signals":["speed"],"show":"density","segment":200})");
    QVERIFY(window.show());
    QTRY_VERIFY(window.hasCurves(1));
    const Spectrum::Lines &lines = window.canvas()->curves().first().lines;
    double meanSquare = 0.0;
    for (const double value : lines.values)
        meanSquare += value * lines.step;
    QVERIFY(std::fabs(meanSquare - 2.0) < 0.05);
    QVERIFY(showsText(window.panel, "mean of 9 segments"));
    const QString title = window.canvas()->axisTitle(QwtPlot::yLeft).text();
    QVERIFY2(title.contains(QString::fromUtf8("(m/s)²/Hz")), qPrintable(title));
    QCOMPARE(SpectrumCanvas::densityUnit("N"), QString::fromUtf8("N²/Hz"));
    QCOMPARE(SpectrumCanvas::densityUnit(""), QStringLiteral("1/Hz"));
}

void tst_QPlcSpectrum::valuesAreThoseBetweenTheCursors()
{
    SpectrumWindow window;
    window.take(1000);
    window.apply(R"({"signals":["force"]})");
    QVERIFY(window.show());
    QTRY_VERIFY(showsText(window.panel, "1000 values"));
    const SignalStore *store = window.plant->store();
    window.context.timeAxis()->setCursor(QPlcTimeAxis::B, store->time(store->firstRow() + 200));
    window.context.timeAxis()->setCursor(QPlcTimeAxis::A, store->time(store->firstRow() + 799));
    QTRY_VERIFY(showsText(window.panel, "600 values"));
}

void tst_QPlcSpectrum::longestPieceWithoutAGapIsShownAndSaid()
{
    SpectrumWindow window;
    window.take(200);
    window.plant->feed()->started();  // another phase
    window.now += 60 * SpectrumWindow::Second;
    window.take(400);
    window.apply(R"({"signals":["force"]})");
    QVERIFY(window.show());
    QTRY_VERIFY(showsText(window.panel, "400 values"));
    QVERIFY(showsText(window.panel, "the longest whole piece of"));
    QVERIFY(showsText(window.panel, "1 gap"));
}

void tst_QPlcSpectrum::tooFewValuesAreRefusedWithASentence()
{
    SpectrumWindow window;
    window.take(15);
    window.apply(R"({"signals":["force"]})");
    QVERIFY(window.show());
    QTRY_VERIFY(showsText(window.panel, "force has 15 evenly spaced values in"));
    QVERIFY(!window.canvas()->isVisibleTo(&window.panel));
    window.take(1);
    QTRY_VERIFY(window.hasCurves(1));
}

void tst_QPlcSpectrum::newValuesAreShownWhileTheWindowIsLive()
{
    SpectrumWindow window;
    window.take(100);
    window.apply(R"({"signals":["force"]})");
    QVERIFY(window.show());
    QTRY_VERIFY(showsText(window.panel, "100 values"));
    window.take(100);
    QTRY_VERIFY(showsText(window.panel, "200 values"));
}

void tst_QPlcSpectrum::spectrogramIsThatOfOneSignal()
{
    SpectrumWindow window;
    window.take(1000);
    window.apply(R"({"signals":["force","speed"],"show":"spectrogram"})");
    QVERIFY(window.show());
    QTRY_VERIFY(window.canvas()->isSpectrogram());
    QVERIFY(showsText(window.panel, "force from"));
    QVERIFY(*window.canvas()->densityAt(5.0, 5.0) > 100.0 * *window.canvas()->densityAt(5.0, 20.0));
    QVERIFY(!window.canvas()->densityAt(5.0, 60.0));
    QVERIFY(!window.canvas()->densityAt(-5.0, 5.0));
    window.trigger("next");
    QTRY_VERIFY(showsText(window.panel, "speed from"));
    QVERIFY(*window.canvas()->densityAt(5.0, 12.5) > 100.0 * *window.canvas()->densityAt(5.0, 5.0));
    window.trigger("amplitude");
    QTRY_VERIFY(window.hasCurves(2));
}

void tst_QPlcSpectrum::onlyEightSignalsAreShown()
{
    SpectrumWindow window;
    window.take(100);
    QStringList formulas;
    for (int i = 1; i < 10; ++i)
        formulas << QStringLiteral("= %1*force").arg(i);
    QVERIFY(window.panel.addSignals(formulas));
    QVERIFY(window.show());
    QTRY_VERIFY(window.hasCurves(8));
    QVERIFY(showsText(window.panel, "Only the first 8 signals are shown."));
}

void tst_QPlcSpectrum::cursorGoesToTheHighestLine()
{
    SpectrumWindow window;
    window.take(1000);
    window.apply(R"({"signals":["force"]})");
    QVERIFY(window.show());
    QTRY_VERIFY(window.hasCurves(1));
    window.trigger("highest");
    QVERIFY(std::fabs(*window.canvas()->cursorFrequency() - 5.0) < 1e-6);
    QVERIFY(showsText(window.panel, "3.000 N at 5.000 Hz"));
    window.trigger("lineUp");
    QVERIFY(std::fabs(*window.canvas()->cursorFrequency() - 5.1) < 1e-6);
    window.trigger("removeCursor");
    QVERIFY(!window.canvas()->cursorFrequency());
    QVERIFY(!showsText(window.panel, " N at "));
}

void tst_QPlcSpectrum::zoomedAxesStay()
{
    SpectrumWindow window;
    window.take(1000);
    window.apply(R"({"signals":["force"],"logFrequency":true})");
    QVERIFY(window.show());
    QTRY_VERIFY(window.hasCurves(1));
    const QwtInterval all = window.canvas()->axisInterval(QwtPlot::xBottom);
    window.trigger("zoomIn");
    const QwtInterval less = window.canvas()->axisInterval(QwtPlot::xBottom);
    QVERIFY(less.minValue() > all.minValue() && less.maxValue() < all.maxValue());
    window.take(100);
    QTRY_VERIFY(showsText(window.panel, "1100 values") || showsText(window.panel, "1080 values"));
    QCOMPARE(window.canvas()->axisInterval(QwtPlot::xBottom), less);
    window.trigger("all");
    QVERIFY(window.canvas()->axisInterval(QwtPlot::xBottom).maxValue() > less.maxValue());
}

void tst_QPlcSpectrum::settingsAreEdited()
{
    SpectrumWindow window;
    window.take(100);
    window.apply(R"({"signals":["force"]})");
    QSignalSpy edited(&window.panel, &QPlcSpectrum::settingsEdited);
    const std::unique_ptr<QWidget> editor(window.panel.createSettingsEditor());
    for (QComboBox *box : editor->findChildren<QComboBox *>()) {
        if (box->accessibleName() != QLatin1String("Show"))
            continue;
        box->setCurrentIndex(1);
        Q_EMIT box->activated(1);
    }
    QCOMPARE(edited.size(), 1);
    QCOMPARE(window.panel.view(), QPlcSpectrum::Density);
    QCOMPARE(window.panel.settings(), objectOf(R"({"signals":["force"],"show":"density"})"));
    window.panel.setView(QPlcSpectrum::Amplitude);
    QCOMPARE(window.panel.settings(), objectOf(R"({"signals":["force"]})"));
    QCOMPARE(edited.size(), 1);
}

void tst_QPlcSpectrum::formulasHaveSpectra()
{
    SpectrumWindow window;
    window.take(1000);
    window.apply(R"({"signals":["= 2*force"]})");
    QVERIFY(window.show());
    QTRY_VERIFY(window.hasCurves(1) && showsText(window.panel, "1000 values"));
    QVERIFY(std::fabs(window.height(0, 5.0) - 6.0) < 0.02);
}

/// With the frequencies that are seen; a spectrogram has a row for each piece of time.
void tst_QPlcSpectrum::whatIsShownIsCopiedAsATable()
{
    SpectrumWindow window;
    window.take(1000);
    window.apply(R"({"signals":["force","speed"]})");
    QVERIFY(window.show());
    QTRY_VERIFY(window.hasCurves(2));
    QStringList lines = window.copied();
    const Spectrum::Lines first = window.canvas()->curves().first().lines;
    QCOMPARE(lines.first(), QStringLiteral("frequency [Hz]\tforce [N]\tspeed [m/s]"));
    QCOMPARE(lines.size(), int(first.values.size()) + 1);
    const QStringList row = lines.at(1 + 50).split(QLatin1Char('\t'));
    QVERIFY(std::fabs(row.at(0).toDouble() - 5.0) < 1e-9);
    QCOMPARE(row.at(1).toDouble(), first.values.at(50));
    window.trigger("zoomIn");
    const QwtInterval seen = window.canvas()->axisInterval(QwtPlot::xBottom);
    lines = window.copied();
    QVERIFY(lines.size() > 2 && lines.size() < int(first.values.size()));
    QVERIFY(lines.at(1).section(QLatin1Char('\t'), 0, 0).toDouble() >= seen.minValue());
    QVERIFY(lines.last().section(QLatin1Char('\t'), 0, 0).toDouble() <= seen.maxValue());
    window.trigger("density");
    QTRY_VERIFY(!window.canvas()->curves().isEmpty() && window.canvas()->curves().first().isDensity);
    QCOMPARE(window.copied().first(), QString::fromUtf8("frequency [Hz]\tforce [N²/Hz]\tspeed [(m/s)²/Hz]"));
    window.trigger("spectrogram");
    QTRY_VERIFY(window.canvas()->isSpectrogram());
    lines = window.copied();
    QVERIFY2(lines.first().startsWith(QStringLiteral("UTC\ttime [s]\tforce at 0 Hz [")), qPrintable(lines.first()));
    QCOMPARE(lines.at(1).count(QLatin1Char('\t')), lines.first().count(QLatin1Char('\t')));
}

QTEST_MAIN(tst_QPlcSpectrum)
#include "tst_QPlcSpectrum.moc"
