// SPDX-License-Identifier: Apache-2.0
// What a modelDescription.xml says, and what is wrong with it.
#include "models/FmuDescription.h"
#include "models/FmuWiring.h"

#include <QtTest/QtTest>

using qplc::FmuDescription;
using qplc::FmuElement;
using qplc::FmuVariable;
using qplc::FmuWiring;

class tst_FmuDescription : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void variablesOfFmi2AreRead();
    void variablesOfFmi3AreRead();
    void arraysHaveTheirStartDimensions();
    void startValuesBelongToParametersAndInputs();
    void namesStandForVariablesArraysAndElements();
    void namesThatStandForNothingAreNamed_data();
    void namesThatStandForNothingAreNamed();
    void wrongDescriptionsAreRefusedWithTheirPlace_data();
    void wrongDescriptionsAreRefusedWithTheirPlace();
    void commentsAndDataMayContainAnything();

private:
    static FmuDescription read(const QByteArray &text, QPlcParseError *error)
    {
        return FmuDescription::fromXml(text, error);
    }
};

namespace {

/// Of version 2 or 3: what stands between the begin and the end of a description.
QByteArray description(int version, const QByteArray &variables, const QByteArray &before = QByteArray())
{
    return "<fmiModelDescription fmiVersion=\"" + QByteArray::number(version)
        + ".0\" modelName=\"M\" guid=\"g\" instantiationToken=\"g\">\n<CoSimulation modelIdentifier=\"m\"/>\n" + before
        + "<ModelVariables>\n" + variables + "</ModelVariables>\n</fmiModelDescription>\n";
}

}  // namespace

void tst_FmuDescription::variablesOfFmi2AreRead()
{
    const QByteArray types
        = "<TypeDefinitions><SimpleType name=\"T\"><Real unit=\"m\" min=\"-1\" max=\"2\"/></SimpleType>"
          "<SimpleType name=\"E\"><Enumeration><Item name=\"On\" value=\"1\"/></Enumeration>"
          "</SimpleType></TypeDefinitions><DefaultExperiment stopTime=\"2.5\" tolerance=\"1e-5\"/>";
    QPlcParseError error;
    const FmuDescription d = read(
        description(2,
                    "<ScalarVariable name=\"a\" valueReference=\"7\" causality=\"input\"><Real declaredType=\"T\" "
                    "start=\"1\"/></ScalarVariable>\n"
                    "<ScalarVariable name=\"b\" valueReference=\"7\" variability=\"discrete\"><Enumeration "
                    "declaredType=\"E\"/></ScalarVariable>\n"
                    "<ScalarVariable name=\"c\" valueReference=\"8\" causality=\"parameter\" description=\"what\">"
                    "<Boolean start=\"true\"/></ScalarVariable>\n",
                    types),
        &error);
    QVERIFY2(d.isValid(), qPrintable(error.toString()));
    QCOMPARE(d.variables.size(), 3);
    QCOMPARE(*d.stopTime, 2.5);
    QCOMPARE(*d.tolerance, 1e-5);
    QVERIFY(!d.startTime);
    const FmuVariable *a = d.find("a");
    QVERIFY(a);
    QCOMPARE(a->kind, FmuVariable::Float64);
    QCOMPARE(a->unit, QString("m"));
    QCOMPARE(a->maximum, QString("2"));
    QCOMPARE(a->variability, FmuVariable::Continuous);
    QCOMPARE(a->typeText(2), QString("Real"));
    const FmuVariable *b = d.find("b");
    QVERIFY(b->isEnumeration);
    QCOMPARE(b->items.first().second, QString("On"));
    QCOMPARE(b->scalar(2), QPlcSignalType::Int32);
    QCOMPARE(d.find("c")->scalar(2), QPlcSignalType::Int32);
    QCOMPARE(d.find("c")->description, QString("what"));
    QVERIFY(!d.find("d"));
}

void tst_FmuDescription::variablesOfFmi3AreRead()
{
    QPlcParseError error;
    const FmuDescription d = read(
        description(3,
                    "<Float32 name=\"a\" valueReference=\"1\" causality=\"output\"><Alias name=\"also\"/></Float32>\n"
                    "<UInt64 name=\"b\" valueReference=\"2\" causality=\"input\" start=\"3\"/>\n"
                    "<Boolean name=\"c\" valueReference=\"3\"/>\n"
                    "<Binary name=\"d\" valueReference=\"4\"><Start value=\"666f\"/></Binary>\n"
                    "<Clock name=\"e\" valueReference=\"5\" causality=\"input\"/>\n"),
        &error);
    QVERIFY2(d.isValid(), qPrintable(error.toString()));
    QCOMPARE(d.variables.size(), 6);
    QCOMPARE(d.find("a")->scalar(3), QPlcSignalType::Real32);
    QCOMPARE(d.find("also")->reference, 1u);
    QCOMPARE(d.find("b")->scalar(3), QPlcSignalType::UInt64);
    QCOMPARE(d.find("b")->variability, FmuVariable::Discrete);
    QCOMPARE(d.find("c")->scalar(3), QPlcSignalType::UInt8);
    QVERIFY(!d.find("d")->isNumber());
    QVERIFY(!d.find("e")->isNumber());
}

void tst_FmuDescription::arraysHaveTheirStartDimensions()
{
    QPlcParseError error;
    const FmuDescription d = read(
        description(3,
                    "<UInt64 name=\"n\" valueReference=\"1\" causality=\"structuralParameter\" start=\"4\"/>\n"
                    "<Float64 name=\"A\" valueReference=\"2\"><Dimension valueReference=\"1\"/><Dimension start=\"3\"/>"
                    "</Float64>\n"),
        &error);
    QVERIFY2(d.isValid(), qPrintable(error.toString()));
    QCOMPARE(d.find("A")->dimensions, QVector<int>({4, 3}));
    QCOMPARE(d.find("A")->count, 12);
    QCOMPARE(d.find("A")->typeText(3), QString("Float64[4][3]"));
}

void tst_FmuDescription::startValuesBelongToParametersAndInputs()
{
    QPlcParseError error;
    const FmuDescription d = read(
        description(3,
                    "<Float64 name=\"parameter\" valueReference=\"1\" causality=\"parameter\"/>\n"
                    "<Float64 name=\"input\" valueReference=\"2\" causality=\"input\"/>\n"
                    "<Float64 name=\"exact\" valueReference=\"3\" initial=\"exact\"/>\n"
                    "<Float64 name=\"output\" valueReference=\"4\" causality=\"output\"/>\n"
                    "<Float64 name=\"constant\" valueReference=\"5\" initial=\"exact\" variability=\"constant\"/>\n"
                    "<UInt64 name=\"n\" valueReference=\"6\" causality=\"structuralParameter\" start=\"1\"/>\n"
                    "<Float64 name=\"tunable\" valueReference=\"7\" causality=\"parameter\" "
                    "variability=\"tunable\"/>\n"),
        &error);
    QVERIFY2(d.isValid(), qPrintable(error.toString()));
    for (const char *name : {"parameter", "input", "exact", "tunable"})
        QVERIFY2(d.find(name)->hasStart(), name);
    for (const char *name : {"output", "constant", "n"})
        QVERIFY2(!d.find(name)->hasStart(), name);
    QVERIFY(d.find("input")->isSettable());
    QVERIFY(d.find("tunable")->isSettable());
    QVERIFY(!d.find("parameter")->isSettable());
}

void tst_FmuDescription::namesStandForVariablesArraysAndElements()
{
    QPlcParseError error;
    const FmuDescription d = read(
        description(3,
                    "<Float64 name=\"v\" valueReference=\"1\"><Dimension start=\"3\"/></Float64>\n"
                    "<Float64 name=\"r[2]\" valueReference=\"4\"/>\n<Float64 name=\"r[1]\" valueReference=\"3\"/>\n"
                    "<Float64 name=\"m[2,1]\" valueReference=\"7\"/>\n<Float64 name=\"m[1,2]\" valueReference=\"6\"/>\n"
                    "<Float64 name=\"m[1,1]\" valueReference=\"5\"/>\n"),
        &error);
    QVERIFY2(d.isValid(), qPrintable(error.toString()));
    const FmuWiring wiring(d);
    const auto references = [&](const QString &name) {
        QStringList texts;
        QString problem;
        for (const FmuElement &element : wiring.find(name, &problem))
            texts << QStringLiteral("%1.%2").arg(element.variable->reference).arg(element.element);
        return texts.join(' ');
    };
    QCOMPARE(references("v"), QString("1.0 1.1 1.2"));
    QCOMPARE(references("v[2]"), QString("1.2"));
    QCOMPARE(references("r"), QString("3.0 4.0"));
    QCOMPARE(references("r[2]"), QString("4.0"));
    QCOMPARE(references("m"), QString("5.0 6.0 7.0"));
    QCOMPARE(wiring.names(), QStringList({"v", "r", "m"}));
}

void tst_FmuDescription::namesThatStandForNothingAreNamed_data()
{
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("text");
    QTest::newRow("unknown") << "speeed"
                             << "the FMU has no variable 'speeed'; did you mean 'speed'?";
    QTest::newRow("element behind the end") << "v[3]"
                                            << "'v' has the elements 0 to 2";
    QTest::newRow("text") << "label"
                          << "'label' is of the type String, which a signal cannot have";
    QTest::newRow("no elements") << "none"
                                 << "'none' has no elements";
}

void tst_FmuDescription::namesThatStandForNothingAreNamed()
{
    QFETCH(QString, name);
    QFETCH(QString, text);
    QPlcParseError error;
    const FmuDescription d = read(
        description(3,
                    "<Float64 name=\"v\" valueReference=\"1\"><Dimension start=\"3\"/></Float64>\n"
                    "<Float64 name=\"speed\" valueReference=\"2\"/>\n<String name=\"label\" valueReference=\"3\"/>\n"
                    "<Float64 name=\"none\" valueReference=\"4\"><Dimension start=\"0\"/></Float64>\n"),
        &error);
    QVERIFY2(d.isValid(), qPrintable(error.toString()));
    QString problem;
    QVERIFY(FmuWiring(d).find(name, &problem).isEmpty());
    QVERIFY2(problem.contains(text), qPrintable(problem));
}

void tst_FmuDescription::wrongDescriptionsAreRefusedWithTheirPlace_data()
{
    QTest::addColumn<QByteArray>("xml");
    QTest::addColumn<QString>("text");
    const auto row = [](const char *name, const QByteArray &xml, const char *text) {
        QTest::newRow(name) << xml << QString(text);
    };
    row("empty", "", "this is not XML");
    row("other root", "<a/>", "modelDescription.xml:1:5: the file begins with 'a' instead of fmiModelDescription");
    row("FMI 1", "<fmiModelDescription fmiVersion=\"1.0\"/>", "version '1.0' of FMI; QtPLC offers 2.0 and 3.0");
    row("model exchange only", "<fmiModelDescription fmiVersion=\"2.0\"><ModelExchange/></fmiModelDescription>",
        "the FMU offers model exchange only; QtPLC needs co-simulation");
    row("variable without a name", description(3, "<Float64 valueReference=\"1\"/>\n"),
        "modelDescription.xml:4:30: variable '' has no name");
    row("unknown causality", description(3, "<Float64 name=\"a\" valueReference=\"1\" causality=\"x\"/>\n"),
        "unknown causality");
    row("variable twice",
        description(3, "<Float64 name=\"a\" valueReference=\"1\"/>\n<Float64 name=\"a\" valueReference=\"2\"/>\n"),
        "modelDescription.xml:5: variable 'a' is there twice");
    row("dimension of nothing",
        description(3, "<Float64 name=\"a\" valueReference=\"1\"><Dimension valueReference=\"9\"/></Float64>\n"),
        "a dimension of variable 'a' does not exist");
    row("huge array",
        description(3,
                    "<Float64 name=\"a\" valueReference=\"1\"><Dimension start=\"100000\"/><Dimension "
                    "start=\"100000\"/></Float64>\n"),
        "or is too large");
    row("dimension that is no number",
        description(3, "<Float64 name=\"a\" valueReference=\"1\"><Dimension start=\"x\"/></Float64>\n"),
        "is neither a number nor a valueReference");
    row("entities", "<!DOCTYPE a [<!ENTITY b \"c\">]><fmiModelDescription/>", "declares or uses entities");
    row("nested", "<fmiModelDescription fmiVersion=\"2.0\">" + QByteArray("<a>").repeated(100),
        "more than 32 elements stand inside of each other");
    row("attributes", "<a " + QByteArray("b=\"1\" ").repeated(1000) + "/>", "an element has more than 256 attributes");
    row("tolerance", description(2, "", "<DefaultExperiment tolerance=\"nan\"/>"), "tolerance = 'nan' is not a number");
    row("library elsewhere",
        "<fmiModelDescription fmiVersion=\"2.0\"><CoSimulation modelIdentifier=\"../m\"/></fmiModelDescription>",
        "modelIdentifier '../m' is not the name of a library");
}

void tst_FmuDescription::wrongDescriptionsAreRefusedWithTheirPlace()
{
    QFETCH(QByteArray, xml);
    QFETCH(QString, text);
    QPlcParseError error;
    QVERIFY(!read(xml, &error).isValid());
    QVERIFY2(error.toString().contains(text), qPrintable(error.toString()));
}

void tst_FmuDescription::commentsAndDataMayContainAnything()
{
    QByteArray noise = "<!-- don't count these: " + QByteArray("a=\"1\" ").repeated(1000)
        + "-->\n<Annotations><![CDATA[" + QByteArray("'= ").repeated(1000) + "]]></Annotations>\n";
    QPlcParseError error;
    const FmuDescription d = read(description(3, "<Float64 name=\"a\" valueReference=\"1\"/>\n", noise), &error);
    QVERIFY2(d.isValid(), qPrintable(error.toString()));
}

QTEST_GUILESS_MAIN(tst_FmuDescription)
#include "tst_FmuDescription.moc"
