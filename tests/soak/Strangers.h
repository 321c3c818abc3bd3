// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

#include <QtCore/QByteArray>

#include <random>
#include <vector>

namespace soak {

/// What strangers say.
class StrangerWords
{
public:
    explicit StrangerWords(quint64 seed)
        : m_random(seed)
    {
    }
    quint64 number() { return m_random(); }
    QByteArray randomBytes(int size);
    /// What a receiver knows to be no message as soon as it has all of it.
    QByteArray garbageMessage();
    static QPlcMessage greeting();

private:
    std::mt19937_64 m_random;
};

/// Who has no business with the plant, and sends all the same. All of it goes to this machine.
class Strangers
{
public:
    explicit Strangers(quint64 seed);
    ~Strangers();
    Strangers(const Strangers &) = delete;
    Strangers &operator=(const Strangers &) = delete;

    /// Datagrams of random bytes, from a port of its own, so slowly that the system drops none of
    /// them. \return how many were sent
    int sendDatagrams(quint16 port, int count);
    /// Connections that send bytes which are no message. \return how many could be made
    int sendGarbage(quint16 port, int count);
    /// Connections that greet without TLS, and tell the master to start, to stop, to arm or to set
    /// a signal. \return how many could be made
    int sendCommands(quint16 port, int count);
    /// Closes the connections that the master has ended. \return how many these were
    int leaveEnded();
    /// Connections that say nothing, and stay until leave(). \return how many could be made
    int connectOnly(quint16 port, int count);
    /// A tool that greets, asks \a count times for much, and reads nothing; it stays until leave().
    /// \return requests that the master's system took
    int askWithoutReading(quint16 port, int count);
    /// Closes all connections.
    void leave();

private:
    int connection(quint16 port, int receiveBuffer = 0);
    bool connectAndSend(quint16 port, const QByteArray &bytes);

    StrangerWords m_words;
    std::vector<int> m_connections;
};

}  // namespace soak
