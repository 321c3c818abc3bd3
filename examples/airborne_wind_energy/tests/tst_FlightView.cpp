// SPDX-License-Identifier: Apache-2.0
#include "ExampleOptions.h"
#include "FlightView.h"

#include <QPlcSignalTable.h>

#include <QtCore/QRegularExpression>
#include <QtTest/QtTest>

#include <algorithm>
#include <cmath>

using awe::FlightMoment;
using awe::FlightPhase;
using awe::FlightView;

namespace {

constexpr double radiansPerDegree = 3.14159265358979323846 / 180.0;

/// A moment in a wind to the east. \param azimuth from downwind, > 0 to the left [deg] \param
/// elevation [deg]
FlightMoment momentAt(double time, double azimuth, double elevation)
{
    const double a = azimuth * radiansPerDegree, e = elevation * radiansPerDegree;
    FlightMoment moment;
    moment.time = time;
    moment.phase = FlightPhase::ReelOut;
    moment.position = 150.0 * Eigen::Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
    moment.windVelocity = Eigen::Vector3d(6.0, 0.0, 0.0);
    moment.tetherLength = 150.0;
    moment.tetherForce = 1234.0;
    moment.power = 2000.0;
    moment.energy = 30000.0;
    return moment;
}

QStringList withoutCodes(const QStringList &lines)
{
    QStringList plain;
    for (const QString &line : lines)
        plain << QString(line).remove(QRegularExpression(QStringLiteral("\033\\[[0-9;]*m")));
    return plain;
}

QString trimmedEnd(QString line)
{
    while (line.endsWith(QLatin1Char(' ')))
        line.chop(1);
    return line;
}

/// Characters of Braille dots.
int dotsOf(const QStringList &lines)
{
    const QString text = lines.join(QString());
    return int(std::count_if(text.begin(), text.end(), [](QChar character) {
        return character.unicode() > 0x2800 && character.unicode() <= 0x28ff;
    }));
}

QPoint placeOf(const QStringList &lines, const QString &mark)
{
    for (int row = 0; row < lines.size(); ++row) {
        if (lines.at(row).contains(mark))
            return QPoint(lines.at(row).indexOf(mark), row);
    }
    return QPoint(-1, -1);
}

}  // namespace

/// The picture of a flight, without a terminal.
class tst_FlightView : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void theTableNamesPhasesAsTheAutopilotDoes();
    void pictureEqualsTheReferencePicture();
    void kiteIsDrawnAtItsAzimuthAndElevation_data();
    void kiteIsDrawnAtItsAzimuthAndElevation();
    void downwindFollowsTheWindSlowly();
    void trailEndsAfterItsTime();
    void trailFades();
    void pointsThatFollowEachOtherAreALine();
    void plotShowsThePowerOfTheLastMinute();
    void plainViewContainsNoEscapeCodes();
    void earlierTimeStartsANewTrail();
    void noFigureLosesItsValueFrom60ColumnsOn();
    void fitsEveryTerminal_data();
    void fitsEveryTerminal();
    void everyColouredLineEndsPlain();
    void crashIsShown();
    void barStaysInItsFrame_data();
    void barStaysInItsFrame();
    void progressLineIsBounded();
};

void tst_FlightView::pictureEqualsTheReferencePicture()
{
    FlightView view(60.0);
    view.add(momentAt(14.0, 30.0, 30.0));
    view.add(momentAt(15.0, 0.0, 30.0));
    const char *const golden[] = {
        "   15.0 / 60 s   ReelOut",
        "[deg]",
        "  90 ┤",
        "     │",
        "     │",
        "  60 ┤",
        "     │",
        "  30 ┤             ⢀            ◆",
        "     │",
        "     │",
        "   0 ┤",
        "     └┴────────────┴────────────┴────────────┴────────────┴",
        "   60 deg       30 deg      downwind      30 deg      60 deg",
        " tether    150.0 m   100 ███████████████░░░░░░░░░░░░░░ 200 m",
        " power      2000 W   mean       2000 W   energy     30.0 kJ",
        " altitude   75.0 m   force      1234 N   wind        6.0 m/s",
    };
    const QStringList lines = withoutCodes(view.draw(60, 16));
    QCOMPARE(lines.size(), int(std::size(golden)));
    for (int i = 0; i < lines.size(); ++i)
        QCOMPARE(trimmedEnd(lines.at(i)), QString::fromUtf8(golden[i]));
}

void tst_FlightView::kiteIsDrawnAtItsAzimuthAndElevation_data()
{
    QTest::addColumn<double>("azimuth");
    QTest::addColumn<double>("elevation");
    QTest::addColumn<QPoint>("place");
    // 100 columns, 6 for the axis: 93 columns for 120 deg; 37 rows, 23 of them for 90 deg
    QTest::newRow("downwind on the ground") << 0.0 << 0.0 << QPoint(52, 24);
    QTest::newRow("zenith") << 0.0 << 90.0 << QPoint(52, 2);
    QTest::newRow("left") << 60.0 << 0.0 << QPoint(6, 24);
    QTest::newRow("right") << -60.0 << 0.0 << QPoint(98, 24);
    QTest::newRow("left beyond the window") << 100.0 << 45.0 << QPoint(6, 13);
    QTest::newRow("right beyond the window") << -179.0 << 45.0 << QPoint(98, 13);
    QTest::newRow("under the ground") << 0.0 << -5.0 << QPoint(52, 24);
}

void tst_FlightView::kiteIsDrawnAtItsAzimuthAndElevation()
{
    QFETCH(double, azimuth);
    QFETCH(double, elevation);
    QFETCH(QPoint, place);
    FlightView view(0.0);
    view.add(momentAt(0.0, azimuth, elevation));
    QCOMPARE(placeOf(withoutCodes(view.draw(100, 37)), QStringLiteral("◆")), place);
}

void tst_FlightView::downwindFollowsTheWindSlowly()
{
    FlightView view(0.0);
    FlightMoment moment = momentAt(0.0, 0.0, 30.0);
    view.add(moment);
    const int downwind = placeOf(withoutCodes(view.draw(100, 37)), QStringLiteral("◆")).x();
    moment.windVelocity = Eigen::Vector3d(6.0 * std::cos(0.5), 6.0 * std::sin(0.5),
                                          0.0);  // turns to the left: the kite is to its right
    moment.time = 0.01;
    view.add(moment);
    QCOMPARE(placeOf(withoutCodes(view.draw(100, 37)), QStringLiteral("◆")).x(), downwind);
    moment.time = 200.0;
    view.add(moment);
    QVERIFY(placeOf(withoutCodes(view.draw(100, 37)), QStringLiteral("◆")).x() > downwind + 20);
}

void tst_FlightView::trailEndsAfterItsTime()
{
    FlightView view(0.0);
    view.add(momentAt(0.0, 30.0, 30.0));
    view.add(momentAt(20.0, 0.0, 30.0));
    QCOMPARE(dotsOf(view.draw(80, 16)), 1);  // the kite hides its own
    view.add(momentAt(20.01, 0.0, 30.0));
    QCOMPARE(dotsOf(view.draw(80, 16)), 0);
}

void tst_FlightView::trailFades()
{
    FlightView view(0.0);
    view.add(momentAt(0.0, 40.0, 30.0));
    view.add(momentAt(10.0, 20.0, 30.0));
    view.add(momentAt(18.0, -20.0, 30.0));
    view.add(momentAt(19.0, -40.0, 30.0));
    const QStringList lines = view.draw(80, 16);
    const int row = placeOf(withoutCodes(lines), QStringLiteral("◆")).y();
    const QString line = lines.at(row);
    QStringList colours;
    QRegularExpressionMatchIterator matches
        = QRegularExpression(QStringLiteral("\033\\[([0-9;]*)m([\u2801-\u28ff◆])")).globalMatch(line);
    while (matches.hasNext())
        colours << matches.next().captured(1);
    QCOMPARE(colours.size(), 4);
    QCOMPARE(colours.removeDuplicates(), 0);
}

void tst_FlightView::pointsThatFollowEachOtherAreALine()
{
    FlightView line(0.0);
    FlightView points(0.0);
    line.add(momentAt(0.0, 40.0, 30.0));
    line.add(momentAt(0.5, -40.0, 30.0));
    points.add(momentAt(0.0, 40.0, 30.0));
    points.add(momentAt(0.6, -40.0, 30.0));  // nothing was heard in between: nothing is known
    QVERIFY(dotsOf(line.draw(80, 16)) > 40);
    QCOMPARE(dotsOf(points.draw(80, 16)), 1);
}

void tst_FlightView::plotShowsThePowerOfTheLastMinute()
{
    FlightView view(0.0);
    for (int i = 0; i <= 700; ++i) {
        FlightMoment moment = momentAt(0.1 * i, 0.0, 30.0);
        moment.power = i < 400 ? -1500.0 : 3200.0;
        view.add(moment);
    }
    const QStringList lines = withoutCodes(view.draw(80, 24));
    const int label = placeOf(lines, QStringLiteral("power [kW], last 60 s")).y();
    QVERIFY(label > 6);
    QVERIFY(lines.at(label - 6).startsWith(QStringLiteral("   5 ┤")));
    QVERIFY(lines.at(label - 1).startsWith(QStringLiteral("  -2 ┤")));
    // Half of the minute it was below zero, then above: to the left below, to the right above.
    const auto dotsIn
        = [&lines](int row, int first, int last) { return dotsOf({lines.at(row).mid(first, last - first)}); };
    QCOMPARE(dotsIn(label - 1, 6, 40) + dotsIn(label - 2, 6, 40), 34);
    QCOMPARE(dotsIn(label - 1, 46, 80) + dotsIn(label - 2, 46, 80), 0);
    QVERIFY(dotsIn(label - 5, 46, 80) >= 30);
    QVERIFY(!withoutCodes(view.draw(80, 21)).join(QString()).contains(QStringLiteral("power [kW]")));  // no room
}

void tst_FlightView::plainViewContainsNoEscapeCodes()
{
    FlightView view(60.0, false);
    view.add(momentAt(1.0, -60.0, 30.0));
    QVERIFY(!view.draw(80, 24).join(QString()).contains(QLatin1Char('\033')));
    FlightView coloured(60.0);
    coloured.add(momentAt(1.0, -60.0, 30.0));
    QCOMPARE(withoutCodes(coloured.draw(80, 24)), view.draw(80, 24));
}

void tst_FlightView::earlierTimeStartsANewTrail()
{
    FlightView view(0.0);
    view.add(momentAt(10.0, 30.0, 30.0));
    view.add(momentAt(0.0, 0.0, 30.0));
    const QStringList lines = view.draw(80, 16);
    QCOMPARE(dotsOf(lines), 0);
    QCOMPARE(withoutCodes(lines).join(QString()).count(QStringLiteral("◆")), 1);
}

void tst_FlightView::fitsEveryTerminal_data()
{
    QTest::addColumn<int>("columns");
    QTest::addColumn<int>("rows");
    for (const QPoint size : {QPoint(80, 24), QPoint(300, 100), QPoint(40, 12), QPoint(20, 5), QPoint(7, 30),
                              QPoint(6, 30), QPoint(1, 1), QPoint(0, 0), QPoint(-1, -1)})
        QTest::addRow("%d x %d", size.x(), size.y()) << size.x() << size.y();
}

void tst_FlightView::fitsEveryTerminal()
{
    QFETCH(int, columns);
    QFETCH(int, rows);
    FlightView view(600.0);
    QVERIFY(view.draw(columns, rows).size() <= qMax(0, rows));  // before the first moment
    for (int i = 0; i < 200; ++i)
        view.add(momentAt(0.1 * i, 5.0 * i, 3.0 * i));
    const QStringList lines = withoutCodes(view.draw(columns, rows));
    QVERIFY(lines.size() <= qMax(0, rows));
    for (const QString &line : lines)
        QVERIFY(line.size() <= columns);
}

void tst_FlightView::noFigureLosesItsValueFrom60ColumnsOn()
{
    FlightView view(60.0);
    view.add(momentAt(15.0, 0.0, 30.0));
    for (int columns = 60; columns <= 100; ++columns) {
        const QString text = withoutCodes(view.draw(columns, 24)).join(QLatin1Char('\n')).simplified();
        for (const char *figure : {"tether 150.0 m", "power 2000 W", "mean 2000 W", "energy 30.0 kJ", "altitude 75.0 m",
                                   "force 1234 N", "wind 6.0 m/s", " 200 m"})
            QVERIFY2(text.contains(QLatin1String(figure)), qPrintable(text));
    }
}

void tst_FlightView::everyColouredLineEndsPlain()
{
    FlightView view(60.0);
    view.add(momentAt(1.0, -60.0, 30.0));
    const QStringList lines = view.draw(80, 24);
    for (const QString &line : lines) {
        const int last = line.lastIndexOf(QLatin1Char('\033'));
        QVERIFY(last < 0 || line.midRef(last).startsWith(QLatin1String("\033[0m")));
    }
}

void tst_FlightView::crashIsShown()
{
    FlightView view(60.0);
    FlightMoment moment = momentAt(1.0, 0.0, 0.0);
    view.add(moment);
    QVERIFY(!view.draw(80, 24).constFirst().contains(QLatin1String("CRASHED")));
    moment.crashed = true;
    view.add(moment);
    QVERIFY(view.draw(80, 24).constFirst().contains(QLatin1String("CRASHED")));
}

void tst_FlightView::barStaysInItsFrame_data()
{
    QTest::addColumn<double>("length");
    QTest::addColumn<int>("filled");
    QTest::newRow("short") << 10.0 << 0;
    QTest::newRow("100 m") << 100.0 << 0;
    QTest::newRow("150 m") << 150.0 << 15;
    QTest::newRow("200 m") << 200.0 << 30;
    QTest::newRow("long") << 1e6 << 30;
}

void tst_FlightView::barStaysInItsFrame()
{
    QFETCH(double, length);
    QFETCH(int, filled);
    FlightMoment moment = momentAt(1.0, 0.0, 30.0);
    moment.tetherLength = length;
    FlightView view(60.0);
    view.add(moment);
    const QString text = withoutCodes(view.draw(80, 24)).join(QString());
    QCOMPARE(text.count(QStringLiteral("█")), filled);
    QCOMPARE(text.count(QStringLiteral("░")), 30 - filled);
}

void tst_FlightView::progressLineIsBounded()
{
    FlightMoment moment = momentAt(123.4, 0.0, 30.0);
    QCOMPARE(awe::progressLine(moment, 600.0),
             QStringLiteral("  123.4 / 600 s  ReelOut   75.0 m high  150.0 m tether    2000 W     30.0 kJ"));
    QCOMPARE(awe::progressLine(moment, 0.0),
             QStringLiteral("  123.4 s  ReelOut   75.0 m high  150.0 m tether    2000 W     30.0 kJ"));
    moment.time = 86400.0;
    moment.energy = 99999.9e3;
    QVERIFY(awe::progressLine(moment, 86400.0).size() < 80);
}

void tst_FlightView::theTableNamesPhasesAsTheAutopilotDoes()
{
    const QPlcSignalTable table = QPlcSignalTable::fromIniFile(awe::builtInSignals());
    QVERIFY(table.contains(QStringLiteral("flightPhase")));
    const QPlcValueNames names = table.at(table.indexOf(QStringLiteral("flightPhase"))).valueNames;
    QCOMPARE(names.size(), awe::flightPhaseCount);
    for (int i = 0; i < awe::flightPhaseCount; ++i)
        QCOMPARE(names.nameOf(i), QString::fromLatin1(awe::flightPhaseName(FlightPhase(i))));
}

QTEST_APPLESS_MAIN(tst_FlightView)
#include "tst_FlightView.moc"
