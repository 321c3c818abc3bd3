// SPDX-License-Identifier: Apache-2.0
#include "Program.h"

#include <QtPlcCore>

#include <QtCore/QFile>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

#include <atomic>
#include <csignal>

namespace {

constexpr int enabled = 1;      // DriveState::Enabled
constexpr int stopButton = 17;  // line of the emergency stop in winch.ini

/// Listens to a flight, and notes what becomes of the signals of the winch, in this order.
class Witness : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    enum Stage { NothingYet, DriveFollows, ValuesAreHeld, ValuesAreSafe, DriveFollowsAgain };

    Witness()
        : QPlcCompactSlaveNode(QStringLiteral("Witness"))
    {
        setListener(true);
        setReceivesQuality(true);
    }
    ~Witness() override { disconnectFromMaster(); }

    bool sees(Stage stage)
    {
        return QTest::qWaitFor([&] { return m_stage >= stage; }, Program::patience);
    }
    double speedWhenSafe() const { return m_speedWhenSafe; }

private:
    void step(const QPlcCycle &) override
    {
        const QPlcQuality quality = m_speed.quality();
        const bool follows = quality.isGood() && m_state == enabled;
        if (m_stage == ValuesAreHeld && quality.kind() == QPlcQuality::Safe)
            m_speedWhenSafe = m_speed;
        if ((m_stage == NothingYet && follows) || (m_stage == DriveFollows && quality.kind() == QPlcQuality::Held)
            || (m_stage == ValuesAreHeld && quality.kind() == QPlcQuality::Safe)
            || (m_stage == ValuesAreSafe && follows))
            m_stage = m_stage + 1;
    }

    std::atomic<int> m_stage{NothingYet};
    std::atomic<double> m_speedWhenSafe{-1.0};
    QPlcInput<double> m_speed{this, "winchSpeed"};  // [m/s]
    QPlcInput<qint8> m_state{this, "winchState"};
};

}  // namespace

/// Flights whose winch is a drive behind a CAN bus, a program of its own.
class tst_WinchFlight : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void winchKindReplacesTheIdealWinchByADrive();
    void idealWinchIsTheDefault();
    void driveGivenReplacesTheMachineOfTheFileInEveryProgram();
    void driveRefusesLockstepSimulation();
    void missingConfigurationIsNamed();
    void emergencyStopStopsDriveAndFlight();
    void killedNodeHoldsThenEntersSafeStateThenRecovers();
    void lostDriveCanReconnect();
    void oneOptionFliesWithADriveOnCanOpen();
    void aDriveOnCanOpenFollowsStopsQuicklyAndFollowsAgain();

private:
    static QString path(const char *program) { return QStringLiteral(AWE_PROGRAMS "/") + QString::fromLatin1(program); }
    /// Copies the files of the example to a folder of this test.
    /// \param simulated  whether awe_sil starts the drive
    /// \param kind       of the winch
    /// \return the file of the plant
    QString plant(bool simulated, const QByteArray &kind = "drive");
    QStringList flightWithRealDrive() { return {"--plant", plant(false), "--duration=0", "--report", reportFile()}; }
    QString reportFile() const { return m_folder->filePath(QStringLiteral("report.json")); }
    QJsonObject report() const;
    void setButton(bool pressed);
    /// Lets \a witness listen to the flight of \a sil. \return false when that did not work out
    static bool listen(Witness &witness, Program &sil);
    static qint64 childOf(const Program &program, const QByteArray &name);

    std::unique_ptr<QTemporaryDir> m_folder;  // also of the devices
};

void tst_WinchFlight::init()
{
    m_folder = std::make_unique<QTemporaryDir>();
    qputenv("QTPLC_FAKE_DEVICES", m_folder->path().toLocal8Bit());
}

QString tst_WinchFlight::plant(bool simulated, const QByteArray &kind)
{
    for (const char *name : {"plant.ini", "winch.ini", "winch_drive.dbc", "winch-canopen.ini", "winch_drive.eds"})
        QFile::copy(QStringLiteral(AWE_HARDWARE "/") + QString::fromLatin1(name),
                    m_folder->filePath(QString::fromLatin1(name)));
    QFile file(m_folder->filePath(QStringLiteral("plant.ini")));
    file.open(QIODevice::ReadOnly);
    QByteArray text = file.readAll().replace("kind = ideal", "kind = " + kind);
    file.close();
    if (!simulated)
        text.replace("simulated = fake:winch", "simulated =");
    file.open(QIODevice::WriteOnly | QIODevice::Truncate);
    file.write(text);
    return file.fileName();
}

QJsonObject tst_WinchFlight::report() const
{
    QFile file(reportFile());
    return file.open(QIODevice::ReadOnly) ? QJsonDocument::fromJson(file.readAll()).object() : QJsonObject();
}

void tst_WinchFlight::setButton(bool pressed)
{
    QFile file(m_folder->filePath(QStringLiteral("buttons")));
    QVERIFY(file.open(QIODevice::ReadWrite));
    if (file.size() == 0)
        file.write(QByteArray(32, '\0'));
    file.seek(stopButton);
    file.write(QByteArray(1, pressed ? '\1' : '\0'));
}

bool tst_WinchFlight::listen(Witness &witness, Program &sil)
{
    if (!sil.waitForErrors(QStringLiteral("node Winch registered over")))
        return false;
    const QString port = sil.errors().section(QStringLiteral(" port "), 1).section(QLatin1Char(' '), 0, 0);
    return witness.connectToMasterAndWaitForConnected(
        QPlcUnderlyingProtocol::fromString(QStringLiteral("127.0.0.1:%1").arg(port)));
}

qint64 tst_WinchFlight::childOf(const Program &program, const QByteArray &name)
{
    for (const qint64 pid : childrenOf(program.processId())) {
        if (nameOf(pid) == name)
            return pid;
    }
    return 0;
}

void tst_WinchFlight::winchKindReplacesTheIdealWinchByADrive()
{
    const Outcome outcome
        = runProgram(path("awe_sil"), {"--plant", plant(true), "--duration=10", "--report", reportFile()});
    QVERIFY2(outcome.exitCode == 0, qPrintable(outcome.errors));
    QVERIFY2(outcome.output.contains(QLatin1String("\n  winch drive ")), qPrintable(outcome.output));

    const QJsonObject flight = report();
    QStringList inputs;  // of the model
    const QJsonArray links = flight.value(QStringLiteral("links")).toArray();
    for (const QJsonValue link : links) {
        if (link[QStringLiteral("to")] == QStringLiteral("Model"))
            inputs << link[QStringLiteral("from")].toString() + '.' + link[QStringLiteral("signal")].toString();
    }
    QVERIFY(inputs.contains(QStringLiteral("Winch.winchSpeed")));
    QVERIFY(!inputs.contains(QStringLiteral("Autopilot.tetherSpeed")));

    const QJsonObject winch = flight.value(QStringLiteral("winch")).toObject();
    for (const char *figure :
         {"mechanical_energy_J", "electrical_energy_J", "losses_J", "speed_error_rms_m_s", "speed_error_max_m_s",
          "position_error_m", "max_current_A", "disabled_s", "interruptions"})
        QVERIFY2(winch.value(QLatin1String(figure)).isDouble(), figure);
    QVERIFY(winch.value(QStringLiteral("mechanical_energy_J")).toDouble() > 1000.0);
    QVERIFY(winch.value(QStringLiteral("losses_J")).toDouble() > 0.0);
    QVERIFY(winch.value(QStringLiteral("max_current_A")).toDouble() > 5.0);
}

void tst_WinchFlight::idealWinchIsTheDefault()
{
    QJsonValue digest;
    for (const char *option : {"--lockstep", "--winch=ideal", "--plant=" AWE_HARDWARE "/plant.ini"}) {
        QCOMPARE(runProgram(path("awe_sil"), {option, "--duration=10", "--report", reportFile()}).exitCode, 0);
        const QJsonObject flight = report();
        QVERIFY(!flight.contains(QStringLiteral("winch")));
        if (digest.isNull())
            digest = flight.value(QStringLiteral("image_digest"));
        QCOMPARE(flight.value(QStringLiteral("image_digest")), digest);
    }
}

/// A program that only read the file would refuse it: a machine and mode drag exclude each other.
void tst_WinchFlight::driveGivenReplacesTheMachineOfTheFileInEveryProgram()
{
    const Outcome outcome = runProgram(
        path("awe_sil"),
        {"--plant", plant(true, "machine"), "--winch=drive", "--mode=drag", "--duration=2", "--report", reportFile()});
    QVERIFY2(outcome.exitCode == 0, qPrintable(outcome.errors));
    QVERIFY(report().contains(QStringLiteral("winch")));
    QVERIFY(report().contains(QStringLiteral("turbine_power_W")));
}

void tst_WinchFlight::driveRefusesLockstepSimulation()
{
    const Outcome outcome = runProgram(path("awe_sil"), {"--winch=drive", "--lockstep"});
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY2(outcome.errors.contains(QLatin1String("use --real-time or --scale")), qPrintable(outcome.errors));
}

void tst_WinchFlight::missingConfigurationIsNamed()
{
    const QString plantFile = plant(true);
    QFile::remove(m_folder->filePath(QStringLiteral("winch.ini")));
    const Outcome outcome = runProgram(path("awe_sil"), {"--plant", plantFile});
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY2(outcome.errors.contains(m_folder->filePath(QStringLiteral("winch.ini"))), qPrintable(outcome.errors));
}

void tst_WinchFlight::emergencyStopStopsDriveAndFlight()
{
    setButton(false);
    Program drive(path("awe_winch_drive"), {});
    Program sil(path("awe_sil"), flightWithRealDrive());
    Witness witness;
    QVERIFY2(listen(witness, sil), qPrintable(sil.errors()));
    QVERIFY(witness.sees(Witness::DriveFollows));
    setButton(true);
    QCOMPARE(sil.waitForEnd(), 1);
    QVERIFY2(sil.errors().contains(QLatin1String("the plant has stopped safely (node 'Winch' asked for it")),
             qPrintable(sil.errors()));
    QVERIFY(report().contains(QStringLiteral("winch")));
    // Told to stop, not left alone: else it would say CommandLost.
    const auto hasStopped
        = [&] { return drive.output().section(QStringLiteral("Enabled\n"), 1).endsWith("Disabled (Command)\n"); };
    QVERIFY2(QTest::qWaitFor(hasStopped, Program::patience), qPrintable(drive.output()));
    drive.sendSignal(SIGTERM);
    QCOMPARE(drive.waitForEnd(), 0);
}

void tst_WinchFlight::killedNodeHoldsThenEntersSafeStateThenRecovers()
{
    setButton(false);
    Program drive(path("awe_winch_drive"), {});
    Program sil(path("awe_sil"), flightWithRealDrive());
    Witness witness;
    QVERIFY2(listen(witness, sil), qPrintable(sil.errors()));
    QVERIFY(witness.sees(Witness::DriveFollows));
    const qint64 node = childOf(sil, "qtplc_hardware");
    QVERIFY(node > 0);
    ::kill(pid_t(node), SIGKILL);
    QVERIFY(witness.sees(Witness::ValuesAreSafe));
    QCOMPARE(witness.speedWhenSafe(), 0.0);
    QVERIFY2(drive.waitForOutput(QStringLiteral("(CommandLost)")), qPrintable(drive.output()));
    QVERIFY(witness.sees(Witness::DriveFollowsAgain));
    sil.sendSignal(SIGTERM);
    QCOMPARE(sil.waitForEnd(), 0);
    QVERIFY(report().value(QStringLiteral("winch"))[QStringLiteral("interruptions")].toInt() >= 1);
    QVERIFY(!report().value(QStringLiteral("crashed")).toBool(true));
}

void tst_WinchFlight::lostDriveCanReconnect()
{
    setButton(false);
    auto drive = std::make_unique<Program>(path("awe_winch_drive"), QStringList());
    Program sil(path("awe_sil"), flightWithRealDrive());
    Witness witness;
    QVERIFY2(listen(witness, sil), qPrintable(sil.errors()));
    QVERIFY(witness.sees(Witness::DriveFollows));
    drive->kill();
    QVERIFY(witness.sees(Witness::ValuesAreSafe));
    QCOMPARE(witness.speedWhenSafe(), 0.0);
    drive = std::make_unique<Program>(path("awe_winch_drive"), QStringList());
    QVERIFY(witness.sees(Witness::DriveFollowsAgain));
    sil.sendSignal(SIGTERM);
    QCOMPARE(sil.waitForEnd(), 0);
}

void tst_WinchFlight::oneOptionFliesWithADriveOnCanOpen()
{
    const Outcome outcome
        = runProgram(path("awe_sil"), {"--winch", "canopen", "--duration=6", "--report", reportFile()});
    QVERIFY2(outcome.exitCode == 0, qPrintable(outcome.errors));
    const QJsonObject winch = report().value(QStringLiteral("winch")).toObject();
    QVERIFY2(winch[QStringLiteral("mechanical_energy_J")].toDouble() > 0.0, qPrintable(outcome.output));
    QVERIFY(winch[QStringLiteral("max_current_A")].toDouble() > 0.0);
}

void tst_WinchFlight::aDriveOnCanOpenFollowsStopsQuicklyAndFollowsAgain()
{
    setButton(false);
    QFile file(plant(false));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray text = file.readAll().replace("hardware = winch.ini", "hardware = winch-canopen.ini");
    file.close();
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(text) == text.size());
    file.close();
    Program drive(path("awe_winch_drive"), {"--canopen"});
    Program sil(path("awe_sil"), {"--plant", file.fileName(), "--duration=0", "--report", reportFile()});
    Witness witness;
    QVERIFY2(listen(witness, sil), qPrintable(sil.errors()));
    QVERIFY2(witness.sees(Witness::DriveFollows), qPrintable(sil.errors() + drive.errors()));
    // The program of the master is killed: nobody tells the drive to stop.
    const qint64 node = childOf(sil, "qtplc_hardware");
    QVERIFY(node > 0);
    ::kill(pid_t(node), SIGKILL);
    QVERIFY(witness.sees(Witness::ValuesAreSafe));
    const auto hasStopped = [&] {
        return drive.output().section(QStringLiteral("Enabled\n"), 1).contains(QStringLiteral("Disabled (Command)\n"));
    };
    QVERIFY2(QTest::qWaitFor(hasStopped, Program::patience), qPrintable(drive.output()));
    QVERIFY(witness.sees(Witness::DriveFollowsAgain));
    sil.sendSignal(SIGTERM);
    QCOMPARE(sil.waitForEnd(), 0);
    QVERIFY(report().value(QStringLiteral("winch"))[QStringLiteral("mechanical_energy_J")].toDouble() > 0.0);
    drive.sendSignal(SIGTERM);
    QCOMPARE(drive.waitForEnd(), 0);
}

QTEST_GUILESS_MAIN(tst_WinchFlight)
#include "tst_WinchFlight.moc"
