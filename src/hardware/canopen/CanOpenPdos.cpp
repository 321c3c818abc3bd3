// SPDX-License-Identifier: Apache-2.0
#include "CanOpenPdos.h"

#include "QPlcDriver.h"

#include <algorithm>

namespace qplc {

void CanOpenPdos::setPlan(const CanOpenConfiguration &plan)
{
    m_isAxis = plan.isAxis;
    for (const Pdo &pdo : plan.pdos) {
        if (pdo.isTransmit) {
            m_inputs.push_back({pdo, {}, plan.freshTime(pdo)});
            continue;
        }
        Output output;
        output.pdo = pdo;
        output.frame.id = pdo.id;
        output.frame.size = quint8(pdo.size());
        for (int i = 0; i < pdo.entries.size(); ++i) {
            const PdoEntry &entry = pdo.entries.at(i);
            output.isOfAxis = output.isOfAxis || isOfAxis(entry);
            Pdo::setBits(output.frame.data.data(), pdo.firstBit(i), entry.number.bits, entry.initial);
        }
        m_outputs.push_back(std::move(output));
    }
}

// ---- channels ----

QPlcReadChannel *CanOpenPdos::readChannel(const QString &object, const QString &name)
{
    for (Input &input : m_inputs) {
        for (const auto &field : input.fields) {
            if (field.channel->name() == name)
                return field.channel.get();
        }
        const int entry = input.pdo.find(object);
        if (entry < 0)
            continue;
        input.fields.push_back({input.pdo.firstBit(entry), input.pdo.entries.at(entry).number,
                                std::make_unique<QPlcReadChannel>(m_driver, name)});
        input.fields.back().channel->setTimeout(input.freshTime);
        return input.fields.back().channel.get();
    }
    return nullptr;
}

QPlcWriteChannel *CanOpenPdos::writeChannel(const QString &name)
{
    for (Output &output : m_outputs) {
        const int entry = output.pdo.find(name);
        if (entry < 0)
            continue;
        const int first = output.pdo.firstBit(entry);
        if (isOfAxis(output.pdo.entries.at(entry)))
            return nullptr;
        for (const auto &field : output.fields) {
            if (field.first == first)
                return field.channel.get();
        }
        output.fields.push_back(
            {first, output.pdo.entries.at(entry).number, std::make_unique<QPlcWriteChannel>(m_driver, name)});
        return output.fields.back().channel.get();
    }
    return nullptr;
}

QStringList CanOpenPdos::names(bool isRead) const
{
    QStringList names;
    const auto add = [&names](const Pdo &pdo) {
        for (const PdoEntry &entry : pdo.entries)
            names << (entry.name.isEmpty() ? entry.address.toText() : entry.name);
    };
    for (const Input &input : m_inputs) {
        if (isRead)
            add(input.pdo);
    }
    for (const Output &output : m_outputs) {
        if (!isRead && !output.isOfAxis)
            add(output.pdo);
    }
    return names;
}

// ---- the cycle ----

void CanOpenPdos::begin() noexcept
{
    for (Input &input : m_inputs)
        input.isDue = input.hasCome = false;
}

const Pdo *CanOpenPdos::take(const CanFrame &frame, qint64 time) noexcept
{
    for (Input &input : m_inputs) {
        if (input.pdo.id != frame.id || frame.size < input.pdo.size())
            continue;
        input.hasCome = true;
        for (const auto &field : input.fields) {
            const quint64 bits = Pdo::bitsOf(frame.data.data(), field.first, field.number.bits);
            field.channel->set(field.number.decode(bits), time);
        }
        return &input.pdo;
    }
    return nullptr;
}

int CanOpenPdos::collect(const AxisOutputs *axis, CanFrame *frames) noexcept
{
    int count = 0;
    for (const Output &output : m_outputs) {
        bool hasAll = output.isOfAxis ? axis != nullptr : !output.fields.empty();
        for (const auto &field : output.fields)
            hasAll = hasAll && field.channel->hasValue();
        if (!hasAll)
            continue;
        CanFrame &frame = frames[count++];
        frame = output.frame;
        for (const auto &field : output.fields)
            encode(field.number, field.first, field.channel->value(), &frame);
        if (output.isOfAxis)
            encodeAxis(output.pdo, *axis, &frame);
    }
    return count;
}

void CanOpenPdos::encode(const RawNumber &number, int first, double value, CanFrame *frame) noexcept
{
    RawNumber::Fit fit = RawNumber::Fits;
    const quint64 bits = number.encode(value, &fit);
    m_saturated += fit == RawNumber::Fits ? 0 : 1;
    Pdo::setBits(frame->data.data(), first, number.bits, bits);
}

void CanOpenPdos::encodeAxis(const Pdo &pdo, const AxisOutputs &axis, CanFrame *frame) noexcept
{
    for (int i = 0; i < pdo.entries.size(); ++i) {
        const PdoEntry &entry = pdo.entries.at(i);
        if (const auto target = targetOf(axis, entry.address.index))
            encode(entry.number, pdo.firstBit(i), *target, frame);
    }
}

std::optional<double> CanOpenPdos::targetOf(const AxisOutputs &axis, quint16 index) noexcept
{
    switch (index) {
    case 0x6040:
        return double(axis.controlword);
    case 0x6060:
        return double(qint8(axis.mode));
    case 0x60FF:
        return axis.velocity;
    case 0x6071:
        return axis.torque;
    case 0x607A:
        return axis.position;
    default:
        return std::nullopt;
    }
}

bool CanOpenPdos::waitsForSync() const noexcept
{
    return std::any_of(m_outputs.begin(), m_outputs.end(),
                       [](const Output &output) { return output.pdo.isSynchronous(); });
}

void CanOpenPdos::noteSync() noexcept
{
    for (Input &input : m_inputs) {
        if (input.pdo.transmission != Pdo::EverySync)
            continue;
        m_missed += input.isDue && !input.hasCome ? 1 : 0;
        input.isDue = true;
        input.hasCome = false;
    }
}

}  // namespace qplc
