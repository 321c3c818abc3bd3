// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace qplc {

/// A name for a port of this machine, kept as a file in the run-time folder of the user. While an
/// object holds a name, portOf() finds it.
class LocalName
{
public:
    LocalName() = default;
    ~LocalName() { release(); }
    LocalName(const LocalName &) = delete;
    LocalName &operator=(const LocalName &) = delete;

    /// Publishes \a port under \a name (letters, digits, '.', '-', '_'); one that a dead master has
    /// left is taken over.
    /// \return false, with the reason in \a error
    bool hold(const QString &name, quint16 port, QString *error);
    void release();

    /// \return 0, with the reason in \a error, when nobody holds \a name
    static quint16 portOf(const QString &name, QString *error);

private:
    QString m_file;
};

}  // namespace qplc
