// SPDX-License-Identifier: Apache-2.0
#include "SdoFrame.h"

#include <algorithm>

namespace qplc {

SdoFrame::Data SdoFrame::make(quint8 command, ObjectAddress address, quint32 rest)
{
    return {command,      quint8(address.index), quint8(address.index >> 8), address.sub,
            quint8(rest), quint8(rest >> 8),     quint8(rest >> 16),         quint8(rest >> 24)};
}

ObjectAddress SdoFrame::addressOf(const Data &data)
{
    return {quint16(data[1] | data[2] << 8), data[3]};
}

quint32 SdoFrame::restOf(const Data &data)
{
    return quint32(data[4]) | quint32(data[5]) << 8 | quint32(data[6]) << 16 | quint32(data[7]) << 24;
}

CanFrame SdoFrame::toFrame(quint32 id, const Data &data)
{
    CanFrame frame;
    frame.id = id;
    frame.size = Size;
    std::copy(data.begin(), data.end(), frame.data.begin());
    return frame;
}

SdoFrame::Data SdoFrame::fromFrame(const CanFrame &frame)
{
    Data data;
    std::copy_n(frame.data.begin(), data.size(), data.begin());
    return data;
}

}  // namespace qplc
