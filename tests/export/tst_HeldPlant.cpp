// SPDX-License-Identifier: Apache-2.0
// A plant inside of a host: scenarios of hold_plant, a host in C without Qt, whose nodes are
// programs on the network.
#include "HeldPlantConfiguration.h"

#include <QtCore/QMap>
#include <QtCore/QProcess>
#include <QtTest/QTest>

using qplc_export::HeldPlantConfiguration;

class tst_HeldPlant : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void configurationIsRead();
    void wrongConfigurationsAreRefusedWithTheirLine_data();
    void wrongConfigurationsAreRefusedWithTheirLine();
    void allErrorsOfAConfigurationAreToldAtOnce();

    void valuesPassWithoutADelayOfTheHost_data() { versions(); }
    void valuesPassWithoutADelayOfTheHost() { run("values_pass"); }
    void stepsAreWholePeriods_data() { versions(); }
    void stepsAreWholePeriods() { run("wrong_steps"); }
    void wrongSettingsAreNamed_data() { versions(); }
    void wrongSettingsAreNamed() { run("wrong_settings"); }
    void nodesNeedTheKeysOfThePlant_data() { versions(); }
    void nodesNeedTheKeysOfThePlant() { run("keys"); }
    void portInUseIsNamed_data() { versions(); }
    void portInUseIsNamed() { run("port_in_use"); }
    void nodesThatNeverComeAreNamedInTime_data() { versions(); }
    void nodesThatNeverComeAreNamedInTime() { run("absent_nodes"); }
    void twoPlantsAreIndependent_data() { versions(); }
    void twoPlantsAreIndependent() { run("two_plants"); }
    void twoLibrariesShareAnApplication_data() { versions(); }
    void twoLibrariesShareAnApplication() { run("two_libraries"); }
    void killedRequiredNodeIsAWarning_data() { versions(); }
    void killedRequiredNodeIsAWarning() { run("killed_required"); }
    void killedCriticalNodeIsAnError_data() { versions(); }
    void killedCriticalNodeIsAnError() { run("killed_critical"); }
    void hangingRequiredNodeCostsTheLimitOnce_data() { versions(); }
    void hangingRequiredNodeCostsTheLimitOnce() { run("hanging_required"); }
    void hangingCriticalNodeIsAnErrorAtTheLimit_data() { versions(); }
    void hangingCriticalNodeIsAnErrorAtTheLimit() { run("hanging_critical"); }
    void failureOfARequiredNodeIsAnErrorOfItsStep_data() { versions(); }
    void failureOfARequiredNodeIsAnErrorOfItsStep() { run("failing_required"); }
    void failureOfACriticalNodeIsAnErrorOfItsStep_data() { versions(); }
    void failureOfACriticalNodeIsAnErrorOfItsStep() { run("failing_critical"); }
    void stopByAPersonEndsTheSimulation_data() { versions(); }
    void stopByAPersonEndsTheSimulation() { run("stop_by_a_person"); }
    void hostMayExitBeforeThePhase_data() { versions(); }
    void hostMayExitBeforeThePhase() { run("exits_early"); }
    void nodesEndWithTheHost_data() { versions(); }
    void nodesEndWithTheHost() { run("ends"); }

    void valuesPassThroughRecords() { call("values_pass"); }
    void wrongSettingsOfALibraryAreNamed() { call("wrong_settings"); }
    void killedRequiredNodeIsAWarningOfTheLibrary() { call("killed_required"); }
    void killedCriticalNodeIsAFailureOfTheLibrary() { call("killed_critical"); }
    void stopByAPersonIsAFailureOfTheLibrary() { call("stop_by_a_person"); }

private:
    static void versions();
    static void run(const char *scenario);
    static void call(const char *scenario);
    static void expectSuccess(const char *program, const QStringList &arguments);
};

namespace {

QPlcSignalTable table()
{
    return QPlcSignalTable::fromIni("[speed]\ntype = Real64\n[length]\ntype = Real64\n[time]\ntype = DateTime\n");
}

}  // namespace

void tst_HeldPlant::configurationIsRead()
{
    HeldPlantConfiguration configuration;
    QString error;
    QVERIFY2(configuration.read("; a plant\n[plant]\ncritical = Model, Autopilot\nrequired = Display\nport = 0\n"
                                "longest_wait = 250 ms\nkeys = /etc/keys.ini\ntime_signal = time\nprofile = Plant\n"
                                "[host]\ngives = speed\ngets = length\n",
                                table(), &error),
             qPrintable(error));
    QCOMPARE(configuration.manifest.nodes.size(), 3);
    QCOMPARE(configuration.manifest.find("Autopilot")->need, QPlcManifest::Critical);
    QCOMPARE(configuration.manifest.find("Display")->need, QPlcManifest::Required);
    QCOMPARE(configuration.manifest.profile, QPlcProfile::Plant);
    QCOMPARE(configuration.timeSignal, QString("time"));
    QCOMPARE(configuration.gives, QStringList{"speed"});
    QCOMPARE(configuration.gets, QStringList{"length"});
    QMap<QString, QString> settings;
    for (const QPlcSignalDefinition &setting : qAsConst(configuration.settings))
        settings[setting.name] = setting.initial.toString();
    QCOMPARE(settings["plant.port"], QString("0"));
    QCOMPARE(settings["plant.keys"], QString("/etc/keys.ini"));
    QCOMPARE(settings["plant.longest_wait"], QString("0.25"));
    QCOMPARE(settings["plant.start_timeout"], QString("30"));
    QCOMPARE(settings["plant.listen"], QString());
}

void tst_HeldPlant::wrongConfigurationsAreRefusedWithTheirLine_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("sentence");
    const QByteArray plant = "[plant]\ncritical = Model\n";
    const QByteArray host = "[host]\ngets = length\n";
    QTest::newRow("empty") << QByteArray() << "names no node";
    QTest::newRow("no nodes") << host << "names no node; write critical = NODE";
    QTest::newRow("no signals") << plant << "no signals for the host";
    QTest::newRow("section") << QByteArray("[pant]\n") << ":1: unknown section [pant]; use [plant] or [host]";
    QTest::newRow("no section") << QByteArray("port = 1\n") << ":1: 'port = 1' is not expected here";
    QTest::newRow("no value") << QByteArray("[plant]\nport\n") << ":2: 'port' is not expected here; write KEY = VALUE";
    QTest::newRow("key") << plant + "prot = 1\n"
                         << ":3: unknown key 'prot'; use critical, required, time_signal";
    QTest::newRow("port") << plant + "port = often\n"
                          << ":3: port = often: use a whole number, 0 ... 65535";
    QTest::newRow("port 70000") << plant + "port = 70000\n"
                                << ":3: port = 70000: use a whole number, 0 ... 65535";
    QTest::newRow("text") << plant + "listen = " + QByteArray(65, '1') + "\n"
                          << ": the text is longer than 64 bytes";
    QTest::newRow("nan") << plant + "longest_wait = nan s\n"
                         << ":3: longest_wait = nan s: use 1 ms to 3600 s";
    QTest::newRow("key twice") << plant + "port = 1\nport = 2\n"
                               << ":4: 'port' is there twice, first in line 3; leave one of them out";
    QTest::newRow("no unit") << plant + "longest_wait = 5\n"
                             << ":3: longest_wait = 5: use 1 ms to 3600 s";
    QTest::newRow("too long") << plant + "start_timeout = 3601 s\n"
                              << ":3: start_timeout = 3601 s: use 1 ms to 3600 s";
    QTest::newRow("profile") << plant + "profile = plant\n"
                             << ":3: profile = plant: use Simulation or Plant";
    QTest::newRow("time") << plant + "time_signal = tome\n"
                          << ":3: unknown signal 'tome'; did you mean 'time'";
    QTest::newRow("node twice") << plant + "required = Model\n"
                                << ":3: node 'Model' is named twice";
    QTest::newRow("no node") << plant + "required = A,,B\n"
                             << ":3: the name of a node is missing";
    QTest::newRow("signal") << plant + "[host]\ngets = lenght\n"
                            << ":4: unknown signal 'lenght'; did you mean 'length'";
    QTest::newRow("both") << plant + host + "gives = length\n"
                          << ":5: signal 'length' is named twice";
    QTest::newRow("host key") << plant + "[host]\ntakes = length\n"
                              << ":4: unknown key 'takes'; use gives or gets";
    QTest::newRow("time given") << plant + "time_signal = time\n[host]\ngives = time\n"
                                << ":5: the master writes 'time'";
}

void tst_HeldPlant::wrongConfigurationsAreRefusedWithTheirLine()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, sentence);
    HeldPlantConfiguration configuration;
    QString error;
    QVERIFY(!configuration.read(text, table(), &error));
    QVERIFY2(error.contains(sentence), qPrintable(error));
}

void tst_HeldPlant::allErrorsOfAConfigurationAreToldAtOnce()
{
    HeldPlantConfiguration configuration;
    QString error;
    QVERIFY(!configuration.read("port = 1\n[plant]\nport = 70000\nport = 1\nlongest_wait = 5\n[plan]\nport = often\n"
                                "[host]\ngets = lenght\ngives = speed\n",
                                table(), &error));
    QCOMPARE(error.split('\n').size(), 6);
    for (const char *line : {":1: 'port = 1' is not expected here", ":3: port = 70000", ":4: 'port' is there twice",
                             ":5: longest_wait = 5", ":6: unknown section [plan]", ":9: unknown signal 'lenght'"})
        QVERIFY2(error.contains(line), qPrintable(error));
    QVERIFY(!configuration.read("[plant]\n" + QByteArray("port = x\n").repeated(100), table(), &error));
    QCOMPARE(error.split('\n').size(), 11);
    QVERIFY2(error.endsWith("there are 90 more errors"), qPrintable(error));
}

void tst_HeldPlant::versions()
{
    QTest::addColumn<int>("version");
    QTest::newRow("FMI 2") << 2;
    QTest::newRow("FMI 3") << 3;
}

void tst_HeldPlant::run(const char *scenario)
{
    QFETCH(int, version);
    expectSuccess(HOLD_PLANT,
                  {scenario, QString::number(version), QLatin1String(version == 2 ? HELD_PLANT_FMI2 : HELD_PLANT_FMI3),
                   QLatin1String(PLANT_PART), QLatin1String(QTPLC), QLatin1String(WORK_FOLDER)});
}

void tst_HeldPlant::call(const char *scenario)
{
    expectSuccess(HOLD_TURBINE,
                  {scenario, QLatin1String(HELD_TURBINE), QLatin1String(HELD_TURBINE_RECORDS),
                   QLatin1String(WORK_FOLDER), QLatin1String(PLANT_PART), QLatin1String(QTPLC)});
}

void tst_HeldPlant::expectSuccess(const char *program, const QStringList &arguments)
{
    QProcess host;
    host.setProcessChannelMode(QProcess::MergedChannels);
    host.start(QLatin1String(program), arguments);
    const bool hasEnded = host.waitForFinished(50000);
    const QByteArray output = host.readAll();
    if (!hasEnded) {
        host.kill();
        host.waitForFinished();
    }
    QVERIFY2(hasEnded, "the host does not end\n" + output);
    QVERIFY2(host.exitStatus() == QProcess::NormalExit && host.exitCode() == 0, output);
    qInfo("%s", output.constData());
}

QTEST_GUILESS_MAIN(tst_HeldPlant)
#include "tst_HeldPlant.moc"
