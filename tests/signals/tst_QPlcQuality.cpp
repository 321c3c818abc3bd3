// SPDX-License-Identifier: Apache-2.0
#include "QPlcQuality.h"

#include <QtTest/QtTest>

class tst_QPlcQuality : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everyByteIsAQuality();
    void defaultQualityIsInvalid();
    void ageOfAHeldValueIsCut();
};

void tst_QPlcQuality::everyByteIsAQuality()
{
    for (int byte = 0; byte < 256; ++byte) {
        const QPlcQuality quality = QPlcQuality::fromByte(quint8(byte));
        const QPlcQuality::Kind kind = byte == 0 ? QPlcQuality::Good
            : byte <= 252                        ? QPlcQuality::Held
            : byte == 253                        ? QPlcQuality::Safe
                                                 : QPlcQuality::Invalid;
        QCOMPARE(quality.kind(), kind);
        QCOMPARE(int(quality.toByte()), byte == 255 ? 254 : byte);
        QCOMPARE(quality.isGood(), byte == 0);
        QCOMPARE(quality.isUsable(), byte <= 252);
        QCOMPARE(quality.heldCycles(), byte <= 252 ? byte : 0);
        QCOMPARE(quality.toString(),
                 kind == QPlcQuality::Good       ? QStringLiteral("good")
                     : kind == QPlcQuality::Held ? QStringLiteral("held %1").arg(byte)
                     : kind == QPlcQuality::Safe ? QStringLiteral("safe")
                                                 : QStringLiteral("invalid"));
    }
}

void tst_QPlcQuality::defaultQualityIsInvalid()
{
    QCOMPARE(QPlcQuality().kind(), QPlcQuality::Invalid);
    for (const QPlcQuality::Kind kind : {QPlcQuality::Good, QPlcQuality::Safe, QPlcQuality::Invalid})
        QCOMPARE(QPlcQuality(kind).kind(), kind);
    QVERIFY(QPlcQuality(QPlcQuality::Good) != QPlcQuality(QPlcQuality::Safe));
}

void tst_QPlcQuality::ageOfAHeldValueIsCut()
{
    QCOMPARE(QPlcQuality::held(-1), QPlcQuality(QPlcQuality::Good));
    QCOMPARE(QPlcQuality::held(0), QPlcQuality(QPlcQuality::Good));
    QCOMPARE(QPlcQuality::held(1).heldCycles(), 1);
    QCOMPARE(QPlcQuality::held(252).heldCycles(), 252);
    QCOMPARE(QPlcQuality::held(Q_INT64_C(1) << 40).heldCycles(), 252);
    QCOMPARE(QPlcQuality::held(253).kind(), QPlcQuality::Held);
}

QTEST_APPLESS_MAIN(tst_QPlcQuality)
#include "tst_QPlcQuality.moc"
