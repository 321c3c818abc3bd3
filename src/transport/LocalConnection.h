// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Descriptor.h"

#include <QtCore/QString>

#include <cstdint>
#include <vector>

namespace qplc {

/// Takes descriptors from a master of the same user: the end of a node, for one registration. See
/// LocalListener. Never waits.
class LocalConnection
{
public:
    /// Connects to the master with this session, and sends it key(). A master of another user gets
    /// nothing.
    /// \return false, with the reason in \a error
    bool open(std::uint64_t session, QString *error);
    /// Random, for this connection alone.
    std::uint64_t key() const { return m_key; }
    /// Takes the \a count descriptors that the master has passed, and closes the connection.
    /// \return nothing, with the reason in \a error, when they are not there
    std::vector<Descriptor> take(std::size_t count, QString *error);

private:
    Descriptor m_socket;
    std::uint64_t m_key = 0;
};

}  // namespace qplc
