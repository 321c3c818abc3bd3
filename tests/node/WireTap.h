// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QVector>

#include <functional>

/// What this process gives to the network, and what it seals: the functions of the C library and of
/// libsodium that send and seal are replaced for the whole program.
namespace wire {

/// A cyclic frame as it was given to the kernel.
struct Sent
{
    int descriptor = -1;
    QByteArray address;  // of the receiver, as the kernel knows it; empty: that of the connection
    QByteArray bytes;
};

/// Forgets everything, and keeps what is sent from now on.
void listen();
/// Everything that was sent since listen().
QVector<Sent> heard();
/// Those for which \a isWanted holds.
QVector<Sent> heard(const std::function<bool(const Sent &)> &isWanted);
/// Sends \a bytes the way that \a before went: from the same address to the same one, as somebody
/// who forges addresses would.
void forge(const Sent &before, const QByteArray &bytes);

/// What became of the nonces since resetSeals().
struct Seals
{
    quint64 frames = 0;     // that were sealed
    quint64 repeated = 0;   // the same frame under the same key and nonce as before
    quint64 conflicts = 0;  // another frame under the same key and nonce as before
    int keys = 0;
};
void resetSeals();
Seals seals();

}  // namespace wire
