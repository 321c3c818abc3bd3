// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalIndexTable.h"
#include "QPlcSignalList.h"

#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

#include <thread>

class tst_QPlcSignalIndexTable : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void tableOutlivesItsReader();
    void invalidTableKeepsThePreviousOne();
    void tableIsReadFromAFile();
    void indexBehindTheTableHasNoName();
    void concurrentReadersAndWritersAreSafe();
    void indexListHoldsEachSignalOnce();
    void indexListRemembersUnknownNames();
    void lastInsertedValueOfASignalIsKept();
    void valuesAreFoundInEveryOrderOfInsertion();
    void valueOfAMissingSignalIsInvalid();
    void listsCompareByContent();
};

void tst_QPlcSignalIndexTable::init()
{
    QPlcSignalIndexTable reader;
    QVERIFY(reader.initializeFromIni("[a]\ntype = Real\n[b]\ntype = Int\n[c]\ntype = RealTriple\n"));
}

void tst_QPlcSignalIndexTable::tableOutlivesItsReader()
{
    QCOMPARE(QPlcSignalIndexTable::current().size(), 3);
    QCOMPARE(int(QPlcSignalIndexTable::index(QStringLiteral("b"))), 1);
    QCOMPARE(QPlcSignalIndexTable::name(2), QStringLiteral("c"));
    QCOMPARE(QPlcSignalIndexTable::type(1), QPlcSignalType(QPlcSignalType::Int32));
}

void tst_QPlcSignalIndexTable::invalidTableKeepsThePreviousOne()
{
    QPlcSignalIndexTable reader;
    QVERIFY(!reader.initializeFromIni("[x]\ntype = Rael\nunits = m\n", QStringLiteral("x.ini")));
    QCOMPARE(reader.errors().size(), 2);
    QVERIFY(reader.errorString().startsWith(QStringLiteral("x.ini:2:8: unknown type 'Rael'")));
    QCOMPARE(reader.errorString().count(QLatin1Char('\n')), 1);
    QCOMPARE(QPlcSignalIndexTable::current().size(), 3);
    QVERIFY(reader.initializeFromIni("[x]\ntype = Real\n"));
    QCOMPARE(reader.errorString(), QString());
    QCOMPARE(QPlcSignalIndexTable::current().size(), 1);
}

void tst_QPlcSignalIndexTable::tableIsReadFromAFile()
{
    const QTemporaryDir directory;
    const QString name = directory.filePath(QStringLiteral("SignalIndexTable.ini"));
    QPlcSignalIndexTable reader;
    QVERIFY(!reader.initializeFromIniFile(name));
    QVERIFY(reader.errorString().startsWith(name + QStringLiteral(": cannot open: ")));
    QFile file(name);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("[wind]\ntype = Real\n");
    file.close();
    QVERIFY2(reader.initializeFromIniFile(name), qPrintable(reader.errorString()));
    QCOMPARE(QPlcSignalIndexTable::name(0), QStringLiteral("wind"));
}

void tst_QPlcSignalIndexTable::indexBehindTheTableHasNoName()
{
    QCOMPARE(QPlcSignalIndexTable::name(3), QString());
    QVERIFY(!QPlcSignalIndexTable::type(QPlcInvalidSignalIndex).isValid());
    QPlcSignalIndexTable::setCurrent(QPlcSignalTable());
    QCOMPARE(QPlcSignalIndexTable::name(0), QString());
    QCOMPARE(QPlcSignalIndexTable::index(QStringLiteral("a")), QPlcInvalidSignalIndex);
}

void tst_QPlcSignalIndexTable::concurrentReadersAndWritersAreSafe()
{
    const QPlcSignalTable small = QPlcSignalTable::fromIni("[a]\ntype = Real\n");
    const QPlcSignalTable large = QPlcSignalIndexTable::current();
    std::thread writer([&] {
        for (int i = 0; i < 1000; ++i)
            QPlcSignalIndexTable::setCurrent(i % 2 == 0 ? small : large);
    });
    int wrong = 0;
    for (int i = 0; i < 1000; ++i) {
        const QPlcSignalTable table = QPlcSignalIndexTable::current();
        wrong += table.indexOf(QStringLiteral("a")) == 0 && (table.size() == 1 || table.size() == 3) ? 0 : 1;
    }
    writer.join();
    QCOMPARE(wrong, 0);
}

void tst_QPlcSignalIndexTable::indexListHoldsEachSignalOnce()
{
    QPlcSignalIndexList list;
    QVERIFY(list.isEmpty());
    QCOMPARE(int(list.insert(QStringLiteral("c"))), 2);
    QCOMPARE(int(list.insert(QStringLiteral("a"))), 0);
    QCOMPARE(int(list.insert(QStringLiteral("c"))), 2);
    QCOMPARE(int(list.insert(QPlcSignalIndex(0))), 0);
    QCOMPARE(list.toVector(), (QVector<QPlcSignalIndex>{2, 0}));
    QVERIFY(list.contains(2));
    QVERIFY(!list.contains(1));
    QVERIFY(list.unknownNames().isEmpty());
}

void tst_QPlcSignalIndexTable::indexListRemembersUnknownNames()
{
    QPlcSignalIndexList list;
    QCOMPARE(list.insert(QStringLiteral("x")), QPlcInvalidSignalIndex);
    QCOMPARE(list.insert(QStringLiteral("x")), QPlcInvalidSignalIndex);
    QCOMPARE(list.insert(QPlcInvalidSignalIndex), QPlcInvalidSignalIndex);
    QVERIFY(list.isEmpty());
    QCOMPARE(list.unknownNames(), (QStringList{QStringLiteral("x"), QStringLiteral("index 65535")}));
}

void tst_QPlcSignalIndexTable::lastInsertedValueOfASignalIsKept()
{
    QPlcSignalList list;
    list.reserve(2);
    QVERIFY(list.insert(QStringLiteral("b"), 1));
    list.insert(0, 1.5);
    QVERIFY(list.insert(QStringLiteral("b"), 2));
    QCOMPARE(list.size(), 2);
    QCOMPARE(list.value(1), QPlcValue(2));
    QCOMPARE(list.value(QStringLiteral("a")).toReal(), 1.5);
    QCOMPARE(list.indices().toVector(), (QVector<QPlcSignalIndex>{1, 0}));
    list.clear();
    QVERIFY(list.isEmpty());
}

void tst_QPlcSignalIndexTable::valuesAreFoundInEveryOrderOfInsertion()
{
    QPlcSignalList list;
    for (const QVector<QPlcSignalIndex> &order :
         {QVector<QPlcSignalIndex>{0, 3, 4, 9}, QVector<QPlcSignalIndex>{9, 4, 3, 0},
          QVector<QPlcSignalIndex>{3, 9, 0, 4}, QVector<QPlcSignalIndex>{0, 9, 4, 3}}) {
        list.clear();
        for (int value : {1, 100}) {
            for (const QPlcSignalIndex index : order)
                list.insert(index, value + index);
        }
        QCOMPARE(list.indices().toVector(), order);
        for (QPlcSignalIndex index = 0; index < 11; ++index) {
            QCOMPARE(list.contains(index), order.contains(index));
            QCOMPARE(list.value(index), order.contains(index) ? QPlcValue(100 + index) : QPlcValue());
        }
    }
}

void tst_QPlcSignalIndexTable::valueOfAMissingSignalIsInvalid()
{
    QPlcSignalList list;
    list.insert(QPlcInvalidSignalIndex, 1);
    QVERIFY(!list.insert(QStringLiteral("x"), 1));
    QVERIFY(list.isEmpty());
    QVERIFY(!list.value(0).isValid());
    QVERIFY(!list.value(QStringLiteral("x")).isValid());
    QVERIFY(!list.contains(QPlcInvalidSignalIndex));
}

void tst_QPlcSignalIndexTable::listsCompareByContent()
{
    QPlcSignalList a;
    QPlcSignalList b;
    QVERIFY(a == b);
    a.insert(0, 1);
    QVERIFY(a != b);
    b.insert(0, 1);
    QVERIFY(a == b);
    b.insert(0, 1.0);
    QVERIFY(a != b);
    QVERIFY(a.indices() == b.indices());
}

QTEST_APPLESS_MAIN(tst_QPlcSignalIndexTable)
#include "tst_QPlcSignalIndexTable.moc"
