// SPDX-License-Identifier: Apache-2.0
#include "protocol/ControlFrame.h"
#include "signals/JsonNames.h"

#include "Vectors.h"

#include <QtCore/QMetaEnum>
#include <QtTest/QtTest>

using namespace qplc;

Q_DECLARE_METATYPE(qplc::ControlFrameReader::Error)

class tst_ControlFrame : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void readerAcceptsTheValidVectors_data();
    void readerAcceptsTheValidVectors();
    void vectorsHaveEveryKind();
    void readerRefusesTheInvalidVectors_data();
    void readerRefusesTheInvalidVectors();
    void streamMayBeCutAtEveryByte();
    void streamMayArriveByteByByte();
    void incompleteMessageCausesNoError();
    void errorsNamePositionAndReason();
    void readerStopsAfterAnError();
    void readerAcceptsFramesUpToTheMaximumLength();
    void longerFramesAreForThoseWhoHaveAgreedOnThem();
    void longerFramesAreForKindsThatNeedThem();
    void encoderRefusesMessagesThatNoReceiverAccepts();
    void readerReturnsTheRestOfTheStream();
    void urgentMessageIsTakenBeforeTheOthers();
    void lookingAheadEndsWhereTheStreamIsBroken();
    void longMessageIsTakenUnread();
    void longMessageThatIsNoneIsAnErrorForItsReader();
    void longUrgentMessageDoesNotOvertake();
    void manyMessagesInOnePieceAreFast();
    void doubledNamesAreFoundWhateverIsBetween();
    void flippedBitsNeverCrash();
    void randomBytesNeverCrash();
};

static QJsonObject controlVectors()
{
    return vectors::file(QStringLiteral("control_frames.json"));
}

static QByteArray rawFrame(quint8 kind, const QByteArray &json)
{
    const quint32 length = quint32(json.size() + 1);
    QByteArray frame;
    for (int shift = 0; shift < 32; shift += 8)
        frame.append(char(length >> shift & 0xFF));
    return frame.append(char(kind)).append(json);
}

static QVector<QPlcMessage> takeAll(ControlFrameReader &reader)
{
    QVector<QPlcMessage> messages;
    QPlcMessage message;
    while (reader.next(&message))
        messages.append(message);
    return messages;
}

static QVector<QPlcMessage> threeMessages()
{
    return {QPlcMessage(QPlcMessage::Stop), QPlcMessage(QPlcMessage::StartRealTime, {{QStringLiteral("cycles"), 3}}),
            QPlcMessage(QPlcMessage::NodeFault, {{QStringLiteral("text"), QStringLiteral("\u00fcber \"3 m/s\"")}})};
}

static QByteArray stream(const QVector<QPlcMessage> &messages)
{
    QByteArray bytes;
    for (const QPlcMessage &message : messages)
        bytes += encodeControlFrame(message);
    return bytes;
}

void tst_ControlFrame::readerAcceptsTheValidVectors_data()
{
    QTest::addColumn<QJsonObject>("row");
    const QJsonArray rows = controlVectors()[QStringLiteral("good")].toArray();
    QVERIFY(!rows.isEmpty());
    for (const QJsonValue row : rows)
        QTest::newRow(qPrintable(row[QStringLiteral("name")].toString())) << row.toObject();
}

void tst_ControlFrame::readerAcceptsTheValidVectors()
{
    QFETCH(QJsonObject, row);
    const QByteArray frame = vectors::bytes(row[QStringLiteral("hex")]);
    ControlFrameReader reader;
    reader.append(frame);
    QPlcMessage message;
    QVERIFY2(reader.next(&message), qPrintable(reader.errorString()));
    QCOMPARE(int(message.kind()), row[QStringLiteral("kind")].toInt());
    QCOMPARE(message.kindName(), row[QStringLiteral("kindName")].toString());
    QCOMPARE(message.fields(), row[QStringLiteral("fields")].toObject());
    QCOMPARE(reader.lastFrame(), frame);
    QVERIFY(!reader.next(&message));
    QCOMPARE(reader.error(), ControlFrameReader::NoError);
    if (row[QStringLiteral("canonical")].toBool())
        QCOMPARE(encodeControlFrame(message).toHex(), frame.toHex());
}

void tst_ControlFrame::vectorsHaveEveryKind()
{
    QSet<int> kinds;
    for (const QJsonValue row : controlVectors()[QStringLiteral("good")].toArray())
        kinds.insert(row[QStringLiteral("kind")].toInt());
    const QMetaEnum all = QMetaEnum::fromType<QPlcMessage::Kind>();
    for (int i = 0; i < all.keyCount(); ++i)
        QVERIFY2(kinds.contains(all.value(i)) || all.value(i) == QPlcMessage::Invalid, all.key(i));
}

void tst_ControlFrame::readerRefusesTheInvalidVectors_data()
{
    QTest::addColumn<QByteArray>("frame");
    QTest::addColumn<ControlFrameReader::Error>("error");
    const QHash<QString, ControlFrameReader::Error> errors{
        {QStringLiteral("FrameTooLong"), ControlFrameReader::FrameTooLong},
        {QStringLiteral("FrameTooShort"), ControlFrameReader::FrameTooShort},
        {QStringLiteral("NestedTooDeep"), ControlFrameReader::NestedTooDeep},
        {QStringLiteral("InvalidJson"), ControlFrameReader::InvalidJson},
    };
    const QJsonArray rows = controlVectors()[QStringLiteral("bad")].toArray();
    QVERIFY(!rows.isEmpty());
    for (const QJsonValue row : rows) {
        QTest::newRow(qPrintable(row[QStringLiteral("name")].toString()))
            << vectors::bytes(row[QStringLiteral("hex")]) << errors.value(row[QStringLiteral("error")].toString());
    }
}

void tst_ControlFrame::readerRefusesTheInvalidVectors()
{
    QFETCH(QByteArray, frame);
    QFETCH(ControlFrameReader::Error, error);
    ControlFrameReader reader;
    reader.append(frame);
    QPlcMessage message(QPlcMessage::Done);
    QVERIFY(!reader.next(&message));
    QCOMPARE(reader.error(), error);
    QVERIFY(reader.errorString().contains(QLatin1String("at byte 0 of the stream")));
    QCOMPARE(message, QPlcMessage(QPlcMessage::Done));
    QVERIFY(reader.lastFrame().isEmpty());
}

void tst_ControlFrame::streamMayBeCutAtEveryByte()
{
    const QByteArray bytes = stream(threeMessages());
    for (int cut = 0; cut <= bytes.size(); ++cut) {
        ControlFrameReader reader;
        reader.append(bytes.left(cut));
        QVector<QPlcMessage> messages = takeAll(reader);
        reader.append(bytes.mid(cut));
        messages += takeAll(reader);
        QCOMPARE(messages, threeMessages());
        QCOMPARE(reader.error(), ControlFrameReader::NoError);
    }
}

void tst_ControlFrame::streamMayArriveByteByByte()
{
    ControlFrameReader reader;
    QVector<QPlcMessage> messages;
    for (const char byte : stream(threeMessages())) {
        reader.append(QByteArray(1, byte));
        messages += takeAll(reader);
    }
    QCOMPARE(messages, threeMessages());
}

void tst_ControlFrame::incompleteMessageCausesNoError()
{
    const QByteArray frame = encodeControlFrame(threeMessages().at(2));
    for (int size = 0; size < frame.size(); ++size) {
        ControlFrameReader reader;
        reader.append(frame.left(size));
        QVERIFY(takeAll(reader).isEmpty());
        QCOMPARE(reader.error(), ControlFrameReader::NoError);
    }
}

void tst_ControlFrame::errorsNamePositionAndReason()
{
    ControlFrameReader tooLong;
    tooLong.append(rawFrame(QPlcMessage::Stop, "{}") + QByteArray(4, '\xff'));
    QCOMPARE(takeAll(tooLong).size(), 1);
    QCOMPARE(tooLong.errorString(),
             QStringLiteral("control frame of 4294967295 bytes at byte 7 of the stream; at most 1048576 are allowed"));

    ControlFrameReader noObject;
    noObject.append(rawFrame(QPlcMessage::Stop, "[1]"));
    QVERIFY(takeAll(noObject).isEmpty());
    QCOMPARE(noObject.errorString(),
             QStringLiteral("control frame (Stop) at byte 0 of the stream: its JSON is an array; an object is needed"));

    ControlFrameReader noJson;
    noJson.append(rawFrame(QPlcMessage::Stop, "{\"a\":?}"));
    QVERIFY(takeAll(noJson).isEmpty());
    QVERIFY2(noJson.errorString().contains(QLatin1String("of its JSON")), qPrintable(noJson.errorString()));

    ControlFrameReader tooDeep;
    tooDeep.append(rawFrame(QPlcMessage::Stop, QByteArray(20, '[')));
    QVERIFY(takeAll(tooDeep).isEmpty());
    QCOMPARE(tooDeep.errorString(),
             QStringLiteral("control frame (Stop) at byte 0 of the stream: "
                            "arrays and objects 20 deep; at most 16 are allowed"));
}

void tst_ControlFrame::readerStopsAfterAnError()
{
    ControlFrameReader reader;
    reader.append(rawFrame(QPlcMessage::Stop, "?"));
    QVERIFY(takeAll(reader).isEmpty());
    const QString first = reader.errorString();
    reader.append(stream(threeMessages()));
    QVERIFY(takeAll(reader).isEmpty());
    QCOMPARE(reader.error(), ControlFrameReader::InvalidJson);
    QCOMPARE(reader.errorString(), first);
    QCOMPARE(reader.takeRest(), rawFrame(QPlcMessage::Stop, "?"));  // and nothing has been collected
}

void tst_ControlFrame::readerAcceptsFramesUpToTheMaximumLength()
{
    const int room = int(UsualControlFrame) - 1 - int(qstrlen("{\"text\":\"\"}"));
    const QPlcMessage longest(QPlcMessage::NodeFault, {{QStringLiteral("text"), QString(room, QLatin1Char('x'))}});
    const QByteArray frame = encodeControlFrame(longest);
    QCOMPARE(quint32(frame.size()), UsualControlFrame + 4);
    ControlFrameReader reader;
    reader.append(frame.left(frame.size() - 1));
    QVERIFY(takeAll(reader).isEmpty());
    reader.append(frame.right(1));
    QCOMPARE(takeAll(reader), QVector<QPlcMessage>{longest});
}

void tst_ControlFrame::longerFramesAreForThoseWhoHaveAgreedOnThem()
{
    const int size = 3 * int(UsualControlFrame);
    const QPlcMessage large(QPlcMessage::Hello, {{QStringLiteral("table"), QString(size, QLatin1Char('x'))}});
    QVERIFY(encodeControlFrame(large).isEmpty());
    const QByteArray frame = encodeControlFrame(large, MaximumControlFrame);
    QVERIFY(frame.size() > size);
    ControlFrameReader usual;
    usual.append(frame);
    QVERIFY(takeAll(usual).isEmpty());
    QCOMPARE(usual.error(), ControlFrameReader::FrameTooLong);
    ControlFrameReader other;
    other.setLimit(MaximumControlFrame);
    other.append(frame);
    QCOMPARE(takeAll(other), QVector<QPlcMessage>{large});
}

void tst_ControlFrame::longerFramesAreForKindsThatNeedThem()
{
    const auto mayBeLong = [](QPlcMessage::Kind kind) { return kind == QPlcMessage::Register; };
    for (const QPlcMessage::Kind kind : {QPlcMessage::Register, QPlcMessage::GetState}) {
        const QPlcMessage large(kind, {{QStringLiteral("x"), QString(int(UsualControlFrame), QLatin1Char('x'))}});
        const QByteArray frame = encodeControlFrame(large, MaximumControlFrame);
        ControlFrameReader reader;
        reader.setLimit(MaximumControlFrame);
        reader.setLongKinds(mayBeLong);
        QCOMPARE(reader.announced(), quint32(0));
        reader.append(frame.left(4));  // the kind is not known yet
        QVERIFY(takeAll(reader).isEmpty());
        QCOMPARE(reader.error(), ControlFrameReader::NoError);
        QCOMPARE(reader.announced(), quint32(frame.size() - 4));
        reader.append(frame.mid(4, 1));
        QVERIFY(takeAll(reader).isEmpty());
        const bool isRefused = reader.error() == ControlFrameReader::FrameTooLong;
        QCOMPARE(isRefused, kind == QPlcMessage::GetState);
        reader.append(frame.mid(5));
        QCOMPARE(takeAll(reader).size(), isRefused ? 0 : 1);
    }
}

void tst_ControlFrame::encoderRefusesMessagesThatNoReceiverAccepts()
{
    const int room = int(UsualControlFrame) - 1 - int(qstrlen("{\"text\":\"\"}"));
    const QString text(room + 1, QLatin1Char('x'));
    QVERIFY(encodeControlFrame(QPlcMessage(QPlcMessage::NodeFault, {{QStringLiteral("text"), text}})).isEmpty());

    QJsonValue nested(1);
    for (int depth = 1; depth < MaximumControlDepth; ++depth)
        nested = QJsonArray{nested};
    const QJsonObject deepest{{QStringLiteral("a"), nested}};
    QVERIFY(!encodeControlFrame(QPlcMessage(QPlcMessage::Stop, deepest)).isEmpty());
    QVERIFY(encodeControlFrame(QPlcMessage(QPlcMessage::Stop, {{QStringLiteral("a"), deepest}})).isEmpty());
}

void tst_ControlFrame::readerReturnsTheRestOfTheStream()
{
    const QByteArray cyclic("\x11\x00\x97\xb0 begin of a cyclic frame", 29);
    const QPlcMessage attached(QPlcMessage::CyclicChannelAttached);
    ControlFrameReader reader;
    QVERIFY(reader.takeRest().isEmpty());
    reader.append(encodeControlFrame(attached) + cyclic);
    QPlcMessage message;
    QVERIFY(reader.next(&message));
    QCOMPARE(message, attached);
    QCOMPARE(reader.takeRest(), cyclic);
    QVERIFY(reader.takeRest().isEmpty());
}

namespace {

bool isStop(QPlcMessage::Kind kind)
{
    return kind == QPlcMessage::Stop;
}

}  // namespace

void tst_ControlFrame::urgentMessageIsTakenBeforeTheOthers()
{
    const QPlcMessage question(QPlcMessage::GetState);
    const QPlcMessage stop(QPlcMessage::Stop, {{QStringLiteral("how"), QStringLiteral("a button")}});
    const QByteArray bytes = stream({question, question, stop, question, stop, question});
    ControlFrameReader reader;
    QPlcMessage message;
    QVERIFY(!reader.takeAhead(&isStop, &message));
    reader.append(bytes.left(bytes.size() / 2));
    QVERIFY(reader.next(&message) && !reader.isOvertaken());
    while (reader.takeAhead(&isStop, &message))
        QCOMPARE(message, stop);
    reader.append(bytes.mid(bytes.size() / 2));
    while (reader.takeAhead(&isStop, &message))
        QCOMPARE(message, stop);
    QVERIFY(!reader.takeAhead(&isStop, &message));
    QVector<bool> taken;
    QVector<bool> overtaken;
    while (reader.next(&message)) {
        QCOMPARE(message.kind() == QPlcMessage::Stop, reader.wasTakenAhead());
        taken << reader.wasTakenAhead();
        overtaken << reader.isOvertaken();
    }
    QCOMPARE(taken, (QVector<bool>{false, true, false, true, false}));
    QCOMPARE(overtaken, (QVector<bool>{true, true, true, false, false}));
    QCOMPARE(reader.error(), ControlFrameReader::NoError);
}

void tst_ControlFrame::lookingAheadEndsWhereTheStreamIsBroken()
{
    const QByteArray stop = encodeControlFrame(QPlcMessage(QPlcMessage::Stop));
    QPlcMessage message;
    ControlFrameReader tooLong;
    tooLong.append(QByteArray("\xff\xff\xff\xff", 4) + stop);
    QVERIFY(!tooLong.takeAhead(&isStop, &message));
    ControlFrameReader incomplete;
    incomplete.append(stop.left(stop.size() - 1));
    QVERIFY(!incomplete.takeAhead(&isStop, &message));
    incomplete.append(stop.right(1));
    QVERIFY(incomplete.takeAhead(&isStop, &message));
    ControlFrameReader broken;
    broken.append(rawFrame(QPlcMessage::Stop, "?") + stop);
    QVERIFY(!broken.takeAhead(&isStop, &message));
    QCOMPARE(broken.error(), ControlFrameReader::InvalidJson);
}

void tst_ControlFrame::longMessageIsTakenUnread()
{
    const QPlcMessage brief(QPlcMessage::GetState);
    const QPlcMessage large(QPlcMessage::SetSignals,
                            {{QStringLiteral("x"), QString(int(ControlFrameReader::ReadAtOnce), QLatin1Char('x'))}});
    for (const bool isAlone : {true, false}) {
        const QByteArray bytes = isAlone ? stream({large}) : stream({brief, large, brief});
        ControlFrameReader reader;
        UnreadControlFrame frame;
        QPlcMessage message;
        reader.append(bytes.left(1000));
        QVERIFY(!reader.takeLong(&frame));  // in front of it stands a brief one, or it is not there yet
        QCOMPARE(reader.next(&message), !isAlone);
        QVERIFY(!reader.takeLong(&frame));
        reader.append(bytes.mid(1000));
        QVERIFY(reader.takeLong(&frame));
        QCOMPARE(frame.kind(), QPlcMessage::SetSignals);
        QString text;
        QCOMPARE(ControlFrameReader::read(frame, &message, &text), ControlFrameReader::NoError);
        QCOMPARE(message, large);
        QVERIFY(!reader.takeLong(&frame));
        QCOMPARE(reader.next(&message), !isAlone);
        QCOMPARE(reader.waiting(), 0);
        reader.append(stream({brief}));
        QVERIFY(reader.next(&message));
        QCOMPARE(message, brief);
        QCOMPARE(reader.error(), ControlFrameReader::NoError);
    }
}

void tst_ControlFrame::longMessageThatIsNoneIsAnErrorForItsReader()
{
    ControlFrameReader reader;
    reader.append(stream({QPlcMessage(QPlcMessage::GetState)}));
    reader.append(rawFrame(QPlcMessage::Register, QByteArray(int(ControlFrameReader::ReadAtOnce), 'x')));
    UnreadControlFrame frame;
    QPlcMessage message;
    QVERIFY(reader.next(&message));
    QVERIFY(reader.takeLong(&frame));
    QCOMPARE(reader.error(), ControlFrameReader::NoError);
    QString text;
    const ControlFrameReader::Error error = ControlFrameReader::read(frame, &message, &text);
    QCOMPARE(error, ControlFrameReader::InvalidJson);
    QVERIFY2(text.contains(QStringLiteral("control frame (Register) at byte 7 of the stream")), qPrintable(text));
    reader.fail(error, text);
    reader.append(stream({QPlcMessage(QPlcMessage::GetState)}));
    QVERIFY(!reader.next(&message));
    QCOMPARE(reader.errorString(), text);
}

void tst_ControlFrame::longUrgentMessageDoesNotOvertake()
{
    const QPlcMessage stop(QPlcMessage::Stop, {{QStringLiteral("how"), QStringLiteral("a button")}});
    const QPlcMessage longStop(
        QPlcMessage::Stop, {{QStringLiteral("how"), QString(int(ControlFrameReader::ReadAtOnce), QLatin1Char('x'))}});
    ControlFrameReader reader;
    reader.append(stream({QPlcMessage(QPlcMessage::GetState), longStop, stop}));
    QPlcMessage message;
    QVERIFY(reader.takeAhead(&isStop, &message));
    QCOMPARE(message, stop);
    QVERIFY(!reader.takeAhead(&isStop, &message));
    UnreadControlFrame frame;
    QVERIFY(reader.next(&message));
    QVERIFY(reader.takeLong(&frame));
    QVERIFY(!reader.wasTakenAhead() && reader.isOvertaken());
    QVERIFY(reader.next(&message));
    QVERIFY(reader.wasTakenAhead());
}

void tst_ControlFrame::manyMessagesInOnePieceAreFast()
{
    const int count = 200000;  // moving the rest of the stream for each would take minutes
    ControlFrameReader reader;
    reader.append(rawFrame(QPlcMessage::Stop, QByteArray()).repeated(count));
    QCOMPARE(takeAll(reader).size(), count);
}

void tst_ControlFrame::doubledNamesAreFoundWhateverIsBetween()
{
    for (const char *space : {"", " ", "\t", "\n", "\r", " \n\t\r "}) {
        const QByteArray name = QByteArray("\"a\"") + space + ":" + space + "1";
        QCOMPARE(qplc::doubledJsonName("{" + name + "," + space + name + "}"), std::make_optional(QString("a")));
        QCOMPARE(qplc::doubledJsonName("{" + name + "}"), std::nullopt);
    }
}

void tst_ControlFrame::flippedBitsNeverCrash()
{
    const QByteArray good = stream(threeMessages());
    for (int bit = 0; bit < good.size() * 8; ++bit) {
        QByteArray bytes = good;
        bytes[bit / 8] = char(bytes.at(bit / 8) ^ (1 << bit % 8));
        ControlFrameReader reader;
        reader.append(bytes);
        QVERIFY(takeAll(reader).size() <= 3);
        QCOMPARE(reader.error() == ControlFrameReader::NoError, reader.errorString().isEmpty());
    }
}

void tst_ControlFrame::randomBytesNeverCrash()
{
    std::mt19937 random(3);
    for (int round = 0; round < 20000; ++round) {
        // Half of the rounds are random JSON behind a right length, made of the characters that
        // matter.
        QByteArray bytes = vectors::randomBytes(random, int(random() % 60));
        if (round % 2 != 0) {
            for (char &byte : bytes)
                byte = "{}[]\",:\\0e-u \xc3\xed\xff"[quint8(byte) % 16];
            bytes = rawFrame(quint8(random()), bytes);
        }
        ControlFrameReader reader;
        reader.append(bytes);
        takeAll(reader);
        QCOMPARE(reader.error() == ControlFrameReader::NoError, reader.errorString().isEmpty());
    }
}

QTEST_APPLESS_MAIN(tst_ControlFrame)
#include "tst_ControlFrame.moc"
