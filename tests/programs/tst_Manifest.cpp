// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ProcessPlant.h"

#include <QtCore/QRegularExpression>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

#include <csignal>

/// A plant of programs with a manifest: what is missing is named, and nothing starts.
class tst_Manifest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_folder.reset(new QTemporaryDir); }
    void cleanup();
    void nothingStartsWithoutANeededNode_data();
    void nothingStartsWithoutANeededNode();
    void evictedNodeIsMissingUntilItIsAdmitted();
    void manifestOfTheRunningPlantStartsItAgain();
    void nothingIsWrittenThatCannotBeRead();
    void masterDoesNotStartWithABadManifest_data();
    void masterDoesNotStartWithABadManifest();
    void checkReportsErrorsAndWritersThatNothingNeeds();

private:
    QString file(const char *name, const QByteArray &content) const
    {
        QFile file(m_folder->filePath(QString::fromLatin1(name)));
        if (!file.open(QIODevice::WriteOnly) || file.write(content) != content.size())
            qFatal("cannot write %s", name);
        return file.fileName();
    }
    bool startMaster(const QStringList &options)
    {
        m_plant.reset(new ProcessPlant);
        return m_plant->start(options);
    }
    std::unique_ptr<Program> node(const char *program) const
    {
        auto started = std::make_unique<Program>(programPath(program), QStringList{m_plant->address()});
        return started->waitForErrors(QStringLiteral("registered")) ? std::move(started) : nullptr;
    }
    Outcome check(const QStringList &files) const
    {
        return runProgram(programPath("qtplc"), QStringList{"check"} + files);
    }

    QScopedPointer<QTemporaryDir> m_folder;
    QScopedPointer<ProcessPlant> m_plant;
    std::unique_ptr<Program> m_model, m_autopilot;
};

void tst_Manifest::cleanup()
{
    m_model.reset();
    m_autopilot.reset();
    m_plant.reset();
}

void tst_Manifest::nothingStartsWithoutANeededNode_data()
{
    QTest::addColumn<QString>("need");
    QTest::addColumn<QString>("before");  // what has happened to the plant: words of qtplc
    QTest::addColumn<int>("signal");      // to the autopilot
    QTest::addColumn<QString>("reason");
    for (const char *need : {"critical", "required"}) {
        const auto row = [&](const char *name, const char *before, int signal, const char *reason) {
            QTest::addRow("%s, %s", need, name) << need << before << signal << reason;
        };
        row("killed in Off", "", SIGKILL, "node 'Autopilot' (has left: ");
        row("killed in Ready", "init", SIGKILL, "node 'Autopilot' (has left: ");
        row("ended in Ready", "init", SIGTERM, "node 'Autopilot' (has left: ");
        row("stopped in Off", "", SIGSTOP, "from node 'Autopilot'");
        row("stopped in Ready", "init", SIGSTOP, "from node 'Autopilot'");
    }
}

void tst_Manifest::nothingStartsWithoutANeededNode()
{
    QFETCH(QString, need);
    QFETCH(QString, before);
    QFETCH(int, signal);
    QFETCH(QString, reason);
    const QStringList options{
        "--manifest",
        file("manifest.ini", "profile = Simulation\n[Model]\n[Autopilot]\nneed = " + need.toLatin1() + '\n')};
    QVERIFY(startMaster(options));
    m_model = node("awe_model");
    m_autopilot = node("awe_autopilot");
    QVERIFY(m_model && m_autopilot);
    if (!before.isEmpty())
        QCOMPARE(m_plant->qtplc(before).exitCode, 0);
    m_autopilot->sendSignal(signal);
    if (signal != SIGSTOP)
        QVERIFY(m_plant->master().waitForErrors("node Autopilot "));
    if (signal != SIGSTOP)
        QTRY_VERIFY(m_plant->qtplc("state").output.contains(reason));
    const Outcome start = m_plant->qtplc("start");
    QCOMPARE(start.exitCode, 1);
    QVERIFY2(start.errors.contains(reason), qPrintable(start.errors));
    QVERIFY(m_plant->qtplc("state").output.contains("Off"));
    if (signal == SIGSTOP)
        return;

    QVERIFY(startMaster(options));  // as after a restart of its computer
    m_model = node("awe_model");
    QVERIFY(m_model);
    const Outcome again = m_plant->qtplc("start");
    QCOMPARE(again.exitCode, 1);
    QVERIFY2(again.errors.contains(QStringLiteral("%1 node 'Autopilot' (has not registered) is missing").arg(need)),
             qPrintable(again.errors));
    m_autopilot = node("awe_autopilot");
    QVERIFY(m_autopilot);
    QCOMPARE(m_plant->qtplc("start").exitCode, 0);
}

void tst_Manifest::evictedNodeIsMissingUntilItIsAdmitted()
{
    QVERIFY(startMaster(
        {"--manifest", file("manifest.ini", "profile = Simulation\n[Model]\n[Autopilot]\nneed = critical\n")}));
    m_model = node("awe_model");
    m_autopilot = node("awe_autopilot");
    QVERIFY(m_model && m_autopilot);
    QCOMPARE(m_plant->qtplc("start").exitCode, 0);
    const Outcome unknown = m_plant->qtplc("evict Autopilto");
    QCOMPARE(unknown.exitCode, 1);
    QVERIFY2(unknown.errors.contains("did you mean 'Autopilot'?"), qPrintable(unknown.errors));
    QCOMPARE(m_plant->qtplc("evict Autopilot").output, QString("evicted: Autopilot\n"));
    const QString state = m_plant->qtplc("state").output;
    QVERIFY2(state.contains("Safe stop") && QRegularExpression("evicted +Autopilot").match(state).hasMatch(),
             qPrintable(state));
    QVERIFY(m_plant->qtplc("events").output.contains("'Autopilot' is evicted by "));
    QCOMPARE(m_plant->qtplc("reset").exitCode, 1);
    const Outcome start = m_plant->qtplc("start");
    QCOMPARE(start.exitCode, 1);
    QVERIFY2(start.errors.contains("'Autopilot'"), qPrintable(start.errors));
    QVERIFY(!m_plant->qtplc("state").output.contains("Autopilot  "));  // no row of it
    QCOMPARE(m_plant->qtplc("admit Autopilot").output, QString("admitted: Autopilot\n"));
    m_autopilot = node("awe_autopilot");
    QVERIFY(m_autopilot);
    QCOMPARE(m_plant->qtplc("reset").exitCode, 0);
    QCOMPARE(m_plant->qtplc("start").exitCode, 0);
}

void tst_Manifest::manifestOfTheRunningPlantStartsItAgain()
{
    QVERIFY(startMaster({}));
    m_model.reset(
        new Program(programPath("awe_model"),
                    {m_plant->address(), "--critical", "--watchdog", "0.3", "--watchdog-reaction", "safe-state"}));
    QVERIFY(m_model->waitForErrors("registered"));
    m_autopilot = node("awe_autopilot");
    QVERIFY(m_autopilot);
    const Outcome written = m_plant->qtplc("manifest");
    QCOMPARE(written.exitCode, 0);
    QVERIFY2(written.output.contains("[Model]\nneed = critical\ntransport = udp\nwatchdog = 300 ms\n")
                 && written.output.contains("[Autopilot]\nneed = required\ntransport = udp\n"),
             qPrintable(written.output));
    QCOMPARE(jsonOf(m_plant->qtplc("manifest --json").output).object().value("nodes").toArray().size(),
             3);  // one is in the process of the master

    const QString manifest = file("manifest.ini", written.output.toUtf8());
    QCOMPARE(check({manifest}).exitCode, 0);
    cleanup();
    QVERIFY(startMaster({"--manifest", manifest}));
    m_autopilot = node("awe_autopilot");
    QVERIFY(m_autopilot);
    m_model.reset(new Program(programPath("awe_model"),
                              {m_plant->address(), "--watchdog", "0.3", "--watchdog-reaction", "safe-state"}));
    QVERIFY(m_model->waitForErrors("registered"));
    QVERIFY(m_plant->qtplc("state --verbose").output.contains("true"));  // Model is critical nevertheless
    QCOMPARE(m_plant->qtplc("start").exitCode, 0);
    const Outcome again = m_plant->qtplc("manifest");
    QCOMPARE(again.output.section('\n', 0, 0), written.output.section('\n', 0, 0));
}

void tst_Manifest::nothingIsWrittenThatCannotBeRead()
{
    QVERIFY(startMaster({}));
    m_autopilot.reset(new Program(programPath("awe_autopilot"), {m_plant->address(), "--name", "a]b"}));
    QVERIFY(m_autopilot->waitForErrors("registered"));
    const Outcome unreadable = m_plant->qtplc("manifest");
    QCOMPARE(unreadable.exitCode, 1);
    QCOMPARE(unreadable.output, QString());
    QVERIFY2(unreadable.errors.contains("a manifest cannot have a node of this plant"), qPrintable(unreadable.errors));
    m_plant->master().sendSignal(SIGKILL);
    m_plant->master().waitForEnd();
    const Outcome none = m_plant->qtplc("manifest");
    QCOMPARE(none.exitCode, 2);
    QCOMPARE(none.output, QString());
}

void tst_Manifest::masterDoesNotStartWithABadManifest_data()
{
    QTest::addColumn<QByteArray>("content");  // empty: there is no file
    QTest::addColumn<QString>("error");
    QTest::newRow("no file") << QByteArray() << "manifest.ini: cannot open: ";
    QTest::newRow("no node") << QByteArray("profile = Plant\n") << "manifest.ini: the manifest names no node";
    QTest::newRow("error") << QByteArray("[A]\nneed = x\n") << "manifest.ini:2:8: 'x' is not a need";
    QTest::newRow("identity") << QByteArray("[A]\nidentity = A\n") << "the master has no security";
}

void tst_Manifest::masterDoesNotStartWithABadManifest()
{
    QFETCH(QByteArray, content);
    QFETCH(QString, error);
    const QString manifest = content.isEmpty() ? m_folder->filePath("manifest.ini") : file("manifest.ini", content);
    const Outcome outcome = runProgram(programPath("awe_master"), {"--port=0", "--manifest", manifest});
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY2(outcome.errors.contains(error), qPrintable(outcome.errors));
    QCOMPARE(outcome.output, QString());
}

void tst_Manifest::checkReportsErrorsAndWritersThatNothingNeeds()
{
    const QString table = file("table.ini", "[speed]\ntype = Real\nwriter = Winch > Backup\n");
    const Outcome wrong = check({file("wrong.ini", "[A]\nneed = x\nwatchdog = y\n"), table});
    QCOMPARE(wrong.exitCode, 2);
    QVERIFY(wrong.errors.contains("wrong.ini:2:8: ") && wrong.errors.contains("wrong.ini:3:12: "));
    const Outcome unneeded = check({file("unneeded.ini", "[Winch]\nneed = optional\n"), table});
    QCOMPARE(unneeded.exitCode, 1);
    QVERIFY2(unneeded.errors.contains("signal 'speed' has 'writer = Winch > Backup' in the table"),
             qPrintable(unneeded.errors));
    QCOMPARE(check({file("right.ini", "[Backup]\n"), table}).exitCode, 0);
    const Outcome example = check({QTPLC_MANIFEST, QTPLC_SIGNALS});
    QCOMPARE(example.errors, QString());
    QCOMPARE(example.exitCode, 0);
}

QTEST_GUILESS_MAIN(tst_Manifest)
#include "tst_Manifest.moc"
