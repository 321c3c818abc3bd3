// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/messages/MessageTable.h"

#include <QtCore/QJsonDocument>
#include <QtCore/QtEndian>
#include <QtNetwork/QTcpServer>
#include <QtNetwork/QTcpSocket>

#include <algorithm>
#include <memory>

/// Stands between a window and a master, passes all bytes on, and keeps the commands that go to the
/// master.
class CommandTap : public QObject
{
public:
    explicit CommandTap(quint16 masterPort)
        : m_masterPort(masterPort)
    {
        connect(&m_server, &QTcpServer::newConnection, this, [this] {
            while (QTcpSocket *window = m_server.nextPendingConnection())
                relay(window);
        });
        m_server.listen(QHostAddress::LocalHost);
    }
    QString address() const { return QStringLiteral("127.0.0.1:%1").arg(m_server.serverPort()); }
    /// Everything that changes something at the master, in the order of its arrival.
    const QVector<QPlcMessage> &commands() const { return m_commands; }
    int count(QPlcMessage::Kind kind) const
    {
        return int(std::count_if(m_commands.begin(), m_commands.end(),
                                 [kind](const QPlcMessage &message) { return message.kind() == kind; }));
    }
    void clear() { m_commands.clear(); }
    /// Cuts all connections, and takes no new ones.
    void cut()
    {
        m_server.close();
        const QList<QTcpSocket *> windows = m_server.findChildren<QTcpSocket *>(QString(), Qt::FindDirectChildrenOnly);
        for (QTcpSocket *window : windows)
            window->abort();
    }

private:
    /// What one connection has sent that is no whole message yet.
    struct Reader
    {
        QByteArray bytes;
        bool isCyclic = false;  // frames of cycles: no commands
    };

    void relay(QTcpSocket *window)
    {
        auto *master = new QTcpSocket(window);
        auto reader = std::make_shared<Reader>();
        connect(window, &QTcpSocket::readyRead, master, [this, window, master, reader] {
            const QByteArray bytes = window->readAll();
            read(reader.get(), bytes);
            master->write(bytes);
        });
        connect(master, &QTcpSocket::readyRead, window, [window, master] { window->write(master->readAll()); });
        connect(window, &QTcpSocket::disconnected, window, &QObject::deleteLater);
        connect(master, &QTcpSocket::disconnected, window, &QTcpSocket::disconnectFromHost);
        master->connectToHost(QHostAddress::LocalHost, m_masterPort);
    }

    /// Control frames: length of the text and a byte for the kind, the kind, the text.
    void read(Reader *reader, const QByteArray &bytes)
    {
        constexpr int headerSize = 5;
        reader->bytes += bytes;
        while (!reader->isCyclic && reader->bytes.size() >= headerSize) {
            const int size = int(qFromLittleEndian<quint32>(reader->bytes.constData()));
            if (reader->bytes.size() < headerSize - 1 + size)
                return;
            const auto kind = QPlcMessage::Kind(quint8(reader->bytes.at(headerSize - 1)));
            const QByteArray text = reader->bytes.mid(headerSize, size - 1);
            reader->bytes.remove(0, headerSize - 1 + size);
            reader->isCyclic = kind == QPlcMessage::AttachCyclicChannel;
            if (qplc::messages::isCommand(kind))
                m_commands.append(QPlcMessage(kind, QJsonDocument::fromJson(text).object()));
        }
    }

    QTcpServer m_server;
    quint16 m_masterPort;
    QVector<QPlcMessage> m_commands;
};
