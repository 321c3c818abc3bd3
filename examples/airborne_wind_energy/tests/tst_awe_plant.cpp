// SPDX-License-Identifier: Apache-2.0
#include "ExtendedTrajectory.h"
#include "Trajectory.h"

#include "Near.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QProcess>
#include <QtCore/QTemporaryDir>

using awe::Trajectory;

/// The program awe_plant, from outside.
class tst_awe_plant : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void programReplaysEveryReferenceFlight_data();
    void programReplaysEveryReferenceFlight();
    void programReplaysFlightsWithOptions();
    void programRefusesInvalidHeadersOfOptions_data();
    void programRefusesInvalidHeadersOfOptions();
    void programRefusesInvalidArguments_data();
    void programRefusesInvalidArguments();
    void programRefusesInvalidFilesAndWritesNothing_data();
    void programRefusesInvalidFilesAndWritesNothing();
    void outputMayReplaceTheInputFile();
    void helpIsWrittenToStandardOutput();

private:
    struct Result
    {
        int exitCode;
        QString output, errors;
    };
    static Result run(const QStringList &arguments);
    QString reference(const QString &name) const { return QStringLiteral(AWE_REFERENCE "/") + name; }
    QTemporaryDir m_folder;
};

tst_awe_plant::Result tst_awe_plant::run(const QStringList &arguments)
{
    QProcess process;
    process.start(QStringLiteral(AWE_PLANT), arguments);
    if (!process.waitForFinished(60000) || process.exitStatus() != QProcess::NormalExit)
        return {-1, QString(), process.errorString()};
    return {process.exitCode(), QString::fromUtf8(process.readAllStandardOutput()),
            QString::fromUtf8(process.readAllStandardError())};
}

void tst_awe_plant::programReplaysEveryReferenceFlight_data()
{
    QTest::addColumn<QString>("name");
    for (const char *name :
         {"s1_straight.csv", "s3_reel_out_eights.csv", "s5_slack_snatch.csv", "s8_negative_alpha.csv"})
        QTest::newRow(name) << QString::fromLatin1(name);
}

void tst_awe_plant::programReplaysEveryReferenceFlight()
{
    QFETCH(QString, name);
    const QString output = m_folder.filePath(name);
    const Result result = run({QStringLiteral("--replay"), reference(name), QStringLiteral("--out"), output});
    QVERIFY2(result.exitCode == 0, qPrintable(result.errors));
    QCOMPARE(result.errors, QString());

    Trajectory recorded, flown;
    QVERIFY(recorded.load(reference(name).toStdString()).empty());
    QVERIFY(flown.load(output.toStdString()).empty());
    QVERIFY(flown.comments() == recorded.comments());
    QCOMPARE(flown.rows().size(), recorded.rows().size());
    const auto expected = Trajectory::toColumns(recorded.rows().back()),
               seen = Trajectory::toColumns(flown.rows().back());
    for (std::size_t i = 0; i < expected.size(); ++i)
        COMPARE_NEAR(seen[i], expected[i], 1e-9 * (1.0 + std::abs(expected[i])));
}

void tst_awe_plant::programReplaysFlightsWithOptions()
{
    const QString output = m_folder.filePath(QStringLiteral("p7.csv"));
    const QString input = reference(QStringLiteral("p7_drag_mode.csv"));
    const Result result = run({QStringLiteral("--replay"), input, QStringLiteral("--out"), output});
    QVERIFY2(result.exitCode == 0, qPrintable(result.errors));
    awe::ExtendedTrajectory recorded, flown;
    QVERIFY(recorded.load(input.toStdString()).empty());
    QVERIFY(flown.load(output.toStdString()).empty());
    QCOMPARE(flown.rows().size(), recorded.rows().size());
    for (std::size_t i = 0; i < awe::ExtendedTrajectory::columnCount; ++i) {
        const double expected = recorded.rows().back()[i];
        COMPARE_NEAR(flown.rows().back()[i], expected, 1e-9 * (1.0 + std::abs(expected)));
    }
}

void tst_awe_plant::programRefusesInvalidHeadersOfOptions_data()
{
    QTest::addColumn<QByteArray>("before");
    QTest::addColumn<QByteArray>("after");
    QTest::addColumn<QString>("message");
    QTest::newRow("not JSON") << QByteArray("{\"plant2\"") << QByteArray("{plant2") << ":2: the header is not JSON: ";
    QTest::newRow("unknown parameter") << QByteArray("\"parameters\": {}")
                                       << QByteArray("\"parameters\": {\"mast\": 1}")
                                       << ":2: 'parameters' of the header: 'mast': it is not known; use tether, ";
    QTest::newRow("unknown word") << QByteArray("\"parameters\": {}")
                                  << QByteArray("\"parameters\": {\"tether\": \"rope\"}")
                                  << ":2: 'parameters' of the header: 'tether': use one of spring, straight, segments";
    QTest::newRow("not a number") << QByteArray("\"parameters\": {}")
                                  << QByteArray("\"parameters\": {\"hRef\": \"high\"}")
                                  << ":2: 'parameters' of the header: 'hRef': use a number";
    QTest::newRow("out of range") << QByteArray("\"parameters\": {}") << QByteArray("\"parameters\": {\"z0\": 7}")
                                  << ":6: roughness is 7 m; choose a value from ";
    QTest::newRow("too many segments") << QByteArray("\"parameters\": {}")
                                       << QByteArray("\"parameters\": {\"tether\": \"segments\", \"segments\": 7}")
                                       << ":6: the tether has 7 segments; the table has room for 6";
    QTest::newRow("wind") << QByteArray("[5.0, 3.0, 0.0]") << QByteArray("[5.0, 3.0]")
                          << ":2: 'wind_m_s' of the header: use three numbers [x, y, z] from -100 to 100 m/s";
    QTest::newRow("winch") << QByteArray("\"ideal\"") << QByteArray("\"steam\"")
                           << ":2: 'winch' of the header: use one of ideal, machine";
    QTest::newRow("winds in words") << QByteArray("[5.0, 3.0, 0.0]") << QByteArray("[\"strong\", 3.0, 0.0]")
                                    << ":2: 'wind_m_s' of the header: use three numbers";
    QTest::newRow("storm") << QByteArray("[5.0, 3.0, 0.0]") << QByteArray("[1e300, 3.0, 0.0]")
                           << ":2: 'wind_m_s' of the header: use three numbers";
    QTest::newRow("no winch") << QByteArray(", \"winch\": \"ideal\"") << QByteArray()
                              << ":2: the header has no 'winch'; add it";
    QTest::newRow("version") << QByteArray("\"plant2\": 1") << QByteArray("\"plant2\": 2")
                             << ":2: 'plant2' of the header: use 1: this program knows no other version";
    QTest::newRow("typing error") << QByteArray("\"parameters\"") << QByteArray("\"paramters\"")
                                  << ":2: 'paramters' of the header: it is not known; use plant2, parameters, ";
    QTest::newRow("parameters in a list") << QByteArray("\"parameters\": {}") << QByteArray("\"parameters\": [1]")
                                          << ":2: 'parameters' of the header: use an object such as ";
    QTest::newRow("half a segment") << QByteArray("\"parameters\": {}")
                                    << QByteArray("\"parameters\": {\"segments\": 6.5}")
                                    << ":2: 'parameters' of the header: 'segments': use a whole number";
    QTest::newRow("second header") << QByteArray("\n# start:") << QByteArray("\n# plant2 = {}\n# start:")
                                   << ":3: a second header; leave one of them out";
    QTest::newRow("time") << QByteArray("\n0.20000000000000001,") << QByteArray("\n0.25,")
                          << ":8: time 0.250000 s; it must be 0.100000 s after that of the row before";
    QTest::newRow("nodes in one place") << QByteArray("\"parameters\": {}")
                                        << QByteArray("\"parameters\": {\"tether\": \"segments\"}")
                                        << "changed.csv: the flight diverges before 0";
    QTest::newRow("column") << QByteArray(",turbinePower,") << QByteArray(",propeller,")
                            << ":5: column 31 is 'propeller'; it must be 'turbinePower'";
}

void tst_awe_plant::programRefusesInvalidHeadersOfOptions()
{
    QFETCH(QByteArray, before);
    QFETCH(QByteArray, after);
    QFETCH(QString, message);
    QFile original(reference(QStringLiteral("p7_drag_mode.csv")));
    QVERIFY(original.open(QIODevice::ReadOnly));
    QByteArray text = original.readAll();
    QVERIFY(text.contains(before));
    QFile changed(m_folder.filePath(QStringLiteral("changed.csv")));
    QVERIFY(changed.open(QIODevice::WriteOnly | QIODevice::Truncate));
    changed.write(text.replace(before, after));
    changed.close();
    const QString output = m_folder.filePath(QStringLiteral("refused.csv"));
    const Result result = run({QStringLiteral("--replay"), changed.fileName(), QStringLiteral("--out"), output});
    QCOMPARE(result.exitCode, 2);
    QVERIFY2(result.errors.contains(message), qPrintable(result.errors));
    QVERIFY(!QFile::exists(output));
}

void tst_awe_plant::programRefusesInvalidArguments_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("message");
    const auto row = [](const char *name, const char *arguments, const char *message) {
        QTest::newRow(name) << QString::fromLatin1(arguments).split(QLatin1Char(' '), Qt::SkipEmptyParts)
                            << QString::fromLatin1(message);
    };
    row("nothing", "", "option '--replay' is missing");
    row("no output", "--replay a.csv", "option '--out' is missing");
    row("no value", "--replay", "option '--replay' has no value");
    row("twice", "--out a --out b", "option '--out' is there twice");
    row("unknown", "--fly a.csv", "unknown option '--fly'; the options are");
    row("missing file", "--replay /nowhere/a.csv --out b.csv", "/nowhere/a.csv: cannot be opened");
    QTest::newRow("empty value") << QStringList{QStringLiteral("--out"), QString()}
                                 << QStringLiteral("option '--out' has an empty value");
    QTest::newRow("folder that is not there")
        << QStringList{QStringLiteral("--replay"), reference(QStringLiteral("s5_slack_snatch.csv")),
                       QStringLiteral("--out"), QStringLiteral("/nowhere/b.csv")}
        << QStringLiteral("/nowhere/b.csv: ");
}

void tst_awe_plant::programRefusesInvalidArguments()
{
    QFETCH(QStringList, arguments);
    QFETCH(QString, message);
    const Result result = run(arguments);
    QCOMPARE(result.exitCode, 2);
    QCOMPARE(result.output, QString());
    VERIFY_CONTAINS(result.errors.toStdString(), message.toStdString());
    QCOMPARE(result.errors.count(QLatin1Char('\n')), 1);
}

void tst_awe_plant::programRefusesInvalidFilesAndWritesNothing_data()
{
    QTest::addColumn<QByteArray>("content");
    QTest::addColumn<QString>("message");
    QFile file(reference(QStringLiteral("s5_slack_snatch.csv")));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray good = file.readAll();
    QTest::newRow("garbage") << QByteArray("\x00\xff\x13garbage\n", 12) << QStringLiteral(":1: no comment line");
    QTest::newRow("empty") << QByteArray() << QStringLiteral(":1: no comment line");
    QTest::newRow("wrong column") << QByteArray(good).replace("tetherLength", "ropeLength")
                                  << QStringLiteral(":5: column 33 is 'ropeLength'");
    QTest::newRow("cut off") << good.left(good.size() / 2) << QStringLiteral("of 36 values");
}

void tst_awe_plant::programRefusesInvalidFilesAndWritesNothing()
{
    QFETCH(QByteArray, content);
    QFETCH(QString, message);
    QTemporaryDir folder;
    QFile file(folder.filePath(QStringLiteral("in.csv")));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(content);
    file.close();
    const Result result = run({QStringLiteral("--replay"), file.fileName(), QStringLiteral("--out"),
                               folder.filePath(QStringLiteral("out.csv"))});
    QCOMPARE(result.exitCode, 2);
    VERIFY_CONTAINS(result.errors.toStdString(), "in.csv:");
    VERIFY_CONTAINS(result.errors.toStdString(), message.toStdString());
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files), QStringList{QStringLiteral("in.csv")});
}

void tst_awe_plant::outputMayReplaceTheInputFile()
{
    const QString path = m_folder.filePath(QStringLiteral("same.csv"));
    QVERIFY(QFile::copy(reference(QStringLiteral("s8_negative_alpha.csv")), path));
    QVERIFY(QFile::setPermissions(path, QFile::ReadOwner | QFile::WriteOwner));
    QCOMPARE(run({QStringLiteral("--replay"), path, QStringLiteral("--out"), path}).exitCode, 0);
    Trajectory flown;
    QVERIFY(flown.load(path.toStdString()).empty());
}

void tst_awe_plant::helpIsWrittenToStandardOutput()
{
    const Result result = run({QStringLiteral("--help")});
    QCOMPARE(result.exitCode, 0);
    VERIFY_CONTAINS(result.output.toStdString(), "usage: awe_plant --replay IN.csv --out OUT.csv");
    QCOMPARE(result.errors, QString());
}

QTEST_GUILESS_MAIN(tst_awe_plant)
#include "tst_awe_plant.moc"
