// SPDX-License-Identifier: Apache-2.0
// Nodes generated from models in each form that Simulink exports. The models are written by hand.
#include "ThreadCosts.h"
#include "counter_node_test.h"
#include "gearbox_node_test.h"
#include "node/api/QPlcSlaveNodePrivate.h"
#include "node/cycle/NodeRuntime.h"
#include "pendulum_node_test.h"
#include "servo_node_test.h"
#include "tank_node_test.h"

#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

#include <cmath>
#include <thread>

using qplc::NodeRuntime;
using namespace std::chrono_literals;

namespace {

/// A node with the signal table that it asks for.
class Plant
{
public:
    explicit Plant(std::unique_ptr<QPlcSimulinkNode> node)
        : m_node(std::move(node))
        , m_table(QPlcSignalTable::fromIni(m_node->table().toUtf8(), &m_errors))
    {
        if (m_errors.isEmpty() && runtime().bind(m_table, &m_error)) {
            m_inputs = runtime().inputLayout();
            m_bytes.fill('\0', int(m_inputs.size()));
        }
    }

    QPlcSimulinkNode &node() { return *m_node; }
    NodeRuntime &runtime() { return QPlcSlaveNodePrivate::of(*m_node).runtime; }
    const QPlcSignalTable &table() const { return m_table; }
    QString error() const { return m_error + QPlcParseError::toString(m_errors); }

    bool reset() { return runtime().reset(&m_error) && runtime().initialize(m_bytes.constData(), &m_error); }
    void set(const char *name, const QPlcValue &value)
    {
        const QByteArray bytes = value.convertedTo(typeOf(name)).toBytes();
        std::memcpy(m_bytes.data() + offsetOf(m_inputs, name), bytes.constData(), std::size_t(bytes.size()));
    }
    QPlcValue get(const char *name)
    {
        return QPlcValue::fromBytes(typeOf(name), runtime().outputs() + offsetOf(runtime().outputLayout(), name));
    }
    bool step(std::chrono::nanoseconds period = 10ms)
    {
        return runtime().step(QPlcCycle(m_cycle++, period), m_bytes.constData());
    }
    QString fault() { return runtime().faultText(); }

private:
    QPlcSignalType typeOf(const char *name) const { return m_table.at(m_table.indexOf(QLatin1String(name))).type; }
    std::size_t offsetOf(const qplc::PayloadLayout &layout, const char *name) const
    {
        for (const qplc::PayloadLayout::Field &field : layout.fields()) {
            if (m_table.at(field.signal).name == QLatin1String(name))
                return field.offset;
        }
        qFatal("no signal %s", name);
    }

    std::unique_ptr<QPlcSimulinkNode> m_node;
    QVector<QPlcParseError> m_errors;
    QPlcSignalTable m_table;
    QString m_error;
    qplc::PayloadLayout m_inputs;
    QByteArray m_bytes;
    quint64 m_cycle = 0;
};

template<typename T, std::size_t N>
QPlcValue values(const T (&numbers)[N])
{
    std::array<T, N> array;
    std::copy(numbers, numbers + N, array.begin());
    return QPlcValue(array);
}

/// The pendulum by the method of Bogacki and Shampine: ode3 of Simulink.
struct Pendulum
{
    double angle = 0.5, speed = 0.0, length = 2.0;

    void step(double torque)
    {
        constexpr double h = 0.01;
        const auto acceleration = [&](double a) { return torque - 9.81 / length * std::sin(a); };
        const double v1 = speed, a1 = acceleration(angle);
        const double v2 = speed + h / 2 * a1, a2 = acceleration(angle + h / 2 * v1);
        const double v3 = speed + 3 * h / 4 * a2, a3 = acceleration(angle + 3 * h / 4 * v2);
        angle += h * (2 * v1 + 3 * v2 + 4 * v3) / 9;
        speed += h * (2 * a1 + 3 * a2 + 4 * a3) / 9;
    }
};

}  // namespace

class tst_SimulinkNodes : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void globalsComputeWhatTheSolverDoes();
    void initialOutputsAreThoseOfTheInitialState();
    void anotherPhaseBeginsAtTheInitialState();
    void parametersTakeEffectAtTheNextInitialization();
    void wrongParametersAreRefusedWithTheirLine();
    void anErrorStatusStopsThePlantWithItsText();
    void aStopRequestStopsThePlant();
    void theFinalTimeOfTheModelDoesNotEndIt();
    void anotherPeriodIsAFault();
    void busesBecomeSignalsOfTheirLeaves();
    void matricesAreTransposed();
    void enumsAndTruthValuesTravel();
    void theTableHasTypesDescriptionsAndNamesOfValues();
    void reusableModelsHaveStatesOfTheirOwn();
    void classesComputeAndReportErrors();
    void classesWithAccessFunctionsCompute();
    void outputAndUpdateMakeATwoPhaseNode();
    void stepsAllocateAndLockNothing();
};

void tst_SimulinkNodes::globalsComputeWhatTheSolverDoes()
{
    Plant plant(make_pendulum_node_test());
    QVERIFY2(plant.error().isEmpty(), qPrintable(plant.error()));
    QVERIFY(plant.reset());
    Pendulum expected;
    for (int i = 0; i < 500; ++i) {
        const double torque = std::sin(0.01 * i);
        plant.set("pendulum.torque", QPlcValue(torque));
        QVERIFY(plant.step());
        QVERIFY(std::abs(plant.get("pendulum.angle").toReal() - expected.angle) < 1e-12);
        QVERIFY(std::abs(plant.get("pendulum.speed").toReal() - expected.speed) < 1e-12);
        QCOMPARE(plant.get("pendulum.power").toReal(), torque * plant.get("pendulum.speed").toReal());
        expected.step(torque);
    }
}

void tst_SimulinkNodes::initialOutputsAreThoseOfTheInitialState()
{
    Plant plant(make_pendulum_node_test());
    QVERIFY(plant.reset());
    QCOMPARE(plant.get("pendulum.angle").toReal(), 0.5);
    QVERIFY(plant.step());
    QCOMPARE(plant.get("pendulum.angle").toReal(), 0.5);  // of the first cycle, too: no step is lost
    QVERIFY(plant.step());
    QVERIFY(plant.get("pendulum.angle").toReal() < 0.5);
}

void tst_SimulinkNodes::anotherPhaseBeginsAtTheInitialState()
{
    Plant plant(make_pendulum_node_test());
    QVERIFY(plant.reset());
    plant.set("pendulum.torque", QPlcValue(3.0));
    for (int i = 0; i < 10; ++i)
        QVERIFY(plant.step());
    const double before = plant.get("pendulum.angle").toReal();
    QVERIFY(plant.reset());
    QCOMPARE(plant.get("pendulum.angle").toReal(), 0.5);
    QCOMPARE(plant.get("pendulum.power").toReal(), 0.0);
    for (int i = 0; i < 10; ++i)
        QVERIFY(plant.step());
    QCOMPARE(plant.get("pendulum.angle").toReal(), before);
}

void tst_SimulinkNodes::parametersTakeEffectAtTheNextInitialization()
{
    QTemporaryDir folder;
    const auto write = [&folder](const QByteArray &text) {
        QFile file(folder.filePath("p.ini"));
        return file.open(QIODevice::WriteOnly) && file.write(text) == text.size() ? file.fileName() : QString();
    };
    Plant plant(make_pendulum_node_test());
    QString error;
    QVERIFY2(plant.node().readParameters(write("[other]\nx = 1\n[parameters]\nlength = 4\ninitial = 0.25, -1 ; both\n"),
                                         &error),
             qPrintable(error));
    QVERIFY(plant.reset());
    Pendulum expected{0.25, -1.0, 4.0};
    for (int i = 0; i < 100; ++i) {
        QVERIFY(plant.step());
        QVERIFY(std::abs(plant.get("pendulum.angle").toReal() - expected.angle) < 1e-12);
        expected.step(0.0);
    }
    QVERIFY(plant.node().readParameters(write("[parameters]\nlength = 2\ninitial = 0.5 0\n"), &error));  // for others
    QVERIFY(plant.reset());
    QCOMPARE(plant.get("pendulum.angle").toReal(), 0.5);
}

void tst_SimulinkNodes::wrongParametersAreRefusedWithTheirLine()
{
    QTemporaryDir folder;
    QFile file(folder.filePath("p.ini"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("[parameters]\nlenght = 4\ninitial = 1\nlength = long\nturns = 1.5\n");
    file.close();
    Plant plant(make_pendulum_node_test());
    QString error;
    QVERIFY(!plant.node().readParameters(file.fileName(), &error));
    const QStringList lines = error.split('\n', Qt::SkipEmptyParts);
    QCOMPARE(lines.size(), 4);
    QVERIFY(lines.at(0).contains(":2:") && lines.at(0).contains("no parameter 'lenght'; did you mean 'length'?"));
    QVERIFY(lines.at(1).contains(":3:") && lines.at(1).contains("has 2 numbers in the model and 1 here"));
    QVERIFY(lines.at(2).contains(":4:")
            && lines.at(2).contains("'long' of parameter 'length' is not a list of numbers"));
    QVERIFY(lines.at(3).contains(":5:") && lines.at(3).contains("the type of parameter 'turns' cannot hold 1.5"));
    QVERIFY(!plant.node().readParameters("/none.ini", &error));
    QVERIFY(error.contains("/none.ini"));
}

void tst_SimulinkNodes::anErrorStatusStopsThePlantWithItsText()
{
    Plant plant(make_pendulum_node_test());
    QVERIFY(plant.reset());
    plant.set("pendulum.torque", QPlcValue(1000.0));
    int steps = 0;
    while (plant.step())
        QVERIFY(++steps < 1000);
    QCOMPARE(plant.fault(), QStringLiteral("the model reports: the pendulum has turned too often"));
    QVERIFY(plant.runtime().wantsSafeStop());
    QVERIFY(plant.reset());  // another phase begins anew
    plant.set("pendulum.torque", QPlcValue(0.0));
    plant.runtime().beginPhase(true);
    QVERIFY(plant.step());
}

void tst_SimulinkNodes::aStopRequestStopsThePlant()
{
    Plant plant(make_pendulum_node_test());
    QVERIFY(plant.reset());
    plant.set("pendulum.stop", QPlcValue(1));
    QVERIFY(!plant.step());
    QCOMPARE(plant.fault(), QStringLiteral("the model asks for the end of the simulation"));
    QVERIFY(plant.runtime().wantsSafeStop());
}

void tst_SimulinkNodes::theFinalTimeOfTheModelDoesNotEndIt()
{
    Plant plant(make_pendulum_node_test());
    QVERIFY(plant.reset());
    for (int i = 0; i < 300; ++i)
        QVERIFY(plant.step());  // the export ends after 1 s
}

void tst_SimulinkNodes::anotherPeriodIsAFault()
{
    Plant plant(make_pendulum_node_test());
    QVERIFY(plant.reset());
    QVERIFY(!plant.step(20ms));
    QCOMPARE(plant.fault(),
             QStringLiteral("the sample time of the model is 10 ms, and the period of the master is "
                            "20 ms; set the period of the master to 10 ms"));
}

void tst_SimulinkNodes::busesBecomeSignalsOfTheirLeaves()
{
    Plant plant(make_gearbox_node_test());
    QVERIFY2(plant.error().isEmpty(), qPrintable(plant.error()));
    QVERIFY(plant.reset());
    plant.set("engineSpeed", QPlcValue(-1600));  // renamed by MAP; fixed point
    plant.set("drive.shaft.torque", values({1.5f, -2.5f}));
    plant.set("drive.wheels.1.torque", values({3.0f, 4.0f}));
    plant.set("drive.wheels.0.speed", QPlcValue(7));
    QVERIFY(plant.step());
    QCOMPARE(plant.get("driveOut.shaft.speed").toInt(), -800);
    QCOMPARE(plant.get("driveOut.shaft.torque"), values({1.5f, -2.5f}));
    QCOMPARE(plant.get("driveOut.wheels.1.torque"), values({3.0f, 4.0f}));
    QCOMPARE(plant.get("driveOut.wheels.0.speed").toInt(), 7);
    QCOMPARE(plant.get("moving").toInt(), 1);
}

void tst_SimulinkNodes::matricesAreTransposed()
{
    Plant plant(make_gearbox_node_test());
    QVERIFY(plant.reset());
    plant.set("J_in", values({1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));  // row by row
    QVERIFY(plant.step());
    QCOMPARE(plant.get("J_out"), values({10.0, 20.0, 30.0, 4.0, 5.0, 6.0}));  // the model multiplies its first row
    QCOMPARE(plant.get("map"), values({1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));       // [2][3], row by row in the model, too
}

void tst_SimulinkNodes::enumsAndTruthValuesTravel()
{
    Plant plant(make_gearbox_node_test());
    QVERIFY(plant.reset());
    plant.set("gear_in", QPlcValue(-1));
    plant.set("locks_in", values({qint8(1), qint8(0), qint8(1)}));
    plant.set("drive.enabled", QPlcValue(1));
    QVERIFY(plant.step());
    QCOMPARE(plant.get("gear").toInt(), -1);
    QCOMPARE(plant.get("locks_out"), values({qint8(0), qint8(1), qint8(0)}));
    QCOMPARE(plant.get("driveOut.enabled").toInt(), 1);
}

void tst_SimulinkNodes::theTableHasTypesDescriptionsAndNamesOfValues()
{
    Plant plant(make_gearbox_node_test());
    const auto signal = [&plant](const char *name) { return plant.table().at(plant.table().indexOf(name)); };
    QCOMPARE(signal("engineSpeed").type.name(), QStringLiteral("Int16"));
    QCOMPARE(signal("engineSpeed").description, QStringLiteral("fixed point: 1/16 rad/s"));
    QCOMPARE(signal("drive.shaft.torque").type.name(), QStringLiteral("Real32[2]"));
    QCOMPARE(signal("J_in").type.name(), QStringLiteral("Real64[6]"));
    QCOMPARE(signal("J_in").description, QStringLiteral("inertia"));
    QCOMPARE(signal("drive.enabled").type.name(), QStringLiteral("Int8"));
    QCOMPARE(signal("locks_in").type.name(), QStringLiteral("Int8[3]"));
    QCOMPARE(signal("gear").type.name(), QStringLiteral("Int32"));
    QVERIFY(plant.node().table().contains("values = -1: Gear_Reverse, 0: Gear_Neutral, 1: Gear_First\n"));
    QVERIFY(plant.node().table().contains("[drive.enabled]\ntype = Bool\n"));
}

void tst_SimulinkNodes::reusableModelsHaveStatesOfTheirOwn()
{
    Plant one(make_gearbox_node_test()), two(make_gearbox_node_test());
    QVERIFY(one.reset() && two.reset());
    QVERIFY(one.step() && one.step() && two.step());
    QCOMPARE(one.get("count").toInt(), 8);  // the first count is 7
    QCOMPARE(two.get("count").toInt(), 7);
    QVERIFY(one.reset());  // the export does not set its state to zero itself
    QVERIFY(one.step());
    QCOMPARE(one.get("count").toInt(), 7);
}

void tst_SimulinkNodes::classesComputeAndReportErrors()
{
    Plant plant(make_counter_node_test());
    QVERIFY2(plant.error().isEmpty(), qPrintable(plant.error()));
    QVERIFY(plant.reset());
    QCOMPARE(plant.get("count").toInt(), 100);
    plant.set("increment", QPlcValue(400));
    QVERIFY(plant.step() && plant.step());
    QCOMPARE(plant.get("count").toInt(), 500);
    QVERIFY(!plant.step());
    QCOMPARE(plant.fault(), QStringLiteral("the model reports: counted too far"));
    QVERIFY(plant.reset());  // a new object: the constructor has set the count
    QCOMPARE(plant.get("count").toInt(), 100);
}

void tst_SimulinkNodes::classesWithAccessFunctionsCompute()
{
    Plant plant(make_servo_node_test());
    QVERIFY2(plant.error().isEmpty(), qPrintable(plant.error()));
    QVERIFY(plant.reset());
    QCOMPARE(plant.get("angle").toReal(), 0.25);
    plant.set("target", QPlcValue(1.25));
    QVERIFY(plant.step() && plant.step());
    QCOMPARE(plant.get("angle").toReal(), 0.75);
}

void tst_SimulinkNodes::outputAndUpdateMakeATwoPhaseNode()
{
    Plant plant(make_tank_node_test());
    QVERIFY2(plant.error().isEmpty(), qPrintable(plant.error()));
    QVERIFY(plant.node().isTwoPhase());
    QVERIFY(plant.reset());
    QCOMPARE(plant.get("level").toReal(), 2.0);
    plant.set("inflow", QPlcValue(1.0));
    QVERIFY(plant.step());
    QCOMPARE(plant.get("level").toReal(), 2.75);  // + inflow - level / 8
}

void tst_SimulinkNodes::stepsAllocateAndLockNothing()
{
    if (!ThreadCosts::areCounted())
        QSKIP("the sanitizer owns malloc", "");
    Plant pendulum(make_pendulum_node_test()), gearbox(make_gearbox_node_test()), counter(make_counter_node_test());
    QVERIFY(pendulum.reset() && gearbox.reset() && counter.reset());
    bool isComplete = true;
    ThreadCosts spent;
    std::uint64_t counted = 0;
    std::thread([&] {
        ThreadCosts::watchThisThread();
        delete new QObject;
        const ThreadCosts before = ThreadCosts::ofWatchedThreads();
        counted = before.allocations;
        for (int i = 0; i < 1000; ++i)
            isComplete = pendulum.step() && gearbox.step() && counter.step() && isComplete;
        spent = ThreadCosts::ofWatchedThreads() - before;
    }).join();
    QVERIFY(isComplete);
    QVERIFY(counted >= 1);  // the counter counts
    QCOMPARE(spent.allocations, std::uint64_t(0));
    QCOMPARE(spent.locks, std::uint64_t(0));
}

QTEST_GUILESS_MAIN(tst_SimulinkNodes)
#include "tst_SimulinkNodes.moc"
