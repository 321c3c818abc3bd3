// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "RecordedFlight.h"
#include "recording/RecordingFolder.h"
#include "recording/Verification.h"

#include <QPlcMasterNode.h>
#include <QPlcRecorder.h>
#include <QPlcSignalIndexTable.h>
#include <QtTest/QtTest>

using namespace qplc;

// The public recorder beside a master.
class tst_QPlcRecorder : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void eachPhaseOfAMasterIsInAFileOfItsOwn();
    void furtherPhasesGoIntoNumberedFiles();
    void aRecorderThatStopsFinishesItsFile();
    void aTargetThatIsThereIsRefused();
    void aRecorderWithoutATargetIsRefused();
    void aPlantIsFoundByItsName();
    void nothingIsMarkedWithoutAPhase();

private:
    QTemporaryDir m_rings{QStringLiteral("/dev/shm/qtplc-test-XXXXXX")};
    QTemporaryDir m_folder;
};

namespace {

struct Plant
{
    Plant()
    {
        table.initializeFromIni(RecordedFlight::ini());
        master.setTimeSignal("time");
        master.setClock(QPlcClock::lockstep());
        master.setInterval(std::chrono::milliseconds(10));
    }
    void fly(quint64 cycles)
    {
        QSignalSpy stopped(&master, &QPlcMasterNode::realTimeHasStopped);
        master.setCycleLimit(cycles);
        QVERIFY2(master.startRealTime(), qPrintable(master.errorString()));
        QTRY_COMPARE(stopped.size(), 1);
    }
    QPlcSignalIndexTable table;
    QPlcMasterNode master;
};

VerifiedFile verified(const QString &file)
{
    VerifiedFile result;
    QString error;
    if (!verifyRecording(file, &result, &error))
        result.problems << error;
    return result;
}

}  // namespace

void tst_QPlcRecorder::initTestCase()
{
    QVERIFY(m_rings.isValid() && m_folder.isValid());
    qputenv("QTPLC_RING_DIR", m_rings.path().toUtf8());
}

void tst_QPlcRecorder::eachPhaseOfAMasterIsInAFileOfItsOwn()
{
    Plant plant;
    QPlcRecorder recorder;
    QSignalSpy finished(&recorder, &QPlcRecorder::fileFinished);
    QSignalSpy states(&recorder, &QPlcRecorder::stateChanged);
    const QString folder = m_folder.filePath("phases");
    recorder.setTarget(folder + '/');
    QVERIFY(recorder.isFolder());
    recorder.setMaster(&plant.master);
    QVERIFY2(recorder.start(), qPrintable(recorder.errorString()));
    QCOMPARE(recorder.state(), QPlcRecorder::Waiting);
    plant.fly(3000);
    plant.fly(500);
    QVERIFY(recorder.waitForFinished(std::chrono::seconds(60)));
    QCOMPARE(recorder.status().cycles, quint64(3500));
    QVERIFY(recorder.stop());
    const QVector<RecordingFolder::File> files = RecordingFolder::files(folder);
    QCOMPARE(files.size(), 2);
    QCOMPARE(finished.size(), 2);
    const QStringList told{finished[0][0].toString(), finished[1][0].toString()};  // in either order
    QVERIFY(told.contains(files[0].path) && told.contains(files[1].path));
    QVERIFY(verified(files[0].path).isComplete() && verified(files[1].path).isComplete());
    QCOMPARE(verified(files[0].path).cycles, quint64(3000));
    QCOMPARE(verified(files[1].path).cycles, quint64(500));
    QCOMPARE(states.last()[0].value<QPlcRecorder::State>(), QPlcRecorder::Off);
    QVERIFY(QDir(m_rings.path()).entryList(QDir::Files).isEmpty());
}

void tst_QPlcRecorder::furtherPhasesGoIntoNumberedFiles()
{
    Plant plant;
    QPlcRecorder recorder;
    recorder.setTarget(m_folder.filePath("flight.mcap"));
    QVERIFY(!recorder.isFolder());
    recorder.setMaster(&plant.master);
    QVERIFY(recorder.start());
    plant.fly(100);
    plant.fly(200);
    QVERIFY(recorder.waitForFinished(std::chrono::seconds(60)));
    QCOMPARE(verified(m_folder.filePath("flight.mcap")).cycles, quint64(100));
    QCOMPARE(verified(m_folder.filePath("flight-2.mcap")).cycles, quint64(200));
}

void tst_QPlcRecorder::aRecorderThatStopsFinishesItsFile()
{
    Plant plant;
    plant.master.setClock(QPlcClock::realTime());
    QPlcRecorder recorder;
    QSignalSpy started(&recorder, &QPlcRecorder::fileStarted);
    recorder.setTarget(m_folder.filePath("stopped.mcap"));
    recorder.setMaster(&plant.master);
    QVERIFY(recorder.start());
    QVERIFY(plant.master.startRealTime());
    QTRY_COMPARE(started.size(), 1);
    QTRY_COMPARE(recorder.state(), QPlcRecorder::Recording);
    QTRY_VERIFY(recorder.status().cycles > 10);
    QVERIFY(recorder.stop());
    QCOMPARE(recorder.state(), QPlcRecorder::Off);
    const VerifiedFile file = verified(m_folder.filePath("stopped.mcap"));
    QVERIFY(file.isFinished);
    QCOMPARE(file.problems, QStringList("the end of the phase is not in the file"));
    QVERIFY(file.cycles > 10);
    plant.master.stop();
}

void tst_QPlcRecorder::aTargetThatIsThereIsRefused()
{
    QFile there(m_folder.filePath("there.mcap"));
    QVERIFY(there.open(QIODevice::WriteOnly));
    QPlcRecorder recorder;
    QSignalSpy errors(&recorder, &QPlcRecorder::errorOccurred);
    recorder.setTarget(there.fileName());
    QVERIFY(!recorder.start());
    QCOMPARE(recorder.error(), QPlcRecorder::TargetError);
    QVERIFY2(recorder.errorString().contains("is there already"), qPrintable(recorder.errorString()));
    recorder.setTarget(m_folder.filePath("there.mcap/folder/"));
    QVERIFY(!recorder.start());
    QVERIFY2(recorder.errorString().contains("cannot make the folder"), qPrintable(recorder.errorString()));
    recorder.setTarget("/no-such-folder/flight.mcap");
    QVERIFY(!recorder.start());
    QVERIFY2(recorder.errorString().contains("/no-such-folder"), qPrintable(recorder.errorString()));
    QCOMPARE(errors.size(), 3);
}

void tst_QPlcRecorder::aRecorderWithoutATargetIsRefused()
{
    QPlcRecorder recorder;
    QVERIFY(!recorder.start());
    QVERIFY2(recorder.errorString().contains("setTarget()"), qPrintable(recorder.errorString()));
    QVERIFY(!recorder.addRing("/no-such-ring"));
    QCOMPARE(recorder.error(), QPlcRecorder::RingError);
}

void tst_QPlcRecorder::aPlantIsFoundByItsName()
{
    Plant plant;
    plant.master.setClock(QPlcClock::realTime());
    QString ringFile;
    connect(&plant.master, &QPlcMasterNode::ringIsReady, &plant.master, [&](const QString &file) { ringFile = file; });
    QVERIFY(plant.master.startRealTime());
    QTRY_VERIFY(!ringFile.isEmpty());
    RingMemory ring;
    QString error;
    QVERIFY2(ring.open(QFile::encodeName(ringFile), &error), qPrintable(error));
    RingDescription description;
    QVERIFY(RingDescription::fromText(ring.description(), &description));
    ring.close();
    QPlcRecorder recorder;
    recorder.setTarget(m_folder.filePath("named/"));
    recorder.setPlant("another plant");
    QVERIFY(recorder.start());
    QTest::qWait(500);  // it looks, and finds nothing
    QCOMPARE(recorder.state(), QPlcRecorder::Waiting);
    QVERIFY(recorder.stop());
    recorder.setPlant(description.plant);
    QVERIFY(recorder.start());
    QTRY_VERIFY(recorder.status().cycles > 10);
    plant.master.stop();
    QTRY_COMPARE(recorder.state(), QPlcRecorder::Waiting);
    QVERIFY(verified(recorder.status().file).hasEnd);
}

void tst_QPlcRecorder::nothingIsMarkedWithoutAPhase()
{
    QPlcRecorder recorder;
    QVERIFY(!recorder.mark());
    recorder.setTarget(m_folder.filePath("marks/"));
    QVERIFY(recorder.start());
    QVERIFY(!recorder.mark());
}

QTEST_GUILESS_MAIN(tst_QPlcRecorder)
#include "tst_QPlcRecorder.moc"
