// SPDX-License-Identifier: Apache-2.0
#include "IioBuffer.h"
#include "QPlcDriverSettings.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"
#include "SysfsAnalogOutput.h"
#include "SysfsClass.h"
#include "SysfsFolder.h"
#include "SysfsPwm.h"
#include "SysfsText.h"
#include "hardware/DeviceAccess.h"
#include "hardware/Drivers.h"
#include "hardware/fake/FakeMemory.h"
#include "signals/ConfigurationFile.h"
#include "signals/MessageText.h"

#include <QtCore/QMap>
#include <QtCore/QRegularExpression>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <functional>
#include <vector>

namespace qplc {

namespace {

using namespace std::chrono_literals;

constexpr std::chrono::nanoseconds ShortestThermometerInterval = 1s;  // it measures for 0.75 s
constexpr std::chrono::nanoseconds ShortestSilence = 1s;              // a chip may need this for its first scan

/// Kind `sysfs`: devices for which the kernel has a driver, such as converters, inertial sensors,
/// counters, thermometers and PWM. See docs/hardware/sysfs.md.
class SysfsDriver final : public QPlcDriver
{
public:
    SysfsDriver()
        : QPlcDriver(OwnPace)
    {
    }

protected:
    void configure(QPlcDriverSettings &settings) override
    {
        const QString root = settings.text(QStringLiteral("root"), QStringLiteral("/sys"));
        m_root = FakeMemory::isFake(root) ? FakeMemory::path(root) : root;
        m_device = settings.requiredText(QStringLiteral("device"), QStringLiteral("iio:ads1015"));
        m_access.configure(settings);
        m_class = SysfsClass::of(m_device.section(QLatin1Char(':'), 0, 0));
        const QString name = m_device.section(QLatin1Char(':'), 1);
        if (!m_class || name.isEmpty()) {
            if (!m_device.isEmpty())
                settings.addError(QStringLiteral("device"),
                                  QStringLiteral("%1 is not a device of the kernel; write for example %2")
                                      .arg(quoted(m_device), SysfsClass::examples()));
            m_class = nullptr;
            return;
        }
        if (m_class->isNumbered(name))
            settings.addError(QStringLiteral("device"),
                              QStringLiteral("'%1' is a number that can be another one after the next start; write the "
                                             "name, label or place of the device ('qtplc_hardware FILE --monitor' "
                                             "lists the names when one is wrong)")
                                  .arg(name));
        configureBuffer(settings);
        if (m_class->kind == SysfsClass::Iio)
            configureRanges(settings);
        else if (m_class->kind == SysfsClass::Counter)
            configureCounter(settings);
        else if (m_class->kind == SysfsClass::Pwm)
            configurePwm(settings);
        else if (m_class->kind == SysfsClass::Thermometer && interval() < ShortestThermometerInterval)
            settings.addError(QStringLiteral("interval"),
                              QStringLiteral("a thermometer on a 1-wire bus measures for 0.75 s; write an interval of "
                                             "1 s or more, for example 'interval = 2 s'"));
    }

    QPlcChannel *channel(const QString &name, QPlcChannel::Direction direction, QString *error) override
    {
        if (QPlcChannel *known = QPlcDriver::channel(name, direction, error))
            return known;
        if (m_class && direction == QPlcChannel::Write)
            *error = problemOfOutput(name);
        if (m_class && error->isEmpty())  // else the key 'device' has an error already
            *error = problemOfName(name);
        if (!error->isEmpty())
            return nullptr;
        if (direction == QPlcChannel::Write) {
            m_outputs.push_back(makeOutput(name));
            return &m_outputs.back()->channel;
        }
        m_inputs.push_back(std::make_unique<Input>(this, name, settingsOf(name)));
        return &m_inputs.back()->channel;
    }

    QStringList channelNames(QPlcChannel::Direction direction) const override
    {
        if (m_class && m_class->kind == SysfsClass::Thermometer && direction == QPlcChannel::Read)
            return {QStringLiteral("temperature")};
        return QPlcDriver::channelNames(direction);
    }

    bool open() override
    {
        if (openDevice())
            return true;
        m_buffer.close();
        return false;
    }

    void close() override
    {
        m_buffer.close();
        m_folder.close();
    }

    bool read() override
    {
        if (m_access.hasFailed())
            return true;  // as write() has told
        if (m_isBuffered)
            return readBuffer();
        for (const auto &input : m_inputs) {
            double value = 0.0;
            if (!m_access.repeat([&] { return readInput(input.get(), &value); }))
                return keepAfter("read", input->file);
            input->channel.set(value);
        }
        m_access.succeed(now());
        return true;
    }

    // In each interval: this corrects a value that another program has changed.
    bool write() override
    {
        m_access.begin();
        for (const auto &output : m_outputs) {
            if (output->channel.hasValue()
                && !m_access.repeat([&] { return output->output->set(output->channel.value()); }))
                return keepAfter("write", output->output->file());
        }
        return true;
    }

    QString remedy(int errorNumber) const override
    {
        switch (errorNumber) {
        case ENOENT:
        case ENODEV:
        case ENXIO:
            return QStringLiteral("the device or the driver of the kernel is gone: plug it in again");
        case EACCES:
        case EPERM:
        case EROFS:
            return QStringLiteral("the file belongs to root, or the service sees /sys read-only: see the section on "
                                  "rights of docs/hardware/sysfs.md");
        case EBUSY:
            return QStringLiteral("another program uses it: it has switched on the buffer of an IIO device, or has the "
                                  "channel");
        case EBADMSG:
            return QStringLiteral("look at the device, or name another channel");
        case EFBIG:
        case ENOTSUP:
            return QStringLiteral("this is not a regular file of sysfs: check 'root'");
        case EINVAL:
            return QStringLiteral("the chip cannot do this: look at 'period' and 'polarity', or 'function'");
        case ENOMEM:
            return QStringLiteral("the kernel has no memory for the buffer: write a shorter 'length'");
        default:
            return QPlcDriver::remedy(errorNumber);
        }
    }

private:
    struct Input
    {
        Input(QPlcDriver *driver, const QString &name, const SysfsPwm::Settings &settings)
            : channel(driver, name)
            , pwm(name.toUtf8(), settings)
        {
        }
        QPlcReadChannel channel;
        SysfsPwm pwm;         // of PWM
        QByteArray file;      // of the others
        int number = 0;       // in the buffer
        double offset = 0.0;  // value = (number + offset) * factor
        double factor = 1.0;
    };
    struct Output
    {
        Output(QPlcDriver *driver, const QString &name, std::unique_ptr<SysfsOutput> deviceOutput)
            : channel(driver, name)
            , output(std::move(deviceOutput))
        {
        }
        QPlcWriteChannel channel;
        const std::unique_ptr<SysfsOutput> output;
    };

    std::unique_ptr<Output> makeOutput(const QString &name)
    {
        std::unique_ptr<SysfsOutput> device;
        const bool isAnalog = m_class && m_class->kind == SysfsClass::Iio;
        const SysfsAnalogOutput::Range range = isAnalog ? m_ranges.value(name) : SysfsAnalogOutput::Range{0.0, 1.0};
        if (isAnalog)
            device = std::make_unique<SysfsAnalogOutput>(name.toUtf8(), range);
        else
            device = std::make_unique<SysfsPwm>(name.toUtf8(), settingsOf(name));
        auto output = std::make_unique<Output>(this, name, std::move(device));
        output->channel.setRange(range.lowest, range.highest);
        if (!isAnalog)
            output->channel.setRestValue(0.0);
        return output;
    }

    // ---- keys ----

    void configureBuffer(QPlcDriverSettings &settings)
    {
        m_isBuffered = settings.truth(QStringLiteral("buffer"), false);
        if (m_isBuffered && m_class->kind != SysfsClass::Iio)
            settings.addError(QStringLiteral("buffer"),
                              QStringLiteral("of these devices, only IIO has buffers; leave 'buffer' out"));
        if (m_class->kind != SysfsClass::Iio)
            return;
        m_bufferSettings.trigger = settings.text(QStringLiteral("trigger"));
        m_bufferSettings.length = int(settings.integer(QStringLiteral("length"), m_bufferSettings.length,
                                                       IioBuffer::ShortestLength, IioBuffer::LongestLength));
        for (const char *name : {"trigger", "length"}) {
            const QString key = QLatin1String(name);
            if (!m_isBuffered && settings.has(key))
                settings.addError(
                    key, QStringLiteral("'%1' belongs to a buffer; add 'buffer = yes', or leave it out").arg(key));
        }
        if (!m_isBuffered)
            return;
        settings.claim(QStringLiteral("buffer"), QStringLiteral("buffer of ") + m_device);
        // Outputs get their safe values also when the buffer cannot be set up.
        if (!settings.namesBehind(QStringLiteral("range.")).isEmpty())
            settings.addError(QStringLiteral("buffer"),
                              QStringLiteral("a section with a buffer has no outputs; write another section with the "
                                             "same 'device' for them"));
    }

    /// Of outputs: "range.voltage0 = 0, 4.096".
    void configureRanges(QPlcDriverSettings &settings)
    {
        const QString prefix = QStringLiteral("range.");
        for (const QString &name : settings.namesBehind(prefix)) {
            const QStringList words = settings.list(prefix + name);
            SysfsAnalogOutput::Range range;
            const bool isRange = words.size() == 2 && finiteNumberFromText(words[0], &range.lowest)
                && finiteNumberFromText(words[1], &range.highest) && range.lowest < range.highest;
            if (!isRange)
                settings.addError(prefix + name,
                                  QStringLiteral("%1 is not a range; write the lowest and the highest value, for "
                                                 "example '0, 4.096'")
                                      .arg(quoted(words.join(QStringLiteral(", ")))));
            m_ranges[name] = range;
        }
    }

    void configureCounter(QPlcDriverSettings &settings)
    {
        m_function = settings.text(QStringLiteral("function")).toUtf8();
        m_isSigned = settings.has(QStringLiteral("bits"));
        m_bits = int(settings.integer(QStringLiteral("bits"), 64, 8, 64));
    }

    void configurePwm(QPlcDriverSettings &settings)
    {
        settings.claim(QStringLiteral("device"), QStringLiteral("chip ") + m_device);
        settings.requiredText(QStringLiteral("period"), QStringLiteral("20 ms"));
        m_common = pwmSettings(settings, QString(), {std::chrono::nanoseconds(20ms).count(), false});
        for (const QString &key : {QStringLiteral("period."), QStringLiteral("polarity.")}) {
            for (const QString &name : settings.namesBehind(key))
                m_special[name] = pwmSettings(settings, QLatin1Char('.') + name, m_common);
        }
    }

    static SysfsPwm::Settings pwmSettings(QPlcDriverSettings &settings, const QString &suffix,
                                          const SysfsPwm::Settings &common)
    {
        SysfsPwm::Settings result;
        result.period
            = settings.duration(QStringLiteral("period") + suffix, std::chrono::nanoseconds(common.period), 100ns, 10s)
                  .count();
        result.isInversed
            = settings.choice(QStringLiteral("polarity") + suffix,
                              {QStringLiteral("normal"), QStringLiteral("inversed")}, common.isInversed ? 1 : 0)
            == 1;
        return result;
    }

    SysfsPwm::Settings settingsOf(const QString &name) const { return m_special.value(name, m_common); }

    QString problemOfOutput(const QString &name) const
    {
        if (m_class->kind == SysfsClass::Pwm || (m_class->kind == SysfsClass::Iio && m_ranges.contains(name)))
            return {};
        if (m_class->kind == SysfsClass::Iio)
            return QStringLiteral("the output %1 has no range; add what the device behind it can take, for example "
                                  "'range.%2 = 0, 4.096'")
                .arg(quoted(name), name);
        return QStringLiteral("%1 of %2 can only be read; of these devices, PWM and IIO take values")
            .arg(quoted(name), m_device);
    }

    /// Why no device of this class has a channel of this name; empty if one may have it.
    QString problemOfName(const QString &name) const
    {
        static const QRegularExpression usual(QStringLiteral("^[A-Za-z0-9][A-Za-z0-9_.:#-]*$"));
        static const QRegularExpression pwm(QStringLiteral("^pwm\\d{1,3}$"));
        if (m_class->kind == SysfsClass::Thermometer && name != QLatin1String("temperature"))
            return QStringLiteral("a thermometer on a 1-wire bus has no channel %1; its channel is 'temperature'")
                .arg(quoted(name));
        if (m_class->kind == SysfsClass::Pwm && !pwm.match(name).hasMatch())
            return QStringLiteral("%1 is not a channel of a PWM chip; they are pwm0, pwm1, ...").arg(quoted(name));
        if (!usual.match(name).hasMatch())
            return QStringLiteral("%1 is not the name of a channel; write it as the kernel does, for example voltage0, "
                                  "accel_x, temp1 or count0")
                .arg(quoted(name));
        return {};
    }

    // ---- the device ----

    bool openDevice()
    {
        QString error;
        const QString path = m_class->find(m_root, m_device.section(QLatin1Char(':'), 1), &error);
        m_access.reset();
        m_problem = nullptr;
        m_buffer.close();
        if (path.isEmpty())
            return fail(error);
        if (!m_folder.open(path))
            return failAt("open", {});
        if (m_isBuffered && !m_buffer.open(m_root, &m_folder, m_bufferSettings))
            return failAt("open", m_buffer.file());
        for (const auto &input : m_inputs) {
            if (!openInput(input.get()))
                return false;
        }
        for (const auto &output : m_outputs) {
            if (!output->output->open(&m_folder))
                return failAt("open", output->output->file());
        }
        m_lastScan = QPlcReadChannel::Never;
        return !m_isBuffered || m_buffer.start(now()) || failAt("open", m_buffer.file());
    }

    bool openInput(Input *input)
    {
        const QByteArray name = input->channel.name().toUtf8();
        bool isFound = true;
        switch (m_class->kind) {
        case SysfsClass::Iio:
            isFound = findIio(input, name);
            if (isFound && m_problem) {
                errno = EBADMSG;
                return failAt("open", input->file);
            }
            break;
        case SysfsClass::Hwmon:
            isFound = findHwmon(input, name);
            break;
        case SysfsClass::Counter:
            isFound = findCounter(input, name);
            return isFound ? startCounter(input->file.left(input->file.indexOf('/'))) : failUnknown(name);
        case SysfsClass::Thermometer:
            input->file = "w1_slave";
            break;
        case SysfsClass::Pwm:
            return input->pwm.open(&m_folder) || failAt("open", input->pwm.file());
        }
        return isFound || failUnknown(name);
    }

    bool findIio(Input *input, const QByteArray &channel)
    {
        const QByteArray name = labelled(channel, QByteArrayLiteral("in_"), QByteArrayLiteral("_label"));
        const bool isConverted = m_folder.has("in_" + name + "_input");  // by the driver of the kernel
        const bool isRaw = m_isBuffered || !isConverted;
        input->file = "in_" + name + (isRaw ? "_raw" : "_input");
        input->factor = SysfsText::iioUnit(name);
        input->offset = 0.0;
        const QByteArrayList scales = SysfsText::iioFiles("in_", name, "scale");
        if (isRaw) {
            input->factor *= m_folder.firstNumber(scales, 1.0);
            input->offset = m_folder.firstNumber(SysfsText::iioFiles("in_", name, "offset"), 0.0);
        }
        if (!m_isBuffered)
            return m_folder.has(input->file);
        const bool hasScale = m_folder.has(input->file)
            || std::any_of(scales.cbegin(), scales.cend(), [&](const QByteArray &file) { return m_folder.has(file); });
        if (isConverted && !hasScale)
            m_problem = "the kernel does not tell the scale of what is in its buffer; read it without 'buffer'";
        return m_buffer.add(name, &input->number);
    }

    bool findHwmon(Input *input, const QByteArray &channel)
    {
        const QByteArray name = labelled(channel, QByteArray(), QByteArrayLiteral("_label"));
        input->file = name + "_input";
        if (!m_folder.has(input->file))
            input->file = name + "_average";
        input->factor = SysfsText::hwmonUnit(name);
        return m_folder.has(input->file);
    }

    bool findCounter(Input *input, const QByteArray &channel)
    {
        input->file = labelled(channel, QByteArray(), QByteArrayLiteral("/name")) + "/count";
        return m_folder.has(input->file);
    }

    bool startCounter(const QByteArray &count)
    {
        QByteArray text;
        const QByteArray function = count + "/function";
        const QByteArray enable = count + "/enable";
        if (!m_function.isEmpty()
            && (!m_folder.read(function, &text)
                || (text.trimmed() != m_function && !m_folder.write(function, m_function))))
            return failAt("set", function);
        if (m_folder.read(enable, &text) && text.trimmed() == "0" && !m_folder.write(enable, "1"))
            return failAt("set", enable);
        return true;
    }

    /// Returns the channel whose label is \a channel, or else \a channel itself.
    QByteArray labelled(const QByteArray &channel, const QByteArray &prefix, const QByteArray &file) const
    {
        const bool isFolder = file.startsWith('/');
        for (const QByteArray &entry : m_folder.files(QString::fromLatin1(prefix + '*' + (isFolder ? "" : file)))) {
            QByteArray text;
            if (m_folder.read(isFolder ? entry + file : entry, &text) && text.trimmed() == channel)
                return entry.mid(prefix.size(), isFolder ? -1 : entry.size() - prefix.size() - file.size());
        }
        return channel;
    }

    QStringList knownChannels() const
    {
        if (m_isBuffered)
            return m_buffer.channels();
        const bool isCounter = m_class->kind == SysfsClass::Counter;
        const bool isIio = m_class->kind == SysfsClass::Iio;
        QStringList names;
        for (const char *pattern : {isCounter ? "count*" : isIio ? "in_*_raw" : "*_input", isIio ? "in_*_input" : ""}) {
            for (const QByteArray &file : m_folder.files(QString::fromLatin1(pattern))) {
                const QByteArray name = isIio ? file.mid(3) : file;
                names << QString::fromUtf8(isCounter ? name : name.left(name.lastIndexOf('_')));
            }
        }
        names.removeDuplicates();
        return names;
    }

    bool failUnknown(const QByteArray &channel)
    {
        return fail(QStringLiteral("%1 has no channel %2%3%4")
                        .arg(m_device, quoted(QString::fromUtf8(channel)),
                             m_isBuffered ? QStringLiteral(" in its buffer") : QString(), knownAre(knownChannels())));
    }

    bool readInput(Input *input, double *value)
    {
        m_problem = nullptr;
        if (m_class->kind == SysfsClass::Pwm) {
            const bool isRead = input->pwm.readDuty(value);
            input->file = input->pwm.file();
            return isRead;
        }
        QByteArray text;
        if (!m_folder.read(input->file, &text))
            return false;
        if (m_class->kind == SysfsClass::Thermometer) {
            const SysfsText::Thermometer reading = SysfsText::thermometer(text);
            m_problem = reading.problem;
            *value = reading.temperature;
            errno = EBADMSG;
            return !m_problem;
        }
        const std::optional<double> number = m_class->kind == SysfsClass::Counter
            ? SysfsText::count(text, m_bits, m_isSigned)
            : SysfsText::number(text);
        errno = EBADMSG;
        if (number)
            *value = (*number + input->offset) * input->factor;
        else
            m_problem = "it does not contain a number; check the device, or use another channel";
        return number.has_value();
    }

    bool readBuffer()
    {
        IioBuffer::Result result = IioBuffer::Failed;
        m_problem = nullptr;
        if (m_lastScan == QPlcReadChannel::Never)
            m_lastScan = now();
        if (!m_access.repeat([&] { return (result = m_buffer.read()) != IioBuffer::Failed; }))
            return keepAfter("read", m_buffer.file());
        switch (result) {
        case IioBuffer::Scan:
            return setValues();
        case IioBuffer::None:
            break;
        default:
            m_access.reject();
            failAt("read", m_buffer.file());
            return m_access.keep(now(), timeout().count()) && result != IioBuffer::Torn;
        }
        const qint64 longest = std::max(timeout(), ShortestSilence).count();
        if (now() - m_lastScan > longest)
            return fail(QStringLiteral("%1 (%2) has sent no scan for %3 s; look at its trigger: its rate, and whether "
                                       "it runs (a slow one needs a longer 'timeout')")
                            .arg(m_device, m_folder.path())
                            .arg(double(longest) * 1e-9));
        m_access.succeed(now());
        return true;
    }

    /// All of a scan, or none of it.
    bool setValues()
    {
        const qint64 time = m_buffer.time(now());
        m_lastScan = now();
        for (const auto &input : m_inputs) {
            if (std::isfinite(valueOf(*input)))
                continue;
            m_problem = "it is not a finite number; check the device, or use another channel";
            errno = EBADMSG;
            m_access.reject();
            failAt("read", input->channel.name().toUtf8());
            return m_access.keep(now(), timeout().count());
        }
        for (const auto &input : m_inputs)
            input->channel.set(valueOf(*input), time);
        m_access.succeed(now());
        return true;
    }

    double valueOf(const Input &input) const { return (m_buffer.value(input.number) + input.offset) * input.factor; }

    /// \return false when the device is lost
    bool keepAfter(const char *operation, const QByteArray &file)
    {
        failAt(operation, file);
        return m_access.keep(now(), timeout().count());
    }

    bool failAt(const char *operation, const QByteArray &file)
    {
        const int errorNumber = errno;
        const QString place = file.isEmpty() ? QString() : QStringLiteral("'%1' of ").arg(QString::fromUtf8(file));
        const QString what
            = QStringLiteral("cannot %1 %2%3 (%4)").arg(QLatin1String(operation), place, m_device, m_folder.path());
        const QString problem = m_problem ? QString::fromLatin1(m_problem) : m_buffer.problem();
        if (!problem.isEmpty() && errorNumber == EBADMSG)
            return fail(what + QStringLiteral(": ") + problem);
        return fail(QStringLiteral("%1: %2; %3").arg(what, qt_error_string(errorNumber), remedy(errorNumber)));
    }

    QString m_root;
    QString m_device;  // "iio:ads1015"
    const SysfsClass *m_class = nullptr;
    QByteArray m_function;  // of a counter
    bool m_isSigned = false;
    int m_bits = 64;
    SysfsPwm::Settings m_common;
    QMap<QString, SysfsPwm::Settings> m_special;       // of channels with keys of their own
    QMap<QString, SysfsAnalogOutput::Range> m_ranges;  // of outputs

    bool m_isBuffered = false;
    IioBuffer::Settings m_bufferSettings;

    SysfsFolder m_folder;
    IioBuffer m_buffer;
    qint64 m_lastScan = 0;  // or the first reading [ns]
    DeviceAccess m_access{this};
    const char *m_problem = nullptr;  // with the text of the last access; null if it is right
    std::vector<std::unique_ptr<Input>> m_inputs;
    std::vector<std::unique_ptr<Output>> m_outputs;
};

}  // namespace

std::unique_ptr<QPlcDriver> createSysfsDriver()
{
    return std::make_unique<SysfsDriver>();
}

}  // namespace qplc
