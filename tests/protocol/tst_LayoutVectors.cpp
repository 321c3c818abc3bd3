// SPDX-License-Identifier: Apache-2.0
#include "QPlcValue.h"
#include "Vectors.h"
#include "signals/PayloadLayout.h"
#include "signals/ProcessImage.h"
#include "signals/SignalRules.h"

#include <QtTest/QtTest>

// The layouts and value encodings that docs/protocol.md promises to clients in other languages.
class tst_LayoutVectors : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void layoutsMatchTheVectors_data();
    void layoutsMatchTheVectors();
    void tablesMatchTheVectors_data();
    void tablesMatchTheVectors();
    void digestsMatchTheVectors_data();
    void digestsMatchTheVectors();
    void valuesMatchTheVectors_data();
    void valuesMatchTheVectors();
};

static void addRows(const QString &list)
{
    QTest::addColumn<QJsonObject>("row");
    const QJsonArray rows = vectors::file(QStringLiteral("layouts.json"))[list].toArray();
    QVERIFY(!rows.isEmpty());
    for (int i = 0; i < rows.size(); ++i)
        QTest::addRow("%d", i) << rows.at(i).toObject();
}

void tst_LayoutVectors::layoutsMatchTheVectors_data()
{
    addRows(QStringLiteral("layouts"));
}

void tst_LayoutVectors::layoutsMatchTheVectors()
{
    QFETCH(QJsonObject, row);
    const QPlcSignalTable table = QPlcSignalTable::fromIni(row[QStringLiteral("table")].toString().toUtf8());
    const QJsonArray fields = row[QStringLiteral("fields")].toArray();
    QVector<QPlcSignalIndex> indices;
    for (const QJsonValue field : fields)
        indices.append(table.indexOf(field[QStringLiteral("name")].toString()));

    const qplc::PayloadLayout layout(table, indices,
                                     row[QStringLiteral("qualities")].toBool() ? qplc::PayloadLayout::WithQualities
                                                                               : qplc::PayloadLayout::WithoutQualities);
    QCOMPARE(layout.fields().size(), std::size_t(fields.size()));
    for (int i = 0; i < fields.size(); ++i) {
        QCOMPARE(layout.fields()[std::size_t(i)].type.name(), fields.at(i)[QStringLiteral("type")].toString());
        QCOMPARE(int(layout.fields()[std::size_t(i)].offset), fields.at(i)[QStringLiteral("offset")].toInt());
    }
    QCOMPARE(int(layout.size()), row[QStringLiteral("size")].toInt());
    QCOMPARE(quint64(layout.hash()), vectors::number(row[QStringLiteral("hash")]));

    QJsonArray borders;
    for (const quint32 border : layout.partBorders(quint32(row[QStringLiteral("maximum")].toInt())))
        borders.append(int(border));
    QCOMPARE(borders, row[QStringLiteral("borders")].toArray());
}

void tst_LayoutVectors::tablesMatchTheVectors_data()
{
    addRows(QStringLiteral("tables"));
}

void tst_LayoutVectors::tablesMatchTheVectors()
{
    QFETCH(QJsonObject, row);
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(row[QStringLiteral("table")].toString().toUtf8(), &errors);
    QVERIFY2(errors.isEmpty(), qPrintable(QPlcParseError::toString(errors)));
    const QStringList lines = row[QStringLiteral("text")].toString().split(QLatin1Char('\n'));
    const QJsonArray safety = row[QStringLiteral("safety")].toArray();
    QCOMPARE(safety.size(), table.size());
    for (int i = 0; i < table.size(); ++i) {
        QCOMPARE(QString::fromUtf8(qplc::safetyLine(table.at(QPlcSignalIndex(i)))).chopped(1), lines.at(2 * i + 1));
        QCOMPARE(table.safetyHash(QPlcSignalIndex(i)), vectors::number(safety.at(i)));
    }
    QCOMPARE(table.hash(), vectors::number(row[QStringLiteral("hash")]));
    QCOMPARE(QPlcSignalTable::fromIni(table.toIni()).hash(), table.hash());
}

void tst_LayoutVectors::digestsMatchTheVectors_data()
{
    addRows(QStringLiteral("digests"));
}

void tst_LayoutVectors::digestsMatchTheVectors()
{
    QFETCH(QJsonObject, row);
    qplc::ProcessImage image(QPlcSignalTable::fromIni(row[QStringLiteral("table")].toString().toUtf8()));
    const QJsonArray cycles = row[QStringLiteral("cycles")].toArray();
    quint64 digest = 0;
    for (const QJsonValue cycle : cycles) {
        const QByteArray bytes = vectors::bytes(cycle[QStringLiteral("image")]);
        QCOMPARE(int(image.size()), bytes.size());
        std::copy(bytes.begin(), bytes.end(), image.data());
        digest = image.digest(digest);
        QCOMPARE(digest, vectors::number(cycle[QStringLiteral("digest")]));
    }
}

void tst_LayoutVectors::valuesMatchTheVectors_data()
{
    addRows(QStringLiteral("values"));
}

void tst_LayoutVectors::valuesMatchTheVectors()
{
    QFETCH(QJsonObject, row);
    const QPlcSignalType type = QPlcSignalType::fromName(row[QStringLiteral("type")].toString());
    QVERIFY(type.isValid());
    const QByteArray bytes = vectors::bytes(row[QStringLiteral("hex")]);
    QString error;
    const QPlcValue value = QPlcValue::fromString(type, row[QStringLiteral("text")].toString(), &error);
    QVERIFY2(value.isValid(), qPrintable(error));
    QCOMPARE(value.toBytes().toHex(), bytes.toHex());
    QCOMPARE(QPlcValue::fromBytes(type, bytes), value);
}

QTEST_APPLESS_MAIN(tst_LayoutVectors)
#include "tst_LayoutVectors.moc"
