// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "recording/OutputFile.h"
#include "recording/ReportDrawing.h"
#include "tools/CampaignPrograms.h"
#include "tools/CampaignReport.h"

#include <QtTest/QtTest>

#include <csignal>
#include <sched.h>
#include <sys/resource.h>

using namespace std::chrono_literals;
using tools::CampaignProgram;
using tools::CampaignReport;
using tools::CampaignResult;
using tools::cyclictestResult;

class tst_Campaign : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void histogramOfCyclictestIsRead();
    void otherOutputHasNoValues_data();
    void otherOutputHasNoValues();
    void programEndsWithAllThatItHasStarted_data();
    void programEndsWithAllThatItHasStarted();
    void programSaysHowItHasEnded();
    void outputOfAProgramIsKeptUpToALimit();
    void programHasOrdinaryScheduling();
    void everyCaseIsALineOfNumbers();
    void pageEscapesWhatIsFound();
    void countsOfAHistogramAreInsideOfIt();
    void bordersOfAHistogramHaveRoom_data();
    void bordersOfAHistogramHaveRoom();
    void computerIsNamedByItsModel();
    void fileSaysWhyItCannotBeWritten_data();
    void fileSaysWhyItCannotBeWritten();
};

void tst_Campaign::histogramOfCyclictestIsRead()
{
    const QPlcDistribution read = cyclictestResult(
        "# Histogram\n000000 000000\n000003 000097\n000010 000002\n# Total: 000000099\n# Min Latencies: 00003\n"
        "# Max Latencies: 04900\n# Histogram Overflows: 00001\n# Thread 0: 00042\n\n");
    QCOMPARE(read.count, quint64(100));
    QCOMPARE(read.minimum, qint64(3'000));
    QCOMPARE(read.p50, qint64(3'000));
    QCOMPARE(read.p99, qint64(10'000));
    QCOMPARE(read.p999, qint64(4'900'000));
    QCOMPARE(read.maximum, qint64(4'900'000));
    QCOMPARE(read.bins.size(), 3);
}

void tst_Campaign::otherOutputHasNoValues_data()
{
    QTest::addColumn<QByteArray>("output");
    QTest::newRow("nothing") << QByteArray();
    QTest::newRow("a refusal") << QByteArray("Unable to change scheduling policy!\nprobably missing capabilities\n");
    QTest::newRow("no cycles") << QByteArray("# Histogram\n000000 000000\n# Max Latencies: 00000\n");
}

void tst_Campaign::otherOutputHasNoValues()
{
    QFETCH(QByteArray, output);
    QCOMPARE(cyclictestResult(output).count, quint64(0));
}

void tst_Campaign::programEndsWithAllThatItHasStarted_data()
{
    QTest::addColumn<QString>("command");
    QTest::newRow("while it runs") << "sleep 1000 & echo $! > '%1'; wait";
    QTest::newRow("after it has ended") << "sleep 1000 & echo $! > '%1'";
    QTest::newRow("although it ignores SIGTERM") << "trap '' TERM; sleep 1000 & echo $! > '%1'; while :; do wait; done";
}

void tst_Campaign::programEndsWithAllThatItHasStarted()
{
    QFETCH(QString, command);
    QTemporaryDir folder;
    const QString file = folder.filePath("pid");
    {
        CampaignProgram program(command.arg(file));
        QTRY_VERIFY(QFileInfo(file).size() > 0);
    }
    QFile pid(file);
    QVERIFY(pid.open(QIODevice::ReadOnly));
    const QString process = QString("/proc/%1/stat").arg(QString::fromUtf8(pid.readAll()).trimmed());
    const auto isGone = [&process] {  // or is a zombie that nobody has asked for
        QFile stat(process);
        return !stat.open(QIODevice::ReadOnly) || stat.readAll().contains(") Z");
    };
    QTRY_VERIFY(isGone());
}

void tst_Campaign::programSaysHowItHasEnded()
{
    CampaignProgram program("echo out; read _; echo no room >&2; exit 3");  // there is nothing to read
    QTRY_VERIFY(!program.isRunning());
    QCOMPARE(program.output(), QByteArray("out\n"));
    QCOMPARE(program.endText(), QString("exit code 3: no room"));
    CampaignProgram killed("kill -KILL $$");
    QTRY_COMPARE(killed.endText(), QString("it was killed"));
    CampaignProgram running("exec sleep 1000");
    QVERIFY(running.isRunning());
    QCOMPARE(running.endText(), QString());
}

void tst_Campaign::outputOfAProgramIsKeptUpToALimit()
{
    CampaignProgram program("head -c 3000000 /dev/zero");
    QTRY_VERIFY(!program.isRunning());
    QCOMPARE(program.output().size(), 1 << 20);
}

void tst_Campaign::programHasOrdinaryScheduling()
{
    const sched_param realTime{1};
    if (::sched_setscheduler(0, SCHED_FIFO, &realTime) != 0)
        QSKIP("SCHED_FIFO is refused: run it as root, or with 'ulimit -r' of at least 1");
    CampaignProgram program("cut -d ' ' -f 41 /proc/$$/stat");  // the policy
    const sched_param ordinary{};
    QCOMPARE(::sched_setscheduler(0, SCHED_OTHER, &ordinary), 0);
    QTRY_VERIFY(!program.isRunning());
    QCOMPARE(program.output(), QByteArray("0\n"));
}

void tst_Campaign::everyCaseIsALineOfNumbers()
{
    CampaignReport report({}, {});
    CampaignResult result;
    result.of = {"udp", 1ms, true, "cpu"};
    result.scheduling = "SCHED_FIFO 49";
    result.plant.cycles = 1000;
    result.plant.lateness.sinceStart.count = 1000;
    result.plant.lateness.sinceStart.p50 = 12'300;
    result.plant.lateness.sinceStart.maximum = 900'000;
    QPlcWorstCycle worst;
    worst.lateness = 500'000;
    worst.skipped = 2;
    result.plant.worst = {worst};
    result.plant.lateness.sinceStart.bins = {{12'300, 1000}};
    result.notes = QStringList{"locked memory was refused", "the load has ended early: exit code 3: \"no room\""};
    report.add(result);
    const QList<QByteArray> lines = report.csv().split('\n');
    QCOMPARE(lines.size(), 3);  // the last one is empty
    QCOMPARE(lines[0].count(','), 23);
    QVERIFY2(lines[1].startsWith("udp,1000.0,fifo,SCHED_FIFO 49,cpu,3,1000,0,0,0,12.3,0.0,0.0,900.0,2500.0,"),
             lines[1]);
    QVERIFY2(
        lines[1].endsWith(",\"locked memory was refused; the load has ended early: exit code 3: \"\"no room\"\"\""),
        lines[1]);
    QCOMPARE(report.histogramCsv().split('\n').at(1), QByteArray("udp,1000.0,fifo,cpu,lateness,12.3,1000"));
}

void tst_Campaign::pageEscapesWhatIsFound()
{
    CampaignReport report({}, {{"kernel", "6.1 <script>"}, {"computer", "A & \"B\""}});
    const QByteArray page = report.html();
    QVERIFY(page.startsWith("<!DOCTYPE html>"));
    QVERIFY(page.contains("6.1 &lt;script&gt;") && page.contains("A &amp; &quot;B&quot;"));
    QVERIFY(!page.contains("<script>"));
    QCOMPARE(report.computerCsv(),
             QByteArray("what,found\n\"kernel\",\"6.1 <script>\"\n\"computer\",\"A & \"\"B\"\"\"\n"));
}

void tst_Campaign::countsOfAHistogramAreInsideOfIt()
{
    qplc::LatenessHistogram histogram;
    histogram.add(50'000, 1'000'000);
    histogram.add(500'000);
    const QString drawing = QString::fromUtf8(qplc::drawingOf(histogram));
    auto texts = QRegularExpression("<text x=\"[^\"]+\" y=\"([^\"]+)\"[^>]*>1000000</text>").globalMatch(drawing);
    QVERIFY2(texts.hasNext(), qPrintable(drawing));
    QVERIFY2(texts.next().captured(1).toDouble() >= 14.0, qPrintable(drawing));  // the height of the digits
}

void tst_Campaign::bordersOfAHistogramHaveRoom_data()
{
    QTest::addColumn<qint64>("least");
    QTest::addColumn<qint64>("most");
    QTest::newRow("one range") << qint64(500'000) << qint64(500'000);
    QTest::newRow("a first border right before a decade") << qint64(700) << qint64(3'000'000);
    QTest::newRow("a first border far before a decade") << qint64(200) << qint64(3'000'000);
    QTest::newRow("a decade that begins at the right edge") << qint64(700) << qint64(10'000'000);
    QTest::newRow("all ranges") << qint64(100) << qint64(9'000'000'000);
}

void tst_Campaign::bordersOfAHistogramHaveRoom()
{
    QFETCH(qint64, least);
    QFETCH(qint64, most);
    qplc::LatenessHistogram histogram;
    histogram.add(least);
    histogram.add(most);
    const QString drawing = QString::fromUtf8(qplc::drawingOf(histogram));
    auto texts = QRegularExpression("<text x=\"([^\"]+)\"[^>]* text-anchor=\"(\\w+)\">[^<]* [mun]?s</text>")
                     .globalMatch(drawing);
    QVERIFY2(texts.hasNext(), qPrintable(drawing));
    constexpr double width = 62.0;  // of "0.631 us", the longest one
    double end = 0.0;
    while (texts.hasNext()) {
        const QRegularExpressionMatch text = texts.next();
        const double begin = text.captured(1).toDouble() - (text.captured(2) == "end" ? width : 0.0);
        QVERIFY2(begin >= end, qPrintable(drawing));
        end = begin + width;
    }
    QVERIFY2(end <= 720.0, qPrintable(drawing));
}

void tst_Campaign::computerIsNamedByItsModel()
{
    QTemporaryDir root;
    QDir(root.path()).mkpath("proc/device-tree");
    const auto write = [&](const char *path, const QByteArray &text) {
        QFile file(root.filePath(path));
        file.open(QIODevice::WriteOnly);
        file.write(text);
    };
    write("proc/cpuinfo", "processor : 0\nmodel name : A Fast One\nflags : fpu hypervisor sse\n");
    write("proc/meminfo", "MemTotal:  1024 kB\n");
    write("proc/loadavg", "0.12 1.50 2.00 1/321 4711\n");
    write("proc/cmdline", "root=UUID=1-2 isolcpus=2,3 ro user=anna idle=poll\n");
    const auto found = [&](const QString &what) {
        for (const tools::CampaignFact &fact : tools::computerFacts(root.path())) {
            if (fact.what == what)
                return fact.found;
        }
        return QString();
    };
    QCOMPARE(found("computer"), QString("A Fast One"));
    QCOMPARE(found("memory"), QString("1024 kB"));
    QCOMPARE(found("virtual machine"), QString("yes"));
    QCOMPARE(found("load average before"), QString("0.12"));
    QCOMPARE(found("kernel parameters"), QString("isolcpus=2,3 idle=poll"));
    QVERIFY(!found("governor").isEmpty());  // as qtplc doctor
    write("proc/device-tree/model", QByteArray("Raspberry Pi 4 Model B\0", 23));
    QCOMPARE(found("computer"), QString("Raspberry Pi 4 Model B"));
}

void tst_Campaign::fileSaysWhyItCannotBeWritten_data()
{
    QTest::addColumn<int>("size");
    QTest::newRow("when it is flushed") << 6'000;
    QTest::newRow("at once") << 100'000;
}

void tst_Campaign::fileSaysWhyItCannotBeWritten()
{
    QFETCH(int, size);
    QTemporaryDir folder;
    qplc::OutputFile file(folder.filePath("campaign.csv"), qplc::OutputFile::Replace);
    QString error;
    QVERIFY(file.open(&error));
    rlimit before{};
    QCOMPARE(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto usual = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{4096, before.rlim_max};  // takes a part, as a disk that becomes full
    QCOMPARE(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const bool isWritten = file.write(QByteArray(size, '1'), &error) && file.commit(&error);
    QCOMPARE(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, usual);
    QVERIFY(!isWritten);
    QVERIFY2(error.endsWith("campaign.csv': " + qt_error_string(EFBIG)), qPrintable(error));
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files), QStringList());
}

QTEST_GUILESS_MAIN(tst_Campaign)
#include "tst_Campaign.moc"
