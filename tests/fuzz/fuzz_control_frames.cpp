// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "protocol/ControlFrame.h"

#include <vector>

namespace {

struct Reading
{
    std::vector<QPlcMessage> messages;
    qplc::ControlFrameReader::Error error = qplc::ControlFrameReader::NoError;
};

/// \param pieces  length of the pieces in which the stream arrives
Reading read(const QByteArray &stream, int pieces)
{
    Reading reading;
    qplc::ControlFrameReader reader;
    QPlcMessage message;
    for (int i = 0; i < stream.size(); i += pieces) {
        reader.append(stream.mid(i, pieces));
        while (reader.next(&message))
            reading.messages.push_back(message);
    }
    reading.error = reader.error();
    fuzz::check((reading.error == qplc::ControlFrameReader::NoError) == reader.errorString().isEmpty(),
                "an error has a text");
    return reading;
}

void writeAgain(const QPlcMessage &message)
{
    const QByteArray frame = qplc::encodeControlFrame(message);
    if (frame.isEmpty())
        return;  // its escapes made it too long
    qplc::ControlFrameReader reader;
    reader.append(frame);
    QPlcMessage again;
    fuzz::check(reader.next(&again), "what was written can be read");
    fuzz::check(qplc::encodeControlFrame(again) == frame, "what was read again is the same");
}

}  // namespace

// Input: the bytes of a control channel.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    const QByteArray stream(reinterpret_cast<const char *>(data), int(size));
    const Reading whole = read(stream, stream.size());
    const Reading pieces = read(stream, 1 + stream.size() / 7);
    fuzz::check(whole.messages == pieces.messages && whole.error == pieces.error,
                "it does not matter how a stream is cut");
    for (const QPlcMessage &message : whole.messages) {
        writeAgain(message);
        message.bytes(QStringLiteral("values"));
        message.hex64(QStringLiteral("token"));
    }
    return 0;
}
