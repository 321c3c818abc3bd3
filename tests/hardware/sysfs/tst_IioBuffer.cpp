// SPDX-License-Identifier: Apache-2.0
// Buffers of IIO: bytes of scans, and the driver with a device that is played.
#include "../../common/ThreadCosts.h"
#include "../DriverBench.h"
#include "../FakeDevices.h"
#include "SysfsTree.h"
#include "hardware/sysfs/IioScan.h"

#include <QtTest/QtTest>

#include <fcntl.h>
#include <random>
#include <sys/stat.h>
#include <unistd.h>

using namespace qplc;
using namespace std::chrono_literals;

namespace {

/// Puts the lowest \a bits of \a number into \a storage bytes, bit by bit.
QByteArray encoded(quint64 number, int bits, int storage, int shift, bool isBigEndian, quint64 around)
{
    QByteArray bytes(storage, '\0');
    for (int bit = 0; bit < 8 * storage; ++bit) {
        const bool isOfNumber = bit >= shift && bit < shift + bits;
        const bool isSet = isOfNumber ? number >> (bit - shift) & 1 : around >> bit & 1;
        const int byte = isBigEndian ? storage - 1 - bit / 8 : bit / 8;
        if (isSet)
            bytes[byte] = char(bytes[byte] | 1 << bit % 8);
    }
    return bytes;
}

const quint8 *dataOf(const QByteArray &bytes)
{
    return reinterpret_cast<const quint8 *>(bytes.constData());
}

/// An inertial sensor with two axes of 12 bits, a temperature, and a timestamp: 16 bytes a scan.
class Sensor
{
public:
    explicit Sensor(const QByteArray &keys = {}, const QStringList &channels = {"accel_x", "accel_y", "temp"})
        : bench(QStringLiteral("sysfs"), "root = fake:sys\ndevice = iio:imu\nbuffer = yes\n" + keys)
    {
        plugIn();
        for (const QString &channel : channels)
            bench.wireRead(channel);
        bench.wireRead("@errors");
    }
    ~Sensor() { closeNode(); }

    void plugIn()
    {
        set("name", "imu\n");
        set("in_accel_scale", "0.5\n");
        set("in_temp_scale", "100\n");
        set("in_temp_offset", "-10\n");
        addElement("in_accel_x", "0", "le:s12/16>>4");
        addElement("in_accel_y", "1", "be:s12/16>>4");
        addElement("in_temp", "2", "le:u16/16>>0");
        addElement("in_timestamp", "5", "le:s64/64>>0");
        set("current_timestamp_clock", "realtime\n");
        set("buffer/enable", "0\n");
        set("buffer/length", "2\n");
        set("trigger/current_trigger", "imu-dev3\n");
        sys.write("bus/iio/devices/trigger0/name", "imu-dev3\n");
        sys.write("bus/iio/devices/trigger1/name", "clock100\n");
        QDir().mkpath(QFileInfo(sys.path(node)).path());
        QFile::remove(sys.path(node));
        ::mkfifo(sys.path(node).toLocal8Bit().constData(), 0600);
        closeNode();
        m_writer = ::open(sys.path(node).toLocal8Bit().constData(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    }
    void addElement(const QString &name, const QByteArray &index, const QByteArray &type, const QByteArray &state = "0")
    {
        set("scan_elements/" + name + "_en", state + '\n');
        set("scan_elements/" + name + "_index", index + '\n');
        set("scan_elements/" + name + "_type", type + '\n');
    }
    void set(const QString &file, const QByteArray &text) { sys.write(folder + file, text); }
    QByteArray get(const QString &file) const { return sys.read(folder + file).trimmed(); }
    void remove(const QString &file) { QFile::remove(sys.path(folder + file)); }
    void closeNode()
    {
        if (m_writer >= 0)
            ::close(m_writer);
        m_writer = -1;
    }

    void send(const QByteArray &bytes)
    {
        if (::write(m_writer, bytes.constData(), std::size_t(bytes.size())) != bytes.size())
            qFatal("the pipe is full");
    }
    /// \param y  and x: of 12 bits
    static QByteArray scan(int x, int y, int temperature, qint64 time = 0)
    {
        return encoded(quint64(x), 12, 2, 4, false, 0xf) + encoded(quint64(y), 12, 2, 4, true, 0x5)
            + encoded(quint64(temperature), 16, 2, 0, false, 0) + QByteArray(2, '\x7e')
            + encoded(quint64(time), 64, 8, 0, false, 0);
    }
    bool hasError(const char *part)
    {
        const bool has = bench.errorString().contains(QLatin1String(part)) && bench.errorString().contains("; ")
            && bench.errorString().contains("iio:imu");
        if (!has)
            qWarning("%s", qPrintable(bench.errorString()));
        return has;
    }

    const FakeDevices devices;
    const QString folder = QStringLiteral("bus/iio/devices/iio:device3/");
    const QString node = QStringLiteral("dev/iio:device3");
    SysfsTree sys{QStringLiteral("fake:sys")};
    DriverBench bench;

private:
    int m_writer = -1;
};

}  // namespace

class tst_IioBuffer : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void typesAreRead_data();
    void typesAreRead();
    void typesThatLieAreRefused_data();
    void typesThatLieAreRefused();
    void elementsHaveTheirPlaces_data();
    void elementsHaveTheirPlaces();
    void scansThatCannotBeAreRefused();
    void randomScansAreDecoded();

    void allValuesAreOfTheNewestScan();
    void valuesHaveTheTimeOfTheKernel();
    void aTimeThatCannotBeIsThatOfTheReading();
    void aDeviceWithoutTimestampsIsRead();
    void onlyWiredChannelsAreInTheScan();
    void bufferOfNewerKernelsIsUsed();
    void aBufferThatWasLeftOnIsSetUpAnew();
    void closingSetsBackWhatItHasChanged();
    void triggerIsSetForAsLongAsTheDeviceIsOpen();
    void readingDoesNotAllocate();

    void whatIsNoBufferIsNamed_data();
    void whatIsNoBufferIsNamed();
    void aFailedOpenSetsBackWhatItHasChanged();
    void anUnknownTriggerIsNamedWithThoseThatAreThere();
    void aNodeThatIsNoDeviceIsRefused();
    void aSilentTriggerIsNamed();
    void aTornScanLosesTheDeviceAtOnce();
    void aFirstScanOfAnotherSizeIsRefused();
    void aFullBufferGivesNoValue();
    void valuesThatAreNotFiniteAreHeld();
    void anUnpluggedDeviceIsLostAtOnce();
    void whatWasSentBeforeOpeningIsDropped();
    void keysThatContradictAreRefused_data();
    void keysThatContradictAreRefused();
};

void tst_IioBuffer::typesAreRead_data()
{
    QTest::addColumn<QByteArray>("bytes");
    QTest::addColumn<double>("value");
    QTest::newRow("le:u8/8>>0") << QByteArray("\xfe") << 254.0;
    QTest::newRow("le:s8/8>>0 ") << QByteArray("\xfe") << -2.0;
    QTest::newRow("le:s12/16>>4") << QByteArray("\x0f\x80") << -2048.0;
    QTest::newRow("be:s12/16>>4") << QByteArray("\x7f\xff") << 2047.0;
    QTest::newRow("be:S12/16>>4") << QByteArray("\xff\xff") << -1.0;
    QTest::newRow("le:u12/16>>0") << QByteArray("\xff\xff") << 4095.0;
    QTest::newRow("be:u24/32>>8") << QByteArray("\x01\x02\x03\xff") << double(0x010203);
    QTest::newRow("be:u24/32>>0") << QByteArray("\xff\x01\x02\x03") << double(0x010203);
    QTest::newRow("le:s24/32") << QByteArray("\x00\x00\x80\x00", 4) << -8388608.0;
    QTest::newRow("le:s64/64>>0") << QByteArray(8, '\xff') << -1.0;
    QTest::newRow("le:u1/8>>7") << QByteArray("\x80") << 1.0;
    QTest::newRow("le:s16/16X4>>0") << QByteArray("\x01\x00\x02\x00\x03\x00\x04\x00", 8) << 1.0;
    QTest::newRow("le:f32/32>>0") << QByteArray("\x00\x00\xc0\x3f", 4) << 1.5;
    QTest::newRow("be:f64/64>>0") << QByteArray("\xc0\x00\x00\x00\x00\x00\x00\x00", 8) << -2.0;
}

void tst_IioBuffer::typesAreRead()
{
    QFETCH(QByteArray, bytes);
    const std::optional<IioElement> element = IioElement::fromText(QTest::currentDataTag());
    QVERIFY(element.has_value());
    QCOMPARE(element->bytes(), bytes.size());
    QTEST(element->number.decode(element->bits(dataOf(bytes))), "value");
}

void tst_IioBuffer::typesThatLieAreRefused_data()
{
    QTest::addColumn<QByteArray>("text");
    const QByteArray texts[] = {
        "",
        "le",
        "le:",
        "12",
        "le:s12/16>>4 ",  // this one is right
        "le:s17/16>>0",   // more bits than there are
        "le:s0/16>>0",
        "le:s12/16>>5",
        "le:s12/24>>0",
        "le:s12/12>>0",
        "le:s12/0>>0",
        "le:s64/128>>0",
        "le:s12/16>>99",
        "le:s12/16>>-1",
        "le:s-1/16>>0",
        "le:s+12/16>>0",
        "le:s12/16>>4>>4",
        "le:s12/16X0>>4",
        "le:s12/16X65>>4",
        "le:s12/16X>>4",
        "le:s12/16x2>>4",
        "le:x12/16>>4",
        "me:s12/16>>4",
        "LE:s12/16>>4",
        "le:f16/16>>0",
        "le:f32/64>>0",
        "le:f32/32>>1",
        "le:s12/16>>4 le:s12/16>>4",
        "le:s12/16\n>>4",
        "le:s99999999999999999999/16>>0",
        QByteArray("le:s12/16>>4\0x", 14),
        "le:s\xd9\xa1/16>>0",  // a digit of another script
    };
    for (const QByteArray &text : texts)
        QTest::newRow(text.toPercentEncoding().constData()) << text;
}

void tst_IioBuffer::typesThatLieAreRefused()
{
    QFETCH(QByteArray, text);
    QCOMPARE(IioElement::fromText(text).has_value(), text == "le:s12/16>>4 ");
}

void tst_IioBuffer::elementsHaveTheirPlaces_data()
{
    QTest::addColumn<QByteArrayList>("types");  // in the order of the scan
    QTest::addColumn<int>("size");
    QTest::addColumn<QList<int>>("places");
    QTest::newRow("one") << QByteArrayList{"le:u8/8>>0"} << 1 << QList<int>{0};
    QTest::newRow("three and a timestamp")
        << QByteArrayList{"le:s16/16>>0", "le:s16/16>>0", "le:s16/16>>0", "le:s64/64>>0"} << 16
        << QList<int>{0, 2, 4, 8};
    QTest::newRow("each at its size") << QByteArrayList{"le:u8/8>>0", "le:u32/32>>0", "le:u8/8>>0", "le:u16/16>>0"}
                                      << 12 << QList<int>{0, 4, 8, 10};
    QTest::newRow("end of the largest") << QByteArrayList{"le:u32/32>>0", "le:u16/16>>0"} << 8 << QList<int>{0, 4};
    QTest::newRow("repeated") << QByteArrayList{"le:u16/16>>0", "le:s16/16X4>>0", "le:u8/8>>0"} << 24
                              << QList<int>{0, 8, 16};
}

void tst_IioBuffer::elementsHaveTheirPlaces()
{
    QFETCH(QByteArrayList, types);
    QFETCH(QList<int>, places);
    IioScan scan;
    QList<int> numbers;
    for (int i = types.size() - 1; i >= 0; --i)  // the order of files is not that of the scan
        numbers.prepend(scan.add(7 * i, *IioElement::fromText(types[i])));
    QCOMPARE(scan.layOut(), static_cast<const char *>(nullptr));
    QTEST(scan.size(), "size");
    for (int i = 0; i < types.size(); ++i) {
        QByteArray bytes(scan.size(), '\0');
        bytes[places[i]] = 1;
        QCOMPARE(scan.value(numbers[i], dataOf(bytes)), 1.0);
    }
}

void tst_IioBuffer::scansThatCannotBeAreRefused()
{
    const auto problemOf = [](std::initializer_list<std::pair<int, const char *>> elements) {
        IioScan scan;
        for (const auto &[index, type] : elements)
            scan.add(index, *IioElement::fromText(type));
        return QByteArray(scan.layOut());
    };
    QVERIFY(problemOf({{0, "le:u8/8>>0"}, {1, "le:u8/8>>0"}}).isEmpty());
    QVERIFY(problemOf({}).contains("no channel of it is read"));
    QVERIFY(problemOf({{3, "le:u8/8>>0"}, {3, "le:u16/16>>0"}}).contains("the same index"));
    QVERIFY(problemOf({{0, "le:u16/16X3>>0"}}).contains("no power of two"));
    IioScan scan;
    for (int i = 0; i < 10; ++i)
        scan.add(i, *IioElement::fromText("le:u64/64X64>>0"));
    QVERIFY(QByteArray(scan.layOut()).contains("longer than 4096 bytes"));
}

void tst_IioBuffer::randomScansAreDecoded()
{
    std::mt19937_64 random(22);
    const auto below = [&](int end) { return int(random() % quint64(end)); };
    for (int round = 0; round < 2000; ++round) {
        IioScan scan;
        QByteArray bytes;
        QVector<double> values;
        QVector<int> numbers;
        int largest = 1;
        const int count = 1 + below(12);
        for (int i = 0; i < count; ++i) {
            const int storage = 1 << below(4);
            const int bits = 1 + below(8 * storage);
            const int shift = below(8 * storage - bits + 1);
            const bool isSigned = below(2) == 0;
            const bool isBigEndian = below(2) == 0;
            const quint64 word = random();
            const quint64 number = bits == 64 ? word : word & ((quint64(1) << bits) - 1);
            const bool isNegative = isSigned && (number >> (bits - 1) & 1);
            // Below zero: how much is missing to the next power of two.
            const quint64 missing = bits == 64 ? ~number + 1 : (quint64(1) << bits) - number;
            values << (isNegative ? -double(missing) : double(number));
            const QByteArray type = QByteArray(isBigEndian ? "be:" : "le:") + (isSigned ? 's' : 'u')
                + QByteArray::number(bits) + '/' + QByteArray::number(8 * storage) + ">>" + QByteArray::number(shift);
            numbers << scan.add(3 * i + below(3), *IioElement::fromText(type));
            while (bytes.size() % storage != 0)
                bytes += char(random());
            bytes += encoded(number, bits, storage, shift, isBigEndian, random());
            largest = std::max(largest, storage);
        }
        while (bytes.size() % largest != 0)
            bytes += char(random());
        QCOMPARE(scan.layOut(), static_cast<const char *>(nullptr));
        QCOMPARE(scan.size(), bytes.size());
        for (int i = 0; i < count; ++i)
            QCOMPARE(scan.value(numbers[i], dataOf(bytes)), values[i]);
    }
}

// ---- the driver ----

void tst_IioBuffer::allValuesAreOfTheNewestScan()
{
    Sensor sensor;
    QCOMPARE(sensor.bench.errors(), QString());
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QVERIFY(sensor.bench.exchange());
    QVERIFY(!sensor.bench.isFresh("accel_x"));  // nothing was sent
    sensor.send(Sensor::scan(1, 2, 3));
    QVERIFY(sensor.bench.exchange());
    QCOMPARE(sensor.bench.value("accel_x"), 0.5);
    sensor.send(Sensor::scan(10, 20, 30) + Sensor::scan(100, 200, 300) + Sensor::scan(-4, 7, 410));
    QVERIFY(sensor.bench.exchange());
    QCOMPARE(sensor.bench.value("accel_x"), -2.0);
    QCOMPARE(sensor.bench.value("accel_y"), 3.5);
    QCOMPARE(sensor.bench.value("temp"), 40.0);  // (410 - 10) * 100 thousandths
    QVERIFY(sensor.bench.exchange());
    QCOMPARE(sensor.bench.value("accel_x"), -2.0);
    sensor.bench.advance(40ms);  // no scan since
    QVERIFY(sensor.bench.exchange());
    QVERIFY(!sensor.bench.isFresh("accel_x"));
    QCOMPARE(sensor.bench.value("@errors"), 0.0);
}

void tst_IioBuffer::valuesHaveTheTimeOfTheKernel()
{
    Sensor sensor;
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QCOMPARE(sensor.get("current_timestamp_clock"), QByteArray("monotonic"));
    sensor.bench.advance(10ms);
    const qint64 time = sensor.bench.now() - 3'000'000;
    sensor.send(Sensor::scan(1, 2, 3, time - 1'000'000) + Sensor::scan(1, 2, 3, time));
    QVERIFY(sensor.bench.exchange());
    QCOMPARE(sensor.bench.time("accel_x"), time);
    QCOMPARE(sensor.bench.time("temp"), time);
}

void tst_IioBuffer::aTimeThatCannotBeIsThatOfTheReading()
{
    Sensor sensor;
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    const qint64 opened = sensor.bench.now();
    sensor.bench.advance(10ms);
    for (const qint64 time : {qint64(0), qint64(-1), opened - 1, sensor.bench.now() + 1,
                              std::numeric_limits<qint64>::max(), std::numeric_limits<qint64>::min()}) {
        sensor.send(Sensor::scan(1, 2, 3, time));
        QVERIFY(sensor.bench.exchange());
        QCOMPARE(sensor.bench.time("accel_x"), sensor.bench.now());
    }
}

void tst_IioBuffer::aDeviceWithoutTimestampsIsRead()
{
    for (const char *file : {"current_timestamp_clock", "scan_elements/in_timestamp_en"}) {
        Sensor sensor;
        sensor.remove(file);
        QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
        sensor.bench.advance(5ms);
        sensor.send(Sensor::scan(6, 7, 8).left(6));
        QVERIFY2(sensor.bench.exchange(), qPrintable(sensor.bench.errorString()));
        QCOMPARE(sensor.bench.value("accel_y"), 3.5);
        QCOMPARE(sensor.bench.time("accel_y"), sensor.bench.now());
    }
}

void tst_IioBuffer::onlyWiredChannelsAreInTheScan()
{
    Sensor sensor({}, {"accel_y"});
    sensor.addElement("in_accel_x", "0", "le:s12/16>>4", "1");  // somebody has left it on
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QCOMPARE(sensor.get("scan_elements/in_accel_x_en"), QByteArray("0"));
    QCOMPARE(sensor.get("scan_elements/in_accel_y_en"), QByteArray("1"));
    const QByteArray scan = Sensor::scan(1, 11, 3);
    sensor.send(scan.mid(2, 2) + QByteArray(6, 'x') + scan.right(8));
    QVERIFY2(sensor.bench.exchange(), qPrintable(sensor.bench.errorString()));
    QCOMPARE(sensor.bench.value("accel_y"), 5.5);
}

void tst_IioBuffer::bufferOfNewerKernelsIsUsed()
{
    Sensor sensor;
    const QString folder = sensor.sys.path(sensor.folder);
    QVERIFY(QDir().rename(folder + "scan_elements", folder + "buffer0"));
    for (const char *file : {"enable", "length"})
        QVERIFY(QFile::rename(folder + "buffer/" + file, folder + "buffer0/" + file));
    QVERIFY(QDir().rmdir(folder + "buffer"));
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QCOMPARE(sensor.get("buffer0/enable"), QByteArray("1"));
    sensor.send(Sensor::scan(1, 2, 3));
    QVERIFY2(sensor.bench.exchange(), qPrintable(sensor.bench.errorString()));
    QCOMPARE(sensor.bench.value("accel_y"), 1.0);
}

void tst_IioBuffer::aBufferThatWasLeftOnIsSetUpAnew()
{
    Sensor sensor("length = 64\n");
    sensor.set("buffer/enable", "1\n");  // by a program that was killed
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QCOMPARE(sensor.get("buffer/enable"), QByteArray("1"));
    QCOMPARE(sensor.get("buffer/length"), QByteArray("64"));
    sensor.bench.close();
    QCOMPARE(sensor.get("buffer/enable"), QByteArray("0"));
}

void tst_IioBuffer::closingSetsBackWhatItHasChanged()
{
    Sensor sensor("trigger = clock100\n", {"accel_y"});
    sensor.addElement("in_accel_x", "0", "le:s12/16>>4", "1");
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    sensor.bench.close();
    for (const auto &[file, text] : {std::pair{"scan_elements/in_accel_x_en", "1"},
                                     {"scan_elements/in_accel_y_en", "0"},
                                     {"scan_elements/in_timestamp_en", "0"},
                                     {"trigger/current_trigger", "imu-dev3"},
                                     {"buffer/length", "2"},
                                     {"buffer/enable", "0"},
                                     {"current_timestamp_clock", "realtime"}})
        QCOMPARE(sensor.get(file), QByteArray(text));
}

void tst_IioBuffer::triggerIsSetForAsLongAsTheDeviceIsOpen()
{
    Sensor sensor("trigger = clock100\n");
    sensor.set("trigger/current_trigger", "\n");
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QCOMPARE(sensor.get("trigger/current_trigger"), QByteArray("clock100"));
    sensor.bench.close();
    QCOMPARE(sensor.sys.read(sensor.folder + "trigger/current_trigger"), QByteArray("\n"));
}

void tst_IioBuffer::readingDoesNotAllocate()
{
    if (!ThreadCosts::areCounted())
        QSKIP("a sanitizer counts allocations");
    Sensor sensor;
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    const QByteArray scan = Sensor::scan(1, 2, 3);
    for (int i = 0; i < 10; ++i) {
        sensor.send(scan);
        QVERIFY(sensor.bench.exchange());
    }
    const ThreadCosts before = ThreadCosts::ofThisThread();
    bool isOpen = true;
    for (int i = 0; i < 1000; ++i) {
        if (i % 3 != 0)
            sensor.send(scan);
        isOpen = sensor.bench.exchange() && isOpen;
    }
    const ThreadCosts costs = ThreadCosts::ofThisThread() - before;
    QVERIFY(isOpen);
    QCOMPARE(costs.allocations, std::uint64_t(0));
}

// ---- faults ----

void tst_IioBuffer::whatIsNoBufferIsNamed_data()
{
    QTest::addColumn<QString>("file");
    QTest::addColumn<QByteArray>("text");  // null: it is removed
    QTest::addColumn<QByteArray>("part");
    const QByteArray gone;
    QTest::newRow("no buffer") << "buffer/enable" << gone << QByteArray("has no buffer: its driver");
    QTest::newRow("channel not in the buffer")
        << "scan_elements/in_temp_en" << gone << QByteArray("no channel 'temp' in its buffer; known are: accel_x");
    QTest::newRow("no index") << "scan_elements/in_temp_index" << gone << QByteArray("in_temp_index");
    QTest::newRow("no number") << "scan_elements/in_temp_index" << QByteArray("-1")
                               << QByteArray("in_temp_index' of iio:imu");
    QTest::newRow("index twice") << "scan_elements/in_temp_index" << QByteArray("1\n") << QByteArray("the same index");
    QTest::newRow("no type") << "scan_elements/in_temp_type" << gone << QByteArray("in_temp_type");
    QTest::newRow("type that lies") << "scan_elements/in_temp_type" << QByteArray("le:u17/16>>0\n")
                                    << QByteArray("'le:u17/16>>0' is not a type of IIO");
    QTest::newRow("type of another length")
        << "scan_elements/in_temp_type" << QByteArray(600, '1') << QByteArray("in_temp_type");
    QTest::newRow("several values") << "scan_elements/in_temp_type" << QByteArray("le:u16/16X4>>0\n")
                                    << QByteArray("has 4 values in a scan");
    QTest::newRow("no scale") << "in_temp_input" << QByteArray("30000\n") << QByteArray("does not tell the scale");
    QTest::newRow("no trigger to set") << "trigger/current_trigger" << gone << QByteArray("it takes no trigger");
}

void tst_IioBuffer::whatIsNoBufferIsNamed()
{
    QFETCH(QString, file);
    QFETCH(QByteArray, text);
    QFETCH(QByteArray, part);
    Sensor sensor("trigger = clock100\n");
    if (file == "in_temp_input")
        sensor.remove("in_temp_scale");
    if (text.isNull())
        sensor.remove(file);
    else
        sensor.set(file, text);
    QVERIFY(!sensor.bench.open());
    QVERIFY(sensor.hasError(part.constData()));
    sensor.plugIn();
    sensor.remove("in_temp_input");
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
}

void tst_IioBuffer::aFailedOpenSetsBackWhatItHasChanged()
{
    Sensor sensor("trigger = clock100\n", {"accel_y"});
    sensor.addElement("in_accel_x", "0", "le:s12/16>>4", "1");
    sensor.addElement("in_accel_y", "1", "le:s12/15>>4");
    QVERIFY(!sensor.bench.open());
    QVERIFY(sensor.hasError("in_accel_y_type"));
    QCOMPARE(sensor.get("scan_elements/in_accel_x_en"), QByteArray("1"));
    QCOMPARE(sensor.get("scan_elements/in_accel_y_en"), QByteArray("0"));
    QCOMPARE(sensor.get("trigger/current_trigger"), QByteArray("imu-dev3"));
    QCOMPARE(sensor.get("buffer/enable"), QByteArray("0"));
}

void tst_IioBuffer::anUnknownTriggerIsNamedWithThoseThatAreThere()
{
    Sensor sensor("trigger = clock10\n");
    QVERIFY(!sensor.bench.open());
    QVERIFY(sensor.hasError("there is no trigger 'clock10'; known are: clock100, imu-dev3"));
    QCOMPARE(sensor.get("trigger/current_trigger"), QByteArray("imu-dev3"));
    for (const char *trigger : {"trigger0", "trigger1"})
        QVERIFY(sensor.sys.remove(QStringLiteral("bus/iio/devices/") + trigger));
    QVERIFY(!sensor.bench.open());
    QVERIFY(sensor.hasError("the kernel has none: make one, for example with its module iio-trig-hrtimer"));
}

void tst_IioBuffer::aNodeThatIsNoDeviceIsRefused()
{
    Sensor sensor;
    QVERIFY(QFile::remove(sensor.sys.path(sensor.node)));
    QVERIFY(!sensor.bench.open());
    QVERIFY(sensor.hasError("mkfifo"));
    sensor.sys.write(sensor.node, "bytes");
    QVERIFY(!sensor.bench.open());
    QVERIFY(sensor.hasError("it is not a character device"));
}

void tst_IioBuffer::aSilentTriggerIsNamed()
{
    Sensor sensor;
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    sensor.send(Sensor::scan(1, 2, 3));
    QVERIFY(sensor.bench.exchange());
    sensor.bench.advance(999ms);
    QVERIFY(sensor.bench.exchange());
    QVERIFY(!sensor.bench.isFresh("accel_x"));
    sensor.bench.advance(2ms);
    QVERIFY(!sensor.bench.exchange());
    QVERIFY(sensor.hasError("has sent no scan for 1 s; look at its trigger"));
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
}

void tst_IioBuffer::aTornScanLosesTheDeviceAtOnce()
{
    Sensor sensor("timeout = 10 s\n");
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    sensor.send(Sensor::scan(1, 2, 3));
    QVERIFY(sensor.bench.exchange());
    sensor.send(Sensor::scan(4, 5, 6) + Sensor::scan(7, 8, 9).left(5));
    QVERIFY(!sensor.bench.exchange());
    QVERIFY(sensor.hasError("do not have the size that the kernel tells (16 bytes); use a kernel"));
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    sensor.send(Sensor::scan(10, 11, 12));
    QVERIFY(sensor.bench.exchange());
    QCOMPARE(sensor.bench.value("accel_x"), 5.0);
    QCOMPARE(sensor.bench.value("@errors"), 1.0);
}

// As of a kernel before 5.7, which does not pad the end of a scan.
void tst_IioBuffer::aFirstScanOfAnotherSizeIsRefused()
{
    Sensor sensor({}, {"accel_x", "accel_y"});
    sensor.remove("scan_elements/in_timestamp_en");
    sensor.addElement("in_accel_x", "0", "le:s64/64>>0");
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    sensor.send(QByteArray(10, '\1'));
    QVERIFY(!sensor.bench.exchange());
    QVERIFY(sensor.hasError("do not have the size that the kernel tells (16 bytes); use a kernel"));
    QVERIFY(!sensor.bench.isFresh("accel_x"));
}

void tst_IioBuffer::aFullBufferGivesNoValue()
{
    Sensor sensor("length = 4\ntimeout = 50 ms\n");
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    sensor.send(Sensor::scan(1, 2, 3));
    QVERIFY(sensor.bench.exchange());
    sensor.bench.advance(10ms);
    for (int i = 0; i < 4; ++i)
        sensor.send(Sensor::scan(100 + i, 0, 0));
    QVERIFY(sensor.bench.exchange());
    QCOMPARE(sensor.bench.value("accel_x"), 0.5);  // it is held
    QCOMPARE(sensor.bench.value("@errors"), 1.0);
    sensor.bench.advance(10ms);
    for (int i = 0; i < 3; ++i)
        sensor.send(Sensor::scan(200 + i, 0, 0));
    QVERIFY(sensor.bench.exchange());
    QCOMPARE(sensor.bench.value("accel_x"), 101.0);
    for (int round = 0; round < 20 && sensor.bench.isOnline(); ++round) {
        for (int i = 0; i < 5; ++i)
            sensor.send(Sensor::scan(300 + i, 0, 0));
        sensor.bench.advance(10ms);
        sensor.bench.exchange();
    }
    QVERIFY(!sensor.bench.isOnline());
    QVERIFY(sensor.hasError("more than 4 scans came in one interval"));
}

void tst_IioBuffer::valuesThatAreNotFiniteAreHeld()
{
    Sensor sensor("timeout = 50 ms\n");
    sensor.addElement("in_temp", "2", "le:f32/32>>0");
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    const auto send = [&](int x, float temperature) {
        QByteArray bytes(4, '\0');
        std::memcpy(bytes.data(), &temperature, sizeof temperature);
        const QByteArray scan = Sensor::scan(x, 0, 0);
        sensor.send(scan.left(4) + bytes + scan.right(8));
    };
    send(2, 15.0F);
    QVERIFY2(sensor.bench.exchange(), qPrintable(sensor.bench.errorString()));
    QCOMPARE(sensor.bench.value("temp"), 0.5);
    sensor.bench.advance(10ms);
    send(4, std::numeric_limits<float>::quiet_NaN());
    QVERIFY(sensor.bench.exchange());
    QCOMPARE(sensor.bench.value("temp"), 0.5);
    QCOMPARE(sensor.bench.value("accel_x"), 1.0);  // of the same instant
    QCOMPARE(sensor.bench.value("@errors"), 1.0);
    sensor.bench.advance(60ms);
    send(4, std::numeric_limits<float>::infinity());
    QVERIFY(!sensor.bench.exchange());
    QVERIFY(sensor.hasError("'temp' of iio:imu"));
    QVERIFY(sensor.hasError("is not a finite number"));
}

void tst_IioBuffer::anUnpluggedDeviceIsLostAtOnce()
{
    Sensor sensor("timeout = 10 s\n");
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    sensor.send(Sensor::scan(1, 2, 3));
    QVERIFY(sensor.bench.exchange());
    QVERIFY(sensor.sys.remove());
    QVERIFY(!sensor.bench.exchange());
    QVERIFY(sensor.hasError("plug it in again"));
    QVERIFY(!sensor.bench.open());
    sensor.plugIn();
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    sensor.send(Sensor::scan(3, 2, 1));
    QVERIFY(sensor.bench.exchange());
    QCOMPARE(sensor.bench.value("accel_x"), 1.5);
}

void tst_IioBuffer::whatWasSentBeforeOpeningIsDropped()
{
    Sensor sensor;
    sensor.send(Sensor::scan(1, 2, 3) + "rest");
    QVERIFY2(sensor.bench.open(), qPrintable(sensor.bench.errorString()));
    QVERIFY(sensor.bench.exchange());
    QVERIFY(!sensor.bench.isFresh("accel_x"));
    sensor.closeNode();  // a pipe without a writer has ended
    QVERIFY(sensor.bench.exchange());
    QCOMPARE(sensor.bench.value("@errors"), 0.0);
}

void tst_IioBuffer::keysThatContradictAreRefused_data()
{
    QTest::addColumn<QByteArray>("keys");
    QTest::addColumn<QString>("part");
    QTest::newRow("class without buffers")
        << QByteArray("device = hwmon:a\nbuffer = yes\n") << "only IIO has buffers; leave 'buffer' out";
    QTest::newRow("trigger alone") << QByteArray("device = iio:a\ntrigger = t\n") << "add 'buffer = yes'";
    QTest::newRow("length alone") << QByteArray("device = iio:a\nbuffer = no\nlength = 8\n") << "add 'buffer = yes'";
    QTest::newRow("short") << QByteArray("device = iio:a\nbuffer = yes\nlength = 1\n") << "from 2 to 16384";
    QTest::newRow("neither yes nor no") << QByteArray("device = iio:a\nbuffer = on demand\n") << "write 'yes' or 'no'";
    QTest::newRow("outputs") << QByteArray("device = iio:a\nbuffer = yes\nrange.voltage0 = 0, 5\n")
                             << "a section with a buffer has no outputs; write another section";
    QTest::newRow("key of IIO") << QByteArray("device = hwmon:a\ntrigger = t\n") << "'trigger' is not a key";
}

void tst_IioBuffer::keysThatContradictAreRefused()
{
    QFETCH(QByteArray, keys);
    QFETCH(QString, part);
    const DriverBench bench(QStringLiteral("sysfs"), keys);
    QVERIFY2(bench.errors().contains(part), qPrintable(bench.errors()));
    QCOMPARE(bench.errors().count('\n'), 0);
}

QTEST_GUILESS_MAIN(tst_IioBuffer)
#include "tst_IioBuffer.moc"
