// SPDX-License-Identifier: Apache-2.0
#include "hardware/can/CanLog.h"
#include "hardware/can/CanLogWriter.h"

#include <QtTest/QtTest>

using namespace qplc;

class tst_CanLog : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void logLinesHaveCandumpFormat_data();
    void logLinesHaveCandumpFormat();
    void logLinesOfOtherProgramsAreRead_data();
    void logLinesOfOtherProgramsAreRead();
    void errorsNameColumnAndRemedy_data();
    void errorsNameColumnAndRemedy();
    void readingReturnsValidLinesAndErrors();
    void writerKeepsOrder();
    void writerAppendsToAnExistingLog();
    void writerNamesTheFileThatItCannotWrite();
};

void tst_CanLog::logLinesHaveCandumpFormat_data()
{
    QTest::addColumn<QByteArray>("text");
    for (const char *text :
         {"(1436509052.249713) can0 044#2A366C2BBA", "(0000000000.000001) vcan1 7FF#",
          "(1436509052.249847) can0 00000001#01", "(1436509052.249847) can0 1FFFFFFF#0102030405060708",
          "(1436509052.450000) can0 123#R", "(1436509052.450000) can0 123#R8",
          "(1436509052.450000) can0 123##1AABBCCDD", "(1436509052.450000) can0 18FEDFFE##3000102030405060708090A0B",
          "(1436509052.450000) fake:winch 20000004#0004000000000000"})
        QTest::newRow(text) << QByteArray(text);
}

void tst_CanLog::logLinesHaveCandumpFormat()
{
    QFETCH(QByteArray, text);
    CanLogLine line;
    QPlcParseError error;
    QVERIFY2(CanLog::parse(text, &line, &error), qPrintable(error.message));
    QCOMPARE(CanLog::text(line), text + '\n');
}

void tst_CanLog::logLinesOfOtherProgramsAreRead_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QByteArray>("same");
    const auto row
        = [](const char *text, const char *same) { QTest::newRow(text) << QByteArray(text) << QByteArray(same); };
    row("(1.5) can0 123#", "(0000000001.500000) can0 123#\n");
    row("  (1.000002999)  can0   123#aa \r", "(0000000001.000002) can0 123#AA\n");
    row("(1.0) can0 123#AA.BB.CC", "(0000000001.000000) can0 123#AABBCC\n");
    row("(1.0) can0 123#AA R", "(0000000001.000000) can0 123#AA\n");
    row("(1.0) can0 123##5AA T", "(0000000001.000000) can0 123##1AA\n");
}

void tst_CanLog::logLinesOfOtherProgramsAreRead()
{
    QFETCH(QByteArray, text);
    QFETCH(QByteArray, same);
    CanLogLine line;
    QPlcParseError error;
    QVERIFY2(CanLog::parse(text, &line, &error), qPrintable(error.message));
    QCOMPARE(CanLog::text(line), same);
}

void tst_CanLog::errorsNameColumnAndRemedy_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<int>("column");
    QTest::addColumn<QString>("message");
    const auto row = [](const char *text, int column, const char *message) {
        QTest::newRow(text) << QByteArray(text) << column << QString::fromLatin1(message);
    };
    row("", 1, "the end of the line instead of '(' and the time");
    row("can0 123#AA", 1, "'c' instead of '(' and the time");
    row("(x) can0 123#AA", 2, "'x' instead of the time in seconds");
    row("(1) can0 123#AA", 3, "')' instead of the time in seconds");
    row("(1.) can0 123#AA", 4, "')' instead of digits behind the point");
    row("(1.0 can0 123#AA", 5, "' ' instead of ')' behind the time");
    row("(1.0)", 6, "the end of the line instead of the name of the interface");
    row("(1.0) can0", 11, "the id has 0 digits");
    row("(1.0) can0 12#AA", 14, "the id has 2 digits; it has 3, or 8");
    row("(1.0) can0 800#AA", 15, "the id is larger than 0x7ff");
    row("(1.0) can0 40000000#AA", 20, "the id is larger than 0x3fffffff");
    row("(1.0) can0 123 AA", 15, "' ' instead of '#' behind the id");
    row("(1.0) can0 123#A", 17, "the end of the line instead of the second digit of a byte");
    row("(1.0) can0 123#AAX", 18, "'X' instead of the end of the line");
    row("(1.0) can0 123#010203040506070809", 32, "the frame has more than 8 bytes");
    row("(1.0) can0 123##", 17, "the end of the line instead of the flags");
    row("(1.0) can0 123##0010203040506070809", 36, "no frame has 9 bytes");
    row("(1.0) can0 123#R9", 17, "'9' instead of the size, 0 ... 8");
}

void tst_CanLog::errorsNameColumnAndRemedy()
{
    QFETCH(QByteArray, text);
    QFETCH(int, column);
    QFETCH(QString, message);
    CanLogLine line;
    QPlcParseError error;
    QVERIFY(!CanLog::parse(text, &line, &error));
    QVERIFY2(error.message.startsWith(message), qPrintable(error.message));
    QCOMPARE(error.column, column);
}

void tst_CanLog::readingReturnsValidLinesAndErrors()
{
    QVector<QPlcParseError> errors;
    const auto lines
        = CanLog::read("(1.0) can0 123#AA\n\nnonsense\r\n(2.0) can0 124#BB", QStringLiteral("a.log"), &errors);
    QCOMPARE(lines.size(), 2);
    QCOMPARE(lines.at(1).frame.id, 0x124U);
    QCOMPARE(lines.at(1).time, 2'000'000'000LL);
    QCOMPARE(errors.size(), 1);
    QCOMPARE(errors.at(0).toString(), QStringLiteral("a.log:3:1: 'n' instead of '(' and the time"));
}

void tst_CanLog::writerKeepsOrder()
{
    const QTemporaryDir folder;
    const QString name = folder.filePath(QStringLiteral("a.log"));
    CanLogWriter writer;
    QString error;
    QVERIFY2(writer.open(name, QStringLiteral("can0"), &error), qPrintable(error));
    for (quint32 i = 0; i < 2000; ++i) {
        CanFrame frame;
        frame.id = i;
        writer.put(frame);
    }
    writer.close();
    QFile file(name);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QVector<QPlcParseError> errors;
    const auto lines = CanLog::read(file.readAll(), name, &errors);
    QCOMPARE(lines.size(), 2000);
    QCOMPARE(writer.dropped(), quint64(0));
    for (int i = 0; i < lines.size(); ++i)
        QCOMPARE(lines.at(i).frame.id, quint32(i));
}

void tst_CanLog::writerAppendsToAnExistingLog()
{
    const QTemporaryDir folder;
    const QString name = folder.filePath(QStringLiteral("a.log"));
    QString error;
    for (int i = 0; i < 2; ++i) {
        CanLogWriter writer;
        QVERIFY(writer.open(name, QStringLiteral("can0"), &error));
        writer.put(CanFrame());
    }
    QFile file(name);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(file.readAll().count('\n'), 2);
}

void tst_CanLog::writerNamesTheFileThatItCannotWrite()
{
    CanLogWriter writer;
    QString error;
    QVERIFY(!writer.open(QStringLiteral("/no/such/folder/a.log"), QStringLiteral("can0"), &error));
    QVERIFY2(error.startsWith(QLatin1String("cannot write the log /no/such/folder/a.log")), qPrintable(error));
}

QTEST_APPLESS_MAIN(tst_CanLog)
#include "tst_CanLog.moc"
