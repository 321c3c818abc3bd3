// SPDX-License-Identifier: Apache-2.0
#include "recording/PlantMessage.h"

#include <QtCore/QSet>
#include <QtTest/QtTest>

using namespace qplc;

namespace {

const char all[]
    = "[a]\ntype = Int8\n[b]\ntype = Int16[2]\n[c]\ntype = UInt32\n[d]\ntype = UInt64\n[e]\ntype = Real32[3]\n"
      "[f]\ntype = Real64\n[g]\ntype = String(5)\n[h]\ntype = DateTime\n[i]\ntype = String\n[j]\ntype = UInt8\n";

}  // namespace

// A cycle as a ROS 1 message.
class tst_PlantMessage : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void anImageComesBackAsItWas_data();
    void anImageComesBackAsItWas();
    void withoutTextsTheValuesLieAsInTheImage();
    void aMessageThatIsCutIsRefused();
    void aTextThatIsTooLongIsRefused();
    void theSchemaNamesEachSignal();
    void fieldsHaveNamesThatRosAllows();
};

void tst_PlantMessage::anImageComesBackAsItWas_data()
{
    QTest::addColumn<QByteArray>("ini");
    QTest::newRow("every type") << QByteArray(all);
    QTest::newRow("one number") << QByteArray("[x]\ntype = Real64\n");
    QTest::newRow("one text") << QByteArray("[x]\ntype = String(1)\n");
}

void tst_PlantMessage::anImageComesBackAsItWas()
{
    QFETCH(QByteArray, ini);
    const QPlcSignalTable table = QPlcSignalTable::fromIni(ini);
    ProcessImage image(table);
    for (int round = 0; round < 20; ++round) {
        for (QPlcSignalIndex i = 0; i < QPlcSignalIndex(table.size()); ++i) {
            const QPlcSignalType type = table.at(i).type;
            if (type.isString())
                image.setValue(i, QPlcValue(QString(qMin(round, type.capacity()), QLatin1Char('x'))));
            else
                for (int byte = 0; byte < type.size(); ++byte)
                    image.data()[image.offset(i) + quint32(byte)] = char(31 * round + 7 * byte + i);
            image.setQuality(i, QPlcQuality::fromByte(quint8(round % 4)));
        }
        const PlantMessage::Cycle cycle{quint64(round), -5, 3, 9};
        QByteArray bytes;
        PlantMessage(table).encode(cycle, image.data(), &bytes);
        PlantMessage message(table);
        const std::optional<PlantMessage::Cycle> read = message.decode(bytes.constData(), std::size_t(bytes.size()));
        QVERIFY(read);
        QCOMPARE(read->number, cycle.number);
        QCOMPARE(read->lateness, cycle.lateness);
        QCOMPARE(read->skipped, cycle.skipped);
        QCOMPARE(read->flags, cycle.flags);
        QCOMPARE(QByteArray(message.image().data(), int(image.totalSize())),
                 QByteArray(image.data(), int(image.totalSize())));
        QCOMPARE(message.image().digest(1), image.digest(1));
    }
}

void tst_PlantMessage::withoutTextsTheValuesLieAsInTheImage()
{
    const QPlcSignalTable table = QPlcSignalTable::fromIni("[a]\ntype = Int8\n[b]\ntype = Real64\n");
    ProcessImage image(table);
    image.setValue(1, QPlcValue(2.5));
    QByteArray bytes;
    PlantMessage(table).encode({}, image.data(), &bytes);
    QCOMPARE(bytes.mid(PlantMessage::CycleSize, 9), QByteArray(image.data(), 9));
    QCOMPARE(bytes.size(), int(PlantMessage::CycleSize) + 9 + 2);
}

void tst_PlantMessage::aMessageThatIsCutIsRefused()
{
    const QPlcSignalTable table = QPlcSignalTable::fromIni(all);
    PlantMessage message(table);
    QByteArray bytes;
    message.encode({}, ProcessImage(table).data(), &bytes);
    for (int size = 0; size < bytes.size(); ++size) {
        const QByteArray cut = bytes.left(size);
        QVERIFY(!message.decode(cut.constData(), std::size_t(cut.size())));
    }
    bytes += 'x';
    QVERIFY(!message.decode(bytes.constData(), std::size_t(bytes.size())));
}

void tst_PlantMessage::aTextThatIsTooLongIsRefused()
{
    const QPlcSignalTable table = QPlcSignalTable::fromIni("[t]\ntype = String(3)\n");
    PlantMessage message(table);
    QByteArray bytes;
    message.encode({}, ProcessImage(table).data(), &bytes);
    bytes.insert(int(PlantMessage::CycleSize) + 4, "long");
    bytes[int(PlantMessage::CycleSize)] = 4;
    QVERIFY(!message.decode(bytes.constData(), std::size_t(bytes.size())));
}

void tst_PlantMessage::theSchemaNamesEachSignal()
{
    const QByteArray schema
        = PlantMessage(QPlcSignalTable::fromIni("[tether.speed]\ntype = Real32[3]\nunit = m/s\n[t]\ntype = String\n"))
              .schema();
    QVERIFY2(schema.contains("\nfloat32[3] tether_speed  # tether.speed [m/s]\n"), schema.constData());
    QVERIFY2(schema.contains("\nstring t  # t\n"), schema.constData());
    QVERIFY2(schema.contains("\nuint8[2] quality"), schema.constData());
}

void tst_PlantMessage::fieldsHaveNamesThatRosAllows()
{
    QSet<QByteArray> used{"cycle"};
    QCOMPARE(rosFieldName("masterTime", &used), QByteArray("masterTime"));
    QCOMPARE(rosFieldName("a.b", &used), QByteArray("a_b"));
    QCOMPARE(rosFieldName("a b", &used), QByteArray("a_b_2"));
    QCOMPARE(rosFieldName("cycle", &used), QByteArray("cycle_2"));
    QCOMPARE(rosFieldName("1st", &used), QByteArray("s_1st"));
    QCOMPARE(rosFieldName(QString(QChar(0xe4)), &used), QByteArray("s__"));
}

QTEST_GUILESS_MAIN(tst_PlantMessage)
#include "tst_PlantMessage.moc"
