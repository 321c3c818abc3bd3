// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QVector>

namespace qplc {

/// Some bytes that all programs of this user on this machine can read while the program lives that
/// put them up: a file in a folder of the user, which is locked. The system takes the lock off when
/// the program ends, however it ends; so a notice without a lock is one of the dead.
class LocalNotice
{
public:
    static constexpr int MaximumSize = 512;  // [byte]
    static constexpr int MaximumCount = 64;  // as many are read

    LocalNotice() = default;
    ~LocalNotice() { withdraw(); }
    LocalNotice(const LocalNotice &) = delete;
    LocalNotice &operator=(const LocalNotice &) = delete;

    /// Puts \a content up, in place of what was up before, and tidies up after the dead. \return
    /// false when there is no folder for it
    bool post(const QByteArray &content);
    void withdraw();

    /// The notices of all that live, in no order.
    static QVector<QByteArray> all();

private:
    QByteArray m_file;
    int m_descriptor = -1;
};

}  // namespace qplc
