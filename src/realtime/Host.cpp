// SPDX-License-Identifier: Apache-2.0
#include "Host.h"

#include "Machine.h"

#include <QtCore/QUuid>

namespace qplc {

namespace {

thread_local Host *entered = nullptr;

}  // namespace

Strand::~Strand() = default;
Host::~Host() = default;

Host &Host::machine() noexcept
{
    static Machine &machine = *new Machine;  // for ever: objects that end with the program use it, too
    return machine;
}

Host &Host::current() noexcept
{
    return entered ? *entered : machine();
}

Host *Host::enter(Host *host) noexcept
{
    Host *before = entered;
    entered = host;
    return before;
}

QString newUuid()
{
    const std::uint64_t high = Host::current().random();
    const std::uint64_t low = Host::current().random();
    // Version 4, variant 1 of RFC 4122.
    const QUuid uuid(uint(high >> 32), ushort(high >> 16), ushort((high & 0x0FFF) | 0x4000),
                     uchar((low >> 56 & 0x3F) | 0x80), uchar(low >> 48), uchar(low >> 40), uchar(low >> 32),
                     uchar(low >> 24), uchar(low >> 16), uchar(low >> 8), uchar(low));
    return uuid.toString(QUuid::WithoutBraces);
}

double randomFraction()
{
    return double(Host::current().random() >> 11) * 0x1p-53;
}

}  // namespace qplc
