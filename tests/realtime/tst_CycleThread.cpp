// SPDX-License-Identifier: Apache-2.0
#include "realtime/CycleThread.h"
#include "realtime/RealTimeSetup.h"

#include <QtCore/QProcess>
#include <QtTest/QtTest>

#include <csignal>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>

using qplc::CycleThread;
using qplc::Scheduling;

namespace {

struct Outcome
{
    int exitCode = -1;
    bool crashed = false;
    QString output;
    QString errors;
};

/// Runs \a command; a watchdog stands outside of chrt, where no real-time thread can starve it.
Outcome run(const QStringList &command)
{
    QProcess process;
    process.start(QStringLiteral("timeout"),
                  QStringList{QStringLiteral("-s"), QStringLiteral("KILL"), QStringLiteral("60")} + command);
    Outcome outcome;
    if (!process.waitForFinished(-1))
        return outcome;
    outcome.crashed = process.exitStatus() == QProcess::CrashExit;
    outcome.exitCode = process.exitCode();
    outcome.output = QString::fromLocal8Bit(process.readAllStandardOutput());
    outcome.errors = QString::fromLocal8Bit(process.readAllStandardError());
    return outcome;
}

Outcome probe(const QStringList &arguments, const QStringList &prefix = {})
{
    return run(prefix + QStringList{QStringLiteral(QTPLC_PROBE)} + arguments);
}

const QStringList &chrt()
{
    static const QStringList command{QStringLiteral("chrt"), QStringLiteral("-f"), QStringLiteral("49")};
    return command;
}

/// Why programs cannot be started by chrt here; empty when they can.
QByteArray chrtRefusal()
{
    const Outcome outcome = run(chrt() + QStringList{QStringLiteral("true")});
    return outcome.exitCode == 0
        ? QByteArray()
        : "not run: 'chrt -f 49 true' is refused here: " + outcome.errors.trimmed().toLocal8Bit();
}

QPlcRealTimeSetting setting(const QVector<QPlcRealTimeSetting> &settings, const char *name)
{
    for (const QPlcRealTimeSetting &setting : settings) {
        if (setting.name == QLatin1String(name))
            return setting;
    }
    return {};
}

/// Starts a thread with \a options whose body is \a body, and waits for its end.
template<typename Body>
QVector<QPlcRealTimeSetting> runThread(const QPlcRealTimeOptions &options, Body body)
{
    CycleThread thread;
    if (!thread.start(QStringLiteral("test"), options, body))
        qWarning("%s", qPrintable(thread.errorString()));
    thread.join();
    return thread.settings();
}

/// What all programs together want of the processors [us]; none: this one may not ask.
std::optional<qint32> wantedIdleLatency()
{
    QFile device(QStringLiteral("/dev/cpu_dma_latency"));
    qint32 value = 0;
    if (!device.open(QIODevice::ReadWrite | QIODevice::Unbuffered)
        || device.read(reinterpret_cast<char *>(&value), sizeof value) != sizeof value)
        return {};
    return value;
}

}  // namespace

class tst_CycleThread : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void bodyRunsOnceOnAThreadOfItsOwn();
    void threadCanBeStartedAgain();
    void destructorWaitsForTheBody();
    void secondStartIsRefusedWhileItRuns();
    void invalidOptionsAreRefusedBeforeThreadCreation();
    void missingBodyIsRefused();
    void nameIsCutAtAWholeCharacter_data();
    void nameIsCutAtAWholeCharacter();
    void signalsGoToTheMainThread();
    void defaultsInheritTheScheduling();
    void cpuIsReadBack();
    void absentCpuIsRefusedWithARemedy();
    void timerSlackIsReadBack();
    void stackIsResidentBeforeTheBody();
    void stackOfTheCallerIsNeverExceeded();
    void processorsStayAwakeWhileTheThreadRuns();
    void memoryLockIsReadBack();
    void chrtIsInherited();
    void optionsOverrideChrt();
    void fifoIsReadBack();
    void resetOnForkIsReported();
    void refusalsNameTheirRemedies();
    void exceptionOfTheBodyIsNotSilent();
};

void tst_CycleThread::bodyRunsOnceOnAThreadOfItsOwn()
{
    int runs = 0;
    pthread_t self{};
    CycleThread thread;
    QVERIFY(!thread.isRunning());
    QVERIFY(thread.start(QStringLiteral("body"), {}, [&] {
        ++runs;
        self = pthread_self();
    }));
    QVERIFY(thread.isRunning());
    thread.join();
    QVERIFY(!thread.isRunning());
    QCOMPARE(runs, 1);
    QVERIFY(!pthread_equal(self, pthread_self()));
    thread.join();  // does nothing
}

void tst_CycleThread::threadCanBeStartedAgain()
{
    CycleThread thread;
    int runs = 0;
    for (int i = 0; i < 50; ++i) {
        QVERIFY(thread.start(QStringLiteral("again"), {}, [&runs] { ++runs; }));
        QVERIFY(!thread.settings().isEmpty());
        thread.join();
    }
    QCOMPARE(runs, 50);
}

void tst_CycleThread::destructorWaitsForTheBody()
{
    std::atomic<bool> stop{false};
    bool ended = false;
    const auto held = std::make_shared<int>(0);
    {
        CycleThread thread;
        QVERIFY(thread.start(QStringLiteral("destructor"), {}, [&stop, &ended, held] {
            while (!stop)
                sched_yield();
            ended = true;
        }));
        stop = true;
    }
    QVERIFY(ended);
    QCOMPARE(held.use_count(), 1L);  // the body and what it held are gone
}

void tst_CycleThread::secondStartIsRefusedWhileItRuns()
{
    std::atomic<bool> stop{false};
    CycleThread thread;
    QVERIFY(thread.start(QStringLiteral("first"), {}, [&stop] {
        while (!stop)
            sched_yield();
    }));
    QVERIFY(!thread.start(QStringLiteral("second"), {}, [] {}));
    QCOMPARE(thread.errorString(), QStringLiteral("cycle thread 'first': runs already; join() it first"));
    QVERIFY(thread.isRunning());
    stop = true;
    thread.join();
    QVERIFY(thread.start(QStringLiteral("second"), {}, [] {}));
    QVERIFY(thread.errorString().isEmpty());
}

void tst_CycleThread::invalidOptionsAreRefusedBeforeThreadCreation()
{
    QPlcRealTimeOptions options;
    options.policy = QPlcRealTimeOptions::Fifo;
    options.priority = 120;
    bool ran = false;
    CycleThread thread;
    QVERIFY(!thread.start(QStringLiteral("winch"), options, [&ran] { ran = true; }));
    QCOMPARE(thread.errorString(), QStringLiteral("cycle thread 'winch': priority 120: use 1 ... 99"));
    QVERIFY(!thread.isRunning());
    QVERIFY(!ran);
}

void tst_CycleThread::missingBodyIsRefused()
{
    CycleThread thread;
    QVERIFY(!thread.start(QStringLiteral("winch"), {}, nullptr));
    QVERIFY(thread.errorString().contains(QLatin1String("no body")));
}

void tst_CycleThread::nameIsCutAtAWholeCharacter_data()
{
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("kernelName");
    QTest::newRow("empty") << QString() << QString();
    QTest::newRow("short") << QStringLiteral("Winch") << QStringLiteral("Winch");
    QTest::newRow("15") << QStringLiteral("123456789012345") << QStringLiteral("123456789012345");
    QTest::newRow("16") << QStringLiteral("1234567890123456") << QStringLiteral("123456789012345");
    QTest::newRow("cut inside a character") << QString::fromUtf8("12345678901234ä") << QStringLiteral("12345678901234");
}

void tst_CycleThread::nameIsCutAtAWholeCharacter()
{
    QFETCH(QString, name);
    char seen[16] = {};
    CycleThread thread;
    QVERIFY(thread.start(name, {}, [&seen] { pthread_getname_np(pthread_self(), seen, sizeof seen); }));
    thread.join();
    QTEST(QString::fromUtf8(seen), "kernelName");
}

void tst_CycleThread::signalsGoToTheMainThread()
{
    sigset_t before;
    sigset_t after;
    sigset_t seen;
    pthread_sigmask(SIG_SETMASK, nullptr, &before);
    runThread({}, [&seen] { pthread_sigmask(SIG_SETMASK, nullptr, &seen); });
    pthread_sigmask(SIG_SETMASK, nullptr, &after);
    for (const int blocked : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGCHLD, SIGALRM, SIGUSR1, SIGWINCH})
        QVERIFY2(sigismember(&seen, blocked) == 1, qPrintable(QString::number(blocked)));
    for (const int own : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS})
        QVERIFY2(sigismember(&seen, own) == 0, qPrintable(QString::number(own)));
    for (int signal = 1; signal < SIGRTMIN; ++signal)
        QCOMPARE(sigismember(&after, signal), sigismember(&before, signal));
}

void tst_CycleThread::defaultsInheritTheScheduling()
{
    const QVector<QPlcRealTimeSetting> settings = runThread({}, [] {});
    QCOMPARE(settings.size(), 2);
    QCOMPARE(settings.at(0).name, QStringLiteral("scheduling"));
    QCOMPARE(settings.at(0).wanted, Scheduling::current().toString() + QStringLiteral(" (inherited)"));
    QCOMPARE(settings.at(0).obtained, Scheduling::current().toString());
    QVERIFY(settings.at(0).granted);
    QVERIFY(settings.at(0).remedy.isEmpty());
    QCOMPARE(settings.at(1).name, QStringLiteral("stack"));
}

void tst_CycleThread::cpuIsReadBack()
{
    cpu_set_t allowed;
    sched_getaffinity(0, sizeof allowed, &allowed);
    int cpu = 0;
    while (!CPU_ISSET(cpu, &allowed))
        ++cpu;
    QPlcRealTimeOptions options;
    options.cpu = cpu;
    cpu_set_t seen;
    const auto cpuSetting = setting(runThread(options, [&seen] { sched_getaffinity(0, sizeof seen, &seen); }), "cpu");
    QVERIFY2(cpuSetting.granted, qPrintable(cpuSetting.toString()));
    QCOMPARE(cpuSetting.obtained, QString::number(cpu));
    QCOMPARE(CPU_COUNT(&seen), 1);
    QVERIFY(CPU_ISSET(cpu, &seen));
    sched_getaffinity(0, sizeof seen, &seen);
    QVERIFY(CPU_EQUAL(&seen, &allowed));  // the thread that starts it keeps its own
}

void tst_CycleThread::absentCpuIsRefusedWithARemedy()
{
    QPlcRealTimeOptions options;
    options.cpu = 1023;
    bool ran = false;
    const auto cpuSetting = setting(runThread(options, [&ran] { ran = true; }), "cpu");
    QVERIFY(ran);
    QVERIFY(!cpuSetting.granted);
    QCOMPARE(cpuSetting.wanted, QStringLiteral("1023"));
    QVERIFY2(cpuSetting.remedy.contains(QStringLiteral("processors %1;").arg(cpuSetting.obtained)),
             qPrintable(cpuSetting.remedy));
}

void tst_CycleThread::timerSlackIsReadBack()
{
    QPlcRealTimeOptions options;
    options.policy = QPlcRealTimeOptions::Other;
    options.timerSlack = 1234;
    int seen = 0;
    const auto slack
        = setting(runThread(options, [&seen] { seen = prctl(PR_GET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL); }), "timer slack");
    QVERIFY2(slack.granted, qPrintable(slack.toString()));
    QCOMPARE(slack.obtained, QStringLiteral("1234 ns"));
    QCOMPARE(seen, 1234);
}

void tst_CycleThread::stackIsResidentBeforeTheBody()
{
    for (const int size : {1, 4096, 64 * 1024, 20 * 1024 * 1024}) {  // the last is more than a thread usually has
        QPlcRealTimeOptions options;
        options.prefaultStack = size;
        const auto stack = setting(runThread(options, [] {}), "stack");
        QVERIFY2(stack.granted, qPrintable(stack.toString()));
        QCOMPARE(stack.obtained, QStringLiteral("%1 byte").arg(size));
    }
    QPlcRealTimeOptions none;
    none.prefaultStack = 0;
    QCOMPARE(setting(runThread(none, [] {}), "stack").name, QString());
}

void tst_CycleThread::stackOfTheCallerIsNeverExceeded()
{
    QVector<QPlcRealTimeSetting> settings;
    runThread({}, [&settings] {  // as a thread that was made by somebody else
        QPlcRealTimeOptions options;
        options.prefaultStack = 64 * 1024 * 1024;
        settings = qplc::applyRealTimeOptions(options);
    });
    const auto stack = setting(settings, "stack");
    rlimit limit{};
    getrlimit(RLIMIT_STACK, &limit);
    if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur > rlim_t(64) * 1024 * 1024)
        QSKIP("not judged: ulimit -s allows more than the largest prefaultStack here", "");
    QVERIFY(!stack.granted);
    QVERIFY2(stack.remedy.contains(QLatin1String("ulimit -s")), qPrintable(stack.remedy));
}

void tst_CycleThread::processorsStayAwakeWhileTheThreadRuns()
{
    const std::optional<qint32> before = wantedIdleLatency();
    QPlcRealTimeOptions options;
    options.idleLatency = 3;
    std::optional<qint32> meanwhile;
    const auto idle = setting(runThread(options, [&] { meanwhile = wantedIdleLatency(); }), "idle latency");
    QCOMPARE(idle.wanted, QStringLiteral("at most 3 µs"));
    if (!before) {
        QVERIFY(!idle.granted);
        QVERIFY2(idle.remedy.contains(QLatin1String("/dev/cpu_dma_latency")), qPrintable(idle.remedy));
        return;
    }
    QVERIFY2(idle.granted, qPrintable(idle.toString()));
    QVERIFY(meanwhile && *meanwhile <= 3);
    QCOMPARE(idle.obtained, QStringLiteral("%1 µs").arg(*meanwhile));
    QVERIFY(*before <= 3 || wantedIdleLatency() > 3);  // another program may wish for as much
    QCOMPARE(setting(runThread({}, [] {}), "idle latency").name, QString());
}

void tst_CycleThread::memoryLockIsReadBack()
{
    QPlcRealTimeOptions options;
    options.lockMemory = true;
    const auto lock = setting(runThread(options, [] {}), "locked memory");
    munlockall();
    QCOMPARE(lock.wanted, QStringLiteral("all"));
    QCOMPARE(lock.granted, lock.obtained.startsWith(QLatin1String("all (")));
    QCOMPARE(lock.granted, lock.remedy.isEmpty());
    if (!lock.granted)
        QSKIP(qPrintable(QStringLiteral("not granted here: ") + lock.toString()), "");
}

void tst_CycleThread::chrtIsInherited()
{
    const QByteArray refusal = chrtRefusal();
    if (!refusal.isEmpty())
        QSKIP(refusal.constData(), "");
    const Outcome outcome = probe({}, chrt());
    QCOMPARE(outcome.errors, QString());
    QVERIFY2(outcome.output.contains(
                 QLatin1String("granted scheduling: wanted SCHED_FIFO 49 (inherited), obtained SCHED_FIFO 49\n")),
             qPrintable(outcome.output));
    QVERIFY2(outcome.output.contains(QLatin1String("seen SCHED_FIFO 49\n")), qPrintable(outcome.output));
}

void tst_CycleThread::optionsOverrideChrt()
{
    const QByteArray refusal = chrtRefusal();
    if (!refusal.isEmpty())
        QSKIP(refusal.constData(), "");
    const Outcome fifo = probe({QStringLiteral("--fifo"), QStringLiteral("20")}, chrt());
    QVERIFY2(fifo.output.contains(QLatin1String("seen SCHED_FIFO 20\n")), qPrintable(fifo.output + fifo.errors));
    const Outcome other = probe({QStringLiteral("--other")}, chrt());
    QVERIFY2(other.output.contains(QLatin1String("seen SCHED_OTHER 0\n")), qPrintable(other.output + other.errors));
}

void tst_CycleThread::fifoIsReadBack()
{
    const QByteArray refusal = chrtRefusal();
    if (!refusal.isEmpty())
        QSKIP(refusal.constData(), "");
    const Outcome outcome = probe({QStringLiteral("--fifo"), QStringLiteral("1")});
    QVERIFY2(outcome.output.contains(QLatin1String("granted scheduling: wanted SCHED_FIFO 1, obtained SCHED_FIFO 1\n")),
             qPrintable(outcome.output + outcome.errors));
    QVERIFY2(outcome.output.contains(QLatin1String("seen SCHED_FIFO 1\n")), qPrintable(outcome.output));
}

void tst_CycleThread::resetOnForkIsReported()
{
    const QByteArray refusal = chrtRefusal();
    if (!refusal.isEmpty())
        QSKIP(refusal.constData(), "");
    const Outcome outcome = probe(
        {}, QStringList{QStringLiteral("chrt"), QStringLiteral("-R"), QStringLiteral("-f"), QStringLiteral("49")});
    QVERIFY2(outcome.output.contains(QLatin1String("refused scheduling: wanted SCHED_FIFO 49 (inherited), obtained "
                                                   "SCHED_OTHER 0; cure: start the program by chrt without")),
             qPrintable(outcome.output + outcome.errors));
}

void tst_CycleThread::refusalsNameTheirRemedies()
{
    const Outcome outcome
        = probe({QStringLiteral("--drop"), QStringLiteral("--fifo"), QStringLiteral("49"), QStringLiteral("--lock")});
    QCOMPARE(outcome.exitCode, 0);
    const QStringList expected{
        QStringLiteral(
            "refused scheduling: wanted SCHED_FIFO 49, obtained SCHED_OTHER 0; cure: sudo setcap cap_sys_nice+ep '%1'")
            .arg(QStringLiteral(QTPLC_PROBE)),
        QStringLiteral("'* - rtprio 49' to /etc/security/limits.d"),
        QStringLiteral("(ulimit -r is 0 now)"),
        QStringLiteral("sudo chrt -f 49 '%1'").arg(QStringLiteral(QTPLC_PROBE)),
        QStringLiteral("refused locked memory: wanted all, obtained 0 KiB; cure: "),
        QStringLiteral("seen SCHED_OTHER 0")};
    for (const QString &text : expected)
        QVERIFY2(outcome.output.contains(text),
                 qPrintable(text + QStringLiteral(" is missing in ") + outcome.output + outcome.errors));
}

void tst_CycleThread::exceptionOfTheBodyIsNotSilent()
{
    const Outcome outcome = probe({QStringLiteral("--throw")});
    QVERIFY(outcome.crashed || outcome.exitCode != 0);
    QVERIFY2(outcome.errors.contains(QLatin1String("body of the probe threw")), qPrintable(outcome.errors));
}

QTEST_GUILESS_MAIN(tst_CycleThread)
#include "tst_CycleThread.moc"
