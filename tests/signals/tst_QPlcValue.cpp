// SPDX-License-Identifier: Apache-2.0
#include "QPlcValue.h"
#include "QSplitPrimitive.h"

#include <QtTest/QtTest>

#include <cmath>
#include <limits>
#include <random>
#include <utility>

class tst_QPlcValue : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void typeFollowsFromTheNumber();
    void bytesAreLittleEndianAndPacked_data();
    void bytesAreLittleEndianAndPacked();
    void textIsReadAndWrittenBack_data();
    void textIsReadAndWrittenBack();
    void wrongTextsAreRefusedWithTheReason_data();
    void wrongTextsAreRefusedWithTheReason();
    void otherSpellingsOfATextAreRead_data();
    void otherSpellingsOfATextAreRead();
    void everyRealSurvivesItsText();
    void timesAreExactToTheNanosecond_data();
    void timesAreExactToTheNanosecond();
    void timesOutsideSixtyFourBitsAreInvalid();
    void textIsNeverCut();
    void malformedBytesOfATextAreInvalid();
    void numbersRoundAndSaturate();
    void elementBeyondTheLastHasNoNumber();
    void conversionKeepsTheQuantityOrFails_data();
    void conversionKeepsTheQuantityOrFails();
    void equalMeansSameTypeAndBytes();
    void movedFromValueStaysUnchanged();
    void largestValueOfEachKindIsCopied();
    void variantHasTheNaturalType();
    void splitPrimitiveIsLittleEndian();
};

namespace {

QPlcSignalType typeNamed(const char *name)
{
    return QPlcSignalType::fromName(QString::fromLatin1(name));
}

QPlcValue read(const char *type, const char *text, QString *error = nullptr)
{
    return QPlcValue::fromString(typeNamed(type), QString::fromUtf8(text), error);
}

}  // namespace

void tst_QPlcValue::typeFollowsFromTheNumber()
{
    enum Anything { Something };
    QVERIFY(!(std::is_convertible_v<Anything *, QPlcValue>));
    QCOMPARE(QPlcValue(true).type(), typeNamed("Int8"));
    QCOMPARE(QPlcValue(1.0f).type(), typeNamed("Real32"));
    QCOMPARE(QPlcValue(1.0).type(), typeNamed("Real64"));
    QCOMPARE(QPlcValue(0).type(), typeNamed("Int32"));
    QCOMPARE(QPlcValue(0u).type(), typeNamed("UInt32"));
    QCOMPARE(QPlcValue(qint64(0)).type(), typeNamed("Int64"));
    QCOMPARE(QPlcValue(quint8(0)).type(), typeNamed("UInt8"));
    QCOMPARE(QPlcValue({1.0f, 2.0f, 3.0f}).type(), typeNamed("RealTriple"));
    QCOMPARE(QPlcValue(std::array<double, 3>{1, 2, 3}).type(), typeNamed("Real64Triple"));
    QCOMPARE(QPlcValue({true, false}).type(), typeNamed("Bool[2]"));
    QCOMPARE(QPlcValue("kite").type(), typeNamed("String"));
    QCOMPARE(QPlcValue(QString(100, QLatin1Char('x'))).type(), typeNamed("String(100)"));
    QCOMPARE(QPlcValue(QDateTime::currentDateTimeUtc()).type(), typeNamed("DateTime"));
    QCOMPARE(QPlcValue(QPlcSignalType::Real32).type(), typeNamed("Real32"));
    QVERIFY(!QPlcValue().isValid());
    QVERIFY(!QPlcValue(QPlcSignalType()).isValid());
}

void tst_QPlcValue::bytesAreLittleEndianAndPacked_data()
{
    QTest::addColumn<QPlcValue>("value");
    QTest::addColumn<QByteArray>("hex");
    QTest::newRow("Int8") << QPlcValue(qint8(-1)) << QByteArray("ff");
    QTest::newRow("Bool") << QPlcValue(true) << QByteArray("01");
    QTest::newRow("UInt16") << QPlcValue(quint16(0x0102)) << QByteArray("0201");
    QTest::newRow("Int32") << QPlcValue(-2) << QByteArray("feffffff");
    QTest::newRow("UInt64") << QPlcValue(quint64(0x0102030405060708)) << QByteArray("0807060504030201");
    QTest::newRow("Real32") << QPlcValue(1.5f) << QByteArray("0000c03f");
    QTest::newRow("Real64") << QPlcValue(-2.0) << QByteArray("00000000000000c0");
    QTest::newRow("triple") << QPlcValue({1.0f, 0.0f, -0.0f}) << QByteArray("0000803f0000000000000080");
    QTest::newRow("text") << read("String(5)", "kit") << QByteArray("03006b69740000");
    QTest::newRow("time") << read("DateTime", "1970-01-01T00:00:00.000000258Z") << QByteArray("0201000000000000");
    QTest::newRow("invalid") << QPlcValue() << QByteArray();
}

void tst_QPlcValue::bytesAreLittleEndianAndPacked()
{
    QFETCH(QPlcValue, value);
    QFETCH(QByteArray, hex);
    QCOMPARE(value.toBytes().toHex(), hex);
    QCOMPARE(QPlcValue::fromBytes(value.type(), value.toBytes()), value);
    QVERIFY(!QPlcValue::fromBytes(value.type(), value.toBytes() + '\0').isValid());
    QByteArray target(value.type().size(), 'x');
    value.toBytes(target.data());
    QCOMPARE(target, value.toBytes());
}

void tst_QPlcValue::textIsReadAndWrittenBack_data()
{
    QTest::addColumn<QString>("type");
    QTest::addColumn<QString>("text");
    const auto row = [](const char *type, const char *text) {
        QTest::addRow("%s %s", type, text) << QString::fromLatin1(type) << QString::fromUtf8(text);
    };
    row("Int8", "-128");
    row("Int8", "127");
    row("UInt8", "255");
    row("Int16", "-32768");
    row("UInt16", "65535");
    row("Int32", "-2147483648");
    row("UInt32", "4294967295");
    row("Int64", "-9223372036854775808");
    row("Int64", "9223372036854775807");
    row("UInt64", "18446744073709551615");
    row("Real32", "0.1");
    row("Real32", "16777216");
    row("Real32", "3.4028235e+38");
    row("Real32", "1e-45");
    row("Real64", "0.30000000000000004");
    row("Real64", "1.7976931348623157e+308");
    row("Real64", "5e-324");
    row("Real64", "-0");
    row("Real64", "nan");
    row("Real32", "inf");
    row("Real64", "-inf");
    row("RealTriple", "0, -0.5, 1e+10");
    row("Byte[4]", "0, 1, 2, 255");
    row("String(12)", "Höhe, \"5 m\"");
    row("String", "");
    row("String", "  kept  ");
}

void tst_QPlcValue::textIsReadAndWrittenBack()
{
    QFETCH(QString, type);
    QFETCH(QString, text);
    QString error;
    const QPlcValue value = QPlcValue::fromString(QPlcSignalType::fromName(type), text, &error);
    QVERIFY2(value.isValid(), qPrintable(error));
    QCOMPARE(error, QString());
    QCOMPARE(value.type(), QPlcSignalType::fromName(type));
    QCOMPARE(value.toString(), text);
}

void tst_QPlcValue::wrongTextsAreRefusedWithTheReason_data()
{
    QTest::addColumn<QString>("type");
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("reason");
    const auto row = [](const char *type, const char *text, const char *reason) {
        QTest::addRow("%s %s", type, text)
            << QString::fromLatin1(type) << QString::fromUtf8(text) << QString::fromUtf8(reason);
    };
    row("Int8", "128", "'128' is out of range for Int8; write a number in -128 ... 127");
    row("Int8", "-129", "out of range");
    row("Int8", "True", "not an integer");
    row("UInt8", "-1", "0 ... 255");
    row("UInt8", "true", "not an integer");
    row("Int32", "2147483648", "out of range");
    row("Int64", "9223372036854775808", "out of range");
    row("UInt64", "18446744073709551616", "out of range");
    row("Int32", "1.0", "not an integer");
    row("Int32", "1e3", "not an integer");
    row("Int32", "0x10", "not an integer");
    row("Int32", "", "not an integer");
    row("Int32", "+", "not an integer");
    row("Real32", "", "not a number");
    row("Real32", "1x", "'1x' is not a number");
    row("Real32", "1e", "not a number");
    row("Real32", ".", "not a number");
    row("Real32", "1 2", "not a number");
    row("Real32", "infinity", "not a number");
    row("Real32", "\xD9\xA1", "not a number");  // an Arabic digit
    row("Real32", "1,5", "the decimal point is '.'");
    row("Real32", "3.5e38", "at most 3.4028235e+38");
    row("Real64", "-1e309", "too large for Real64");
    row("RealTriple", "1, 2", "holds 2 values, Real32[3] needs 3");
    row("RealTriple", "1, 2, ", "'' is not a number");
    row("String(3)", "kite", "'kite' has 4 bytes of UTF-8, String(3) holds 3");
    row("String(3)", "öö", "4 bytes");
    row("DateTime", "2026-01-31", "not a time");
    row("DateTime", "2026-02-30T00:00:00Z", "not a time");
    row("DateTime", "2026-01-31T24:00:00Z", "not a time");
    row("DateTime", "2026-01-31T23:59:60Z", "not a time");
    row("DateTime", "2026-01-31T12:00:00", "not a time");
    row("DateTime", "2026-01-31T12:00:00.Z", "not a time");
    row("DateTime", "2026-01-31T12:00:00.1234567890Z", "not a time");
    row("DateTime", "2026-01-31T12:00:00+01:00", "not a time");
    row("DateTime", "2263-01-01T00:00:00Z", "not a time");
    row("DateTime", "9999-01-01T00:00:00Z", "not a time");
    row("DateTime", "0001-01-01T00:00:00Z", "not a time");
    row("Nonsense", "1", "type is not valid");
}

void tst_QPlcValue::wrongTextsAreRefusedWithTheReason()
{
    QFETCH(QString, type);
    QFETCH(QString, text);
    QFETCH(QString, reason);
    QString error;
    QVERIFY(!QPlcValue::fromString(QPlcSignalType::fromName(type), text, &error).isValid());
    QVERIFY2(error.contains(reason), qPrintable(error));
    QVERIFY(!QPlcValue::fromString(QPlcSignalType::fromName(type), text).isValid());
}

void tst_QPlcValue::otherSpellingsOfATextAreRead_data()
{
    QTest::addColumn<QPlcValue>("given");
    QTest::addColumn<QString>("canonical");
    QTest::newRow("true") << read("Bool", "true") << QStringLiteral("1");
    QTest::newRow("false") << read("Bool", "false") << QStringLiteral("0");
    QTest::newRow("sign") << read("UInt8", "+7") << QStringLiteral("7");
    QTest::newRow("blanks") << read("Int16", "  -7 ") << QStringLiteral("-7");
    QTest::newRow("minus nothing") << read("UInt8", "-0") << QStringLiteral("0");
    QTest::newRow("no leading digit") << read("Real32", ".5") << QStringLiteral("0.5");
    QTest::newRow("no fraction") << read("Real32", "5.") << QStringLiteral("5");
    QTest::newRow("capital words") << read("Real32", "NaN") << QStringLiteral("nan");
    QTest::newRow("plus infinity") << read("Real64", "+INF") << QStringLiteral("inf");
    QTest::newRow("rounds to zero") << read("Real64", "1e-400") << QStringLiteral("0");
    QTest::newRow("one for all") << read("RealTriple", "2") << QStringLiteral("2, 2, 2");
    QTest::newRow("no blanks") << read("RealTriple", "1,2,3") << QStringLiteral("1, 2, 3");
    QTest::newRow("truths") << read("Bool[2]", "true,false") << QStringLiteral("1, 0");
    QTest::newRow("zeros of a second") << read("DateTime", "2026-01-31T12:00:00.500Z")
                                       << QStringLiteral("2026-01-31T12:00:00.5Z");
}

void tst_QPlcValue::otherSpellingsOfATextAreRead()
{
    QFETCH(QPlcValue, given);
    QFETCH(QString, canonical);
    QCOMPARE(given.toString(), canonical);
}

void tst_QPlcValue::everyRealSurvivesItsText()
{
    std::mt19937 random(1);
    for (int i = 0; i < 20000; ++i) {
        const quint64 bits = quint64(random()) << 32 | random();
        double wide;
        std::memcpy(&wide, &bits, sizeof wide);
        float narrow;
        std::memcpy(&narrow, &bits, sizeof narrow);
        if (!std::isnan(wide))
            QCOMPARE(QPlcValue::fromString(QPlcSignalType::Real64, QPlcValue(wide).toString()), QPlcValue(wide));
        if (!std::isnan(narrow))
            QCOMPARE(QPlcValue::fromString(QPlcSignalType::Real32, QPlcValue(narrow).toString()), QPlcValue(narrow));
    }
}

void tst_QPlcValue::timesAreExactToTheNanosecond_data()
{
    QTest::addColumn<qint64>("time");
    QTest::addColumn<QString>("text");
    const auto row = [](qint64 time, const char *text) { QTest::newRow(text) << time << QString::fromLatin1(text); };
    row(0, "1970-01-01T00:00:00Z");
    row(1, "1970-01-01T00:00:00.000000001Z");
    row(-1, "1969-12-31T23:59:59.999999999Z");
    row(-1000000000, "1969-12-31T23:59:59Z");
    row(951782400120000000, "2000-02-29T00:00:00.12Z");
    row(1769860800123456789, "2026-01-31T12:00:00.123456789Z");
    row(std::numeric_limits<qint64>::max(), "2262-04-11T23:47:16.854775807Z");
    row(std::numeric_limits<qint64>::min(), "1677-09-21T00:12:43.145224192Z");
}

void tst_QPlcValue::timesAreExactToTheNanosecond()
{
    QFETCH(qint64, time);
    QFETCH(QString, text);
    const QPlcValue value = QPlcValue::fromString(QPlcSignalType::DateTime, text);
    QCOMPARE(value.toInt64(), time);
    QCOMPARE(value.toString(), text);
    const qint64 milliseconds = qint64(std::floor(static_cast<long double>(time) / 1e6L));
    QCOMPARE(value.toDateTime(), QDateTime::fromMSecsSinceEpoch(milliseconds, Qt::UTC));
}

void tst_QPlcValue::timesOutsideSixtyFourBitsAreInvalid()
{
    QVERIFY(!read("DateTime", "2262-04-11T23:47:16.854775808Z").isValid());
    QVERIFY(!read("DateTime", "1677-09-21T00:12:43.145224191Z").isValid());
    QVERIFY(!QPlcValue(QDateTime(QDate(2300, 1, 1), QTime(0, 0), Qt::UTC)).isValid());
    QVERIFY(!QPlcValue(QDateTime()).isValid());
    const QDateTime time(QDate(2026, 1, 31), QTime(12, 0, 0, 5), Qt::UTC);
    QCOMPARE(QPlcValue(time).toDateTime(), time);
    QVERIFY(!QPlcValue(1.0).toDateTime().isValid());
}

void tst_QPlcValue::textIsNeverCut()
{
    QCOMPARE(QPlcValue(QString(1438, QLatin1Char('x'))).toString().size(), 1438);
    QVERIFY(!QPlcValue(QString(1439, QLatin1Char('x'))).isValid());
    QVERIFY(!QPlcValue(QString(QChar(0xD800))).isValid());
    QVERIFY(!QPlcValue("\xFF").isValid());
    QVERIFY(QPlcValue("kite").convertedTo(typeNamed("String(4)")).isValid());
    QVERIFY(!QPlcValue("kite").convertedTo(typeNamed("String(3)")).isValid());
    QCOMPARE(QPlcValue("kite").convertedTo(typeNamed("String(100)")).toString(), QStringLiteral("kite"));
}

void tst_QPlcValue::malformedBytesOfATextAreInvalid()
{
    const QPlcSignalType type = typeNamed("String(4)");
    QVERIFY(!QPlcValue::fromBytes(type, QByteArray::fromHex("050061626364")).isValid());  // length beyond the capacity
    QVERIFY(!QPlcValue::fromBytes(type, QByteArray::fromHex("ffff61626364")).isValid());
    QVERIFY(!QPlcValue::fromBytes(type, QByteArray::fromHex("0200c3280000")).isValid());  // no UTF-8
    QVERIFY(!QPlcValue::fromBytes(type, QByteArray::fromHex("0100c3a40000")).isValid());  // half a character
    const QPlcValue padded = QPlcValue::fromBytes(type, QByteArray::fromHex("0100617a7a7a"));
    QCOMPARE(padded.toBytes().toHex(), QByteArray("010061000000"));  // unused bytes do not count
}

void tst_QPlcValue::numbersRoundAndSaturate()
{
    bool ok = false;
    QCOMPARE(QPlcValue(2.5).toInt(), 3);
    QCOMPARE(QPlcValue(-2.4f).toInt(), -2);
    QCOMPARE(QPlcValue(1e300).toInt(0, &ok), std::numeric_limits<int>::max());
    QVERIFY(ok);
    QCOMPARE(QPlcValue(-1e300).toInt64(), std::numeric_limits<qint64>::min());
    QCOMPARE(QPlcValue(9223372036854775808.0).toInt64(), std::numeric_limits<qint64>::max());
    QCOMPARE(QPlcValue(18446744073709551616.0).toUInt64(), std::numeric_limits<quint64>::max());
    QCOMPARE(QPlcValue(-1).toUInt(), 0u);
    QCOMPARE(QPlcValue(std::numeric_limits<quint64>::max()).toInt64(), std::numeric_limits<qint64>::max());
    QCOMPARE(QPlcValue(std::numeric_limits<quint64>::max()).toUInt64(), std::numeric_limits<quint64>::max());
    QCOMPARE(QPlcValue(std::numeric_limits<double>::quiet_NaN()).toInt(0, &ok), 0);
    QVERIFY(!ok);
    QVERIFY(std::isnan(QPlcValue(std::numeric_limits<double>::quiet_NaN()).toReal(0, &ok)));
    QVERIFY(ok);
    QVERIFY(QPlcValue(0.1).toBool());
    QVERIFY(!QPlcValue(false).toBool());
}

void tst_QPlcValue::elementBeyondTheLastHasNoNumber()
{
    const QPlcValue triple({1.0, 2.0, 3.0});
    bool ok = true;
    QCOMPARE(triple.toReal(2, &ok), 3.0);
    QVERIFY(ok);
    QCOMPARE(triple.toReal(3, &ok), 0.0);
    QVERIFY(!ok);
    QCOMPARE(triple.toInt(-1, &ok), 0);
    QVERIFY(!ok);
    QCOMPARE(QPlcValue("12").toReal(0, &ok), 0.0);
    QVERIFY(!ok);
    QCOMPARE(QPlcValue().toUInt64(0, &ok), quint64(0));
    QVERIFY(!ok);
    QCOMPARE(QPlcValue(1.5).toRealTriple(), (std::array<double, 3>{1.5, 0.0, 0.0}));
}

void tst_QPlcValue::conversionKeepsTheQuantityOrFails_data()
{
    QTest::addColumn<QPlcValue>("value");
    QTest::addColumn<QString>("type");
    QTest::addColumn<QString>("text");  // empty: refused
    const auto row = [](const char *name, const QPlcValue &value, const char *type, const char *text) {
        QTest::newRow(name) << value << QString::fromLatin1(type) << QString::fromLatin1(text);
    };
    row("same", QPlcValue(1.5), "Real64", "1.5");
    row("narrower real", QPlcValue(0.1), "Real32", "0.1");
    row("too large for a float", QPlcValue(1e39), "Real32", "");
    row("infinity", QPlcValue(std::numeric_limits<double>::infinity()), "Real32", "inf");
    row("nan", QPlcValue(std::numeric_limits<double>::quiet_NaN()), "Real32", "nan");
    row("nan to integer", QPlcValue(std::numeric_limits<double>::quiet_NaN()), "Int32", "");
    row("rounded", QPlcValue(1.6), "Int8", "2");
    row("rounds out of range", QPlcValue(127.5), "Int8", "");
    row("integer to real", QPlcValue(-3), "Real32", "-3");
    row("negative to unsigned", QPlcValue(-3), "UInt64", "");
    row("largest unsigned", QPlcValue(std::numeric_limits<quint64>::max()), "Int64", "");
    row("wider integer", QPlcValue(quint8(200)), "Int16", "200");
    row("too wide", QPlcValue(200), "Int8", "");
    row("one to all", QPlcValue(2), "RealTriple", "2, 2, 2");
    row("triples", QPlcValue({1.0, 2.0, 3.0}), "RealTriple", "1, 2, 3");
    row("three to two", QPlcValue({1.0, 2.0, 3.0}), "Real[2]", "");
    row("three to one", QPlcValue({1.0, 2.0, 3.0}), "Real", "");
    row("text to number", QPlcValue("1"), "Real", "");
    row("number to text", QPlcValue(1), "String", "");
    row("time to number", QPlcValue(QPlcSignalType(QPlcSignalType::DateTime)), "Int64", "");
    row("nothing", QPlcValue(), "Real", "");
    row("to nothing", QPlcValue(1), "Nonsense", "");
}

void tst_QPlcValue::conversionKeepsTheQuantityOrFails()
{
    QFETCH(QPlcValue, value);
    QFETCH(QString, type);
    QFETCH(QString, text);
    const QPlcValue converted = value.convertedTo(QPlcSignalType::fromName(type));
    QCOMPARE(converted.isValid(), !text.isEmpty());
    QCOMPARE(converted.toString(), text);
    if (converted.isValid())
        QCOMPARE(converted.type(), QPlcSignalType::fromName(type));
}

void tst_QPlcValue::equalMeansSameTypeAndBytes()
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    QVERIFY(QPlcValue(nan) == QPlcValue(nan));
    QVERIFY(QPlcValue(0.0) != QPlcValue(-0.0));
    QVERIFY(QPlcValue(1.0) != QPlcValue(1.0f));
    QVERIFY(QPlcValue() == QPlcValue());
    QVERIFY(QPlcValue() != QPlcValue(0));
    QVERIFY(QPlcValue({1.0, 2.0, 3.0, 4.0}) == QPlcValue({1.0, 2.0, 3.0, 4.0}));
    QVERIFY(QPlcValue({1.0, 2.0, 3.0, 4.0}) != QPlcValue({1.0, 2.0, 3.0, 5.0}));
    QVERIFY(QPlcValue({1.0, nan}).isFinite() == false);
    QVERIFY(QPlcValue({1.0, 2.0}).isFinite());
    QVERIFY(QPlcValue("nan").isFinite());
}

void tst_QPlcValue::movedFromValueStaysUnchanged()
{
    QPlcValue text(QStringLiteral("kite"));
    const QPlcValue moved = std::move(text);
    QCOMPARE(moved.toString(), QStringLiteral("kite"));
    QCOMPARE(text.toString(), QStringLiteral("kite"));
}

void tst_QPlcValue::largestValueOfEachKindIsCopied()
{
    QByteArray bytes(QPlcSignalType::MaximumSize, '\0');
    for (int i = 0; i < bytes.size(); ++i)
        bytes[i] = char(i);
    const QPlcSignalType type = typeNamed("Byte[1440]");
    const QPlcValue value = QPlcValue::fromBytes(type, bytes);
    QPlcValue copy = value;
    QCOMPARE(copy.toBytes(), bytes);
    copy = QPlcValue(1);
    QCOMPARE(copy.toBytes().size(), 4);
    QCOMPARE(value.toUInt(1439), uint(quint8(1439)));
    QCOMPARE(QPlcValue::fromString(type, value.toString()), value);
}

void tst_QPlcValue::variantHasTheNaturalType()
{
    QCOMPARE(QPlcValue(true).toVariant(), QVariant(1));
    QCOMPARE(QPlcValue(quint16(3)).toVariant(), QVariant(3u));
    QCOMPARE(QPlcValue(quint64(3)).toVariant(), QVariant(quint64(3)));
    QCOMPARE(QPlcValue(qint64(-3)).toVariant(), QVariant(qint64(-3)));
    QCOMPARE(QPlcValue(1.5f).toVariant(), QVariant(1.5f));
    QCOMPARE(QPlcValue(1.5).toVariant(), QVariant(1.5));
    QCOMPARE(QPlcValue("kite").toVariant(), QVariant(QStringLiteral("kite")));
    QCOMPARE(QPlcValue({1.0, 2.0}).toVariant(), QVariant(QVariantList{1.0, 2.0}));
    QCOMPARE(read("DateTime", "2026-01-31T12:00:00Z").toVariant().type(), QVariant::DateTime);
    QVERIFY(!QVariant(QPlcValue().toVariant()).isValid());
}

void tst_QPlcValue::splitPrimitiveIsLittleEndian()
{
    QCOMPARE(QSplitPrimitive<float>(1.5f).toBytes().toHex(), QByteArray("0000c03f"));
    QCOMPARE(QSplitPrimitive<quint16>(0x0102).toBytes().toHex(), QByteArray("0201"));
    QCOMPARE(QSplitPrimitive<qint64>::fromBytes("\xfe\xff\xff\xff\xff\xff\xff\xff"), qint64(-2));
    QCOMPARE(QSplitPrimitive<double>().toBytes(), QByteArray(8, '\0'));
}

QTEST_APPLESS_MAIN(tst_QPlcValue)
#include "tst_QPlcValue.moc"
