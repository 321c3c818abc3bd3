// SPDX-License-Identifier: Apache-2.0
// A button at a hardware node stops the plant, and so does its torn wire where it is wired as our
// pages say.
#include "../common/Waiting.h"
#include "DriverBench.h"
#include "FakeDevices.h"
#include "WinchBench.h"
#include "hardware/gpio/FakeGpioChip.h"

#include <QtCore/QDirIterator>
#include <QtCore/QRegularExpression>

using namespace std::chrono_literals;
using qplc::FakeGpioChip;

namespace {

constexpr int stopLine = 17;   // of docs/hardware/gpio.md
constexpr int brakeLine = 22;  // likewise

QByteArray contentOf(const QString &fileName)
{
    QFile file(fileName);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// The blocks of INI of docs/hardware/gpio.md: the configuration of a node, and its signal table.
QStringList blocksOfTheGpioPage()
{
    static const QRegularExpression block(QStringLiteral("```ini\n(.*?)```"),
                                          QRegularExpression::DotMatchesEverythingOption);
    QStringList blocks;
    auto matches
        = block.globalMatch(QString::fromUtf8(contentOf(QStringLiteral(QTPLC_SOURCES "/docs/hardware/gpio.md"))));
    while (matches.hasNext())
        blocks << matches.next().captured(1);
    return blocks;
}

/// A board with 32 lines. A line is a byte.
struct PlayedBoard
{
    PlayedBoard()
    {
        QString error;
        if (!memory.create(QStringLiteral("fake:board"), 32, &error))
            qFatal("%s", qPrintable(error));
    }
    /// -1: the node does not drive it.
    int driven(std::size_t line) const
    {
        const quint8 byte = memory.at(line);
        return byte & FakeGpioChip::IsOutput ? (byte & FakeGpioChip::Driven ? 1 : 0) : -1;
    }

    const FakeDevices devices;
    qplc::FakeMemory memory;
};

/// The speed is the button. Its values are fresh for longer than a busy machine lets its thread
/// wait.
QByteArray buttonWiring()
{
    QByteArray text = wiring;
    text.replace("name = Winch\n", "name = Winch\nsafeStop = drive.speed\n");
    return text.replace("device = bench0\n", "device = bench0\ntimeout = 2 s\n");
}

}  // namespace

class tst_EmergencyStop : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_bench.init(); }
    void aPressedButtonStopsThePlantSafely_data() { addKinds(); }
    void aPressedButtonStopsThePlantSafely();
    void aButtonThatIsSlowAtFirstStopsNothing_data() { addKinds(); }
    void aButtonThatIsSlowAtFirstStopsNothing();
    void aButtonWithoutAValueStopsThePlantToo();
    void theWiringOfTheGpioPageStopsThePlantAndSetsTheBrake_data();
    void theWiringOfTheGpioPageStopsThePlantAndSetsTheBrake();
    void publishedWiringsTreatTornWireAsPressedButton_data();
    void publishedWiringsTreatTornWireAsPressedButton();

private:
    WinchBench m_bench;
};

void tst_EmergencyStop::aPressedButtonStopsThePlantSafely()
{
    QFETCH(QString, kind);
    QFETCH(int, pace);
    m_bench.pace = QPlcDriver::Pace(pace);
    TestMaster master(QPlcClock::realTime(), winchTable());
    QVERIFY(master.listen());
    QPlcHardwareNode node;
    QVERIFY(node.configure(buttonWiring(), "winch.ini"));
    node.openDevices();
    QTRY_VERIFY(node.drivers().first().isOnline);
    QVERIFY(master.admit(node, kind));
    QVERIFY(WinchBench::start(master));
    QVERIFY(master.waitForCycles(20));
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    LogCapture log;
    m_bench.device->speed = 1.0;
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    QVERIFY2(master.stateReason().contains("node 'Winch' asked for it"), qPrintable(master.stateReason()));
    QTRY_COMPARE(m_bench.device->brake.load(), 1.0);
    node.disconnectFromMaster();
}

void tst_EmergencyStop::aButtonThatIsSlowAtFirstStopsNothing()
{
    QFETCH(QString, kind);
    QFETCH(int, pace);
    m_bench.pace = QPlcDriver::Pace(pace);
    TestMaster master(QPlcClock::realTime(), winchTable());
    QVERIFY(master.listen());
    QPlcHardwareNode node;
    QVERIFY(node.configure(buttonWiring(), "winch.ini"));
    m_bench.device->silentReads = 3;
    QVERIFY(master.admit(node, kind));
    QVERIFY(WinchBench::start(master));
    QVERIFY(master.waitForCycles(20));
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    node.disconnectFromMaster();
}

void tst_EmergencyStop::aButtonWithoutAValueStopsThePlantToo()
{
    TestMaster master(QPlcClock::realTime(), winchTable());
    QPlcHardwareNode node;
    QVERIFY(node.configure(buttonWiring(), "winch.ini"));
    m_bench.device->isPlugged = false;
    QVERIFY(master.addLocalNode(&node));
    LogCapture log;
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
}

void tst_EmergencyStop::theWiringOfTheGpioPageStopsThePlantAndSetsTheBrake_data()
{
    QTest::addColumn<int>("line");
    QTest::newRow("button pressed: its contact opens, and the resistor pulls the line") << int(FakeGpioChip::Pulled);
    QTest::newRow("wire torn") << int(FakeGpioChip::IsTorn);
}

void tst_EmergencyStop::theWiringOfTheGpioPageStopsThePlantAndSetsTheBrake()
{
    QFETCH(int, line);
    const QStringList blocks = blocksOfTheGpioPage();
    QVERIFY(blocks.size() >= 2);
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(blocks[1].toUtf8(), &errors);
    QVERIFY2(errors.isEmpty(), qPrintable(QPlcParseError::toString(errors)));
    QByteArray configuration = blocks[0].toUtf8();
    configuration.replace("device = gpiochip0\n", "device = fake:board\ntimeout = 2 s\n").replace("GPIO27", "27");

    PlayedBoard board;
    TestMaster master(QPlcClock::realTime(), table);
    QPlcHardwareNode node;
    QVERIFY2(node.configure(configuration, "gpio.ini"),
             qPrintable(QPlcParseError::toString(node.configurationErrors())));
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(WinchBench::start(master));
    QVERIFY(master.setSignalValue("brakeRelease", 1));
    QTRY_COMPARE(board.driven(brakeLine), 1);
    QCOMPARE(master.signalValue("emergencyStopPressed").toInt(), 0);
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);

    LogCapture log;
    board.memory.at(stopLine) = quint8(line);
    QVERIFY(master.waitForState(QPlcMasterNode::SafeStop));
    QVERIFY2(master.stateReason().contains("node 'Winch' asked for it"), qPrintable(master.stateReason()));
    QTRY_COMPARE(board.driven(brakeLine), 0);
}

/// Every line of a stop button in what people read and copy.
void tst_EmergencyStop::publishedWiringsTreatTornWireAsPressedButton_data()
{
    static const QRegularExpression button(QStringLiteral("^[ /]*input\\.(\\w*[sS]top\\w*) = ([^;\n]*)"),
                                           QRegularExpression::MultilineOption);
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("words");
    for (const char *folder : {"docs", "examples", "include", "packaging"}) {
        QDirIterator files(QStringLiteral(QTPLC_SOURCES "/") + QLatin1String(folder), QDir::Files,
                           QDirIterator::Subdirectories);
        while (files.hasNext()) {
            auto matches = button.globalMatch(QString::fromUtf8(contentOf(files.next())));
            while (matches.hasNext()) {
                const QRegularExpressionMatch match = matches.next();
                QTest::addRow("%s: %s", qPrintable(files.fileName()), qPrintable(match.captured(1)))
                    << match.captured(1) << match.captured(2).trimmed();
            }
        }
    }
}

void tst_EmergencyStop::publishedWiringsTreatTornWireAsPressedButton()
{
    QFETCH(QString, name);
    QFETCH(QString, words);
    PlayedBoard board;
    DriverBench bench(QStringLiteral("gpio"),
                      QStringLiteral("device = fake:board\ninput.%1 = %2\n").arg(name, words).toUtf8());
    QVERIFY2(bench.errors().isEmpty(), qPrintable(bench.errors()));
    QCOMPARE(bench.wireRead(name), QString());
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    QVERIFY(bench.exchange());
    QCOMPARE(bench.value(name), 0.0);
    board.memory.at(std::size_t(words.section(',', 0, 0).toInt())) = FakeGpioChip::IsTorn;
    for (int i = 0; i < 3; ++i) {
        bench.advance(10ms);
        QVERIFY(bench.exchange());
    }
    QCOMPARE(bench.value(name), 1.0);
}

QTEST_GUILESS_MAIN(tst_EmergencyStop)
#include "tst_EmergencyStop.moc"
