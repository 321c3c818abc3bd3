// SPDX-License-Identifier: Apache-2.0
#include "hardware/modbus/ModbusPlan.h"

#include <QtTest/QtTest>

#include <array>
#include <random>

using qplc::ModbusBlock;
using qplc::ModbusRegister;
using qplc::planToRead;
using qplc::planToWrite;
using Words = std::vector<quint16>;

class tst_ModbusRegister : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void registerIsReadFromItsConfiguration();
    void registerInheritsDefaultsFromItsSection();
    void invalidRegistersAreReported_data();
    void invalidRegistersAreReported();
    void typesAreEncodedAsTheProtocolDefines_data();
    void typesAreEncodedAsTheProtocolDefines();
    void bitsOfARegisterAreANumber();
    void randomValuesAreReadBack();
    void valuesOutOfRangeAreSaturated_data();
    void valuesOutOfRangeAreSaturated();
    void factorAndOffsetConvertBothWays();
    void neighboursAreReadInOneRequest();
    void gapsAreReadOnlyWhereThatIsAllowed();
    void unitsAndSpacesAreReadApart();
    void noRequestIsLargerThanTheProtocolAllows();
    void aValueIsNeverCut();
    void writeRequestsContainOnlyConfiguredRegisters();

private:
    static ModbusRegister parsed(const QString &text)
    {
        ModbusRegister result;
        QString error;
        if (!ModbusRegister::parse(text, {}, &result, &error))
            qWarning("%s", qPrintable(error));
        return result;
    }
    static std::vector<ModbusRegister> row(int count, const char *space, int first = 0, int step = 1)
    {
        std::vector<ModbusRegister> all;
        for (int i = 0; i < count; ++i)
            all.push_back(parsed(QStringLiteral("%1 %2").arg(space).arg(first + i * step)));
        return all;
    }
};

void tst_ModbusRegister::registerIsReadFromItsConfiguration()
{
    const ModbusRegister place = parsed("holding 0x64, int32, factor -0.1, offset 2.5, word-order little, unit 7");
    QCOMPARE(place.space, ModbusRegister::Holding);
    QCOMPARE(place.address, quint16(100));
    QCOMPARE(place.type, ModbusRegister::Int32);
    QCOMPARE(place.factor, -0.1);
    QCOMPARE(place.offset, 2.5);
    QVERIFY(place.isLowWordFirst);
    QCOMPARE(place.unit, quint8(7));

    QCOMPARE(parsed("input 65535").type, ModbusRegister::UInt16);
    QCOMPARE(parsed("  coil   3 ").space, ModbusRegister::Coil);
    QCOMPARE(parsed("discrete 3").type, ModbusRegister::Bit);
    QCOMPARE(parsed("holding 8,bit 15").bit, quint8(15));
}

void tst_ModbusRegister::registerInheritsDefaultsFromItsSection()
{
    ModbusRegister section;
    section.unit = 9;
    section.isLowWordFirst = true;
    ModbusRegister place;
    QString error;
    QVERIFY(ModbusRegister::parse("input 5, float32", section, &place, &error));
    QCOMPARE(place.unit, quint8(9));
    QVERIFY(place.isLowWordFirst);
    QVERIFY(ModbusRegister::parse("input 5, unit 2, word-order big", section, &place, &error));
    QCOMPARE(place.unit, quint8(2));
    QVERIFY(!place.isLowWordFirst);
}

void tst_ModbusRegister::invalidRegistersAreReported_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("error");
    QTest::newRow("nothing") << ""
                             << "'' is not a place in a device";
    QTest::newRow("space") << "register 5"
                           << "'register 5' is not a place in a device: one of coil, discrete, input, holding";
    QTest::newRow("no address") << "holding"
                                << "'holding' is not a place";
    QTest::newRow("negative address") << "holding -1"
                                      << "'holding -1' is not a place";
    QTest::newRow("address of a manual") << "holding 400101"
                                         << "an address of 0 ... 65535";
    QTest::newRow("behind the last") << "holding 65535, int32"
                                     << "takes 2 registers from 65535 on";
    QTest::newRow("type") << "holding 5, int17"
                          << "'int17' is not known: int16, uint16";
    QTest::newRow("type of a coil") << "coil 5, int16"
                                    << "a coil or discrete input is a bit and has no type";
    QTest::newRow("bit of a coil") << "coil 5, bit 1"
                                   << "is a bit itself";
    QTest::newRow("bit 16") << "holding 5, bit 16"
                            << "'bit 16' is not valid: a number of 0 ... 15";
    QTest::newRow("bits of a coil") << "coil 5, bits 1-2"
                                    << "is a bit itself";
    QTest::newRow("bits in the wrong order") << "holding 5, bits 7-4"
                                             << "'bits 7-4' is not valid: the lowest and the highest bit of 0 ... 15";
    QTest::newRow("bits without an end") << "holding 5, bits 4"
                                         << "\"4-7\" for example";
    QTest::newRow("byte order") << "holding 5, byte-order middle"
                                << "big or little";
    QTest::newRow("factor 0") << "holding 5, factor 0"
                              << "'factor 0' is not valid: a number, not 0";
    QTest::newRow("factor nan") << "holding 5, factor nan"
                                << "'factor nan' is not valid";
    QTest::newRow("offset") << "holding 5, offset x"
                            << "'offset x' is not valid: a number";
    QTest::newRow("unit") << "holding 5, unit 256"
                          << "a number of 0 ... 255";
    QTest::newRow("word order") << "holding 5, word-order middle"
                                << "big or little";
    QTest::newRow("empty part") << "holding 5,, int16"
                                << "'' is not known";
}

void tst_ModbusRegister::invalidRegistersAreReported()
{
    QFETCH(QString, text);
    QFETCH(QString, error);
    ModbusRegister place;
    QString found;
    QVERIFY(!ModbusRegister::parse(text, {}, &place, &found));
    QVERIFY2(found.contains(error), qPrintable(found));
}

void tst_ModbusRegister::typesAreEncodedAsTheProtocolDefines_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<double>("value");
    QTest::addColumn<Words>("words");
    QTest::newRow("coil") << "coil 0" << 1.0 << Words{1};
    QTest::newRow("uint16") << "holding 0" << 65534.0 << Words{0xfffe};
    QTest::newRow("int16") << "holding 0, int16" << -2.0 << Words{0xfffe};
    QTest::newRow("uint32") << "holding 0, uint32" << 305419896.0 << Words{0x1234, 0x5678};
    QTest::newRow("uint32 little") << "holding 0, uint32, word-order little" << 305419896.0 << Words{0x5678, 0x1234};
    QTest::newRow("int32") << "holding 0, int32" << -2.0 << Words{0xffff, 0xfffe};
    QTest::newRow("float32") << "holding 0, float32" << -1.5 << Words{0xbfc0, 0x0000};
    QTest::newRow("float32 little") << "holding 0, float32, word-order little" << -1.5 << Words{0x0000, 0xbfc0};
    QTest::newRow("int64") << "holding 0, int64" << -3.0 << Words{0xffff, 0xffff, 0xffff, 0xfffd};
    QTest::newRow("uint16, bytes swapped") << "holding 0, byte-order little" << 4660.0 << Words{0x3412};
    QTest::newRow("int32, bytes swapped") << "holding 0, int32, byte-order little" << -2.0 << Words{0xffff, 0xfeff};
    QTest::newRow("uint32, bytes and words swapped")
        << "holding 0, uint32, word-order little, byte-order little" << 305419896.0 << Words{0x7856, 0x3412};
    QTest::newRow("float32, bytes swapped") << "holding 0, float32, byte-order little" << -1.5 << Words{0xc0bf, 0x0000};
    QTest::newRow("coil has no bytes") << "coil 0, byte-order little" << 1.0 << Words{1};
    QTest::newRow("float64") << "holding 0, float64" << 1.0 << Words{0x3ff0, 0, 0, 0};
    QTest::newRow("float64 little") << "holding 0, float64, word-order little" << 1.0 << Words{0, 0, 0, 0x3ff0};
}

void tst_ModbusRegister::typesAreEncodedAsTheProtocolDefines()
{
    QFETCH(QString, text);
    QFETCH(double, value);
    QFETCH(Words, words);
    const ModbusRegister place = parsed(text);
    QCOMPARE(std::size_t(place.size()), words.size());
    Words encoded(words.size());
    place.encode(value, encoded.data());
    QCOMPARE(encoded, words);
    QCOMPARE(place.decode(words.data()), value);
    QCOMPARE(parsed("input 0, bit 3").decode(Words{0x0008}.data()), 1.0);
    QCOMPARE(parsed("input 0, bit 3").decode(Words{0xfff7}.data()), 0.0);
}

void tst_ModbusRegister::bitsOfARegisterAreANumber()
{
    QCOMPARE(parsed("input 0, bits 4-7").decode(Words{0xfa5f}.data()), 5.0);
    QCOMPARE(parsed("holding 0, bits 0-15").decode(Words{0xfffe}.data()), 65534.0);
    QCOMPARE(parsed("holding 0, bits 9-9").decode(Words{0x0200}.data()), 1.0);
    QCOMPARE(parsed("holding 0, bits 12-15, factor 0.5, offset -1").decode(Words{0x7fff}.data()), 2.5);
    QCOMPARE(parsed("holding 0, bits 0-7, byte-order little").decode(Words{0x12ff}.data()), 18.0);
    QVERIFY(!parsed("input 0, bits 4-7").isWritable());
    quint16 word = 0;
    parsed("holding 0, bits 4-7, factor 0.5").encode(2.5, &word);
    QCOMPARE(word, quint16(0x0050));
    parsed("holding 0, bits 4-7").encode(99.0, &word);
    QCOMPARE(word, quint16(0x00f0));
    parsed("holding 0, bit 0, byte-order little").encode(1.0, &word);
    QCOMPARE(word, quint16(0x0100));
    QCOMPARE(parsed("holding 0, bits 9-11").mask(), quint16(0x0e00));
    QCOMPARE(parsed("holding 0, bits 0-15").mask(), quint16(0xffff));
    QCOMPARE(parsed("holding 0, bit 9, byte-order little").mask(), quint16(0x0002));
}

void tst_ModbusRegister::randomValuesAreReadBack()
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-32768.0, 32767.0);
    for (const char *type : {"int16", "int32", "int64", "float32", "float64"}) {
        for (const char *order : {"big", "little", "big, byte-order little", "little, byte-order little"}) {
            const ModbusRegister place = parsed(QStringLiteral("holding 0, %1, word-order %2").arg(type, order));
            for (int i = 0; i < 1000; ++i) {
                const double value = place.type == ModbusRegister::Float64 ? any(random) : std::round(any(random));
                std::array<quint16, 4> words{};
                place.encode(value, words.data());
                QCOMPARE(place.decode(words.data()), value);
            }
        }
    }
}

void tst_ModbusRegister::valuesOutOfRangeAreSaturated_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<double>("value");
    QTest::addColumn<double>("written");
    QTest::newRow("rounded") << "holding 0" << 2.5 << 3.0;
    QTest::newRow("below uint16") << "holding 0" << -5.0 << 0.0;
    QTest::newRow("above uint16") << "holding 0" << 70000.0 << 65535.0;
    QTest::newRow("below int16") << "holding 0, int16" << -1e9 << -32768.0;
    QTest::newRow("above int32") << "holding 0, int32" << 1e12 << 2147483647.0;
    QTest::newRow("above int64") << "holding 0, int64" << 1e30 << 9223372036854775807.0;
    QTest::newRow("above float32") << "holding 0, float32" << 1e300 << double(std::numeric_limits<float>::max());
    QTest::newRow("above float32, scaled")
        << "holding 0, float32, factor 1e-10" << 1e300 << double(std::numeric_limits<float>::max()) * 1e-10;
    QTest::newRow("below float64, scaled")
        << "holding 0, float64, factor 1e-10" << -1e300 << -std::numeric_limits<double>::max() * 1e-10;
    QTest::newRow("coil, nearly on") << "coil 0" << 0.5 << 1.0;
    QTest::newRow("coil, off") << "coil 0" << -7.0 << 0.0;
}

void tst_ModbusRegister::valuesOutOfRangeAreSaturated()
{
    QFETCH(QString, text);
    QFETCH(double, value);
    QFETCH(double, written);
    const ModbusRegister place = parsed(text);
    std::array<quint16, 4> words{};
    place.encode(value, words.data());
    QCOMPARE(place.decode(words.data()), written);
}

void tst_ModbusRegister::factorAndOffsetConvertBothWays()
{
    const ModbusRegister place = parsed("holding 0, int16, factor 0.1, offset -40");
    quint16 word = 0;
    place.encode(-35.5, &word);
    QCOMPARE(word, quint16(45));
    QCOMPARE(place.decode(&word), -35.5);
}

void tst_ModbusRegister::neighboursAreReadInOneRequest()
{
    const std::vector<ModbusBlock> blocks = planToRead(
        {parsed("holding 12, int32"), parsed("holding 10"), parsed("holding 11"), parsed("holding 12, bit 3")}, 0);
    QCOMPARE(blocks.size(), std::size_t(1));
    QCOMPARE(blocks[0].request.first, quint16(10));
    QCOMPARE(blocks[0].request.count, 4);
    QCOMPARE(blocks[0].members, (std::vector<std::size_t>{1, 2, 0, 3}));
    QVERIFY(planToRead({}, 0).empty());
}

void tst_ModbusRegister::gapsAreReadOnlyWhereThatIsAllowed()
{
    const std::vector<ModbusRegister> registers = row(3, "input", 0, 4);
    QCOMPARE(planToRead(registers, 0).size(), std::size_t(3));
    QCOMPARE(planToRead(registers, 2).size(), std::size_t(3));
    QCOMPARE(planToRead(registers, 3).size(), std::size_t(1));
    QCOMPARE(planToRead(registers, 3)[0].request.count, 9);
}

void tst_ModbusRegister::unitsAndSpacesAreReadApart()
{
    QCOMPARE(planToRead({parsed("holding 1"), parsed("input 2"), parsed("holding 2, unit 2")}, 100).size(),
             std::size_t(3));
    QCOMPARE(planToRead({parsed("coil 1"), parsed("discrete 2")}, 100).size(), std::size_t(2));
}

void tst_ModbusRegister::noRequestIsLargerThanTheProtocolAllows()
{
    const auto counts = [](const std::vector<ModbusBlock> &blocks) {
        std::vector<int> all;
        for (const ModbusBlock &block : blocks)
            all.push_back(block.request.count);
        return all;
    };
    QCOMPARE(counts(planToRead(row(126, "holding"), 0)), (std::vector<int>{125, 1}));
    QCOMPARE(counts(planToRead(row(2001, "coil"), 0)), (std::vector<int>{2000, 1}));
    QCOMPARE(counts(planToWrite(row(124, "holding"))), (std::vector<int>{123, 1}));
    QCOMPARE(counts(planToWrite(row(1969, "coil"))), (std::vector<int>{1968, 1}));
}

void tst_ModbusRegister::aValueIsNeverCut()
{
    std::vector<ModbusRegister> registers = row(124, "holding");
    registers.push_back(parsed("holding 124, float32"));
    const std::vector<ModbusBlock> blocks = planToRead(registers, 0);
    QCOMPARE(blocks.size(), std::size_t(2));
    QCOMPARE(blocks[1].request.first, quint16(124));
    QCOMPARE(blocks[1].request.count, 2);
}

void tst_ModbusRegister::writeRequestsContainOnlyConfiguredRegisters()
{
    QCOMPARE(planToWrite({parsed("holding 1"), parsed("holding 2"), parsed("holding 4")}).size(), std::size_t(2));
    QVERIFY(overlap(parsed("holding 1, int32"), parsed("holding 2")));
    QVERIFY(!overlap(parsed("holding 1, int32"), parsed("holding 3")));
    QVERIFY(!overlap(parsed("holding 1"), parsed("holding 1, unit 2")));
    QVERIFY(!overlap(parsed("holding 1"), parsed("coil 1")));
}

QTEST_APPLESS_MAIN(tst_ModbusRegister)
#include "tst_ModbusRegister.moc"
