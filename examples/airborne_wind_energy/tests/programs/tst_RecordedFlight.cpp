// SPDX-License-Identifier: Apache-2.0
#include "Program.h"

#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

#include <csignal>

/// awe_sil records its flight, and qtplc proves that all of it is in the file.
class tst_RecordedFlight : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void theFileHasTheWholeFlight_data();
    void theFileHasTheWholeFlight();
    void aCycleTakesFewBytes();
    void aFileThatIsThereIsNotReplaced();
    void aRecorderThatIsKilledLosesNoCycle();
    void theRecorderOfAFolderIsAsked();

private:
    static QString program(const char *name) { return QStringLiteral(AWE_PROGRAMS "/%1").arg(QLatin1String(name)); }
    QString file(const char *name) const { return m_folder.filePath(QLatin1String(name)); }
    /// What `qtplc verify` says of a file.
    static QJsonObject verified(const QString &file, int *exitCode);

    QTemporaryDir m_folder;
    QTemporaryDir m_rings{QStringLiteral("/dev/shm/qtplc-test-XXXXXX")};
};

/// Rings of other masters on this machine are elsewhere.
void tst_RecordedFlight::initTestCase()
{
    QVERIFY(m_folder.isValid() && m_rings.isValid());
    qputenv("QTPLC_RING_DIR", m_rings.path().toUtf8());
}

QJsonObject tst_RecordedFlight::verified(const QString &file, int *exitCode)
{
    const Outcome outcome = runProgram(program("qtplc"), {"verify", file, "--json"});
    *exitCode = outcome.exitCode;
    return QJsonDocument::fromJson(outcome.output.toUtf8()).object();
}

void tst_RecordedFlight::theFileHasTheWholeFlight_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::newRow("in one process") << QStringList();
    QTest::newRow("turned by a host") << QStringList("--external");
    QTest::newRow("in several processes") << QStringList("--processes");
    QTest::newRow("by a clock") << QStringList("--scale=20");
}

void tst_RecordedFlight::theFileHasTheWholeFlight()
{
    QFETCH(QStringList, arguments);
    const QByteArray name = QByteArray(QTest::currentDataTag()).replace(' ', '_');
    const QString recording = file(name + ".mcap");
    const Outcome flight
        = runProgram(program("awe_sil"),
                     arguments + QStringList{"--duration=20", "--record", recording, "--report", file(name + ".json")});
    QCOMPARE(flight.exitCode, 0);
    if (!arguments.contains("--processes"))  // there it is what the master says
        QVERIFY2(flight.output.contains("cycles in " + recording + ", 0 missing"), qPrintable(flight.output));
    QFile reportFile(file(name + ".json"));
    QVERIFY(reportFile.open(QIODevice::ReadOnly));
    const QJsonObject report = QJsonDocument::fromJson(reportFile.readAll()).object();
    int exitCode = -1;
    const QJsonObject facts = verified(recording, &exitCode);
    QCOMPARE(facts["problems"].toArray(), QJsonArray());
    QCOMPARE(exitCode, 0);
    QVERIFY(facts["complete"].toBool());
    QCOMPARE(facts["cycles"].toDouble() + facts["skipped"].toDouble(), facts["lastCycle"].toDouble() + 1);
    QCOMPARE(facts["digest"].toString(), report["image_digest"].toString());
}

void tst_RecordedFlight::aCycleTakesFewBytes()
{
    const QString recording = file("ten_minutes.mcap");
    QCOMPARE(runProgram(program("awe_sil"), {"--duration=600", "--record", recording}).exitCode, 0);
    const double size = double(QFileInfo(recording).size()) / 60000.0;
    QVERIFY2(size <= 145.0, qPrintable(QStringLiteral("%1 bytes for each cycle").arg(size)));
}

void tst_RecordedFlight::aFileThatIsThereIsNotReplaced()
{
    QFile there(file("there.mcap"));
    QVERIFY(there.open(QIODevice::WriteOnly));
    there.write("a text");
    there.close();
    const Outcome outcome = runProgram(program("awe_sil"), {"--duration=1", "--record", there.fileName()});
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY2(outcome.errors.contains("is there already"), qPrintable(outcome.errors));
    QVERIFY(there.open(QIODevice::ReadOnly));
    QCOMPARE(there.readAll(), QByteArray("a text"));
}

void tst_RecordedFlight::aRecorderThatIsKilledLosesNoCycle()
{
    Program flight(program("awe_sil"), {"--scale=3", "--duration=45"});
    QTRY_VERIFY_WITH_TIMEOUT(
        runProgram(program("qtplc"), {"record", "/no-such-folder/x"}).errors.contains("no-such-folder"),
        Program::patience);
    Program killed(program("qtplc"), {"record", file("first.mcap")});
    QVERIFY(killed.waitForOutput("recording plant"));
    QTRY_VERIFY_WITH_TIMEOUT(QFileInfo(file("first.mcap")).size() > 10'000, Program::patience);
    killed.sendSignal(SIGKILL);
    killed.waitForEnd();
    Program next(program("qtplc"), {"record", file("second.mcap")});
    QVERIFY(next.waitForOutput("recording plant"));
    QCOMPARE(next.waitForEnd(60'000), 0);
    QCOMPARE(flight.waitForEnd(60'000), 0);
    QCOMPARE(runProgram(program("qtplc"), {"recover", file("first.mcap")}).exitCode, 0);
    int exitCode = -1;
    const QJsonObject begin = verified(file("first.mcap"), &exitCode);
    const QJsonObject end = verified(file("second.mcap"), &exitCode);
    // The master may have skipped cycles just there: they are in no gap.
    const double before = end["gaps"].toArray().at(0).toObject()["last"].toDouble();
    QVERIFY(before <= begin["lastCycle"].toDouble());
    QVERIFY(end["lastCycle"].toDouble() > begin["lastCycle"].toDouble());
    QVERIFY(!end["problems"].toArray().contains("the end of the phase is not in the file"));
}

void tst_RecordedFlight::theRecorderOfAFolderIsAsked()
{
    const QString folder = file("asked");
    const auto ask
        = [&](const QStringList &arguments) { return runProgram(program("qtplc"), QStringList("record") + arguments); };
    QVERIFY(ask({"status", folder}).errors.contains("there is no folder"));
    Program recorder(program("qtplc"), {"record", folder + '/'});
    QVERIFY(recorder.waitForOutput("recording into"));
    QVERIFY(ask({"mark", folder}).errors.contains("nothing to mark"));
    Program flight(program("awe_sil"), {"--scale=3", "--duration=100000"});
    QVERIFY(recorder.waitForOutput("recording plant"));
    const auto state = [&] {
        const QByteArray text = ask({"status", folder, "--json"}).output.toUtf8();
        return QJsonDocument::fromJson(text).object().value("state").toString();
    };
    QTRY_COMPARE_WITH_TIMEOUT(state(), QString("recording"), Program::patience);
    QCOMPARE(ask({"mark", folder}).exitCode, 0);
    QVERIFY(ask({"list", folder}).output.contains("marked, not finished"));
    QCOMPARE(ask({"stop", folder}).exitCode, 0);
    QCOMPARE(state(), QString("stopped"));
    QVERIFY(!ask({"list", folder}).output.contains("not finished"));
    QCOMPARE(ask({"start", folder}).exitCode, 0);
    QCOMPARE(ask({"later", folder}).exitCode, 2);
    flight.sendSignal(SIGTERM);
    QCOMPARE(flight.waitForEnd(), 0);
    recorder.sendSignal(SIGTERM);
    QCOMPARE(recorder.waitForEnd(), 0);
    QVERIFY(ask({"mark", folder}).errors.contains("no recorder records into"));
    int exitCode = -1;
    const QJsonArray files = QJsonDocument::fromJson(ask({"list", folder, "--json"}).output.toUtf8()).array();
    QCOMPARE(files.size(), 2);
    const QJsonObject first = verified(files[0].toObject()["file"].toString(), &exitCode);
    const QJsonObject second = verified(files[1].toObject()["file"].toString(), &exitCode);
    QCOMPARE(exitCode, 0);
    QCOMPARE(second["from"], first["next"]);
}

QTEST_GUILESS_MAIN(tst_RecordedFlight)
#include "tst_RecordedFlight.moc"
