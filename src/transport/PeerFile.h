// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <sys/stat.h>

namespace qplc {

/// A pipe or sealed memory of another program of this machine, which that program calls
/// `/proc/PID/fd/N`. The program is not trusted: it may name anything.
///
/// find() takes hold of the file and looks at it without opening it (O_PATH), so that no device,
/// pipe or file notices. The open functions open what find() has looked at, and not the path again:
/// another file that is put into its place in the meantime is not opened.
class PeerFile
{
public:
    PeerFile() = default;
    ~PeerFile();
    PeerFile(const PeerFile &) = delete;
    PeerFile &operator=(const PeerFile &) = delete;

    /// \param what for the reason, "memory" for example \param owner user who has to own the file:
    ///         that of the other program
    /// \return false, with the reason in \a error
    bool find(const QString &path, const QString &what, uid_t owner, QString *error);

    /// Opens memory of memfd_create() that is sealed against every change of its size, to read and
    /// write. \return its descriptor, -1 with the reason in \a error
    int openMemory(std::size_t size, QString *error) const;
    /// Opens a pipe to write, without waiting. \return its descriptor, -1 with the reason in \a
    /// error
    int openPipe(QString *error) const;

private:
    int reopen(int flags, QString *error) const;
    QString refusal(const QString &reason) const;

    int m_descriptor = -1;
    QString m_path;
    QString m_what;
    struct stat m_status = {};
};

}  // namespace qplc
