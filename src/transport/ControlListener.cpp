// SPDX-License-Identifier: Apache-2.0
#include "ControlListener.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr int Queue = 512;  // of who has not been taken yet: all nodes of a plant may come back at once

}  // namespace

ControlListener::ControlListener(QObject *parent)
    : QObject(parent)
{
}

ControlListener::~ControlListener()
{
    close();
}

bool ControlListener::listen(const QHostAddress &address, quint16 port)
{
    close();
    if (!m_server.listen(address, port))
        return false;
    ::listen(int(m_server.socketDescriptor()), Queue);  // Qt asks for 50
    m_server.pauseAccepting();                          // its notifier is off: this one takes its place
    m_notifier = std::make_unique<QSocketNotifier>(m_server.socketDescriptor(), QSocketNotifier::Read);
    connect(m_notifier.get(), &QSocketNotifier::activated, this, &ControlListener::arrived);
    reserve();
    return true;
}

void ControlListener::close()
{
    m_notifier.reset();
    m_server.close();
    if (m_reserve >= 0)
        ::close(m_reserve);
    m_reserve = -1;
}

void ControlListener::reserve()
{
    m_reserve = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
}

int ControlListener::take()
{
    while (m_notifier) {
        const int descriptor
            = ::accept4(int(m_server.socketDescriptor()), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
        if (descriptor >= 0)
            return descriptor;
        if (errno == EMFILE || errno == ENFILE) {
            closeOneForWantOfDescriptors();
            return -1;  // one in each turn of the event loop: others have work, too
        }
        if (errno != EINTR && errno != ECONNABORTED)
            return -1;
    }
    return -1;
}

void ControlListener::closeOneForWantOfDescriptors()
{
    if (m_reserve >= 0)
        ::close(m_reserve);
    const int descriptor = ::accept4(int(m_server.socketDescriptor()), nullptr, nullptr, SOCK_CLOEXEC);
    if (descriptor >= 0) {
        ++m_withoutDescriptor;
        ::close(descriptor);
    } else if (errno == EMFILE || errno == ENFILE) {
        setAttentive(false);  // others have taken the one in reserve, too: not at every turn of the event loop
    }
    reserve();
}

void ControlListener::setAttentive(bool attentive)
{
    if (m_notifier && m_notifier->isEnabled() != attentive)
        m_notifier->setEnabled(attentive);
}

}  // namespace qplc
