// SPDX-License-Identifier: Apache-2.0
#include "ControlListener.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace qplc {

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
    m_port = ControlNetwork::current().listen(address, port, &m_error, &m_errorString);
    if (!m_port)
        return false;
    m_notifier = std::make_unique<QSocketNotifier>(m_port->descriptor(), QSocketNotifier::Read);
    connect(m_notifier.get(), &QSocketNotifier::activated, this, &ControlListener::arrived);
    reserve();
    return true;
}

void ControlListener::close()
{
    m_notifier.reset();
    m_port.reset();
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
        const int descriptor = m_port->accept();
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
    const int descriptor = m_port->accept();
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
