// SPDX-License-Identifier: Apache-2.0
#include "signals/Fnv1a.h"
#include "signals/PayloadLayout.h"

#include <QtTest/QtTest>

#include <vector>

using qplc::PayloadLayout;

namespace {

QPlcSignalTable reals(int count)
{
    QByteArray text;
    for (int i = 0; i < count; ++i)
        text += "[r" + QByteArray::number(i) + "]\ntype = Real64\n";
    return QPlcSignalTable::fromIni(text);
}

PayloadLayout layoutOfAll(const QPlcSignalTable &table, PayloadLayout::Qualities qualities)
{
    QVector<QPlcSignalIndex> all;
    for (int i = 0; i < table.size(); ++i)
        all.append(QPlcSignalIndex(i));
    return {table, all, qualities};
}

}  // namespace

class tst_PayloadLayout : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void qualitiesFollowTheValues();
    void aPayloadWithoutValuesHasNoQualities();
    void partsWithQualitiesAreFullAndTearNoValue_data();
    void partsWithQualitiesAreFullAndTearNoValue();
};

void tst_PayloadLayout::qualitiesFollowTheValues()
{
    const QPlcSignalTable table = reals(3);
    const PayloadLayout without = layoutOfAll(table, PayloadLayout::WithoutQualities);
    QVERIFY(!without.hasQualities());
    QCOMPARE(without.size(), 24u);
    QCOMPARE(without.valueSize(), 24u);
    const PayloadLayout with = layoutOfAll(table, PayloadLayout::WithQualities);
    QVERIFY(with.hasQualities());
    QCOMPARE(with.size(), 27u);
    QCOMPARE(with.valueSize(), 24u);
    QCOMPARE(with.hash(), qplc::fnv1a64("r0:Real64@0\nr1:Real64@8\nr2:Real64@16\nqualities@24\n"));
    QVERIFY(with.hash() != without.hash());
}

void tst_PayloadLayout::aPayloadWithoutValuesHasNoQualities()
{
    const PayloadLayout layout(reals(1), {}, PayloadLayout::WithQualities);
    QVERIFY(!layout.hasQualities());
    QCOMPARE(layout.size(), 0u);
    QCOMPARE(layout.hash(), PayloadLayout().hash());
}

void tst_PayloadLayout::partsWithQualitiesAreFullAndTearNoValue_data()
{
    QTest::addColumn<int>("count");
    QTest::addColumn<QVector<quint32>>("borders");
    QTest::newRow("all in one") << 10 << QVector<quint32>{0, 90};
    QTest::newRow("full") << 11 << QVector<quint32>{0, 99};
    QTest::newRow("qualities are parted") << 12 << QVector<quint32>{0, 100, 108};
    QTest::newRow("the last value has a part of its own") << 13 << QVector<quint32>{0, 96, 117};
    QTest::newRow("many") << 100 << QVector<quint32>{0, 96, 192, 288, 384, 480, 576, 672, 768, 868, 900};
}

void tst_PayloadLayout::partsWithQualitiesAreFullAndTearNoValue()
{
    QFETCH(int, count);
    QFETCH(QVector<quint32>, borders);
    const std::vector<quint32> made = layoutOfAll(reals(count), PayloadLayout::WithQualities).partBorders(100);
    QCOMPARE(QVector<quint32>(made.begin(), made.end()), borders);
}

QTEST_APPLESS_MAIN(tst_PayloadLayout)
#include "tst_PayloadLayout.moc"
