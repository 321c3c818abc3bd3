// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "NodeFixtures.h"
#include "gui/panel/WindowContext.h"
#include "gui/window/ConnectStrip.h"
#include "gui/window/StateStepper.h"

#include <QtCore/QSettings>
#include <QtCore/QTemporaryDir>
#include <QtPlc>

using namespace qplc;

/// A panel of the program, as the keyboard controller of the thesis: it writes "setpoint" and looks
/// at "count".
class Operator : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("Operator"); }

    explicit Operator(QWidget *parent = nullptr)
        : QPlcWidget(parent)
    {
        QPlcSignalIndexList inputs;
        inputs.insert(QStringLiteral("count"));
        setInputSignalIndices(inputs);
        QPlcSignalIndexList outputs;
        outputs.insert(QStringLiteral("setpoint"));
        setOutputSignalIndices(outputs);
        setInitialOutputSignals(valueOf("setpoint", QPlcValue(1.5)));
    }
    QString kind() const override { return typeName(); }
    void write(double value) { Q_EMIT sendNewOutputSignals(valueOf("setpoint", QPlcValue(value))); }
    void realTimeout(const QList<QPlcSignalList> &signalValues) override
    {
        for (const QPlcSignalList &values : signalValues)
            counts.append(values.value(QStringLiteral("count")).toInt());
    }
    QVector<int> counts;
};
using OperatorFactory = QPlcWidgetFactoryOf<Operator>;

namespace {

/// The main program of listing 4.18, word by word where its words are wiring.
class ThesisProgram
{
public:
    ThesisProgram()
    {
        plcThread->start(QThread::TimeCriticalPriority);

        slaveNode = new QPlcIOBufferSlaveNode("ControlCenter", QPlcSlaveNode::SilentZeroOrderHold);
        slaveNode->moveToThread(plcThread);

        frameRateLimiter = new QPlcFrameRateLimiter(slaveNode);
        frameRateLimiter->setFrameRateLimit(50);

        controlCenter = new QPlcControlCenter;
        controlCenter->addAvailableWidget(QPlcWidget::registerFactory(new OperatorFactory));
        QString error;
        if (!controlCenter->addLayout(QStringLiteral("Operator"), layout(), &error))
            qFatal("%s", qPrintable(error));
        controlCenter->show();

        wire();

        slaveNode->setInputSignalIndices(controlCenter->inputSignalIndices());
        slaveNode->setOutputSignalIndices(controlCenter->outputSignalIndices());
        slaveNode->setInitialOutputSignals(controlCenter->initialOutputSignals());
    }

    ~ThesisProgram()
    {
        delete controlCenter;
        delete frameRateLimiter;
        QMetaObject::invokeMethod(slaveNode, &QObject::deleteLater);
        plcThread->quit();
        plcThread->wait();
        delete plcThread;
    }

    /// As a person does.
    bool connectTo(quint16 port) const
    {
        controlCenter->activateWindow();
        if (!QTest::qWaitForWindowActive(controlCenter))
            return false;
        QTest::keyClick(controlCenter, Qt::Key_O, Qt::ControlModifier);
        QTest::keyClicks(QApplication::focusWidget(), QStringLiteral("127.0.0.1:%1").arg(port));
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Return);
        return true;
    }
    Operator *panel() const { return controlCenter->findChild<Operator *>(); }

    QThread *plcThread = new QThread;
    QPlcIOBufferSlaveNode *slaveNode;
    QPlcFrameRateLimiter *frameRateLimiter;
    QPlcControlCenter *controlCenter;

private:
    static QByteArray layout()
    {
        return R"({"format": "QtPLC layout", "version": 1, "currentTab": "tab1", "windows": [],
                   "tabs": [{"id": "tab1", "name": "Operator", "tree": {"id": "panel1", "type": "Operator"}}]})";
    }

    void wire()
    {
        QObject::connect(frameRateLimiter, SIGNAL(timedOut(QList<QPlcSignalList>)), controlCenter,
                         SLOT(realTimeout(QList<QPlcSignalList>)));
        QObject::connect(controlCenter, SIGNAL(connectRequested(QPlcUnderlyingProtocol)), slaveNode,
                         SLOT(connectToMaster(QPlcUnderlyingProtocol)));
        QObject::connect(slaveNode, SIGNAL(connectedToMaster()), controlCenter, SLOT(connectedToMaster()));
        QObject::connect(slaveNode, SIGNAL(errorWithMaster(QPlcAbstractSocket::Error, QString)), controlCenter,
                         SLOT(errorWithMaster(QPlcAbstractSocket::Error, QString)));
        QObject::connect(controlCenter, SIGNAL(disconnectRequested()), slaveNode, SLOT(disconnectFromMaster()));
        QObject::connect(slaveNode, SIGNAL(disconnectedFromMaster()), controlCenter, SLOT(disconnectedFromMaster()));
        QObject::connect(controlCenter, SIGNAL(initialOutputSignalsChanged(QPlcSignalList)), slaveNode,
                         SLOT(setInitialOutputSignals(QPlcSignalList)));
        QObject::connect(slaveNode, SIGNAL(hasInitialized(QPlcSignalList)), controlCenter,
                         SLOT(initialize(QPlcSignalList)));
        QObject::connect(slaveNode, SIGNAL(realTimeHasStarted()), controlCenter, SLOT(started()));
        QObject::connect(slaveNode, SIGNAL(realTimeHasStopped()), controlCenter, SLOT(stopped()));
        QObject::connect(controlCenter, SIGNAL(inputSignalIndicesChanged(QPlcSignalIndexList)), slaveNode,
                         SLOT(setInputSignalIndices(QPlcSignalIndexList)));
        QObject::connect(controlCenter, SIGNAL(outputSignalIndicesChanged(QPlcSignalIndexList)), slaveNode,
                         SLOT(setOutputSignalIndices(QPlcSignalIndexList)));
        QObject::connect(controlCenter, SIGNAL(sendNewOutputSignals(QPlcSignalList)), slaveNode,
                         SLOT(setOutputSignals(QPlcSignalList)));
        QObject::connect(controlCenter, SIGNAL(sendMessage(QPlcMessage)), slaveNode,
                         SLOT(sendMessageToMaster(QPlcMessage)));
    }
};

}  // namespace

/// The program of the thesis against a master in this process.
class tst_ThesisWiring : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void wiringOfTheThesisWorks();
    void aRefusedConnectionIsSeenInTheWindow();
    void wiredPlantHasTheNameSetByItsProgram();
    void aTableThatIsReadLaterIsThatOfTheWiredPlant();
};

void tst_ThesisWiring::wiringOfTheThesisWorks()
{
    QTemporaryDir folder;
    QCoreApplication::setOrganizationName(QStringLiteral("QtPlcTest"));
    QSettings::setDefaultFormat(QSettings::IniFormat);
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder.path());
    CounterNode counter;  // outlives the master
    TestMaster master(QPlcClock::realTime());
    master.setInterval(std::chrono::milliseconds(10));
    QVERIFY(master.listen());
    QVERIFY(master.addLocalNode(&counter));
    QPlcSignalIndexTable::setCurrent(testTable());
    LogCapture log;
    ThesisProgram program;
    QVERIFY2(log.matching(QStringLiteral("QObject::connect")).isEmpty(), qPrintable(log.all().join(QLatin1Char('\n'))));
    QCOMPARE(program.controlCenter->inputSignalIndices().size(), testTable().size());
    QCOMPARE(program.controlCenter->outputSignalIndices().size(), 1);
    QVERIFY(program.controlCenter->isStartPageShown());

    // A person connects: the address goes to the node of the program.
    QVERIFY(program.connectTo(master.serverPort()));
    QTRY_COMPARE(program.controlCenter->plants().size(), 1);
    const QString plant = program.controlCenter->plants().constFirst();
    QCOMPARE(plant, QStringLiteral("127.0.0.1:%1").arg(master.serverPort()));  // as it was entered
    QVERIFY(program.controlCenter->isConnected(plant));
    QVERIFY(!program.controlCenter->isStartPageShown());
    QVERIFY(program.panel());

    // Nobody tells the node who writes a signal: the window does not say that nobody does.
    const auto *tree = program.controlCenter->findChild<QPlcSignalTree *>()->findChild<QTreeView *>();
    QVERIFY(tree->model()->rowCount(tree->model()->index(0, 0)) > 0);
    QVERIFY(
        tree->model()
            ->match(tree->model()->index(0, 0), Qt::DisplayRole, QStringLiteral("Not written"), 1, Qt::MatchRecursive)
            .isEmpty());

    // ... and starts: the command goes the same way. The values of before are old by now.
    QTest::qWait(700);
    QTest::keyClick(program.controlCenter, Qt::Key_F5);
    QTRY_COMPARE(master.state(), QPlcMasterNode::RealTime);
    QTRY_VERIFY(program.panel()->counts.size() > 50);
    const auto *stepper = program.controlCenter->findChild<StateStepper *>();
    QTRY_COMPARE(stepper->accessibleName(), QStringLiteral("State of the master: Real time"));
    const QVector<int> counts = program.panel()->counts;
    for (int i = 1; i < counts.size(); ++i)
        QVERIFY(counts[i] > counts[i - 1]);  // a busy machine misses cycles, and never tells one twice
    QCOMPARE(master.signalValue(QStringLiteral("setpoint")).toReal(), 1.5);
    program.panel()->write(-2.25);
    QTRY_COMPARE(master.signalValue(QStringLiteral("setpoint")).toReal(), -2.25);

    // STOP, and leave.
    QTest::keyClick(program.controlCenter, Qt::Key_Period, Qt::ControlModifier);
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QTest::keyClick(program.controlCenter, Qt::Key_D, Qt::ControlModifier);
    QTRY_VERIFY(!program.controlCenter->isConnected(plant));
    master.removeLocalNode(&counter);
}

void tst_ThesisWiring::aRefusedConnectionIsSeenInTheWindow()
{
    QPlcSignalIndexTable::setCurrent(testTable());
    quint16 port = 0;
    {
        TestMaster master;
        QVERIFY(master.listen());
        port = master.serverPort();
    }
    ThesisProgram program;
    QVERIFY(program.connectTo(port));
    const auto *strip = program.controlCenter->findChild<ConnectStrip *>();
    QTRY_VERIFY(strip->error().contains(QString::number(port)));
    QVERIFY(strip->isVisible());
    program.controlCenter->errorWithMaster(QPlcAbstractSocket::TimeoutError);
    QVERIFY2(strip->error().contains(QStringLiteral("TimeoutError")), qPrintable(strip->error()));
}

void tst_ThesisWiring::wiredPlantHasTheNameSetByItsProgram()
{
    QPlcSignalIndexTable::setCurrent(testTable());
    QPlcControlCenter nameless;
    nameless.connectedToMaster();
    QCOMPARE(nameless.plants(), QStringList{QStringLiteral("plant")});
    QPlcControlCenter window;
    window.setPlantName(QStringLiteral("winch"));
    window.connectedToMaster();
    window.connectedToMaster();
    QCOMPARE(window.plants(), QStringList{QStringLiteral("winch")});
}

void tst_ThesisWiring::aTableThatIsReadLaterIsThatOfTheWiredPlant()
{
    QPlcSignalIndexTable::setCurrent(testTable());
    QPlcControlCenter window;
    window.connectedToMaster();
    const Plant *plant = window.context()->plants()->selected();
    QVERIFY(plant->table().contains(QStringLiteral("count")));
    const QSignalSpy changed(&window, &QPlcControlCenter::inputSignalIndicesChanged);
    QPlcSignalIndexTable::setCurrent(QPlcSignalTable::fromIni("[speed]\ntype = Real64\n"));
    window.signalIndexTableChanged();
    QCOMPARE(changed.size(), 1);
    QCOMPARE(window.inputSignalIndices().size(), 1);
    QVERIFY(plant->table().contains(QStringLiteral("speed")));
    QPlcSignalIndexTable::setCurrent(testTable());
}

int main(int argc, char **argv)
{
    QPlcGuiApplication application(argc, argv);
    application.thread()->setPriority(QThread::LowestPriority);
    tst_ThesisWiring test;
    return QTest::qExec(&test, argc, argv);
}

#include "tst_ThesisWiring.moc"
