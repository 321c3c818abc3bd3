// SPDX-License-Identifier: Apache-2.0
#include "LineTemplate.h"
#include "LineText.h"
#include "QPlcDriverSettings.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"
#include "SerialKeys.h"
#include "hardware/Drivers.h"
#include "signals/MessageText.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <vector>

namespace qplc {

namespace {

using namespace std::chrono_literals;

constexpr qint64 LongestSilenceOfLines = std::chrono::nanoseconds(5s).count();
constexpr std::chrono::nanoseconds UsualTimeoutOfLines = 2500ms;       // of instruments that talk by themselves
constexpr qint64 LongestStall = std::chrono::nanoseconds(5s).count();  // of a line that takes no bytes
constexpr int MostOfAskedText = 256;                                   // [byte]
constexpr int bitsOfByte = 10;                                         // on the line, with start and stop

/// Kind `serial-lines`: any instrument that sends lines of text with numbers, by itself or when it
/// is asked, or that takes such lines. See docs/hardware/serial.md.
class SerialLinesDriver final : public QPlcDriver
{
public:
    SerialLinesDriver()
        : QPlcDriver(OwnPace)
    {
    }

protected:
    void configure(QPlcDriverSettings &settings) override
    {
        m_keys.read(settings, 9600);
        m_ask = bytes(settings, QStringLiteral("ask"), QString());
        if (m_ask.size() > MostOfAskedText)
            settings.addError(
                QStringLiteral("ask"),
                QStringLiteral("it has %1 bytes; write at most %2").arg(m_ask.size()).arg(MostOfAskedText));
        if (!m_ask.isEmpty() && !settings.has(QStringLiteral("interval")))
            settings.addError(
                QStringLiteral("ask"),
                QStringLiteral("the driver asks once in each interval; add for example 'interval = 200 ms'"));
        const QByteArray ends = bytes(settings, QStringLiteral("end"), QStringLiteral("\\r\\n"));
        m_stream.setEnds(ends.isEmpty() ? QByteArray("\r\n") : ends);
        addSends(settings);
        const QString prefix = QStringLiteral("pattern.");
        QStringList keys;
        for (const QString &name : settings.namesBehind(prefix))
            keys << prefix + name;
        if (settings.has(QStringLiteral("pattern"))
            || (keys.isEmpty() && settings.namesBehind(QStringLiteral("send.")).isEmpty()))
            keys.prepend(QStringLiteral("pattern"));
        for (const QString &key : qAsConst(keys))
            addPattern(settings, key);
        for (const auto &channel : m_channels) {
            if (!settings.has(QStringLiteral("timeout")) && !settings.has(QStringLiteral("interval")))
                channel->setTimeout(UsualTimeoutOfLines);
        }
    }

    bool open() override
    {
        QString error;
        m_stream.reset();
        m_isFirstRead = true;
        m_other.clear();
        m_outgoing.clear();
        m_hasQueuedSafe = false;
        m_lastTaken = now();
        for (Send &send : m_sends)
            send.sent.clear();
        setDelivered(m_sends.empty());
        return m_line.open(m_keys.device, m_keys.line, &error) || fail(error);
    }

    void close() override { m_line.close(); }

    // While lines wait, no new ones are added: old values would go out before the newest ones. Safe
    // values do not wait.
    bool write() override
    {
        if (!flush())
            return failAt(QStringLiteral("write to"));
        const bool isBusy = !m_outgoing.isEmpty() || m_line.waiting() > 0;
        const bool isSafe = std::any_of(m_outputs.begin(), m_outputs.end(),
                                        [](const auto &output) { return output->hasValue() && output->isSafe(); });
        if (!isBusy || (isSafe && !m_hasQueuedSafe)) {
            collect();
            m_hasQueuedSafe = isSafe;
        } else if (!m_sends.empty()) {
            ++m_unsent;
        }
        if (!flush())
            return failAt(QStringLiteral("write to"));
        setDelivered(m_outgoing.isEmpty() && m_line.waiting() == 0 && hasSentAll());
        if (!m_outgoing.isEmpty() && now() - m_lastTaken > LongestStall)
            return fail(QStringLiteral("the line '%1' takes no bytes; look at its adapter, and at the hardware flow "
                                       "control of the instrument")
                            .arg(m_keys.device));
        return true;
    }

    QString undeliveredText() const override
    {
        const auto isMissing = [](const Send &send) { return send.sent.isEmpty(); };
        if (std::any_of(m_sends.begin(), m_sends.end(), isMissing))
            return QStringLiteral("a line is not sent before all of its numbers have a value; give each of them a safe "
                                  "value");
        return QStringLiteral("their lines have not left the computer; look at the adapter and its rate");
    }

    bool read() override
    {
        if (m_isFirstRead)
            m_lastByte = m_lastMatch = now();
        m_isFirstRead = false;
        const int taken = m_line.readEach([this](char byte) {
            if (m_stream.feed(byte))
                apply(m_stream.line());
        });
        if (taken < 0)
            return failAt(QStringLiteral("read from"));
        if (taken > 0)
            m_lastByte = now();
        m_errors.set(double(m_bad + m_stream.refused()));
        m_unsentLines.set(double(m_unsent));
        return judge();
    }

    QString remedy(int errorNumber) const override
    {
        const QString text = SerialLine::remedy(errorNumber);
        return text.isEmpty() ? QPlcDriver::remedy(errorNumber) : text;
    }

private:
    struct Pattern
    {
        LinePattern pattern;
        std::vector<QPlcReadChannel *> channels;  // of its names
    };

    /// A line that is sent.
    struct Send
    {
        LineTemplate line;
        std::vector<QPlcWriteChannel *> channels;  // of its names
        QByteArray sent;                           // as the instrument has it; empty: nothing yet
    };

    void addSends(QPlcDriverSettings &settings)
    {
        const QString prefix = QStringLiteral("send.");
        const QStringList names = settings.namesBehind(prefix);
        if (names.isEmpty())
            return;
        const QStringList used = settings.usedChannels();
        int length = 0;
        for (const QString &name : names) {
            const QString key = prefix + name;
            const QByteArray text = bytes(settings, key, QString());
            if (text.isEmpty() && !settings.text(key).isEmpty())
                continue;  // an error already
            Send send;
            const QString error = LineTemplate::parse(text, &send.line);
            if (!error.isEmpty()) {
                settings.addError(key, error);
                continue;
            }
            for (int i = 0; i < send.line.names().size(); ++i) {
                QPlcWriteChannel *output = outputOf(send.line.names().at(i));
                const double largest = std::min(output->maximum(), send.line.largest(i));
                output->setRange(-largest, largest);
                send.channels.push_back(output);
                if (!used.isEmpty() && !used.contains(output->name()))
                    settings.addError(
                        key,
                        QStringLiteral("the line is never sent, because '%1' gets no value; add it to the "
                                       "section 'write', or remove it from the line")
                            .arg(output->name()));
            }
            length += send.line.shortest();
            m_sends.push_back(send);
        }
        m_isOnChange
            = settings.choice(QStringLiteral("write"), {QStringLiteral("always"), QStringLiteral("on-change")}) == 1;
        const double time = double(length + m_ask.size()) * bitsOfByte / std::max(1, m_keys.line.baud);  // [s]
        if (!m_isOnChange && time > double(interval().count()) * 1e-9)
            settings.addWarning(QStringLiteral("interval"),
                                QStringLiteral("the lines of one interval take %1 ms at %2 baud, so some are left out; "
                                               "make the interval longer, or write 'write = on-change'")
                                    .arg(time * 1e3, 0, 'f', 1)
                                    .arg(m_keys.line.baud));
    }

    QPlcWriteChannel *outputOf(const QString &name)
    {
        for (const auto &output : m_outputs) {
            if (output->name() == name)
                return output.get();
        }
        m_outputs.push_back(std::make_unique<QPlcWriteChannel>(this, name));
        return m_outputs.back().get();
    }

    /// The line with the present values; empty: not all of them are known, or one is no number.
    static QByteArray textOf(const Send &send)
    {
        std::vector<double> values;
        for (const QPlcWriteChannel *channel : send.channels) {
            if (!channel->hasValue())
                return {};
            values.push_back(std::clamp(channel->value(), channel->minimum(), channel->maximum()));
        }
        return send.line.text(values);
    }

    /// Lines of this interval into m_outgoing.
    void collect()
    {
        for (Send &send : m_sends) {
            const QByteArray text = textOf(send);
            if (text.isEmpty() || (m_isOnChange && text == send.sent))
                continue;
            m_outgoing += text;
            send.sent = text;
        }
        m_outgoing += m_ask;
    }

    bool hasSentAll() const
    {
        return std::all_of(m_sends.begin(), m_sends.end(),
                           [](const Send &send) { return !send.sent.isEmpty() && send.sent == textOf(send); });
    }

    /// \return false, with errno, when the line is gone
    bool flush()
    {
        if (m_outgoing.isEmpty())
            return true;
        const int count = m_line.write(m_outgoing.constData(), m_outgoing.size());
        if (count < 0)
            return false;
        m_outgoing.remove(0, count);
        if (count > 0)
            m_lastTaken = now();
        return true;
    }

    QByteArray bytes(QPlcDriverSettings &settings, const QString &key, const QString &usual)
    {
        QByteArray result;
        const QString text = settings.text(key, usual);
        if (bytesOfText(text, &result))
            return result;
        settings.addError(key,
                          QStringLiteral("%1 has an unknown character behind '\\'; there are \\r, \\n, \\t, \\\\ and "
                                         "\\xNN with two hexadecimal digits")
                              .arg(quoted(text)));
        return {};
    }

    void addPattern(QPlcDriverSettings &settings, const QString &key)
    {
        const QString text = settings.requiredText(key, QStringLiteral("^(?<weight>[-+0-9.]+) kg"));
        Pattern pattern;
        const QString error = text.isEmpty() ? QString() : LinePattern::parse(text, &pattern.pattern);
        if (!error.isEmpty())
            settings.addError(key, error);
        for (const QString &name : pattern.pattern.names())
            pattern.channels.push_back(channelOf(name));
        m_patterns.push_back(pattern);
    }

    QPlcReadChannel *channelOf(const QString &name)
    {
        for (const auto &channel : m_channels) {
            if (channel->name() == name)
                return channel.get();
        }
        m_channels.push_back(std::make_unique<QPlcReadChannel>(this, name));
        return m_channels.back().get();
    }

    /// The first pattern that matches has the line.
    void apply(const QByteArray &line)
    {
        for (const Pattern &pattern : m_patterns) {
            const QVector<std::optional<double>> values = pattern.pattern.match(line);
            for (int i = 0; i < values.size(); ++i) {
                if (values[i])
                    pattern.channels[std::size_t(i)]->set(*values[i]);
                else
                    ++m_bad;
            }
            if (values.isEmpty())
                continue;
            m_lastMatch = now();
            return;
        }
        ++m_bad;
        m_other = line;
    }

    bool judge()
    {
        if (m_patterns.empty())
            return true;  // it only takes lines
        if (now() - m_lastByte > std::max<qint64>(LongestSilenceOfLines, timeout().count()))
            return fail(
                QStringLiteral("nothing comes from '%1'; look at the power of the instrument, at its wires (its "
                               "TX is our RX), and whether it has to be asked ('ask = ...')")
                    .arg(m_keys.device));
        if (!m_other.isEmpty() && now() - m_lastMatch > std::max<qint64>(LongestSilenceOfLines, timeout().count()))
            return fail(QStringLiteral("no line from '%1' at %2 matches, for example %3; look at 'baud', 'format', and "
                                       "the pattern")
                            .arg(m_keys.device, m_keys.line.toString(), quoted(QString::fromLatin1(m_other))));
        return true;
    }

    bool failAt(const QString &operation)
    {
        const int errorNumber = errno;
        return fail(QStringLiteral("cannot %1 the serial line '%2': %3; %4")
                        .arg(operation, m_keys.device, qt_error_string(errorNumber), remedy(errorNumber)));
    }

    SerialKeys m_keys;
    SerialLine m_line;
    LineStream m_stream;
    QByteArray m_ask;
    std::vector<Send> m_sends;
    std::vector<std::unique_ptr<QPlcWriteChannel>> m_outputs;
    bool m_isOnChange = false;
    QByteArray m_outgoing;  // that the line has not taken yet
    bool m_hasQueuedSafe = false;
    qint64 m_lastTaken = 0;  // when the line took bytes [ns]
    quint64 m_unsent = 0;    // intervals whose lines were left out
    std::vector<Pattern> m_patterns;
    std::vector<std::unique_ptr<QPlcReadChannel>> m_channels;
    QPlcReadChannel m_errors{this, QStringLiteral("@errors")};
    QPlcReadChannel m_unsentLines{this, QStringLiteral("@unsent")};
    bool m_isFirstRead = true;
    qint64 m_lastByte = 0;   // when it came [ns]
    qint64 m_lastMatch = 0;  // likewise, a line
    QByteArray m_other;      // the last line that matches nothing
    quint64 m_bad = 0;       // lines and numbers
};

}  // namespace

std::unique_ptr<QPlcDriver> createSerialLinesDriver()
{
    return std::make_unique<SerialLinesDriver>();
}

}  // namespace qplc
