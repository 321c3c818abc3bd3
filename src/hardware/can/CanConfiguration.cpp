// SPDX-License-Identifier: Apache-2.0
#include "CanConfiguration.h"

#include "CanBus.h"
#include "QPlcDriverSettings.h"
#include "signals/DurationText.h"
#include "signals/MessageText.h"

#include <QtCore/QDir>
#include <QtCore/QHash>
#include <QtCore/QRegularExpression>
#include <QtCore/QSet>

#include <algorithm>

namespace qplc {

namespace {

using namespace std::chrono_literals;

constexpr std::chrono::hours longestCanTime{24};

// "every 10 ms"
bool readCanPeriod(const QString &word, std::chrono::nanoseconds *period)
{
    static const QRegularExpression pattern(QStringLiteral("^every ([0-9]+(?:\\.[0-9]+)? ?(?:us|ms|s))$"));
    const QRegularExpressionMatch match = pattern.match(word);
    double time = 0.0;  // [ns]
    if (!durationFromText(match.captured(1), &time) || !(time >= 1e5 && time <= 1e12))
        return false;
    *period = std::chrono::nanoseconds(static_cast<qint64>(time));
    return true;
}

bool readCanRule(const QStringList &words, CanSendRule *rule)
{
    const QLatin1String atMost("at most ");
    for (const QString &word : words) {
        if (word == QLatin1String("every cycle"))
            rule->everyCycle = true;
        else if (word == QLatin1String("on change"))
            rule->onChange = true;
        else if (word == QLatin1String("on request"))
            rule->onRequest = true;
        else if (word.startsWith(atMost)) {
            if (!readCanPeriod(word.mid(atMost.size()), &rule->gap))
                return false;
        } else if (!readCanPeriod(word, &rule->period))
            return false;
    }
    return !words.isEmpty();
}

bool readCanId(const QString &word, DbcMessage *message)
{
    bool isNumber = false;
    message->id = word.toUInt(&isNumber, 0);
    // As elsewhere in the world of CAN: 8 hexadecimal digits are an extended id.
    message->isExtended
        = message->id > CanFrame::StandardIds || (word.startsWith(QLatin1String("0x")) && word.size() == 10);
    return isNumber && message->id <= CanFrame::ExtendedIds;
}

bool readCanSize(const QString &word, int *size)
{
    static const QRegularExpression pattern(QStringLiteral("^([0-9]{1,2}) ?bytes?$"));
    const QRegularExpressionMatch match = pattern.match(word);
    *size = match.captured(1).toInt();
    return match.hasMatch();
}

// A service may write into the folder that systemd gives it, and not beside its configuration.
QString canLogFile(QPlcDriverSettings &settings)
{
    const QString key = QStringLiteral("log");
    const QString name = settings.text(key);
    const QString folder = qEnvironmentVariable("STATE_DIRECTORY").section(QLatin1Char(':'), 0, 0);
    return name.isEmpty() || folder.isEmpty() ? settings.fileName(key) : QDir(folder).filePath(name);
}

}  // namespace

void CanConfiguration::read(QPlcDriverSettings &settings)
{
    m_device = settings.requiredText(QStringLiteral("device"), QStringLiteral("can0"));
    m_logFile = canLogFile(settings);
    m_bitRate = readBitRate(m_device, QStringLiteral("bitrate"), 5000, 1'000'000, settings);
    m_dataBitRate = readBitRate(m_device, QStringLiteral("data-bitrate"), 5000, 12'000'000, settings);
    readDbc(settings);
    readFrames(settings);
    readSignals(settings);
    readRules(settings);
    readTimeouts(settings);
    readSources(settings);
    readProtections(settings);
    finish(settings);
    finishIds(settings);
    warnOfOverlaps(settings);
}

const CanMessage *CanConfiguration::find(const QString &message) const
{
    const auto isNamed = [&message](const CanMessage &one) { return one.description.name == message; };
    const auto found = std::find_if(m_messages.cbegin(), m_messages.cend(), isNamed);
    return found == m_messages.cend() ? nullptr : &*found;
}

QStringList CanConfiguration::names() const
{
    QStringList names;
    for (const CanMessage &message : m_messages)
        names << message.description.name;
    return names;
}

int CanConfiguration::readBitRate(const QString &device, const QString &key, int minimum, int maximum,
                                  QPlcDriverSettings &settings)
{
    if (CanBus::setsBitRate(device))
        return int(settings.integer(key, 0, minimum, maximum));
    if (settings.has(key))
        settings.addError(key,
                          device.startsWith(QLatin1String("fake:"))
                              ? QStringLiteral("'%1' has no bit rate; remove the key %2").arg(device, key)
                              : QStringLiteral("root sets the bit rate of '%1' for all its programs (ip link set %2 up "
                                               "type can bitrate 500000 restart-ms 100); remove the key %3")
                                    .arg(device, device.section(QLatin1Char(':'), -1), key));
    return 0;
}

void CanConfiguration::readDbc(QPlcDriverSettings &settings)
{
    const QString fileName = settings.fileName(QStringLiteral("dbc"));
    if (fileName.isEmpty())
        return;
    QVector<QPlcParseError> errors;
    const DbcFile file = DbcFile::fromFile(fileName, &errors);
    settings.addErrors(errors);
    for (const DbcMessage &message : file.messages()) {
        CanMessage one;
        one.description = message;
        m_messages.append(one);
    }
}

// frame.NAME = 0x123, 8 bytes, every 10 ms
void CanConfiguration::readFrames(QPlcDriverSettings &settings)
{
    const QStringList names = settings.namesBehind(QStringLiteral("frame."));
    for (const QString &name : names) {
        const QString key = QStringLiteral("frame.") + name;
        QString error;
        if (!addFrame(name, settings.list(key), &error))
            settings.addError(key, error);
    }
}

bool CanConfiguration::addFrame(const QString &name, const QStringList &words, QString *error)
{
    static const QRegularExpression allowed(QStringLiteral("^[A-Za-z_][A-Za-z0-9_]*$"));
    CanMessage one;
    DbcMessage &message = one.description;
    message.name = name;
    *error
        = QStringLiteral("'%1' is not a frame; write frame.%2 = 0x123, 8 bytes, and, if need be, extended, fd, no bit "
                         "rate switch, j1939, every 10 ms")
              .arg(words.join(QStringLiteral(", ")), name);
    if (words.size() < 2 || !allowed.match(name).hasMatch() || !readCanId(words.at(0), &message)
        || !readCanSize(words.at(1), &message.size))
        return false;
    for (const QString &word : words.mid(2)) {
        if (word == QLatin1String("extended"))
            message.isExtended = true;
        else if (word == QLatin1String("fd"))
            message.isFd = true;
        else if (word == QLatin1String("j1939"))
            message.isJ1939 = message.isExtended = true;
        else if (word == QLatin1String("no bit rate switch"))
            message.hasBitRateSwitch = false;
        else if (!readCanPeriod(word, &message.cycleTime))
            return false;
    }
    message.isFd = !message.isJ1939 && (message.isFd || message.size > 8);
    if (message.isJ1939 && message.size > 8)
        *error = DbcFile::sizeProblemOf(message);
    else if (!CanFrame::isSize(message.size, message.isFd))
        *error = QStringLiteral("no frame has %1 bytes; it has 0 ... 8, and with CAN FD 12, 16, 20, 24, 32, 48 or 64")
                     .arg(message.size);
    else if (find(name))
        *error = QStringLiteral("there is a message '%1' in the DBC file; take another name").arg(name);
    else {
        m_messages.append(one);
        return true;
    }
    return false;
}

// signal.FRAME.NAME = 0|16@1- (0.1,0)
void CanConfiguration::readSignals(QPlcDriverSettings &settings)
{
    const QStringList names = settings.namesBehind(QStringLiteral("signal."));
    for (const QString &name : names) {
        const QString key = QStringLiteral("signal.") + name;
        QString error;
        if (!addSignal(name, settings.text(key), &error))
            settings.addError(key, error);
    }
}

// Of signals by keys each pair, of a used message in a DBC file one: unions of signals are usual
// there.
void CanConfiguration::warnOfOverlaps(QPlcDriverSettings &settings) const
{
    QSet<QString> used;
    const QStringList channels = settings.usedChannels();
    for (const QString &channel : channels)
        used.insert(channel.section(QLatin1Char('.'), 0, 0));
    for (const CanMessage &message : m_messages) {
        const DbcMessage &description = message.description;
        const QString prefix = QStringLiteral("signal.%1.").arg(description.name);
        bool isTold = !used.contains(description.name);
        if (!description.unsupported.isEmpty() || (isTold && settings.namesBehind(prefix).isEmpty()))
            continue;
        const auto pairs = description.overlappingSignals();
        for (const auto &pair : pairs) {
            const bool isByKey = settings.has(prefix + pair.second);
            if (!isByKey && isTold)
                continue;
            isTold = isTold || !isByKey;
            settings.addWarning(isByKey ? prefix + pair.second : QStringLiteral("dbc"),
                                QStringLiteral("signals '%1' and '%2' of %3 '%4' have bits in common; correct start "
                                               "and length if this is not on purpose")
                                    .arg(pair.first, pair.second,
                                         isByKey ? QStringLiteral("frame") : QStringLiteral("message"),
                                         description.name));
        }
    }
}

bool CanConfiguration::addSignal(const QString &name, const QString &text, QString *error)
{
    const QString frame = name.section(QLatin1Char('.'), 0, 0);
    const auto owner = std::find_if(m_messages.begin(), m_messages.end(),
                                    [&frame](const CanMessage &message) { return message.description.name == frame; });
    if (owner == m_messages.end()) {
        *error = QStringLiteral("there is no frame '%1'; write a line frame.%1 = 0x123, 8 bytes").arg(frame);
        return false;
    }
    DbcSignal signal;
    signal.name = name.section(QLatin1Char('.'), 1);
    if (!DbcFile::readSignal(text, &signal, error)) {
        *error = QStringLiteral("'%1' is not the place of a signal: %2; write signal.%3 = start|length@order sign "
                                "(factor,offset), 0|16@1- (0.1,0) for example")
                     .arg(text, *error, name);
        return false;
    }
    DbcMessage &message = owner->description;
    *error = DbcFile::problemOf(message, signal);
    const bool hasMultiplexor = std::any_of(message.content.cbegin(), message.content.cend(),
                                            [](const DbcSignal &part) { return part.isMultiplexor; });
    if (signal.isMultiplexor && (hasMultiplexor || signal.isMultiplexed()))
        *error = QStringLiteral("frame '%1' has two multiplexors; it can have one: write a frame of the same id for "
                                "each, or a DBC file with lines SG_MUL_VAL_")
                     .arg(frame);
    if (!error->isEmpty())
        return false;
    message.content.append(signal);
    return true;
}

// The message that a key is about. Null, after an error, when there is none.
CanMessage *CanConfiguration::messageOf(const QString &name, const QString &key, QPlcDriverSettings &settings)
{
    for (CanMessage &message : m_messages) {
        if (message.description.name == name)
            return &message;
    }
    settings.addError(key,
                      QStringLiteral("there is no message '%1'%2").arg(name, didYouMean(closeNames(name, names()))));
    return nullptr;
}

// send.MESSAGE = every 10 ms, on change
void CanConfiguration::readRules(QPlcDriverSettings &settings)
{
    const QStringList names = settings.namesBehind(QStringLiteral("send."));
    for (const QString &name : names) {
        const QString key = QStringLiteral("send.") + name;
        const QStringList words = settings.list(key);
        CanMessage *message = messageOf(name, key, settings);
        if (!message)
            continue;
        CanSendRule rule;
        if (!readCanRule(words, &rule))
            settings.addError(
                key,
                QStringLiteral("'%1' does not say when to send; write every cycle, every 10 ms, on change, "
                               "on request, or some of them with commas between, and at most every 10 ms for a gap")
                    .arg(words.join(QStringLiteral(", "))));
        else if (rule.period.count() > 0 && rule.gap > rule.period)
            settings.addError(key,
                              QStringLiteral("at most every %1 is less often than every %2; write a longer period, or "
                                             "a smaller gap")
                                  .arg(durationText(rule.gap), durationText(rule.period)));
        else if (rule.onRequest && message->description.isFd)
            settings.addError(key,
                              QStringLiteral("message '%1' is one of CAN FD, which has no requests (remote frames); "
                                             "write another rule")
                                  .arg(name));
        message->rule = rule;
    }
}

void CanConfiguration::readTimeouts(QPlcDriverSettings &settings)
{
    const QStringList names = settings.namesBehind(QStringLiteral("timeout."));
    for (const QString &name : names) {
        const QString key = QStringLiteral("timeout.") + name;
        const std::chrono::nanoseconds timeout = settings.duration(key, 100ms, 1ms, longestCanTime);
        CanMessage *message = messageOf(name, key, settings);
        if (!message)
            continue;
        message->timeout = timeout;
        const std::chrono::nanoseconds cycle = message->description.cycleTime;
        if (timeout < cycle)
            settings.addError(key,
                              QStringLiteral("%1 is shorter than the cycle time of '%2' (%3), so its values would be "
                                             "invalid between two frames; write at least that")
                                  .arg(durationText(timeout), name, durationText(cycle)));
    }
}

// source.MESSAGE = 0x21
void CanConfiguration::readSources(QPlcDriverSettings &settings)
{
    const QStringList names = settings.namesBehind(QStringLiteral("source."));
    for (const QString &name : names) {
        const QString key = QStringLiteral("source.") + name;
        const int source = int(settings.integer(key, 0, 0, 253));
        CanMessage *message = messageOf(name, key, settings);
        if (!message)
            continue;
        message->source = source;
        if (!message->description.isJ1939)
            settings.addError(key,
                              QStringLiteral("message '%1' is not one of J1939, so its id is that of the frame; remove "
                                             "the key, or add the word j1939 to frame.%1")
                                  .arg(name));
    }
}

// counter.MESSAGE = SIGNAL, up to 14
// checksum.MESSAGE = SIGNAL, crc8, polynomial 0x2F
void CanConfiguration::readProtections(QPlcDriverSettings &settings)
{
    for (const bool isCounter : {true, false}) {
        const QString prefix = isCounter ? QStringLiteral("counter.") : QStringLiteral("checksum.");
        const QStringList names = settings.namesBehind(prefix);
        for (const QString &name : names) {
            const QString key = prefix + name;
            const QStringList words = settings.list(key);
            CanMessage *message = messageOf(name, key, settings);
            if (!message)
                continue;
            const QString error = isCounter ? message->protection.readCounter(words, message->description)
                                            : message->protection.readChecksum(words, message->description);
            if (!error.isEmpty())
                settings.addError(key, error);
        }
    }
}

// What is not said follows from the cycle times.
void CanConfiguration::finish(QPlcDriverSettings &settings)
{
    for (CanMessage &message : m_messages) {
        DbcMessage &description = message.description;
        if (description.unsupported.isEmpty())
            description.unsupported = description.connectMultiplexors();
        CanSendRule &rule = message.rule;
        if (rule.onRequest && description.isJ1939)
            settings.addError(QStringLiteral("send.") + description.name,
                              QStringLiteral("message '%1' is one of J1939, which has no remote frames; write another "
                                             "rule")
                                  .arg(description.name));
        if (!rule.everyCycle && !rule.onChange && !rule.onRequest && rule.period.count() == 0) {
            rule.period = description.cycleTime;
            rule.everyCycle = rule.period.count() == 0;
        }
        if (rule.gap.count() == 0)
            rule.gap = description.delayTime;
        if (message.timeout.count() == 0)
            message.timeout = 3 * description.cycleTime;
    }
}

// A group of J1939 comes from any source and goes to any node, unless its messages need source and
// destination to be told apart. Messages of one id are told apart by their multiplexors.
void CanConfiguration::finishIds(QPlcDriverSettings &settings)
{
    constexpr quint32 sourceBits = 0xFF;
    constexpr quint32 destinationBits = 0xFF00;
    constexpr quint32 priorityBits = 0x1C000000;
    QHash<quint32, int> messagesOfGroup;
    for (const CanMessage &message : qAsConst(m_messages)) {
        if (message.description.isJ1939)
            ++messagesOfGroup[CanFrame::groupOf(message.description.id)];
    }
    QHash<quint64, int> firstOfId;
    for (int i = 0; i < m_messages.size(); ++i) {
        CanMessage &message = m_messages[i];
        const DbcMessage &description = message.description;
        if (description.isJ1939) {
            const quint32 group = CanFrame::groupOf(description.id);
            const bool isAlone = messagesOfGroup.value(group) == 1;
            message.mask &= ~priorityBits & ~(isAlone && message.source < 0 ? sourceBits : 0)
                & ~(isAlone && CanFrame::isForOneNode(group) ? destinationBits : 0);
        }
        const quint64 id
            = quint64(message.mask) << 32 | CanFrame::keyOf(message.sentId() & message.mask, description.isExtended);
        const int first = firstOfId.value(id, i);
        firstOfId.insert(id, first);
        CanMessage &other = m_messages[first];
        const QString key = QStringLiteral("frame.") + description.name;
        if (first == i || !settings.has(key))  // in a DBC file, ids that differ by their priority alone
            continue;
        message.sharesId = other.sharesId = true;
        if (!description.isMultiplexed() || !other.description.isMultiplexed())
            settings.addError(key,
                              QStringLiteral("frame '%1' has the id of message '%2'; give each its own, or a "
                                             "multiplexor (M) by which their frames can be told apart")
                                  .arg(description.name, other.description.name));
    }
}

}  // namespace qplc
