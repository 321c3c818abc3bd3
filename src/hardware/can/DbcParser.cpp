// SPDX-License-Identifier: Apache-2.0
#include "DbcParser.h"

#include "CanFrame.h"
#include "DbcReader.h"

#include <QtCore/QHash>

#include <algorithm>
#include <cmath>
#include <limits>

namespace qplc {

namespace {

constexpr quint64 extendedIdBit = 0x80000000;
constexpr quint64 noMessage = 0xC0000000;  // holds the signals that are in no message
constexpr const char *startValueText = "the raw value of the signal before anybody has written it";
constexpr double unsaidStart = std::numeric_limits<double>::quiet_NaN();

QString idText(quint64 id)
{
    return QStringLiteral("0x%1").arg(id & ~extendedIdBit, 0, 16);
}

// Values of VFrameFormat: a word, or its number.
bool isJ1939Format(const QString &value)
{
    return value == QLatin1String("J1939PG") || value == QLatin1String("3");
}

bool isFdFormat(const QString &value)
{
    return value.endsWith(QLatin1String("_FD")) || value == QLatin1String("14") || value == QLatin1String("15");
}

/// Reads the statements of a DBC file into messages.
class DbcParser
{
public:
    DbcParser(const QString &text, const QString &fileName)
        : m_reader(text, fileName)
    {
    }

    /// The whole file. \return empty when there are errors()
    QVector<DbcMessage> parse()
    {
        while (!m_reader.atEnd() && m_reader.errors().size() < DbcFile::MaximumErrors) {
            const DbcToken token = m_reader.next();
            const Statement statement = token.kind == DbcToken::Word ? statementOf(token.text) : nullptr;
            const int before = m_reader.errors().size();
            if (statement)
                (this->*statement)();
            else
                m_reader.fail(token,
                              QStringLiteral(
                                  "%1 does not begin a statement of a DBC file; the file is damaged, or not a DBC file")
                                  .arg(token.shown()));
            if (m_reader.errors().size() != before)
                m_reader.skipToLine(isKeyword);
            m_reader.resume();
        }
        if (m_reader.errors().isEmpty())
            finish();
        return m_reader.errors().isEmpty() ? m_messages : QVector<DbcMessage>();
    }

    QVector<QPlcParseError> errors() const { return m_reader.errors(); }

private:
    using Statement = void (DbcParser::*)();
    struct Attribute
    {
        int message = -1;  // index
        QString name;
        DbcToken value;
    };

    static Statement statementOf(const QString &keyword)
    {
        static const QHash<QString, Statement> statements{
            {QStringLiteral("BO_"), &DbcParser::message},
            {QStringLiteral("SG_"), &DbcParser::signal},
            {QStringLiteral("VAL_"), &DbcParser::valueNames},
            {QStringLiteral("SIG_VALTYPE_"), &DbcParser::floatKind},
            {QStringLiteral("SG_MUL_VAL_"), &DbcParser::extendedMultiplexing},
            {QStringLiteral("BA_"), &DbcParser::attribute},
            {QStringLiteral("BA_DEF_DEF_"), &DbcParser::attributeDefault},
            {QStringLiteral("NS_"), &DbcParser::newSymbols},
            {QStringLiteral("VERSION"), &DbcParser::skipLines},
            {QStringLiteral("BS_"), &DbcParser::skipLines},
            {QStringLiteral("BU_"), &DbcParser::skipLines},
            {QStringLiteral("VAL_TABLE_"), &DbcParser::skip},
            {QStringLiteral("CM_"), &DbcParser::skip},
            {QStringLiteral("BO_TX_BU_"), &DbcParser::skip},
            {QStringLiteral("EV_"), &DbcParser::skip},
            {QStringLiteral("ENVVAR_DATA_"), &DbcParser::skip},
            {QStringLiteral("EV_DATA_"), &DbcParser::skip},
            {QStringLiteral("BA_DEF_"), &DbcParser::skip},
            {QStringLiteral("BA_DEF_REL_"), &DbcParser::skip},
            {QStringLiteral("BA_DEF_DEF_REL_"), &DbcParser::skip},
            {QStringLiteral("BA_REL_"), &DbcParser::skip},
            {QStringLiteral("BA_DEF_SGTYPE_"), &DbcParser::skip},
            {QStringLiteral("BA_SGTYPE_"), &DbcParser::skip},
            {QStringLiteral("BU_SG_REL_"), &DbcParser::skip},
            {QStringLiteral("BU_EV_REL_"), &DbcParser::skip},
            {QStringLiteral("BU_BO_REL_"), &DbcParser::skip},
            {QStringLiteral("SGTYPE_"), &DbcParser::skip},
            {QStringLiteral("SGTYPE_VAL_"), &DbcParser::skip},
            {QStringLiteral("SIGTYPE_VALTYPE_"), &DbcParser::skip},
            {QStringLiteral("SIG_TYPE_REF_"), &DbcParser::skip},
            {QStringLiteral("SIG_GROUP_"), &DbcParser::skip},
            {QStringLiteral("CAT_DEF_"), &DbcParser::skip},
            {QStringLiteral("CAT_"), &DbcParser::skip},
            {QStringLiteral("FILTER"), &DbcParser::skip},
        };
        return statements.value(keyword, nullptr);
    }

    static bool isKeyword(const QString &word) { return statementOf(word) != nullptr; }

    void skip() { m_reader.skipStatement(); }
    // A statement without an end of its own goes on until a line begins with the next one.
    void skipLines() { m_reader.skipToLine(isKeyword); }

    // The list of keywords: each of them stands alone in its line.
    void newSymbols()
    {
        m_reader.takes(':');
        while (m_reader.peek().kind == DbcToken::Word && !m_reader.peek().isWord("BS_")
               && !m_reader.peek().isWord("BU_") && !m_reader.peek().isWord("BO_"))
            m_reader.next();
    }

    void message()
    {
        DbcMessage message;
        m_current = -1;
        QString sender;
        const DbcToken at = m_reader.peek();
        if (readId(&message) && m_reader.expectWord(&message.name, "the name of the message")
            && m_reader.expectSign(':', "':' behind the name of the message") && readSize(&message)
            && m_reader.expectWord(&sender, "the sender of the message (Vector__XXX if it has none)") && !m_isSkipped)
            addMessage(at, message);
    }

    void signal()
    {
        DbcSignal signal;
        signal.initial = unsaidStart;
        const DbcToken at = m_reader.peek();
        if (m_current < 0 && !m_isSkipped) {
            m_reader.fail(at, QStringLiteral("SG_ %1 belongs to no message; put it behind a line BO_").arg(at.shown()));
            return;
        }
        if (!m_reader.expectWord(&signal.name, "the name of the signal") || !m_reader.expectRole(&signal)
            || !m_reader.expectSign(':', "':' behind the name of the signal") || !m_reader.expectPlace(&signal))
            return;
        if (!m_isSkipped)
            addSignal(at, signal);
        m_reader.skipToLine(isKeyword);  // behind its receivers
    }

    // VAL_ id signal 0 "off" 1 "on" ; or VAL_ variable ...
    void valueNames()
    {
        DbcSignal *signal = m_reader.peek().kind == DbcToken::Number ? expectSignal(expectMessage()) : nullptr;
        while (signal && m_reader.peek().kind == DbcToken::Number) {
            double value = 0.0;
            QString name;
            if (!m_reader.expectNumber(&value, "a value") || !m_reader.expectText(&name, "the name of the value"))
                return;
            if (std::abs(value) < 9e18)
                signal->valueNames.insert(static_cast<qint64>(value), name);
        }
        if (!signal)
            m_reader.skipStatement();
        else
            m_reader.expectSign(';', "a value with its name, or ';'");
    }

    // SIG_VALTYPE_ id signal : 1;
    void floatKind()
    {
        DbcMessage *message = expectMessage();
        const DbcToken at = m_reader.peek();
        DbcSignal *signal = expectSignal(message);
        qint64 kind = 0;
        m_reader.takes(':');
        if (signal && m_reader.expectInteger(&kind, 0, 3, "0 (integer), 1 (float) or 2 (double)")) {
            if ((kind == 1 && signal->length != 32) || (kind == 2 && signal->length != 64) || kind == 3)
                m_reader.fail(at,
                              QStringLiteral("signal '%1' has %2 bits; a float has 32 and a double 64")
                                  .arg(signal->name)
                                  .arg(signal->length));
            else if (kind != 0)
                signal->kind = kind == 1 ? DbcSignal::Float32 : DbcSignal::Float64;
        }
        m_reader.skipStatement();
    }

    // SG_MUL_VAL_ id signal multiplexor 3-3, 5-7;
    void extendedMultiplexing()
    {
        DbcMessage *message = expectMessage();
        DbcSignal *signal = expectSignal(message);
        const DbcToken at = m_reader.peek();
        const DbcSignal *multiplexor = signal ? expectSignal(message) : nullptr;
        QVector<DbcSignal::Range> pages;
        if (multiplexor && m_reader.expectPages(&pages)) {
            if (!multiplexor->isMultiplexor)
                m_reader.fail(at,
                              QStringLiteral("signal '%1' of message '%2' is not a multiplexor (M)")
                                  .arg(multiplexor->name, message->name));
            signal->multiplexor = int(multiplexor - message->content.constData());
            signal->pages = pages;
        }
        m_reader.skipStatement();
    }

    // BA_ "GenMsgCycleTime" BO_ id value; and the others, of which some are taken.
    void attribute()
    {
        QString name;
        if (!m_reader.expectText(&name, "the name of an attribute"))
            return;
        const bool isOfMessage = m_reader.peek().isWord("BO_");
        const bool isOfSignal = m_reader.peek().isWord("SG_");
        if (name == QLatin1String("ProtocolType"))
            m_isJ1939 = m_reader.peek().text == QLatin1String("J1939");
        if (isOfMessage || isOfSignal) {
            m_reader.next();
            DbcMessage *message = expectMessage();
            DbcSignal *signal = isOfSignal ? expectSignal(message) : nullptr;
            if (signal && name == QLatin1String("GenSigStartValue") && m_reader.peek().kind == DbcToken::Number)
                m_reader.expectNumber(&signal->initial, startValueText);
            else if (message && isOfMessage)
                m_attributes.append({int(message - m_messages.constData()), name, m_reader.peek()});
        }
        m_reader.skipStatement();
    }

    void attributeDefault()
    {
        QString name;
        if (!m_reader.expectText(&name, "the name of an attribute"))
            return;
        if (name == QLatin1String("GenSigStartValue") && m_reader.peek().kind == DbcToken::Number)
            m_reader.expectNumber(&m_startValue, startValueText);
        else
            m_defaults.append({-1, name, m_reader.peek()});
        m_reader.skipStatement();
    }

    bool readId(DbcMessage *message)
    {
        const DbcToken at = m_reader.peek();
        quint64 id = 0;
        if (!m_reader.expectUnsigned(&id, "the id of the message, a decimal number"))
            return false;
        m_isSkipped = id == noMessage;
        message->isExtended = (id & extendedIdBit) != 0;
        message->id = quint32(id & ~extendedIdBit);
        if (m_isSkipped || id <= 0x7FF || (message->isExtended && id - extendedIdBit <= 0x1FFFFFFF))
            return true;
        return m_reader.fail(
            at,
            QStringLiteral("the id %1 is not valid on a CAN bus; use 0 ... 2047, or 2147483648 + an extended "
                           "id of 0 ... 536870911")
                .arg(at.text));
    }

    bool readSize(DbcMessage *message)
    {
        qint64 size = 0;
        if (!m_reader.expectInteger(&size, 0, 65535, "the size of the message in bytes"))
            return false;
        message->size = int(size);
        return true;
    }

    bool addMessage(const DbcToken &at, const DbcMessage &message)
    {
        const quint64 key = message.id | (message.isExtended ? extendedIdBit : 0);
        if (m_indexOfId.contains(key))
            return m_reader.fail(at,
                                 QStringLiteral("message '%1' has the id %2 of message '%3'; give each its own")
                                     .arg(message.name, idText(key), m_messages.at(m_indexOfId.value(key)).name));
        if (m_indexOfName.contains(message.name))
            return m_reader.fail(
                at, QStringLiteral("there are two messages '%1'; give each its own name").arg(message.name));
        if (m_messages.size() == DbcFile::MaximumMessages)
            return m_reader.fail(at,
                                 QStringLiteral("there are more than %1 messages; remove those that you do not need")
                                     .arg(DbcFile::MaximumMessages));
        m_current = m_messages.size();
        m_indexOfId.insert(key, m_current);
        m_indexOfName.insert(message.name, m_current);
        m_messages.append(message);
        return true;
    }

    bool addSignal(const DbcToken &at, const DbcSignal &signal)
    {
        DbcMessage &message = m_messages[m_current];
        if (++m_signalCount > DbcFile::MaximumSignals)
            return m_reader.fail(
                at,
                QStringLiteral("there are more than %1 signals; remove the messages that you do not need")
                    .arg(DbcFile::MaximumSignals));
        const QString problem = DbcFile::problemOf(message, signal);
        if (!problem.isEmpty())
            return m_reader.fail(at, problem);
        message.content.append(signal);
        return true;
    }

    // The id of a message that there is. Null, without an error, for one that is no message.
    DbcMessage *expectMessage()
    {
        const DbcToken at = m_reader.peek();
        quint64 id = 0;
        if (!m_reader.expectUnsigned(&id, "the id of a message") || id == noMessage)
            return nullptr;
        const int index = m_indexOfId.value(id, -1);
        if (index < 0)
            m_reader.fail(at, QStringLiteral("there is no message with the id %1").arg(at.text));
        return index < 0 ? nullptr : &m_messages[index];
    }

    DbcSignal *expectSignal(DbcMessage *message)
    {
        const DbcToken at = m_reader.peek();
        QString name;
        if (!message || !m_reader.expectWord(&name, "the name of a signal"))
            return nullptr;
        for (DbcSignal &signal : message->content) {
            if (signal.name == name)
                return &signal;
        }
        m_reader.fail(at, QStringLiteral("message '%1' has no signal '%2'").arg(message->name, name));
        return nullptr;
    }

    void setAttribute(DbcMessage *message, const Attribute &attribute)
    {
        const DbcToken &value = attribute.value;
        const bool isCycleTime = attribute.name == QLatin1String("GenMsgCycleTime");
        if (isCycleTime || attribute.name == QLatin1String("GenMsgDelayTime")) {
            bool isNumber = false;
            const double time = value.text.toDouble(&isNumber);  // [ms]
            if (!isNumber || !(time >= 0.0 && time <= 1e9))
                m_reader.fail(value,
                              QStringLiteral("the %1 %2 of message '%3' is not a number of milliseconds")
                                  .arg(isCycleTime ? QStringLiteral("cycle time") : QStringLiteral("delay time"),
                                       value.shown(), message->name));
            else
                (isCycleTime ? message->cycleTime : message->delayTime)
                    = std::chrono::nanoseconds(static_cast<qint64>(time * 1e6));
        } else if (attribute.name == QLatin1String("VFrameFormat")) {
            message->isFd = isFdFormat(value.text);
            message->isJ1939 = message->isExtended && isJ1939Format(value.text);
        } else if (attribute.name == QLatin1String("CANFD_BRS"))
            message->hasBitRateSwitch = value.text != QLatin1String("0");
    }

    // What can be said only when everything is read.
    void finish()
    {
        for (DbcMessage &message : m_messages)
            message.isJ1939 = m_isJ1939 && message.isExtended;
        for (const Attribute &attribute : qAsConst(m_defaults)) {
            for (DbcMessage &message : m_messages)
                setAttribute(&message, attribute);
        }
        for (DbcMessage &message : m_messages) {
            for (DbcSignal &signal : message.content)
                signal.initial = std::isnan(signal.initial) ? m_startValue : signal.initial;
        }
        for (const Attribute &attribute : qAsConst(m_attributes))
            setAttribute(&m_messages[attribute.message], attribute);
        for (DbcMessage &message : m_messages) {
            message.isFd = !message.isJ1939 && (message.isFd || message.size > 8);
            message.unsupported = message.connectMultiplexors();
            const QString problem = DbcFile::sizeProblemOf(message);
            if (!problem.isEmpty())
                message.unsupported = problem;
        }
    }

    DbcReader m_reader;
    QVector<DbcMessage> m_messages;
    QHash<quint64, int> m_indexOfId;
    QHash<QString, int> m_indexOfName;
    QVector<Attribute> m_defaults;
    QVector<Attribute> m_attributes;  // of messages
    double m_startValue = 0.0;        // raw, of signals that have none of their own
    int m_signalCount = 0;
    int m_current = -1;        // the message that SG_ belongs to; -1: none
    bool m_isJ1939 = false;    // the whole network, as far as messages do not say something else
    bool m_isSkipped = false;  // SG_ belongs to a message that is no message
};

}  // namespace

QVector<DbcMessage> parseDbc(const QString &text, const QString &fileName, QVector<QPlcParseError> *errors)
{
    DbcParser parser(text, fileName);
    const QVector<DbcMessage> messages = parser.parse();
    *errors = parser.errors();
    return messages;
}

}  // namespace qplc
