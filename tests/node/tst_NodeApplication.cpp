// SPDX-License-Identifier: Apache-2.0
#include "NodeFixtures.h"
#include "QPlcNodeApplication.h"

#include <QtCore/QTemporaryDir>
#include <QtNetwork/QTcpServer>
#include <QtTest/QtTest>

#include <csignal>
#include <stdexcept>
#include <unistd.h>

namespace {

/// What is written to the standard error stream while this object lives.
class StandardError
{
public:
    StandardError()
        : m_before(::dup(STDERR_FILENO))
        , m_file(std::tmpfile())
    {
        ::dup2(::fileno(m_file), STDERR_FILENO);
    }
    ~StandardError()
    {
        ::dup2(m_before, STDERR_FILENO);
        ::close(m_before);
        std::fclose(m_file);
    }
    Q_DISABLE_COPY(StandardError)
    QString text() const
    {
        QByteArray bytes(1 << 16, 0);
        bytes.resize(int(::pread(::fileno(m_file), bytes.data(), std::size_t(bytes.size()), 0)));
        return QString::fromUtf8(bytes);
    }

private:
    int m_before;
    std::FILE *m_file;
};

const char anyPort[] = "tcp://127.0.0.1:00000";

/// A command line, and the application that reads it.
class Program
{
public:
    explicit Program(const QStringList &arguments)
    {
        m_bytes << "winch";
        for (const QString &argument : arguments)
            m_bytes << argument.toUtf8();
        for (QByteArray &argument : m_bytes)
            m_pointers.push_back(argument.data());
        m_count = int(m_pointers.size());
        m_pointers.push_back(nullptr);
        application = std::make_unique<QPlcNodeApplication>(m_count, m_pointers.data());
    }
    std::unique_ptr<QPlcNodeApplication> application;

    /// Before the options are read: a port is known only when there is an application. The last
    /// argument is that of anyPort, and becomes the address of \a master.
    void setMaster(const TestMaster &master) { setMasterPort(master.serverPort()); }
    void setMasterPort(quint16 port)
    {
        const QString text = QStringLiteral("tcp://127.0.0.1:%1").arg(port, 5, 10, QLatin1Char('0'));
        Q_ASSERT(m_bytes.last().size() == text.size());
        std::copy_n(text.toLatin1().constData(), text.size(), m_pointers[std::size_t(m_count - 1)]);
    }

    /// What run() of a node class does. \return the exit code
    int run(QPlcSlaveNode &node)
    {
        return application->parseNodeOptions() ? application->run(node) : application->exitCode();
    }

private:
    QVector<QByteArray> m_bytes;
    std::vector<char *> m_pointers;
    int m_count = 0;
};

}  // namespace

// Options of a node's program, and how the program ends.
class tst_NodeApplication : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void eachOptionIsKnown_data();
    void eachOptionIsKnown();
    void whatCannotBeUsedIsToldAndEndsTheProgram_data();
    void whatCannotBeUsedIsToldAndEndsTheProgram();
    void optionsSetUpTheNode();
    void withoutOptionsTheNodeStaysAsItIs();
    void aSecuredNodeNeedsItsKeysOnly();
    void withoutAMasterItEndsAtOnce();
    void aSignalEndsItBeforeItsConnectionIsSettled_data();
    void aSignalEndsItBeforeItsConnectionIsSettled();
    void itEndsWithItsMaster();
    void itEndsWithItsMasterAlsoAfterAFault();
    void itStaysWithoutItsMaster();
    void aSignalTableThatCannotBeReadEndsTheProgram();
    void aManifestIsReadFromItsFile();
};

void tst_NodeApplication::eachOptionIsKnown_data()
{
    QTest::addColumn<QStringList>("arguments");
    for (const char *name :
         {"master", "signals", "name", "watchdog", "watchdog-reaction", "priority", "cpu", "spin-us", "idle-latency-us",
          "faults", "security", "keys", "certificate", "key", "authority", "identity"})
        QTest::newRow(name) << QStringList{"--" + QString(name), "7"};
    for (const char *name : {"critical", "stay", "same-cycle", "lock-memory", "enable-fault-injection"})
        QTest::newRow(name) << QStringList{"--" + QString(name)};
}

void tst_NodeApplication::eachOptionIsKnown()
{
    QFETCH(QStringList, arguments);
    Program program(arguments);
    const StandardError error;
    QVERIFY2(program.application->parseOptions(), qPrintable(error.text()));
    QVERIFY(program.application->isSet(arguments[0].mid(2)));
    QCOMPARE(program.application->value(arguments[0].mid(2)), arguments.value(1));
}

void tst_NodeApplication::whatCannotBeUsedIsToldAndEndsTheProgram_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("text");
    const auto row = [](const char *arguments, const char *text) {
        QTest::newRow(arguments) << QString(arguments).split(' ') << QString(text);
    };
    row("--watchdig 1", "unknown option '--watchdig' (see --help); did you mean");
    row("--name", "missing value after '--name' (see --help)\n");
    row("further", "unexpected argument 'further'; options begin with --, see --help");
    row("--master nowhere://x", "--master: ");
    row("--watchdog 3600.5", "--watchdog 3600.5: use a number of 0 ... 3600");
    row("--watchdog -1", "--watchdog -1: use a number of 0 ... 3600");
    row("--watchdog soon", "--watchdog soon: use a number of 0 ... 3600");
    row("--watchdog-reaction maybe", "--watchdog-reaction 'maybe': use report or safe-state");
    row("--priority 0", "--priority 0: use a whole number of 1 ... 99");
    row("--priority 100", "--priority 100: use a whole number of 1 ... 99");
    row("--cpu -1", "--cpu -1: use a whole number of 0 ... 1023");
    row("--spin-us 10001", "--spin-us 10001: use a whole number of 0 ... 10000");
    row("--idle-latency-us x", "--idle-latency-us x: use a whole number of 0 ... 1000000");
    row("--faults loss=5%", "--faults disturbs the plant on purpose; give --enable-fault-injection, too");
    row("--enable-fault-injection", "--enable-fault-injection alone does nothing");
    row("--enable-fault-injection --faults loss=x", "--faults ");
    row("--security none", "--security 'none': use psk or cert");
    row("--security psk", "--security psk needs --keys FILE");
    row("--security psk --keys /nonexistent", "/nonexistent");
    row("--security cert --key a --authority b", "--security cert needs --certificate FILE");
    row("--keys a", "--keys is for --security psk or --security cert");
    row("--identity a", "--identity is for --security psk or --security cert");
}

void tst_NodeApplication::whatCannotBeUsedIsToldAndEndsTheProgram()
{
    QFETCH(QStringList, arguments);
    QFETCH(QString, text);
    Program program(arguments);
    CounterNode node;
    const StandardError error;
    const int code = program.run(node);
    QCOMPARE(code, int(QPlcApplicationOptions::UsageError));
    QVERIFY2(error.text().startsWith("winch: ") && error.text().contains(text), qPrintable(error.text()));
    QCOMPARE(node.state(), QPlcSlaveNode::Disconnected);
}

void tst_NodeApplication::optionsSetUpTheNode()
{
    LogCapture log;
    Program program(QString("--master tcp://127.0.0.1:1 --name Drum --watchdog 0.25 "
                            "--critical --same-cycle --priority 12 --cpu 0 --spin-us 30 --idle-latency-us 0 "
                            "--lock-memory --enable-fault-injection --faults loss=5%")
                        .split(' '));
    CounterNode node;
    QCOMPARE(program.run(node), int(QPlcApplicationOptions::UsageError));  // there is no master
    QCOMPARE(node.name(), QString("Drum"));
    QCOMPARE(node.watchdog(), std::chrono::nanoseconds(std::chrono::milliseconds(250)));
    QVERIFY(node.isCritical());
    QVERIFY(node.isSameCycle());
    QCOMPARE(node.reconnectPolicy(), QPlcSlaveNode::ReconnectWhenLost);
    QCOMPARE(node.faultPlan(), QString("loss=5%"));
    const QPlcRealTimeOptions options = node.realTimeOptions();
    QCOMPARE(options.policy, QPlcRealTimeOptions::Fifo);
    QCOMPARE(options.priority, 12);
    QCOMPARE(options.cpu, 0);
    QCOMPARE(std::int64_t(options.spin), std::int64_t(30'000));
    QCOMPARE(options.idleLatency, 0);
    QVERIFY(options.lockMemory);
}

void tst_NodeApplication::withoutOptionsTheNodeStaysAsItIs()
{
    LogCapture log;
    Program program({"--master", "tcp://127.0.0.1:1"});
    CounterNode node;
    node.activateWatchdog(std::chrono::milliseconds(70));
    (void)program.run(node);
    QCOMPARE(node.name(), QString("Counter"));
    QCOMPARE(node.watchdog(), std::chrono::nanoseconds(std::chrono::milliseconds(70)));
    QVERIFY(!node.isCritical());
    QVERIFY(!node.isSameCycle());
    QCOMPARE(node.faultPlan(), QString());
    QVERIFY(!node.realTimeOptions().lockMemory);
}

void tst_NodeApplication::aSecuredNodeNeedsItsKeysOnly()
{
    LogCapture log;
    QTemporaryDir folder;
    QFile file(folder.filePath("keys.ini"));
    QVERIFY(file.open(QIODevice::WriteOnly)
            && file.write("[Counter]\nrole = Node\nkey = " + QByteArray(64, 'a') + "\n") > 0);
    file.close();
    QVERIFY(file.setPermissions(QFile::ReadOwner | QFile::WriteOwner));
    Program program({"--master", "tcp://127.0.0.1:1", "--security", "psk", "--keys", file.fileName()});
    CounterNode node;
    (void)program.run(node);
    QCOMPARE(node.error(), QPlcSlaveNode::ConnectionError);  // it has begun to connect
    QPlcSecurity::setCurrent({});
}

void tst_NodeApplication::withoutAMasterItEndsAtOnce()
{
    LogCapture log;
    Program program({"--master", "tcp://127.0.0.1:1"});
    CounterNode node;
    QCOMPARE(program.run(node), int(QPlcApplicationOptions::UsageError));
    QCOMPARE(node.error(), QPlcSlaveNode::ConnectionError);
}

void tst_NodeApplication::aSignalEndsItBeforeItsConnectionIsSettled_data()
{
    QTest::addColumn<int>("signal");
    QTest::newRow("SIGINT") << SIGINT;
    QTest::newRow("SIGTERM") << SIGTERM;
}

/// It is connected, and its master has not answered.
void tst_NodeApplication::aSignalEndsItBeforeItsConnectionIsSettled()
{
    QFETCH(int, signal);
    Program program({"--master", anyPort});
    QTcpServer silent;
    QVERIFY(silent.listen(QHostAddress::LocalHost));
    program.setMasterPort(silent.serverPort());
    QObject::connect(&silent, &QTcpServer::newConnection, [signal] { std::raise(signal); });
    CounterNode node;
    const StandardError error;
    QCOMPARE(program.run(node), int(QPlcApplicationOptions::Success));
    QCOMPARE(error.text(), QString());
    QCOMPARE(node.error(), QPlcSlaveNode::NoError);
    QCOMPARE(node.state(), QPlcSlaveNode::Disconnected);
}

void tst_NodeApplication::itEndsWithItsMaster()
{
    LogCapture log;
    Program program({"--master", anyPort});
    TestMaster master;
    QVERIFY(master.listen());
    program.setMaster(master);
    CounterNode node;
    QObject::connect(
        &node, &QPlcSlaveNode::connectedToMaster, &master, [&] { master.stopServer(); }, Qt::QueuedConnection);
    QCOMPARE(program.run(node), int(QPlcApplicationOptions::Success));
    QCOMPARE(node.state(), QPlcSlaveNode::Disconnected);
}

void tst_NodeApplication::itEndsWithItsMasterAlsoAfterAFault()
{
    LogCapture log;
    Program program({"--master", anyPort});
    TestMaster master;
    QVERIFY(master.listen());
    program.setMaster(master);
    CounterNode node;
    node.onStep = [](const QPlcCycle &) { throw std::runtime_error("the model is broken"); };
    QObject::connect(
        &node, &QPlcSlaveNode::connectedToMaster, &master, [&] { master.startRealTime(); }, Qt::QueuedConnection);
    QObject::connect(
        &node, &QPlcSlaveNode::errorOccurred, &master, [&] { master.stopServer(); }, Qt::QueuedConnection);
    QTimer::singleShot(20'000, program.application.get(), [] { QCoreApplication::exit(-1); });
    QCOMPARE(program.run(node), int(QPlcApplicationOptions::Success));
    QCOMPARE(node.error(), QPlcSlaveNode::UserCodeError);
}

void tst_NodeApplication::itStaysWithoutItsMaster()
{
    LogCapture log;
    Program program({"--master", "tcp://127.0.0.1:1", "--stay"});
    CounterNode node;
    QTimer::singleShot(100, program.application.get(), &QCoreApplication::quit);
    QCOMPARE(program.run(node), int(QPlcApplicationOptions::Success));
    QCOMPARE(node.reconnectPolicy(), QPlcSlaveNode::ReconnectAlways);
}

void tst_NodeApplication::aSignalTableThatCannotBeReadEndsTheProgram()
{
    QTemporaryDir folder;
    QFile file(folder.filePath("signals.ini"));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write("[speed]\ntype = Reel32\n") > 0);
    file.close();
    for (const bool isDefault : {false, true}) {
        Program program(isDefault ? QStringList() : QStringList{"--signals", file.fileName()});
        if (isDefault)
            program.application->setDefaultSignals(file.fileName());
        CounterNode node;
        const StandardError error;
        QCOMPARE(program.run(node), int(QPlcApplicationOptions::UsageError));
        QVERIFY2(error.text().contains("unknown type 'Reel32'"), qPrintable(error.text()));
    }
}

void tst_NodeApplication::aManifestIsReadFromItsFile()
{
    QTemporaryDir folder;
    QFile file(folder.filePath("manifest.ini"));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write("[Winch]\n") > 0);
    file.close();
    const auto nodesOf = [&](const QStringList &arguments) {
        Program program(arguments);
        program.application->addManifestOption();
        QPlcManifest manifest;
        return program.application->parseOptions() && program.application->readManifest(&manifest)
            ? manifest.nodes.size()
            : -1;
    };
    QCOMPARE(nodesOf({}), 0);
    QCOMPARE(nodesOf({"--manifest", file.fileName()}), 1);
    const StandardError error;
    QCOMPARE(nodesOf({"--manifest", "/nowhere/manifest.ini"}), -1);
    QVERIFY2(error.text().contains("/nowhere/manifest.ini: cannot open"), qPrintable(error.text()));
}

QTEST_APPLESS_MAIN(tst_NodeApplication)
#include "tst_NodeApplication.moc"
