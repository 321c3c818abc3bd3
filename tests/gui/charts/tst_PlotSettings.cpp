// SPDX-License-Identifier: Apache-2.0
#include "gui/charts/PlotSettings.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtTest/QtTest>

using namespace qplc;

namespace {

QJsonObject parsed(const QByteArray &text)
{
    QJsonParseError error;
    const QJsonObject json = QJsonDocument::fromJson(text, &error).object();
    if (error.error != QJsonParseError::NoError)
        qFatal("%s", qPrintable(error.errorString()));
    return json;
}

}  // namespace

class tst_PlotSettings : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void writtenSettingsAreReadBackUnchanged_data();
    void writtenSettingsAreReadBackUnchanged();
    void defaultsAreNotWritten();
    void invalidSettingsGetTheirDefaults();
    void limitsAreShownByDefaultForASingleLine();
    void aRangeIsFixedWithBothEndsInOrder();
    void aCurveIsNamedByWhatItShows();
};

void tst_PlotSettings::writtenSettingsAreReadBackUnchanged_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::newRow("nothing") << QByteArray("{}");
    QTest::newRow("a curve") << QByteArray(R"({"curves":[{"signal":"kite.elevation"}]})");
    QTest::newRow("a formula") << QByteArray(R"({"curves":[{"signal":"= derivative(tetherForce) / 2"}]})");
    QTest::newRow("all of a curve") << QByteArray(
        R"({"axes":{"N":{"minimum":1}},"curves":[{"axis":"right","color":"#d55e00","gain":0.5,)"
        R"("offset":-2,"signal":"a","visible":false},{"axis":"left","signal":"b"}]})");
    QTest::newRow("what nobody knows of a curve") << QByteArray(R"({"curves":[{"signal":"a","width":3}]})");
    QTest::newRow("all of the plot") << QByteArray(
        R"({"grid":false,"labels":"seconds","left":{"lines":[60,75.5],"maximum":90,"minimum":0},)"
        R"("legend":false,"limits":true,)"
        R"("right":{"minimum":-1.5},"span":10,"statistics":false,"time":"own"})");
}

void tst_PlotSettings::writtenSettingsAreReadBackUnchanged()
{
    QFETCH(QByteArray, text);
    const QJsonObject json = parsed(text);
    QCOMPARE(PlotSettings::fromJson(json).toJson(), json);
    QCOMPARE(PlotSettings::emptyJson().take(json), QJsonObject());  // each key is known
}

void tst_PlotSettings::defaultsAreNotWritten()
{
    const QJsonObject json
        = parsed(R"({"grid":true,"curves":[],"span":30,"left":{},"labels":"clock","time":"linked"})");
    QCOMPARE(PlotSettings::fromJson(json).toJson(), QJsonObject());
}

void tst_PlotSettings::invalidSettingsGetTheirDefaults()
{
    const PlotSettings settings = PlotSettings::fromJson(
        parsed(R"({"curves":[7,{"signal":3,"gain":"x","color":"no"}],"left":5,"span":-4,"grid":"x"})"));
    QCOMPARE(settings.curves.size(), 2);
    QCOMPARE(settings.curves[1].signal, QString());
    QCOMPARE(settings.curves[1].gain, 1.0);
    QVERIFY(!settings.curves[1].color.isValid());
    QVERIFY(!settings.left.minimum);
    QVERIFY(settings.span > 0.0);
    QVERIFY(settings.hasGrid);
}

void tst_PlotSettings::limitsAreShownByDefaultForASingleLine()
{
    const auto shows
        = [](const char *json) { return PlotSettings::fromJson(QJsonDocument::fromJson(json).object()).showsLimits(); };
    QVERIFY(!shows(R"({})"));
    QVERIFY(shows(R"({"curves":[{"signal":"a"}]})"));
    QVERIFY(shows(R"({"curves":[{"signal":"a"},{"signal":"b","bands":true}]})"));
    QVERIFY(!shows(R"({"curves":[{"signal":"a"},{"signal":"b"}]})"));
    QVERIFY(shows(R"({"curves":[{"signal":"a"},{"signal":"b"}],"limits":true})"));
    QVERIFY(!shows(R"({"curves":[{"signal":"a"}],"limits":false})"));
}

void tst_PlotSettings::aRangeIsFixedWithBothEndsInOrder()
{
    QVERIFY((PlotRangeSettings{0.0, 1.0}).isFixed());
    QVERIFY(!(PlotRangeSettings{1.0, 0.0}).isFixed());
    QVERIFY(!(PlotRangeSettings{0.0, std::nullopt}).isFixed());
    QVERIFY(!PlotRangeSettings().isFixed());
}

void tst_PlotSettings::aCurveIsNamedByWhatItShows()
{
    PlotCurveSettings curve;
    curve.signal = QStringLiteral("force");
    QCOMPARE(curve.text(), QStringLiteral("force"));
    curve.gain = 0.001;
    curve.offset = 5.0;
    QCOMPARE(curve.text(), QStringLiteral("0.001*force+5"));
    curve.gain = 1.0;
    curve.offset = -2.0;
    QCOMPARE(curve.text(), QStringLiteral("force-2"));
}

QTEST_APPLESS_MAIN(tst_PlotSettings)
#include "tst_PlotSettings.moc"
