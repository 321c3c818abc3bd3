// SPDX-License-Identifier: Apache-2.0
#include "CanConfiguration.h"

#include "CanBus.h"
#include "QPlcDriverSettings.h"
#include "signals/DurationText.h"
#include "signals/MessageText.h"

#include <QtCore/QDir>
#include <QtCore/QHash>
#include <QtCore/QRegularExpression>

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
    for (const QString &word : words) {
        if (word == QLatin1String("every cycle"))
            rule->everyCycle = true;
        else if (word == QLatin1String("on change"))
            rule->onChange = true;
        else if (word == QLatin1String("on request"))
            rule->onRequest = true;
        else if (!readCanPeriod(word, &rule->period))
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
    finish(settings);
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
                         "rate switch, every 10 ms")
              .arg(words.join(QStringLiteral(", ")), name);
    if (words.size() < 2 || !allowed.match(name).hasMatch() || !readCanId(words.at(0), &message)
        || !readCanSize(words.at(1), &message.size))
        return false;
    for (const QString &word : words.mid(2)) {
        if (word == QLatin1String("extended"))
            message.isExtended = true;
        else if (word == QLatin1String("fd"))
            message.isFd = true;
        else if (word == QLatin1String("no bit rate switch"))
            message.hasBitRateSwitch = false;
        else if (!readCanPeriod(word, &message.cycleTime))
            return false;
    }
    message.isFd = message.isFd || message.size > 8;
    if (!CanFrame::isSize(message.size, message.isFd))
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
        else
            warnOfOverlap(find(name.section(QLatin1Char('.'), 0, 0))->description, key, settings);
    }
}

/// Of the last signal of a message.
void CanConfiguration::warnOfOverlap(const DbcMessage &message, const QString &key, QPlcDriverSettings &settings)
{
    const DbcSignal &last = message.content.last();
    for (const DbcSignal &other : message.content) {
        if (other.name != last.name && other.overlaps(last))
            settings.addWarning(key,
                                QStringLiteral("signals '%1' and '%2' of frame '%3' have bits in common; correct start "
                                               "and length if this is not on purpose")
                                    .arg(other.name, last.name, message.name));
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
    if (signal.role == DbcSignal::Multiplexor && message.multiplexor >= 0)
        *error = QStringLiteral("frame '%1' has two multiplexors; it can have one").arg(frame);
    if (!error->isEmpty())
        return false;
    if (signal.role == DbcSignal::Multiplexor)
        message.multiplexor = message.content.size();
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
                               "on request, or some of them with commas between")
                    .arg(words.join(QStringLiteral(", "))));
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

// What is not said follows from the cycle times.
void CanConfiguration::finish(QPlcDriverSettings &settings)
{
    QHash<quint32, QString> nameOfKey;
    for (CanMessage &message : m_messages) {
        DbcMessage &description = message.description;
        const bool isMultiplexed
            = std::any_of(description.content.cbegin(), description.content.cend(),
                          [](const DbcSignal &signal) { return signal.role == DbcSignal::Multiplexed; });
        if (isMultiplexed && description.multiplexor < 0 && description.unsupported.isEmpty())
            description.unsupported = QStringLiteral("it has multiplexed signals and no multiplexor (M)");
        CanSendRule &rule = message.rule;
        if (!rule.everyCycle && !rule.onChange && !rule.onRequest && rule.period.count() == 0) {
            rule.period = description.cycleTime;
            rule.everyCycle = rule.period.count() == 0;
        }
        if (message.timeout.count() == 0)
            message.timeout = 3 * description.cycleTime;
        const quint32 key = CanFrame::keyOf(description.id, description.isExtended);
        if (nameOfKey.contains(key))
            settings.addError(QStringLiteral("frame.") + description.name,
                              QStringLiteral("frame '%1' has the id of message '%2'; give each its own")
                                  .arg(description.name, nameOfKey.value(key)));
        nameOfKey.insert(key, description.name);
    }
}

}  // namespace qplc
