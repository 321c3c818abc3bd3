// SPDX-License-Identifier: Apache-2.0
#include "protocol/Crc32c.h"

#include "Vectors.h"

#include <QtTest/QtTest>

using namespace qplc;

class tst_Crc32c : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void checksumsMatchTheVectors_data();
    void checksumsMatchTheVectors();
    void instructionAndTableAgreeAtEveryLengthAndAlignment();
    void checksumOfTwoPiecesIsThatOfTheWhole();
    void emptyInputMayHaveANullAddress();
};

void tst_Crc32c::checksumsMatchTheVectors_data()
{
    QTest::addColumn<QByteArray>("bytes");
    QTest::addColumn<quint32>("crc");
    const QJsonArray rows = vectors::file(QStringLiteral("crc32c.json"))[QStringLiteral("vectors")].toArray();
    QVERIFY(!rows.isEmpty());
    for (const QJsonValue row : rows) {
        QTest::newRow(qPrintable(row[QStringLiteral("name")].toString()))
            << vectors::bytes(row[QStringLiteral("hex")]) << quint32(vectors::number(row[QStringLiteral("crc")]));
    }
}

void tst_Crc32c::checksumsMatchTheVectors()
{
    QFETCH(QByteArray, bytes);
    QFETCH(quint32, crc);
    QCOMPARE(crc32c(0, bytes.constData(), std::size_t(bytes.size())), crc);
    QCOMPARE(crc32cByTable(0, bytes.constData(), std::size_t(bytes.size())), crc);
}

void tst_Crc32c::instructionAndTableAgreeAtEveryLengthAndAlignment()
{
    std::mt19937 random(1);
    const QByteArray bytes = vectors::randomBytes(random, 300);
    for (std::size_t begin = 0; begin < 16; ++begin) {
        for (std::size_t size = 0; size + begin < 300; ++size) {
            const auto start = std::uint32_t(random());
            QCOMPARE(crc32c(start, bytes.constData() + begin, size),
                     crc32cByTable(start, bytes.constData() + begin, size));
        }
    }
}

void tst_Crc32c::checksumOfTwoPiecesIsThatOfTheWhole()
{
    std::mt19937 random(2);
    const QByteArray bytes = vectors::randomBytes(random, 100);
    const std::uint32_t whole = crc32c(0, bytes.constData(), 100);
    for (std::size_t cut = 0; cut <= 100; ++cut) {
        QCOMPARE(crc32c(crc32c(0, bytes.constData(), cut), bytes.constData() + cut, 100 - cut), whole);
        QCOMPARE(crc32cByTable(crc32cByTable(0, bytes.constData(), cut), bytes.constData() + cut, 100 - cut), whole);
    }
}

void tst_Crc32c::emptyInputMayHaveANullAddress()
{
    QCOMPARE(crc32c(0, nullptr, 0), 0u);
    QCOMPARE(crc32c(0x12345678, nullptr, 0), 0x12345678u);
    QCOMPARE(crc32cByTable(0x12345678, nullptr, 0), 0x12345678u);
}

QTEST_APPLESS_MAIN(tst_Crc32c)
#include "tst_Crc32c.moc"
