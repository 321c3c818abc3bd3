// SPDX-License-Identifier: Apache-2.0
#include "PlantConfiguration.h"
#include "Program.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QRegularExpression>
#include <QtCore/QSet>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

/// Every command of the page with the experiments prints what the page shows, and the page's claims
/// follow from these numbers.
class tst_KiteExperiments : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void commandPrintsWhatThePageShows_data();
    void commandPrintsWhatThePageShows();
    void aFifthOfTheDragIsAlmostFiveTimesAsFast();
    void thePowerComesCloseToTheFormula();
    void reelInPowerAgreesWithTheThesis();
    void softTetherReducesThePeaksOfTheForce();
    void programPrintsTheErrorShownOnThePage();
    void everyPlantFileIsShownAndValid();
    void everyProcessUsesTheConfiguredPlant();

private:
    /// A command of the page and the lines of its output that are shown.
    struct Experiment
    {
        QString command;
        QStringList lines;
    };
    /// The number behind \a label in the lines that the page shows of the command with \a plant; \a
    /// column: from 0.
    double shown(const QString &plant, const QString &label, int column = 0) const;
    QStringList arguments(const QString &command) const;
    static Outcome fly(const QStringList &arguments);

    QString m_page;
    QVector<Experiment> m_experiments;
};

void tst_KiteExperiments::initTestCase()
{
    QVERIFY(QDir::setCurrent(QStringLiteral(AWE_EXAMPLE)));
    QFile file(QStringLiteral(KITE_PAGE));
    QVERIFY(file.open(QIODevice::ReadOnly));
    m_page = QString::fromUtf8(file.readAll());
    static const QRegularExpression pair(QStringLiteral("```sh\n(awe_sil[^\n]*)\n```\n```text\n(.*?)\n```"),
                                         QRegularExpression::DotMatchesEverythingOption);
    for (auto found = pair.globalMatch(m_page); found.hasNext();) {
        const QRegularExpressionMatch match = found.next();
        m_experiments.append({match.captured(1), match.captured(2).split(QLatin1Char('\n'))});
    }
    QCOMPARE(m_experiments.size(), m_page.count(QLatin1String("```sh")));  // no command is without its lines
    QVERIFY(m_experiments.size() >= 12);
}

QStringList tst_KiteExperiments::arguments(const QString &command) const
{
    return command.split(QLatin1Char(' '), Qt::SkipEmptyParts).mid(1);
}

Outcome tst_KiteExperiments::fly(const QStringList &arguments)
{
    return runProgram(QStringLiteral(AWE_PROGRAMS "/awe_sil"), arguments);
}

double tst_KiteExperiments::shown(const QString &plant, const QString &label, int column) const
{
    for (const Experiment &experiment : m_experiments) {
        if (!experiment.command.contains(QStringLiteral("plants/%1.ini").arg(plant)))
            continue;
        for (const QString &line : experiment.lines) {
            if (!line.trimmed().startsWith(label))
                continue;
            static const QRegularExpression number(QStringLiteral("-?\\d+(\\.\\d+)?"));
            auto found = number.globalMatch(line.trimmed().mid(label.size()));
            for (int i = 0; i < column && found.hasNext(); ++i)
                found.next();
            if (found.hasNext())
                return found.next().captured().toDouble();
        }
    }
    return qQNaN();
}

void tst_KiteExperiments::commandPrintsWhatThePageShows_data()
{
    QTest::addColumn<QString>("command");
    QTest::addColumn<QStringList>("lines");
    for (const Experiment &experiment : qAsConst(m_experiments))
        QTest::newRow(qPrintable(experiment.command)) << experiment.command << experiment.lines;
}

void tst_KiteExperiments::commandPrintsWhatThePageShows()
{
    QFETCH(QString, command);
    QFETCH(QStringList, lines);
    const Outcome outcome = fly(arguments(command));
    const bool diverges = command.contains(QLatin1String("diverging"));
    QCOMPARE(outcome.exitCode, diverges ? 2 : 0);
    const QStringList printed = (outcome.output + outcome.errors).split(QLatin1Char('\n'));
    for (const QString &line : lines)
        QVERIFY2(printed.contains(line), qPrintable(line + QStringLiteral("\nis not in\n") + printed.join('\n')));
    QCOMPARE(outcome.output.contains(QLatin1String("CRASHED")), lines.join('\n').contains(QLatin1String("CRASHED")));
}

/// 5 in the steady state; the flight of the page has to come to nine tenths of it.
void tst_KiteExperiments::aFifthOfTheDragIsAlmostFiveTimesAsFast()
{
    const QString speed = QStringLiteral("kite speed");
    const double ratio
        = shown(QStringLiteral("crosswind-drag-fifth"), speed, 1) / shown(QStringLiteral("crosswind"), speed, 1);
    QVERIFY2(ratio > 4.5 && ratio < 5.1, qPrintable(QString::number(ratio)));
    QVERIFY(m_page.contains(QStringLiteral("%1 times the speed").arg(ratio, 0, 'f', 1)));
    const QString force = QStringLiteral("greatest force");
    const double pull
        = shown(QStringLiteral("crosswind-drag-fifth"), force) / shown(QStringLiteral("crosswind"), force);
    QVERIFY(m_page.contains(QStringLiteral("%1 times the force").arg(pull, 0, 'f', 0)));
    const double soft = shown(QStringLiteral("crosswind-soft-drag-fifth"), speed, 1);
    QVERIFY2(soft < 0.6 * shown(QStringLiteral("crosswind-drag-fifth"), speed, 1), qPrintable(QString::number(soft)));
}

/// 2/27 rho A v^3 c_AWE = 3091 W, with 2 % for weight and elevation.
void tst_KiteExperiments::thePowerComesCloseToTheFormula()
{
    const double power = shown(QStringLiteral("max-power-point"), QStringLiteral("greatest power"));
    QVERIFY2(power > 0.98 * 3091.0 && power <= 3091.0, qPrintable(QString::number(power)));
}

void tst_KiteExperiments::reelInPowerAgreesWithTheThesis()
{
    const double power = shown(QStringLiteral("reel-in"), QStringLiteral("reeling out, in"), 1);
    QVERIFY2(qAbs(power + 200.0) < 20.0, qPrintable(QString::number(power)));
}

void tst_KiteExperiments::softTetherReducesThePeaksOfTheForce()
{
    const QString force = QStringLiteral("greatest force");
    QVERIFY(shown(QStringLiteral("soft-tether"), force) < 0.8 * shown(QStringLiteral("stiff-tether"), force));
    const QString power = QStringLiteral("reeling out, in");
    const double ratio = shown(QStringLiteral("soft-tether"), power) / shown(QStringLiteral("stiff-tether"), power);
    QVERIFY2(ratio > 0.9 && ratio < 1.1, qPrintable(QString::number(ratio)));
}

void tst_KiteExperiments::programPrintsTheErrorShownOnThePage()
{
    QTemporaryDir folder;
    QVERIFY(QDir(folder.path()).mkdir(QStringLiteral("plants")));
    QFile heavy(QStringLiteral("plants/heavy.ini"));
    QVERIFY(heavy.open(QIODevice::ReadOnly));
    QFile wrong(folder.filePath(QStringLiteral("plants/heavy.ini")));
    QVERIFY(wrong.open(QIODevice::WriteOnly));
    wrong.write(heavy.readAll().replace("mass = 20", "mass = -20"));
    wrong.close();
    QVERIFY(QDir::setCurrent(folder.path()));
    const Outcome outcome = fly({QStringLiteral("--plant"), QStringLiteral("plants/heavy.ini")});
    QVERIFY(QDir::setCurrent(QStringLiteral(AWE_EXAMPLE)));
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY2(m_page.contains(QStringLiteral("```\n%1```").arg(outcome.errors)), qPrintable(outcome.errors));
}

void tst_KiteExperiments::everyPlantFileIsShownAndValid()
{
    const QStringList named = awe::PlantConfiguration::names();
    const QStringList files = QDir(QStringLiteral("plants")).entryList({QStringLiteral("*.ini")});
    QVERIFY(files.size() >= 10);
    for (const QString &file : files) {
        const QString name = QStringLiteral("plants/") + file;
        awe::PlantConfiguration plant;
        QString error;
        QVERIFY2(awe::PlantConfiguration::read(name, &plant, &error), qPrintable(error));
        const QString plantName = QFileInfo(file).completeBaseName();
        const QString shown = named.contains(plantName) ? plantName : name;
        QVERIFY2(m_page.contains(QStringLiteral("--plant %1 ").arg(shown)), qPrintable(name));
    }
}

/// In one process and in three the same flight, to the last bit, and not that of another plant.
void tst_KiteExperiments::everyProcessUsesTheConfiguredPlant()
{
    const QTemporaryDir folder;
    const auto report = [&](const QStringList &options) {
        const QString name = folder.filePath(QStringLiteral("report.json"));
        const QStringList fixed{QStringLiteral("--duration=10"), QStringLiteral("--report=") + name};
        const Outcome outcome = fly(fixed + options);
        QFile file(name);
        return outcome.exitCode == 0 && file.open(QIODevice::ReadOnly)
            ? QJsonDocument::fromJson(file.readAll()).object()
            : QJsonObject();
    };
    const QStringList plant{QStringLiteral("--plant=plants/drag-fifth.ini")};
    const QJsonObject usual = report({}), alone = report(plant),
                      processes = report(plant + QStringList{QStringLiteral("--processes")});
    for (const char *figure : {"image_digest", "eta", "max_speed_m_s"}) {
        QVERIFY2(!alone.value(QLatin1String(figure)).isUndefined(), figure);
        QCOMPARE(processes.value(QLatin1String(figure)), alone.value(QLatin1String(figure)));
        QVERIFY(alone.value(QLatin1String(figure)) != usual.value(QLatin1String(figure)));
    }
}

QTEST_GUILESS_MAIN(tst_KiteExperiments)
#include "tst_KiteExperiments.moc"
