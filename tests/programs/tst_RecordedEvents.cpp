// SPDX-License-Identifier: Apache-2.0
#include "ProcessPlant.h"

#include <QtCore/QDir>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

/// What people did is in the recordings of programs that were killed.
class tst_RecordedEvents : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void aKilledMasterLeavesWhoSetWhat_data();
    void aKilledMasterLeavesWhoSetWhat();
    void aReportShowsThem();
    void badCallsAreRefused_data();
    void badCallsAreRefused();

private:
    void recordWhatIsLeft() const;
    QVector<QJsonObject> told(const QStringList &options) const
    {
        QVector<QJsonObject> result;
        const Outcome outcome
            = runProgram(programPath("qtplc"), QStringList{"events", "--json", "--file", m_folder->path()} + options);
        if (outcome.exitCode != 0)
            qWarning("%s", qPrintable(outcome.errors));
        for (const QString &line : outcome.output.split(QLatin1Char('\n'), Qt::SkipEmptyParts))
            result << QJsonDocument::fromJson(line.toUtf8()).object();
        return result;
    }

    QScopedPointer<QTemporaryDir> m_folder;
    QScopedPointer<QTemporaryDir> m_rings;
};

void tst_RecordedEvents::init()
{
    m_folder.reset(new QTemporaryDir);
    m_rings.reset(new QTemporaryDir("/dev/shm/qtplc-test-XXXXXX"));
    QVERIFY(m_folder->isValid() && m_rings->isValid());
    qputenv("QTPLC_RING_DIR", m_rings->path().toUtf8());
}

void tst_RecordedEvents::recordWhatIsLeft() const
{
    Program recorder(programPath("qtplc"), {"record", m_folder->path() + '/'});
    QTRY_COMPARE_WITH_TIMEOUT(QDir(m_rings->path()).entryList(QDir::Files), QStringList(), 60'000);
    recorder.terminate();
    recorder.waitForEnd();
}

void tst_RecordedEvents::aKilledMasterLeavesWhoSetWhat_data()
{
    QTest::addColumn<bool>("isRecorded");
    QTest::newRow("nothing records") << false;
    QTest::newRow("with its recorder") << true;
}

void tst_RecordedEvents::aKilledMasterLeavesWhoSetWhat()
{
    QFETCH(bool, isRecorded);
    ProcessPlant plant;
    QVERIFY(plant.start(isRecorded ? QStringList{"--record=" + m_folder->path() + '/'} : QStringList()));
    QCOMPARE(plant.qtplc("start").exitCode, 0);
    QCOMPARE(plant.qtplc("set tetherSpeed 1.5").exitCode, 0);
    QCOMPARE(plant.qtplc("set tetherSpeed 2.5").exitCode, 0);
    QTRY_VERIFY_WITH_TIMEOUT(plant.qtplc("list tetherSpeed").output.contains("2.5"), 60'000);
    plant.master().kill();
    plant.master().waitForEnd();
    recordWhatIsLeft();

    const QVector<QJsonObject> set = told({"--signal", "tetherSpeed"});
    QCOMPARE(set.size(), 2);
    QCOMPARE(set[0].value("from").toString(), QString("0"));
    QCOMPARE(set[0].value("to").toString(), QString("1.5"));
    QCOMPARE(set[1].value("to").toString(), QString("2.5"));
    QCOMPARE(set[1].value("by").toString(), QString("qtplc"));
    QVERIFY(set[1].value("cycle").toDouble() > set[0].value("cycle").toDouble());
    const QVector<QJsonObject> all = told({});
    const auto isStart = [](const QJsonObject &each) { return each.value("command") == "StartRealTime"; };
    QCOMPARE(int(std::count_if(all.begin(), all.end(), isStart)), 1);
    QVERIFY(std::any_of(all.begin(), all.end(),
                        [](const QJsonObject &each) { return each.value("channel") == "/events"; }));

    // The image has the value from that cycle on, and not before.
    const QString table = m_folder->filePath("table.csv");
    const int cycle = set[1].value("cycle").toInt();
    QCOMPARE(runProgram(programPath("qtplc"),
                        {"export", m_folder->path(), "-o", table, "--signals", "tetherSpeed", "--force"})
                 .exitCode,
             0);
    QFile csv(table);
    QVERIFY(csv.open(QIODevice::ReadOnly | QIODevice::Text));
    const QList<QByteArray> head = csv.readLine().trimmed().split(',');
    const auto columnOf = [&head](const char *name) {
        const auto isColumn = [name](const QByteArray &each) { return each.startsWith(name); };  // the unit follows
        const auto found = std::find_if(head.begin(), head.end(), isColumn);
        return found == head.end() ? -1 : int(found - head.begin());
    };
    const int number = columnOf("cycle");
    const int value = columnOf("tetherSpeed");
    QVERIFY2(number >= 0 && value >= 0, head.join(',').constData());
    int checked = 0;
    while (!csv.atEnd()) {
        const QList<QByteArray> row = csv.readLine().trimmed().split(',');
        if (row.value(number).toInt() == cycle - 1 || row.value(number).toInt() == cycle) {
            QCOMPARE(row.value(value).toDouble() == 2.5, row.value(number).toInt() == cycle);
            ++checked;
        }
    }
    QCOMPARE(checked, 2);
}

void tst_RecordedEvents::aReportShowsThem()
{
    ProcessPlant plant;
    const QString file = m_folder->filePath("flight.mcap");
    const QString report = m_folder->filePath("report.html");
    QVERIFY(plant.start({"--record=" + file}));
    QCOMPARE(plant.qtplc("start").exitCode, 0);
    QCOMPARE(plant.qtplc("set tetherSpeed 1.5").exitCode, 0);
    QCOMPARE(plant.qtplc("stop").exitCode, 0);
    plant.master().terminate();
    QCOMPARE(plant.master().waitForEnd(), 0);
    QCOMPARE(runProgram(programPath("qtplc"), {"report", file, "-o", report}).exitCode, 0);
    QFile page(report);
    QVERIFY(page.open(QIODevice::ReadOnly));
    const QByteArray html = page.readAll();
    QVERIFY(html.contains("has set tetherSpeed: "));
    QVERIFY(html.contains("commands Stop"));
    QVERIFY(html.contains("asked for it"));  // the last state, which is told behind the last cycle
}

void tst_RecordedEvents::badCallsAreRefused_data()
{
    QTest::addColumn<QStringList>("options");
    QTest::addColumn<QString>("error");
    QTest::newRow("a signal of a running master") << QStringList{"--signal", "power"} << "--signal needs a recording";
    QTest::newRow("following a recording")
        << QStringList{"--follow", "--file", "flight.mcap"} << "--follow needs a master";
    QTest::newRow("no recording") << QStringList{"--file", "no-such.mcap"} << "no-such.mcap";
    QTest::newRow("an empty folder") << QStringList{"--file", "/proc/self/fdinfo"} << "has no recording";
}

void tst_RecordedEvents::badCallsAreRefused()
{
    QFETCH(QStringList, options);
    QFETCH(QString, error);
    const Outcome outcome = runProgram(programPath("qtplc"), QStringList{"events"} + options);
    QVERIFY(outcome.exitCode != 0);
    QVERIFY2(outcome.errors.contains(error), qPrintable(outcome.errors));
    QVERIFY(outcome.output.isEmpty());
}

QTEST_GUILESS_MAIN(tst_RecordedEvents)
#include "tst_RecordedEvents.moc"
