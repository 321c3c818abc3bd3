// SPDX-License-Identifier: Apache-2.0
#include "hardware/serial/NmeaStream.h"
#include "hardware/serial/NmeaWind.h"

#include <QtTest/QtTest>

#include <cmath>

using namespace qplc;

namespace {

/// A sentence with its checksum.
QByteArray sealed(const QByteArray &body)
{
    return '$' + body + '*'
        + QByteArray::number(NmeaSentence::checksum(body.constData(), body.size()), 16)
              .rightJustified(2, '0')
              .toUpper();
}

NmeaWind windOf(const QByteArray &body)
{
    NmeaSentence sentence;
    if (NmeaSentence::parse(sealed(body), &sentence) != NmeaSentence::Good)
        qFatal("%s is no sentence", body.constData());
    return NmeaWind::read(sentence);
}

QVector<QByteArray> typesIn(const QByteArray &bytes, NmeaStream *stream)
{
    QVector<QByteArray> types;
    for (const char byte : bytes) {
        if (stream->feed(byte))
            types << stream->sentence().type();
    }
    return types;
}

bool isNear(const std::optional<double> &value, double expected)
{
    return value && std::abs(*value - expected) < 1e-9;
}

}  // namespace

class tst_NmeaSentence : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void sentenceIsSplitIntoTalkerTypeAndFields();
    void checksumFollowsTheStandard();
    void invalidSentenceIsRefused_data();
    void invalidSentenceIsRefused();
    void numbersAreDecimal();
    void aStreamMayComeInAnyPieces();
    void aStreamFindsTheNextSentenceAfterGarbage();
    void endlessLineDoesNotGrowTheBuffer();
    void sentencesWithoutAChecksumAreRefusedUnlessAllowed();
    void windIsReadFromMwv_data();
    void windIsReadFromMwv();
    void anInvalidMwvHasNoWind();
    void windIsReadFromVwrAndVwt();
    void weatherIsReadFromMda();
    void weatherIsReadFromXdr();
    void impossibleValuesAreIgnored();
    void otherSentencesGiveNoWind();
};

void tst_NmeaSentence::sentenceIsSplitIntoTalkerTypeAndFields()
{
    NmeaSentence sentence;
    QCOMPARE(NmeaSentence::parse("$WIMWV,214.8,R,,M,A", &sentence), NmeaSentence::Good);
    QCOMPARE(sentence.talker(), QByteArray("WI"));
    QCOMPARE(sentence.type(), QByteArray("MWV"));
    QCOMPARE(sentence.fieldCount(), 5);
    QCOMPARE(sentence.field(0), QByteArray("214.8"));
    QCOMPARE(sentence.field(2), QByteArray());
    QCOMPARE(sentence.field(5), QByteArray());
    QVERIFY(sentence.isLetter(1, 'R'));
    QVERIFY(!sentence.isLetter(2, 'R'));
    QVERIFY(!sentence.hasChecksum());
    QCOMPARE(NmeaSentence::parse("$PGRMZ,93,f", &sentence), NmeaSentence::Good);
    QCOMPARE(sentence.talker(), QByteArray("P"));
    QCOMPARE(sentence.type(), QByteArray("GRMZ"));
    QCOMPARE(NmeaSentence::parse("!AIVDM,1", &sentence), NmeaSentence::Good);
}

void tst_NmeaSentence::checksumFollowsTheStandard()
{
    NmeaSentence sentence;
    // Worked by hand: exclusive or of the letters.
    QCOMPARE(NmeaSentence::checksum("AB", 2), quint8('A' ^ 'B'));
    const quint8 sum = 'W' ^ 'I' ^ 'M' ^ 'W' ^ 'V' ^ ',' ^ '1';
    const QByteArray good = "$WIMWV,1*" + QByteArray::number(sum, 16).rightJustified(2, '0');
    QCOMPARE(NmeaSentence::parse(good, &sentence), NmeaSentence::Good);
    QVERIFY(sentence.hasChecksum());
    QCOMPARE(sentence.field(0), QByteArray("1"));
    QCOMPARE(NmeaSentence::parse(good.toLower().replace("wimwv", "WIMWV"), &sentence), NmeaSentence::Good);
    QCOMPARE(NmeaSentence::parse(QByteArray(good).replace(",1*", ",2*"), &sentence), NmeaSentence::WrongChecksum);
}

void tst_NmeaSentence::invalidSentenceIsRefused_data()
{
    QTest::addColumn<QByteArray>("line");
    QTest::addColumn<int>("result");
    QTest::newRow("nothing") << QByteArray() << int(NmeaSentence::NoSentence);
    QTest::newRow("only the begin") << QByteArray("$") << int(NmeaSentence::NoSentence);
    QTest::newRow("no begin") << QByteArray("WIMWV,1") << int(NmeaSentence::NoSentence);
    QTest::newRow("short address") << QByteArray("$WMWV,1") << int(NmeaSentence::NoSentence);
    QTest::newRow("small letters") << QByteArray("$wimwv,1") << int(NmeaSentence::NoSentence);
    QTest::newRow("only a P") << QByteArray("$P,1") << int(NmeaSentence::NoSentence);
    QTest::newRow("a zero byte") << QByteArray("$WIMWV,\0", 8) << int(NmeaSentence::NoSentence);
    QTest::newRow("bit 7") << QByteArray("$WIMWV,\xb0") << int(NmeaSentence::NoSentence);
    QTest::newRow("two begins") << QByteArray("$WIM$WIMWV,1") << int(NmeaSentence::NoSentence);
    QTest::newRow("half a checksum") << QByteArray("$WIMWV,1*1") << int(NmeaSentence::WrongChecksum);
    QTest::newRow("an empty checksum") << QByteArray("$WIMWV,1*") << int(NmeaSentence::WrongChecksum);
    QTest::newRow("a checksum of letters") << QByteArray("$WIMWV,1*zz") << int(NmeaSentence::WrongChecksum);
    QTest::newRow("something behind it") << sealed("WIMWV,1") + " " << int(NmeaSentence::WrongChecksum);
    QTest::newRow("too long") << "$WIMWV," + QByteArray(NmeaSentence::MaximumLength, '1') << int(NmeaSentence::TooLong);
}

void tst_NmeaSentence::invalidSentenceIsRefused()
{
    QFETCH(QByteArray, line);
    NmeaSentence sentence;
    QTEST(int(NmeaSentence::parse(line, &sentence)), "result");
}

void tst_NmeaSentence::numbersAreDecimal()
{
    NmeaSentence sentence;
    QCOMPARE(NmeaSentence::parse("$WIMWV,214.8,-0.5,+3,007,1e3,nan,inf,0x1,.,1.2.3,", &sentence), NmeaSentence::Good);
    double number = 0.0;
    const double right[] = {214.8, -0.5, 3.0, 7.0};
    for (int i = 0; i < 4; ++i) {
        QVERIFY(sentence.number(i, &number));
        QCOMPARE(number, right[i]);
    }
    for (int i = 4; i < sentence.fieldCount() + 1; ++i)
        QVERIFY2(!sentence.number(i, &number), sentence.field(i).constData());
    QCOMPARE(number, 7.0);
}

void tst_NmeaSentence::aStreamMayComeInAnyPieces()
{
    const QByteArray bytes
        = sealed("WIMWV,1,R,2,M,A") + "\r\n" + sealed("WIXDR,C,1,C,A") + "\n\n" + sealed("WIVWR,1,L") + "\r";
    NmeaStream stream;
    QCOMPARE(typesIn(bytes, &stream), (QVector<QByteArray>{"MWV", "XDR", "VWR"}));
    QCOMPARE(stream.sentences(), quint64(3));
    QCOMPARE(stream.refused(), quint64(0));
    QCOMPARE(stream.bytes(), quint64(bytes.size()));
}

void tst_NmeaSentence::aStreamFindsTheNextSentenceAfterGarbage()
{
    const QByteArray good = sealed("WIMWV,1,R,2,M,A") + "\r\n";
    NmeaStream stream;
    QCOMPARE(typesIn("\x81\xff\n,R,2,M,A*12\r\n$WIMW" + good + QByteArray(good).replace(",2,", ",3,") + good, &stream),
             (QVector<QByteArray>{"MWV", "MWV"}));
    QCOMPARE(stream.refused(),
             quint64(2));  // half a sentence, and one with a wrong checksum; the rest was no sentence at all
}

void tst_NmeaSentence::endlessLineDoesNotGrowTheBuffer()
{
    NmeaStream stream;
    QCOMPARE(typesIn("$WIMWV," + QByteArray(100000, '1') + "\r\n" + sealed("WIMWV,1") + "\r\n", &stream),
             QVector<QByteArray>{"MWV"});
    QCOMPARE(stream.refused(), quint64(1));
}

void tst_NmeaSentence::sentencesWithoutAChecksumAreRefusedUnlessAllowed()
{
    NmeaStream stream;
    QCOMPARE(typesIn("$WIMWV,1\r\n", &stream), QVector<QByteArray>{});
    stream.setChecksumRequired(false);
    QCOMPARE(typesIn("$WIMWV,1\r\n$WIMWV,1*00\r\n", &stream), QVector<QByteArray>{"MWV"});
}

void tst_NmeaSentence::windIsReadFromMwv_data()
{
    QTest::addColumn<QByteArray>("body");
    QTest::addColumn<bool>("isRelative");
    QTest::addColumn<double>("speed");
    QTest::addColumn<double>("angle");
    QTest::newRow("m/s") << QByteArray("WIMWV,90,R,5.5,M,A") << true << 5.5 << M_PI / 2;
    QTest::newRow("knots") << QByteArray("WIMWV,180,T,36,N,A") << false << 18.52 << M_PI;
    QTest::newRow("km/h") << QByteArray("WIMWV,270,R,36,K,A") << true << 10.0 << 1.5 * M_PI;
    QTest::newRow("miles per hour") << QByteArray("IIMWV,360,R,100,S,A") << true << 44.704 << 0.0;
    QTest::newRow("a negative angle") << QByteArray("WIMWV,-90,R,1,M,A") << true << 1.0 << 1.5 * M_PI;
}

void tst_NmeaSentence::windIsReadFromMwv()
{
    QFETCH(QByteArray, body);
    QFETCH(bool, isRelative);
    QFETCH(double, speed);
    QFETCH(double, angle);
    const NmeaWind wind = windOf(body);
    const NmeaWind::Wind &seen = isRelative ? wind.relative : wind.theoretical;
    const NmeaWind::Wind &other = isRelative ? wind.theoretical : wind.relative;
    QVERIFY(isNear(seen.speed, speed));
    QVERIFY(isNear(seen.angle, angle));
    QVERIFY(!other.speed && !other.angle);
    QVERIFY(wind.isValid && *wind.isValid);
}

void tst_NmeaSentence::anInvalidMwvHasNoWind()
{
    for (const char *body : {"WIMWV,90,R,5.5,M,V", "WIMWV,90,R,5.5,M,", "WIMWV,90,R"}) {
        const NmeaWind wind = windOf(body);
        QVERIFY2(wind.isValid && !*wind.isValid && !wind.relative.speed && !wind.relative.angle, body);
    }
    QVERIFY(!windOf("WIMWV,90,X,5.5,M,A").isValid);
}

void tst_NmeaSentence::windIsReadFromVwrAndVwt()
{
    const NmeaWind left = windOf("IIVWR,45,L,10,N,5.2,M,18.5,K");
    QVERIFY(isNear(left.relative.angle, 1.75 * M_PI));
    QVERIFY(isNear(left.relative.speed, 5.2));
    const NmeaWind right = windOf("IIVWT,45,R,36,N,,M,,K");
    QVERIFY(isNear(right.theoretical.angle, 0.25 * M_PI));
    QVERIFY(isNear(right.theoretical.speed, 18.52));
    QVERIFY(!right.relative.angle);
    QVERIFY(!windOf("IIVWR,190,L,,,,,,").relative.angle);
    QVERIFY(!windOf("IIVWR,45,,,,,,,").relative.angle);
}

void tst_NmeaSentence::weatherIsReadFromMda()
{
    const NmeaWind weather = windOf("WIMDA,29.92,I,1.0132,B,21.5,C,,C,55,,12.1,C,90,T,87,M,10,N,5.14,M");
    QVERIFY(isNear(weather.pressure, 101320.0));
    QVERIFY(isNear(weather.temperature, 21.5));
    QVERIFY(isNear(weather.humidity, 0.55));
    QVERIFY(isNear(weather.direction, M_PI / 2));
    QVERIFY(isNear(weather.theoretical.speed, 5.14));
    QVERIFY(isNear(windOf("WIMDA,,I,,B,,C,,C,,,,C,,T,,M,36,N,,M").theoretical.speed, 18.52));
    QVERIFY(!windOf("WIMDA").pressure);
}

void tst_NmeaSentence::weatherIsReadFromXdr()
{
    const NmeaWind weather = windOf("WIXDR,C,21.5,C,AIR,C,30,C,HEATER,H,55,P,0,P,1.0132,B,0");
    QVERIFY(isNear(weather.temperature, 21.5));
    QVERIFY(isNear(weather.humidity, 0.55));
    QVERIFY(isNear(weather.pressure, 101320.0));
    QVERIFY(isNear(windOf("WIXDR,P,99000,P,X").pressure, 99000.0));
    QVERIFY(!windOf("WIXDR,C,21.5").temperature);
}

void tst_NmeaSentence::impossibleValuesAreIgnored()
{
    const NmeaWind wind = windOf("WIMWV,400,R,-1,M,A");
    QVERIFY(!wind.relative.angle);
    QVERIFY(!wind.relative.speed);
    QVERIFY(!windOf("WIMWV,90,R,5,X,A").relative.speed);
}

void tst_NmeaSentence::otherSentencesGiveNoWind()
{
    QVERIFY(!windOf("GPGGA,1").isOfWind);
    QVERIFY(!windOf("PMWV,90,R,5,M,A").isOfWind);
    QVERIFY(windOf("WIMWV").isOfWind);
}

QTEST_GUILESS_MAIN(tst_NmeaSentence)
#include "tst_NmeaSentence.moc"
