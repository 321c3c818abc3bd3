// SPDX-License-Identifier: Apache-2.0
// The program of hardware nodes as a process, with a board that this test plays, at a master that
// this test runs.
#include "../../common/Waiting.h"
#include "../FakeDevices.h"
#include "NodeFixtures.h"
#include "hardware/gpio/FakeGpioChip.h"

#include <QtCore/QProcess>

using qplc::FakeGpioChip;

namespace {

const QByteArray tableText = "[button]\ntype = Bool\nhold = 1000\n"
                             "[brakeRelease]\ntype = Bool\nsafe = 0\nhold = 1000\n";
const QByteArray wiring = "[node]\nname = Buttons\n[board]\ndriver = gpio\ndevice = fake:board\n"
                          "input.button = 2, pull-up\noutput.brakeRelease = 5\n"
                          "[board.read]\nbutton = button\n[board.write]\nbrakeRelease = brakeRelease\n"
                          "[board.safe]\nbrakeRelease = 0\n";

/// A plant of a master and a board, in a phase.
struct Plant
{
    Plant()
        : master(std::make_unique<TestMaster>(QPlcClock::realTime(), QPlcSignalTable::fromIni(tableText)))
    {
    }
    ~Plant()
    {
        program.kill();
        program.waitForFinished();
    }

    bool start()
    {
        QString error;
        QFile file(folder.filePath(QStringLiteral("board.ini")));
        if (!memory.create(QStringLiteral("fake:board"), 8, &error) || !file.open(QIODevice::WriteOnly)
            || file.write(wiring) != wiring.size() || !master->listen())
            return false;
        file.close();
        program.setProcessChannelMode(QProcess::ForwardedErrorChannel);
        program.start(QStringLiteral(QTPLC_HARDWARE_PROGRAM),
                      {file.fileName(), QStringLiteral("--watchdog"), QStringLiteral("2"), QStringLiteral("--master"),
                       QStringLiteral("udp://127.0.0.1:%1").arg(master->serverPort())});
        return waitUntil([this] { return !master->nodes().isEmpty(); }) && master->startRealTime()
            && master->waitForState(QPlcMasterNode::RealTime) && master->setSignalValue("brakeRelease", 1);
    }
    void pull(bool isHigh) { memory.at(2) = isHigh ? FakeGpioChip::Pulled : 0; }
    /// 0 or 1; -1: nobody drives it.
    int brakeRelease() const
    {
        const quint8 byte = memory.at(5);
        return byte & FakeGpioChip::IsOutput ? (byte & FakeGpioChip::Driven ? 1 : 0) : -1;
    }

    const FakeDevices devices;
    const QTemporaryDir folder;
    qplc::FakeMemory memory;
    std::unique_ptr<TestMaster> master;
    QProcess program;
};

}  // namespace

class tst_BoardOfAProgram : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void boardLinesAreConnectedToSignals();
    void theBoardIsSafeWhenTheProgramIsTerminated();
    void boardIsSafeAfterLossOfTheMaster();
    void aKilledProgramIsMadeSafeByTheNextOne();
    void unpluggedBoardReconnectsDuringThePhase();
};

void tst_BoardOfAProgram::boardLinesAreConnectedToSignals()
{
    Plant plant;
    QVERIFY(plant.start());
    plant.pull(true);
    QTRY_COMPARE(plant.master->signalValue("button").toInt(), 1);
    plant.pull(false);
    QTRY_COMPARE(plant.master->signalValue("button").toInt(), 0);
    QTRY_COMPARE(plant.brakeRelease(), 1);
    QVERIFY(plant.master->setSignalValue("brakeRelease", 0));
    QTRY_COMPARE(plant.brakeRelease(), 0);
}

void tst_BoardOfAProgram::theBoardIsSafeWhenTheProgramIsTerminated()
{
    Plant plant;
    QVERIFY(plant.start());
    QTRY_COMPARE(plant.brakeRelease(), 1);
    plant.program.terminate();
    QVERIFY(plant.program.waitForFinished(20000));
    QCOMPARE(plant.brakeRelease(), 0);
}

void tst_BoardOfAProgram::boardIsSafeAfterLossOfTheMaster()
{
    Plant plant;
    QVERIFY(plant.start());
    QTRY_COMPARE(plant.brakeRelease(), 1);
    plant.master.reset();
    QTRY_COMPARE(plant.brakeRelease(), 0);
}

// As ExecStopPost= of its service does.
void tst_BoardOfAProgram::aKilledProgramIsMadeSafeByTheNextOne()
{
    Plant plant;
    QVERIFY(plant.start());
    QTRY_COMPARE(plant.brakeRelease(), 1);
    plant.program.kill();
    QVERIFY(plant.program.waitForFinished(20000));
    QCOMPARE(plant.brakeRelease(), 1);  // the line keeps its level
    QProcess safe;
    safe.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    safe.start(QStringLiteral(QTPLC_HARDWARE_PROGRAM), {plant.folder.filePath("board.ini"), "--safe"});
    QVERIFY(safe.waitForFinished(20000));
    QCOMPARE(safe.exitCode(), 0);
    QCOMPARE(plant.brakeRelease(), 0);
}

void tst_BoardOfAProgram::unpluggedBoardReconnectsDuringThePhase()
{
    Plant plant;
    QVERIFY(plant.start());
    QTRY_COMPARE(plant.brakeRelease(), 1);
    qplc::FakeMemory::remove("fake:board");
    QString error;
    QVERIFY2(plant.memory.create("fake:board", 8, &error), qPrintable(error));
    QTRY_COMPARE(plant.brakeRelease(), 1);
    QTRY_COMPARE(plant.master->signalValue("button").toInt(), 0);
    plant.pull(true);
    QTRY_COMPARE(plant.master->signalValue("button").toInt(), 1);
}

QTEST_GUILESS_MAIN(tst_BoardOfAProgram)
#include "tst_BoardOfAProgram.moc"
