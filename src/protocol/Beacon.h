// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QString>

#include <optional>

namespace qplc {

/// What a master tells of itself to whoever looks for one: docs/protocol.md, section 13. Nothing in
/// it is secret, and nothing in it is proven.
struct Beacon
{
    static constexpr int MaximumName = 64;  // [byte]
    static constexpr int MaximumSize = 17 + MaximumName + 4;
    static constexpr const char *Group = "239.255.81.80";
    static constexpr quint16 GroupPort = 50081;

    quint16 port = 0;  // of the control channel; the address is that of the sender
    bool isSecured = false;
    quint64 tableHash = 0;
    QString name;

    /// A name that is too long is cut between two characters, and an empty one becomes "master".
    /// \pre port is not 0
    QByteArray encoded() const;
    /// Nothing unless each byte is as it must be.
    static std::optional<Beacon> decode(const char *bytes, int size);

    friend bool operator==(const Beacon &a, const Beacon &b)
    {
        return a.port == b.port && a.isSecured == b.isSecured && a.tableHash == b.tableHash && a.name == b.name;
    }
};

}  // namespace qplc
