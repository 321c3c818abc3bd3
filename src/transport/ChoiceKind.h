// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TransportKind.h"

namespace qplc {

/// A node that does not say how its frames travel: over the first of two transports if datagrams
/// get through in both directions, else over the second one.
class ChoiceKind final : public TransportKind
{
public:
    ChoiceKind(const QString &name, const QString &first, const QString &fallback);

    QString name() const override { return m_name; }
    bool isOfMachine() const override { return first()->isOfMachine(); }
    const TransportKind *first() const override;
    const TransportKind *fallback() const override;

    bool admits(const CyclicHub &hub, const Newcomer &node, ChannelError *error) const override;
    bool beginLink(const ControlEnds &ends, QJsonObject *request, std::unique_ptr<CyclicLink> *link,
                   QString *error) const override;

private:
    const QString m_name;
    const QString m_first;
    const QString m_fallback;
};

}  // namespace qplc
