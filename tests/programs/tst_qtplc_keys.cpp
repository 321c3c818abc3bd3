// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ProcessPlant.h"

#include <QtPlcCore>

#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

namespace {

/// A tool that asks for all signals, again and again, before it has an answer.
class Flooder
{
public:
    static constexpr int Questions = 1500;

    Flooder(const QString &port, const QString &keysFile)
    {
        m_socket.setSecurity(QPlcSecurity::preSharedKeys(keysFile));
        QObject::connect(&m_socket, &QPlcAbstractSocket::connected, &m_socket, [this] {
            m_socket.sendMessage(
                QPlcMessage(QPlcMessage::Hello, {{"protocol", 2}, {"name", "bert"}, {"role", "tool"}}));
        });
        QObject::connect(&m_socket, &QPlcAbstractSocket::messageReceived, &m_socket,
                         [this](const QPlcMessage &message) {
                             answers += message.kind() == QPlcMessage::Signals;
                             for (int i = 0; message.kind() == QPlcMessage::Hello && i < Questions; ++i)
                                 m_socket.sendMessage(QPlcMessage(QPlcMessage::GetSignals));
                         });
        m_socket.connectToMaster(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, quint16(port.toInt())));
    }
    int answers = 0;

private:
    QPlcMasterSocket m_socket;
};

}  // namespace

/// Keys by the tool, and a plant of programs that is secured with them.
class tst_qtplc_keys : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_folder.reset(new QTemporaryDir); }
    void keysAreMadeShownAndRevoked();
    void keysSurviveALossOfPower_data();
    void keysSurviveALossOfPower();
    void filesThatCannotBeSyncedAreReported_data();
    void filesThatCannotBeSyncedAreReported();
    void otherLinesOfTheFileStay();
    void mistakesAreReportedInOneSentence_data();
    void mistakesAreReportedInOneSentence();
    void keysFileReadableByOthersIsRefused();
    void programsRunWithKeys();
    void startsNeedArmingUnlessDisabled();
    void stopDoesNotWaitForAFloodOfQuestions();
    void aSecuredFlightStartsWithItsNodes();
    void optionsThatDoNotFitAreRefused_data();
    void optionsThatDoNotFitAreRefused();

private:
    QString path(const char *name) const { return m_folder->filePath(QString::fromLatin1(name)); }
    Outcome keys(const QStringList &arguments, const char *file = "keys.ini") const
    {
        return runProgram(programPath("qtplc"), QStringList{"keys"} + arguments + QStringList{"--keys", path(file)});
    }
    QByteArray content(const char *name) const
    {
        QFile file(path(name));
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray("none");
    }
    /// Makes a key of `Model` while strace, with these options, writes `trace`.
    Outcome tracedKey(const QStringList &options, const QStringList &arguments) const
    {
        return runProgram("strace",
                          QStringList{"-f", "-qq", "-y", "-o", path("trace")} + options
                              + QStringList{programPath("qtplc"), "keys", "new", "Model"} + arguments);
    }
    QScopedPointer<QTemporaryDir> m_folder;
};

namespace {

bool canTrace()
{
    return runProgram("strace", {"-f", "-qq", "-o", "/dev/null", "true"}).exitCode == 0;
}

}  // namespace

void tst_qtplc_keys::keysAreMadeShownAndRevoked()
{
    const Outcome made = keys({"new", "Model", "--copy", path("model.ini")});
    QCOMPARE(made.errors, QString());
    QCOMPARE(made.exitCode, 0);
    QCOMPARE(keys({"new", "anna", "--role", "Operator"}).exitCode, 0);
    const QByteArray text = content("keys.ini");
    QVERIFY(text.startsWith(content("model.ini")));
    QVERIFY(
        QRegularExpression("^\\[Model\\]\nkey = [0-9a-f]{64}\nrole = Node\n$").match(content("model.ini")).hasMatch());
    const QString key = QString::fromLatin1(content("model.ini").split('\n').at(1).mid(6));
    QVERIFY(!made.output.contains(key));
    for (const char *file : {"keys.ini", "model.ini"})
        QCOMPARE(QFile::permissions(path(file)) & 0x077, QFile::Permissions());
    const Outcome list = keys({"list"});
    QVERIFY2(list.output.contains("Model     Node") && list.output.contains("anna      Operator"),
             qPrintable(list.output));
    QVERIFY(!list.output.contains(key));
    QCOMPARE(jsonOf(keys({"list", "--json"}).output).array().size(), 2);
    QCOMPARE(keys({"new", "Model"}).exitCode, 1);
    QCOMPARE(content("keys.ini"), text);
    QCOMPARE(keys({"new", "Model", "--replace"}).exitCode, 0);
    QVERIFY(!content("keys.ini").contains(key.toLatin1()));
    QCOMPARE(keys({"revoke", "Model"}).exitCode, 0);
    QVERIFY(!content("keys.ini").contains("Model") && content("keys.ini").contains("anna"));
    QCOMPARE(keys({"revoke", "anna"}).exitCode, 0);
    QCOMPARE(keys({"list"}).exitCode, 0);
}

void tst_qtplc_keys::keysSurviveALossOfPower_data()
{
    QTest::addColumn<QString>("name");
    QTest::newRow("file") << "keys.ini";
    QTest::newRow("link to a file of another folder") << "link.ini";
}

void tst_qtplc_keys::keysSurviveALossOfPower()
{
    QFETCH(QString, name);
    if (!canTrace())
        QSKIP("strace is not there, or may not trace");
    const QString folder = path(name == "link.ini" ? "real" : ".");
    QVERIFY(QDir().mkpath(folder) && QFile::link("real/keys.ini", path("link.ini")));
    const Outcome made = tracedKey({"-e", "trace=fsync,fdatasync,linkat,rename,renameat,renameat2"},
                                   {"--keys", m_folder->filePath(name)});
    QCOMPARE(made.errors, QString());
    const QStringList calls = QString::fromUtf8(content("trace")).split('\n').filter(m_folder->path());
    const int named = calls.indexOf(QRegularExpression(".*(link|rename).*keys\\.ini.*"));
    QVERIFY2(named > 0, qPrintable(calls.join('\n')));
    QVERIFY2(calls.at(named - 1).contains("sync("), qPrintable(calls.join('\n')));  // the keys
    QVERIFY2(calls.value(named + 1).contains(QRegularExpression("fsync\\(\\d+<" + QDir::cleanPath(folder) + ">")),
             qPrintable(calls.join('\n')));  // their name
}

void tst_qtplc_keys::filesThatCannotBeSyncedAreReported_data()
{
    QTest::addColumn<QStringList>("fault");
    QTest::addColumn<QString>("report");
    QTest::addColumn<bool>("isWritten");
    const QString notSynced = "is written, but may not survive a loss of power: ";
    QTest::newRow("file system without sync") << QStringList{"inject=fsync:error=EINVAL"} << "" << true;
    QTest::newRow("disk fails") << QStringList{"inject=fsync:error=EIO"} << "cannot write %1: Input/output error"
                                << false;
    QTest::newRow("disk fails at the folder")
        << QStringList{"inject=fsync:error=EIO", "-P", "FOLDER"} << "%1 " + notSynced + "Input/output error" << true;
    // Each file opens its folder twice: for a file without a name, and to sync.
    QTest::newRow("folder of mode 0300") << QStringList{"inject=openat:error=EACCES:when=2+2", "-P", "FOLDER"}
                                         << "%1 " + notSynced + "Permission denied" << true;
}

void tst_qtplc_keys::filesThatCannotBeSyncedAreReported()
{
    QFETCH(QStringList, fault);
    QFETCH(QString, report);
    QFETCH(bool, isWritten);
    if (!canTrace())
        QSKIP("strace is not there, or may not trace");
    const Outcome made = tracedKey(QStringList{"-e"} + fault.replaceInStrings("FOLDER", m_folder->path()),
                                   {"--keys", path("keys.ini"), "--copy", path("model.ini")});
    QCOMPARE(made.exitCode, isWritten ? 0 : 1);
    for (const char *name : {"keys.ini", "model.ini"})
        QCOMPARE(content(name).contains("[Model]"), isWritten);
    QVERIFY2(made.errors.contains(QString(report).replace("%1", path("keys.ini"))), qPrintable(made.errors));
    QCOMPARE(made.errors.count("may not survive"), report.contains("may not survive") ? 2 : 0);
    QCOMPARE(made.errors.isEmpty(), report.isEmpty());
}

void tst_qtplc_keys::otherLinesOfTheFileStay()
{
    QCOMPARE(keys({"new", "a"}).exitCode, 0);
    QFile file(path("keys.ini"));
    QVERIFY(file.open(QIODevice::ReadWrite));
    const QByteArray first = file.readAll();
    file.seek(0);
    file.write("; keys of the north plant\n" + first + "; the others");
    file.close();
    QCOMPARE(keys({"new", "b"}).exitCode, 0);
    QCOMPARE(keys({"revoke", "b"}).exitCode, 0);
    QCOMPARE(content("keys.ini"), "; keys of the north plant\n" + first + "; the others\n");
}

void tst_qtplc_keys::mistakesAreReportedInOneSentence_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<int>("exitCode");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("no action") << QStringList{"make"} << 2 << "keys make: use new, list or revoke";
    QTest::newRow("no identity") << QStringList{"new"} << 2 << "keys new needs an IDENTITY";
    QTest::newRow("too much") << QStringList{"list", "a"} << 2 << "keys list takes no IDENTITY";
    QTest::newRow("bad identity") << QStringList{"new", "a b"} << 2 << "'a b' is not a valid identity";
    QTest::newRow("bad role") << QStringList{"new", "a", "--role", "king"} << 2 << "--role 'king': use Observer";
    QTest::newRow("no file") << QStringList{"list"} << 1 << "cannot open";
    QTest::newRow("nobody to revoke") << QStringList{"revoke", "a"} << 1 << "cannot open";
    QTest::newRow("no folder") << QStringList{"new", "a", "--copy", "/nowhere/a.ini"} << 1
                               << "cannot write /nowhere/a.ini";
}

void tst_qtplc_keys::mistakesAreReportedInOneSentence()
{
    QFETCH(QStringList, arguments);
    QFETCH(int, exitCode);
    QFETCH(QString, sentence);
    const Outcome outcome = keys(arguments);
    QCOMPARE(outcome.exitCode, exitCode);
    QVERIFY2(outcome.errors.contains(sentence), qPrintable(outcome.errors));
    QCOMPARE(outcome.errors.count('\n'), 1);
}

void tst_qtplc_keys::keysFileReadableByOthersIsRefused()
{
    QCOMPARE(keys({"new", "a"}).exitCode, 0);
    QVERIFY(QFile::setPermissions(path("keys.ini"), QFile::ReadOwner | QFile::WriteOwner | QFile::ReadOther));
    for (const QStringList &arguments : {QStringList{"list"}, QStringList{"new", "b"}, QStringList{"revoke", "a"}}) {
        const Outcome outcome = keys(arguments);
        QCOMPARE(outcome.exitCode, 1);
        QVERIFY2(outcome.errors.contains("chmod 600 " + path("keys.ini")), qPrintable(outcome.errors));
    }
}

void tst_qtplc_keys::programsRunWithKeys()
{
    for (const char *name : {"Model", "Autopilot"})
        QCOMPARE(keys({"new", name, "--copy", path(name)}).exitCode, 0);
    QCOMPARE(keys({"new", "anna", "--role", "Operator", "--copy", path("anna")}).exitCode, 0);
    QCOMPARE(keys({"new", "bert", "--role", "Observer", "--copy", path("bert")}).exitCode, 0);
    Program master(programPath("awe_master"), {"--port=0", "--security=psk", "--keys=" + path("keys.ini")});
    QVERIFY(master.waitForOutput("\n"));
    const QString port = master.output().section('\n', 0, 0).section(' ', 1);
    const auto secured = [&](const char *name) {
        return QStringList{"--master=127.0.0.1:" + port, "--security=psk", "--keys=" + path(name)};
    };
    Program model(programPath("awe_model"), secured("Model"));
    Program autopilot(programPath("awe_autopilot"), secured("Autopilot"));
    QVERIFY2(model.waitForErrors("registered") && autopilot.waitForErrors("registered"), qPrintable(model.errors()));
    const auto qtplc = [&](const char *who, const QStringList &command) {
        return runProgram(programPath("qtplc"), secured(who) + command);
    };
    const Outcome denied = qtplc("bert", {"start"});
    QCOMPARE(denied.exitCode, 1);
    QVERIFY2(denied.errors.contains("Denied: role Observer may not send InitializeAllStates"),
             qPrintable(denied.errors));
    QCOMPARE(qtplc("bert", {"get", "power", "--plain"}).exitCode, 0);
    QCOMPARE(qtplc("anna", {"start", "--cycles", "10"}).exitCode, 0);
    QCOMPARE(qtplc("bert", {"echo", "power", "--count", "1"}).exitCode, 0);
    QCOMPARE(qtplc("bert", {"stop"}).exitCode, 0);
    const Outcome plain = runProgram(programPath("qtplc"), {"--master=127.0.0.1:" + port, "state"});
    QCOMPARE(plain.exitCode, 1);
    QVERIFY2(plain.errors.contains("this master is secured; connect with --security psk"), qPrintable(plain.errors));
    QCOMPARE(keys({"revoke", "anna"}).exitCode, 0);
    const Outcome revoked = qtplc("anna", {"state"});
    QCOMPARE(revoked.exitCode, 2);
    QVERIFY2(revoked.errors.contains("does not know identity 'anna'"), qPrintable(revoked.errors));
    QVERIFY2(master.waitForErrors("unknown identity 'anna'"), qPrintable(master.errors()));
}

void tst_qtplc_keys::startsNeedArmingUnlessDisabled()
{
    QCOMPARE(keys({"new", "anna", "--role", "Operator"}).exitCode, 0);
    for (const bool isArming : {true, false}) {
        QStringList options{"--port=0", "--security=psk", "--keys=" + path("keys.ini")};
        if (!isArming)
            options << "--no-arming";
        Program master(programPath("awe_master"), options);
        QVERIFY(master.waitForOutput("\n"));
        const QString port = master.output().section('\n', 0, 0).section(' ', 1);
        const Outcome state = runProgram(
            programPath("qtplc"),
            {"--master=127.0.0.1:" + port, "--security=psk", "--keys=" + path("keys.ini"), "state", "--json"});
        QCOMPARE(jsonOf(state.output).object().value("armingRequired"), QJsonValue(isArming));
    }
}

void tst_qtplc_keys::stopDoesNotWaitForAFloodOfQuestions()
{
    QCOMPARE(keys({"new", "anna", "--role", "Operator", "--copy", path("anna")}).exitCode, 0);
    QCOMPARE(keys({"new", "bert", "--role", "Observer", "--copy", path("bert")}).exitCode, 0);
    Program master(programPath("awe_master"),
                   {"--port=0", "--security=psk", "--no-arming", "--keys=" + path("keys.ini")});
    QVERIFY(master.waitForOutput("\n"));
    const QString port = master.output().section('\n', 0, 0).section(' ', 1);
    const QStringList anna{"--master=127.0.0.1:" + port, "--security=psk", "--keys=" + path("anna")};
    const auto run = [&](const char *command) {  // while the flood is read
        Program program(programPath("qtplc"), anna + QStringList{QString::fromLatin1(command), "--json"});
        (void)waitUntil([&] { return program.state() == QProcess::NotRunning; }, 60000);
        return Outcome{program.waitForEnd(), program.output(), program.errors()};
    };
    QCOMPARE(run("start").exitCode, 0);
    std::vector<std::unique_ptr<Flooder>> flood;
    const auto answers = [&] {
        int count = 0;
        for (const auto &flooder : flood)
            count += flooder->answers;
        return count;
    };
    for (int i = 0; i < 4; ++i)
        flood.push_back(std::make_unique<Flooder>(port, path("bert")));
    QVERIFY(waitUntil([&] { return answers() > 0; }));
    const Outcome stop = run("stop");
    const int answered = answers();
    QVERIFY2(stop.exitCode == 0, qPrintable(stop.errors));
    QVERIFY2(answered < 4 * Flooder::Questions / 2, qPrintable(QString::number(answered)));
    QCOMPARE(jsonOf(run("state").output).object().value("state").toString(), QString("Off"));
    QVERIFY(answers() < 4 * Flooder::Questions);  // else the flood was too short to show anything
}

void tst_qtplc_keys::aSecuredFlightStartsWithItsNodes()
{
    for (const char *name : {"Model", "Autopilot"})
        QCOMPARE(keys({"new", name, "--copy", path(name)}).exitCode, 0);
    Program master(programPath("awe_master"),
                   {"--port=0", "--security=psk", "--keys=" + path("keys.ini"), "--start-with=Model,Autopilot",
                    "--lockstep", "--duration=1"});
    QVERIFY(master.waitForOutput("\n"));
    const QString port = master.output().section('\n', 0, 0).section(' ', 1);
    const auto node = [&](const char *program, const char *name) {
        return std::make_unique<Program>(
            programPath(program), QStringList{"--master=127.0.0.1:" + port, "--security=psk", "--keys=" + path(name)});
    };
    const auto model = node("awe_model", "Model");
    const auto autopilot = node("awe_autopilot", "Autopilot");
    QVERIFY2(master.waitForEnd() == 0, qPrintable(master.errors()));
}

void tst_qtplc_keys::optionsThatDoNotFitAreRefused_data()
{
    QTest::addColumn<QString>("options");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("unknown") << "--security=ssh"
                             << "--security 'ssh': use psk or cert";
    QTest::newRow("no keys") << "--security=psk"
                             << "--security psk needs --keys FILE";
    QTest::newRow("no certificate") << "--security=cert"
                                    << "--security cert needs --certificate FILE";
    QTest::newRow("keys alone") << "--keys=keys.ini"
                                << "--keys is for --security psk";
    QTest::newRow("no file") << "--security=psk --keys=/nowhere/keys.ini"
                             << "cannot open /nowhere/keys.ini";
}

void tst_qtplc_keys::optionsThatDoNotFitAreRefused()
{
    QFETCH(QString, options);
    QFETCH(QString, sentence);
    for (const char *program : {"awe_master", "awe_model", "qtplc"}) {
        QStringList arguments = options.split(' ');
        if (QLatin1String(program) == QLatin1String("qtplc"))
            arguments << "state";
        const Outcome outcome = runProgram(programPath(program), arguments);
        QCOMPARE(outcome.exitCode, 2);
        QVERIFY2(outcome.errors.contains(sentence), qPrintable(outcome.errors));
    }
}

QTEST_GUILESS_MAIN(tst_qtplc_keys)
#include "tst_qtplc_keys.moc"
