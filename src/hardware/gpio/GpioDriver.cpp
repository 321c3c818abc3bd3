// SPDX-License-Identifier: Apache-2.0
#include "Debouncer.h"
#include "GpioChip.h"
#include "GpioLineWords.h"
#include "QPlcDriverSettings.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"
#include "hardware/Drivers.h"

#include <cerrno>
#include <limits>
#include <vector>

namespace qplc {

namespace {

constexpr int MostEdgesAtOnce = 16;
constexpr int MostEdgesPerCycle = 16 * MostEdgesAtOnce;  // a line that never rests must not hold the cycle

/// Kinds `gpio` and `gpio-expander`: switches and lamps at the lines of a GPIO chip, in the cycle,
/// or at a pace of their own, because the chip is behind a slow bus. See docs/hardware/gpio.md.
class GpioDriver final : public QPlcDriver
{
public:
    explicit GpioDriver(Pace pace)
        : QPlcDriver(pace)
    {
    }

protected:
    void configure(QPlcDriverSettings &settings) override
    {
        m_device = settings.requiredText(QStringLiteral("device"), QStringLiteral("gpiochip0"));
        m_readOperation = "cannot read a line of " + m_device.toLocal8Bit();
        m_writeOperation = "cannot write a line of " + m_device.toLocal8Bit();
        bool hasLines = false;
        for (const bool isOutput : {false, true}) {
            const QString prefix = isOutput ? QStringLiteral("output.") : QStringLiteral("input.");
            const QStringList names = settings.namesBehind(prefix);
            hasLines = hasLines || !names.isEmpty();
            for (const QString &name : names) {
                GpioLineWords words;
                const QString error = GpioLineWords::read(settings.list(prefix + name), isOutput, &words);
                if (error.isEmpty())
                    settings.claim(prefix + name,
                                   QStringLiteral("line %1 of %2").arg(words.request.line, chipName(m_device)));
                if (!error.isEmpty())
                    settings.addError(prefix + name, error);
                else if (isOutput)
                    m_outputs.push_back(std::make_unique<Output>(this, name, words));
                else
                    m_inputs.push_back(std::make_unique<Input>(this, name, words));
            }
        }
        if (!hasLines)
            settings.addError(QString(),
                              QStringLiteral("no line of the chip is used; say 'input.NAME = LINE' or "
                                             "'output.NAME = LINE'"));
    }

    bool open() override
    {
        QString error;
        m_chip = GpioChip::open(m_device, &error);
        if (!m_chip)
            return fail(error);
        for (const auto &input : m_inputs) {
            if (!openInput(input.get())) {
                close();
                return false;
            }
        }
        for (const auto &output : m_outputs) {
            if (!openOutput(output.get())) {
                close();
                return false;
            }
        }
        return true;
    }

    void close() override
    {
        for (const auto &input : m_inputs)
            input->line.reset();
        for (const auto &output : m_outputs)
            output->line.reset();
        m_chip.reset();
    }

    bool read() override
    {
        for (const auto &input : m_inputs) {
            if (!read(input.get()))
                return fail(m_readOperation.constData(), errno);
        }
        return true;
    }

    bool write() override
    {
        for (const auto &output : m_outputs) {
            if (output->value.hasValue() && !write(output.get()))
                return false;
        }
        return true;
    }

    QString remedy(int errorNumber) const override
    {
        if (errorNumber == ENODEV || errorNumber == ENXIO)
            return QStringLiteral("the chip is gone: plug it in again");
        if (errorNumber == EBUSY)
            return QStringLiteral("another program has the line: 'gpioinfo' tells which");
        return QPlcDriver::remedy(errorNumber);
    }

private:
    /// "gpiochip0" of "/dev/gpiochip0".
    static QString chipName(QString device) { return device.remove(QStringLiteral("/dev/")); }

    struct Input
    {
        Input(QPlcDriver *driver, const QString &name, const GpioLineWords &lineWords)
            : words(lineWords)
            , value(driver, name)
            , edges(driver, name + QStringLiteral(".@edges"))
            , time(driver, name + QStringLiteral(".@time"))
            , debouncer(lineWords.debounce)
        {
            time.setTimeout(std::chrono::nanoseconds::zero());  // it is old by its nature
            const GpioLineRequest &request = words.request;
            if (request.pull == GpioLineRequest::AsItIs)
                value.setTornValue(std::numeric_limits<double>::quiet_NaN());
            else if (request.pull != GpioLineRequest::NoPull)
                value.setTornValue((request.pull == GpioLineRequest::PullUp) != request.isActiveLow ? 1.0 : 0.0);
        }

        bool wantsEdges() const { return words.debounce > 0 || edges.isWired() || time.isWired(); }
        void countEdge(bool isOn)
        {
            if (!(words.edges & (isOn ? GpioLineWords::Rising : GpioLineWords::Falling)))
                return;
            ++count;
            time.set(double(debouncer.edgeTime()) * 1e-9, debouncer.edgeTime());
        }

        const GpioLineWords words;
        QPlcReadChannel value;  // 0 or 1
        QPlcReadChannel edges;  // that were counted
        QPlcReadChannel time;   // of the last of them, monotonic [s]
        Debouncer debouncer;
        quint64 count = 0;
        std::unique_ptr<GpioLine> line;
    };
    struct Output
    {
        Output(QPlcDriver *driver, const QString &name, const GpioLineWords &lineWords)
            : words(lineWords)
            , value(driver, name)
        {
            value.setRange(0.0, 1.0);
            if (!words.isKept)
                value.setRestValue(0.0);
        }

        const GpioLineWords words;
        QPlcWriteChannel value;
        std::unique_ptr<GpioLine> line;  // null until there is a value
        bool isOn = false;
    };

    bool openInput(Input *input)
    {
        QString error;
        GpioLineRequest request = input->words.request;
        // Expanders often have no edges: what is read at the interval is what counts.
        request.wantsEdges = pace() == EveryCycle && input->wantsEdges();
        input->debouncer.reset();
        input->line = m_chip->request(request, &error);
        return input->line || fail(error);
    }

    // A line is only looked at until write() knows its value: to drive it before would be a jump at
    // the device.
    bool openOutput(Output *output)
    {
        QString error;
        return m_chip->isFree(output->words.request.line, &error) || fail(error);
    }

    bool takeOutput(Output *output)
    {
        QString error;
        GpioLineRequest request = output->words.request;
        request.isOn = output->isOn = output->value.isOn();
        output->line = m_chip->request(request, &error);
        return output->line || fail(error);
    }

    bool read(Input *input)
    {
        GpioEdge edges[MostEdgesAtOnce];
        for (int taken = 0; taken < MostEdgesPerCycle;) {
            const int count = input->line->takeEdges(edges, MostEdgesAtOnce);
            if (count < 0)
                return false;
            for (int i = 0; i < count; ++i) {
                if (input->debouncer.feed(edges[i].isOn, edges[i].time))
                    input->countEdge(input->debouncer.isOn());
            }
            if (count < MostEdgesAtOnce)
                break;
            taken += count;
        }
        // The level tells the truth also when the kernel has lost edges, and it ends the time of
        // debouncing.
        const int value = input->line->value();
        if (value < 0)
            return false;
        if (input->debouncer.feed(value == 1, now()))
            input->countEdge(input->debouncer.isOn());
        input->value.set(input->debouncer.isOn() ? 1.0 : 0.0, now());
        input->edges.set(double(input->count), now());
        return true;
    }

    bool write(Output *output)
    {
        if (!output->line)  // the first value is the safe one, before the first cycle: this may take memory and time
            return takeOutput(output);
        const bool isOn = output->value.isOn();
        if (isOn == output->isOn || (output->words.isKept && output->value.isSafe()))
            return true;
        output->isOn = isOn;
        return output->line->setValue(isOn) || fail(m_writeOperation.constData(), errno);
    }

    QString m_device;
    QByteArray m_readOperation;  // for errors in a cycle
    QByteArray m_writeOperation;
    std::unique_ptr<GpioChip> m_chip;
    std::vector<std::unique_ptr<Input>> m_inputs;
    std::vector<std::unique_ptr<Output>> m_outputs;
};

}  // namespace

std::unique_ptr<QPlcDriver> createGpioDriver()
{
    return std::make_unique<GpioDriver>(QPlcDriver::EveryCycle);
}

std::unique_ptr<QPlcDriver> createGpioExpanderDriver()
{
    return std::make_unique<GpioDriver>(QPlcDriver::OwnPace);
}

}  // namespace qplc
