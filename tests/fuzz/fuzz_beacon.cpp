// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "protocol/Beacon.h"
#include "protocol/Crc32c.h"

#include <QtCore/QtEndian>

namespace {

void look(const QByteArray &datagram)
{
    const std::optional<qplc::Beacon> beacon = qplc::Beacon::decode(datagram.constData(), datagram.size());
    if (!beacon)
        return;
    fuzz::check(beacon->port != 0 && !beacon->name.isEmpty(), "a beacon has a port and a name");
    fuzz::check(beacon->encoded() == datagram, "a beacon has one form only");
}

}  // namespace

// Input: a datagram that somebody sends to those who look for a master; then the same with the
// checksum that it should have.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    fuzz::Input input(data, size);
    QByteArray datagram = input.bytes(size);
    look(datagram);
    const int summed = datagram.size() - int(sizeof(quint32));
    if (summed < 0)
        return 0;
    qToLittleEndian(qplc::crc32c(0, datagram.constData(), std::size_t(summed)), datagram.data() + summed);
    look(datagram);
    return 0;
}
