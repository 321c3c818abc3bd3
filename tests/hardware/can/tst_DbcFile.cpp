// SPDX-License-Identifier: Apache-2.0
#include "hardware/can/CanFrame.h"
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

// Root selects Sub and C, and Sub selects A and B.
QByteArray nestedMessage()
{
    const auto signal = [](const char *name, const char *place) {
        return QByteArray(" SG_ ") + name + " : " + place + "@1+ (1,0) [0|0] \"\" X\n";
    };
    return "BO_ 7 A: 8 X\n" + signal("Root M", "0|8") + signal("Sub m0M", "8|8") + signal("Always", "16|8")
        + signal("A m0", "24|16") + signal("B m1", "24|16") + signal("C m1", "8|32") + signal("A2 m0", "32|8")
        + signal("Wide m1", "8|8")
        + "SG_MUL_VAL_ 7 Sub Root 0-0;\nSG_MUL_VAL_ 7 A Sub 0-0;\nSG_MUL_VAL_ 7 B Sub 1-1;\n"
          "SG_MUL_VAL_ 7 C Root 1-1;\nSG_MUL_VAL_ 7 A2 Sub 0-0;\nSG_MUL_VAL_ 7 Wide Root 1-3;\n";
}

// Names of the signals that a frame holds, but A2 and Wide.
QString signalsIn(const DbcMessage &message, const QByteArray &hex)
{
    const QByteArray data = QByteArray::fromHex(hex).leftJustified(8, '\0');
    QStringList names;
    for (const DbcSignal &signal : message.content) {
        const bool isExtra = signal.name == QLatin1String("A2") || signal.name == QLatin1String("Wide");
        if (!isExtra && message.isThere(signal, reinterpret_cast<const quint8 *>(data.constData())))
            names << signal.name;
    }
    return names.join(QLatin1Char(' '));
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
    void nestedMultiplexorsSelectTheirSignals();
    void rangesOfAMultiplexorAreRead();
    void messageMayHaveSeveralMultiplexors();
    void unclearMultiplexorsMakeOnlyTheirMessageUnsupported_data();
    void unclearMultiplexorsMakeOnlyTheirMessageUnsupported();
    void signalsOfDifferentPagesMayOverlap_data();
    void signalsOfDifferentPagesMayOverlap();
    void j1939IsReadFromTheAttributes_data();
    void j1939IsReadFromTheAttributes();
    void longMessageOfJ1939MakesOnlyItselfUnsupported();
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
    QVERIFY(temperatures->content.at(0).isMultiplexor);
    QVERIFY(!temperatures->content.at(0).isMultiplexed());
    QCOMPARE(temperatures->content.at(2).multiplexor, 0);
    QVERIFY(temperatures->content.at(2).isOnPage(1));
    QVERIFY(!temperatures->content.at(2).isOnPage(0));
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

void tst_DbcFile::nestedMultiplexorsSelectTheirSignals()
{
    const DbcFile file = readDbc(nestedMessage());
    const DbcMessage &message = file.messages().at(0);
    QCOMPARE(message.unsupported, QString());
    QCOMPARE(signalsIn(message, "0000"), QStringLiteral("Root Sub Always A"));
    QCOMPARE(signalsIn(message, "0001"), QStringLiteral("Root Sub Always B"));
    QCOMPARE(signalsIn(message, "0100"), QStringLiteral("Root Always C"));
    QCOMPARE(signalsIn(message, "0200"), QStringLiteral("Root Always"));
}

void tst_DbcFile::rangesOfAMultiplexorAreRead()
{
    const DbcFile file = readDbc("BO_ 7 A: 8 X\n SG_ P M : 0|8@1+ (1,0) [0|0] \"\" X\n"
                                 " SG_ Q m2 : 8|8@1+ (1,0) [0|0] \"\" X\n SG_ R m2 : 16|8@1+ (1,0) [0|0] \"\" X\n"
                                 "SG_MUL_VAL_ 7 Q P 2-4, 6-6,8-9;\nSG_MUL_VAL_ 7 R P 2-2;\n");
    const DbcMessage &message = file.messages().at(0);
    QCOMPARE(message.unsupported, QString());
    QString pages;
    for (quint64 page = 0; page < 12; ++page)
        pages += message.content.at(1).isOnPage(page) ? QLatin1Char('x') : QLatin1Char('-');
    QCOMPARE(pages, QStringLiteral("--xxx-x-xx--"));
    QCOMPARE(signalsIn(message, "02"), QStringLiteral("P Q R"));
}

void tst_DbcFile::messageMayHaveSeveralMultiplexors()
{
    const DbcFile file = readDbc("BO_ 7 A: 8 X\n SG_ P M : 0|8@1+ (1,0) [0|0] \"\" X\n"
                                 " SG_ Q M : 8|8@1+ (1,0) [0|0] \"\" X\n SG_ OfP m1 : 16|8@1+ (1,0) [0|0] \"\" X\n"
                                 " SG_ OfQ m1 : 24|8@1+ (1,0) [0|0] \"\" X\n"
                                 "SG_MUL_VAL_ 7 OfP P 1-1;\nSG_MUL_VAL_ 7 OfQ Q 1-1;\n");
    const DbcMessage &message = file.messages().at(0);
    QCOMPARE(message.unsupported, QString());
    QCOMPARE(signalsIn(message, "0000"), QStringLiteral("P Q"));
    QCOMPARE(signalsIn(message, "0100"), QStringLiteral("P Q OfP"));
    QCOMPARE(signalsIn(message, "0001"), QStringLiteral("P Q OfQ"));
    QCOMPARE(signalsIn(message, "0101"), QStringLiteral("P Q OfP OfQ"));
}

void tst_DbcFile::unclearMultiplexorsMakeOnlyTheirMessageUnsupported_data()
{
    QTest::addColumn<QByteArray>("lines");
    QTest::addColumn<QString>("reason");
    const auto signal = [](const char *name) { return QByteArray(" SG_ ") + name + " : 0|8@1+ (1,0) [0|0] \"\" X\n"; };
    QTest::newRow("no multiplexor") << signal("Q m2") << "it has multiplexed signals and no multiplexor (M)";
    QTest::newRow("two of them") << signal("P M") + signal("Q M") + signal("R m1")
                                 << "it has several multiplexors, and no line SG_MUL_VAL_ says to which one signal 'R'";
    QTest::newRow("a nested one and its parent") << signal("P M") + signal("Q m0M")
            + signal("R m1") << "it has several multiplexors, and no line SG_MUL_VAL_ says to which one signal 'R'";
    QTest::newRow("a circle") << signal("P m0M") + signal("Q m0M") + "SG_MUL_VAL_ 7 P Q 0-0;\nSG_MUL_VAL_ 7 Q P 0-0;\n"
                              << "signal 'P' is selected by itself";
    QTest::newRow("by itself") << signal("P m0M") + "SG_MUL_VAL_ 7 P P 0-0;\n"
                               << "signal 'P' is selected by itself";
}

void tst_DbcFile::unclearMultiplexorsMakeOnlyTheirMessageUnsupported()
{
    QFETCH(QByteArray, lines);
    QFETCH(QString, reason);
    const DbcFile file = readDbc("BO_ 7 A: 8 X\n" + lines + "BO_ 8 B: 8 X\n");
    QCOMPARE(file.messages().size(), 2);
    QVERIFY2(file.messages().at(0).unsupported.startsWith(reason), qPrintable(file.messages().at(0).unsupported));
    QCOMPARE(file.messages().at(1).unsupported, QString());
}

void tst_DbcFile::signalsOfDifferentPagesMayOverlap_data()
{
    QTest::addColumn<QByteArray>("a");
    QTest::addColumn<QByteArray>("b");
    QTest::addColumn<bool>("overlap");
    const auto row = [](const char *a, const char *b, bool overlap) {
        QTest::newRow(QByteArray(a) + ", " + b) << QByteArray(a) << QByteArray(b) << overlap;
    };
    row("Always", "C", true);
    row("A", "B", false);  // Sub is 0, or 1
    row("A", "C", false);  // Root is 0, or 1
    row("A", "A2", true);  // Sub may be 0 for both
    row("B", "A2", false);
    row("Sub", "C", false);
    row("Sub", "Always", false);  // other bits
    row("C", "Wide", true);       // ranges 1-1 and 1-3
    row("A", "Wide", false);
}

void tst_DbcFile::signalsOfDifferentPagesMayOverlap()
{
    QFETCH(QByteArray, a);
    QFETCH(QByteArray, b);
    QFETCH(bool, overlap);
    const DbcFile file = readDbc(nestedMessage());
    const DbcMessage &message = file.messages().at(0);
    const DbcSignal &one = *message.find(QString::fromLatin1(a));
    const DbcSignal &other = *message.find(QString::fromLatin1(b));
    QCOMPARE(message.overlap(one, other), overlap);
    QCOMPARE(message.overlap(other, one), overlap);
}

void tst_DbcFile::j1939IsReadFromTheAttributes_data()
{
    QTest::addColumn<QByteArray>("attributes");
    QTest::addColumn<bool>("isJ1939");
    QTest::newRow("nothing is said") << QByteArray() << false;
    QTest::newRow("the network") << QByteArray("BA_ \"ProtocolType\" \"J1939\";\n") << true;
    QTest::newRow("all messages") << QByteArray("BA_DEF_DEF_ \"VFrameFormat\" \"J1939PG\";\n") << true;
    QTest::newRow("this one") << QByteArray("BA_ \"VFrameFormat\" BO_ 2566844926 3;\n") << true;
    QTest::newRow("the network, and not this one")
        << QByteArray("BA_ \"ProtocolType\" \"J1939\";\nBA_ \"VFrameFormat\" BO_ 2566844926 1;\n") << false;
    QTest::newRow("another protocol") << QByteArray("BA_ \"ProtocolType\" \"CAN\";\n") << false;
}

void tst_DbcFile::j1939IsReadFromTheAttributes()
{
    QFETCH(QByteArray, attributes);
    QFETCH(bool, isJ1939);
    const DbcFile file = readDbc("BO_ 2566844926 Speed: 8 X\nBO_ 5 Standard: 8 X\n" + attributes);
    QCOMPARE(file.messages().at(0).isJ1939, isJ1939);
    QVERIFY(!file.messages().at(1).isJ1939);  // an id of 11 bits
    QCOMPARE(CanFrame::groupOf(file.messages().at(0).id), 0xFEF1U);
    QCOMPARE(CanFrame::groupOf(0x0C00FF03), 0U);        // a group for one node: its destination is no part of it
    QCOMPARE(CanFrame::groupOf(0x19F0FF03), 0x1F0FFU);  // data page 1
}

void tst_DbcFile::longMessageOfJ1939MakesOnlyItselfUnsupported()
{
    const DbcFile file = readDbc("BO_ 2566844926 Long: 100 X\n SG_ P : 792|8@1+ (1,0) [0|0] \"\" X\n"
                                 "BO_ 2566844670 Short: 8 X\nBA_ \"ProtocolType\" \"J1939\";\n");
    QVERIFY2(file.messages().at(0).unsupported.startsWith(
                 QLatin1String("it has 100 bytes, which J1939 sends in several frames (transport protocol, TP)")),
             qPrintable(file.messages().at(0).unsupported));
    QVERIFY(!file.messages().at(0).isFd);
    QCOMPARE(file.messages().at(1).unsupported, QString());
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
    row("m3M 0|8@1+", "");
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
