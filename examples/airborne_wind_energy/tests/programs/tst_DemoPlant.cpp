// SPDX-License-Identifier: Apache-2.0
#include "DemoPlant.h"
#include "Witness.h"

#include <QtCore/QFile>
#include <QtCore/QTemporaryDir>
#include <QtNetwork/QTcpServer>

#include <csignal>

/// The demo, as the Control Center sees it.
class tst_DemoPlant : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void cleanup();
    void demoFliesTheKiteAndEndsAllItsPrograms();
    void missingProgramIsNamedWithTheRemedy_data();
    void missingProgramIsNamedWithTheRemedy();
    void killedProgramIsNamedAndARestartFliesOnTheSamePort_data();
    void killedProgramIsNamedAndARestartFliesOnTheSamePort();
    void endedProgramIsNamedWithItsLastErrorLine();
    void demoEndsSuspendedPrograms();
    void restartUsesAnotherPortWhenTheFirstIsInUse();
    void peopleStopAndStartTheFlight();
    void startOfARunningDemoReportsItsAddressAgain();
};

void tst_DemoPlant::cleanup()
{
    QCOMPARE(childrenOf(QCoreApplication::applicationPid()), QList<qint64>());
}

void tst_DemoPlant::demoFliesTheKiteAndEndsAllItsPrograms()
{
    QList<qint64> pids;
    {
        awe::DemoPlant demo;
        QSignalSpy listening(&demo, &awe::DemoPlant::listening);
        QCOMPARE(demo.address(), QString());
        demo.start();
        QVERIFY(listening.wait(Program::patience));
        QCOMPARE(listening.at(0).at(0).toString(), demo.address());
        Witness witness;
        QVERIFY2(witness.join(demo.address()), qPrintable(witness.errorString()));
        QVERIFY(witness.seesCycles(50));
        pids = childrenOf(QCoreApplication::applicationPid());
        QCOMPARE(pids.size(), 3);
    }
    QCOMPARE(stillRunning(pids), QList<qint64>());
}

void tst_DemoPlant::missingProgramIsNamedWithTheRemedy_data()
{
    QTest::addColumn<QStringList>("there");
    QTest::addColumn<QString>("missing");
    QTest::newRow("none there") << QStringList() << QStringLiteral("awe_master");
    QTest::newRow("no model") << QStringList{QStringLiteral("awe_master"), QStringLiteral("awe_autopilot")}
                              << QStringLiteral("awe_model");
    QTest::newRow("no autopilot") << QStringList{QStringLiteral("awe_master"), QStringLiteral("awe_model")}
                                  << QStringLiteral("awe_autopilot");
}

void tst_DemoPlant::missingProgramIsNamedWithTheRemedy()
{
    QFETCH(QStringList, there);
    QFETCH(QString, missing);
    QTemporaryDir folder;
    for (const QString &name : there)
        QVERIFY(QFile::link(QStringLiteral(AWE_PROGRAMS "/") + name, folder.filePath(name)));
    awe::DemoPlant demo(folder.path());
    QSignalSpy failed(&demo, &awe::DemoPlant::failed);
    demo.start();
    QCOMPARE(failed.size(), 1);
    const QString sentence = failed.at(0).at(0).toString();
    QVERIFY2(sentence.contains(missing) && sentence.contains(folder.path())
                 && sentence.contains(QLatin1String("cmake --build")),
             qPrintable(sentence));
    QVERIFY(!demo.isRunning());
}

void tst_DemoPlant::killedProgramIsNamedAndARestartFliesOnTheSamePort_data()
{
    QTest::addColumn<QByteArray>("victim");
    for (const char *name : {"awe_master", "awe_model", "awe_autopilot"})
        QTest::newRow(name) << QByteArray(name);
}

void tst_DemoPlant::killedProgramIsNamedAndARestartFliesOnTheSamePort()
{
    QFETCH(QByteArray, victim);
    awe::DemoPlant demo;
    QSignalSpy listening(&demo, &awe::DemoPlant::listening);
    QSignalSpy failed(&demo, &awe::DemoPlant::failed);
    demo.start();
    QVERIFY(listening.wait(Program::patience));
    const QString address = demo.address();
    QTRY_VERIFY_WITH_TIMEOUT(childNamed(victim) != 0, Program::patience);
    ::kill(pid_t(childNamed(victim)), SIGKILL);
    QVERIFY(failed.wait(Program::patience));
    const QString sentence = failed.at(0).at(0).toString();
    QVERIFY2(sentence.startsWith(QString::fromLatin1(victim) + QStringLiteral(" has ended (Killed)")),
             qPrintable(sentence));
    demo.restart();
    QTRY_COMPARE_WITH_TIMEOUT(listening.size(), 2, Program::patience);
    QCOMPARE(demo.address(), address);
    Witness witness;
    QVERIFY2(witness.join(demo.address()), qPrintable(witness.errorString()));
    QVERIFY(witness.seesCycles(50));
    QCOMPARE(failed.size(), 1);  // those that followed the first are no news
}

void tst_DemoPlant::endedProgramIsNamedWithItsLastErrorLine()
{
    QTemporaryDir folder;
    for (const char *name : {"awe_master", "awe_autopilot"})
        QVERIFY(QFile::link(QStringLiteral(AWE_PROGRAMS "/") + QString::fromLatin1(name),
                            folder.filePath(QString::fromLatin1(name))));
    QFile model(folder.filePath(QStringLiteral("awe_model")));
    QVERIFY(model.open(QIODevice::WriteOnly));
    model.write("#!/bin/sh\necho 'awe_model: calm' >&2\necho 'awe_model: there is no wind' >&2\nexit 2\n");
    QVERIFY(model.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner));
    model.close();
    awe::DemoPlant demo(folder.path());
    QSignalSpy failed(&demo, &awe::DemoPlant::failed);
    demo.start();
    QVERIFY(failed.wait(Program::patience));
    QCOMPARE(failed.at(0).at(0).toString(), QStringLiteral("awe_model has ended (exit code 2): there is no wind"));
}

void tst_DemoPlant::demoEndsSuspendedPrograms()
{
    QList<qint64> pids;
    {
        awe::DemoPlant demo;
        QSignalSpy listening(&demo, &awe::DemoPlant::listening);
        demo.start();
        QVERIFY(listening.wait(Program::patience));
        pids = childrenOf(QCoreApplication::applicationPid());
        for (qint64 pid : pids)
            ::kill(pid_t(pid), SIGSTOP);
    }
    QCOMPARE(stillRunning(pids), QList<qint64>());
}

void tst_DemoPlant::restartUsesAnotherPortWhenTheFirstIsInUse()
{
    awe::DemoPlant demo;
    QSignalSpy listening(&demo, &awe::DemoPlant::listening);
    demo.start();
    QVERIFY(listening.wait(Program::patience));
    const QString address = demo.address();
    for (qint64 pid : childrenOf(QCoreApplication::applicationPid()))
        ::kill(pid_t(pid), SIGKILL);
    QTRY_VERIFY_WITH_TIMEOUT(!demo.isRunning(), Program::patience);
    QTcpServer other;
    QVERIFY(other.listen(QHostAddress::LocalHost, address.section(QLatin1Char(':'), 1).toUShort()));
    demo.restart();
    QTRY_COMPARE_WITH_TIMEOUT(listening.size(), 2, Program::patience);
    QVERIFY(demo.address() != address);
}

void tst_DemoPlant::peopleStopAndStartTheFlight()
{
    awe::DemoPlant demo;
    QSignalSpy listening(&demo, &awe::DemoPlant::listening);
    QSignalSpy failed(&demo, &awe::DemoPlant::failed);
    demo.start();
    QVERIFY(listening.wait(Program::patience));
    Witness person;
    QVERIFY2(person.join(demo.address()), qPrintable(person.errorString()));
    QVERIFY(person.seesCycles(20));
    QSignalSpy stopped(&person, &QPlcSlaveNode::realTimeHasStopped);
    person.stop();
    QVERIFY(stopped.wait(Program::patience));
    const int cycles = person.cycles();
    person.startRealTime();
    QTRY_VERIFY_WITH_TIMEOUT(person.cycles() > cycles + 20, Program::patience);
    QCOMPARE(failed.size(), 0);
}

void tst_DemoPlant::startOfARunningDemoReportsItsAddressAgain()
{
    awe::DemoPlant demo;
    QSignalSpy listening(&demo, &awe::DemoPlant::listening);
    demo.start();
    demo.start();  // nothing, it is on its way
    QVERIFY(listening.wait(Program::patience));
    demo.start();
    QCOMPARE(listening.size(), 2);
    QCOMPARE(listening.at(1).at(0).toString(), demo.address());
    QCOMPARE(childrenOf(QCoreApplication::applicationPid()).size(), 3);
}

QTEST_GUILESS_MAIN(tst_DemoPlant)
#include "tst_DemoPlant.moc"
