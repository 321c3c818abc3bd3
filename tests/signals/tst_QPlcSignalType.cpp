// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalType.h"

#include <QtTest/QtTest>

class tst_QPlcSignalType : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everyTypeNameIsKnown_data();
    void everyTypeNameIsKnown();
    void wrongTypeNamesAreRefusedWithARemedy_data();
    void wrongTypeNamesAreRefusedWithARemedy();
    void canonicalNameIsReadBack();
    void typeLargerThanTheMaximumIsInvalid();
};

void tst_QPlcSignalType::everyTypeNameIsKnown_data()
{
    QTest::addColumn<QString>("canonical");
    QTest::addColumn<int>("count");
    QTest::addColumn<int>("size");

    const auto row = [](const char *name, const char *canonical, int count, int size) {
        QTest::newRow(name) << QString::fromLatin1(canonical) << count << size;
    };
    row("Int8", "Int8", 1, 1);
    row("Bool", "Int8", 1, 1);
    row("Int16", "Int16", 1, 2);
    row("Int32", "Int32", 1, 4);
    row("Int", "Int32", 1, 4);
    row("Int64", "Int64", 1, 8);
    row("UInt8", "UInt8", 1, 1);
    row("Byte", "UInt8", 1, 1);
    row("UInt16", "UInt16", 1, 2);
    row("UInt32", "UInt32", 1, 4);
    row("UInt", "UInt32", 1, 4);
    row("UInt64", "UInt64", 1, 8);
    row("Real32", "Real32", 1, 4);
    row("Real", "Real32", 1, 4);
    row("Real64", "Real64", 1, 8);
    row("Real32Triple", "Real32[3]", 3, 12);
    row("RealTriple", "Real32[3]", 3, 12);
    row("Real64Triple", "Real64[3]", 3, 24);
    row("String", "String(64)", 1, 66);
    row("DateTime", "DateTime", 1, 8);
    row("Real[3]", "Real32[3]", 3, 12);
    row("Bool[1]", "Int8", 1, 1);
    row("Byte[1440]", "UInt8[1440]", 1440, 1440);
    row("Real64[180]", "Real64[180]", 180, 1440);
    row("String(1)", "String(1)", 1, 3);
    row("String(1438)", "String(1438)", 1, 1440);
}

void tst_QPlcSignalType::everyTypeNameIsKnown()
{
    QFETCH(QString, canonical);
    QFETCH(int, count);
    QFETCH(int, size);
    QString error = QStringLiteral("from before");
    const QPlcSignalType type = QPlcSignalType::fromName(QString::fromLatin1(QTest::currentDataTag()), &error);
    QVERIFY(type.isValid());
    QCOMPARE(error, QString());
    QCOMPARE(type.name(), canonical);
    QCOMPARE(type.count(), count);
    QCOMPARE(type.size(), size);
    QCOMPARE(QPlcSignalType::fromName(canonical), type);
}

void tst_QPlcSignalType::wrongTypeNamesAreRefusedWithARemedy_data()
{
    QTest::addColumn<QString>("remedy");  // part of the message

    const auto row = [](const char *name, const char *remedy) { QTest::newRow(name) << QString::fromLatin1(remedy); };
    row("", "write one of Int8, Bool");
    row("Float", "write one of Int8, Bool");
    row("real", "did you mean 'Real'?");
    row("realtriple", "did you mean 'RealTriple'?");
    row("Raelt", "did you mean 'Real'");
    row("real 32", "'Real32'");
    row("Real 32", "'Real32'");
    row("Real32Tripel", "did you mean 'Real32Triple'");
    row("Boolean", "did you mean 'Bool'?");
    row("Reel[3]", "unknown type 'Reel'; did you mean 'Real'");
    row("Real32[0]", "at least 1");
    row("Real32[-1]", "at least 1");
    row("Real32[]", "write, for example, 'Real32[3]'");
    row("Real32[3", "write, for example, 'Real32[3]'");
    row("Real32[3)", "write, for example, 'Real32[3]'");
    row("Real32[ 3]", "write, for example, 'Real32[3]'");
    row("Real32[3]]", "write, for example, 'Real32[3]'");
    row("Real32[3][3]", "write, for example, 'Real32[3]'");
    row("Real32(3)", "write the size as in 'Real32[3]'");
    row("Real32[361]", "at most 1440 bytes; write a size of at most 360");
    row("Real32[999999]", "at most 360");
    row("Real32[99999999999999999999]", "whole number");
    row("RealTriple[2]", "a RealTriple has no size of its own");
    row("DateTime[2]", "a DateTime has no size of its own");
    row("String[8]", "write the size as in 'String(64)'");
    row("String(0)", "at least 1");
    row("String(1439)", "write a size of at most 1438");
    row("[3]", "unknown type ''");
}

void tst_QPlcSignalType::wrongTypeNamesAreRefusedWithARemedy()
{
    QFETCH(QString, remedy);
    QString error;
    QVERIFY(!QPlcSignalType::fromName(QString::fromLatin1(QTest::currentDataTag()), &error).isValid());
    QVERIFY2(error.contains(remedy), qPrintable(error));
}

void tst_QPlcSignalType::canonicalNameIsReadBack()
{
    for (int scalar = QPlcSignalType::Int8; scalar <= QPlcSignalType::DateTime; ++scalar) {
        for (const int count : {0, 1, 2, 64, 180}) {
            const QPlcSignalType type(QPlcSignalType::Scalar(scalar), count);
            if (type.isValid())
                QCOMPARE(QPlcSignalType::fromName(type.name()), type);
            else
                QCOMPARE(scalar, int(QPlcSignalType::DateTime));
        }
    }
    QCOMPARE(QPlcSignalType().name(), QStringLiteral("Invalid"));
}

void tst_QPlcSignalType::typeLargerThanTheMaximumIsInvalid()
{
    QVERIFY(QPlcSignalType(QPlcSignalType::Real32, 360).isValid());
    QVERIFY(!QPlcSignalType(QPlcSignalType::Real32, 361).isValid());
    QVERIFY(!QPlcSignalType(QPlcSignalType::Int8, 65537).isValid());
    QVERIFY(!QPlcSignalType(QPlcSignalType::Real64, 0x7fffffff).isValid());
    QVERIFY(!QPlcSignalType(QPlcSignalType::Int8, -1).isValid());
    QVERIFY(!QPlcSignalType(QPlcSignalType::String, 1439).isValid());
    QVERIFY(!QPlcSignalType(QPlcSignalType::DateTime, 2).isValid());
    QVERIFY(!QPlcSignalType(QPlcSignalType::Scalar(13)).isValid());
    QCOMPARE(QPlcSignalType(QPlcSignalType::Invalid), QPlcSignalType());
    QCOMPARE(QPlcSignalType().size(), 0);
}

QTEST_APPLESS_MAIN(tst_QPlcSignalType)
#include "tst_QPlcSignalType.moc"
