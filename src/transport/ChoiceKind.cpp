// SPDX-License-Identifier: Apache-2.0
#include "ChoiceKind.h"

#include "TransportRegistry.h"

namespace qplc {

ChoiceKind::ChoiceKind(const QString &name, const QString &first, const QString &fallback)
    : m_name(name)
    , m_first(first)
    , m_fallback(fallback)
{
}

const TransportKind *ChoiceKind::first() const
{
    return TransportRegistry::instance().named(m_first);
}

const TransportKind *ChoiceKind::fallback() const
{
    return TransportRegistry::instance().named(m_fallback);
}

bool ChoiceKind::admits(const CyclicHub &hub, const Newcomer &node, ChannelError *error) const
{
    return first()->admits(hub, node, error) && fallback()->admits(hub, node, error);
}

bool ChoiceKind::beginLink(const ControlEnds &ends, QJsonObject *request, std::unique_ptr<CyclicLink> *link,
                           QString *error) const
{
    return first()->beginLink(ends, request, link, error);
}

}  // namespace qplc
