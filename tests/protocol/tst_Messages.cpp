// SPDX-License-Identifier: Apache-2.0
#include "Vectors.h"
#include "protocol/messages/MessageTable.h"

#include <QtCore/QMetaEnum>
#include <QtTest/QtTest>

using namespace qplc::messages;

namespace {

/// Names of the fields that a struct describes.
template<typename Struct, typename Value>
void collect(const Field<Struct, Value> &field, QStringList *names)
{
    names->append(QLatin1String(field.name));
}

/// Those that transports add are known to them alone: tst_TransportRegistry looks for them.
template<typename Struct>
void collect(const Rest<Struct> &, QStringList *)
{
}

template<typename Message>
QStringList namesOf()
{
    QStringList names;
    Message::fields.forEach([&names](const auto &each) { collect(each, &names); });
    return names;
}

/// Calls \a visit with a default value of each message of a list.
template<typename Visit, typename... Messages>
void forEach(List<Messages...>, Visit &&visit)
{
    (visit(Messages()), ...);
}

/// Whether all of \a expected is in \a written, which may have more: the defaults of fields that
/// were missing.
bool isWithin(const QJsonValue &expected, const QJsonValue &written)
{
    if (expected.isArray()) {
        const QJsonArray wanted = expected.toArray();
        const QJsonArray there = written.toArray();
        return wanted.size() == there.size()
            && std::equal(wanted.begin(), wanted.end(), there.begin(),
                          [](const QJsonValue &a, const QJsonValue &b) { return isWithin(a, b); });
    }
    if (!expected.isObject())
        return expected == written;
    const QJsonObject wanted = expected.toObject();
    const QJsonObject there = written.toObject();
    const QStringList names = wanted.keys();
    return std::all_of(names.begin(), names.end(),
                       [&](const QString &name) { return isWithin(wanted.value(name), there.value(name)); });
}

/// Whether the fields that \a Message knows are the same after they were read and written.
template<typename Message>
bool comesBack(const QJsonObject &fields)
{
    Message message;
    QString error;
    if (!fromObject(fields, &message, &error))
        return false;
    const QJsonObject written = toObject(message);
    const QStringList names = namesOf<Message>();
    for (auto field = fields.begin(); field != fields.end(); ++field) {
        if (names.contains(field.key()) && !isWithin(field.value(), written.value(field.key())))
            return false;
    }
    return true;
}

template<typename... Messages>
bool comesBackAsOneOf(List<Messages...>, int kind, const QJsonObject &fields)
{
    return ((Messages::kind == kind && comesBack<Messages>(fields)) || ...);
}

/// The part of docs/protocol.md that says what the fields of messages are.
QString fieldsOfTheDocument()
{
    const QString text = QString::fromUtf8(vectors::document(QStringLiteral("protocol.md")));
    const int begin = text.indexOf(QStringLiteral("\n## 4. "));
    return text.mid(begin, text.indexOf(QStringLiteral("\n## 6. ")) - begin);
}

template<typename Message>
QString errorOf(const QJsonObject &fields)
{
    Message message;
    QString error;
    fromObject(fields, &message, &error);
    return error;
}

}  // namespace

class tst_Messages : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void everyKindHasAStruct();
    void everyVectorIsReproducedUnchanged_data();
    void everyVectorIsReproducedUnchanged();
    void theDocumentNamesEveryField();
    void documentListsEveryErrorWord();
    void invalidRequiredFieldsAreReported_data();
    void invalidRequiredFieldsAreReported();
    void stopWithAnInvalidFieldIsAccepted();
    void aFieldWithoutAValueIsNotSent();
    void unknownFieldsAreIgnored();
    void eachMessageGoesToItsHandler();
    void largestWholeNumbersSurviveTheRoundTrip();
};

void tst_Messages::everyKindHasAStruct()
{
    const QMetaEnum kinds = QMetaEnum::fromType<QPlcMessage::Kind>();
    for (int i = 0; i < kinds.keyCount(); ++i) {
        const auto kind = QPlcMessage::Kind(kinds.value(i));
        const bool isListed = FromClient::contains(kind) || FromMaster::contains(kind);
        QVERIFY2(isListed == (kind != QPlcMessage::Invalid), kinds.key(i));
    }
}

void tst_Messages::everyVectorIsReproducedUnchanged_data()
{
    QTest::addColumn<int>("kind");
    QTest::addColumn<QJsonObject>("fields");
    const QJsonArray good = vectors::file(QStringLiteral("control_frames.json"))[QStringLiteral("good")].toArray();
    for (const QJsonValue &vector : good) {
        const int kind = vector[QStringLiteral("kind")].toInt();
        if (isKind(quint8(kind)))
            QTest::newRow(qPrintable(vector[QStringLiteral("name")].toString()))
                << kind << vector[QStringLiteral("fields")].toObject();
    }
}

void tst_Messages::everyVectorIsReproducedUnchanged()
{
    QFETCH(int, kind);
    QFETCH(QJsonObject, fields);
    QVERIFY(comesBackAsOneOf(FromClient(), kind, fields) || comesBackAsOneOf(FromMaster(), kind, fields));
}

void tst_Messages::theDocumentNamesEveryField()
{
    const QString document = fieldsOfTheDocument();
    QVERIFY(document.size() > 10'000);
    int count = 0;
    const auto check = [&](const auto &message) {
        using Message = std::decay_t<decltype(message)>;
        for (const QString &name : namesOf<Message>()) {
            ++count;
            QVERIFY2(document.contains(QStringLiteral("`%1`").arg(name)),
                     qPrintable(QPlcMessage::kindName(Message::kind) + QLatin1Char('.') + name));
        }
    };
    forEach(FromClient(), check);
    forEach(FromMaster(), check);
    QVERIFY(count > 80);
}

void tst_Messages::documentListsEveryErrorWord()
{
    QStringList words;
    for (const QLatin1String &word : errorWord::all)
        words << word;
    const QString codes = fieldsOfTheDocument().section("### 5.5", 1).section("### 5.6", 0, 0);
    QStringList documented;
    QRegularExpressionMatchIterator rows
        = QRegularExpression("^\\| (`[^|]*) \\|", QRegularExpression::MultilineOption).globalMatch(codes);
    while (rows.hasNext())
        documented << rows.next().captured(1).remove('`').split(", ");
    words.sort();
    documented.sort();
    QCOMPARE(documented, words);
}

void tst_Messages::invalidRequiredFieldsAreReported_data()
{
    QTest::addColumn<QString>("error");
    QTest::addColumn<QString>("expected");
    QTest::newRow("missing") << errorOf<SetSignals>({}) << "field 'values' is missing or not of type object";
    QTest::newRow("another type") << errorOf<SetSignals>({{"values", 5}})
                                  << "field 'values' is missing or not of type object";
    QTest::newRow("a value of another type") << errorOf<SetSignals>({{"values", QJsonObject{{"a", 1}}}})
                                             << "field 'values' is missing or not of type object";
    QTest::newRow("too small") << errorOf<SetSignals>({{"values", QJsonObject()}, {"duration", 0}})
                               << "field 'duration' is 0; it has to be 1 ... 1000000000000000";
    QTest::newRow("no whole number") << errorOf<SetSignals>({{"values", QJsonObject()}, {"duration", 1.5}})
                                     << "field 'duration' is missing or not of type ns";
    QTest::newRow("no base64") << errorOf<InitializeWithValues>({{"values", "%%%"}})
                               << "field 'values' is missing or not of type base64";
    QTest::newRow("no hex64") << errorOf<AttachCyclicChannel>({{"node", 1}, {"token", "0x12"}})
                              << "field 'token' is missing or not of type hex64";
    QTest::newRow("beyond its type") << errorOf<AttachCyclicChannel>({{"node", 65536}, {"token", "0000000000000001"}})
                                     << "field 'node' is missing or not of type number";
    QTest::newRow("a word that is not known")
        << errorOf<RealTimeStarted>({{"clock", "Sundial"}}) << "field 'clock' is missing or not of type text";
    QTest::newRow("half a seal") << errorOf<Registered>({{"node", 1},
                                                         {"inputsHash", "0000000000000001"},
                                                         {"outputsHash", "0000000000000001"},
                                                         {"seal", QJsonObject{{"inputs", "AAAA"}}}})
                                 << "field 'seal' is missing or not of type object";
}

void tst_Messages::invalidRequiredFieldsAreReported()
{
    QFETCH(QString, error);
    QFETCH(QString, expected);
    QCOMPARE(error, expected);
}

void tst_Messages::stopWithAnInvalidFieldIsAccepted()
{
    Stop stop;
    QString error;
    QVERIFY(fromObject({{QStringLiteral("whoever"), 5}, {QStringLiteral("how"), QJsonArray()}}, &stop, &error));
    QCOMPARE(stop.whoever, QString());
}

void tst_Messages::aFieldWithoutAValueIsNotSent()
{
    QCOMPARE(toObject(Stop()), QJsonObject());
    QCOMPARE(toObject(GetSignals()), QJsonObject());
    QCOMPARE(toObject(StartRealTime()), QJsonObject());
    QCOMPARE(toObject(StatesInitialized{true, {}}), (QJsonObject{{QStringLiteral("ok"), true}}));
    QCOMPARE(toMessage(Arm()), QPlcMessage(QPlcMessage::Arm));
}

void tst_Messages::unknownFieldsAreIgnored()
{
    SafeStop message;
    QString error;
    QVERIFY(fromObject({{QStringLiteral("colour"), 7}, {QStringLiteral("reason"), QStringLiteral("ice")}}, &message,
                       &error));
    QCOMPARE(message.reason, QStringLiteral("ice"));
}

void tst_Messages::eachMessageGoesToItsHandler()
{
    QPlcMessage::Kind taken = QPlcMessage::Invalid;
    const auto remember = [&](const auto &message) { taken = std::decay_t<decltype(message)>::kind; };
    QString error;
    QCOMPARE(int(dispatch(FromClient(), QPlcMessage(QPlcMessage::GetState), remember, &error)),
             int(Dispatch::Delivered));
    QCOMPARE(taken, QPlcMessage::GetState);
    QCOMPARE(int(dispatch(FromClient(), QPlcMessage(QPlcMessage::State), remember, &error)), int(Dispatch::Unknown));
    QCOMPARE(int(dispatch(FromClient(), QPlcMessage(QPlcMessage::SetSignals), remember, &error)),
             int(Dispatch::Malformed));
    QCOMPARE(taken, QPlcMessage::GetState);
    QVERIFY(!error.isEmpty());
}

void tst_Messages::largestWholeNumbersSurviveTheRoundTrip()
{
    EventEntry event;
    event.sequence = 9007199254740992;  // 2^53
    event.time = ~0ULL;
    EventEntry back;
    QString error;
    QVERIFY(fromObject(toObject(event), &back, &error));
    QCOMPARE(back.sequence, event.sequence);
    QCOMPARE(quint64(back.time), quint64(event.time));
}

QTEST_APPLESS_MAIN(tst_Messages)
#include "tst_Messages.moc"
