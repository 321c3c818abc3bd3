// SPDX-License-Identifier: Apache-2.0
// What CANopen says on paper: transfers of objects, files of devices, keys, states of a drive.
#include "CanOpenPeer.h"
#include "DriverBench.h"
#include "hardware/canopen/CanOpenEmergency.h"
#include "hardware/canopen/CanOpenIds.h"
#include "hardware/canopen/Cia402Axis.h"
#include "hardware/canopen/EdsFile.h"
#include "hardware/canopen/Pdo.h"
#include "hardware/canopen/SdoTransfer.h"

#include <QtTest/QtTest>

#include <limits>

using namespace qplc;

namespace {

/// Each abort code of CiA 301 that a server may answer.
const quint32 abortCodes[] = {
    0x05030000, 0x05040000, 0x05040001, 0x05040002, 0x05040003, 0x05040004, 0x05040005, 0x06010000,
    0x06010001, 0x06010002, 0x06020000, 0x06040041, 0x06040042, 0x06040043, 0x06040047, 0x06060000,
    0x06070010, 0x06070012, 0x06070013, 0x06090011, 0x06090030, 0x06090031, 0x06090032, 0x06090036,
    0x060A0023, 0x08000000, 0x08000020, 0x08000021, 0x08000022, 0x08000023, 0x08000024,
};

/// A transfer from begin to end against the server of the other side.
struct Wire
{
    explicit Wire(peer::Dictionary *objects)
        : server(objects, {})
    {
    }
    SdoTransfer run(SdoTransfer transfer)
    {
        for (frames = 0; frames < 20000 && transfer.hasRequest(); ++frames) {
            transfer.sent();
            if (const auto answer = server.answer(transfer.request()))
                transfer.take(*answer);
        }
        return transfer;
    }
    peer::SdoServer server;
    int frames = 0;
};

peer::Object objectOf(const QByteArray &value)
{
    peer::Object object;
    object.value = value;
    return object;
}

AxisFeedback feedbackOf(quint16 statusword, AxisMode mode = AxisMode::SyncVelocity)
{
    return {true, statusword, mode, 70.0};
}

AxisCommand enabled(double velocity = 5.0)
{
    AxisCommand command;
    command.isSafe = false;
    command.enable = true;
    command.velocity = velocity;
    return command;
}

constexpr quint16 wordDisabled = 0x0240;
constexpr quint16 wordReady = 0x0231;
constexpr quint16 wordSwitchedOn = 0x0233;
constexpr quint16 wordEnabled = 0x0237;
constexpr quint16 wordQuickStop = 0x0217;
constexpr quint16 wordFault = 0x0218;

const QByteArray drive = R"([DeviceInfo]
VendorNumber=0x0000029C
ProductNumber=7
[1000]
ParameterName=Device type
ObjectType=0x7
DataType=0x0007
AccessType=ro
DefaultValue=0x00020192
[1018]
ParameterName=Identity
ObjectType=0x9
SubNumber=2
[1018sub0]
ParameterName=Number of entries
DataType=0x0005
AccessType=const
DefaultValue=1
[1018sub1]
ParameterName=Vendor-ID
DataType=0x0007
AccessType=ro
[1800]
ParameterName=TPDO 1
SubNumber=3
[1800sub1]
ParameterName=COB-ID
DataType=0x0007
AccessType=rw
DefaultValue=$NODEID+0x180
[1800sub2]
ParameterName=Transmission
DataType=0x0005
AccessType=rw
DefaultValue=0xFF
[1A00]
ParameterName=TPDO 1 mapping
SubNumber=3
[1A00sub0]
ParameterName=Count
DataType=0x0005
AccessType=rw
DefaultValue=2
[1A00sub1]
ParameterName=First
DataType=0x0007
AccessType=rw
DefaultValue=0x60410010
[1A00sub2]
ParameterName=Second
DataType=0x0007
AccessType=rw
DefaultValue=0x20010020
ParameterValue=0x20010320
[2001]
ParameterName=Temperatures
ObjectType=0x8
CompactSubObj=3
DataType=0x0004
AccessType=ro
[2002]
ParameterName=Name of the drive
DataType=0x0009
AccessType=rw
DefaultValue=some text
[6041]
ParameterName=Statusword
DataType=0x0006
AccessType=ro
PDOMapping=1
)";

QString errorsOf(const QByteArray &text)
{
    QVector<QPlcParseError> errors;
    EdsFile::fromText(text, "drive.eds", 5, &errors);
    return QPlcParseError::toString(errors);
}

}  // namespace

class tst_CanOpenProtocol : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    // Transfers
    void valuesOfAnySizeArriveUnchanged_data();
    void valuesOfAnySizeArriveUnchanged();
    void fourBytesNeedOneFrame();
    void everyAbortCodeIsToldInWords_data();
    void everyAbortCodeIsToldInWords();
    void aServerSaysWhatItDoesNotHave();
    void answersOfOthersChangeNothing();
    void aRepeatedSegmentAborts();
    void aDeviceCannotSendMoreThanItPromised();
    void aDeviceCannotSendWithoutEnd();
    // Files
    void aFileNamesObjectsTypesAndValues();
    void configuredValuesAreStrongerThanDefaults();
    void latin1IsRead();
    void errorsOfFilesHaveAPlaceAndARemedy_data();
    void errorsOfFilesHaveAPlaceAndARemedy();
    void aFileThatIsMissingIsSaid();
    // Keys
    void wrongKeysAreToldAllAtOnce_data();
    void wrongKeysAreToldAllAtOnce();
    void aFileGivesThePdosThatKeysDoNotName();
    // PDOs
    void bitsOfAPdoKeepTheirNeighbours();
    // Emergencies
    void emergenciesAreToldByTheirClass();
    void anEmergencyHasAllThatItsFrameHas();
    // Axis
    void statuswordsAreStates_data();
    void statuswordsAreStates();
    void theDriveIsLedToOperationEnabled();
    void targetsWaitForTheStateAndTheMode();
    void theSafeStateIsTheQuickStop_data();
    void theSafeStateIsTheQuickStop();
    void withoutEnableTheDriveIsDisabledByItsRamp();
    void aFaultIsResetOnRequestOnly();
    void afterAFaultEnableHasToBeFalseOnce();
    void aDriveThatStoppedByItselfDoesNotStartAgainByItself();
    void targetsAreCutToTheirLimits();
    void aPositionIsTheActualOneUntilItFollows();
    void homingStartsWithItsRequestAndTellsItsEnd();
};

// ---- transfers ----

void tst_CanOpenProtocol::valuesOfAnySizeArriveUnchanged_data()
{
    QTest::addColumn<int>("size");
    for (const int size : {0, 1, 2, 3, 4, 5, 6, 7, 8, 13, 14, 15, 100, 5000})
        QTest::addRow("%d bytes", size) << size;
}

void tst_CanOpenProtocol::valuesOfAnySizeArriveUnchanged()
{
    QFETCH(int, size);
    QByteArray value;
    for (int i = 0; i < size; ++i)
        value.append(char(i * 7 + 1));
    peer::Dictionary objects;
    objects[peer::keyOf(0x2000, 1)] = objectOf({});
    objects[peer::keyOf(0x2000, 1)].hasAnySize = true;
    Wire wire(&objects);
    const SdoTransfer written = wire.run(SdoTransfer::write({0x2000, 1}, value));
    QCOMPARE(written.state(), SdoTransfer::Done);
    QCOMPARE(objects[peer::keyOf(0x2000, 1)].value, value);
    const SdoTransfer read = wire.run(SdoTransfer::read({0x2000, 1}));
    QCOMPARE(read.state(), SdoTransfer::Done);
    QCOMPARE(read.value(), value);
}

void tst_CanOpenProtocol::fourBytesNeedOneFrame()
{
    peer::Dictionary objects;
    objects[peer::keyOf(0x6085, 0)] = objectOf(peer::bytesOf(3000, 4));
    Wire wire(&objects);
    QCOMPARE(wire.run(SdoTransfer::read({0x6085, 0})).value(), peer::bytesOf(3000, 4));
    QCOMPARE(wire.frames, 1);
    QCOMPARE(wire.run(SdoTransfer::write({0x6085, 0}, peer::bytesOf(7, 4))).state(), SdoTransfer::Done);
    QCOMPARE(wire.frames, 1);
}

void tst_CanOpenProtocol::everyAbortCodeIsToldInWords_data()
{
    QTest::addColumn<quint32>("code");
    for (const quint32 code : abortCodes)
        QTest::addRow("%08x", code) << code;
}

void tst_CanOpenProtocol::everyAbortCodeIsToldInWords()
{
    QFETCH(quint32, code);
    peer::Dictionary objects;
    peer::Object &object = objects[peer::keyOf(0x2000, 0)];
    object.value = QByteArray(2, '\0');
    object.abortOfRead = code;
    object.abortOfWrite = code;
    Wire wire(&objects);
    for (const SdoTransfer &begin :
         {SdoTransfer::read({0x2000, 0}), SdoTransfer::write({0x2000, 0}, QByteArray(2, 'x'))}) {
        const SdoTransfer transfer = wire.run(begin);
        QCOMPARE(transfer.state(), SdoTransfer::Aborted);
        QCOMPARE(transfer.abortCode(), code);
        QVERIFY(SdoTransfer::abortText(code) != SdoTransfer::abortText(0));
    }
    QStringList texts;
    for (const quint32 other : abortCodes)
        texts << SdoTransfer::abortText(other);
    QCOMPARE(texts.count(SdoTransfer::abortText(code)), 1);
}

void tst_CanOpenProtocol::aServerSaysWhatItDoesNotHave()
{
    peer::Dictionary objects;
    objects[peer::keyOf(0x2000, 1)] = objectOf(QByteArray(2, '\0'));
    objects[peer::keyOf(0x2000, 1)].highest = 100;
    objects[peer::keyOf(0x2000, 1)].lowest = 10;
    objects[peer::keyOf(0x2000, 2)] = objectOf(QByteArray(2, '\0'));
    objects[peer::keyOf(0x2000, 2)].isWritable = false;
    objects[peer::keyOf(0x2000, 3)] = objectOf(QByteArray(2, '\0'));
    objects[peer::keyOf(0x2000, 3)].isReadable = false;
    Wire wire(&objects);
    const auto codeOf = [&](const SdoTransfer &transfer) { return wire.run(transfer).abortCode(); };
    QCOMPARE(codeOf(SdoTransfer::read({0x3000, 0})), 0x06020000U);
    QCOMPARE(codeOf(SdoTransfer::read({0x2000, 9})), 0x06090011U);
    QCOMPARE(codeOf(SdoTransfer::read({0x2000, 3})), 0x06010001U);
    QCOMPARE(codeOf(SdoTransfer::write({0x2000, 2}, QByteArray(2, '\0'))), 0x06010002U);
    QCOMPARE(codeOf(SdoTransfer::write({0x2000, 1}, QByteArray(3, '\0'))), 0x06070012U);
    QCOMPARE(codeOf(SdoTransfer::write({0x2000, 1}, QByteArray(1, '\0'))), 0x06070013U);
    QCOMPARE(codeOf(SdoTransfer::write({0x2000, 1}, peer::bytesOf(101, 2))), 0x06090031U);
    QCOMPARE(codeOf(SdoTransfer::write({0x2000, 1}, peer::bytesOf(9, 2))), 0x06090032U);
    QCOMPARE(codeOf(SdoTransfer::write({0x2000, 1}, peer::bytesOf(10, 2))), 0U);
}

void tst_CanOpenProtocol::answersOfOthersChangeNothing()
{
    SdoTransfer transfer = SdoTransfer::read({0x6041, 0});
    QVERIFY(!transfer.take({0x43, 0x40, 0x60, 0, 1, 0, 0, 0}));  // another object
    QVERIFY(!transfer.take({0x80, 0x40, 0x60, 0, 0, 0, 2, 6}));  // its abort
    QCOMPARE(transfer.state(), SdoTransfer::Running);
    QVERIFY(transfer.take({0x4B, 0x41, 0x60, 0, 0x37, 0x02, 0, 0}));
    QCOMPARE(transfer.value(), peer::bytesOf(0x0237, 2));
    QVERIFY(!transfer.take({0x4B, 0x41, 0x60, 0, 0x37, 0x02, 0, 0}));  // it is over
}

void tst_CanOpenProtocol::aRepeatedSegmentAborts()
{
    SdoTransfer transfer = SdoTransfer::read({0x1008, 0});
    QVERIFY(transfer.take({0x41, 0x08, 0x10, 0, 20, 0, 0, 0}));
    QVERIFY(transfer.take({0x00, 'a', 'b', 'c', 'd', 'e', 'f', 'g'}));
    QVERIFY(transfer.take({0x00, 'a', 'b', 'c', 'd', 'e', 'f', 'g'}));
    QCOMPARE(transfer.state(), SdoTransfer::Aborted);
    QCOMPARE(transfer.abortCode(), 0x05030000U);
    QVERIFY(transfer.hasRequest());
    const SdoTransfer::Data abort{0x80, 0x08, 0x10, 0x00, 0x00, 0x00, 0x03, 0x05};
    QVERIFY(transfer.request() == abort);
}

void tst_CanOpenProtocol::aDeviceCannotSendMoreThanItPromised()
{
    SdoTransfer transfer = SdoTransfer::read({0x1008, 0});
    QVERIFY(transfer.take({0x41, 0x08, 0x10, 0, 8, 0, 0, 0}));
    QVERIFY(transfer.take({0x00, 1, 2, 3, 4, 5, 6, 7}));
    QVERIFY(transfer.take({0x11, 1, 2, 3, 4, 5, 6, 7}));
    QCOMPARE(transfer.abortCode(), 0x06070010U);
    SdoTransfer large = SdoTransfer::read({0x1008, 0});
    QVERIFY(large.take({0x41, 0x08, 0x10, 0, 0, 0, 0, 0x40}));
    QCOMPARE(large.abortCode(), 0x05040005U);
}

void tst_CanOpenProtocol::aDeviceCannotSendWithoutEnd()
{
    SdoTransfer empty = SdoTransfer::read({0x1008, 0});
    QVERIFY(empty.take({0x40, 0x08, 0x10, 0, 0, 0, 0, 0}));
    QVERIFY(empty.take({0x0E, 0, 0, 0, 0, 0, 0, 0}));
    QCOMPARE(empty.state(), SdoTransfer::Aborted);
    SdoTransfer endless = SdoTransfer::read({0x1008, 0});
    QVERIFY(endless.take({0x40, 0x08, 0x10, 0, 0, 0, 0, 0}));
    quint8 toggle = 0;
    int count = 0;
    for (; endless.state() == SdoTransfer::Running && count < 20000; ++count, toggle ^= 0x10)
        endless.take({toggle, 1, 2, 3, 4, 5, 6, 7});
    QCOMPARE(endless.abortCode(), 0x05040005U);
    QVERIFY(count <= SdoTransfer::MaximumSize / 7 + 1);
}

// ---- files ----

void tst_CanOpenProtocol::aFileNamesObjectsTypesAndValues()
{
    QVector<QPlcParseError> errors;
    const EdsFile file = EdsFile::fromText(drive, "drive.eds", 5, &errors);
    QCOMPARE(QPlcParseError::toString(errors), QString());
    QCOMPARE(file.vendor(), 0x29CU);
    QCOMPARE(file.product(), 7U);
    const CanOpenDictionary &objects = file.dictionary();
    QVERIFY(objects.find("Statusword"));
    QCOMPARE(objects.find("Statusword")->address.toText(), QString("6041:00"));
    QCOMPARE(objects.find("6041:00")->number->bits, 16);
    QVERIFY(!objects.find("6041:00")->isWritable);
    QCOMPARE(objects.find("Identity.VendorID")->address.toText(), QString("1018:01"));
    QCOMPARE(objects.find("1800:01")->value.value_or(0), quint64(0x185));
    QCOMPARE(objects.find("Temperatures.3")->address.toText(), QString("2001:03"));
    QCOMPARE(objects.find("2001:00")->value.value_or(0), quint64(3));
    QVERIFY(!objects.find("NameOfTheDrive")->number);
    QVERIFY(!objects.find("6042:00"));
}

void tst_CanOpenProtocol::configuredValuesAreStrongerThanDefaults()
{
    QVector<QPlcParseError> errors;
    const EdsFile file = EdsFile::fromText(drive, "drive.dcf", 5, &errors);
    QCOMPARE(file.dictionary().find("1A00:02")->value.value_or(0), quint64(0x20010320));
}

void tst_CanOpenProtocol::latin1IsRead()
{
    QByteArray text = drive;
    text.replace("Temperatures", "Temp\xE9ratures");
    QCOMPARE(errorsOf(text), QString());
}

void tst_CanOpenProtocol::errorsOfFilesHaveAPlaceAndARemedy_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("error");
    QTest::newRow("no object") << QByteArray("[FileInfo]\nFileName=a.eds\n") << "this is no EDS file";
    QTest::newRow("no type") << QByteArray("[1018sub1]\nParameterName=Vendor\n")
                             << "drive.eds:1:2: object 1018:01 has no";
    QTest::newRow("no number") << QByteArray("[1000]\nDataType=0x0007\nDefaultValue=twelve\n")
                               << "drive.eds:3:14: 'twelve'";
    QTest::newRow("too large") << QByteArray("[1000]\nDataType=0x0005\nDefaultValue=256\n")
                               << "does not fit into the 8 bits";
    QTest::newRow("too small") << QByteArray("[1000]\nDataType=0x0002\nDefaultValue=-129\n")
                               << "does not fit into the 8";
    QTest::newRow("no data type") << QByteArray("[1000]\nDataType=0x10000\n") << "is no data type";
    QTest::newRow("twice") << QByteArray("[1000]\nDataType=7\n[1000]\nDataType=7\n")
                           << "drive.eds:3:2: section '1000' is";
    QTest::newRow("subindices") << QByteArray("[2001]\nDataType=7\nCompactSubObj=300\n") << "no number of subindices";
    QTest::newRow("no entry") << QByteArray("[1000]\nDataType=7\nnothing\n") << "drive.eds:3:1: 'nothing' is neither";
}

void tst_CanOpenProtocol::errorsOfFilesHaveAPlaceAndARemedy()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, error);
    const QString told = errorsOf(text);
    QVERIFY2(told.contains(error), qPrintable(told));
    QVERIFY2(told.contains("; "), qPrintable(told));
}

void tst_CanOpenProtocol::aFileThatIsMissingIsSaid()
{
    QVector<QPlcParseError> errors;
    EdsFile::fromFile("/nowhere/drive.eds", 5, &errors);
    QCOMPARE(errors.size(), 1);
    QVERIFY(errors.first().toString().contains("/nowhere/drive.eds"));
}

// ---- keys ----

void tst_CanOpenProtocol::wrongKeysAreToldAllAtOnce_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<QStringList>("errors");
    const auto add = [](const char *row, const QByteArray &keys, const QStringList &errors) {
        QTest::newRow(row) << keys << errors;
    };
    add("no node", "", {"names no node; add for example 'node = 5'"});
    add("node and master", "node = 128\nmaster = 200\ntpdo1 = 6041:00\n",
        {"node = '128' is not a whole number from 1 to 127", "master = '200' is not a whole"});
    add("the id of the master", "node = 5\nmaster = 5\ntpdo1 = 6041:00\n", {"the master cannot have the id 5"});
    add("no PDO", "node = 5\n", {"has no PDO, so no value; add for example"});
    add("no SYNC", "node = 5\ntpdo1 = every sync, 6041:00\n", {"TPDO 1 waits for SYNC; add 'sync = every cycle'"});
    add("PDOs", "node = 5\ntpdo1 = 6041:00, 2001:01\nrpdo1 = 6040:00, 60FF:00, 607A:00\ntpdo99 = 6041:00\n",
        {"the type of object '2001:01' is not known", "RPDO 1 has 80 bits, and a frame has 64", "'tpdo99' is no PDO"});
    add("ids", "node = 5\ntpdo5 = 6041:00\ntpdo1 = id 0x600, 6041:00\ntpdo2 = id 0x385, 6064:00\ntpdo3 = 606C:00\n",
        {"TPDO 5 has no id by default", "'id 0x600' is no id of a PDO", "has the id 0x385 of TPDO 2"});
    add("words",
        "node = 5\ntpdo1 = Statuswrd\ntpdo2 = 6064:00 i33\ntpdo3 = every 0 syncs, 6064:00\ntpdo4 = every 2 min\n",
        {"did you mean 'Statusword'", "'i33' is no type", "write every 1 ... 240 syncs", "every 1 ms ... every 65 s"});
    add("values", "node = 5\ntpdo1 = 6041:00\nset.6085:00 = -1\nset.2000:00 = 5\nset.Nothing = 1\nset.6060:00 = 200\n",
        {"'-1' is not a value of object 6085:00, which has 32 bits without a sign", "the type of object 2000:00",
         "there is no object 'Nothing'", "'200' is not a value of object 6060:00"});
    add("a drive without its words", "node = 5\nprofile = 402\ntpdo1 = 606C:00\nrpdo1 = 60FF:00\n",
        {"no RPDO has the controlword", "no TPDO has the statusword"});
    add("limits", "node = 5\nprofile = 402\nlimit.position-min = 5\nlimit.position-max = 4\nlimit.torque = -1\n",
        {"limit.position-min = 5 is above", "limit.torque = '-1' is not a number"});
    add("mode", "node = 5\nprofile = 402\nmode = fast\n", {"mode = 'fast' is not one of"});
    add("what nobody reads", "node = 5\ntpdo1 = 6041:00\nheartbeet = 1 s\n", {"did you mean 'heartbeat'"});
    add("a file", "node = 5\neds = nowhere.eds\ntpdo1 = 6041:00\n", {"nowhere.eds"});
    add("the bus", "node = 5\ntpdo1 = 6041:00\ndevice = fake:\n", {"is there twice"});
}

void tst_CanOpenProtocol::wrongKeysAreToldAllAtOnce()
{
    QFETCH(QByteArray, keys);
    QFETCH(QStringList, errors);
    DriverBench bench("canopen", "device = fake:bench\n" + keys);
    for (const QString &error : errors)
        QVERIFY2(bench.errors().contains(error), qPrintable(bench.errors()));
    QCOMPARE(bench.errors().count('\n') + 1, errors.size());
}

void tst_CanOpenProtocol::aFileGivesThePdosThatKeysDoNotName()
{
    QTemporaryDir folder;
    QFile file(folder.filePath("drive.eds"));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(drive) == drive.size());
    file.close();
    DriverBench bench("canopen", "device = fake:bench\nnode = 5\neds = drive.eds\n", folder.filePath("bench.ini"));
    QCOMPARE(bench.errors(), QString());
    QCOMPARE(bench.wireRead("Statusword"), QString());
    QCOMPARE(bench.wireRead("2001:03"), QString());
    QVERIFY(bench.wireRead("6064:00").contains("no channel '6064:00' to read"));
}

// ---- PDOs ----

void tst_CanOpenProtocol::bitsOfAPdoKeepTheirNeighbours()
{
    for (int first = 0; first < 64; ++first) {
        for (int count = 1; first + count <= 64; ++count) {
            std::array<quint8, 8> data;
            data.fill(0xA5);
            const quint64 before = Pdo::bitsOf(data.data(), 0, 64);
            const quint64 value = 0x123456789ABCDEFULL & RawNumber::lowBits(count);
            Pdo::setBits(data.data(), first, count, value);
            QCOMPARE(Pdo::bitsOf(data.data(), first, count), value);
            const quint64 others = ~(RawNumber::lowBits(count) << first);
            QCOMPARE(Pdo::bitsOf(data.data(), 0, 64) & others, before & others);
        }
    }
}

// ---- emergencies ----

void tst_CanOpenProtocol::emergenciesAreToldByTheirClass()
{
    QCOMPARE(emergencyText(0x8130), QString("the heartbeat of the master was missing"));
    QCOMPARE(emergencyText(0x2310), QString("continuous over-current, at the output side"));
    QCOMPARE(emergencyText(0x2311), QString("current, at the output side"));
    QCOMPARE(emergencyText(0x2910), QString("current"));
    QCOMPARE(emergencyText(0x7121), QString("motor blocked"));
    QCOMPARE(emergencyText(0xF0AA), QString("additional functions"));
    QCOMPARE(emergencyText(0xFF01), QString("an error of the manufacturer"));
    QCOMPARE(emergencyText(0xA000), QString("an error of the manufacturer"));
    for (unsigned code = 0; code <= 0xFFFF; ++code)
        QVERIFY(!emergencyText(quint16(code)).isEmpty());
}

void tst_CanOpenProtocol::anEmergencyHasAllThatItsFrameHas()
{
    qplc::CanFrame frame;
    frame.size = 8;
    frame.data = {0x10, 0x23, 0x13, 0xDE, 0xAD, 0xBE, 0xEF, 0x01};
    const CanOpenEmergency emergency = CanOpenEmergency::fromFrame(frame);
    QCOMPARE(emergency.text(),
             QString("emergency 2310 (continuous over-current, at the output side), error register 13 (generic, "
                     "current, communication), bytes of the manufacturer DE AD BE EF 01"));
    QCOMPARE(emergency.toBits(), Q_UINT64_C(0x01EFBEADDE132310));
    QCOMPARE(emergency.manufacturerBits(), Q_UINT64_C(0x01EFBEADDE));
    QCOMPARE(CanOpenEmergency::fromBits(emergency.toBits()).text(), emergency.text());
    QVERIFY(emergency.isError());
    QVERIFY(!CanOpenEmergency::fromBits(0x130000).isError());
    QCOMPARE(qplc::errorRegisterText(0), QString("none"));
}

// ---- axis ----

void tst_CanOpenProtocol::statuswordsAreStates_data()
{
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("mask");  // of the bits that count
    QTest::addColumn<int>("state");
    const auto add = [](const char *row, int bits, int mask, AxisState state) {
        QTest::newRow(row) << bits << mask << int(state);
    };
    add("not ready", 0x00, 0x4F, AxisState::NotReady);
    add("switch on disabled", 0x40, 0x4F, AxisState::SwitchOnDisabled);
    add("ready", 0x21, 0x6F, AxisState::ReadyToSwitchOn);
    add("switched on", 0x23, 0x6F, AxisState::SwitchedOn);
    add("enabled", 0x27, 0x6F, AxisState::OperationEnabled);
    add("quick stop", 0x07, 0x6F, AxisState::QuickStopActive);
    add("fault reaction", 0x0F, 0x4F, AxisState::FaultReaction);
    add("fault", 0x08, 0x4F, AxisState::Fault);
}

void tst_CanOpenProtocol::statuswordsAreStates()
{
    QFETCH(int, bits);
    QFETCH(int, mask);
    QFETCH(int, state);
    int count = 0;
    for (int word = 0; word <= 0xFFFF; ++word) {
        const bool isState = int(Cia402Axis::stateOf(quint16(word))) == state;
        QCOMPARE(isState, (word & mask) == bits);
        count += isState ? 1 : 0;
    }
    QVERIFY(count > 0);
}

void tst_CanOpenProtocol::theDriveIsLedToOperationEnabled()
{
    Cia402Axis axis;
    QCOMPARE(axis.step(enabled(), feedbackOf(wordDisabled)).controlword, quint16(0x06));
    QCOMPARE(axis.step(enabled(), feedbackOf(wordReady)).controlword, quint16(0x07));
    QCOMPARE(axis.step(enabled(), feedbackOf(wordSwitchedOn)).controlword, quint16(0x0F));
    const AxisOutputs outputs = axis.step(enabled(5.0), feedbackOf(wordEnabled));
    QCOMPARE(outputs.controlword, quint16(0x0F));
    QCOMPARE(outputs.velocity, 5.0);
    QCOMPARE(outputs.mode, AxisMode::SyncVelocity);
}

void tst_CanOpenProtocol::targetsWaitForTheStateAndTheMode()
{
    Cia402Axis axis;
    for (const quint16 word : {wordDisabled, wordReady, wordSwitchedOn, wordQuickStop, wordFault})
        QCOMPARE(axis.step(enabled(5.0), feedbackOf(word)).velocity, 0.0);
    axis.reset();
    QCOMPARE(axis.step(enabled(5.0), feedbackOf(wordEnabled, AxisMode::None)).velocity, 0.0);
    QCOMPARE(axis.step(enabled(5.0), feedbackOf(wordEnabled)).velocity, 5.0);
}

void tst_CanOpenProtocol::theSafeStateIsTheQuickStop_data()
{
    QTest::addColumn<int>("statusword");
    for (const quint16 word : {wordDisabled, wordReady, wordSwitchedOn, wordEnabled, wordQuickStop})
        QTest::addRow("%04x", word) << int(word);
}

void tst_CanOpenProtocol::theSafeStateIsTheQuickStop()
{
    QFETCH(int, statusword);
    Cia402Axis axis;
    AxisCommand safe = enabled();
    safe.isSafe = true;
    AxisCommand requested = enabled();
    requested.quickStop = true;
    AxisFeedback unknown = feedbackOf(quint16(statusword));
    unknown.isKnown = false;
    for (const AxisOutputs &outputs :
         {axis.step(safe, feedbackOf(quint16(statusword))), axis.step(requested, feedbackOf(quint16(statusword))),
          axis.step(enabled(), unknown)}) {
        QCOMPARE(outputs.controlword, quint16(0x02));
        QCOMPARE(outputs.velocity, 0.0);
        QCOMPARE(outputs.torque, 0.0);
    }
}

void tst_CanOpenProtocol::withoutEnableTheDriveIsDisabledByItsRamp()
{
    Cia402Axis axis;
    AxisCommand command = enabled();
    axis.step(command, feedbackOf(wordEnabled));
    command.enable = false;
    QCOMPARE(axis.step(command, feedbackOf(wordEnabled)).controlword, quint16(0x07));
    QCOMPARE(axis.step(command, feedbackOf(wordSwitchedOn)).controlword, quint16(0x06));
    QCOMPARE(axis.step(command, feedbackOf(wordReady)).controlword, quint16(0x06));
}

void tst_CanOpenProtocol::aFaultIsResetOnRequestOnly()
{
    Cia402Axis axis;
    AxisCommand command = enabled();
    for (int i = 0; i < 10; ++i)
        QCOMPARE(axis.step(command, feedbackOf(wordFault)).controlword & 0x80, 0);
    command.faultReset = true;
    QCOMPARE(axis.step(command, feedbackOf(wordFault)).controlword & 0x80, 0x80);
    command.enable = false;
    QCOMPARE(axis.step(command, feedbackOf(wordDisabled)).controlword & 0x80, 0);
    // The next fault needs a request of its own.
    QCOMPARE(axis.step(command, feedbackOf(wordFault)).controlword & 0x80, 0);
    command.faultReset = false;
    QCOMPARE(axis.step(command, feedbackOf(wordFault)).controlword & 0x80, 0);
    command.faultReset = true;
    QCOMPARE(axis.step(command, feedbackOf(wordFault)).controlword & 0x80, 0x80);
}

void tst_CanOpenProtocol::afterAFaultEnableHasToBeFalseOnce()
{
    Cia402Axis axis;
    AxisCommand command = enabled();
    axis.step(command, feedbackOf(wordEnabled));
    axis.step(command, feedbackOf(wordFault));
    for (int i = 0; i < 10; ++i)
        QCOMPARE(axis.step(command, feedbackOf(wordReady)).controlword, quint16(0x06));
    QVERIFY(axis.isBlocked());
    command.enable = false;
    axis.step(command, feedbackOf(wordReady));
    command.enable = true;
    QCOMPARE(axis.step(command, feedbackOf(wordReady)).controlword, quint16(0x07));
    QVERIFY(!axis.isBlocked());
}

void tst_CanOpenProtocol::aDriveThatStoppedByItselfDoesNotStartAgainByItself()
{
    Cia402Axis axis;
    axis.step(enabled(), feedbackOf(wordEnabled));
    for (int i = 0; i < 10; ++i)
        QCOMPARE(axis.step(enabled(), feedbackOf(wordDisabled)).controlword, quint16(0x06));
    QCOMPARE(axis.step(enabled(), feedbackOf(wordReady)).controlword, quint16(0x06));
    // The safe state of the plant counts as no enable.
    AxisCommand safe = enabled();
    safe.isSafe = true;
    axis.step(safe, feedbackOf(wordReady));
    QCOMPARE(axis.step(enabled(), feedbackOf(wordReady)).controlword, quint16(0x07));
}

void tst_CanOpenProtocol::targetsAreCutToTheirLimits()
{
    AxisLimits limits;
    limits.velocity = 100.0;
    limits.torque = 50.0;
    Cia402Axis axis(limits);
    AxisCommand command = enabled(-1e9);
    command.torque = 1e9;
    AxisOutputs outputs = axis.step(command, feedbackOf(wordEnabled));
    QCOMPARE(outputs.velocity, -100.0);
    QCOMPARE(outputs.torque, 50.0);
    QVERIFY(axis.isLimited());
    command = enabled(std::numeric_limits<double>::quiet_NaN());
    outputs = axis.step(command, feedbackOf(wordEnabled));
    QCOMPARE(outputs.velocity, 0.0);
    QVERIFY(axis.isLimited());
    axis.step(enabled(100.0), feedbackOf(wordEnabled));
    QVERIFY(!axis.isLimited());
}

void tst_CanOpenProtocol::aPositionIsTheActualOneUntilItFollows()
{
    AxisLimits limits;
    limits.highestPosition = 90.0;
    Cia402Axis axis(limits);
    AxisCommand command = enabled();
    command.mode = AxisMode::SyncPosition;
    command.position = 80.0;
    QCOMPARE(axis.step(command, feedbackOf(wordSwitchedOn, AxisMode::SyncPosition)).position, 70.0);
    QCOMPARE(axis.step(command, feedbackOf(wordEnabled, AxisMode::SyncPosition)).position, 80.0);
    command.position = 95.0;
    QCOMPARE(axis.step(command, feedbackOf(wordEnabled, AxisMode::SyncPosition)).position, 90.0);
    command.position = std::numeric_limits<double>::quiet_NaN();
    QCOMPARE(axis.step(command, feedbackOf(wordEnabled, AxisMode::SyncPosition)).position, 70.0);
}

void tst_CanOpenProtocol::homingStartsWithItsRequestAndTellsItsEnd()
{
    Cia402Axis axis;
    AxisCommand command = enabled();
    command.mode = AxisMode::Homing;
    QCOMPARE(axis.step(command, feedbackOf(wordEnabled | 0x1000, AxisMode::Homing)).controlword, quint16(0x0F));
    QVERIFY(!axis.isHomed());  // what is homed before nobody asked for
    command.home = true;
    QCOMPARE(axis.step(command, feedbackOf(wordEnabled | 0x1000, AxisMode::Homing)).controlword, quint16(0x1F));
    QVERIFY(!axis.isHomed());
    axis.step(command, feedbackOf(wordEnabled, AxisMode::Homing));
    QVERIFY(!axis.isHomed());
    axis.step(command, feedbackOf(wordEnabled | 0x3000, AxisMode::Homing));
    QVERIFY(!axis.isHomed());  // the drive tells an error of homing
    axis.step(command, feedbackOf(wordEnabled | 0x1400, AxisMode::Homing));
    QVERIFY(axis.isHomed());
    command.home = false;
    QCOMPARE(axis.step(command, feedbackOf(wordEnabled | 0x1400, AxisMode::Homing)).controlword, quint16(0x0F));
    QVERIFY(axis.isHomed());
}

QTEST_GUILESS_MAIN(tst_CanOpenProtocol)
#include "tst_CanOpenProtocol.moc"
