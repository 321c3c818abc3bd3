// SPDX-License-Identifier: Apache-2.0
// What a test is told if it uses the simulator in a way that cannot work. This program starts
// itself for each mistake that ends a program.
#include <QtCore/QProcess>
#include <QtPlcTest>
#include <QtTest/QtTest>

#include <cstdlib>
#include <functional>
#include <map>

using namespace std::chrono_literals;

namespace {

class Winch : public QPlcCompactSlaveNode
{
public:
    Winch()
        : QPlcCompactSlaveNode(QStringLiteral("Winch"))
    {
    }
};

/// A simulator with a host for a master and one for a winch.
struct Plant
{
    QPlcSimulator &simulator;
    QPlcSimulatedHost masterHost{simulator, QStringLiteral("master")};
    QPlcSimulatedHost winchHost{simulator, QStringLiteral("winch")};
};

struct Mistake
{
    std::function<void(Plant &)> make;
    const char *sentence;
};

const std::map<QString, Mistake> mistakes{
    {"a node connects outside of call()",
     {[](Plant &plant) { plant.winchHost.start<Winch>()->connectToMaster(plant.masterHost.place()); },
      "connects or listens outside of QPlcSimulatedHost::call(), where there is no network; use it inside: "
      "host.call([&] { ... })"}},
    {"a master listens outside of call()",
     {[](Plant &plant) {
          auto *master = plant.masterHost.start<QPlcMasterNode>();
          master->setSignalTable(QPlcSignalTable::fromIni("[tetherLength]\ntype = Real64\n"));
          master->startServer(plant.masterHost.place());
      },
      "connects or listens outside of QPlcSimulatedHost::call()"}},
    {"a master is made outside of start()",
     {[](Plant &) { QPlcMasterNode master; },
      "a master is made outside of QPlcSimulatedHost::start(), where no host runs it; make it with "
      "host.start<QPlcMasterNode>()"}},
    {"the clock is set after start()",
     {[](Plant &plant) {
          plant.winchHost.start<Winch>();
          plant.winchHost.setClock(5s, 200);
      },
      "QPlcSimulatedHost::setClock(): the program of host 'winch' runs already; call setClock() before start()"}},
    {"runFor() gets a negative time",
     {[](Plant &plant) { plant.simulator.runFor(-5ns); },
      "QPlcSimulator::runFor(): the time is -5 ns; virtual time does not run back, use 0 or more"}},
    {"runUntil() gets a negative time",
     {[](Plant &plant) { plant.simulator.runUntil([] { return false; }, -1us); },
      "QPlcSimulator::runUntil(): the time is -1000 ns; virtual time does not run back, use 0 or more"}},
    {"a thread begins without a program",
     {[](Plant &plant) { plant.winchHost.startThread([] {}); },
      "QPlcSimulatedHost::startThread(): no program runs on host 'winch'; call start() before"}},
    {"program() is asked for another type",
     {[](Plant &plant) {
          plant.masterHost.start<QPlcMasterNode>();
          plant.masterHost.program<Winch>();
      },
      "the program of host 'master' is a QPlcMasterNode and no (anonymous namespace)::Winch; ask for "
      "program<QPlcMasterNode>()"}},
    {"program() is asked for a base",
     {[](Plant &plant) {
          plant.winchHost.start<Winch>();
          plant.winchHost.program<QPlcSlaveNode>();
      },
      "the program of host 'winch' is a (anonymous namespace)::Winch and no QPlcSlaveNode"}},
    {"a simulator gets too many hosts",
     {[](Plant &plant) {
          for (int i = 2; i <= 200; ++i)
              QPlcSimulatedHost(plant.simulator, QString::number(i));
      },
      "host '200' is too many, a simulator has 200"}},
    {"a road loses more than everything",
     {[](Plant &plant) {
          QPlcSimulatedRoad road;
          road.loss = 1.5;
          plant.simulator.setRoads(road);
      },
      "QPlcSimulatedRoad: loss is 1.5; use 0 to 1"}}};

void make(const Mistake &mistake)
{
    QPlcSimulator::run(1, [&](QPlcSimulator &simulator) {
        Plant plant{simulator};
        mistake.make(plant);
    });
}

}  // namespace

class tst_SimulatorMisuse : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void aMistakeEndsTheProgramWithASentence_data();
    void aMistakeEndsTheProgramWithASentence();
    void clockIsSetBetweenTwoStarts();
    void noTimeAndNoHostTooManyAreAllowed();
    void otherTransportOnASimulatedHostIsRefused_data();
    void otherTransportOnASimulatedHostIsRefused();
    void simulatedTransportOnTheMachineIsRefused();
    void unknownTransportNamesThoseOfTheHost();
    void invalidAddressSaysWhereItsReasonIs();
};

void tst_SimulatorMisuse::aMistakeEndsTheProgramWithASentence_data()
{
    QTest::addColumn<QString>("mistake");
    for (const auto &each : mistakes)
        QTest::newRow(qPrintable(each.first)) << each.first;
}

void tst_SimulatorMisuse::aMistakeEndsTheProgramWithASentence()
{
    QFETCH(QString, mistake);
    QProcess other;
    other.start(QCoreApplication::applicationFilePath(), {QStringLiteral("--mistake"), mistake});
    QVERIFY(other.waitForFinished(120'000));
    const QByteArray said = other.readAllStandardError();
    QVERIFY2(said.contains(mistakes.at(mistake).sentence), said.constData());
    QCOMPARE(other.exitStatus(), QProcess::CrashExit);
}

void tst_SimulatorMisuse::clockIsSetBetweenTwoStarts()
{
    QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
        Plant plant{simulator};
        plant.winchHost.start<Winch>();
        plant.winchHost.kill();
        plant.winchHost.setClock(5s, 200);
        QVERIFY(!plant.winchHost.program<QPlcMasterNode>());  // of any type: there is none
        plant.winchHost.start<Winch>();
        QVERIFY(plant.winchHost.program<Winch>());
    });
}

void tst_SimulatorMisuse::noTimeAndNoHostTooManyAreAllowed()
{
    QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
        Plant plant{simulator};
        for (int i = 2; i < 200; ++i)
            QPlcSimulatedHost(simulator, QString::number(i));
        simulator.runFor(0ns);
        QVERIFY(!simulator.runUntil([] { return false; }, 0ns));
        QCOMPARE(simulator.now(), 0ns);
    });
}

void tst_SimulatorMisuse::otherTransportOnASimulatedHostIsRefused_data()
{
    QTest::addColumn<QString>("scheme");
    QTest::newRow("tcp") << "tcp://";
    QTest::newRow("udp") << "udp://";
    QTest::newRow("no scheme") << "";
}

void tst_SimulatorMisuse::otherTransportOnASimulatedHostIsRefused()
{
    QFETCH(QString, scheme);
    QPlcSimulator::run(1, [&](QPlcSimulator &simulator) {
        Plant plant{simulator};
        auto *winch = plant.winchHost.start<Winch>();
        const auto master = QPlcUnderlyingProtocol::fromString(scheme + QStringLiteral("127.0.1.1:50000"));
        QTest::ignoreMessage(QtWarningMsg, QRegularExpression("this host has no transport"));
        plant.winchHost.call([&] { winch->connectToMaster(master); });
        QCOMPARE(winch->error(), QPlcSlaveNode::OptionError);
        QCOMPARE(winch->errorString(),
                 QStringLiteral("node 'Winch': this host has no transport %1://; use sim://, sim-stream:// or "
                                "sim-auto://")
                     .arg(master.kindName()));
    });
}

void tst_SimulatorMisuse::simulatedTransportOnTheMachineIsRefused()
{
    QPlcSimulator::run(1, [](QPlcSimulator &) {});  // makes the transport known
    Winch winch;
    QTest::ignoreMessage(QtWarningMsg, QRegularExpression("this host has no transport sim://; use tcp://, udp://"));
    winch.connectToMaster(QPlcUnderlyingProtocol::fromString(QStringLiteral("sim://127.0.1.1:50000")));
    QCOMPARE(winch.error(), QPlcSlaveNode::OptionError);
}

void tst_SimulatorMisuse::unknownTransportNamesThoseOfTheHost()
{
    QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
        Plant plant{simulator};
        QString error;
        plant.winchHost.call([&] {
            QPlcUnderlyingProtocol::fromString(QStringLiteral("simm://127.0.1.1"), QPlcUnderlyingProtocol::Automatic,
                                               &error);
        });
        QCOMPARE(error, QString("unknown transport 'simm://'; use sim://, sim-stream:// or sim-auto://"));
    });
}

void tst_SimulatorMisuse::invalidAddressSaysWhereItsReasonIs()
{
    Winch winch;
    QTest::ignoreMessage(QtWarningMsg, QRegularExpression("the address of the master is not valid"));
    winch.connectToMaster(QPlcUnderlyingProtocol::fromString(QStringLiteral("simm://127.0.1.1")));
    QCOMPARE(winch.error(), QPlcSlaveNode::OptionError);
    QVERIFY2(winch.errorString().contains(QStringLiteral("fromString(), which says why in its argument error")),
             qPrintable(winch.errorString()));
}

int main(int argc, char **argv)
{
    const QCoreApplication application(argc, argv);
    if (const QStringList arguments = QCoreApplication::arguments(); arguments.value(1) == QLatin1String("--mistake")) {
        make(mistakes.at(arguments.value(2)));
        return EXIT_SUCCESS;
    }
    tst_SimulatorMisuse test;
    return QTest::qExec(&test, argc, argv);
}

#include "tst_SimulatorMisuse.moc"
