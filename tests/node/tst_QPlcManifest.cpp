// SPDX-License-Identifier: Apache-2.0
#include "QPlcManifest.h"

#include <QtTest/QtTest>

using namespace std::chrono_literals;

// The text of a manifest.
class tst_QPlcManifest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everyKeyIsRead();
    void sectionAloneIsARequiredNode();
    void badTextIsRefusedWithPlaceAndRemedy_data();
    void badTextIsRefusedWithPlaceAndRemedy();
    void allErrorsAreReportedInTheOrderOfTheFile();
    void unreadableFileIsOneError();
    void writtenManifestIsReadAsTheSame();
};

void tst_QPlcManifest::everyKeyIsRead()
{
    QVector<QPlcParseError> errors;
    const QPlcManifest manifest
        = QPlcManifest::fromIni("; the kite\nprofile = plant\n\n[Emergency stop]\nneed = critical\n"
                                "transport = udp, tcp\nwatchdog = 0.5 s ; at most\n"
                                "identity = stop-1\n[Camera]\nneed = optional\n",
                                &errors, "kite.ini");
    QCOMPARE(QPlcParseError::toString(errors), QString());
    QCOMPARE(manifest.fileName, QString("kite.ini"));
    QCOMPARE(manifest.profile, QPlcProfile::Plant);
    QCOMPARE(manifest.nodes.size(), 2);
    const QPlcManifest::Node *stop = manifest.find("Emergency stop");
    QVERIFY(stop);
    QCOMPARE(stop->need, QPlcManifest::Critical);
    QCOMPARE(stop->transports, (QStringList{"udp", "tcp"}));
    QCOMPARE(stop->watchdog, std::chrono::nanoseconds(500ms));
    QCOMPARE(stop->identity, QString("stop-1"));
    QCOMPARE(manifest.find("Camera")->need, QPlcManifest::Optional);
    QVERIFY(!manifest.find("camera"));
}

void tst_QPlcManifest::sectionAloneIsARequiredNode()
{
    const QPlcManifest manifest = QPlcManifest::fromIni("[Winch]\n");
    QCOMPARE(manifest.profile, QPlcProfile::Automatic);
    QVERIFY(manifest.find("Winch"));
    QCOMPARE(manifest.find("Winch")->need, QPlcManifest::Required);
    QVERIFY(manifest.find("Winch")->transports.isEmpty());
    QCOMPARE(manifest.find("Winch")->watchdog, std::chrono::nanoseconds(0));
}

void tst_QPlcManifest::badTextIsRefusedWithPlaceAndRemedy_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("error");
    const auto row = [](const char *name, const char *text, const char *error) {
        QTest::newRow(name) << QByteArray(text) << QString::fromUtf8(error);
    };
    row("no node", "; nothing\n", "m.ini: the manifest names no node; write [NAME] for each node that the plant needs");
    row("profile only", "profile = Plant\n",
        "m.ini: the manifest names no node; write [NAME] for each node that the plant needs");
    row("node twice", "[A]\n[B]\n[A]\n", "m.ini:3:2: duplicate node 'A' (first at line 1); remove one");
    row("key twice", "[A]\nneed = critical\nneed = optional\n",
        "m.ini:3:1: duplicate key 'need' (first at line 2); remove one");
    row("unknown key", "[A]\nneeds = critical\n", "m.ini:2:1: unknown key 'needs'; did you mean 'need'?");
    row("unknown need", "[A]\nneed = vital\n", "m.ini:2:8: 'vital' is not a need; use critical, required, optional");
    row("unknown profile", "profile = Plan\n[A]\n",
        "m.ini:1:11: 'Plan' is not a profile; use Plant, Simulation or Automatic");
    row("no node, and another error", "profile = Plan\n",
        "m.ini:1:11: 'Plan' is not a profile; use Plant, Simulation or Automatic");
    row("key before nodes", "need = critical\n[A]\n",
        "m.ini:1:1: the key 'need' stands before the first node; only 'profile' may stand there");
    row("profile of a node", "[A]\nprofile = Plant\n",
        "m.ini:2:1: unknown key 'profile'; the keys are need, transport, watchdog, identity");
    row("unknown transport", "[A]\ntransport = udp, upd\n",
        "m.ini:2:13: 'upd' is not a transport; use one or more of tcp, udp, udp-multicast, local, inprocess");
    row("no transport", "[A]\ntransport =\n",
        "m.ini:2:12: '' is not a transport; use one or more of tcp, udp, udp-multicast, local, inprocess");
    row("watchdog without a unit", "[A]\nwatchdog = 0.5\n",
        "m.ini:2:12: '0.5' is not the time of a watchdog; use 1 ms ... 24 h, as in 'watchdog = 500 ms'");
    row("no watchdog", "[A]\nwatchdog = 0 s\n",
        "m.ini:2:12: '0 s' is not the time of a watchdog; use 1 ms ... 24 h, as in 'watchdog = 500 ms'");
    row("identity with blanks", "[A]\nidentity = the winch\n",
        "m.ini:2:12: 'the winch' is not a valid identity; use 1 ... 64 letters, digits, '.', '-', '_'");
    row("node without a name", "[]\n", "m.ini:1:2: a node needs a name of 1 ... 64 characters");
    row("master", "[Master]\n", "m.ini:1:2: 'Master' is the name of the master; name a node");
    row("not closed", "[A\n", "m.ini:1:3: ']' is missing; write the section as [name]");
    row("no text", "[A]\nneed = critical\xff\n", "m.ini:2:16: byte 0xFF is not UTF-8; save the file as UTF-8");
}

void tst_QPlcManifest::badTextIsRefusedWithPlaceAndRemedy()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, error);
    QVector<QPlcParseError> errors;
    QVERIFY(QPlcManifest::fromIni(text, &errors, "m.ini").isEmpty());
    QCOMPARE(QPlcParseError::toString(errors).trimmed(), error);
}

void tst_QPlcManifest::allErrorsAreReportedInTheOrderOfTheFile()
{
    QVector<QPlcParseError> errors;
    QVERIFY(QPlcManifest::fromIni("[A]\nneed = x\nwatchdog = y\n[A]\n", &errors).isEmpty());
    QCOMPARE(errors.size(), 3);
    QCOMPARE(errors.at(0).line, 2);
    QCOMPARE(errors.at(1).line, 3);
    QCOMPARE(errors.at(2).line, 4);
}

void tst_QPlcManifest::unreadableFileIsOneError()
{
    QVector<QPlcParseError> errors;
    QVERIFY(QPlcManifest::fromIniFile("/nowhere/manifest.ini", &errors).isEmpty());
    QCOMPARE(errors.size(), 1);
    QVERIFY2(errors.first().toString().startsWith("/nowhere/manifest.ini: cannot open: "),
             qPrintable(errors.first().toString()));
    QVERIFY(errors.first().message.endsWith("give the path of a manifest"));
}

void tst_QPlcManifest::writtenManifestIsReadAsTheSame()
{
    QPlcManifest manifest;
    manifest.profile = QPlcProfile::Simulation;
    manifest.nodes = {{"Emergency stop", QPlcManifest::Critical, {"udp", "tcp"}, 500ms, "stop-1"},
                      {"#1; x = y", QPlcManifest::Optional, {}, 1500us, {}},
                      {"Camera", QPlcManifest::Required, {}, 0ns, {}}};
    QVector<QPlcParseError> errors;
    const QPlcManifest again = QPlcManifest::fromIni(manifest.toIni(), &errors);
    QCOMPARE(QPlcParseError::toString(errors), QString());
    QCOMPARE(again.toIni(), manifest.toIni());
    QCOMPARE(again.nodes.size(), 3);
    QCOMPARE(again.nodes.at(1).name, QString("#1; x = y"));
    QCOMPARE(again.nodes.at(1).watchdog, std::chrono::nanoseconds(1500us));
    QCOMPARE(again.profile, QPlcProfile::Simulation);
}

QTEST_GUILESS_MAIN(tst_QPlcManifest)
#include "tst_QPlcManifest.moc"
