// SPDX-License-Identifier: Apache-2.0
#include "PlantConfiguration.h"

#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

using namespace awe;

class tst_PlantConfiguration : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void withoutAFileTheWinchIsIdeal();
    void oneWordMakesItADrive();
    void whatCannotBeMeantIsNamed_data();
    void whatCannotBeMeantIsNamed();
    void fileThatIsNotThereIsNamed();

private:
    QString write(const QByteArray &text);

    QTemporaryDir m_folder;
};

QString tst_PlantConfiguration::write(const QByteArray &text)
{
    QFile file(m_folder.filePath(QStringLiteral("plant.ini")));
    return file.open(QIODevice::WriteOnly) && file.write(text) == text.size() ? file.fileName() : QString();
}

void tst_PlantConfiguration::withoutAFileTheWinchIsIdeal()
{
    PlantConfiguration plant;
    QString error;
    QVERIFY2(PlantConfiguration::read(PlantConfiguration::builtInFile(), &plant, &error), qPrintable(error));
    QVERIFY(!plant.hasDrive());
    QCOMPARE(winchSpeedSignal(plant.winch), "tetherSpeed");
    QVERIFY(QFile::exists(plant.winchHardware));
    QVERIFY(plant.simulatedWinch.startsWith(QLatin1String("fake:")));
}

void tst_PlantConfiguration::oneWordMakesItADrive()
{
    QFile builtIn(PlantConfiguration::builtInFile());
    QVERIFY(builtIn.open(QIODevice::ReadOnly));
    const QString name = write(builtIn.readAll().replace("kind = ideal", "kind = drive"));
    PlantConfiguration plant;
    QString error;
    QVERIFY2(PlantConfiguration::read(name, &plant, &error), qPrintable(error));
    QVERIFY(plant.hasDrive());
    QCOMPARE(winchSpeedSignal(plant.winch), "winchSpeed");
    QCOMPARE(plant.winchHardware, m_folder.filePath(QStringLiteral("winch.ini")));
}

void tst_PlantConfiguration::whatCannotBeMeantIsNamed_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("expected");
    QTest::newRow("kind") << QByteArray("[winch]\nkind = steam\n") << "kind = steam: use ideal or drive";
    QTest::newRow("key") << QByteArray("[winch]\n; a comment\nkin = drive\n")
                         << "plant.ini:3: 'kin' is no key of [winch]";
    QTest::newRow("section") << QByteArray("[kite]\n") << "plant.ini:1: '[kite]' is not known here";
    QTest::newRow("before the section") << QByteArray("\nkind = drive\n") << "plant.ini:2: ";
    QTest::newRow("no value") << QByteArray("[winch]\nkind\n") << "plant.ini:2: 'kind' is no key";
}

void tst_PlantConfiguration::whatCannotBeMeantIsNamed()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, expected);
    PlantConfiguration plant;
    QString error;
    QVERIFY(!PlantConfiguration::read(write(text), &plant, &error));
    QVERIFY2(error.contains(expected), qPrintable(error));
}

void tst_PlantConfiguration::fileThatIsNotThereIsNamed()
{
    PlantConfiguration plant;
    QString error;
    QVERIFY(!PlantConfiguration::read(QStringLiteral("/nowhere/plant.ini"), &plant, &error));
    QVERIFY2(error.contains(QLatin1String("/nowhere/plant.ini")), qPrintable(error));
}

QTEST_APPLESS_MAIN(tst_PlantConfiguration)
#include "tst_PlantConfiguration.moc"
