// SPDX-License-Identifier: Apache-2.0
#include "../common/RuntimeFolder.h"
#include "ProcessPlant.h"

#include <QtTest/QtTest>

#include <csignal>

/// What qtplc does by itself: help, completion, doctor, campaign, find.
class tst_qtplc_alone : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void helpOfEveryCommandHasExamplesAndFits_data();
    void helpOfEveryCommandHasExamplesAndFits();
    void generalHelpFitsTheTerminal();
    void completionOffersCommandsAndOptions_data();
    void completionOffersCommandsAndOptions();
    void completionOffersSignalsOfTheRunningMaster_data();
    void completionOffersSignalsOfTheRunningMaster();
    void completionWithoutAMasterIsSilent();
    void bashCompletes_data();
    void bashCompletes();
    void doctorExaminesThisComputer();
    void doctorEndsWithAVerdictInOneLine();
    void campaignMeasuresEachCase();
    void campaignKeepsCompleteCasesWhenItIsInterrupted();
    void campaignRefusesWhatItCannotMeasure_data();
    void campaignRefusesWhatItCannotMeasure();
    void findListsMastersWithoutAnAddress();
    void findReportsThatThereIsNoMaster();

private:
    static Outcome qtplc(const QStringList &arguments) { return runProgram(programPath("qtplc"), arguments); }
    static QStringList complete(const QStringList &words)
    {
        const Outcome outcome = qtplc(QStringList{"complete", "--", "qtplc"} + words);
        return outcome.exitCode == 0 && outcome.errors.isEmpty() ? outcome.output.split('\n', Qt::SkipEmptyParts)
                                                                 : QStringList{"failed: " + outcome.errors};
    }
    static QStringList commandNames() { return complete({""}); }
};

// ---- help ----

void tst_qtplc_alone::helpOfEveryCommandHasExamplesAndFits_data()
{
    QTest::addColumn<QString>("command");
    QVERIFY(commandNames().size() > 10);
    for (const QString &command : commandNames())
        QTest::newRow(qPrintable(command)) << command;
}

void tst_qtplc_alone::helpOfEveryCommandHasExamplesAndFits()
{
    QFETCH(QString, command);
    const Outcome outcome = qtplc({"help", command});
    QCOMPARE(outcome.exitCode, 0);
    QVERIFY2(outcome.output.startsWith(QString("Usage: qtplc %1 ").arg(command)), qPrintable(outcome.output));
    QVERIFY(outcome.output.contains(QString("\nExamples:\n  ")) && outcome.output.contains("qtplc " + command));
    QVERIFY(outcome.output.contains("\n  --json "));
    for (const QString &line : outcome.output.split('\n'))
        QVERIFY2(line.size() <= 80, qPrintable(line));
    const Outcome other = qtplc({command, "--help"});
    QCOMPARE(other.exitCode, 0);
    QCOMPARE(other.output, outcome.output);
    // Every option that is offered is explained.
    for (const QString &option : complete({command, "--"}))
        QVERIFY2(option == "--help" || outcome.output.contains("\n  " + option), qPrintable(option));
}

void tst_qtplc_alone::generalHelpFitsTheTerminal()
{
    const QString text = qtplc({"help"}).output;
    QCOMPARE(qtplc({"--help"}).output, text);
    for (const QString &line : text.split('\n'))
        QVERIFY2(line.size() <= 80, qPrintable(line));
}

// ---- completion ----

void tst_qtplc_alone::completionOffersCommandsAndOptions_data()
{
    QTest::addColumn<QStringList>("words");
    QTest::addColumn<QStringList>("candidates");
    QTest::newRow("a command") << QStringList{"wat"} << QStringList{"watch"};
    QTest::newRow("several") << QStringList{"st"} << QStringList{"state", "start", "stop"};
    QTest::newRow("none") << QStringList{"xyz"} << QStringList();
    QTest::newRow("behind an option") << QStringList{"--timeout", "1", "wat"} << QStringList{"watch"};
    QTest::newRow("behind a switch") << QStringList{"--json", "wat"} << QStringList{"watch"};
    QTest::newRow("the value of an option") << QStringList{"--timeout", ""} << QStringList();
    QTest::newRow("an option") << QStringList{"set", "--f"} << QStringList{"--for"};
    QTest::newRow("not those of others") << QStringList{"stop", "--f"} << QStringList();
    QTest::newRow("common ones") << QStringList{"--ma"} << QStringList{"--master"};
    QTest::newRow("a command to explain") << QStringList{"help", "doc"} << QStringList{"doctor"};
    QTest::newRow("no second one") << QStringList{"help", "doctor", ""} << QStringList();
    QTest::newRow("no argument") << QStringList{"stop", ""} << QStringList();
}

void tst_qtplc_alone::completionOffersCommandsAndOptions()
{
    QFETCH(QStringList, words);
    QTEST(complete(words), "candidates");
}

void tst_qtplc_alone::completionOffersSignalsOfTheRunningMaster_data()
{
    QTest::addColumn<QString>("words");
    QTest::addColumn<QStringList>("candidates");
    const QStringList tether{"tetherSpeed", "tetherForce_earth", "tetherLength"};
    QTest::newRow("get") << "get tether" << tether;
    QTest::newRow("the second") << "echo power tether" << tether;
    QTest::newRow("watch") << "watch tetherL" << QStringList{"tetherLength"};
    QTest::newRow("set: what nobody writes") << "set tether" << QStringList{"tetherSpeed"};
    QTest::newRow("set: a value") << "set tetherSpeed tether" << QStringList();
    QTest::newRow("set: the next name") << "set power 1 --for 3 tether" << QStringList{"tetherSpeed"};
}

void tst_qtplc_alone::completionOffersSignalsOfTheRunningMaster()
{
    QFETCH(QString, words);
    QFETCH(QStringList, candidates);
    ProcessPlant plant;
    QVERIFY(plant.start());
    Program model(programPath("awe_model"), {plant.address()});  // no autopilot: tetherSpeed is free
    QVERIFY(model.waitForErrors("registered"));
    QCOMPARE(complete(plant.withMaster(words)), candidates);
    QStringList separate{"--master", plant.address().section('=', 1)};
    QCOMPARE(complete(separate + words.split(' ')), candidates);
}

void tst_qtplc_alone::completionWithoutAMasterIsSilent()
{
    QCOMPARE(complete({"--master=127.0.0.1:1", "get", "te"}), QStringList());
    QCOMPARE(complete({"--master=nonsense:x", "get", "te"}), QStringList());
    QCOMPARE(complete({"--master="}), QStringList());
}

void tst_qtplc_alone::bashCompletes_data()
{
    QTest::addColumn<QString>("line");
    QTest::addColumn<QString>("candidates");
    QTest::newRow("a command") << "qtplc wa"
                               << "watch";
    QTest::newRow("an empty word") << "qtplc help " << commandNames().join(' ');
    QTest::newRow("an option") << "qtplc set --f"
                               << "--for";
    QTest::newRow("a signal") << "qtplc --master 127.0.0.1:PORT get tetherL"
                              << "tetherLength";
    QTest::newRow("a signal, written otherwise") << "qtplc --master=127.0.0.1:PORT get tetherL"
                                                 << "tetherLength";
    QTest::newRow("nothing") << "qtplc stop "
                             << "";
}

void tst_qtplc_alone::bashCompletes()
{
    QFETCH(QString, line);
    QFETCH(QString, candidates);
    ProcessPlant plant;
    QVERIFY(plant.start());
    const QString script
        = QStringLiteral("set -eu; PATH=%1:$PATH; source %2; complete -p qtplc > /dev/null; "
                         "COMP_LINE=\"%3\"; COMP_POINT=${#COMP_LINE}; _qtplc; echo \"${COMPREPLY[*]}\"")
              .arg(QTPLC_PROGRAMS, QTPLC_COMPLETION, line.replace("PORT", plant.port));
    const Outcome outcome = runProgram("/bin/bash", {"--norc", "-c", script});
    QVERIFY2(outcome.exitCode == 0, qPrintable(outcome.errors));
    QCOMPARE(outcome.output.trimmed(), candidates);
}

// ---- doctor ----

void tst_qtplc_alone::doctorEndsWithAVerdictInOneLine()
{
    const Outcome outcome = qtplc({"doctor"});
    const QStringList lines = outcome.output.split('\n', Qt::SkipEmptyParts);
    QVERIFY(lines.size() > 5);
    const QString verdict = lines.constLast();
    QVERIFY2(verdict.startsWith(outcome.exitCode == 0 ? "Ready for real time." : "Not ready for real time: cure "),
             qPrintable(verdict));
    for (const QString &line : lines) {
        const QString subject = line.mid(9).section(QRegularExpression(" {1,}(?=\\S)"), 0, 0);
        if (line.startsWith("to cure"))
            QVERIFY2(verdict.contains(subject.trimmed()), qPrintable(verdict + " / " + line));
    }
}

void tst_qtplc_alone::doctorExaminesThisComputer()
{
    const Outcome outcome = qtplc({"doctor", "--json", "--master", "127.0.0.1:1"});  // needs none
    const QJsonObject document = jsonOf(outcome.output).object();
    const QJsonArray findings = document.value("findings").toArray();
    QStringList subjects;
    bool isHealthy = true;
    for (const QJsonValue &finding : findings) {
        const QString verdict = finding["verdict"].toString();
        subjects << finding["subject"].toString();
        QVERIFY2(QStringList({"ok", "to cure", "unknown"}).contains(verdict), qPrintable(verdict));
        QCOMPARE(finding["cure"].toString().isEmpty(), verdict != "to cure");
        QVERIFY(!finding["found"].toString().isEmpty());
        isHealthy = isHealthy && verdict != "to cure";
    }
    QCOMPARE(
        subjects,
        (QStringList{"versions", "kernel", "processors", "clock source", "governor", "idle states", "real-time share",
                     "scheduling", "locked memory", "swap", "wake-up", "wake-up FIFO", "loopback"}));
    QCOMPARE(document.value("ok").toBool(), isHealthy);
    QCOMPARE(outcome.exitCode, isHealthy ? 0 : 1);
    QCOMPARE(outcome.errors, QString());
}

// ---- campaign ----

/// The rows of a file of a campaign; the first one has the titles.
static QStringList rowsOf(const QString &file)
{
    QFile opened(file);
    return opened.open(QIODevice::ReadOnly) ? QString::fromUtf8(opened.readAll()).split('\n', Qt::SkipEmptyParts)
                                            : QStringList();
}

void tst_qtplc_alone::campaignMeasuresEachCase()
{
    QTemporaryDir folder;
    const QString output = folder.filePath("new/jitter");
    const Outcome outcome = qtplc({"campaign", "-o", output, "--for", "1", "--periods", "20ms", "--policies", "other",
                                   "--command", "exec sleep 1000", "--json"});
    const QJsonObject document = jsonOf(outcome.output).object();
    QCOMPARE(outcome.errors, QString());
    QCOMPARE(document["cases"].toInt(), 2);
    QCOMPARE(document["planned"].toInt(), 2);
    const QStringList rows = rowsOf(output + "/campaign.csv");
    QCOMPARE(rows.size(), 3);
    QVERIFY2(rows[1].startsWith("udp,20000.0,other,SCHED_OTHER 0,idle,3,"), qPrintable(rows[1]));
    QVERIFY2(rows[2].startsWith("udp,20000.0,other,SCHED_OTHER 0,command,3,"), qPrintable(rows[2]));
    for (const QString &row : rows.mid(1))
        QVERIFY2(row.section(',', 6, 6).toInt() > 0, qPrintable(row));  // cycles
    const bool hasNotes = !rows[1].endsWith(",\"\"") || !rows[2].endsWith(",\"\"");
    QCOMPARE(document["ok"].toBool(), !hasNotes);
    QCOMPARE(outcome.exitCode, hasNotes ? 1 : 0);
    QVERIFY(rowsOf(output + "/histograms.csv").filter("udp,20000.0,other,command,lateness,").size() > 0);
    QVERIFY(rowsOf(output + "/computer.csv").filter("\"kernel\",").size() == 1);
    QVERIFY(rowsOf(output + "/campaign.html").join('\n').contains("udp, 20 ms, other, command"));
    QCOMPARE(QDir(output).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot).size(), 4);
    const Outcome again = qtplc({"campaign", "-o", output, "--loads", "idle", "--policies", "other"});
    QCOMPARE(again.exitCode, 2);
    QVERIFY2(again.errors.contains("there is a campaign in"), qPrintable(again.errors));
}

void tst_qtplc_alone::campaignKeepsCompleteCasesWhenItIsInterrupted()
{
    QTemporaryDir folder;
    Program program(programPath("qtplc"),
                    {"campaign", "-o", folder.path(), "--for", "3", "--periods", "20ms", "--policies", "other",
                     "--command", QString("echo $$ > '%1'; sleep 1000 & wait").arg(folder.filePath("pid"))});
    QTRY_VERIFY_WITH_TIMEOUT(rowsOf(folder.filePath("pid")).size() == 1, 3 * Program::patience);
    QList<qint64> load = childrenOf(rowsOf(folder.filePath("pid")).first().toLongLong());
    load << rowsOf(folder.filePath("pid")).first().toLongLong();
    program.sendSignal(SIGINT);
    QCOMPARE(program.waitForEnd(), 1);
    QVERIFY2(program.output().contains("1 of 2 cases are in"), qPrintable(program.output()));
    QCOMPARE(stillRunning(load), QList<qint64>());
    const QStringList rows = rowsOf(folder.filePath("campaign.csv"));
    QCOMPARE(rows.size(), 2);
    QVERIFY2(rows[1].contains(",idle,"), qPrintable(rows[1]));
}

void tst_qtplc_alone::campaignRefusesWhatItCannotMeasure_data()
{
    QTest::addColumn<QString>("options");
    QTest::addColumn<QString>("error");
    QTest::newRow("no folder") << ""
                               << "use --output FOLDER";
    QTest::newRow("a folder that cannot be made") << "-o /proc/jitter --loads idle"
                                                  << "cannot make the folder '/proc/jitter'";
    QTest::newRow("a file") << "-o /dev/null --loads idle"
                            << "cannot make the folder '/dev/null'";
    QTest::newRow("no time") << "-o NEW --for 0"
                             << "for";
    QTest::newRow("years") << "-o NEW --for 1e13"
                           << "for";
    QTest::newRow("another load") << "-o NEW --loads idle,gpu"
                                  << "--loads: there is no 'gpu'";
    QTest::newRow("no load") << "-o NEW --loads ,"
                             << "--loads names nothing";
    QTest::newRow("an empty load") << "-o NEW --command="
                                   << "--command is empty";
    QTest::newRow("another policy") << "-o NEW --policies rr --loads idle"
                                    << "--policies: there is no 'rr'";
    QTest::newRow("another transport") << "-o NEW --transports can --loads idle"
                                       << "--transports: there is no 'can'";
    QTest::newRow("a period without a unit") << "-o NEW --periods 10 --loads idle"
                                             << "'10' is not a period";
    QTest::newRow("a short period") << "-o NEW --periods 99us --loads idle"
                                    << "'99us' is not a period";
    QTest::newRow("no processor") << "-o NEW --cpu 1023 --loads idle"
                                  << "cpu: wanted 1023";
    QStringList many;
    for (int i = 0; i < 101; ++i)
        many << QString("%1ms").arg(i + 1);
    QTest::newRow("many cases") << "-o NEW --loads idle --periods " + many.join(',') << "202 cases are too many";
}

void tst_qtplc_alone::campaignRefusesWhatItCannotMeasure()
{
    QFETCH(QString, options);
    QFETCH(QString, error);
    QTemporaryDir folder;
    const QString output = folder.filePath("jitter");
    const Outcome outcome = qtplc(("campaign " + options.replace("NEW", output)).split(' ', Qt::SkipEmptyParts));
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY2(outcome.errors.contains(error), qPrintable(outcome.errors));
    QCOMPARE(outcome.output, QString());
    QVERIFY(!QFileInfo::exists(output));
}

// ---- find ----

void tst_qtplc_alone::findListsMastersWithoutAnAddress()
{
    const RuntimeFolder folder;
    ProcessPlant here;
    QVERIFY(here.start());
    const QString address = "127.0.0.1:" + here.port;
    const Outcome text = qtplc({"find", "--seconds", "0.5"});
    QCOMPARE(text.exitCode, 0);
    QVERIFY2(text.output.contains(address + "  awe_master  this computer  insecure"), qPrintable(text.output));
    const QJsonArray found = jsonOf(qtplc({"find", "--seconds=0.5", "--json"}).output).array();
    QCOMPARE(found.size(), 1);
    QCOMPARE(found.at(0)["address"].toString(), address);
    QCOMPARE(found.at(0)["local"].toBool(), true);
    QCOMPARE(found.at(0)["secured"].toBool(), false);

    // One that is not seen as one of this computer, but sends beacons.
    Program far(programPath("awe_master"), {"--port=0", "--beacon"});
    QVERIFY(far.waitForOutput("\n"));
    const QString port = far.output().section('\n', 0, 0).section(' ', 1);
    const RuntimeFolder other;
    const Outcome heard = qtplc({"find", "--seconds=3"});
    QVERIFY2(heard.output.contains("127.0.0.1:" + port + "  awe_master  network  insecure"), qPrintable(heard.output));
    QVERIFY(!heard.output.contains(address));
}

void tst_qtplc_alone::findReportsThatThereIsNoMaster()
{
    const RuntimeFolder folder;
    const Outcome none = qtplc({"find", "--seconds=0.3"});
    const Outcome json = qtplc({"find", "--seconds=0.3", "--json"});
    QCOMPARE(none.exitCode, 1);
    QCOMPARE(none.output, QString());
    QVERIFY2(none.errors.contains("found no master in 0.3 s; start one"), qPrintable(none.errors));
    QCOMPARE(json.output, QString("[]\n"));
    QCOMPARE(qtplc({"find", "--seconds=0"}).exitCode, 2);
    QCOMPARE(qtplc({"find", "kite"}).exitCode, 2);
}

QTEST_GUILESS_MAIN(tst_qtplc_alone)
#include "tst_qtplc_alone.moc"
