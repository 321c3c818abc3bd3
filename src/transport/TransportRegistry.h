// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TransportKind.h"

#include <vector>

namespace qplc {

/// All transports by name.
///
/// Those of the list in CMakeLists.txt are there from the begin on, in the order of
/// QPlcUnderlyingProtocol::Kind. Others join at run time; their kinds have the numbers that follow.
class TransportRegistry
{
public:
    static TransportRegistry &instance();

    /// From now on masters and nodes know \a kind, until the program ends. To be called before
    /// there are masters, nodes, and other threads.
    /// \return false, with the reason in \a error, when the name is taken or no name
    bool add(std::unique_ptr<const TransportKind> kind, QString *error);

    /// Null: there is none.
    const TransportKind *named(const QString &name) const;
    /// Null: there is none. \param number  as in QPlcUnderlyingProtocol::Kind
    const TransportKind *at(int number) const;
    /// 0: there is none.
    int numberOf(const QString &name) const;
    const std::vector<std::unique_ptr<const TransportKind>> &kinds() const { return m_kinds; }
    /// Those that Host::current() has: "tcp://, udp:// or local://", with :// behind each name.
    QString namesText(const QString &behind = QString()) const;

private:
    TransportRegistry();

    std::vector<std::unique_ptr<const TransportKind>> m_kinds;
};

}  // namespace qplc
