// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalTable.h"
#include "signals/Fnv1a.h"

#include <QtCore/QFile>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

#include <algorithm>
#include <limits>

#include <time.h>

class tst_QPlcSignalTable : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void tableOfTheThesisIsRead();
    void everyKeyIsRead();
    void initialValueIsZeroByDefault();
    void safeValueIsSafeOrZeroOrTheLimitNearestToIt_data();
    void safeValueIsSafeOrZeroOrTheLimitNearestToIt();
    void writersAreReadInTheirOrder();
    void byteOrderMarkAndCarriageReturnsChangeNothing();
    void namesThatDifferInCaseAreTwoSignals();
    void iniIsReadBackAsAnEqualTable();
    void exampleTableHasTheSignalsOfTheThesisFirst();
    void fileThatCannotBeReadIsOneError();
    void largestTableIsReadInTime();
    void oneSignalTooManyIsAnError();
    void appendCompletesTheDefinition();
    void appendRefusesWhatATableCannotHold_data();
    void appendRefusesWhatATableCannotHold();
    void unknownNameIsAnsweredWithCloseOnes_data();
    void unknownNameIsAnsweredWithCloseOnes();
    void hashIsFnv1aOfWhatNodeAndMasterHaveToAgreeOn();
};

namespace {

// Without an error, or the table is empty.
QPlcSignalTable read(const QByteArray &text)
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(text, &errors, QStringLiteral("test.ini"));
    if (!errors.isEmpty())
        qWarning("%s", qPrintable(QPlcParseError::toString(errors)));
    return table;
}

QByteArray manySignals(int count)
{
    QByteArray text;
    for (int i = 0; i < count; ++i)
        text += "[signal_" + QByteArray::number(i) + "]\ntype = Real\n\n";
    return text;
}

void compareTables(const QPlcSignalTable &a, const QPlcSignalTable &b)
{
    QCOMPARE(a.size(), b.size());
    for (int i = 0; i < a.size(); ++i) {
        const QPlcSignalDefinition &x = a.at(QPlcSignalIndex(i));
        const QPlcSignalDefinition &y = b.at(QPlcSignalIndex(i));
        QCOMPARE(x.name, y.name);
        QCOMPARE(x.type, y.type);
        QCOMPARE(x.typeName, y.typeName);
        QCOMPARE(x.unit, y.unit);
        QCOMPARE(x.description, y.description);
        QCOMPARE(x.minimum, y.minimum);
        QCOMPARE(x.maximum, y.maximum);
        QCOMPARE(x.initial, y.initial);
        QCOMPARE(x.safe, y.safe);
        QCOMPARE(x.hold, y.hold);
        QCOMPARE(x.writers, y.writers);
        QCOMPARE(x.nanAllowed, y.nanAllowed);
        QCOMPARE(x.slope, y.slope);
        QCOMPARE(x.isVolatile, y.isVolatile);
    }
    QCOMPARE(a.hash(), b.hash());
}

}  // namespace

void tst_QPlcSignalTable::tableOfTheThesisIsRead()
{
    const QPlcSignalTable table
        = read(";NETWORK NODES\n\n[masterTime]\ntype = DateTime\n\n[masterJitter]\ntype = Real\n\n\n\n"
               ";CONTROL INPUTS\n\n[tetherSpeed]\ntype = Real\n\n"
               ";STATES\n\n[bodyPosition_earth]\ntype = RealTriple");
    QCOMPARE(table.size(), 4);
    QCOMPARE(table.at(0).name, QStringLiteral("masterTime"));
    QCOMPARE(table.at(0).type, QPlcSignalType(QPlcSignalType::DateTime));
    QCOMPARE(int(table.indexOf(QStringLiteral("tetherSpeed"))), 2);
    QCOMPARE(table.at(3).type, QPlcSignalType(QPlcSignalType::Real32, 3));
    QCOMPARE(table.at(3).typeName, QStringLiteral("RealTriple"));
    QCOMPARE(table.at(3).line, 18);
    QVERIFY(!table.contains(QStringLiteral("TetherSpeed")));
    QCOMPARE(int(table.indexOf(QStringLiteral("nonsense"))), int(QPlcInvalidSignalIndex));
}

void tst_QPlcSignalTable::everyKeyIsRead()
{
    const QPlcSignalTable table = read("[wind.speed_2]\nhold = 5 ; cycles\nslope = 2.5 per second\nvolatile = "
                                       "yes\nwriter = Mast\nnan = allowed\nsafe = "
                                       "1\ninitial = 0, 1, 2\nmax = 10\nmin = -1e1\n"
                                       "description = at the \"mast\"\nunit = m/s\ntype = Real64Triple\n");
    QCOMPARE(table.size(), 1);
    const QPlcSignalDefinition &signal = table.at(0);
    QCOMPARE(signal.name, QStringLiteral("wind.speed_2"));
    QCOMPARE(signal.unit, QStringLiteral("m/s"));
    QCOMPARE(signal.description, QStringLiteral("at the \"mast\""));
    QCOMPARE(signal.minimum, QPlcValue(-10.0));
    QCOMPARE(signal.maximum, QPlcValue(10.0));
    QCOMPARE(signal.initial, QPlcValue({0.0, 1.0, 2.0}));
    QCOMPARE(signal.safe, QPlcValue({1.0, 1.0, 1.0}));
    QCOMPARE(signal.hold, std::optional<int>(5));
    QCOMPARE(signal.writers, QStringList{"Mast"});
    QVERIFY(signal.nanAllowed);
    QCOMPARE(signal.slope, 2.5);
    QVERIFY(signal.isVolatile);
}

void tst_QPlcSignalTable::initialValueIsZeroByDefault()
{
    const QPlcSignalTable table = read("[a]\ntype = Real\n[b]\ntype = String(3)\n[c]\ntype = UInt16[40]\n");
    for (const QPlcSignalDefinition &signal : table) {
        QCOMPARE(signal.initial, QPlcValue(signal.type));
        QVERIFY(!signal.minimum.isValid() && !signal.maximum.isValid() && !signal.safe.isValid());
    }
}

void tst_QPlcSignalTable::safeValueIsSafeOrZeroOrTheLimitNearestToIt_data()
{
    QTest::addColumn<QByteArray>("lines");
    QTest::addColumn<QString>("safe");
    QTest::newRow("nothing said") << QByteArray("type = Real64\n") << "0";
    QTest::newRow("safe") << QByteArray("type = Real64\nsafe = 3\nmin = -5\nmax = 5\n") << "3";
    QTest::newRow("zero is allowed") << QByteArray("type = Real64\nmin = -5\nmax = 5\ninitial = 4\n") << "0";
    QTest::newRow("above zero") << QByteArray("type = Int32\nmin = 2\nmax = 5\ninitial = 4\n") << "2";
    QTest::newRow("below zero") << QByteArray("type = Real32\nmin = -7\nmax = -2.5\ninitial = -4\n") << "-2.5";
    QTest::newRow("at least") << QByteArray("type = Real64\nmin = 1\ninitial = 4\n") << "1";
    QTest::newRow("at most") << QByteArray("type = Real64\nmax = -1\ninitial = -4\n") << "-1";
    QTest::newRow("every element") << QByteArray("type = Real64Triple\nmin = 2\nmax = 5\ninitial = 4\n") << "2, 2, 2";
    QTest::newRow("truth") << QByteArray("type = Bool\ninitial = 1\n") << "0";
    QTest::newRow("text") << QByteArray("type = String\n") << "";
}

void tst_QPlcSignalTable::safeValueIsSafeOrZeroOrTheLimitNearestToIt()
{
    QFETCH(QByteArray, lines);
    QFETCH(QString, safe);
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni("[s]\n" + lines, &errors);
    QVERIFY2(errors.isEmpty(), qPrintable(QPlcParseError::toString(errors)));
    QCOMPARE(table.at(0).safeValue().toString(), safe);
    QVERIFY(table.at(0).safeValue().type() == table.at(0).type);
}

void tst_QPlcSignalTable::writersAreReadInTheirOrder()
{
    const QPlcSignalTable table
        = read("[a]\ntype = Real\nwriter = Autopilot B>  Autopilot A >C\n[b]\ntype = Int\nwriter=X\n"
               "[c]\ntype = Int\n");
    QCOMPARE(table.at(0).writers, (QStringList{"Autopilot B", "Autopilot A", "C"}));
    QCOMPARE(table.at(1).writers, QStringList{"X"});
    QVERIFY(table.at(2).writers.isEmpty());
}

void tst_QPlcSignalTable::byteOrderMarkAndCarriageReturnsChangeNothing()
{
    const QByteArray text = "; comment\n[a]\ntype = Real\n[b]\ntype = Int\nunit = \xC2\xB0\n";
    compareTables(read("\xEF\xBB\xBF" + QByteArray(text).replace('\n', "\r\n")), read(text));
}

void tst_QPlcSignalTable::namesThatDifferInCaseAreTwoSignals()
{
    const QPlcSignalTable table = read("[Wind]\ntype = Real\n[wind]\ntype = Real\n");
    QCOMPARE(int(table.indexOf(QStringLiteral("Wind"))), 0);
    QCOMPARE(int(table.indexOf(QStringLiteral("wind"))), 1);
}

void tst_QPlcSignalTable::iniIsReadBackAsAnEqualTable()
{
    const QPlcSignalTable table = read(
        "[a]\ntype = Bool\nsafe = true\n[b]\ntype = Real\nmin = -inf\nmax = 1e10\ninitial = -0\n"
        "[c]\ntype = String(20)\ninitial = \" ; \\\"x\\\"\\n\"\nsafe =\nunit = \xC2\xB0 ; degree\n"
        "[d]\ntype = DateTime\ninitial = 2026-01-31T12:00:00.000000001Z\n"
        "[e]\ntype = Real[3]\nunit = \"; m\"\ndescription = \"a\\nb\"\ninitial = nan, inf, 1\nhold = 7\nnan = allowed\n"
        "[f]\ntype = UInt64[2]\nmax = 18446744073709551615\ninitial = 18446744073709551615\n"
        "[g]\ntype = Real\nwriter = \"A ; 1 > B\"\nhold = 0\nslope = 0.1 per second\nvolatile = yes\n");
    QCOMPARE(table.size(), 7);
    compareTables(read(table.toIni()), table);
    QCOMPARE(QPlcSignalTable().toIni(), QByteArray());
    // A hold that was said stays: without it the profile of the plant decides.
    QCOMPARE(read("#x\n[a]\nhold=3\ntype=Bool\ninitial=false").toIni(), QByteArray("[a]\ntype = Bool\nhold = 3\n"));
}

void tst_QPlcSignalTable::exampleTableHasTheSignalsOfTheThesisFirst()
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table
        = QPlcSignalTable::fromIniFile(QStringLiteral(SIGNAL_TABLES "/airborne_wind_energy.ini"), &errors);
    QVERIFY2(errors.isEmpty(), qPrintable(QPlcParseError::toString(errors)));
    const char *const expected[][2] = {
        {"masterTime", "DateTime"},
        {"masterJitter", "Real"},
        {"masterWorkload", "Real"},
        {"modelWorkload", "Real"},
        {"bodyControlPitchSpeed", "Real"},
        {"bodyControlYawSpeed", "Real"},
        {"tetherSpeed", "Real"},
        {"bodyPosition_earth", "RealTriple"},
        {"bodyVelocity_earth", "RealTriple"},
        {"windVelocity_earth", "RealTriple"},
        {"bodyControlOrientation", "RealTriple"},
        {"bodyPositionOrientation", "RealTriple"},
        {"angleOfAttack", "Real"},
        {"dragCoefficient", "Real"},
        {"liftCoefficient", "Real"},
        {"aweCoefficient", "Real"},
        {"gravitationalForce_earth", "RealTriple"},
        {"aerodynamicForce_earth", "RealTriple"},
        {"tetherForce_earth", "RealTriple"},
        {"tetherLength", "Real"},
        {"power", "Real"},
        {"averagePower", "Real"},
        {"energy", "Real"},
        {"crashed", "Bool"},
        {"autopilotWorkload", "Real"},
        {"flightPhase", "Int8"},
        {"winchLoad", "Real"},
        {"winchState", "Int8"},
        {"winchSpeed", "Real"},
        {"winchPosition", "Real"},
        {"winchCurrent", "Real"},
        {"winchElectricalPower", "Real"},
    };
    QCOMPARE(table.size(), int(std::size(expected)));
    for (int i = 0; i < table.size(); ++i) {
        const QPlcSignalDefinition &signal = table.at(QPlcSignalIndex(i));
        QCOMPARE(signal.name, QString::fromLatin1(expected[i][0]));
        QCOMPARE(signal.typeName, QString::fromLatin1(expected[i][1]));
        QVERIFY2(!signal.description.isEmpty(), expected[i][0]);
        QCOMPARE(signal.unit.isEmpty(), !signal.type.isReal());
    }
    compareTables(read(table.toIni()), table);
}

void tst_QPlcSignalTable::fileThatCannotBeReadIsOneError()
{
    const QTemporaryDir directory;
    const QString missing = directory.filePath(QStringLiteral("missing.ini"));
    for (const QString &name : {missing, directory.path()}) {
        QVector<QPlcParseError> errors;
        QVERIFY(QPlcSignalTable::fromIniFile(name, &errors).isEmpty());
        QCOMPARE(errors.size(), 1);
        QCOMPARE(errors.first().file, name);
        QVERIFY2(errors.first().message.startsWith(QStringLiteral("cannot open: ")),
                 qPrintable(errors.first().message));
    }
    QVERIFY(QPlcSignalTable::fromIniFile(missing).isEmpty());
    QVector<QPlcParseError> errors;
    QVERIFY(QPlcSignalTable::fromIniFile(QString(), &errors).isEmpty());
    QCOMPARE(QPlcParseError::toString(errors),
             QStringLiteral("the name of the file is empty; give the path of a signal table"));
}

void tst_QPlcSignalTable::largestTableIsReadInTime()
{
    const QPlcSignalTable table = read(manySignals(QPlcSignalTable::MaximumSignals));
    QCOMPARE(table.size(), 65534);
    QCOMPARE(int(table.indexOf(QStringLiteral("signal_65533"))), 65533);
    const auto ownTime = [] {  // of this thread, however busy the computer is [ns]
        timespec time{};
        ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return qint64(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
    };
    const auto shortestOf = [&ownTime](int signalCount) {  // [ns], of three
        const QByteArray text = manySignals(signalCount);
        qint64 shortest = std::numeric_limits<qint64>::max();
        for (int i = 0; i < 3; ++i) {
            const qint64 begin = ownTime();
            (void)read(text);
            shortest = std::min(shortest, ownTime() - begin);
        }
        return shortest;
    };
    // Eight times the signals take about eight times as long; 64 if each is compared with all.
    const double ratio = double(shortestOf(16384)) / double(shortestOf(2048));
    QVERIFY2(ratio < 24.0, qPrintable(QString::number(ratio)));
}

void tst_QPlcSignalTable::oneSignalTooManyIsAnError()
{
    QVector<QPlcParseError> errors;
    QVERIFY(QPlcSignalTable::fromIni(manySignals(65540), &errors).isEmpty());
    QCOMPARE(errors.size(), 1);
    QCOMPARE(errors.first().toString(),
             QStringLiteral("196603:2: the signal 'signal_65534' is one too many; a table has at most 65534"));
    QPlcSignalTable full = read(manySignals(65534));
    QPlcSignalDefinition signal;
    signal.name = QStringLiteral("more");
    signal.type = QPlcSignalType::Int8;
    QString error;
    QVERIFY(!full.append(signal, &error));
    QCOMPARE(error, QStringLiteral("signal 'more': is one too many; a table has at most 65534"));
}

void tst_QPlcSignalTable::appendCompletesTheDefinition()
{
    QPlcSignalTable table;
    QPlcSignalDefinition signal;
    signal.name = QStringLiteral("force");
    signal.type = QPlcSignalType(QPlcSignalType::Real32, 3);
    signal.typeName = QStringLiteral("Int8");  // a wrong hint does not survive
    signal.minimum = -1;
    signal.maximum = 2.5;
    signal.safe = 1.0;
    QString error;
    QVERIFY2(table.append(signal, &error), qPrintable(error));
    QCOMPARE(error, QString());
    QCOMPARE(table.at(0).typeName, QStringLiteral("Real32[3]"));
    QCOMPARE(table.at(0).minimum, QPlcValue(-1.0f));
    QCOMPARE(table.at(0).maximum, QPlcValue(2.5f));
    QCOMPARE(table.at(0).initial, QPlcValue({0.0f, 0.0f, 0.0f}));
    QCOMPARE(table.at(0).safe, QPlcValue({1.0f, 1.0f, 1.0f}));
    compareTables(read(table.toIni()), table);
}

void tst_QPlcSignalTable::appendRefusesWhatATableCannotHold_data()
{
    QTest::addColumn<QPlcSignalDefinition>("signal");
    QTest::addColumn<QString>("reason");
    const auto row = [](const char *reason, auto change) {
        QPlcSignalDefinition signal;
        signal.name = QStringLiteral("a");
        signal.type = QPlcSignalType::Real32;
        change(signal);
        QTest::newRow(reason) << signal << QString::fromLatin1(reason);
    };
    using Signal = QPlcSignalDefinition;
    row("signal 'taken': there is one already", [](Signal &s) { s.name = QStringLiteral("taken"); });
    row("the signal has no name", [](Signal &s) { s.name.clear(); });
    row("'1a' is not a valid signal name", [](Signal &s) { s.name = QStringLiteral("1a"); });
    row("has 64 characters", [](Signal &s) { s.name = QString(64, QLatin1Char('x')); });
    row("the type is not valid", [](Signal &s) { s.type = QPlcSignalType(); });
    row("0x0a in 'm?s'", [](Signal &s) { s.unit = QStringLiteral("m\ns"); });
    row("control character 0x00", [](Signal &s) { s.description = QString(QChar(0)); });
    row("half a surrogate pair", [](Signal &s) { s.description = QString(QChar(0xDC00)); });
    row("its line in the table has 4112 bytes", [](Signal &s) { s.description = QString(4098, QLatin1Char('x')); });
    row("cannot be held for -1 cycles", [](Signal &s) { s.hold = -1; });
    row("the slope -2 is not a positive number", [](Signal &s) { s.slope = -2.0; });
    row("min 2 is greater than max 1", [](Signal &s) { s.minimum = 2, s.maximum = 1; });
    row("the limit kite is String(64)", [](Signal &s) { s.minimum = "kite"; });
    row("nan is not a limit", [](Signal &s) { s.maximum = std::numeric_limits<double>::quiet_NaN(); });
    row("the initial value '0' is outside", [](Signal &s) { s.minimum = 2; });
    row("the safe value '3' is outside of min and max; give 'safe =' a value of at most 2",
        [](Signal &s) { s.maximum = 2, s.safe = 3; });
    row("the safe value 'inf' is not finite", [](Signal &s) { s.safe = std::numeric_limits<float>::infinity(); });
    row("'kite' is a String(64); give a value of the type Real32", [](Signal &s) { s.initial = "kite"; });
    row("'1, 2' is a Int32[2]; give a value of the type Real32", [](Signal &s) { s.safe = QPlcValue({1, 2}); });
    row("String(64) cannot be limited by 'a'", [](Signal &s) {
        s.type = QPlcSignalType::String;
        s.minimum = "a";
    });
}

void tst_QPlcSignalTable::appendRefusesWhatATableCannotHold()
{
    QFETCH(QPlcSignalDefinition, signal);
    QFETCH(QString, reason);
    QPlcSignalTable table = read("[taken]\ntype = Real\n");
    QString error;
    QVERIFY(!table.append(signal, &error));
    QVERIFY2(error.contains(reason), qPrintable(error));
    QVERIFY(!table.append(signal));
    QCOMPARE(table.size(), 1);
}

void tst_QPlcSignalTable::unknownNameIsAnsweredWithCloseOnes_data()
{
    QTest::addColumn<QString>("answer");
    const auto row = [](const char *name, const char *answer) { QTest::newRow(name) << QString::fromLatin1(answer); };
    row("tetherSped", "unknown signal 'tetherSped'; did you mean 'tetherSpeed'?");
    row("TETHERSPEED", "unknown signal 'TETHERSPEED'; did you mean 'tetherSpeed'?");
    row("tether_speed", "unknown signal 'tether_speed'; did you mean 'tetherSpeed'?");
    row("tetherSepeed", "unknown signal 'tetherSepeed'; did you mean 'tetherSpeed'?");
    row("powre", "unknown signal 'powre'; did you mean 'power'?");
    row("tether", "unknown signal 'tether'; did you mean 'tetherSpeed', 'tetherLength' or 'tetherForce'?");
    row("kite", "unknown signal 'kite'; the signal table has none like it, add it there");
    row("", "unknown signal ''; the signal table has none like it, add it there");
}

void tst_QPlcSignalTable::unknownNameIsAnsweredWithCloseOnes()
{
    QFETCH(QString, answer);
    const QPlcSignalTable table
        = read("[tetherSpeed]\ntype = Real\n[tetherLength]\ntype = Real\n[tetherForce]\ntype = Real\n"
               "[tetherAngle]\ntype = Real\n[power]\ntype = Real\n");
    QCOMPARE(table.unknownSignalText(QString::fromLatin1(QTest::currentDataTag())), answer);
    QCOMPARE(table.closeNames(QStringLiteral("tether"), 1), QStringList{QStringLiteral("tetherSpeed")});
    QVERIFY(QPlcSignalTable().unknownSignalText(QStringLiteral("x")).contains(QStringLiteral("table is empty")));
    QVERIFY(table.closeNames(QString(100000, QLatin1Char('x'))).isEmpty());
}

void tst_QPlcSignalTable::hashIsFnv1aOfWhatNodeAndMasterHaveToAgreeOn()
{
    QCOMPARE(qplc::fnv1a64("", 0), Q_UINT64_C(0xcbf29ce484222325));
    QCOMPARE(qplc::fnv1a64(QByteArray("a")), Q_UINT64_C(0xaf63dc4c8601ec8c));
    QCOMPARE(qplc::fnv1a64(QByteArray("foobar")), Q_UINT64_C(0x85944171f73967e8));
    QCOMPARE(qplc::fnv1a64(QByteArray("bar"), qplc::fnv1a64(QByteArray("foo"))), Q_UINT64_C(0x85944171f73967e8));

    const quint64 hash = read("[a]\ntype = RealTriple\nunit = m\n[b]\ntype = Bool\n").hash();
    QCOMPARE(hash, qplc::fnv1a64(QByteArray("a:Real32[3]:m\n::::::\nb:Int8:\n::::::\n")));
    QCOMPARE(read("[a]\nunit = m\ntype = Real[3]\ninitial = 1\n[b]\ntype = Int8\ndescription = d\n").hash(), hash);
    QVERIFY(read("[a]\ntype = RealTriple\nunit = m\nmin = -1\n[b]\ntype = Bool\n").hash() != hash);
    QVERIFY(read("[a]\ntype = RealTriple\nunit = m\n[b]\ntype = Bool\nsafe = 1\n").hash() != hash);
    QVERIFY(read("[a]\ntype = RealTriple\nunit = km\n[b]\ntype = Bool\n").hash() != hash);
    QVERIFY(read("[b]\ntype = Bool\n[a]\ntype = RealTriple\nunit = m\n").hash() != hash);
    QCOMPARE(QPlcSignalTable().hash(), qplc::fnv1a64Start);
}

QTEST_APPLESS_MAIN(tst_QPlcSignalTable)
#include "tst_QPlcSignalTable.moc"
