// SPDX-License-Identifier: Apache-2.0
#include "ChoiceKind.h"

namespace qplc {

std::unique_ptr<const TransportKind> makeAutomaticKind()
{
    return std::make_unique<ChoiceKind>(QStringLiteral("auto"), QStringLiteral("udp"), QStringLiteral("tcp"));
}

}  // namespace qplc
