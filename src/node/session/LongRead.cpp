// SPDX-License-Identifier: Apache-2.0
#include "LongRead.h"

#include "protocol/messages/MessageTable.h"

#include <utility>

namespace qplc {

void LongRead::read()
{
    error = ControlFrameReader::read(frame, &message, &errorText);
    frame.bytes.clear();
    if (error != ControlFrameReader::NoError || message.kind() != QPlcMessage::Register)
        return;
    if (std::optional<messages::Register> read = messages::readAs<messages::Register>(message, &fault))
        registration = std::make_shared<const messages::Register>(std::move(*read));
}

}  // namespace qplc
