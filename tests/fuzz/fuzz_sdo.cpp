// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "hardware/canopen/CanOpenDevice.h"
#include "hardware/canopen/CanOpenMonitor.h"
#include "hardware/canopen/SdoTransfer.h"

#include <algorithm>

namespace {

using qplc::SdoTransfer;

// A transfer with everything that a device may answer.
void run(SdoTransfer transfer, fuzz::Input *input)
{
    int bytes = 0;
    while (!input->atEnd() && transfer.state() == SdoTransfer::Running) {
        fuzz::check(transfer.hasRequest() || bytes > 0, "it begins with a request");
        transfer.sent();
        SdoTransfer::Data response{};
        const QByteArray frame = input->bytes(response.size());
        std::copy(frame.begin(), frame.end(), response.begin());
        const SdoTransfer::Data before = transfer.request();
        const bool isTaken = transfer.take(response);
        bytes += int(response.size());
        fuzz::check(isTaken || (transfer.state() == SdoTransfer::Running && transfer.request() == before),
                    "an answer to somebody else changes nothing");
        fuzz::check(transfer.value().size() <= SdoTransfer::MaximumSize, "a value has an end");
        fuzz::check(transfer.isWrite() || transfer.value().size() <= bytes, "a value comes from the device");
    }
    if (transfer.state() == SdoTransfer::Done)
        fuzz::check(!transfer.hasRequest(), "what is done asks for nothing");
    if (transfer.state() == SdoTransfer::Aborted)
        fuzz::check(!SdoTransfer::abortText(transfer.abortCode()).isEmpty(), "a reason has words");
}

}  // namespace

// Input: what a device sends, and what a master sends to a device that is played. The first byte
// chooses what it was asked for.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    fuzz::Input input(data, size);
    const auto kind = input.number<quint8>();
    const qplc::ObjectAddress address{0x1008, 0};
    if (kind % 3 == 0)
        run(SdoTransfer::read(address), &input);
    else if (kind % 3 == 1)
        run(SdoTransfer::write(address, QByteArray(kind / 4, 'x')), &input);
    qplc::CanOpenMonitor monitor;
    qplc::CanOpenDevice device(5);
    device.objects().add({0x2000, 1}, QByteArray(4, '\0'), qplc::CanOpenObjects::ReadWrite);
    device.objects().add({0x2000, 2}, QByteArray(20, '\0'), qplc::CanOpenObjects::ReadWrite);
    qplc::CanOpenDevice::Frames out;
    qint64 now = 0;
    while (!input.atEnd()) {
        qplc::CanFrame frame;
        frame.id = input.number<quint16>();
        frame.size = quint8(input.number<quint8>() % 9);
        const QByteArray bytes = input.bytes(frame.size);
        std::copy(bytes.begin(), bytes.end(), frame.data.begin());
        if (monitor.take(frame, 5, 1))
            fuzz::check(frame.id == 0x705 || frame.id == 0x85, "only the device tells of itself");
        fuzz::check(!monitor.emergency().text().isEmpty(), "an emergency has words");
        monitor.look(2, 1);
        device.take(frame, now, &out);
        device.tick(now += 10'000'000, &out);
        fuzz::check(out.size() <= 20, "a frame has few answers");
        for (const qplc::CanFrame &answer : out)
            fuzz::check(answer.size <= 8 && answer.id <= qplc::CanFrame::StandardIds, "an answer is a frame");
        out.clear();
        fuzz::check(device.objects().find({0x2000, 2})->value.size() == 20, "an object keeps its size");
    }
    return 0;
}
