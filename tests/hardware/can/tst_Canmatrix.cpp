// SPDX-License-Identifier: Apache-2.0
#include "RandomDbc.h"
#include "hardware/can/CanFrame.h"
#include "hardware/can/DbcFile.h"

#include <QtTest/QtTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

using namespace qplc;

namespace {

constexpr quint32 seed = 20261123;
constexpr int fewestSignals = 10000;

double numberOf(const QString &text)
{
    return text == QLatin1String("inf") ? std::numeric_limits<double>::infinity() : text.toDouble();
}

quint64 bitsOf(const DbcSignal &signal, double value)
{
    std::array<quint8, 64> data{};
    DbcSignal alone = signal;
    alone.start = 0;
    alone.byteOrder = DbcSignal::Intel;
    alone.encodeRaw(data.data(), value);
    return alone.bits(data.data());
}

}  // namespace

/// Frames of canmatrix and of ours, out of the same file and the same raw values.
class tst_Canmatrix : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void testFileCoversAllSignalLayouts();
    void bytesMatchCanmatrix();
    void rawValuesMatchCanmatrix();
    void physicalValuesMatchCanmatrix();
    void encodedPhysicalValuesMatchCanmatrix();
    void framesOfANetworkMatchCanmatrix();

private:
    struct Frame
    {
        const DbcMessage *message = nullptr;
        QMap<QString, quint64> raw;  // as asked, as bits
        QByteArray bytes;            // of canmatrix
        QJsonObject rawAnswer;
        QJsonObject physical;
    };

    void ask(const QVector<RandomDbc::Message> &messages, RandomDbc *random);
    QByteArray question(const RandomDbc::Message &message, int page, RandomDbc *random, Frame *frame);
    bool answer(const QByteArray &questions);
    bool consult(const QString &file, const QByteArray &questions, int count, QList<QByteArray> *answers) const;
    void compareFrame(const DbcFile &file, quint32 id, const QByteArray &bytes, const QJsonObject &answer, int *values);

    QTemporaryDir m_folder;
    DbcFile m_file;
    QVector<Frame> m_frames;
    int m_values = 0;
};

void tst_Canmatrix::initTestCase()
{
    RandomDbc random(seed);
    const QVector<RandomDbc::Message> messages = random.messages(fewestSignals);
    const QByteArray text = RandomDbc::text(messages);
    QFile file(m_folder.filePath(QStringLiteral("random.dbc")));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text);
    file.close();
    QVector<QPlcParseError> errors;
    m_file = DbcFile::fromText(text, file.fileName(), &errors);
    QVERIFY2(errors.isEmpty(), qPrintable(QPlcParseError::toString(errors)));
    ask(messages, &random);
}

void tst_Canmatrix::ask(const QVector<RandomDbc::Message> &messages, RandomDbc *random)
{
    QByteArray questions;
    for (const RandomDbc::Message &message : messages) {
        for (int page = message.pages > 0 ? 0 : -1; page < message.pages; ++page) {
            Frame frame;
            frame.message = m_file.find(QString::fromLatin1(message.name));
            QVERIFY(frame.message);
            questions += question(message, page, random, &frame);
            m_frames.append(frame);
        }
    }
    if (!answer(questions))
        QSKIP("install python3-canmatrix: /usr/bin/python3 cannot import canmatrix");
}

// Random raw values for the signals of a page. Floats are small enough to be finite.
QByteArray tst_Canmatrix::question(const RandomDbc::Message &message, int page, RandomDbc *random, Frame *frame)
{
    QJsonObject raw;
    for (const RandomDbc::Signal &part : message.content) {
        if (part.page >= 0 && part.page != page)
            continue;
        const QString name = QString::fromLatin1(part.name);
        const DbcSignal &signal = *frame->message->find(name);
        const quint64 mask = ~quint64(0) >> (64 - part.length);
        const quint64 special[] = {0, mask, mask >> 1, (mask >> 1) + 1};
        quint64 bits = (random->below(8) == 0 ? special[random->below(4)] : random->bits()) & mask;
        if (part.isMultiplexor)
            bits = quint64(page);
        if (signal.isFloat()) {
            const double value = (double(qint64(random->bits())) / 3.0) * std::pow(10.0, random->below(40) - 30);
            bits = bitsOf(signal, value);
            DbcSignal alone = signal;
            alone.start = 0;
            alone.byteOrder = DbcSignal::Intel;
            alone.factor = 1.0;
            alone.offset = 0.0;
            std::array<quint8, 64> data{};
            alone.setBits(data.data(), bits);
            raw.insert(name, QStringLiteral("f%1").arg(alone.decode(data.data()), 0, 'g', 17));
        } else {
            const bool isNegative = part.isSigned && ((bits >> (part.length - 1)) & 1);
            raw.insert(name, isNegative ? QString::number(qint64(bits | ~mask)) : QString::number(bits));
        }
        frame->raw.insert(name, bits);
        ++m_values;
    }
    const QJsonObject object{{QStringLiteral("frame"), frame->message->name}, {QStringLiteral("raw"), raw}};
    return QJsonDocument(object).toJson(QJsonDocument::Compact) + '\n';
}

bool tst_Canmatrix::answer(const QByteArray &questions)
{
    QList<QByteArray> lines;
    if (!consult(QStringLiteral("random.dbc"), questions, m_frames.size(), &lines))
        return false;
    for (int i = 0; i < m_frames.size(); ++i) {
        const QJsonObject object = QJsonDocument::fromJson(lines.at(i)).object();
        m_frames[i].bytes = QByteArray::fromHex(object.value(QLatin1String("bytes")).toString().toLatin1());
        m_frames[i].rawAnswer = object.value(QLatin1String("raw")).toObject();
        m_frames[i].physical = object.value(QLatin1String("physical")).toObject();
    }
    return true;
}

// Returns false if there is no canmatrix.
bool tst_Canmatrix::consult(const QString &file, const QByteArray &questions, int count,
                            QList<QByteArray> *answers) const
{
    QProcess oracle;
    oracle.start(QStringLiteral("/usr/bin/python3"),
                 {QStringLiteral("-B"), QStringLiteral(CANMATRIX_ORACLE), m_folder.filePath(file)});
    if (!oracle.waitForStarted())
        return false;
    oracle.write(questions);
    oracle.closeWriteChannel();
    if (!oracle.waitForFinished(200000))
        qFatal("canmatrix takes more than 200 s");
    if (oracle.exitCode() == 77)
        return false;
    *answers = oracle.readAllStandardOutput().split('\n');
    if (oracle.exitCode() != 0 || answers->size() != count + 1)
        qFatal("canmatrix gave %d answers to %d questions, and exit code %d: %s", int(answers->size()) - 1, count,
               oracle.exitCode(), oracle.readAllStandardError().constData());
    return true;
}

void tst_Canmatrix::testFileCoversAllSignalLayouts()
{
    QVERIFY2(m_values >= fewestSignals, qPrintable(QString::number(m_values)));
    QSet<int> kinds;  // length and byte order
    int multiplexed = 0;
    int floats = 0;
    for (const DbcMessage &message : m_file.messages()) {
        QCOMPARE(message.unsupported, QString());
        for (const DbcSignal &signal : message.content) {
            kinds.insert(signal.length * 4 + signal.byteOrder * 2 + (signal.kind == DbcSignal::Signed ? 1 : 0));
            multiplexed += signal.isMultiplexed() ? 1 : 0;
            floats += signal.isFloat() ? 1 : 0;
        }
    }
    QCOMPARE(kinds.size(), 64 * 4);
    QVERIFY(multiplexed > 1000);
    QVERIFY(floats > 50);
    qInfo("%d values in %d frames", m_values, int(m_frames.size()));
}

void tst_Canmatrix::bytesMatchCanmatrix()
{
    for (const Frame &frame : qAsConst(m_frames)) {
        QByteArray data(frame.message->size, '\0');
        for (auto raw = frame.raw.cbegin(); raw != frame.raw.cend(); ++raw)
            frame.message->find(raw.key())->setBits(reinterpret_cast<quint8 *>(data.data()), raw.value());
        QVERIFY2(data == frame.bytes, qPrintable(frame.message->name));
    }
}

void tst_Canmatrix::rawValuesMatchCanmatrix()
{
    int count = 0;
    for (const Frame &frame : qAsConst(m_frames)) {
        const auto *data = reinterpret_cast<const quint8 *>(frame.bytes.constData());
        QCOMPARE(frame.rawAnswer.size(), frame.raw.size());
        for (auto raw = frame.rawAnswer.constBegin(); raw != frame.rawAnswer.constEnd(); ++raw, ++count) {
            const DbcSignal &signal = *frame.message->find(raw.key());
            const QString expected = raw.value().toString();
            if (signal.isFloat())
                QCOMPARE(signal.bits(data), bitsOf(signal, numberOf(expected.mid(1))));
            else if (signal.kind == DbcSignal::Signed)
                QCOMPARE(QString::number(signal.signedRaw(data)), expected);
            else
                QCOMPARE(QString::number(signal.bits(data)), expected);
        }
    }
    QCOMPARE(count, m_values);
}

// canmatrix computes with 28 decimal digits and rounds once; we round a factor, a product and a
// sum.
void tst_Canmatrix::physicalValuesMatchCanmatrix()
{
    constexpr double rounding = 3 * std::numeric_limits<double>::epsilon();
    for (const Frame &frame : qAsConst(m_frames)) {
        const auto *data = reinterpret_cast<const quint8 *>(frame.bytes.constData());
        for (auto value = frame.physical.constBegin(); value != frame.physical.constEnd(); ++value) {
            const DbcSignal &signal = *frame.message->find(value.key());
            const double expected = numberOf(value.value().toString());
            const double ours = signal.decode(data);
            const double largest = std::max(std::abs(expected), std::abs(signal.offset));
            QVERIFY2(std::abs(ours - expected) <= rounding * largest,
                     qPrintable(QStringLiteral("%1.%2: %3 instead of %4")
                                    .arg(frame.message->name, signal.name)
                                    .arg(ours, 0, 'g', 17)
                                    .arg(expected, 0, 'g', 17)));
        }
    }
}

// Raw values of more than 48 bits are not told by a double.
void tst_Canmatrix::encodedPhysicalValuesMatchCanmatrix()
{
    int count = 0;
    for (const Frame &frame : qAsConst(m_frames)) {
        const auto *data = reinterpret_cast<const quint8 *>(frame.bytes.constData());
        for (auto value = frame.physical.constBegin(); value != frame.physical.constEnd(); ++value) {
            const DbcSignal &signal = *frame.message->find(value.key());
            if (signal.length > 48)
                continue;
            if (signal.isFloat() && signal.factor != 1.0)
                continue;
            std::array<quint8, 64> encoded{};
            QCOMPARE(signal.encode(encoded.data(), numberOf(value.value().toString())), DbcSignal::Fits);
            if (!signal.isFloat())
                QCOMPARE(signal.bits(encoded.data()), signal.bits(data));
            ++count;
        }
    }
    QVERIFY2(count > fewestSignals / 2, qPrintable(QString::number(count)));
}

// Frames of random bytes and sources, of J1939 with extended multiplexing.
void tst_Canmatrix::framesOfANetworkMatchCanmatrix()
{
    constexpr int messageCount = 120;
    constexpr int framesOfEach = 30;
    RandomDbc random(seed + 1);
    const QByteArray text = RandomDbc::text(random.networkMessages(messageCount), true);
    QFile file(m_folder.filePath(QStringLiteral("network.dbc")));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text);
    file.close();
    QVector<QPlcParseError> errors;
    const DbcFile ours = DbcFile::fromText(text, file.fileName(), &errors);
    QVERIFY2(errors.isEmpty(), qPrintable(QPlcParseError::toString(errors)));
    QCOMPARE(ours.messages().size(), messageCount);

    QVector<QPair<quint32, QByteArray>> frames;
    QByteArray questions;
    for (const DbcMessage &message : ours.messages()) {
        QVERIFY2(message.isJ1939 && message.unsupported.isEmpty(), qPrintable(message.unsupported));
        for (int i = 0; i < framesOfEach; ++i) {
            const quint64 data = random.bits();
            const quint32 destination = CanFrame::isForOneNode(CanFrame::groupOf(message.id)) ? 0xFF00 : 0;
            const quint32 changed = 0x1C0000FF | destination;  // priority, source
            const quint32 id = (message.id & ~changed) | (quint32(random.bits()) & changed);
            const QByteArray bytes(reinterpret_cast<const char *>(&data), 8);
            frames.append({id, bytes});
            questions += "{\"id\": " + QByteArray::number(id) + ", \"bytes\": \"" + bytes.toHex() + "\"}\n";
        }
    }
    QList<QByteArray> answers;
    QVERIFY(consult(QStringLiteral("network.dbc"), questions, frames.size(), &answers));
    int values = 0;
    for (int i = 0; i < frames.size(); ++i)
        compareFrame(ours, frames.at(i).first, frames.at(i).second, QJsonDocument::fromJson(answers.at(i)).object(),
                     &values);
    QVERIFY2(values >= fewestSignals, qPrintable(QString::number(values)));
    qInfo("%d values in %d frames", values, int(frames.size()));
}

void tst_Canmatrix::compareFrame(const DbcFile &file, quint32 id, const QByteArray &bytes, const QJsonObject &answer,
                                 int *values)
{
    constexpr double rounding = 3 * std::numeric_limits<double>::epsilon();
    const auto *data = reinterpret_cast<const quint8 *>(bytes.constData());
    const auto isOfGroup
        = [id](const DbcMessage &message) { return CanFrame::groupOf(message.id) == CanFrame::groupOf(id); };
    const auto message = std::find_if(file.messages().cbegin(), file.messages().cend(), isOfGroup);
    QVERIFY(message != file.messages().cend());
    QCOMPARE(message->name, answer.value(QLatin1String("frame")).toString());
    const QJsonObject raw = answer.value(QLatin1String("raw")).toObject();
    const QJsonObject physical = answer.value(QLatin1String("physical")).toObject();
    for (const DbcSignal &signal : message->content) {
        const QString place = QStringLiteral("%1.%2 in %3").arg(message->name, signal.name, QString(bytes.toHex()));
        QVERIFY2(message->isThere(signal, data) == raw.contains(signal.name), qPrintable(place));
        if (!message->isThere(signal, data))
            continue;
        ++*values;
        const double expected = numberOf(physical.value(signal.name).toString());
        const double largest = std::max(std::abs(expected), std::abs(signal.offset));
        const double ours = signal.decode(data);
        QVERIFY2((std::isnan(ours) && std::isnan(expected)) || ours == expected
                     || std::abs(ours - expected) <= rounding * largest,
                 qPrintable(place));
        if (!signal.isFloat())
            QVERIFY2((signal.kind == DbcSignal::Signed ? QString::number(signal.signedRaw(data))
                                                       : QString::number(signal.bits(data)))
                         == raw.value(signal.name).toString(),
                     qPrintable(place));
    }
}

QTEST_GUILESS_MAIN(tst_Canmatrix)
#include "tst_Canmatrix.moc"
