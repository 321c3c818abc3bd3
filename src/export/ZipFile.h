// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>

namespace qplc_export {

/// A ZIP archive in memory. It has no clock: equal contents give equal bytes.
class ZipFile
{
public:
    /// \param name  with / between folders; ASCII
    void add(const QByteArray &name, const QByteArray &content);
    /// The whole file.
    QByteArray bytes() const;

private:
    QByteArray m_entries;
    QByteArray m_directory;
    quint16 m_count = 0;
};

}  // namespace qplc_export
