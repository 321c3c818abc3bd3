// SPDX-License-Identifier: Apache-2.0
#include "signals/Fnv1a.h"
#include "signals/ProcessImage.h"

#include <QtTest/QtTest>

#include <set>
#include <utility>

using qplc::CopyRun;
using qplc::PayloadLayout;
using qplc::ProcessImage;

class tst_ProcessImage : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void layoutIsPackedInTheRegisteredOrder();
    void emptyLayoutIsOneEmptyPart();
    void partsAreFullAndTearNoSignal_data();
    void partsAreFullAndTearNoSignal();
    void imageBeginsWithTheInitialValues();
    void imageIsAlignedAndPacked();
    void valueOfAnotherTypeIsConvertedOrRefused();
    void imageWithoutSignalsIsValid();
    void neighboursAreCopiedInOneRun();
    void gatheredFrameIsScatteredBack();
    void everyBitChangesTheDigest();
    void digestIsTheSameEverywhere();
    void digestDependsOnOrderAndHistory();
};

namespace {

// Sizes 1, 4, 12, 8, 2 + 5.
QPlcSignalTable mixedTable()
{
    return QPlcSignalTable::fromIni("[brake]\ntype = Bool\ninitial = true\n[speed]\ntype = Real\ninitial = 1.5\n"
                                    "[position]\ntype = RealTriple\ninitial = 1, 2, 3\n[time]\ntype = DateTime\n"
                                    "[title]\ntype = String(5)\ninitial = kite\n");
}

QPlcSignalTable reals(int count)
{
    QByteArray text;
    for (int i = 0; i < count; ++i)
        text += "[r" + QByteArray::number(i) + "]\ntype = Real64\n";
    return QPlcSignalTable::fromIni(text);
}

QString describe(const std::vector<CopyRun> &runs)
{
    QStringList texts;
    for (const CopyRun &run : runs)
        texts << QStringLiteral("%1>%2:%3").arg(run.from).arg(run.to).arg(run.size);
    return texts.join(QLatin1Char(' '));
}

}  // namespace

void tst_ProcessImage::layoutIsPackedInTheRegisteredOrder()
{
    const PayloadLayout layout(mixedTable(), {2, 0, 4});
    QCOMPARE(layout.size(), 20u);
    QCOMPARE(layout.fields().size(), std::size_t(3));
    QCOMPARE(layout.fields()[1].offset, 12u);
    QCOMPARE(int(layout.fields()[1].signal), 0);
    QCOMPARE(layout.fields()[2].type.name(), QStringLiteral("String(5)"));
    QCOMPARE(layout.hash(), qplc::fnv1a64(QByteArray("position:Real32[3]@0\nbrake:Int8@12\ntitle:String(5)@13\n")));
    QCOMPARE(layout.hash(), Q_UINT64_C(0x42eeee0eb39295c6));
    QVERIFY(PayloadLayout(mixedTable(), {0, 2, 4}).hash() != layout.hash());
}

void tst_ProcessImage::emptyLayoutIsOneEmptyPart()
{
    for (const PayloadLayout &layout : {PayloadLayout(), PayloadLayout(mixedTable(), {})}) {
        QCOMPARE(layout.size(), 0u);
        QCOMPARE(layout.hash(), qplc::fnv1a64Start);
        QCOMPARE(layout.partBorders(100), (std::vector<quint32>{0, 0}));
    }
}

void tst_ProcessImage::partsAreFullAndTearNoSignal_data()
{
    QTest::addColumn<int>("maximum");
    QTest::addColumn<QVector<quint32>>("borders");
    QTest::newRow("all in one") << 1456 << QVector<quint32>{0, 32};
    QTest::newRow("just all") << 32 << QVector<quint32>{0, 32};
    QTest::newRow("one byte short") << 31 << QVector<quint32>{0, 20, 32};
    QTest::newRow("two") << 20 << QVector<quint32>{0, 20, 32};
    QTest::newRow("three") << 12 << QVector<quint32>{0, 12, 20, 32};
    QTest::newRow("one each") << 7 << QVector<quint32>{0, 12, 13, 20, 32};
}

void tst_ProcessImage::partsAreFullAndTearNoSignal()
{
    QFETCH(int, maximum);
    QFETCH(QVector<quint32>, borders);
    // 12 + 1 + 7 + 12 bytes
    const QPlcSignalTable table
        = QPlcSignalTable::fromIni("[a]\ntype = RealTriple\n[b]\ntype = Bool\n[c]\ntype = String(5)\n"
                                   "[d]\ntype = RealTriple\n");
    const PayloadLayout layout(table, {0, 1, 2, 3});
    const std::vector<quint32> found = layout.partBorders(quint32(maximum));
    QCOMPARE(QVector<quint32>(found.begin(), found.end()), borders);
}

void tst_ProcessImage::imageBeginsWithTheInitialValues()
{
    ProcessImage image(mixedTable());
    QCOMPARE(image.value(0), QPlcValue(true));
    QCOMPARE(image.value(2), QPlcValue({1.0f, 2.0f, 3.0f}));
    QCOMPARE(image.value(3).toInt64(), qint64(0));
    QCOMPARE(image.value(4).toString(), QStringLiteral("kite"));
    QVERIFY(image.setValue(1, 7));
    QVERIFY(image.setValue(4, "x"));
    image.reset();
    QCOMPARE(image.value(1), QPlcValue(1.5f));
    QCOMPARE(image.value(4).toString(), QStringLiteral("kite"));
}

void tst_ProcessImage::imageIsAlignedAndPacked()
{
    const ProcessImage image(mixedTable());
    QCOMPARE(reinterpret_cast<quintptr>(image.data()) % 64, quintptr(0));
    QCOMPARE(image.size(), 32u);
    QCOMPARE(image.offset(1), 1u);
    QCOMPARE(image.offset(4), 25u);
    QCOMPARE(QByteArray(image.data(), 32).toHex(),
             QByteArray("01"                        // true
                        "0000c03f"                  // 1.5
                        "0000803f0000004000004040"  // 1, 2, 3
                        "0000000000000000"          // 1970
                        "04006b69746500"));         // kite
}

void tst_ProcessImage::valueOfAnotherTypeIsConvertedOrRefused()
{
    ProcessImage image(mixedTable());
    QVERIFY(image.setValue(1, 2));
    QCOMPARE(image.value(1), QPlcValue(2.0f));
    QVERIFY(image.setValue(2, 5.0));
    QCOMPARE(image.value(2), QPlcValue({5.0f, 5.0f, 5.0f}));
    const quint64 before = image.digest(0);
    QVERIFY(!image.setValue(0, 200));
    QVERIFY(!image.setValue(1, "1"));
    QVERIFY(!image.setValue(4, "too long"));
    QVERIFY(!image.setValue(1, QPlcValue()));
    QVERIFY(!image.setValue(5, 1));
    QVERIFY(!image.value(QPlcInvalidSignalIndex).isValid());
    QCOMPARE(image.digest(0), before);
}

void tst_ProcessImage::imageWithoutSignalsIsValid()
{
    ProcessImage empty;
    empty.reset();
    QCOMPARE(empty.size(), 0u);
    QVERIFY(!empty.value(0).isValid());
    QCOMPARE(empty.digest(1), ProcessImage(QPlcSignalTable()).digest(1));
    ProcessImage image(mixedTable());
    const char *const bytes = image.data();
    empty = std::move(image);
    QCOMPARE(static_cast<const void *>(empty.data()), static_cast<const void *>(bytes));
    QCOMPARE(empty.value(1), QPlcValue(1.5f));
}

void tst_ProcessImage::neighboursAreCopiedInOneRun()
{
    const ProcessImage image(mixedTable());
    const auto layout
        = [&image](const QVector<QPlcSignalIndex> &indices) { return PayloadLayout(image.table(), indices); };
    QCOMPARE(describe(image.gatherRuns(layout({}))), QString());
    QCOMPARE(describe(image.gatherRuns(layout({0, 1, 2, 3, 4}))), QStringLiteral("0>0:32"));
    QCOMPARE(describe(image.gatherRuns(layout({2, 3}))), QStringLiteral("5>0:20"));
    QCOMPARE(describe(image.scatterRuns(layout({2, 3}))), QStringLiteral("0>5:20"));
    QCOMPARE(describe(image.gatherRuns(layout({2, 1}))), QStringLiteral("5>0:12 1>12:4"));
    QCOMPARE(describe(image.scatterRuns(layout({0, 2, 3}))), QStringLiteral("0>0:1 1>5:20"));
}

void tst_ProcessImage::gatheredFrameIsScatteredBack()
{
    ProcessImage image(mixedTable());
    ProcessImage other(mixedTable());
    image.setValue(1, -3);
    image.setValue(3, QDateTime(QDate(2026, 1, 31), QTime(12, 0), Qt::UTC));
    image.setValue(4, "wind");
    const PayloadLayout layout(image.table(), {4, 0, 1, 3, 2});
    QByteArray payload(int(layout.size()), '\0');
    qplc::copyRuns(image.gatherRuns(layout), image.data(), payload.data());
    qplc::copyRuns(other.scatterRuns(layout), payload.constData(), other.data());
    for (QPlcSignalIndex i = 0; i < 5; ++i)
        QCOMPARE(other.value(i), image.value(i));
    QCOMPARE(other.digest(9), image.digest(9));
}

void tst_ProcessImage::everyBitChangesTheDigest()
{
    for (const int count : {1, 3, 4, 5, 31, 32, 33}) {
        ProcessImage image(reals(count));
        std::set<quint64> digests = {image.digest(0)};
        for (quint32 bit = 0; bit < image.size() * 8; ++bit) {
            image.data()[bit / 8] = char(image.data()[bit / 8] ^ (1 << bit % 8));
            digests.insert(image.digest(0));
            image.data()[bit / 8] = char(image.data()[bit / 8] ^ (1 << bit % 8));
        }
        QCOMPARE(digests.size(), std::size_t(count) * 64 + 1);
    }
}

// The numbers were computed by another program from the description of the digest.
void tst_ProcessImage::digestIsTheSameEverywhere()
{
    ProcessImage image(reals(5));
    for (quint32 i = 0; i < image.size(); ++i)
        image.data()[i] = char(i * 7 + 1);
    QCOMPARE(image.digest(0), Q_UINT64_C(0x66e98d9fa6fcac06));
    QCOMPARE(ProcessImage().digest(0), Q_UINT64_C(0x6c65530ac6533c37));
    QCOMPARE(ProcessImage(mixedTable()).digest(1), Q_UINT64_C(0x3aaed71802ef0b0c));
}

void tst_ProcessImage::digestDependsOnOrderAndHistory()
{
    ProcessImage a(reals(8));
    ProcessImage b(reals(8));
    a.setValue(0, 1.0);
    b.setValue(4, 1.0);  // the same lane
    QVERIFY(a.digest(0) != b.digest(0));
    QVERIFY(a.digest(0) != a.digest(1));
    QVERIFY(b.digest(a.digest(0)) != a.digest(b.digest(0)));
    QVERIFY(ProcessImage(reals(8)).digest(0) != ProcessImage(reals(7)).digest(0));  // zeros count
}

QTEST_APPLESS_MAIN(tst_ProcessImage)
#include "tst_ProcessImage.moc"
