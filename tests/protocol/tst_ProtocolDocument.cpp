// SPDX-License-Identifier: Apache-2.0
#include "FieldTable.h"
#include "Vectors.h"

#include <QtCore/QMetaEnum>
#include <QtTest/QtTest>

// docs/protocol.md is what clients in other languages are written from: it must not drift from the
// code.
class tst_ProtocolDocument : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void documentListsEveryKindWithItsNumber();
    void documentListsEveryFieldWithItsTypePresenceAndValues();
    void documentDescribesTheFieldsOfEveryExample();
    void documentContainsTheExampleOfTheVectors();
    void documentContainsTheSealedExampleOfTheVectors();

private:
    QString m_text;
};

void tst_ProtocolDocument::initTestCase()
{
    m_text = QString::fromUtf8(vectors::document(QStringLiteral("protocol.md")));
    QVERIFY(!m_text.isEmpty());
}

void tst_ProtocolDocument::documentListsEveryKindWithItsNumber()
{
    const QMetaEnum kinds = QMetaEnum::fromType<QPlcMessage::Kind>();
    for (int i = 0; i < kinds.keyCount(); ++i) {
        const QString row = QStringLiteral("| %1 | `%2` |").arg(kinds.value(i)).arg(QLatin1String(kinds.key(i)));
        QVERIFY2(m_text.contains(row) || kinds.value(i) == QPlcMessage::Invalid, qPrintable(row));
    }
}

void tst_ProtocolDocument::documentListsEveryFieldWithItsTypePresenceAndValues()
{
    const QString begin = QStringLiteral("<!-- fields -->\n\n");
    const QString end = QStringLiteral("<!-- end of fields -->");
    const int from = m_text.indexOf(begin) + begin.size();
    const int to = m_text.indexOf(end, from);
    QVERIFY(from > begin.size() && to >= from);
    if (m_text.mid(from, to - from) == fieldtable::text())
        return;
    QFile file(QStringLiteral("protocol.md"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write((m_text.left(from) + fieldtable::text() + m_text.mid(to)).toUtf8());
    QFAIL(qPrintable(QStringLiteral("the structs have other fields than section 5.9; remedy: look at %1, and copy it "
                                    "to docs/protocol.md")
                         .arg(QFileInfo(file).absoluteFilePath())));
}

void tst_ProtocolDocument::documentDescribesTheFieldsOfEveryExample()
{
    for (const QJsonValue row :
         vectors::file(QStringLiteral("control_frames.json"))[QStringLiteral("good")].toArray()) {
        if (!row[QStringLiteral("canonical")].toBool())
            continue;
        for (const QString &field : row[QStringLiteral("fields")].toObject().keys())
            QVERIFY2(m_text.contains(QStringLiteral("`%1`").arg(field)), qPrintable(field));
    }
}

void tst_ProtocolDocument::documentContainsTheExampleOfTheVectors()
{
    const QJsonObject example
        = vectors::file(QStringLiteral("cyclic_frames.json"))[QStringLiteral("frames")].toArray().at(0).toObject();
    const QJsonValue channel = example[QStringLiteral("channel")];
    const QJsonArray parts{channel[QStringLiteral("session")], channel[QStringLiteral("layoutHash")],
                           example[QStringLiteral("payload")], example[QStringLiteral("frames")].toArray().at(0)};
    for (const QJsonValue hex : parts)
        QVERIFY2(m_text.contains(hex.toString()), qPrintable(hex.toString()));
}

void tst_ProtocolDocument::documentContainsTheSealedExampleOfTheVectors()
{
    const QJsonObject example
        = vectors::file(QStringLiteral("sealed_frames.json"))[QStringLiteral("frames")].toArray().at(0).toObject();
    const QString frame = example[QStringLiteral("frames")].toArray().at(0).toString();
    const int header = 2 * int(qplc::CyclicHeaderSize);
    const int tag = frame.size() - 2 * 16;
    for (const QString &hex : {frame.left(header), frame.mid(header, tag - header), frame.mid(tag)})
        QVERIFY2(m_text.contains(hex), qPrintable(hex));
}

QTEST_APPLESS_MAIN(tst_ProtocolDocument)
#include "tst_ProtocolDocument.moc"
