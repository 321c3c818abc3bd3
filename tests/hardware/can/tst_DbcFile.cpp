// SPDX-License-Identifier: Apache-2.0
#include "hardware/can/DbcFile.h"

#include <QtTest/QtTest>

using namespace qplc;
using namespace std::chrono_literals;

namespace {

// The file of this folder.
QByteArray winchDrive()
{
    QFile file(QStringLiteral(WINCH_DRIVE_DBC));
    if (!file.open(QIODevice::ReadOnly))
        qFatal("%s is missing", WINCH_DRIVE_DBC);
    return file.readAll();
}

DbcFile readDbc(const QByteArray &text)
{
    QVector<QPlcParseError> errors;
    DbcFile file = DbcFile::fromText(text, QStringLiteral("a.dbc"), &errors);
    if (!errors.isEmpty())
        qWarning("%s", qPrintable(QPlcParseError::toString(errors)));
    return file;
}

}  // namespace

class tst_DbcFile : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void messagesHaveIdsAndSizes();
    void bitPositionsOfSignalsAreRead();
    void scaleRangeAndUnitAreRead();
    void multiplexedSignalsKnowTheirPage();
    void floatTypesAreReadAfterTheMessages();
    void attributesAreRead();
    void messageOverridesTheDefaultFrameFormat_data();
    void messageOverridesTheDefaultFrameFormat();
    void signalsWithoutAStartValueHaveTheDefault();
    void valuesHaveNames();
    void textMayBeLatin1();
    void windowsLineEndingsAreAccepted();
    void signalsWithoutMessageAreLeftOut();
    void extendedMultiplexingMakesOnlyItsMessageUnsupported_data();
    void extendedMultiplexingMakesOnlyItsMessageUnsupported();
    void redundantMultiplexRangesAreAccepted();
    void oversizedMessageMakesOnlyItselfUnsupported();
    void signalLayoutIsReadFromItsOwnText_data();
    void signalLayoutIsReadFromItsOwnText();
};

void tst_DbcFile::messagesHaveIdsAndSizes()
{
    const DbcFile file = readDbc(winchDrive());
    QCOMPARE(file.messages().size(), 3);
    const DbcMessage *status = file.find(QStringLiteral("DriveStatus"));
    QVERIFY(status);
    QCOMPARE(status->id, 291U);
    QVERIFY(!status->isExtended);
    QCOMPARE(status->size, 8);
    const DbcMessage *temperatures = file.find(QStringLiteral("Temperatures"));
    QVERIFY(temperatures->isExtended);
    QCOMPARE(temperatures->id, 0x18FEDFFEU);
    QVERIFY(!temperatures->isFd);
    QVERIFY(file.find(QStringLiteral("Wide"))->isFd);
    QVERIFY(!file.find(QStringLiteral("Narrow")));
}

void tst_DbcFile::bitPositionsOfSignalsAreRead()
{
    const DbcFile file = readDbc(winchDrive());
    const DbcSignal *speed = file.messages().at(0).find(QStringLiteral("Speed"));
    QVERIFY(speed);
    QCOMPARE(speed->start, 0);
    QCOMPARE(speed->length, 16);
    QCOMPARE(speed->byteOrder, DbcSignal::Intel);
    QCOMPARE(speed->kind, DbcSignal::Signed);
    const DbcSignal *position = file.messages().at(0).find(QStringLiteral("Position"));
    QCOMPARE(position->start, 23);
    QCOMPARE(position->byteOrder, DbcSignal::Motorola);
    QCOMPARE(position->kind, DbcSignal::Unsigned);
}

void tst_DbcFile::scaleRangeAndUnitAreRead()
{
    const DbcFile file = readDbc(winchDrive());
    const DbcSignal *speed = file.messages().at(0).find(QStringLiteral("Speed"));
    QCOMPARE(speed->factor, 0.1);
    QCOMPARE(speed->minimum, -3000.0);
    QCOMPARE(speed->maximum, 3000.0);
    QCOMPARE(speed->unit, QStringLiteral("rpm"));
    QCOMPARE(file.messages().at(0).find(QStringLiteral("Position"))->offset, -100.0);
}

void tst_DbcFile::multiplexedSignalsKnowTheirPage()
{
    const DbcFile file = readDbc(winchDrive());
    const DbcMessage *temperatures = file.find(QStringLiteral("Temperatures"));
    QCOMPARE(temperatures->multiplexor, 0);
    QCOMPARE(temperatures->content.at(0).role, DbcSignal::Multiplexor);
    QCOMPARE(temperatures->content.at(2).role, DbcSignal::Multiplexed);
    QCOMPARE(temperatures->content.at(2).multiplexValue, quint64(1));
    QVERIFY(temperatures->unsupported.isEmpty());
}

void tst_DbcFile::floatTypesAreReadAfterTheMessages()
{
    const DbcFile file = readDbc(winchDrive());
    const DbcMessage *wide = file.find(QStringLiteral("Wide"));
    QCOMPARE(wide->find(QStringLiteral("Setpoint"))->kind, DbcSignal::Float32);
    QCOMPARE(wide->find(QStringLiteral("Precise"))->kind, DbcSignal::Float64);
}

void tst_DbcFile::attributesAreRead()
{
    const DbcFile file = readDbc(winchDrive());
    QCOMPARE(file.find(QStringLiteral("DriveStatus"))->cycleTime, std::chrono::nanoseconds(10ms));
    QCOMPARE(file.find(QStringLiteral("Temperatures"))->cycleTime,
             std::chrono::nanoseconds(100ms));  // the default of the file
    QCOMPARE(file.find(QStringLiteral("DriveStatus"))->find(QStringLiteral("Mode"))->initial, 3.0);
    QVERIFY(!file.find(QStringLiteral("Wide"))->hasBitRateSwitch);
}

void tst_DbcFile::messageOverridesTheDefaultFrameFormat_data()
{
    QTest::addColumn<QByteArray>("attributes");
    QTest::addColumn<bool>("isFd");
    const QByteArray fd = "BA_DEF_DEF_ \"VFrameFormat\" \"StandardCAN_FD\";\n";
    const QByteArray classic = "BA_DEF_DEF_ \"VFrameFormat\" \"StandardCAN\";\n";
    QTest::newRow("nothing is said") << QByteArray() << false;
    QTest::newRow("FD by default") << fd << true;
    QTest::newRow("FD by default, and not this one") << fd + "BA_ \"VFrameFormat\" BO_ 513 0;\n" << false;
    QTest::newRow("the same in words") << fd + "BA_ \"VFrameFormat\" BO_ 513 \"StandardCAN\";\n" << false;
    QTest::newRow("this one only") << classic + "BA_ \"VFrameFormat\" BO_ 513 14;\n" << true;
}

void tst_DbcFile::messageOverridesTheDefaultFrameFormat()
{
    QFETCH(QByteArray, attributes);
    QFETCH(bool, isFd);
    const DbcFile file = readDbc("BO_ 513 A: 8 X\nBO_ 514 Long: 16 X\n" + attributes);
    QCOMPARE(file.messages().at(0).isFd, isFd);
    QVERIFY(file.messages().at(1).isFd);  // its size says so
}

void tst_DbcFile::signalsWithoutAStartValueHaveTheDefault()
{
    const DbcFile file = readDbc("BO_ 513 A: 8 X\n SG_ Own : 0|8@1+ (1,0) [0|0] \"\" X\n"
                                 " SG_ Zero : 8|8@1+ (1,0) [0|0] \"\" X\n SG_ Other : 16|8@1+ (1,0) [0|0] \"\" X\n"
                                 "BA_DEF_DEF_ \"GenSigStartValue\" 5;\nBA_ \"GenSigStartValue\" SG_ 513 Own 7;\n"
                                 "BA_ \"GenSigStartValue\" SG_ 513 Zero 0;\n");
    const auto &content = file.messages().at(0).content;
    QCOMPARE(content.at(0).initial, 7.0);
    QCOMPARE(content.at(1).initial, 0.0);
    QCOMPARE(content.at(2).initial, 5.0);
}

void tst_DbcFile::valuesHaveNames()
{
    const DbcFile file = readDbc(winchDrive());
    const auto names = file.messages().at(0).find(QStringLiteral("Mode"))->valueNames;
    QCOMPARE(names.size(), 3);
    QCOMPARE(names.value(-1), QStringLiteral("fault"));
}

void tst_DbcFile::textMayBeLatin1()
{
    const QByteArray text = "BO_ 1 A: 1 X\n SG_ T : 0|8@1+ (1,0) [0|0] \"\xB0"
                            "C\" X\n";
    QCOMPARE(readDbc(text).messages().at(0).content.at(0).unit,
             QString::fromUtf8("\xC2\xB0"
                               "C"));
    const QByteArray utf8 = "\xEF\xBB\xBF"
                            "BO_ 1 A: 1 X\n SG_ T : 0|8@1+ (1,0) [0|0] \"\xC2\xB0"
                            "C\" X\n";
    QCOMPARE(readDbc(utf8).messages().at(0).content.at(0).unit,
             QString::fromUtf8("\xC2\xB0"
                               "C"));
}

void tst_DbcFile::windowsLineEndingsAreAccepted()
{
    QByteArray text = winchDrive();
    QCOMPARE(readDbc(text.replace("\n", "\r\n")).messages().size(), 3);
}

void tst_DbcFile::signalsWithoutMessageAreLeftOut()
{
    const DbcFile file = readDbc("BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX\n"
                                 " SG_ Lost : 0|8@1- (1,0) [0|0] \"\" Vector__XXX\n"
                                 "BO_ 5 A: 1 X\n SG_ T : 0|8@1+ (1,0) [0|0] \"\" X\n"
                                 "BA_ \"GenSigStartValue\" SG_ 3221225472 Lost 3;\n");
    QCOMPARE(file.messages().size(), 1);
    QCOMPARE(file.messages().at(0).content.size(), 1);
}

void tst_DbcFile::extendedMultiplexingMakesOnlyItsMessageUnsupported_data()
{
    QTest::addColumn<QByteArray>("lines");
    QTest::newRow("m0M") << QByteArray(
        " SG_ P M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ Q m0M : 8|8@1+ (1,0) [0|0] \"\" X\n");
    QTest::newRow("two M") << QByteArray(
        " SG_ P M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ Q M : 8|8@1+ (1,0) [0|0] \"\" X\n");
    QTest::newRow("a range") << QByteArray(
        " SG_ P M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ Q m2 : 8|8@1+ (1,0) [0|0] \"\" X\n"
        "SG_MUL_VAL_ 7 Q P 2-4;\n");
    QTest::newRow("two ranges") << QByteArray(
        " SG_ P M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ Q m2 : 8|8@1+ (1,0) [0|0] \"\" X\n"
        "SG_MUL_VAL_ 7 Q P 2-2, 4-4;\n");
    QTest::newRow("no multiplexor") << QByteArray(" SG_ Q m2 : 8|8@1+ (1,0) [0|0] \"\" X\n");
}

void tst_DbcFile::extendedMultiplexingMakesOnlyItsMessageUnsupported()
{
    QFETCH(QByteArray, lines);
    const DbcFile file = readDbc("BO_ 7 A: 8 X\n" + lines);
    QCOMPARE(file.messages().size(), 1);
    QVERIFY2(file.messages().at(0).unsupported.contains(QLatin1String("multiplexor")),
             qPrintable(file.messages().at(0).unsupported));
}

void tst_DbcFile::redundantMultiplexRangesAreAccepted()
{
    const DbcFile file = readDbc("BO_ 7 A: 8 X\n SG_ P M : 0|8@1+ (1,0) [0|0] \"\" X\n"
                                 " SG_ Q m2 : 8|8@1+ (1,0) [0|0] \"\" X\nSG_MUL_VAL_ 7 Q P 2-2;\n");
    QCOMPARE(file.messages().at(0).unsupported, QString());
}

void tst_DbcFile::oversizedMessageMakesOnlyItselfUnsupported()
{
    const DbcFile file = readDbc("BO_ 7 A: 39 X\n SG_ P : 0|8@1+ (1,0) [0|0] \"\" X\n");
    QCOMPARE(file.messages().at(0).unsupported, QStringLiteral("it has 39 bytes, which no frame has"));
}

void tst_DbcFile::signalLayoutIsReadFromItsOwnText_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("error");  // a part of it; empty: there is none
    const auto row = [](const char *text, const char *error) {
        QTest::newRow(text) << QString::fromLatin1(text) << QString::fromLatin1(error);
    };
    row("0|16@1-", "");
    row("7|16@0+ (0.1,-40)", "");
    row("7|16@0+(0.1,-40)[0|100]\"V\"", "");
    row("M 0|8@1+", "");
    row("m3 8|32@1f", "");
    row("8|64@1f (2,1)", "");
    row("", "the end of the file instead of the start bit");
    row("0|16@1- (0.1,0) rpm", "stray 'rpm'");
    row("0|16", "'@' behind the length");
    row("x 0|16@1-", "use ':', M for a multiplexor");
}

void tst_DbcFile::signalLayoutIsReadFromItsOwnText()
{
    QFETCH(QString, text);
    QFETCH(QString, error);
    DbcSignal signal;
    QString message;
    QCOMPARE(DbcFile::readSignal(text, &signal, &message), error.isEmpty());
    QVERIFY2(message.contains(error), qPrintable(message));
}

QTEST_APPLESS_MAIN(tst_DbcFile)
#include "tst_DbcFile.moc"
