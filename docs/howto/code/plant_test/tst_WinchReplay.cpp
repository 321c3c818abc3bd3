// SPDX-License-Identifier: Apache-2.0
#include "Winch.h"

#include <QtPlcTest>
#include <QtTest/QtTest>

/// Stands for a recording from the field: a minute of a master and a winch in lockstep.
static bool record(const QString &file)
{
    QPlcMasterNode master;
    master.setSignalTable(QPlcSignalTable::fromIni("[tetherLength]\ntype = Real64\n"));
    master.setClock(QPlcClock::lockstep());
    master.setCycleLimit(6000);
    QPlcRecorder recorder;
    recorder.setTarget(file);
    recorder.setMaster(&master);
    Winch winch;
    QSignalSpy stopped(&master, &QPlcMasterNode::realTimeHasStopped);
    return recorder.start() && master.addLocalNode(&winch) && master.startRealTime()
        && (!stopped.isEmpty() || stopped.wait(60'000)) && recorder.stop();
}

class tst_WinchReplay : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { QVERIFY(record(m_flight)); }
    void theProgramComputesItsFlightAgain()
    {
        QPlcReplay replay(m_flight);
        const QString program = QCoreApplication::applicationDirPath() + "/winch";
        QVERIFY2(replay.runProgram(program), qPrintable(replay.text()));
        QCOMPARE(replay.compared(), quint64(6000));
    }
    void theNodeComputesItsFlightAgain()
    {
        QPlcReplay replay(m_flight);
        Winch winch;
        QVERIFY2(replay.run(winch), qPrintable(replay.text()));
    }

private:
    QTemporaryDir m_folder;
    const QString m_flight = m_folder.filePath("flight.mcap");
};
QTEST_GUILESS_MAIN(tst_WinchReplay)
#include "tst_WinchReplay.moc"
