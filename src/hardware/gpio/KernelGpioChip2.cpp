// SPDX-License-Identifier: Apache-2.0
// By libgpiod 2.
#include "GpioChip.h"
#include "hardware/DeviceFiles.h"

#include <QtCore/QDir>
#include <QtCore/QFile>

#include <cerrno>
#include <fcntl.h>
#include <gpiod.h>

namespace qplc {

namespace {

constexpr int MostEdges = 16;

template<auto Free>
struct GpiodFree
{
    template<typename T>
    void operator()(T *object) const
    {
        Free(object);
    }
};
using ChipPointer = std::unique_ptr<gpiod_chip, GpiodFree<gpiod_chip_close>>;
using ChipInfoPointer = std::unique_ptr<gpiod_chip_info, GpiodFree<gpiod_chip_info_free>>;
using LineInfoPointer = std::unique_ptr<gpiod_line_info, GpiodFree<gpiod_line_info_free>>;
using SettingsPointer = std::unique_ptr<gpiod_line_settings, GpiodFree<gpiod_line_settings_free>>;
using LineConfigPointer = std::unique_ptr<gpiod_line_config, GpiodFree<gpiod_line_config_free>>;
using RequestConfigPointer = std::unique_ptr<gpiod_request_config, GpiodFree<gpiod_request_config_free>>;
using RequestPointer = std::unique_ptr<gpiod_line_request, GpiodFree<gpiod_line_request_release>>;
using EventsPointer = std::unique_ptr<gpiod_edge_event_buffer, GpiodFree<gpiod_edge_event_buffer_free>>;

class KernelGpioLine : public GpioLine
{
public:
    KernelGpioLine(RequestPointer request, unsigned offset)
        : m_request(std::move(request))
        , m_offset(offset)
    {
    }

    /// takeEdges() must not wait. \return false, with errno
    bool useEdges() noexcept
    {
        m_events.reset(gpiod_edge_event_buffer_new(MostEdges));
        const int descriptor = gpiod_line_request_get_fd(m_request.get());
        const int flags = ::fcntl(descriptor, F_GETFL);
        return m_events && flags >= 0 && ::fcntl(descriptor, F_SETFL, flags | O_NONBLOCK) == 0;
    }

    int value() noexcept override { return gpiod_line_request_get_value(m_request.get(), m_offset); }
    bool setValue(bool isOn) noexcept override
    {
        return gpiod_line_request_set_value(m_request.get(), m_offset,
                                            isOn ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE)
            == 0;
    }
    int takeEdges(GpioEdge *edges, int most) noexcept override
    {
        if (!m_events)
            return 0;
        const int count
            = gpiod_line_request_read_edge_events(m_request.get(), m_events.get(), std::size_t(qMin(most, MostEdges)));
        if (count < 0)
            return errno == EAGAIN ? 0 : -1;
        for (int i = 0; i < count; ++i) {
            gpiod_edge_event *event = gpiod_edge_event_buffer_get_event(m_events.get(), unsigned(i));
            edges[i].isOn = gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE;
            edges[i].time = qint64(gpiod_edge_event_get_timestamp_ns(event));
        }
        return count;
    }

private:
    RequestPointer m_request;
    EventsPointer m_events;
    const unsigned m_offset;
};

SettingsPointer settingsOf(const GpioLineRequest &request)
{
    constexpr gpiod_line_bias pulls[]
        = {GPIOD_LINE_BIAS_AS_IS, GPIOD_LINE_BIAS_DISABLED, GPIOD_LINE_BIAS_PULL_UP, GPIOD_LINE_BIAS_PULL_DOWN};
    SettingsPointer settings(gpiod_line_settings_new());
    if (!settings)
        return settings;
    gpiod_line_settings_set_active_low(settings.get(), request.isActiveLow);
    if (request.isOutput) {
        gpiod_line_settings_set_direction(settings.get(), GPIOD_LINE_DIRECTION_OUTPUT);
        gpiod_line_settings_set_output_value(settings.get(),
                                             request.isOn ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE);
        if (request.isOpenDrain)
            gpiod_line_settings_set_drive(settings.get(), GPIOD_LINE_DRIVE_OPEN_DRAIN);
    } else {
        gpiod_line_settings_set_direction(settings.get(), GPIOD_LINE_DIRECTION_INPUT);
        gpiod_line_settings_set_bias(settings.get(), pulls[request.pull]);
        if (request.wantsEdges)
            gpiod_line_settings_set_edge_detection(settings.get(), GPIOD_LINE_EDGE_BOTH);
    }
    return settings;
}

class KernelGpioChip : public GpioChip
{
public:
    KernelGpioChip(const QString &device, ChipPointer chip)
        : m_device(device)
        , m_chip(std::move(chip))
    {
    }

    bool isFree(const QString &line, QString *error) override
    {
        const int offset = find(line, error);
        if (offset < 0)
            return false;
        const LineInfoPointer info(gpiod_chip_get_line_info(m_chip.get(), unsigned(offset)));
        if (!info || !gpiod_line_info_is_used(info.get()))
            return true;
        *error = busyLine(m_device, line, QString::fromLocal8Bit(gpiod_line_info_get_consumer(info.get())));
        return false;
    }

    std::unique_ptr<GpioLine> request(const GpioLineRequest &request, QString *error) override
    {
        if (!isFree(request.line, error))
            return nullptr;
        const auto offset = unsigned(find(request.line, error));
        auto line = std::make_unique<KernelGpioLine>(requestLine(request, offset), offset);
        if (m_error == 0 && (!request.wantsEdges || line->useEdges()))
            return line;
        *error = refused(m_device, request, m_error ? m_error : errno);
        return nullptr;
    }

private:
    RequestPointer requestLine(const GpioLineRequest &request, unsigned offset)
    {
        const SettingsPointer settings = settingsOf(request);
        const LineConfigPointer lines(gpiod_line_config_new());
        const RequestConfigPointer config(gpiod_request_config_new());
        m_error = 0;
        if (!settings || !lines || !config
            || gpiod_line_config_add_line_settings(lines.get(), &offset, 1, settings.get()) < 0) {
            m_error = errno;
            return nullptr;
        }
        gpiod_request_config_set_consumer(config.get(), gpioConsumer());
        RequestPointer result(gpiod_chip_request_lines(m_chip.get(), config.get(), lines.get()));
        m_error = result ? 0 : errno;
        return result;
    }

    int find(const QString &line, QString *error)
    {
        const ChipInfoPointer info(gpiod_chip_get_info(m_chip.get()));
        const quint64 lines = info ? gpiod_chip_info_get_num_lines(info.get()) : 0;
        bool isNumber = false;
        const uint number = line.toUInt(&isNumber);
        int offset = -1;
        if (!isNumber)
            offset = gpiod_chip_get_line_offset_from_name(m_chip.get(), line.toLocal8Bit().constData());
        else if (number < lines)
            offset = int(number);
        if (offset < 0)
            *error = noSuchLine(m_device, line, lines);
        return offset;
    }

    const QString m_device;
    ChipPointer m_chip;
    int m_error = 0;
};

ChipPointer chipWithLabel(const QString &label)
{
    const QDir devices(QStringLiteral("/dev"));
    for (const QString &name : devices.entryList({QStringLiteral("gpiochip*")}, QDir::System, QDir::Name)) {
        ChipPointer chip(gpiod_chip_open(QFile::encodeName(devices.filePath(name)).constData()));
        const ChipInfoPointer info(chip ? gpiod_chip_get_info(chip.get()) : nullptr);
        if (info && label == QString::fromLocal8Bit(gpiod_chip_info_get_label(info.get())))
            return chip;
    }
    errno = ENOENT;
    return nullptr;
}

}  // namespace

std::unique_ptr<GpioChip> openKernelGpioChip(const QString &device, QString *error)
{
    const QString path = DeviceFiles::path(device);
    ChipPointer chip = QFile::exists(path) ? ChipPointer(gpiod_chip_open(QFile::encodeName(path).constData()))
                                           : chipWithLabel(device);
    if (chip)
        return std::make_unique<KernelGpioChip>(device, std::move(chip));
    *error = gpioChipErrorText(device, errno);
    return nullptr;
}

}  // namespace qplc
