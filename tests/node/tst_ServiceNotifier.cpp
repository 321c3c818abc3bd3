// SPDX-License-Identifier: Apache-2.0
#include "../common/NotifyListener.h"
#include "../common/Waiting.h"
#include "ScriptedMaster.h"

#include <QtCore/QSemaphore>

#include <memory>

using namespace std::chrono_literals;

namespace {

/// Hangs in cycle 3 until it may go on.
class HangingCounter : public CounterNode
{
public:
    HangingCounter()
    {
        onStep = [this](const QPlcCycle &cycle) {
            if (cycle.number() != 3)
                return;
            entered.release();
            goOn.acquire();
        };
    }
    QSemaphore entered, goOn;
};

}  // namespace

// What a service manager is told of a node or a master, and when its watchdog is fed. Looks are
// taken by hand: a minute is far away.
class tst_ServiceNotifier : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        QPlcSignalIndexTable::setCurrent({});
        m_listener = std::make_unique<NotifyListener>();
        QVERIFY(m_listener->isOpen());
        qputenv("NOTIFY_SOCKET", QFile::encodeName(m_listener->path()));
        qputenv("WATCHDOG_USEC", "60000000");
        qunsetenv("WATCHDOG_PID");
    }
    void cleanup()
    {
        for (const char *name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"})
            qunsetenv(name);
    }
    void noNotificationWithoutServiceManager();
    void missingServiceManagerIsReportedOnce();
    void readyIsNotifiedOnceWithTheState();
    void destructorNotifiesStopping();
    void stateChangesAreNotified();
    void theWatchdogOfAnotherProcessIsNotOurs();
    void timerFeedsTheWatchdogBeforeItsTimeout();
    void nodeFeedsTheWatchdogWithoutCycles();
    void nodeFeedsTheWatchdogWhileCyclesRun();
    void nodeWithHangingStepStopsFeedingTheWatchdog();
    void nodeFeedsTheWatchdogWhileTheMasterIsSilent();
    void masterFeedsTheWatchdogWhileCyclesRun();
    void masterWithHangingCycleStopsFeedingTheWatchdog();
    void longPeriodsAreNotTreatedAsHangs();
    void waitingLockstepIsNotTreatedAsHang();

private:
    /// Whether a look feeds the watchdog.
    bool feeds(QPlcServiceNotifier &service)
    {
        m_listener->take();
        service.look();
        return m_listener->take().contains("WATCHDOG=1");
    }
    std::unique_ptr<NotifyListener> m_listener;
};

void tst_ServiceNotifier::noNotificationWithoutServiceManager()
{
    qunsetenv("NOTIFY_SOCKET");
    CounterNode node;
    QPlcServiceNotifier service(node);
    QVERIFY(!service.isWanted());
    service.setReady();
    QVERIFY(!feeds(service));
}

void tst_ServiceNotifier::missingServiceManagerIsReportedOnce()
{
    qputenv("NOTIFY_SOCKET", "/nowhere/notify");
    CounterNode node;
    QPlcServiceNotifier service(node);
    QTest::ignoreMessage(QtWarningMsg, QRegularExpression("NOTIFY_SOCKET=/nowhere/notify: No such file or directory"));
    service.setReady();
    service.look();
}

void tst_ServiceNotifier::readyIsNotifiedOnceWithTheState()
{
    CounterNode node;
    QPlcServiceNotifier service(node);
    QVERIFY(service.isWanted());
    service.setReady();
    QCOMPARE(m_listener->take(), QStringList({"READY=1", "STATUS=Disconnected"}));
    service.setReady();
    QCOMPARE(m_listener->take(), QStringList());
}

void tst_ServiceNotifier::destructorNotifiesStopping()
{
    CounterNode node;
    {
        QPlcServiceNotifier service(node);
    }
    QCOMPARE(m_listener->take(), QStringList("STOPPING=1"));
}

void tst_ServiceNotifier::stateChangesAreNotified()
{
    TestMaster master;
    QPlcServiceNotifier service(master);
    CounterNode counter;
    EchoNode echo;
    QVERIFY(master.addLocalNode(&counter) && master.addLocalNode(&echo));
    QVERIFY(master.initializeAllStates());
    QVERIFY(master.waitForState(QPlcMasterNode::Ready));
    QVERIFY(m_listener->take().contains("STATUS=Ready, 2 nodes, port 0"));
}

void tst_ServiceNotifier::theWatchdogOfAnotherProcessIsNotOurs()
{
    CounterNode node;
    qputenv("WATCHDOG_PID", QByteArray::number(qint64(::getpid())));
    QCOMPARE(QPlcServiceNotifier(node).watchdogTime(), std::chrono::microseconds(60s));
    qputenv("WATCHDOG_PID", "1");
    QCOMPARE(QPlcServiceNotifier(node).watchdogTime(), 0us);
}

void tst_ServiceNotifier::timerFeedsTheWatchdogBeforeItsTimeout()
{
    qputenv("WATCHDOG_USEC", "40000");
    CounterNode node;
    QPlcServiceNotifier service(node);
    QVERIFY(m_listener->waitFor("WATCHDOG=1"));
    QVERIFY(m_listener->waitFor("WATCHDOG=1"));
}

void tst_ServiceNotifier::nodeFeedsTheWatchdogWithoutCycles()
{
    CounterNode node;
    QPlcServiceNotifier service(node);
    for (int i = 0; i < 3; ++i)
        QVERIFY(feeds(service));
}

void tst_ServiceNotifier::nodeFeedsTheWatchdogWhileCyclesRun()
{
    ScriptedMaster master;
    CounterNode node;
    QPlcServiceNotifier service(node);
    QVERIFY(master.admit(node, master.udp()));
    QVERIFY(master.start());
    for (quint64 k = 0; k < 3; ++k) {
        master.request(k);
        QVERIFY(master.waitForAnswers(int(k) + 1));
        QVERIFY(feeds(service));
    }
    m_listener->take();
    service.look();
    QCOMPARE(m_listener->take(), QStringList({"WATCHDOG=1", "STATUS=Real time, 3 cycles"}));
    node.disconnectFromMaster();
}

void tst_ServiceNotifier::nodeWithHangingStepStopsFeedingTheWatchdog()
{
    ScriptedMaster master;
    CounterNode node;
    QSemaphore entered, goOn;
    node.onStep = [&](const QPlcCycle &) {
        entered.release();
        goOn.acquire();
    };
    QPlcServiceNotifier service(node);
    QVERIFY(master.admit(node, master.udp()));
    QVERIFY(master.start());
    master.request(0);
    QVERIFY(entered.tryAcquire(1, 5000));
    QVERIFY(feeds(service));  // it may have begun just now
    QVERIFY(!feeds(service));
    QVERIFY(!feeds(service));
    goOn.release(100);
    QVERIFY(master.waitForAnswers(1));
    QVERIFY(feeds(service));
    node.disconnectFromMaster();
}

void tst_ServiceNotifier::nodeFeedsTheWatchdogWhileTheMasterIsSilent()
{
    ScriptedMaster master;
    CounterNode node;
    QPlcServiceNotifier service(node);
    QVERIFY(master.admit(node, master.udp()));
    QVERIFY(master.start());
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    for (int i = 0; i < 3; ++i)
        QVERIFY(feeds(service));
    node.disconnectFromMaster();
}

void tst_ServiceNotifier::masterFeedsTheWatchdogWhileCyclesRun()
{
    TestMaster master(QPlcClock::realTime());
    CounterNode counter;
    EchoNode echo;
    QPlcServiceNotifier service(master);
    QVERIFY(feeds(service));
    QVERIFY(master.addLocalNode(&counter) && master.addLocalNode(&echo));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    for (quint64 looks = 0; looks < 3; ++looks) {
        const quint64 seen = master.cycle();
        QTRY_VERIFY(master.cycle() > seen);
        QVERIFY(feeds(service));
    }
    master.stop();
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QVERIFY(feeds(service) && feeds(service));
}

void tst_ServiceNotifier::masterWithHangingCycleStopsFeedingTheWatchdog()
{
    TestMaster master(QPlcClock::realTime());
    master.setGapLimit(0s);
    HangingCounter counter;
    EchoNode echo;
    QPlcServiceNotifier service(master);
    QVERIFY(master.addLocalNode(&counter) && master.addLocalNode(&echo));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    QVERIFY(counter.entered.tryAcquire(1, 5000));
    QVERIFY(feeds(service));  // the last cycle may have ended just now
    QVERIFY(!feeds(service));
    QVERIFY(!feeds(service));
    counter.goOn.release();
    QTRY_VERIFY(master.cycle() > 3);
    QVERIFY(feeds(service));
    master.stop();
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
}

void tst_ServiceNotifier::longPeriodsAreNotTreatedAsHangs()
{
    qputenv("WATCHDOG_USEC", "40000000");  // a look in 10 s
    TestMaster master(QPlcClock::scaled(0.001));
    QVERIFY(master.setInterval(100ms));  // that last 100 s each
    CounterNode counter;
    EchoNode echo;
    QPlcServiceNotifier service(master);
    QVERIFY(master.addLocalNode(&counter) && master.addLocalNode(&echo));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    QVERIFY(master.waitForCycles(1));
    QTest::qWait(20);  // the cycle has ended, too
    constexpr int patience = 3 * 100 / 10;
    for (int i = 0; i <= patience; ++i)
        QVERIFY2(feeds(service), qPrintable(QString::number(i)));
    QVERIFY(!feeds(service));
    master.stop();
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
}

void tst_ServiceNotifier::waitingLockstepIsNotTreatedAsHang()
{
    TestMaster master;
    HangingCounter counter;
    EchoNode echo;
    QPlcServiceNotifier service(master);
    QVERIFY(master.addLocalNode(&counter) && master.addLocalNode(&echo));
    QVERIFY(master.startRealTime());
    QVERIFY(counter.entered.tryAcquire(1, 5000));
    QVERIFY(feeds(service) && feeds(service) && feeds(service));
    counter.goOn.release();
    master.stop();
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
}

QTEST_GUILESS_MAIN(tst_ServiceNotifier)
#include "tst_ServiceNotifier.moc"
