// SPDX-License-Identifier: Apache-2.0
#include "Vectors.h"
#include "protocol/Beacon.h"

#include <QtTest/QtTest>

using qplc::Beacon;

// Section 13 of docs/protocol.md.
class tst_Beacon : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void validBeaconsMatchTheVectors_data() { addRows(QStringLiteral("good")); }
    void validBeaconsMatchTheVectors();
    void invalidBeaconsAreDropped_data() { addRows(QStringLiteral("bad")); }
    void invalidBeaconsAreDropped();
    void everyWrongBitIsFound();
    void everyOtherLengthIsDropped();
    void longNamesAreCutBetweenCharacters_data();
    void longNamesAreCutBetweenCharacters();
    void theDocumentHasTheExample();

private:
    static void addRows(const QString &list)
    {
        QTest::addColumn<QJsonObject>("row");
        const QJsonArray rows = vectors::file(QStringLiteral("beacons.json"))[list].toArray();
        QVERIFY(!rows.isEmpty());
        for (const QJsonValue row : rows)
            QTest::newRow(qPrintable(row[QStringLiteral("name")].toString())) << row.toObject();
    }
    static std::optional<Beacon> decode(const QByteArray &bytes)
    {
        return Beacon::decode(bytes.constData(), bytes.size());
    }
};

void tst_Beacon::validBeaconsMatchTheVectors()
{
    QFETCH(QJsonObject, row);
    const Beacon beacon{quint16(row[QStringLiteral("port")].toInt()), row[QStringLiteral("secured")].toBool(),
                        vectors::number(row[QStringLiteral("tableHash")]), row[QStringLiteral("text")].toString()};
    const QByteArray bytes = vectors::bytes(row[QStringLiteral("hex")]);
    QCOMPARE(beacon.encoded().toHex(), bytes.toHex());
    QVERIFY(bytes.size() <= Beacon::MaximumSize);
    const auto read = decode(bytes);
    QVERIFY(read.has_value());
    QVERIFY(*read == beacon);
}

void tst_Beacon::invalidBeaconsAreDropped()
{
    QFETCH(QJsonObject, row);
    QVERIFY(!decode(vectors::bytes(row[QStringLiteral("hex")])));
}

void tst_Beacon::everyWrongBitIsFound()
{
    const QByteArray good = Beacon{50000, false, 7, QStringLiteral("kite")}.encoded();
    for (int bit = 0; bit < good.size() * 8; ++bit) {
        QByteArray bad = good;
        bad[bit / 8] = char(bad[bit / 8] ^ (1 << bit % 8));
        QVERIFY2(!decode(bad), qPrintable(QString::number(bit)));
    }
}

void tst_Beacon::everyOtherLengthIsDropped()
{
    const QByteArray good = Beacon{50000, true, 7, QStringLiteral("kite")}.encoded();
    for (int size = 0; size < 300; ++size)
        QCOMPARE(decode(good.leftJustified(size, 'x', true)).has_value(), size == good.size());
}

void tst_Beacon::longNamesAreCutBetweenCharacters_data()
{
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("sent");
    const auto times = [](int count, const char *text) { return QString::fromUtf8(text).repeated(count); };
    QTest::newRow("none") << QString() << QStringLiteral("master");
    QTest::newRow("64 bytes") << times(64, "x") << times(64, "x");
    QTest::newRow("65 bytes") << times(65, "x") << times(64, "x");
    QTest::newRow("two bytes a character")
        << QStringLiteral("x") + times(40, "ö") << QStringLiteral("x") + times(31, "ö");
    QTest::newRow("four bytes a character")
        << QStringLiteral("xx") + times(40, "🪁") << QStringLiteral("xx") + times(15, "🪁");
}

void tst_Beacon::longNamesAreCutBetweenCharacters()
{
    QFETCH(QString, name);
    const auto read = decode(Beacon{1, false, 0, name}.encoded());
    QVERIFY(read.has_value());
    QTEST(read->name, "sent");
}

void tst_Beacon::theDocumentHasTheExample()
{
    const QByteArray document = vectors::document(QStringLiteral("protocol.md"));
    QByteArray example = document.mid(document.indexOf("The 31 bytes of a master"));
    example = example.mid(example.indexOf("```\n") + 4);
    example.truncate(example.indexOf("```"));
    QByteArray bytes;
    for (const QByteArray &line : example.split('\n'))
        bytes += QByteArray::fromHex(line.left(47));  // the rest says what it is
    QCOMPARE(bytes.toHex(), Beacon({50000, false, 0x0123456789ABCDEF, QStringLiteral("awe_master")}).encoded().toHex());
    QVERIFY(document.contains("**239.255.81.80**") && document.contains("**50081**"));
    QCOMPARE(QByteArray(Beacon::Group), QByteArray("239.255.81.80"));
    QCOMPARE(int(Beacon::GroupPort), 50081);
}

QTEST_APPLESS_MAIN(tst_Beacon)
#include "tst_Beacon.moc"
