// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "../DriverBench.h"
#include "../FakeDevices.h"
#include "../conformance/GpioTestDevices.h"
#include "ThreadCosts.h"
#include "hardware/gpio/FakeGpioChip.h"
#include "hardware/gpio/GpioLineWords.h"

using namespace qplc;
using namespace std::chrono_literals;

namespace {

/// A board with 8 lines, and the driver that uses it.
struct Board
{
    explicit Board(const QByteArray &keys, const QString &kind = QStringLiteral("gpio"))
        : bench(kind, "device = fake:board\n" + keys)
    {
        QString error;
        if (!memory.create(QStringLiteral("fake:board"), 8, &error))
            qFatal("%s", qPrintable(error));
    }
    void pull(std::size_t line, bool isHigh) { memory.at(line) = isHigh ? FakeGpioChip::Pulled : 0; }
    /// 0 or 1; -1: it is no output.
    int driven(std::size_t line) const
    {
        const quint8 byte = memory.at(line);
        return byte & FakeGpioChip::IsOutput ? (byte & FakeGpioChip::Driven ? 1 : 0) : -1;
    }

    const FakeDevices devices;
    FakeMemory memory;
    DriverBench bench;
};

}  // namespace

class tst_GpioDriver : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void lineOptionsAreRead_data();
    void lineOptionsAreRead();
    void invalidLineOptionsAreReported_data();
    void invalidLineOptionsAreReported();
    void errorsOfAConfigurationHaveTheirLine();
    void anInputFollowsItsLine();
    void activeLowInvertsALine();
    void aTornWireHasTheLevelOfItsPullResistor();
    void aTornWireWithoutAResistorFloats();
    void aBounceIsNotSeen();
    void edgesAreCountedWithTheTimeOfTheLast();
    void onlyTheEdgesThatWereAskedForAreCounted();
    void outputIsNotDrivenUntilItHasAValue();
    void anOutputBeginsWithItsSafeValue();
    void anOutputThatIsKeptDoesNotGetItsSafeValue();
    void cycleAllocatesNothingAndLocksNothing();
    void anExpanderIsReadBesideTheCycle();
    void aMissingLineIsNamed();
    void unpluggedBoardIsReportedAndReconnects();
    void missingChipIsReportedWithARemedy();
    void edgesBetweenTwoCyclesAreCountedByTheKernel();
};

void tst_GpioDriver::lineOptionsAreRead_data()
{
    QTest::addColumn<bool>("isOutput");
    QTest::addColumn<QStringList>("words");
    QTest::addColumn<QString>("meaning");
    QTest::newRow("a number") << false << QStringList{"17"} << "17 pull 0 debounce 0 edges 3";
    QTest::newRow("a name") << false << QStringList{" GPIO17 ", "pull-up"} << "GPIO17 pull 2 debounce 0 edges 3";
    QTest::newRow("everything") << false << QStringList{"3", "Active-Low", "no-pull", "debounce  5 ms", "edges falling"}
                                << "3 active-low pull 1 debounce 5000000 edges 2";
    QTest::newRow("microseconds") << false << QStringList{"3", "pull-down", "debounce 1.5us", "edges rising"}
                                  << "3 pull 3 debounce 1500 edges 1";
    QTest::newRow("an output") << true << QStringList{"4", "open-drain", "active-low", "keep"}
                               << "4 active-low open-drain keep";
}

void tst_GpioDriver::lineOptionsAreRead()
{
    QFETCH(bool, isOutput);
    QFETCH(QStringList, words);
    GpioLineWords line;
    QCOMPARE(GpioLineWords::read(words, isOutput, &line), QString());
    QString meaning = line.request.line;
    if (line.request.isActiveLow)
        meaning += " active-low";
    if (line.request.isOpenDrain)
        meaning += " open-drain";
    if (line.isKept)
        meaning += " keep";
    if (!isOutput)
        meaning += QString(" pull %1 debounce %2 edges %3").arg(line.request.pull).arg(line.debounce).arg(line.edges);
    QTEST(meaning, "meaning");
    QCOMPARE(line.request.isOutput, isOutput);
}

void tst_GpioDriver::invalidLineOptionsAreReported_data()
{
    QTest::addColumn<bool>("isOutput");
    QTest::addColumn<QStringList>("words");
    QTest::addColumn<QString>("part");
    QTest::newRow("nothing") << false << QStringList{} << "the line is missing";
    QTest::newRow("misspelt") << false << QStringList{"1", "pullup"} << "'pullup' is not an option of an input";
    QTest::newRow("an output's") << false << QStringList{"1", "keep"} << "'keep' is not an option of an input";
    QTest::newRow("an input's") << true << QStringList{"1", "pull-up"} << "'pull-up' is not an option of an output";
    QTest::newRow("no unit") << false << QStringList{"1", "debounce 5"} << "'debounce 5'";
    QTest::newRow("too long") << false << QStringList{"1", "debounce 2 s"} << "at most 1 s";
    QTest::newRow("negative") << false << QStringList{"1", "debounce -1 ms"} << "'debounce -1 ms'";
}

void tst_GpioDriver::invalidLineOptionsAreReported()
{
    QFETCH(bool, isOutput);
    QFETCH(QStringList, words);
    QFETCH(QString, part);
    GpioLineWords line;
    const QString error = GpioLineWords::read(words, isOutput, &line);
    QVERIFY2(error.contains(part), qPrintable(error));
}

void tst_GpioDriver::errorsOfAConfigurationHaveTheirLine()
{
    const Board wrong("input.stop = 1, activelow\n");
    QVERIFY2(wrong.bench.errors().startsWith("bench.ini:4:") && wrong.bench.errors().contains("'activelow'"),
             qPrintable(wrong.bench.errors()));
    const Board empty("");
    QVERIFY2(empty.bench.errors().contains("no line of the chip is used"), qPrintable(empty.bench.errors()));
    const DriverBench nameless(QStringLiteral("gpio"), "input.a = 1\n");
    QVERIFY2(nameless.errors().contains("device = gpiochip0"), qPrintable(nameless.errors()));
}

void tst_GpioDriver::anInputFollowsItsLine()
{
    Board board("input.stop = 3\n");
    QCOMPARE(board.bench.wireRead("stop"), QString());
    board.pull(3, true);
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("stop"), 1.0);
    board.pull(3, false);
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("stop"), 0.0);
    QCOMPARE(board.driven(3), -1);
}

void tst_GpioDriver::activeLowInvertsALine()
{
    Board board("input.stop = 3, active-low\noutput.lamp = 4, active-low\n");
    QCOMPARE(board.bench.wireRead("stop") + board.bench.wireWrite("lamp"), QString());
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    board.bench.set("lamp", 1.0);
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("stop"), 1.0);
    QCOMPARE(board.driven(4), 0);
    board.pull(3, true);
    board.bench.set("lamp", 0.0);
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("stop"), 0.0);
    QCOMPARE(board.driven(4), 1);
}

void tst_GpioDriver::aTornWireHasTheLevelOfItsPullResistor()
{
    Board board("input.up = 3, pull-up\ninput.down = 4, pull-down\n");
    QCOMPARE(board.bench.wireRead("up") + board.bench.wireRead("down"), QString());
    board.memory.at(4) = FakeGpioChip::Pulled;
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("up"), 0.0);
    QCOMPARE(board.bench.value("down"), 1.0);
    board.memory.at(3) = FakeGpioChip::IsTorn;
    board.memory.at(4) = FakeGpioChip::Pulled | FakeGpioChip::IsTorn;
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("up"), 1.0);
    QCOMPARE(board.bench.value("down"), 0.0);
}

void tst_GpioDriver::aTornWireWithoutAResistorFloats()
{
    Board board("input.stop = 3, no-pull\n");
    QCOMPARE(board.bench.wireRead("stop"), QString());
    board.memory.at(3) = FakeGpioChip::IsTorn;
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    const double first = board.bench.value("stop");
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("stop"), 1.0 - first);
}

void tst_GpioDriver::aBounceIsNotSeen()
{
    Board board("input.stop = 3, debounce 5 ms\n");
    board.bench.wireRead("stop");
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    for (int i = 0; i < 10; ++i) {
        board.pull(3, i % 2 == 0);
        board.bench.advance(4ms);
        QVERIFY(board.bench.exchange());
        QCOMPARE(board.bench.value("stop"), 0.0);
    }
    board.pull(3, true);
    for (const auto step : {1ms, 4ms}) {
        board.bench.advance(step);
        QVERIFY(board.bench.exchange());
        QCOMPARE(board.bench.value("stop"), 0.0);
    }
    board.bench.advance(1ms);
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("stop"), 1.0);
}

void tst_GpioDriver::edgesAreCountedWithTheTimeOfTheLast()
{
    Board board("input.turns = 3\n");
    QCOMPARE(board.bench.wireRead("turns.@edges") + board.bench.wireRead("turns.@time"), QString());
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("turns.@edges"), 0.0);
    QVERIFY(!board.bench.isFresh("turns.@time"));
    qint64 last = 0;
    for (int i = 0; i < 5; ++i) {
        board.pull(3, i % 2 == 0);
        board.bench.advance(2ms);
        last = board.bench.now();
        QVERIFY(board.bench.exchange());
    }
    QCOMPARE(board.bench.value("turns.@edges"), 5.0);
    board.bench.advance(1h);
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("turns.@edges"), 5.0);
    QCOMPARE(board.bench.value("turns.@time"), double(last) * 1e-9);
}

void tst_GpioDriver::onlyTheEdgesThatWereAskedForAreCounted()
{
    Board board("input.up = 3, edges rising\ninput.down = 4, edges falling\n");
    QCOMPARE(board.bench.wireRead("up.@edges") + board.bench.wireRead("down.@edges"), QString());
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    for (int i = 0; i < 5; ++i) {
        board.pull(3, i % 2 == 0);
        board.pull(4, i % 2 == 0);
        QVERIFY(board.bench.exchange());
    }
    QCOMPARE(board.bench.value("up.@edges"), 3.0);
    QCOMPARE(board.bench.value("down.@edges"), 2.0);
}

void tst_GpioDriver::outputIsNotDrivenUntilItHasAValue()
{
    Board board("output.lamp = 4\n");
    board.bench.wireWrite("lamp");
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.driven(4), -1);
    board.bench.set("lamp", 1.0);
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.driven(4), 1);
    board.bench.set("lamp", 0.4);
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.driven(4), 0);
}

void tst_GpioDriver::anOutputBeginsWithItsSafeValue()
{
    Board board("output.brake = 4, active-low\n");
    board.bench.wireWrite("brake");
    board.bench.set("brake", 1.0, true);
    board.bench.runner().write(0);
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QCOMPARE(board.driven(4), 0);  // before the first cycle
}

void tst_GpioDriver::anOutputThatIsKeptDoesNotGetItsSafeValue()
{
    Board board("output.pump = 4, keep\noutput.lamp = 5\n");
    board.bench.wireWrite("pump");
    board.bench.wireWrite("lamp");
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    for (const bool isSafe : {true, false, true}) {
        board.bench.set("pump", isSafe ? 0.0 : 1.0, isSafe);
        board.bench.set("lamp", isSafe ? 0.0 : 1.0, isSafe);
        QVERIFY(board.bench.exchange());
    }
    QCOMPARE(board.driven(4), 1);
    QCOMPARE(board.driven(5), 0);
}

void tst_GpioDriver::cycleAllocatesNothingAndLocksNothing()
{
    if (!ThreadCosts::areCounted())
        QSKIP("a sanitizer has the functions that are counted");
    Board board("input.stop = 3, debounce 1 ms\noutput.lamp = 4\n");
    QCOMPARE(board.bench.wireRead("stop") + board.bench.wireRead("stop.@edges") + board.bench.wireWrite("lamp"),
             QString());
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    board.bench.runner().setValue(0, 0.0, true);
    QVERIFY(board.bench.exchange());
    const ThreadCosts before = ThreadCosts::ofThisThread();
    for (int i = 0; i < 1000; ++i) {
        board.pull(3, i % 4 < 2);
        board.bench.advance(1ms);
        board.bench.runner().setValue(0, i % 2, false);
        board.bench.exchange();
    }
    const ThreadCosts costs = ThreadCosts::ofThisThread() - before;
    QCOMPARE(costs.allocations, std::uint64_t(0));
    QCOMPARE(costs.locks, std::uint64_t(0));
    QVERIFY(board.bench.value("stop.@edges") > 100.0);
}

void tst_GpioDriver::anExpanderIsReadBesideTheCycle()
{
    Board board("interval = 20 ms\ninput.door = 3, debounce 30 ms\noutput.lamp = 5\n", "gpio-expander");
    QCOMPARE(board.bench.errors(), QString());
    for (const char *name : {"door", "door.@edges"})
        QCOMPARE(board.bench.wireRead(name), QString());
    QCOMPARE(board.bench.wireWrite("lamp"), QString());
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    board.pull(3, true);
    board.bench.set("lamp", 1.0);
    board.bench.runner().write(board.bench.now());  // a cycle
    board.bench.runner().read(board.bench.now());
    QCOMPARE(board.driven(5), -1);
    QCOMPARE(board.bench.value("door"), 0.0);
    for (int i = 0; i < 3; ++i) {  // the thread of the driver
        board.bench.advance(20ms);
        QVERIFY(board.bench.exchange());
    }
    QCOMPARE(board.driven(5), 1);
    QCOMPARE(board.bench.value("door"), 1.0);
    QCOMPARE(board.bench.value("door.@edges"), 1.0);
}

void tst_GpioDriver::aMissingLineIsNamed()
{
    Board board("output.lamp = 8\n");
    board.bench.wireWrite("lamp");
    QVERIFY(!board.bench.open());
    QVERIFY2(board.bench.errorString().contains("fake:board has no line '8'; it has 8 lines"),
             qPrintable(board.bench.errorString()));
}

void tst_GpioDriver::unpluggedBoardIsReportedAndReconnects()
{
    Board board("input.stop = 3\n");
    board.bench.wireRead("stop");
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    FakeMemory::remove("fake:board");
    QVERIFY(!board.bench.exchange());
    QVERIFY(!board.bench.isFresh("stop"));
    QVERIFY2(board.bench.errorString().contains("fake:board") && board.bench.errorString().contains("plug it in again"),
             qPrintable(board.bench.errorString()));
    board.bench.close();
    QVERIFY(!board.bench.open());
    QString error;
    QVERIFY2(board.memory.create("fake:board", 8, &error), qPrintable(error));
    board.pull(3, true);
    QVERIFY2(board.bench.open(), qPrintable(board.bench.errorString()));
    QVERIFY(board.bench.exchange());
    QCOMPARE(board.bench.value("stop"), 1.0);
}

void tst_GpioDriver::missingChipIsReportedWithARemedy()
{
    DriverBench bench(QStringLiteral("gpio"), "device = gpiochip987\ninput.stop = 1\n");
    QVERIFY(!bench.open());
    const QString error = bench.errorString();
    QVERIFY2(error.contains("gpiochip987")
                 && (error.contains("there are ") || error.contains("this computer has none")
                     || error.contains("built without libgpiod")),
             qPrintable(error));
}

void tst_GpioDriver::edgesBetweenTwoCyclesAreCountedByTheKernel()
{
    const QStringList parts = testDeviceParts("QTPLC_TEST_GPIO");
    if (parts.size() != 4)
        QSKIP("needs a chip of the module gpio-sim: QTPLC_TEST_GPIO names it");
    SimulatedGpioDevice device(parts);
    DriverBench bench(QStringLiteral("gpio"), device.keys());
    QCOMPARE(bench.wireRead("in") + bench.wireRead("in.@edges") + bench.wireRead("in.@time"), QString());
    device.give("in", 0.0);
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    QVERIFY(bench.exchange());
    const double before = double(monotonicNow()) * 1e-9;
    for (const double level : {1.0, 0.0, 1.0, 0.0, 1.0})
        device.give("in", level);
    const double after = double(monotonicNow()) * 1e-9;
    QTRY_VERIFY(bench.exchange() && bench.value("in.@edges") >= 5.0);
    QCOMPARE(bench.value("in.@edges"), 5.0);
    QCOMPARE(bench.value("in"), 1.0);
    QVERIFY(bench.value("in.@time") >= before && bench.value("in.@time") <= after);
}

QTEST_GUILESS_MAIN(tst_GpioDriver)
#include "tst_GpioDriver.moc"
