// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "hardware/can/CanFrame.h"
#include "hardware/can/DbcFile.h"

namespace {

// What lies in a frame can be taken out and put back.
void exchange(const qplc::DbcMessage &message)
{
    QByteArray bytes(message.size, char(0xA5));
    auto *data = reinterpret_cast<quint8 *>(bytes.data());
    for (const qplc::DbcSignal &signal : message.content) {
        fuzz::check(signal.neededBytes() <= message.size, "a signal lies in its message");
        const quint64 bits = signal.bits(data);
        signal.encode(data, signal.decode(data));
        signal.setBits(data, bits);
        fuzz::check(signal.bits(data) == bits && bytes == QByteArray(message.size, char(0xA5)),
                    "bits that are put back are the same");
    }
}

// What is in a frame follows from multiplexors that are in it.
void select(const qplc::DbcMessage &message)
{
    const QByteArray bytes(message.size, char(0xA5));
    const auto *data = reinterpret_cast<const quint8 *>(bytes.constData());
    bool hasPage = false;
    for (const qplc::DbcSignal &signal : message.content) {
        fuzz::check(signal.multiplexor < message.content.size(), "a multiplexor is one of the signals");
        fuzz::check(message.depthOf(signal) < message.content.size(), "multiplexors have an end");
        fuzz::check(signal.isMultiplexed() == (signal.multiplexor >= 0), "a page is that of a multiplexor");
        const bool isThere = message.isThere(signal, data);
        hasPage = hasPage || (isThere && signal.isMultiplexed());
        if (isThere && signal.isMultiplexed())
            fuzz::check(message.isThere(message.content.at(signal.multiplexor), data), "and so is its multiplexor");
    }
    fuzz::check(message.hasPage(data) == hasPage, "a frame has a page when it has a signal of one");
    for (const auto &pair : message.overlappingSignals())
        fuzz::check(message.find(pair.first) && message.find(pair.second), "signals that overlap have names");
}

}  // namespace

// Input: a DBC file. Whatever is read without an error can be used.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    const QByteArray text(reinterpret_cast<const char *>(data), int(size));
    QVector<QPlcParseError> errors;
    const qplc::DbcFile file = qplc::DbcFile::fromText(text, QStringLiteral("fuzzed.dbc"), &errors);
    fuzz::check(file.isEmpty() != errors.isEmpty(), "a file has messages, or else errors");
    fuzz::check(errors.size() <= qplc::DbcFile::MaximumErrors, "errors have an end");
    for (const QPlcParseError &error : errors)
        fuzz::check(!error.toString().isEmpty() && error.line >= 0 && error.column >= 0, "an error has a place");
    for (const qplc::DbcMessage &message : file.messages()) {
        fuzz::check(file.find(message.name) == &message, "each message has its own name");
        fuzz::check(!message.unsupported.isEmpty() || qplc::CanFrame::isSize(message.size, message.isFd),
                    "a message fits into a frame");
        exchange(message);
        if (message.unsupported.isEmpty())
            select(message);
    }
    return 0;
}
