// SPDX-License-Identifier: Apache-2.0
// An FMU as a node of a master.
#include "../common/Waiting.h"
#include "NodeFixtures.h"
#include "ThreadCosts.h"

#include <QtPlcModels>

#include <QtCore/QTemporaryDir>

#include <cmath>

class tst_FmuNode : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void outputsFollowTheInputs_data();
    void outputsFollowTheInputs();
    void resultsAreEqualInEveryProcess_data() { addVersions(); }
    void resultsAreEqualInEveryProcess();
    void theStepDividesThePeriod_data() { addVersions(); }
    void theStepDividesThePeriod();
    void aStepThatDoesNotDivideThePeriodIsAFault();
    void arraysAreWiredWholeAndByElement_data() { addVersions(); }
    void arraysAreWiredWholeAndByElement();
    void withoutWiresNamesDecide_data() { addVersions(); }
    void withoutWiresNamesDecide();
    void withoutAnySignalTheRegistrationFails();
    void everyTypePassesUnchanged();
    void negativeZeroPassesUnchanged();
    void enumerationsThatDoNotFitAreAFault();
    void typesThatDoNotFitAreRefused();
    void everyPhaseBeginsAtTheStartValues_data() { addVersions(); }
    void everyPhaseBeginsAtTheStartValues();
    void anFmuThatDiscardsOrEndsStopsThePlant_data();
    void anFmuThatDiscardsOrEndsStopsThePlant();
    void anErrorOfTheFmuIsAFaultOfTheNode_data();
    void anErrorOfTheFmuIsAFaultOfTheNode();
    void nanOfTheFmuIsNotTaken_data() { addVersions(); }
    void nanOfTheFmuIsNotTaken();
    void whatTheFmuReportsIsLoggedOutsideOfTheCycle();
    void cyclesAllocateNothing_data() { addVersions(); }
    void cyclesAllocateNothing();
    void wrongConfigurationsAreRefusedWithTheirPlace_data();
    void wrongConfigurationsAreRefusedWithTheirPlace();
    void allErrorsOfAConfigurationAreToldAtOnce();

private:
    static void addVersions()
    {
        QTest::addColumn<QString>("file");
        QTest::newRow("FMI 2") << "plant2";
        QTest::newRow("FMI 3") << "plant3";
    }

    QTemporaryDir m_temporary;
};

namespace {

QByteArray configuration(const QString &file, const QByteArray &more)
{
    return "[node]\nname = Model\n[fmu]\nfile = " QTPLC_TEST_FMUS "/" + file.toUtf8() + ".fmu\n" + more;
}

const QByteArray wires = "[fmu.read]\nsum = x\n[fmu.write]\nu = setpoint\n";

/// The table of the other tests, with signals for what an FMU has.
QPlcSignalTable fmuTable(const QByteArray &more = QByteArray())
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(testTable().toIni() + more, &errors);
    Q_ASSERT_X(errors.isEmpty(), "fmuTable", qPrintable(QPlcParseError::toString(errors)));
    return table;
}

QString errorsOf(const QPlcFmuNode &node)
{
    return QPlcParseError::toString(node.configurationErrors());
}

/// Runs a phase of \a cycles cycles in lockstep.
bool run(TestMaster &master, quint64 cycles)
{
    master.setCycleLimit(cycles);
    return master.startRealTime() && master.waitForState(QPlcMasterNode::Off);
}

}  // namespace

void tst_FmuNode::initTestCase()
{
    qputenv("TMPDIR", QFile::encodeName(m_temporary.path()));
}

void tst_FmuNode::outputsFollowTheInputs_data()
{
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("kind");
    for (const char *file : {"plant2", "plant3"}) {
        for (const char *kind : {"local", "tcp"})
            QTest::addRow("%s %s", file, kind) << file << kind;
    }
}

void tst_FmuNode::outputsFollowTheInputs()
{
    QFETCH(QString, file);
    QFETCH(QString, kind);
    TestMaster master;
    QVERIFY(master.listen());
    master.setInterval(std::chrono::milliseconds(10));
    QPlcFmuNode node;
    QVERIFY2(node.configure(configuration(file,
                                          "[fmu.start]\nx0 = 1\n[fmu.read]\nsum = x * 2 + 0.5\necho = u\n"
                                          "[fmu.write]\nu = setpoint * 0.5 - 1\n"),
                            "model.ini"),
             qPrintable(errorsOf(node)));
    QCOMPARE(node.name(), QString("Model"));
    QCOMPARE(node.modelName(), QString("Plant"));
    QVERIFY(master.admit(node, kind));
    QVERIFY(master.setSignalValue("setpoint", 6.0));
    QVERIFY(run(master, 101));
    // In cycle 100 the outputs of 100 steps are there.
    QVERIFY(qAbs(master.signalValue("sum").toReal() - ((1.0 + 101 * 0.01 * 2.0) * 2.0 + 0.5)) < 0.05);
    QCOMPARE(master.signalValue("echo").toReal(), 2.0);
    node.disconnectFromMaster();
}

void tst_FmuNode::resultsAreEqualInEveryProcess()
{
    QFETCH(QString, file);
    QVector<double> results;
    for (const char *kind : {"local", "udp", "tcp"}) {
        TestMaster master;
        QVERIFY(master.listen());
        QPlcFmuNode node;
        QVERIFY(node.configure(configuration(file, wires), "model.ini"));
        QVERIFY(master.admit(node, kind));
        QVERIFY(master.setSignalValue("setpoint", 0.7));
        QVERIFY(run(master, 50));
        results << master.signalValue("sum").toReal();
        node.disconnectFromMaster();
    }
    QVERIFY(results.first() > 0.0);
    QCOMPARE(results.at(1), results.at(0));
    QCOMPARE(results.at(2), results.at(0));
}

void tst_FmuNode::theStepDividesThePeriod()
{
    QFETCH(QString, file);
    TestMaster master;
    master.setInterval(std::chrono::milliseconds(10));
    QPlcFmuNode node;
    QVERIFY(
        node.configure(configuration(file, "step = 2 ms\n[fmu.read]\nsum = time\n[fmu.write]\nu = setpoint\n"), "a"));
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(run(master, 5));
    QVERIFY(qAbs(master.signalValue("sum").toReal() - 0.05) < 0.011);
    node.disconnectFromMaster();
}

void tst_FmuNode::aStepThatDoesNotDivideThePeriodIsAFault()
{
    TestMaster master;
    master.setInterval(std::chrono::milliseconds(10));
    QPlcFmuNode node;
    QVERIFY(node.configure(configuration("plant2", "step = 3 ms\n" + wires), "a"));
    QVERIFY(master.addLocalNode(&node));
    const LogCapture log;
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Fault);
    QTRY_VERIFY(!log.matching("the step of the FMU, 3 ms, does not divide the period of the master, 10 ms").isEmpty());
    node.disconnectFromMaster();
}

void tst_FmuNode::arraysAreWiredWholeAndByElement()
{
    QFETCH(QString, file);
    TestMaster master;
    QPlcFmuNode node;
    // "r[2]" is a variable of FMI 2, and the last element in FMI 3.
    QVERIFY2(node.configure(configuration(file, "[fmu.start]\nx0 = 2\n[fmu.read]\nvector = r\nsum = r[2]\n"), "a"),
             qPrintable(errorsOf(node)));
    QCOMPARE(node.wires().size(), 4);
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(run(master, 2));
    QCOMPARE(master.signalValue("vector").toRealTriple(), (std::array<double, 3>{2.0, 4.0, 6.0}));
    QCOMPARE(master.signalValue("sum").toReal(), file == "plant2" ? 4.0 : 6.0);
    node.disconnectFromMaster();
}

void tst_FmuNode::withoutWiresNamesDecide()
{
    QFETCH(QString, file);
    TestMaster master(QPlcClock::lockstep(),
                      fmuTable("[u]\ntype = Real64\ninitial = 1\n[r]\ntype = Real64[3]\n[mode]\ntype = Int8\n"));
    QPlcFmuNode node;
    QVERIFY2(node.configureFromFile(QStringLiteral(QTPLC_TEST_FMUS "/%1.fmu").arg(file)), qPrintable(errorsOf(node)));
    QCOMPARE(node.name(), QString("Plant"));
    QVERIFY(node.wires().isEmpty());
    for (int i = 0; i < 2; ++i) {  // each registration
        QVERIFY(master.addLocalNode(&node));
        QCOMPARE(node.wires().size(), 5);
        QVERIFY(run(master, 10));
        QVERIFY(master.signalValue("r").toReal(2) > 0.0);
        node.disconnectFromMaster();
    }
}

void tst_FmuNode::withoutAnySignalTheRegistrationFails()
{
    TestMaster master;
    QPlcFmuNode node;
    QVERIFY(node.configureFromFile(QTPLC_TEST_FMUS "/plant2.fmu"));
    const LogCapture log;
    QVERIFY(!master.addLocalNode(&node));
    const QString text = master.errorString() + node.errorString() + log.all().join(' ');
    QVERIFY2(text.contains("no input or output of the FMU is named as a signal"), qPrintable(text));
}

void tst_FmuNode::everyTypePassesUnchanged()
{
    const QStringList kinds{"Float32", "Float64", "Int8",   "UInt8", "Int16",
                            "UInt16",  "Int32",   "UInt32", "Int64", "UInt64"};
    const QStringList values{"1.5",
                             "-2.25e300",
                             "-128",
                             "255",
                             "-32768",
                             "65535",
                             "-2147483648",
                             "4294967295",
                             "-9223372036854775808",
                             "18446744073709551615"};
    QByteArray table;
    const auto add = [&](const QString &name, const QString &type, const QString &initial) {
        table += QStringLiteral("[%1]\ntype = %2\ninitial = %3\n").arg(name, type, initial).toUtf8();
    };
    for (int i = 0; i < kinds.size(); ++i) {
        const QString type = QString(kinds.at(i)).replace("Float", "Real");
        add(kinds.at(i) + ".in", type, values.at(i));
        add(kinds.at(i) + ".out", type, "0");
        add(kinds.at(i) + ".vectorIn", type + "[3]", QStringLiteral("1, %1, 3").arg(values.at(i)));
        add(kinds.at(i) + ".vectorOut", type + "[3]", "0");
    }
    add("Boolean.in", "Bool", "1");
    add("Boolean.out", "Bool", "0");
    add("Boolean.vectorIn", "UInt8[3]", "1, 0, 1");
    add("Boolean.vectorOut", "UInt8[3]", "0");
    add("colourIn", "Int16", "200");
    add("colourOut", "Int16", "0");
    add("matrixIn", "Real64[6]", "1, 2, 3, 4, 5, 6");
    add("matrixOut", "Real32[6]", "0");
    TestMaster master(QPlcClock::lockstep(), fmuTable(table));
    QPlcFmuNode node;
    QVERIFY2(node.configureFromFile(QTPLC_TEST_FMUS "/types3.fmu"), qPrintable(errorsOf(node)));
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(run(master, 5));
    for (const QString &kind : kinds + QStringList{"Boolean"}) {
        QCOMPARE(master.signalValue(kind + ".out"), master.signalValue(kind + ".in"));
        QCOMPARE(master.signalValue(kind + ".vectorOut"), master.signalValue(kind + ".vectorIn"));
    }
    QCOMPARE(master.signalValue("colourOut").toInt(), 200);
    QCOMPARE(master.signalValue("matrixOut").toString(), QString("1, 2, 3, 4, 5, 6"));
    node.disconnectFromMaster();
}

/// The bits of results are compared.
void tst_FmuNode::negativeZeroPassesUnchanged()
{
    TestMaster master;
    QPlcFmuNode node;
    QVERIFY(node.configure(configuration("plant2", "[fmu.read]\nfree = u\n[fmu.write]\nu = setpoint\n"), "a"));
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(master.setSignalValue("setpoint", -0.0));
    QVERIFY(run(master, 5));
    QVERIFY(std::signbit(master.signalValue("free").toReal()));
    node.disconnectFromMaster();
}

void tst_FmuNode::enumerationsThatDoNotFitAreAFault()
{
    TestMaster master(QPlcClock::lockstep(),
                      fmuTable("[colourIn]\ntype = Int16\ninitial = 200\n[colourOut]\ntype = Int8\n"));
    QPlcFmuNode node;
    QVERIFY(node.configureFromFile(QTPLC_TEST_FMUS "/types3.fmu"));
    QVERIFY(master.addLocalNode(&node));
    const LogCapture log;
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Fault);
    QTRY_VERIFY(!log.matching("the value 200 does not fit between variable 'colourOut' and signal 'colourOut' (Int8)")
                     .isEmpty());
    node.disconnectFromMaster();
}

void tst_FmuNode::typesThatDoNotFitAreRefused()
{
    TestMaster master;
    QPlcFmuNode node;
    QVERIFY(node.configure(configuration("plant2", "[fmu.read]\ncount = x\nvector = x\n"), "a"));
    const LogCapture log;
    QVERIFY(!master.addLocalNode(&node));
    const QString text = master.errorString() + node.errorString() + log.all().join(' ');
    QVERIFY2(text.contains("signal 'count' is Int32 in the table, but the node writes it as Real (variable 'x')"),
             qPrintable(text));
    QVERIFY2(text.contains("signal 'vector'"), qPrintable(text));
}

void tst_FmuNode::everyPhaseBeginsAtTheStartValues()
{
    QFETCH(QString, file);
    TestMaster master;
    QPlcFmuNode node;
    QVERIFY(node.configure(configuration(file, "[fmu.start]\nx0 = 4\n" + wires), "a"));
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(master.setSignalValue("setpoint", 1.0));
    QVector<double> ends;
    for (int i = 0; i < 3; ++i) {
        QVERIFY(master.initializeAllStates());
        QVERIFY(master.waitForState(QPlcMasterNode::Ready));
        QCOMPARE(master.signalValue("sum").toReal(), 4.0);
        QVERIFY(run(master, 10));
        ends << master.signalValue("sum").toReal();
    }
    QVERIFY(ends.first() > 4.0);
    QCOMPARE(ends.at(1), ends.first());
    QCOMPARE(ends.at(2), ends.first());
    node.disconnectFromMaster();
}

void tst_FmuNode::anFmuThatDiscardsOrEndsStopsThePlant_data()
{
    QTest::addColumn<QString>("file");
    QTest::addColumn<int>("fault");
    QTest::addColumn<QString>("reason");
    for (const char *file : {"plant2", "plant3"}) {
        QTest::addRow("%s discards", file) << file << 1 << "the FMU has discarded the step at ";
        QTest::addRow("%s ends", file) << file << 2 << "the FMU has ended the simulation at ";
    }
}

void tst_FmuNode::anFmuThatDiscardsOrEndsStopsThePlant()
{
    QFETCH(QString, file);
    QFETCH(int, fault);
    QFETCH(QString, reason);
    TestMaster master;
    QPlcFmuNode node;
    QVERIFY(node.configure(
        configuration(file, "[fmu.start]\nfaultTime = 0.05\nfault = " + QByteArray::number(fault) + '\n' + wires),
        "a"));
    QVERIFY(master.addLocalNode(&node));
    QSignalSpy ended(&node, &QPlcFmuNode::modelEnded);
    const LogCapture log;
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    QVERIFY2(master.stateReason().contains("node 'Model' asked for it"), qPrintable(master.stateReason()));
    QTRY_COMPARE(ended.size(), 1);
    QVERIFY2(ended.first().first().toString().startsWith(reason), qPrintable(ended.first().first().toString()));
    QCOMPARE(log.matching(reason).size(), 1);
    node.disconnectFromMaster();
}

void tst_FmuNode::anErrorOfTheFmuIsAFaultOfTheNode_data()
{
    QTest::addColumn<QString>("file");
    QTest::addColumn<int>("fault");
    QTest::addColumn<QString>("text");
    for (const char *file : {"plant2", "plant3"}) {
        QTest::addRow("%s error", file) << file << 3 << "the FMU reports an error (fmi";
        QTest::addRow("%s fatal", file) << file << 4 << "the FMU reports a fatal error (fmi";
    }
}

void tst_FmuNode::anErrorOfTheFmuIsAFaultOfTheNode()
{
    QFETCH(QString, file);
    QFETCH(int, fault);
    QFETCH(QString, text);
    TestMaster master;
    QPlcFmuNode node;
    QVERIFY(node.configure(
        configuration(file, "[fmu.start]\nfaultTime = 0.05\nfault = " + QByteArray::number(fault) + '\n' + wires),
        "a"));
    QVERIFY(master.addLocalNode(&node));
    const LogCapture log;
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Fault);
    QTRY_VERIFY(!log.matching(text).filter("the tank").isEmpty());
    node.disconnectFromMaster();
}

void tst_FmuNode::nanOfTheFmuIsNotTaken()
{
    QFETCH(QString, file);
    TestMaster master;
    QPlcFmuNode node;
    QVERIFY(node.configure(configuration(file, "[fmu.start]\nfaultTime = 0.05\nfault = 5\nx0 = 3\n" + wires), "a"));
    QVERIFY(master.addLocalNode(&node));
    const LogCapture log;
    QVERIFY(run(master, 20));
    QCOMPARE(master.signalValue("sum").toReal(), 3.0);
    QVERIFY(node.state() != QPlcSlaveNode::Fault);
    node.disconnectFromMaster();
}

void tst_FmuNode::whatTheFmuReportsIsLoggedOutsideOfTheCycle()
{
    TestMaster master;
    QPlcFmuNode node;
    QVERIFY(node.configure(configuration("plant2",
                                         "log = on\n[fmu.start]\nlabel = 50 %s of it\nfault = 9\n"
                                         "faultTime = 0.05\n"
                                             + wires),
                           "a"));
    QVERIFY(master.addLocalNode(&node));
    const LogCapture log;
    QVERIFY(run(master, 10));
    QTRY_VERIFY(!log.matching("lines were too many and are missing").isEmpty());
    QCOMPARE(log.matching("Model: FMU: it logs (plant)").size(), 1);
    QCOMPARE(log.matching("Model: FMU: warning: 50 %s of it (plant)").size(), 1);
    QVERIFY(!log.matching("Model: FMU: warning: flood (plant)").isEmpty());
    node.disconnectFromMaster();
}

void tst_FmuNode::cyclesAllocateNothing()
{
    QFETCH(QString, file);
    if (!ThreadCosts::areCounted())
        QSKIP("the sanitizer owns malloc", "");
    /// Tells the counter which thread the cycles run on.
    class Watched : public QPlcFmuNode
    {
        void update(const QPlcCycle &cycle) override
        {
            ThreadCosts::watchThisThread();
            QPlcFmuNode::update(cycle);
        }
    };
    TestMaster master(QPlcClock::lockstep(), fmuTable("[mode]\ntype = Int8\n[on]\ntype = Bool\ninitial = 1\n"));
    Watched node;
    QVERIFY2(node.configure(configuration(file,
                                          "[fmu.start]\nlimit = 1\n[fmu.read]\nsum = x\nvector = r * 2\nmode = mode\n"
                                          "[fmu.write]\nu = setpoint\nenabled = on\n"),
                            "a"),
             qPrintable(errorsOf(node)));
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(master.setSignalValue("setpoint", 1.0));
    master.setCycleLimit(5000);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(100));
    const ThreadCosts before = ThreadCosts::ofWatchedThreads();
    QVERIFY(master.waitForCycles(4900));
    const ThreadCosts spent = ThreadCosts::ofWatchedThreads() - before;
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.signalValue("mode").toInt(), 1);
    QCOMPARE(spent.allocations, std::uint64_t(0));
    node.disconnectFromMaster();
}

void tst_FmuNode::wrongConfigurationsAreRefusedWithTheirPlace_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("error");
    const auto row = [](const char *name, const QByteArray &more, const char *error) {
        QTest::newRow(name) << configuration("plant2", more) << QString(error);
    };
    QTest::newRow("no FMU") << QByteArray("[node]\nname = A\n") << "no FMU is named; add [fmu] with 'file = model.fmu'";
    QTest::newRow("no file") << QByteArray("[fmu]\nfile = none.fmu\n") << "a.ini:2:8: none.fmu: there is no such file";
    QTest::newRow("line before a section")
        << QByteArray("file = x\n") << "a.ini:1:1: 'file' stands before the first section; begin with [node] or [fmu]";
    QTest::newRow("key of node") << QByteArray("[node]\nnaem = x\n[fmu]\nfile = x\n")
                                 << "'naem' is not a key of [node]";
    row("section", "[fmu.reed]\n", "a.ini:5:2: there is no section 'fmu.reed'; did you mean 'fmu.read'?");
    row("key", "stop = 1\n", "a.ini:5:8: 'stop' is not a key of [fmu]; did you mean 'step'?");
    row("step", "step = 10\n", "'10' is not a step; write for example '10 ms'");
    row("tolerance", "tolerance = -1\n", "'-1' is not a tolerance");
    row("log", "log = yes\n", "'yes' is neither 'on' nor 'off'");
    row("start", "[fmu.start]\ngian = 1\n", "a.ini:6:8: the FMU has no variable 'gian'; did you mean 'gain'?");
    row("variable", "[fmu.read]\nsum = y\n", "a.ini:6:7: the FMU has no variable 'y'");
    row("output that is written", "[fmu.write]\nx = setpoint\n", "'x' (output) cannot be written while cycles run");
    row("number", "[fmu.write]\nu = 8\n", "'8' is a number and not a signal; set it in [fmu.start]");
    row("twice", "[fmu.read]\nsum = x\nsum[0] = x\n", "'sum' is wired twice, or with brackets and without");
    row("element of an array", "[fmu.read]\nvector[1] = r\n", "an element of a signal cannot have 3 values");
    row("gap", "[fmu.read]\nvector[0] = x\nvector[2] = x\n", "no variable gives a value to vector[1]");
    row("factor on the left", "[fmu.read]\nsum * 2 = x\n", "factor and offset of 'sum * 2' belong to the right side");
    row("text", "[fmu.read]\nsum = label\n", "'label' is of the type String");
    row("factor 0", "[fmu.read]\nsum = x * 0\n", "a.ini:6:7: with the factor '0', nothing is left of the value");
    row("factor nan", "[fmu.read]\nsum = x * nan\n", "the factor 'nan' is not a finite number");
    row("factor inf", "[fmu.write]\nu = setpoint * inf\n", "the factor 'inf' is not a finite number");
    row("offset", "[fmu.read]\nsum = x * 2 - inf\n", "the offset 'inf' is not a finite number");
    row("start nan", "[fmu.start]\ngain = nan\n", "a.ini:6:8: 'nan' is not a value of 'gain' (Real)");
    row("start inf", "[fmu.start]\nx0 = -inf\n", "'-inf' is not a value of 'x0' (Real)");
    row("step nan", "step = nan\n", "'nan' is not a step");
    row("step that is too long", "step = 1e9 s\n", "'1e9 s' is not a step; write for example '10 ms', at most '10 s'");
    row("tolerance inf", "tolerance = inf\n", "'inf' is not a tolerance");
    row("key twice", "log = on\nlog = off\n", "a.ini:6:1: 'log' is there twice, first in line 5");
}

void tst_FmuNode::wrongConfigurationsAreRefusedWithTheirPlace()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, error);
    QPlcFmuNode node;
    QVERIFY(!node.configure(text, "a.ini"));
    QVERIFY2(errorsOf(node).contains(error), qPrintable(errorsOf(node)));
    QVERIFY(node.wires().isEmpty());
}

void tst_FmuNode::allErrorsOfAConfigurationAreToldAtOnce()
{
    QPlcFmuNode node;
    QVERIFY(!node.configure(configuration("plant2",
                                          "log = perhaps\nlog = off\nstep = inf\n[fmu.start]\ngain = nan\n[fmu.read]\n"
                                          "sum = y\nfree = x * 0\n[fmu.write]\nu = 8\n"),
                            "a.ini"));
    for (const char *error : {"'log' is there twice", "neither 'on' nor 'off'", "'inf' is not a step",
                              "'nan' is not a value", "no variable 'y'", "the factor '0'", "'8' is a number"})
        QVERIFY2(errorsOf(node).contains(error), qPrintable(errorsOf(node)));
    QCOMPARE(node.configurationErrors().size(), 7);
    QVERIFY(node.wires().isEmpty());
}

QTEST_GUILESS_MAIN(tst_FmuNode)
#include "tst_FmuNode.moc"
