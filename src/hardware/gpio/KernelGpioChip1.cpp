// SPDX-License-Identifier: Apache-2.0
// By libgpiod 1.6 (Debian 12).
#include "GpioChip.h"

#include <QtCore/QFile>

#include <cerrno>
#include <fcntl.h>
#include <gpiod.h>

namespace qplc {

namespace {

constexpr int MostEdges = 16;  // what the kernel keeps for a line

class KernelGpioLine : public GpioLine
{
public:
    explicit KernelGpioLine(gpiod_line *line)
        : m_line(line)
    {
    }
    ~KernelGpioLine() override { gpiod_line_release(m_line); }

    /// takeEdges() must not wait. \return false, with errno
    bool useEdges() noexcept
    {
        m_edges = gpiod_line_event_get_fd(m_line);
        const int flags = m_edges < 0 ? -1 : ::fcntl(m_edges, F_GETFL);
        return flags >= 0 && ::fcntl(m_edges, F_SETFL, flags | O_NONBLOCK) == 0;
    }

    int value() noexcept override { return gpiod_line_get_value(m_line); }
    bool setValue(bool isOn) noexcept override { return gpiod_line_set_value(m_line, isOn) == 0; }
    int takeEdges(GpioEdge *edges, int most) noexcept override
    {
        if (m_edges < 0)
            return 0;
        gpiod_line_event events[MostEdges];
        const int count = gpiod_line_event_read_fd_multiple(m_edges, events, unsigned(qMin(most, MostEdges)));
        if (count < 0)
            return errno == EAGAIN ? 0 : -1;
        for (int i = 0; i < count; ++i) {
            edges[i].isOn = events[i].event_type == GPIOD_LINE_EVENT_RISING_EDGE;
            edges[i].time = qint64(events[i].ts.tv_sec) * 1'000'000'000 + events[i].ts.tv_nsec;
        }
        return count;
    }

private:
    gpiod_line *m_line;
    int m_edges = -1;
};

class KernelGpioChip : public GpioChip
{
public:
    KernelGpioChip(const QString &device, gpiod_chip *chip)
        : m_device(device)
        , m_chip(chip)
    {
    }
    ~KernelGpioChip() override { gpiod_chip_close(m_chip); }

    bool isFree(const QString &name, QString *error) override
    {
        gpiod_line *line = find(name, error);
        if (!line)
            return false;
        if (!gpiod_line_is_used(line))
            return true;
        *error = busyLine(m_device, name, QString::fromLocal8Bit(gpiod_line_consumer(line)));
        return false;
    }

    std::unique_ptr<GpioLine> request(const GpioLineRequest &request, QString *error) override
    {
        if (!isFree(request.line, error))
            return nullptr;
        gpiod_line *line = find(request.line, error);
        const gpiod_line_request_config config = {gpioConsumer(), type(request), flags(request)};
        if (gpiod_line_request(line, &config, request.isOn) < 0) {
            *error = refused(m_device, request, errno);
            return nullptr;
        }
        auto result = std::make_unique<KernelGpioLine>(line);
        if (request.wantsEdges && !result->useEdges()) {
            *error = refused(m_device, request, errno);
            return nullptr;
        }
        return result;
    }

private:
    gpiod_line *find(const QString &name, QString *error)
    {
        bool isNumber = false;
        const uint offset = name.toUInt(&isNumber);
        gpiod_line *line = nullptr;
        if (!isNumber)
            line = gpiod_chip_find_line(m_chip, name.toLocal8Bit().constData());
        else if (offset < gpiod_chip_num_lines(m_chip))
            line = gpiod_chip_get_line(m_chip, offset);
        if (!line)
            *error = noSuchLine(m_device, name, gpiod_chip_num_lines(m_chip));
        return line;
    }

    static int type(const GpioLineRequest &request)
    {
        if (request.isOutput)
            return GPIOD_LINE_REQUEST_DIRECTION_OUTPUT;
        return request.wantsEdges ? GPIOD_LINE_REQUEST_EVENT_BOTH_EDGES : GPIOD_LINE_REQUEST_DIRECTION_INPUT;
    }

    static int flags(const GpioLineRequest &request)
    {
        constexpr int pulls[] = {0, GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE, GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP,
                                 GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN};
        return pulls[request.pull] | (request.isActiveLow ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0)
            | (request.isOpenDrain ? GPIOD_LINE_REQUEST_FLAG_OPEN_DRAIN : 0);
    }

    const QString m_device;
    gpiod_chip *m_chip;
};

}  // namespace

std::unique_ptr<GpioChip> openKernelGpioChip(const QString &device, QString *error)
{
    errno = 0;
    gpiod_chip *chip = gpiod_chip_open_lookup(QFile::encodeName(device).constData());
    if (chip)
        return std::make_unique<KernelGpioChip>(device, chip);
    *error = gpioChipErrorText(device, errno ? errno : ENOENT);
    return nullptr;
}

}  // namespace qplc
