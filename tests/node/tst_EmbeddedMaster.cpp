// SPDX-License-Identifier: Apache-2.0
#include "QPlcEmbeddedMaster.h"

#include <QtPlcCore>

#include <QtCore/QDir>
#include <QtTest/QTest>

#include <atomic>
#include <clocale>
#include <csignal>
#include <stdexcept>
#include <thread>

using StepResult = QPlcMasterNode::StepResult;
using namespace std::chrono_literals;

// A master in a program without an application of Qt: this test has none.
class tst_EmbeddedMaster : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void programExchangesValuesByPorts();
    void localAndRemoteNodesGiveTheSameBits_data();
    void localAndRemoteNodesGiveTheSameBits();
    void severalPeriodsAreSeveralCycles();
    void startNamesMissingNodes();
    void startThatFailsSaysWhy();
    void initializeShowsAndTakesInitialValues_data();
    void initializeShowsAndTakesInitialValues();
    void initializeNamesMissingNodes();
    void startAfterAStopBeginsAgain();
    void stopEndsTheStepOfAnotherThread();
    void exceptionOfACallIsAnError();
    void refusedNodeIsNull();
    void objectsComeAndGoWithoutATrace();
    void severalMastersRunAtOnce();
    void programKeepsItsLocaleAndSignals();
    void masterOfTheProgramMakesAnApplication();
};

namespace {

QPlcSignalTable smallTable()
{
    return QPlcSignalTable::fromIni(R"(
[command]
type = Real64
[measurement]
type = Real64
[count]
type = Int32
)");
}

class Command : public QPlcCompactSlaveNode
{
public:
    Command()
        : QPlcCompactSlaveNode("Command")
    {
    }
    QPlcOutput<double> value{this, "command"};

private:
    void step(const QPlcCycle &) override {}
};

class Measurement : public QPlcCompactSlaveNode
{
public:
    Measurement()
        : QPlcCompactSlaveNode("Measurement")
    {
    }
    QPlcInput<double> value{this, "measurement", QPlcInputTiming::SameCycle};

private:
    void step(const QPlcCycle &) override {}
};

class Sum : public QPlcCompactSlaveNode
{
public:
    explicit Sum(const QString &name = "Sum")
        : QPlcCompactSlaveNode(name)
    {
    }
    static inline std::atomic<bool> hangs{false};

private:
    QPlcInput<double> m_command{this, "command", QPlcInputTiming::SameCycle};
    QPlcOutput<double> m_measurement{this, "measurement"};
    QPlcOutput<int> m_count{this, "count"};

    void reset() override
    {
        m_measurement = 0.0;
        m_count = 0;
    }
    void step(const QPlcCycle &) override
    {
        while (hangs)
            std::this_thread::sleep_for(1ms);
        m_measurement = m_measurement + 0.1 * m_command;
        m_count = m_count + 1;
    }
};

/// A node with a thread and an event loop of its own, as a program has.
class RemoteNode
{
public:
    RemoteNode(const QPlcUnderlyingProtocol &master)
    {
        m_isConnected = m_owner.call([&](QPlcMasterNode &) {
            m_node = std::make_unique<Sum>();
            m_hasRegistered = m_node->connectToMasterAndWaitForConnected(master);
        });
    }
    ~RemoteNode()
    {
        m_owner.call([&](QPlcMasterNode &) { m_node.reset(); });
    }
    bool hasRegistered() const { return m_isConnected && m_hasRegistered; }

private:
    QPlcEmbeddedMaster m_owner;  // of a thread with an event loop
    std::unique_ptr<Sum> m_node;
    bool m_isConnected = false;
    bool m_hasRegistered = false;
};

int threads()
{
    return QDir("/proc/self/task").entryList(QDir::Dirs | QDir::NoDotAndDotDot).size();
}

quint16 listen(QPlcEmbeddedMaster &embedded)
{
    quint16 port = 0;
    embedded.call([&](QPlcMasterNode &master) {
        master.setSignalTable(smallTable());
        master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0));
        port = master.serverPort();
    });
    return port;
}

}  // namespace

void tst_EmbeddedMaster::programExchangesValuesByPorts()
{
    QVERIFY(!QCoreApplication::instance());
    QPlcEmbeddedMaster embedded;
    QVERIFY(listen(embedded) != 0);
    auto *command = embedded.addNode<Command>();
    auto *sum = embedded.addNode<Sum>();
    auto *measurement = embedded.addNode<Measurement>();
    QVERIFY2(command && sum && measurement, qPrintable(embedded.errorString()));
    QVERIFY2(embedded.start(10s), qPrintable(embedded.errorString()));
    double expected = 0.0;
    for (int cycle = 0; cycle < 10; ++cycle) {
        command->value = cycle;
        QCOMPARE(embedded.step(), StepResult::Complete);
        expected += 0.1 * cycle;
        QCOMPARE(double(measurement->value), expected);
    }
    embedded.stop();
    QCOMPARE(embedded.step(), StepResult::Stopped);
}

void tst_EmbeddedMaster::localAndRemoteNodesGiveTheSameBits_data()
{
    QTest::addColumn<QString>("transport");
    for (const char *transport : {"udp", "tcp", "local"})
        QTest::newRow(transport) << transport;
}

void tst_EmbeddedMaster::localAndRemoteNodesGiveTheSameBits()
{
    QFETCH(QString, transport);
    QVector<quint64> digests;
    for (const bool isRemote : {false, true}) {
        QPlcEmbeddedMaster embedded;
        const quint16 port = listen(embedded);
        auto *command = embedded.addNode<Command>();
        QVERIFY(command);
        std::unique_ptr<RemoteNode> remote;
        if (isRemote) {
            const QString address = transport == "local" ? QString("local://%1").arg(port)
                                                         : QString("%1://127.0.0.1:%2").arg(transport).arg(port);
            remote = std::make_unique<RemoteNode>(QPlcUnderlyingProtocol::fromString(address));
            QVERIFY(remote->hasRegistered());
        } else {
            QVERIFY(embedded.addNode<Sum>());
        }
        QVERIFY2(embedded.start(20s, {"Sum"}), qPrintable(embedded.errorString()));
        for (int cycle = 0; cycle < 200; ++cycle) {
            command->value = 0.01 * cycle;
            QCOMPARE(embedded.step(), StepResult::Complete);
        }
        embedded.call([&](QPlcMasterNode &master) { digests << master.statistics().imageDigest; });
        embedded.stop();
    }
    QCOMPARE(digests.at(0), digests.at(1));
}

void tst_EmbeddedMaster::severalPeriodsAreSeveralCycles()
{
    QPlcEmbeddedMaster embedded;
    listen(embedded);
    QVERIFY(embedded.addNode<Sum>());
    QVERIFY(embedded.start(10s));
    QCOMPARE(embedded.step(7), StepResult::Complete);
    int count = 0;
    embedded.call([&](QPlcMasterNode &master) { count = int(master.signalValue("count").toReal()); });
    QCOMPARE(count, 7);
}

void tst_EmbeddedMaster::startNamesMissingNodes()
{
    QPlcEmbeddedMaster embedded;
    const quint16 port = listen(embedded);
    QVERIFY(embedded.addNode<Sum>());
    QVERIFY(!embedded.start(50ms, {"Sum", "Winch", "Model"}));
    QVERIFY2(embedded.errorString().contains("'Winch', 'Model'"), qPrintable(embedded.errorString()));
    QVERIFY2(embedded.errorString().contains(QString::number(port)), qPrintable(embedded.errorString()));
    QCOMPARE(embedded.step(), StepResult::Stopped);
    QVERIFY(!embedded.start(0ms));
    QVERIFY2(embedded.errorString().contains("out of range"), qPrintable(embedded.errorString()));
}

void tst_EmbeddedMaster::startThatFailsSaysWhy()
{
    class Failing : public Sum
    {
        void initialized() override { throw std::runtime_error("no oil"); }
    };
    QPlcEmbeddedMaster embedded;
    listen(embedded);
    QVERIFY(embedded.addNode<Failing>());
    QVERIFY(!embedded.start(10s));
    QVERIFY2(embedded.errorString().contains("no oil"), qPrintable(embedded.errorString()));
    QCOMPARE(embedded.step(), StepResult::Stopped);
}

void tst_EmbeddedMaster::initializeShowsAndTakesInitialValues_data()
{
    QTest::addColumn<bool>("isArmed");
    QTest::newRow("a start") << false;
    QTest::newRow("a start that has to be armed") << true;
}

void tst_EmbeddedMaster::initializeShowsAndTakesInitialValues()
{
    class Beginning : public QPlcCompactSlaveNode
    {
    public:
        Beginning()
            : QPlcCompactSlaveNode("Beginning")
        {
        }

    private:
        QPlcInput<double> m_command{this, "command", QPlcInputTiming::SameCycle};
        QPlcOutput<double> m_measurement{this, "measurement"};
        double m_first = 0.0;
        void reset() override { m_measurement = 1.5; }
        void initialized() override { m_first = m_command; }
        void step(const QPlcCycle &) override { m_measurement = m_first; }
    };
    QFETCH(bool, isArmed);
    QPlcEmbeddedMaster embedded;
    listen(embedded);
    embedded.call([&](QPlcMasterNode &master) { master.setArmingRequired(isArmed); });
    auto *command = embedded.addNode<Command>();
    auto *measurement = embedded.addNode<Measurement>();
    QVERIFY(command && measurement && embedded.addNode<Beginning>());
    command->value = 4.0;
    QVERIFY2(embedded.initialize(10s), qPrintable(embedded.errorString()));
    QCOMPARE(double(measurement->value), 1.5);
    QCOMPARE(embedded.step(), StepResult::Stopped);
    command->value = 7.0;
    QVERIFY2(embedded.initialize(10s), qPrintable(embedded.errorString()));
    command->value = 9.0;  // too late: a start does not initialize again
    QVERIFY2(embedded.start(10s), qPrintable(embedded.errorString()));
    QCOMPARE(embedded.step(), StepResult::Complete);
    QCOMPARE(double(measurement->value), 7.0);
}

void tst_EmbeddedMaster::initializeNamesMissingNodes()
{
    QPlcEmbeddedMaster embedded;
    const quint16 port = listen(embedded);
    QVERIFY(!embedded.initialize(10ms, {"Winch", "Kite"}));
    for (const QString &word : {QString("initialize"), QString("'Winch', 'Kite'"), QString::number(port)})
        QVERIFY2(embedded.errorString().contains(word), qPrintable(embedded.errorString()));
    QVERIFY(!embedded.initialize(0ms));
    QVERIFY2(embedded.errorString().contains("out of range"), qPrintable(embedded.errorString()));
}

void tst_EmbeddedMaster::startAfterAStopBeginsAgain()
{
    QPlcEmbeddedMaster embedded;
    listen(embedded);
    QVERIFY(embedded.addNode<Sum>());
    QVector<quint64> digests;
    for (int phase = 0; phase < 2; ++phase) {
        QVERIFY(embedded.start(10s));
        QCOMPARE(embedded.step(20), StepResult::Complete);
        embedded.stop();
        embedded.call([&](QPlcMasterNode &master) { digests << master.statistics().imageDigest; });
    }
    QCOMPARE(digests.at(0), digests.at(1));
    embedded.call([](QPlcMasterNode &master) { master.setArmingRequired(true); });
    QVERIFY2(embedded.start(10s), qPrintable(embedded.errorString()));  // start() is both steps
    QCOMPARE(embedded.step(), StepResult::Complete);
    embedded.call([](QPlcMasterNode &master) { master.safeStop("test"); });
    QCOMPARE(embedded.step(5), StepResult::SafeStop);
}

void tst_EmbeddedMaster::stopEndsTheStepOfAnotherThread()
{
    QPlcEmbeddedMaster embedded;
    const quint16 port = listen(embedded);
    RemoteNode remote(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port));
    QVERIFY(remote.hasRegistered());
    embedded.call([](QPlcMasterNode &master) { master.setLongestWait(24h); });
    QVERIFY(embedded.start(20s, {"Sum"}));
    QCOMPARE(embedded.step(), StepResult::Complete);
    Sum::hangs = true;
    std::atomic<int> result{-1};
    std::thread host([&] { result = int(embedded.step()); });
    embedded.stop();
    host.join();
    Sum::hangs = false;
    QCOMPARE(StepResult(result.load()), StepResult::Stopped);
}

void tst_EmbeddedMaster::exceptionOfACallIsAnError()
{
    QPlcEmbeddedMaster embedded;
    QVERIFY(!embedded.call([](QPlcMasterNode &) { throw std::runtime_error("broken"); }));
    QVERIFY2(embedded.errorString().contains("broken"), qPrintable(embedded.errorString()));
    QVERIFY(embedded.call([](QPlcMasterNode &) {}));
}

void tst_EmbeddedMaster::refusedNodeIsNull()
{
    QPlcEmbeddedMaster embedded;
    listen(embedded);
    QVERIFY(embedded.addNode<Sum>());
    QVERIFY(!embedded.addNode<Sum>("Other"));  // writes the same signals
    QVERIFY2(embedded.errorString().contains("Other"), qPrintable(embedded.errorString()));
}

void tst_EmbeddedMaster::objectsComeAndGoWithoutATrace()
{
    const int before = threads();
    for (int i = 0; i < 20; ++i) {
        QPlcEmbeddedMaster embedded;
        QVERIFY(QCoreApplication::instance());
        listen(embedded);
        QVERIFY(embedded.addNode<Sum>());
        QVERIFY(embedded.start(10s));
        QCOMPARE(embedded.step(), StepResult::Complete);
        if (i % 2 == 0)
            embedded.call([](QPlcMasterNode &master) { master.safeStop("end"); });
    }
    QCOMPARE(threads(), before);
    QVERIFY(!QCoreApplication::instance());
}

void tst_EmbeddedMaster::severalMastersRunAtOnce()
{
    QPlcEmbeddedMaster first;
    QPlcEmbeddedMaster second;
    for (QPlcEmbeddedMaster *embedded : {&first, &second}) {
        QVERIFY(listen(*embedded) != 0);
        QVERIFY(embedded->addNode<Sum>());
        QVERIFY2(embedded->start(10s), qPrintable(embedded->errorString()));
    }
    QVector<quint64> cycles;
    QCOMPARE(first.step(3), StepResult::Complete);
    QCOMPARE(second.step(5), StepResult::Complete);
    QCOMPARE(first.step(3), StepResult::Complete);
    for (QPlcEmbeddedMaster *embedded : {&first, &second})
        embedded->call([&](QPlcMasterNode &master) { cycles << master.statistics().cycles; });
    QCOMPARE(cycles, (QVector<quint64>{6, 5}));
}

void tst_EmbeddedMaster::programKeepsItsLocaleAndSignals()
{
    std::setlocale(LC_ALL, "C");
    qputenv("LC_ALL", "C.UTF-8");
    struct sigaction before[NSIG];
    for (int signal = 1; signal < NSIG; ++signal)
        sigaction(signal, nullptr, &before[signal]);
    QPlcEmbeddedMaster embedded;
    const quint16 port = listen(embedded);
    RemoteNode remote(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port));
    QVERIFY(embedded.start(20s, {"Sum"}));
    QCOMPARE(embedded.step(), StepResult::Complete);
    QCOMPARE(std::setlocale(LC_ALL, nullptr), "C");
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGCHLD, SIGALRM, SIGUSR1, SIGUSR2, SIGPROF}) {
        struct sigaction now;
        sigaction(signal, nullptr, &now);
        QVERIFY2(now.sa_handler == before[signal].sa_handler, strsignal(signal));
    }
}

QStringList warnings;

void keepWarning(QtMsgType type, const QMessageLogContext &, const QString &text)
{
    if (type == QtWarningMsg || type == QtCriticalMsg)
        warnings << text;
}

/// A QPlcMasterNode whose clock the program turns, without a thread of its own.
void tst_EmbeddedMaster::masterOfTheProgramMakesAnApplication()
{
    QVERIFY(!QCoreApplication::instance());
    const QtMessageHandler former = qInstallMessageHandler(keepWarning);
    double measured = 0.0;
    bool hadApplication = false;
    {
        Command command;
        Sum sum;
        Measurement measurement;
        QPlcMasterNode master;
        master.setSignalTable(smallTable());
        master.setClock(QPlcClock::external());
        const bool hasBegun = master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0))
            && master.addLocalNode(&command) && master.addLocalNode(&sum) && master.addLocalNode(&measurement)
            && master.startRealTime();
        command.value = 10.0;
        for (int i = 0; hasBegun && i < 3; ++i)
            master.step();
        measured = measurement.value;
        hadApplication = QCoreApplication::instance() != nullptr;
        master.stop();
    }
    qInstallMessageHandler(former);
    QCOMPARE(warnings, QStringList());
    QCOMPARE(measured, 3.0);
    QVERIFY(hadApplication && !QCoreApplication::instance());
}

QTEST_APPLESS_MAIN(tst_EmbeddedMaster)
#include "tst_EmbeddedMaster.moc"
