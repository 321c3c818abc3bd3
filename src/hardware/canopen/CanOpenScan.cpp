// SPDX-License-Identifier: Apache-2.0
#include "CanOpenScan.h"

#include "CanOpenClient.h"
#include "signals/MessageText.h"

#include <array>

namespace qplc {

namespace {

constexpr std::chrono::milliseconds scanAnswerTime{50};  // of a device that has answered before
constexpr std::chrono::milliseconds scanPause{1};        // between two questions: they are no flood

/// What was heard of each node id.
struct Heard
{
    std::array<bool, CanOpenIds::MaximumNode + 1> answers{};
    std::array<NmtState, CanOpenIds::MaximumNode + 1> states;

    Heard() { states.fill(NmtState::Unknown); }
    void take(const CanFrame &frame)
    {
        const quint32 node = frame.id & 0x7F;
        if (frame.flags != 0 || node == 0)
            return;
        if (frame.id == CanOpenIds::SdoResponse + node && frame.size == SdoFrame::Size)
            answers[node] = true;
        else if (frame.id == CanOpenIds::Heartbeat + node && frame.size >= 1)
            states[node] = NmtState(frame.data[0] & 0x7F);
    }
};

CanFrame questionFor(int node)
{
    return SdoFrame::toFrame(CanOpenIds::SdoRequest + quint32(node), SdoTransfer::read({0x1000, 0}).request());
}

// What it does not have stays 0 and empty.
void readDevice(CanBus *bus, const QString &name, CanOpenScan::Device *device)
{
    CanOpenClient client(*bus, name, device->node, scanAnswerTime);
    QByteArray text;
    client.readNumber({0x1000, 0}, &device->type);
    client.readNumber({0x1018, 1}, &device->vendor);
    client.readNumber({0x1018, 2}, &device->product);
    client.readNumber({0x1018, 3}, &device->revision);
    client.readNumber({0x1018, 4}, &device->serial);
    if (client.read({0x1008, 0}, &text))
        device->name = printable(QString::fromLatin1(text).remove(QChar(0)).left(40));
}

}  // namespace

bool CanOpenScan::run(const QString &device, std::chrono::nanoseconds time, QVector<Device> *devices, QString *error)
{
    const std::unique_ptr<CanBus> bus = CanBus::make(device, error);
    if (!bus)
        return false;
    CanBus::Options options;
    for (quint32 node = 1; node <= quint32(CanOpenIds::MaximumNode); ++node) {
        options.keys.push_back(CanOpenIds::SdoResponse + node);
        options.keys.push_back(CanOpenIds::Heartbeat + node);
    }
    if (!bus->open(options)) {
        *error = bus->errorString();
        return false;
    }
    Heard heard;
    CanOpenClient all(*bus, device, 0, scanAnswerTime);
    all.setListener([&heard](const CanFrame &frame) { heard.take(frame); });
    const auto never = [] { return false; };
    for (int node = 1; node <= CanOpenIds::MaximumNode; ++node) {
        const CanFrame question = questionFor(node);
        if (!all.send(question)) {
            *error = all.errorString();
            return false;
        }
        all.waitUntil(never, scanPause);
    }
    all.waitUntil(never, time);
    for (int node = 1; node <= CanOpenIds::MaximumNode; ++node) {
        Device found;
        found.node = node;
        found.state = heard.states[std::size_t(node)];
        found.hasAnswered = heard.answers[std::size_t(node)];
        if (found.hasAnswered)
            readDevice(bus.get(), device, &found);
        if (found.hasAnswered || found.state != NmtState::Unknown)
            devices->append(found);
    }
    bus->close();
    return true;
}

QString CanOpenScan::profileText(quint32 type)
{
    switch (type & 0xFFFF) {
    case 401:
        return QStringLiteral("inputs and outputs (401)");
    case 402:
        return QStringLiteral("drive (402)");
    case 404:
        return QStringLiteral("measuring device (404)");
    case 405:
        return QStringLiteral("controller (405)");
    case 406:
        return QStringLiteral("encoder (406)");
    default:
        return QStringLiteral("profile %1").arg(type & 0xFFFF);
    }
}

}  // namespace qplc
