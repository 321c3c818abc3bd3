// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <memory>
#include <modbus/modbus.h>
#include <mutex>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

/// A Modbus device as a thread: a server of libmodbus with 200 bits and registers of each kind, on
/// a free TCP port of loopback or on one end of a pseudo terminal.
class ModbusServer
{
public:
    static constexpr int Size = 200;
    static constexpr int Unit = 1;  // that it answers to on a serial line

    struct Seen
    {
        int function;
        int first;
    };

    static std::unique_ptr<ModbusServer> onTcp(int port = 0)
    {
        std::unique_ptr<ModbusServer> server(new ModbusServer(modbus_new_tcp("127.0.0.1", port)));
        server->m_listener = modbus_tcp_listen(server->m_context, 2);
        sockaddr_in address{};
        socklen_t length = sizeof address;
        ::getsockname(server->m_listener, reinterpret_cast<sockaddr *>(&address), &length);
        server->m_port = ntohs(address.sin_port);
        server->start();
        return server;
    }

    static std::unique_ptr<ModbusServer> onSerialLine()
    {
        std::unique_ptr<ModbusServer> server(new ModbusServer(modbus_new_rtu("/dev/ptmx", 19200, 'E', 8, 1)));
        const int ours = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
        ::grantpt(ours);
        ::unlockpt(ours);
        std::array<char, 64> name{};
        ::ptsname_r(ours, name.data(), name.size());
        server->m_line = QString::fromLatin1(name.data());
        // Kept open: else the line would be hung up while nobody else has it open.
        server->m_otherEnd = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        modbus_set_slave(server->m_context, Unit);
        modbus_set_socket(server->m_context, ours);
        server->m_client = ours;
        server->start();
        return server;
    }

    ~ModbusServer()
    {
        const quint64 one = 1;
        const ssize_t written = ::write(m_stop, &one, sizeof one);
        Q_UNUSED(written)
        m_thread.join();
        for (int descriptor : {m_client, m_listener, m_otherEnd, m_stop}) {
            if (descriptor >= 0)
                ::close(descriptor);
        }
        modbus_mapping_free(m_mapping);
        modbus_free(m_context);
    }
    ModbusServer(const ModbusServer &) = delete;
    ModbusServer &operator=(const ModbusServer &) = delete;

    int port() const { return m_port; }
    /// The end for others of the serial line.
    QString line() const { return m_line; }
    int otherEnd() const { return m_otherEnd; }

    /// What is done with the values while no request is answered.
    template<typename Function>
    auto with(Function function)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        return function(*m_mapping);
    }
    /// From here on all requests are answered with this exception; 0: no longer.
    void answerWith(int exception)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_exception = exception;
    }
    /// It takes requests and answers none.
    void setSilent(bool isSilent)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_isSilent = isSilent;
    }
    /// The next answer is one that cannot be meant: too long, with a wrong checksum (serial line)
    /// or number (TCP).
    void garbleNext()
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_isGarbled = true;
    }
    std::vector<Seen> takeRequests()
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        return std::exchange(m_requests, {});
    }

private:
    explicit ModbusServer(modbus_t *context)
        : m_context(context)
        , m_mapping(modbus_mapping_new(Size, Size, Size, Size))
        , m_stop(::eventfd(0, EFD_CLOEXEC))
    {
    }

    void start()
    {
        m_thread = std::thread([this] { run(); });
    }

    void run()
    {
        for (;;) {
            pollfd descriptors[] = {{m_stop, POLLIN, 0}, {m_client >= 0 ? m_client : m_listener, POLLIN, 0}};
            if (::poll(descriptors, 2, -1) < 0 || descriptors[0].revents != 0)
                return;
            if (m_client < 0)
                m_client = modbus_tcp_accept(m_context, &m_listener);
            else
                serve();
        }
    }

    void serve()
    {
        std::array<quint8, MODBUS_TCP_MAX_ADU_LENGTH> request{};
        const int length = modbus_receive(m_context, request.data());
        if (length > 0)
            answer(request.data(), length);
        else if (length < 0 && m_listener >= 0)
            hangUp();
    }

    void hangUp()
    {
        ::close(m_client);
        m_client = -1;
    }

    void answer(const quint8 *request, int length)
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        const quint8 *body = request + modbus_get_header_length(m_context);
        m_requests.push_back({body[0], body[1] << 8 | body[2]});
        if (m_exception != 0)
            modbus_reply_exception(m_context, request, unsigned(m_exception));
        else if (std::exchange(m_isGarbled, false))
            garble(request);
        else if (!m_isSilent)
            modbus_reply(m_context, request, length, m_mapping);
    }

    void garble(const quint8 *request)
    {
        const quint8 onLine[] = {request[0], request[1], 2, 0x12, 0x34, 0xAA, 0xAA, 0x01, 0x04, 0x02};
        const quint8 onTcp[] = {quint8(~request[0]), request[1], 0, 0, 0, 5, request[6], request[7], 2, 0x12, 0x34};
        const bool isSerial = m_listener < 0;
        const ssize_t written = ::write(m_client, isSerial ? onLine : onTcp, isSerial ? sizeof onLine : sizeof onTcp);
        Q_UNUSED(written)
    }

    modbus_t *m_context;
    modbus_mapping_t *m_mapping;
    int m_stop;
    int m_listener = -1;
    int m_client = -1;
    int m_otherEnd = -1;
    int m_port = 0;
    QString m_line;
    std::mutex m_mutex;
    int m_exception = 0;
    bool m_isSilent = false;
    bool m_isGarbled = false;
    std::vector<Seen> m_requests;
    std::thread m_thread;
};
