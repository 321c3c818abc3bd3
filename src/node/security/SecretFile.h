// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QString>

namespace qplc {

/// A file that only its owner may read, like one with keys, or that only its owner may change, like
/// one with rights or certificates.
class SecretFile
{
public:
    static constexpr int MaximumSize = 1024 * 1024;  // [byte]

    enum Need : quint8 { Secret, Trusted };

    /// Reads a file of this user (or root's) that nobody else may read or change (Secret), or
    /// change (Trusted).
    /// \return false, with file and remedy in \a error, when it is not such a file
    static bool read(const QString &fileName, Need need, QByteArray *content, QString *error);
    /// Writes the file as a whole, or leaves it as it was; its mode becomes 0600.
    /// \return whether it is written; \a problem says if it then may not survive a loss of power
    static bool write(const QString &fileName, const QByteArray &content, QString *problem);
};

}  // namespace qplc
