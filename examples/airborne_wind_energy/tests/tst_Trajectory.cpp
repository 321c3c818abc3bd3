// SPDX-License-Identifier: Apache-2.0
#include "Trajectory.h"

#include "Near.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QTemporaryDir>

#include <locale>
#include <sstream>

using awe::Trajectory;

class tst_Trajectory : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void readsHeaderAndRows();
    void trajectoryIsWrittenAsItWasRead();
    void everyColumnHasItsPlace();
    void acceptsWindowsLineEnds();
    void readErrorNamesPlaceAndCause_data();
    void readErrorNamesPlaceAndCause();
    void failedReadLeavesTheObjectAlone();
    void missingFileIsNamed();
    void failedSaveLeavesTheOldFileAlone();
    void saveLeavesNoTemporaryFile();

private:
    std::string m_good;  // three rows
};

namespace {

std::string joined(const std::vector<std::string> &lines)
{
    std::string text;
    for (const std::string &line : lines)
        text += line + '\n';
    return text;
}

std::string replaced(std::string text, const std::string &what, const std::string &by)
{
    return text.replace(text.find(what), what.size(), by);
}

}  // namespace

void tst_Trajectory::initTestCase()
{
    QFile file(QStringLiteral(AWE_REFERENCE "/s5_slack_snatch.csv"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    for (int i = 0; i < 8; ++i)
        m_good += file.readLine().toStdString();
    m_good = replaced(m_good, "T = 5 s", "T = 0.02 s");
    std::istringstream stream(m_good);
    const std::string complaint = Trajectory().read(stream, "good");
    QVERIFY2(complaint.empty(), complaint.c_str());
}

void tst_Trajectory::readsHeaderAndRows()
{
    std::istringstream stream(m_good);
    Trajectory trajectory;
    QVERIFY(trajectory.read(stream, "good").empty());
    QCOMPARE(trajectory.windVelocity(), Eigen::Vector3d(5.0, 3.0, 0.0));
    QCOMPARE(trajectory.duration(), 0.02);
    QCOMPARE(trajectory.step(), 0.01);
    QCOMPARE(trajectory.initialState().yawAngle, -45.0);
    QCOMPARE(trajectory.initialState().tetherLength, 100.0);
    QCOMPARE(trajectory.comments().size(), std::size_t(4));
    QCOMPARE(trajectory.rows().size(), std::size_t(3));
    QCOMPARE(trajectory.rows()[2].time, 0.02);
    QCOMPARE(trajectory.rows()[0].outputs.gravitationalForce.z(), -49.05);
}

void tst_Trajectory::trajectoryIsWrittenAsItWasRead()
{
    std::istringstream in(m_good);
    std::ostringstream out;
    Trajectory trajectory;
    QVERIFY(trajectory.read(in, "good").empty());
    trajectory.write(out);
    QCOMPARE(QString::fromStdString(out.str()), QString::fromStdString(m_good));
}

void tst_Trajectory::everyColumnHasItsPlace()
{
    Trajectory::Columns columns{};
    for (std::size_t i = 0; i < columns.size(); ++i)
        columns[i] = 100.0 + static_cast<double>(i);
    const Trajectory::Row row = Trajectory::fromColumns(columns);
    QCOMPARE(Trajectory::toColumns(row), columns);
    QCOMPARE(row.outputs.inputs.tetherSpeed, 103.0);
    QCOMPARE(row.outputs.inputs.windVelocity.x(), 110.0);
    QCOMPARE(row.outputs.angleOfAttack, 119.0);
    QCOMPARE(row.outputs.tetherForce.z(), 131.0);
    QCOMPARE(row.outputs.energy, 135.0);
}

void tst_Trajectory::acceptsWindowsLineEnds()
{
    std::string text;
    for (char c : m_good)
        text += c == '\n' ? std::string("\r\n") : std::string(1, c);
    std::istringstream stream(text);
    const std::string complaint = Trajectory().read(stream, "dos");
    QVERIFY2(complaint.empty(), complaint.c_str());
}

void tst_Trajectory::readErrorNamesPlaceAndCause_data()
{
    QTest::addColumn<QString>("what");
    QTest::addColumn<QString>("by");
    QTest::addColumn<QString>("message");
    const auto row = [](const char *name, const char *what, const char *by, const char *message) {
        QTest::newRow(name) << QString::fromLatin1(what) << QString::fromLatin1(by) << QString::fromLatin1(message);
    };
    row("no wind", "# wind = ", "# breeze = ", "f:5: no comment line '# wind = ");
    row("wind of two numbers", "[5 3 0]", "[5 3]", "f:2: wind has not 3 numbers");
    row("wind with letters", "[5 3 0]", "[5 x 0]", "f:2: wind is 'x'; write a finite number");
    row("no duration", "; T = ", "; time = ", "f:2: the duration is not written");
    row("no step", "rk4 step", "euler step", "f:2: the step is not written");
    row("step too long", "step 0.01 s", "step 1 s", "f:5: step is 1 s; choose a value from");
    row("negative duration", "T = 0.02 s", "T = -1 s", "f:5: T is not between");
    row("no initial state", "# x0 = ", "# x1 = ", "f:5: no comment line '# x0 = ");
    row("initial state too short", " 100 0 0]", " 100 0]", "f:3: x0 has not 11 numbers");
    row("initial state not closed", " 100 0 0]", " 100 0 0", "f:3: the initial state is not written");
    row("wrong column", ",tetherSpeed,", ",ropeSpeed,", "f:5: column 4 is 'ropeSpeed'; it must be 'tetherSpeed'");
    row("column missing", ",energy\n", "\n", "f:5: column 36 is ''; it must be 'energy'");
    row("column too many", ",energy\n", ",energy,money\n", "f:5: column 37 is 'money'; remove it");
    row("value missing", "0.01,0,", "0.01,", "f:7: only 35 of 36 values");
    row("value too many", "0.01,0,", "0.01,0,0,", "f:7: more than 36 values");
    row("not a number", "0.01,0,", "0.01,zero,", "f:7: bodyControlPitchSpeed is 'zero'");
    row("not finite", "0.01,0,", "0.01,inf,", "f:7: bodyControlPitchSpeed is 'inf'");
    row("empty value", "0.01,0,", "0.01,,", "f:7: bodyControlPitchSpeed is ''");
    row("number with a tail", "0.01,0,", "0.01,0m,", "f:7: bodyControlPitchSpeed is '0m'");
    row("wrong time", "\n0.01,0,", "\n0.015,0,", "f:7: time 0.015000 s in row 1");
    row("rows missing", "T = 0.02 s", "T = 0.03 s", "f:9: the file ends after 3 rows");
    row("rows too many", "T = 0.02 s", "T = 0.01 s", "f:8: more rows than the 2");
}

void tst_Trajectory::readErrorNamesPlaceAndCause()
{
    QFETCH(QString, what);
    QFETCH(QString, by);
    QFETCH(QString, message);
    QVERIFY(m_good.find(what.toStdString()) != std::string::npos);
    std::istringstream stream(replaced(m_good, what.toStdString(), by.toStdString()));
    VERIFY_CONTAINS(Trajectory().read(stream, "f"), message.toStdString());
}

void tst_Trajectory::failedReadLeavesTheObjectAlone()
{
    std::istringstream good(m_good), bad(replaced(m_good, "0.02,", "x,"));
    Trajectory trajectory;
    QVERIFY(trajectory.read(good, "good").empty());
    QVERIFY(!trajectory.read(bad, "bad").empty());
    QCOMPARE(trajectory.rows().size(), std::size_t(3));
    QCOMPARE(trajectory.comments().size(), std::size_t(4));
    std::istringstream empty(joined({}));
    VERIFY_CONTAINS(trajectory.read(empty, "empty"), "empty:1: no comment line");
}

void tst_Trajectory::missingFileIsNamed()
{
    VERIFY_CONTAINS(Trajectory().load("/nowhere/flight.csv"), "/nowhere/flight.csv: cannot be opened for reading");
}

void tst_Trajectory::failedSaveLeavesTheOldFileAlone()
{
    VERIFY_CONTAINS(Trajectory().save("/nowhere/flight.csv"), "/nowhere/flight.csv: ");
    QTemporaryDir folder;
    QVERIFY(QDir(folder.path()).mkdir(QStringLiteral("taken")));  // a folder cannot be replaced by a file
    const QString taken = folder.filePath(QStringLiteral("taken"));
    VERIFY_CONTAINS(Trajectory().save(taken.toStdString()), "cannot be replaced");
    QCOMPARE(QDir(folder.path()).entryList(QDir::AllEntries | QDir::NoDotAndDotDot),
             QStringList{QStringLiteral("taken")});
}

void tst_Trajectory::saveLeavesNoTemporaryFile()
{
    QTemporaryDir folder;
    std::istringstream in(m_good);
    Trajectory trajectory;
    QVERIFY(trajectory.read(in, "good").empty());
    const QString path = folder.filePath(QStringLiteral("flight.csv"));
    QVERIFY(trajectory.save(path.toStdString()).empty());
    QVERIFY(trajectory.save(path.toStdString()).empty());  // over the old one
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files), QStringList{QStringLiteral("flight.csv")});
    Trajectory again;
    QVERIFY(again.load(path.toStdString()).empty());
    QCOMPARE(again.rows().size(), std::size_t(3));
}

QTEST_APPLESS_MAIN(tst_Trajectory)
#include "tst_Trajectory.moc"
