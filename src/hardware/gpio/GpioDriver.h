// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Debouncer.h"
#include "GpioChip.h"
#include "GpioLineWords.h"
#include "QPlcDriver.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"

#include <memory>
#include <vector>

namespace qplc {

/// Kind `gpio`: switches and lamps at the lines of a GPIO chip. See docs/hardware/gpio.md.
class GpioDriver : public QPlcDriver
{
public:
    GpioDriver();

protected:
    void configure(QPlcDriverSettings &settings) override;
    bool open() override;
    void close() override;
    bool read() override;
    bool write() override;
    QString remedy(int errorNumber) const override;

private:
    struct Input
    {
        Input(QPlcDriver *driver, const QString &name, const GpioLineWords &words);

        bool wantsEdges() const;
        void countEdge(bool isOn);

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
        Output(QPlcDriver *driver, const QString &name, const GpioLineWords &words);

        const GpioLineWords words;
        QPlcWriteChannel value;
        std::unique_ptr<GpioLine> line;  // null until there is a value
        bool isOn = false;
    };

    bool openInput(Input *input);
    bool openOutput(Output *output);
    bool takeOutput(Output *output);
    bool read(Input *input);
    bool write(Output *output);

    QString m_device;
    QByteArray m_readOperation;  // for errors in a cycle
    QByteArray m_writeOperation;
    std::unique_ptr<GpioChip> m_chip;
    std::vector<std::unique_ptr<Input>> m_inputs;
    std::vector<std::unique_ptr<Output>> m_outputs;
};

}  // namespace qplc
