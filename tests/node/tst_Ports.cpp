// SPDX-License-Identifier: Apache-2.0
#include "NodeFixtures.h"
#include "node/api/QPlcSlaveNodePrivate.h"
#include "node/cycle/NodeRuntime.h"
#include "realtime/TimeSource.h"

#include <QtTest/QtTest>

#include <Eigen/Core>

using qplc::NodeRuntime;

namespace {

QPlcSignalTable tableOf(const QByteArray &type)
{
    return QPlcSignalTable::fromIni("[in]\ntype = " + type + "\n[out]\ntype = " + type + "\n");
}

/// Gives its input back as its output.
template<typename T>
class Through : public QPlcCompactSlaveNode
{
public:
    Through()
        : QPlcCompactSlaveNode("Through")
    {
    }
    QPlcInput<T> m_in{this, "in"};
    QPlcOutput<T> m_out{this, "out"};
    void step(const QPlcCycle &) override { m_out = m_in.value(); }
};

/// The bytes that come out when \a value goes in.
template<typename T>
QPlcValue through(const QByteArray &type, const QPlcValue &value)
{
    const QPlcSignalTable table = tableOf(type);
    Through<T> node;
    NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    if (!runtime.bind(table, &error))
        return QPlcValue(error);
    const QPlcValue in = value.convertedTo(table.at(0).type);
    runtime.step(QPlcCycle(), in.toBytes().constData());
    return QPlcValue::fromBytes(table.at(1).type, runtime.outputs());
}

template<typename Port>
QString refusal(const QByteArray &type)
{
    class Node : public QPlcCompactSlaveNode
    {
    public:
        Node()
            : QPlcCompactSlaveNode("Node")
        {
        }
        Port m_port{this, "in"};
    } node;
    NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    runtime.bind(tableOf(type), &error);
    return error;
}

enum class Phase : qint8 { Launch = -3, Fly = 0, Land = 4 };
enum class Switch : bool { Off, On };
enum Gear { Low, Middle, High };  // of C: an unsigned int

template<typename T>
bool fitsExactly(const QByteArray &type)
{
    const QPlcValue smallest(std::numeric_limits<T>::lowest());
    const QPlcValue largest(std::numeric_limits<T>::max());
    return through<T>(type, smallest) == smallest && through<T>(type, largest) == largest;
}

}  // namespace

class tst_Ports : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everyElementTypeTravelsExactly();
    void arraysAndVectorsTravelInOrder();
    void truthValuesAreNormalized();
    void enumeratorsTravelAsTheNumbersThatTheyAre();
    void timesAreNanoseconds();
    void realsMixAndIntegersWiden();
    void incompatibleTypesAreRefused_data();
    void incompatibleTypesAreRefused();
    void allMismatchesStandInOneMessage();
    void aSignalIsDeclaredOnce();
    void oneSignalMayBeReadAndWritten();
    void boundPortsUseVariablesThatExist();
    void boundPortsUseEnumeratorsThatExist();
    void outputsStayUntilAssigned();
    void compactSignalsAdoptTheTypeOfTheSignal();
    void compactSignalsThatDoNotFitAreFaults();
    void theFirstFaultOfAPhaseIsKept();
    void portsReportNameDirectionAndValue();
    void workloadBecomesAnOutput();
    void bindingAgainFollowsTheNewTable();
};

void tst_Ports::everyElementTypeTravelsExactly()
{
    QVERIFY(fitsExactly<qint8>("Int8"));
    QVERIFY(fitsExactly<qint16>("Int16"));
    QVERIFY(fitsExactly<qint32>("Int32"));
    QVERIFY(fitsExactly<qint64>("Int64"));
    QVERIFY(fitsExactly<quint8>("UInt8"));
    QVERIFY(fitsExactly<quint16>("UInt16"));
    QVERIFY(fitsExactly<quint32>("UInt32"));
    QVERIFY(fitsExactly<quint64>("UInt64"));
    QVERIFY(fitsExactly<float>("Real32"));
    QVERIFY(fitsExactly<double>("Real64"));
    QVERIFY(fitsExactly<long>("Int64"));
    QVERIFY(fitsExactly<unsigned long>("UInt64"));
    QVERIFY(fitsExactly<signed char>("Int8"));
}

void tst_Ports::arraysAndVectorsTravelInOrder()
{
    const QPlcValue triple(std::array<double, 3>{1.5, -2.5, 1e300});
    const QPlcValue singles(std::array<float, 3>{1.5f, -2.5f, 1e30f});
    QCOMPARE((through<std::array<double, 3>>("Real64Triple", triple)), triple);
    QCOMPARE(through<Eigen::Vector3d>("Real64Triple", triple), triple);
    QCOMPARE(through<Eigen::Vector3f>("Real32Triple", singles), singles);
    QCOMPARE(through<Eigen::Vector3d>("Real32Triple", singles), singles);
    QCOMPARE((through<std::array<int, 4>>("Int32[4]", QPlcValue(std::array<int, 4>{1, -2, 3, INT_MIN}))),
             QPlcValue(std::array<int, 4>{1, -2, 3, INT_MIN}));
    QCOMPARE((through<Eigen::Matrix<double, 6, 1>>("Real64[6]", QPlcValue(std::array<double, 6>{1, 2, 3, 4, 5, 6}))),
             QPlcValue(std::array<double, 6>{1, 2, 3, 4, 5, 6}));
    QCOMPARE((through<std::array<bool, 2>>("Int8[2]", QPlcValue(std::array<qint8, 2>{1, 0}))),
             QPlcValue(std::array<qint8, 2>{1, 0}));
}

void tst_Ports::truthValuesAreNormalized()
{
    for (const char *type : {"Bool", "Byte"}) {
        QCOMPARE(through<bool>(type, QPlcValue(0)).toInt(), 0);
        QCOMPARE(through<bool>(type, QPlcValue(1)).toInt(), 1);
        QCOMPARE(through<bool>(type, QPlcValue(77)).toInt(), 1);  // whatever another node has sent
    }
}

void tst_Ports::enumeratorsTravelAsTheNumbersThatTheyAre()
{
    QCOMPARE(through<Phase>("Int8", QPlcValue(-3)).toInt(), -3);
    QCOMPARE(through<Phase>("Int8", QPlcValue(77)).toInt(), 77);  // without an enumerator: as documented
    QCOMPARE(through<Gear>("UInt32", QPlcValue(2)).toInt(), 2);
    QCOMPARE((through<std::array<Phase, 3>>("Int8[3]", QPlcValue(std::array<qint8, 3>{4, -3, 0}))),
             QPlcValue(std::array<qint8, 3>{4, -3, 0}));
    QCOMPARE(through<Switch>("Bool", QPlcValue(1)).toInt(), 1);
    QCOMPARE(refusal<QPlcOutput<Phase>>("Int32"), QString());  // widened, as an integer
    QVERIFY(refusal<QPlcInput<Phase>>("Int32").contains("Int8"));
    QVERIFY(refusal<QPlcInput<Gear>>("Int32").contains("UInt32"));
    QVERIFY(refusal<QPlcOutput<Phase>>("Real64").contains("Int8"));
}

void tst_Ports::timesAreNanoseconds()
{
    const QPlcValue time(QDateTime(QDate(2026, 1, 31), QTime(12, 0), Qt::UTC));
    QCOMPARE(through<qint64>("DateTime", time), time);
}

void tst_Ports::realsMixAndIntegersWiden()
{
    QCOMPARE(through<double>("Real32", QPlcValue(0.5)).toReal(), 0.5);
    QCOMPARE(through<float>("Real64", QPlcValue(0.1)).toReal(), double(0.1f));  // rounded, as said
    QCOMPARE(refusal<QPlcInput<int>>("Int16"), QString());
    QCOMPARE(refusal<QPlcInput<int>>("Int32"), QString());
    QCOMPARE(refusal<QPlcOutput<short>>("Int32"), QString());
    QCOMPARE(refusal<QPlcOutput<quint8>>("UInt64"), QString());
    class Widener : public QPlcCompactSlaveNode
    {
    public:
        Widener()
            : QPlcCompactSlaveNode("Widener")
        {
        }
        QPlcInput<qint64> m_in{this, "in"};
        QPlcOutput<qint8> m_out{this, "out"};
        void step(const QPlcCycle &) override { m_out = qint8(m_in / 1000); }
    } node;
    NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    QVERIFY(runtime.bind(tableOf("Int32"), &error));
    QVERIFY(runtime.step(QPlcCycle(), QPlcValue(-100000).toBytes().constData()));
    QCOMPARE(QPlcValue::fromBytes(QPlcSignalType(QPlcSignalType::Int32), runtime.outputs()).toInt(), -100);
}

void tst_Ports::incompatibleTypesAreRefused_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QStringList>("words");
    const auto row
        = [](const char *name, const QString &text, const QStringList &words) { QTest::newRow(name) << text << words; };
    row("wider integer input", refusal<QPlcInput<short>>("Int32"), {"'in'", "Int32", "reads", "Int16"});
    row("narrower integer output", refusal<QPlcOutput<int>>("Int16"), {"Int16", "writes", "Int32"});
    row("signedness", refusal<QPlcInput<int>>("UInt16"), {"UInt16", "Int32"});
    row("integer from real", refusal<QPlcInput<int>>("Real64"), {"Real64", "Int32"});
    row("real from integer", refusal<QPlcInput<double>>("Int32"), {"Int32", "Real64"});
    row("bool from real", refusal<QPlcInput<bool>>("Real32"), {"bool"});
    row("bool from Int32", refusal<QPlcInput<bool>>("Int32"), {"bool"});
    row("scalar from array", refusal<QPlcInput<double>>("Real64Triple"), {"Real64[3]", "Real64"});
    row("array from scalar", refusal<QPlcInput<std::array<double, 3>>>("Real64"), {"Real64[3]"});
    row("other length", refusal<QPlcInput<Eigen::Vector4d>>("Real64[3]"), {"Real64[3]", "Real64[4]"});
    row("number from text", refusal<QPlcInput<double>>("String"), {"String(64)"});
    row("time as double", refusal<QPlcInput<double>>("DateTime"), {"DateTime"});
    row("time as int", refusal<QPlcInput<int>>("DateTime"), {"DateTime", "Int32"});
}

void tst_Ports::incompatibleTypesAreRefused()
{
    QFETCH(QString, text);
    QFETCH(QStringList, words);
    QVERIFY(!text.isEmpty());
    for (const QString &word : words)
        QVERIFY2(text.contains(word), qPrintable(text));
}

void tst_Ports::allMismatchesStandInOneMessage()
{
    class Wrong : public QPlcCompactSlaveNode
    {
    public:
        Wrong()
            : QPlcCompactSlaveNode("Wrong")
        {
        }
        QPlcInput<double> m_a{this, "setpiont"};
        QPlcInput<int> m_b{this, "echo"};
        QPlcInput<double> m_good{this, "setpoint"};
        QPlcOutput<double> m_c{this, "vector"};
    } node;
    TestMaster master;
    QVERIFY(!master.addLocalNode(&node));
    QCOMPARE(master.error(), QPlcMasterNode::SignalError);
    for (const char *word : {"'Wrong'", "'setpiont'", "'setpoint'", "'echo'", "'vector'"})
        QVERIFY2(master.errorString().contains(word), qPrintable(master.errorString()));
    QCOMPARE(master.errorString().count(';'), 3);
}

void tst_Ports::aSignalIsDeclaredOnce()
{
    class Twice : public QPlcCompactSlaveNode
    {
    public:
        Twice()
            : QPlcCompactSlaveNode("Twice")
        {
        }
        QPlcInput<double> m_a{this, "in"};
        QPlcInput<double> m_b{this, "in"};
    } node;
    NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    QVERIFY(!runtime.bind(tableOf("Real64"), &error));
    QVERIFY2(error.contains("'in' is declared twice"), qPrintable(error));
}

void tst_Ports::oneSignalMayBeReadAndWritten()
{
    class Feedback : public QPlcCompactSlaveNode
    {
    public:
        Feedback()
            : QPlcCompactSlaveNode("Feedback")
        {
        }
        QPlcInput<double> m_last{this, "in"};
        QPlcOutput<double> m_next{this, "in"};
        void reset() override { m_next = 1.0; }
        void step(const QPlcCycle &) override { m_next = m_last * 2.0; }
    } node;
    TestMaster master(QPlcClock::lockstep(), tableOf("Real64"));
    master.setCycleLimit(10);
    QVERIFY2(master.addLocalNode(&node), qPrintable(master.errorString()));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.signalValue("in").toReal(), 1024.0);
}

void tst_Ports::boundPortsUseEnumeratorsThatExist()
{
    struct
    {
        Phase phases[2] = {Phase::Fly, Phase::Fly};
        Phase shown[2] = {Phase::Land, Phase::Launch};
    } model;
    QPlcCompactSlaveNode node("Node");
    QPlcBoundInput<Phase[2]> input(&node, "in", &model.phases);
    QPlcBoundOutput<Phase[2]> output(&node, "out", &model.shown);
    NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    QVERIFY2(runtime.bind(tableOf("Int8[2]"), &error), qPrintable(error));
    const QPlcValue value(std::array<qint8, 2>{4, -3});
    QVERIFY(runtime.step(QPlcCycle(), value.toBytes().constData()));
    QVERIFY(model.phases[0] == Phase::Land && model.phases[1] == Phase::Launch);
    QCOMPARE(QPlcValue::fromBytes(QPlcSignalType::fromName("Int8[2]"), runtime.outputs()), value);
}

void tst_Ports::boundPortsUseVariablesThatExist()
{
    struct
    {
        double level;
        float matrix[3];
    } u = {};
    struct
    {
        double level;
        double position[3];
    } y = {};
    class Bound : public QPlcCompactSlaveNode
    {
    public:
        Bound(double *levelIn, float (*matrix)[3], double *levelOut, double (*position)[3])
            : QPlcCompactSlaveNode("Bound")
            , m_level(this, "echo", levelIn)
            , m_matrix(this, "floats", matrix)
            , m_levelOut(this, "sum", levelOut)
            , m_position(this, "vector", position)
        {
        }
        QPlcBoundInput<double> m_level;
        QPlcBoundInput<float[3]> m_matrix;
        QPlcBoundOutput<double> m_levelOut;
        QPlcBoundOutput<double[3]> m_position;
    } node(&u.level, &u.matrix, &y.level, &y.position);
    const QPlcSignalTable table = QPlcSignalTable::fromIni(
        "[echo]\ntype=Real64\n[floats]\ntype=RealTriple\n[sum]\ntype=Real32\n[vector]\ntype=Real64Triple\n");
    NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    QVERIFY2(runtime.bind(table, &error), qPrintable(error));
    y.level = 2.5;
    y.position[2] = -7.0;
    QVERIFY(runtime.step(QPlcCycle(),
                         (QPlcValue(4.5).toBytes() + QPlcValue(std::array<float, 3>{1, 2, 3}).toBytes()).constData()));
    QCOMPARE(u.level, 4.5);
    QCOMPARE(u.matrix[2], 3.0f);
    QCOMPARE(QByteArray(runtime.outputs(), 28),
             QPlcValue(2.5f).toBytes() + QPlcValue(std::array<double, 3>{0, 0, -7}).toBytes());
}

void tst_Ports::outputsStayUntilAssigned()
{
    class Once : public QPlcCompactSlaveNode
    {
    public:
        Once()
            : QPlcCompactSlaveNode("Once")
        {
        }
        QPlcOutput<double> m_out{this, "out"};
        void step(const QPlcCycle &cycle) override
        {
            if (cycle.number() == 0)
                m_out = 3.0;
        }
    } node;
    NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    QVERIFY(runtime.bind(tableOf("Real64"), &error));
    QVERIFY(runtime.reset(&error));
    for (quint64 k = 0; k < 3; ++k) {
        QVERIFY(runtime.step(QPlcCycle(k, std::chrono::milliseconds(1)), nullptr));
        QCOMPARE(QPlcValue::fromBytes(QPlcSignalType(QPlcSignalType::Real64), runtime.outputs()).toReal(), 3.0);
    }
}

void tst_Ports::compactSignalsAdoptTheTypeOfTheSignal()
{
    class Compact : public QPlcCompactSlaveNode
    {
    public:
        Compact()
            : QPlcCompactSlaveNode("Compact")
        {
        }
        QPlcCompactSignal _in = QPlcCompactSignal("in", QPlcCompactSignal::Input, this);
        QPlcCompactSignal _out = QPlcCompactSignal("out", QPlcCompactSignal::Output, this);
        double first = 0.0;
        double third = 0.0;
        void compactRealTimeout() override
        {
            first = _in;
            third = _in[2];
            double doubled[3];
            for (int i = 0; i < 3; ++i)
                doubled[i] = 2.0 * _in[i];
            _out = doubled;
        }
    } node;
    NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    QVERIFY(runtime.bind(tableOf("RealTriple"), &error));
    QCOMPARE(node._out.value().type().name(), QString("Real32[3]"));  // zero before the first cycle
    QVERIFY(runtime.step(QPlcCycle(), QPlcValue(std::array<float, 3>{1, 2, 3}).toBytes().constData()));
    QCOMPARE(node.first, 1.0);
    QCOMPARE(node.third, 3.0);
    QCOMPARE(QByteArray(runtime.outputs(), 12), QPlcValue(std::array<float, 3>{2, 4, 6}).toBytes());
    node._out = node._in;  // as variables are
    QCOMPARE(node._out.value(), node._in.value());
    node._out = QPlcValue("text");
    QCOMPARE(node._out.value().toString(), QString("text"));
}

void tst_Ports::compactSignalsThatDoNotFitAreFaults()
{
    class Compact : public QPlcCompactSlaveNode
    {
    public:
        Compact()
            : QPlcCompactSlaveNode("Compact")
        {
        }
        QPlcCompactSignal _out = QPlcCompactSignal("out", QPlcCompactSignal::Output, this);
        QPlcValue next;
        void compactInitializeOutputSignals() override { _out = QPlcValue(0.0); }
        void compactRealTimeout() override { _out = next; }
    } node;
    NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    QVERIFY(runtime.bind(tableOf("Int8"), &error));
    for (const QPlcValue &wrong : {QPlcValue("text"), QPlcValue(1000), QPlcValue(std::array<int, 3>{1, 2, 3})}) {
        node.next = QPlcValue(5.0);
        QVERIFY(runtime.reset(&error));
        runtime.beginPhase(true, qplc::TimeSource::monotonic());
        QVERIFY(runtime.step(QPlcCycle(), nullptr));
        QCOMPARE(int(*runtime.outputs()), 5);
        node.next = wrong;
        QVERIFY(!runtime.step(QPlcCycle(), nullptr));
        QVERIFY2(QString(runtime.faultText()).contains("'out'"), runtime.faultText());
        QCOMPARE(int(*runtime.outputs()), 0);  // safe
        node.next = QPlcValue(5.0);
        QVERIFY(!runtime.step(QPlcCycle(), nullptr));  // and not again in this phase
    }
}

void tst_Ports::theFirstFaultOfAPhaseIsKept()
{
    class Thrower : public QPlcCompactSlaveNode
    {
    public:
        Thrower()
            : QPlcCompactSlaveNode("Thrower")
        {
        }
        void step(const QPlcCycle &cycle) override
        {
            throw std::runtime_error("cycle " + std::to_string(cycle.number()));
        }
    } node;
    NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    QVERIFY(runtime.bind(tableOf("Real64"), &error));
    for (quint64 first : {3, 8}) {
        QVERIFY(runtime.reset(&error));
        runtime.beginPhase(true, qplc::TimeSource::monotonic());
        for (quint64 k = first; k < first + 3; ++k)
            QVERIFY(!runtime.step(QPlcCycle(k, std::chrono::milliseconds(1)), nullptr));
        QCOMPARE(QString(runtime.faultText()),
                 QString("cycle %1").arg(first));  // its owner reads it while cycles go on
    }
}

void tst_Ports::portsReportNameDirectionAndValue()
{
    Through<double> node;
    QCOMPARE(node.m_in.name(), QString("in"));
    QVERIFY(node.m_in.isInput());
    QCOMPARE(node.m_out.direction(), QPlcPort::Output);
    QCOMPARE(double(node.m_in), 0.0);
    node.m_out = 4.0;
    QCOMPARE(node.m_out.value(), 4.0);
    QPlcOutput<double> other(&node, "other");
    other = node.m_out;
    QCOMPARE(other.value(), 4.0);
}

void tst_Ports::workloadBecomesAnOutput()
{
    for (const char *type : {"Real32", "Real64"}) {
        Through<double> node;
        NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
        runtime.setWorkloadSignal("load");
        QString error;
        const QPlcSignalTable table = QPlcSignalTable::fromIni(
            "[in]\ntype=Real64\n[out]\ntype=Real64\n[load]\ntype=" + QByteArray(type) + "\n");
        QVERIFY(runtime.bind(table, &error));
        QCOMPARE(int(runtime.outputLayout().fields().size()), 2);
        QVERIFY(runtime.step(QPlcCycle(), QByteArray(8, '\0').constData()));
        QVERIFY(QPlcValue::fromBytes(table.at(2).type, runtime.outputs() + 8).toReal() > 0.0);
        runtime.beginPhase(true);  // results must not depend on the machine
        QVERIFY(runtime.step(QPlcCycle(), QByteArray(8, '\0').constData()));
        QCOMPARE(QPlcValue::fromBytes(table.at(2).type, runtime.outputs() + 8).toReal(), 0.0);
    }
    Through<double> node;
    NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    runtime.setWorkloadSignal("laod");
    QVERIFY(!runtime.bind(tableOf("Real64"), &error));
    QVERIFY2(error.contains("'laod'"), qPrintable(error));
    runtime.setWorkloadSignal("n");
    QVERIFY(
        !runtime.bind(QPlcSignalTable::fromIni("[in]\ntype=Real64\n[out]\ntype=Real64\n[n]\ntype=Int32\n"), &error));
    QVERIFY2(error.contains("'n' is Int32"), qPrintable(error));
}

void tst_Ports::bindingAgainFollowsTheNewTable()
{
    Through<double> node;
    NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    QVERIFY(runtime.bind(tableOf("Real64"), &error));
    QVERIFY(runtime.bind(tableOf("Real32"), &error));
    QVERIFY(runtime.step(QPlcCycle(), QPlcValue(1.5f).toBytes().constData()));
    QCOMPARE(QByteArray(runtime.outputs(), 4), QPlcValue(1.5f).toBytes());
}

QTEST_GUILESS_MAIN(tst_Ports)
#include "tst_Ports.moc"
