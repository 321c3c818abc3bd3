// SPDX-License-Identifier: Apache-2.0
#include "LineText.h"
#include "QPlcDriverSettings.h"
#include "QPlcReadChannel.h"
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
constexpr std::chrono::nanoseconds UsualTimeoutOfLines = 2500ms;  // of instruments that talk by themselves
constexpr int MostOfAskedText = 256;                              // [byte]

/// Kind `serial-lines`: any instrument that sends lines of text with numbers, by itself or when it
/// is asked. See docs/hardware/serial.md.
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
        const QString prefix = QStringLiteral("pattern.");
        QStringList keys;
        for (const QString &name : settings.namesBehind(prefix))
            keys << prefix + name;
        if (settings.has(QStringLiteral("pattern")) || keys.isEmpty())
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
        return m_line.open(m_keys.device, m_keys.line, &error) || fail(error);
    }

    void close() override { m_line.close(); }

    // Bytes that do not fit into the buffer of the line are dropped: the next interval asks again.
    bool write() override
    {
        return m_ask.isEmpty() || m_line.write(m_ask.constData(), m_ask.size()) >= 0
            || failAt(QStringLiteral("write to"));
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
    std::vector<Pattern> m_patterns;
    std::vector<std::unique_ptr<QPlcReadChannel>> m_channels;
    QPlcReadChannel m_errors{this, QStringLiteral("@errors")};
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
