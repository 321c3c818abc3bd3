// SPDX-License-Identifier: Apache-2.0
#include "QSplitPrimitive.h"
#include "signals/PayloadLayout.h"

#include <QtTest/QtTest>

#include <limits>
#include <vector>

using qplc::PayloadLayout;

namespace {

/// Reals of both sizes side by side, torn apart by what is no real.
QPlcSignalTable realsAndOthers()
{
    return QPlcSignalTable::fromIni(
        "[a]\ntype = Real32\n[b]\ntype = RealTriple\n[mask]\ntype = UInt32\n[c]\ntype = Real64\n"
        "[d]\ntype = Real64\n[e]\ntype = Real32\n");
}

PayloadLayout layoutOfAll(const QPlcSignalTable &table)
{
    QVector<QPlcSignalIndex> all;
    for (int i = 0; i < table.size(); ++i)
        all.append(QPlcSignalIndex(i));
    return {table, all};
}

}  // namespace

class tst_PayloadLayout : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void finiteValuesAreFinite();
    void theFirstValueThatIsNotFiniteIsFound_data();
    void theFirstValueThatIsNotFiniteIsFound();
    void integersMayHaveAnyBits();
    void aPayloadWithoutRealsIsFinite();
};

void tst_PayloadLayout::finiteValuesAreFinite()
{
    const QPlcSignalTable table = realsAndOthers();
    const PayloadLayout layout = layoutOfAll(table);
    std::vector<char> payload(layout.size(), 0);
    QVERIFY(!layout.firstNotFinite(payload.data()));
    for (const PayloadLayout::Field &field : layout.fields()) {
        char *bytes = payload.data() + field.offset;
        if (field.type.scalar() == QPlcSignalType::Real32)
            QSplitPrimitive<float>(-std::numeric_limits<float>::max()).toBytes(bytes);
        else if (field.type.scalar() == QPlcSignalType::Real64)
            QSplitPrimitive<double>(std::numeric_limits<double>::denorm_min()).toBytes(bytes);
    }
    QVERIFY(!layout.firstNotFinite(payload.data()));
}

void tst_PayloadLayout::theFirstValueThatIsNotFiniteIsFound_data()
{
    QTest::addColumn<QString>("signal");
    QTest::addColumn<int>("element");
    QTest::addColumn<double>("value");
    const double infinity = std::numeric_limits<double>::infinity();
    QTest::newRow("first") << "a" << 0 << infinity;
    QTest::newRow("first of an array") << "b" << 0 << -infinity;
    QTest::newRow("last of an array") << "b" << 2 << qQNaN();
    QTest::newRow("double") << "c" << 0 << infinity;
    QTest::newRow("double beside a double") << "d" << 0 << qSNaN();
    QTest::newRow("last") << "e" << 0 << qQNaN();
}

void tst_PayloadLayout::theFirstValueThatIsNotFiniteIsFound()
{
    QFETCH(QString, signal);
    QFETCH(int, element);
    QFETCH(double, value);
    const QPlcSignalTable table = realsAndOthers();
    const PayloadLayout layout = layoutOfAll(table);
    std::vector<char> payload(layout.size(), 0);
    for (const PayloadLayout::Field &field : layout.fields()) {
        if (table.at(field.signal).name != signal)
            continue;
        if (field.type.scalar() == QPlcSignalType::Real32)
            QSplitPrimitive<float>(float(value)).toBytes(payload.data() + field.offset + 4 * element);
        else
            QSplitPrimitive<double>(value).toBytes(payload.data() + field.offset + 8 * element);
    }
    const PayloadLayout::Field *found = layout.firstNotFinite(payload.data());
    QVERIFY(found);
    QCOMPARE(table.at(found->signal).name, signal);
}

void tst_PayloadLayout::integersMayHaveAnyBits()
{
    const QPlcSignalTable table = realsAndOthers();
    const PayloadLayout layout = layoutOfAll(table);
    std::vector<char> payload(layout.size(), 0);
    QSplitPrimitive<quint32>(0xffffffffu).toBytes(payload.data() + layout.fields().at(2).offset);
    QVERIFY(!layout.firstNotFinite(payload.data()));
}

void tst_PayloadLayout::aPayloadWithoutRealsIsFinite()
{
    QVERIFY(!PayloadLayout().firstNotFinite(nullptr));
}

QTEST_APPLESS_MAIN(tst_PayloadLayout)
#include "tst_PayloadLayout.moc"
