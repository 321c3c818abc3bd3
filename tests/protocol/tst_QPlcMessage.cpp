// SPDX-License-Identifier: Apache-2.0
#include "QPlcMessage.h"

#include <QtTest/QtTest>

Q_DECLARE_METATYPE(QJsonValue)

class tst_QPlcMessage : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void defaultMessageIsInvalidAndEmpty();
    void messageNamesItsKind();
    void numberOf64BitsSurvives_data();
    void numberOf64BitsSurvives();
    void malformedNumberIsZero_data();
    void malformedNumberIsZero();
    void bytesSurvive_data();
    void bytesSurvive();
    void malformedBytesGiveAnEmptyArray_data();
    void malformedBytesGiveAnEmptyArray();
    void textOfAnotherTypeIsEmpty();
    void messagesAreEqualByKindAndFields();
};

static QPlcMessage withField(const QJsonValue &value)
{
    return QPlcMessage(QPlcMessage::State, {{QStringLiteral("x"), value}});
}

void tst_QPlcMessage::defaultMessageIsInvalidAndEmpty()
{
    const QPlcMessage message;
    QCOMPARE(message.kind(), QPlcMessage::Invalid);
    QVERIFY(message.fields().isEmpty());
}

void tst_QPlcMessage::messageNamesItsKind()
{
    QCOMPARE(QPlcMessage(QPlcMessage::Register).kindName(), QStringLiteral("Register"));
    QCOMPARE(QPlcMessage::kindName(QPlcMessage::SendYourInitialOutputStates),
             QStringLiteral("SendYourInitialOutputStates"));
    QCOMPARE(QPlcMessage(QPlcMessage::Kind(77)).kindName(), QStringLiteral("unknown kind 77"));
    QCOMPARE(QPlcMessage::kindName(QPlcMessage::Kind(255)), QStringLiteral("unknown kind 255"));
}

void tst_QPlcMessage::numberOf64BitsSurvives_data()
{
    QTest::addColumn<quint64>("number");
    QTest::addColumn<QString>("text");
    QTest::newRow("zero") << Q_UINT64_C(0) << "0000000000000000";
    QTest::newRow("one") << Q_UINT64_C(1) << "0000000000000001";
    QTest::newRow("more than a double holds") << Q_UINT64_C(0x0020000000000001) << "0020000000000001";
    QTest::newRow("every digit") << Q_UINT64_C(0x0123456789abcdef) << "0123456789abcdef";
    QTest::newRow("largest") << ~Q_UINT64_C(0) << "ffffffffffffffff";
}

void tst_QPlcMessage::numberOf64BitsSurvives()
{
    QFETCH(quint64, number);
    QFETCH(QString, text);
    QCOMPARE(QPlcMessage::fromHex64(number), text);
    QCOMPARE(withField(text).hex64(QStringLiteral("x")), number);
}

void tst_QPlcMessage::malformedNumberIsZero_data()
{
    QTest::addColumn<QJsonValue>("value");
    QTest::newRow("missing") << QJsonValue(QJsonValue::Undefined);
    QTest::newRow("a number") << QJsonValue(1);
    QTest::newRow("empty") << QJsonValue(QString());
    QTest::newRow("15 digits") << QJsonValue(QStringLiteral("123456789abcdef"));
    QTest::newRow("17 digits") << QJsonValue(QStringLiteral("00000000000000001"));
    QTest::newRow("upper case") << QJsonValue(QStringLiteral("000000000000000A"));
    QTest::newRow("0x") << QJsonValue(QStringLiteral("0x00000000000001"));
    QTest::newRow("a sign") << QJsonValue(QStringLiteral("+000000000000001"));
    QTest::newRow("a space") << QJsonValue(QStringLiteral(" 000000000000001"));
    QTest::newRow("a letter") << QJsonValue(QStringLiteral("000000000000000g"));
    QTest::newRow("digits of another script") << QJsonValue(QString(16, QChar(0x0661)));
}

void tst_QPlcMessage::malformedNumberIsZero()
{
    QFETCH(QJsonValue, value);
    QCOMPARE(withField(value).hex64(QStringLiteral("x")), Q_UINT64_C(0));
}

void tst_QPlcMessage::bytesSurvive_data()
{
    QTest::addColumn<QByteArray>("bytes");
    QTest::addColumn<QString>("text");
    QTest::newRow("none") << QByteArray() << "";
    QTest::newRow("one") << QByteArray("\0", 1) << "AA==";
    QTest::newRow("two") << QByteArray("\xff\xfe", 2) << "//4=";
    QTest::newRow("three") << QByteArray("abc") << "YWJj";
}

void tst_QPlcMessage::bytesSurvive()
{
    QFETCH(QByteArray, bytes);
    QFETCH(QString, text);
    QCOMPARE(QPlcMessage::fromBytes(bytes), text);
    QCOMPARE(withField(text).bytes(QStringLiteral("x")), bytes);
}

void tst_QPlcMessage::malformedBytesGiveAnEmptyArray_data()
{
    QTest::addColumn<QJsonValue>("value");
    QTest::newRow("missing") << QJsonValue(QJsonValue::Undefined);
    QTest::newRow("a number") << QJsonValue(1234);
    QTest::newRow("no padding") << QJsonValue(QStringLiteral("AA"));
    QTest::newRow("half a padding") << QJsonValue(QStringLiteral("AA="));
    QTest::newRow("too much padding") << QJsonValue(QStringLiteral("YWJj===="));
    QTest::newRow("a line end") << QJsonValue(QStringLiteral("YW\nJj"));
    QTest::newRow("the alphabet of addresses") << QJsonValue(QStringLiteral("__4="));
    QTest::newRow("not Latin") << QJsonValue(QStringLiteral("YWJ\u0441"));
}

void tst_QPlcMessage::malformedBytesGiveAnEmptyArray()
{
    QFETCH(QJsonValue, value);
    QVERIFY(withField(value).bytes(QStringLiteral("x")).isEmpty());
}

void tst_QPlcMessage::textOfAnotherTypeIsEmpty()
{
    QCOMPARE(withField(QStringLiteral("Off")).text(QStringLiteral("x")), QStringLiteral("Off"));
    QVERIFY(withField(1).text(QStringLiteral("x")).isEmpty());
    QVERIFY(withField(QJsonObject()).text(QStringLiteral("x")).isEmpty());
    QVERIFY(withField(1).text(QStringLiteral("y")).isEmpty());
}

void tst_QPlcMessage::messagesAreEqualByKindAndFields()
{
    QCOMPARE(withField(1), withField(1));
    QVERIFY(withField(1) != withField(2));
    QVERIFY(QPlcMessage(QPlcMessage::Stop) != QPlcMessage(QPlcMessage::GetState));
}

QTEST_APPLESS_MAIN(tst_QPlcMessage)
#include "tst_QPlcMessage.moc"
