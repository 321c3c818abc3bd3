// SPDX-License-Identifier: Apache-2.0
#include "LocalListener.h"

#include "DescriptorMessage.h"
#include "LocalSocket.h"
#include "realtime/TimeSource.h"

#include <algorithm>
#include <cerrno>
#include <chrono>

namespace qplc {

namespace {

constexpr int Backlog = 256;                            // connections in the queue of the kernel
constexpr std::int64_t LongestWaiting = 5'000'000'000;  // [ns] from its connection to its registration

}  // namespace

bool LocalListener::open(std::uint64_t session, QString *error)
{
    close();
    sockaddr_un address;
    const socklen_t length = LocalSocket::addressOf(session, &address);
    m_socket = LocalSocket::make();
    if (!m_socket.isOpen() || ::bind(m_socket.number(), reinterpret_cast<const sockaddr *>(&address), length) < 0
        || ::listen(m_socket.number(), Backlog) < 0) {
        *error = QStringLiteral("cannot listen for local nodes: %1").arg(systemErrorText());
        close();
        return false;
    }
    m_clock = std::make_unique<QTimer>();
    m_clock->setInterval(std::chrono::seconds(1));
    QObject::connect(m_clock.get(), &QTimer::timeout, m_clock.get(), [this] { dropOld(); });
    m_notifier = std::make_unique<QSocketNotifier>(m_socket.number(), QSocketNotifier::Read);
    QObject::connect(m_notifier.get(), &QSocketNotifier::activated, m_notifier.get(), [this] { acceptAll(); });
    return true;
}

void LocalListener::close()
{
    m_clock.reset();
    m_waiting.clear();
    m_notifier.reset();
    m_socket = Descriptor();
}

/// Empties the queue of the kernel, which is full of strangers at worst.
void LocalListener::acceptAll()
{
    for (int turn = 0; turn <= Backlog; ++turn) {
        Descriptor socket(::accept4(m_socket.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
        if (!socket.isOpen()) {
            // No descriptor is left: look again after a while, not at every turn of the event loop.
            if (errno == EMFILE || errno == ENFILE) {
                m_notifier->setEnabled(false);
                startClock();
            }
            return;
        }
        if (LocalSocket::userOfPeer(socket.number()) != ::geteuid())
            continue;
        if (m_waiting.size() == MaximumWaiting)
            m_waiting.erase(m_waiting.begin());
        m_waiting.push_back({std::move(socket), monotonicNow(), {}});
        startClock();
    }
}

/// Of those that wait; what is closed or sends something else does not wait any longer.
void LocalListener::readKeys()
{
    const auto isUseless = [](Waiting &each) {
        if (each.key)
            return false;
        const std::optional<DescriptorMessage> message = receiveDescriptors(each.socket.number());
        if (!message)
            return errno != EAGAIN;
        each.key = message->key;
        return !message->descriptors.empty();
    };
    m_waiting.erase(std::remove_if(m_waiting.begin(), m_waiting.end(), isUseless), m_waiting.end());
}

bool LocalListener::pass(std::uint64_t key, const std::vector<int> &descriptors, QString *error)
{
    if (m_socket.isOpen())
        acceptAll();
    readKeys();
    const auto found
        = std::find_if(m_waiting.begin(), m_waiting.end(), [key](const Waiting &each) { return each.key == key; });
    if (found == m_waiting.end()) {
        *error
            = QStringLiteral("no program of user %1 has connected with this localKey: local nodes run as the user of "
                             "their master; run both as the same user, or use udp")
                  .arg(::geteuid());
        return false;
    }
    const Descriptor socket = std::move(found->socket);
    m_waiting.erase(found);
    if (sendDescriptors(socket.number(), key, descriptors))
        return true;
    *error = QStringLiteral("cannot pass shared memory to a local node: %1").arg(systemErrorText());
    return false;
}

void LocalListener::startClock()
{
    if (!m_clock->isActive())
        m_clock->start();
}

void LocalListener::dropOld()
{
    const std::int64_t oldest = monotonicNow() - LongestWaiting;
    const auto isOld = [oldest](const Waiting &each) { return each.since < oldest; };
    m_waiting.erase(std::remove_if(m_waiting.begin(), m_waiting.end(), isOld), m_waiting.end());
    m_notifier->setEnabled(true);
    if (m_waiting.empty())
        m_clock->stop();
}

}  // namespace qplc
